# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel mutate: the mutants, their names, and what becomes of survivors.

No prover is run; the last class needs a host compiler and is skipped without one.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import shutil
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

from keel.base.verdict_cache import Cache
from keel.c.project import ProjectError, Unit
from keel.engines import wp
from keel.judge import wp_targets
from keel.judge.settings import Exceptions
from keel.mutate import command as mutate
from keel.mutate import mutation
from keel.mutate import verdicts as mutant_verdicts
from keel.mutate.mutation import Tools, Trial
from keel.mutate.operators import Mutant, mutants
from keel.mutate.trees import Trees
from keel.mutate.verdicts import Verdict
from keel.prove.times import Times

ROOT = Path(__file__).resolve().parents[2]

HEADER = """\
#include <stdbool.h>
/*@ assigns \\nothing;
  @ ensures BOX_001: \\result <==> a < 3;
  @*/
static inline bool keel_box_small(int a)
{
    return a < 3; /* less than 3 */
}
"""


def made(body: str, result: str = "void") -> list[Mutant]:
    """The mutants of a function with this body."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "f.c"
        end = "}\n" * (1 + body.count("{") - body.count("}"))
        text = f"static {result} f(int a, int *p)\n{{\n    {body}\n{end}"
        path.write_text(text, encoding="utf-8")
        return mutants(path)


def results(body: str, result: str = "void", kind: str = "") -> list[str]:
    """What the mutants make of a line."""
    return [mutant.after for mutant in made(body, result) if kind in ("", mutant.kind)]


class Generation(unittest.TestCase):
    def test_relations_get_their_boundary_and_their_opposite(self) -> None:
        self.assertEqual(results("g(a < b);", kind="relation"), ["g(a <= b);", "g(a >= b);"])
        self.assertEqual(results("g(a == b);", kind="relation"), ["g(a != b);"])

    def test_arithmetic(self) -> None:
        self.assertEqual(results("p[0] = a + b;", kind="arithmetic"), ["p[0] = a - b;"])
        self.assertEqual(results("a++;", kind="arithmetic"), ["a--;"])

    def test_signs_pointers_and_arrows_are_no_arithmetic(self) -> None:
        for body in ("*p = -1;", "p->x = y;", "return (-a);"):
            with self.subTest(body):
                self.assertEqual(results(body, kind="arithmetic"), [])

    def test_constants_move_by_one_and_to_zero(self) -> None:
        self.assertEqual(results("a = 5u;", kind="constant"), ["a = 0u;", "a = 4u;", "a = 6u;"])
        self.assertEqual(results("a = 0x10;", kind="constant"), ["a = 0;", "a = 15;", "a = 17;"])
        moved = ["a = (KEEL_X + 1u);", "a = (KEEL_X - 1u);"]
        self.assertEqual(results("a = KEEL_X;", kind="constant"), moved)
        self.assertEqual(results("a = KEEL_OK;", kind="constant"), [])

    def test_conditions_are_negated_unless_a_relation_does_it(self) -> None:
        found = results("if ((a < b) && c) {", kind="condition")
        self.assertEqual(found, ["if (!((a < b) && c)) {"])
        self.assertEqual(results("if (a < b) {", kind="condition"), [])
        self.assertEqual(results("a = c ? 1 : 2;", kind="condition"), ["a = !(c) ? 1 : 2;"])
        self.assertEqual(results("if (!c) {", kind="negation"), ["if (c) {"])

    def test_statements_are_left_out(self) -> None:
        for body in ("a = 1;", "a++;", "g(a);", "p->x = a;", "*p = 3;"):
            with self.subTest(body):
                self.assertEqual(results(body, kind="deletion"), [";"])

    def test_declarations_returns_and_loop_headers_are_not_left_out(self) -> None:
        for body in (
            "int b = 1;",
            "const int c = 2;",
            "return;",
            "unit_t *const q = p;",
            "for (i = 0; f(i) < 3; i++) {",
        ):
            with self.subTest(body):
                self.assertEqual(results(body, kind="deletion"), [])

    def test_results_of_the_same_type(self) -> None:
        self.assertEqual(results("return true;", "bool", "result"), ["return false;"])
        self.assertEqual(results("return q;", "box_t *", "result"), ["return NULL;"])
        self.assertEqual(
            results("return KEEL_OK;", "keel_status_t", "result"), ["return KEEL_ERR_STATE;"]
        )
        self.assertEqual(
            results("return a;", "uint32_t", "result"), ["return (a) + 1u;", "return 0u;"]
        )

    def test_comments_and_annotations_are_left_alone(self) -> None:
        self.assertEqual(results("/* a < 3 */ //@ assert a < 3;\n"), [])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "box.h"
            path.write_text(HEADER, encoding="utf-8")
            for mutant in mutants(path):
                changed = mutant.apply(HEADER)
                self.assertEqual(changed.partition("{")[0], HEADER.partition("{")[0])
                self.assertIn("/* less than 3 */", changed)

    def test_a_mutant_keeps_its_name_when_it_moves(self) -> None:
        names = {mutant.identity for mutant in made("a = 1;\n    if (a < 2) {\n    }")}
        moved = {mutant.identity for mutant in made("\n\n    a = 1;\n    if (a < 2) {\n    }")}
        self.assertEqual(names, moved)

    def test_equal_lines_are_told_apart(self) -> None:
        names = [mutant.identity for mutant in made("a++;\n    a++;")]
        self.assertEqual(len(names), len(set(names)))


def verdict(status: str, body: str = "a++;") -> Verdict:
    """A verdict on some mutant."""
    return Verdict(made(body)[0], status)


class Settling(unittest.TestCase):
    def accepted(self, text: str) -> dict[mutant_verdicts.Identity, str]:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "equivalent.toml"
            path.write_text(text, encoding="utf-8")
            return mutant_verdicts.read_equivalent(path)

    entry = '[[equivalent]]\nfunction = "f"\noriginal = "a++;"\nmutant = ";"\nreason = "{}"\n'

    def test_a_reason_explains_a_survivor(self) -> None:
        survivor = verdict("survived")
        reasons = self.accepted(self.entry.format("nobody reads it"))
        self.assertEqual(mutant_verdicts.settle([survivor], reasons, True), [])
        self.assertEqual((survivor.status, survivor.reason), ("equivalent", "nobody reads it"))

    def test_a_reason_for_what_is_killed_must_go(self) -> None:
        reasons = self.accepted(self.entry.format("no matter"))
        [problem] = mutant_verdicts.settle([verdict("killed")], reasons, True)
        self.assertIn("needless", problem)

    def test_a_reason_for_no_mutant_must_go(self) -> None:
        reasons = self.accepted(self.entry.format("no matter").replace("a++", "b++"))
        [problem] = mutant_verdicts.settle([verdict("killed")], reasons, True)
        self.assertIn("there is no such mutant", problem)
        self.assertEqual(mutant_verdicts.settle([verdict("killed")], reasons, False), [])

    def test_a_reason_must_be_given(self) -> None:
        for text in (self.entry.format(" "), self.entry.format("x").replace("reason", "because")):
            with self.subTest(text), self.assertRaises(ProjectError):
                self.accepted(text)

    def conclude(self, *verdicts: Verdict, problems: tuple[str, ...] = ()) -> tuple[int, str]:
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            status = mutate.conclude(verdicts, problems, ("cbmc",))
        return status, output.getvalue().splitlines()[-1]

    def test_a_survivor_without_reason_fails(self) -> None:
        last = "killed 1 of 2 mutants (0 equivalent), 1 survived unexplained"
        self.assertEqual(self.conclude(verdict("killed"), verdict("survived")), (1, last))

    def test_a_mutant_that_is_undecided_is_not_killed_and_fails(self) -> None:
        last = "killed 1 of 2 mutants (0 equivalent), 0 survived unexplained, 1 undecided"
        self.assertEqual(self.conclude(verdict("killed"), verdict("undecided")), (1, last))

    def test_a_reason_explains_what_is_undecided(self) -> None:
        undecided = verdict("undecided")
        reasons = self.accepted(self.entry.format("nobody reads it"))
        self.assertEqual(mutant_verdicts.settle([undecided], reasons, True), [])
        self.assertEqual(undecided.status, "equivalent")

    def test_a_mutant_that_was_not_tried_fails(self) -> None:
        last = "killed 1 of 2 mutants (0 equivalent), 0 survived unexplained, 1 not tried"
        self.assertEqual(self.conclude(verdict("killed"), verdict("skipped")), (1, last))

    def test_all_killed_or_explained_is_success(self) -> None:
        verdicts = (verdict("killed"), verdict("equivalent"), verdict("stillborn"))
        last = "killed 1 of 2 mutants (1 equivalent), 0 survived unexplained"
        self.assertEqual(self.conclude(*verdicts), (0, last))
        self.assertEqual(self.conclude(*verdicts, problems=("x",))[0], 1)


def verdict_by(mutant: Mutant, **engines: str) -> mutant_verdicts.Verdict:
    """A verdict with what the engines said."""
    return mutant_verdicts.Verdict(mutant, engines=engines)


class Limits(unittest.TestCase):
    def test_limits_follow_the_times_of_the_proof(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for name, prover, seconds in (("a", "Alt-Ergo:2.0.0", 0.1), ("b", "CVC4:1.8", 4.0)):
                answer = {"prover": prover, "verdict": "valid", "time": seconds}
                (Path(folder) / f"{name}.json").write_text(json.dumps(answer), encoding="utf-8")
            goals = [{"prover": "Qed"}, {"prover": "Alt-Ergo 2.0.0"}, {"prover": "CVC4 1.8"}]
            stages = mutation.limits(wp_targets.Result(goals=goals), Path(folder))
        names = ("alt-ergo", "cvc4")
        self.assertEqual(stages, (wp.Stage(names, 12), wp.Stage(names, 12, pruning=True)))


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Trials(unittest.TestCase):
    """Mutants that need no prover, and the tree that must not change."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve() / "project"
        scratch = self.root.parent / "scratch"
        header = self.root / "include" / "keel" / "rtos" / "box.h"
        for path in (header.parent, self.root / "src", self.root / "proofs", scratch):
            path.mkdir(parents=True)
        header.write_text(HEADER, encoding="utf-8")
        self.unit = Unit(self.root, "rtos", "box")
        environment = {"PATH": os.environ["PATH"]}
        tools = Tools(
            (), (), (), ("gcc",), environment, scratch, scratch / "answers", scratch / "verdicts"
        )
        trees = Trees(self.root, scratch, 1)
        self.trial = Trial(
            self.unit,
            tools,
            trees,
            (),
            False,
            Cache(None),
            {},
            Exceptions(),
            Times(scratch / "times.json"),
        )

    def status(self, replacement: str) -> str:
        """What becomes of the header with something else for `a < 3`."""
        start = HEADER.rindex("a < 3")
        mutant = Mutant(
            self.unit.header,
            "keel_box_small",
            "x",
            start,
            start + len("a < 3"),
            replacement,
            1,
            "",
            "",
        )
        found = self.trial.try_mutant(mutant).status
        self.assertEqual(self.unit.header.read_text(encoding="utf-8"), HEADER)
        return found

    def test_the_same_object_code_is_equivalent(self) -> None:
        self.assertEqual(self.status("a <= 2"), "equivalent")

    def test_what_does_not_compile_is_stillborn(self) -> None:
        self.assertEqual(self.status("a <"), "stillborn")
        self.assertEqual(self.status("keel_box_small((int *)0)"), "stillborn")

    def test_what_nobody_notices_survives(self) -> None:
        self.assertEqual(self.status("a < 4"), "survived")

    def test_where_wp_proved_nothing_before_it_is_asked_again(self) -> None:
        mutant = Mutant(self.unit.header, "keel_box_small", "x", 0, 1, "", 1, "", "")
        runner: Any = None
        self.trial._stages["keel_box_small"] = ()
        answer = self.trial._by_wp(mutant, self.unit, runner)
        self.assertFalse(verdict_by(mutant, wp=answer).is_lasting)
        self.assertTrue(verdict_by(mutant, wp="survived").is_lasting)
        self.assertTrue(verdict_by(mutant, cbmc="killed: x").is_lasting)


