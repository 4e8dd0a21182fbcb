# SPDX-License-Identifier: Apache-2.0
"""Tests of the part `requirements`: each fault that is put in shows, with its cause."""

from __future__ import annotations

import test_requirements_trace as small
from traced_project import STAMP, TracedProject

from keel.gather.parts.requirements import make

LOW = "specs/requirements/widget.sdoc"


class RequirementsTest(TracedProject):
    """What a reviewer reads of a requirement, and what keeps the part from being made."""

    def states(self) -> dict[str, str]:
        """How each requirement stands."""
        return {item.id: item.state for item in self.part(make).items}

    def test_all_is_well(self) -> None:
        part = self.part(make)
        self.assertEqual(part.problems, ())
        self.assertEqual(
            self.states(),
            {
                "HLR-001": "good",
                "HLR-002": "good",
                "WID-001": "good",
                "WID-002": "good",
                "WID-003": "told",
            },
        )
        self.assertEqual(part.summary["high-level requirements"], "2")

    def test_a_reviewer_reaches_goals_harness_and_parent(self) -> None:
        items = {item.id: item for item in self.part(make).items}
        self.assertEqual(
            items["WID-001"].links,
            (
                "requirement:HLR-001",
                "function:keel_widget_turn",
                "goal:widget/keel_widget_turn_ensures_WID_001_turns",
                "goal:widget/keel_widget_turn_ensures_WID_001_range",
                "goal:widget/keel_widget_turn_harness/WID_001_turns",
                "harness:widget/keel_widget_turn_harness",
            ),
        )
        self.assertEqual(
            items["WID-002"].links, ("requirement:HLR-002", "test:unit/widget/it_loops")
        )
        self.assertEqual(items["HLR-001"].links, ("requirement:WID-001",))
        self.assertIn("Rationale: Widgets that stand still", items["HLR-001"].text)
        self.assertEqual(items["HLR-001"].facts["source"], "eq. 1; section III-A")

    def test_departures_and_derived_ones_are_listed_with_their_reasons(self) -> None:
        tables = {table.title: table.rows for table in self.part(make).tables}
        self.assertEqual(
            tables["Departures from the paper"],
            (("requirement:HLR-002", "Surprising", "none", "The paper's widgets do not loop."),),
        )
        self.assertEqual(
            [row[0] for row in tables["Derived requirements"]],
            ["requirement:HLR-002", "requirement:WID-003"],
        )

    def test_a_goal_that_is_not_proved(self) -> None:
        self.proofs["wp"]["goal_list"][0]["status"] = "Timeout"
        self.assertEqual(
            self.problems(make),
            ["WID-001: goal widget/keel_widget_turn_ensures_WID_001_turns: Timeout"],
        )
        self.assertEqual(self.states()["WID-001"], "bad")
        self.assertEqual(self.states()["HLR-001"], "bad")

    def test_an_assertion_that_fails(self) -> None:
        harness = self.proofs["cbmc"]["harnesses"]["keel_widget_turn_harness"]
        harness["assertions"][0]["status"] = "FAILURE"
        harness["proved"] = 2
        self.assertEqual(
            self.problems(make),
            [
                "WID-001: goal widget/keel_widget_turn_harness/WID_001_turns: FAILURE",
                "WID-001: harness widget/keel_widget_turn_harness: 2 of 3 proved",
            ],
        )

    def test_a_harness_that_is_not_sound(self) -> None:
        self.proofs["cbmc"]["harnesses"]["keel_widget_turn_harness"]["sound"] = False
        self.assertEqual(
            self.problems(make),
            ["WID-001: harness widget/keel_widget_turn_harness: 3 of 3 proved, not sound"],
        )

    def test_a_test_that_fails_on_the_target_alone(self) -> None:
        self.reports["test-target/report.json"]["suites"] = {
            "unit/widget": {"tests": {"it_loops": "failed"}}
        }
        self.assertEqual(
            self.problems(make), ["WID-002: test unit/widget/it_loops: passed, failed"]
        )

    def test_a_test_that_did_not_run(self) -> None:
        self.reports["test/report.json"]["suites"] = {}
        self.assertEqual(
            self.problems(make), ["WID-002: TESTS lists it_loops, of which no report has a verdict"]
        )
        self.assertEqual(self.states()["HLR-002"], "open")

    def test_proofs_that_are_gone(self) -> None:
        self.reports["prove/report.json"]["units"] = {}
        self.assertEqual(
            self.problems(make), ["WID-001: VERIFICATION says proof, and no report has one"]
        )

    def test_a_harness_that_compares_with_a_model_proves_what_the_model_names(self) -> None:
        self.proofs["wp"]["goal_list"] = []
        self.proofs["cbmc"]["harnesses"]["keel_widget_turn_harness"]["assertions"] = []
        self.assertEqual(self.states()["WID-001"], "open")
        self.write("specs/model/widget.c", "// WID-001: turns\n")
        self.write("specs/model/widget.h", "")
        self.write("proofs/widget/turn_harness.c", '#include "../../specs/model/widget.h"\n')
        self.assertEqual(self.states()["WID-001"], "good")

    def test_a_missing_parent_leaves_the_one_above_open(self) -> None:
        self.change(LOW, "<<<\nRELATIONS:\n- TYPE: Parent\n  VALUE: HLR-001\n", "<<<\n")
        self.assertEqual(self.states()["HLR-001"], "open")

    def test_a_report_of_another_source(self) -> None:
        self.reports["test/report.json"]["made_from"] = {**STAMP, "tree": "other"}
        self.assertEqual(
            self.problems(make),
            [
                "build/test/report.json: speaks of another source than the one that is here "
                "(the same commit, other files)"
            ],
        )

    def test_no_requirements(self) -> None:
        for name in (LOW, "specs/requirements/high_level.sdoc"):
            self.write(name, "")
        self.assertEqual(self.problems(make), ["specs/requirements: has no requirement"])

    def test_files_of_tests_stand_for_their_suites(self) -> None:
        self.write(LOW, small.SDOC.replace("TESTS: it_loops", "TESTS: tests/target/faults.c"))
        self.write("tests/target/faults.c", "")
        self.reports["test-target/report.json"]["suites"] = {
            "fault/undefined": {"tests": {"fault/undefined": "failed"}}
        }
        self.assertEqual(
            self.problems(make), ["WID-002: test fault/undefined/fault/undefined: failed"]
        )
