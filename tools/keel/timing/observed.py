# SPDX-License-Identifier: Apache-2.0
"""What the same runs tell of load, paths and responses, and what contradicts the paper."""

from __future__ import annotations

from dataclasses import dataclass

from keel.timing import textbook_tests
from keel.timing.experiments import GOAL_MODEL, MODELS, Deviations, Findings, variants
from keel.timing.output import Cell
from keel.timing.phases import without_phases
from keel.timing.scheduler_bounds import TICK, bounds_of, path_bound, responses_of
from keel.timing.taskset import TaskSet


def show_load(tasks: TaskSet, results: Deviations, findings: Findings) -> None:
    """Idle time and load over windows of 100 ms."""
    rows: list[list[Cell]] = []
    if tasks.published and tasks.published.load_percent is not None:
        load = tasks.published.load_percent
        rows.append(["paper", 1000.0 * (100.0 - load), load, None])
    for name in ("Keel", "no phases", "EDF"):
        for model in MODELS:
            idle, least = results[name, model].idle_mean_us, results[name, model].idle_least_us
            loads = ((100_000 - us) / 1000 for us in (idle, least))
            rows.append([f"{name}, {model}", idle, *loads])
    columns = ["", "idle of 100 000 us", "load, %", "highest load of a window, %"]
    findings.show("CPU load (eq. 13, 14), passes that run a task included", columns, rows)
    total = 100.0 * float(textbook_tests.utilisation(tasks.tasks))
    findings.say("Passes that run nothing count as idle, as the kernel counts them.")
    findings.say(
        f"Table 2's budgets alone are {total:.2f} %; the paper's load means that its tasks took "
        "two thirds of them on average.\n"
    )
    findings.report["load"] = rows


@dataclass(frozen=True)
class Seen:
    """The longest that was observed on a path, us."""

    reaction: float
    freshness: float
    event: float  # The reaction to an event that just misses its sample.


REASON_ADVICE = "these limits are advice: it is not known whether the paper has these paths"


def seen_on(results: Deviations, variant: str, chain: str) -> Seen:
    """The longest on a path, with all models that keep to the budgets."""
    runs = [results[variant, model].chains[chain] for model in ("constant", GOAL_MODEL)]
    return Seen(
        max(run.reaction for run in runs),
        max(run.freshness for run in runs),
        max(run.event for run in runs),
    )


def show_paths(tasks: TaskSet, results: Deviations, findings: Findings) -> None:
    """Observed against predicted against limits."""
    plain = without_phases(tasks)
    bounds = [bounds_of(item) for item in (tasks, plain)]
    rows: list[list[Cell]] = []
    events: list[list[Cell]] = []
    worst: dict[str, Seen] = {}
    for chain in tasks.chains:
        path = tasks.path(chain)
        phased, together = (seen_on(results, name, chain.name) for name in ("Keel", "no phases"))
        rows.append(
            [
                chain.name,
                phased.reaction,
                together.reaction,
                textbook_tests.reaction(path),
                chain.reaction_limit_us,
                phased.freshness,
                together.freshness,
                textbook_tests.freshness(path),
                chain.freshness_limit_us,
            ]
        )
        events.append(
            [
                chain.name,
                phased.event,
                path_bound(tasks, chain, bounds[0]).least,
                together.event,
                path_bound(plain, chain, bounds[1]).least,
                chain.reaction_limit_us,
            ]
        )
        worst[chain.name] = phased
    columns = [
        "path",
        "E seen",
        "E, no phases",
        "E, eq. 5, 6",
        "limit",
        "F seen",
        "F, no phases",
        "F, eq. 7",
        "limit",
    ]
    findings.show("Fig. 10: reaction and freshness, us", columns, rows)
    findings.say(
        "Seen: from the start of the run that takes a sample to the end of the first (E) or any "
        "(F) run of the last task\nthat acts on it.\n"
    )
    columns = ["path", "seen", "safe bound", "no phases: seen", "safe bound", "limit of E"]
    title = "From an event that just misses its sample until the path has reacted, us"
    findings.show(title, columns, events)
    findings.say(
        "That is also how old a value gets until it is replaced. Eq. 5 to 7 do not bound it: they "
        "begin with the sample.\n"
    )
    findings.report["paths"] = rows
    findings.report["events"] = events
    beyond = [row[0] for row in events if float(row[3] or 0.0) > float(row[4] or 0.0)]
    findings.goal(
        "paths, no phases",
        "observed within the safe bound",
        f"beyond: {beyond}" if beyond else "all",
        not beyond,
    )
    judge_paths(tasks, worst, findings)


