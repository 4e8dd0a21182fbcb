# SPDX-License-Identifier: Apache-2.0
"""Tests of what keeps a gap between two engines from going unnoticed.

What WP leaves to CBMC is named and asserted; assertions are fixed; nothing defined stands unused;
what changes in a refusal is listed. No prover is run.
"""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path
from typing import Any

from keel.audit import assertions, completeness, unused
from keel.c.project import Unit, find_units
from keel.judge import wp_frames, wp_targets
from keel.judge.settings import Exceptions
from keel.lint import refusals

ROOT = Path(__file__).resolve().parents[2]

HEADER = """\
#ifndef BOX_H
#define BOX_H
#define BOX_LIMIT 7
/*@ predicate box_small(int x) = x < BOX_LIMIT;
  @ logic integer box_twice(integer x) = x + x;
  @*/
/*@ requires \\valid(box);
  @ requires put_small: box_small(value);
  @ assigns *box;
  @ ensures BOX_001: *box == value;
  @*/
keel_status_t keel_box_put(int *box, int value);
/*@ assigns *box;
  @ ensures BOX_002: *box == box_twice(3);
  @*/
void keel_box_fill(int *box);
#endif
"""
SOURCE = """\
#include "keel/rtos/box.h"

/*@ requires \\valid(box);
  @ assigns *box;
  @*/
static void helper(int *box)
{
    /*@ loop invariant stays: *box == 3;
      @ loop assigns \\nothing;
      @ loop variant 1;
      @*/
    while (*box > 3) {
    }
}

keel_status_t keel_box_put(int *box, int value)
{
    *box = value;
    return KEEL_OK;
}

void keel_box_fill(int *box)
{
    helper(box);
    (void)keel_box_put(box, 6);
}
"""
HARNESS = """\
// replaces: keel_box_put
// covers: keel_box_fill helper
void keel_box_fill_harness(void)
{
    keel_box_fill(&box);
    __CPROVER_assert(box == 3, "stays: it does");
}
"""


