# SPDX-License-Identifier: Apache-2.0
"""Tests of bench/budget.toml and of what the emulated machine counts: what is read, and when a
budget is exceeded. That an instruction is counted as one is checked by the image itself, against
assembly of known length.

The budget here has units that there are not: a new one needs no change of tools/keel.
"""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from keel.base.errors import ToolError
from keel.bench import budget as budgets
from keel.bench import command as bench
from keel.bench import emulated
from keel.bench.budget import Budget
from keel.bench.command import Measured
from keel.bench.kinds import KINDS, Kind
from keel.bench.tables import Goal, Target
from keel.install import Toolchain

OUTPUT = """\
bench known passes 3 instructions 16 longest 10
bench waited passes 10 instructions 300 longest 31
bench idle passes 2 instructions 1200 longest 700
bench realtime passes 4 instructions 2000 longest 532
bench other passes 1 instructions 1000 longest 1000
bench rotor passes 1000 instructions 116000 longest 122
bench task_adc passes 50 instructions 5000 longest 120
bench ended
"""
FIGURES = {
    "no_task": Kind(12, 1500, 700),
    "one_task": Kind(5, 3000, 1000),
    "rotor": Kind(1000, 116000, 122),
    "task_adc": Kind(50, 5000, 120),
}
ROTOR = 'rotor = { about = "rotor step", step = "keel_rotor_step", goal = 110, budget = 116 }\n'
GOOD = f"""\
# About the budget.
tolerance_percent = 5

[figures]
no_task = {{ about = "pass, no task", of = ["waited", "idle"], goal = 130, budget = 125 }}
one_task = {{ about = "pass, one task", of = ["realtime", "other"], goal = 200, budget = 600 }}
# Of a unit that there is not.
{ROTOR}task_adc = {{ about = "task: adc", budget = 110 }}
"""


