# SPDX-License-Identifier: Apache-2.0
"""Tests of harnesses that are executed on mutants, and of what CBMC is asked about it.

The harnesses are compiled and executed, for which clang 19 is needed; CBMC is not run.
"""

from __future__ import annotations

import dataclasses
import json
import os
import shutil
import tempfile
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest import mock

from test_prove import SOURCE, TreeTest

from keel.base.jobs import Runner
from keel.base.verdict_cache import Cache
from keel.judge.cbmc_answers import Answer
from keel.judge.harness import read_harness
from keel.judge.settings import Exceptions
from keel.mutate import execution as mutant_execution
from keel.mutate.execution import Executions, Kill, Sample, numbers_in
from keel.mutate.harnesses import survey
from keel.mutate.mutation import BY_CBMC, BY_WP, Tools, Trial
from keel.mutate.operators import Mutant
from keel.mutate.seeds import DRAWS, USUAL, inputs_in
from keel.mutate.trees import Trees
from keel.mutate.verdicts import EXECUTED, Verdict, table
from keel.prove.times import Times

ROOT = Path(__file__).resolve().parents[2]

BODY = "*box = value;"
HARNESS = """\
// covers: keel_box_put
#include "keel/rtos/box.h"

int nondet_int(void);

static int calls;

void keel_box_put_harness(void)
{
    const int value = nondet_int();
    int box = 3;

    calls++;
    __CPROVER_assert(calls == 1, "BOX_000: an execution leaves nothing to the next");
    __CPROVER_assume((value >= 0) && (value < 1000));

    keel_box_put(&box, value);

    __CPROVER_assert(box == value, "BOX_001: it holds the value");
}
"""

BOXES = """\
typedef struct {
    int value[10];
} boxes_t;

boxes_t nondet_boxes(void);
"""


@unittest.skipUnless(shutil.which("clang-19"), "needs clang 19")
class ExecutionCase(TreeTest):
    """A project with one harness that can be executed."""

    def setUp(self) -> None:
        super().setUp()
        searches = ("-runs=2000", *mutant_execution.SEARCH[1:])
        fewer = mock.patch.multiple(mutant_execution, SEARCH=searches, INPUTS=2000)
        fewer.start()
        self.addCleanup(fewer.stop)
        self.scratch = Path(tempfile.mkdtemp(dir=self.root.parent, prefix="scratch"))
        self.addCleanup(shutil.rmtree, self.scratch, True)
        self.write(HARNESS)

    def write(self, text: str) -> None:
        """Another harness."""
        (self.unit.folder / "keel_box_put_harness.c").write_text(text, encoding="utf-8")

    def runner(self, folder: Path) -> Runner:
        return Runner(dict(os.environ), folder)

    def executions(self, seeds: Callable[[], Any] | None = None) -> Executions:
        return Executions(
            self.unit,
            ("clang-19",),
            "19",
            survey(self.root),
            self.scratch,
            Cache(self.root / "inputs"),
            lambda: self.runner(self.root),
            seeds,
        )

    def mutant(self, body: str) -> Mutant:
        start = SOURCE.index(BODY)
        return Mutant(
            self.unit.source, "keel_box_put", "x", start, start + len(BODY), body, 15, BODY, body
        )

    def kill(self, body: str, made: Executions | None = None) -> Kill | None:
        """What executions say of another body."""
        made = made or self.executions()
        mutant = self.mutant(body)
        harness = read_harness(self.unit, self.unit.folder / "keel_box_put_harness.c")
        with Trees(self.root, self.scratch, 1).with_mutant(mutant, self.root) as tree:
            return made.kills(mutant, [harness], tree, self.runner(tree))


