# SPDX-License-Identifier: Apache-2.0
"""Tests of keel.test.object_coverage: conditions are evaluated as the processor's manual says, seen
in a real run, and what is not seen fails without a reason that fits.
"""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest import mock

from keel.base.errors import ToolError
from keel.base.run import Ended
from keel.base.source import STAMP, VERDICT, stamp_of
from keel.boards.conditions import (
    BLOCK,
    BRANCH,
    SELECTION,
    Conditional,
    ConditionError,
    Conditions,
    flags_say,
)
from keel.boards.elf import Contents, Symbol, read_contents
from keel.boards.lines import Lines, Place, read_lines
from keel.install import Toolchain
from keel.test import object_coverage, trace
from keel.test.emulated import EmulatedBoard
from keel.test.object_coverage import Condition, Measurement, Reason, UncoveredError, read_reasons
from keel.test.trace import one_by_one, outcomes_of, traced

ROOT = Path(__file__).resolve().parents[2]

OWN = Path("build/test/object_coverage")
N, Z, C, V = 1 << 31, 1 << 30, 1 << 29, 1 << 28
LOG = """\
R00=00000000 R01=00000005 R02=00000003 R03=00000001
R12=2002012c R13=20004390 R14=000001f9 R15={:08x}
XPSR={:08x} --C- T priv-thread
"""


def conditional(address: int, condition: str = "hi", register: int = -1) -> Conditional:
    """A conditional instruction."""
    return Conditional(address, 0, BRANCH, "b", condition, register)


