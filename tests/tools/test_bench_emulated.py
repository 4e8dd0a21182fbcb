# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel/bench/emulated.py: what it reads, and when a budget is exceeded. That an
instruction is counted as one is checked by the image itself, against assembly of known length.
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
from keel.bench import emulated
from keel.bench.emulated import Budget, Figure
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

OUTPUT = """\
bench known passes 3 instructions 16 longest 10
bench waited passes 10 instructions 300 longest 31
bench idle passes 2 instructions 1200 longest 700
bench realtime passes 4 instructions 2000 longest 532
bench other passes 1 instructions 1000 longest 1000
bench several passes 30 instructions 45000 longest 1700
bench four passes 2 instructions 5800 longest 2909
bench filter passes 1000 instructions 35000 longest 35
bench pid passes 1000 instructions 116000 longest 116
bench reference passes 1000 instructions 178000 longest 183
bench mixer passes 1000 instructions 199000 longest 199
bench mixer_worst passes 1000 instructions 410500 longest 428
bench mode passes 1000 instructions 241000 longest 241
bench mode_worst passes 1000 instructions 464000 longest 464
bench attitude passes 1000 instructions 392900 longest 412
bench altitude passes 1000 instructions 220000 longest 220
bench position passes 1000 instructions 441000 longest 441
bench cascade passes 1000 instructions 2851400 longest 2899
bench battery passes 1000 instructions 372000 longest 372
bench calibration passes 1000 instructions 71000 longest 71
bench sbus passes 1000 instructions 54400 longest 621
bench sbus_worst passes 1000 instructions 152000 longest 152
bench ms5611 passes 1000 instructions 250000 longest 260
bench ubx passes 1000 instructions 110000 longest 400
bench mavlink passes 1000 instructions 120000 longest 700
bench signing passes 1000 instructions 3000000 longest 3000
bench log_ring passes 1000 instructions 830000 longest 840
bench ulog passes 1000 instructions 610000 longest 610
bench trace passes 1000 instructions 280000 longest 290
bench lateness passes 1000 instructions 90000 longest 95
bench table_line passes 1000 instructions 1500000 longest 1600
bench spread passes 1 instructions 70000 longest 70000
bench crsf passes 1000 instructions 130000 longest 2900
bench ibus passes 1000 instructions 120000 longest 2700
bench ppm passes 1000 instructions 90000 longest 500
bench imu passes 1000 instructions 1456300 longest 1509
bench imu_worst passes 1000 instructions 4035011 longest 4046
bench ended
"""
TASKS = [f"task_{name}" for name in emulated.TASKS]
FIGURES = {
    "no_task": Figure(12, 1500, 700),
    "one_task": Figure(5, 3000, 1000),
    "several_tasks": Figure(30, 45000, 1700),
    "four_tasks": Figure(2, 5800, 2909),
    "imu": Figure(1000, 1456300, 1509),
    "imu_worst": Figure(1000, 4035011, 4046),
    "filter": Figure(1000, 35000, 35),
    "pid": Figure(1000, 116000, 116),
    "reference": Figure(1000, 178000, 183),
    "mixer": Figure(1000, 199000, 199),
    "mixer_worst": Figure(1000, 410500, 428),
    "mode": Figure(1000, 241000, 241),
    "mode_worst": Figure(1000, 464000, 464),
    "attitude": Figure(1000, 392900, 412),
    "altitude": Figure(1000, 220000, 220),
    "position": Figure(1000, 441000, 441),
    "cascade": Figure(1000, 2851400, 2899),
    "battery": Figure(1000, 372000, 372),
    "calibration": Figure(1000, 71000, 71),
    "sbus": Figure(1000, 54400, 621),
    "sbus_worst": Figure(1000, 152000, 152),
    "ms5611": Figure(1000, 250000, 260),
    "ubx": Figure(1000, 110000, 400),
    "mavlink": Figure(1000, 120000, 700),
    "signing": Figure(1000, 3000000, 3000),
    "log_ring": Figure(1000, 830000, 840),
    "ulog": Figure(1000, 610000, 610),
    "trace": Figure(1000, 280000, 290),
    "lateness": Figure(1000, 90000, 95),
    "table_line": Figure(1000, 1500000, 1600),
    "spread": Figure(1, 70000, 70000),
    "crsf": Figure(1000, 130000, 2900),
    "ibus": Figure(1000, 120000, 2700),
    "ppm": Figure(1000, 90000, 500),
    **{name: Figure(50, 5000, 120) for name in TASKS},
}
GOOD = """\
# About the budget.
tolerance_percent = 5

[instructions]
no_task = 125
one_task = 600
several_tasks = 1500
four_tasks = 2900
imu = 1457
imu_worst = 4036
filter = 35
pid = 116
reference = 178
mixer = 199
mixer_worst = 410.5
mode = 241
mode_worst = 464
attitude = 392.9
altitude = 220.0
position = 441.0
battery = 372.0
sbus = 54.4
sbus_worst = 152.0
ms5611 = 250.0
ubx = 110.0
mavlink = 120.0
signing = 3000.0
log_ring = 830.0
ulog = 610.0
trace = 280.0
lateness = 90.0
table_line = 1500.0
spread = 70000.0
crsf = 130.0
ibus = 120.0
ppm = 90.0
cascade = 2851.4
calibration = 71.0
""" + "".join(f"{name} = 100\n" for name in TASKS)


