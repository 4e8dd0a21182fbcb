# SPDX-License-Identifier: Apache-2.0
"""The virtual board: builds its program, gives it orders, reads what happened."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from keel.base.build import Build
from keel.base.errors import ROOT, ToolError
from keel.install import Toolchain
from keel.timing.scheduler_bounds import declared
from keel.timing.taskset import QUEUE_CAPACITY, Task, TaskSet

BUILD = Path("build/timing")
TURN_NS = 200  # A turn of the main loop that does nothing: 30 instructions and the loop.
FLAGS = (
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Wconversion",
    "-I.",
    "-Iinclude",
    "-Iexperiments",
)
SOURCES = ("src/rtos", "bsp/host", "experiments")


class BoardError(ToolError):
    """The program failed, or its results are none."""


@dataclass(frozen=True)
class Experiment:
    """One run. Work is what a task's longest run takes; budgets are what is declared."""

    tasks: TaskSet
    policy: str = "keel"
    model: str = "constant"
    seed: int = 1
    duration_us: int = 1_000_000
    first_us: int = 0
    turn_ns: int = TURN_NS
    skip_idle: bool = True
    work: dict[str, int] = field(default_factory=dict)  # Where it is not the task's budget.
    budgets: dict[str, int] = field(default_factory=dict)  # Where not declared.
    spike: tuple[str, int, int] | None = None  # Task, number of the run, its time.

    def orders(self) -> str:
        """The experiment as the program reads it."""
        costs = self.tasks.costs
        lines = [
            f"policy {self.policy}",
            f"model {self.model}",
            f"costs {self.turn_ns} {costs.pass_us * 1000} {costs.dispatch_us * 1000}",
            f"set {self.seed} {self.duration_us} {self.first_us} {costs.guard_us} "
            f"{costs.utilisation_limit_ppm} {int(self.skip_idle)} {int(costs.without_promotion)}",
        ]
        lines += [self.task(task) for task in self.tasks.tasks]
        number = {task.name: index for index, task in enumerate(self.tasks.tasks)}
        if self.spike:
            name, run, time = self.spike
            lines.append(f"spike {number[name]} {run} {time}")
        for chain in self.tasks.chains:
            path = " ".join(str(number[name]) for name in chain.path)
            lines.append(f"chain {len(chain.path)} {path}")
        return "\n".join([*lines, "run", ""])

    def task(self, task: Task) -> str:
        """The order for a task."""
        budget = self.budgets.get(task.name, declared(self.tasks, task))
        work = self.work.get(task.name, task.budget)
        return f"task {task.priority} {task.period} {budget} {work} {task.phase}"


@dataclass(frozen=True)
class TaskOutcome:
    """What a task did; times in us. What the kernel told of it before the start counts if the set
    was admitted."""

    admitted: bool
    told_us: int
    told_unpromoted_us: int
    told_promotes: bool
    told_skips: bool
    runs: int
    samples: int
    sigma: float
    mean: float
    worst: float
    late: int
    due: float
    gap: float
    last: float
    skipped: int
    overruns: int
    promotions: int


@dataclass(frozen=True)
class ChainOutcome:
    """What was observed on a path, us: the longest."""

    outputs: int
    reaction: float  # From a sample to the first output that acts on it.
    freshness: float  # From a sample to any output that acts on it.
    event: float  # From an event that just misses its sample to the first output that knows of it.


@dataclass(frozen=True)
class Result:
    """What happened in a run."""

    status: int
    fingerprint: str
    passes: int
    idle_mean_us: float
    idle_least_us: int
    tasks: dict[str, TaskOutcome]
    chains: dict[str, ChainOutcome]


def read_task(raw: dict[str, Any]) -> TaskOutcome:
    """A task's outcome; the program counts in ns."""
    in_ns = ("sigma", "mean", "worst", "due", "gap", "last")
    return TaskOutcome(
        **{key: value / 1000 if key in in_ns else value for key, value in raw.items()}
    )


def read_result(line: str, experiment: Experiment) -> Result:
    """A line of the program's output."""
    raw = json.loads(line)
    names = [task.name for task in experiment.tasks.tasks]
    raw["tasks"] = {name: read_task(item) for name, item in zip(names, raw["tasks"], strict=True)}
    chains = [chain.name for chain in experiment.tasks.chains]
    raw["chains"] = {
        name: ChainOutcome(
            item["outputs"], item["reaction"] / 1000, item["freshness"] / 1000, item["event"] / 1000
        )
        for name, item in zip(chains, raw["chains"], strict=True)
    }
    return Result(**raw)


def for_capacity(tasks: TaskSet) -> list[str]:
    """The flag of a build whose queue holds what the set says; none for the capacity that ships."""
    capacity = tasks.costs.capacity
    return [] if capacity == QUEUE_CAPACITY else [f"-DKEEL_QUEUE_CAPACITY={capacity}u"]


def build(tools: Toolchain, name: str = "experiment", extra: Sequence[str] = ()) -> Path:
    """Build the program."""
    board = Build(tools, "gcc", [*FLAGS, *extra], ROOT / BUILD / f"{name}.build", link_flags=extra)
    return board.program(name, SOURCES, ["-lm"])


def run_batch(
    program: Path, experiments: Sequence[Experiment], timeout_s: float, refusals: bool = False
) -> list[Result]:
    """Run experiments one after another in one process.

    A run that the kernel refused or ended is an error, as nothing or little was measured in it,
    unless the caller looks at the status itself (refusals).
    """
    orders = "".join(experiment.orders() for experiment in experiments)
    try:
        done = subprocess.run(
            [program], input=orders, capture_output=True, text=True, timeout=timeout_s, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise BoardError(f"the virtual board does not end within {timeout_s:g} s") from error
    lines = done.stdout.splitlines()
    if done.returncode != 0 or len(lines) != len(experiments):
        raise BoardError(f"the virtual board fails: {done.stderr or done.returncode}")
    results = [read_result(*pair) for pair in zip(lines, experiments, strict=True)]
    for result, experiment in zip(results, experiments, strict=True):
        if result.status != 0 and not refusals:
            raise BoardError(
                f"a run of {experiment.tasks.name} ({experiment.policy}, "
                f"{experiment.model}) ended with status {result.status} of "
                "include/keel/status.h: it is no result"
            )
    return results
