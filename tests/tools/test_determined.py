# SPDX-License-Identifier: Apache-2.0
"""Tests of the check that every function's outcome is determined: each gap in it is found.

A small project in which all is determined is changed in one place.
"""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from test_prove import WholeRunCase

from keel.audit import clauses, determined
from keel.base.files import write_text
from keel.c import declarations
from keel.c.project import ProjectError

ROOT = Path(__file__).resolve().parents[2]

HEADER = """\
#define BOX_SIDES 4u
#define BOX_COUNTS(box) (box)->count, (box)->side[0 .. BOX_SIDES - 1]
typedef struct keel_lid {
    float angle; /**< In rad; see x. */
    const char *name;
} keel_lid_t;
typedef struct keel_box {
    uint32_t count;
    uint8_t side[BOX_SIDES];
    keel_lid_t lid;
} keel_box_t;
/*@ predicate box_full(keel_box_t *b) = \\forall integer i; 0 <= i < 4 ==> b->side[i] > 0;
  @ predicate moved{L, M}(keel_box_t *b) =
  @     \\at(b->count, M) == \\at(b->lid.angle, L);
  @*/
/*@ requires \\valid(box) && box_full(box);
  @ assigns BOX_COUNTS(box), box->lid.angle;
  @ ensures BOX_001: \\result == 0 && box->count == \\old(box->count) + more;
  @ ensures BOX_002: \\forall integer i; 0 <= i < 4 ==> box->side[i] == 1;
  @ ensures BOX_003_lid: box->lid.angle == 0;
  @*/
int32_t keel_box_put(keel_box_t *box, uint32_t more);
/*@ assigns \\nothing;
  @ ensures BOX_004: \\result == box->lid.angle;
  @*/
static inline float keel_box_angle(const keel_box_t *box)
{
    return box->lid.angle;
}
"""
MODEL = """\
int32_t model_box_put(keel_box_t *box, uint32_t more);
float model_box_angle(const keel_box_t *crate);
"""
SAME = """\
#define SIDES BOX_SIDES
static inline bool float_same(float a, float b)
{
    return __CPROVER_equal(a, b);
}

static bool lid_same(const keel_lid_t *a, const keel_lid_t *b)
{
    return float_same(a->angle, b->angle) && (a->name == b->name);
}

static bool box_same(const keel_box_t *a, const keel_box_t *b, uint32_t i)
{
    return (a->count == b->count) && lid_same(&a->lid, &b->lid) && (a->side[i] == b->side[i]);
}
"""
PUT = """\
// covers: keel_box_put
// defines: -DBOX_SIDES=2u
#include "../common/same_box.h"
#include "../../specs/model/box.h"

void keel_box_put_harness(void)
{
    const uint32_t more = any_bits(8u);
    const uint32_t x = any_below(SIDES);
    keel_box_t box = nondet_box();
    keel_box_t model = box;
    int32_t status;

    __CPROVER_assume(more > 0u);

    status = keel_box_put(&box, more);

    __CPROVER_assert(status == model_box_put(&model, more), "BOX_001_model: (as) the model");
    __CPROVER_assert((more > 0u) && box_same(&box, &model, x), "BOX_002_model: says");
}
"""
ANGLE = """\
// covers: keel_box_angle
#include "../common/same_box.h"
#include "../../specs/model/box.h"

void keel_box_angle_harness(void)
{
    const keel_box_t box = nondet_box();
    const float expected = model_box_angle(&box);

    __CPROVER_assert(float_same(keel_box_angle(&box), expected), "BOX_004_model: as the model");
}
"""
FILES = {
    "include/keel/rtos/box.h": HEADER,
    "src/rtos/box.c": "int32_t keel_box_put(keel_box_t *box, uint32_t more)\n{\n    return 0;\n}\n",
    "specs/model/box.h": MODEL,
    "proofs/common/same_box.h": SAME,
    "proofs/box/keel_box_put_harness.c": PUT,
    "proofs/box/keel_box_angle_harness.c": ANGLE,
}
BY_WP = '[box]\ndetermined = [{ function = "keel_box_put", by = "wp", reason = "no end" }]\n'


class DeterminedTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        for name, text in FILES.items():
            self.write(name, text)

    def write(self, name: str, text: str) -> None:
        write_text(self.root / name, text)

    def change(self, name: str, old: str, new: str) -> None:
        path = next(path for path in FILES if path.endswith(name))
        self.assertIn(old, FILES[path])
        self.write(path, FILES[path].replace(old, new))

    def outcome(self, function: str = "keel_box_put") -> determined.Outcome:
        return next(one for one in determined.of_tree(self.root) if one.function == function)

    def problems(self) -> list[str]:
        return [text for one in determined.of_tree(self.root) for text in one.problems]

    def assert_found(self, text: str) -> None:
        found = self.problems()
        self.assertTrue(any(text in problem for problem in found), found)
        self.write_all()

    def write_all(self) -> None:
        for name, text in FILES.items():
            self.write(name, text)


