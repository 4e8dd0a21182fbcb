#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of the slips of thought that mutants are made of: each operator makes what it is to make.

python3 tests/tools/test_slips.py
"""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from proofs.mutant_slips import surroundings  # noqa: E402
from proofs.mutants import Generated, generate  # noqa: E402

HEADER = """\
typedef struct box {
    uint32_t width;  /**< In mm. */
    uint32_t height; /**< In mm; see width. */
    uint32_t depth;
    float weight;
    uint32_t side[4];
    uint32_t *owner;
} box_t;
typedef enum colour {
    BOX_RED = 0, /**< , not blue */
    BOX_GREEN,
    BOX_BLUE
} colour_t;
#define BOX_STAGE_OPEN 0u /**< Open. */
#define BOX_STAGE_SHUT 1u
#define LID_KIND_FLAT 3u
#define LID_KIND_ROUND 4u

#define ONLY_ONE 7u
"""


def generated(body: str) -> Generated:
    """The mutants of a function with this body, and what was dropped."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "f.c"
        end = "}\n" * (1 + body.count("{") - body.count("}"))
        text = f"static int f(int a, box_t *p)\n{{\n    {body}\n{end}"
        path.write_text(text, encoding="utf-8")
        return generate(path, surroundings([HEADER]))


def made(body: str, kind: str) -> list[str]:
    """What the mutants of a kind make of a body."""
    return [mutant.after for mutant in generated(body).mutants if mutant.kind == kind]


