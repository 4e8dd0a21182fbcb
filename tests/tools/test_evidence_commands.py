# SPDX-License-Identifier: Apache-2.0
"""Tests of what the evidence package is made from: which reports serve, which commands are run.

The make that is started only notes what it was asked.
"""

from __future__ import annotations

import json
import os
import tempfile
import threading
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from unittest import mock

from evidence_sample import STAMP, context_in
from makefile import rule_of, rules

from keel.base.run import Ended
from keel.base.source import STAMP as MADE_FROM
from keel.base.source import VERDICT, stamp_of, write_report
from keel.evidence.commands import (
    Command,
    batches,
    commands_of,
    handed_over,
    not_good,
    run_commands,
)
from keel.install.lock import Lock

ROOT = Path(__file__).resolve().parents[2]


class InFolder(unittest.TestCase):
    """A folder with the report of one command."""

    command = Command("test/report.json", ("test",))

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, text: str) -> None:
        path = self.folder / "build" / self.command.report
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


class Commands(InFolder):
    """What is run."""

    def run_with(self, ended: Ended) -> list[str]:
        self.ran: list[str] = []

        def start(words: Sequence[str], _: Path) -> Ended:
            self.ran += words
            return ended

        return run_commands(context_in(self.folder), [self.command], start)

    def ran_for(self, **report: Any) -> bool:
        self.write(json.dumps({MADE_FROM: STAMP, **report}))
        self.assertEqual(self.run_with(Ended(0, "")), [])
        return bool(self.ran)

    def test_a_good_report_of_this_source_is_kept(self) -> None:
        self.assertFalse(self.ran_for(verdict="good"))
        self.assertFalse(self.ran_for(verdict="proved"))

    def test_a_report_of_another_source_is_made_anew(self) -> None:
        self.assertTrue(self.ran_for(verdict="good", **{MADE_FROM: {**STAMP, "tree": "0" * 64}}))
        self.write(json.dumps({VERDICT: "good"}))
        self.run_with(Ended(0, ""))
        self.assertEqual(self.ran, ["test"])

    def test_a_report_that_is_not_good_is_made_anew(self) -> None:
        for said in ("failed", "partial", "GOOD", "", None, True):
            self.assertTrue(self.ran_for(verdict=said), said)

    def test_a_report_without_a_verdict_is_made_anew(self) -> None:
        self.assertTrue(self.ran_for(passed=3, failed=0, ok=True))

    def test_a_report_of_some_proofs_is_made_anew(self) -> None:
        self.assertTrue(self.ran_for(verdict="proved", partial=True))

    def test_every_command_is_a_target_of_make(self) -> None:
        commands = commands_of(ROOT)
        self.assertGreater(len(commands), 8)
        for command in commands:
            self.assertIn(rule_of(command.shown), rules(), command.shown)

    def test_narrow_commands_that_follow_each_other_run_at_the_same_time(self) -> None:
        wide, narrow = (Command(f"{word}.json", (word,), word != "w") for word in "wn")
        other = Command("o.json", ("o",), narrow=True)
        self.assertEqual(
            batches([narrow, other, wide, wide, narrow]),
            [[narrow, other], [wide], [wide], [narrow]],
        )

    def test_all_that_fail_at_the_same_time_are_told_in_their_order(self) -> None:
        slow, quick = (Command(f"{word}.json", (word,), narrow=True) for word in ("slow", "quick"))
        ended = threading.Event()

        def start(words: Sequence[str], _: Path) -> Ended:
            if words == slow.words:
                ended.wait(5.0)
            ended.set()
            return Ended(1, words[0])

        told = run_commands(context_in(self.folder), [slow, quick], start)
        self.assertEqual([problem.split(":")[0] for problem in told], ["make slow", "make quick"])

    def test_a_half_written_report_is_made_anew(self) -> None:
        self.write('{"verdict": "good", "made')
        self.run_with(Ended(0, ""))
        self.assertEqual(self.ran, ["test"])

    def test_a_command_that_fails_is_named_with_its_last_line(self) -> None:
        [told] = self.run_with(Ended(1, "much\n3 of 4 tests passed\n"))
        self.assertIn("make test: exit status 1: 3 of 4 tests passed", told)
        [log] = (self.folder / "work/logs").iterdir()
        self.assertIn("much", log.read_text(encoding="utf-8"))