class Equality(DeterminedTest):
    def test_all_is_determined(self) -> None:
        self.assertEqual(self.problems(), [])
        found = determined.of_tree(self.root)
        self.assertEqual([one.by for one in found], ["equality", "equality"])
        self.assertEqual(
            determined.summary(found),
            "determined: 1 of 2 functions for every valid state, 1 within a bound"
            " (1 of them with WP's clauses on every field beyond it)",
        )

    def test_what_a_harness_narrows_is_listed(self) -> None:
        bounds = self.outcome().harnesses["keel_box_put_harness"]
        self.assertEqual(bounds, ["BOX_SIDES = 2 (4 is shipped)", "more > 0u", "any_bits(8u)"])
        row = determined.as_markdown(determined.of_tree(self.root))
        self.assertIn(
            "| keel_box_put | within a bound; WP's clauses name every field beyond it |"
            " keel_box_put_harness | BOX_SIDES = 2 (4 is shipped); more > 0u;",
            row,
        )

    def test_a_model_must_be_declared_with_the_same_types(self) -> None:
        self.change("model/box.h", "model_box_put(", "model_box_fill(")
        self.assert_found("specs/model/box.h declares no model_box_put")
        for old, new in (
            ("uint32_t more", "uint16_t more"),
            ("int32_t model", "int model"),
            ("const keel_box_t *c", "keel_box_t *c"),
        ):
            with self.subTest(new):
                self.change("model/box.h", old, new)
                self.assert_found("has other types than keel_box_")

    def test_a_harness_must_compare(self) -> None:
        cases = {
            ("model_box_put(", "model_box_fill("): "no harness of it calls model_box_put",
            ("status == model", "status != model"): "the results are not asserted to be the same",
            ("(more > 0u) && box_same(&box, &model, x)", "true"): "box: are not asserted",
            ("&& box_same", "|| box_same"): "box: are not asserted",
            ("box_same(&box, &model, x)", "box_same(&box, &box, x)"): "box: are not asserted",
            ("box_same(&box", "lid_same(&box"): "lid_same does not compare two keel_box_t",
            ("put(&model", "put(&box"): "both are given one object",
            ("put(&model, more", "put(&model, 1u"): "the model is given 1u, the function more",
        }
        for (old, new), why in cases.items():
            with self.subTest(new):
                self.change("put_harness.c", old, new)
                self.assert_found(why)

    def test_a_claim_must_be_made_in_every_execution(self) -> None:
        tail = PUT.partition("    __CPROVER_assert(status")[2]
        asserted = "    __CPROVER_assert(status" + tail.removesuffix("}\n")
        for head in ("if (status == 0) {", "while (more > 0u) {"):
            with self.subTest(head):
                self.change("put_harness.c", asserted, f"    {head}\n{asserted}    }}\n")
                self.assert_found("model_box_put(&model, more) is not called in every execution")
        self.change("put_harness.c", "    int32_t status;", "    int32_t status;\n    return;")
        self.assert_found("returns early")
        for jump in ("goto end;", "continue;", "break;"):
            with self.subTest(jump):
                line = f"    int32_t status;\n    if (more > 9u) {{\n        {jump}\n    }}"
                self.change("put_harness.c", "    int32_t status;", line)
                self.assert_found("a harness that jumps may pass its assertions by")

    def test_a_loop_over_numbers_is_listed(self) -> None:
        self.change(
            "angle_harness.c",
            "    const float expected",
            "    for (uint32_t i = 0u; i < 3u; i++) {\n    const float expected",
        )
        path = self.root / "proofs/box/keel_box_angle_harness.c"
        path.write_text(path.read_text().rstrip()[:-1] + "    }\n}\n", encoding="utf-8")
        self.assertEqual(
            self.outcome("keel_box_angle").harnesses,
            {"keel_box_angle_harness": ["for (uint32_t i = 0u; i < 3u; i++)"]},
        )

    def test_claims_come_after_the_calls_and_nothing_between(self) -> None:
        claim = PUT[PUT.index("    __CPROVER_assert((more") : -len("}\n")]
        self.change("put_harness.c", claim, "")
        text = (self.root / "proofs/box/keel_box_put_harness.c").read_text(encoding="utf-8")
        early = text.replace("    status = keel", f"{claim}    status = keel")
        self.write("proofs/box/keel_box_put_harness.c", early)
        self.assert_found("box: are not asserted")
        for line in ("model = box;", "box.count = 0u;", "model.side[0] = box.side[0];"):
            with self.subTest(line):
                self.change("put_harness.c", claim, f"    {line}\n{claim}")
                self.assert_found("is written between the calls and the assertion")
        self.change(
            "put_harness.c", "    __CPROVER_assert(st", "    status = 0;\n    __CPROVER_assert(st"
        )
        self.assert_found("status is written between")

    def test_nothing_is_written_behind_its_back(self) -> None:
        claim = PUT[PUT.index("    __CPROVER_assert((more") : -len("}\n")]
        for name, function, line in (
            ("a parameter", "settle(keel_box_t *a)\n{\n    a->count = 0u;", "settle(&box);"),
            (
                "a cast",
                "settle(const keel_box_t *a)\n{\n    *(keel_box_t *)a = 0;",
                "settle(&box);",
            ),
            ("what is kept", "settle(void)\n{\n    kept->count = 0u;", "settle();"),
            (
                "what is set anew",
                "settle(const keel_box_t *a, keel_box_t *b)\n{\n    b = kept;\n    b->count = 0u;",
                "settle(&box, &other);",
            ),
            (
                "one further on",
                "other(void)\n{\n    *kept = 0;\n}\n\nvoid s(void)\n{\n    other();",
                "s();",
            ),
            ("what has no body", "other(void)\n{\n    ;", "settle();"),
            ("a pointer", "other(void)\n{\n    ;", "kept->count = 0u;"),
            ("a pointer of its own", "other(void)\n{\n    ;", "*at = model;"),
            ("a copy", "other(void)\n{\n    ;", "memcpy(&box, &model, sizeof(box));"),
            ("a copy by a pointer", "other(void)\n{\n    ;", "memcpy(at, &model, sizeof(box));"),
            ("another of its name", "other(void)\n{\n    ;", "{ static keel_box_t box, model; }"),
        ):
            text = PUT.replace("void keel_box", f"static void {function}\n}}\n\nvoid keel_box")
            with self.subTest(name):
                self.write("proofs/box/keel_box_put_harness.c", text)
                self.assertEqual(self.problems(), [])
                changed = text.replace(claim, f"    {line}\n{claim}")
                self.write("proofs/box/keel_box_put_harness.c", changed)
                self.assert_found("box is written between the calls and the assertion")

    def test_what_reads_may_be_called_between(self) -> None:
        function = (
            "static uint32_t asked;\n\nstatic bool full(const keel_box_t *a)\n{\n"
            "    uint32_t sum[2] = {0u};\n\n    asked++;\n    sum[0] = a->count;\n"
            "    return sum[0] != 0u;\n}\n\n"
        )
        text = PUT.replace("void keel_box", f"{function}void keel_box").replace(
            "    __CPROVER_assert(status", "    (void)full(&box);\n    __CPROVER_assert(status"
        )
        self.write("proofs/box/keel_box_put_harness.c", text)
        self.assertEqual(self.problems(), [])

    def test_the_model_has_an_object_of_its_own(self) -> None:
        for declared, given in (
            ("keel_box_t *other = &box;", "other"),
            ("keel_box_t *other = &box;", "&*other"),
            ("keel_box_t *other[1] = {&box};", "other[0]"),
        ):
            text = PUT.replace("    int32_t status;", f"    {declared}\n    int32_t status;")
            text = text.replace("model_box_put(&model,", f"model_box_put({given},")
            with self.subTest(given):
                self.write("proofs/box/keel_box_put_harness.c", text)
                self.assert_found(f"&box and {given} may be one object")

    def test_both_calls_start_from_the_same(self) -> None:
        for line in ("model.count = 9u - model.count;", "box.count = 0u;", "set(&model);"):
            text = PUT.replace("    __CPROVER_assume(", f"    {line}\n    __CPROVER_assume(")
            set_ = "static void set(keel_box_t *a)\n{\n    a->count = 1u;\n}\n\nvoid keel_box"
            with self.subTest(line):
                self.write("proofs/box/keel_box_put_harness.c", text.replace("void keel_box", set_))
                self.assert_found("box: box or model is written after one was made of the other")
        text = ANGLE.replace(
            "box = nondet_box();", "box = nondet_box();\n    keel_box_t old = box;"
        )
        text = text.replace("angle(&box), e", "angle(&old), e")
        self.write("proofs/box/keel_box_angle_harness.c", text)
        self.write("proofs/box/keel_box_put_harness.c", PUT)
        self.assertEqual(self.problems(), [])
        for place in ("    const float", "    __CPROVER_assert"):
            changed = text.replace(place, f"    old.count = 1u;\n{place}")
            self.write("proofs/box/keel_box_angle_harness.c", changed)
            self.assert_found("box or old is written after one was made of the other")

    def test_both_calls_are_given_the_same(self) -> None:
        for line in ("more = 1u - more;", "set(&more);", "*at = 1u;"):
            text = PUT.replace(
                "    __CPROVER_assert(status", f"    {line}\n    __CPROVER_assert(status"
            )
            declared = "static void set(uint32_t *a)\n{\n    *a = 1u;\n}\n\nvoid keel_box"
            with self.subTest(line):
                self.write(
                    "proofs/box/keel_box_put_harness.c", text.replace("void keel_box", declared)
                )
                self.assert_found("more: more is written between the calls")
        given = PUT.replace("keel_box_put(&box, more)", "keel_box_put(&box, box.count)")
        self.write(
            "proofs/box/keel_box_put_harness.c",
            given.replace("model_box_put(&model, more)", "model_box_put(&model, box.count)"),
        )
        self.assert_found("more: box is written between the calls")

    def test_floats_are_compared_bit_for_bit(self) -> None:
        self.change(
            "angle_harness.c",
            "float_same(keel_box_angle(&box), expected)",
            "keel_box_angle(&box) == expected",
        )
        self.assert_found("the results are not asserted")

    def test_an_index_must_be_any_of_the_array(self) -> None:
        claim = PUT[PUT.index("    __CPROVER_assert((more") : -len("}\n")]
        within = claim.replace(", x)", ", i)").strip()
        loop = "    for (uint32_t i = 0u; i < BOX_SIDES; i++) {\n        %s\n    }\n"
        cases = {
            claim: "",
            claim.replace(", x)", ", more)"): "box_same: more is not arbitrary",
            claim.replace(", x)", ", 0u)"): "box_same: 0u is not arbitrary",
            claim.replace(", x)", ")"): "box_same is given 0 indices, not 1",
            loop % within: "",
            loop.replace("BOX_SIDES", "2u") % within: "",  # as the harness defines it
            loop.replace("BOX_SIDES", "1u") % within: "i is below 1u, and an array has BOX_SIDES",
            loop.replace("i = 0u", "i = 1u") % within: "does more than assert at every index",
            loop.replace("i++", "i += 2u") % within: "does more than assert at every index",
            loop % f"i++; {within}": "does more than assert at every index",
            loop % f"break; {within}": "does more than assert at every index",
            loop % f"{within} model = box;": "does more than assert at every index",
            loop % f"if (more > 7u) {{ {within} }}": "box: are not asserted to be the same",
        }
        for text, why in cases.items():
            with self.subTest(text):
                self.change("put_harness.c", claim, text)
                if why:
                    self.assert_found(why)
                else:
                    self.assertEqual(self.problems(), [])
        for old, new in (
            ("any_below(SIDES)", "any_below(1u)"),
            ("any_below(SIDES)", "3u"),
            ("int32_t status;", "int32_t status;\n\n    x = 0u;"),
        ):
            with self.subTest(new):
                self.change("put_harness.c", old, new)
                self.assertNotEqual(self.problems(), [])
        self.change("same_box.h", "uint32_t i)", "uint8_t i)")
        self.assert_found("box_same: an index is a uint32_t")

    def test_a_contract_of_stand_ins_counts_as_what_it_says(self) -> None:
        does = """
static bool keel_box_put_does(const keel_box_t *is, const keel_box_t *was, int32_t a, int32_t b,
                              uint32_t x)
{
    return box_same(is, was, x) && (a == b);
}
"""
        good = "keel_box_put_does(&box, &model, status, expected, x)"
        head, _, tail = PUT.partition("    __CPROVER_assert(status")
        call = "    const int32_t expected = model_box_put(&model, more);\n"
        for text, claim, found in (
            (does, good, False),
            (does.replace("&&", "||"), good, True),
            (does.replace("(a == b)", "(a == a)"), good, True),
            (does.replace("    return", "    a = b;\n    return"), good, True),
            (does, good.replace("&model", "&box"), True),
            (does, f"(more > 3u) || {good}", True),
        ):
            with self.subTest(text=text, claim=claim):
                self.write("proofs/common/same_box.h", SAME + text)
                body = f'{head}{call}    __CPROVER_assert({claim}, "x");\n}}\n'
                self.write("proofs/box/keel_box_put_harness.c", body)
                self.assertEqual(bool(self.problems()), found, self.problems())


