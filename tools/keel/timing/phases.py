# SPDX-License-Identifier: Apache-2.0
"""Release phases with which no two tasks ever want the processor at the same time (collide in
scheduler_bounds.py).

Tasks are placed one after the other, real-time first in queue order, then by period; each at its
first free phase.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from keel.timing.scheduler_bounds import needs
from keel.timing.taskset import Task, TaskSet


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


def spread(tasks: TaskSet) -> tuple[TaskSet, list[str]]:
    """The set with phases, and the names of the tasks for which there was no room."""
    order = sorted(
        tasks.tasks, key=lambda task: (not task.realtime, 0 if task.realtime else task.period)
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
