# SPDX-License-Identifier: Apache-2.0
"""Tests of the evidence part `formal`: what is wrong with proofs must be a problem, named."""

from __future__ import annotations

import contextlib
import io
import json
import unittest
import unittest.mock
from pathlib import Path

from evidence_proofs import NOW, EvidenceTest

from keel.base.source import STAMP
from keel.base.verdict_cache import Cache
from keel.c.project import find_units
from keel.gather import review, third_opinion
from keel.gather.formal import bounds, esbmc, ledger, opinion, reviews
from keel.gather.part import Item, Part
from keel.gather.parts import formal

ROOT = Path(__file__).resolve().parents[2]

QUEUE_GOAL = "keel_queue_add_ensures_QUE_003_order"


class FormalTest(EvidenceTest):
    """A test with the part."""

    def setUp(self) -> None:
        super().setUp()
        asked = opinion.read_opinions(self.root).ask
        answer = {
            "verdict": "proved",
            "wrong": "refuted",
            "properties": 9,
            "bounds": "",
            "wrong_body": "w",
        }
        self.answers = {one.harness: dict(answer) for one in asked}
        self.opinions = {"harnesses": self.answers, STAMP: NOW}

    def part(self) -> Part:
        """The part, made from tree and report as they are now."""
        self.write("opinion/report.json", self.opinions)
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

    def test_how_long_it_took_is_told_apart_from_all_else(self) -> None:
        before = self.part()
        self.assertEqual(before.measured["queue/wp/lemmas"], 1.5)
        for unit in self.report["units"].values():
            unit["seconds"] = dict.fromkeys(unit["seconds"], 77.7)
        after = self.part()
        self.assertEqual(after.measured["queue/wp/lemmas"], 77.7)
        self.assertEqual(after.model_copy(update={"measured": before.measured}), before)

    def test_a_goal_says_who_proved_it_and_what_for(self) -> None:
        item = self.item("goal", f"queue/{QUEUE_GOAL}")
        self.assertEqual(item.state, "good")
        self.assertEqual((item.facts["engine"], item.facts["prover"]), ("WP", "CVC4 1.8"))
        self.assertEqual(item.links, ("unit:queue", "requirement:QUE-003"))

    def test_an_assertion_belongs_to_its_harness(self) -> None:
        item = self.item("goal", "queue/keel_queue_add_harness/QUE_003_model")
        self.assertEqual(item.facts["engine"], "CBMC")
        self.assertEqual(
            item.links, ("harness:queue/keel_queue_add_harness", "requirement:QUE-003")
        )

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
        self.assertIn(
            "harness:stats/keel_stats_mean_us_harness", bounds.cover_of(one, every, self.report)
        )


class Ledger(FormalTest):
    """The ledger of assumptions, and the theorems that rest on it."""

    def test_every_assumption_is_an_item_with_an_owner(self) -> None:
        facts = self.item("assumption", "A-12").facts
        self.assertEqual(
            (facts["owner"], facts["how it is verified"]), ("integrator", "test on the board")
        )

    def test_an_assumption_without_an_owner(self) -> None:
        self.replace(ledger.FILE, "| `keel_clock_fn_t` | integrator |", "| `keel_clock_fn_t` | |")
        self.assert_problem(self.part(), "specs/soundness.md:", "A-12: owner: missing")

    def test_an_owner_that_is_none(self) -> None:
        self.replace(
            ledger.FILE, "| `keel_clock_fn_t` | integrator |", "| `keel_clock_fn_t` | nobody |"
        )
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


CLOCK = "clock/keel_clock_init_harness"
OUTPUT = """\
  PASSED       [f.overflow.1]            line  28  arithmetic overflow on add
  PASSED       [h.assertion.1]           line  17  CLK_002_model: as the model says

** 0 of 2 properties failed, 2 passed

VERIFICATION SUCCESSFUL
"""
REFUTED = """\
  FAILED       [h.assertion.1]           line  17  CLK_002_model: as the model says

VERIFICATION FAILED
"""


