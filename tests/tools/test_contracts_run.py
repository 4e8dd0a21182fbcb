# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel contracts-run: a body that breaks its contract is seen, and what does not
run is told with a reason.
"""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
import unittest
from collections import Counter
from pathlib import Path
from typing import Any
from unittest import mock

from keel.base.errors import ToolError
from keel.base.run import Ended
from keel.base.source import VERDICT
from keel.config import parse_toml, read_toml
from keel.install import Toolchain
from keel.test import contracts_run
from keel.test.contracts_run import CHOICE, GROUPS, Choice, Run, Runner, ignored_in, mistakes
from keel.test.contracts_run import violation as violated

ROOT = Path(__file__).resolve().parents[2]

OWN = ROOT / "build/test/contracts_run"
SAID = """\
[e-acsl] beginning translation.
[e-acsl] src/rtos/load.c:9: Warning:
  E-ACSL construct `assigns clause in behavior' is not yet supported.
  Ignoring annotation.
[e-acsl] include/keel/x.h:105: Warning:
  E-ACSL construct
  `logic functions or predicates with no definition nor reads clause'
  is not yet supported.
[e-acsl] FRAMAC_SHARE/libc/a.h:261: Warning:
  E-ACSL construct `assigns clause in behavior' is not yet supported.
"""
BROKEN = """\
include/keel/x.h: In function 'keel_x'
include/keel/x.h:155: Error: Postcondition failed:
\tThe failing predicate is:
"""


class Words(unittest.TestCase):
    """What E-ACSL and its programs say."""

    def test_clauses_that_are_left_out(self) -> None:
        found = [(item["file"], item["line"], item["construct"]) for item in ignored_in(SAID)]
        self.assertEqual(
            found,
            [
                (
                    "include/keel/x.h",
                    105,
                    "logic functions or predicates with no definition nor reads clause",
                ),
                ("src/rtos/load.c", 9, "assigns clause in behavior"),
            ],
        )

    def test_a_violation_has_its_place(self) -> None:
        told = violated(Ended(-6, BROKEN))
        self.assertEqual(
            told, "include/keel/x.h:155: Error: Postcondition failed: The failing predicate is:"
        )

    def test_no_test_is_a_failure(self) -> None:
        whole = Run()
        whole.add("keel_x", Run(checks=Counter(Postcondition=1)))
        self.assertEqual(whole.failures, ["keel_x: no test ran"])


class Choosing(unittest.TestCase):
    """Every public function is named, once."""

    def refused(self, old: str, new: str) -> str:
        """What is said of the project's file with a change."""
        text = CHOICE.read_text()
        self.assertEqual(text.count(old), 1, old)
        with self.assertRaises(ToolError) as caught:
            parse_toml(text.replace(old, new), Choice, "x.toml", mistakes)
        return str(caught.exception)

    def test_the_project_s_choice(self) -> None:
        self.assertTrue(read_toml(CHOICE, Choice, mistakes).executed)

    def test_a_function_that_is_not_named(self) -> None:
        told = self.refused('    "keel_load_begin",\n', "")
        self.assertIn("nothing is said of keel_load_begin", told)

    def test_a_function_that_is_not_there(self) -> None:
        old = '    "keel_load_begin",\n'
        told = self.refused(old, f'{old}    "keel_gone",\n')
        self.assertIn("keel_gone is not of src/rtos/load.c, or twice", told)


class Running(unittest.TestCase):
    """A file of the kernel, whole and broken."""

    def run_one(self, name: str, old: str = "", new: str = "") -> Run:
        """Run the contract of keel_load_begin, with a change of the file."""
        tools = Toolchain()
        tools.ensure(*GROUPS, say=lambda _: None)
        runner = Runner(tools, OWN)
        place = OWN / name / "load.c"
        place.parent.mkdir(exist_ok=True)
        text = (ROOT / "src/rtos/load.c").read_text()
        self.assertTrue(not old or text.count(old) == 1)
        place.write_text(text.replace(old, new) if old else text)
        return runner.run_one(place.relative_to(ROOT).as_posix(), "keel_load_begin")

    def test_the_body_keeps_its_contract(self) -> None:
        found = self.run_one("tool-good")
        self.assertEqual((found.passed, found.failures), (4, []))
        self.assertGreater(found.checks["Postcondition"], 0)

    def test_a_body_that_breaks_its_contract(self) -> None:
        good = "load->start_us = now_us;"
        found = self.run_one("tool-bad", good, good.replace(";", " + 1u;"))
        self.assertEqual(len(found.failures), 1)
        where = r"^include/keel/internal/rtos/load\.h:\d+: Error: Postcondition failed"
        self.assertRegex(found.failures[0], where)


class Verdict(unittest.TestCase):
    """The exit status and the report tell the truth."""

    def judge(self, runs: dict[str, Run]) -> tuple[int, dict[str, Any]]:
        """Exit status and report."""
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / "report.json"
        choice = read_toml(CHOICE, Choice)
        with (
            mock.patch.object(contracts_run, "REPORT", path),
            contextlib.redirect_stdout(io.StringIO()),
        ):
            status = contracts_run.judge(runs, choice, {})
        report: dict[str, Any] = json.loads(path.read_text())
        self.assertEqual(report[VERDICT], "failed" if status else "good")
        return status, report

    def test_good(self) -> None:
        status, report = self.judge({"src/x.c": Run(["keel_x"], Counter(Postcondition=1), [], 3)})
        self.assertEqual(status, 0)
        self.assertEqual(report["units"]["src/x.c"]["checks"], {"Postcondition": 1})
        self.assertTrue(all(item["reason"] for item in report["left_out"]))

    def test_a_violation_and_an_empty_run_fail(self) -> None:
        self.assertEqual(self.judge({"src/x.c": Run(["keel_x"], failures=["broken"])})[0], 1)
        self.assertEqual(self.judge({})[0], 1)
