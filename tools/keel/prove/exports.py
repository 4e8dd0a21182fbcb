# SPDX-License-Identifier: Apache-2.0
"""A run's results for other programs: JUnit XML for CI systems, SARIF for hosts and editors."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from keel.base.files import write_text
from keel.base.junit import JUnitSuite, write_junit
from keel.base.sarif import SarifResult, split_place, write_sarif
from keel.prove.driver import Outcome
from keel.prove.report import Gathered, UnitResult

JUNIT, SARIF, SUMMARY = "junit.xml", "results.sarif", "summary.md"
KIND = re.compile(
    r"_(loop_(?:invariant|variant|assigns)|assert_rte|assert|ensures|requires|assigns|terminates)"
)


@dataclass(frozen=True)
class Check:
    """Something that was to be proved; `failure` is empty if it is."""

    rule: str
    suite: str
    name: str
    failure: str = ""
    place: str = ""


def checks(gathered: Gathered) -> list[Check]:
    """All that a run looked at, and each problem that is about none of it."""
    found = [check for outcome in gathered.outcomes for check in _checks(outcome, gathered)]
    names = {(check.suite.partition(".")[0], check.name) for check in found if check.failure}
    for unit, result in gathered.units.items():
        found += [
            Check("rules/problem", f"{unit}.rules", text, text, text)
            for text in result.problems
            if not any(name in text for suite, name in names if suite == unit)
        ]
    return found + [Check("rules/problem", "rules", text, text, text) for text in gathered.problems]


def _checks(outcome: Outcome, gathered: Gathered) -> Iterator[Check]:
    """What a job looked at."""
    job, result = outcome.job, outcome.result
    unit = gathered.units[job.unit]
    if job.kind == "wp":
        for goal in result["goals"]:
            kind = KIND.search(goal["name"])
            failure = "" if goal["status"] == "Valid" else f"{goal['name']}: {goal['status']}"
            rule = "wp/" + (kind[1] if kind else "lemma")
            yield Check(rule, f"{job.unit}.wp", goal["name"], failure, goal.get("place", ""))
    elif job.kind == "cbmc":
        for item in result["properties"]:
            failed = item["status"] != "SUCCESS"
            failure = f"{item['description']}: {item['status']}" if failed else ""
            rule = "cbmc/" + (item["name"].split(".") + ["check"])[1]
            suite = f"{job.unit}.cbmc.{job.name}"
            yield Check(rule, suite, item["name"], failure, item["place"])
    else:
        yield _single(outcome, unit)


def _single(outcome: Outcome, unit: UnitResult) -> Check:
    """A job with one answer: a wrong body, a bound."""
    job, failure = outcome.job, "; ".join(outcome.problems)
    folder = unit.unit.folder
    rule, path = {
        "negative": ("cbmc/wrong-body", unit.unit.wrong_list),
        "gappa-negative": ("gappa/wrong-bound", unit.unit.wrong_folder / job.name),
    }.get(job.kind, ("gappa/bound", folder / job.name))
    file = path.relative_to(unit.unit.root).as_posix()
    # What fails of a wrong body names the line of its entry; a bound has a file of its own.
    own, line = split_place(failure)
    place = f"{file}:{line if own == file else 1}"
    return Check(rule, f"{job.unit}.{rule.partition('/')[0]}", job.name, failure, place)


def suites(every: Iterable[Check]) -> dict[str, JUnitSuite]:
    """The checks as tests."""
    tests: dict[str, dict[str, str]] = {}
    for check in every:
        where = f"\n{check.place}" if check.failure and check.place else ""
        tests.setdefault(check.suite, {})[check.name] = check.failure + where
    return {name: JUnitSuite(of_suite) for name, of_suite in tests.items()}


def results(every: Iterable[Check]) -> list[SarifResult]:
    """What failed."""
    return [
        SarifResult(check.rule, check.failure, *split_place(check.place))
        for check in every
        if check.failure
    ]


def summary(gathered: Gathered) -> str:
    """A short table, for the page of a CI run; below it what failed."""
    lines = ["| unit | WP | CBMC | Gappa | wrong bodies refuted |", "|---|---|---|---|---|"]
    for name, unit in gathered.units.items():
        refuted = [*unit.negative.values(), *unit.wrong_bounds.values()]
        cells = [
            (unit.wp_proved, unit.wp_total),
            (unit.cbmc_proved, unit.cbmc_total),
            (unit.gappa_proved, unit.gappa_total),
            (sum(refuted), len(refuted)),
        ]
        numbers = [f"{good} of {total}" if total else "" for good, total in cells]
        lines.append(f"| {name} | {' | '.join(numbers)} |")
    lines += ["", f"Proved {gathered.proved} of {gathered.total} goals.", ""]
    return "\n".join([*lines, *(f"- {' '.join(text.split())}" for text in gathered.all_problems)])


def clear(folder: Path) -> None:
    """Remove what an earlier run left: a run that breaks off leaves nothing."""
    for name in (JUNIT, SARIF, SUMMARY):
        (folder / name).unlink(missing_ok=True)


def write(folder: Path, gathered: Gathered) -> None:
    """Write both files."""
    every = checks(gathered)
    write_junit(folder / JUNIT, "Keel proofs", suites(every))
    write_sarif(folder / SARIF, "Keel proofs", results(every))
    write_text(folder / SUMMARY, summary(gathered) + "\n")
