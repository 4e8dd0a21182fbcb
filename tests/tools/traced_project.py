# SPDX-License-Identifier: Apache-2.0
"""The small project of test_requirements_trace.py, with reports on its proofs and tests."""

from __future__ import annotations

import copy
import tempfile
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest import mock

from keel.install.packages import provide

provide("common")

import test_requirements_trace as small

from keel.base.files import write_json, write_text
from keel.gather.part import Context, Part

ROOT = Path(__file__).resolve().parents[2]

STAMP = {"commit": "c", "tree": "t", "product": "p"}
GOAL = {
    "name": "keel_widget_turn_ensures_WID_001_turns",
    "status": "Valid",
    "prover": "Qed",
    "target": "keel_widget_turn",
}
RANGE = {**GOAL, "name": "keel_widget_turn_ensures_WID_001_range"}
HARNESS = {
    "properties": 3,
    "proved": 3,
    "sound": True,
    "assertions": [
        {"name": "turn.assertion.1", "description": "WID_001_turns: it turns", "status": "SUCCESS"}
    ],
}
PROVE = {
    "verdict": "proved",
    "units": {
        "widget": {
            "wp": {"goal_list": [GOAL, RANGE], "not_by_wp": {}},
            "cbmc": {"harnesses": {"keel_widget_turn_harness": HARNESS}, "without_harness": {}},
            "gappa": {"goal_list": []},
        }
    },
}
TEST = {"suites": {"unit/widget": {"tests": {"it_loops": "passed"}}}}
REPORTS: dict[str, Any] = {
    "prove/report.json": PROVE,
    "test/report.json": TEST,
    "test-target/report.json": {"suites": {}},
}


class TracedProject(unittest.TestCase):
    """A project whose parts have no problem, to be broken in one place."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.reports = copy.deepcopy(REPORTS)
        # What StrictDoc and LOBSTER do is tested in test_tracing_tools.py.
        for place in ("requirements.written", "trace.second_look"):
            patch = mock.patch(f"keel.gather.parts.{place}", return_value={})
            patch.start()
            self.addCleanup(patch.stop)
        for name, text in small.FILES.items():
            self.write(name, text)

    def write(self, name: str, text: str) -> None:
        """Write a file of the project."""
        write_text(self.root / name, text)

    def change(self, name: str, old: str, new: str) -> None:
        """Replace a text that must be there."""
        self.assertIn(old, small.FILES[name])
        self.write(name, small.FILES[name].replace(old, new))

    @property
    def proofs(self) -> Any:
        """What the report says of the unit."""
        return self.reports["prove/report.json"]["units"]["widget"]

    def context(self) -> Context:
        """The project, with its reports as they are now."""
        build = self.root / "build"
        for name, report in self.reports.items():
            write_json(build / name, {"made_from": STAMP, **report})
        return Context(self.root, build, build / "work", STAMP)

    def part(self, make: Callable[[Context], Part]) -> Part:
        """The part, made from the project and its reports."""
        return make(self.context())

    def problems(self, make: Callable[[Context], Part]) -> list[str]:
        """What the part says is wrong."""
        return list(self.part(make).problems)
