#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of how mutants are tried: in which order of harnesses, by whom, and what is kept.

    python3 tests/tools/test_crew.py

No prover is run. The cluster is one of threads, and is skipped unless the packages of tools/
dask.requirements.txt are there (python3 tools/toolchain.py ensure dask).
"""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import os
import sys
import tempfile
import unittest
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(Path(__file__).resolve().parent)]

import mutate  # noqa: E402
from proofs.cache import Cache  # noqa: E402
from proofs.mutant_crew import Dask, Threads, answer_order, archive, orders  # noqa: E402
from proofs.mutant_trees import Trees  # noqa: E402
from proofs.mutant_verdicts import Verdict, report, standing, table  # noqa: E402
from proofs.mutants import Mutant, mutants  # noqa: E402
from proofs.mutation import BY_CBMC, BY_WP, NO_ANSWER, Tools, Trial  # noqa: E402
from proofs.project import ProjectError, find_units  # noqa: E402
from proofs.settings import Exceptions  # noqa: E402
from proofs.times import Times  # noqa: E402
from test_prove import HARNESS, SOURCE, TreeTest  # noqa: E402
from toolchain import Toolchain, ToolchainError  # noqa: E402

from proofs import cbmc, cbmc_answers, engines, harness, jobs, mutant_worker  # noqa: E402


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
                "keel_box_put__slow_harness", "keel_box_put"),
            "keel_box_put__eq_harness": harness_text(
                "keel_box_put__eq_harness", "keel_box_put model_box_put"),
            "keel_box_get__eq_harness": harness_text(
                "keel_box_get__eq_harness", "helper keel_box_put model_box_get"),
            "keel_box_get_harness": harness_text("keel_box_get_harness", "keel_box_get"),
            "keel_box_far_harness": harness_text("keel_box_far_harness", "keel_box_far").replace(
                "keel_box_put(&box", "keel_box_far(&box"),
            "keel_box_not_harness": harness_text(
                "keel_box_not_harness", "keel_box_not", "// replaces: keel_box_put\n"),
        }  # fmt: skip
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
            "box/cbmc/keel_box_put_harness": 5, "box/cbmc/keel_box_put__slow_harness": 90,
            "box/cbmc/keel_box_put__eq_harness": 30, "sail/cbmc/keel_sail_set_harness": 1,
        }  # fmt: skip
        (self.root / "times.json").write_text(json.dumps(times))
        self.unit = find_units(self.root)["box"]
        self.trial = self.make_trial()

    def make_trial(
        self, stamp: str = "1", patient: bool = True, driver: str = "d",
        wp: str = "1",
    ) -> Trial:  # fmt: skip
        scratch = Path(tempfile.mkdtemp(dir=self.root.parent, prefix="scratch"))
        self.addCleanup(lambda: __import__("shutil").rmtree(scratch, ignore_errors=True))
        tools = Tools(
            (), ("goto-cc",), ("cbmc",), ("gcc",), {}, scratch, scratch / "a", scratch / "v"
        )
        return Trial(
            self.unit, tools, Trees(self.root, scratch, 1), ("cbmc", "wp"), False,
            Cache(self.root / "cache"),
            {"tool": "t", BY_CBMC: stamp, BY_WP: wp, "driver": driver}, Exceptions(),
            Times(self.root / "times.json"), patient,
        )  # fmt: skip

    def mutant(self, text: str = "*box = value;") -> Mutant:
        start = SOURCE.index(text)
        return Mutant(self.unit.source, "keel_box_put", "x", start, start + len(text), ";", 15,
                      text, ";")  # fmt: skip


class Order(TrialCase):
    def test_equality_first_then_what_covers_then_what_links_and_the_fastest_of_each(self) -> None:
        names = [
            one.name.removesuffix("_harness") for one in self.trial._ranked(self.mutant(), True)
        ]
        self.assertEqual(names, ["keel_box_put__eq", "keel_box_get__eq", "keel_sail_set",
                                 "keel_box_put", "keel_box_put__slow", "keel_box_get"])  # fmt: skip

    def test_at_first_only_those_are_asked_that_cover_it(self) -> None:
        names = [one.name for one in self.trial._ranked(self.mutant(), False)]
        self.assertNotIn("keel_box_get_harness", names)

    def test_a_tree_has_the_model(self) -> None:
        with self.trial._trees.with_mutant(self.mutant(), self.root) as tree:
            self.assertTrue((tree / "specs/model/box.h").is_file())

    def test_who_answered_is_not_asked_again(self) -> None:
        asked: list[str] = []

        def check(_self: cbmc.Cbmc, harness: Any, *_: object) -> cbmc_answers.Answer:
            asked.append(harness.name)
            return cbmc_answers.Answer([], [], [], complete="slow" not in harness.name)

        said: dict[str, str] = {}
        runner = jobs.Runner({}, self.root)
        with (
            mock.patch.object(cbmc.Cbmc, "check", check),
            mock.patch.object(cbmc.Cbmc, "build", lambda *_: (Path("x"), "")),
        ):
            first = self.trial._by_cbmc(self.mutant(), self.unit, runner, False, said)
            begun = len(asked)
            last = self.trial._by_cbmc(self.mutant(), self.unit, runner, True, said)
        self.assertEqual((first, last), (NO_ANSWER, NO_ANSWER))
        self.assertEqual(begun, 5)
        self.assertEqual(asked[begun:], ["keel_box_put__slow_harness", "keel_box_get_harness"])


class FirstOfAll(TrialCase):
    def test_who_is_killed_by_a_small_harness_is_shown_to_nobody_else(self) -> None:
        said = "killed: keel_box_put_harness: BOX_001 (KEEL_QUEUE_CAPACITY=2u)"
        others = mock.Mock(side_effect=AssertionError("asked"))
        with (
            mock.patch.object(Trial, "_compare", lambda *_: None),
            mock.patch.object(Trial, "_by_small", lambda *_: said),
            mock.patch.object(Trial, "_by_cbmc", others),
            mock.patch.object(Trial, "_by_wp", others),
        ):
            verdict = self.trial.try_mutant(self.mutant())
        self.assertEqual((verdict.status, verdict.engines), ("killed", {"cbmc": said}))


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
        key = engines.cbmc_key(read, checker, self.root, {"tool": "t", "driver": "d"})
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
        for other in (digest(self.make_trial(stamp="2")), self.trial.digest_of([], ""),
                      self.trial.digest_of(made, "[[equivalent]]")):  # fmt: skip
            self.assertIn("STALE", standing("box", path, other))
        path.write_text(path.read_text()[:-20])
        self.assertEqual(standing("box", path, now), "box          no result")

    def test_kinds_are_counted_apart(self) -> None:
        verdicts = [
            Verdict(self.mutant(), status) for status in ("killed", "survived", "stillborn")
        ]
        self.assertIn("x          killed    1 of    2", table(verdicts, ()))


class FakeTrial:
    """Notes what it is asked; who runs it is interrupted at the second verdict."""

    def __init__(self) -> None:
        self.tried: list[Mutant] = []
        self.kept: dict[Mutant, Verdict] = {}
        self.unusable: list[str] = []
        self.interrupted = False

    def try_mutant(self, mutant: Mutant) -> Verdict:
        self.tried.append(mutant)
        return Verdict(mutant, "killed", "", {"cbmc": "killed: it"})

    def known(self, mutant: Mutant) -> Verdict | None:
        return self.kept.get(mutant)

    def keep(self, verdict: Verdict) -> None:
        self.kept[verdict.mutant] = verdict
        if len(self.kept) == 2 and not self.interrupted:
            self.interrupted = True
            raise KeyboardInterrupt

    def digest_of(self, mutants: Sequence[Mutant], accepted: str) -> str:
        return f"{len(mutants)} {accepted}"

    def stop(self) -> None:
        pass


class Resumption(TreeTest):
    def measurement(self, trial: FakeTrial) -> mutate.Measurement:
        made: Any = object.__new__(mutate.Measurement)
        made._options = mutate.parse(["--unit", "box"], ["box"])
        made._build = self.root / "build/mutate"
        made.engines = ("cbmc",)
        found = mutants(self.unit.source)[:6]
        fake: Any = trial
        made.units = [mutate.Measured(self.unit, fake, found, 2, {})]
        whole: mutate.Measurement = made
        return whole

    def test_who_was_interrupted_goes_on_where_it_was(self) -> None:
        trial = FakeTrial()
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            with self.assertRaises(KeyboardInterrupt):
                first = self.measurement(trial)
                first.run(Threads(1, first))
            self.assertEqual(len(trial.kept), 2)
            before = set(trial.kept)
            trial.tried.clear()
            second = self.measurement(trial)
            second.run(Threads(1, second))
            self.assertEqual(second.conclude(), 0)
        self.assertEqual(len(trial.tried), 4)
        self.assertFalse(before & set(trial.tried))
        self.assertIn("6 mutants, 2 known before", output.getvalue())
        self.assertRegex(output.getvalue(), r"1/4 +\d+ min left killed ")
        content = json.loads((self.root / "build/mutate/box.json").read_text())
        self.assertEqual((content["summary"]["killed"], content["dropped"]), (6, 2))

    def test_all_cores_and_all_units_unless_told(self) -> None:
        options = mutate.parse([], ["box", "sail"])
        self.assertEqual((options.unit, options.jobs), (["box", "sail"], os.cpu_count()))


# What stands for tools/mutate.py in the archive that is sent to a worker.
PROGRAM = """\
import json, sys
order = json.load(sys.stdin)
if order["quick"]:
    sys.exit("it is too quick")
