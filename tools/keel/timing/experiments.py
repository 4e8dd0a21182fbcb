# SPDX-License-Identifier: Apache-2.0
"""What the experiments share: goals, a runner of simulations, and the variants that are compared.

Goals are judged on the task set as its file gives it, which is what flies: with its phases. The
same set with all tasks released together, as a table without phases has them, stands beside it.

Simulated are time, the execution times of tasks, and the cost of scheduling. Only hardware can tell
whether those costs are right, and what caches, buses and interrupts do.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from rich.console import Console

from keel.timing.board import TURN_NS, Experiment, Result, run_batch
from keel.timing.output import Cell, table
from keel.timing.phases import without_phases
from keel.timing.taskset import TaskSet

SECOND = 1_000_000
PASS_US = 5  # The goals are stated for this cost; the analyser counts with the task set's worst.
SAMPLES = 1000
LONG_US = 1001 * SECOND + SECOND // 2  # 1000 periods of the slowest task.
MODELS = ("constant", "uniform", "heavy")
GOAL_MODEL = "uniform"
# The best measured among Cleanflight and Betaflight in each class, percent of the period.
SIGMA_GOALS = {
    "low": 0.091,
    "medium": 0.261,
    "medium-high": 0.202,
    "high": 0.303,
    "real-time": 0.384,
}
REALTIME_SIGMA_GOAL = 0.05
HOUR_GOAL_S = 10.0


Deviations = dict[tuple[str, str], Result]  # By variant and model.


@dataclass(frozen=True)
class Goal:
    """Something that should hold. A reason says why it is known not to."""

    name: str
    wanted: str
    measured: str
    met: bool
    reason: str = ""


@dataclass
class Findings:
    """What all experiments found, as it is printed and as it is kept."""

    out: Console = field(default_factory=lambda: Console(quiet=True))
    goals: list[Goal] = field(default_factory=list)
    report: dict[str, Any] = field(default_factory=dict)

    def goal(self, name: str, wanted: str, measured: str, met: bool, reason: str = "") -> None:
        """Add a goal."""
        self.goals.append(Goal(name, wanted, measured, met, reason))

    def show(
        self, title: str, columns: Sequence[str], rows: Sequence[Sequence[Cell]], left: int = 1
    ) -> list[dict[str, Cell]]:
        """Print a table; its rows by their columns."""
        self.out.print(table(title, columns, rows, left))
        return [dict(zip(columns, row, strict=True)) for row in rows]

    def say(self, text: str) -> None:
        """Print a remark."""
        self.out.print(text)

    @property
    def unexplained(self) -> list[Goal]:
        """Goals that are missed without a known reason."""
        return [goal for goal in self.goals if not (goal.met or goal.reason)]


class Runner:
    """Runs experiments by name, two at a time, and tells how far it is."""

    def __init__(self, program: Path, out: Console) -> None:
        self.program = program
        self.out = out

    def run(self, title: str, experiments: dict[str, Experiment]) -> dict[str, Result]:
        """All experiments of a chapter."""

        def one(name: str) -> Result:
            began = time.monotonic()
            (result,) = run_batch(self.program, [experiments[name]], 300.0)
            self.out.print(f"  {title}: {name} ({time.monotonic() - began:.1f} s)", style="dim")
            return result

        with ThreadPoolExecutor(2) as pool:
            return dict(zip(experiments, pool.map(one, experiments), strict=True))


def at_goal_cost(tasks: TaskSet) -> TaskSet:
    """The set with the pass that the goals are stated for."""
    return replace(tasks, costs=tasks.costs.model_copy(update={"pass_us": PASS_US}))


def by_rate(tasks: TaskSet) -> TaskSet:
    """The set queued by period, so that equal priorities favour the faster task."""
    return replace(tasks, tasks=tuple(sorted(tasks.tasks, key=lambda task: task.period)))


@dataclass(frozen=True)
class Variant:
    """A way to run the set."""

    name: str
    policy: str
    tasks: TaskSet
    turn_ns: int = TURN_NS


def realtime_phases(tasks: TaskSet) -> TaskSet:
    """The set with the phases of its real-time tasks alone."""
    changed = [task if task.realtime else replace(task, phase=0) for task in tasks.tasks]
    return replace(tasks, tasks=tuple(changed))


def variants(tasks: TaskSet) -> list[Variant]:
    """What is compared."""
    plain = without_phases(tasks)
    return [
        Variant("Keel", "keel", tasks),
        Variant("EDF, phases", "edf", tasks),
        Variant("5 us turn", "keel", tasks, 5000),
        Variant("RT phases", "keel", realtime_phases(tasks)),
        Variant("no phases", "keel", plain),
        Variant("spread", "spread", plain),
        Variant("by rate", "keel", by_rate(plain)),
        Variant("unguarded", "unguarded", plain),
        Variant("EDF", "edf", plain),
    ]


def sigma(tasks: TaskSet, result: Result, name: str) -> float:
    """Eq. 15 of a task, in percent of its period."""
    return 100.0 * result.tasks[name].sigma / tasks.named(name).period


def class_sigma(tasks: TaskSet, result: Result, class_name: str) -> float:
    """The mean of eq. 15 over the tasks of a class."""
    members = [task.name for task in tasks.tasks if task.class_name == class_name]
    return sum(sigma(tasks, result, name) for name in members) / len(members)


def paper_class_sigma(tasks: TaskSet, class_name: str) -> float:
    """The mean over the paper's column."""
    values = [task.sigma or 0.0 for task in tasks.tasks if task.class_name == class_name]
    return sum(values) / len(values)
