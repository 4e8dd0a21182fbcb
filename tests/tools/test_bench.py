# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel bench: what it reads from callgrind, what it counts, and when it fails.

One class measures a function whose instructions are known: it is written in assembly. The last
runs the demo (examples/urpilot), which shares its table of tasks with the benchmark, and holds it
against table 2 of the paper, copied here a second time.
"""

from __future__ import annotations

import contextlib
import io
import platform
import re
import subprocess
import tempfile
import unittest
from collections import Counter
from pathlib import Path
from unittest import mock

from keel.base.errors import ToolError
from keel.bench import assembly, callgrind, emulated, tables
from keel.bench import command as bench
from keel.bench.budget import read_budget
from keel.bench.callgrind import Dump
from keel.bench.command import Host, Measured
from keel.bench.kinds import KINDS, NO_TASK, Kind, merged
from keel.bench.tables import Goal, Target
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

# Three dumps as callgrind writes them. In the first, keel_step's own 40 + 30 instructions stand
# around a call whose cost (7) is the clock's; the last has no label, so it is not ours.
CALLGRIND = """\
# callgrind format
version: 1
part: 1
desc: Timerange: Basic block 0 - 10
desc: Trigger: Client Request: keel waited 10
positions: line
events: Ir
summary: 77

fn=bench_clock
0 7

fn=keel_step
0 40
cfn=bench_clock
calls=10 0
0 7
0 30

totals: 77
part: 2
desc: Trigger: Client Request: keel other 1
events: Ir
fn=keel_step
12 50
cfn=keel_next
calls=1 0
12 25
fn=keel_next
0 25
totals: 75
part: 3
desc: Trigger: Program termination
fn=keel_step
0 1000
"""
LAYER = frozenset({"keel_step", "keel_next"})


class DumpTest(unittest.TestCase):
    def dumps(self) -> list[Dump]:
        return list(callgrind.read_dumps(CALLGRIND.splitlines(keepends=True)))

    def test_labelled_dumps_are_read_with_own_costs_only(self) -> None:
        first, second = self.dumps()
        self.assertEqual(first, Dump("waited", 10, Counter(bench_clock=7, keel_step=70)))
        self.assertEqual(second, Dump("other", 1, Counter(keel_step=50, keel_next=25)))

    def test_only_the_layer_is_counted(self) -> None:
        found = callgrind.sum_dumps(self.dumps(), LAYER)
        self.assertEqual((found["waited"].passes, found["waited"].mean), (10, 7.0))
        self.assertEqual((found["other"].mean, found["other"].longest), (75.0, 75))
        self.assertEqual(found["idle"], Kind())

    def test_the_longest_of_several_passes(self) -> None:
        dumps = [Dump("other", 1, Counter(keel_step=cost)) for cost in (10, 40, 25)]
        kind = callgrind.sum_dumps(dumps, LAYER)["other"]
        self.assertEqual((kind.passes, kind.mean, kind.longest), (3, 25.0, 40))

    def test_kinds_are_taken_together_by_their_passes(self) -> None:
        found = {"waited": Kind(9, 90), "idle": Kind(1, 110, 110)}
        total = merged(found, NO_TASK)
        self.assertEqual((total.passes, total.mean, total.longest), (10, 20.0, 110))

    def test_an_instruction_of_nobody_is_an_error(self) -> None:
        for name in ("memcpy", "keel_unknown", "bench"):
            with self.assertRaisesRegex(ToolError, name):
                callgrind.sum_dumps([Dump("other", 1, Counter({name: 1}))], LAYER)

    def test_an_unknown_kind_is_an_error(self) -> None:
        with self.assertRaisesRegex(ToolError, "odd"):
            callgrind.sum_dumps([Dump("odd", 1)], LAYER)


class MeasureTest(unittest.TestCase):
    HOST = Host(Path("x"), LAYER)

    def kinds(self, cost: int) -> dict[str, Kind]:
        return {name: Kind(1, cost, cost) for name in KINDS}

    def measure(self, *runs: dict[str, Kind]) -> dict[str, Kind]:
        with mock.patch.object(bench, "count", side_effect=runs):
            return bench.measure_set(mock.Mock(), self.HOST, 21)

    def test_two_equal_runs_are_a_result(self) -> None:
        self.assertEqual(self.measure(self.kinds(5), self.kinds(5)), self.kinds(5))

    def test_two_runs_that_differ_by_one_are_an_error(self) -> None:
        with self.assertRaisesRegex(ToolError, "differ"):
            self.measure(self.kinds(5), self.kinds(6))

    def test_a_kind_that_never_came_is_an_error(self) -> None:
        for gone in (["waited"], ["idle"], ["realtime", "other"]):
            kinds = {**self.kinds(5), **{name: Kind() for name in gone}}
            with self.subTest(gone), self.assertRaisesRegex(ToolError, "no pass"):
                self.measure(kinds, kinds)


class TargetTest(unittest.TestCase):
    def test_sizes_are_read(self) -> None:
        text = "  text\t data\t bss\t dec\t hex\tfilename\n 428\t 4\t 8\t 440\t 1b8\tx/decision.o\n"
        self.assertEqual(bench.read_sizes(text), {"decision": (428, 12)})

    def test_symbols_are_read(self) -> None:
        text = "00000000 0000001c B bench_size_config\n00000028 00000640 B bench_size_scheduler\n"
        self.assertEqual(bench.read_symbols(text), {"config": 28, "scheduler": 1600})

    def test_a_task_is_what_a_scheduler_grows_by(self) -> None:
        less, more = bench.CAPACITIES
        self.assertEqual(bench.size_of_task(64 + 40 * less, 64 + 40 * more), 40)
        for wrong in (64 + 40 * more + 1, 64 + 40 * less, 0):
            with self.subTest(wrong), self.assertRaisesRegex(ToolError, "whole tasks"):
                bench.size_of_task(64 + 40 * less, wrong)

    def test_totals(self) -> None:
        target = Target({"a": 100, "b": 50}, {}, {"task": 40})
        self.assertEqual((target.per_task, target.total), (40, 150))


# As objdump -dr writes it. The step calls its own helper and, in a tail call, another.
LISTING = """\
x.o:     file format elf32-littlearm

