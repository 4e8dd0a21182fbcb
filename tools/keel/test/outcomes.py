# SPDX-License-Identifier: Apache-2.0
"""How a suite went: its tests by name, from what its program wrote."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from keel.base.run import Ended


@dataclass
class Outcome:
    """How a suite went: its tests by name, and what each failure says."""

    tests: dict[str, str] = field(default_factory=dict)
    passed: int = 0
    failures: list[str] = field(default_factory=list)
    seconds: float = 0.0
    texts: dict[str, str] = field(default_factory=dict)  # Of the tests that failed.
    skipped: dict[str, str] = field(default_factory=dict)  # Tests that tell nothing, and why.

    def add(self, name: str, failure: str = "") -> None:
        """Count one test."""
        self.tests[name] = "failed" if failure else "passed"
        if failure:
            self.failures.append(failure)
            self.texts[name] = failure
        else:
            self.passed += 1

    def as_dict(self) -> dict[str, Any]:
        """For the report."""
        return {
            "passed": self.passed,
            "failed": len(self.failures),
            "seconds": round(self.seconds, 1),
            "tests": self.tests,
            "failures": self.failures,
            "skipped": self.skipped,
        }

    def add_end(self, name: str, ended: Ended, good: bool) -> None:
        """Count a program that did not end as its tests say."""
        if ended.timed_out or not good:
            last = list(self.tests)[-1:] or ["the start"]
            self.add(name, f"{name}: {ended.how}, after {last[0]}\n{ended.evidence}")


# Floats are equal when they are: Unity takes 1e-5 of them for nothing unless it is told.
EXACT_FLOATS = "-DUNITY_FLOAT_PRECISION=0.0f"
UNITY_LINE = re.compile(r"^(.+?):(\d+):(\w+):(PASS|FAIL|IGNORE)(?::? ?(.*))?$", re.MULTILINE)
UNITY_SUMMARY = re.compile(r"^(\d+) Tests (\d+) Failures (\d+) Ignored", re.MULTILINE)


def unity_outcome(name: str, ended: Ended) -> Outcome:
    """Read what a Unity program wrote. An ignored test is a failed one: it tested nothing."""
    outcome = Outcome()
    for file, number, test, verdict, message in UNITY_LINE.findall(ended.output):
        failure = f"{file}:{number}: {test}: {message or verdict}"
        outcome.add(test, "" if verdict == "PASS" else failure)
    summary = UNITY_SUMMARY.search(ended.output)
    told = int(summary[1]) if summary else -1
    good = told == len(outcome.tests) and ended.status == len(outcome.failures)
    outcome.add_end(name, ended, good)
    return outcome


REFERENCE_LINE = re.compile(r"^(PASS|FAIL) (\S+?)(?:: (.*))?$", re.MULTILINE)
REFERENCE_SUMMARY = re.compile(r"^(\d+) passed, (\d+) failed\n*\Z", re.MULTILINE)


def reference_outcome(name: str, source: str, ended: Ended) -> Outcome:
    """Read what a reference program wrote: `PASS test` or `FAIL test: why` for each test, any
    other lines, and last `N passed, N failed`. Its exit status is 0 exactly if none failed."""
    outcome = Outcome()
    for verdict, test, message in REFERENCE_LINE.findall(ended.output):
        outcome.add(test, "" if verdict == "PASS" else f"{source}: {test}: {message or verdict}")
    summary = REFERENCE_SUMMARY.search(ended.output)
    told = (int(summary[1]), int(summary[2])) if summary else None
    failed = len(outcome.failures)
    once = len(outcome.tests) == outcome.passed + failed  # No name twice.
    good = once and told == (outcome.passed, failed) and ended.status == (1 if failed else 0)
    outcome.add_end(name, ended, good)
    return outcome


def program_outcome(name: str, ended: Ended, evidence: str = "") -> Outcome:
    """A program whose exit status is its verdict; `evidence` is what a failure shows."""
    outcome = Outcome()
    told = f"{name}: {ended.how}\n{evidence or ended.evidence}"
    outcome.add(name, "" if ended.good else told)
    return outcome


PYTHON_PLACE = re.compile(r"^(\S+\.py:\d+): ", re.MULTILINE)


def pytest_outcome(name: str, report: Path, ended: Ended, may_skip: bool = False) -> Outcome:
    """Read pytest's report. A skipped test tested nothing: it is a failed one, or does not count.

    What a failure says begins with its place: the last line of a test that the trace names.
    """
    outcome = Outcome()
    for case in ElementTree.parse(report).iter("testcase") if report.is_file() else ():
        test = f"{case.get('classname')}.{case.get('name')}"
        wrong = [part for part in case if part.tag in ("failure", "error", "skipped")]
        if may_skip and [part.tag for part in wrong] == ["skipped"]:
            outcome.skipped[test] = wrong[0].get("message", "")
            continue
        told = "; ".join(f"{part.tag}: {part.get('message', '')}" for part in wrong)
        places = PYTHON_PLACE.findall("".join(part.text or "" for part in wrong))
        own = [place for place in places if "test_" in place] or places
        place = f"{own[-1]}: " if own else ""
        outcome.add(test, f"{place}{test}: {told}" if wrong else "")
    good = ended.status == (1 if outcome.failures else 0) and bool(outcome.tests)
    if ended.timed_out or not good:
        outcome.add(name, f"{name}: {ended.how}\n{ended.evidence}")
    return outcome
