# SPDX-License-Identifier: Apache-2.0
"""Tests of `make prove ARGS='--explain NAME'`: what it says of goals, harnesses and wrong
bodies.
"""

from __future__ import annotations

import contextlib
import io
import json
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from test_prove import ASSERTED, GOALS, WRONG, WholeRunCase, cbmc_output, item

from keel.c.project import find_units
from keel.judge.wp_targets import Result
from keel.judge.wp_verdict import clause_at
from keel.prove.counterexample import changes, lines, read_trace
from keel.prove.explain import UnknownName, named, subjects
from keel.prove.located import line_of, locate
from keel.prove.proof_run import Choice, Session
from keel.prove.sequents import of_goal, read_sequents, relevant

ROOT = Path(__file__).resolve().parents[2]


def number(value: int) -> dict[str, Any]:
    """A number as CBMC writes it."""
    return {"name": "integer", "data": f"{value}u", "binary": f"{value:032b}"}


def called(function: str, line: int) -> dict[str, Any]:
    """A call."""
    where = {"file": "proofs/box/h.c", "line": str(line)}
    return {
        "stepType": "function-call",
        "function": {"displayName": function},
        "sourceLocation": where,
    }


def assigned(lhs: str, value: dict[str, Any], kind: str = "variable") -> dict[str, Any]:
    """An assignment."""
    return {"stepType": "assignment", "lhs": lhs, "value": value, "assignmentType": kind}


RETURN = {"stepType": "function-return"}
BOX = {
    "members": [
        {"name": "count", "value": number(2)},
        {
            "name": "slot",
            "value": {
                "elements": [{"index": 0, "value": number(7)}, {"index": 1, "value": number(9)}]
            },
        },
    ]
}
POINTER = {"name": "pointer", "data": "&box!0@1"}
TRACE = [
    called("__CPROVER_initialize", 1),
    assigned("limit", number(4)),
    RETURN,
    called("put_harness", 3),
    assigned("box", BOX),
    called("put", 8),
    assigned("box", POINTER, "actual-parameter"),
    assigned("i", number(5)),
    assigned("box.slot[1ul]", number(3)),
    assigned("limit", number(6)),
    assigned("goto_symex$$return_value$$put", number(1)),
    RETURN,
    {
        "stepType": "failure",
        "reason": "BOX_001: kept",
        "sourceLocation": {"file": "proofs/box/h.c", "line": "12"},
    },
]


class Counterexamples(unittest.TestCase):
    def test_the_state_before_and_what_became_of_it(self) -> None:
        found = read_trace(TRACE, "put_harness", "put")
        self.assertEqual((found.reason, found.place), ("BOX_001: kept", "proofs/box/h.c:12"))
        self.assertEqual(found.called_at, "proofs/box/h.c:8")
        self.assertEqual(lines(found.before), ["box.count = 2", "box.slot[0..1] = 7, 9"])
        self.assertEqual(
            changes(found.before, found.after),
            ["box.slot[1] = 3 (before: 9)", "limit = 6 (before: nothing)"],
        )
        self.assertEqual(found.returned, {"put": "1"})

    def test_a_failure_in_the_code_names_the_calls_that_lead_there(self) -> None:
        steps = [
            *TRACE[:10],
            {
                "stepType": "failure",
                "reason": "overflow",
                "sourceLocation": {"file": "src/rtos/box.c", "line": "4"},
            },
        ]
        found = read_trace(steps, "put_harness", "put")
        self.assertEqual(found.place, "src/rtos/box.c:4")
        self.assertEqual(found.calls, ["put (called at proofs/box/h.c:8)"])

    def test_a_boolean_that_is_neither_false_nor_true_shows(self) -> None:
        value = {"name": "boolean", "data": "TRUE", "binary": "10000000"}
        steps = [called("h", 1), assigned("flag", value), called("f", 2)]
        [line] = lines(read_trace(steps, "h", "f").before)
        self.assertIn("0x80", line)

    def test_equal_values_are_told_once_and_a_copy_as_such(self) -> None:
        state = {f"a.x[{i}]": "0" for i in range(6)} | {"a.x[6]": "1", "a.n": "7"}
        state |= {name.replace("a.", "b."): value for name, value in state.items()}
        self.assertEqual(
            lines(state), ["a.x[0..5] = 0, each", "a.x[6] = 1", "a.n = 7", "b: the same as a"]
        )


