# SPDX-License-Identifier: Apache-2.0
"""The part `safety`: the safety manual, that is what an integrator must ensure, numbered.

Each constraint is an entry of the ledger in specs/soundness.md of which the integrator is the
owner, under the ledger's number: SC-07 rests on A-07, and neither number changes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from keel.base.files import read_text
from keel.gather.markdown import sections, tables
from keel.gather.part import Context, Item, Part, Table

LEDGER = "specs/soundness.md"
SECTION = "The ledger of assumptions"
OWNER = "integrator"
NUMBER = re.compile(r"A-(\d+)")
TEXT = """\
Keel's proofs hold under assumptions. Those that only the integrator can ensure are constraints on
the system in which Keel is used: each SC is to be shown by the integrator, in the way that is named
or in a better one, and kept with the system's own evidence.

Keel is a component. That a system is safe with it is not shown here: hazards, safety goals and
integrity levels are the system's."""


def column(row: Mapping[str, str], begin: str) -> str:
    """The cell of the column whose name begins so."""
    return next((text for name, text in row.items() if name.startswith(begin)), "")


def entries(text: str) -> Iterator[dict[str, str]]:
    """The ledger's rows, those of all its tables."""
    for rows in tables(sections(text).get(SECTION, "")):
        yield from (row for row in rows if NUMBER.fullmatch(row.get("id", "")))


def constraint(row: Mapping[str, str]) -> Item:
    """What the integrator must ensure."""
    facts = {
        "ensured by": column(row, "who"),
        "verification": column(row, "how"),
        "stated in": column(row, "stated"),
    }
    return Item(
        kind="constraint",
        id=row["id"].replace("A-", "SC-"),
        title=row["assumption"],
        facts={name: text for name, text in facts.items() if text},
        links=(f"assumption:{row['id']}",),
    )


def faults(rows: list[dict[str, str]]) -> Iterator[str]:
    """What keeps the ledger from being a safety manual."""
    if not rows:
        yield f"{LEDGER}: there is no entry below {SECTION!r}"
    for row in rows:
        if not row.get("owner"):
            yield f"{LEDGER}: {row['id']}: has no owner"
        if not column(row, "how"):
            yield f"{LEDGER}: {row['id']}: does not say how it is verified"


def make(context: Context) -> Part:
    """The manual."""
    rows = list(entries(read_text(context.root / LEDGER)))
    own = [constraint(row) for row in rows if row.get("owner") == OWNER]
    others = tuple(
        (f"assumption:{row['id']}", row["assumption"], row.get("owner", ""))
        for row in rows
        if row.get("owner") != OWNER
    )
    manual = Table(
        title="Constraints on the integrator",
        columns=("constraint", "what must hold", "by whom", "how it is verified"),
        rows=tuple(
            (
                f"constraint:{item.id}",
                item.title,
                item.facts.get("ensured by", ""),
                item.facts.get("verification", ""),
            )
            for item in own
        ),
    )
    rest = Table(
        title="Assumptions that are not the integrator's",
        rows=others,
        columns=("assumption", "what is assumed", "owner"),
    )
    return Part(
        name="safety",
        title="Safety manual",
        text=TEXT,
        items=tuple(own),
        tables=(manual, rest),
        summary={
            "constraints on the integrator": str(len(own)),
            "other assumptions": str(len(others)),
        },
        problems=tuple(faults(rows)),
    )
