# SPDX-License-Identifier: Apache-2.0
"""Random small task sets."""

from __future__ import annotations

import random
from dataclasses import replace

from keel.timing.taskset import CLASSES, Chain, Costs, Task, TaskSet

PERIODS = (50, 60, 80, 100, 120, 150, 200, 240, 300, 400, 500, 600, 1000)


def random_set(number: int, load: float, free: bool = False) -> TaskSet:
    """The set of that number: 2 to 7 tasks of about that load; free: scheduling costs nothing."""
    draw = random.Random(number)
    names = list(CLASSES)
    count = draw.randrange(2, 8)
    harmonic = draw.random() < 0.4
    tasks = []
    for index in range(count):
        period = 50 * 2 ** draw.randrange(5) if harmonic else draw.choice(PERIODS)
        if draw.random() < 0.1:
            period = draw.randrange(40, 1200)
        share = load / count * draw.uniform(0.2, 1.8)
        budget = min(period, max(1, round(period * share)))
        phase = 0 if draw.random() < 0.4 else draw.randrange(period)
        class_name = "real-time" if draw.random() < 0.35 else draw.choice(names[:4])
        tasks.append(Task(f"t{index}", f"t{index}", class_name, period, budget, phase))
    costs = Costs(guard_us=0, pass_us=0, dispatch_us=0)
    if not free:
        costs = Costs(
            guard_us=draw.randrange(6),
            pass_us=draw.randrange(4),
            dispatch_us=draw.randrange(3),
            utilisation_limit_percent=draw.choice((100.0, 100.0, 69.3)),
        )
    return TaskSet(f"set{number}", tuple(tasks), (), costs)


def with_chains(tasks: TaskSet, number: int) -> TaskSet:
    """The set with two paths of that number, each through 2 to 4 of its tasks in any order."""
    draw = random.Random(number)
    names = [task.name for task in tasks.tasks]
    chains = tuple(
        Chain(
            name=name,
            path=draw.sample(names, draw.randrange(2, min(4, len(names)) + 1)),
            reaction_limit_us=1,
            freshness_limit_us=1,
        )
        for name in ("first", "second")
    )
    return replace(tasks, chains=chains)
