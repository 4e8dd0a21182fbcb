# SPDX-License-Identifier: Apache-2.0
"""Textbook tests: utilisation bounds, Jeffay's condition, non-preemptive fixed priorities, chains.

Sources: Liu and Layland 1973 (eq. 8 and 11 of the paper); Bini and Buttazzo 2003, the hyperbolic
bound; Jeffay, Stanat and Martel 1991, non-preemptive EDF; Davis, Burns, Bril and Lukkien 2007,
non-preemptive fixed priorities; Davare and others 2007, the end-to-end bound of a chain of periodic
tasks. Eq. 5 to 7 are the paper's. Times are whole us; none here includes the scheduler's own.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from keel.timing.taskset import Task

# What is not reached in so many steps is given up, and counts as not found: no file may keep the
# analyser busy for long.
POINTS = 100_000  # Of Jeffay's condition.
STEPS = 2000  # Of a fixed point.
RUNS = 200  # Of a task in one busy period.


def utilisation(tasks: Sequence[Task]) -> Fraction:
    """Sum of C / T, exactly."""
    return sum((Fraction(task.budget, task.period) for task in tasks), Fraction(0))


def liu_layland(count: int) -> float:
    """The bound of eq. 8 for so many tasks."""
    return count * (2.0 ** (1.0 / count) - 1.0) if count else 1.0


def hyperbolic(tasks: Sequence[Task]) -> float:
    """The product of U + 1, which must not exceed 2."""
    return math.prod(1.0 + task.utilisation for task in tasks)


# --- Jeffay's condition --------------------------------------------------------------------------


@dataclass(frozen=True)
class Jeffay:
    """The interval with the least slack; holds when utilisation and slack say so."""

    holds: bool
    slack: int | None  # None: there is no interval to test, or they are too many.
    interval: int | None
    blocker: str | None
    decided: bool = True


def jeffay(tasks: Sequence[Task]) -> Jeffay:
    """Whether non-preemptive EDF meets every deadline, whatever the phases.

    For every task i and every L between the shortest period and its own:
    L >= C_i + sum of floor((L - 1) / T_j) C_j. The right side only grows at L = k T_j + 1.
    """
    total = utilisation(tasks)
    longest = max(task.period for task in tasks)
    best = Jeffay(total <= 1, None, None, None)
    worst_block = max(task.budget for task in tasks)
    queue = [(task.period, task.budget, task.period) for task in tasks]
    heapq.heapify(queue)
    demand = 0
    for _ in range(POINTS):
        point = queue[0][0]
        interval = point + 1
        while queue[0][0] == point:
            _, budget, period = queue[0]
            demand += budget
            heapq.heapreplace(queue, (point + period, budget, period))
        if interval >= longest:
            return best
        block = max((task for task in tasks if task.period > interval), key=lambda t: t.budget)
        slack = interval - demand - block.budget
        if best.slack is None or slack < best.slack:
            best = Jeffay(total <= 1 and slack >= 0, slack, interval, block.name)
            if slack < 0:
                return best
        # Demand is at most U (L - 1): from here on no interval has less slack.
        if best.slack is not None and (1 - total) * interval - worst_block >= best.slack:
            return best
    return Jeffay(False, best.slack, best.interval, best.blocker, decided=False)


# --- Non-preemptive fixed priorities -------------------------------------------------------------


def fixed_point(
    start: int, limit: int, step: list[tuple[int, int]], constant: int, closed: bool
) -> int | None:
    """The least t = constant + sum of n(t) C over (T, C); None beyond the limit.

    n counts the releases before t, or (closed) those up to t.
    """
    time = start
    for _ in range(STEPS):
        demand = constant + sum(
            (time // period + 1 if closed else -(-time // period)) * budget
            for period, budget in step
        )
        if demand == time:
            return time
        if demand > limit:
            return None
        time = demand
    return None


def response(task: Task, higher: Sequence[Task], blocking: int) -> int | None:
    """The worst response time of a task, over all its runs of a busy period; None: no bound."""
    above = [(other.period, other.budget) for other in higher]
    own = (task.period, task.budget)
    if utilisation([task, *higher]) >= 1:
        return None
    limit = 1 << 40
    busy = fixed_point(blocking + task.budget, limit, [*above, own], blocking, closed=False)
    if busy is None or -(-busy // task.period) > RUNS:
        return None
    worst = 0
    for number in range(-(-busy // task.period)):
        base = blocking + number * task.budget
        start = fixed_point(base, limit, above, base, closed=True)
        if start is None:
            return None
        worst = max(worst, start + task.budget - number * task.period)
    return worst


def fixed_priority(tasks: Sequence[Task], outside: int) -> list[int | None]:
    """Response times of tasks in order of priority, blocked by lower ones and once by outside."""
    times = []
    for index, task in enumerate(tasks):
        lower = max((other.budget for other in tasks[index + 1 :]), default=0)
        times.append(response(task, tasks[:index], max(lower, outside)))
    return times


# --- Chains --------------------------------------------------------------------------------------


def reaction(path: Sequence[Task]) -> int:
    """E of eq. 5 for the first two tasks, and eq. 6 for each further one."""
    producer, consumer = path[0], path[1]
    first = consumer.period if consumer.period < producer.period else producer.period
    total = first + producer.budget
    for producer, consumer in pairwise(path[1:]):
        if consumer.period < producer.period:
            total += consumer.period
        else:
            total += producer.period - producer.budget + consumer.budget
    return total


def freshness(path: Sequence[Task]) -> int:
    """F of eq. 7 for the first two tasks. The paper defines none for longer paths.

    Each further task is taken to add what it does in eq. 7's second case: a value that it reads is
    at most one period of its producer old, and it takes its own budget.
    """
    producer, consumer = path[0], path[1]
    if consumer.period < producer.period:
        total = 2 * producer.period
    else:
        total = producer.period + consumer.budget
    for producer, consumer in pairwise(path[1:]):
        total += producer.period + consumer.budget
    return total


def conventional(path: Sequence[Task], responses: Sequence[int | None]) -> int | None:
    """The end-to-end bound of asynchronous periodic tasks: sum of T + R over the path."""
    total = 0
    for task, worst in zip(path, responses, strict=True):
        if worst is None:
            return None
        total += task.period + worst
    return total


def hyperperiod(tasks: Sequence[Task]) -> int:
    """The least common multiple of the periods."""
    return math.lcm(*(task.period for task in tasks))
