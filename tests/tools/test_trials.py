# SPDX-License-Identifier: Apache-2.0
"""Tests of how a mutant is tried: in which order of harnesses and engines, and what is kept.

No prover is run.
"""

from __future__ import annotations

import dataclasses
import json
import os
import tempfile
from collections.abc import Collection
from pathlib import Path
from typing import Any
from unittest import mock

from test_prove import HARNESS, SOURCE, TreeTest

from keel.base import jobs
from keel.base.verdict_cache import Cache
from keel.c.project import find_units
from keel.engines import cbmc
from keel.judge import cbmc_answers, harness
from keel.judge.settings import Exceptions
from keel.mutate import small_harnesses as mutant_small
from keel.mutate.mutation import BY_CBMC, BY_WP, NO_ANSWER, Tools, Trial
from keel.mutate.operators import Mutant
from keel.mutate.trees import Trees
from keel.mutate.verdicts import Identity, Verdict, report, standing, table
from keel.prove import job_list
from keel.prove.times import Times

ROOT = Path(__file__).resolve().parents[2]


def harness_text(name: str, covers: str, more: str = "") -> str:
    """A harness of keel_box_put under another name."""
    text = HARNESS.replace("keel_box_put_harness", name)
    return text.replace("// covers: keel_box_put", f"{more}// covers: {covers}")


class TrialCase(TreeTest):
    """A project with several harnesses, and a trial on it."""

    def setUp(self) -> None:
        super().setUp()
        folder = self.unit.folder
        linking = "// sources: src/rtos/box.c\n"
        texts = {
            "keel_box_put__slow_harness": harness_text(
                "keel_box_put__slow_harness", "keel_box_put"
            ),
            "keel_box_put__eq_harness": harness_text(
                "keel_box_put__eq_harness", "keel_box_put model_box_put"
            ),
            "keel_box_get__eq_harness": harness_text(
                "keel_box_get__eq_harness", "helper keel_box_put model_box_get"
            ),
            "keel_box_get_harness": harness_text("keel_box_get_harness", "keel_box_get"),
            "keel_box_far_harness": harness_text("keel_box_far_harness", "keel_box_far").replace(
                "keel_box_put(&box", "keel_box_far(&box"
            ),
            "keel_box_not_harness": harness_text(
                "keel_box_not_harness", "keel_box_not", "// replaces: keel_box_put\n"
            ),
        }
        for name, text in texts.items():
            (folder / f"{name}.c").write_text(text, encoding="utf-8")
        other = self.root / "proofs/sail/keel_sail_set_harness.c"
        other.parent.mkdir()
        other.write_text(linking + harness_text("keel_sail_set_harness", "keel_box_put"))
        (self.root / "include/keel/rtos/sail.h").write_text("/* sail */\n")
        (self.root / "src/rtos/sail.c").write_text("/* sail */\n")
        (self.root / "specs/model").mkdir(parents=True)
        (self.root / "specs/model/box.h").write_text("/* model */\n")
        times = {
            "box/cbmc/keel_box_put_harness": 5,
            "box/cbmc/keel_box_put__slow_harness": 90,
            "box/cbmc/keel_box_put__eq_harness": 30,
            "sail/cbmc/keel_sail_set_harness": 1,
        }
        (self.root / "times.json").write_text(json.dumps(times))
        self.unit = find_units(self.root)["box"]
        self.trial = self.make_trial()

    def make_trial(
        self,
        stamp: str = "1",
        patient: bool = True,
        driver: str = "d",
        wp: str = "1",
        accepted: Collection[Identity] = (),
    ) -> Trial:
        scratch = Path(tempfile.mkdtemp(dir=self.root.parent, prefix="scratch"))
        self.addCleanup(lambda: __import__("shutil").rmtree(scratch, ignore_errors=True))
        tools = Tools(
            (), ("goto-cc",), ("cbmc",), ("gcc",), {}, scratch, scratch / "a", scratch / "v"
        )
        return Trial(
            self.unit,
            tools,
            Trees(self.root, scratch, 1),
            ("cbmc", "wp"),
            False,
            Cache(self.root / "cache"),
            {"tool": "t", BY_CBMC: stamp, BY_WP: wp, "driver": driver},
            Exceptions(),
            Times(self.root / "times.json"),
            patient,
            accepted=accepted,
        )

    def mutant(self, text: str = "*box = value;") -> Mutant:
        start = SOURCE.index(text)
        return Mutant(
            self.unit.source, "keel_box_put", "x", start, start + len(text), ";", 15, text, ";"
        )


