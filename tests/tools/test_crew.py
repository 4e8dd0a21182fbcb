# SPDX-License-Identifier: Apache-2.0
"""Tests of how mutants are tried: by whom, and how who was interrupted goes on.

No prover is run. The cluster is one of threads, and is skipped unless the
packages of the group dask are there (python3 tools/keel tools ensure dask).
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

from test_prove import SOURCE, TreeTest

from keel.base import cluster_worker
from keel.base.cluster import archive
from keel.c.project import ProjectError
from keel.install import Toolchain, ToolchainError
from keel.mutate import command as mutate
from keel.mutate.crew import PROGRAM, SENT, Dask, Threads, answer_order, orders
from keel.mutate.execution import Sample
from keel.mutate.operators import Mutant, mutants
from keel.mutate.verdicts import Verdict

ROOT = Path(__file__).resolve().parents[2]


class FakeTrial:
    """Notes what it is asked; who runs it is interrupted at the second verdict."""

    def __init__(self) -> None:
        self.tried: list[Mutant] = []
        self.kept: dict[Mutant, Verdict] = {}
        self.unusable: list[str] = []
        self.not_executed: dict[str, str] = {}
        self.sample = Sample(50)
        self.late = Sample(10)
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


# Stands for the tools in the archive that is sent to a worker.
FAKE = """\
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
        program = self.root / "tools/keel/__main__.py"
        program.parent.mkdir(parents=True)
        program.write_text(FAKE, encoding="utf-8")
        self.found = mutants(self.unit.source)
        fake: Any = FakeTrial()
        self.jobs = [("box", fake, mutant) for mutant in self.found]

    def test_orders_are_of_one_function(self) -> None:
        groups = orders(self.jobs)
        self.assertEqual(
            sorted(place for group in groups for place in group), list(range(len(self.jobs)))
        )
        for group in groups:
            self.assertEqual(len({self.found[place].function for place in group}), 1)
            self.assertLessEqual(len(group), 6)

    def test_a_worker_runs_the_program_that_was_sent(self) -> None:
        sent = archive(self.root, SENT)
        self.assertEqual(sent, archive(self.root, SENT))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        order = {"unit": "box", "mutants": [["f", "a", "b", 1]], "quick": False}
        with mock.patch.object(tempfile, "tempdir", folder.name):
            for _ in range(2):
                answer = cluster_worker.carry_out(sent, PROGRAM, order)
                self.assertEqual(answer["verdicts"][0]["engines"], {"cbmc": "b"})
            [place] = Path(folder.name).iterdir()
            self.assertEqual((place / "src/rtos/box.c").read_text(), SOURCE)
            with self.assertRaisesRegex(RuntimeError, "it is too quick"):
                cluster_worker.carry_out(sent, PROGRAM, {**order, "quick": True})

    def test_the_tools_themselves_start_from_what_is_sent(self) -> None:
        """The command and its packages: what FAKE does not need."""
        code = "import sys; sys.path[:0] = ['tools']; import keel.install as i; i.Toolchain()"
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        sent = archive(ROOT, SENT)
        with mock.patch.object(tempfile, "tempdir", folder.name):
            answer = cluster_worker.carry_out(sent, ["-c", f"{code}; print('7')"], {})
        self.assertEqual(answer, 7)

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
        with (
            mock.patch.object(tempfile, "tempdir", folder.name),
            distributed.LocalCluster(
                n_workers=1,
                threads_per_worker=2,
                processes=False,
                dashboard_address=None,
                protocol="tcp",
                host="127.0.0.1",
            ) as cluster,
        ):
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
