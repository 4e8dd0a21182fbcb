# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel coverage: reading exports, finding gaps, excluding them. Nothing is built."""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

from keel.base.errors import ToolError
from keel.base.source import STAMP, VERDICT, stamp_of
from keel.test import coverage
from keel.test.coverage import (
    Exclusion,
    FileCoverage,
    Gap,
    apply,
    branch_counts,
    coverage_of,
    line_counts,
    mcdc_conditions,
    read_exclusions,
    share,
    spans_of,
    within,
)

ROOT = Path(__file__).resolve().parents[2]

TEXT = "#define LIMIT 3\nif (a && b) {\n    return 1;\n}\nreturn 0;\n"


def gap(line: int = 3, text: str = "return 1;") -> Gap:
    """A gap in a file."""
    return Gap("src/x.c", line, text, "line not executed")


def excluding(file: str) -> Exclusion:
    """An exclusion of a line of a file."""
    return Exclusion(file=file, line="return 1;", reason="why")


class Reading(unittest.TestCase):
    """Exports become counts."""

    def test_line_counts_of_several_files(self) -> None:
        lcov = "SF:/a.c\nFN:1,f\nDA:1,5\nDA:2,0\nend_of_record\nSF:/b.c\nDA:1,0\nend_of_record\n"
        self.assertEqual(line_counts(lcov), {"/a.c": {1: 5, 2: 0}, "/b.c": {1: 0}})

    def test_copies_of_an_inline_function_add_up(self) -> None:
        lcov = "SF:/a.h\nDA:1,0\nend_of_record\nSF:/a.h\nDA:1,2\nend_of_record\n"
        self.assertEqual(line_counts(lcov), {"/a.h": {1: 2}})
        rows = [[2, 5, 2, 9, 0, 1, 0, 0, 4], [2, 5, 2, 9, 3, 0, 0, 0, 4]]
        self.assertEqual(branch_counts(rows), {(2, 5): (3, 1)})
        decisions = [[2, 5, 2, 9, 0, 5, [True, False]], [2, 5, 2, 9, 0, 5, [False, False]]]
        self.assertEqual(mcdc_conditions(decisions), {(2, 5): [True, False]})

    def test_two_branches_on_a_line_stay_apart(self) -> None:
        rows = [[2, 5, 2, 6, 1, 0, 0, 0, 4], [2, 10, 2, 11, 0, 1, 0, 0, 4]]
        self.assertEqual(branch_counts(rows), {(2, 5): (1, 0), (2, 10): (0, 1)})


class Gaps(unittest.TestCase):
    """Whatever is not covered is a gap with its line."""

    def measure(self, lines: dict[int, int], a: int, shown: list[bool]) -> FileCoverage:
        """The coverage of TEXT; a: how often its first condition was true."""
        branches = [[2, 5, 2, 6, a, 4, 0, 0, 4], [2, 10, 2, 11, 1, 1, 0, 0, 4]]
        return coverage_of("src/x.c", TEXT, lines, branches, [[2, 5, 2, 11, 0, 5, shown]])

    def test_all_covered(self) -> None:
        found = self.measure({2: 5, 3: 1, 5: 4}, 1, [True, True])
        self.assertEqual((found.lines, found.branches, found.mcdc), ((3, 3), (4, 4), (2, 2)))
        self.assertEqual(found.gaps, [])

    def test_a_line(self) -> None:
        found = self.measure({2: 5, 3: 0, 5: 4}, 1, [True, True])
        self.assertEqual(found.lines, (2, 3))
        self.assertEqual(found.gaps, [gap()])

    def test_a_branch(self) -> None:
        found = self.measure({2: 5}, 0, [True, True])
        self.assertEqual(found.branches, (3, 4))
        what = "condition at column 5 is never true"
        self.assertEqual([item.what for item in found.gaps], [what])

    def test_a_condition(self) -> None:
        found = self.measure({2: 5}, 1, [True, False])
        self.assertEqual(found.mcdc, (1, 2))
        what = "decision at column 5: condition 2 never decides it alone"
        self.assertEqual([item.what for item in found.gaps], [what])

    def test_a_macro_is_no_line(self) -> None:
        self.assertEqual(self.measure({1: 7, 2: 5}, 1, [True, True]).lines, (1, 1))


