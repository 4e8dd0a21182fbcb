# SPDX-License-Identifier: Apache-2.0
"""Traces each function of the product up to requirements.

What a header offers traces by the labels of its contract's clauses, also those that a macro stands
for: QUE_003_order stands for QUE-003. A static function of a source has no meaning of its own: it
traces by its callers, if there are any and all of them trace.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from keel.c import source as csource
from keel.c.declarations import macros
from keel.judge import wp_frames

LABEL = re.compile(r"\bensures\s+([A-Z]{3,4})_(\d{3})(?:_\w+)?\s*:")


@dataclass(frozen=True)
class Function:
    """A function that the product defines."""

    name: str
    file: str
    line: int
    helper: bool
    requirements: tuple[str, ...] = ()
    callers: tuple[str, ...] = field(default=())


def read_functions(root: Path) -> list[Function]:
    """Every function of src and include, with the requirements that it traces to."""
    headers = sorted((root / "include").glob("keel/**/*.h"))
    sources = sorted((root / "src").glob("**/*.c"))
    texts = [path.read_text(encoding="utf-8") for path in headers]
    short = {name: text for name, (_, text) in macros(texts).items()}
    labels: dict[str, tuple[str, ...]] = {}
    for text in texts:
        for name, contract in wp_frames.contracts(text):
            labels[name] = labels.get(name, ()) + _uids(contract, short)
    found = []
    for path in headers + sources:
        found += _of_file(root, path, labels)
    return found


def _uids(contract: str, short: Mapping[str, str]) -> tuple[str, ...]:
    """The requirements that a contract names, each once, its macros laid open."""
    words = dict.fromkeys(re.findall(r"\b[A-Z]\w+", contract))
    opened = [contract, *(short[word] for word in words if "ensures" in short.get(word, ""))]
    uids = [f"{unit}-{number}" for text in opened for unit, number in LABEL.findall(text)]
    inner = [uid for text in opened[1:] for uid in _uids(text, short)]
    return tuple(dict.fromkeys(uids + inner))


def _of_file(root: Path, path: Path, labels: dict[str, tuple[str, ...]]) -> list[Function]:
    """The functions that a file defines, the helpers with what their callers trace to."""
    text = path.read_text(encoding="utf-8")
    where = path.relative_to(root).as_posix()
    bodies = {one.name: csource.body_of(text, one.name) for one in csource.defined(text)}
    found = {
        one.name: Function(
            one.name,
            where,
            one.line,
            helper=one.static and path.suffix == ".c",
            requirements=labels.get(one.name, ()),
            callers=tuple(
                name
                for name, body in bodies.items()
                if name != one.name and csource.calls(body, one.name)
            ),
        )
        for one in csource.defined(text)
    }
    for _ in found:  # A chain of helpers is no longer than there are functions.
        found = {name: _by_callers(one, found) for name, one in found.items()}
    return list(found.values())


def _by_callers(one: Function, known: dict[str, Function]) -> Function:
    """A helper with the requirements of its callers, if all of them trace."""
    above = [known[name].requirements for name in one.callers]
    if not one.helper or not all(above):
        return one
    return replace(one, requirements=tuple(sorted({uid for uids in above for uid in uids})))


def function_problems(functions: list[Function]) -> list[str]:
    """The functions that trace to no requirement."""
    return [f"{one.file}: {one.name}: {_why(one)}" for one in functions if not one.requirements]


def _why(one: Function) -> str:
    if not one.helper:
        return "no clause of its contract bears a requirement's id"
    if not one.callers:
        return "nothing calls this static function"
    return f"not all of its callers trace to a requirement: {', '.join(one.callers)}"
