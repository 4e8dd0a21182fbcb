# SPDX-License-Identifier: Apache-2.0
"""Tests of which texts `make prove` refuses as they may look different to provers and compilers."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from keel.audit import disguises, shapes
from keel.base.files import write_text
from keel.c.syntax import SyntaxProblem
from keel.qualify.deceptions import BUILT, HIDDEN

ROOT = Path(__file__).resolve().parents[2]

HARNESS = """\
// SPDX-License-Identifier: Apache-2.0
void keel_box_harness(void)
{
    __CPROVER_assert(keel_box(1u) == 5u, "BOX_001: four more");
}
"""


class Projects(unittest.TestCase):
    def setUp(self) -> None:
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.write("include/keel/rtos/box.h", BUILT)
        self.write("proofs/box/keel_box_harness.c", HARNESS)

    def write(self, name: str, text: str) -> None:
        write_text(self.root / name, text)

    def problems(self, *allowed: str) -> list[str]:
        return disguises.problems(self.root, allowed)

    def test_a_guard_a_default_and_a_refusal_are_fine(self) -> None:
        self.assertEqual(self.problems(), [])

    def test_each_disguise_is_named_with_its_place(self) -> None:
        for fault, old, new, what in HIDDEN:
            with self.subTest(fault):
                self.write("include/keel/rtos/box.h", BUILT.replace(old, new))
                try:
                    problems = self.problems()
                except SyntaxProblem as error:
                    problems = [str(error).removeprefix(f"{self.root}/")]
                    what = "no C that can be parsed"
                self.assertTrue(any(what in text for text in problems), problems)
                self.assertRegex(problems[0], r"^include/keel/rtos/box\.h:\d+: ")

    def test_a_conditional_needs_a_reason_and_a_reason_a_conditional(self) -> None:
        said = "#ifdef KEEL_BOX_ROUND"
        text = BUILT.replace("    return", f"{said}\n    x++;\n#endif\n    return")
        self.write("include/keel/rtos/box.h", text)
        [problem] = self.problems()
        self.assertIn(f"box.h:13: `{said}`: provers and compilers may see different code", problem)
        self.assertEqual(self.problems(said), [])
        self.write("include/keel/rtos/box.h", BUILT)
        self.assertIn("stands nowhere any more", self.problems(said)[0])

    def test_a_harness_has_no_conditional_at_all(self) -> None:
        self.write(
            "proofs/box/keel_box_harness.c",
            HARNESS.replace("    __", "#if 0\n    __").replace(");\n}", ");\n#endif\n}"),
        )
        self.assertEqual(self.problems(), ["proofs/box/keel_box_harness.c:4: `#if 0`"])

    def test_lines_are_counted_across_those_that_go_on(self) -> None:
        text = BUILT.replace("#include", "#define KEEL_BOX_TWO(x) \\\n    ((x) + 2u)\n#include")
        self.write("include/keel/rtos/box.h", text.replace("    return", "    _Bad();\n    return"))
        [problem] = self.problems()
        self.assertIn("box.h:15: `_Bad`", problem)

    def test_an_address_is_told_from_a_number(self) -> None:
        held = (
            "typedef struct box {\n    const char *name;\n    char all[4];\n    char c;\n} box_t;\n"
        )
        text = "static long f(const box_t *box, const char *p, long n)\n{{\n    return {};\n}}\n"
        fields = shapes.pointers_in([held])
        for address in ("(long)p", "(long)(p + 1)", "(long)(box->name)", "(int)&n", '(long)"a"'):
            with self.subTest(address):
                [(line, what)] = shapes.in_what_is_proved(text.format(address), fields)
                self.assertEqual((line, f"`{address}`: an address as a number" in what), (3, True))
        for number in ("(long)(p - box->name)", "(long)*p", "(long)p[1]", "(int)box->c", "(int)n"):
            with self.subTest(number):
                self.assertEqual([*shapes.in_what_is_proved(text.format(number), fields)], [])

    def test_a_variable_may_hold_its_own_address(self) -> None:
        node = "    struct node n = { .next = &n };\n"
        text = BUILT.replace("    return", f"{node}    return")
        self.write("include/keel/rtos/box.h", text)
        self.assertEqual(self.problems(), [])

    def test_the_number_of_elements_has_one_value_everywhere(self) -> None:
        text = "static int all[4];\nstatic int f(void)\n{{\n    return {};\n}}\n"
        good = text.format("sizeof(all) / sizeof all[0]")
        self.assertEqual([*shapes.in_what_is_proved(good)], [])
        self.assertEqual(len([*shapes.in_what_is_proved(text.format("sizeof(all)"))]), 1)
        self.assertEqual(len([*shapes.in_what_is_proved(text.format("16 / sizeof(int)"))]), 1)
