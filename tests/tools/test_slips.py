# SPDX-License-Identifier: Apache-2.0
"""Tests of the slips of thought that mutants are made of: each operator makes what it is to
make.
"""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from keel.mutate.operators import Generated, generate
from keel.mutate.slips import numbers_beyond, surroundings

ROOT = Path(__file__).resolve().parents[2]

HEADER = """\
typedef struct box {
    uint32_t width;  /**< In mm. */
    uint32_t height; /**< In mm; see width. */
    uint32_t depth;
    float weight;
    uint32_t side[4];
    uint32_t lid[BOX_LIDS];
    uint32_t *owner;
} box_t;
typedef enum colour {
    BOX_RED = 0, /**< , not blue */
    BOX_GREEN,
    BOX_BLUE
} colour_t;
#define BOX_LIDS 8u

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


def beyond(body: str, *numbers: int) -> list[str]:
    """What the slips beyond numbers make of a body."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "f.c"
        text = f"static int f(int a, box_t *p)\n{{\n    {body}\n}}\n"
        path.write_text(text, encoding="utf-8")
        around = surroundings([HEADER], {"f": numbers})
        return [one.after for one in generate(path, around).mutants if one.kind == "beyond"]


def made(body: str, kind: str) -> list[str]:
    """What the mutants of a kind make of a body."""
    return [mutant.after for mutant in generated(body).mutants if mutant.kind == kind]


class Beyond(unittest.TestCase):
    """Slips that show beyond a bound alone."""

    def test_an_index_comes_round(self) -> None:
        found = beyond("p->owner[a] = p->side[2];", 128)
        self.assertEqual(found, ["p->owner[a % 128u] = p->side[2];"])
        self.assertEqual(beyond("p->side[BOX_RED] = 1u;", 128), [])
        self.assertEqual(beyond("p->side[a] = 1u;"), [])

    def test_an_index_reaches_no_number_beyond_its_array(self) -> None:
        self.assertEqual(beyond("p->side[a] = 1u;", 4), [])
        self.assertEqual(beyond("p->side[a] = 1u;", 2), ["p->side[a % 2u] = 1u;"])
        self.assertEqual(beyond("p->lid[a] = 1u;", 4), ["p->lid[a % 4u] = 1u;"])
        self.assertEqual(beyond("p->lid[a] = 1u;", 8), [])

    def test_what_counts_an_index_may_come_to_the_length(self) -> None:
        loop = "for (int i = 0; i < 9; i++) { p->side[i] = 1u; }"
        self.assertEqual(beyond(loop, 8), [])
        self.assertEqual(len(beyond(loop, 4)), 4)

    def test_a_size_comes_round_and_a_comparison_changes(self) -> None:
        self.assertEqual(
            beyond("return p->width < 9u;", 64),
            [
                "return (p->width % 64u) < 9u;",
                "return ((p->width < 9u) && (p->width < 64u));",
                "return ((p->width < 9u) || (p->width >= 64u));",
            ],
        )
        self.assertEqual(beyond("return p->width == 9u;", 64), [])
        self.assertEqual(len(beyond("return a > BOX_RED;", 64, 256)), 6)

    def test_a_time_is_no_count(self) -> None:
        self.assertEqual(beyond("return p->age_us < 9u;", 64), [])
        self.assertEqual(len(beyond("return p->width < a_us;", 64)), 3)

    def test_a_loop_ends_by_its_head(self) -> None:
        loop = "for (int i = 0; i != a; i++) { f(i, p); }"
        self.assertEqual(beyond(loop, 16), [loop.replace("i != a", "(i != a) && (i < 16u)")])
        loop = "while (p->width != 0u) { p->width -= 1u; }"
        ends = loop.replace("p->width != 0u", "(p->width != 0u) && (p->width < 16u)")
        self.assertEqual(beyond(loop, 16), [ends])

    def test_a_loop_that_counts_nothing_ends_by_a_number_beside(self) -> None:
        loop = "while (p->width != 0u) { g(p); }"
        names = ["depth", "height", "width"]
        self.assertEqual(
            beyond(loop, 16),
            [
                loop.replace("p->width != 0u", f"(p->width != 0u) && (p->{name} < 16u)")
                for name in names
            ],
        )

    def test_no_slip_has_a_block_of_its_own(self) -> None:
        body = "for (int i = 0; i < a; i++) { if (i > 3) { p->owner[i] = 1u; } }"
        made_ones = beyond(body, 8)
        self.assertGreater(len(made_ones), 8)
        self.assertTrue(all(one.count("{") == body.count("{") for one in made_ones))

    def test_numbers_beyond_bounds(self) -> None:
        for bounds, numbers in (
            (["KEEL_QUEUE_CAPACITY = 4 (32 is shipped)"], (8,)),
            (["any_bits(5u)", "any_bits64(62u)"], (32,)),
            (["count <= 8u in any_count", "text[36]"], (16, 64)),
            (["table_in_order(3) in any_valid_mavlink", "mavlink.known = 3 in any_mavlink"], (4,)),
            (["for (uint32_t sensors = 2u; sensors <= 2u; sensors++)"], (4,)),
            (["more > 0u", "x < 0xFFu", "y = nondet_bool() ? 1u : A"], ()),
        ):
            with self.subTest(bounds):
                self.assertEqual(numbers_beyond(bounds), numbers)


