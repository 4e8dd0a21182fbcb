# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel/engines/gappa.py: a bound counts when Gappa's own enclosure lies within it.

Gappa is played by a script that prints what the real one prints.
"""

from __future__ import annotations

import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

from keel.base.jobs import Runner
from keel.c.project import ProjectError
from keel.engines import gappa

ROOT = Path(__file__).resolve().parents[2]

FUNCTION = """\
static float mean(float w0, float x0, float w1, float x1)
{
    const float p0 = w0 * x0;
    const float s0 = 0.0f + p0;
    const float p1 = w1 * x1;
    const float s1 = s0 + p1;
    const float v1 = w0 + w1;
    const float q = s1 / v1;

    return q;
}
"""
# Worked out by hand: each product is rounded, then the one addition; both weights go through v1.
FIRST = "(1 + p0) * (1 + s1) * (1 + q) / (1 + v1) - 1"
SECOND = "(1 + p1) * (1 + s1) * (1 + q) / (1 + v1) - 1"
HYPOTHESES = " /\\ ".join(f"|{name}| <= 0x1p-24" for name in ("p0", "p1", "s1", "v1", "q"))
STATEMENT = f"""\
# goals: 2
# rounds: mean.h mean
BOX_001_a = {FIRST};
BOX_001_b = {SECOND};
{{ {HYPOTHESES} -> |BOX_001_a| <= 0x4.1p-24 /\\ |BOX_001_b| <= 0x4.1p-24 }}
"""
# 17 * 2^-26 = 4.25 * 2^-24 is beyond 4.0625 * 2^-24, 2^-22 = 4 * 2^-24 is not.
WITHIN, BEYOND = "1b-22 {2.38419e-07, 2^(-22)}", "17b-26 {2.53320e-07, 2^(-21.9)}"
FAKE = """\
import re, sys
name = re.search(r"-> \\|(\\w+)\\| in \\?", open(sys.argv[1]).read())[1]
print("Results:")
print(f"  |{name}| in [0, " + (PLAY) + "]")
"""


class GappaTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "mean.h").write_text(FUNCTION, encoding="utf-8")
        self.path = self.root / "mean.g"
        self.path.write_text(STATEMENT, encoding="utf-8")

    def engine(self, play: str) -> gappa.Gappa:
        """Gappa that answers so; `play` is Python over `name`."""
        fake = self.root / "fake.py"
        fake.write_text(FAKE.replace("PLAY", play), encoding="utf-8")
        runner = Runner({}, self.root)
        return gappa.Gappa([sys.executable, str(fake)], runner, self.root, self.root)

    def problems(self, play: str = repr(WITHIN), **changes: tuple[str, str]) -> list[str]:
        text = STATEMENT
        for old, new in changes.values():
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.path.write_text(text, encoding="utf-8")
        return self.engine(play).prove(self.path).problems

    def test_bounds_that_enclose_what_gappa_finds_are_proved(self) -> None:
        result = self.engine(repr(WITHIN)).prove(self.path)
        self.assertEqual(result.problems, [])
        self.assertEqual([goal["status"] for goal in result.goals], ["Valid", "Valid"])

    def test_an_enclosure_beyond_the_bound_fails_that_goal_alone(self) -> None:
        play = f"{BEYOND!r} if name == 'BOX_001_b' else {WITHIN!r}"
        result = self.engine(play).prove(self.path)
        self.assertEqual([goal["status"] for goal in result.goals], ["Valid", "Unknown"])
        self.assertEqual(len(result.problems), 1)
        self.assertIn("BOX_001_b is not proved", result.problems[0])

    def test_a_complaint_is_no_proof(self) -> None:
        problems = self.problems(f"{WITHIN!r} + ']\\nWarning: no contradiction was found'")
        self.assertIn("no enclosure", problems[0])

    def test_silence_is_no_proof(self) -> None:
        self.assertIn("no enclosure", self.problems("(_ for _ in ()).throw(SystemExit(0))")[0])

    def test_a_vanished_goal_fails(self) -> None:
        problems = self.problems(goal=(" /\\ |BOX_001_b| <= 0x4.1p-24", ""))
        self.assertIn("has 1 goals; `goals` says 2", "\n".join(problems))
        self.assertIn("which no goal bounds", "\n".join(problems))

    def test_a_formula_that_does_not_follow_from_the_function_fails(self) -> None:
        problems = self.problems(formula=("(1 + p1) * (1 + s1)", "(1 + p1)"))
        self.assertIn("does not follow from mean", "\n".join(problems))

    def test_another_order_of_operations_fails(self) -> None:
        text = FUNCTION.replace("s0 + p1", "p1 + w0")
        (self.root / "mean.h").write_text(text, encoding="utf-8")
        self.assertTrue(self.problems())

    def test_a_narrower_hypothesis_fails(self) -> None:
        problems = self.problems(hypothesis=("|q| <= 0x1p-24", "|q| <= 0x1p-25"))
        self.assertIn("each rounding of mean is at most 2^-24", "\n".join(problems))

    def test_formulas_by_hand(self) -> None:
        self.assertEqual(gappa.formulas(FUNCTION), ([FIRST, SECOND], {"p0", "p1", "s1", "v1", "q"}))

    def test_a_bound_in_another_form_is_refused(self) -> None:
        with self.assertRaisesRegex(ProjectError, "not of the form"):
            self.problems(form=("|BOX_001_b| <= 0x4.1p-24", "BOX_001_b in [0, 1]"))

    def test_a_wrong_file_must_not_be_proved(self) -> None:
        self.path.write_text("# expect: BOX_001_a\n" + STATEMENT, encoding="utf-8")
        self.assertEqual(self.engine(repr(BEYOND)).refute(self.path).problems, [])
        self.assertIn("is proved", self.engine(repr(WITHIN)).refute(self.path).problems[0])

    def test_a_wrong_file_names_goals_that_it_has(self) -> None:
        self.path.write_text("# expect: BOX_001_c\n" + STATEMENT, encoding="utf-8")
        self.assertIn("no goal of it", self.engine(repr(BEYOND)).refute(self.path).problems[0])

    def test_exact_numbers(self) -> None:
        answer = "Results:\n  |x| in [0, 33554433b-48 {1.19209e-07, 2^(-23)}]\n"
        self.assertEqual(gappa.enclosures(answer), {"x": Fraction(33554433, 2**48)})