class Executing(ExecutionCase):
    """What executions say of other bodies."""

    def test_a_wrong_body_is_killed_by_its_harness_and_assertion(self) -> None:
        kill = self.kill("*box = value + 1;")
        assert kill
        self.assertEqual(kill.text, "BOX_001: it holds the value")
        self.assertEqual(
            kill.said,
            "killed: keel_box_put_harness: BOX_001: it holds the value"
            f" (executed, input {kill.number})",
        )
        self.assertEqual(len(kill.values), 1)
        self.assertLess(int(kill.values[0], 16), 1000)

    def test_the_same_input_kills_again(self) -> None:
        first, second = self.kill("*box = value & 3;"), self.kill("*box = value & 3;")
        assert first and second
        self.assertEqual(first, dataclasses.replace(second, harness=first.harness))

    def test_the_body_itself_is_not_killed(self) -> None:
        self.assertIsNone(self.kill("*box = value + 0;"))

    def test_what_an_assumption_excludes_shows_nothing(self) -> None:
        self.assertIsNone(self.kill("*box = (value < 1000) ? value : 0;"))
        self.assertIsNotNone(self.kill("*box = (value < 999) ? value : 0;"))

    def test_a_hang_is_no_kill(self) -> None:
        self.assertIsNone(self.kill("while (value >= 0) { *box = 4; }"))

    def test_but_another_input_may_kill_what_hangs(self) -> None:
        kill = self.kill("while (value > 100) { *box = 4; } *box = 1;")
        self.assertTrue(kill is None or int(kill.values[0], 16) <= 100)

    def test_a_crash_is_no_kill(self) -> None:
        for body in (
            "*(volatile int *)(value - value) = 1;",
            "*box = value / (value - value);",
            "box[value + 4] = 1;",
            "*box = value; *box = 2147483647 + value + 1;",
            "*box = 1 << (value + 40);",
        ):
            with self.subTest(body):
                self.assertIsNone(self.kill(body))

    def test_what_does_not_compile_is_no_kill(self) -> None:
        self.assertIsNone(self.kill("*box = ;"))

    def test_a_harness_that_fails_unchanged_is_not_used_and_told(self) -> None:
        self.write(HARNESS.replace("box == value", "box == 5"))
        made = self.executions()
        self.assertIsNone(self.kill("*box = 4;", made))
        self.assertIn("unchanged", made.failing["keel_box_put_harness"])

    def test_nor_is_one_whose_end_is_reached_by_nothing(self) -> None:
        self.write(HARNESS.replace("value < 1000", "value < 0"))
        made = self.executions()
        self.assertIsNone(self.kill("*box = 4;", made))
        self.assertIn("reaches its end", made.failing["keel_box_put_harness"])

    def stand_in(self, called_from: str, linkage: str = "") -> None:
        """A harness with a stand-in for a function of a linkage that is called from a file."""
        models = self.root / "specs" / "model"
        models.mkdir(parents=True, exist_ok=True)
        twice = f"{linkage}int twice(int a)\n{{\n    return a + a;\n}}\n"
        other = f"{linkage}int twice(int a);\n\nint same(int a)\n{{\n    return twice(a) - a;\n}}\n"
        (models / "twice.c").write_text(twice, encoding="utf-8")
        (models / called_from).open("a", encoding="utf-8").write(other)
        source = self.unit.source.relative_to(self.root)
        files = " ".join(sorted({"specs/model/twice.c", f"specs/model/{called_from}"}))
        stand_in = """\
int same(int a);
static bool told;

int twice_stand_in(int a)
{
    told = true;
    return a + a;
}

void keel_box_put_harness"""
        text = HARNESS.replace("void keel_box_put_harness", stand_in)
        text = text.replace("#include", "#include <stdbool.h>\n#include", 1)
        text = text.replace("box == value,", "(box == same(value)) && told,")
        self.write(f"// sources: {source} {files}\n// replaces: twice\n{text}")

    def test_a_stand_in_is_executed_in_the_place_of_its_function(self) -> None:
        self.stand_in("other.c")
        made = self.executions()
        self.assertIsNotNone(self.kill("*box = 4;", made))
        self.assertEqual(made.failing, {})
        self.assertIsNone(self.kill("*box = value + 0;"))

    def test_also_where_its_own_file_calls_it(self) -> None:
        self.stand_in("twice.c")
        made = self.executions()
        self.assertIsNotNone(self.kill("*box = 4;", made))
        self.assertEqual(made.failing, {})
        self.assertIsNone(self.kill("*box = value + 0;"))

    def test_but_not_a_static_one_of_its_own_file(self) -> None:
        self.stand_in("twice.c", "static ")
        made = self.executions()
        self.assertIsNone(self.kill("*box = 4;", made))
        self.assertEqual(made.failing, {})

    def test_what_nobody_calls_may_call_what_is_not_there(self) -> None:
        source = SOURCE + "\nint absent(int a);\nint idle(int a);\n"
        source += "int idle(int a)\n{\n    return absent(a);\n}\n"
        self.unit.source.write_text(source, encoding="utf-8")
        made = self.executions()
        self.assertIsNotNone(self.kill("*box = 4;", made))
        self.assertEqual(made.failing, {})

    def test_what_no_search_finds_is_executed_when_it_is_said(self) -> None:
        rare = "(((unsigned)value * 2654435761u) == 3735928559u)"
        self.write(HARNESS.replace("(value >= 0) && (value < 1000)", rare))
        made = self.executions()
        self.assertIsNone(self.kill("*box = 4;", made))
        self.assertIn("reaches its end", made.failing["keel_box_put_harness"])

        value = 3735928559 * pow(2654435761, -1, 1 << 32) % (1 << 32)
        told = mock.Mock()
        told.of.return_value = inputs_in(answered([value]))
        kill = self.kill("*box = 4;", self.executions(lambda: told))
        assert kill
        self.assertEqual(int(kill.values[0], 16), value)

    def test_where_nothing_is_arbitrary_one_execution_is_all(self) -> None:
        self.write(HARNESS.replace("= nondet_int()", "= 7"))
        kill = self.kill("*box = 8;")
        assert kill
        self.assertEqual((kill.number, kill.values), (0, ()))

    def test_structures_are_filled_field_by_field(self) -> None:
        self.write(
            HARNESS.replace(
                "static int calls;",
                """\
typedef struct { float x[3]; bool yes; int *p; uint8_t n; } part_t;
part_t nondet_part(void);
static int calls;""",
            )
            .replace('#include "', '#include <stdbool.h>\n#include <stdint.h>\n#include "')
            .replace(
                "int box = 3;",
                """\
int box = 3;
const part_t part = nondet_part();
__CPROVER_assert((part.p == 0) && ((part.yes == 0) || (part.yes == 1)), "BOX_002: as it is");
__CPROVER_assume(part.n == 200u);""",
            )
        )
        kill = self.kill("*box = 1001;")
        assert kill
        self.assertEqual((len(kill.values), kill.values[5]), (6, "0xC8"))
        self.assertIn(kill.values[4], ("0x0", "0x1"))

    def test_inputs_are_kept_until_the_harness_changes(self) -> None:
        self.assertIsNotNone(self.kill("*box = 1001;"))
        kept = list((self.root / "inputs").iterdir())
        self.assertEqual(len(kept), 1)
        with mock.patch.object(Executions, "_searched", side_effect=AssertionError("searched")):
            self.assertIsNotNone(self.kill("*box = 1001;"))
            self.write(HARNESS + "/* a remark */\n")
            self.assertIsNotNone(self.kill("*box = 1001;"))
            self.write(HARNESS.replace("int box = 3", "int box = 4"))
            with self.assertRaises(AssertionError):
                self.kill("*box = 1001;")


