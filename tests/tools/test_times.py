# SPDX-License-Identifier: Apache-2.0
"""Tests of times: what is recorded, which job goes first, and what a run will still take."""

from __future__ import annotations

import json
import re
import tempfile
import unittest
from collections.abc import Sequence
from pathlib import Path

from test_prove import WholeRunCase

from keel.prove.driver import Job
from keel.prove.progress import Running
from keel.prove.report import HELP
from keel.prove.times import PRIOR, UNKNOWN, Forecast, Times, estimates, read_times, recorded_anew

ROOT = Path(__file__).resolve().parents[2]


class Estimates(unittest.TestCase):
    def test_a_job_never_seen_is_an_average_of_its_kind(self) -> None:
        seconds = {"a/wp/f": 10.0, "b/wp/g": 20.0, "a/cbmc/h": 90.0}
        found = estimates(["a/wp/f", "c/wp/new", "c/gappa/new"], seconds)
        self.assertEqual(found, {"a/wp/f": 10.0, "c/wp/new": 15.0, "c/gappa/new": UNKNOWN})


class Files(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.own = Path(folder.name) / "own.json"
        self.shared = Path(folder.name) / "shared.json"
        self.shared.write_text('{"a/wp/f": 9, "a/wp/g": 5}', encoding="utf-8")

    def test_a_fresh_clone_knows_the_recorded_times(self) -> None:
        times = Times(self.own, self.shared)
        self.assertEqual(times.expected("a/wp/f"), 9)
        self.assertEqual(times.expected("a/wp/new"), float("inf"))

    def test_the_clone_has_seen_it_better(self) -> None:
        times = Times(self.own, self.shared)
        times.note("a/wp/f", 3.0)
        times.save()
        again = Times(self.own, self.shared)
        self.assertEqual((again.of("wp", "a", "f"), again.of("wp", "a", "g")), (3.0, 5.0))
        self.assertEqual(again.recorded, {"a/wp/f": 9.0, "a/wp/g": 5.0})

    def test_a_broken_file_is_none(self) -> None:
        for text in ("", "[]", '{"a": "x"}', '{"a": null}'):
            self.own.write_text(text, encoding="utf-8")
            with self.subTest(text):
                self.assertEqual(read_times(self.own), {})


class Recording(unittest.TestCase):
    def test_small_changes_are_not_recorded(self) -> None:
        before = {"a/wp/f": 10.0, "a/wp/g": 2.0}
        self.assertEqual(recorded_anew(before, {"a/wp/f": 14.9, "a/wp/g": 3.9}, True), before)

    def test_large_changes_are_recorded_in_round_numbers(self) -> None:
        found = recorded_anew({"a/wp/f": 10.0}, {"a/wp/f": 123.4, "a/wp/n": 0.1}, True)
        self.assertEqual(found, {"a/wp/f": 120, "a/wp/n": 1})

    def test_a_job_that_is_no_more_goes_after_a_whole_run(self) -> None:
        before = {"a/wp/f": 10.0, "a/wp/old": 5.0}
        self.assertEqual(list(recorded_anew(before, {"a/wp/f": 10.0}, True)), ["a/wp/f"])
        self.assertEqual(list(recorded_anew(before, {"a/wp/f": 10.0}, False)), list(before))


class Left(unittest.TestCase):
    def test_two_jobs_side_by_side_take_half_of_the_sum(self) -> None:
        forecast = Forecast({"a": 100.0, "b": 60.0, "c": 40.0}, 2)
        self.assertEqual(forecast.seconds(), 100.0)
        self.assertEqual(forecast.text(), "about 2 min left")

    def test_no_less_than_the_longest(self) -> None:
        self.assertEqual(Forecast({"a": 100.0, "b": 20.0}, 4).seconds(), 100.0)

    def test_what_is_known_takes_no_time(self) -> None:
        forecast = Forecast({"a": 100.0, "b": 20.0}, 1)
        forecast.known("a")
        self.assertEqual((forecast.seconds(), forecast.text()), (20.0, "less than 1 min left"))

    def test_a_slow_machine_is_learnt(self) -> None:
        forecast = Forecast({"a": PRIOR, "b": 100.0}, 1)
        forecast.done("a", 3 * PRIOR)  # 60 s as recorded before, and 60 s that took 180: twice
        self.assertAlmostEqual(forecast.seconds(), 200.0)

    def test_nothing_is_left_at_the_end(self) -> None:
        forecast = Forecast({"a": 1.0}, 1)
        forecast.done("a", 5.0)
        self.assertEqual((forecast.seconds(), forecast.text()), (0.0, ""))

    def test_no_time_is_told_while_one_of_the_jobs_was_never_timed(self) -> None:
        forecast = Forecast({"a": 1.0, "b": 1.0, "new": 1.0}, 1, ["new"])
        self.assertEqual(forecast.text(), "3 jobs left")
        forecast.done("new", 5.0)
        self.assertEqual(forecast.text(), "less than 1 min left")

    def test_no_time_is_told_while_a_job_is_late(self) -> None:
        forecast = Forecast({"a": 1.0}, 1)
        forecast.late("a")
        self.assertEqual(forecast.text(), "1 job left")


class Late(unittest.TestCase):
    def test_a_job_is_named_after_a_minute_and_whenever_it_has_run_twice_as_long(self) -> None:
        self.assertEqual(self.named(None, (59, 60, 100, 120, 200, 240)), [60, 120, 240])

    def test_a_job_that_was_timed_is_named_when_it_takes_twice_as_long(self) -> None:
        self.assertEqual(self.named(100.0, (60, 199, 201)), [201])

    def test_a_job_that_has_ended_is_not_named(self) -> None:
        self.assertEqual(self.named(None, (), after=(300,)), [])

    def named(
        self, expected: float | None, during: Sequence[int], after: Sequence[int] = ()
    ) -> list[float]:
        """At which seconds a job is named, of those at which is looked."""
        now = 0.0
        heard: list[float] = []
        job = Job("box", "cbmc", "h", lambda: "key", lambda _room: {})
        running = Running(
            lambda _job, seconds: heard.append(seconds), lambda _: expected, lambda: now
        )
        with running.now(job):
            for now in during:
                running.look()
        for now in after:
            running.look()
        return heard


class Run(WholeRunCase):
    def test_a_run_records_its_times_when_it_is_asked_to(self) -> None:
        path = self.root / "proofs" / "times.json"
        self.prove()
        self.assertFalse(path.exists())
        self.prove(update=True)
        recorded = json.loads(path.read_text(encoding="utf-8"))
        names = ["cbmc/keel_box_put_harness", "wp/helper", "wp/keel_box_put", "wp/survey"]
        self.assertEqual(list(recorded), [f"box/{name}" for name in names])
        self.assertTrue(all(seconds >= 1 for seconds in recorded.values()))

    def test_what_is_told_to_help_is_there(self) -> None:
        page, _, anchor = HELP.rpartition("#")
        headings = re.findall(r"^#+ (.*)$", Path(page).read_text(encoding="utf-8"), re.MULTILINE)
        self.assertIn(anchor, [heading.lower().replace(" ", "-") for heading in headings])

    def test_what_is_left_is_told(self) -> None:
        self.assertIn("3 jobs left", self.prove()[1])
        self.fresh = True
        self.assertIn("less than 1 min left", self.prove()[1])
