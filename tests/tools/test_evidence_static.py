# SPDX-License-Identifier: Apache-2.0
"""Tests of the part `static` of the evidence package: each fault is put into a report, and must
show as a problem that names it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from evidence_sample import STAMP, PartTest

from keel.base.source import STAMP as MADE_FROM
from keel.boards.board import board_names
from keel.gather.parts import static

ROOT = Path(__file__).resolve().parents[2]

FINDING = {"rule": "misra-c2012-15.5", "file": "src/x.c", "line": 7, "reason": "15.5: is not met"}


def lint_report() -> dict[str, Any]:
    """A file with one finding, which a deviation allows."""
    deviation = {
        "id": "MD-001",
        "rule": "15.5",
        "reason": "early refusals",
        "where": ["src/"],
        "line": "",
        "marked": False,
        "declared": 16,
        "allows": {"src/x.c": 1},
    }
    return {
        "findings": [],
        "violations": 1,
        "deviations": [deviation],
        "files": ["src/x.c"],
        "rules_without_checker": ["1.1"],
        "tools": {"cppcheck": "2.22.0"},
    }


def stack_report() -> dict[str, Any]:
    """A stack with room, whose bound no run has refuted."""
    main = {"size": 500, "bound": 208, "path": ["keel_reset", "x.c:main"]}
    return {
        "stacks": {"main": main},
        "tasks": {"body": {"bound": 40, "path": ["x.c:body"]}},
        "exception_frame_bytes": 108,
        "painted": 100,
    }


def bench_report() -> dict[str, Any]:
    """One figure, within its budget, above its goal."""
    figure = {"passes": 10, "mean": 30.25, "longest": 31, "budget": 30.0, "goal": 25}
    return {"cortex_m7": {"figures": {"no_task": figure}, "over_budget": []}}


def eva_report() -> dict[str, Any]:
    """One function, whose contract names what it writes."""
    writes = {"function": "keel_x", "verdict": "within", "run": "alone", "reached": 1.0}
    return {
        "problems": [],
        "alarms": [],
        "analyzed": 3,
        "functions": 4,
        "reach": {"main": [3, 4]},
        "assigns": [writes],
        "explained": {"alarm": [], "writes": []},
    }


class Static(PartTest):
    """A build folder with good reports, into which each test puts one fault."""

    maker = staticmethod(static.make)

    def setUp(self) -> None:
        super().setUp()
        self.write("lint/report.json", lint_report())
        for name in board_names(ROOT):
            self.write(f"stack/{name}.json", stack_report())
        self.write("bench/report.json", bench_report())
        self.write("eva/report.json", eva_report())

    def table(self, title: str) -> list[tuple[str, ...]]:
        """The rows of the table whose title begins so."""
        (rows,) = [table.rows for table in self.make().tables if table.title.startswith(title)]
        return list(rows)

    def test_good_reports_give_a_part_without_problems(self) -> None:
        part = self.make()
        self.assertEqual(part.problems, ())
        self.assertEqual([f"{item.kind}:{item.id}" for item in part.items], ["deviation:MD-001"])
        self.assertEqual(self.table("MISRA"), [("deviation:MD-001", "15.5", "src/x.c", "1")])
        self.assertEqual(
            self.table("Instructions"), [("no_task", "10", "30.2", "31", "30.0", "25", "no")]
        )

    def test_a_finding_without_a_deviation(self) -> None:
        self.write("lint/report.json", {**lint_report(), "findings": [FINDING]})
        self.assertEqual(self.problem(), "src/x.c:7: misra-c2012-15.5: 15.5: is not met")

    def test_what_eva_leaves_to_explain(self) -> None:
        alarm = "src/x.c:7: keel_x: index_bound: i < 4"
        writes = "keel_x: may write what its contract does not name"
        self.write("eva/report.json", {**eva_report(), "problems": [alarm, writes]})
        self.assertEqual(list(self.make().problems), [alarm, writes])

    def test_what_eva_reached_and_compared(self) -> None:
        self.assertEqual(self.table("Statements"), [("main", "3", "4")])
        self.assertEqual(self.table("What is written"), [("keel_x", "within", "alone", "100 %")])

    def test_a_stack_without_room(self) -> None:
        report = stack_report()
        report["stacks"]["main"]["size"] = 207
        self.write("stack/mps2_an500.json", report)
        self.assertIn(
            "mps2_an500: the stack main needs up to 208 bytes, and has 207", self.problem()
        )

    def test_a_painted_stack_deeper_than_the_bound(self) -> None:
        self.write("stack/mps2_an500.json", {**stack_report(), "painted": 101})
        self.assertIn("101 bytes deep, deeper than the bound of 100", self.problem())

    def test_a_stack_that_was_not_painted_is_told(self) -> None:
        self.write("stack/fmuv5.json", {**stack_report(), "painted": None})
        painted = {row[0]: row[4] for row in self.table("Worst-case") if row[1] == "stack main"}
        self.assertEqual(
            painted,
            {"cuav_v5": "100", "fmuv5": "did not run", "mps2_an500": "100", "nucleo_f767zi": "100"},
        )

    def test_a_cost_above_its_budget(self) -> None:
        report = bench_report()
        report["cortex_m7"]["over_budget"] = ["pass, no task 40.0 > 31.5"]
        self.write("bench/report.json", report)
        self.assertIn("bench/budget.toml: pass, no task 40.0 > 31.5", self.problem())

    def test_a_bench_of_the_host_alone(self) -> None:
        self.write("bench/report.json", {"sets": {}})
        self.assertIn("has no figures of the Cortex-M7", self.problem())

    def test_a_report_that_is_missing_stale_or_broken(self) -> None:
        (self.build / "stack/fmuv5.json").unlink()
        self.write("bench/report.json", {**bench_report(), MADE_FROM: {**STAMP, "tree": "other"}})
        (self.build / "eva/report.json").unlink()
        (self.build / "lint/report.json").write_text('{"findings": [')
        shown = [problem.partition(": ")[0] for problem in self.make().problems]
        names = ("lint/report", "eva/report", "stack/fmuv5", "bench/report")
        self.assertEqual(shown, [f"build/{name}.json" for name in names])
