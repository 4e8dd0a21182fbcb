# SPDX-License-Identifier: Apache-2.0
"""Results of mutation, from specs/mutation.toml: scores, survivors, and what has gone stale."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.c.project import find_units
from keel.gather.part import Item, State, Table
from keel.install import Found
from keel.mutate import standing as mutant_standing
from keel.mutate.standing import Standing, Survivor

Report = Mapping[str, Any]

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


def change(mutant: Survivor) -> str:
    """What was changed, for people."""
    return f"{mutant.original}  ->  {mutant.mutant}"


def unexplained(one: Standing) -> list[Survivor]:
    """The survivors of a unit that nobody has explained."""
    return [mutant for mutant in one.survivors if not mutant.reason]


def problems(every: Sequence[Standing]) -> Iterator[str]:
    """A result that is stale, and a survivor that nobody has explained.

    One that is stale by its tools alone is shown so, and counts for nothing, but is no problem: on
    another machine they may be of other versions, which no commit can mend.
    """
    for one in every:
        if ours := [name for name in one.stale if name in OURS]:
            yield f"{one.shown}: is stale, {', '.join(ours)} changed since: make mutate again"
        for mutant in unexplained(one):
            yield (
                f"{one.shown}: {mutant.function}:{mutant.line}: {mutant.status},"
                f" unexplained: {change(mutant)}"
            )
        if one.record:
            yield from (f"{one.shown}: {text}" for text in one.record.problems)


def foreseen(root: Path) -> list[str]:
    """The problems that no command can mend which is run for the package, known before any is."""
    found: list[str] = []
    every = standings(root, {}, found)
    return [*found, *problems(every)]


def items(every: Sequence[Standing]) -> Iterator[Item]:
    """The result on each unit, and each survivor without a reason; a stale result is not good."""
    for one in every:
        if one.record is None:
            continue
        killed = one.record.killed
        state: State = "bad" if one.record.open else "good"
        yield Item(
            kind="mutant",
            id=f"{one.unit}/result",
            title=f"{one.unit}: result of mutation",
            text=f"{killed.total} of {one.record.counted} mutants that make a difference are"
            " killed.",
            state=state if one.current else "open",
            facts={
                "result": one.how,
                "killed by executing harnesses": str(killed.executed),
                "killed by CBMC": str(killed.solved),
                "killed by WP": str(killed.wp),
                "harnesses that killed": ", ".join(one.record.killers),
                "of the same object code": str(one.record.same),
                "make no difference, with a reason": str(len(one.record.accepted)),
                "do not compile": str(one.record.stillborn),
            },
            links=(f"unit:{one.unit}",),
        )
        for number, mutant in enumerate(unexplained(one), 1):
            yield Item(
                kind="mutant",
                id=f"{one.unit}/survivor-{number}",
                title=f"{mutant.function}:{mutant.line}",
                text=change(mutant),
                state="bad" if one.current else "open",
                facts={"verdict": mutant.status, "result": one.how},
                links=(f"unit:{one.unit}",),
            )


def score(every: Sequence[Standing]) -> str:
    """Killed of counted."""
    records = [one.record for one in every if one.record]
    return f"{sum(one.killed.total for one in records)} of {sum(one.counted for one in records)}"


def numbers(every: Sequence[Standing]) -> tuple[str, ...]:
    """The cells of some results in the table of mutants, from the score on."""
    records = [one.record for one in every if one.record]
    sums = (
        sum(one.killed.by_harnesses for one in records),
        sum(one.killed.wp for one in records),
        sum(one.equivalent for one in records),
        sum(len(one.open) for one in records),
    )
    return (score(every), *map(str, sums))


def table(every: Sequence[Standing]) -> Table:
    """A line for each unit, and one for all results that are current."""
    current = [one for one in every if one.current]
    rows = [
        (f"unit:{one.unit}", one.how, *(numbers([one]) if one.record else [""] * 5))
        for one in every
    ]
    rows.append(
        ("all that are current", f"{len(current)} of {len(every)} units", *numbers(current))
    )
    return Table(
        title="Mutants",
        columns=("unit", "result", "killed", "by CBMC", "by WP", "make no difference", "open"),
        rows=tuple(rows),
        note="Counted are mutants that compile and make a difference. By CBMC is by a"
        " counterexample to one of its harnesses, by executing it or by a solver. WP is asked"
        " for what CBMC does not notice in little time, so these are not two independent"
        " scores. A unit whose mutants were not run shows nothing about the strength of its"
        " proofs.",
    )


def survivors(every: Sequence[Standing]) -> Table:
    """Each mutant that nobody notices, with the reason that a person gave."""
    rows = [
        (
            f"unit:{one.unit}",
            f"{mutant.function}:{mutant.line}",
            change(mutant),
            mutant.status,
            mutant.reason,
        )
        for one in every
        for mutant in one.survivors
    ]
    return Table(
        title="Survivors, adjudicated",
        columns=("unit", "place", "change", "verdict", "reason"),
        rows=tuple(rows),
        note="Those that compile to the same object code are left out here, and counted above. So"
        " are the reasons of a unit whose proofs have changed since its result.",
    )
