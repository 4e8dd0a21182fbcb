# SPDX-License-Identifier: Apache-2.0
"""Tests of the small harnesses that mutants are tried by first.

No prover is run.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any
from unittest import mock

from test_prove import HARNESS, TreeTest

from keel.judge.cbmc_answers import Answer
from keel.judge.harness import Harness, read_harness
from keel.mutate.small_harnesses import Small, small

ROOT = Path(__file__).resolve().parents[2]


class SmallHarness(TreeTest):
    def made(self, directives: str, header: str = "#define KEEL_QUEUE_CAPACITY 32u\n") -> Harness:
        """The small form of a harness with these directives, beside a header with a capacity."""
        path = self.unit.folder / "keel_box_put_harness.c"
        own = [line for line in HARNESS.splitlines() if not line.startswith("// cbmc:")]
        path.write_text("\n".join([directives, *own]), encoding="utf-8")
        capacity = self.root / "include/keel/rtos/capacity.h"
        capacity.write_text(header, encoding="utf-8")
        return small(read_harness(self.unit, path), [capacity])

    def test_capacity_and_unwinding_shrink_together(self) -> None:
        made = self.made("// cbmc: --unwind 34 --refine")
        self.assertEqual(made.defines, ("-DKEEL_QUEUE_CAPACITY=2u",))
        self.assertEqual(made.options[:3], ("--unwind", "4", "--refine"))
        self.assertTrue(made.assertions_only)

    def test_what_a_harness_chose_shrinks_too_and_never_grows(self) -> None:
        for chosen, expected in (("8u", "2u"), ("1u", "1u")):
            made = self.made(f"// defines: -DKEEL_QUEUE_CAPACITY={chosen} -DX=1")
            self.assertEqual(made.defines, (f"-DKEEL_QUEUE_CAPACITY={expected}", "-DX=1"))

    def test_loops_over_something_else_are_unwound_as_before(self) -> None:
        for bound in ("7", "35"):
            made = self.made(f"// cbmc: --unwind {bound}")
            self.assertEqual(made.options[:2], ("--unwind", bound))

    def test_where_there_is_no_capacity_none_is_defined(self) -> None:
        self.assertEqual(self.made("// cbmc: --unwind 34", "/* none */\n").defines, ())

    def test_the_solver_in_cbmc_takes_small_formulas(self) -> None:
        self.assertNotIn("cadical", self.made("// cbmc: --external-sat-solver cadical").options)

    def test_who_finds_no_examples_is_not_asked(self) -> None:
        made = Small({}, mock.Mock())
        solver: Any = type("Solver", (), {"name": "solver", "options": ("--z3", "--fpa")})()
        other: Any = type("Other", (), {"name": "other", "options": ("--unwind", "3")})()
        self.assertEqual(made.ranked("keel_box_put", [solver, other]), [other])


def answer(failure: str = "", complete: bool = True) -> Answer:
    """What CBMC says."""
    trace = [{"stepType": "failure", "reason": failure}] if failure else []
    return Answer([], [], [], complete, bool(failure), trace=trace)


class Checker:
    """CBMC that gives the same answer to everything."""

    def __init__(self, said: Answer) -> None:
        self.said = said
        self.asked = 0

    def build(self, _harness: Harness, name: str) -> tuple[Path, str]:
        return Path(name), ""

    def check(self, _harness: Harness, _binary: Path, _extra: object) -> Answer:
        self.asked += 1
        return self.said


class Kills(TreeTest):
    def kill(self, mutated: Answer, unchanged: Answer) -> str:
        """What a small harness says of a mutant, with these answers on it and on the original."""
        harness = read_harness(self.unit, self.unit.folder / "keel_box_put_harness.c")
        first: Any = Checker(mutated)
        second: Any = Checker(unchanged)
        made = Small({harness.name: []}, lambda: second)
        said = made.kills(harness, "keel_box_put", first, self.root)
        self.assertEqual(made.kills(harness, "keel_box_put", first, self.root), said)
        self.assertLessEqual(second.asked, 1)
        self.asked = first.asked
        return said

    def test_a_failing_assertion_kills(self) -> None:
        killed = "killed: keel_box_put_harness: BOX_001"
        self.assertEqual(self.kill(answer("BOX_001"), answer()), killed)

    def test_not_when_it_fails_unchanged_or_when_nobody_knows(self) -> None:
        self.assertEqual(self.kill(answer("BOX_001"), answer("BOX_001")), "")
        self.assertEqual(self.kill(answer("BOX_001"), answer(complete=False)), "")

    def test_who_is_of_no_use_is_not_asked_again(self) -> None:
        self.kill(answer("BOX_001"), answer(complete=False))
        self.assertEqual(self.asked, 1)

    def test_nor_does_no_answer_kill_or_a_loop_that_goes_on(self) -> None:
        self.assertEqual(self.kill(answer(), answer()), "")
        self.assertEqual(self.kill(answer("BOX_001", complete=False), answer()), "")
        self.assertEqual(self.kill(answer("unwinding assertion loop 0"), answer()), "")

    def test_who_never_answers_is_asked_three_times(self) -> None:
        harness = read_harness(self.unit, self.unit.folder / "keel_box_put_harness.c")
        silent: Any = Checker(answer(complete=False))
        killing: Any = Checker(answer("BOX_001"))
        unchanged: Any = Checker(answer())
        for before, asked in ([], 3), ([killing], 5):
            made = Small({harness.name: []}, lambda: unchanged)
            silent.asked = 0
            for checker in [*before, *[silent] * 5]:
                made.kills(harness, "keel_box_put", checker, self.root)
            self.assertEqual(silent.asked, asked)

    def test_who_killed_most_is_asked_first(self) -> None:
        harness = read_harness(self.unit, self.unit.folder / "keel_box_put_harness.c")
        checker: Any = Checker(answer("BOX_001"))
        unchanged: Any = Checker(answer())
        made = Small({harness.name: []}, lambda: unchanged)
        other: Any = type("Other", (), {"name": "other", "options": ()})()
        self.assertEqual(made.ranked("keel_box_put", [other, harness]), [other, harness])
        made.kills(harness, "keel_box_put", checker, self.root)
        self.assertEqual(made.ranked("keel_box_put", [other, harness]), [harness, other])
        self.assertEqual(made.ranked("elsewhere", [other, harness]), [other, harness])
