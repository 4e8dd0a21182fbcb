# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel status, which writes docs/status.md."""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path
from typing import Any

from keel.release import status

ROOT = Path(__file__).resolve().parents[2]

HEADING = "# Status\n\nThis is proved by the last complete run"
TABLE = """\
| unit | functions determined | WP goals | CBMC harnesses | CBMC properties | Gappa goals | \
mistakes refuted |
|---|---|---|---|---|---|---|
| `clock` | 3 | 48 | 1 | 53 | 0 | 0 |
| `queue` | 5 | 282 | 2 | 1189 | 6 | 4 |
| all | 8 | 330 | 3 | 1242 | 6 | 4 |

Every goal and every property is proved.

A *function determined*"""


def functions(name: str, count: int) -> list[dict[str, Any]]:
    """Functions that are determined, the last by WP."""
    ways = ["equality"] * (count - 1) + ["wp"]
    return [{"function": f"{name}_{number}", "by": way} for number, way in enumerate(ways)]


def unit(
    name: str,
    determined: int,
    goals: int,
    harnesses: int,
    properties: int,
    bodies: int,
    bounds: int = 0,
) -> dict[str, Any]:
    """A unit of the report of which everything is proved."""
    return {
        "determined": functions(name, determined),
        "wp": {"goals": goals, "proved": goals, "not_proved_here": {}, "not_by_wp": {}},
        "cbmc": {
            "properties": properties,
            "without_harness": {},
            "proved": properties,
            "negative": {"bodies": bodies, "refuted": bodies},
            "harnesses": {str(number): {"sound": True} for number in range(harnesses)},
        },
        "gappa": {
            "goals": bounds,
            "proved": bounds,
            "negative": {"bounds": min(bounds, 1), "refused": min(bounds, 1)},
        },
    }


def a_report() -> dict[str, Any]:
    """A report of which everything is proved."""
    units = {"clock": unit("c", 3, 48, 1, 53, 0), "queue": unit("q", 5, 282, 2, 1189, 3, 6)}
    return {"verdict": "proved", "problems": [], "units": units}


class StatusTest(unittest.TestCase):
    """A page and a report in a folder of their own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.page = self.root / "docs/status.md"
        self.page.parent.mkdir()
        self.page.write_text("old", encoding="utf-8")

    def run_status(self, report: dict[str, Any] | None) -> tuple[int, str]:
        """The exit status and what was said on stderr."""
        if report is not None:
            path = self.root / "build/prove/report.json"
            path.parent.mkdir(parents=True)
            path.write_text(json.dumps(report), encoding="utf-8")
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            return status.main([], self.root), errors.getvalue()

    def written(self, report: dict[str, Any]) -> str:
        """The page that a report gives."""
        self.assertEqual(self.run_status(report), (0, ""))
        return self.page.read_text(encoding="utf-8")

    def refused(self, report: dict[str, Any] | None, reason: str) -> None:
        """It says why, and leaves the page alone."""
        code, errors = self.run_status(report)
        self.assertEqual(code, 2)
        self.assertIn(reason, errors)
        self.assertEqual(self.page.read_text(encoding="utf-8"), "old")

    def test_page(self) -> None:
        text = self.written(a_report())
        self.assertTrue(text.startswith(HEADING))
        self.assertIn(TABLE, text)
        self.assertNotIn("Exceptions", text)

    def test_what_is_not_proved_stands_out(self) -> None:
        report = a_report()
        report |= {"verdict": "failed", "problems": ["one", "two"]}
        queue = report["units"]["queue"]
        queue["determined"][1]["by"] = "nothing"
        queue["determined"][2]["by"] = "open"
        queue["wp"]["proved"] = 280
        queue["cbmc"]["harnesses"]["1"]["sound"] = False
        queue["cbmc"]["proved"] = 1188
        queue["cbmc"]["negative"]["refuted"] = 2
        queue["gappa"]["proved"] = 5
        text = self.written(report)
        row = "**280 of 282** | **1 of 2** | **1188 of 1189** | **5 of 6** | **3 of 4** |\n"
        self.assertIn(f"| `queue` | **3 of 5** | {row}", text)
        self.assertIn("| `clock` | 3 | 48 | 1 | 53 | 0 | 0 |\n", text)
        row = "**328 of 330** | **2 of 3** | **1241 of 1242** | **5 of 6** | **3 of 4** |\n"
        self.assertIn(f"| all | **6 of 8** | {row}", text)
        self.assertIn("**Not everything is proved**: 2 problems.\n", text)
        self.assertNotIn("Every goal", text)

    def test_what_is_left_out_is_named(self) -> None:
        report = a_report()
        clock, queue = report["units"].values()
        clock["cbmc"]["without_harness"] = {"f": "why"}
        queue["cbmc"]["without_harness"] = {"g": "why"}
        queue["wp"]["not_proved_here"] = {"h": "why"}
        queue["wp"]["not_by_wp"] = {"k": "why", "l": "why"}
        queue["determined"][4]["by"] = "nothing"
        text = self.written(report)
        self.assertIn("- not determined in every field: `q_4`.\n", text)
        self.assertIn("- without a harness: `f`, `g`.\n", text)
        self.assertIn("- declared without a body: `h`.\n", text)
        self.assertIn("- postconditions left to CBMC: 2 functions: `queue` 2.\n", text)

    def test_partial_report_is_refused(self) -> None:
        self.refused(a_report() | {"partial": True}, "not of all units")

    def test_report_without_units_is_refused(self) -> None:
        self.refused(a_report() | {"units": {}}, "names no unit")

    def test_missing_report_is_refused(self) -> None:
        self.refused(None, "there is no report")