SEQUENTS = """\
[wp] Proved goals:   1 / 3

Goal Post-condition 'range' in 'keel_queue_find':
Prove: true.
Prover Qed returns Valid (4ms)

------------------------------------------------------------

Goal Preservation of Invariant 'range' (file src/rtos/queue.c, line 27):
Let a = shiftfield_F6_keel_queue_task(queue_0).
Let a_1 = shiftfield_F6_keel_queue_order(queue_0).
Let a_2 = shift_uint8(a_1, i).
Let x = Mchar_0[a_2].
Let a_4 = shiftfield_F6_keel_queue_count(queue_0).
Let x_1 = Mchar_0[a_4].
Assume {
  Type: is_uint8_chunk(Mchar_0) /\\ is_uint32(i).
  (* Heap *)
  Type: (region(queue_0.base) <= 0) /\\ framed(Mptr_0).
  (* Pre-condition *)
  Have: P_queue_order(Mchar_0, queue_0) /\\
      valid_rd(Malloc_0, queue_0, 418).
  (* Invariant 'range' *)
  Have: (0 <= i) /\\ (i <= x_1).
  (* Elsewhere *)
  Have: other_0 = 3.
  (* Then *)
  Have: Mptr_0
        [shift_PTR(a, x)] != task_0.
}
Prove: (i < x_1) /\\ ((-1) <= i).
Prover Alt-Ergo 2.0.0 returns Timeout (Qed:6ms) (3s)

------------------------------------------------------------
"""
FIND = "keel_queue_find_loop_invariant_range_preserved"


class Sequents(unittest.TestCase):
    def test_a_goal_is_told_in_the_words_of_the_code(self) -> None:
        [one] = of_goal(FIND, read_sequents(SEQUENTS, ["keel_queue"]))
        self.assertEqual(one.claim, "(i < queue_0->count) && ((-1) <= i)")
        self.assertEqual((one.place, one.proved), ("src/rtos/queue.c:27", False))
        self.assertEqual(one.said, ("Alt-Ergo 2.0.0: Timeout",))
        about, rest = relevant(one)
        self.assertIn(("Invariant 'range'", "(0 <= i) && (i <= queue_0->count)"), about)
        self.assertIn(("Then", "queue_0->task[queue_0->order[i]] != task_0"), about)
        self.assertEqual(rest, 1)

    def test_a_postcondition_is_no_invariant_of_that_name(self) -> None:
        every = read_sequents(SEQUENTS, ["keel_queue"])
        [one] = of_goal("keel_queue_find_ensures_range", every)
        self.assertTrue(one.proved)
        self.assertEqual(of_goal("keel_queue_find_ensures_other", every), [])


ACCESSES = """\

Goal Assertion 'rte,mem_access' (file src/rtos/box.c, line 4):
Prove: valid_rw(Malloc_0, box, 1).

------------------------------------------------------------

Goal Assertion 'rte,mem_access' (file src/rtos/box.c, line 5):
Prove: true.

------------------------------------------------------------

Goal Assertion 'rte,mem_access' (file src/rtos/box.c, line 6):
Prove: valid_rw(Malloc_0, other, 1).

------------------------------------------------------------
"""
ACCESS = "keel_box_put_assert_rte_mem_access"


class Lines(unittest.TestCase):
    NAMES = (ACCESS, f"{ACCESS}_2", f"{ACCESS}_3", "keel_box_put_assigns")

    def line(self, goal: str, names: Sequence[str] = NAMES) -> str:
        return line_of(goal, names, read_sequents(ACCESSES, ()))

    def test_goals_of_one_kind_are_told_apart_by_their_number(self) -> None:
        self.assertEqual(self.line(ACCESS), "src/rtos/box.c:4")
        self.assertEqual(self.line(f"{ACCESS}_3"), "src/rtos/box.c:6")

    def test_no_line_is_told_where_there_is_a_doubt(self) -> None:
        self.assertEqual(self.line("keel_box_put_assigns"), "", "WP tells none")
        self.assertEqual(self.line(f"{ACCESS}_2"), "", "that is proved, so the order is another")
        self.assertEqual(self.line(ACCESS, self.NAMES[:2]), "", "not as many goals as are printed")

    def test_an_open_goal_has_its_line_and_its_provers_words(self) -> None:
        said = f"{ACCESS}_3 is not proved, provers gave up (include/box.h:9): Z3 4.8.12: Failed"
        goals = [{"name": name, "status": "Valid"} for name in self.NAMES]
        goals[2] |= {"status": "Unproved", "place": "include/box.h:9"}
        result = Result(goals=goals, problems=[said, "another (include/box.h:9)"])
        locate(result, lambda: ACCESSES)
        self.assertEqual(goals[2]["place"], "src/rtos/box.c:6")
        self.assertIn(
            "gave up (src/rtos/box.c:6): Z3 4.8.12: ended without an answer", result.problems[0]
        )
        self.assertEqual(result.problems[1], "another (include/box.h:9)")

    def test_where_all_is_proved_nothing_is_printed(self) -> None:
        locate(Result(goals=[{"name": ACCESS, "status": "Valid"}]), self.fail)