class Sameness(DeterminedTest):
    def test_a_field_left_out_is_named(self) -> None:
        cases = {
            ("(a->count == b->count) && ", ""): "box_same: keel_box_t.count is not compared",
            (" && (a->name == b->name)", ""): "lid_same: keel_lid_t.name is not compared",
            (" && lid_same(&a->lid, &b->lid)", ""): "keel_box_t.lid is not compared by a function",
            ("&& lid_same", "&& any_same"): "keel_box_t.lid is not compared by a function",
            (
                "float_same(a->angle, b->angle)",
                "(a->angle == b->angle)",
            ): "keel_lid_t.angle is not compared by float_same",
            (
                "(a->side[i] == b->side[i])",
                "(a->side[0] == b->side[0])",
            ): "keel_box_t.side is not compared at all of its BOX_SIDES places",
            (
                "lid_same(&a->lid, &b->lid)",
                "float_same(a->lid.angle, b->lid.angle)",
            ): "keel_box_t.lid is not compared by a function",
        }
        for (old, new), why in cases.items():
            with self.subTest(new):
                self.change("same_box.h", old, new)
                self.assert_found(why)

    def test_what_compares_nothing_is_refused(self) -> None:
        cases = {
            ("a->count == b->count", "a->count == a->count"),
            ("a->count == b->count", "a->count >= b->count"),
            ("a->count == b->count", "a->count == b->lid.angle"),
            ("a->count == b->count", "true"),
            ("(&a->lid, &b->lid)", "(&a->lid, &a->lid)"),
            ("b->side[i]", "b->side[x]"),
            ("&& (a->side", "|| (a->side"),
            ("a->side[i] == b->side[i]", "a->side[i + 0u] == b->side[i + 0u]"),
            ("lid_same(&a->lid, &b->lid)", "lid_alike(&a->lid, &b->lid)"),
            ("lid_same(&a->lid, &b->lid)", "(more ? lid_same(&a->lid, &b->lid) : true)"),
        }
        for old, new in cases:
            with self.subTest(new):
                self.change("same_box.h", old, new)
                self.assert_found("compares nothing of the two")

    def test_a_comparer_is_one_expression(self) -> None:
        cases = {
            "    if (b->count > 9u) {\n        return true;\n    }\n    return (a->count": "an if",
            "    __CPROVER_assume(a->count == b->count);\n    return (a->count": "an assumption",
            "    const keel_box_t *const c = a;\n    return (c->count": "a copy",
            "    for (i = 0u; i < SIDES; i++) {\n    }\n    return (a->count": "a loop",
            "    return true;\n    return (a->count": "a return before it",
            "    i = 0u;\n    return (a->count": "an index changed",
            "#ifdef NO\n    return (a->count": "a directive",
        }
        for text, what in cases.items():
            with self.subTest(what):
                end = "\n#else\n    return true;\n#endif\n}" if "#" in text else "\n}"
                self.change("same_box.h", "    return (a->count", text)
                path = self.root / "proofs/common/same_box.h"
                head, _, tail = path.read_text(encoding="utf-8").rpartition("\n}")
                path.write_text(head + end + tail, encoding="utf-8")
                self.assert_found("box_same is not one expression")

    def test_no_name_in_a_comparer_is_a_macro(self) -> None:
        for line, name in (
            ("#define float_same(a, b) true", "float_same"),
            ("#define lid_same(a, b) (1 == 1)", "lid_same"),
            ("#define count lid.angle", "count"),
            ("#define b a", "b"),
        ):
            with self.subTest(line):
                self.change("put_harness.c", "#include", f"{line}\n#include")
                self.assert_found(f"{name} is a macro")
        with self.subTest("defined on the command line"), self.assertRaises(ProjectError):
            self.change("put_harness.c", "-DBOX_SIDES=2u", "-DBOX_SIDES=2u -Dlid_same(a,b)=true")
            self.problems()

    def test_floats_are_compared_by_the_one_function_for_them(self) -> None:
        for old, new in (
            ("__CPROVER_equal(a, b)", "true"),
            ("__CPROVER_equal(a, b)", "a == b"),
            ("__CPROVER_equal(a, b)", "__CPROVER_equal(a, a)"),
        ):
            with self.subTest(new):
                self.change("same_box.h", old, new)
                self.assert_found("float_same is not that of")

    def test_a_comparer_is_defined_once(self) -> None:
        self.write(
            "proofs/common/same_box.h",
            SAME
            + """
#ifdef BOX_SIDES
static bool lid_same(const keel_lid_t *a, const keel_lid_t *b)
{
    return a->name == b->name;
}
#endif
""",
        )
        self.assert_found("lid_same is defined more than once")

    def test_an_array_may_be_compared_at_each_place_by_number(self) -> None:
        sides = " && ".join(f"(a->side[{i}u] == b->side[{i}u])" for i in range(2))
        self.change("same_box.h", "(a->side[i] == b->side[i])", sides)
        self.assertEqual(self.problems(), [])
        self.change("same_box.h", "(a->side[i] == b->side[i])", sides.replace("1u", "0u"))
        self.assert_found("keel_box_t.side is not compared at all of its BOX_SIDES places")

    def test_a_part_may_be_compared_by_another_function(self) -> None:
        part = SAME.replace("(a->count == b->count) && ", "part_same(a, b) && ").replace(
            "static bool box",
            "static bool part_same(const keel_box_t *x, const keel_box_t *y)\n{\n"
            "    return x->count == y->count;\n}\n\nstatic bool box",
        )
        self.write("proofs/common/same_box.h", part)
        self.assertEqual(self.problems(), [])
        for old, new in (
            ("x->count == y", "x->count <= y"),
            ("part_same(a, b)", "part_same(a, a)"),
            ("return x->c", "return true || x->c"),
        ):
            with self.subTest(new):
                self.write("proofs/common/same_box.h", part.replace(old, new))
                self.assertNotEqual(self.problems(), [])

    def test_a_structure_may_be_compared_field_by_field(self) -> None:
        fields = "float_same(a->lid.angle, b->lid.angle) && (a->lid.name == b->lid.name)"
        self.change("same_box.h", "lid_same(&a->lid, &b->lid)", fields)
        self.assertEqual(self.problems(), [])

    def test_a_new_field_must_be_compared(self) -> None:
        self.change("rtos/box.h", "    keel_lid_t lid;\n", "    keel_lid_t lid;\n    bool shut;\n")
        self.assert_found("box_same: keel_box_t.shut is not compared")

    def test_what_cannot_be_read_is_an_error(self) -> None:
        for field in ("uint8_t a : 3;", "int a[2][3];", "int a, b;", "struct { int x; } y;"):
            with self.subTest(field), self.assertRaises(ProjectError):
                self.change("rtos/box.h", "    uint32_t count;", f"    {field}")
                self.problems()


