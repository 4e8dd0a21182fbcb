# SPDX-License-Identifier: Apache-2.0
"""Overload, the clock's wrap, and the readings of eq. 3."""

from __future__ import annotations

import time
from dataclasses import replace

from keel.timing import textbook_tests
from keel.timing.board import Experiment, Result, run_batch
from keel.timing.experiments import GOAL_MODEL, HOUR_GOAL_S, SECOND, Findings, Runner
from keel.timing.output import Cell
from keel.timing.phases import without_phases
from keel.timing.scheduler_bounds import realtime_bound
from keel.timing.taskset import TaskSet

OVERLOAD_US = 10 * SECOND


def overloaded(tasks: TaskSet, percent: int) -> TaskSet:
    """The others' periods shortened so that budgets add up to that utilisation.

    Without phases, which belong to the periods.
    """
    realtime = float(textbook_tests.utilisation(tasks.realtime))
    factor = (percent / 100 - realtime) / float(textbook_tests.utilisation(tasks.others))
    changed = [
        task if task.realtime else replace(task, period=max(1, round(task.period / factor)))
        for task in without_phases(tasks).tasks
    ]
    return replace(tasks, tasks=tuple(changed), chains=())


def understated(tasks: TaskSet) -> dict[str, int]:
    """Budgets small enough to be admitted: a designer's error."""
    return {task.name: max(1, task.budget // 2) for task in tasks.others}


def overload_plans(tasks: TaskSet) -> dict[str, Experiment]:
    """The overloads. Each declares what admission takes, and then does more."""
    plans = {}
    for percent in (120, 150):
        heavy = overloaded(tasks, percent)
        plans[f"{percent} %"] = Experiment(
            heavy, duration_us=OVERLOAD_US, budgets=understated(heavy)
        )
    for name, run in (("Foreground magnetometer", 3), ("GPS", 3)):
        work = {name: run * tasks.named(name).budget}
        label = tasks.named(name).label
        plans[f"{label} takes 3 C"] = Experiment(tasks, duration_us=OVERLOAD_US, work=work)
    spike = ("Foreground magnetometer", 10, 950)
    for policy in ("keel", "paper"):
        plans[f"950 us once, {policy}"] = Experiment(
            tasks, policy, duration_us=10 * OVERLOAD_US, spike=spike
        )
    return plans


def longest_run(experiment: Experiment) -> int:
    """The longest run of a task that is not real-time."""
    times = [experiment.work.get(task.name, task.budget) for task in experiment.tasks.others]
    return max([*times, *([experiment.spike[2]] if experiment.spike else [])])


def overload_bound(experiment: Experiment) -> int:
    """What still holds for real-time tasks: one such run in the way."""
    blocking = longest_run(experiment) + experiment.tasks.costs.dispatch_us
    return realtime_bound(experiment.tasks, blocking)


def silent(experiment: Experiment, result: Result) -> list[str]:
    """Tasks that had stopped running before the end: no start in the last fifth."""
    late = 0.8 * experiment.duration_us
    return [
        task.label
        for task in experiment.tasks.others
        if result.tasks[task.name].last < late and task.period < experiment.duration_us / 10
    ]


def counted(experiment: Experiment, result: Result) -> bool:
    """Whether runs and skipped periods account for every release."""
    return all(
        result.tasks[task.name].due
        == task.phase
        + task.period * (result.tasks[task.name].runs + result.tasks[task.name].skipped)
        for task in experiment.tasks.tasks
    )


def overload(tasks: TaskSet, runner: Runner, findings: Findings) -> None:
    """120 % and 150 %, overruns, and the run that starves the paper's rule."""
    plans = overload_plans(tasks)
    results = runner.run("overload", plans)
    rows: list[list[Cell]] = []
    for name, plan in plans.items():
        result = results[name]
        worst = max(result.tasks[task.name].worst for task in plan.tasks.realtime)
        missed = sum(result.tasks[task.name].skipped for task in plan.tasks.realtime)
        outcomes = [result.tasks[task.name] for task in plan.tasks.others]
        gap = max(result.tasks[task.name].gap / task.period for task in plan.tasks.others)
        rows.append(
            [
                name,
                worst,
                overload_bound(plan),
                missed,
                sum(item.skipped for item in outcomes),
                sum(item.overruns for item in outcomes),
                sum(item.promotions for item in outcomes),
                gap,
                " ".join(silent(plan, result)) or "none",
                "yes" if counted(plan, result) else "NO",
            ]
        )
        judge_overload(name, plan, result, findings)
    columns = [
        "overload",
        "RT worst, us",
        "bound with it, us",
        "RT skipped",
        "others skipped",
        "overruns",
        "promotions",
        "longest gap, T",
        "starved",
        "all counted",
    ]
    findings.report["overload"] = findings.show("Overload", columns, rows)
    findings.say(
        "The bound is that of a pass with the overload's longest run in it, not the one for runs "
        "that keep their budgets.\n"
    )


def judge_overload(name: str, plan: Experiment, result: Result, findings: Findings) -> None:
    """The goals under overload."""
    starved = silent(plan, result)
    if plan.policy == "paper":
        findings.goal(
            f"{name}: the paper's rule",
            "starves the task for ever",
            f"starved: {' '.join(starved) or 'none'}",
            bool(starved),
        )
        return
    worst = max(result.tasks[task.name].worst for task in plan.tasks.realtime)
    bound = overload_bound(plan)
    shortest = min(task.period for task in plan.tasks.realtime)
    findings.goal(
        f"{name}: real-time",
        f"within {bound} us, the overrun in it",
        f"{worst:.1f} us",
        worst <= bound,
    )
    if bound > shortest:
        missed = sum(result.tasks[task.name].skipped for task in plan.tasks.realtime)
        findings.goal(
            f"{name}: real-time",
            f"within the period of {shortest} us",
            f"{worst:.1f} us, {missed} releases skipped and counted",
            worst <= shortest,
            f"nothing preempts a run of {longest_run(plan)} us: a longer run than the gap costs "
            "real-time releases whatever the rule",
        )
    findings.goal(
        f"{name}: others",
        "every task keeps running",
        f"starved: {' '.join(starved) or 'none'}",
        not starved,
    )
    findings.goal(
        f"{name}: counters",
        "account for every release",
        "all" if counted(plan, result) else "NOT all",
        counted(plan, result),
    )


def clock(tasks: TaskSet, runner: Runner, findings: Findings) -> None:
    """The same minutes across the counter's wrap, and an hour against the wall clock."""
    wrap = 1 << 32
    firsts = {"from 0": 0, "wraps after 30 s": wrap - 30 * SECOND, "wraps at once": wrap - 1}
    plans = {
        name: Experiment(tasks, model=GOAL_MODEL, duration_us=60 * SECOND, first_us=first)
        for name, first in firsts.items()
    }
    results = runner.run("clock", plans)
    reference = results["from 0"]
    same = all(result == reference for result in results.values())
    findings.goal(
        "clock wrap",
        "identical results across 2^32 us",
        f"fingerprint {reference.fingerprint}" if same else "DIFFERENT",
        same,
    )
    began = time.monotonic()
    (hour,) = run_batch(
        runner.program, [Experiment(tasks, model=GOAL_MODEL, duration_us=3600 * SECOND)], 300.0
    )
    seconds = time.monotonic() - began
    runs = sum(outcome.runs for outcome in hour.tasks.values())
    findings.goal(
        "speed",
        f"one simulated hour in {HOUR_GOAL_S:.0f} s",
        f"{seconds:.1f} s, {runs} runs, {hour.passes} passes",
        seconds <= HOUR_GOAL_S,
    )
    findings.report["clock"] = {"fingerprints": {n: r.fingerprint for n, r in results.items()}}
    findings.say(f"One simulated hour: {seconds:.1f} s of real time, {runs} runs of tasks.\n")


READINGS = {
    "keel": "Keel: released tasks that fit the slack to the real-time release, or are promoted",
    "literal": "eq. 3 to the letter: the task's own t_r, which is not above 0 when it is due",
    "ungated": "slack to the real-time release, but no wait for a task's own release",
    "paper": "slack to the real-time release, released tasks only: works until one long run",
}
READING_US = 20 * SECOND


def readings(tasks: TaskSet, runner: Runner, findings: Findings) -> None:
    """What eq. 3 does, read in each of the ways that its text allows."""
    plain = without_phases(tasks)
    plans = {name: Experiment(plain, name, duration_us=READING_US) for name in READINGS}
    rows: list[list[Cell]] = []
    for name, result in runner.run("eq. 3", plans).items():
        often = [result.tasks[task.name].runs / (READING_US / task.period) for task in plain.others]
        load = (100_000 - result.idle_mean_us) / 1000
        rows.append(
            [READINGS[name], sum(value == 0 for value in often), min(often), max(often), load]
        )
    columns = ["eq. 3 read as", "others that never run", "runs a period, least", "most", "load, %"]
    title = "Readings of eq. 3, constant WCET, no phases"
    findings.report["readings"] = findings.show(title, columns, rows)
