#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of the evidence part `formal`: what is wrong with proofs must be a problem, named.

    python3 tests/tools/test_evidence_formal.py
"""

from __future__ import annotations

import contextlib
import io
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/tools")]

from evidence_proofs import EvidenceTest  # noqa: E402

import review  # noqa: E402
from evidence.formal import bounds, ledger, reviews  # noqa: E402
from evidence.part import Item, Part  # noqa: E402
from evidence.parts import formal  # noqa: E402
from proofs.project import find_units  # noqa: E402

QUEUE_GOAL = "keel_queue_add_ensures_QUE_003_order"


class FormalTest(EvidenceTest):
    """A test with the part."""

    def part(self) -> Part:
        """The part, made from tree and report as they are now."""
        return formal.make(self.context())

    def item(self, kind: str, name: str) -> Item:
        """An item of the part."""
        return next(item for item in self.part().items if (item.kind, item.id) == (kind, name))

    def goal(self, name: str = QUEUE_GOAL) -> dict[str, str]:
        """A goal of the unit queue in the report."""
        goals = self.report["units"]["queue"]["wp"]["goal_list"]
        found: dict[str, str] = next(goal for goal in goals if goal["name"] == name)
        return found


class Goals(FormalTest):
    """Goals, assertions and bounds."""

    def test_all_is_well_with_the_tree_as_it_is(self) -> None:
        self.assertEqual(self.part().problems, ())

    def test_a_goal_says_who_proved_it_and_what_for(self) -> None:
        item = self.item("goal", f"queue/{QUEUE_GOAL}")
        self.assertEqual(item.state, "good")
        self.assertEqual((item.facts["engine"], item.facts["prover"]), ("WP", "CVC4 1.8"))
        self.assertEqual(item.links, ("unit:queue", "requirement:QUE-003"))

    def test_an_assertion_belongs_to_its_harness(self) -> None:
        item = self.item("goal", "queue/keel_queue_add_harness/QUE_003_model")
        self.assertEqual(item.facts["engine"], "CBMC")
        self.assertEqual(item.links, ("harness:queue/keel_queue_add_harness",
                                      "requirement:QUE-003"))  # fmt: skip

    def test_a_goal_that_failed(self) -> None:
        self.goal()["status"] = "Timeout"
        self.assert_problem(self.part(), QUEUE_GOAL, "not proved", "Timeout")
        self.assert_problem(self.part(), "theorem queue", "QUE-003")
        self.assertEqual(self.item("goal", f"queue/{QUEUE_GOAL}").state, "bad")

    def test_an_assertion_that_failed(self) -> None:
        harness = self.report["units"]["queue"]["cbmc"]["harnesses"]["keel_queue_add_harness"]
        harness["assertions"][0]["status"] = "FAILURE"
        self.assert_problem(self.part(), "keel_queue_add_harness", "FAILURE")

    def test_a_goal_that_is_missing(self) -> None:
        goals = self.report["units"]["queue"]["wp"]["goal_list"]
        goals.remove(self.goal())
        self.assert_problem(self.part(), "proofs/queue/goals.txt", QUEUE_GOAL)

    def test_a_unit_that_is_missing(self) -> None:
        del self.report["units"]["clock"]
        self.assert_problem(self.part(), "unit clock", "says nothing")

    def test_a_report_of_another_source_a_partial_and_a_failed_one(self) -> None:
        self.report["made_from"] = {"commit": "other"}
        self.assert_problem(self.part(), "build/prove/report.json", "another source")
        self.report["made_from"] = self.context().stamp
        self.report["partial"] = True
        self.assert_problem(self.part(), "a part of the proofs")
        del self.report["partial"]
        self.report["verdict"] = "failed"
        self.assert_problem(self.part(), "the verdict is 'failed'")


class Harnesses(FormalTest):
    """Harnesses and their bounds."""

    def test_a_harness_that_was_removed(self) -> None:
        (self.root / "proofs/queue/keel_queue_add_harness.c").unlink()
        self.assert_problem(self.part(), "queue/keel_queue_add_harness", "there is no file of it")

    def test_a_harness_without_a_verdict(self) -> None:
        del self.report["units"]["queue"]["cbmc"]["harnesses"]["keel_queue_add_harness"]
        self.assert_problem(self.part(), "proofs/queue/keel_queue_add_harness.c", "no verdict")

    def test_a_harness_that_is_not_sound(self) -> None:
        harness = self.report["units"]["queue"]["cbmc"]["harnesses"]["keel_queue_add_harness"]
        harness["sound"] = False
        self.assert_problem(self.part(), "keel_queue_add_harness", "not sound")

    def test_a_bound_without_a_reason(self) -> None:
        path = self.root / "proofs/scheduler/keel_scheduler_report_harness.c"
        text = path.read_text(encoding="utf-8")
        head, _, code = text.partition("//\n// Bounded")
        path.write_text(head + code[code.index("#include") :], encoding="utf-8")
        self.assert_problem(self.part(), path.name, "KEEL_QUEUE_CAPACITY=16", "does not say why")

    def test_bits_and_assumptions_are_bounds_and_contracts_are_none(self) -> None:
        found = {one.harness.name: one.bounds for one in bounds.read_all(self.root)}
        self.assertEqual(
            found["keel_queue_advance_harness"],
            ["KEEL_QUEUE_CAPACITY=4", "any_bits(5u)", "any_bits64(62u)", "any_bits64(8u)"],
        )
        self.assertEqual(
            found["keel_deviation_add__exact_harness"],
            ["(off_us < (1u << 10)) || (off_us > UINT32_MAX)", "chosen numbers"],
        )
        self.assertEqual(found["keel_queue_add_harness"], [])

    def test_what_covers_a_bound(self) -> None:
        every = bounds.read_all(self.root)
        one = next(one for one in every if one.harness.name == "keel_stats_mean_us__exact_harness")
        self.assertIn("harness:stats/keel_stats_mean_us_harness",
                      bounds.cover_of(one, every, self.report))  # fmt: skip


class Ledger(FormalTest):
    """The ledger of assumptions, and the theorems that rest on it."""

    def test_every_assumption_is_an_item_with_an_owner(self) -> None:
        facts = self.item("assumption", "A-12").facts
        self.assertEqual((facts["owner"], facts["how it is verified"]),
                         ("integrator", "test on the board"))  # fmt: skip

    def test_an_assumption_without_an_owner(self) -> None:
        self.replace(ledger.FILE, "| `keel_clock_fn_t` | integrator |", "| `keel_clock_fn_t` | |")
        self.assert_problem(self.part(), "specs/soundness.md:", "A-12: owner: missing")

    def test_an_owner_that_is_none(self) -> None:
        self.replace(ledger.FILE, "| `keel_clock_fn_t` | integrator |",
                     "| `keel_clock_fn_t` | nobody |")  # fmt: skip
        self.assert_problem(self.part(), "A-12: owner: nobody is none of integrator, Keel, tool")

    def test_an_assumption_that_nobody_verifies(self) -> None:
        self.replace(ledger.FILE, "| test on the board |", "| |")
        self.assert_problem(self.part(), "A-12: how it is verified: missing")

    def test_an_assumption_that_is_given_twice(self) -> None:
        self.replace(ledger.FILE, "| A-12 |", "| A-11 |")
        self.assert_problem(self.part(), "A-11 is given twice")

    def test_a_theorem_on_one_engine_needs_a_reason(self) -> None:
        self.replace("specs/theorems.toml", "alone = { ISO-001 =", "alone = { SCH-020 =")
        self.assert_problem(self.part(), "theorem isolation: ISO-001 is proved by WP alone")
        self.assert_problem(self.part(), "needless, SCH-020 is proved by")

    def test_a_theorem_on_nothing(self) -> None:
        self.replace("specs/theorems.toml", '["QUE-009"]', '["QUE-099"]')
        self.assert_problem(self.part(), "theorem releases: no goal bears the label of QUE-099")

    def test_a_theorem_that_assumes_what_the_ledger_lacks(self) -> None:
        self.replace("specs/theorems.toml", '["A-08"]', '["A-88"]')
        self.assert_problem(self.part(), "theorem adding", "the ledger has no A-88")


class Reviews(FormalTest):
    """Signatures of people."""

    def sign(self) -> None:
        """Somebody reviews the queue."""
        review.sign(find_units(self.root)["queue"], "A. Reader", 'read "all"', "2026-11-30")

    def state(self) -> tuple[str, ...]:
        """The row of the queue in the table of reviews."""
        table = next(table for table in self.part().tables if table.title == "Reviews")
        return next(row for row in table.rows if row[0] == "unit:queue")

    def test_nobody_has_reviewed_a_unit_until_somebody_signs(self) -> None:
        self.assertEqual(self.state()[1], "not reviewed")
        self.sign()
        self.assertEqual(self.state()[1:], ("signed", "A. Reader", "2026-11-30", 'read "all"'))
        self.assertEqual(self.part().summary["units reviewed by a person"], "1 of 17")

    def test_a_signature_is_stale_when_what_it_is_of_has_changed(self) -> None:
        self.sign()
        self.replace("src/rtos/queue.c", "return", "return ")
        self.assertTrue(self.state()[1].startswith("STALE"))
        self.assert_problem(self.part(), "specs/reviews/queue.toml", "A. Reader", "stale")

    def test_who_proves_a_goal_is_no_affair_of_a_review(self) -> None:
        self.sign()
        self.replace("proofs/queue/goals.txt", " cvc4", " z3")
        self.assertEqual(self.part().problems, ())

    def test_a_signature_without_a_person(self) -> None:
        self.sign()
        self.replace("specs/reviews/queue.toml", "A. Reader", "")
        self.assert_problem(self.part(), "specs/reviews/queue.toml", "person")

    def test_a_form_that_is_missing(self) -> None:
        (self.root / reviews.FOLDER / "queue.toml").unlink()
        self.assert_problem(self.part(), "specs/reviews/queue.toml", "is missing")

    def test_the_command_tells_and_refuses(self) -> None:
        self.sign()
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(review.run(review.parse([]), self.root), 0)
            self.replace("src/rtos/queue.c", "return", "return ")
            self.assertEqual(review.run(review.parse([]), self.root), 1)
        self.assertIn("queue        signed  A. Reader 2026-11-30", said.getvalue())
        self.assertIn("FAILED specs/reviews/queue.toml", said.getvalue())


if __name__ == "__main__":
    unittest.main()
