# SPDX-License-Identifier: Apache-2.0
"""Tests of the evidence part `strength`: what weakens the trust in the proofs must be a problem."""

from __future__ import annotations

import contextlib
import io
import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from evidence_proofs import EvidenceTest

from keel.base.errors import ToolError
from keel.base.source import STAMP
from keel.c.project import Unit, find_units
from keel.gather.part import Item, Part
from keel.gather.parts import strength
from keel.gather.strength import mutants as recorded
from keel.mutate import command as mutate
from keel.mutate import records as mutant_records
from keel.mutate import table as mutant_table
from keel.mutate.operators import mutants
from keel.mutate.verdicts import Verdict

ROOT = Path(__file__).resolve().parents[2]

RECORD = "specs/mutation.toml"
OF_RANGE = f"{RECORD}: range: "
KILLED = {"cbmc": "killed: keel_range_clamp_harness: RNG_002_model"}


class StrengthTest(EvidenceTest):
    """A tree with a result of mutation on the unit range."""

    def setUp(self) -> None:
        super().setUp()
        (self.root / RECORD).unlink()
        self.report["tools"] = {"cbmc": {"version": "6.6.0", "sha256": "c", "parts": []}}
        self.verdicts = [
            Verdict(mutant, "killed", "", dict(KILLED)) for mutant in mutants(self.unit.header)
        ][:4]

    @property
    def unit(self) -> Unit:
        """The unit whose mutants were run."""
        return find_units(self.root)["range"]

    def record(self) -> str:
        """Keep the verdicts as the result."""
        harnesses = mutant_records.all_harnesses(self.root)
        judges = mutant_records.killers(verdict.engines for verdict in self.verdicts)
        tools = recorded.found_of(self.report)
        made_of = mutant_records.origin(self.unit, harnesses, tools, judges)
        return mutant_table.keep(self.unit, self.verdicts, [], made_of)

    def explain(self, number: int, reason: str) -> None:
        """A person accepts a mutant, with a reason."""
        mutant = self.verdicts[number].mutant
        lines = {
            "function": mutant.function,
            "original": mutant.before,
            "mutant": mutant.after,
            "reason": reason,
        }
        text = "".join(f"{key} = {json.dumps(value)}\n" for key, value in lines.items())
        path = self.root / "proofs/range/equivalent.toml"
        path.write_text(f"[[equivalent]]\n{text}", encoding="utf-8")
        self.verdicts[number] = Verdict(mutant, "equivalent", reason)

    def survivors(self) -> tuple[tuple[str, ...], ...]:
        """The rows of the survivors."""
        tables = {table.title: table for table in self.part().tables}
        return tables["Survivors, adjudicated"].rows

    def part(self) -> Part:
        """The part, made from tree and report as they are now."""
        return strength.make(self.context())

    def row(self) -> tuple[str, ...]:
        """The unit's row in the table of mutants."""
        rows = next(table.rows for table in self.part().tables if table.title == "Mutants")
        return next(row for row in rows if row[0] == "unit:range")

    def item(self, name: str) -> Item:
        """An item of the part."""
        return next(item for item in self.part().items if item.id == name)


