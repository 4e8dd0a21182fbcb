# SPDX-License-Identifier: Apache-2.0
"""Is each bound that Gappa must refuse a wrong one? proofs/*/wrong/*.g, in exact rationals.

A prover that refuses a bound may just be too weak for it. So each wrong file names, behind
`# witness:`, values for which its hypotheses hold and the bound that it expects to be refused does
not. They are worked out by hand, or found by a search for fence_too_tight.g.
"""

from __future__ import annotations

import ast
import operator
import re
import unittest
from collections.abc import Callable, Mapping
from fractions import Fraction
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FILES = sorted(ROOT.glob("proofs/*/wrong/*.g"))

EXPECTED = re.compile(r"^# expect: (\w+)$", re.MULTILINE)
WITNESS = re.compile(r"^# witness: (.+)$", re.MULTILINE)
VALUE = re.compile(r"(\w+) = ([^,\s]+)")
DEFINITION = re.compile(r"^(\w+) (rnd)?= ([^;]+);", re.MULTILINE)
FORMULA = re.compile(r"\{(.*?)\s->\s(.*?)\}", re.DOTALL)
BOUND = re.compile(r"\|(\w+)\| <= (\S+)")
HEXADECIMAL = re.compile(r"0x[0-9a-f]+(?:\.[0-9a-f]+)?(?:p[+-]?\d+)?")
OPERATIONS: Mapping[type[ast.operator], Callable[[Fraction, Fraction], Fraction]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
BITS = 24  # Of a binary32's significand. Nothing here is so small that it is subnormal.


def to_single(value: Fraction) -> Fraction:
    """To the nearest binary32, ties to even; Python rounds a fraction to an integer just so."""
    step = Fraction(1)
    while abs(value) >= step * 2**BITS:
        step *= 2
    while value and abs(value) < step * 2 ** (BITS - 1):
        step /= 2
    return round(value / step) * step


def exactly(value: Fraction) -> Fraction:
    """Not rounded."""
    return value


def number(text: str) -> Fraction:
    """A decimal or hexadecimal number, maybe negative; a double holds each of the files'."""
    return Fraction(float.fromhex(text)) if "0x" in text else Fraction(text)


def evaluate(
    text: str, values: Mapping[str, Fraction], rounded: Callable[[Fraction], Fraction]
) -> Fraction:
    """An expression, each operation of it rounded."""
    numbers: list[Fraction] = []

    def noted(match: re.Match[str]) -> str:
        numbers.append(number(match[0]))
        return f"numbers[{len(numbers) - 1}]"

    def value_of(node: ast.expr) -> Fraction:
        match node:
            case ast.BinOp():
                operation = OPERATIONS[type(node.op)]
                return rounded(operation(value_of(node.left), value_of(node.right)))
            case ast.UnaryOp(op=ast.USub()):
                return -value_of(node.operand)
            case ast.Name():
                return values[node.id]
            case ast.Constant():
                return Fraction(str(node.value))
            case ast.Call(args=[argument]):  # rnd(), the only function there is.
                return to_single(value_of(argument))
            case ast.Subscript(slice=ast.Constant(value=int(index))):
                return numbers[index]
        raise ValueError(f"no expression of these files: {ast.dump(node)}")

    return value_of(ast.parse(HEXADECIMAL.sub(noted, text.strip()), mode="eval").body)


def bounds(text: str) -> dict[str, Fraction]:
    """What is said of whose size."""
    return {name: number(bound) for name, bound in BOUND.findall(text)}


class WrongBoundTest(unittest.TestCase):
    def test_there_are_some(self) -> None:
        self.assertTrue(FILES)

    def test_a_witness_shows_that_each_is_wrong(self) -> None:
        for path in FILES:
            with self.subTest(path.name):
                text = path.read_text(encoding="utf-8")
                witness, expected = WITNESS.search(text), EXPECTED.search(text)
                assert witness and expected, "names no witness, or nothing that it expects"
                values = {name: number(value) for name, value in VALUE.findall(witness[1])}
                for name, is_rounded, body in DEFINITION.findall(text):
                    values[name] = evaluate(body, values, to_single if is_rounded else exactly)
                formula = FORMULA.search(text)
                assert formula, "states nothing"
                for name, bound in bounds(formula[1]).items():
                    self.assertLessEqual(abs(values[name]), bound, name)
                wrong = expected[1]
                self.assertGreater(abs(values[wrong]), bounds(formula[2])[wrong])

    def test_numbers_by_hand(self) -> None:
        singles = {
            "1": "1",
            "16777217": "16777216",
            "16777219": "16777220",
            "1/3": "11184811/33554432",
            "-33554435": "-33554436",
        }
        for value, single in singles.items():
            self.assertEqual(to_single(Fraction(value)), Fraction(single))
        self.assertEqual(number("0x5.8p-24"), Fraction(11, 2**25))
        values = {"a": Fraction(2), "b": Fraction(3)}
        self.assertEqual(evaluate("a - (b - 0x1p-1) / 4 * -b", values, exactly), Fraction(31, 8))