class Functions(unittest.TestCase):
    """Each function is measured by its lines, whoever includes it."""

    def test_names_and_lines(self) -> None:
        functions = [
            {"name": "/src/x.c:small", "filenames": ["/src/x.c"], "regions": [[2, 1, 4, 2, 0]]},
            {"name": "b.c:keel_y", "filenames": ["/include/y.h"], "regions": [[7, 1, 9, 2, 3]]},
        ]
        self.assertEqual(
            spans_of(functions),
            {"/src/x.c": {"small": range(2, 5)}, "/include/y.h": {"keel_y": range(7, 10)}},
        )

    def test_what_lies_outside_of_it_does_not_count(self) -> None:
        branches = [[2, 5, 2, 6, 0, 4, 0, 0, 4], [5, 1, 5, 2, 0, 0, 0, 0, 4]]
        decisions = [[2, 5, 2, 11, 0, 5, [True, False]], [5, 1, 5, 9, 0, 5, [False, False]]]
        told = ("src/x.c", TEXT, {2: 5, 3: 0, 5: 0}, branches, decisions)
        found = within(range(2, 5), *told)
        self.assertEqual((found.lines, found.branches, found.mcdc), ((1, 2), (1, 2), (1, 2)))


class Exclusions(unittest.TestCase):
    """Exclusions hold for a line's text, need a reason, and must be of use."""

    def read(self, text: str) -> list[Exclusion]:
        """Read a file of exclusions."""
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-"))
        path = Path(folder) / "exclusions.toml"
        path.write_text(text)
        return read_exclusions(path)

    def test_reads_what_the_project_has(self) -> None:
        read_exclusions()

    def test_no_file_means_none(self) -> None:
        self.assertEqual(read_exclusions(Path("/nowhere/at/all.toml")), [])

    def test_reads_an_exclusion(self) -> None:
        text = '[[exclusion]]\nfile = "src/x.c"\nline = "return 1;"\nreason = "why"\n'
        self.assertEqual(self.read(text), [excluding("src/x.c")])

    def test_refuses_an_exclusion_without_reason(self) -> None:
        for reason in ("", 'reason = ""\n'):
            with self.assertRaisesRegex(
                ToolError, r"exclusions\.toml:[14]: exclusion number 1: reason: "
            ):
                self.read(f'[[exclusion]]\nfile = "src/x.c"\nline = "return 1;"\n{reason}')

    def test_refuses_unknown_keys(self) -> None:
        with self.assertRaisesRegex(
            ToolError, "toml:1: exclude: unknown key; did you mean exclusion"
        ):
            self.read('[[exclude]]\nfile = "src/x.c"\n')

    def test_apply_sorts_gaps_and_exclusions(self) -> None:
        used = excluding("src/x.c")
        unused = excluding("src/y.c")
        other = gap(5, "return 0;")
        found = apply([used, unused], [gap(), other])
        self.assertEqual(found, ([other], [gap()], [unused]))


class Verdict(unittest.TestCase):
    """The exit status and the report tell the truth."""

    report: dict[str, Any]

    def judge(self, gaps: list[Gap], exclusions: list[Exclusion]) -> tuple[int, str, bool]:
        """Exit status, output, and what the report says."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        output = io.StringIO()
        files = {"src/x.c": FileCoverage((2, 3), (4, 4), (2, 2), gaps)}
        with mock.patch.object(coverage, "REPORT", folder / "report.json"):
            with contextlib.redirect_stdout(output):
                status = coverage.judge(files, exclusions)
            self.report = json.loads((folder / "report.json").read_text())
        return status, output.getvalue(), self.report[VERDICT] == "good"

    def test_a_gap_fails_and_is_shown_with_its_place(self) -> None:
        status, output, good = self.judge([gap()], [])
        self.assertEqual((status, good), (1, False))
        self.assertIn("src/x.c:3: line not executed: return 1;", output)
        self.assertTrue(output.endswith("coverage: 1 gaps, 0 unused exclusions\n"))

    def test_an_excluded_gap_passes(self) -> None:
        status, output, good = self.judge([gap()], [excluding("src/x.c")])
        self.assertEqual((status, good), (0, True))
        self.assertIn("1 gaps excluded", output)
        self.assertEqual(self.report["excluded"][0]["reason"], "why")
        self.assertEqual(self.report[STAMP], stamp_of())

    def test_an_unused_exclusion_fails(self) -> None:
        status, output, good = self.judge([], [excluding("src/x.c")])
        self.assertEqual((status, good), (1, False))
        self.assertIn("excludes nothing: src/x.c: return 1;", output)

    def test_nearly_all_is_not_all(self) -> None:
        self.assertEqual(share(999, 1000), "999/1000  99 %")
        self.assertEqual(share(1000, 1000), "1000/1000 100 %")

    def test_what_cannot_be_measured_fails(self) -> None:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        report = folder / "report.json"
        report.write_text("{}")
        output = io.StringIO()
        with (
            mock.patch.object(coverage, "BUILD", folder),
            mock.patch.object(coverage, "REPORT", report),
            mock.patch.object(coverage, "measure", side_effect=ToolError("no compiler")),
            contextlib.redirect_stdout(output),
            contextlib.redirect_stderr(output),
        ):
            self.assertEqual(coverage.main([]), 2)
        self.assertIn("no compiler", output.getvalue())
        self.assertFalse(report.exists(), "an old report must not stand for a new one")