class Opinions(FormalTest):
    """What ESBMC says."""

    def test_an_engine_that_does_not_agree(self) -> None:
        self.answers[CLOCK]["verdict"] = "failed: CLK_001"
        self.assert_problem(self.part(), "ESBMC does not prove", CLOCK, "CLK_001")
        self.answers[CLOCK] |= {"verdict": "proved", "wrong": "proved"}
        self.assert_problem(self.part(), "ESBMC does not refute", CLOCK)

    def test_an_answer_that_is_missing(self) -> None:
        del self.answers[CLOCK]
        self.assert_problem(self.part(), "build/opinion/report.json", "no answer", CLOCK)

    def test_a_harness_that_nobody_asks_about_without_a_reason(self) -> None:
        entry = f'[[ask]]\nharness = "{CLOCK}"\n'
        self.replace(opinion.FILE, entry, "")
        self.assert_problem(self.part(), opinion.FILE, CLOCK, "nor is there a reason")

    def test_a_harness_that_does_not_exist(self) -> None:
        self.replace(opinion.FILE, CLOCK, "clock/keel_clock_gone_harness")
        self.assert_problem(self.part(), opinion.FILE, "there is no harness clock/keel_clock_gone")

    def test_why_a_harness_is_not_asked_about(self) -> None:
        harnesses = {one.id: one.harness for one in bounds.read_all(self.root)}
        self.assertIn("stand-ins", opinion.why_not(harnesses["pass/keel_pass_run_harness"]))
        clamp = harnesses["range/keel_range_clamp_harness"]
        self.assertIn("__CPROVER_equal", opinion.why_not(clamp))
        self.assertEqual(opinion.why_not(harnesses[CLOCK]), "")

    def test_a_verdict_counts_only_with_what_was_asked(self) -> None:
        self.assertEqual(esbmc.judged(OUTPUT, ()), ("proved", 2))
        self.assertEqual(
            esbmc.judged(OUTPUT.replace("CLK_002_model:", "some"), ())[0], "checked no assertion"
        )
        unknown = "WARNING: no body for function __CPROVER_equal\n"
        self.assertEqual(esbmc.judged(unknown + OUTPUT, ())[0], "does not know __CPROVER_equal")
        self.assertEqual(esbmc.judged("ERROR: PARSING ERROR\n", ())[0], "ERROR: PARSING ERROR")

    def test_a_refutation_counts_only_at_an_assertion_of_the_harness(self) -> None:
        self.assertEqual(esbmc.judged(REFUTED, ["CLK_002_model"])[0], "refuted")
        unlabelled = REFUTED.replace("CLK_002_model:", "array bounds:")
        self.assertTrue(esbmc.judged(unlabelled, ["CLK_002_model"])[0].startswith("failed"))
        self.assertTrue(esbmc.judged(REFUTED, ())[0].startswith("failed"))


