# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel test: failures, crashes, hangs and empty suites are told as such."""

from __future__ import annotations

import contextlib
import errno
import io
import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock
from xml.etree import ElementTree

from keel.base.build import BuildError
from keel.base.run import Ended, run
from keel.base.source import STAMP, VERDICT, stamp_of
from keel.install import Toolchain
from keel.test import command as run_tests
from keel.test import suites as running
from keel.test.command import BUILD, HostBuilds
from keel.test.outcomes import (
    Outcome,
    program_outcome,
    pytest_outcome,
    reference_outcome,
    unity_outcome,
)
from keel.test.suites import Suite

ROOT = Path(__file__).resolve().parents[2]

PASSED = "t.c:1:QUE_001_a:PASS\n"
FAILED = "t.c:9:QUE_002_b:FAIL: Expected 1 Was 2\n"


def python(code: str) -> list[str]:
    """A program of one line of Python."""
    return [sys.executable, "-c", code]


class Programs(unittest.TestCase):
    """How a program ends."""

    def test_a_crash_is_named(self) -> None:
        ended = run(python("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)"))
        self.assertEqual(ended.how, "crashed: SIGSEGV")
        self.assertEqual(len(program_outcome("p", ended).failures), 1)

    def test_a_hang_is_ended_with_its_children(self) -> None:
        code = "import subprocess; print('so far', flush=True); subprocess.run(['sleep', '600'])"
        ended = run(python(code), timeout_s=5.0)
        self.assertTrue(ended.timed_out)
        self.assertIn("hung", ended.how)
        self.assertIn("so far", ended.output)
        self.assertIn("hung", program_outcome("p", ended).failures[0])


class Unity(unittest.TestCase):
    """What a Unity program wrote."""

    def test_all_pass(self) -> None:
        outcome = unity_outcome("unit/t", Ended(0, PASSED + "1 Tests 0 Failures 0 Ignored\nOK\n"))
        self.assertEqual((outcome.passed, outcome.failures), (1, []))
        self.assertEqual(outcome.tests, {"QUE_001_a": "passed"})

    def test_a_failure_has_its_place(self) -> None:
        text = PASSED + FAILED + "2 Tests 1 Failures 0 Ignored\nFAIL\n"
        outcome = unity_outcome("unit/t", Ended(1, text))
        self.assertEqual(outcome.passed, 1)
        self.assertEqual(outcome.failures, ["t.c:9: QUE_002_b: Expected 1 Was 2"])

    def test_an_ignored_test_is_a_failure(self) -> None:
        text = "t.c:3:QUE_003_c:IGNORE\n1 Tests 0 Failures 1 Ignored\nOK\n"
        outcome = unity_outcome("unit/t", Ended(0, text))
        self.assertEqual(outcome.passed, 0)
        self.assertIn("t.c:3: QUE_003_c: IGNORE", outcome.failures)

    def test_a_crash_counts_though_tests_passed(self) -> None:
        outcome = unity_outcome("unit/t", Ended(-11, PASSED))
        self.assertEqual(outcome.passed, 1)
        self.assertIn("crashed: SIGSEGV, after QUE_001_a", outcome.failures[0])

    def test_a_bad_exit_status_counts_though_all_passed(self) -> None:
        outcome = unity_outcome("unit/t", Ended(1, PASSED + "1 Tests 0 Failures 0 Ignored\nOK\n"))
        self.assertEqual(len(outcome.failures), 1)

    def test_lost_tests_count(self) -> None:
        outcome = unity_outcome("unit/t", Ended(0, PASSED + "2 Tests 0 Failures 0 Ignored\nOK\n"))
        self.assertEqual(len(outcome.failures), 1)


