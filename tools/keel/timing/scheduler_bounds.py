# SPDX-License-Identifier: Apache-2.0
"""Bounds for Keel's own scheduler, the scheduler's costs included.

They hold for every execution time up to the budget, given the costs that the task set declares: p
(a pass that looks at the tasks), d (a dispatch), W (the guard). Those of real-time tasks (1) and
behind a promotion (3) hold for every phase. Those of other tasks (2), and with them that nobody is
promoted, hold for every phase of the other tasks, but for the real-time phases that the set gives:
Tails looks at the very releases, unless they are too many. Those of (4) hold for the phases of the
set alone. tests/timing compares the bounds with simulations by the kernel's own code. Why they
hold:

1. A real-time task waits for what is left of the pass that had looked at it just before its
   release, and for the tasks before it in the next pass: each other real-time task once, one other
   task at most, and two passes. With the guard, and as long as nobody is promoted, another task
   has always ended before a release comes.
2. A task that is not real-time waits, from its release on, only while (a) real-time tasks run,
   (b) tasks of no lower dynamic priority run, (c) the time to the next real-time release is below
   W + w, or (d) a task started before ends. Dynamic priorities are bounded by responses, responses
   by dynamic priorities. Bounds that agree with each other, all within the periods, hold together:
   the first response to break its bound would do so while all others keep theirs, which its bound
   excludes. No task's age then comes near its promotion.
3. A promoted task waits for promoted tasks only, one in a pass, each with all real-time tasks. This
   needs neither slack nor the assumption of 2.
4. Where no two tasks collide, nobody waits: whoever is released finds the run before it ended, the
   pass behind that run over, and the next real-time release as far away as the guard asks for. The
   first turn of the loop from the release on runs it. By induction over the releases, which lie on
   a grid. So each sample's way along a path is known: a run reads what was released before it. Two
   periodic tasks i and j keep apart for ever exactly if (phase_j - phase_i) mod
   gcd(T_i, T_j) is at least what i needs before j, and at most the gcd less what j needs before i.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from keel.timing.taskset import PRIORITY_MAX, Chain, Task, TaskSet
from keel.timing.textbook_tests import STEPS, conventional

INSTANTS = 256  # More release instants than this are bounded by a count, not looked at.
ROUNDS = 200
SAMPLES = 1000  # Of a path, in the common period of its tasks; more are not followed.
EFFORT = 50_000  # Steps of all fixed points together; beyond them no bound counts as found.
TICK = 1  # The resolution of the clock; a turn of the main loop around a step must be shorter.
LIMIT = 1 << 40


@dataclass(frozen=True)
class OtherBound:
    """A task that is not real-time."""

    response: int | None  # From its release to its end; None: no bound below its period.
    any_phase: int | None  # The same by (2) alone, should the other tasks' phases be others.
    promotion_wait: int  # From its release to its promotion.
    promoted_response: int | None  # From its release to its end if it has to be promoted, and is.


@dataclass(frozen=True)
class Shortfall:
    """Why a task that is not real-time has no bound: what it may wait for, in us, worked out until
    that left the period. The bound would be as much or more."""

    period: int
    own: int  # Its run, a pass and a dispatch.
    blocking: int  # A run that began before, and a pass.
    realtime: int  # Real-time tasks.
    rivals: int  # Tasks that may be chosen before it.
    tails: int  # Time before real-time releases in which it does not fit, and their passes.

    @property
    def least(self) -> int:
        """What the bound would be at least."""
        return self.own + self.blocking + self.realtime + self.rivals + self.tails


@dataclass(frozen=True)
class Bounds:
    """What holds for a task set."""

    realtime: dict[str, int]  # The bound that counts: with promotion if that cannot be excluded.
    realtime_guarded: dict[str, int]
    realtime_promotion: dict[str, int]
    others: dict[str, OtherBound]
    promotion_excluded: bool
    apart: dict[str, int] | None  # Every task's response by (4); None where tasks collide.
    shortfalls: dict[str, Shortfall]  # Of the tasks at which the bounds of (2) failed.


def declared(tasks: TaskSet, task: Task) -> int:
    """The budget to declare to the kernel: execution time, and the scheduler's own for this run."""
    return task.budget + tasks.costs.pass_us + tasks.costs.dispatch_us