class Slips(unittest.TestCase):
    def test_two_statements_are_exchanged(self) -> None:
        self.assertEqual(made("p->x = 1;\n    a = p->x;\n    a++;", "order"),
                         ["a = p->x; p->x = 1;", "a++; a = p->x;"])  # fmt: skip

    def test_also_in_a_branch_with_what_stands_between(self) -> None:
        body = "if (a) {\n    a = 1;\n    //@ assert a == 1;\n    g(a);\n    }"
        [mutant] = [one for one in generated(body).mutants if one.kind == "order"]
        self.assertEqual(mutant.replacement.split("\n")[1].strip(), "//@ assert a == 1;")
        self.assertEqual(mutant.after, "g(a); a = 1;")

    def test_declarations_and_ends_stay_where_they_are(self) -> None:
        for body in ("int b;\n    int c;", "a = 1;\n    return a;", "g(a);\n    break;"):
            with self.subTest(body):
                self.assertEqual(made(body, "order"), [])
        self.assertEqual(made("const int b[2] = {1, 2};\n    int c = b[0];", "order"),
                         ["int c = b[0]; const int b[2] = {1, 2};"])  # fmt: skip

    def test_a_write_comes_before_its_check(self) -> None:
        body = "if (a > 3) {\n        return 1;\n    }\n    p->x = a;"
        self.assertEqual(made(body, "early"), ["p->x = a; if (a > 3) { return 1; }"])
        self.assertEqual(made(body.replace("return 1", "a = 3"), "early"), [])

    def test_what_has_nothing_to_do_with_each_other_is_left_in_order(self) -> None:
        for body, exchanged in (
            ("p->x = 1;\n    p->y = 2;", False),
            ("p->q.n = 1;\n    p->q.x[a] += 2;", False),
            ("p->x = 1;\n    p->y = p->x;", True),
            ("p->q = *q;\n    p->q.n = 2;", True),
            ("p->o[p->n] = 1;\n    p->n = 2;", True),
            ("p->o[a] = 1;\n    p->o[b] = 2;", True),
            ("p->x = g(1);\n    p->y = g(2);", True),
            ("p->x = 1;\n    q->y = 2;", True),
            ("b = a;\n    c += 2;", False),
            ("b++;\n    c = p->x;", False),
            ("const int b = p->x;\n    const int *const c = p->q;", False),
            ("int b = 1;\n    int c = b;", True),
            ("b = c;\n    c = 2;", True),
            ("b = a++;\n    c = 2;", True),
            ("b = g(1);\n    c = 2;", True),
            ("b = 1;\n    c = *p;\n    g(&b);", True),
            ("b = 1;\n    *p = 2;", True),
        ):
            with self.subTest(body):
                self.assertEqual(bool(made(body, "order")), exchanged)

    def test_what_only_computes_may_stand_before_a_check(self) -> None:
        for statement, moved in (("b = g(a);", False), ("const int b = 1;", False),
                                 ("*p = 1;", True), ("g(a);", True)):  # fmt: skip
            with self.subTest(statement):
                body = "if (a > 3) {\n        return 1;\n    }\n    " + statement
                self.assertEqual(bool(made(body, "early")), moved)

    def test_a_branch_is_left_out(self) -> None:
        body = (
            "if (a) {\n    a = 1;\n    } else if (b) {\n    a = 2;\n    } else {\n    a = 3;\n    }"
        )
        self.assertEqual(made(body, "branch"), [
            ";", "} else if (b) {} else {", "} else {}",
        ])  # fmt: skip

    def test_a_value_is_computed_and_not_taken(self) -> None:
        self.assertEqual(made("a = g(1);", "stale"), ["(void)(g(1));"])
        self.assertEqual(made("p->x[a] = (a == 1) ? 2 : 3;", "stale"),
                         ["(void)((a == 1) ? 2 : 3);"])  # fmt: skip
        for body in ("const int b = g(1);", "box_t *b = g(1);", "a = 1;", "g(a == 1);"):
            with self.subTest(body):
                self.assertEqual(made(body, "stale"), [])

    def test_a_clause_is_forgotten(self) -> None:
        cases = {
            "if (a && b && !g(c)) {": ["if(b&&!g(c)){", "if(a&&!g(c)){", "if(a&&b){"],
            "a = (b || (c && d)) ? 1 : 2;": [
                "a=((c&&d))?1:2;", "a=(b)?1:2;", "a=(b||(d))?1:2;", "a=(b||(c))?1:2;"],
            "return a || b;": ["returnb;", "returna;"],
        }  # fmt: skip
        for body, wanted in cases.items():
            with self.subTest(body):
                self.assertEqual([text.replace(" ", "") for text in made(body, "clause")], wanted)

    def test_the_neighbours_field_is_used(self) -> None:
        self.assertEqual(made("a = p->width;", "field"), ["a = p->depth;", "a = p->height;"])
        for body in ("a = p->weight;", "a = p->side[0];", "a = p->owner;", "a = p->height();"):
            with self.subTest(body):
                self.assertEqual([text for text in made(body, "field") if "height" not in body], [])

    def test_the_neighbours_index_is_used(self) -> None:
        self.assertEqual(made("a[i] = b[j];", "index"), [
            "a[0u] = b[j];", "a[i + 1u] = b[j];", "a[j] = b[j];",
            "a[i] = b[0u];", "a[i] = b[i];", "a[i] = b[j + 1u];",
        ])  # fmt: skip

    def test_arguments_are_exchanged(self) -> None:
        self.assertEqual(made("g(a, h(b, c), d);", "arguments"), [
            "g(a, d, h(b, c));", "g(h(b, c), a, d);", "g(a, h(c, b), d);"])  # fmt: skip
        self.assertEqual(made("if (a) {", "arguments") + made("g(a, a);", "arguments"), [])

    def test_another_constant_of_its_kind_is_used(self) -> None:
        cases = {
            "a = BOX_RED;": ["a = BOX_BLUE;", "a = BOX_GREEN;"],
            "a = BOX_STAGE_SHUT;": ["a = BOX_STAGE_OPEN;"],
            "a = LID_KIND_FLAT;": ["a = LID_KIND_ROUND;"],
            "a = ONLY_ONE;": [],
        }
        for body, wanted in cases.items():
            with self.subTest(body):
                self.assertEqual(made(body, "family"), wanted)

    def test_what_says_the_same_is_dropped_and_counted(self) -> None:
        found = generated("a = 1;\n    a = 1;")
        self.assertEqual([one.kind for one in found.mutants if one.kind == "order"], [])
        self.assertGreaterEqual(found.dropped, 1)
        texts = [mutant.apply(Path(__file__).read_text()) for mutant in found.mutants]
        self.assertEqual(len(texts), len(set(texts)))


if __name__ == "__main__":
    unittest.main()