00000000 <keel_step>:
   0:\ted90 7a01 \tvldr\ts14, [r0, #4]
   4:\tf7ff fffe \tbl\t0 <helper>
\t\t\t4: R_ARM_THM_CALL\thelper
   8:\tf7ff bffe \tb.w\t0 <keel_other>
\t\t\t8: R_ARM_THM_JUMP24\tkeel_other

00000000 <helper>:
   0:\ted2d 8b02 \tvpush\t{d8}
   4:\tee30 0a00 \tvadd.f32\ts0, s0, s0

00000000 <keel_other>:
   0:\t4770      \tbx\tlr
"""


class StepTest(unittest.TestCase):
    def refused(self, old: str, new: str) -> str:
        self.assertIn(old, LISTING)
        with self.assertRaises(ToolError) as caught:
            assembly.refuse_slow_code(assembly.read_code(LISTING.replace(old, new)), "keel_step")
        return str(caught.exception)

    def test_functions_are_read(self) -> None:
        code = assembly.read_code(LISTING)
        self.assertEqual(list(code), ["keel_step", "helper", "keel_other"])
        self.assertEqual(code["keel_step"].calls, {"helper", "keel_other"})
        self.assertEqual([item.instructions for item in code.values()], [3, 2, 1])

    def test_single_precision_and_own_calls_are_fine(self) -> None:
        assembly.refuse_slow_code(assembly.read_code(LISTING), "keel_step")

    def test_double_precision_is_refused_also_in_a_callee(self) -> None:
        for wrong in ("vadd.f64\td0, d0, d0", "vcvt.f64.f32\td0, s0", "vcvt.f32.f64\ts0, d0"):
            self.assertIn("helper", self.refused("vadd.f32\ts0, s0, s0", wrong))

    def test_a_library_call_is_refused(self) -> None:
        self.assertIn("sqrtf", self.refused("CALL\thelper", "CALL\tsqrtf"))
        self.assertIn("__aeabi_dmul", self.refused("JUMP24\tkeel_other", "JUMP24\t__aeabi_dmul"))

    def test_what_no_step_reaches_may_call(self) -> None:
        more = LISTING + "\n00000000 <keel_init>:\n\t\t\t0: R_ARM_THM_CALL\tmemcpy\n"
        assembly.refuse_slow_code(assembly.read_code(more), "keel_step")

    def test_a_step_that_is_gone_is_an_error(self) -> None:
        with self.assertRaisesRegex(ToolError, "keel_gone"):
            assembly.refuse_slow_code(assembly.read_code(LISTING), "keel_gone")


class GoalTest(unittest.TestCase):
    TARGET = Target({"a": 2048}, {}, {"task": 40})

    def goals(self, waited: int, one: int) -> list[Goal]:
        found = {name: Kind() for name in KINDS}
        found["waited"] = Kind(2, waited * 2)
        found["other"] = Kind(2, one * 2)
        return bench.goals_of(found, self.TARGET, read_budget())

    def test_a_goal_is_met_up_to_its_limit(self) -> None:
        self.assertEqual([goal.met for goal in self.goals(25, 200)], [True] * 4)
        self.assertEqual([goal.met for goal in self.goals(26, 201)], [False, False, True, True])

    def test_the_verdict_tells_what_is_missed(self) -> None:
        self.assertIn("all 4 goals met", tables.verdict(self.goals(25, 200)))
        self.assertIn(
            "1 of 4 goals missed: instructions, no task 26.0 > 25",
            tables.verdict(self.goals(26, 1)),
        )

    def status(self, goals: list[Goal], *arguments: str) -> int:
        host = Measured({bench.GOAL_SET: {}}, self.TARGET, {}, goals)
        with contextlib.ExitStack() as stack:
            stack.enter_context(contextlib.redirect_stdout(io.StringIO()))
            for name in ("print_host", "write_report", "host_report", "together"):
                stack.enter_context(mock.patch.object(bench, name, return_value={}))
            stack.enter_context(mock.patch.object(bench, "measure_host", return_value=host))
            stack.enter_context(mock.patch.object(emulated, "measure", return_value={}))
            stack.enter_context(mock.patch.object(tables, "print_figures"))
            stack.enter_context(mock.patch.object(Toolchain, "ensure"))
            return bench.main(arguments)

    def test_a_missed_goal_fails_a_check_only(self) -> None:
        self.assertEqual(self.status(self.goals(26, 1)), 0)
        self.assertEqual(self.status(self.goals(26, 1), "--check"), 1)
        self.assertEqual(self.status(self.goals(25, 1), "--check"), 0)

    def test_an_error_fails(self) -> None:
        quiet = contextlib.redirect_stderr(io.StringIO())
        with quiet, mock.patch.object(bench, "measure_host", side_effect=ToolError("x")):
            with mock.patch.object(Toolchain, "ensure"):
                self.assertEqual(bench.main([]), 2)


# A step of five instructions and a call of the clock, which has two of its own.
KNOWN = """
#include <valgrind/callgrind.h>
void keel_step(void);
__asm__(".text\\n.globl keel_step\\n.type keel_step,@function\\nkeel_step:\\n"
        "nop\\nnop\\nnop\\ncall bench_clock\\nret\\n.size keel_step,.-keel_step\\n"
        ".type bench_clock,@function\\nbench_clock:\\nnop\\nret\\n"
        ".size bench_clock,.-bench_clock\\n");
static void bench_step(void)
{
    CALLGRIND_TOGGLE_COLLECT;
    keel_step();
    CALLGRIND_TOGGLE_COLLECT;
}
int main(void)
{
    for (int i = 0; i < 4; i++) { bench_step(); }
    CALLGRIND_DUMP_STATS_AT("keel waited 4");
    bench_step();
    CALLGRIND_DUMP_STATS_AT("keel other 1");
    return 0;
}
"""


@unittest.skipUnless(platform.machine() == "x86_64", "the known function is x86-64 assembly")
class CallgrindTest(unittest.TestCase):
    def test_known_instructions_are_counted_exactly(self) -> None:
        tools = Toolchain()
        tools.ensure("bench", say=lambda _: None)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "known.c").write_text(KNOWN)
            program = folder / "known"
            gcc = [*tools.command("gcc"), "-O1", str(folder / "known.c"), "-o", str(program)]
            subprocess.run(gcc, check=True)
            with mock.patch.object(bench, "BUILD", folder):
                kinds = bench.count(tools, Host(program, frozenset({"keel_step"})), 1)
        self.assertEqual((kinds["waited"].passes, kinds["waited"].instructions), (4, 20))
        self.assertEqual((kinds["other"].passes, kinds["other"].longest), (1, 5))


# Table 2 of the paper: class, period in ms, worst-case execution time in us.
TABLE_2 = {
    "Scheduler analysis": ("low", 100, 10),
    "Stack": ("low", 100, 7),
    "ADC": ("low", 1000, 18),
    "Background power module": ("low", 20, 8),
    "Foreground power module": ("low", 100, 17),
    "Background barometer": ("high", 10, 50),
    "Foreground barometer": ("medium-high", 20, 50),
    "Background magnetometer": ("high", 10, 350),
    "Foreground magnetometer": ("medium-high", 20, 37),
    "Calibration magnetometer": ("low", 50, 41),
    "Background IMU": ("real time", 1, 57),
    "Foreground IMU": ("real time", 2, 37),
    "Calibration IMU": ("low", 50, 22),
    "GPS": ("medium", 20, 355),
    "Background radio": ("medium", 10, 21),
    "Foreground radio": ("medium", 20, 53),
    "Navigation": ("medium", 20, 47),
    "Angle rate control": ("real time", 2, 83),
    "Angle control": ("high", 2, 71),
    "Position control": ("high", 10, 11),
    "State machine": ("low", 20, 11),
}
# With a turn of the loop of 5 us a real-time task waits at most 4 us for the next turn, and for
# the real-time tasks before it: nothing else runs when one of them is due.
LATEST_US = {"Background IMU": 4, "Foreground IMU": 4 + 57, "Angle rate control": 4 + 57 + 37}
ROW = re.compile(r"^(\S.*?) {2,}(low|medium|medium-high|high|real time) +(\d.*)$")


class DemoTest(unittest.TestCase):
    program: Path

    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.program = Path(folder.name) / "demo"
        sources = [*ROOT.glob("src/rtos/*.c"), *ROOT.glob("examples/urpilot/*.c")]
        gcc = [*Toolchain().command("gcc"), "-std=c99", "-O1", "-Wall", "-Wextra", "-Werror"]
        gcc += ["-fsanitize=undefined,address", "-fno-sanitize-recover=all"]
        folders = [f"-I{ROOT / name}" for name in ("include", "examples/urpilot")]
        subprocess.run([*gcc, *folders, *sources, "-lm", "-o", cls.program], check=True)

    def demo(self, *arguments: str) -> tuple[int, list[str]]:
        done = subprocess.run(
            [self.program, *arguments], capture_output=True, text=True, timeout=60, check=False
        )
        return done.returncode, done.stdout.splitlines()

    def test_every_task_of_table_2_runs_once_per_period(self) -> None:
        status, lines = self.demo()
        rows = [match for match in map(ROW.match, lines) if match]
        self.assertEqual(status, 0)
        self.assertEqual([row[1] for row in rows], list(TABLE_2))
        for row in rows:
            name, sort, numbers = row[1], row[2], row[3].split()
            figures = [int(word) for word in numbers if "." not in word]
            period, runs, _, mean, longest, latest, *counters = figures
            self.assertEqual((sort, period, longest), TABLE_2[name])
            self.assertEqual((runs, mean), (60000 // period, longest), name)
            self.assertLessEqual(latest, LATEST_US.get(name, period * 1000 - longest), name)
            self.assertEqual(counters, [0, 0, 0, 0], name)

    def test_the_load_is_that_of_table_2(self) -> None:
        load = sum(wcet / (10 * period) for _, period, wcet in TABLE_2.values())
        _, lines = self.demo()
        (line,) = [line for line in lines if line.startswith("CPU load")]
        minute, _, _, declared = re.findall(r"([\d.]+) (?:%|ms)", line)
        self.assertAlmostEqual(float(declared), load, places=3)
        self.assertAlmostEqual(float(minute), load, places=2)

    def test_a_loop_that_is_too_slow_fails(self) -> None:
        status, lines = self.demo("3000")
        self.assertEqual(status, 1)
        self.assertTrue(lines[-1].startswith("FAILED: 21 of 21"), lines[-1])

    def test_a_wrong_command_line_is_refused(self) -> None:
        for arguments in (["x"], ["0"], ["5", "5"], ["-1"]):
            self.assertEqual(self.demo(*arguments)[0], 2, arguments)