class Reference(unittest.TestCase):
    """What a C++ reference program wrote, and that one is built with Eigen and the kernel."""

    def outcome(self, status: int, text: str) -> Outcome:
        return reference_outcome("reference/x", "x.cpp", Ended(status, text))

    def test_all_pass_among_other_lines(self) -> None:
        outcome = self.outcome(0, "a table\nPASS FLT_001_a\nPASS FLT_002_b\n2 passed, 0 failed\n")
        self.assertEqual((outcome.passed, outcome.failures), (2, []))
        self.assertEqual(outcome.tests, {"FLT_001_a": "passed", "FLT_002_b": "passed"})

    def test_a_failure_says_why(self) -> None:
        outcome = self.outcome(1, "PASS a\nFAIL b: 2 > 1\n1 passed, 1 failed\n")
        self.assertEqual((outcome.passed, outcome.failures), (1, ["x.cpp: b: 2 > 1"]))

    def test_a_crash_counts_though_tests_passed(self) -> None:
        outcome = self.outcome(-11, "PASS a\n")
        self.assertEqual(outcome.passed, 1)
        self.assertIn("crashed: SIGSEGV, after a", outcome.failures[0])

    def test_totals_that_do_not_fit_count(self) -> None:
        for status, text in (
            (0, "PASS a\n2 passed, 0 failed\n"),
            (0, "PASS a\n1 passed, 0 failed\nmore\n"),
            (0, "PASS a\nPASS a\n2 passed, 0 failed\n"),
            (0, "FAIL a: x\n0 passed, 1 failed\n"),
            (1, "PASS a\n1 passed, 0 failed\n"),
        ):
            with self.subTest(text):
                self.assertIn("reference/x", self.outcome(status, text).failures[-1])

    def test_a_program_is_built_with_eigen_and_the_kernel(self) -> None:
        code = (
            '#include <Eigen/Dense>\n#include "reference.hpp"\n'
            'extern "C" {\n#include "keel/rtos/load.h"\n}\n'
            "int main()\n{\n    keel_load_t load{};\n    reference::Suite suite;\n"
            "    keel_load_begin(&load, 3u, 4u);\n"
            "    const Eigen::Vector2d both(double(load.start_us), double(load.busy_us));\n"
            '    suite.within("norm", both.norm(), 5.0, 1e-15);\n'
            '    suite.within("off", 1.0, 2.0, 0.5);\n'
            '    suite.within("nan", both.norm() * NAN, 0.0, 1.0);\n'
            "    return suite.end();\n}\n"
        )
        tools = Toolchain()
        tools.ensure("test", say=lambda _: None)
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        (folder / "known.cpp").write_text(code)
        with mock.patch.object(run_tests, "BUILD", folder):
            outcome = run_tests.reference_suite(
                HostBuilds(tools), "reference/known", str(folder / "known.cpp")
            )
        self.assertEqual(outcome.tests, {"norm": "passed", "off": "failed", "nan": "failed"})
        self.assertEqual(len(outcome.failures), 2)


