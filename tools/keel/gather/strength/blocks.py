# SPDX-License-Identifier: Apache-2.0
"""What the harnesses reach: a proof about what nobody reaches would be worth nothing.

make prove has CBMC look for an execution through every block of what a harness covers, and fails
where there is none, but for what CBMC itself makes of calls through pointers, on the line of such a
call. Here each such block needs a reason (specs/unreached.toml), the lines are listed, and each
function of the product needs a harness that covers it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.base.files import read_text
from keel.c import source as csource
from keel.c.project import find_units
from keel.config import Table, Text, model_validator, read_toml
from keel.gather.formal.bounds import Bounded
from keel.gather.part import Table as Shown
from keel.judge.cbmc_answers import POINTER_CALL
from keel.judge.harness import MODELS

FILE = "specs/unreached.toml"

Report = Mapping[str, Any]


class Unreached(Table):
    """Blocks of a harness, or a function."""

    harness: str = ""
    blocks: int = 0
    function: str = ""
    reason: Text

    @model_validator(mode="after")
    def of_one_thing(self) -> Unreached:
        """Either blocks of a harness, or a function."""
        if bool(self.harness and self.blocks > 0) == bool(self.function):
            raise ValueError("needs either harness and blocks, or function")
        return self


class File(Table):
    """The file."""

    unreached: list[Unreached] = []


def read_reasons(root: Path) -> list[Unreached]:
    """All entries."""
    return read_toml(root / FILE, File).unreached


def functions_of(root: Path) -> dict[str, str]:
    """The functions of the product that have a body, and the unit of each."""
    return {
        function.name: unit.name
        for unit in find_units(root).values()
        for path in unit.own_files
        for function in csource.defined(read_text(path))
        if function.body
    }


def pointer_calls(root: Path) -> dict[str, list[str]]:
    """The lines with a call through a pointer, as make prove knows one, by function."""
    files = [path for unit in find_units(root).values() for path in unit.own_files]
    found: dict[str, list[str]] = {}
    for path in (*files, *sorted((root / MODELS).glob("*.c"))):
        text = read_text(path)
        lines = text.splitlines()
        for function in csource.defined(text):
            begin, end = (text.count("\n", 0, place) for place in function.body or (0, 0))
            found.setdefault(function.name, []).extend(
                f"{path.relative_to(root).as_posix()}:{number + 1}"
                for number in range(begin, end + 1)
                if POINTER_CALL.search(lines[number])
            )
    return found


def places_of(one: Bounded, calls: Mapping[str, Sequence[str]]) -> list[str]:
    """Where a harness may leave blocks unreached: function and line."""
    return [f"{name} at {place}" for name in one.harness.covers for place in calls.get(name, ())]


def missing(report: Report, one: Bounded) -> int:
    """How many blocks a harness does not reach."""
    harnesses = report["units"].get(one.unit, {}).get("cbmc", {}).get("harnesses", {})
    coverage = harnesses.get(one.harness.name, {}).get("coverage", {"blocks": 0, "reached": 0})
    return int(coverage["blocks"]) - int(coverage["reached"])


def covered_by(functions: Sequence[str], harnesses: Sequence[Bounded]) -> dict[str, list[str]]:
    """The harnesses that reach all of a function."""
    found: dict[str, list[str]] = {name: [] for name in functions}
    for one in harnesses:
        for name in one.harness.covers:
            if name in found:
                found[name].append(one.id)
    return found


def problems(
    report: Report,
    harnesses: Sequence[Bounded],
    functions: Sequence[str],
    reasons: Sequence[Unreached],
    calls: Mapping[str, Sequence[str]],
) -> Iterator[str]:
    """A block or a function that nobody reaches without a reason, and a reason without these."""
    blocks = {one.harness: one.blocks for one in reasons if one.harness}
    for one in harnesses:
        if one.id in blocks and not places_of(one, calls):
            yield f"{FILE}: {one.id}: nothing that it covers calls through a pointer"
        seen, given = missing(report, one), blocks.pop(one.id, 0)
        if seen != given:
            yield (
                f"harness {one.id}: does not reach {seen} blocks of what it covers, and {FILE}"
                f" has a reason for {given}"
            )
    yield from (f"{FILE}: there is no harness {name}" for name in blocks)
    excused = {one.function for one in reasons if one.function}
    for name, by in covered_by(functions, harnesses).items():
        if not by and name not in excused:
            yield f"function {name}: no harness covers it, and {FILE} has no reason"
        if by and name in excused:
            yield f"{FILE}: needless, {by[0]} covers {name}"
    yield from (f"{FILE}: there is no function {name}" for name in excused - set(functions))


def tables(
    harnesses: Sequence[Bounded],
    functions: Mapping[str, str],
    reasons: Sequence[Unreached],
    calls: Mapping[str, Sequence[str]],
) -> Iterator[Shown]:
    """What each function is reached by, and what is not reached."""
    places = {one.id: "; ".join(places_of(one, calls)) for one in harnesses}
    rows = [
        (f"unit:{functions[name]}", name, "; ".join(f"harness:{one}" for one in by) or "nobody")
        for name, by in covered_by(list(functions), harnesses).items()
    ]
    yield Shown(
        title="Functions, and the harnesses that reach every block of them",
        columns=("unit", "function", "reached by"),
        rows=tuple(rows),
        note=f"Models ({MODELS}) that a harness covers are reached, too, but are not listed.",
    )
    yield Shown(
        title="Blocks that a harness does not reach",
        columns=("harness", "blocks", "all at these calls through a pointer", "reason"),
        rows=tuple(
            (
                f"harness:{one.harness}" if one.harness else one.function,
                str(one.blocks),
                places.get(one.harness, ""),
                " ".join(one.reason.split()),
            )
            for one in reasons
        ),
        note="All other blocks of what a harness covers are reached, and each of these lines, too:"
        " CBMC has found an execution through each. make prove fails on an unreached block"
        " that stands elsewhere. That is a check against contradictory assumptions.",
    )


def summary(report: Report) -> str:
    """Reached blocks, of all."""
    units = report.get("units", {}).values()
    found = [
        harness["coverage"] for unit in units for harness in unit["cbmc"]["harnesses"].values()
    ]
    return f"{sum(one['reached'] for one in found)} of {sum(one['blocks'] for one in found)}"