class Evaluation(unittest.TestCase):
    """Whether conditions hold (ARMv7-M Architecture Reference Manual, A7.3)."""

    def test_flags(self) -> None:
        for condition, holds, fails in (
            ("eq", Z, 0),
            ("ne", 0, Z),
            ("hs", C, 0),
            ("lo", 0, C),
            ("mi", N, 0),
            ("pl", 0, N),
            ("vs", V, 0),
            ("vc", 0, V),
            ("hi", C, C | Z),
            ("ls", C | Z, C),
            ("ls", 0, C),
            ("ge", N | V, N),
            ("ge", 0, V),
            ("lt", N, N | V),
            ("lt", V, 0),
            ("gt", 0, Z),
            ("gt", N | V, N),
            ("le", Z, 0),
            ("le", V, N | V),
        ):
            with self.subTest(condition, holds=holds, fails=fails):
                self.assertTrue(flags_say(condition, holds))
                self.assertFalse(flags_say(condition, fails))

    def test_registers(self) -> None:
        self.assertTrue(conditional(0, "cbz", 2).holds({2: 0}, 0))
        self.assertFalse(conditional(0, "cbnz", 2).holds({2: 0}, 0))
        self.assertTrue(conditional(0, "cbnz", 2).holds({2: 7}, Z))

    def test_a_log(self) -> None:
        log = LOG.format(0x100, C) + LOG.format(0x104, C) + LOG.format(0x100, C | Z)
        at = {0x100: conditional(0x100), 0x104: conditional(0x104, "cbnz", 1)}
        for chunk_b in (1, 7, 1000):  # However it is read.
            seen = outcomes_of(io.BytesIO(log.encode()), {**at, 0x108: conditional(0x108)}, chunk_b)
            self.assertEqual(seen, {0x100: {True, False}, 0x104: {True}, 0x108: set()})

    def test_half_a_log(self) -> None:
        log = LOG.format(0x100, C).encode()
        for end in (log.index(b"XPSR"), log.index(b"XPSR=") + len(b"XPSR=2000")):
            seen = outcomes_of(io.BytesIO(log[:end]), {0x100: conditional(0x100)})
            self.assertEqual(seen, {0x100: set()})

    def test_registers_are_those_of_the_same_instruction(self) -> None:
        log = LOG.replace("R01=00000005", "R01=00000000").format(0x100, C) + LOG.format(0x104, C)
        at = {0x104: conditional(0x104, "cbz", 1)}
        self.assertEqual(outcomes_of(io.BytesIO(log.encode()), at), {0x104: {False}})

    def test_a_condition_that_goes_another_way_late(self) -> None:
        zero = LOG.replace("R01=00000005", "R01=00000000")
        log = (LOG.format(0x100, C) + LOG.format(0x104, C)) * 3 + zero.format(0x104, C | N)
        log += LOG.format(0x100, C | N) + LOG.format(0x100, Z)
        at = {0x100: conditional(0x100), 0x104: conditional(0x104, "cbz", 1)}
        self.assertEqual(
            outcomes_of(io.BytesIO(log.encode()), at), {0x100: {True, False}, 0x104: {True, False}}
        )

    def test_what_has_had_both_outcomes_is_logged_no_more(self) -> None:
        items = [conditional(address) for address in (0x100, 0x104, 0x108)]
        broken_off, whole = Ended(-9, "", timed_out=True), Ended(0, "all of it")
        runs = [
            (broken_off, {0x100: {True, False}, 0x104: {True}, 0x108: set[bool]()}),
            (broken_off, {0x104: {True}, 0x108: set()}),
            (whole, {0x104: {True, False}, 0x108: {True}}),
        ]
        unused = mock.Mock()
        with mock.patch.object(trace, "_logged", side_effect=runs) as logged:
            ended, seen = traced(unused, unused, Path("image.elf"), items)
        self.assertEqual(ended, whole)
        self.assertEqual(seen, {0x100: {True, False}, 0x104: {True, False}, 0x108: {True}})
        asked = [(call.args[3], call.args[4]) for call in logged.call_args_list]
        self.assertEqual(
            asked, [(items, trace.LOOK_S), (items[1:], trace.LOOK_S), (items[1:], trace.TIMEOUT_S)]
        )

    def test_a_run_that_is_broken_off_before_it_begins(self) -> None:
        tools = mock.Mock()
        tools.versions.return_value = {"qemu": mock.Mock(version="7.2.0")}
        ended = [Ended(-9, "", timed_out=True), Ended(-9, "", timed_out=True)]
        with (
            mock.patch.object(trace, "emulator", return_value=["qemu"]),
            mock.patch.object(trace, "run", side_effect=ended),
        ):
            hung, seen = traced(tools, mock.Mock(), OWN / "none.elf", [conditional(0x100)])
        self.assertTrue(hung.timed_out)
        self.assertEqual(seen, {0x100: set()})

    def test_a_run_that_hangs_is_told(self) -> None:
        hung = Ended(-9, "", timed_out=True), {0x100: {True}}
        with mock.patch.object(trace, "_logged", return_value=hung):
            ended, _ = traced(mock.Mock(), mock.Mock(), Path("a.elf"), [conditional(0x100)])
        self.assertTrue(ended.timed_out)

    def test_the_emulator_s_word_for_single_steps(self) -> None:
        self.assertEqual(one_by_one("7.2.22"), ["-singlestep"])
        self.assertEqual(one_by_one("8.0.1"), ["-singlestep"])
        self.assertEqual(one_by_one("10.0.2"), ["-accel", "tcg,one-insn-per-tb=on"])


class Sources(unittest.TestCase):
    """Instructions and their lines."""

    def test_a_function_that_begins_where_an_earlier_one_of_its_unit_ends(self) -> None:
        """The linker put the second of a unit before its first, whose rows come first."""
        lines = Lines([Place(8, "a.c", "a.c", 1), Place(0x10), Place(4, "a.c", "a.c", 7), Place(8)])
        self.assertEqual(lines.at(8), Place(8, "a.c", "a.c", 1))
        self.assertEqual(lines.at(0x10), Place(0x10))

    def test_the_last_place_before_an_address(self) -> None:
        lines = Lines([Place(8, "b.c", "b.c", 1), Place(0x10), Place(4, "a.c", "a.h", 7)])
        self.assertEqual(lines.at(2).file, "")
        self.assertEqual((lines.at(6).unit, lines.at(6).line), ("a.c", 7))
        self.assertEqual(lines.at(8).file, "b.c")
        self.assertEqual(lines.at(0x20).file, "")