def answered(values: list[int]) -> str:
    """What CBMC 6.6.0 prints of a test that it found; of the fields, those that are read.

    The values are the first ones drawn. Behind them it leaves all as it is usual.
    """
    told = [value ^ usual for value, usual in zip(values, USUAL, strict=False)]
    elements = [
        {"index": place, "value": {"binary": f"{value:064b}", "width": 64}}
        for place, value in enumerate([*told, *[0] * (DRAWS - len(told))])
    ]
    table_ = {"members": [{"name": "value", "value": {"elements": elements}}]}
    test = {"coveredGoals": ["f.coverage.1"], "inputs": [{"id": "keel_run_seed", "value": table_}]}
    return json.dumps([{"program": "CBMC"}, {"tests": [test]}])


class Seeding(unittest.TestCase):
    """What is read of an answer of CBMC."""

    def test_each_value_stands_in_a_slot_behind_the_first(self) -> None:
        [found] = inputs_in(answered([7, 0xFEDCBA9876543210]))
        slots = [int.from_bytes(found[place : place + 8], "little") for place in (0, 8, 16, 24)]
        self.assertEqual(slots, [0xFF, 0x7FF, 0xDCBA9876543210FF, USUAL[2] << 8 | 0xFF])
        self.assertEqual(len(found), 8 * (1 + DRAWS))

    def test_what_does_not_matter_is_not_zero_and_differs(self) -> None:
        self.assertGreater(len(set(USUAL)), DRAWS // 2)
        self.assertLess(USUAL.count(0), 3)

    def test_an_answer_that_breaks_off_says_nothing(self) -> None:
        whole = answered([7])
        for text in ("", "[]", whole[:-9], "cbmc: not found", json.dumps([{"tests": []}])):
            self.assertEqual(inputs_in(text), [])


class Checker:
    """CBMC that says the same of every execution."""

    def __init__(self, answer: Answer) -> None:
        self.answer = answer
        self.text = ""
        self.options: tuple[str, ...] = ()

    def build(self, harness: Any, _name: str) -> tuple[Path, str]:
        self.text = harness.path.read_text(encoding="utf-8")
        return harness.path, ""

    def check(self, harness: Any, _binary: Path, *_: object) -> Answer:
        self.options = harness.options
        return self.answer


def answer(status: str, complete: bool = True) -> Answer:
    """What CBMC says of the assertion."""
    said = {"name": "f.assertion.1", "description": "BOX_001: it holds the value", "status": status}
    return Answer([said], [], [], complete)


class Confirming(ExecutionCase):
    """A trial that executes, and CBMC that agrees or does not."""

    def trial(self, every: int = 50) -> Trial:
        tools = Tools(
            (),
            ("goto-cc",),
            ("cbmc",),
            ("gcc",),
            dict(os.environ),
            self.scratch,
            self.scratch / "a",
            self.scratch / "v",
            ("clang-19",),
            "19",
            self.root / "inputs",
        )
        return Trial(
            self.unit,
            tools,
            Trees(self.root, self.scratch, 1),
            ("cbmc", "wp"),
            False,
            Cache(self.root / "cache"),
            {"tool": "t", BY_CBMC: "1", BY_WP: "1", "driver": "d"},
            Exceptions(),
            Times(self.root / "times.json"),
            confirm=every,
        )

    def tried(self, trial: Trial, body: str, said: Answer) -> tuple[Verdict, Checker]:
        checker = Checker(said)
        others = mock.Mock(return_value="survived")
        with (
            mock.patch.object(Trial, "_compare", lambda *_: None),
            mock.patch.object(Trial, "_checker", lambda *_: checker),
            mock.patch.object(Trial, "_killed_by_small", lambda *_: False),
            mock.patch.object(Trial, "_by_cbmc", others),
            mock.patch.object(Trial, "_by_wp", others),
        ):
            return trial.try_mutant(self.mutant(body)), checker

    def test_cbmc_is_shown_the_values_and_confirms(self) -> None:
        trial = self.trial()
        verdict, checker = self.tried(trial, "*box = 1001;", answer("FAILURE"))
        self.assertEqual(verdict.status, "killed")
        self.assertIn(EXECUTED, verdict.engines["cbmc"])
        self.assertIn("keel_run_values[] = {0x", checker.text)
        self.assertEqual((trial.sample.executed, trial.sample.confirmed), (1, 1))
        self.assertIn("1 by executions of its harnesses", table([verdict], ("cbmc",))[0])

    def test_cbmc_has_the_bound_of_the_harness_and_needs_no_solver(self) -> None:
        self.write("// cbmc: --unwind 7 --external-sat-solver cadical\n" + HARNESS)
        _, checker = self.tried(self.trial(), "*box = 1001;", answer("FAILURE"))
        self.assertEqual(checker.options, ("--unwind", "7"))

    def test_the_bound_of_the_harness_is_not_that_of_loops_that_draw(self) -> None:
        drawn = HARNESS.replace("int nondet_int(void);", BOXES).replace(
            "const int value = nondet_int();", "const int value = nondet_boxes().value[9];"
        )
        self.write("// cbmc: --unwind 7\n" + drawn)
        _, checker = self.tried(self.trial(), "*box = 1001;", answer("FAILURE"))
        loops = f"nondet_boxes.0:{mutant_execution.FILLED}"
        self.assertEqual(checker.options, ("--unwind", "7", "--unwindset", loops))

    def test_a_kill_is_kept_under_its_harness(self) -> None:
        trial = self.trial()
        verdict, _ = self.tried(trial, "*box = 1001;", answer("FAILURE"))
        trial.keep(verdict)
        known = self.trial().known(self.mutant("*box = 1001;"))
        assert known
        self.assertEqual(known.engines, verdict.engines)

    def test_a_contradiction_is_no_kill_and_fails(self) -> None:
        trial = self.trial()
        verdict, _ = self.tried(trial, "*box = 1001;", answer("SUCCESS"))
        self.assertEqual(verdict.status, "undecided")
        self.assertTrue(verdict.engines["cbmc"].startswith("contradiction"))
        self.assertEqual(len(trial.sample.contradictions), 1)
        trial.keep(verdict)
        self.assertIsNone(self.trial().known(self.mutant("*box = 1001;")))

    def test_without_an_answer_the_next_one_is_confirmed(self) -> None:
        trial = self.trial()
        self.tried(trial, "*box = 1001;", answer("SUCCESS", complete=False))
        self.assertEqual((trial.sample.confirmed, trial.sample.contradictions), (0, []))
        self.tried(trial, "*box = 1002;", answer("FAILURE"))
        self.assertEqual(trial.sample.confirmed, 1)

    def test_cbmc_is_asked_about_the_harness_in_which_an_execution_did_not_end(self) -> None:
        step = {"stepType": "failure", "reason": "pointer outside of object bounds"}
        fails = Answer([], [], [], True, failed=True, trace=[step])
        for body in ("box[value + 4] = 1;", "while (value >= 0) { *box = 4; }"):
            with self.subTest(body):
                trial = self.trial()
                with mock.patch.object(Trial, "_passes_unchanged", lambda *_: True):
                    verdict, _ = self.tried(trial, body, fails)
                said = "killed: keel_box_put_harness: pointer outside of object bounds"
                self.assertEqual((verdict.status, verdict.engines), ("killed", {"cbmc": said}))
                self.assertEqual(trial.sample.executed, 0)
        verdict, _ = self.tried(self.trial(), "box[value + 4] = 1;", answer("SUCCESS"))
        self.assertEqual(verdict.engines, {"cbmc": "survived", "wp": "survived"})

    def test_what_executions_leave_goes_on(self) -> None:
        verdict, _ = self.tried(self.trial(), "*box = value + 0;", answer("SUCCESS"))
        self.assertEqual(
            (verdict.status, verdict.engines), ("survived", {"cbmc": "survived", "wp": "survived"})
        )

    def test_the_sample_is_the_first_and_one_of_so_many(self) -> None:
        sample = Sample(3)
        taken = []
        for number in range(8):
            if sample.takes():
                taken.append(number)
                sample.heard(True, "")
        self.assertEqual(taken, [0, 3, 6])


class Numbers(unittest.TestCase):
    def test_numbers_of_code_are_found_and_no_others(self) -> None:
        text = "#define A 32u\nfloat b1 = 1.5e-3f; /* 99 */ int c = 0x10 + x2 + 7; // 3\n"
        self.assertEqual(numbers_in([text]), ["0.0015", "7.0", "16.0", "32.0"])