class Elsewhere(InFolder):
    """Proofs of other machines, joined in one report."""

    command = Command("prove/report.json", ("prove-all",))
    z3 = mock.Mock(version="4.8.12", sha256="a" * 64)
    report = {
        VERDICT: "proved",
        MADE_FROM: STAMP,
        "tools": {"z3": {"version": "4.8.12", "sha256": "a" * 64}},
    }

    def told(self, proved: str = "1") -> list[str]:
        """Why the report cannot serve."""
        tools = mock.Mock(lock=Lock.read(), **{"versions.return_value": {"z3": self.z3}})
        with (
            mock.patch.dict(os.environ, KEEL_PROVED=proved),
            mock.patch("keel.evidence.commands.Toolchain", lambda: tools),
        ):
            return handed_over(context_in(self.folder))

    def told_of(self, **changed: Any) -> str:
        self.write(json.dumps({**self.report, **changed}))
        [problem] = self.told()
        self.assertRegex(problem, r"^build/prove/report\.json: .*\(KEEL_PROVED=1: nothing is ")
        return problem

    def test_one_of_this_commit_and_these_tools_serves(self) -> None:
        self.write(json.dumps(self.report))
        self.assertEqual(self.told(), [])

    def test_where_this_machine_proves_none_is_needed(self) -> None:
        self.assertEqual(self.told("0"), [])

    def test_one_that_is_missing(self) -> None:
        [problem] = self.told()
        self.assertIn("is missing (KEEL_PROVED=1", problem)

    def test_one_of_another_commit_or_of_other_files(self) -> None:
        self.assertIn(
            "(commit 000000000000, here cccccccccccc)",
            self.told_of(**{MADE_FROM: {**STAMP, "commit": "0" * 40}}),
        )
        self.assertIn(
            "(the same commit, other files)",
            self.told_of(**{MADE_FROM: {**STAMP, "tree": "0" * 64}}),
        )
        self.assertIn("(it names none)", self.told_of(**{MADE_FROM: None}))

    def test_one_that_says_that_something_failed_or_was_left_out(self) -> None:
        self.assertIn("does not say that all is proved", self.told_of(verdict="failed"))
        self.assertIn("does not say that all is proved", self.told_of(partial=True))

    def test_one_of_other_tools(self) -> None:
        for version, digest, why in (
            ("4.8.13", "a" * 64, "z3 4.8.13, here is 4.8.12"),
            ("4.8.12", "b" * 64, "another file of z3"),
            ("5.0", "a" * 64, "z3 5.0, locked is"),
        ):
            tools = {"z3": {"version": version, "sha256": digest}}
            self.assertIn(why, self.told_of(tools=tools))


class Verdicts(InFolder):
    """What reports say of themselves, also when nothing is run."""

    def told(self, **report: Any) -> list[str]:
        self.write(json.dumps({MADE_FROM: STAMP, **report}))
        return list(not_good(context_in(self.folder), [self.command]))

    def test_a_good_one(self) -> None:
        self.assertEqual(self.told(verdict="good"), [])

    def test_one_that_says_that_it_failed(self) -> None:
        told = "build/test/report.json: its verdict is 'failed': make test"
        self.assertEqual(self.told(verdict="failed"), [told])

    def test_one_without_the_field(self) -> None:
        told = "build/test/report.json: has no verdict: make test"
        self.assertEqual(self.told(passed=3), [told])

    def test_one_of_a_part_alone(self) -> None:
        told = "build/test/report.json: its verdict is 'partial': make test"
        self.assertEqual(self.told(verdict="partial"), [told])
        told = "build/test/report.json: its verdict is 'proved', of a part alone: make test"
        self.assertEqual(self.told(verdict="proved", partial=True), [told])

    def test_what_a_report_is_written_with(self) -> None:
        path = self.folder / "report.json"
        for good, whole, said in (
            (True, True, "good"),
            (True, False, "partial"),
            (False, True, "failed"),
            (False, False, "failed"),
        ):
            # What the report itself calls its verdict does not count.
            write_report(path, {VERDICT: "good", "x": 1}, self.folder, good=good, whole=whole)
            read = json.loads(path.read_text(encoding="utf-8"))
            path.unlink()
            expected = {VERDICT: said, "x": 1, MADE_FROM: stamp_of(self.folder)}
            self.assertEqual(read, expected)


class Reports(InFolder):
    """What a part is told of a report that cannot serve."""

    def told(self, text: str | None) -> list[str]:
        context = context_in(self.folder)
        if text is not None:
            self.write(text)
        problems: list[str] = []
        context.report(self.command.report, problems)
        return problems

    def test_missing(self) -> None:
        self.assertEqual(self.told(None), ["build/test/report.json: is missing"])

    def test_half_written(self) -> None:
        self.assertRegex(self.told('{"units": {')[0], r"^build/test/report\.json: is not whole: ")

    def test_stale(self) -> None:
        for stamp, how in (
            ({}, "it names none"),
            ({**STAMP, "commit": "0" * 40}, "commit 000000000000, here cccccccccccc"),
            ({**STAMP, "commit": ""}, "commit none, here cccccccccccc"),
            ({**STAMP, "tree": "0" * 64}, "the same commit, other files"),
        ):
            told = self.told(json.dumps({MADE_FROM: stamp}))
            self.assertEqual(
                told,
                [
                    "build/test/report.json: speaks of another source than the one"
                    f" that is here ({how})"
                ],
            )

    def test_good(self) -> None:
        self.assertEqual(self.told(json.dumps({MADE_FROM: STAMP})), [])
