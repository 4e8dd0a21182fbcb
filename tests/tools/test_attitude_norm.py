# SPDX-License-Identifier: Apache-2.0
"""Is the step that Gappa bounds the one of the code? proofs/attitude/norm.g, against the C text."""

from __future__ import annotations

import ast
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src/flight/attitude.c"
GAPPA = ROOT / "proofs/attitude/norm.g"
HEADER = ROOT / "include/keel/flight/attitude.h"

ROUNDED = re.compile(r"^(\w+) rnd= ([^;]+);", re.MULTILINE)
CONSTANT = re.compile(r"const float (\w+) = ([^;]+);")
COMPONENTS = re.compile(r"p = \{([^}]+)\};")
HYPOTHESIS = re.compile(r"\|(\w+)\| <= (0x[0-9a-f.]+p[+-]\d+)")


def parsed(text: str) -> str:
    """An expression as a tree: brackets that change nothing are gone, the order is not."""
    return ast.dump(ast.parse(text.strip(), mode="eval"))


def body_of(name: str) -> str:
    """A function's body in the C text."""
    text = SOURCE.read_text("utf-8")
    match = re.search(rf"\b{name}\([^)]*\)\n\{{\n(.*?)\n\}}\n", text, re.DOTALL)
    assert match, name
    return match[1]


def as_gappa(text: str) -> str:
    """A C expression with Gappa's names: q.w is qw, 0.5f is 0.5."""
    return re.sub(r"(\d)f\b", r"\1", re.sub(r"\b([qh])\.([wxyz])\b", r"\1\2", text))


def in_code() -> dict[str, str]:
    """What `turned_quaternion` computes, by name; the components that it returns are pw to pz."""
    body = body_of("turned_quaternion")
    found = {name: parsed(as_gappa(text)) for name, text in CONSTANT.findall(body)}
    components = COMPONENTS.findall(body)[0].split(",")
    return found | {f"p{axis}": parsed(text) for axis, text in zip("wxyz", components, strict=True)}


def in_gappa() -> dict[str, str]:
    """What norm.g rounds, by name."""
    return {name: parsed(text) for name, text in ROUNDED.findall(GAPPA.read_text("utf-8"))}


def square_of(letter: str) -> str:
    """|q|^2 as keel_attitude_is_unit computes it, of the quaternion with this letter."""
    text = CONSTANT.findall(body_of("keel_attitude_is_unit"))[0][1]
    return parsed(re.sub(r"\bq(\w)\b", rf"{letter}\1", as_gappa(text)))


def constant(name: str) -> float:
    """A number that the header defines."""
    match = re.search(rf"#define KEEL_ATTITUDE_{name} +([\d.]+)f\n", HEADER.read_text("utf-8"))
    assert match, name
    return float(match[1])


class AttitudeNorm(unittest.TestCase):
    def test_every_operation_of_the_step_is_that_of_the_code(self) -> None:
        rounded = in_gappa()
        guards = {name: rounded.pop(name) for name in ("g", "u")}
        self.assertEqual(rounded, in_code())
        self.assertEqual(guards, {"g": square_of("q"), "u": square_of("p")})

    def test_the_hypotheses_are_what_the_code_clamps_and_checks(self) -> None:
        text = GAPPA.read_text("utf-8")
        found = {name: float.fromhex(bound) for name, bound in HYPOTHESIS.findall(text)}
        half = constant("HALF_ANGLE_LIMIT")
        guard = found["G"]
        self.assertEqual([found["hx"], found["hy"], found["hz"]], [half] * 3)
        self.assertEqual([1 - guard, 1 + guard], [constant("NORM_MIN"), constant("NORM_MAX")])
        self.assertEqual(found["ATT_010_guard"], guard)
        proof = (ROOT / "proofs/attitude/attitude_proof.h").read_text("utf-8")
        component = re.findall(r"#define COMPONENT_LIMIT (\S+)f\n", proof)
        self.assertEqual([found[f"q{axis}"] for axis in "wxyz"], [float.fromhex(component[0])] * 4)

    def test_what_the_code_turns_is_clamped_and_asked_of(self) -> None:
        body = " ".join(body_of("rotate_attitude").split())
        self.assertIn(
            "half = clamped_vector(scaled_vector(attitude->scale.half_step, rate), "
            "KEEL_ATTITUDE_HALF_ANGLE_LIMIT);",
            body,
        )
        self.assertIn(
            "next = turned_quaternion(attitude->quaternion, half); "
            "if (keel_attitude_is_unit(next))",
            body,
        )