class Extent(DeterminedTest):
    """For which states a harness shows what it shows."""

    FREE = (
        PUT.replace("// defines: -DBOX_SIDES=2u\n", "")
        .replace("    __CPROVER_assume(more > 0u);\n\n", "")
        .replace("any_bits(8u)", "nondet_u32()")
    )

    def put(self, *changes: tuple[str, str], name: str = "keel_box_put_harness") -> None:
        """A harness that narrows nothing, but for changes."""
        text = self.FREE.replace("keel_box_put_harness", name)
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write(f"proofs/box/{name}.c", text)

    def bounds(self) -> list[str]:
        return self.outcome().harnesses.get("keel_box_put_harness", ["it is not listed"])

    def test_what_narrows_nothing_is_for_every_valid_state(self) -> None:
        self.put()
        self.assertEqual((self.outcome().extent, self.bounds()), ("every valid state", []))

    def test_what_narrows_in_the_harness_is_a_bound(self) -> None:
        start = "    const uint32_t more = nondet_u32();"
        for line, bound in (
            ("    const uint32_t more = any_bits(31u);", "any_bits(31u)"),
            ("    const uint32_t more = any_below(16u);", "any_below(16u)"),
            ("    const uint32_t more = nondet_u32() % 16u;", "nondet_u32() % 16u"),
            ("    const uint32_t more = nondet_u32() & 15u;", "nondet_u32() & 15u"),
            (
                "    const uint32_t more = nondet_bool() ? 1u : MANY;",
                "more = nondet_bool() ? 1u : 7",
            ),
            (f"{start}\n    __CPROVER_assume((more < MANY) && f(more));", "more < 7"),
            (f"{start}\n    uint8_t room[4];\n\n    fill(room, more);", ""),
        ):
            with self.subTest(line):
                self.put((start, line), ("#include", "#define MANY 7u\n#include"))
                found = self.bounds()
                self.assertEqual(bound in found, bool(bound), found)

    def test_a_part_that_is_set_is_a_bound(self) -> None:
        self.put(("    keel_box_t model", "    box.count = 3u;\n    keel_box_t model"))
        self.assertEqual(self.bounds(), ["box.count = 3u"])

    def test_what_narrows_in_a_helper_is_a_bound(self) -> None:
        helper = (
            "static uint32_t any_more(void)\n{\n    const uint32_t m = nondet_u32();\n\n"
            "%s\n    return m;\n}\n"
        )
        other = "static int any_other(void)\n{\n    __CPROVER_assume(deep == 1);\n}\n"
        plain = "nondet_u32();\n    const uint32_t x"
        for line, bound in (
            ("    __CPROVER_assume(m < MANY);", "m < 9 in any_more"),
            ("    lid.name = NULL;", "lid.name = NULL in any_more"),
            ("    f(any_bits(9u));", "any_bits(9u) in any_more"),
            ("    f(any_other());", "deep == 1 in any_other"),
        ):
            with self.subTest(line):
                text = f"{SAME}#define MANY 9u\n{other}{helper % line}"
                self.write("proofs/common/same_box.h", text)
                self.put((plain, plain.replace("nondet_u32", "any_more")))
                self.assertEqual(self.bounds(), [bound])

    def test_one_of_two_constants_that_a_helper_gives_is_a_bound(self) -> None:
        helper = "static uint32_t any_more(void)\n{\n    return nondet_bool() ? 1u : MANY;\n}\n"
        self.write("proofs/common/same_box.h", f"{SAME}#define MANY 9u\n{helper}")
        plain = "nondet_u32();\n    const uint32_t x"
        self.put((plain, plain.replace("nondet_u32", "any_more")))
        self.assertEqual(self.bounds(), ["return nondet_bool() ? 1u : 9 in any_more"])

    def test_a_stand_in_is_looked_into_and_must_be_shown_to_keep_its_contract(self) -> None:
        self.write(
            "proofs/common/same_box.h",
            SAME
            + """
float keel_box_angle_stand_in(const keel_box_t *box)
{
    __CPROVER_assume(box->count < 3u);
    __CPROVER_assume(keel_box_angle_does(box));
    return nondet_float();
}
""",
        )
        self.put(("// covers", "// replaces: keel_box_angle\n// covers"))
        self.assertEqual(
            self.bounds(),
            [
                "box->count < 3u in keel_box_angle_stand_in",
                "keel_box_angle by its contract, shown within nothing: no harness asserts"
                " keel_box_angle_does",
            ],
        )

    def test_a_precondition_narrows_nothing(self) -> None:
        valid = "keel_box_put_may(&box, more) && box_valid_here(&box)"
        assumed = f"int32_t status;\n\n    __CPROVER_assume({valid}"
        self.put(("int32_t status;", f"{assumed});"))
        self.assertEqual(self.bounds(), [])
        self.put(("int32_t status;", f"{assumed} && (more < 3u));"))
        self.assertEqual(self.bounds(), ["more < 3u"])
        for sign in ("&", "=="):
            one = f"keel_box_put_may(&box, more) {sign} (more < 3u)"
            self.put(("int32_t status;", f"int32_t status;\n\n    __CPROVER_assume({one});"))
            self.assertEqual(self.bounds(), [one])
        self.put(("int32_t status;", f"{assumed} && (more < 3u));"))
        part = '[[part]]\nin = "keel_box_put_harness"\nof = "BOX_001"\ntexts = ["more < 3u"]\n'
        self.write("proofs/preconditions.toml", part)
        self.assertEqual(self.bounds(), [])
        self.put()
        decider = determined.Decider(self.root)
        decider.every()
        self.assertEqual(
            decider.problems(),
            [
                "proofs/preconditions.toml: nothing in"
                " keel_box_put_harness says 'more < 3u' any more, remove it"
            ],
        )

    def test_chosen_points_never_count(self) -> None:
        table = "static const uint32_t points[2] = {1u, 2u};\n\nvoid keel"
        start = "const uint32_t more = nondet_u32();"
        points = {
            "a row of a table": [("void keel", table), (start, "const uint32_t more = points[1];")],
            "constants": [(start, "const uint32_t more = 1u;"), ("nondet_box()", "{0u}")],
            "a constant for all that is read": [(start, "const uint32_t more = 1u;")],
        }
        for what, changes in points.items():
            with self.subTest(what):
                self.put(*changes)
                self.assert_found(
                    "keel_box_put: only harnesses of chosen points compare it with"
                    " the model: keel_box_put_harness"
                )
        with self.subTest("by its name"):
            (self.root / "proofs/box/keel_box_put_harness.c").unlink()
            self.put(name="keel_box_put__points_harness")
            self.assertEqual(self.outcome().points, ["keel_box_put__points_harness"])
            self.assertEqual(len(self.problems()), 1)

    def test_a_harness_of_points_beside_another_is_shown_as_such(self) -> None:
        self.put()
        self.put(name="keel_box_put__edges_harness")
        found = determined.of_tree(self.root)
        self.assertIn(
            "keel_box_put_harness; (keel_box_put__edges_harness: chosen points)",
            determined.as_markdown(found),
        )
        said = "determined: 2 of 2 functions for every valid state"
        self.assertEqual(determined.summary(found), said)


