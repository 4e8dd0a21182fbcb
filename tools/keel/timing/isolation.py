# SPDX-License-Identifier: Apache-2.0
"""Which of the two isolation theorems holds for a task set, with its bounds.

The theorems (specs/soundness.md, Isolation) bound the time from a real-time task's release to its
start: ISO-001 as long as nothing is promoted, ISO-002 whatever is promoted. Both are proved; that
nothing is promoted in a set is argued at the head of scheduler_bounds.py. Budgets are taken as they
are declared to the kernel, with the scheduler's own time (A-18, A-19).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from keel.timing.scheduler_bounds import TICK, Bounds, declared
from keel.timing.taskset import Task, TaskSet

UNPROMOTED = "ISO-001"
WHATEVER = "ISO-002"


@dataclass(frozen=True)
class Start:
    """Bounds of a real-time task, from its release to its start."""

    label: str
    name: str
    period: int
    unpromoted: int  # ISO-001: the other real-time budgets, and W.
    whatever: int  # ISO-002: 2 W and the longest other budget more, perhaps its own.
    skipping: bool  # By ISO-002 alone, whole periods may be skipped.
    bound: int | None  # The one that holds; None where neither does.


@dataclass(frozen=True)
class Isolation:
    """What holds for all real-time tasks of a set."""

    theorem: str | None  # The stronger one that holds.
    reason: str  # Why this one, or none.
    unpromoted: str  # Why nothing is ever promoted; empty when that is not known.
    longest_other: int  # L: the longest declared budget of another task.
    starts: list[Start]


def nothing_promoted(tasks: TaskSet, found: Bounds) -> str:
    """Why no task of the set is ever promoted; nothing when that is not known."""
    if not tasks.others:
        return "every task is real-time"
    if tasks.costs.without_promotion:
        return "the scheduler is set up to promote nothing"
    if found.promotion_excluded:
        return "every other task responds within its period"
    return ""


def theorem_of(tasks: TaskSet, unpromoted: str, refusals: Iterable[str]) -> tuple[str | None, str]:
    """The stronger theorem that holds, and why; or why none does."""
    refusal = next(iter(refusals), None)
    if refusal is not None:
        return None, refusal
    turn = tasks.costs.pass_us + TICK
    if turn > tasks.costs.guard_us:
        return None, (
            f"a pass that runs nothing, and a turn of the main loop, may take {turn} us, more than "
            f"the guard of {tasks.costs.guard_us} us (A-17)"
        )
    if unpromoted:
        return UNPROMOTED, f"nothing is promoted, as {unpromoted}"
    return WHATEVER, "that a task is promoted is not excluded"


def start_of(tasks: TaskSet, task: Task, longest: int, theorem: str | None) -> Start:
    """The bounds of one task."""
    guard = tasks.costs.guard_us
    demand = sum(declared(tasks, other) for other in tasks.realtime)
    own = declared(tasks, task)
    turn = demand + 2 * guard + longest
    unpromoted = demand - own + guard
    whatever = turn - own if turn <= task.period else turn
    bound = {UNPROMOTED: unpromoted, WHATEVER: whatever}.get(theorem or "")
    return Start(
        task.label, task.name, task.period, unpromoted, whatever, turn > task.period, bound
    )


def isolation_of(tasks: TaskSet, found: Bounds, refusals: Iterable[str]) -> Isolation:
    """What holds for a set, given why the kernel would refuse it."""
    unpromoted = nothing_promoted(tasks, found)
    theorem, reason = theorem_of(tasks, unpromoted, refusals)
    longest = max((declared(tasks, task) for task in tasks.others), default=0)
    starts = [start_of(tasks, task, longest, theorem) for task in tasks.realtime]
    return Isolation(theorem, reason, unpromoted, longest, starts)