class Asked:
    """WP that proves within the given stages, or not at all, and notes what it was asked."""

    def __init__(self, proves: tuple[tuple[wp.Stage, ...], ...]) -> None:
        self.proves = proves
        self.asked: list[tuple[wp.Stage, ...]] = []

    def first_problem(
        self, _target: wp_targets.Target, stages: tuple[wp.Stage, ...], _: object
    ) -> str:
        self.asked.append(stages)
        return "" if stages in self.proves else "f_ensures"


class Patience(Trials):
    short = (wp.Stage(("alt-ergo",), 2),)

    def ask(self, patient: bool, *proves: tuple[wp.Stage, ...]) -> tuple[str, int]:
        """What a trial makes of WP's answers, and how often it asked."""
        prover: Any = Asked(proves)
        self.trial._patient = patient
        target = wp_targets.Target(self.unit, self.unit.header, "keel_box_small")
        return self.trial._asked(prover, target, self.short), len(prover.asked)

    def test_what_only_takes_longer_survives_and_from_then_on_all_get_the_full_limits(self) -> None:
        self.assertEqual(self.ask(True, wp.THOROUGH), ("survived", 2))
        self.assertEqual(len(self.trial.late.contradictions), 1)
        self.assertEqual(self.ask(True), ("killed: f_ensures", 2))
        self.assertEqual(self.ask(True, wp.THOROUGH), ("survived", 2))

    def test_one_in_fifty_that_short_limits_do_not_prove_gets_the_full_ones(self) -> None:
        said = [self.ask(True) for _ in range(51)]
        self.assertEqual([number for number, one in enumerate(said) if one[1] == 2], [0, 50])
        self.assertEqual(said[0][0], "killed: f_ensures")
        self.assertEqual(said[1], (f"killed: f_ensures{mutation.SHORTLY}", 1))
        self.assertEqual((self.trial.late.executed, self.trial.late.confirmed), (51, 2))

    def test_what_is_proved_at_once_is_not_asked_twice(self) -> None:
        self.assertEqual(self.ask(True, self.short), ("survived", 1))

    def test_without_the_full_limits_nothing_is_killed(self) -> None:
        answer = f"{mutation.UNDECIDED}: f_ensures"
        self.assertEqual(self.ask(False, wp.THOROUGH), (answer, 1))


class CommandLine(unittest.TestCase):
    def test_an_unknown_unit_is_named_with_those_there_are(self) -> None:
        error = io.StringIO()
        with contextlib.redirect_stderr(error), self.assertRaises(SystemExit) as stopped:
            mutate.parse(["--unit", "kite"], ["box"])
        self.assertEqual(stopped.exception.code, 2)
        self.assertIn("no such unit: kite (there are: box)", error.getvalue())

    def test_what_cannot_be_read_is_no_failed_check(self) -> None:
        error = io.StringIO()
        with (
            mock.patch.object(mutate, "find_units", side_effect=ProjectError("units.toml: no")),
            contextlib.redirect_stderr(error),
        ):
            self.assertEqual(mutate.main([]), 2)
        self.assertEqual(error.getvalue(), "mutate: units.toml: no\n")
