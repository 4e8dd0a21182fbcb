# SPDX-License-Identifier: Apache-2.0
"""Tests of the verdicts that are kept: shared by all clones, only success, and nothing broken."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
import time
import unittest
from pathlib import Path
from typing import Any

from test_prove import WRONG, WholeRunCase, cbmc_output

from keel.base.verdict_cache import Cache

ROOT = Path(__file__).resolve().parents[2]

PROVED: dict[str, Any] = {"problems": [], "seconds": 1.0}


class Entries(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.cache = Cache(self.folder)

    def test_what_was_put_is_there(self) -> None:
        self.cache.put("k", PROVED)
        self.assertEqual(self.cache.get("k"), PROVED)
        self.assertIsNone(self.cache.get("l"))

    def test_an_entry_that_was_changed_is_ignored(self) -> None:
        self.cache.put("k", {**PROVED, "goals": ["Valid"]})
        path = self.folder / "k.json"
        path.write_text(path.read_text().replace("Valid", "Vapid"), encoding="utf-8")
        self.assertIsNone(self.cache.get("k"))

    def test_an_entry_under_another_name_is_ignored(self) -> None:
        self.cache.put("k", PROVED)
        (self.folder / "k.json").rename(self.folder / "l.json")
        self.assertIsNone(self.cache.get("l"))

    def test_a_failure_is_no_verdict(self) -> None:
        self.cache.put("k", {"problems": ["timeout"]})
        self.assertIsNone(self.cache.get("k"))

    def test_what_cannot_be_read_is_ignored(self) -> None:
        for text in ("", "[]", '{"key": "k"}', '{"key": "k", "result": 3}', "\x00"):
            (self.folder / "k.json").write_text(text, encoding="utf-8")
            with self.subTest(text):
                self.assertIsNone(self.cache.get("k"))

    def test_a_fresh_cache_is_written_and_not_read(self) -> None:
        fresh = Cache(self.folder, fresh=True)
        fresh.put("k", PROVED)
        self.assertIsNone(fresh.get("k"))
        self.assertEqual(self.cache.get("k"), PROVED)

    def keep(self, *ages: float) -> None:
        """Entries 0, 1, ... that were used so many seconds ago."""
        for number, age in enumerate(ages):
            self.cache.put(str(number), PROVED)
            when = time.time() - age
            os.utime(self.folder / f"{number}.json", (when, when))

    def left(self) -> list[str]:
        return sorted(path.stem for path in self.folder.glob("*.json"))

    def test_the_old_is_forgotten(self) -> None:
        self.keep(50, 150)
        self.cache.prune(oldest=100)
        self.assertEqual(self.left(), ["0"])

    def test_what_was_used_is_not_old(self) -> None:
        self.keep(50, 150)
        self.cache.get("1")
        self.cache.prune(oldest=100)
        self.assertEqual(self.left(), ["0", "1"])

    def test_beyond_a_size_the_least_recently_used_goes(self) -> None:
        self.keep(20, 10, 30)
        size = (self.folder / "0.json").stat().st_size
        self.cache.prune(largest=2 * size)
        self.assertEqual(self.left(), ["0", "1"])


class Clones(WholeRunCase):
    def setUp(self) -> None:
        super().setUp()
        self.unit.wrong_list.write_text(WRONG, encoding="utf-8")
        self.play(wrong=json.loads(cbmc_output(self.failing())))

    @staticmethod
    def failing() -> dict[str, Any]:
        return {
            "property": "h.assertion.1",
            "status": "FAILURE",
            "description": "BOX_001: it holds the value",
            "sourceLocation": {"file": "f.c", "line": "9", "function": "f"},
        }

    def verdicts(self) -> dict[str, int]:
        status, output, report = self.prove()
        self.assertEqual(status, 0, output)
        counts: dict[str, int] = report["verdicts"]
        told = f"verdicts: {counts['known']} known before, {counts['fresh']} had now"
        self.assertIn(told, output.splitlines())
        return counts

    def test_a_second_clone_has_all_verdicts_of_the_first(self) -> None:
        self.assertEqual(self.verdicts(), {"known": 0, "fresh": 5})
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        other = Path(folder.name).resolve() / "other"
        shutil.copytree(self.root, other, ignore=shutil.ignore_patterns("build", "verdicts"))
        self.root, self.report_file = other, other / "build" / "prove" / "report.json"
        self.tools = type(self.tools)(other)
        self.assertEqual(self.verdicts(), {"known": 5, "fresh": 0})

    def test_a_fresh_run_has_every_verdict_now(self) -> None:
        self.verdicts()
        self.fresh = True
        self.assertEqual(self.verdicts(), {"known": 0, "fresh": 5})