class Kept(DeterminedTest):
    """proofs/determined.md, which shows a narrowing in a review."""

    def setUp(self) -> None:
        super().setUp()
        head = "static bool box_valid_here(const keel_box_t *b)\n"
        self.same = f"{SAME}\n{head}{{\n    return b->count < 99u;\n}}\n"
        self.write("proofs/common/same_box.h", self.same)
        valid = "(more > 0u);\n    __CPROVER_assume(box_valid_here(&box));"
        text = PUT.replace("(more > 0u);", valid)
        self.write("proofs/box/keel_box_put_harness.c", text)
        self.assertTrue(determined.update_kept(self.root))

    def differences(self, whole: bool = True) -> list[str]:
        decider = determined.Decider(self.root)
        found = decider.every()
        if not whole:
            found = [one for one in found if one.unit != "box"]
        return determined.kept_problems(self.root, decider, found, whole)

    def test_it_is_as_it_was_written(self) -> None:
        self.assertEqual(self.differences(), [])
        self.assertFalse(determined.update_kept(self.root))

    def test_a_narrowing_is_a_difference(self) -> None:
        self.change("put_harness.c", "any_bits(8u)", "any_bits(7u)")
        self.assertIn(
            "proofs/determined.md: keel_box_put is shown otherwise now: review, and run"
            " --update-goals",
            self.differences(),
        )
        self.assertEqual(self.differences(whole=False), [])

    def test_a_precondition_that_says_more_is_a_difference(self) -> None:
        self.write("proofs/common/same_box.h", self.same.replace("< 99u", "< 9u"))
        self.assertEqual(
            self.differences(),
            [
                "proofs/determined.md: proofs/common/same_box.h:"
                " box_valid_here says something else now: review, and run"
                " --update-goals"
            ],
        )

    def test_a_form_that_units_not_looked_at_have_is_no_difference(self) -> None:
        path = self.root / "proofs/determined.md"
        text = path.read_text(encoding="utf-8")
        here = "    return b->count < 99u;\n"
        self.assertEqual(text.count(here), 1)
        decider = determined.Decider(self.root)
        found = decider.every()
        for kept, good in ((f"    return true;\n{here}", True), ("    return true;\n", False)):
            path.write_text(text.replace(here, kept), encoding="utf-8")
            problems = determined.kept_problems(self.root, decider, found, whole=False)
            self.assertEqual(not problems, good, problems)

    def test_what_is_gone_is_a_difference(self) -> None:
        self.write("proofs/box/keel_box_angle_harness.c", "")
        self.assertTrue(any("keel_box_angle is shown" in text for text in self.differences()))
        path = self.root / "proofs/determined.md"
        path.write_text(path.read_text(encoding="utf-8") + "\nmore\n", encoding="utf-8")
        self.write("proofs/box/keel_box_angle_harness.c", ANGLE)
        self.assertEqual(
            self.differences(),
            [
                "proofs/determined.md names what is not there any"
                " more: review, and run --update-goals"
            ],
        )
        path.unlink()
        self.assertEqual(
            self.differences(), ["proofs/determined.md is missing: review, and run --update-goals"]
        )


