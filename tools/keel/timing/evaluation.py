# SPDX-License-Identifier: Apache-2.0
"""The paper's evaluation on the virtual board, with the very scheduler of src/."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

from rich.console import Console

from keel.timing.deviation import deviation, show_deviation
from keel.timing.experiments import Deviations, Findings, Runner, at_goal_cost
from keel.timing.observed import show_contradictions, show_load, show_paths, show_realtime
from keel.timing.output import Cell
from keel.timing.overload import clock, overload, readings
from keel.timing.taskset import TaskSet

SIMULATED = (
    "Simulated: time, execution times, and what turns, passes and dispatches cost. The scheduler "
    "is the code of src/.\nOnly hardware can tell: whether these costs and the budgets are right, "
    "what caches, buses and interrupts add, and\nwhether the counter behind the clock runs true."
)


def show_goals(findings: Findings) -> None:
    """Goals, and why some are missed."""
    goals = findings.goals
    rows: list[list[Cell]] = [
        [goal.name, goal.wanted, goal.measured, "met" if goal.met else "MISSED"] for goal in goals
    ]
    findings.show("Goals", ["", "goal", "measured", ""], rows, 3)
    for reason in dict.fromkeys(goal.reason for goal in goals if not goal.met):
        names = ", ".join(goal.name for goal in goals if not goal.met and goal.reason == reason)
        findings.say(f"Missed: {names}: {reason or 'NO KNOWN REASON'}.")
    findings.say("")


def evaluate(tasks: TaskSet, program: Path, out: Console) -> tuple[Findings, Deviations]:
    """All experiments; tables go to the console."""
    tasks = at_goal_cost(tasks)
    findings = Findings(out)
    runner = Runner(program, out)
    results = deviation(tasks, runner)
    for chapter in (show_deviation, show_load, show_paths, show_realtime):
        chapter(tasks, results, findings)
    show_contradictions(tasks, findings)
    for experiment in (readings, overload, clock):
        experiment(tasks, runner, findings)
    show_goals(findings)
    findings.say(SIMULATED)
    findings.report["goals"] = [asdict(goal) for goal in findings.goals]
    return findings, results
