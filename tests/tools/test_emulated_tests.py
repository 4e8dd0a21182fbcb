# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel test-target: how it judges what an emulated board printed, and that a
program which hangs or computes something else is a failure.
"""

from __future__ import annotations

import shutil
import unittest
from pathlib import Path
from unittest import mock

from keel.base.run import Ended
from keel.install import Toolchain
from keel.test import emulated_tests
from keel.test.emulated import EmulatedBoard
from keel.test.faults import FAULTS, judge_fault, read_record
from keel.test.outcomes import unity_outcome

ROOT = Path(__file__).resolve().parents[2]

OWN = Path("build/test/emulated_tests")
DIVISION = """\
breaking
safe state: fault 1 exception 6 code 0x00000000 task breaker
  cfsr 0x02000000 hfsr 0x00000000 mmfar 0x00000000 bfar 0x00000000
  sp 0x20004360 exc_return 0xffffffe9
  stacked pc 0x00200a44 lr 0x00000961 xpsr 0x01000000
  r0 0x00000000 r1 0x00000000 r2 0x70000000 r3 0x20020028 r12 0x000003e8
  r4 0x20020030 0x00000000 0x00000000 0x200043f8 0x00000000 0x00000000 0x00000000 0x00000000
"""
SPAN = range(0x200A40, 0x200A50)


class Records(unittest.TestCase):
    """A fault's record, as printed."""

    def judge(self, kind: str, *changes: tuple[str, str], span: range = SPAN) -> list[str]:
        text = DIVISION
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        return judge_fault(FAULTS[kind], read_record(text), span)

    def test_a_record_is_read(self) -> None:
        found = read_record(DIVISION)
        self.assertEqual(found["exception"], "6")
        self.assertEqual(found["task"], "breaker")
        self.assertEqual(found["pc"], "0x00200a44")
        self.assertEqual(found["stacked"], "yes")

    def test_what_is_expected(self) -> None:
        self.assertEqual(self.judge("division"), [])

    def test_no_record(self) -> None:
        self.assertEqual(judge_fault(FAULTS["division"], {}, SPAN), ["no record was printed"])

    def test_another_exception(self) -> None:
        wrong = self.judge("division", ("exception 6", "exception 3"))
        self.assertEqual(wrong, ["exception is 3, not 6"])

    def test_another_status(self) -> None:
        wrong = self.judge("division", ("cfsr 0x02000000", "cfsr 0x02010000"))
        self.assertEqual(wrong, ["cfsr is 0x02010000, not 0x02000000"])

    def test_another_task(self) -> None:
        self.assertEqual(
            self.judge("division", ("task breaker", "task -")), ["task is -, not breaker"]
        )

    def test_a_second_fault(self) -> None:
        self.assertEqual(self.judge("division", ("fault 1", "fault 2")), ["fault is 2, not 1"])

    def test_another_place(self) -> None:
        wrong = self.judge("division", span=range(0x100, 0x110))
        self.assertEqual(wrong, ["pc is 0x00200a44, not in 0x00000100 to 0x00000110"])

    def test_the_address_of_a_bus_fault(self) -> None:
        bus = (("exception 6", "exception 5"), ("cfsr 0x02000000", "cfsr 0x00008200"))
        good = self.judge("bus", *bus, ("bfar 0x00000000", "bfar 0x70000000"))
        self.assertEqual(good, [])
        self.assertEqual(self.judge("bus", *bus), ["the address is 0x00000000, not 0x70000000"])

    def test_the_stack_met_its_guard(self) -> None:
        stack = (("exception 6", "exception 4"), ("  stacked", "  not stacked"))
        status = ("cfsr 0x02000000", "cfsr 0x00000092")
        inside, above = (
            ("mmfar 0x00000000", "mmfar 0x200003f8"),
            ("mmfar 0x00000000", "mmfar 0x20000400"),
        )
        self.assertEqual(self.judge("stack", *stack, status, inside, span=range(0)), [])
        self.assertEqual(len(self.judge("stack", *stack, status, above, span=range(0))), 1)
        self.assertEqual(len(self.judge("stack", status, inside, span=range(0))), 2)


