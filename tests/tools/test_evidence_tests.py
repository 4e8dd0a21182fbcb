# SPDX-License-Identifier: Apache-2.0
"""Tests of the part `tests` of the evidence package: each fault is put into a report, and must show
as a problem that names it.
"""

from __future__ import annotations

from typing import Any

from evidence_sample import STAMP, PartTest

from keel.base.junit import JUnitSuite, write_junit
from keel.base.source import STAMP as MADE_FROM
from keel.gather.parts import tests

QUEUE, TEST = "unit/queue", "QUE_003_order"
GAP = {"file": "src/x.c", "line": 3, "text": "return 1;", "what": "line not executed"}


def run_report() -> dict[str, Any]:
    """A run of one suite with one test, which passed."""
    outcome = {
        "passed": 1,
        "failed": 0,
        "seconds": 0.1,
        "tests": {TEST: "passed"},
        "failures": [],
        "skipped": {},
    }
    return {"passed": 1, "failed": 0, "filter": "", "suites": {QUEUE: outcome}}


def coverage_report() -> dict[str, Any]:
    """A file with one function, all covered."""
    counts = {"lines": [3, 3], "branches": [4, 4], "mcdc": [0, 0]}
    functions = {"keel_x": counts, "small": counts}
    return {
        "total": counts,
        "files": {"src/x.c": {**counts, "functions": functions}},
        "gaps": [],
        "excluded": [],
        "unused_exclusions": [],
    }


CODE_GAP = {
    "file": "src/x.c",
    "line": 3,
    "text": "if (a) {",
    "function": "keel_x",
    "offset": 4,
    "instruction": "bhi",
    "never": "taken",
}


def code_report() -> dict[str, Any]:
    """One branch, seen both ways."""
    counts = {"branch": 1, "conditions": 1, "outcomes": 2, "seen": 2}
    return {
        "total": counts,
        "files": {"src/x.c": {**counts, "functions": {"keel_x": counts}}},
        "gaps": [],
        "explained": [],
        "stale_reasons": [],
        "untraced": ["long"],
    }


def contracts_report() -> dict[str, Any]:
    """One contract that ran, with a clause left out, and one that did not run."""
    clause = {"function": "keel_x", "file": "src/x.c", "line": 3, "construct": "assigns"}
    unit = {"functions": ["keel_x"], "ignored": [clause], "failures": []}
    absent = {"unit": "src/x.c", "functions": ["keel_y"], "reason": "It does not end."}
    return {"units": {"src/x.c": unit}, "left_out": [absent]}


