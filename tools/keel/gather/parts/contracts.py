# SPDX-License-Identifier: Apache-2.0
"""The part `contracts`: every public function as its header declares it, comment and contract."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from keel.base.files import read_text
from keel.c.project import Unit, find_units
from keel.gather.part import Context, Item, Part

DECLARATION = re.compile(
    r"(?P<comments>(?:/\*(?:(?!\*/).)*\*/\s*)+)"
    r"(?P<prototype>(?:[A-Za-z_][\w \n]*[ *\n])(?P<name>[a-z]\w*)\([^;{}]*\))\s*[;{]",
    re.DOTALL,
)
GUARDS = re.compile(r"^[A-Z_]+\n", re.MULTILINE)  # KEEL_C_BEGIN, which stands alone.
DOCUMENTED = "/**"
CONTRACT = "/*@"
SENTENCE = re.compile(
    r"/\*\*[\s*]*(.*?)(?:\s\((?:requirement|eq|[A-Z]{3}-)|(?<!eq)\.\s|\n \*\n|\s*\*/)", re.DOTALL
)
TEXT = """\
The promises and the preconditions of each public function: its comment, its contract in ACSL and
its prototype, as they stand in its headers. The formal proofs are about the contract."""


class Declared(NamedTuple):
    """A function of a header."""

    name: str
    text: str
    line: int

    @property
    def title(self) -> str:
        """The first sentence of its comment."""
        match = SENTENCE.search(self.text)
        words = re.sub(r"\s*\n\s*\*?\s*", " ", match[1]).strip() if match else ""
        return words or self.name


def declared(text: str) -> Iterator[Declared]:
    """The functions that a header declares or defines and explains; what stands in their contracts
    for any function of a user's has no such comment."""
    for match in DECLARATION.finditer(text):
        _, explained, rest = match["comments"].rpartition(DOCUMENTED)
        if explained:
            whole = GUARDS.sub("", f"{explained}{rest}{match['prototype']};")
            line = text.count("\n", 0, match.start("prototype")) + 1
            yield Declared(match["name"], whole.strip(), line)


def items_of(unit: Unit, root: Path) -> Iterator[Item]:
    """A unit and its functions."""
    links = tuple(f"file:{path.relative_to(root).as_posix()}" for path in unit.headers)
    yield Item(
        kind="unit",
        id=unit.name,
        title=f"{unit.layer}/{unit.name}",
        facts={"header": f"file:{unit.header.relative_to(root).as_posix()}"},
        links=links,
    )
    texts = {path: read_text(path) for path in unit.headers}
    apart = {
        match["name"]: match["comments"].strip()
        for text in texts.values()
        for match in DECLARATION.finditer(text)
        if DOCUMENTED not in match["comments"] and CONTRACT in match["comments"]
    }
    for path, text in texts.items():
        header = path.relative_to(root).as_posix()
        for one in declared(text):
            if one.name.startswith(f"{unit.prefix}"):
                contract = f"\n{apart[one.name]}" if one.name in apart else ""
                yield Item(
                    kind="function",
                    id=one.name,
                    title=one.title,
                    text=f"{one.text}{contract}",
                    facts={"declared at": f"{header}:{one.line}"},
                    links=(f"unit:{unit.name}", f"file:{header}"),
                )


def make(context: Context) -> Part:
    """All units."""
    units = find_units(context.root)
    items = tuple(item for unit in units.values() for item in items_of(unit, context.root))
    functions = [item for item in items if item.kind == "function"]
    bare = [f"{item.id}: has no contract" for item in functions if CONTRACT not in item.text]
    return Part(
        name="contracts",
        title="Contracts",
        text=TEXT,
        items=items,
        problems=tuple(bare),
        summary={"units": str(len(units)), "public functions": str(len(functions))},
    )