names = [mutant[2] for mutant in order["mutants"]]
verdicts = [{"status": "killed", "reason": order["unit"], "engines": {"cbmc": n}} for n in names]
print("chatter")
print(json.dumps({"stamp": "s", "verdicts": verdicts}))
"""


def dask_packages() -> str:
    """The folder of the packages, or "" when they are not there."""
    try:
        return Toolchain().command("dask-packages")[0]
    except ToolchainError:
        return ""


class Sent(TreeTest):
    def setUp(self) -> None:
        super().setUp()
        program = self.root / "tools/mutate.py"
        program.parent.mkdir()
        program.write_text(PROGRAM, encoding="utf-8")
        self.found = mutants(self.unit.source)
        fake: Any = FakeTrial()
        self.jobs = [("box", fake, mutant) for mutant in self.found]

    def test_orders_are_of_one_function(self) -> None:
        groups = orders(self.jobs)
        self.assertEqual(sorted(place for group in groups for place in group),
                         list(range(len(self.jobs))))  # fmt: skip
        for group in groups:
            self.assertEqual(len({self.found[place].function for place in group}), 1)
            self.assertLessEqual(len(group), 6)

    def test_a_worker_runs_the_program_that_was_sent(self) -> None:
        sent = archive(self.root)
        self.assertEqual(sent, archive(self.root))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        order = {"unit": "box", "mutants": [["f", "a", "b", 1]], "quick": False}
        with mock.patch.object(tempfile, "tempdir", folder.name):
            for _ in range(2):
                answer = mutant_worker.carry_out(sent, order)
                self.assertEqual(answer["verdicts"][0]["engines"], {"cbmc": "b"})
            [place] = Path(folder.name).iterdir()
            self.assertEqual((place / "src/rtos/box.c").read_text(), SOURCE)
            with self.assertRaisesRegex(RuntimeError, "it is too quick"):
                mutant_worker.carry_out(sent, {**order, "quick": True})

    def test_only_the_answer_goes_out(self) -> None:
        output, error = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(error):

            def carry_out(order: Any) -> dict[str, Any]:
                print("chatter")
                return dict(order)

            answer_order(lambda: '{"a": 1}', carry_out)
        self.assertEqual((output.getvalue(), error.getvalue()), ('{"a": 1}\n', "chatter\n"))

    def test_without_the_packages_it_is_said(self) -> None:
        error = ImportError(name="dask")
        missing = mock.patch.object(importlib, "import_module", side_effect=error)
        with missing, self.assertRaisesRegex(ProjectError, "DASK is set, but there is no dask"):
            Dask("tcp://127.0.0.1:1", self.root, "s", {})

    @contextlib.contextmanager
    def cluster(self) -> Iterator[str]:
        """The address of a cluster in this process."""
        packages = dask_packages()
        if packages not in sys.path:
            sys.path.append(packages)
        distributed: Any = importlib.import_module("distributed")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        with mock.patch.object(tempfile, "tempdir", folder.name), distributed.LocalCluster(
            n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None,
            protocol="tcp", host="127.0.0.1",
        ) as cluster:  # fmt: skip
            yield cluster.scheduler_address

    @unittest.skipUnless(dask_packages(), "needs the packages for Dask")
    def test_a_cluster_tries_them_all(self) -> None:
        with self.cluster() as address:
            crew = Dask(address, self.root, "s", {"engine": None, "quick": False})
            found = dict(crew.run(self.jobs))
            self.assertEqual(sorted(found), list(range(len(self.jobs))))
            for place, verdict in found.items():
                self.assertEqual(verdict.engines, {"cbmc": self.found[place].after})
                self.assertEqual((verdict.status, verdict.reason), ("killed", "box"))
            crew.stop()
            other = Dask(address, self.root, "t", {"engine": None, "quick": False})
            with self.assertRaisesRegex(ProjectError, "a worker has other tools"):
                dict(other.run(self.jobs))
            other.stop()


if __name__ == "__main__":
    unittest.main()
