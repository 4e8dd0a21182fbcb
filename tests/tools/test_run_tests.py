#!/usr/bin/env python3
"""Tests of tools/run_tests.py: failures, crashes, hangs and empty suites are told as such.

    python3 tests/tools/test_run_tests.py
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import run_tests  # noqa: E402
from run_tests import (  # noqa: E402
    Bench,
    BuildError,
    Ended,
    Outcome,
    Suite,
    program_outcome,
    pytest_outcome,
    python_outcome,
    reference_outcome,
    run,
    unity_outcome,
)
from toolchain import Toolchain  # noqa: E402

PASSED = "t.c:1:QUE_001_a:PASS\n"
FAILED = "t.c:9:QUE_002_b:FAIL: Expected 1 Was 2\n"
PYTHON_TRACE = """F.
======================================================================
FAIL: test_x (test_y.Y.test_x)
What it is about.
----------------------------------------------------------------------
Traceback (most recent call last):
  File "/somewhere/tests/tools/test_y.py", line 7, in test_x
    self.assertEqual(1, 2)
AssertionError: 1 != 2

----------------------------------------------------------------------
Ran 2 tests in 0.001s

FAILED (failures=1)
"""


def python(code: str) -> list[str]:
    """A program of one line of Python."""
    return [sys.executable, "-c", code]


class Programs(unittest.TestCase):
    """How a program ends."""

    def test_exit_status_and_output(self) -> None:
        ended = run(python("import sys; print('out'); sys.stderr.write('err'); sys.exit(3)"))
        self.assertEqual((ended.status, ended.timed_out), (3, False))
        self.assertEqual(sorted(ended.output.split()), ["err", "out"])
        self.assertEqual(ended.how, "exit status 3")

    def test_a_crash_is_named(self) -> None:
        ended = run(python("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)"))
        self.assertEqual(ended.how, "crashed: SIGSEGV")
        self.assertEqual(len(program_outcome("p", ended).failures), 1)

    def test_a_hang_is_ended_with_its_children(self) -> None:
        code = "import subprocess; print('so far', flush=True); subprocess.run(['sleep', '60'])"
        ended = run(python(code), timeout_s=1.0)
        self.assertTrue(ended.timed_out)
        self.assertIn("hung", ended.how)
        self.assertIn("so far", ended.output)
        self.assertIn("hung", program_outcome("p", ended).failures[0])

    def test_a_sanitizer_s_words_are_the_evidence(self) -> None:
        noise = "noise\n" * 50
        ended = Ended(1, f"{noise}a.c:5:3: runtime error: overflow\nstack\n")
        self.assertTrue(ended.evidence.startswith("a.c:5:3: runtime error: overflow"))


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
            "#include <Eigen/Dense>\n#include \"reference.hpp\"\n"
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
                Bench(tools), "reference/known", str(folder / "known.cpp")
            )
        self.assertEqual(outcome.tests, {"norm": "passed", "off": "failed", "nan": "failed"})
        self.assertEqual(len(outcome.failures), 2)


class Python(unittest.TestCase):
    """What unittest wrote."""

    def test_all_pass(self) -> None:
        outcome = python_outcome("tools/y", Ended(0, "..\nRan 2 tests in 0.0s\n\nOK\n"))
        self.assertEqual((outcome.passed, outcome.failures), (2, []))

    def test_a_failure_has_its_place(self) -> None:
        outcome = python_outcome("tools/y", Ended(1, PYTHON_TRACE))
        self.assertEqual(outcome.passed, 1)
        place = "/somewhere/tests/tools/test_y.py:7: test_x (test_y.Y.test_x)"
        self.assertEqual(outcome.failures, [f"{place}: AssertionError: 1 != 2"])

    def test_skipped_tests_are_not_passed(self) -> None:
        outcome = python_outcome("tools/y", Ended(0, "Ran 3 tests in 0s\n\nOK (skipped=2)\n"))
        self.assertEqual((outcome.passed, outcome.failures), (1, []))

    def test_no_test_is_a_failure(self) -> None:
        outcome = python_outcome("tools/y", Ended(0, "Ran 0 tests in 0.0s\n\nOK\n"))
        self.assertEqual(len(outcome.failures), 1)

    def test_a_crash_is_a_failure(self) -> None:
        outcome = python_outcome("tools/y", Ended(-9, ".."))
        self.assertIn("SIGKILL", outcome.failures[0])


class Pytest(unittest.TestCase):
    """What pytest reported."""

    def outcome(self, cases: str, status: int) -> Outcome:
        """The outcome of a report with these cases."""
        folder = self.enterContext(tempfile.TemporaryDirectory())
        report = Path(folder) / "report.xml"
        report.write_text(f"<testsuites><testsuite>{cases}</testsuite></testsuites>")
        return pytest_outcome("timing/y", report, Ended(status, ""))

    def test_all_pass(self) -> None:
        outcome = self.outcome('<testcase classname="t" name="a"/>', 0)
        self.assertEqual((outcome.passed, outcome.failures), (1, []))

    def test_failures_and_skipped_tests_are_named(self) -> None:
        outcome = self.outcome(
            '<testcase classname="t" name="a"><failure message="1 is 2"/></testcase>'
            '<testcase classname="t" name="b"><skipped message="later"/></testcase>', 1,
        )  # fmt: skip
        self.assertEqual(outcome.failures, ["t.a: failure: 1 is 2", "t.b: skipped: later"])

    def test_no_report_and_a_status_that_does_not_fit_are_failures(self) -> None:
        missing = pytest_outcome("timing/y", Path("nowhere.xml"), Ended(2, "usage"))
        self.assertIn("timing/y: exit status 2", missing.failures[0])
        crashed = self.outcome('<testcase classname="t" name="a"/>', -11)
        self.assertIn("SIGSEGV", crashed.failures[0])


class Everything(unittest.TestCase):
    """The whole run: totals, report, exit status."""

    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        self.enterContext(mock.patch.object(run_tests, "ROOT", self.folder))

    def main(self, suites: dict[str, object], *arguments: str) -> tuple[int, str]:
        """Run suites that end in an outcome, or an error."""

        def suite(name: str, result: object) -> Suite:
            def act(bench: Bench) -> Outcome:
                del bench
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

    def test_totals_and_report(self) -> None:
        status, output = self.main({"a": self.outcome(2), "b": self.outcome(1, 1)})
        self.assertEqual(status, 1)
        self.assertTrue(output.endswith("3 passed, 1 failed\n"))
        self.assertIn("t.c:0: bad0: it failed", output)
        report = json.loads((self.folder / run_tests.REPORT).read_text())
        self.assertEqual((report["passed"], report["failed"]), (3, 1))
        self.assertEqual(report["suites"]["b"]["tests"], {"good0": "passed", "bad0": "failed"})

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
        self.assertEqual(status, 1)
        self.assertTrue(output.endswith("0 passed, 0 failed\n"))

    def test_a_filter_chooses(self) -> None:
        status, output = self.main(
            {"unit/a": self.outcome(1), "tools/b": self.outcome(0, 1)}, "--filter", "unit"
        )
        self.assertEqual(status, 0)
        self.assertNotIn("tools/b", output)


if __name__ == "__main__":
    unittest.main()
