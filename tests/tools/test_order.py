# SPDX-License-Identifier: Apache-2.0
"""Tests of which expressions `make prove` refuses as C leaves the order of their operands open.

ISO C11, 6.5p2: a side effect that is unsequenced relative to a value computation of the same object
is undefined behaviour; 6.5.2.2p10: calls in one expression come in any order.
"""

from __future__ import annotations

import unittest

from keel.audit import order

TEXT = """\
static int shared;
static const int fixed = 3;
/*@ assigns \\nothing; */
static int look(const int *at);
/*@ assigns *at; */
static int take(int *at);
/*@ requires \\valid(box); assigns box->a; */
static int f(struct box *box, int *at, int i)
{
    int x = i;
    int y = i;
    int all[2] = { 0, 0 };

    STATEMENT
    return look(&x) + all[0];
}
"""
WRONG = (
    "y = x + take(&x);",
    "y = take(&x) + x;",
    "y = take(at) + take(&y);",
    "y = *at - take(at);",
    "y = box->a * take(at);",
    "y = all[i] | take(&all[1]);",
    "y = shared + take(at);",
    "x += take(&x);",
    "box->a += take(at);",
    "box->next->a = take(at);",
    "all[*at] = take(at);",
    "*box->at = take(at);",
    "box->run(*at, take(at));",
    "y = look(at) + take(at);",
    "use(take(at), take(at));",
    "use(i, box->a, take(at));",
    "y = i++ + all[0];",
    "y = i++ + i;",
    "y = (i = 3) * i;",
    "int two[2] = { take(at), *at };",
    "struct box other = { .a = take(at), .b = box->b };",
    "if ((take(at) > 0) == (*at > 0)) { y = 0; }",
    "struct two pair = { one_box, take(one_box.cells) };",
)
RIGHT = (
    "y = take(&x); y += x;",
    "y = i + take(&x);",
    "y = fixed + take(at);",
    "y = look(at) + *at;",
    "y = look(&x) + look(at);",
    "y = (take(at) > 0) && (*at > 0);",
    "y = (take(at) > 0) ? *at : x;",
    "box->a = take(at);",
    "all[i] = take(at);",
    "box->all[i].a = take(&box->b);",
    "use(take(at), i);",
    "use(&x, &y, take(at));",
    "i += take(at);",
    "x = (i = 3) * y;",
    "for (int k = 0; k < i; k++) { x += k; }",
)


class Orders(unittest.TestCase):
    def test_an_operand_that_writes_has_none_beside_it_that_reads(self) -> None:
        for statement in WRONG:
            with self.subTest(statement):
                lines = [line for line, _ in order.unordered(TEXT.replace("STATEMENT", statement))]
                self.assertEqual(lines, [14])

    def test_what_has_an_order_or_meets_nowhere_is_fine(self) -> None:
        for statement in RIGHT:
            with self.subTest(statement):
                text = TEXT.replace("STATEMENT", statement)
                self.assertEqual([*order.unordered(text)], [])

    def test_a_function_of_a_header_may_be_known_to_write_nothing(self) -> None:
        text = TEXT.replace("STATEMENT", "y = seen(at) + *at;")
        self.assertEqual(len([*order.unordered(text)]), 1)
        self.assertEqual([*order.unordered(text, {"seen"})], [])

    def test_a_pointer_of_that_name_leads_to_another_function(self) -> None:
        text = TEXT.replace("STATEMENT", "int (*seen)(void) = &other; y = seen() + shared;")
        self.assertEqual(len([*order.unordered(text, {"seen"})]), 1)

    def test_the_own_function_counts_where_a_header_has_one_of_that_name(self) -> None:
        text = TEXT.replace("STATEMENT", "y = own(at) + *at;")
        text += "static int own(int *at)\n{\n    return *at++;\n}\n"
        self.assertEqual(len([*order.unordered(text, {"own"})]), 1)

    def test_a_frame_of_one_behaviour_is_not_that_of_the_function(self) -> None:
        text = TEXT.replace("STATEMENT", "y = half(at) + *at;")
        contract = "/*@ behavior one: assumes *at == 0; assigns \\nothing; */\n"
        text = text.replace(
            "/*@ assigns *at; */", f"{contract}static int half(int *at);\n/*@ assigns *at; */"
        )
        self.assertEqual(len([*order.unordered(text)]), 1)
        whole = text.replace("/*@ behavior", "/*@ assigns \\nothing; behavior")
        self.assertEqual([*order.unordered(whole)], [])
