# SPDX-License-Identifier: Apache-2.0
"""Tests of the part `trace`: whatever stands alone shows, with its cause."""

from __future__ import annotations

import test_requirements_trace as small
from traced_project import TracedProject

from keel.gather.parts.trace import make

LOW = "specs/requirements/widget.sdoc"
SOURCE = "src/rtos/widget.c"


class TraceTest(TracedProject):
    """What hangs together, and what does not."""

    def test_all_is_well(self) -> None:
        part = self.part(make)
        self.assertEqual(part.problems, ())
        self.assertEqual([item.state for item in part.items], ["good"] * 3)
        self.assertEqual(part.tables[0].rows, (("widget", "3", "1", "2", "2", "1", "", "1", "1"),))

    def test_a_function_leads_both_ways(self) -> None:
        items = {item.id: item for item in self.part(make).items}
        self.assertEqual(
            items["keel_widget_turn"].links,
            (
                "requirement:WID-001",
                "goal:widget/keel_widget_turn_ensures_WID_001_turns",
                "goal:widget/keel_widget_turn_ensures_WID_001_range",
                "goal:widget/keel_widget_turn_harness/WID_001_turns",
                "harness:widget/keel_widget_turn_harness",
            ),
        )
        self.assertEqual(items["nudge"].links, ("requirement:WID-001", "function:push"))
        self.assertEqual(items["nudge"].facts["traces"], "by its callers")

    def test_a_requirement_with_its_evidence_in_a_row(self) -> None:
        rows = {row[0]: row[1:] for row in self.part(make).tables[1].rows}
        self.assertEqual(
            rows["requirement:WID-001"],
            (
                "requirement:HLR-001",
                "WID_001_range WID_001_turns",
                "function:keel_widget_turn",
                "2",
                "1",
                "",
                "harness:widget/keel_widget_turn_harness",
                "",
                "good",
            ),
        )
        self.assertEqual(rows["requirement:WID-003"][0], "derived")

    def test_an_orphan_requirement(self) -> None:
        self.change(LOW, "<<<\nRELATIONS:\n- TYPE: Parent\n  VALUE: HLR-001\n", "<<<\n")
        self.assertIn("WID-001: it has no parent, and no DERIVED says why", self.problems(make))

    def test_an_orphan_function(self) -> None:
        self.write(SOURCE, small.SOURCE + "\nvoid keel_widget_stop(void)\n{\n}\n")
        self.assertEqual(
            self.problems(make),
            [
                "src/rtos/widget.c: keel_widget_stop: no clause of its contract bears a"
                " requirement's id",
                "function keel_widget_stop: build/prove/report.json has no harness of it",
            ],
        )
        self.assertEqual([item.state for item in self.part(make).items].count("bad"), 1)

    def test_an_unknown_id(self) -> None:
        self.change("proofs/widget/turn_harness.c", "WID_001", "WID_009")
        self.assertIn(
            "proofs/widget/turn_harness.c: WID_009_turns: there is no requirement WID-009",
            self.problems(make),
        )

    def test_a_dropped_label(self) -> None:
        self.change("include/keel/widget.h", "WID_001_turns", "turns")
        self.assertIn(
            "WID-001: CLAUSES is not what the headers say (tools/keel trace --update)",
            self.problems(make),
        )

    def test_a_clause_that_no_goal_bears(self) -> None:
        del self.proofs["wp"]["goal_list"][1]
        self.assertEqual(
            self.problems(make),
            ["WID-001: no goal and no assertion bears the clause WID_001_range"],
        )

    def test_a_clause_that_is_left_to_cbmc_is_listed_with_the_reason(self) -> None:
        del self.proofs["wp"]["goal_list"][1]
        self.proofs["wp"]["not_by_wp"] = {"keel_widget_turn": "floats"}
        part = self.part(make)
        self.assertEqual(part.problems, ())
        self.assertEqual(
            part.tables[2].rows,
            (("requirement:WID-001", "WID_001_range", "keel_widget_turn: floats"),),
        )

    def test_a_removed_harness(self) -> None:
        self.proofs["cbmc"]["harnesses"] = {}
        self.assertEqual(
            self.problems(make),
            ["function keel_widget_turn: build/prove/report.json has no harness of it"],
        )
        self.proofs["cbmc"]["without_harness"] = {"keel_widget_turn": "a reason"}
        self.assertEqual(self.problems(make), [])

    def test_a_goal_of_a_function_that_is_not_proved(self) -> None:
        self.proofs["wp"]["goal_list"][0]["status"] = "Timeout"
        items = {item.id: item.state for item in self.part(make).items}
        self.assertEqual(items["keel_widget_turn"], "bad")
        self.assertEqual(self.part(make).tables[0].rows[0][4], "2, 1 bad")

    def test_a_name_that_two_functions_have(self) -> None:
        self.write("src/rtos/other.c", small.SOURCE)
        self.assertIn(
            "nudge: 2 functions have this name, which the package cannot tell apart",
            self.problems(make),
        )

    def test_a_report_that_is_not_whole(self) -> None:
        self.part(make)
        self.write("build/prove/report.json", '{"units": ')
        del self.reports["prove/report.json"]
        problem, *more = self.problems(make)
        self.assertTrue(problem.startswith("build/prove/report.json: is not whole"), problem)
        self.assertEqual(more, [])
