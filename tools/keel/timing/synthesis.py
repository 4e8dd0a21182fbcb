# SPDX-License-Identifier: Apache-2.0
"""Periods from end-to-end limits (section IV-A of the paper), as long as the limits allow.

The tasks of judged paths start with the shortest period of a ladder 1, 2, 5, 10, ... Again and
again one is slowed down by a rung, as long as eq. 5 to 7 stay within every limit: the one that
saves most utilisation for what its period grows. This is a search by greed: in the end no period
can be one rung longer, but a better combination may exist.

Eq. 5 and 6 leave out how long a value waits for a task slower than its producer: by them alone
the last task of a path may be as slow as one likes. So the sum of a path's periods must also stay
within its reaction limit, which is the conventional bound but for the response times. (The paper's
own periods do not keep this for the magnetometer and the radio.)

Tasks beside the paths keep their periods, rounded down to multiples of the shortest period found,
as the paper does; those with shorter periods keep them as they are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from rich.console import Console

from keel.timing import textbook_tests
from keel.timing.analysis import LOAD_ALARM, LOAD_TARGET, Analysis, analyse
from keel.timing.output import Cell, table
from keel.timing.scheduler_bounds import declared
from keel.timing.taskset import Task, TaskSet

LADDER = (100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000, 200_000, 500_000)
SPARE_PERIOD = 20_000


class SynthesisError(Exception):
    """There is nothing to find, or no periods that keep the limits."""


@dataclass(frozen=True)
class Synthesis:
    """Periods found, and what they mean."""

    before: TaskSet
    after: TaskSet
    analysis: Analysis
    spare_us: int  # The longest budget of one more low task, every SPARE_PERIOD, that still holds.


def with_periods(tasks: TaskSet, periods: dict[str, int]) -> TaskSet:
    """The set with other periods, without phases: they belong to the old ones."""
    changed = [
        replace(task, period=periods.get(task.name, task.period), phase=0) for task in tasks.tasks
    ]
    return replace(tasks, tasks=tuple(changed))


def keeps_limits(tasks: TaskSet) -> bool:
    """Whether eq. 5 to 7 and the sums of periods are within the limits of judged paths."""
    return all(
        textbook_tests.reaction(path) <= chain.reaction_limit_us
        and sum(task.period for task in path) <= chain.reaction_limit_us
        and textbook_tests.freshness(path) <= chain.freshness_limit_us
        for chain in tasks.chains
        if not chain.advisory and (path := tasks.path(chain))
    )


def shortest(tasks: TaskSet, task: Task) -> int:
    """The first rung on which the task, and all real-time budgets if it is one, have room."""
    need = declared(tasks, task)
    if task.realtime:
        need = sum(declared(tasks, other) for other in tasks.realtime)
        need += 2 * tasks.costs.guard_us
    return next((rung for rung in LADDER if rung >= need), LADDER[-1])


def slowed(tasks: TaskSet, periods: dict[str, int]) -> dict[str, int] | None:
    """One task a rung slower: the one that saves most and keeps the limits; None when none does."""

    def saving(name: str) -> float:
        # For each us of period that it costs: (1/T - 1/T') / (T' - T).
        period, longer = LADDER[(rung := LADDER.index(periods[name])) : rung + 2]
        return tasks.named(name).budget / (period * longer)

    can = [name for name, period in periods.items() if period < LADDER[-1]]
    for name in sorted(can, key=saving, reverse=True):
        longer = {**periods, name: LADDER[LADDER.index(periods[name]) + 1]}
        if keeps_limits(with_periods(tasks, longer)):
            return longer
    return None


def spare(tasks: TaskSet) -> int:
    """How long one more task may be without breaking the verdict."""
    low, high = 0, SPARE_PERIOD
    while low < high:
        middle = (low + high + 1) // 2
        more = Task("Spare", "spare", "low", SPARE_PERIOD, middle)
        if analyse(replace(tasks, tasks=(*tasks.tasks, more))).schedulable:
            low = middle
        else:
            high = middle - 1
    return low


def synthesize(tasks: TaskSet) -> Synthesis:
    """Find periods. Raises SynthesisError."""
    names = dict.fromkeys(
        name for chain in tasks.chains if not chain.advisory for name in chain.path
    )
    if not names:
        raise SynthesisError("there is no path with limits that are judged")
    periods = {name: shortest(tasks, tasks.named(name)) for name in names}
    if not keeps_limits(with_periods(tasks, periods)):
        raise SynthesisError("even the shortest periods do not keep the limits of every path")
    while (longer := slowed(tasks, periods)) is not None:
        periods = longer
    base = min(periods.values())
    for task in tasks.tasks:
        if task.name not in periods:
            periods[task.name] = task.period // base * base or task.period
    found = with_periods(tasks, periods)
    analysis = analyse(found)
    return Synthesis(tasks, found, analysis, spare(found) if analysis.schedulable else 0)


def margin(utilisation: float) -> str:
    """What is left, in the terms of section IV-C."""
    percent = 100.0 * utilisation
    return (
        f"{percent:.2f} %; {LOAD_TARGET - percent:.2f} points to the target of {LOAD_TARGET:.0f} %,"
        f" {LOAD_ALARM[0] - percent:.2f} to the alarm at {LOAD_ALARM[0]:.0f}"
        f" to {LOAD_ALARM[1]:.0f} %"
    )


def print_synthesis(found: Synthesis, out: Console) -> None:
    """Periods, paths and margins."""
    rows: list[list[Cell]] = [
        [new.label, new.name, new.budget, old.period, new.period, f"{100 * new.utilisation:.3f}"]
        for old, new in zip(found.before.tasks, found.after.tasks, strict=True)
        if old.period != new.period
    ]
    columns = ["", "task", "C", "T given", "T found", "U, %"]
    out.print(table("Periods that change, us", columns, rows, 2))
    chains: list[list[Cell]] = [
        [
            row.name,
            row.reaction,
            row.conventional,
            row.reaction_limit,
            row.freshness,
            row.freshness_limit,
            "advice" if row.advisory else "",
        ]
        for row in found.analysis.chains
    ]
    out.print(
        table("Paths with these periods, us", ["path", "E", "limit", "F", "limit", ""], chains)
    )
    before = float(textbook_tests.utilisation(found.before.tasks))
    out.print(f"Utilisation as given: {margin(before)}.")
    out.print(f"With the periods found: {margin(found.analysis.total.utilisation)}.")
    ratio = math.floor(10000 * found.spare_us / SPARE_PERIOD) / 100
    out.print(
        f"Room for one more low task every {SPARE_PERIOD // 1000} ms: up to {found.spare_us} us "
        f"({ratio:.2f} %) in one run; the real-time gaps limit a single run."
    )
