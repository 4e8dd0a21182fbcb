# SPDX-License-Identifier: Apache-2.0
"""Is the fence's test that Gappa bounds the code's? proofs/cascade/fence.g, against the C text."""

from __future__ import annotations

import ast
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src/flight/cascade.c"
GAPPA = ROOT / "proofs/cascade/fence.g"
HEADER = ROOT / "include/keel/flight/cascade.h"

ROUNDED = re.compile(r"^(\w+) rnd= ([^;]+);", re.MULTILINE)
SINGLE = re.compile(r"^(\w+) = rnd\(\1_\);", re.MULTILINE)
CONSTANT = re.compile(r"const float (\w+) = ([^;]+);")
FENCE = re.compile(r"cascade->fence\.(\w+) = ([^;]+);")
NEAR = re.compile(r"is_side_near\(fence, ([^,]+), ([^)]+)\)")
HYPOTHESIS = re.compile(r"\|([LxvAT])\| <= (0x[0-9a-f.]+p[+-]\d+)")

# The code's names in Gappa's; `way` is what near_sides gives for it.
NAMES = {
    "cascade->fence.gain": "gain",
    "fence->gain": "gain",
    "fence->half_gain": "half",
    "config->acceleration": "A",
    "config->reaction_s": "T",
    "fence->reaction_s": "T",
    "speed": "v",
    "way": "(L - x)",
}
ANY_NAME = re.compile("|".join(rf"\b{re.escape(name)}\b" for name in NAMES))


def parsed(text: str) -> str:
    """An expression as a tree: brackets that change nothing are gone, the order is not."""
    return ast.dump(ast.parse(text.strip(), mode="eval"))


def as_gappa(text: str) -> str:
    """A C expression with Gappa's names: 0.5f is 0.5."""
    return parsed(re.sub(r"(\d)f\b", r"\1", ANY_NAME.sub(lambda name: NAMES[name[0]], text)))


def body_of(name: str) -> str:
    """A function's body in the C text, on one line."""
    text = SOURCE.read_text("utf-8")
    match = re.search(rf"\b{name}\([^)]*\)\n\{{\n(.*?)\n\}}\n", text, re.DOTALL)
    assert match, name
    return " ".join(match[1].split())


def constant(name: str) -> float:
    """A number that the header defines."""
    match = re.search(rf"#define KEEL_CASCADE_{name} +([\d.]+)f\n", HEADER.read_text("utf-8"))
    assert match, name
    return float(match[1])


class CascadeFence(unittest.TestCase):
    def test_every_operation_of_the_fence_is_that_of_the_code(self) -> None:
        text = GAPPA.read_text("utf-8")
        made = dict(FENCE.findall(body_of("keel_cascade_init")))
        tested = dict(CONSTANT.findall(body_of("is_side_near")))
        square = re.fullmatch(r"\(fastest > 0\.0f\) \? \((.+)\) : 0\.0f", tested["square"])
        assert square
        code = {
            "gain": made["gain"],
            "half": made["half_gain"],
            "left": tested["left"],
            "fastest": tested["fastest"],
            "square": square[1],
        }
        self.assertEqual(
            {name: parsed(value) for name, value in ROUNDED.findall(text)},
            {name: as_gappa(value) for name, value in code.items()},
        )
        self.assertEqual(sorted(SINGLE.findall(text)), ["A", "L", "T", "v", "x"])
        self.assertEqual(set(tested), {"fastest", "left", "square"})

    def test_the_fence_has_the_numbers_of_the_configuration(self) -> None:
        made = dict(FENCE.findall(body_of("keel_cascade_init")))
        self.assertEqual(made["reaction_s"], "config->reaction_s")
        self.assertEqual(made["twice_braking"], "2.0f * config->braking")
        self.assertEqual(set(made), {"gain", "half_gain", "reaction_s", "twice_braking"})

    def test_a_side_is_near_by_the_two_numbers_that_are_bounded(self) -> None:
        self.assertIn("return !(square <= (fence->twice_braking * left));", body_of("is_side_near"))

    def test_either_side_is_so_far_away_and_approached_so_fast(self) -> None:
        # L - x with x the position towards the side: that below has both signs turned, exactly.
        sides = [("reach + position", "-speed"), ("reach - position", "speed")]
        self.assertEqual(NEAR.findall(body_of("near_sides")), sides)

    def test_the_hypotheses_are_what_the_code_takes(self) -> None:
        found = HYPOTHESIS.findall(GAPPA.read_text("utf-8"))
        bounds = {name: float.fromhex(bound) for name, bound in found}
        self.assertEqual(len(found), len(bounds))
        self.assertEqual(
            [bounds["L"], bounds["A"], bounds["T"]],
            [constant(name) for name in ("DISTANCE_MAX", "ACCELERATION_MAX", "REACTION_MAX_S")],
        )
        self.assertEqual(bounds["x"], bounds["L"])
        self.assertGreaterEqual(bounds["v"], constant("SPEED_MAX"))
