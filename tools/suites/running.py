# SPDX-License-Identifier: Apache-2.0
"""Runs suites, tells how they went, and writes the reports."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from common.errors import ToolError, nearest
from common.junit import JUnitSuite, write_junit
from common.source import write_report
from suites.outcomes import Outcome
from toolchain import Toolchain

REPORT = "report.json"
JUNIT = "junit.xml"


@dataclass(frozen=True)
class Suite:
    """A named set of tests, with the groups of tools that it needs."""

    name: str
    groups: tuple[str, ...]
    run: Callable[[], Outcome]


def chosen(suites: Sequence[Suite], words: str) -> list[Suite]:
    """The suites whose name contains the words; none is an error."""
    found = [suite for suite in suites if words in suite.name]
    if not found:
        like = nearest(words, [suite.name for suite in suites])
        guess = f"; did you mean {like}?" if like else ""
        raise ToolError(f"no suite's name contains {words!r}{guess}")
    return found


def run_suite(tools: Toolchain, suite: Suite) -> Outcome:
    """Run one suite; whatever keeps it from running is its failure."""
    began = time.monotonic()
    try:
        tools.ensure(*suite.groups)
        outcome = suite.run()
    except (ToolError, OSError) as error:
        outcome = Outcome()
        outcome.add(suite.name, f"{suite.name}: {error}")
    if not outcome.passed and not outcome.failures:
        outcome.add(suite.name, f"{suite.name}: no test was run")
    outcome.seconds = time.monotonic() - began
    return outcome


def tell(name: str, outcome: Outcome) -> None:
    """One line for a suite, and its failures."""
    failed = f", {len(outcome.failures)} FAILED" if outcome.failures else ""
    print(f"{name:<24} {outcome.passed:>4} passed{failed}  ({outcome.seconds:.1f} s)", flush=True)
    for failure in outcome.failures:
        print(failure, flush=True)


def begin(folder: Path) -> None:
    """An unfinished run leaves no report."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in (REPORT, JUNIT):
        (folder / name).unlink(missing_ok=True)


def run_all(tools: Toolchain, suites: Sequence[Suite]) -> dict[str, Outcome]:
    """Run suites, and tell of each as it ends."""
    outcomes: dict[str, Outcome] = {}
    for suite in suites:
        outcomes[suite.name] = run_suite(tools, suite)
        tell(suite.name, outcomes[suite.name])
    return outcomes


def end(
    folder: Path, title: str, outcomes: Mapping[str, Outcome], facts: Mapping[str, object]
) -> int:
    """Write the reports, print the totals; the exit status."""
    passed = sum(outcome.passed for outcome in outcomes.values())
    failed = sum(len(outcome.failures) for outcome in outcomes.values())
    suites = {name: outcome.as_dict() for name, outcome in outcomes.items()}
    write_junit(folder / JUNIT, title, {
        name: JUnitSuite({test: outcome.texts.get(test, "") for test in outcome.tests},
                         outcome.seconds)
        for name, outcome in outcomes.items()
    })  # fmt: skip
    counted = {"passed": passed, "failed": failed}
    good = passed > 0 and failed == 0
    write_report(folder / REPORT, {**counted, **facts, "suites": suites}, good=good,
                 whole=not facts.get("filter"))  # fmt: skip
    sys.stderr.flush()
    print(f"{passed} passed, {failed} failed")
    return 0 if good else 1
