# SPDX-License-Identifier: Apache-2.0
"""A copy of the tree and a report of make prove about it, for tests of the evidence on proofs."""

from __future__ import annotations

import json
import tomllib
import unittest
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from keel.install.packages import provide

provide()

from copied_tree import CopiedTree

from keel.base.source import STAMP
from keel.c.project import Unit, find_units
from keel.gather.part import Context, Part
from keel.judge.goals import read_goals
from keel.judge.wrong_bodies import read_wrong_bodies

ROOT = Path(__file__).resolve().parents[2]
NOW = {"commit": "c", "tree": "t", "product": "p"}
COPIED = ("include", "src", "proofs", "specs")


def wp_of(unit: Unit) -> dict[str, Any]:
    """WP's half of a unit's entry: all goals that are listed are proved."""
    names = read_goals(unit.goal_list, "").names
    return {
        "goals": len(names),
        "proved": len(names),
        "smoke_tests": 3,
        "accepted_warnings": {},
        "not_proved_here": {},
        "not_by_wp": {},
        "by_cbmc": {},
        "goal_list": [
            {"name": name, "status": "Valid", "prover": "CVC4 1.8", "target": "lemmas"}
            for name in names
        ],
    }


def cbmc_of(unit: Unit) -> dict[str, Any]:
    """CBMC's half: all assertions that are listed are proved, and two checks besides."""
    listed = tomllib.loads((unit.root / "specs/unreached.toml").read_text(encoding="utf-8"))
    unreached = {one["harness"]: one["blocks"] for one in listed["unreached"]}
    asserted: dict[str, list[dict[str, str]]] = {path.stem: [] for path in unit.harnesses}
    for line in (unit.folder / "assertions.txt").read_text(encoding="utf-8").splitlines():
        name, _, description = line.partition(" ")
        asserted[name].append({"name": "a", "description": description, "status": "SUCCESS"})
    harnesses = {
        name: {
            "properties": len(found) + 2,
            "proved": len(found) + 2,
            "sound": True,
            "assertions": found,
            "checks": "all",
            "coverage": {"blocks": 30, "reached": 30 - unreached.get(f"{unit.name}/{name}", 0)},
        }
        for name, found in asserted.items()
    }
    wrong = {body.name: True for body in read_wrong_bodies(unit)}
    return {"properties": 9, "proved": 9, "harnesses": harnesses, "negative": {"list": wrong}}


def report_of(root: Path) -> dict[str, Any]:
    """A report of make prove by which all that the tree lists is proved."""
    units = {}
    bounds = [f"VOT_016_p{i}_v{j}" for i in range(3) for j in (1, 2)]
    gappa_goals = {
        "voter": [*bounds, "VOT_017_agreement"],
        "reference": ["REF_003_end", "REF_010_square"],
        "attitude": ["ATT_010_length", "ATT_010_guard"],
        "cascade": ["CAS_011_left", "CAS_011_square"],
    }
    for unit in find_units(root).values():
        if unit.folder.is_dir():
            own = gappa_goals.get(unit.name, [])
            gappa = [
                {"name": name, "bound": "2", "enclosure": "1", "status": "Valid"} for name in own
            ]
            wrong = {path.name: True for path in unit.wrong_statements}
            units[unit.name] = {
                "problems": [],
                "determined": [],
                "seconds": {"wp/lemmas": 1.5},
                "wp": wp_of(unit),
                "cbmc": cbmc_of(unit),
                "gappa": {
                    "goals": len(gappa),
                    "proved": len(gappa),
                    "goal_list": gappa,
                    "negative": {"list": wrong},
                },
            }
    return {
        "verdict": "proved",
        "problems": [],
        "goals": 1,
        "proved": 1,
        "units": units,
        STAMP: NOW,
    }


@cache
def copied() -> CopiedTree:
    """The copy that all tests of a process share."""
    return CopiedTree(ROOT, COPIED)


class EvidenceTest(unittest.TestCase):
    """A test with a copy of the tree, and a report about it."""

    def setUp(self) -> None:
        self.root = copied().put_back()
        self.report = report_of(self.root)

    def write(self, name: str, report: Mapping[str, Any]) -> None:
        """Write a report below build/."""
        path = self.root / "build" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(report), encoding="utf-8")

    def context(self) -> Context:
        """What a part is made from."""
        self.write("prove/report.json", self.report)
        return Context(self.root, self.root / "build", self.root / "build/work", NOW, print)

    def replace(self, name: str, old: str, new: str) -> None:
        """Change a file of the tree."""
        path = self.root / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, 1), encoding="utf-8")

    def assert_problem(self, part: Part, *words: str) -> None:
        """One problem has all the words."""
        found = [text for text in part.problems if all(word in text for word in words)]
        self.assertTrue(found, f"{words} in none of {part.problems[:9]}")
        self.assertNotIn("\n", found[0])