class Pytest(unittest.TestCase):
    """What pytest reported."""

    def outcome(self, cases: str, status: int, may_skip: bool = False) -> Outcome:
        """The outcome of a report with these cases."""
        folder = self.enterContext(tempfile.TemporaryDirectory())
        report = Path(folder) / "report.xml"
        report.write_text(f"<testsuites><testsuite>{cases}</testsuite></testsuites>")
        return pytest_outcome("timing/y", report, Ended(status, "so far\n"), may_skip)

    def test_all_pass(self) -> None:
        outcome = self.outcome('<testcase classname="t" name="a"/>', 0)
        self.assertEqual((outcome.passed, outcome.failures), (1, []))
        self.assertEqual(outcome.tests, {"t.a": "passed"})

    def test_failures_and_skipped_tests_are_named(self) -> None:
        cases = (
            '<testcase classname="t" name="a"><failure message="1 is 2">    f()\n'
            "tests/test_y.py:7: in test_a\n    g()\ntools/y.py:9: AssertionError</failure>"
            '</testcase><testcase classname="t" name="b"><skipped message="later"/></testcase>'
        )
        outcome = self.outcome(cases, 1)
        self.assertEqual(
            outcome.failures, ["tests/test_y.py:7: t.a: failure: 1 is 2", "t.b: skipped: later"]
        )
        skipping = self.outcome(cases, 1, may_skip=True)
        self.assertEqual(skipping.tests, {"t.a": "failed"})
        self.assertEqual(skipping.as_dict()["skipped"], {"t.b": "later"})

    def test_no_report_no_test_and_a_status_that_does_not_fit_are_failures(self) -> None:
        missing = pytest_outcome("timing/y", Path("nowhere.xml"), Ended(2, "usage"))
        self.assertIn("timing/y: exit status 2", missing.failures[0])
        crashed = self.outcome('<testcase classname="t" name="a"/>', -11)
        self.assertIn("SIGSEGV", crashed.failures[0])
        skipped = '<testcase classname="t" name="a"><skipped message="x"/></testcase>'
        self.assertEqual(len(self.outcome(skipped, 0, may_skip=True).failures), 1)

    def test_a_hang_is_a_failure(self) -> None:
        hung = pytest_outcome("tools/y", Path("nowhere.xml"), Ended(-9, "..", timed_out=True))
        self.assertIn("hung", hung.failures[0])

    def test_a_real_run_is_read(self) -> None:
        """A file of unittest tests: one good, one bad, one with a bad sub-test, one skipped."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        source = folder / "test_real.py"
        source.write_text(
            "import unittest\nclass T(unittest.TestCase):\n"
            "    def test_a(self):\n        print('x')\n"
            "    def test_b(self):\n        self.assertEqual(1, 2)\n"
            "    def test_c(self):\n"
            "        with self.subTest('s'):\n            self.assertEqual(3, 4)\n"
            "    @unittest.skip('later')\n    def test_d(self):\n        pass\n"
        )
        Toolchain().ensure("tools-tests", say=lambda _: None)
        with mock.patch.object(run_tests, "BUILD", folder):
            outcome = run_tests.python_suite("tools/real", source, "tools-tests", may_skip=True)
        self.assertEqual(outcome.passed, 1)
        self.assertTrue(
            any(
                "test_real.T.test_b: failure: AssertionError: 1 != 2" in text
                for text in outcome.failures
            ),
            outcome.failures,
        )
        self.assertIn("/test_real.py:6: ", "".join(outcome.failures))
        self.assertTrue(any("3 != 4" in text for text in outcome.failures), outcome.failures)


class Everything(unittest.TestCase):
    """The whole run: totals, report, exit status."""

    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        self.enterContext(mock.patch.object(run_tests, "ROOT", self.folder))

    def main(self, suites: dict[str, object], *arguments: str) -> tuple[int, str]:
        """Run suites that end in an outcome, or an error."""

        def suite(name: str, result: object) -> Suite:
            def act() -> Outcome:
                if isinstance(result, Exception):
                    raise result
                assert isinstance(result, Outcome)
                return result

            return Suite(name, (), act)

        made = [suite(name, result) for name, result in suites.items()]
        output = io.StringIO()
        with (
            mock.patch.object(run_tests, "all_suites", return_value=made),
            contextlib.redirect_stdout(output),
            contextlib.redirect_stderr(output),
        ):
            status = run_tests.main(list(arguments))
        return status, output.getvalue()

    def outcome(self, good: int, bad: int = 0) -> Outcome:
        """An outcome with so many tests."""
        outcome = Outcome()
        for i in range(good):
            outcome.add(f"good{i}")
        for i in range(bad):
            outcome.add(f"bad{i}", f"t.c:{i}: bad{i}: it failed")
        return outcome

    def test_a_run_of_some_suites_does_not_pass_for_all(self) -> None:
        for arguments, verdict in (((), "good"), (("--filter", "a"), "partial")):
            self.assertEqual(self.main({"a": self.outcome(2)}, *arguments)[0], 0)
            report = json.loads((self.folder / BUILD / running.REPORT).read_text())
            self.assertEqual(report[VERDICT], verdict)

    def test_totals_and_report(self) -> None:
        status, output = self.main({"a": self.outcome(2), "b": self.outcome(1, 1)})
        self.assertEqual(status, 1)
        self.assertTrue(output.endswith("3 passed, 1 failed\n"))
        self.assertIn("t.c:0: bad0: it failed", output)
        report = json.loads((self.folder / BUILD / running.REPORT).read_text())
        self.assertEqual((report["passed"], report["failed"]), (3, 1))
        self.assertEqual(report[VERDICT], "failed")
        self.assertEqual(report["suites"]["b"]["tests"], {"good0": "passed", "bad0": "failed"})
        self.assertEqual(report[STAMP], stamp_of())
        cases = {
            case.get("name"): [part.get("message") for part in case]
            for case in ElementTree.parse(self.folder / BUILD / running.JUNIT).iter("testcase")
        }
        self.assertEqual(cases, {"good0": [], "good1": [], "bad0": ["t.c:0: bad0: it failed"]})

    def test_all_pass(self) -> None:
        status, output = self.main({"a": self.outcome(2)})
        self.assertEqual(status, 0)
        self.assertTrue(output.endswith("2 passed, 0 failed\n"))

    def test_a_suite_without_tests_fails(self) -> None:
        status, output = self.main({"a": self.outcome(0), "b": self.outcome(1)})
        self.assertEqual(status, 1)
        self.assertIn("a: no test was run", output)

    def test_a_suite_that_does_not_build_fails(self) -> None:
        status, output = self.main({"a": BuildError("a.c:1:1: error: no")})
        self.assertEqual(status, 1)
        self.assertIn("a.c:1:1: error: no", output)

    def test_a_filter_that_fits_nothing_fails(self) -> None:
        status, output = self.main({"a": self.outcome(1)}, "--filter", "zzz")
        self.assertEqual(status, 2)
        self.assertEqual(output, "test: no suite's name contains 'zzz'\n")
        _, output = self.main({"unit/queue": self.outcome(1)}, "--filter", "unit/queu3")
        self.assertIn("did you mean unit/queue?", output)

    def test_a_report_that_cannot_be_written_is_one_line(self) -> None:
        full = OSError(errno.ENOSPC, "No space left on device")
        with mock.patch.object(Path, "write_bytes", side_effect=full):
            status, output = self.main({"a": self.outcome(1)})
        self.assertEqual(status, 2)
        self.assertRegex(output, r"\ntest: cannot write \S+junit\.xml: No space left on device\n$")

    def test_a_filter_chooses(self) -> None:
        status, output = self.main(
            {"unit/a": self.outcome(1), "tools/b": self.outcome(0, 1)}, "--filter", "unit"
        )
        self.assertEqual(status, 0)
        self.assertNotIn("tools/b", output)