class Order(TrialCase):
    def test_equality_first_then_what_covers_then_what_links_and_the_fastest_of_each(self) -> None:
        names = [one.name.removesuffix("_harness") for one in self.trial._ranked(self.mutant())]
        self.assertEqual(
            names,
            [
                "keel_box_put__eq",
                "keel_box_get__eq",
                "keel_sail_set",
                "keel_box_put",
                "keel_box_put__slow",
                "keel_box_get",
            ],
        )

    def test_a_tree_has_the_model(self) -> None:
        with self.trial._trees.with_mutant(self.mutant(), self.root) as tree:
            self.assertTrue((tree / "specs/model/box.h").is_file())

    def test_each_that_covers_is_asked_once_and_one_without_an_answer_leaves_it_open(self) -> None:
        asked: list[str] = []

        def check(_self: cbmc.Cbmc, harness: Any, *_: object) -> cbmc_answers.Answer:
            asked.append(harness.name)
            return cbmc_answers.Answer([], [], [], complete="slow" not in harness.name)

        runner = jobs.Runner({}, self.root)
        with (
            mock.patch.object(cbmc.Cbmc, "check", check),
            mock.patch.object(cbmc.Cbmc, "build", lambda *_: (Path("x"), "")),
        ):
            said = self.trial._by_cbmc(self.mutant(), self.unit, runner)
        self.assertEqual(said, NO_ANSWER)
        self.assertEqual(len(set(asked)), 5)
        self.assertEqual(len(asked), 5)

    def test_a_limit_is_of_processor_time(self) -> None:
        runner = jobs.Runner({"PATH": os.environ["PATH"]}, self.root)
        self.trial._tools = dataclasses.replace(self.trial._tools, cbmc=("sh", "-c"))
        command = self.trial._checker(self.root, runner, 0.3)._cbmc
        self.assertEqual(runner.run([*command, "sleep 1.5; echo done"]).output, "done\n")
        busy = runner.run([*command, "while true; do :; done"], 60.0)
        self.assertFalse(busy.timed_out)
        self.assertNotEqual(busy.status, 0)
        self.assertEqual(self.trial._checker(self.root, runner)._cbmc, ["sh", "-c"])


class SmallFirst(TrialCase):
    killed = "killed: keel_box_put_harness: BOX_001 (KEEL_QUEUE_CAPACITY=2u)"

    def tried(self, kills: Any, others: Any, small_only: bool = False) -> Verdict:
        """What becomes of a mutant, with small harnesses and other questions that answer so."""
        self.trial._small_only = small_only
        with (
            mock.patch.object(Trial, "_compare", lambda *_: None),
            mock.patch.object(mutant_small.Small, "kills", kills),
            mock.patch.object(Trial, "_by_cbmc", others),
            mock.patch.object(Trial, "_by_wp", others),
        ):
            return self.trial.try_mutant(self.mutant())

    def test_who_is_killed_by_a_small_harness_is_shown_to_nobody_else(self) -> None:
        others = mock.Mock(side_effect=AssertionError("asked"))
        verdict = self.tried(lambda *_: self.killed, others)
        self.assertEqual((verdict.status, verdict.engines), ("killed", {"cbmc": self.killed}))

    def test_a_small_harness_that_only_calls_the_function_is_asked_before_a_whole_one(self) -> None:
        seen: list[str] = []

        def kills(_self: object, harness: Any, *_: object) -> str:
            seen.append(harness.name)
            return self.killed if harness.name == "keel_box_get_harness" else ""

        verdict = self.tried(kills, mock.Mock(side_effect=AssertionError("asked")))
        self.assertEqual((verdict.status, verdict.engines["cbmc"]), ("killed", self.killed))
        self.assertEqual(seen[-1], "keel_box_get_harness")

    def test_of_an_accepted_reason_small_harnesses_alone_are_asked(self) -> None:
        self.trial = self.make_trial(accepted=[self.mutant().identity])
        others = mock.Mock(side_effect=AssertionError("asked"))
        verdict = self.tried(lambda *_: "", others)
        self.assertEqual(verdict.status, "survived")
        self.assertEqual(self.tried(lambda *_: self.killed, others).status, "killed")

    def test_what_was_kept_with_a_reason_is_not_taken_without_it(self) -> None:
        accepting = self.make_trial(accepted=[self.mutant().identity])
        accepting.keep(Verdict(self.mutant()))
        self.assertIsNotNone(accepting.known(self.mutant()))
        self.assertIsNone(self.make_trial().known(self.mutant()))

    def test_what_small_harnesses_leave_is_not_tried_when_only_they_are_asked(self) -> None:
        verdict = self.tried(lambda *_: "", mock.Mock(side_effect=AssertionError("asked")), True)
        self.assertEqual(verdict.status, "skipped")