class Tree(unittest.TestCase):
    """A test with a project of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        self.write("include/keel/rtos/box.h", HEADER)
        self.write("src/rtos/box.c", SOURCE)
        self.write("proofs/box/keel_box_fill_harness.c", HARNESS)

    def write(self, name: str, text: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    @property
    def unit(self) -> Unit:
        return find_units(self.root)["box"]


class Frames(Tree):
    left = {"keel_box_fill": "floats", "helper": "floats"}

    def problems(self, *entries: str, left: dict[str, str] | None = None) -> list[str]:
        exceptions = Exceptions(
            not_by_wp=self.left if left is None else left, by_cbmc=dict.fromkeys(entries, "why")
        )
        return wp_frames.problems(self.unit, exceptions, [self.unit])

    def test_all_but_postconditions_and_what_is_named_stays_with_wp(self) -> None:
        entry = "keel_box_fill put_small keel_box_fill_harness"
        exceptions = Exceptions(not_by_wp=self.left, by_cbmc={entry: "why"})
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_fill")
        found = wp_frames.restricted(target, exceptions).selection
        self.assertEqual(found[:2], ["-wp-fct", "keel_box_fill"])
        self.assertEqual(found[2:], ["-wp-prop=-@ensures,-put_small", *wp_frames.NO_FLOATS])

    def test_other_functions_stay_whole(self) -> None:
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_put")
        self.assertEqual(
            wp_frames.restricted(target, Exceptions()).selection, ["-wp-fct", "keel_box_put"]
        )

    def test_a_precondition_that_a_stand_in_asserts_is_fine(self) -> None:
        self.assertEqual(self.problems("keel_box_fill put_small keel_box_fill_harness"), [])

    def test_an_invariant_that_a_harness_asserts_is_fine(self) -> None:
        self.assertEqual(self.problems("helper stays keel_box_fill_harness"), [])

    def complaint(self, entry: str, text: str, left: dict[str, str] | None = None) -> None:
        [problem] = self.problems(entry, left=left)
        self.assertIn(text, problem)

    def test_a_precondition_that_nobody_asserts_is_a_failure(self) -> None:
        self.write("proofs/box/keel_box_fill_harness.c", HARNESS.replace("// replaces", "// note"))
        self.complaint("keel_box_fill put_small keel_box_fill_harness", "does not replace")

    def test_an_invariant_that_nobody_asserts_is_a_failure(self) -> None:
        self.write("proofs/box/keel_box_fill_harness.c", HARNESS.replace("stays:", "it stays:"))
        self.complaint("helper stays keel_box_fill_harness", "has no assertion stays")

    def test_a_label_of_nothing_is_a_failure(self) -> None:
        entry = "keel_box_fill put_large keel_box_fill_harness"
        self.complaint(entry, "is no precondition of what keel_box_fill calls")

    def test_a_harness_that_is_not_there_or_covers_less_is_a_failure(self) -> None:
        self.complaint("keel_box_fill put_small keel_box_harness", "there is no harness")
        self.write("proofs/box/keel_box_fill_harness.c", HARNESS.replace(" helper\n", "\n"))
        self.complaint("helper stays keel_box_fill_harness", "does not cover helper")

    def test_only_what_wp_leaves_may_leave_a_clause(self) -> None:
        entry = "keel_box_fill put_small keel_box_fill_harness"
        self.complaint(entry, "only what not_by_wp names", left={})

    def test_a_label_that_wp_leaves_stands_for_one_clause(self) -> None:
        entries = ["helper stays keel_box_fill_harness", "keel_box_fill put_small x_harness"]
        self.assertEqual(completeness.left_twice(self.unit, entries), [])
        again = SOURCE.replace(
            "    while (*box > 3)", "    //@ assert stays: *box < 9;\n    while (*box > 3)"
        )
        self.write("src/rtos/box.c", again)
        [problem] = completeness.left_twice(self.unit, entries)
        self.assertIn("helper, stays: stands for more than", problem)
        shared = HEADER.replace(
            "ensures BOX_002:", "requires put_small: \\true;\n  @ ensures BOX_002:"
        )
        self.write("include/keel/rtos/box.h", shared)
        self.write("src/rtos/box.c", SOURCE)
        [problem] = completeness.left_twice(self.unit, entries)
        self.assertIn("keel_box_fill, put_small: stands for more than", problem)

    def test_a_ghost_function_has_its_contract_to_itself(self) -> None:
        ghost = (
            "/*@ ghost\n/@ requires told: \\true;\n @ ensures \\true;\n @/\n"
            "static void tell(int *box)\n{\n}\n*/\n\n"
        )
        self.write("src/rtos/box.c", SOURCE.replace("/*@ requires", ghost + "/*@ requires"))
        self.assertEqual(self.problems(), [])
        self.assertEqual(wp_frames.preconditions([self.unit])["told"], "tell")

    def test_a_postcondition_that_no_engine_proves_is_a_failure(self) -> None:
        stated = "  @ assigns *box;\n  @ ensures *box == 3;\n  @*/\nstatic"
        self.write("src/rtos/box.c", SOURCE.replace("  @ assigns *box;\n  @*/\nstatic", stated))
        [problem] = self.problems()
        self.assertIn("helper: WP leaves its postcondition", problem)


class Assertions(Tree):
    def harnesses(self, *texts: str) -> dict[str, Any]:
        entries = [{"name": "x", "description": text, "status": "SUCCESS"} for text in texts]
        return {"h_harness": {"assertions": entries}}

    def test_equal_lists_are_fine(self) -> None:
        self.assertTrue(assertions.update(self.unit, self.harnesses("B_001: b", "A_001: a")))
        path = assertions.list_of(self.unit)
        self.assertEqual(path.read_text(), "h_harness A_001: a\nh_harness B_001: b\n")
        self.assertEqual(assertions.problems(self.unit, self.harnesses("A_001: a", "B_001: b")), [])

    def test_a_vanished_assertion_is_a_failure(self) -> None:
        assertions.update(self.unit, self.harnesses("A_001: a", "A_001: a"))
        [problem] = assertions.problems(self.unit, self.harnesses("A_001: a"))
        self.assertIn("h_harness A_001: a: is listed, but no harness", problem)

    def test_a_vanished_harness_is_a_failure(self) -> None:
        assertions.update(self.unit, self.harnesses("A_001: a"))
        self.assertEqual(len(assertions.problems(self.unit, {})), 1)

    def test_a_new_assertion_must_be_reviewed(self) -> None:
        assertions.update(self.unit, self.harnesses("A_001: a"))
        [problem] = assertions.problems(self.unit, self.harnesses("A_001: a", "A_002: b"))
        self.assertIn("is a new assertion", problem)

    def test_a_list_that_is_missing_is_a_failure(self) -> None:
        [problem] = assertions.problems(self.unit, self.harnesses("A_001: a"))
        self.assertIn("assertions.txt is missing", problem)

    def test_a_run_that_broke_off_accepts_nothing(self) -> None:
        assertions.update(self.unit, self.harnesses("A_001: a"))
        self.assertFalse(assertions.update(self.unit, self.harnesses()))

    def left_open(self, name: str, *texts: str) -> list[str]:
        """What is wrong where WP leaves keel_box_fill to a harness that asserts these."""
        entries = [{"name": "x", "description": text, "status": "SUCCESS"} for text in texts]
        return assertions.left_open(
            self.unit, {"keel_box_fill": "why"}, {name: {"assertions": entries}}
        )

    def test_a_postcondition_that_wp_leaves_needs_an_assertion_of_its_name(self) -> None:
        own = "keel_box_fill_harness"
        self.assertEqual(self.left_open(own, "BOX_002: it holds six"), [])
        for texts in ((), ("BOX_002_six: it holds six",), ("it holds six, BOX_002: so",)):
            [problem] = self.left_open(own, *texts)
            self.assertIn("keel_box_fill: WP leaves BOX_002 to CBMC", problem)

    def test_an_assertion_of_a_harness_that_does_not_cover_the_function_is_none(self) -> None:
        [problem] = self.left_open("keel_box_put_harness", "BOX_002: it holds six")
        self.assertIn("no harness that covers the function", problem)

    def test_a_postcondition_that_wp_leaves_needs_a_label(self) -> None:
        self.write("include/keel/rtos/box.h", HEADER.replace("ensures BOX_002: ", "ensures "))
        [problem] = self.left_open("keel_box_fill_harness", "BOX_002: it holds six")
        self.assertIn("without a label", problem)


class Unused(Tree):
    def test_what_is_used_is_fine(self) -> None:
        self.assertEqual(unused.problems(self.root), [])

    def test_what_nothing_uses_is_named_with_its_place(self) -> None:
        self.write("include/keel/rtos/box.h", HEADER.replace("box_small(value)", "value < 7"))
        first, *_ = unused.problems(self.root)
        self.assertIn("include/keel/rtos/box.h:4: box_small is used by no contract", first)

    def test_a_use_by_what_is_unused_itself_does_not_count(self) -> None:
        text = HEADER.replace("box_small(value)", "value < BOX_LIMIT")
        tiny = "  @ predicate box_tiny(int x) = box_small(x) && box_tiny(x);\n"
        more = tiny + "  @*/\n/*@ requires \\v"
        self.write("include/keel/rtos/box.h", text.replace("  @*/\n/*@ requires \\v", more))
        names = [problem.split()[1] for problem in unused.problems(self.root)]
        self.assertEqual(names, ["box_small", "box_tiny"])

    def test_ghost_code_and_the_header_of_the_state_count(self) -> None:
        state = "/*@ predicate box_kept(int x) = x == BOX_LIMIT;\n  @*/\n"
        self.write("include/keel/rtos/box_state.h", state)
        [problem] = unused.problems(self.root)
        self.assertIn("box_state.h:1: box_kept is used by no contract", problem)
        ghost = "/*@ ghost\n/@ requires box_kept(n);\n @/\nstatic void tell(int n)\n{\n}\n*/\n"
        self.write("src/rtos/box.c", SOURCE + ghost)
        self.assertEqual(unused.problems(self.root), [])

    def test_a_mention_in_a_comment_is_no_use(self) -> None:
        text = HEADER.replace("box_twice(3)", "6; // box_twice(3)\n  @ //")
        self.write("include/keel/rtos/box.h", text + "/* box_twice */\n")
        [problem] = unused.problems(self.root)
        self.assertIn("box_twice", problem)

    def test_a_macro_that_nothing_uses_is_named(self) -> None:
        self.write("include/keel/rtos/box.h", HEADER.replace("x < BOX_LIMIT", "x < 7"))
        [problem] = unused.problems(self.root)
        self.assertIn("box.h:3: nothing uses the macro BOX_LIMIT", problem)


class Refusals(Tree):
    def setUp(self) -> None:
        super().setUp()
        self.state("")

    def state(self, line: str) -> None:
        self.write("specs/requirements/status.sdoc", f"Nothing changes, except:\n{line}\n")

    def test_a_function_of_which_nothing_is_said_is_a_failure(self) -> None:
        [problem] = refusals.problems(self.root)
        self.assertIn("keel_box_put: nothing says that its refusals change nothing", problem)

    def test_a_behaviour_that_assigns_nothing_says_so(self) -> None:
        behaviour = "  @ behavior b: assigns \\nothing;\n  @ ensures B"
        text = HEADER.replace("  @ ensures BOX_001", behaviour)
        self.write("include/keel/rtos/box.h", text)
        self.assertEqual(refusals.problems(self.root), [])

    def test_an_assertion_in_a_harness_of_its_own_says_so(self) -> None:
        self.write("proofs/box/keel_box_put_all_harness.c", '"STA_001_kept: x"')
        self.assertEqual(len(refusals.problems(self.root)), 1)
        self.write("proofs/box/keel_box_put__all_harness.c", '"STA_001_kept: x"')
        self.assertEqual(refusals.problems(self.root), [])

    def test_an_exception_needs_what_proves_it(self) -> None:
        self.state("- BOX_001 keel_box_put, KEEL_ERR_FULL: it counts")
        self.assertEqual(refusals.problems(self.root), [])
        self.state("- BOX_009_counted keel_box_put, any: it counts")
        [problem] = refusals.problems(self.root)
        self.assertIn("BOX_009_counted is neither in its contract nor asserted", problem)

    def test_an_exception_of_nothing_is_a_failure(self) -> None:
        self.state("- BOX_001 keel_box_fill, any: it counts")
        self.assertIn(
            "STA-001: there is no keel_box_fill that returns a status", refusals.problems(self.root)
        )
