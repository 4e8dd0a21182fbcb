# SPDX-License-Identifier: Apache-2.0
"""Tests of the limits of programs: of their processor time, whatever else the machine does."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from collections.abc import Sequence
from pathlib import Path

from endless import CORES, busy
from endless import PROGRAM as ENDLESS

from keel.base import run
from keel.base.jobs import Runner
from keel.install import Toolchain, ToolchainError, small_environment
from keel.install.provers import CLOCK_PER_PROCESSOR, by_processor_time

ROOT = Path(__file__).resolve().parents[2]

# As much processor time as is told, and then a word.
BURN = """\
import sys, time
while time.process_time() < float(sys.argv[1]):
    pass
print('done')
"""


def pigeons(holes: int) -> str:
    """That one pigeon more than there are holes finds no place: easy to say, and long to prove."""
    birds = range(holes + 1)
    lines = ["(set-logic QF_UF)"]
    lines += [f"(declare-fun p{i}_{k} () Bool)" for i in birds for k in range(holes)]
    for i in birds:
        lines.append(f"(assert (or {' '.join(f'p{i}_{k}' for k in range(holes))}))")
        lines += [f"(assert (not (and p{i}_{k} p{j}_{k})))" for j in range(i) for k in range(holes)]
    return "\n".join([*lines, "(check-sat)\n"])


def ended(words: Sequence[str]) -> tuple[str, float]:
    """What a program says, and the processor's time that it alone has used, the system's too."""
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout
        said = child.stdout.read()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    return said, usage.ru_utime + usage.ru_stime


class Programs(unittest.TestCase):
    def test_a_program_ends_with_its_processor_time(self) -> None:
        for text in (ENDLESS, f"import os\nos.fork()\n{ENDLESS}"):
            ended = run.run([sys.executable, "-c", text], 0.5)
            self.assertTrue(ended.timed_out)
            self.assertIn("processor time", ended.how)

    def test_a_busy_machine_takes_nothing_from_it(self) -> None:
        start = time.monotonic()
        with busy(4 * CORES):
            ended = run.run([sys.executable, "-c", BURN, "0.6"], 1.0)
        self.assertEqual((ended.output, ended.timed_out), ("done\n", False))
        self.assertGreater(time.monotonic() - start, 1.0, "the machine was not busy")

    def test_a_program_that_does_nothing_hangs(self) -> None:
        ended = run.run([sys.executable, "-c", "import time\ntime.sleep(60)"], 0.7)
        self.assertTrue(ended.timed_out)

    def test_what_a_child_has_used_counts_when_it_has_ended(self) -> None:
        twice = "import subprocess, sys\nfor _ in range(2):\n    subprocess.run(sys.argv[1:])\n"
        words = [sys.executable, "-c", twice, sys.executable, "-c", BURN, "0.5"]
        self.assertTrue(run.run(words, 0.8).timed_out)
        self.assertFalse(run.run(words, 3.0).timed_out)

    def test_provers_are_limited_alike(self) -> None:
        runner = Runner(small_environment({}), ROOT)
        self.assertTrue(runner.run([sys.executable, "-c", ENDLESS], 0.5).timed_out)
        self.assertFalse(runner.run([sys.executable, "-c", BURN, "0.2"], 0.5).timed_out)


class Provers(unittest.TestCase):
    """The script that starts a prover for why3."""

    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def script(self, program: str) -> str:
        """The script that starts a program."""
        place = self.folder / "script"
        place.write_text(by_processor_time(program), encoding="utf-8")
        place.chmod(0o755)
        return str(place)

    def started(self, program: str, *words: str) -> subprocess.CompletedProcess[str]:
        """How a program ends that is started by the script."""
        line = [self.script(program), *words]
        return subprocess.run(line, capture_output=True, text=True, check=False)

    def test_a_time_by_the_clock_becomes_one_of_the_processor(self) -> None:
        seconds = str(10 * CLOCK_PER_PROCESSOR)
        self.assertEqual(
            self.started("/bin/echo", "-timelimit", seconds, "f.why").stdout,
            "-timelimit 10 f.why\n",
        )
        self.assertEqual(
            self.started("/bin/echo", "--stats", f"--tlimit={seconds}000").stdout,
            "--stats --tlimit=10000\n",
        )
        self.assertEqual(
            self.started("/bin/echo", "--rlimit=6000", "a b").stdout,
            "--tlimit=10000 --rlimit=6000 a b\n",  # a test for contradictions has both
        )

    def test_z3_is_ended_by_the_system(self) -> None:
        program = self.folder / "endless"
        program.write_text(f"#!{sys.executable}\n{ENDLESS}", encoding="utf-8")
        program.chmod(0o755)
        ended = self.started(str(program), f"-T:{CLOCK_PER_PROCESSOR}")
        self.assertEqual(ended.returncode, -signal.SIGXCPU)

    def test_cvc4_counts_its_own_time(self) -> None:
        try:
            [cvc4] = Toolchain().command("cvc4")
        except (ToolchainError, ValueError):
            self.skipTest("cvc4 is not installed: make prove")
        goal = self.folder / "goal.smt2"
        goal.write_text(pigeons(11), encoding="utf-8")
        limit = f"--tlimit={2 * CLOCK_PER_PROCESSOR}000"
        with busy(2 * CORES):
            said, used = ended([self.script(cvc4), limit, "--lang=smt2", str(goal)])
        self.assertEqual(said, "unknown\n")
        # It ends up to 0.6 s before its limit; by the clock it would have had some 0.5 s.
        self.assertGreater(used, 1.0, "it was ended by the clock")