FLIGHT = (
    "flight votes 5000 steps 5000 refused 0 worst 70000 used 63 latched 0 used 63 latched 0 "
    "used 0 latched 63\n"
)
COPTER = (
    "copter state 2 mode 4 phase 2 level 1 load 15350 motor 158525 motor 157566 motor 157868 "
    "motor 50001\n"
)
LINE = "task {}: period {} runs {} longest 9 skipped {} overruns {} promotions {}\n"


class Demo(unittest.TestCase):
    """What the demo printed."""

    def judge(self, *lines: str, end: str = "demo ended\n", flight: str = FLIGHT) -> list[str]:
        return emulated_tests.judge_demo(
            {"IMU": 1000, "ADC": 1000000}, "".join([*lines, flight, end])
        )

    def test_votes_and_control(self) -> None:
        lines = (LINE.format("IMU", 1000, 10000, 0, 0, 0), LINE.format("ADC", 1000000, 10, 0, 0, 0))
        for old, new in (
            ("worst 70000", "worst 70001"),
            ("latched 63", "latched 62"),
            ("refused 0", "refused 1"),
            ("steps 5000", "steps 4999"),
            (FLIGHT, ""),
        ):
            wrong = self.judge(*lines, flight=FLIGHT.replace(old, new))
            self.assertEqual(len(wrong), 1, new)
            self.assertIn("votes and control", wrong[0])

    def test_a_copter_on_its_desk(self) -> None:
        lines = (LINE.format("IMU", 1000, 10000, 0, 0, 0), LINE.format("ADC", 1000000, 10, 0, 0, 0))
        periods = {"IMU": 1000, "ADC": 1000000}
        for old, new, count in (
            ("", "", 0),
            ("motor 50001", "motor 50000", 1),
            ("state 2", "state 0", 1),
            ("phase 2", "phase 1", 1),
            (COPTER, "", 1),
        ):
            text = "".join([*lines, COPTER.replace(old, new), "demo ended\n"])
            wrong = emulated_tests.judge_copter(periods, text)
            self.assertEqual([told[:10] for told in wrong], ["the copter"] * count, new)

    def test_a_copters_task_over_its_budget(self) -> None:
        lines = (LINE.format("IMU", 1000, 10000, 0, 1, 0), LINE.format("ADC", 1000000, 10, 0, 0, 0))
        text = "".join([*lines, COPTER, "demo ended\n"])
        wrong = emulated_tests.judge_copter({"IMU": 1000, "ADC": 1000000}, text)
        self.assertEqual(wrong, ["IMU: skipped 0, overruns 1, promoted 0"])

    def test_background_radio(self) -> None:
        line = "radio {}: protocol {} found {} sent {} frames {} longest {} behind {}\n"
        good = {
            name: [name, protocol, found, 100, 0 if "noise" in name else 100 - before, 200, 9]
            for name, (protocol, found, before) in emulated_tests.RADIOS.items()
        }

        def judge(rows: dict[str, list[object]]) -> list[str]:
            text = "".join(line.format(*row) for row in rows.values())
            return emulated_tests.judge_radio(200, text)

        self.assertEqual(judge(good), [])
        self.assertEqual(judge({}), ["not each stream was told of"])
        for name, at, value, wrong in (
            ("SBUS", 1, 3, "SBUS: protocol 3, known in run 12"),
            ("SBUS", 2, 13, "SBUS: protocol 1, known in run 13"),
            ("CRSF", 4, 95, "CRSF: 95 frames of 100, and 9 ms behind"),
            ("PPM", 6, 10, "PPM: 93 frames of 100, and 10 ms behind"),
            ("noise", 4, 1, "noise: 1 frames"),
            ("noise of CRSF", 5, 201, "noise of CRSF: a run of 201 us, over 200"),
        ):
            row = list(good[name])
            row[at] = value
            self.assertEqual(judge({**good, name: row}), [wrong])

    def test_each_task_ran_once_per_period(self) -> None:
        lines = (LINE.format("IMU", 1000, 10000, 0, 0, 0), LINE.format("ADC", 1000000, 10, 0, 0, 0))
        self.assertEqual(self.judge(*lines), [])

    def test_one_run_too_few(self) -> None:
        lines = (LINE.format("IMU", 1000, 9999, 0, 0, 0), LINE.format("ADC", 1000000, 10, 0, 0, 0))
        self.assertEqual(self.judge(*lines), ["IMU: period 1000, 9999 runs, not 10000"])

    def test_another_period(self) -> None:
        lines = (LINE.format("IMU", 2000, 10000, 0, 0, 0), LINE.format("ADC", 1000000, 10, 0, 0, 0))
        self.assertEqual(self.judge(*lines), ["IMU: period 2000, 10000 runs, not 10000"])

    def test_late_tasks(self) -> None:
        good = LINE.format("ADC", 1000000, 10, 0, 0, 0)
        for counts in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
            wrong = self.judge(LINE.format("IMU", 1000, 10000, *counts), good)
            self.assertEqual(len(wrong), 1, counts)

    def test_a_task_that_never_ran(self) -> None:
        wrong = self.judge(LINE.format("IMU", 1000, 10000, 0, 0, 0))
        self.assertEqual(wrong, ["ADC: is only in the table"])

    def test_a_stranger(self) -> None:
        lines = (
            LINE.format("IMU", 1000, 10000, 0, 0, 0),
            LINE.format("ADC", 1000000, 10, 0, 0, 0),
            LINE.format("BBC", 1000, 1, 0, 0, 0),
        )
        self.assertIn("BBC: is only in the output", self.judge(*lines))

    def test_an_end_that_is_missing(self) -> None:
        lines = (LINE.format("IMU", 1000, 10000, 0, 0, 0), LINE.format("ADC", 1000000, 10, 0, 0, 0))
        self.assertEqual(self.judge(*lines, end=""), ["it did not come to its end"])

    def test_the_table_is_read(self) -> None:
        periods = emulated_tests.demo_periods(
            (ROOT / emulated_tests.TASK_SET).read_text(encoding="utf-8")
        )
        self.assertEqual(len(periods), 21)
        self.assertEqual(periods["Background IMU"], 1000)
        self.assertEqual(periods["ADC"], 1000000)


