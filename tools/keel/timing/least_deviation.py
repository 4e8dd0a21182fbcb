# SPDX-License-Identifier: Apache-2.0
"""The least period deviation (eq. 15) that any order of service leaves where tasks are released
together, with times drawn from 50 % to 100 % of the WCET, each run by itself.

It holds for a scheduler that preempts nothing, starts a due task whenever the processor is free,
and serves tasks released together in one fixed order, as FCFS, static priorities and EDF do. Then
a task starts when those ahead of it have ended, so its start varies with their times, which have
the variance (C/2)^2 / 12 = C^2 / 48 each. Two starts in a row vary by themselves, so the deviation
from the period has a mean square of at least twice that sum, over the tasks ahead that are
released with it; those that are released with every n-th of its releases alone count 1/n. Left
out, since it only adds: that the mean start also differs from release to release, that backlog
meets later releases (the later a start, the more of them are before it), and the scheduler's own.

Not covered is who lets the processor idle on purpose, as phases do, and as a guard does for tasks
that do not fit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from keel.timing.taskset import Task, TaskSet

SUBSETS = 16  # A class of more tasks would have too many orders to look at.


def mean_square(task: Task, ahead: Sequence[Task]) -> float:
    """What those ahead add to the mean square of a task's deviation, us^2."""
    return sum(
        task.period / math.lcm(task.period, other.period) * other.budget**2 / 24 for other in ahead
    )


def least(members: Sequence[Task], ahead: Sequence[Task]) -> float | None:
    """The least mean deviation of a class, percent of the period, behind the tasks ahead.

    The best order by subsets: the last of the first n tasks has the others of them ahead.
    """
    if len(members) > SUBSETS:
        return None
    share = 100.0 / len(members)
    best = [0.0] + [math.inf] * ((1 << len(members)) - 1)
    for subset in range(1, len(best)):
        inside = [index for index in range(len(members)) if subset >> index & 1]
        for last in inside:
            before = [members[index] for index in inside if index != last]
            square = mean_square(members[last], [*ahead, *before])
            deviation = share * math.sqrt(square) / members[last].period
            best[subset] = min(best[subset], best[subset & ~(1 << last)] + deviation)
    return best[-1]


def least_of_class(tasks: TaskSet, class_name: str, behind: bool) -> float | None:
    """The least mean deviation of a class, alone or behind all classes of higher priority."""
    members = [task for task in tasks.tasks if task.class_name == class_name]
    higher = [task for task in tasks.tasks if task.priority > members[0].priority]
    return least(members, higher if behind else [])