class Running(unittest.TestCase):
    """Instructions that really run on the emulator."""

    CODE = (
        "__attribute__((naked)) unsigned known(unsigned x)\n{\n"
        '    __asm volatile("cbz r0, 1f\\n cmp r0, #5\\n bhi 1f\\n ite eq\\n moveq r0, #1\\n"\n'
        '                   "movne r0, #2\\n 1: bx lr");\n}\n'
        "int main(void)\n{\n    return (int)(known(5u) + known(9u)) - 10;\n}\n"
    )
    board: EmulatedBoard

    @classmethod
    def setUpClass(cls) -> None:
        tools = Toolchain()
        tools.ensure("target", "stack")
        cls.board = EmulatedBoard(tools, folder=OWN)

    def found(self, name: str, code: str) -> tuple[Contents, Symbol, Path]:
        """Build a program; its function `known`."""
        source = ROOT / OWN / f"{name}.c"
        source.write_text(code)
        made = self.board.builder.object(source.relative_to(ROOT).as_posix(), ["-Wno-error"])
        image = self.board.builder.link(name, [made])
        contents = read_contents(self.board.tools, image.elf)
        return contents, contents.symbol("known"), image.elf

    def test_outcomes_of_a_run(self) -> None:
        contents, function, elf = self.found("tool_known", self.CODE)
        items = list(Conditions(self.board.tools).of(contents, function))
        self.assertEqual(
            [(item.kind, item.text) for item in items],
            [(BRANCH, "cbz r0"), (BRANCH, "bhi"), (BLOCK, "moveq r0, #1"), (BLOCK, "movne r0, #2")],
        )
        ended, seen = traced(self.board.tools, self.board.board, elf, items)
        self.assertEqual(ended.status, 0)
        self.assertEqual(
            [seen[item.address] for item in items], [{False}, {True, False}, {True}, {False}]
        )
        places = read_lines(self.board.tools, elf, (OWN.as_posix(),))
        self.assertEqual(places.at(function.address).unit, f"{OWN}/tool_known.c")

    def test_a_selection_counts_and_a_computed_jump_is_refused(self) -> None:
        for text, kind in (
            ("vselgt.f32 s0, s0, s1", SELECTION),
            ("tbb [pc, r0]", ""),
            ("bx r1", ""),
            ("mov pc, r1", ""),
        ):
            code = self.CODE.replace("cbz r0, 1f", text)
            contents, function, _ = self.found(f"tool_{text[:4].strip()}", code)
            items = Conditions(self.board.tools).of(contents, function)
            with self.subTest(text):
                if kind:
                    self.assertEqual(next(items).kind, kind)
                    continue
                with self.assertRaisesRegex(ConditionError, r"known\+0x0: .*computed jump"):
                    list(items)

    def test_a_function_that_no_test_calls_is_told(self) -> None:
        measurement = Measurement(self.board)
        measurement.functions = measurement.compiled() - {("src/rtos/load.c", "keel_load_begin")}
        with self.assertRaisesRegex(UncoveredError, "src/rtos/load.c: keel_load_begin$"):
            measurement.check_all_functions()

    def test_tests_that_fail_are_no_evidence(self) -> None:
        source = ROOT / OWN / "tool_fails.c"
        source.write_text(
            '#include "unity.h"\nvoid setUp(void)\n{\n}\nvoid tearDown(void)\n{\n}\n'
            "static void bad(void)\n{\n    TEST_ASSERT_EQUAL(1, 2);\n}\n"
            "int main(void)\n{\n    UNITY_BEGIN();\n    RUN_TEST(bad);\n"
            "    return UNITY_END();\n}\n"
        )
        with self.assertRaisesRegex(UncoveredError, "failed on the target\n.*bad: Expected 1"):
            Measurement(self.board).run([source.relative_to(ROOT).as_posix()])

    def test_images_that_differ_are_refused(self) -> None:
        measurement = Measurement(self.board)
        measurement.known(CONDITION)
        self.assertIs(measurement.known(replace(CONDITION)), CONDITION)
        with self.assertRaisesRegex(ToolError, r"keel_x\+0x4 differs between images"):
            measurement.known(replace(CONDITION, instruction="bls"))


CONDITION = Condition(
    "src/x.c", "keel_x", 4, BRANCH, "bhi", "src/x.c", 3, "if (a) {", {True, False}
)
REASON = Reason(function="keel_x", line="if (a) {", never="taken", reason="why")


