#!/usr/bin/env python3
"""Tests of tools/status.py, and of the README that it writes: its example compiles.

    python3 tests/tools/test_status.py
"""

from __future__ import annotations

import contextlib
import io
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import status  # noqa: E402

README = "# Title\n\n<!-- status -->\nold\n<!-- /status -->\n\nThe end.\n"
TABLE = """\
# Title

<!-- status -->
| unit | WP goals proved | CBMC harnesses | CBMC properties | Gappa goals | wrong variants refuted |
|---|---|---|---|---|---|
| `clock` | 48 | 1 | 53 | 0 | 0 |
| `queue` | 282 | 2 | 1189 | 6 | 4 |
| all | 330 | 3 | 1242 | 6 | 4 |

Every goal and every property is proved.
<!-- /status -->

The end.
"""


def unit(
    goals: int, harnesses: int, properties: int, bodies: int, bounds: int = 0
) -> dict[str, Any]:
    """A unit of the report of which everything is proved."""
    return {
        "wp": {"goals": goals, "proved": goals, "not_proved_here": {}, "not_by_wp": {}},
        "cbmc": {
            "properties": properties,
            "without_harness": {},
            "proved": properties,
            "negative": {"bodies": bodies, "refuted": bodies},
            "harnesses": {str(number): {"sound": True} for number in range(harnesses)},
        },
        "gappa": {
            "goals": bounds, "proved": bounds,
            "negative": {"bounds": min(bounds, 1), "refused": min(bounds, 1)},
        },
    }


def a_report() -> dict[str, Any]:
    """A report of which everything is proved."""
    units = {"clock": unit(48, 1, 53, 0), "queue": unit(282, 2, 1189, 3, 6)}
    return {"verdict": "proved", "problems": [], "units": units}


class StatusTest(unittest.TestCase):
    """A README and a report in a folder of their own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.readme = self.root / "README.md"
        self.readme.write_text(README, encoding="utf-8")

    def run_status(self, report: dict[str, Any] | None) -> tuple[int, str]:
        """The exit status and what was said on stderr."""
        if report is not None:
            path = self.root / "build/prove/report.json"
            path.parent.mkdir(parents=True)
            path.write_text(json.dumps(report), encoding="utf-8")
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            return status.main([], self.root), errors.getvalue()

    def refused(self, report: dict[str, Any] | None, reason: str) -> None:
        """It says why, and leaves the README alone."""
        before = self.readme.read_text(encoding="utf-8")
        code, errors = self.run_status(report)
        self.assertEqual(code, 1)
        self.assertIn(reason, errors)
        self.assertEqual(self.readme.read_text(encoding="utf-8"), before)

    def test_table(self) -> None:
        self.assertEqual(self.run_status(a_report()), (0, ""))
        self.assertEqual(self.readme.read_text(encoding="utf-8"), TABLE)

    def test_twice_is_once(self) -> None:
        self.readme.write_text(TABLE, encoding="utf-8")
        self.assertEqual(self.run_status(a_report()), (0, ""))
        self.assertEqual(self.readme.read_text(encoding="utf-8"), TABLE)

    def test_what_is_not_proved_stands_out(self) -> None:
        report = a_report()
        report |= {"verdict": "failed", "problems": ["one", "two"]}
        queue = report["units"]["queue"]
        queue["wp"]["proved"] = 280
        queue["cbmc"]["harnesses"]["1"]["sound"] = False
        queue["cbmc"]["proved"] = 1188
        queue["cbmc"]["negative"]["refuted"] = 2
        queue["gappa"]["proved"] = 5
        self.assertEqual(self.run_status(report)[0], 0)
        text = self.readme.read_text(encoding="utf-8")
        row = "| **280 of 282** | **1 of 2** | **1188 of 1189** | **5 of 6** | **3 of 4** |\n"
        self.assertIn(f"| `queue` {row}", text)
        self.assertIn("| `clock` | 48 | 1 | 53 | 0 | 0 |\n", text)
        row = "| **328 of 330** | **2 of 3** | **1241 of 1242** | **5 of 6** | **3 of 4** |\n"
        self.assertIn(f"| all {row}", text)
        self.assertIn("**Not everything is proved**: 2 problems.\n", text)
        self.assertNotIn("Every goal", text)

    def test_what_is_left_out_is_named(self) -> None:
        report = a_report()
        report["units"]["clock"]["cbmc"]["without_harness"] = {"f": "why"}
        report["units"]["queue"]["cbmc"]["without_harness"] = {"g": "why"}
        report["units"]["queue"]["wp"]["not_proved_here"] = {"h": "why"}
        report["units"]["queue"]["wp"]["not_by_wp"] = {"k": "why"}
        self.assertEqual(self.run_status(report)[0], 0)
        text = self.readme.read_text(encoding="utf-8")
        self.assertIn("Without a harness (reasons in `proofs/units.toml`): `f`, `g`.\n", text)
        self.assertIn("Declared without a body (reasons in `proofs/units.toml`): `h`.\n", text)
        self.assertIn("Postconditions left to CBMC (reasons in `proofs/units.toml`): `k`.\n", text)

    def test_partial_report_is_refused(self) -> None:
        self.refused(a_report() | {"partial": True}, "not of all units")

    def test_report_without_units_is_refused(self) -> None:
        self.refused(a_report() | {"units": {}}, "names no unit")

    def test_missing_report_is_refused(self) -> None:
        self.refused(None, "there is no report")

    def test_missing_marks_are_refused(self) -> None:
        self.readme.write_text("# Title\n<!-- status -->\n", encoding="utf-8")
        self.refused(a_report(), "README.md needs one")

    def test_marks_the_wrong_way_round_are_refused(self) -> None:
        self.readme.write_text("<!-- /status -->\n<!-- status -->\n", encoding="utf-8")
        self.refused(a_report(), "stands before")


class ReadmeTest(unittest.TestCase):
    """The project's own README."""

    def setUp(self) -> None:
        self.text = (ROOT / "README.md").read_text(encoding="utf-8")

    def test_has_a_place_for_the_table(self) -> None:
        self.assertIn(TABLE.splitlines()[3], status.replaced(self.text, TABLE))

    def test_example_compiles(self) -> None:
        examples = re.findall(r"^```c\n(.*?)^```$", self.text, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(examples), 1)
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{ROOT / 'include'}"]
        done = subprocess.run(
            ["gcc", *flags, "-fsyntax-only", "-x", "c", "-"], input=examples[0], text=True,
            capture_output=True, timeout=60, check=False,
        )  # fmt: skip
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_targets_exist(self) -> None:
        makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
        for target in re.findall(r"\bmake ([a-z]+)\b", self.text):
            self.assertRegex(makefile, rf"(?m)^{target}:")

    def test_linked_files_exist(self) -> None:
        for link in re.findall(r"\]\(([^):#]+)\)", self.text):
            self.assertTrue((ROOT / link).is_file(), link)


if __name__ == "__main__":
    unittest.main()