class Tests(PartTest):
    """A build folder with good reports, into which each test puts one fault."""

    maker = staticmethod(tests.make)

    def setUp(self) -> None:
        super().setUp()
        for folder in ("test", "test-target"):
            self.write(f"{folder}/report.json", run_report())
            self.junit(folder)
        self.write("coverage/report.json", coverage_report())
        self.write("coverage-target/report.json", code_report())
        self.write("contracts-run/report.json", contracts_report())

    def junit(self, folder: str, said: str = "") -> None:
        """Write a run's other report."""
        write_junit(self.build / folder / "junit.xml", "Keel", {QUEUE: JUnitSuite({TEST: said})})

    def test_good_reports_make_a_whole_part(self) -> None:
        part = self.make()
        self.assertEqual(part.problems, ())
        self.assertEqual(part.summary["Tests on the host"], "1 passed, 0 failed")
        self.assertEqual(part.summary["Branches covered"], "4 of 4")
        [item] = part.items
        self.assertEqual((item.kind, item.id, item.state), ("test", f"{QUEUE}/{TEST}", "good"))
        self.assertEqual(item.links, ("requirement:QUE-003",))
        self.assertEqual(set(item.facts.values()), {"passed"})
        self.assertIn(("src/x.c", "function:keel_x", "3 of 3", "4 of 4", "–"), part.tables[1].rows)
        row = ("src/x.c", "function:keel_x", "1", "0", "0", "2 of 2")
        self.assertIn(row, part.tables[3].rows)
        self.assertEqual(part.summary["Contracts that ran with the unit tests"], "1; 1 did not")
        self.assertEqual(part.tables[7].rows, (("keel_y", "It does not end."),))
        self.assertEqual(len(part.files), 7)

    def test_a_failing_test(self) -> None:
        report = run_report()
        report["suites"][QUEUE]["tests"][TEST] = "failed"
        self.write("test-target/report.json", report)
        self.junit("test-target", "t.c:9: Expected 1 Was 2")
        self.assertEqual(
            self.problem(),
            f"{QUEUE}/{TEST} failed on the emulated Cortex-M7: t.c:9: Expected 1 Was 2",
        )
        self.assertEqual(self.make().items[0].state, "bad")

    def test_two_reports_of_a_run_that_differ(self) -> None:
        self.junit("test", "t.c:9: Expected 1 Was 2")
        self.assertEqual(self.problem(), "build/test/junit.xml: has other tests than report.json")

    def test_half_a_report(self) -> None:
        path = self.build / "test/report.json"
        path.write_text(path.read_text()[:-9])
        self.assertIn("build/test/report.json: is not whole", self.problem())

    def test_seconds_are_in_no_table(self) -> None:
        before = self.make()
        report = run_report()
        report["suites"][QUEUE]["seconds"] = 77.7
        self.write("test/report.json", report)
        self.assertEqual(self.make(), before)

    def test_half_a_junit_file(self) -> None:
        path = self.build / "test/junit.xml"
        path.write_text(path.read_text()[:-9])
        self.assertIn("build/test/junit.xml: is not whole", self.problem())

    def test_no_report(self) -> None:
        (self.build / "coverage/report.json").unlink()
        self.assertEqual(self.problem(), "build/coverage/report.json: is missing")

    def test_a_stale_report(self) -> None:
        self.write("test/report.json", {**run_report(), MADE_FROM: {**STAMP, "tree": "0ther"}})
        self.assertIn("build/test/report.json: speaks of another source", self.problem())

    def test_some_of_the_suites(self) -> None:
        self.write("test/report.json", {**run_report(), "filter": "unit/"})
        self.assertIn("only the suites with 'unit/' in their names ran", self.problem())

    def test_no_sanitizers(self) -> None:
        self.write("test/report.json", {**run_report(), "sanitizers": False})
        self.assertIn("the sanitizers' libraries were missing", self.problem())

    def test_no_test(self) -> None:
        self.write("test/report.json", {**run_report(), "suites": {}})
        (self.build / "test/junit.xml").write_text("<testsuites/>")
        self.assertEqual(self.problem(), "build/test/report.json: no test ran on the host")

    def test_a_skipped_test_is_told(self) -> None:
        report = run_report()
        report["suites"][QUEUE]["skipped"] = {"t.later": "no board"}
        self.write("test/report.json", report)
        self.assertIn(f"{QUEUE}: t.later (no board)", self.make().tables[0].note)

    def test_a_gap_without_a_reason(self) -> None:
        self.write("coverage/report.json", {**coverage_report(), "gaps": [GAP]})
        self.assertEqual(
            self.problem(), "src/x.c:3: line not executed, and no reason is given: return 1;"
        )

    def test_a_gap_with_a_reason(self) -> None:
        report = {**coverage_report(), "excluded": [{**GAP, "reason": "why"}]}
        self.write("coverage/report.json", report)
        part = self.make()
        self.assertEqual(part.problems, ())
        self.assertIn(("src/x.c:3", "return 1;", "line not executed", "why"), part.tables[2].rows)

    def test_a_reason_without_a_gap(self) -> None:
        stale = {"file": "src/x.c", "line": "return 2;", "reason": "why"}
        self.write("coverage/report.json", {**coverage_report(), "unused_exclusions": [stale]})
        self.assertEqual(
            self.problem(), "specs/coverage_exclusions.toml: excludes nothing: src/x.c: return 2;"
        )

    def test_a_branch_without_a_reason(self) -> None:
        self.write("coverage-target/report.json", {**code_report(), "gaps": [CODE_GAP]})
        self.assertEqual(
            self.problem(),
            "src/x.c:3: keel_x+0x4 bhi: never taken, and no reason is given: if (a) {",
        )

    def test_a_branch_with_a_reason(self) -> None:
        report = {**code_report(), "explained": [{**CODE_GAP, "reason": "why"}]}
        self.write("coverage-target/report.json", report)
        part = self.make()
        self.assertEqual(part.problems, ())
        self.assertEqual(part.tables[4].rows[0][2:], ("keel_x+0x4 bhi", "taken", "why"))

    def test_a_stale_reason_for_a_branch(self) -> None:
        stale = {
            "function": "keel_x",
            "line": "if (b) {",
            "never": "taken",
            "instructions": 1,
            "reason": "why",
        }
        self.write("coverage-target/report.json", {**code_report(), "stale_reasons": [stale]})
        self.assertIn(
            "specs/object_coverage.toml: fits another number of gaps than 1: keel_x", self.problem()
        )

    def test_a_violated_contract(self) -> None:
        report = contracts_report()
        report["units"]["src/x.c"]["failures"] = ["keel_x: x.h:3: Error: Postcondition failed:"]
        self.write("contracts-run/report.json", report)
        self.assertEqual(
            self.problem(), "contracts-run: keel_x: x.h:3: Error: Postcondition failed:"
        )