class Verdict(unittest.TestCase):
    """The exit status and the report tell the truth."""

    report: dict[str, Any]

    def judge(self, conditions: list[Condition], *reasons: Reason) -> tuple[int, str]:
        """Exit status and output."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        output = io.StringIO()
        with (
            mock.patch.object(object_coverage, "REPORT", folder / "report.json"),
            contextlib.redirect_stdout(output),
        ):
            status = object_coverage.judge(conditions, reasons, {"tests": ["t.c"]})
        self.report = json.loads((folder / "report.json").read_text())
        self.assertEqual(self.report[VERDICT], "failed" if status else "good")
        return status, output.getvalue()

    def test_all_seen(self) -> None:
        status, output = self.judge([CONDITION])
        self.assertEqual(status, 0)
        self.assertIn("2 of 2 outcomes of conditional instructions (1 branches)", output)
        self.assertEqual(self.report["files"]["src/x.c"]["functions"]["keel_x"]["seen"], 2)
        self.assertEqual(self.report[STAMP], stamp_of())

    def test_a_gap_fails_and_is_shown_with_its_place(self) -> None:
        status, output = self.judge([replace(CONDITION, seen={False})])
        self.assertEqual(status, 1)
        self.assertIn("src/x.c:3: keel_x+0x4 bhi: never taken: if (a) {", output)
        self.assertEqual(len(self.report["gaps"]), 1)

    def test_a_gap_with_a_reason_passes(self) -> None:
        for name in ("keel_x", "keel_x.part.0"):
            status, output = self.judge([replace(CONDITION, function=name, seen={False})], REASON)
            self.assertEqual(status, 0, output)
            self.assertEqual(self.report["explained"][0]["reason"], "why")

    def test_a_reason_for_another_outcome_does_not_fit(self) -> None:
        status, output = self.judge([replace(CONDITION, seen={True})], REASON)
        self.assertEqual(status, 1)
        self.assertIn("never not taken", output)

    def test_a_stale_reason_fails(self) -> None:
        status, output = self.judge([CONDITION], REASON)
        self.assertEqual(status, 1)
        self.assertIn("fits another number of gaps than 1: keel_x: never taken: if (a) {", output)

    def test_a_reason_for_one_instruction_does_not_hide_a_second(self) -> None:
        gaps = [replace(CONDITION, seen={False}), replace(CONDITION, offset=8, seen={False})]
        self.assertEqual(self.judge(gaps, REASON)[0], 1)
        self.assertEqual(self.judge(gaps, REASON.model_copy(update={"instructions": 2}))[0], 0)

    def test_nothing_found_is_not_good(self) -> None:
        self.assertEqual(self.judge([])[0], 1)

    def test_the_project_s_reasons_are_read(self) -> None:
        reasons = read_reasons()
        self.assertTrue(reasons.uncovered)
        self.assertFalse(reasons.traces(Path("tests/unit/test_mixer_equations.c")))
        self.assertFalse(reasons.traces(Path("tests/unit/test_rotor_specified.c")))
        self.assertTrue(reasons.traces(Path("tests/unit/test_mixer.c")))

    def test_a_test_that_there_is_not(self) -> None:
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / "reasons.toml"
        path.write_text('untraced = [\n    "mixer_equations",\n    "rotor_curves",\n]\n')
        with self.assertRaisesRegex(
            ToolError, r"reasons\.toml:1: untraced number 2: there is no tests/unit/test_rotor_cur"
        ):
            read_reasons(path)

    def test_a_reason_is_needed(self) -> None:
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / "reasons.toml"
        path.write_text('[[uncovered]]\nfunction = "f"\nline = "x"\nnever = "taken"\nreason = ""\n')
        with self.assertRaisesRegex(ToolError, r"reasons\.toml:5: .*reason: "):
            read_reasons(path)

    def test_what_cannot_be_measured_leaves_no_report(self) -> None:
        report = Path(self.enterContext(tempfile.TemporaryDirectory())) / "report.json"
        report.write_text("{}")
        output = io.StringIO()
        with (
            mock.patch.object(object_coverage, "REPORT", report),
            mock.patch.object(object_coverage, "measure", side_effect=ToolError("no emulator")),
            contextlib.redirect_stderr(output),
        ):
            self.assertEqual(object_coverage.main([]), 2)
        self.assertIn("no emulator", output.getvalue())
        self.assertFalse(report.exists())
