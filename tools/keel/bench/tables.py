# SPDX-License-Identifier: Apache-2.0
"""What `make bench` prints of its measurements on the host."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from keel.bench.budget import Budget
from keel.bench.kinds import NO_TASK, ONE_TASK, Kind, merged

# The same set and the same method with the schedulers that flight firmware flies: instructions
# of a pass that runs no task, and of one that runs one.
FOR_SCALE = {"Cleanflight": (526, 563), "Betaflight": (564, 662)}


@dataclass(frozen=True)
class Target:
    """The Cortex-M7 build, in bytes."""

    text: dict[str, int]
    data: dict[str, int]
    sizes: dict[str, int]

    @property
    def total(self) -> int:
        return sum(self.text.values())

    @property
    def per_task(self) -> int:
        return self.sizes["task"]


@dataclass(frozen=True)
class Goal:
    """What a figure should at most be."""

    name: str
    value: float
    limit: int

    @property
    def met(self) -> bool:
        return self.value <= self.limit


def row(label: str, kind: Kind, indent: str = "  ") -> str:
    longest = f"{kind.longest:9}" if kind.longest else ""
    return f"{indent}{label:28}{kind.passes:8}{kind.mean:10.1f}{longest}"


def print_set(tasks: int, capacity: int, kinds: Mapping[str, Kind]) -> None:
    print(f"\n{tasks} tasks (queue of {capacity})          passes      mean  longest")
    print(row("no task", merged(kinds, NO_TASK)))
    print(row("waiting", kinds["waited"], "    "))
    print(row("first after work, wake-up", kinds["idle"], "    "))
    print(row("one task", merged(kinds, ONE_TASK)))
    for label, name in (("real-time", "realtime"), ("other", "other")):
        if kinds[name].passes:
            print(row(label, kinds[name], "    "))
    print(row("several tasks", kinds["several"]))


def print_scale() -> None:
    print("\nFor scale (measured before, same set, same method)    no task  one task")
    for name, (none, one) in FOR_SCALE.items():
        print(f"  {name:50}{none:8}{one:10}")


def print_hot(tasks: int, kinds: Mapping[str, Kind]) -> None:
    print(f"\nInstructions by function, mean per pass, {tasks} tasks")
    for label, names in (("no task", NO_TASK), ("one task", ONE_TASK)):
        kind = merged(kinds, names)
        parts = [f"{name} {cost / kind.passes:.1f}" for name, cost in kind.functions.most_common()]
        print(f"  {label}: {', '.join(parts)}")


def print_target(target: Target, capacity: int) -> None:
    print("\nCortex-M7, bytes of text")
    for name, size in target.text.items():
        print(f"  {name:28}{size:8}")
    print(f"  {'sum':28}{target.total:8}")
    print(f"Writable data of the layer: {sum(target.data.values())} bytes")
    sizes = target.sizes
    print(
        f"RAM per task: {target.per_task} bytes; its declaration, which may be constant, takes "
        f"{sizes['config']}"
    )
    print(f"The scheduler, its queue of {capacity} included: {sizes['scheduler']} bytes")


def print_goals(goals: Sequence[Goal]) -> None:
    print("\nGoals                                value     limit")
    for goal in goals:
        met = "met" if goal.met else "MISSED"
        print(f"  {goal.name:30}{goal.value:10.1f}{goal.limit:10}  {met}")


def verdict(goals: Sequence[Goal]) -> str:
    missed = [f"{goal.name} {goal.value:.1f} > {goal.limit}" for goal in goals if not goal.met]
    if not missed:
        return f"bench: all {len(goals)} goals met, two runs equal to the instruction."
    return f"bench: {len(missed)} of {len(goals)} goals missed: {'; '.join(missed)}."


def print_steps(budget: Budget, steps: Mapping[str, Kind]) -> None:
    print("\nInstructions of a step, host build    mean   goal on the Cortex-M7")
    for name, kind in steps.items():
        print(f"  {budget.figures[name].about:34}{kind.mean:7.1f}{budget.goal(name):7}")
    print("  On the Cortex-M7 none of them has double precision or calls a library.")


def print_figures(budget: Budget, host: Mapping[str, Kind], counted: Mapping[str, Kind]) -> None:
    print("\nInstructions, mean (longest)         host  Cortex-M7             budget   goal")
    for name, figure in budget.figures.items():
        shown = f"{host[name].mean:9.1f}" if name in host else f"{'-':>9}"
        kind, goal = counted[name], figure.goal
        met = "-" if goal is None else f"{goal} {'met' if kind.mean <= goal else 'MISSED'}"
        print(
            f"  {figure.about:30}{shown}{kind.mean:11.1f} ({kind.longest:5})"
            f"{figure.budget:11.1f}   {met}"
        )
