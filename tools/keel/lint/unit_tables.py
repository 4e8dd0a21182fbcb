# SPDX-License-Identifier: Apache-2.0
"""No tool has a table of units: what a unit needs of tests, benches or exceptions stands in data,
so that a new one changes no tool.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath

from keel.lint.texts import Finding, Text

TOOLS = "tools/keel/"
MOST = 4  # Fewer may be what the tool is about, such as the fields of a structure that it reads.
COLLECTIONS = (ast.Dict, ast.List, ast.Set, ast.Tuple)


def units_of(texts: Sequence[Text]) -> frozenset[str]:
    """The kernel's units, by their headers."""
    return frozenset(
        PurePosixPath(text.path).stem for text in texts if text.path.startswith("include/keel/")
    )


def unit_in(word: str, units: frozenset[str]) -> str:
    """The unit that a text names: as such, as a file, or as the beginning of a function or test."""
    name = PurePosixPath(word).stem.removeprefix("keel_")
    parts = name.split("_")
    starts = ("_".join(parts[:count]) for count in range(len(parts), 0, -1))
    return next((start for start in starts if start in units), "")


def check_unit_tables(texts: Sequence[Text]) -> Iterator[Finding]:
    """Tables of units in the tools."""
    units = units_of(texts)
    for text in texts:
        if text.path.startswith(TOOLS) and text.path.endswith(".py"):
            for line, names in tables_in("\n".join(text.lines), units).items():
                told = ", ".join(sorted(names)[: MOST + 1])
                yield Finding(text.path, line, f"a table of units, which is data: {told}, ...")


def tables_in(source: str, units: frozenset[str]) -> dict[int, set[str]]:
    """The lines in which tables of units begin; of tables within each other that of the outer."""
    found: dict[int, set[str]] = {}
    todo: list[ast.AST] = [ast.parse(source)]
    while todo:
        node = todo.pop()
        names = units_named(node, units) if isinstance(node, COLLECTIONS) else set()
        if len(names) > MOST and isinstance(node, ast.expr):
            found[node.lineno] = names
        else:
            todo += ast.iter_child_nodes(node)
    return dict(sorted(found.items()))


def units_named(node: ast.AST, units: frozenset[str]) -> set[str]:
    """The units that texts within a part of a file name."""
    words = (one.value for one in ast.walk(node) if isinstance(one, ast.Constant))
    return {unit_in(word, units) for word in words if isinstance(word, str)} - {""}
