#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Do the numbers of the public headers differ where they must? Sets of bits, and names of cases.

Code and model read one header, so each proof of equality holds with any numbers there. A set of
bits is three or more constants, line by line, written in hexadecimal, most of which are single
bits: then all of them are, and no two of a header are equal, unless WORDS says that they are bits of
another word. Of three or more whole numbers that stand line by line no two are equal, either.

    python3 tests/tools/test_constants.py
"""

from __future__ import annotations

import re
import sys
import unittest
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from proofs.csource import read  # noqa: E402
from proofs.declarations import macros  # noqa: E402
from proofs.syntax import found, parse, written  # noqa: E402

HEADERS = sorted((ROOT / "include").glob("keel/*/*.h"))
# Names of bits that are told in a word of their own.
WORDS = ("KEEL_MODE_CHECK_",)
WHOLE = re.compile(r"\(?(-?(?:0x[0-9A-Fa-f]+|[0-9]+))[uU]?\)?")
FEW = 3  # A pair may be anything.
BITWISE = ("&", "|", "&=", "|=")


@dataclass(frozen=True)
class Constant:
    """A whole number with a name."""

    name: str
    text: str
    value: int
    row: int

    @property
    def is_hexadecimal(self) -> bool:
        """Whether it is written so."""
        return self.text.startswith("0x")

    @property
    def is_bit(self) -> bool:
        """Whether it is a power of two."""
        return self.value > 0 and self.value & (self.value - 1) == 0

    @property
    def word(self) -> str:
        """Which word its bit is of: one a header, and those of WORDS."""
        return next((start for start in WORDS if self.name.startswith(start)), "")


def constants(text: str) -> Iterator[Constant]:
    """The whole numbers of a header."""
    known = macros([text])
    for node in found(parse(text), "preproc_def"):
        name = written(node.child_by_field_name("name"))
        match = WHOLE.fullmatch(known[name][1]) if name in known else None
        if match:
            yield Constant(name, match[1], int(match[1], 0), node.start_point.row)


def groups(text: str) -> list[list[Constant]]:
    """Those that stand line by line, three or more."""
    every: list[list[Constant]] = []
    for one in constants(text):
        if every and one.row == every[-1][-1].row + 1:
            every[-1].append(one)
        else:
            every.append([one])
    return [group for group in every if len(group) >= FEW]


def sets(text: str) -> list[list[Constant]]:
    """The sets of bits."""
    hexadecimal = ([one for one in group if one.is_hexadecimal] for group in groups(text))
    return [
        group
        for group in hexadecimal
        if len(group) >= FEW and 2 * sum(one.is_bit for one in group) > len(group)
    ]


def equal(group: list[Constant], kind: str) -> Iterator[str]:
    """Which are equal to one before."""
    seen: dict[tuple[str, int], str] = {}
    for one in group:
        first = seen.setdefault((one.word, one.value), one.name)
        if first != one.name:
            yield f"{first} and {one.name} are one {kind}"


def problems(text: str) -> list[str]:
    """What is wrong with the numbers of a header."""
    bits = [one for group in sets(text) for one in group]
    wrong = [f"{one.name} is no single bit" for one in bits if not one.is_bit]
    numbers = [line for group in groups(text) for line in equal(group, "number")]
    return [*wrong, *equal(bits, "bit"), *numbers]


def combined(text: str) -> set[str]:
    """The names that code combines with others bit by bit."""
    names = set()
    for node in found(parse(text), "binary_expression", "assignment_expression"):
        if written(node.child_by_field_name("operator")) in BITWISE:
            sides = [node.child_by_field_name(side) for side in ("left", "right")]
            names |= {written(one) for one in sides if one and one.type == "identifier"}
    return names


class HeadersTest(unittest.TestCase):
    """The public headers."""

    def test_the_numbers_differ_where_they_must(self) -> None:
        for header in HEADERS:
            with self.subTest(header.name):
                self.assertEqual(problems(read(header)), [])

    def test_the_twelve_checks_before_arming_are_a_set(self) -> None:
        [checks] = [
            group
            for group in sets(read(ROOT / "include/keel/flight/mode.h"))
            if group[0].name.startswith("KEEL_MODE_CHECK_")
        ]
        self.assertEqual([one.value for one in checks], [1 << bit for bit in range(12)])

    def test_what_code_takes_for_bits_is_in_a_set(self) -> None:
        known = {one.name for header in HEADERS for one in constants(read(header))}
        bits = {one.name for header in HEADERS for group in sets(read(header)) for one in group}
        taken = set()
        for path in (*ROOT.glob("src/**/*.c"), *ROOT.glob("examples/copter/*.c")):
            taken |= combined(read(path))
        self.assertGreater(len(taken & bits), 20)
        self.assertEqual(taken & known - bits, set())

    def test_bits_of_a_battery_module_leave_room_for_the_other(self) -> None:
        text = (ROOT / "include/keel/flight/battery.h").read_text("utf-8")
        [flags] = sets(text)
        first = re.findall(r"#define (\w+) .*/\*\*< Of module 0:", text)
        shifted = [one.value << 1 for one in flags if one.name in first]
        self.assertEqual(len(shifted), 4)
        self.assertFalse(set(shifted) & {one.value for one in flags})


def header(*values: str) -> str:
    """A header with these constants, line by line."""
    return "".join(f"#define KEEL_SIDE_{chr(65 + n)} {value}\n" for n, value in enumerate(values))


class RulesTest(unittest.TestCase):
    """What the rules see."""

    def test_equal_bits(self) -> None:
        text = header("0x01u", "0x02u", "0x02u", "0x08u")
        self.assertIn("KEEL_SIDE_B and KEEL_SIDE_C are one bit", problems(text))

    def test_equal_bits_of_two_sets(self) -> None:
        text = header("0x01u", "0x02u", "0x04u")
        other = header("0x08u", "0x10u", "0x04u").replace("SIDE", "EDGE")
        self.assertEqual(
            problems(f"{text}\n{other}"), ["KEEL_SIDE_C and KEEL_EDGE_C are one bit"]
        )  # fmt: skip

    def test_but_not_of_two_words(self) -> None:
        text = header("0x01u", "0x02u", "0x04u")
        self.assertEqual(problems(f"{text}\n{text.replace('KEEL_SIDE_', WORDS[0])}"), [])

    def test_what_is_no_single_bit(self) -> None:
        for wrong in ("0x03u", "0x00u"):
            text = header("0x01u", "0x02u", wrong, "0x08u")
            self.assertIn("KEEL_SIDE_C is no single bit", problems(text))

    def test_equal_numbers(self) -> None:
        self.assertEqual(
            problems(header("0", "1u", "2", "1")), ["KEEL_SIDE_B and KEEL_SIDE_D are one number"]
        )  # fmt: skip

    def test_limits_may_be_equal(self) -> None:
        self.assertEqual(problems(header("1.0f", "1.0f", "16.0f") + header("8u", "8u")), [])

    def test_what_is_combined(self) -> None:
        text = "void f(unsigned *x) { *x |= A; if ((*x & B) != 0u) { *x = 1u + C; } }"
        self.assertEqual(combined(text), {"A", "B"})


if __name__ == "__main__":
    unittest.main()