class Reading(unittest.TestCase):
    """What the image prints."""

    def test_the_kinds_of_a_figure_are_taken_together(self) -> None:
        kinds = emulated.read_figures(OUTPUT)
        self.assertEqual(emulated.together(kinds, ("waited", "idle")), FIGURES["no_task"])
        self.assertEqual(FIGURES["no_task"].mean, 125.0)

    def test_a_kind_without_passes(self) -> None:
        kinds = emulated.read_figures(OUTPUT.replace("passes 2 ", "passes 0 "))
        with self.assertRaisesRegex(ToolError, "of the kind idle"):
            emulated.together(kinds, ("waited", "idle"))

    def test_an_image_that_did_not_end_well(self) -> None:
        with self.assertRaisesRegex(ToolError, "bench failed"):
            emulated.read_figures(OUTPUT.replace("bench ended", "bench failed"))


class Budgets(unittest.TestCase):
    """The budget file, and what is above it."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.file = Path(temporary.name) / "budget.toml"

    def read(self, text: str) -> Budget:
        self.file.write_text(text)
        return emulated.read_budget(self.file)

    def test_the_tolerance_is_five_percent(self) -> None:
        self.assertAlmostEqual(self.read(GOOD).limit("filter"), 36.75)

    def test_nothing_is_above_its_budget(self) -> None:
        self.assertEqual(emulated.exceeded(FIGURES, self.read(GOOD)), [])

    def test_up_to_the_tolerance_is_good(self) -> None:
        budget = self.read(GOOD)
        just = {**FIGURES, "pid": Figure(10, 1218, 122)}  # 121.8 = 116 * 1.05
        above = {**FIGURES, "pid": Figure(10, 1219, 122)}
        self.assertEqual(emulated.exceeded(just, budget), [])
        self.assertEqual(
            emulated.exceeded(above, budget), ["PID step, its filter included 121.9 > 121.8"]
        )

    def test_files_that_are_refused(self) -> None:
        for old, new, reason in (
            ("pid = 116\n", "", "budget.toml:4: instructions: pid: is missing"),
            (
                "pid = 116\n",
                "pid = 116\nrotor = 3\n",
                "budget.toml:13: instructions: rotor: is no figure",
            ),
            (
                "pid = 116\n",
                "pid = 0\n",
                "toml:12: instructions: pid: expected to be greater than 0",
            ),
            ("pid = 116\n", "pid = 'little'\n", "expected to be a valid number, found 'little'"),
            ("tolerance_percent = 5\n", "", "tolerance_percent: is missing"),
            ("[instructions]", "[instructions", "budget.toml:4: no TOML"),
        ):
            with self.assertRaises(ToolError) as caught:
                self.read(GOOD.replace(old, new))
            self.assertIn(reason, str(caught.exception))

    def test_accepting_writes_the_figures_and_keeps_the_rest(self) -> None:
        self.file.write_text(GOOD)
        emulated.accept(self.file, FIGURES)
        self.assertTrue(self.file.read_text().startswith("# About the budget.\n"))
        budget = emulated.read_budget(self.file)
        self.assertEqual(
            budget.instructions,
            {
                "no_task": 125.0,
                "one_task": 600.0,
                "several_tasks": 1500.0,
                "four_tasks": 2900.0,
                "imu": 1456.3,
                "imu_worst": 4035.0,
                "filter": 35.0,
                "pid": 116.0,
                "reference": 178.0,
                "mixer": 199.0,
                "mixer_worst": 410.5,
                "mode": 241.0,
                "mode_worst": 464.0,
                "attitude": 392.9,
                "altitude": 220.0,
                "position": 441.0,
                "battery": 372.0,
                "calibration": 71.0,
                "sbus": 54.4,
                "sbus_worst": 152.0,
                "ms5611": 250.0,
                "ubx": 110.0,
                "mavlink": 120.0,
                "signing": 3000.0,
                "log_ring": 830.0,
                "ulog": 610.0,
                "trace": 280.0,
                "lateness": 90.0,
                "table_line": 1500.0,
                "spread": 70000.0,
                "crsf": 130.0,
                "ibus": 120.0,
                "ppm": 90.0,
                "cascade": 2851.4,
                **dict.fromkeys(TASKS, 100.0),
            },
        )


class Report(Budgets):
    """The target's part of the report."""

    def add(self, figures: dict[str, Figure] | Exception) -> list[str]:
        self.report = self.file.with_name("report.json")
        host = {"verdict": "failed", "sets": {"21": {"no_task": {"mean": 33.5}}}}
        self.report.write_text(json.dumps(host))
        self.file.write_text(GOOD)
        effect = (
            {"side_effect": figures}
            if isinstance(figures, Exception)
            else {"return_value": figures}
        )
        self.said = io.StringIO()
        with (
            contextlib.redirect_stdout(self.said),
            mock.patch.object(emulated, "measure", **effect),
            mock.patch.object(emulated, "BUDGET", self.file),
        ):
            tools = Toolchain()
            tools.ensure("target", say=lambda _: None)
            return emulated.add(tools, self.report)

    def test_figures_join_the_hosts(self) -> None:
        self.assertEqual(self.add(FIGURES), [])
        report = json.loads(self.report.read_text())
        self.assertEqual(report["cortex_m7"]["figures"]["filter"]["mean"], 35.0)
        self.assertEqual(report["sets"]["21"]["no_task"]["mean"], 33.5)
        self.assertEqual(report["verdict"], "good")
        self.assertRegex(self.said.getvalue(), r"pass, no task +33\.5 +125\.0 \( +700\) +125\.0")

    def test_what_is_over_its_budget_is_told(self) -> None:
        over = self.add({**FIGURES, "filter": Figure(1000, 40000, 40)})
        self.assertEqual(over, ["filter step 40.0 > 36.8"])
        report = json.loads(self.report.read_text())
        self.assertEqual((report["cortex_m7"]["over_budget"], report["verdict"]), (over, "failed"))

    def test_an_error_leaves_no_report(self) -> None:
        with self.assertRaisesRegex(ToolError, "broken"):
            self.add(ToolError("broken"))
        self.assertFalse(self.report.exists())
