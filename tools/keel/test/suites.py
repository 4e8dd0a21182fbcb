# SPDX-License-Identifier: Apache-2.0
"""Runs suites side by side, tells how they went, and writes the reports."""

from __future__ import annotations

import argparse
import os
import sys
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ToolError, nearest
from keel.base.junit import JUnitSuite, write_junit
from keel.base.run import stop_all
from keel.base.source import write_report
from keel.install import Toolchain
from keel.test.outcomes import Outcome

REPORT = "report.json"
JUNIT = "junit.xml"


@dataclass(frozen=True)
class Suite:
    """A named set of tests, with the groups of tools that it needs, the seconds that it takes
    alone, whether it runs only when all do, and whether it spends most of them waiting; it may be
    run in any thread."""

    name: str
    groups: tuple[str, ...]
    run: Callable[[], Outcome]
    seconds: float = 0.0
    more: bool = False
    waits: bool = False


def add_options(parser: Parser) -> None:
    """Which suites, and how many at once."""
    parser.add_argument("--filter", default="", metavar="TEXT", help="suites whose name has this")
    parser.add_argument(
        "-j",
        "--jobs",
        type=int,
        default=os.cpu_count() or 1,
        metavar="N",
        help="suites side by side; default: one a core",
    )


def parse(parser: Parser, arguments: Sequence[str] | None) -> argparse.Namespace:
    """The command line; no suite at once is refused."""
    options = parser.parse_args(arguments)
    if options.jobs < 1:
        parser.error("--jobs needs at least 1")
    return options


def chosen(suites: Sequence[Suite], words: str) -> list[Suite]:
    """The suites whose name contains the words; none is an error."""
    found = [suite for suite in suites if words in suite.name]
    if not found:
        like = nearest(words, [suite.name for suite in suites])
        guess = f"; did you mean {like}?" if like else ""
        raise ToolError(f"no suite's name contains {words!r}{guess}")
    return found


def failure(suite: Suite, why: str) -> Outcome:
    """The outcome of a suite that could not be run."""
    outcome = Outcome()
    outcome.add(suite.name, f"{suite.name}: {why}")
    return outcome


def refusal(tools: Toolchain, groups: Sequence[str]) -> str:
    """Install groups of tools; when that cannot be, why."""
    try:
        tools.ensure(*groups)
    except (ToolError, OSError) as error:
        return str(error)
    return ""


def run_suite(suite: Suite, refused: str = "") -> Outcome:
    """Run one suite; whatever keeps it from running, such as a missing tool, is its failure."""
    began = time.monotonic()
    try:
        outcome = failure(suite, refused) if refused else suite.run()
    except (ToolError, OSError) as error:
        outcome = failure(suite, str(error))
    except Exception:
        outcome = failure(suite, f"an error of the runner\n{traceback.format_exc()}")
    if not outcome.passed and not outcome.failures:
        outcome.add(suite.name, f"{suite.name}: no test was run")
    outcome.seconds = time.monotonic() - began
    return outcome


def tell(name: str, outcome: Outcome) -> None:
    """One line for a suite, and its failures, in one piece."""
    failed = f", {len(outcome.failures)} FAILED" if outcome.failures else ""
    line = f"{name:<24} {outcome.passed:>4} passed{failed}  ({outcome.seconds:.1f} s)"
    print("\n".join([line, *outcome.failures]), flush=True)


def begin(folder: Path) -> None:
    """An unfinished run leaves no report."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in (REPORT, JUNIT):
        (folder / name).unlink(missing_ok=True)


def run_all(tools: Toolchain, suites: Sequence[Suite], jobs: int) -> dict[str, Outcome]:
    """Run suites, so many at once, and tell of each as it ends; their outcomes in their own order.

    What they need is installed first: a tool must not change while another suite uses it. Then
    those that take longest begin. One of those that wait runs beside the others, so that no core
    idles for it; but not where one at a time is asked for. Whatever ends this ends all programs
    that were started.
    """
    wanted = dict.fromkeys(suite.groups for suite in suites)
    refused = {groups: refusal(tools, groups) for groups in wanted}
    outcomes: dict[str, Outcome] = {}
    pool, lane = ThreadPoolExecutor(jobs), ThreadPoolExecutor(1)
    try:
        futures: dict[Future[Outcome], str] = {}
        for suite in sorted(suites, key=lambda suite: -suite.seconds):
            runs_in = lane if suite.waits and jobs > 1 else pool
            futures[runs_in.submit(run_suite, suite, refused[suite.groups])] = suite.name
        for future in as_completed(futures):
            name = futures[future]
            outcomes[name] = future.result()
            tell(name, outcomes[name])
    except BaseException:
        for threads in (pool, lane):
            threads.shutdown(wait=False, cancel_futures=True)
        stop_all()
        raise
    finally:
        pool.shutdown()
        lane.shutdown()
    return {suite.name: outcomes[suite.name] for suite in suites}


def end(
    folder: Path, title: str, outcomes: Mapping[str, Outcome], facts: Mapping[str, object]
) -> int:
    """Write the reports, print what failed by name, and the totals; the exit status."""
    passed = sum(outcome.passed for outcome in outcomes.values())
    failed = sum(len(outcome.failures) for outcome in outcomes.values())
    suites = {name: outcome.as_dict() for name, outcome in outcomes.items()}
    write_junit(
        folder / JUNIT,
        title,
        {
            name: JUnitSuite(
                {test: outcome.texts.get(test, "") for test in outcome.tests}, outcome.seconds
            )
            for name, outcome in outcomes.items()
        },
    )
    counted = {"passed": passed, "failed": failed}
    good = passed > 0 and failed == 0
    write_report(
        folder / REPORT,
        {**counted, **facts, "suites": suites},
        good=good,
        whole=not (facts.get("filter") or facts.get("left_out")),
    )
    sys.stderr.flush()
    for name, outcome in outcomes.items():
        for test in outcome.texts:
            print(f"FAILED {name}: {test}")
    print(f"{passed} passed, {failed} failed")
    return 0 if good else 1