class Mutants(StrengthTest):
    """Recorded results."""

    def test_units_without_a_result_are_shown_as_such(self) -> None:
        part = self.part()
        self.assertEqual(part.problems, ())
        units = len(list((ROOT / "proofs").glob("*/goals.txt")))
        self.assertEqual(part.summary["units whose mutants were run"], f"0 of {units}")
        self.assertEqual(self.row()[1], "not run")

    def test_a_result_is_scored(self) -> None:
        self.explain(3, "no difference")
        self.verdicts[2] = Verdict(self.verdicts[2].mutant, "killed", "", {"wp": "killed: a goal"})
        self.record()
        self.assertEqual(self.part().problems, ())
        self.assertEqual(self.row()[1:], ("current", "3 of 3", "2", "1", "1", "0"))
        self.assertEqual(self.part().summary["mutants killed"], "3 of 3")
        item = self.item("range/result")
        self.assertEqual((item.state, item.text[:6]), ("good", "3 of 3"))
        self.assertEqual(item.facts["harnesses that killed"], "keel_range_clamp_harness")

    def test_a_survivor_has_the_reason_that_a_person_gave(self) -> None:
        self.explain(3, "no difference")
        self.record()
        mutant = self.verdicts[3].mutant
        self.assertNotIn("no difference", (self.root / RECORD).read_text(encoding="utf-8"))
        place, change, verdict, reason = self.survivors()[0][1:]
        self.assertEqual(place, f"{mutant.function}:{mutant.line}")
        self.assertEqual(change, f"{mutant.before}  ->  {mutant.after}")
        self.assertEqual((verdict, reason), ("makes no difference", "no difference"))

    def test_a_reason_that_has_changed_is_shown_with_no_survivor(self) -> None:
        self.explain(3, "no difference")
        self.record()
        self.replace("proofs/range/equivalent.toml", "no difference", "hardly any difference")
        self.assert_problem(self.part(), OF_RANGE, "stale", "proofs")
        self.assertEqual(self.survivors(), ())

    def test_a_reason_for_a_line_that_is_gone(self) -> None:
        self.explain(3, "no difference")
        self.record()
        self.replace("proofs/range/equivalent.toml", "return ", "give ")
        self.assert_problem(
            self.part(), "proofs/range/equivalent.toml: entry 1: keel_range", "give "
        )
        self.assertIn("entry 1: keel_range", self.told()[2])

    def test_what_nobody_has_explained_is_not_recorded_as_explained(self) -> None:
        self.verdicts[3] = Verdict(self.verdicts[3].mutant, "equivalent", "no difference")
        with self.assertRaisesRegex(ToolError, "range: equivalent.toml has no reason for keel_"):
            self.record()

    def told(self) -> tuple[int, str, str]:
        """What mutate --status makes of the tree: exit status, output, errors."""
        tools: Any = SimpleNamespace(versions=lambda _: recorded.found_of(self.report))
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            options = mutate.parse(["--status"], ["range"])
            status = mutate.tell_status([self.unit], options, tools)
        return status, output.getvalue(), errors.getvalue()

    def test_mutate_tells_what_is_kept_and_whether_it_is_current(self) -> None:
        """In a clone where no mutant was tried."""
        self.assertEqual(self.told(), (0, "range        no result is kept\n", ""))
        self.record()
        line = "range        killed 4 of 4, 0 equivalent; "
        self.assertEqual(self.told(), (0, f"{line}current\n", ""))
        self.report["tools"]["cbmc"]["version"] = "6.7.0"
        self.assertEqual(self.told(), (0, f"{line}STALE: cbmc changed since\n", ""))
        self.replace(RECORD, "problems = []", "problems = [")
        status, _, errors = self.told()
        self.assertEqual(status, 2)
        self.assertRegex(errors, f"^mutate: {RECORD}:[0-9]+: no TOML: ")

    def test_a_result_on_another_source_is_stale_and_does_not_count(self) -> None:
        self.record()
        self.replace("include/keel/middleware/range.h", "RNG_001", "RNG_009")
        self.assert_problem(self.part(), OF_RANGE, "stale", "source")
        self.assertIn("STALE", self.row()[1])
        self.assertEqual(self.part().summary["mutants killed"], "0 of 0")
        self.assertEqual(self.item("range/result").state, "open")

    def test_other_words_of_a_comment_leave_a_result_current(self) -> None:
        self.record()
        header = "include/keel/middleware/range.h"
        self.replace(header, "* @brief ", "* @brief In other words: ")
        self.assertEqual(self.told()[1].split("; ")[1], "current\n")
        # Where no function is, no result names a line.
        self.replace("include/keel/c_declarations.h", "* @brief ", "*\n * @brief ")
        self.assertEqual(self.told()[1].split("; ")[1], "current\n")
        self.replace(header, "* @brief ", "*\n * @brief ")
        self.assertIn("STALE: source changed since", self.told()[1])

    def test_code_in_what_looks_like_a_comment_is_stale(self) -> None:
        self.record()
        lemma = "//@ lemma more: 1 < 2;\n#define"
        self.replace("include/keel/middleware/range.h", "#define", lemma)
        self.assertIn("STALE: source changed since", self.told()[1])

    def test_a_result_of_other_tools_is_stale_and_no_problem(self) -> None:
        self.record()
        self.report["tools"]["cbmc"]["version"] = "6.7.0"
        self.assertEqual(self.part().problems, ())
        self.assertEqual(self.row()[1], "STALE: cbmc changed since")
        self.assertEqual(self.part().summary["mutants killed"], "0 of 0")
        self.assertEqual(self.item("range/result").state, "open")

    def test_a_result_of_other_builds_of_the_same_tools_is_current(self) -> None:
        self.record()
        self.report["tools"]["cbmc"]["sha256"] = "d"
        self.assertNotIn("STALE", self.row()[1])
        self.report["tools"]["cbmc"]["parts"] = [{"name": "libc6", "version": "2.41"}]
        self.assertEqual(self.row()[1], "STALE: cbmc changed since")

    def test_a_result_on_other_proofs_is_stale(self) -> None:
        self.record()
        self.replace("proofs/range/keel_range_clamp_harness.c", "__CPROVER_assert(", "(void)(")
        self.assert_problem(self.part(), OF_RANGE, "stale", "proofs")

    def test_without_the_harness_that_killed_it_is_stale(self) -> None:
        self.record()
        (self.root / "proofs/range/keel_range_clamp_harness.c").unlink()
        self.assert_problem(self.part(), OF_RANGE, "stale", "proofs")

    def test_a_harness_that_killed_nothing_makes_nothing_stale(self) -> None:
        self.record()
        self.replace("proofs/range/keel_range_contains_harness.c", "__CPROVER_assert(", "(void)(")
        self.assertEqual(self.row()[1], "current")

    def test_comments_of_harnesses_and_provers_of_goals_make_nothing_stale(self) -> None:
        self.record()
        self.replace("proofs/range/keel_range_clamp_harness.c", "// Every", "// Really every")
        self.replace("proofs/range/goals.txt", " qed", " z3")
        self.assertEqual(self.row()[1], "current")

    def test_a_statement_left_out_leaves_nothing_in_its_place(self) -> None:
        first = self.verdicts[0]
        self.verdicts[0] = replace(first, mutant=replace(first.mutant, after=""))
        self.record()
        self.assertEqual(self.part().problems, ())

    def test_a_survivor_that_nobody_has_explained(self) -> None:
        self.verdicts[1] = Verdict(self.verdicts[1].mutant, "survived", "", {"cbmc": "survived"})
        self.record()
        self.assert_problem(self.part(), OF_RANGE, "survived, unexplained", "->")
        self.assertEqual(self.item("range/survivor-1").state, "bad")

    def test_what_was_not_tried_whole_is_not_recorded(self) -> None:
        self.verdicts[0].status = "skipped"
        self.assertIn("left alone", self.record())
        self.assertFalse((self.root / RECORD).exists())

    def test_a_record_replaces_that_of_its_unit_and_leaves_the_others(self) -> None:
        (self.root / RECORD).write_text((ROOT / RECORD).read_text("utf-8"), "utf-8")
        before = mutant_table.read(self.root)
        self.record()
        after = mutant_table.read(self.root)
        self.assertEqual(list(after.unit), list(before.unit))
        changed = [
            name
            for name in before.unit
            if before.unit[name] != after.unit[name] or before.made_of(name) != after.made_of(name)
        ]
        self.assertEqual(changed, ["range"])
        self.assertEqual(after.unit["range"].mutants, 4)

    def test_a_record_is_not_added_to_a_table_that_is_refused(self) -> None:
        self.record()
        self.replace(RECORD, "mutants = 4", "mutants = 5")
        before = (self.root / RECORD).read_text(encoding="utf-8")
        with self.assertRaisesRegex(ToolError, "add up to 4"):
            self.record()
        self.assertEqual((self.root / RECORD).read_text(encoding="utf-8"), before)

    def test_a_table_that_is_refused_says_nothing_of_any_unit(self) -> None:
        self.record()
        self.replace(RECORD, "mutants = 4", "mutants = 5")
        self.assert_problem(self.part(), f"{RECORD}:", "unit: range: mutants: 5, but")
        self.assertEqual(self.row()[1], "not run")

    def test_an_entry_that_no_reason_has(self) -> None:
        self.explain(3, "no difference")
        self.record()
        self.replace(RECORD, "{entry = 1", "{entry = 2")
        self.assert_problem(
            self.part(), OF_RANGE, "accepted: there is no entry 2 in proofs/range/equivalent.toml"
        )

    def test_a_unit_that_is_not_there(self) -> None:
        self.record()
        self.replace(RECORD, "[unit.range]", "[unit.ranges]")
        self.assert_problem(self.part(), f"{RECORD}: there is no unit ranges with proofs")

    def test_the_command_records_nothing_by_halves(self) -> None:
        for option in (["--quick"], ["--function", "f"], ["--engine", "wp"]):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
                mutate.parse(["--record", *option], ["range"])