class Names(WholeRunCase):
    def test_a_label_leads_to_the_harness_that_asserts_it(self) -> None:
        every = subjects([self.unit], self.report_file)
        [one] = named(every, "BOX_001")
        self.assertEqual((one.kind, one.where), ("assertion", "keel_box_put_harness"))
        self.assertEqual(named(every, "keel_box_put_assigns")[0].kind, "goal")

    def test_a_goal_that_only_the_last_run_knows_has_a_name(self) -> None:
        goals = {"wp": {"goal_list": [{"name": "keel_box_put_ensures_new"}]}}
        self.report_file.parent.mkdir(parents=True)
        self.report_file.write_text(json.dumps({"units": {"box": goals}}), encoding="utf-8")
        every = subjects([self.unit], self.report_file)
        self.assertEqual(named(every, "keel_box_put_ensures_new")[0].kind, "goal")

    def test_an_unknown_name_is_answered_with_the_nearest(self) -> None:
        every = subjects([self.unit], self.report_file)
        with self.assertRaisesRegex(UnknownName, "did you mean keel_box_put_harness"):
            named(every, "keel_box_put_harnes")

    def test_a_clause_is_quoted_whole(self) -> None:
        place = "include/keel/rtos/box.h:7"
        self.assertEqual(clause_at(self.root, place), "ensures BOX_001: *box == value;")


class Explained(WholeRunCase):
    def explain(self, name: str) -> tuple[int, str]:
        choice = Choice(
            (find_units(self.root)["box"],), True, ("wp", "cbmc"), 1, self.verdict_folder
        )
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            tools: Any = self.tools
            status = Session(self.root, tools, choice).explain(name)
        return status, output.getvalue()

    def test_a_name_that_is_none_is_a_wrong_command_line(self) -> None:
        status, output = self.explain("nonsense")
        self.assertEqual((status, output.count("\n")), (2, 1))

    def test_a_harness_that_holds_has_no_counterexample(self) -> None:
        status, output = self.explain("keel_box_put_harness")
        self.assertEqual(status, 0, output)
        self.assertIn("there is no counterexample", output)

    def test_an_assertion_that_fails_shows_the_counterexample(self) -> None:
        text = json.dumps(TRACE).replace("put_harness", "keel_box_put_harness")
        steps = json.loads(text.replace('"put"', '"keel_box_put"'))
        failing = cbmc_output(item("h.assertion.1", "FAILURE", "BOX_001: x"))
        self.play(cbmc=[*json.loads(failing), {"trace": steps}])
        status, output = self.explain("BOX_001")
        self.assertEqual(status, 1)
        self.assertIn("at proofs/box/h.c:12", output)
        self.assertIn("box.slot[0..1] = 7, 9", output)

    def test_a_wrong_body_is_shown_with_its_fault(self) -> None:
        self.unit.wrong_list.write_text(WRONG, encoding="utf-8")
        self.play(wrong=json.loads(cbmc_output(ASSERTED)))
        self.assertEqual(self.explain("zero")[0], 1)
        self.play(wrong=[*json.loads(cbmc_output(ASSERTED)), {"trace": TRACE}])
        status, output = self.explain("zero")
        self.assertEqual(status, 0)
        self.assertIn("-    *box = value;", output)
        self.assertIn("+    *box = 0;", output)

    def test_a_run_that_fails_names_the_command(self) -> None:
        goals = {**GOALS, "keel_box_put": {"ensures_BOX_001": "Timeout", "assigns": "Valid"}}
        self.play(goals=goals)
        output = self.prove()[1]
        self.assertIn("make prove UNIT=box ARGS='--explain keel_box_put_ensures_BOX_001'", output)
        self.assertEqual(output.count("FAILED keel_box_put_ensures_BOX_001"), 1)
        self.assertIn("all that failed, together: build/prove/summary.md", output)