class SameTerm(DeterminedTest):
    """Models that are the code under other names."""

    CODE = """\
int32_t keel_box_put(keel_box_t *box, uint32_t more)
{
    const uint32_t sum = box->count + more;

    if (sum < more) {
        return -1;
    }
    box->count = sum;
    return 0;
}
"""

    def setUp(self) -> None:
        super().setUp()
        self.write("src/rtos/box.c", self.CODE)
        self.write("specs/model/box.c", self.CODE.replace("keel_", "model_").replace("sum", "all"))

    def said(self) -> list[str]:
        decider = determined.Decider(self.root)
        decider.every()
        return decider.problems()

    def test_one_needs_an_entry_that_says_what_else_would_see_a_slip(self) -> None:
        [problem] = self.said()
        self.assertIn("[box]: its model is its code under other names", problem)
        self.write("proofs/same_term.toml", '[box]\nseen_by = "values by hand"\n')
        self.assertEqual(self.said(), [])
        self.assertTrue(determined.update_kept(self.root))
        kept = (self.root / "proofs/determined.md").read_text(encoding="utf-8")
        self.assertIn(
            "## box\n\nThe model is the same term, under other names; a slip in both is"
            " seen by: values by hand.\n",
            kept,
        )

    def test_another_formulation_needs_none(self) -> None:
        other = "    box->count = (box->count > (UINT32_MAX - more)) ? box->count : 1u + more;\n"
        self.write(
            "specs/model/box.c",
            f"int32_t model_box_put(keel_box_t *box, uint32_t more)\n"
            f"{{\n{other}    return (int32_t)other(box)->last[3];\n}}\n",
        )
        self.assertEqual(self.said(), [])

    def test_an_entry_is_read(self) -> None:
        self.write("proofs/same_term.toml", '[lid]\nseen_by = "x"\n[box]\nseen_by = "y"\n')
        self.assertEqual(self.said(), ["proofs/same_term.toml: there is no unit lid"])
        self.write("proofs/same_term.toml", '[box]\nreason = "x"\n')
        with self.assertRaises(ProjectError):
            self.said()


