# SPDX-License-Identifier: Apache-2.0
"""Tests of shards: the parts are the same everywhere, and joined only when nothing is amiss."""

from __future__ import annotations

import contextlib
import io
import json
import unittest
from pathlib import Path
from typing import Any

from test_prove import GOALS, SOURCE, WholeRunCase

from keel.c.project import ProjectError
from keel.prove import command as prove
from keel.prove.driver import Job
from keel.prove.shards import Shard, part, read_shard

ROOT = Path(__file__).resolve().parents[2]


def job(name: str) -> Job:
    """A job that nobody runs."""
    return Job("box", "wp", name, lambda: name, dict)


class Parts(unittest.TestCase):
    jobs = tuple(job(name) for name in "abcdef")
    recorded = {f"box/wp/{name}": t for name, t in zip("abcdef", (9, 5, 4, 3, 3, 0), strict=True)}

    def names(self, number: int, of: int) -> list[str]:
        return [one.name for one in part(self.jobs, Shard(number, of), self.recorded)]

    def test_parts_take_equally_long(self) -> None:
        # Longest first to where there is least: 9 | 5 4 | then 3 to the first or second, by hand.
        self.assertEqual(self.names(1, 2), ["a", "d", "f"])
        self.assertEqual(self.names(2, 2), ["b", "c", "e"])

    def test_every_job_is_in_one_part(self) -> None:
        found = [name for number in (1, 2, 3, 4) for name in self.names(number, 4)]
        self.assertEqual(sorted(found), list("abcdef"))

    def test_the_order_of_the_jobs_does_not_matter(self) -> None:
        turned = part(self.jobs[::-1], Shard(1, 2), self.recorded)
        self.assertEqual([one.name for one in turned], self.names(1, 2))

    def test_one_part_is_all(self) -> None:
        self.assertEqual(sorted(self.names(1, 1)), list("abcdef"))

    def test_a_shard_is_read(self) -> None:
        self.assertEqual(read_shard("2/4"), Shard(2, 4))
        for text in ("", "2", "0/4", "5/4", "1/0", "-1/4", "1/4/2", "a/b"):
            with self.subTest(text), self.assertRaisesRegex(ValueError, "is no shard"):
                read_shard(text)


class CommandLine(unittest.TestCase):
    def refused(self, *arguments: str) -> str:
        error = io.StringIO()
        with contextlib.redirect_stderr(error), self.assertRaises(SystemExit) as stopped:
            prove.parse(arguments, ["box"])
        self.assertEqual(stopped.exception.code, 2)
        return error.getvalue()

    def test_a_shard_is_a_part_of_the_whole(self) -> None:
        self.assertIn("2/4 is the second", self.refused("--shard", "5/4"))
        for more in (["--unit", "box"], ["--engine", "wp"], ["--quick"], ["--update-goals"]):
            self.assertIn("a part of a whole run", self.refused("--shard", "1/2", *more))

    def test_reports_are_joined_to_the_whole(self) -> None:
        for more in (["--unit", "box"], ["--engine", "wp"], ["--quick"], ["--fresh"]):
            self.assertIn("takes a whole run", self.refused("--join", "a.json", *more))


class Joining(WholeRunCase):
    def shard(self, number: int, of: int = 2) -> Path:
        """The report of a shard."""
        file = self.root / "build" / "prove" / f"shard-{number}-of-{of}.json"
        whole, self.report_file = self.report_file, file
        self.status, self.output, self.report = self.prove(shard=Shard(number, of))
        self.report_file = whole
        return file

    def shards(self) -> tuple[Path, ...]:
        return self.shard(1), self.shard(2)

    def refused(self, why: str, *files: Path) -> None:
        with self.assertRaisesRegex(ProjectError, why):
            self.prove(join=files)
        self.assertFalse(self.report_file.exists())

    def test_a_shard_says_what_it_is(self) -> None:
        self.shard(1)
        self.assertEqual(self.status, 0, self.output)
        self.assertEqual((self.report["partial"], self.report["shard"]), (True, "1/2"))
        self.assertIn("shard 1/2", self.output)
        self.assertFalse(self.report_file.exists())

    def test_joined_they_are_the_whole(self) -> None:
        status, output, report = self.prove(join=self.shards())
        self.assertEqual(status, 0, output)
        self.assertNotIn("partial", report)
        self.assertEqual((report["verdict"], report["proved"]), ("proved", 5))
        whole = self.prove()[2]
        self.assertEqual(report["units"], whole["units"])

    def test_a_shard_that_is_missing_is_told(self) -> None:
        first, second = self.shards()
        self.refused("the report of shard 2/2 is missing", first)
        self.refused("the report of shard 1/2 is missing", second)

    def test_a_shard_that_is_there_twice_is_told(self) -> None:
        first, second = self.shards()
        copy = first.with_name("copy.json")
        copy.write_bytes(first.read_bytes())
        self.refused("copy.json: shard 1/2 is also in", first, second, copy)

    def test_shards_of_two_divisions_do_not_join(self) -> None:
        self.refused("is of another division", self.shard(1), self.shard(2, 3))

    def test_another_text_is_told(self) -> None:
        files = self.shards()
        self.unit.source.write_text(SOURCE.replace("value;", "value ;"), encoding="utf-8")
        self.refused("made with another source", *files)

    def test_other_tools_are_told(self) -> None:
        first, second = self.shards()
        self.change(second, lambda report: report["origin"].update(tools="0"))
        self.refused("shard-2-of-2.json: made with another tools", first, second)

    def test_another_commit_is_told(self) -> None:
        first, second = self.shards()
        self.change(second, lambda report: report["origin"].update(commit="0" * 40))
        self.refused("shard-2-of-2.json: made with another commit", first, second)

    @staticmethod
    def change(path: Path, how: Any) -> None:
        report = json.loads(path.read_text(encoding="utf-8"))
        how(report)
        path.write_text(json.dumps(report), encoding="utf-8")

    def test_a_job_that_no_report_has_is_told(self) -> None:
        first, second = self.shards()
        self.change(second, lambda report: report["outcomes"].popitem())
        self.refused("no report has .*; 1 are missing", first, second)

    def test_a_report_of_the_whole_is_none_of_a_shard(self) -> None:
        self.prove()
        whole = self.report_file.with_name("whole.json")
        self.report_file.rename(whole)
        self.refused("whole.json: no report of a shard", whole)
        self.refused("gone.json: no report of a shard", whole.with_name("gone.json"))

    def test_what_a_shard_did_not_prove_fails_the_whole(self) -> None:
        broken = {**GOALS, "helper": {"assigns": "Timeout", "loop_variant_decrease": "Valid"}}
        self.play(goals=broken)
        files = self.shards()
        status, output, report = self.prove(join=files)
        self.assertEqual((status, report["verdict"]), (1, "failed"))
        self.assertIn("helper_assigns is not proved", output)

    def test_the_rules_hold_for_the_whole(self) -> None:
        files = self.shards()
        text = self.unit.goal_list.read_text(encoding="utf-8")
        self.unit.goal_list.write_text(text + "zebra\n", encoding="utf-8")
        status, output, _ = self.prove(join=files)
        self.assertEqual(status, 1)
        self.assertIn("zebra is listed, but", output)