class Kept(FormalTest):
    """Answers that are kept."""

    def asked(self, says: str) -> tuple[dict[str, object], int]:
        """What is answered on a harness when ESBMC would say this, and how often it was asked."""
        harnesses = bounds.read_all(self.root)
        question = next(iter(opinion.questions(opinion.read_opinions(self.root), harnesses)))
        program = unittest.mock.Mock()
        program.ask.return_value = {"verdict": says, "properties": 2, "wrong": "refuted"}
        found = third_opinion.answer(question, program, Cache(self.root / "cache"), "ESBMC 8.4")
        return found, program.ask.call_count

    def test_agreement_is_kept_until_what_it_is_of_changes(self) -> None:
        self.assertEqual(self.asked("proved")[1], 1)
        answer, times = self.asked("failed")
        self.assertEqual((answer["verdict"], times), ("proved", 0))
        self.replace("include/keel/rtos/clock.h", "? (to_us - from_us)", "? (to_us - from_us + 0u)")
        self.assertEqual(self.asked("failed")[0]["verdict"], "failed")

    def test_the_report_says_whether_it_agrees(self) -> None:
        for says, ends in (("proved", (0, "good")), ("no answer in 120 s", (1, "failed"))):
            answers = {CLOCK: {"verdict": says, "wrong": ""}}
            tools = unittest.mock.Mock()
            tools().versions.return_value = {"esbmc": unittest.mock.Mock(version="8", sha256="a")}
            with (
                unittest.mock.patch.object(third_opinion, "ask_all", return_value=answers),
                unittest.mock.patch.object(third_opinion, "Toolchain", tools),
                contextlib.redirect_stdout(io.StringIO()),
            ):
                status = third_opinion.run([], self.root)
            report = json.loads((self.root / "build" / opinion.REPORT).read_text("utf-8"))
            self.assertEqual((status, report["verdict"]), ends)

    def test_a_failure_is_asked_about_again(self) -> None:
        self.assertEqual([self.asked("failed")[1] for _ in range(2)], [1, 1])

    def test_a_harness_is_asked_with_its_wrong_body_in_place(self) -> None:
        harnesses = bounds.read_all(self.root)
        asked = opinion.questions(opinion.read_opinions(self.root), harnesses)
        question = next(one for one in asked if one.harness.name == "keel_queue_init_harness")
        program = esbmc.Esbmc(
            ["esbmc"], Path("h"), unittest.mock.Mock(), self.root, self.root / "scratch"
        )
        words = program.command(question, question.wrong)
        changed = self.root / "scratch/init_skips_last/src/rtos/queue.c"
        self.assertIn(str(changed), words)
        self.assertNotEqual(changed.read_text(), (self.root / "src/rtos/queue.c").read_text())
        self.assertIn("-DKEEL_QUEUE_CAPACITY=3u", words)


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
        units = len(reviews.proved_units(ROOT))
        self.assertEqual(self.part().summary["units reviewed by a person"], f"1 of {units}")

    def test_a_signature_is_stale_when_what_it_is_of_has_changed(self) -> None:
        self.sign()
        self.replace("src/rtos/queue.c", "return", "return ")
        self.assertTrue(self.state()[1].startswith("STALE"))
        self.assert_problem(self.part(), "specs/reviews.toml: queue: ", "A. Reader", "stale")

    def test_who_proves_a_goal_is_no_affair_of_a_review(self) -> None:
        self.sign()
        self.replace("proofs/queue/goals.txt", " cvc4", " z3")
        self.assertEqual(self.part().problems, ())

    def test_a_signature_without_a_person(self) -> None:
        self.sign()
        self.replace(reviews.FILE, '"A. Reader"', '""')
        self.assert_problem(self.part(), "specs/reviews.toml:8: review number 1: person")

    def test_a_signature_that_says_too_little_or_too_much(self) -> None:
        self.sign()
        self.replace(reviews.FILE, 'unit = "queue"\n', "")
        self.assert_problem(self.part(), "specs/reviews.toml:6: review number 1: unit: is missing")
        self.replace(reviews.FILE, "[[review]]\n", '[[review]]\nunit = "queue"\nmood = "good"\n')
        self.assert_problem(self.part(), "specs/reviews.toml:8: ", "mood: unknown key")

    def test_a_signature_on_a_unit_that_is_not_there(self) -> None:
        self.sign()
        self.replace(reviews.FILE, 'unit = "queue"', 'unit = "cue"')
        self.assert_problem(
            self.part(),
            "specs/reviews.toml:7: review number 1: unit: there is no unit cue with proofs",
        )

    def test_a_file_that_is_missing(self) -> None:
        (self.root / reviews.FILE).unlink()
        self.assert_problem(self.part(), "specs/reviews.toml")

    def test_of_two_signatures_each_is_of_its_unit(self) -> None:
        self.sign()
        review.sign(find_units(self.root)["pass"], "B. Reader", "nothing", "2026-11-30")
        self.replace("src/rtos/queue.c", "return", "return ")
        self.assertEqual(self.part().summary["units reviewed by a person"].split(" ")[0], "1")
        self.assertTrue(self.state()[1].startswith("STALE"))

    def test_the_command_tells_and_refuses(self) -> None:
        self.sign()
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(review.run(review.parse([]), self.root), 0)
            self.replace("src/rtos/queue.c", "return", "return ")
            self.assertEqual(review.run(review.parse([]), self.root), 1)
        self.assertIn("queue        signed  A. Reader 2026-11-30", said.getvalue())
        self.assertIn("FAILED specs/reviews.toml: queue: ", said.getvalue())