class Mistakes(StrengthTest):
    """Wrong bodies and wrong bounds."""

    def test_a_mistake_says_what_it_is_and_who_refuses_it(self) -> None:
        item = self.item("queue/wrong-add_overwrites")
        self.assertIn("overwrites the slot", item.text)
        self.assertIn("harness:queue/keel_queue_add_harness", item.links)
        bound = self.item("voter/wrong-mean_rounds_twice")
        self.assertEqual(bound.text, "One rounding more than there is.")

    def test_a_mistake_that_nobody_refuses(self) -> None:
        self.report["units"]["queue"]["cbmc"]["negative"]["list"]["add_overwrites"] = False
        self.assert_problem(
            self.part(), "queue/wrong-add_overwrites", "is not refused", "keel_queue_add_harness"
        )

    def test_a_mistake_without_a_verdict(self) -> None:
        del self.report["units"]["voter"]["gappa"]["negative"]["list"]["mean_rounds_twice.g"]
        self.assert_problem(self.part(), "voter/wrong-mean_rounds_twice", "no verdict")

    def test_without_a_report_the_report_is_the_problem_and_not_each_mistake(self) -> None:
        self.report[STAMP] = {"commit": "", "tree": "", "product": ""}
        part = self.part()
        self.assertEqual({one.state for one in part.items if "/wrong-" in one.id}, {"open"})
        self.assert_problem(part, "build/prove/report.json", "speaks of another source")

    def test_a_mistake_that_says_nothing(self) -> None:
        name = "proofs/voter/wrong/mean_rounds_twice.g"
        self.replace(name, "# One rounding more than there is.\n", "")
        self.assert_problem(self.part(), "voter/wrong-mean_rounds_twice", "does not say")

    def test_a_wrong_body_that_says_nothing_is_refused(self) -> None:
        self.replace("proofs/queue/wrong.toml", "description = ", "descriptions = ")
        self.assert_problem(self.part(), "proofs/queue/wrong.toml:", "unknown key descriptions")


