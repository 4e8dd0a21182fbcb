# SPDX-License-Identifier: Apache-2.0
"""The soundness case, specs/soundness.md: its text, its tables, and the ledger of assumptions.

A table whose first column is `id` is part of the ledger. Each entry says whose it is to see to that
the assumption holds, in one of the words of OWNERS, and how that is verified; one without either
is refused, as is an id that is given twice.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from keel.base.errors import ToolError
from keel.gather.part import Item, Table

FILE = "specs/soundness.md"
COLUMNS = ("id", "assumption", "stated in", "owner", "who ensures it", "how it is verified")
# Who answers for an assumption: who builds a product on Keel, Keel itself, or a tool's maker.
OWNERS = ("integrator", "Keel", "tool")
ID = re.compile(r"^A-\d{2}$")
RULE = re.compile(r"^\|[-| :]+\|$")
CELL = re.compile(r"(?<!\\)\|")


class LedgerError(ToolError):
    """What is wrong with the ledger, with file and line."""

    status = 1


@dataclass(frozen=True)
class MarkdownTable:
    """A table of a document, the section that it stands in, and its first line."""

    section: str
    line: int
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Assumption:
    """An entry of the ledger."""

    id: str
    assumption: str
    stated_in: str
    owner: str
    ensured_by: str
    verified: str

    @property
    def item(self) -> Item:
        """As an item of the package."""
        return Item(
            kind="assumption",
            id=self.id,
            title=f"{self.id}: {self.assumption}",
            text=self.assumption,
            facts={
                "owner": self.owner,
                "ensured by": self.ensured_by,
                "stated in": self.stated_in,
                "how it is verified": self.verified,
            },
        )


def tables_of(text: str) -> Iterator[MarkdownTable]:
    """The tables of a document in Markdown."""
    rows: list[tuple[str, ...]] = []
    section, first = "", 0
    for number, line in enumerate([*text.splitlines(), ""], 1):
        if line.startswith("#"):
            section = line.lstrip("#").strip()
        if line.startswith("|"):
            first = first if rows else number
            if not RULE.match(line):
                rows.append(tuple(cell.strip() for cell in CELL.split(line.strip())[1:-1]))
        elif rows:
            yield MarkdownTable(section, first, rows[0], tuple(rows[1:]))
            rows = []


def prose_of(text: str) -> str:
    """A document without its tables."""
    return "\n".join(line for line in text.splitlines() if not line.startswith("|"))


def read_ledger(text: str) -> list[Assumption]:
    """The entries of the ledger, in order; whatever one lacks refuses the whole."""
    found: dict[str, Assumption] = {}
    for table in tables_of(text):
        if table.columns[:1] != COLUMNS[:1]:
            continue
        if table.columns != COLUMNS:
            raise LedgerError(f"{FILE}:{table.line}: the ledger's columns are {', '.join(COLUMNS)}")
        for number, row in enumerate(table.rows, table.line + 2):
            entry = _entry(row, f"{FILE}:{number}")
            if entry.id in found:
                raise LedgerError(f"{FILE}:{number}: {entry.id} is given twice")
            found[entry.id] = entry
    if not found:
        raise LedgerError(f"{FILE}: has no ledger of assumptions")
    return list(found.values())


def _entry(row: Sequence[str], place: str) -> Assumption:
    if len(row) != len(COLUMNS):
        raise LedgerError(f"{place}: {len(row)} cells, {len(COLUMNS)} are wanted")
    if not ID.match(row[0]):
        raise LedgerError(f"{place}: {row[0] or 'nothing'} is no id: A- and two digits")
    for name, cell in zip(COLUMNS, row, strict=True):
        if not cell:
            raise LedgerError(f"{place}: {row[0]}: {name}: missing")
    if row[3] not in OWNERS:
        raise LedgerError(f"{place}: {row[0]}: owner: {row[3]} is none of {', '.join(OWNERS)}")
    return Assumption(*row)


def tables(text: str) -> list[Table]:
    """The document's tables, in the package's form."""
    return [
        Table(title=f"Soundness: {table.section}", columns=table.columns, rows=table.rows)
        for table in tables_of(text)
        if table.columns[0] != COLUMNS[0]
    ]


def ledger_table(entries: Sequence[Assumption]) -> Table:
    """The whole ledger in one table."""
    rows = tuple(
        (f"assumption:{one.id}", one.assumption, one.owner, one.ensured_by, one.verified)
        for one in entries
    )
    return Table(
        title="Ledger of assumptions",
        columns=("id", "assumption", "owner", "ensured by", "how it is verified"),
        rows=rows,
        note="Owner: who answers for it. An assumption that is verified by review holds only where"
        " somebody has made that review: this package cannot show it.",
    )
