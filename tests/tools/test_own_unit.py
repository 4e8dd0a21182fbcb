# SPDX-License-Identifier: Apache-2.0
"""Tests of keel.mk and examples/own_unit, as a new user tries them: in a folder of their own.

The provers are the real ones; what they prove of the example is kept in the user's cache.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from makefile import make_in

from keel.install.cache import default_cache

ROOT = Path(__file__).resolve().parents[2]


class OwnUnit(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project = Path(folder.name).resolve() / "own"
        ignored = shutil.ignore_patterns("build")
        shutil.copytree(ROOT / "examples/own_unit", self.project, ignore=ignored)
        self.source = self.project / "src/battery/monitor.c"

    def slip(self, old: str, new: str) -> None:
        """An engineer's mistake."""
        text = self.source.read_text(encoding="utf-8")
        self.assertEqual(text.count(old), 1)
        self.source.write_text(text.replace(old, new), encoding="utf-8")

    def test_the_example_is_proved_where_it_was_copied_to(self) -> None:
        status, output = make_in(self.project, "prove")
        self.assertEqual(status, 0, output)
        self.assertIn("determined: 2 of 2 functions", output)
        report = json.loads((self.project / "build/prove/report.json").read_text("utf-8"))
        self.assertEqual(report["verdict"], "proved")
        self.assertEqual(list(report["units"]), ["monitor"])

    def test_its_own_makefile_does_the_same(self) -> None:
        output = self.dry("keel-prove", f"KEEL={ROOT}", "KEEL_UNIT=monitor", "KEEL_ARGS=--fresh")
        program = f'"{ROOT}/tools/keel" prove --project "{self.project}"'
        self.assertIn(f"{program} --unit monitor --fresh", " ".join(output.split()))
        begun = " ".join(self.dry("keel-new", f"KEEL={ROOT}", "KEEL_UNIT=gauge").split())
        program = f'"{ROOT}/tools/keel" new --project "{self.project}"'
        self.assertIn(f'{program} --unit "gauge"', begun)

    def dry(self, *words: str) -> str:
        """What the project's own Makefile would run, and what it has to say."""
        ended = subprocess.run(
            ["make", "-n", *words],
            cwd=self.project,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        return ended.stdout.replace("\\\n", "")

    def test_an_including_makefile_keeps_its_own_names(self) -> None:
        """Before and behind the project's own rules; a warning of make's would be an overriding."""
        own = "all: ; @echo all $(UNIT) $(ARGS)\ntest: ; @echo own test\nhelp: ; @echo own help\n"
        include = f"include {ROOT}/keel.mk\n"
        for text in (own + include, include + own):
            (self.project / "Makefile").write_text(f"UNIT := u\nARGS := a\n{text}")
            for target, said in (("", "all u a"), ("test", "own test"), ("help", "own help")):
                words = [target] if target else []
                self.assertEqual(self.dry(*words), f"echo {said}\n")
            program = f'"{ROOT}/tools/keel" prove --project "{self.project}"'
            self.assertTrue(" ".join(self.dry("keel-prove").split()).endswith(program))
            self.assertIn("No rule to make target 'prove'", self.dry("prove"))

    def test_its_help_has_the_names_that_can_be_typed(self) -> None:
        output = make_in(self.project, "help")[1]
        self.assertRegex(output, r"make prove +prove the project \(UNIT=monitor; ARGS=")
        self.assertNotIn("keel-", output)
        command = ["make", "keel-help", f"KEEL={ROOT}"]
        output = subprocess.check_output(command, cwd=self.project, text=True)
        self.assertRegex(output, r"make keel-prove +prove the project \(KEEL_UNIT=monitor; ")

    def test_its_unit_tests_pass_and_notice_a_mistake(self) -> None:
        status, output = make_in(self.project, "test")
        self.assertEqual((status, output.splitlines()[-1]), (0, "4 of 4 tests passed"), output)
        self.slip("monitor->alarm = true;", "monitor->alarm = false;")
        status, output = make_in(self.project, "test")
        self.assertNotEqual(status, 0)
        self.assertRegex(output, r"FAILED BAT_002_\w+: tests/unit/test_monitor.c:\d+")

    def test_its_unit_tests_need_no_compiler_of_cxx(self) -> None:
        """A machine that has the programs of C alone, and may install nothing."""
        programs, cache = self.project.parent / "programs", self.project.parent / "cache"
        programs.mkdir()
        cache.mkdir()
        (cache / "tools").symlink_to(default_cache() / "tools")
        for name in ("make", "python3", "gcc", "as", "ld", "sh"):
            (programs / name).symlink_to(Path(shutil.which(name) or name).resolve())
        ended = subprocess.run(
            [programs / "make", "-f", ROOT / "keel.mk", "test"],
            cwd=self.project,
            text=True,
            env={"PATH": str(programs), "KEEL_CACHE": str(cache), "KEEL_NO_INSTALL": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
            timeout=900,
        )
        self.assertIn("4 of 4 tests passed", ended.stdout)

    def test_a_mistake_fails_the_proof_and_is_explained(self) -> None:
        self.slip("low < BATTERY_MONITOR_SAMPLES", "low <= BATTERY_MONITOR_SAMPLES")
        status, output = make_in(self.project, "prove", "UNIT=monitor", "ARGS=--engine cbmc")
        self.assertEqual(status, 2)  # As make ends, whatever the reason; the program tells it.
        self.assertIn("BAT_002_model: as the model says: REFUTED by a counterexample", output)
        explain = "UNIT=monitor ARGS='--explain battery_monitor_step_harness'"
        command = f"make -f {ROOT}/keel.mk prove {explain}"
        self.assertIn(f"to see why: {command}", output)
        status, output = make_in(
            self.project, "prove", "UNIT=monitor", "ARGS=--explain BAT_002_model"
        )
        self.assertNotEqual(status, 0)
        self.assertIn("monitor.low = 6 (before: 5)", output)
        self.assertIn("before: 5", output)

    def test_what_is_not_proved_is_told_apart_from_what_could_not_be_tried(self) -> None:
        tools = str(ROOT / "tools/keel")
        program = [sys.executable, tools, "prove", "--project", str(self.project)]

        def status(unit: str) -> int:
            return subprocess.run(
                [*program, "--engine", "cbmc", "--unit", unit],
                check=False,
                capture_output=True,
                timeout=900,
            ).returncode

        self.assertEqual(status("monitor"), 0)
        self.slip("low < BATTERY_MONITOR_SAMPLES", "low <= BATTERY_MONITOR_SAMPLES")
        self.assertEqual(status("monitor"), 1)
        self.assertEqual(status("monito"), 2)

    def test_its_evidence_has_its_own_requirements_tasks_and_proofs(self) -> None:
        status, output = make_in(self.project, "evidence")
        self.assertEqual(status, 0, output)
        place = self.project / "build/evidence"
        page = (place / "site/function-battery_monitor_step.html").read_text(encoding="utf-8")
        for proof in ("@ ensures BAT_002_", "battery_monitor_step_harness", "BAT-002"):
            self.assertIn(proof, page)
        index = (place / "index.html").read_text(encoding="utf-8")
        self.assertIn("schedulable: every task meets its deadline", index)
        self.assertIn("constraints kept", index)
        status, output = make_in(self.project, "evidence", "VERIFY=build/evidence")
        self.assertEqual(status, 0, output)
        (place / "proofs/part.json").write_text("{}", encoding="utf-8")
        status, output = make_in(self.project, "evidence", "VERIFY=build/evidence")
        self.assertNotEqual(status, 0)
        self.assertIn("FAILED proofs/part.json: was altered", output)

    def change(self, name: str, old: str, new: str) -> str:
        """What make evidence says after a change of one of the project's files."""
        path = self.project / name
        text = path.read_text(encoding="utf-8")
        self.assertEqual(text.count(old), 1)
        path.write_text(text.replace(old, new), encoding="utf-8")
        status, output = make_in(self.project, "evidence")
        self.assertNotEqual(status, 0, output)
        self.assertFalse((self.project / "build/evidence").exists())
        return output

    def test_its_evidence_needs_each_requirement_shown(self) -> None:
        output = self.change("specs/requirements.toml", 'id = "BAT-002"', 'id = "BAT-003"')
        self.assertIn("requirements: BAT-003: no proof names it", output)
        self.assertIn("requirements: BAT-003: no test names it", output)
        self.assertIn("requirements: BAT-002: a test names it, but", output)

    def test_its_evidence_needs_a_table_that_holds_and_every_constraint_kept(self) -> None:
        output = self.change("specs/tasks.toml", "budget_us = 50", "budget_us = 950")
        self.assertIn("FAILED tasks: specs/tasks.toml: ", output)
        output = self.change("specs/constraints.toml", 'id = "SC-07"', 'id = "SC-99"')
        self.assertIn("SC-99: there is no such constraint", output)

    def test_a_folder_that_is_no_project_is_refused_in_one_line(self) -> None:
        shutil.rmtree(self.project / "include")
        output = make_in(self.project, "prove")[1]
        self.assertIn(f"prove: {self.project}: there is no unit, include/LAYER/NAME.h", output)
