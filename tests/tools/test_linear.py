# SPDX-License-Identifier: Apache-2.0
"""Tests of the filter before Alt-Ergo: what it shows of a goal, and what it does not ask.

`make check NAME=qualify` asks Alt-Ergo itself, behind the filter, about what it proved though
it is false.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from keel.engines.linear_filter import is_nonlinear, linear_part

ROOT = Path(__file__).resolve().parents[2]

FILTER = ROOT / "tools/keel/engines/linear_filter.py"
GOAL = "goal wp_goal : (forall x:int. ((0 <= x) -> ((x + 1) <= (256 * (x + 1)))))\n"
DIVISION = """\
axiom Div_mod :
  (forall x:int. forall y:int. ((not (y = 0)) -> (x = ((y * div(x, y)) + mod(x, y)))))

"""
BETWEEN = "(x:int. (is_uint(x) -> (x <  256)))\n\n"


class Terms(unittest.TestCase):
    """What counts as a product, quotient or remainder of variables."""

    def test_products(self) -> None:
        for text in (
            "(x * y)",
            "((x * 3) * y)",
            "(y * 3 * x)",
            "(3 * x * y)",
            "((- n) * x)",
            "(x1 * y)",
            "(x * y2)",
            "(f(3) * x)",
            "(x * 3y)",
        ):
            self.assertTrue(is_nonlinear(text), text)

    def test_quotients_and_remainders(self) -> None:
        for text in (
            "(x / y)",
            "(x % 256)",
            "(x / 256)",
            "div(x, 257)",
            "mod(x, 256)",
            "(-x/2)",
            "(1 / 2)",
            "(1.0 / 0.0)",
            "(x / 2.0)",
        ):
            self.assertTrue(is_nonlinear(text), text)

    def test_linear(self) -> None:
        for text in (
            "(256 * x)",
            "(x * 256)",
            "((256 * x) + (3 * y))",
            "(0.5 * r)",
            "(x + y)",
            "(division <= modulus)",
            "(f(x)[y] - 3)",
            "(256 * div1(x))",
            "((- 3) * x)",
            "((1.0 / 1024.0) <= r)",
            "((- 1.0) * r)",
            "((1.0 / 3.0) * r)",
        ):
            self.assertFalse(is_nonlinear(text), text)


class Shown(unittest.TestCase):
    """What of a text Alt-Ergo is shown."""

    def test_a_linear_text_is_shown_whole(self) -> None:
        text = f"logic f : int -> int\n\naxiom small : {BETWEEN}{GOAL}"
        self.assertEqual(linear_part(text), text)

    def test_an_axiom_with_a_product_is_left_out(self) -> None:
        head = f"logic div : int, int -> int\n\naxiom small : {BETWEEN}"
        self.assertEqual(linear_part(f"{head}{DIVISION}{GOAL}"), f"{head}{GOAL}")

    def test_a_goal_that_divides_is_not_asked(self) -> None:
        self.assertIsNone(linear_part("goal g : (forall x:int. (div(x, 257) <= x))\n"))
        self.assertIsNone(linear_part("goal g :\n  (forall x:int.\n  ((x *\n  x) >= 0))\n"))

    def test_a_hypothesis_that_divides_is_left_out(self) -> None:
        text = (
            "goal wp_goal :\n  (forall x:int. forall t:(int,int) farray.\n  ((3 <= x) ->\n"
            "  ((div(x, 2) = 1) -> (((t[x]) = 0) -> (forall k:int. (((x * k) <= 9 -> (k = 1))"
            " -> ((f(k) <-> (k = 2)) -> (x = k))))))))\n"
        )
        self.assertEqual(
            linear_part(text),
            "goal wp_goal :\n  (forall x:int. forall t:(int,int) farray.\n  ((3 <= x) ->"
            "((((t[x]) = 0) ->(forall k:int. (((f(k) <-> (k = 2)) ->(x = k))))))))\n",
        )

    def test_what_a_goal_is_about_stays(self) -> None:
        for conclusion in (
            "(div(x, 2) = y)",
            "((x = 1) <-> ((x * y) = 1))",
            "(((x * y) = 1) and (x -> y))",
        ):
            goal = f"goal g : (forall x:int. forall y:int. ((x = 1) -> {conclusion}))\n"
            self.assertIsNone(linear_part(goal), conclusion)

    def test_a_definition_loses_its_body(self) -> None:
        text = f"predicate near(x: int, t: (int,int) farray) =\n  ((x * x) < (t[x]))\n\n{GOAL}"
        near = "logic near : int, (int,int) farray -> prop\n\n"
        self.assertEqual(linear_part(text), f"{near}{GOAL}")
        text = f"function half(x: int,\n  a: addr) : int = (x / 2)\n\n{GOAL}"
        self.assertEqual(linear_part(text), f"logic half : int, addr -> int\n\n{GOAL}")

    def test_of_a_predicate_what_it_implies_is_left(self) -> None:
        text = (
            "predicate ok(x: int,\n  m: (int,int) farray) = (((0 <= x) and ((x * x) < 9)) and\n"
            "  ((forall k:int. ((k < x) and (0 <= k))) and ((x = 1) or ((x / 2) = 1))))\n\n"
        )
        bound = "forall x: int. forall m: (int,int) farray. (ok(x, m) -> "
        self.assertEqual(
            linear_part(text + GOAL),
            "logic ok : int, (int,int) farray -> prop\n\n"
            f"axiom ok_0 : ({bound}(0 <= x)))\n\n"
            f"axiom ok_2 : ({bound}(forall k:int. ((k < x) and (0 <= k)))))\n\n{GOAL}",
        )
        for body in (
            "(((x * x) < 9) or ((x = 1) and (x = 2)))",
            "((x < 1) -> ((x * x) = 0))",
            "(exists k:int. (x = 1) and (k * k) = x)",
        ):
            shown = linear_part(f"predicate ok(x: int) = {body}\n\n{GOAL}")
            self.assertEqual(shown, f"logic ok : int -> prop\n\n{GOAL}", body)

    def test_a_definition_that_is_not_understood_ends_it(self) -> None:
        self.assertIsNone(linear_part(f"function half : int = (x / 2)\n\n{GOAL}"))

    def test_a_comment_says_nothing(self) -> None:
        self.assertEqual(linear_part(f"(* x / y *)\n{GOAL}"), f"\n{GOAL}")


class Started(unittest.TestCase):
    """The filter as why3 starts it, with a program that prints what it is shown."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.prover = self.folder / "prover"
        self.prover.write_text('#!/bin/sh\necho "$@"\n[ -f "$3" ] && cat "$3"\nexit 3\n')
        self.prover.chmod(0o755)
        self.file = self.folder / "goal.why"

    def ask(self, *words: str | Path) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-S", "-E", FILTER, self.prover, *words]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_the_prover_gets_options_and_the_linear_part(self) -> None:
        self.file.write_text(DIVISION + GOAL)
        done = self.ask("-timelimit", "10", self.file)
        self.assertEqual(done.stdout, f"-timelimit 10 {self.file}\n{GOAL}")
        self.assertEqual(done.returncode, 3)

    def test_what_is_not_asked_is_answered_in_alt_ergos_words(self) -> None:
        self.file.write_text(DIVISION + "goal g : (x = ((256 * div(x, 257)) + mod(x, 256)))\n")
        done = self.ask("-timelimit", "10", self.file)
        self.assertRegex(done.stdout, r'^File ".*", line 1, characters 1-1: ?I don\'t know')
        self.assertEqual(done.returncode, 0)

    def test_without_a_file_nothing_is_read(self) -> None:
        self.assertEqual(self.ask("-version").stdout, "-version\n")
