# SPDX-License-Identifier: Apache-2.0
"""Tests of the rules for the text of proofs: what would make a harness say less is refused."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from keel.audit import harness_rules
from keel.audit.harness_inputs import taken
from keel.base.files import write_text
from keel.c.project import find_units
from keel.c.syntax import SyntaxProblem

ROOT = Path(__file__).resolve().parents[2]

FILES = {
    "include/keel/rtos/box.h": "#define BOX_SIDES 4u\nint keel_box_put(int *box, int value);\n",
    "src/rtos/box.c": (
        '#include "keel/rtos/box.h"\n\nint keel_box_put(int *box, int value)\n{\n'
        "    *box = value;\n    return 0;\n}\n"
    ),
    "specs/model/box.h": "int model_box_put(int *box, int value);\n",
    "specs/model/box.c": (
        '#include "box.h"\n\nint model_box_put(int *box, int value)\n{\n    return 0;\n}\n'
    ),
    "proofs/common/box_proof.h": (
        "#ifndef BOX_PROOF_H\n#define BOX_PROOF_H\n\n#define MOST 7u\n\nint nondet_int(void);\n\n"
        "static int any_int(void)\n{\n    return nondet_int();\n}\n\n#endif\n"
    ),
    "proofs/box/keel_box_put_harness.c": (
        "// sources: src/rtos/box.c specs/model/box.c\n// covers: keel_box_put\n"
        '#include "../../specs/model/box.h"\n#include "../common/box_proof.h"\n'
        '#include "keel/rtos/box.h"\n\n'
        "void keel_box_put_harness(void)\n{\n    int box = nondet_int();\n    int model = box;\n\n"
        '    __CPROVER_assert(keel_box_put(&box, 1) == model_box_put(&model, 1), "BOX_001: x");\n'
        "}\n"
    ),
}
PROOF = "proofs/common/box_proof.h"
HARNESS = "proofs/box/keel_box_put_harness.c"
MODEL = "specs/model/box.c"


class RulesTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        for name, text in FILES.items():
            write_text(self.root / name, text)

    def problems(self) -> list[str]:
        return harness_rules.problems(self.root, find_units(self.root).values())

    def assert_found(self, file: str, text: str, why: str) -> None:
        """Behind what a file includes and declares stands a text."""
        before = FILES[file]
        end = "#endif\n" if before.endswith("#endif\n") else ""
        write_text(self.root / file, f"{before.removesuffix(end)}{text}\n{end}")
        found = self.problems()
        self.assertTrue(any(why in problem for problem in found), found)
        write_text(self.root / file, before)

    def test_what_is_good_has_no_problems(self) -> None:
        self.assertEqual(self.problems(), [])

    def test_keels_own_proofs_have_none(self) -> None:
        self.assertEqual(harness_rules.problems(ROOT, find_units(ROOT).values()), [])

    def test_what_gives_anything_has_no_body(self) -> None:
        for file in (PROOF, HARNESS, MODEL):
            with self.subTest(file):
                self.assert_found(
                    file,
                    "int nondet_other(void)\n{\n    return 1;\n}",
                    "nondet_other has a body: it does not give anything",
                )

    def test_a_macro_stands_for_no_function(self) -> None:
        for line, why in (
            ("#define float_same(a, b) true", "the macro float_same is not in capitals"),
            ("#define keel_box_put model_box_put", "the macro keel_box_put is not in capitals"),
            ("#define __CPROVER_assert(a, b)", "the macro __CPROVER_assert is not in capitals"),
            ("#  define \\\n  box_same", "the macro box_same is not in capitals"),
            ("#define KEEL_QUEUE_CAPACITY 2u", "the macro KEEL_QUEUE_CAPACITY begins with KEEL_"),
            ("#define BOX_SIDES 2u", "the macro BOX_SIDES has a name that the code uses"),
            ("#define UINT32_MAX 16u", "the macro UINT32_MAX has a name that the code uses"),
            ("#define NULL 1", "the macro NULL has a name that the code uses"),
            ("#undef MOST", "#undef may make this another text than it seems"),
            ('#pragma CPROVER check disable "bounds"', "#pragma may make this another text"),
        ):
            for file in (PROOF, HARNESS, MODEL):
                with self.subTest(line, file=file):
                    self.assert_found(file, line, why)

    def test_a_macro_hides_nothing(self) -> None:
        for line, why in (
            ("#define SETTLED __CPROVER_assume(raw != 7u)", "SETTLED has __CPROVER_assume in it"),
            ("#define ANY nondet_int()", "the macro ANY has nondet_int in it"),
            ("#define END return", "the macro END has return in it"),
            ("#define ASIDE if (false)", "the macro ASIDE has if in it"),
            ("#define SET MOST = 3u", "the macro SET has = in it: it does more than give a value"),
            ("#define NEXT(x) ((x)++)", "the macro NEXT has ++ in it"),
            ("#define TWO(x) x; x", "the macro TWO has ; in it"),
            ("#define PASTED(x) nondet##x", "the macro PASTED has ## in it"),
            ("#define CALLED settle(0)", "the macro CALLED names settle"),
            ("#define CALL(f) f(0)", "the macro CALL names f"),
            ("#define RAW \\\n    (raw - 1u)", "the macro RAW names raw"),
            ("#define PAIR 1u, 2u", "the macro PAIR is no whole expression"),
            ("#define OPEN (1u", "the macro OPEN is no whole expression"),
        ):
            for file in (PROOF, HARNESS, MODEL):
                with self.subTest(line, file=file):
                    self.assert_found(file, line, why)

    def test_a_macro_may_be_an_expression(self) -> None:
        text = (
            "#define LIMIT (MOST + 0x1p-3f) /* of each */\n#define BIT(n) (1u << (n))\n"
            '#define BOTH {true, (uint8_t)7u}\n#define NAME "a name = (x"\n'
        )
        write_text(self.root / MODEL, FILES[MODEL] + text)
        self.assertEqual(self.problems(), [])

    def test_a_variable_stands_for_no_function(self) -> None:
        for text in (
            "void f(void)\n{\n    int (*any_int)(void) = other;\n\n    any_int();\n}",
            "void f(int (*any_int)(void))\n{\n    any_int();\n}",
        ):
            for file in (PROOF, HARNESS, MODEL):
                with self.subTest(text, file=file):
                    self.assert_found(file, text, "any_int is a variable that is called")

    def test_a_variable_stands_for_no_other(self) -> None:
        for text in (
            "void f(void)\n{\n    int box;\n\n    {\n        static int box;\n    }\n}",
            "void f(int box)\n{\n    if (box) {\n        int box = 1;\n    }\n}",
        ):
            with self.subTest(text):
                self.assert_found(PROOF, text, "box is declared around, too")
        self.assert_found(
            PROOF, "void f(void)\n{\n    typedef int box_t;\n}", "a type is defined in a function"
        )
        text = (
            "void f(int (*take)(int i))\n{\n    int i;\n\n"
            "    for (int i = 0; i < 3; i++) {\n    }\n"
            "    if (i) {\n        int j;\n    } else {\n        int j;\n    }\n}\n"
        )
        write_text(self.root / HARNESS, FILES[HARNESS] + text)
        self.assertEqual(self.problems(), [])

    def test_a_model_calls_what_has_a_body(self) -> None:
        for text, why in (
            ("void end(int status);", "end is declared here, without a body"),
            ("void f(void)\n{\n    end();\n}", "calls end, which has no body"),
            ("void f(void)\n{\n    exit(1);\n}", "exit ends what is asserted after it, too"),
            ("void (*end)(int) = exit;", "exit ends what is asserted after it, too"),
        ):
            with self.subTest(text):
                self.assert_found(MODEL, text, why)
        self.assert_found("specs/model/box.h", "void end(int x);", "end is declared here, without")
        text = (
            "int nondet_int(void);\nstatic int f(void);\nstatic int f(void)\n{\n    return 1;\n}\n"
        )
        write_text(self.root / MODEL, FILES[MODEL] + text)
        self.assertEqual(self.problems(), [])

    def test_how_is_rounded_is_the_compilers(self) -> None:
        for file in (PROOF, HARNESS, MODEL):
            with self.subTest(file):
                self.assert_found(
                    file,
                    "void f(void)\n{\n    __CPROVER_rounding_mode = 1;\n}",
                    "__CPROVER_rounding_mode is CBMC's own",
                )

    def test_what_hides_a_directive_or_a_way_past_an_assertion_is_refused(self) -> None:
        for text, why in (
            ('void f(void)\n{\n    _Pragma("x");\n}', "_Pragma has no place in proofs"),
            ("void f(void)\n{\n    goto end;\nend:\n    ;\n}", "goto has no place in proofs"),
        ):
            with self.subTest(text):
                self.assert_found(PROOF, text, why)

        for text in ("#\\\ndefine any_int true", "# /* x */ define any_int true"):
            with self.subTest(text), self.assertRaises(SyntaxProblem):
                self.assert_found(PROOF, text, "never asked")

    def test_no_condition_leaves_anything_out(self) -> None:
        for line in ("#if 0", "#ifdef MOST", "#ifndef __CPROVER__", "#if defined(MOST)"):
            with self.subTest(line):
                self.assert_found(PROOF, f"{line}\nint left(void);\n#endif", "what is left out")

    def test_a_source_is_linked_and_not_included(self) -> None:
        self.assert_found(HARNESS, '#include "../../src/rtos/box.c"', "a source is included")

    def test_a_function_of_the_code_is_the_codes(self) -> None:
        body = "(int *box, int value)\n{\n    return 0;\n}"
        for file in (PROOF, HARNESS, MODEL):
            with self.subTest(file):
                self.assert_found(
                    file, f"int keel_box_put{body}", "keel_box_put is a function of the code"
                )
        self.assert_found(PROOF, f"static int keel_box_other{body}", "bears a name of the code")
        self.assert_found(PROOF, f"static int __CPROVER_assume{body}", "is CBMC's own")

    def test_what_is_linked_is_not_defined_beside_it(self) -> None:
        body = "(int *box, int value)\n{\n    return 0;\n}"
        self.assert_found(
            HARNESS,
            f"int model_box_put{body}",
            "model_box_put is defined by proofs, and by specs/model/box.c",
        )

    def test_what_is_called_has_a_body(self) -> None:
        for call in (
            "abort()",
            "exit(0)",
            "__builtin_unreachable()",
            "any_other()",
            "__CPROVER_cover(0)",
            "longjmp(0, 1)",
        ):
            with self.subTest(call):
                self.assert_found(
                    PROOF,
                    f"static void end(void)\n{{\n    {call};\n}}",
                    f"calls {call.partition('(')[0]}, which has no body",
                )


class Conditions(unittest.TestCase):
    def test_a_text_without_what_is_left_out(self) -> None:
        text = "#ifndef CRC_AS_IT_IS\nint one;\n#else\nint two;\n#endif\nint three;\n"
        self.assertEqual(taken(text, []).split("\n")[1::2], ["int one;", "        ", "int three;"])
        left = taken(text, ["CRC_AS_IT_IS"])
        self.assertEqual(left.split("\n")[1::2], ["        ", "int two;", "int three;"])
        self.assertEqual(len(left), len(text))