class Blocks(StrengthTest):
    """What the harnesses reach."""

    def coverage(self, unit: str, name: str) -> dict[str, int]:
        """What a harness reaches, in the report."""
        harness = self.report["units"][unit]["cbmc"]["harnesses"][name]
        coverage: dict[str, int] = harness["coverage"]
        return coverage

    def test_a_block_that_is_not_reached_without_a_reason(self) -> None:
        self.coverage("queue", "keel_queue_add_harness")["reached"] -= 1
        self.assert_problem(
            self.part(), "queue/keel_queue_add_harness", "does not reach 1 blocks", "a reason for 0"
        )

    def test_a_reason_for_what_is_reached(self) -> None:
        coverage = self.coverage("pass", "keel_pass_turn_harness")
        coverage["reached"] = coverage["blocks"]
        self.assert_problem(
            self.part(), "pass/keel_pass_turn_harness", "0 blocks", "a reason for 12"
        )

    def test_a_function_that_no_harness_covers(self) -> None:
        self.replace("src/rtos/queue.c", "static ", "static void lonely(void)\n{\n}\n\nstatic ")
        self.assert_problem(self.part(), "function lonely", "no harness covers it")
        reasons = self.root / "specs/unreached.toml"
        entry = '\n[[unreached]]\nfunction = "lonely"\nreason = "nobody calls it"\n'
        reasons.write_text(reasons.read_text("utf-8") + entry, "utf-8")
        self.assertEqual(self.part().problems, ())

    def test_an_entry_without_a_reason(self) -> None:
        self.replace("specs/unreached.toml", '"as in keel_pass_turn_harness"', '""')
        self.assert_problem(self.part(), "specs/unreached.toml", "reason")

    def test_unreached_blocks_are_listed_by_function_and_line(self) -> None:
        source = (self.root / "src/rtos/pass.c").read_text("utf-8").splitlines()
        line = source.index("    task->run(task->context);") + 1
        (table,) = [one for one in self.part().tables if one.title.startswith("Blocks that")]
        rows = {row[0]: row[1:3] for row in table.rows}
        blocks, places = rows["harness:pass/keel_pass_turn__once_harness"]
        self.assertEqual(blocks, "6")
        self.assertIn(f"run_task at src/rtos/pass.c:{line}", places.split("; "))
        self.assertNotIn("specs/model", places)

    def test_blocks_where_there_is_no_call_through_a_pointer(self) -> None:
        self.coverage("queue", "keel_queue_add_harness")["reached"] -= 1
        reasons = self.root / "specs/unreached.toml"
        entry = (
            '\n[[unreached]]\nharness = "queue/keel_queue_add_harness"\nblocks = 1\n'
            'reason = "as in keel_pass_turn_harness"\n'
        )
        reasons.write_text(reasons.read_text("utf-8") + entry, "utf-8")
        self.assert_problem(
            self.part(),
            "specs/unreached.toml: queue/keel_queue_add_harness",
            "nothing that it covers calls through a pointer",
        )

    def test_an_entry_that_is_of_nothing(self) -> None:
        self.replace("specs/unreached.toml", "keel_pass_turn__once_harness", "keel_gone_harness")
        self.assert_problem(self.part(), "there is no harness pass/keel_gone_harness")
