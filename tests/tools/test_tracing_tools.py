# SPDX-License-Identifier: Apache-2.0
"""Tests of what StrictDoc and LOBSTER make of the requirements, with the tools themselves."""

from __future__ import annotations

import shutil
from pathlib import Path

import test_requirements_trace as small
from traced_project import ROOT, TracedProject

from keel.base.errors import ToolError
from keel.gather.traced import read
from keel.trace import lobster, strictdoc
from keel.trace.packages import packages
from keel.trace.requirements import FOLDER

LOW = "specs/requirements/widget.sdoc"


class LobsterTest(TracedProject):
    """LOBSTER finds alone what is alone, and does not take a failure for cover."""

    def complaints(self) -> list[str]:
        """What LOBSTER says when the trace is joined as the part does it."""
        context = self.context()
        traced = read(context, [])
        trace = traced.trace
        levels = lobster.items(trace.requirements, trace.functions, traced.verdicts)
        return lobster.gate(context.work, packages(), levels)

    def test_all_is_well(self) -> None:
        self.assertEqual(self.complaints(), [])
        page = self.root / "build/work" / lobster.PAGE
        self.assertIn("WID-001", page.read_text(encoding="utf-8"))

    def test_a_failing_test_covers_nothing(self) -> None:
        suites = self.reports["test/report.json"]["suites"]
        suites["unit/widget"]["tests"]["it_loops"] = "failed"
        self.assertEqual(
            self.complaints(),
            [
                "LOBSTER: req WID-002: missing reference to Proofs or Tests",
                "LOBSTER: test unit/widget/it_loops: its verdict is: failed; missing up reference",
            ],
        )

    def test_a_goal_that_is_not_proved(self) -> None:
        self.proofs["wp"]["goal_list"][0]["status"] = "Timeout"
        self.assertEqual(
            self.complaints(),
            [
                "LOBSTER: goal widget/keel_widget_turn_ensures_WID_001_turns: its verdict is:"
                " Timeout; missing up reference"
            ],
        )

    def test_a_requirement_without_a_parent(self) -> None:
        self.change(LOW, "<<<\nRELATIONS:\n- TYPE: Parent\n  VALUE: HLR-001\n", "<<<\n")
        self.assertEqual(
            self.complaints(),
            [
                "LOBSTER: req HLR-001: missing reference to Low-level requirements or Tests",
                "LOBSTER: req WID-001: missing up reference",
            ],
        )

    def test_a_parent_that_does_not_exist(self) -> None:
        self.change(LOW, "VALUE: HLR-001", "VALUE: HLR-001\n- TYPE: Parent\n  VALUE: HLR-009")
        self.assertEqual(
            self.complaints(), ["LOBSTER: req WID-001: unknown tracing target req HLR-009"]
        )

    def test_a_function_without_a_requirement(self) -> None:
        self.write("src/rtos/widget.c", small.SOURCE + "\nvoid keel_widget_stop(void)\n{\n}\n")
        self.assertEqual(
            self.complaints(),
            ["LOBSTER: c src/rtos/widget.c:keel_widget_stop: missing up reference"],
        )

    def test_a_goal_of_a_requirement_that_does_not_exist(self) -> None:
        self.proofs["wp"]["goal_list"][0]["name"] = "keel_widget_turn_ensures_WID_009_turns"
        self.assertEqual(
            self.complaints(),
            [
                "LOBSTER: goal widget/keel_widget_turn_ensures_WID_009_turns: unknown tracing"
                " target req WID-009; missing up reference"
            ],
        )


class StrictDocTest(TracedProject):
    """The requirements are what StrictDoc's grammar asks for."""

    def setUp(self) -> None:
        super().setUp()
        shutil.rmtree(self.root / "specs")
        shutil.copytree(ROOT / FOLDER, self.root / FOLDER)

    def export(self) -> dict[str, Path]:
        """What StrictDoc writes."""
        return strictdoc.export(self.root, self.root / "work", packages())

    def test_the_requirements_as_pages_and_as_reqif(self) -> None:
        files = self.export()
        reqif = files["keel.reqif"].read_text(encoding="utf-8")
        self.assertIn("QUE-003", reqif)
        trace = files["strictdoc/requirements/queue-TRACE.html"].read_text(encoding="utf-8")
        self.assertIn("HLR-003", trace)
        page = files["strictdoc/index.html"].read_text(encoding="utf-8")
        self.assertNotIn(str(self.root), page)
        again = self.export()["keel.reqif"].read_text(encoding="utf-8")
        self.assertEqual(reqif, again)

    def test_a_parent_that_does_not_exist(self) -> None:
        path = self.root / FOLDER / "task.sdoc"
        path.write_text(path.read_text("utf-8").replace("HLR-002", "HLR-999"), encoding="utf-8")
        with self.assertRaisesRegex(ToolError, "StrictDoc does not read .*HLR-999"):
            self.export()

    def test_a_high_level_requirement_without_its_rationale(self) -> None:
        path = self.root / FOLDER / "high_level.sdoc"
        text = path.read_text("utf-8").replace("RATIONALE:", "COMMENT:", 1)
        path.write_text(text, encoding="utf-8")
        with self.assertRaisesRegex(ToolError, "StrictDoc does not read "):
            self.export()