class Unchanged(TrialCase):
    def test_a_harness_that_fails_unchanged_kills_nothing_and_is_proved_once(self) -> None:
        proofs: list[str] = []

        def prove(_self: cbmc.Cbmc, harness: Any) -> cbmc.Result:
            proofs.append(harness.name)
            return cbmc.Result(problems=["no"] if "slow" in harness.name else [])

        with mock.patch.object(cbmc.Cbmc, "prove", prove):
            for _ in range(2):
                trial = self.make_trial()
                trial._proved = Cache(self.root / "verdicts")
                self.assertTrue(trial._passes_unchanged("keel_box_put_harness"))
                self.assertFalse(trial._passes_unchanged("keel_box_put__slow_harness"))
                self.assertFalse(trial._passes_unchanged("keel_box_put__slow_harness"))
                self.assertEqual(trial.unusable, ["keel_box_put__slow_harness"])
        checker = cbmc.Cbmc(
            ("goto-cc",), ("cbmc",), jobs.Runner({}, self.root), self.root, self.root
        )
        read = harness.read_harness(self.unit, self.unit.folder / "keel_box_put_harness.c")
        key = job_list.cbmc_key(read, checker, self.root, {"tool": "t", "driver": "d"})
        self.assertEqual([path.stem for path in (self.root / "verdicts").iterdir()], [key])
        self.assertEqual(proofs.count("keel_box_put_harness"), 1)
        self.assertEqual(proofs.count("keel_box_put__slow_harness"), 2)


class Kept(TrialCase):
    def test_a_verdict_is_kept_until_something_changes(self) -> None:
        mutant = self.mutant()
        self.assertIsNone(self.trial.known(mutant))
        for status in ("killed", "survived", "equivalent"):
            self.trial.keep(Verdict(mutant, status, "why", {"cbmc": "no answer", "wp": "x"}))
            known = self.make_trial().known(mutant)
            assert known
            self.assertEqual((known.status, known.reason), (status, "why"))
        self.assertIsNotNone(self.make_trial(driver="e").known(mutant))
        self.assertIsNone(self.make_trial(stamp="2").known(mutant))
        self.assertIsNone(self.make_trial(wp="2").known(mutant))
        self.assertIsNone(self.make_trial(patient=False).known(mutant))
        path = self.root / "proofs/sail/keel_sail_set_harness.c"
        path.write_text(path.read_text() + "/* new */\n")
        self.assertIsNone(self.make_trial().known(mutant))

    def test_a_counterexample_depends_on_its_harness_and_on_no_contract(self) -> None:
        mutant = self.mutant()
        killed = {"cbmc": "killed: keel_box_put_harness: BOX_001: as the model says"}
        self.trial.keep(Verdict(mutant, "killed", "", killed))
        self.assertIsNotNone(self.make_trial(wp="2", patient=False).known(mutant))
        self.assertIsNone(self.make_trial(stamp="2").known(mutant))
        for name, kept in (("keel_box_put__slow_harness", True), ("keel_box_put_harness", False)):
            path = self.unit.folder / f"{name}.c"
            path.write_text(path.read_text() + "/* a remark */\n")
            self.assertIsNotNone(self.make_trial().known(mutant))
            path.write_text(path.read_text() + "int more;\n")
            self.assertEqual(self.make_trial().known(mutant) is not None, kept)

    def test_what_was_not_tried_is_not_kept(self) -> None:
        self.trial.keep(Verdict(self.mutant(), "skipped", "out of time"))
        self.assertIsNone(self.trial.known(self.mutant()))

    def test_a_report_that_is_not_about_this_is_stale(self) -> None:
        path = self.root / "box.json"
        self.assertEqual(standing("box", path, "d"), "box          no result")
        verdicts = [Verdict(self.mutant(), "killed"), Verdict(self.mutant(), "survived")]
        made = [self.mutant()]

        def digest(trial: Trial) -> str:
            return trial.digest_of(made, "")

        now = digest(self.trial)
        path.write_text(report("box", verdicts, [], 3, now))
        line = "box          killed 1 of 2, 0 equivalent, 1 open"
        self.assertEqual(standing("box", path, now), line)
        for name in ("include/keel/rtos/box.h", "proofs/box/keel_box_put_harness.c"):
            file = self.root / name
            text = file.read_text()
            file.write_text(text + "/* changed */\n")
            with self.subTest(name):
                self.assertIn("STALE", standing("box", path, digest(self.make_trial())))
            file.write_text(text)
        self.assertEqual(standing("box", path, digest(self.make_trial(driver="e"))), line)
        for other in (
            digest(self.make_trial(stamp="2")),
            self.trial.digest_of([], ""),
            self.trial.digest_of(made, "[[equivalent]]"),
        ):
            self.assertIn("STALE", standing("box", path, other))
        path.write_text(path.read_text()[:-20])
        self.assertEqual(standing("box", path, now), "box          no result")

    def test_kinds_are_counted_apart(self) -> None:
        verdicts = [
            Verdict(self.mutant(), status) for status in ("killed", "survived", "stillborn")
        ]
        self.assertIn("x          killed    1 of    2", table(verdicts, ()))