def realtime_bound(tasks: TaskSet, blocking: int) -> int:
    """The longest response of any real-time task (1 above), blocked by that much."""
    costs = tasks.costs
    bodies = sum(task.budget + costs.dispatch_us for task in tasks.realtime)
    return bodies + blocking + 2 * costs.pass_us + TICK


def promotion_blocking(tasks: TaskSet) -> int:
    """The longest run of a task that is served whatever the slack."""
    longest = max((task.budget for task in tasks.others), default=0)
    return longest + tasks.costs.dispatch_us if longest else 0


def promotion_wait(task: Task) -> int:
    """From a release to the promotion: the age (max - 1) T / sp, rounded up, less the period."""
    return -(-(PRIORITY_MAX - 1) * task.period // task.priority) - task.period


# --- When no two tasks collide -------------------------------------------------------------------


def needs(tasks: TaskSet, task: Task, follower: Task) -> int:
    """From a task's release to that of a follower who must not notice it."""
    costs = tasks.costs
    # Its run, and the pass after it that finds nothing to do.
    own = declared(tasks, task) + costs.pass_us + TICK
    if follower.realtime and not task.realtime:
        return max(own, costs.guard_us + declared(tasks, task) + TICK)
    return own


def collide(tasks: TaskSet, first: Task, second: Task) -> bool:
    """Whether one of two tasks is ever released before the other is done."""
    cycle = math.gcd(first.period, second.period)
    distance = (second.phase - first.phase) % cycle
    return not needs(tasks, first, second) <= distance <= cycle - needs(tasks, second, first)


def collisions(tasks: TaskSet) -> list[tuple[Task, Task]]:
    """The pairs that collide; a task that is released before it is done itself is one with it."""
    late = [(task, task) for task in tasks.tasks if needs(tasks, task, task) > task.period]
    return late + [pair for pair in combinations(tasks.tasks, 2) if collide(tasks, *pair)]


# --- When a task does not fit --------------------------------------------------------------------


class Tails:
    """The time before real-time releases in which a task does not fit any more (c above)."""

    def __init__(self, realtime: Sequence[Task]) -> None:
        self.realtime = realtime
        self.cycle = math.lcm(*(task.period for task in realtime)) if realtime else 0
        count = sum(self.cycle // task.period for task in realtime)
        self.instants: list[int] = []
        if 0 < count <= INSTANTS:
            self.instants = sorted(
                {
                    (task.phase + number * task.period) % self.cycle
                    for task in realtime
                    for number in range(self.cycle // task.period)
                }
            )

    def count(self, window: int) -> int:
        """At most so many release instants in any window of that length."""
        if not self.instants:
            return sum(window // task.period + 1 for task in self.realtime)
        return max(self._seen(first, window) for first in range(len(self.instants)))

    def total(self, window: int, tail: int) -> int:
        """At most so much time in tails of that length."""
        if not self.instants:
            return self.count(window) * tail
        size = len(self.instants)
        parts = [
            min(tail, (at - self.instants[index - 1]) % self.cycle or self.cycle)
            for index, at in enumerate(self.instants)
        ]
        sums = [0]
        for part in parts + parts:
            sums.append(sums[-1] + part)
        worst = 0
        for first in range(size):
            rounds, rest = divmod(self._seen(first, window), size)
            worst = max(worst, rounds * sums[size] + sums[first + rest] - sums[first])
        return worst

    def _seen(self, first: int, window: int) -> int:
        """Instants from the one of that number on, as far as the window reaches."""
        rounds, rest = divmod(window, self.cycle)
        size = len(self.instants)
        end = self.instants[first] + rest
        seen = bisect_right(self.instants, end) - first
        if end >= self.cycle:
            seen = size - first + bisect_right(self.instants, end - self.cycle)
        return rounds * size + seen


# --- Tasks that are not real-time ----------------------------------------------------------------


def competes(task: Task, rival: Task, rival_first: bool, rival_response: int) -> bool:
    """Whether a rival can be chosen before the task: its highest priority against the lowest."""
    highest = 1 + rival.priority * (rival.period + rival_response) // rival.period
    lowest = 1 + task.priority
    return highest > lowest or (highest == lowest and rival_first)


def demanded(tasks: Sequence[tuple[int, int, int]], window: int) -> int:
    """What tasks of (period, cost of a run, response) take of a window at most."""
    return sum(((window + carry) // period + 1) * cost for period, cost, carry in tasks)


class Others:
    """The bound of 2, for all tasks that are not real-time together."""

    def __init__(self, tasks: TaskSet, realtime_response: int) -> None:
        self.tasks = tasks
        self.tails = Tails(tasks.realtime)
        self.realtime_response = realtime_response
        self.effort = EFFORT
        self.shortfalls: dict[str, Shortfall] = {}
        self.run_cost = tasks.costs.pass_us + tasks.costs.dispatch_us + TICK

    def responses(self) -> dict[str, int | None]:
        """The least bounds that agree with each other, or None for all.

        Bounds R are valid when each task's bound, worked out with R for the others, is R again (2
        above). They grow from the bare budgets until they do, or one leaves its period.
        """
        assumed = {task.name: declared(self.tasks, task) for task in self.tasks.others}
        for _ in range(ROUNDS):
            found = {task.name: self.response(task, assumed) for task in self.tasks.others}
            grown = {name: value for name, value in found.items() if value is not None}
            if len(grown) < len(found):
                break
            if grown == assumed:
                return {**grown}
            assumed = grown
        return dict.fromkeys(assumed)

    def response(self, task: Task, assumed: dict[str, int]) -> int | None:
        """From the release to the end, if it is within the period."""
        rivals, blocking = self.rivals(task, assumed)
        costs = self.tasks.costs
        realtime = [
            (rt.period, rt.budget + self.run_cost, self.realtime_response)
            for rt in self.tasks.realtime
        ]
        before = [(k.period, k.budget + self.run_cost, assumed[k.name]) for k in rivals]
        tail = costs.guard_us + declared(self.tasks, task)
        constant = blocking + costs.pass_us + TICK
        own = task.budget + costs.pass_us + costs.dispatch_us
        wait = constant
        while self.effort > 0:
            self.effort -= 1
            tails = self.tails.total(wait, tail) + self.tails.count(wait) * costs.pass_us
            found = Shortfall(
                task.period, own, constant, demanded(realtime, wait), demanded(before, wait), tails
            )
            if found.least > task.period:
                self.shortfalls[task.name] = found
                return None
            if found.least == wait + own:
                return wait + own
            wait = found.least - own
        return None

    def rivals(self, task: Task, assumed: dict[str, int]) -> tuple[list[Task], int]:
        """The tasks that may be chosen before this one, and the longest run of the rest."""
        order = {other.name: number for number, other in enumerate(self.tasks.others)}
        rivals, blocking = [], 0
        for other in self.tasks.others:
            if other is task:
                continue
            first = order[other.name] < order[task.name]
            if competes(task, other, first, assumed[other.name]):
                rivals.append(other)
            else:
                blocking = max(blocking, other.budget + self.run_cost)
        return rivals, blocking


def promoted_response(tasks: TaskSet, task: Task) -> int | None:
    """From the release to the end of a task that is served by promotion at the latest (3)."""
    costs = tasks.costs
    each_pass = sum(rt.budget + costs.dispatch_us for rt in tasks.realtime)
    each_pass += costs.pass_us + costs.dispatch_us + TICK
    longest = max(other.budget for other in tasks.others)
    rivals = [
        (other.budget + each_pass, promotion_wait(other))
        for other in tasks.others
        if other is not task
    ]
    constant = longest + 2 * each_pass
    wait = constant
    for _ in range(STEPS):
        longer = constant + sum((wait // again + 1) * cost for cost, again in rivals)
        if longer == wait:
            return promotion_wait(task) + wait + task.budget
        if longer > LIMIT:
            return None
        wait = longer
    return None


# --- Together ------------------------------------------------------------------------------------


def bounds_of(tasks: TaskSet) -> Bounds:
    """All bounds of a task set."""
    guarded = realtime_bound(tasks, 0)
    promoted = realtime_bound(tasks, promotion_blocking(tasks))
    realtime_fits = all(guarded <= task.period for task in tasks.realtime)
    none: dict[str, int | None] = {task.name: None for task in tasks.others}
    bound_of = Others(tasks, guarded)
    responses = bound_of.responses() if realtime_fits else none
    apart = None
    if not collisions(tasks):
        apart = {task.name: declared(tasks, task) + TICK for task in tasks.tasks}
    excluded = (
        tasks.costs.without_promotion
        or apart is not None
        or all(response is not None for response in responses.values())
    )
    others = {
        task.name: OtherBound(
            apart[task.name] if apart else responses[task.name],
            responses[task.name],
            promotion_wait(task),
            None if tasks.costs.without_promotion else promoted_response(tasks, task),
        )
        for task in tasks.others
    }
    names = [task.name for task in tasks.realtime]
    whatever = dict.fromkeys(names, guarded if excluded else promoted)
    return Bounds(
        realtime={name: apart[name] for name in names} if apart else whatever,
        realtime_guarded=dict.fromkeys(names, guarded),
        realtime_promotion=dict.fromkeys(names, promoted),
        others=others,
        promotion_excluded=excluded,
        apart=apart,
        shortfalls=bound_of.shortfalls,
    )


def responses_of(found: Bounds) -> dict[str, int | None]:
    """The bound of every task's response."""
    return {**found.realtime, **{name: bound.response for name, bound in found.others.items()}}


# --- Paths ---------------------------------------------------------------------------------------


def next_release(task: Task, time: int) -> int:
    """The first release after that time."""
    number = max(0, (time - task.phase) // task.period + 1)
    return task.phase + number * task.period


def followed(path: Sequence[Task], response: int) -> int | None:
    """The longest reaction of a path whose tasks never collide, to an event that just misses its
    sample: from the release of the run that misses it, over that of the next one, to the end of the
    first run of the last task that knows of it, given the last task's response."""
    first = path[0]
    samples = math.lcm(*(task.period for task in path)) // first.period
    if samples > SAMPLES:
        return None
    start = next_release(first, sum(task.period for task in path))  # All have begun by then.
    longest = 0
    for missed in range(start, start + samples * first.period, first.period):
        release = missed + first.period
        for task in path[1:]:
            release = next_release(task, release)
        longest = max(longest, release + response - missed)
    return longest


@dataclass(frozen=True)
class PathBound:
    """Bounds of a path's reaction to an event that just misses its sample, and so of how old a
    value gets until it is replaced."""

    total: int | None  # The sum of T + R.
    followed: int | None  # With the phases of the set; None where tasks collide.

    @property
    def least(self) -> int | None:
        """The one that counts."""
        return min((item for item in (self.total, self.followed) if item is not None), default=None)


def path_bound(tasks: TaskSet, chain: Chain, found: Bounds) -> PathBound:
    """The bounds of a path, given those of the tasks."""
    responses = responses_of(found)
    path = tasks.path(chain)
    last = (found.apart or {}).get(path[-1].name)
    # A task that may be late may skip a period as well: then T + R says nothing.
    in_time = [
        worst if (worst := responses[task.name]) is not None and worst <= task.period else None
        for task in path
    ]
    return PathBound(
        conventional(path, in_time), followed(path, last) if last is not None else None
    )
