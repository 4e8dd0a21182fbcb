# SPDX-License-Identifier: Apache-2.0
"""Recorded results of mutation (specs/mutation): scores, survivors, and what has gone stale."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.c.project import find_units
from keel.evidence.part import Item, State, Table
from keel.install import Found
from keel.mutate import standing as mutant_standing
from keel.mutate.standing import Standing

Report = Mapping[str, Any]

OPEN = ("survived", "undecided", "skipped")
STATES: Mapping[str, State] = {"killed": "good", "equivalent": "told"}
OURS = ("source", "proofs")  # Of what a result is made of, what a commit changes.


def found_of(report: Report) -> dict[str, Found]:
    """The tools of the last make prove."""
    return {
        name: Found(name, tool["version"], "", "", tool["sha256"], 0, 0, {}, {}, tool["parts"])
        for name, tool in report.get("tools", {}).items()
    }


def standings(root: Path, report: Report, problems: list[str]) -> list[Standing]:
    """Every unit with proofs, beside the tools of a report; what cannot be read is a problem."""
    units = find_units(root).values()
    return list(mutant_standing.standings(root, units, found_of(report), problems))


def change(mutant: Report) -> str:
    """What was changed, for people."""
    return f"{mutant['original']}  ->  {mutant['mutant']}"


def problems(every: Sequence[Standing]) -> Iterator[str]:
    """A result that is stale, and a survivor that nobody has explained.

    One that is stale by its tools alone is shown so, and counts for nothing, but is no problem: on
    another machine they may be of other versions, which no commit can mend.
    """
    for one in every:
        if ours := [name for name in one.stale if name in OURS]:
            yield f"{one.shown}: is stale, {', '.join(ours)} changed since: make mutate again"
        for mutant in one.with_status(*OPEN):
            yield (f"{one.shown}: {mutant['function']}:{mutant['line']}: {mutant['status']},"
                   f" unexplained: {change(mutant)}")  # fmt: skip
        for mutant in one.with_status("equivalent"):
            if not mutant.get("reason"):
                yield f"{one.shown}: {mutant['function']}:{mutant['line']}: without a reason"
        if one.record:
            yield from (f"{one.shown}: {text}" for text in one.record["problems"])


def foreseen(root: Path) -> list[str]:
    """The problems that no command can mend which is run for the package, known before any is."""
    found: list[str] = []
    every = standings(root, {}, found)
    return [*found, *problems(every)]


def killer(mutant: Report) -> str:
    """Who noticed a mutant."""
    said = [f"{engine.upper()} {text.removeprefix('killed: ')}"
            for engine, text in mutant["engines"].items() if text.startswith("killed")]  # fmt: skip
    return said[0] if said else ""


def items(every: Sequence[Standing]) -> Iterator[Item]:
    """Each mutant of each result; of a stale result none is good."""
    for one in every:
        for number, mutant in enumerate(one.record["mutants"] if one.record else [], 1):
            if mutant["status"] == "stillborn":
                continue
            state = STATES.get(mutant["status"], "bad")
            yield Item(
                kind="mutant", id=f"{one.unit}/{number}",
                title=f"{mutant['function']}:{mutant['line']}: {mutant['kind']}",
                text=change(mutant), state=state if one.current else "open",
                facts={
                    "verdict": mutant["status"], "noticed by": killer(mutant) or "nobody",
                    "why it makes no difference": mutant.get("reason", ""), "result": one.how,
                },
                links=(f"unit:{one.unit}",),
            )  # fmt: skip


def killed_by(every: Sequence[Standing], engine: str) -> int:
    """How many mutants an engine killed; where one has, the other is not asked as a rule."""
    return sum(mutant["engines"].get(engine, "").startswith("killed")
               for one in every for mutant in one.with_status("killed"))  # fmt: skip


def score(every: Sequence[Standing]) -> str:
    """Killed of counted."""
    killed = sum(len(one.with_status("killed")) for one in every)
    return f"{killed} of {sum(len(one.counted) for one in every)}"


def table(every: Sequence[Standing]) -> Table:
    """A line for each unit, and one for all results that are current."""
    rows = [
        (
            f"unit:{one.unit}", one.how, score([one]), str(killed_by([one], "cbmc")),
            str(killed_by([one], "wp")), str(len(one.with_status("equivalent"))),
            str(len(one.with_status(*OPEN))),
        )
        if one.record
        else (f"unit:{one.unit}", one.how, "", "", "", "", "")
        for one in every
    ]  # fmt: skip
    current = [one for one in every if one.current]
    rows.append(
        ("all that are current", f"{len(current)} of {len(every)} units", score(current),
         str(killed_by(current, "cbmc")), str(killed_by(current, "wp")),
         str(sum(len(one.with_status("equivalent")) for one in current)),
         str(sum(len(one.with_status(*OPEN)) for one in current)))
    )  # fmt: skip
    return Table(
        title="Mutants",
        columns=("unit", "result", "killed", "by CBMC", "by WP", "make no difference", "open"),
        rows=tuple(rows),
        note="Counted are mutants that compile and make a difference. By CBMC is by a"
             " counterexample to one of its harnesses, by executing it or by a solver. WP is asked"
             " for what CBMC does not notice in little time, so these are not two independent"
             " scores. A unit whose mutants were not run shows nothing about the strength of its"
             " proofs.",
    )  # fmt: skip


def survivors(every: Sequence[Standing]) -> Table:
    """What nobody notices, each with the reason that a person gave."""
    rows = [
        (f"unit:{one.unit}", f"{mutant['function']}:{mutant['line']}", change(mutant),
         mutant["status"] if mutant["status"] in OPEN else "makes no difference",
         mutant.get("reason", ""))
        for one in every
        for mutant in one.with_status("equivalent", *OPEN)
        if mutant.get("reason") != "same object code"
    ]  # fmt: skip
    return Table(
        title="Survivors, adjudicated", columns=("unit", "place", "change", "verdict", "reason"),
        rows=tuple(rows),
        note="Those that compile to the same object code are left out here, and counted above.",
    )