class ByWp(DeterminedTest):
    def setUp(self) -> None:
        super().setUp()
        self.write("proofs/units.toml", BY_WP)
        self.write("proofs/box/keel_box_put_harness.c", "")

    def write_all(self) -> None:
        super().write_all()
        self.write("proofs/box/keel_box_put_harness.c", "")

    def test_every_field_is_named_by_a_clause(self) -> None:
        outcome = self.outcome()
        self.assertEqual((outcome.by, outcome.reason, outcome.problems), ("wp", "no end", []))
        labels = {
            "count": ["BOX_001"],
            "side": ["BOX_002"],
            "lid.angle": ["BOX_003_lid"],
            "\\result": ["BOX_001"],
        }
        self.assertEqual(outcome.fields, labels)
        self.assertIn("not by equality: no end", determined.as_markdown([outcome]))

    def test_a_field_that_no_clause_names_is_a_failure(self) -> None:
        cases = {
            ("box->count == \\old(box->count) + more", "more > 0"): "count",
            ("box->count ==", "\\at(box->count, Pre) =="): "count",
            ("\\result == 0 && ", ""): "\\result",
            ("BOX_003_lid", "lid"): "lid.angle",
            (
                "ensures BOX_003_lid: box->lid.angle == 0",
                "ensures BOX_003: moved{Pre, Post}(box)",
            ): "lid.angle",
            ("assigns BOX_COUNTS(box), box->lid.angle", "assigns *box"): "lid.name",
            ("\\forall integer i; 0 <= i < 4 ==> box->side[i] == 1", "box_full(box)"): "side",
        }
        for (old, new), name in cases.items():
            with self.subTest(new):
                self.change("rtos/box.h", old, new)
                self.assert_found(
                    f"keel_box_put: no clause of its contract says what becomes of {name}"
                )

    def test_what_cannot_be_read_is_a_failure(self) -> None:
        self.change("rtos/box.h", "assigns BOX_COUNTS(box)", "assigns other->count")
        self.assert_found("what is assigned by other->count?")

    def test_a_choice_is_checked(self) -> None:
        left = 'not_by_wp = [{ function = "keel_box_put", reason = "floats" }]\n'
        cases = {
            BY_WP.replace('"wp"', '"luck"'): "`by` is one of wp, nothing",
            BY_WP.replace("box_put", "box_shut"): "there is no function keel_box_shut",
            BY_WP + left: "WP leaves its postconditions to CBMC",
        }
        for text, why in cases.items():
            with self.subTest(why):
                self.write("proofs/units.toml", text)
                self.assert_found(why)

    def test_a_needless_choice_is_a_failure(self) -> None:
        self.write("proofs/box/keel_box_put_harness.c", PUT)
        self.assertEqual(self.problems(), [])  # the harness narrows
        free = PUT.replace("any_bits(8u)", "nondet_u32()").replace(
            "// defines: -DBOX_SIDES=2u\n", ""
        )
        free = free.replace("    __CPROVER_assume(more > 0u);\n", "")
        self.write("proofs/box/keel_box_put_harness.c", free)
        self.assert_found("determined: keel_box_put is no exception any more")

    def test_nothing_needs_a_reason_and_is_shown(self) -> None:
        self.write("proofs/units.toml", BY_WP.replace('"wp"', '"nothing"'))
        self.assertEqual(self.problems(), [])
        found = determined.of_tree(self.root)
        self.assertIn(
            "determined: 1 of 2 functions for every valid state, 1 excepted",
            determined.summary(found),
        )


