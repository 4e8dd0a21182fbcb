"""Release phases with which no two tasks ever want the processor at the same time.

Two periodic tasks i and j keep apart for ever exactly if (phase_j - phase_i) mod gcd(T_i, T_j) is
at least what i needs before j, and at most the gcd less what j needs before i. Tasks are placed
one after the other, real-time first in queue order, then by period; each at its first free phase.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from timing import keel
from timing.taskset import Task, TaskSet


def needs(tasks: TaskSet, task: Task, follower: Task) -> int:
    """From a task's release to that of a follower who must not notice it."""
    costs = tasks.costs
    # Its run, and the pass after it that finds nothing to do.
    own = keel.declared(tasks, task) + costs.pass_us + keel.TICK
    if follower.realtime and not task.realtime:
        return max(own, costs.guard_us + keel.declared(tasks, task) + keel.TICK)
    return own


def next_free(tasks: TaskSet, task: Task, other: Task, phase: int) -> int | None:
    """The first phase from that one on at which two tasks keep apart, or None."""
    cycle = math.gcd(task.period, other.period)
    before = needs(tasks, other, task)
    if before + needs(tasks, task, other) > cycle:
        return None
    distance = (phase - other.phase) % cycle
    if distance < before:
        return phase + before - distance
    if distance > cycle - needs(tasks, task, other):
        return phase + cycle - distance + before
    return phase


def place(tasks: TaskSet, task: Task, placed: Sequence[Task]) -> int | None:
    """The first phase at which a task keeps apart from all placed ones, or None."""
    phase = 0
    apart = 0
    index = 0
    while apart < len(placed):
        later = next_free(tasks, task, placed[index], phase)
        if later is None or later >= task.period:
            return None
        apart = apart + 1 if later == phase else 1
        phase = later
        index = (index + 1) % len(placed)
    return phase


def without_phases(tasks: TaskSet) -> TaskSet:
    """The set with all phases 0."""
    return replace(tasks, tasks=tuple(replace(task, phase=0) for task in tasks.tasks))


def spread(tasks: TaskSet, realtime_only: bool = False) -> tuple[TaskSet, list[str]]:
    """The set with phases, and the names of the tasks for which there was no room."""
    chosen = tasks.realtime if realtime_only else list(tasks.tasks)
    order = sorted(
        chosen, key=lambda task: (not task.realtime, 0 if task.realtime else task.period)
    )
    placed: list[Task] = []
    crowded: list[str] = []
    for task in order:
        phase = place(tasks, task, placed)
        if phase is None:
            crowded.append(task.name)
        else:
            placed.append(replace(task, phase=phase))
    found = {task.name: task for task in placed}
    return replace(tasks, tasks=tuple(found.get(task.name, task) for task in tasks.tasks)), crowded
