# SPDX-License-Identifier: Apache-2.0
"""How structures lie in memory: alike for provers, target and host, and what is not is seen."""

from __future__ import annotations

import re
import tempfile
import unittest
from pathlib import Path

from check_layouts import Types, compared

from keel.c.project import ProjectError
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

INCLUDED = "#include <stdbool.h>\n#include <stddef.h>\n#include <stdint.h>\n"
SMALL = "typedef enum colour { RED, GREEN } colour_t;\n"
LARGE = "typedef enum colour { RED, GREEN = 65536 } colour_t;\n"
BALL = "typedef struct ball { bool is_round; colour_t colour; uint8_t size; } ball_t;\n"
REFUSED = "'colour_t colour;': an enumeration in a structure"
# In each there is more than a byte, and something that only some compilers would align.
PLAIN = """
typedef uint8_t colour_t;
typedef struct ball { bool is_round; colour_t colour; uint16_t size; } ball_t;
typedef struct balls { uint8_t count; double weight; ball_t ball[3]; uint64_t seen; } balls_t;
"""
POINTERS = """
typedef int (*catch_t)(void);
typedef struct ball { bool is_round; const char *name; } ball_t;
typedef struct balls { uint8_t count; ball_t ball[2]; } balls_t;
typedef struct player { uint8_t hands; catch_t with; } player_t;
typedef struct field { uint8_t side; size_t length; } field_t;
"""


def problems(text: str, source: str = "") -> list[str]:
    """What the text alone says against a header and a source."""
    return list(Types([text], [source]).problems())


class RulesTest(unittest.TestCase):
    """What is refused whatever compilers say."""

    def test_an_enumeration_in_a_structure_is_refused(self) -> None:
        for text in (SMALL + BALL, LARGE + BALL, BALL + SMALL):
            self.assertEqual(problems(text), [REFUSED])

    def test_in_a_source_too(self) -> None:
        self.assertEqual(problems(SMALL, BALL), [REFUSED])

    def test_and_by_another_name(self) -> None:
        text = SMALL.replace("colour_t", "paint_t") + "typedef paint_t colour_t;\n" + BALL
        self.assertEqual(problems(text), [REFUSED])

    def test_and_in_an_array(self) -> None:
        text = SMALL + "typedef struct balls { colour_t of[3]; } balls_t;\n"
        self.assertEqual(problems(text), ["'colour_t of[3];': an enumeration in a structure"])

    def test_and_without_a_name(self) -> None:
        with self.assertRaisesRegex(ProjectError, "One plain field a line"):
            problems("typedef struct ball { enum { RED } colour; } ball_t;\n")

    def test_a_structure_that_the_list_would_lack_is_refused(self) -> None:
        for text in ("struct ball { int size; };\n", "typedef union ball { int size; } ball_t;\n"):
            [only] = problems(text)
            self.assertIn("not a structure behind typedef", only)

    def test_an_enumeration_beside_structures_is_none_of_them(self) -> None:
        self.assertEqual(problems(SMALL + PLAIN.replace("colour_t", "hue_t")), [])


class LayoutsTest(unittest.TestCase):
    """What the compilers and the provers say."""

    tools: Toolchain

    @classmethod
    def setUpClass(cls) -> None:
        cls.tools = Toolchain()
        cls.tools.ensure("prove")

    def seeded(self, text: str) -> tuple[int, tuple[str, ...]]:
        """Of a project with one header: the structures compared on the host, what differs."""
        with tempfile.TemporaryDirectory(prefix="keel-test-") as folder:
            header = Path(folder) / "include" / "keel" / "seeded.h"
            header.parent.mkdir(parents=True)
            header.write_text(f"{INCLUDED}{text}", "utf-8")
            result = compared(self.tools, Path(folder))
        return result.on_host, result.differences

    def test_the_structures_of_keel_are_the_same_for_all(self) -> None:
        result = compared(self.tools, ROOT)
        headers = [*ROOT.glob("include/**/*.h"), *ROOT.glob("src/**/*.h")]
        texts = "".join(path.read_text("utf-8") for path in headers)
        self.assertEqual(result.differences, ())
        self.assertEqual(result.structures, len(re.findall(r"^typedef struct\b", texts, re.M)))
        self.assertGreater(result.on_host, 0)

    def test_an_enumeration_has_another_size_for_cbmc(self) -> None:
        _, differences = self.seeded(SMALL + BALL)
        self.assertIn(REFUSED, differences)
        self.assertIn("size of ball_t.colour: arm-none-eabi-gcc says 1, CBMC 4", differences)
        self.assertIn("offset of ball_t.size: arm-none-eabi-gcc says 2, CBMC 8", differences)
        self.assertIn("size of ball_t: arm-none-eabi-gcc says 3, CBMC 12", differences)
        self.assertFalse([line for line in differences if "Frama-C" in line])

    def test_plain_structures_are_the_same(self) -> None:
        self.assertEqual(self.seeded(PLAIN), (2, ()))

    def test_what_holds_a_pointer_is_not_asked_on_the_host(self) -> None:
        self.assertEqual(self.seeded(POINTERS), (0, ()))