class Differences(unittest.TestCase):
    """Two builds that print digests."""

    def output(self, changed: int = -1, blocks: int = emulated_tests.BLOCKS) -> str:
        lines = [f"queue block {n} 0x{n + (n == changed):08x}0x00000000" for n in range(blocks)]
        return "\n".join([*lines, ""])

    def first(self, theirs: str) -> int | None:
        ours = emulated_tests.digests(self.output())
        return emulated_tests.first_difference(ours, emulated_tests.digests(theirs), "queue")

    def test_equal(self) -> None:
        self.assertIsNone(self.first(self.output()))

    def test_one_block_differs(self) -> None:
        self.assertEqual(self.first(self.output(changed=7)), 7)

    def test_one_block_is_missing(self) -> None:
        self.assertEqual(self.first(self.output(blocks=49)), 49)

    def test_nothing_was_printed(self) -> None:
        self.assertEqual(self.first(""), 0)


class Emulated(unittest.TestCase):
    """Programs that really run on the emulator."""

    board: EmulatedBoard

    @classmethod
    def setUpClass(cls) -> None:
        tools = Toolchain()
        tools.ensure("target")
        cls.board = EmulatedBoard(tools, folder=OWN)

    def program(self, name: str, text: str) -> Ended:
        """Build a program, and run it for two seconds at most."""
        source = ROOT / OWN / f"{name}.c"
        source.write_text(text)
        made = self.board.builder.object(source.relative_to(ROOT).as_posix())
        return self.board.run(self.board.builder.link(name, [made]), 2.0)

    def test_the_exit_status_arrives(self) -> None:
        ended = self.program("tool-status", "int main(void)\n{\n    return 42;\n}\n")
        self.assertEqual((ended.status, ended.timed_out), (42, False))
        self.assertRegex(ended.output, r"stack: \d+ of 16384 bytes used")

    def test_a_program_that_hangs_is_killed(self) -> None:
        ended = self.program("tool-hang", "int main(void)\n{\n    for (;;) {\n    }\n}\n")
        self.assertTrue(ended.timed_out)
        outcome = unity_outcome("unit/hang", ended)
        self.assertEqual((outcome.passed, len(outcome.failures)), (0, 1))

    def test_a_test_that_fails_is_counted(self) -> None:
        source = ROOT / OWN / "tool_unity.c"
        source.write_text(
            '#include "unity.h"\nvoid setUp(void)\n{\n}\nvoid tearDown(void)\n{\n}\n'
            "static void good(void)\n{\n    TEST_ASSERT_EQUAL(1, 1);\n}\n"
            "static void bad(void)\n{\n    TEST_ASSERT_EQUAL(1, 2);\n}\n"
            "int main(void)\n{\n    UNITY_BEGIN();\n    RUN_TEST(good);\n    RUN_TEST(bad);\n"
            "    return UNITY_END();\n}\n"
        )
        outcome = emulated_tests.unit_suite(
            self.board, "unit/tool", source.relative_to(ROOT).as_posix()
        )
        self.assertEqual((outcome.passed, len(outcome.failures)), (1, 1))

    def test_the_first_vector_that_differs_is_named(self) -> None:
        with mock.patch.object(emulated_tests, "DRIVER", self.changed_driver()):
            defines = ["-DDETAIL_UNIT=1u", "-DDETAIL_BLOCK=0u"]
            model = emulated_tests.run_model(self.board, defines)
        with mock.patch.object(emulated_tests, "run_model", lambda *_: model):
            told = emulated_tests.differing_vector(self.board, "priority", 0)
        self.assertRegex(told, r"^vector 1234: the model has 0x\w+, the target 0x\w+$")

    def test_what_is_compared_with_is_the_model(self) -> None:
        folder = ROOT / OWN / "tool_model"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(ROOT / emulated_tests.MODELS, folder)
        priority = folder / "priority.c"
        text = priority.read_text()
        old = "    return (saturation_us(period_us) + (sp - 1u)) / sp;\n"
        self.assertEqual(text.count(old), 1)
        priority.write_text(text.replace(old, "    return saturation_us(period_us) / sp;\n"))
        model = emulated_tests.digests(emulated_tests.run_model(self.board))
        with mock.patch.object(emulated_tests, "MODELS", folder.relative_to(ROOT).as_posix()):
            wrong = emulated_tests.digests(emulated_tests.run_model(self.board))
        units = emulated_tests.units_of(self.board)
        self.assertIn("reference", units)
        found = {unit: emulated_tests.first_difference(model, wrong, unit) for unit in units}
        self.assertEqual(found, {**dict.fromkeys(units), "priority": 0})

    def changed_driver(self) -> str:
        """The driver with one vector of the unit priority changed."""
        text = (ROOT / emulated_tests.DRIVER).read_text()
        old = "    digest(s, promotion_us);\n"
        self.assertEqual(text.count(old), 1)
        place = OWN / "tool_differential.c"
        changed = text.replace(old, "    digest(s, promotion_us + (s->vector == 1234u));\n")
        (ROOT / place).write_text(changed)
        return place.as_posix()