class Parsing(unittest.TestCase):
    def test_a_clause_ends_behind_its_quantifiers(self) -> None:
        text = "\\forall integer i; (\\exists integer j; i < j); requires x;"
        self.assertEqual(clauses.statement(text), text.removesuffix("; requires x;"))

    def test_the_state_before_does_not_count(self) -> None:
        self.assertEqual(
            clauses.after("a == \\old(b(c)) + \\at(d, Post)").split(), ["a", "==", "+", "(d)"]
        )

    def test_signatures(self) -> None:
        text = (
            "static inline const char *f(const int *a, unsigned n, const float v[], int *const p);"
        )
        found = declarations.signatures(text)["f"]
        self.assertEqual(
            found.types, ("const char *", "const int *", "unsigned", "const float *", "int *")
        )
        self.assertEqual([one.written for one in found.parameters], [False, False, False, True])

    def test_what_stands_around_declarations_belongs_to_none(self) -> None:
        text = "KEEL_C_BEGIN\n\nint first(void);\n\nKEEL_C_END\nint second(void);\n"
        found = declarations.signatures(text)
        self.assertEqual([found[name].types for name in ("first", "second")], [("int",)] * 2)


class Report(WholeRunCase):
    def test_open_functions_are_shown_and_do_not_fail(self) -> None:
        status, output, report = self.prove()
        self.assertEqual(status, 0, output)
        self.assertIn("1 open: their units have no model", output)
        [entry] = report["units"]["box"]["determined"]
        self.assertEqual((entry["function"], entry["by"]), ("keel_box_put", "open"))
        table = (self.root / "build/prove/determined.md").read_text(encoding="utf-8")
        self.assertIn("| keel_box_put | open |", table)

    def test_what_nothing_determines_fails_where_there_is_a_model(self) -> None:
        model = self.root / "specs/model/box.h"
        model.parent.mkdir(parents=True)
        model.write_text("void model_box_put(int *box, int value);\n", encoding="utf-8")
        status, _, report = self.prove()
        self.assertEqual(status, 1)
        self.assertIn("keel_box_put: no harness of it calls model_box_put", report["problems"])
        self.assertIn(
            "- keel_box_put: no harness",
            (self.root / "build/prove/determined.md").read_text(encoding="utf-8"),
        )