class Budgeted(unittest.TestCase):
    """A budget of its own."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.file = Path(temporary.name) / "budget.toml"
        self.budget = self.read(GOOD)

    def read(self, text: str) -> Budget:
        self.file.write_text(text)
        return budgets.read_budget(self.file)


class Reading(Budgeted):
    """What the image prints."""

    def figures(self, output: str) -> dict[str, Kind]:
        return emulated.figures_of(emulated.read_kinds(output), self.budget)

    def test_the_kinds_of_a_figure_are_taken_together(self) -> None:
        self.assertEqual(self.figures(OUTPUT), FIGURES)
        self.assertEqual(FIGURES["no_task"].mean, 125.0)

    def test_a_kind_without_passes(self) -> None:
        for output in (
            OUTPUT.replace("passes 2 ", "passes 0 "),
            OUTPUT.replace("bench idle", "bench known"),
        ):
            with self.assertRaisesRegex(ToolError, "of the kind idle"):
                self.figures(output)

    def test_a_kind_that_no_figure_is_of(self) -> None:
        with self.assertRaisesRegex(ToolError, r"budget\.toml: figures: motor: is counted, but"):
            self.figures(OUTPUT.replace("rotor", "motor"))

    def test_an_image_that_did_not_end_well(self) -> None:
        with self.assertRaisesRegex(ToolError, "bench failed"):
            self.figures(OUTPUT.replace("bench ended", "bench failed"))


class Budgets(Budgeted):
    """The budget file, and what is above it."""

    def test_the_tolerance_is_five_percent(self) -> None:
        self.assertAlmostEqual(self.budget.limit("rotor"), 121.8)

    def test_steps_are_those_that_a_host_build_counts(self) -> None:
        self.assertEqual([*self.budget.steps], ["rotor"])

    def test_nothing_is_above_its_budget(self) -> None:
        self.assertEqual(self.budget.exceeded(FIGURES), [])

    def test_up_to_the_tolerance_is_good(self) -> None:
        just = {**FIGURES, "rotor": Kind(10, 1218, 122)}  # 121.8 = 116 * 1.05
        above = {**FIGURES, "rotor": Kind(10, 1219, 122)}
        self.assertEqual(self.budget.exceeded(just), [])
        self.assertEqual(self.budget.exceeded(above), ["rotor step 121.9 > 121.8"])

    def test_files_that_are_refused(self) -> None:
        for old, new, reason in (
            ("budget = 116 ", "budget = 0 ", "toml:8: figures: rotor: budget: expected to be gr"),
            ("budget = 116 ", "budget = 'little' ", "valid number, found 'little'"),
            (", budget = 116 ", "", "budget.toml:8: figures: rotor: budget: is missing"),
            ("goal = 110, ", "", "budget.toml:8: figures: rotor: goal: is missing"),
            ("goal = 110, ", "gaol = 110, ", "gaol: unknown key; did you mean goal?"),
            ("keel_rotor_step", "rotor_step", "rotor: step: expected to match"),
            ("goal = 110, ", 'goal = 110, of = ["a"], ', "rotor: of: a step is counted under"),
            ("no_task = {", "nothing = {", "budget.toml:4: figures: no_task: is missing"),
            ("tolerance_percent = 5\n", "", "tolerance_percent: is missing"),
            ("[figures]", "[figures", "budget.toml:4: no TOML"),
        ):
            with self.subTest(new), self.assertRaises(ToolError) as caught:
                self.assertIn(old, GOOD)
                self.read(GOOD.replace(old, new))
            self.assertIn(reason, str(caught.exception))

    def test_accepting_writes_the_figures_and_keeps_the_rest(self) -> None:
        budgets.accept({**FIGURES, "rotor": Kind(3, 400, 200)}, self.file)
        expected = GOOD.replace("125 }", "125.0 }").replace("600 }", "600.0 }")
        expected = expected.replace("budget = 116 }", "budget = 133.3 }")
        self.assertEqual(
            self.file.read_text(), expected.replace("budget = 110 }", "budget = 100.0 }")
        )

    def test_a_figure_that_no_line_has_is_not_accepted(self) -> None:
        self.file.write_text(GOOD.replace(ROTOR, ROTOR.replace("{ ", "{")))
        with self.assertRaisesRegex(ToolError, "0 lines `rotor = "):
            budgets.accept(FIGURES, self.file)


class Report(Budgeted):
    """The whole command, but for what is measured."""

    HOST = Measured(
        {bench.GOAL_SET: {name: Kind(2, 67) for name in KINDS}},
        Target({}, {}, {"task": 40}),
        {"rotor": Kind(10, 905)},
        [Goal("text", 1, 2)],
    )

    def judge(self, counted: dict[str, Kind] | Exception, *arguments: str) -> int:
        self.report = self.file.with_name("report.json")
        self.report.write_text("{}")
        self.said = io.StringIO()
        effect = "side_effect" if isinstance(counted, Exception) else "return_value"
        with (
            contextlib.redirect_stdout(self.said),
            contextlib.redirect_stderr(self.said),
            mock.patch.object(bench, "measure_host", return_value=self.HOST),
            mock.patch.object(bench, "print_host"),
            mock.patch.object(emulated, "measure", **{effect: counted}),
            mock.patch.object(bench, "read_budget", lambda: self.read(self.file.read_text())),
            mock.patch.object(bench, "accept", lambda of: budgets.accept(of, self.file)),
            mock.patch.object(bench, "REPORT", self.report),
            mock.patch.object(Toolchain, "ensure"),
            mock.patch.object(Toolchain, "versions", return_value={"qemu": mock.Mock(version="7")}),
        ):
            return bench.main(arguments)

    def test_figures_stand_beside_the_hosts(self) -> None:
        self.assertEqual(self.judge(FIGURES), 0)
        report = json.loads(self.report.read_text())
        rotor = report["cortex_m7"]["figures"]["rotor"]
        self.assertEqual((rotor["mean"], rotor["budget"], rotor["goal"]), (116.0, 116, 110))
        self.assertEqual(report["steps"]["rotor"]["mean"], 90.5)
        self.assertEqual(report["sets"]["21"]["no_task"]["mean"], 33.5)
        self.assertEqual(report["verdict"], "good")
        for line in (
            r"pass, no task +33\.5 +125\.0 \( +700\) +125\.0   130 met\n",
            r"rotor step +90\.5 +116\.0 \( +122\) +116\.0   110 MISSED\n",
            r"task: adc +- +100\.0 \( +120\) +110\.0   -\n",
        ):
            self.assertRegex(self.said.getvalue(), line)

    def test_what_is_over_its_budget_fails(self) -> None:
        self.assertEqual(self.judge({**FIGURES, "rotor": Kind(1000, 140000, 140)}), 1)
        over = ["rotor step 140.0 > 121.8"]
        report = json.loads(self.report.read_text())
        self.assertEqual((report["cortex_m7"]["over_budget"], report["verdict"]), (over, "failed"))
        self.assertIn(f"over the budget of bench/budget.toml: {over[0]}.", self.said.getvalue())

    def test_what_is_accepted_is_the_budget(self) -> None:
        self.assertEqual(self.judge({**FIGURES, "rotor": Kind(10, 1400, 140)}, "--accept"), 0)
        self.assertIn("budget = 140.0 }", self.file.read_text())

    def test_an_error_leaves_no_report(self) -> None:
        self.assertEqual(self.judge(ToolError("broken")), 2)
        self.assertFalse(self.report.exists())