class Slips(unittest.TestCase):
    def test_two_statements_are_exchanged(self) -> None:
        self.assertEqual(
            made("p->x = 1;\n    a = p->x;\n    a++;", "order"),
            ["a = p->x; p->x = 1;", "a++; a = p->x;"],
        )

    def test_also_in_a_branch_with_what_stands_between(self) -> None:
        body = "if (a) {\n    a = 1;\n    //@ assert a == 1;\n    g(a);\n    }"
        [mutant] = [one for one in generated(body).mutants if one.kind == "order"]
        self.assertEqual(mutant.replacement.split("\n")[1].strip(), "//@ assert a == 1;")
        self.assertEqual(mutant.after, "g(a); a = 1;")

    def test_declarations_and_ends_stay_where_they_are(self) -> None:
        for body in ("int b;\n    int c;", "a = 1;\n    return a;", "g(a);\n    break;"):
            with self.subTest(body):
                self.assertEqual(made(body, "order"), [])
        self.assertEqual(
            made("const int b[2] = {1, 2};\n    int c = b[0];", "order"),
            ["int c = b[0]; const int b[2] = {1, 2};"],
        )

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
        for statement, moved in (
            ("b = g(a);", False),
            ("const int b = 1;", False),
            ("*p = 1;", True),
            ("g(a);", True),
        ):
            with self.subTest(statement):
                body = "if (a > 3) {\n        return 1;\n    }\n    " + statement
                self.assertEqual(bool(made(body, "early")), moved)

    def test_a_branch_is_left_out(self) -> None:
        body = (
            "if (a) {\n    a = 1;\n    } else if (b) {\n    a = 2;\n    } else {\n    a = 3;\n    }"
        )
        self.assertEqual(made(body, "branch"), [";", "} else if (b) {} else {", "} else {}"])

    def test_a_value_is_computed_and_not_taken(self) -> None:
        self.assertEqual(made("a = g(1);", "stale"), ["(void)(g(1));"])
        self.assertEqual(
            made("p->x[a] = (a == 1) ? 2 : 3;", "stale"), ["(void)((a == 1) ? 2 : 3);"]
        )
        for body in ("const int b = g(1);", "box_t *b = g(1);", "a = 1;", "g(a == 1);"):
            with self.subTest(body):
                self.assertEqual(made(body, "stale"), [])

    def test_a_clause_is_forgotten(self) -> None:
        cases = {
            "if (a && b && !g(c)) {": ["if(b&&!g(c)){", "if(a&&!g(c)){", "if(a&&b){"],
            "a = (b || (c && d)) ? 1 : 2;": [
                "a=((c&&d))?1:2;",
                "a=(b)?1:2;",
                "a=(b||(d))?1:2;",
                "a=(b||(c))?1:2;",
            ],
            "return a || b;": ["returnb;", "returna;"],
        }
        for body, wanted in cases.items():
            with self.subTest(body):
                self.assertEqual([text.replace(" ", "") for text in made(body, "clause")], wanted)

    def test_the_neighbours_field_is_used(self) -> None:
        self.assertEqual(made("a = p->width;", "field"), ["a = p->depth;", "a = p->height;"])
        for body in ("a = p->weight;", "a = p->side[0];", "a = p->owner;", "a = p->height();"):
            with self.subTest(body):
                self.assertEqual([text for text in made(body, "field") if "height" not in body], [])

    def test_the_neighbours_index_is_used(self) -> None:
        self.assertEqual(
            made("a[i] = b[j];", "index"),
            [
                "a[0u] = b[j];",
                "a[i + 1u] = b[j];",
                "a[j] = b[j];",
                "a[i] = b[0u];",
                "a[i] = b[i];",
                "a[i] = b[j + 1u];",
            ],
        )

    def test_arguments_are_exchanged(self) -> None:
        self.assertEqual(
            made("g(a, h(b, c), d);", "arguments"),
            ["g(a, d, h(b, c));", "g(h(b, c), a, d);", "g(a, h(c, b), d);"],
        )
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
