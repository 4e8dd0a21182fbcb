# SPDX-License-Identifier: Apache-2.0
"""Tests of the results for other programs: build/prove/junit.xml and build/prove/results.sarif."""

from __future__ import annotations

import json
import unittest
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from test_prove import ASSERTED, GOALS, WholeRunCase, cbmc_output, item

from keel.base.sarif import SarifResult, document, split_place

ROOT = Path(__file__).resolve().parents[2]

LEVELS = ("none", "note", "warning", "error")


def sarif_problems(log: dict[str, Any]) -> list[str]:
    """What the schema of SARIF 2.1.0 demands of the parts that are used here, and is not so."""
    found = [] if log.get("version") == "2.1.0" else ["version"]
    found += [] if set(log) <= {"$schema", "version", "runs"} else ["unknown keys"]
    for run in log["runs"]:
        driver = run["tool"]["driver"]
        found += [] if driver["name"] else ["name"]
        rules = [rule["id"] for rule in driver["rules"]]
        found += [] if len(rules) == len(set(rules)) else ["a rule twice"]
        for result in run["results"]:
            found += [] if result["message"]["text"] else ["message.text"]
            found += [] if result["ruleId"] in rules else ["ruleId"]
            found += [] if result["level"] in LEVELS else ["level"]
            for location in result.get("locations", []):
                physical = location["physicalLocation"]
                uri = physical["artifactLocation"]["uri"]
                found += [] if uri and not uri.startswith("/") and " " not in uri else ["uri"]
                line = physical.get("region", {"startLine": 1})["startLine"]
                found += [] if isinstance(line, int) and line >= 1 else ["startLine"]
    return found


class Sarif(unittest.TestCase):
    def test_a_result_has_its_place(self) -> None:
        log = document("t", [SarifResult("a/b", "wrong", "src/x.c", 4), SarifResult("a/b", "bad")])
        self.assertEqual(sarif_problems(log), [])
        first, second = log["runs"][0]["results"]
        self.assertEqual(first["locations"][0]["physicalLocation"]["region"], {"startLine": 4})
        self.assertNotIn("locations", second)

    def test_a_place_is_found_in_a_text(self) -> None:
        self.assertEqual(split_place("proofs/a b: src/rtos/x.c:12: no"), ("src/rtos/x.c", 12))
        self.assertEqual(split_place("no place known"), ("", 0))


class Exports(WholeRunCase):
    def files(self) -> tuple[ElementTree.Element, dict[str, Any]]:
        self.prove()
        folder = self.report_file.parent
        log = json.loads((folder / "results.sarif").read_text(encoding="utf-8"))
        self.assertEqual(sarif_problems(log), [])
        return ElementTree.parse(folder / "junit.xml").getroot(), log

    def test_a_proof_has_a_test_for_each_goal_and_no_result(self) -> None:
        tests, log = self.files()
        self.assertEqual((tests.get("tests"), tests.get("failures")), ("5", "0"))
        self.assertEqual(log["runs"][0]["results"], [])

    def test_an_open_goal_is_at_its_clause(self) -> None:
        goals = {**GOALS, "keel_box_put": {"ensures_BOX_001": "Timeout", "assigns": "Valid"}}
        self.play(goals=goals)
        tests, log = self.files()
        [result] = log["runs"][0]["results"]
        self.assertEqual(result["ruleId"], "wp/ensures")
        place = result["locations"][0]["physicalLocation"]
        self.assertEqual(place["artifactLocation"]["uri"], "include/keel/rtos/box.h")
        self.assertEqual(place["region"]["startLine"], 7)
        [failure] = tests.iter("failure")
        self.assertIn("include/keel/rtos/box.h:7", failure.text or "")

    def test_a_failed_check_is_at_its_line(self) -> None:
        failing = [ASSERTED, item("keel_box_put.overflow.1", "FAILURE", "overflow", 15)]
        self.play(cbmc=json.loads(cbmc_output(*failing)))
        [result] = self.files()[1]["runs"][0]["results"]
        self.assertEqual(
            (result["ruleId"], result["message"]["text"]), ("cbmc/overflow", "overflow: FAILURE")
        )

    def test_the_summary_has_a_row_for_each_unit_and_what_failed(self) -> None:
        self.unit.goal_list.unlink()
        self.files()
        text = (self.report_file.parent / "summary.md").read_text(encoding="utf-8")
        self.assertIn("| box | 4 of 4 | 1 of 1 |  |  |", text)
        self.assertIn("- proofs/box/goals.txt is missing", text)

    def test_what_a_rule_finds_is_there_too(self) -> None:
        self.unit.goal_list.unlink()
        tests, log = self.files()
        self.assertEqual([one["ruleId"] for one in log["runs"][0]["results"]], ["rules/problem"])
        self.assertEqual(tests.get("failures"), "1")

    def test_a_run_that_breaks_off_leaves_none(self) -> None:
        self.files()
        self.unit.goal_list.write_text("a b c\n", encoding="utf-8")
        with self.assertRaises(Exception):
            self.prove()
        self.assertEqual([path.name for path in self.report_file.parent.glob("*.xml")], [])
        self.assertFalse((self.report_file.parent / "results.sarif").exists())