def judge_paths(tasks: TaskSet, worst: dict[str, Seen], findings: Findings) -> None:
    """What was observed, against the safe bound, against limits, and against advice."""
    found = bounds_of(tasks)
    beyond_bound = []
    late: list[str] = []
    beyond: dict[bool, list[str]] = {False: [], True: []}  # By whether the limits are advice.
    for chain in tasks.chains:
        seen = worst[chain.name]
        limit = path_bound(tasks, chain, found).least
        if limit is None or max(seen.reaction, seen.freshness, seen.event) > limit:
            beyond_bound.append(chain.name)
        if seen.reaction > chain.reaction_limit_us or seen.freshness > chain.freshness_limit_us:
            beyond[chain.advisory].append(chain.name)
        if seen.event > chain.reaction_limit_us and not chain.advisory:
            late.append(chain.name)
    for wanted, names, reason in (
        ("observed within the safe bound", beyond_bound, ""),
        ("from a sample: observed within the paper's limits", beyond[False], ""),
        ("from an event: observed within the paper's limits", late, ""),
        ("from a sample: observed within the limits that are advice", beyond[True], REASON_ADVICE),
    ):
        measured = f"beyond: {'; '.join(names)}" if names else "all"
        findings.goal("paths", wanted, measured, not names, reason)


def show_realtime(tasks: TaskSet, results: Deviations, findings: Findings) -> None:
    """Jitter and responses of real-time tasks, with phases and without."""
    rows: list[list[Cell]] = []
    held = True
    for variant in variants(tasks):
        if variant.turn_ns > TICK * 1000:
            continue  # Beyond what the bound assumes of the main loop.
        bound = bounds_of(variant.tasks).realtime
        for task in variant.tasks.realtime:
            for model in MODELS:
                outcome = results[variant.name, model].tasks[task.name]
                if model == GOAL_MODEL:
                    limit = bound[task.name] if variant.policy == "keel" else None
                    rows.append([variant.name, task.label, outcome.sigma, outcome.worst, limit])
                # Heavy tails exceed budgets, which no bound covers.
                if variant.policy == "keel" and model != "heavy":
                    held &= outcome.worst <= bound[task.name]
    columns = ["", "task", "deviation, us", "worst response, us", "bound, us"]
    findings.show("Real-time tasks, times in 50 % to 100 %", columns, rows, 2)
    findings.report["realtime"] = rows
    findings.goal(
        "real-time responses",
        "never above the analyser's bound",
        "never" if held else "EXCEEDED",
        held,
    )
    kept = all(
        results[variant, model].tasks[name].worst <= (bound.response or 0)
        for variant, bounded in (("Keel", tasks), ("no phases", without_phases(tasks)))
        for name, bound in bounds_of(bounded).others.items()
        for model in ("constant", GOAL_MODEL)
    )
    findings.goal(
        "other responses", "never above the analyser's bound", "never" if kept else "EXCEEDED", kept
    )


def show_contradictions(tasks: TaskSet, findings: Findings) -> None:
    """The paper's figures that its own table excludes. It gives no phases."""
    found = bounds_of(without_phases(tasks))
    responses = responses_of(found)
    rows: list[list[Cell]] = []
    for task in tasks.tasks:
        response = responses[task.name]
        if task.sigma is None or response is None:
            continue
        # Two starts differ from a period by at most the longest wait; so does their deviation.
        most = response - task.budget
        printed = task.sigma * task.period / 100
        if printed > most:
            rows.append([task.label, task.name, task.sigma, printed, most, printed / most])
    columns = ["", "task", "printed, % of T", "that is, us", "possible, us", "ratio"]
    title = "Printed deviations that table 2 excludes"
    findings.report["contradictions"] = findings.show(title, columns, rows, 2)
    findings.say(
        f"{len(rows)} of {len(tasks.tasks)} printed deviations exceed the longest wait under Keel "
        "with table 2's budgets and periods. So they are\nno percentages of the period (the paper "
        "gives no unit), or releases were not on a grid, or tasks took longer than their\nWCET. "
        "Nor do they fall with priority, as the text says: τ9, medium-high, has 4.89, τ14, medium, "
        "1.43.\n"
    )
