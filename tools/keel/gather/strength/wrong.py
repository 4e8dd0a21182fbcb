# SPDX-License-Identifier: Apache-2.0
"""Wrong bodies and wrong bounds: mistakes made on purpose, which a proof must refuse."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.files import read_text
from keel.c.project import find_units
from keel.gather.part import Item, State, Table
from keel.judge.wrong_bodies import read_wrong_bodies

Report = Mapping[str, Any]

COMMENT = re.compile(r"^#(?: (?!\w+: )(.*))?$", re.MULTILINE)
# Where the report says nothing, the report is what is wrong, and not each mistake.
VERDICTS: Mapping[bool | None, tuple[str, State]] = {
    True: ("refused", "good"),
    False: ("not refused", "bad"),
    None: ("no verdict", "open"),
}
EXPECTED = re.compile(r"^# expect: *(\S+)", re.MULTILINE)


@dataclass(frozen=True)
class Mistake:
    """A mistake, what must refuse it, and whether that was so."""

    unit: str
    name: str
    mistake: str
    by: str  # The harness as a link, or Gappa.
    expected: str
    refused: bool | None  # None: the report says nothing of it.

    @property
    def id(self) -> str:
        """As an item."""
        return f"{self.unit}/wrong-{self.name}"


def mistake_in(text: str) -> str:
    """What the comments in a file of bounds say that are no directives."""
    return " ".join(match[1] for match in COMMENT.finditer(text) if match[1]).strip()


def read_mistakes(root: Path, report: Report) -> list[Mistake]:
    """The wrong bodies and bounds of all units."""
    found = []
    for unit in find_units(root).values():
        said = report.get("units", {}).get(unit.name, {})
        bodies = said.get("cbmc", {}).get("negative", {}).get("list", {})
        bounds = said.get("gappa", {}).get("negative", {}).get("list", {})
        for wrong in read_wrong_bodies(unit):
            found.append(
                Mistake(
                    unit.name,
                    wrong.name,
                    wrong.description,
                    f"harness:{unit.name}/{wrong.harness}",
                    ", ".join(wrong.expect),
                    bodies.get(wrong.name),
                )
            )
        for path in unit.wrong_statements:
            text = read_text(path)
            expected = ", ".join(EXPECTED.findall(text))
            found.append(
                Mistake(
                    unit.name, path.stem, mistake_in(text), "Gappa", expected, bounds.get(path.name)
                )
            )
    return found


def problems(every: list[Mistake]) -> Iterator[str]:
    """A mistake that nobody refuses, of which nothing is known, or that nobody has described."""
    for one in every:
        if one.refused is None:
            yield f"wrong body {one.id}: build/prove/report.json has no verdict of it"
        elif not one.refused:
            yield f"wrong body {one.id}: is not refused by {one.by.partition(':')[2] or one.by}"
        if not one.mistake:
            yield f"wrong body {one.id}: its head does not say what the mistake is"


def items(every: list[Mistake]) -> Iterator[Item]:
    """Each mistake."""
    for one in every:
        harness = (one.by,) if one.by.startswith("harness:") else ()
        verdict, state = VERDICTS[one.refused]
        yield Item(
            kind="mutant",
            id=one.id,
            title=f"{one.unit}: {one.name.replace('_', ' ')}",
            text=one.mistake,
            state=state,
            facts={"must fail": one.expected, "verdict": verdict},
            links=(f"unit:{one.unit}", *harness),
        )


def table(every: list[Mistake]) -> Table:
    """All mistakes."""
    rows = tuple(
        (f"mutant:{one.id}", one.mistake, one.by, one.expected, VERDICTS[one.refused][0])
        for one in every
    )
    return Table(
        title="Mistakes made on purpose",
        rows=rows,
        columns=("wrong body", "mistake", "refused by", "what must fail", "verdict"),
    )
