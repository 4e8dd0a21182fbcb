# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel prove: what must make a proof fail does, and only success is remembered.

No prover is run: the engines are played by small scripts that print what the real ones print.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any
from unittest import mock

from waiting import WAIT_S, wait_for

from keel.audit import completeness, theorems
from keel.base.files import write_text
from keel.base.jobs import Finished, Runner, in_pool
from keel.base.verdict_cache import Cache
from keel.c import source as csource
from keel.c.project import KEEL, ProjectError, Unit, closure, find_units
from keel.c.syntax import SyntaxProblem
from keel.engines import cbmc, wp
from keel.install import Toolchain, ToolchainError
from keel.judge import cbmc_answers, harness, settings, wp_targets
from keel.judge import wp_log as wplog
from keel.judge import wp_verdict as verdict
from keel.judge import wrong_bodies as wrong
from keel.judge.cbmc_answers import read_answer, refutation_problems
from keel.prove import command as prove
from keel.prove import driver, exports, job_list, report
from keel.prove.proof_run import Choice, Session
from keel.prove.times import Times

ROOT = Path(__file__).resolve().parents[2]

HEADER = """\
#ifndef KEEL_RTOS_BOX_H
#define KEEL_RTOS_BOX_H
#include "keel/status.h"
/** Puts a value into a box. */
/*@ requires \\valid(box);
  @ assigns *box;
  @ ensures BOX_001: *box == value;
  @*/
void keel_box_put(int *box, int value);
#endif
"""
SOURCE = """\
#include "keel/rtos/box.h"

/* Counts { for nothing. */
static int helper(int limit)
{
    int i = 0;
    while (i < limit) {
        i++;
    }
    return i;
}

void keel_box_put(int *box, int value)
{
    *box = value;
}
"""
HARNESS = """\
// cbmc: --unwind 3 --external-sat-solver cadical
// covers: keel_box_put
#include "keel/rtos/box.h"

void keel_box_put_harness(void)
{
    int box;
    keel_box_put(&box, 7);
    __CPROVER_assert(box == 7, "BOX_001: it holds the value");
}
"""
WRONG = """\
# Faults that the harness must notice.

[[wrong]]
name = "zero"
description = "It forgets the value."
harness = "keel_box_put_harness"
expect = ["BOX_001"]

[[wrong.replace]]
old = "*box = value;"
new = "*box = 0;"
"""
# One more, to stand behind it or before it.
OTHER = """
[[wrong]]
name = "one"
description = "It puts in a one."
harness = "keel_box_put_harness"
expect = ["BOX_001"]

[[wrong.replace]]
old = "*box = value;"
new = "*box = 1;"
"""


def make_tree(root: Path) -> Unit:
    """A project with one unit."""
    files = {
        "include/keel/status.h": "/* status */\n",
        "include/keel/rtos/box.h": HEADER,
        "src/rtos/box.c": SOURCE,
        "proofs/box/keel_box_put_harness.c": HARNESS,
        "proofs/box/wrong.toml": WRONG,
    }
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return find_units(root)["box"]


class TreeTest(unittest.TestCase):
    """A test with a project of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        self.unit = make_tree(self.root)


class CSource(unittest.TestCase):
    def test_functions_are_found_with_their_bodies(self) -> None:
        found = csource.functions(SOURCE)
        self.assertEqual(
            [(f.name, f.line, f.static) for f in found],
            [("helper", 4, True), ("keel_box_put", 13, False)],
        )
        self.assertIn("*box = value;", csource.body_of(SOURCE, "keel_box_put"))
        self.assertEqual([f.body for f in csource.functions(HEADER)], [None])

    def test_comments_and_literals_do_not_confuse(self) -> None:
        text = "int f(void)\n{\n    return g(\"/* } */\", '{');\n}\n\nint h(void)\n{\n}\n"
        self.assertEqual([f.name for f in csource.defined(text)], ["f", "h"])

    def test_loops_are_counted_once(self) -> None:
        body = "{ for (;;) { while (x) { } do { } while (y); } }"
        self.assertEqual(csource.loops(body), 3)

    def test_ghost_functions_are_proved_and_their_loops_must_end(self) -> None:
        text = (
            "/*@ ghost\n/@ ensures \\true; @/\nstatic void lemma(int n)\n{\n"
            "    /@ loop variant n; @/\n    while (n > 0) {\n        n--;\n    }\n}\n*/\n"
            "int f(void)\n{\n    //@ ghost lemma(1);\n    return 1;\n}\n"
        )
        opened = csource.with_ghosts(text)
        self.assertEqual([f.name for f in csource.defined(text)], ["f"])
        self.assertEqual([f.name for f in csource.proved(text)], ["lemma", "f"])
        self.assertEqual([f.line for f in csource.proved(text)], [3, 11])
        self.assertEqual(csource.loops(csource.body_of(opened, "lemma")), 1)
        self.assertEqual(len(opened), len(text))

    def test_a_loop_in_a_ghost_of_one_line_is_counted(self) -> None:
        text = "int f(void)\n{\n    //@ ghost while (n > 0) n--;\n    return 1;\n}\n"
        body = csource.body_of(csource.with_ghosts(text), "f")
        self.assertEqual(csource.loops(body), 1)
        self.assertEqual(len(csource.with_ghosts(text)), len(text))

    def test_other_bodies_are_removed(self) -> None:
        text = csource.without_other_bodies(SOURCE, frozenset(["keel_box_put"]))
        self.assertNotIn("while", text)
        self.assertIn("*box = value;", text)

    def test_words_that_assume_are_found_in_annotations_alone(self) -> None:
        text = "/* an axiom */\nint check;\n/*@ axiomatic A {\n  @ axiom a: x; } */\n//@ admit x;\n"
        words = [(3, "axiomatic"), (4, "axiom"), (5, "admit")]
        self.assertEqual(csource.forbidden(text), words)
        self.assertEqual(csource.forbidden("/*@ // we check it\n  @ ensures \\true; */"), [])

    def test_includes_in_comments_do_not_count(self) -> None:
        text = '/* #include "a.h" */\n#include "b.h"\n#include <c.h>\n'
        self.assertEqual(csource.includes(text), (("b.h", True), ("c.h", False)))
        with self.assertRaisesRegex(SyntaxProblem, "1: #include NAME: which file"):
            csource.includes("#include NAME\n")

    def test_essence_keeps_literals_and_drops_comments(self) -> None:
        self.assertEqual(
            csource.essence('/*@ x */\nint a; // y\n\nf("//z");\n'), 'int a;\nf("//z");'
        )

    def test_prose_is_dropped_and_every_line_stays(self) -> None:
        self.assertEqual(
            csource.without_prose(
                "/* a\n b */ int x; // y\n/*@ p; // q\n  @ r; */ //\n//@ s; // t\n"
            ),
            "\n int x;\n/*@ p;\n  @ r; */\n//@ s;",
        )

    def test_all_c_of_keel_is_parsed(self) -> None:
        # A type as the argument of a macro, and an attribute behind a macro of the file's own.
        hidden = {"tests/property/lockstep.c", "tests/target/faults.c"}
        folders = ("include", "src", "proofs", "specs/model", "tests", "examples")
        files = [path for name in folders for path in (ROOT / name).rglob("*.[ch]")]
        self.assertGreater(len(files), 200)
        for path in files:
            if str(path.relative_to(ROOT)) in hidden:
                with self.assertRaises(SyntaxProblem):
                    csource.read(path)
            else:
                csource.read(path)

    def test_what_is_no_c_is_an_error_with_file_and_line(self) -> None:
        wrong = {
            "int f(void)\n{\n    return 1 +;\n}\n": 3,
            "int f(void)\n{\n    return 1\n}\nint g(void);\n": 3,
            "int e;\nLIBRARY int f(void);\n": 2,
            "int e;\n/*@ ghost\nvoid f(void)\n{\n    int = 1;\n} */\n": 5,
        }
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "wrong.c"
            for text, line in wrong.items():
                path.write_text(text, encoding="utf-8")
                with self.subTest(text), self.assertRaises(SyntaxProblem) as caught:
                    csource.read(path)
                self.assertIn(f"{path}:{line}: this is no C", str(caught.exception))

    def test_places_do_not_depend_on_what_letters_are_in_comments(self) -> None:
        text = "/* \u00b5s, \u2264 */ int f(void)\n{\n    return 1;\n}\n"
        self.assertEqual(csource.body_of(text, "f"), "{\n    return 1;\n}")

    def test_code_that_knows_a_prover_is_found(self) -> None:
        self.assertEqual(csource.prover_code("#ifdef __FRAMAC__\n#endif\n"), [(1, "__FRAMAC__")])
        self.assertEqual(csource.prover_code("/* __CPROVER */"), [])


def wp_log(*lines: str, function: str = "keel_box_put") -> str:
    """A log of WP about one function."""
    start = (
        "[kernel] Warning: machdep keel_cortex_m7 has no registered macro. Using X",
        "[kernel] Parsing src/rtos/box.c (with preprocessing)",
        f"[rte:annot] annotating function {function}",
    )
    return "\n".join([*start, *lines]) + "\n"


def wp_report(total: int, valid: int, *unproved: str) -> str:
    """A JSON report of WP in the shape of the real one."""
    entries: dict[str, Any] = {name: {"wp:main": {"total": 1, "unknown": 1}} for name in unproved}
    if valid:
        entries["rest"] = {"wp:main": {"total": valid, "valid": valid}}
    entries["wp:section"] = {"wp:main": {"total": total, "valid": valid}}
    return json.dumps(
        {
            "wp:global": {"wp:main": {"total": total, "valid": valid}},
            "wp:functions": {"keel_box_put": entries},
        }
    )


GOOD = (
    "[wp] [Qed] Goal typed_keel_box_put_ensures_BOX_001 : Valid (1ms)",
    "[wp] [Alt-Ergo 2.0.0] Goal typed_keel_box_put_assigns : Valid (Qed:1ms) (8ms) (12)",
    "[wp] [Passed] Smoke-test typed_keel_box_put_wp_smoke_default_requires",
)


class WpVerdict(TreeTest):
    def judge(self, log: str, report: str, allowed: tuple[str, ...] = ()) -> wp_targets.Result:
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_put")
        return verdict.judge(target, log, report, self.root, allowed)

    def assert_fails(self, result: wp_targets.Result, text: str) -> None:
        self.assertTrue(any(text in problem for problem in result.problems), result.problems)

    def test_all_proved_is_success(self) -> None:
        result = self.judge(wp_log(*GOOD), wp_report(3, 3))
        self.assertEqual(result.problems, [])
        self.assertEqual((result.proved, len(result.goals), result.smoke), (2, 2, 1))
        self.assertEqual(result.goals[1]["prover"], "Alt-Ergo 2.0.0")

    def test_a_timeout_is_a_failure_and_names_the_clause(self) -> None:
        log = wp_log(
            "[wp] [Alt-Ergo 2.0.0] Goal typed_keel_box_put_ensures_BOX_001 : Timeout (2s)",
            *GOOD[1:],
            "[wp] [Failed] Goal typed_keel_box_put_ensures_BOX_001",
            "  CVC4 1.8: Unknown (Qed:7ms)",
            "  Alt-Ergo 2.0.0: Timeout (Qed:7ms) (30s)",
        )
        result = self.judge(log, wp_report(3, 2, "keel_box_put_ensures_BOX_001"))
        self.assert_fails(
            result,
            "keel_box_put_ensures_BOX_001 is not proved, provers gave up"
            " (include/keel/rtos/box.h:7)",
        )
        self.assertTrue(result.gave_up)
        self.assert_fails(result, "Alt-Ergo 2.0.0: Timeout, CVC4 1.8: Unknown")

    def test_a_later_stage_may_prove_what_an_earlier_one_did_not(self) -> None:
        log = wp_log(
            "[wp] [Alt-Ergo 2.0.0] Goal typed_keel_box_put_assigns : Timeout (2s)",
            GOOD[0],
            "[wp] [CVC4 1.8] Goal typed_keel_box_put_assigns : Valid (20ms)",
            GOOD[2],
        )
        result = self.judge(log, wp_report(3, 3))
        self.assertEqual(result.problems, [])
        self.assertEqual(result.goals[0]["prover"], "CVC4 1.8")

    def test_a_failed_smoke_test_is_a_failure(self) -> None:
        log = wp_log(
            *GOOD[:2],
            "[wp] [Failed] Smoke-test typed_keel_box_put_wp_smoke_default_requires",
            "       Qed: Valid",
            "[wp] src/rtos/box.c:13: Warning: Failed smoke-test",
        )
        result = self.judge(log, wp_report(3, 2, "keel_box_put_wp_smoke_default_requires"))
        self.assert_fails(result, "smoke test keel_box_put_wp_smoke_default_requires failed")
        self.assert_fails(result, "src/rtos/box.c:13")

    def test_a_warning_of_unsoundness_is_a_failure(self) -> None:
        warnings = (
            "[wp] src/rtos/box.c:13: Warning: Missing assigns clause",
            "[wp] Warning: Missing RTE guards",
            "[kernel:annot:missing-spec] src/rtos/box.c:3: Warning: \n  Neither code nor",
            "[wp] src/rtos/box.c:3: Warning: \n  Cast with incompatible pointers types",
            "[rte] src/rtos/box.c:3: Warning: \n  guaranteed RTE: assert unsigned_overflow",
            "[wp] Warning: Memory model hypotheses for function 'keel_box_put'",
            "[kernel] User Error: cannot find entry point",
            "[kernel] Frama-C aborted: invalid user input.",
        )
        for warning in warnings:
            with self.subTest(warning):
                result = self.judge(wp_log(warning, *GOOD), wp_report(3, 3))
                self.assertEqual(len(result.problems), 1, result.problems)

    def test_an_accepted_warning_is_noted(self) -> None:
        warning = "[wp] src/rtos/box.c:3: Warning: \n  Unknown callee, assigns\n  everything"
        result = self.judge(
            wp_log(warning, *GOOD), wp_report(3, 3), ("callee, assigns everything",)
        )
        self.assertEqual((result.problems, result.allowed), ([], ["callee, assigns everything"]))

    def test_an_error_is_never_harmless(self) -> None:
        error = "[kernel] User Error: has no registered macro"
        self.assert_fails(self.judge(wp_log(error, *GOOD), wp_report(3, 3)), "User Error")

    def test_log_and_report_must_agree(self) -> None:
        self.assert_fails(self.judge(wp_log(*GOOD), wp_report(4, 4)), "do not trust")
        self.assert_fails(self.judge(wp_log(*GOOD), wp_report(3, 2, "x")), "do not trust")
        broken = json.loads(wp_report(3, 3))
        broken["wp:functions"]["keel_box_put"]["rest"]["wp:main"]["valid"] = 1
        self.assert_fails(self.judge(wp_log(*GOOD), json.dumps(broken)), "do not trust")

    def test_a_call_through_a_pointer_has_a_goal_for_each_path(self) -> None:
        point = "[wp] [Qed] Goal typed_keel_box_put_call_point_any_body_s12 : Valid (1ms)"
        log = wp_log(*GOOD, point, point)
        report = json.loads(wp_report(5, 5))
        counts = {"wp:main": {"total": 2, "valid": 2}}
        report["wp:functions"]["keel_box_put"]["keel_box_put_call_point_any_body_s12"] = counts
        result = self.judge(log, json.dumps(report))
        self.assertEqual(result.problems, [])
        self.assertIn("keel_box_put_call_point_any_body", [goal["name"] for goal in result.goals])
        counts["wp:main"]["valid"] = 1
        report["wp:global"]["wp:main"]["valid"] = 4
        self.assertNotEqual(self.judge(log, json.dumps(report)).problems, [])

    def test_without_a_report_nothing_is_proved(self) -> None:
        self.assert_fails(self.judge(wp_log(*GOOD), ""), "wrote no report")

    def test_without_goals_nothing_is_proved(self) -> None:
        self.assert_fails(self.judge(wp_log(), wp_report(0, 0)), "no goal")

    def test_a_function_that_wp_does_not_see_is_a_failure(self) -> None:
        log = wp_log(*GOOD, function="other")
        self.assert_fails(self.judge(log, wp_report(3, 3)), "does not know this function")

    def test_a_loop_without_variant_is_a_failure(self) -> None:
        target = wp_targets.Target(self.unit, self.unit.source, "helper")
        goal = "[wp] [Qed] Goal typed_helper_assigns : Valid (1ms)"
        variant = "[wp] [Qed] Goal typed_helper_loop_variant_decrease : Valid (1ms)"
        without = verdict.judge(target, wp_log(goal, function="helper"), wp_report(1, 1), self.root)
        self.assert_fails(without, "1 loops, but 0 loop variants")
        log = wp_log(goal, variant, function="helper")
        self.assertEqual(verdict.judge(target, log, wp_report(2, 2), self.root).problems, [])
        parts = [variant.replace("decrease", f"decrease_part{number}") for number in (1, 2)]
        log = wp_log(goal, *parts, function="helper")
        self.assertEqual(verdict.judge(target, log, wp_report(3, 3), self.root).problems, [])


class WpRun(TreeTest):
    def prover(self, cache: Path | None = None) -> wp.Wp:
        runner = Runner({}, self.root)
        frama_c = ["frama-c", "-load-script", str(self.root / "m.ml")]
        (self.root / "m.ml").write_text("", encoding="utf-8")
        return wp.Wp(frama_c, runner, self.root, self.root, cache, ["true"])

    def test_each_stage_uses_its_own_provers_only(self) -> None:
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_put")
        command = self.prover().command(target, wp.THOROUGH, True, self.root / "r.json")
        provers = [word for word in command if word.startswith("-wp-prover")]
        # WP asks a prover as often as it was named, so none is named again while it stays.
        self.assertEqual(provers, ["-wp-prover=alt-ergo,cvc4", "-wp-prover=z3"])

    def test_contradictions_are_looked_for_in_functions_where_asked(self) -> None:
        function = wp_targets.Target(self.unit, self.unit.source, "keel_box_put")
        lemmas = wp_targets.Target(self.unit, self.unit.source, None, ("BOX_two",))
        for target, smoke, times in ((function, True, 1), (function, False, 0), (lemmas, True, 0)):
            command = self.prover().command(target, wp.QUICK, smoke, self.root / "r.json")
            [modules] = [command[i + 1] for i, word in enumerate(command) if word == "-load-module"]
            self.assertEqual(modules.count("find_contradictions.cmxs"), times)

    def test_the_script_is_told_function_prover_and_what_is_left(self) -> None:
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_put", left=("BOX_3",))
        with mock.patch.object(Runner, "run", return_value=Finished(0, "")) as run:
            self.prover().prove(target, wp.QUICK)
        self.assertEqual(
            run.call_args.kwargs["extra"],
            {"KEEL_SMOKE": "cvc4 60000 keel_box_put -@ensures -BOX_3"},
        )

    def test_a_script_is_compiled_once_and_a_complaint_ends_the_run(self) -> None:
        prover = self.prover()
        with mock.patch.object(Runner, "run", return_value=Finished(0, "lib")) as run:
            for _ in range(2):
                prover.survey(self.unit.source)
        compiled = [call.args[0] for call in run.call_args_list if "ocamlopt" in call.args[0]]
        self.assertEqual(len(compiled), 2, "the machdep's, and find_assumptions.ml")
        prover = self.prover()
        with mock.patch.object(Runner, "run", return_value=Finished(2, "Unbound module")):
            with self.assertRaisesRegex(ProjectError, "m.ml: Unbound module"):
                prover.survey(self.unit.source)

    def test_where_nothing_is_recorded_all_provers_are_asked_at_once(self) -> None:
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_put", left=frozenset())
        prover = self.prover()
        with mock.patch.object(prover, "_judged") as judged:
            prover._run(target, wp.THOROUGH, True, (), {})
        self.assertIn("-wp-prover=alt-ergo,cvc4,z3", judged.call_args.args[1])

    def test_floats_are_smoked_by_a_prover_that_knows_them(self) -> None:
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_put")
        with self.unit.header.open("a", encoding="utf-8") as stream:
            stream.write("/* No float stands in here. */\n")
        self.assertEqual(wp.smoke_stage(target, self.root), wp.SMOKE, "prose is no code")
        with self.unit.header.open("a", encoding="utf-8") as stream:
            stream.write("typedef struct { float most; } keel_box_limit_t;\n")
        self.assertEqual(wp.smoke_stage(target, self.root), wp.SMOKE_OF_FLOATS)

    def test_answers_that_prove_nothing_are_forgotten(self) -> None:
        prover = self.prover(self.root / "answers")
        target = wp_targets.Target(self.unit, self.unit.source, "keel_box_put")
        folder = self.root / "answers" / target.identity
        folder.mkdir(parents=True)
        answers = {
            "valid": {"verdict": "valid", "time": 3.0},
            "long": {"verdict": "timeout", "time": 2.0},
            "smoke": {"verdict": "stepout", "steps": 100000},
            "unknown": {"verdict": "unknown"},
        }
        for name, answer in answers.items():
            (folder / f"{name}.json").write_text(json.dumps(answer), encoding="utf-8")
        (folder / "torn.json").write_text('{ "verdict":', encoding="utf-8")
        prover._drop_failures(target)
        self.assertEqual(sorted(path.stem for path in folder.iterdir()), ["smoke", "valid"])

    def test_targets_are_the_functions_of_header_and_source_and_the_lemmas(self) -> None:
        with self.unit.header.open("a", encoding="utf-8") as stream:
            stream.write("/*@ lemma BOX_two: 1 + 1 == 2;\n  @*/\n")
        names = [(t.name, t.lemmas) for t in wp_targets.targets(self.unit)]
        self.assertEqual(names, [("helper", ()), ("keel_box_put", ()), ("lemmas", ("BOX_two",))])

    def test_theorem_files_are_targets(self) -> None:
        text = "// wp: theorem\nvoid theorem(int *b)\n{\n    keel_box_put(b, 1);\n}\n"
        (self.unit.folder / "twice.c").write_text(text, encoding="utf-8")
        unit = find_units(self.root)["box"]
        found = [(t.file.stem, t.function) for t in wp_targets.targets(unit)]
        self.assertIn(("twice", "theorem"), found)

    def test_a_unit_of_inline_functions_is_proved_by_including_it(self) -> None:
        self.unit.source.unlink()
        file = wp_targets.translation_unit(self.unit)
        self.assertEqual(file.read_text(encoding="utf-8"), '#include "keel/rtos/box.h"\n')


class Keys(TreeTest):
    def keys(self) -> dict[str, str]:
        unit = find_units(self.root)["box"]
        runner = Runner({}, self.root)
        prover = wp.Wp(["frama-c"], runner, self.root, self.root)
        checker = cbmc.Cbmc(["goto-cc"], ["cbmc"], runner, self.root, self.root)
        exceptions = settings.read_exceptions(self.root / "none", ["box"])
        stamp = {"tool": "1"}
        jobs = [
            *job_list.wp_jobs([unit], prover, self.root, stamp, exceptions),
            *job_list.cbmc_jobs([unit], checker, self.root, stamp),
        ]
        return {job.name: job.key() for job in jobs}

    def write_wrong(self, text: str) -> None:
        self.unit.wrong_list.write_text(text, encoding="utf-8")

    def changed_by(self, file: str, old: str, new: str, times: int = -1) -> set[str]:
        before = self.keys()
        path = self.root / file
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, times), encoding="utf-8")
        after = self.keys()
        return {name for name in after if before[name] != after[name]}

    def test_a_body_matters_to_its_function_and_to_cbmc(self) -> None:
        changed = self.changed_by("src/rtos/box.c", "*box = value;", "*box = value;;")
        self.assertEqual(changed, {"keel_box_put", "keel_box_put_harness", "zero"})

    def test_a_wrong_body_that_has_gone_stale_has_no_key(self) -> None:
        with self.assertRaisesRegex(ProjectError, "wrong.toml:3: zero: stale, src/rtos/box.c: "):
            self.changed_by("src/rtos/box.c", "*box = value;", "*box = value + 0;")

    def test_a_replacement_matters_to_its_wrong_body_alone(self) -> None:
        file = "proofs/box/wrong.toml"
        self.write_wrong(WRONG + OTHER)
        self.assertEqual(self.changed_by(file, "= 0;", "= 2;"), {"zero"})
        self.assertEqual(self.changed_by(file, "It forgets", "Oh, it forgets"), set())
        smaller = 'expect = ["BOX_001"]\ndefines = "-DBOXES=4u"\n\n[[wrong.replace]]\nold'
        before = 'expect = ["BOX_001"]\n\n[[wrong.replace]]\nold'
        self.assertEqual(self.changed_by(file, before, smaller, 1), {"zero"})

    def test_a_new_wrong_body_leaves_the_keys_of_its_neighbours(self) -> None:
        before = self.keys()
        for text in (WRONG + OTHER, OTHER + WRONG):
            self.write_wrong(text)
            after = self.keys()
            self.assertNotIn(after.pop("one"), before.values())
            self.assertEqual(after, before)

    def test_each_key_of_a_wrong_body_but_its_description_matters(self) -> None:
        self.write_wrong(WRONG + OTHER)
        one = "proofs/box/wrong.toml"
        (self.unit.folder / "keel_box_put__two_harness.c").write_text(
            HARNESS.replace("put_harness", "put__two_harness"), encoding="utf-8"
        )
        two = 'harness = "keel_box_put__two_harness"\nexpect = ["BOX_001"]\n\n'
        old = 'harness = "keel_box_put_harness"\nexpect = ["BOX_001"]\n\n'
        self.assertEqual(self.changed_by(one, old, two, 1), {"zero"})
        self.assertEqual(
            self.changed_by(one, 'expect = ["BOX_001"]', 'expect = ["BOX"]', 1), {"zero"}
        )
        before = self.keys()
        self.write_wrong((WRONG + OTHER).replace('"zero"', '"null"'))
        self.assertNotIn(self.keys()["null"], before.values())

    def test_the_harness_of_what_is_replaced_matters(self) -> None:
        replacing = HARNESS.replace("// covers", "// replaces: helper\n// covers")
        (self.unit.folder / "keel_box_put_harness.c").write_text(replacing, encoding="utf-8")
        other = HARNESS.replace("keel_box_put", "helper")
        (self.unit.folder / "helper_harness.c").write_text(other, encoding="utf-8")
        changed = self.changed_by("proofs/box/helper_harness.c", "&box, 7", "&box, 8")
        self.assertEqual(changed, {"helper_harness", "keel_box_put_harness", "zero"})

    def test_a_contract_matters_to_wp_alone(self) -> None:
        changed = self.changed_by("include/keel/rtos/box.h", "BOX_001: *box", "BOX_002: *box")
        self.assertEqual(changed, {"helper", "keel_box_put"})

    def test_a_comment_more_or_less_matters_to_none(self) -> None:
        for file, code in (
            ("include/keel/rtos/box.h", "#define"),
            ("src/rtos/box.c", "#include"),
            ("proofs/box/keel_box_put_harness.c", "#include"),
        ):
            self.assertEqual(self.changed_by(file, code, f"/* Two\n * lines. */\n{code}", 1), set())
        more = "//@ predicate more(int x) = x > 0;\n#define"
        changed = self.changed_by("include/keel/rtos/box.h", "#define", more, 1)
        self.assertEqual(changed, {"helper", "keel_box_put"})

    def test_an_included_file_matters_to_all(self) -> None:
        changed = self.changed_by("include/keel/status.h", "/* status */", "#define X 1")
        self.assertEqual(changed, set(self.keys()))

    def test_directives_matter(self) -> None:
        harness_file = "proofs/box/keel_box_put_harness.c"
        changed = self.changed_by(harness_file, "--unwind 3", "--unwind 4")
        self.assertEqual(changed, {"keel_box_put_harness", "zero"})
        self.assertEqual(self.changed_by("proofs/box/wrong.toml", "BOX_001", "BOX_002"), {"zero"})

    def test_a_missing_include_is_an_error(self) -> None:
        with self.assertRaisesRegex(ProjectError, "nowhere.h"):
            self.changed_by("src/rtos/box.c", "keel/rtos/box.h", "nowhere.h")

    def test_closure_follows_includes(self) -> None:
        names = [path.name for path in closure(self.root, [self.unit.source])]
        self.assertEqual(sorted(names), ["box.c", "box.h", "status.h"])


ONE = driver.Pool(1)


class Choices(unittest.TestCase):
    def test_the_kernel_is_the_scheduler_voter_filter_and_pid(self) -> None:
        units = find_units()
        names = set(prove.kernel_of(KEEL, units))
        self.assertLessEqual(
            {"clock", "queue", "pass", "scheduler", "range", "voter", "filter", "pid"}, names
        )
        self.assertTrue(names.isdisjoint({"mavlink", "attitude", "mixer", "spread"}))

    def test_a_kernel_of_units_that_are_not_there_is_refused(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(ProjectError, r"kernel\.toml: not there"):
                prove.kernel_of(Path(folder), {})
            listed = 'layers = []\nunits = ["voter", "votr"]\n[without]\n'
            write_text(Path(folder) / "specs" / "kernel.toml", listed)
            with self.assertRaisesRegex(ProjectError, "no such unit: votr$"):
                prove.kernel_of(Path(folder), {"voter": find_units()["voter"]})
            write_text(Path(folder) / "specs" / "kernel.toml", "layers = []\nunits =\n")
            with self.assertRaisesRegex(ProjectError, r"kernel\.toml: .*line 2"):
                prove.kernel_of(Path(folder), {})

    def test_sizes_are_numbers(self) -> None:
        self.assertEqual(prove.size("KEEL_QUEUE_CAPACITY=8"), "-DKEEL_QUEUE_CAPACITY=8u")
        for text in ("KEEL_QUEUE_CAPACITY", "X=0", "x=3", "X=3 -DY", "X=KEEL_OK"):
            with self.assertRaises(argparse.ArgumentTypeError):
                prove.size(text)

    def test_a_choice_is_no_shard(self) -> None:
        for words in (
            ["--kernel", "--shard", "1/2"],
            ["--size", "A=1", "--join", "f"],
            ["--kernel", "--unit", "queue"],
            ["--patience", "0"],
        ):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
                prove.parse(words, ["queue"])


class Theorems(unittest.TestCase):
    """Which theorems a run tells."""

    LIST = """\
[[theorem]]
id = "queue"
statement = "A queue has no gaps."
rests_on = ["QUE-001", "QUE-002"]
"""

    def test_a_theorem_holds_when_all_that_it_rests_on_is_proved(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            self.assertEqual(theorems.told(root, {"QUE-001"}), [])
            write_text(root / theorems.LIST, self.LIST)
            self.assertEqual(theorems.told(root, {"QUE-001"}), [])
            told = theorems.told(root, {"QUE-001", "QUE-002", "PID-001"})
            self.assertEqual(told[1:], ["  queue: A queue has no gaps."])

    def test_labels_are_read_off_goals_and_assertions(self) -> None:
        names = ["keel_f_ensures_QUE_001_kept", "QUE_002_model: as it says", "XQUE_0031"]
        self.assertEqual(theorems.labels(names), {"QUE-001", "QUE-002"})


class Jobs(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_job(
        self, problems: list[str], key: str = "k", changed: str = ""
    ) -> tuple[int, driver.Outcome]:
        """Run a job with these problems; how often it was executed, and its outcome."""
        executed: list[int] = []

        def execute(_room: int) -> dict[str, Any]:
            executed.append(1)
            return {"problems": list(problems), "seconds": 1.0}

        keys = iter([key, key, changed or key])
        job = driver.Job("box", "wp", "f", lambda: next(keys), execute)
        runner = Runner({}, self.folder)
        times = Times(self.folder / "times.json")
        cache = Cache(self.folder / "cache")
        [outcome] = driver.run_jobs([job], cache, runner, ONE, times, lambda _: None)
        return len(executed), outcome

    def test_success_is_remembered(self) -> None:
        self.assertEqual(self.run_job([])[0], 1)
        executed, outcome = self.run_job([])
        self.assertEqual((executed, outcome.cached), (0, True))

    def test_another_key_is_another_job(self) -> None:
        self.run_job([])
        self.assertEqual(self.run_job([], key="other")[0], 1)

    def test_a_failure_is_not_remembered(self) -> None:
        self.run_job(["timeout"])
        executed, outcome = self.run_job(["timeout"])
        self.assertEqual((executed, outcome.problems), (1, ["timeout"]))

    def test_a_text_that_changes_meanwhile_is_not_proved(self) -> None:
        executed, outcome = self.run_job([], changed="k2")
        self.assertIn("changed while it was proved", outcome.problems[0])
        for key in ("k", "k2"):
            self.assertEqual(self.run_job([], key)[0], 1)

    def test_a_torn_entry_is_ignored(self) -> None:
        self.run_job([])
        (self.folder / "cache" / "k.json").write_text('{"key": "k", "resu', encoding="utf-8")
        self.assertEqual(self.run_job([])[0], 1)

    def test_the_longest_goes_first(self) -> None:
        (self.folder / "times.json").write_text(json.dumps({"b/wp/short": 1, "b/wp/long": 9}))
        order: list[str] = []

        def job(name: str) -> driver.Job:
            def execute(_room: int) -> dict[str, Any]:
                order.append(name)
                return {"problems": [], "seconds": 0.0}

            return driver.Job("b", "wp", name, lambda: name, execute)

        jobs = [job("short"), job("long"), job("new")]
        times = Times(self.folder / "times.json")
        driver.run_jobs(jobs, Cache(None), Runner({}, self.folder), ONE, times, lambda _: None)
        self.assertEqual(order, ["new", "long", "short"])

    def test_contracts_and_theorems_go_first(self) -> None:
        (self.folder / "times.json").write_text(json.dumps({"b/cbmc/long": 9, "b/wp/short": 1}))
        order: list[str] = []

        def job(kind: str, name: str) -> driver.Job:
            def execute(_room: int) -> dict[str, Any]:
                order.append(name)
                return {"problems": [], "seconds": 0.0}

            return driver.Job("b", kind, name, lambda: name, execute)

        jobs = [job("cbmc", "new"), job("cbmc", "long"), job("wp", "short")]
        times = Times(self.folder / "times.json")
        driver.run_jobs(jobs, Cache(None), Runner({}, self.folder), ONE, times, lambda _: None)
        self.assertEqual(order, ["short", "new", "long"])

    def first_verdicts(self, *ended: tuple[str, str, str, list[str]]) -> list[str]:
        """The lines of the first verdict, and how many jobs had ended when each came.

        A job has a kind, a name, the status of its only goal or property, and problems."""
        jobs = [
            driver.Job("box", kind, name, str, lambda _: {}) for kind, name, _status, _why in ended
        ]
        console = report.Console(jobs, Times(self.folder / "none.json"), 1)
        lines: list[str] = []
        for count, (job, (_kind, _name, status, why)) in enumerate(zip(jobs, ended, strict=True)):
            goal = [{"name": "goal", "status": status}]
            result = {"goals": goal, "properties": goal, "problems": why, "seconds": 1.0}
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                console.done(driver.Outcome(job, result, cached=False))
            lines += [
                f"{count + 1} {line}"
                for line in said.getvalue().splitlines()
                if line.startswith("first verdict")
            ]
        return lines

    def test_the_first_verdict_comes_when_all_of_wp_is_proved(self) -> None:
        function = ("wp", "keel_box_open", "Valid", [])
        theorem = ("wp", "isolation:serve", "Valid", [])
        harness = ("cbmc", "keel_box_open_harness", "SUCCESS", [])
        [line] = self.first_verdicts(function, theorem, harness)
        self.assertTrue(line.startswith("2 first verdict, after 0.0 min: WP proves all of its 2 "))
        self.assertIn("the theorems of isolation;", line)
        # Not while WP has work left, nor at the end of all, nor if anything is open or in doubt.
        self.assertEqual(len(self.first_verdicts(harness, function, theorem)), 0)
        self.assertEqual(len(self.first_verdicts(function, theorem)), 0)
        unknown = ("wp", "keel_box_shut", "Unknown", ["open"])
        self.assertEqual(self.first_verdicts(unknown, theorem, harness), [])
        doubtful = ("wp", "keel_box_shut", "Valid", ["a warning of unsoundness"])
        self.assertEqual(self.first_verdicts(doubtful, theorem, harness), [])

    def test_what_was_given_up_is_asked_again_alone_with_more_room(self) -> None:
        order: list[tuple[str, int]] = []

        def job(name: str, needs: int) -> driver.Job:
            def execute(room: int) -> dict[str, Any]:
                order.append((name, room))
                lacks = room < needs
                return {"problems": ["open"] * lacks, "seconds": 0.0, "gave_up": lacks}

            return driver.Job("b", "wp", name, lambda: name, execute)

        jobs = [job("hard", 2), job("easy", 1), job("harder", 3)]
        times = Times(self.folder / "times.json")
        (self.folder / "times.json").write_text(json.dumps({"b/wp/hard": 9, "b/wp/harder": 8}))
        runner = Runner({}, self.folder)
        seen = driver.run_jobs(jobs, Cache(None), runner, ONE, times, lambda _: None)
        self.assertEqual(sorted(order[:3]), [("easy", 1), ("hard", 1), ("harder", 1)])
        self.assertEqual(sorted(order[3:]), [("hard", 2), ("harder", 2)])
        self.assertEqual(
            {one.job.name: one.problems for one in seen},
            {"easy": [], "hard": [], "harder": ["open"]},
        )
        order.clear()
        quick = driver.Pool(1, again=False)
        driver.run_jobs(jobs, Cache(None), Runner({}, self.folder), quick, times, lambda _: None)
        self.assertEqual(len(order), 3)

    def test_of_a_unit_that_is_wrong_nothing_is_asked_again(self) -> None:
        rooms: list[int] = []

        def job(name: str, gave_up: bool) -> driver.Job:
            def execute(room: int) -> dict[str, Any]:
                rooms.append(room)
                return {"problems": ["open"], "seconds": 0.0, "gave_up": gave_up}

            return driver.Job("b", "wp", name, lambda: name, execute)

        jobs = [job("hard", True), job("refuted", False)]
        times = Times(self.folder / "times.json")
        runner = Runner({}, self.folder)
        seen = driver.run_jobs(jobs, Cache(None), runner, ONE, times, lambda _: None)
        self.assertEqual((rooms, len(seen)), ([1, 1], 2))

    def test_what_takes_long_is_heard_of_while_it_runs(self) -> None:
        heard: list[str] = []
        ended: list[str] = []
        job = driver.Job(
            "b",
            "wp",
            "slow",
            lambda: "key",
            lambda _: time.sleep(1.5) or {"problems": [], "seconds": 1.5},
        )

        def late(one: driver.Job, _seconds: float) -> None:
            self.assertEqual(ended, [])
            heard.append(one.name)

        with mock.patch("keel.prove.progress.PATIENCE_S", 0.1):
            driver.run_jobs(
                [job],
                Cache(None),
                Runner({}, self.folder),
                ONE,
                Times(self.folder / "times.json"),
                lambda one: ended.append(one.job.name),
                late,
            )
        self.assertIn("slow", heard)
        self.assertEqual(ended, ["slow"])


class Rules(TreeTest):
    def test_a_public_function_without_a_contract_is_named(self) -> None:
        self.assertEqual(completeness.without_contract(self.unit, self.root), [])
        text = "/*@ predicate fits(integer x) = x < 3; */\nvoid keel_box_empty(int *box);\n"
        with self.unit.header.open("a", encoding="utf-8") as stream:
            stream.write(text)
        line = self.unit.header.read_text(encoding="utf-8").count("\n")
        [problem] = completeness.without_contract(self.unit, self.root)
        self.assertIn(f"include/keel/rtos/box.h:{line}: keel_box_empty has no contract", problem)

    def contracts_apart(self, include: str) -> Unit:
        """The unit with its contracts in an internal header; its source includes another line."""
        bare = re.sub(r"/\*@.*?\*/\n", "", HEADER, flags=re.DOTALL)
        self.unit.internal.parent.mkdir(parents=True)
        text = HEADER.replace("RTOS", "INTERNAL_RTOS").replace("keel/status.h", "keel/rtos/box.h")
        self.unit.internal.write_text(text, encoding="utf-8")
        self.unit.header.write_text(bare, encoding="utf-8")
        line = '#include "keel/rtos/box.h"'
        self.unit.source.write_text(SOURCE.replace(line, include), encoding="utf-8")
        return find_units(self.root)["box"]

    def test_contracts_may_stand_in_a_header_of_their_own(self) -> None:
        unit = self.contracts_apart('#include "keel/internal/rtos/box.h"')
        names = [path.relative_to(self.root / "include/keel").as_posix() for path in unit.headers]
        self.assertEqual(names, ["rtos/box.h", "internal/rtos/box.h"])
        self.assertEqual(list(find_units(self.root)), ["box"])
        self.assertEqual(completeness.without_contract(unit, self.root), [])
        self.assertEqual(completeness.unread_contracts(unit, self.root), [])
        self.assertEqual(completeness.missing_harnesses(unit, {}, self.root), [])
        self.unit.header.rename(self.unit.internal)
        unit = find_units(self.root)["box"]
        self.assertEqual((unit.header, unit.headers), (unit.internal, [unit.internal]))

    def test_contracts_that_the_source_does_not_include_hold_of_nothing(self) -> None:
        unit = self.contracts_apart('#include "keel/rtos/box.h"')
        [problem] = completeness.unread_contracts(unit, self.root)
        self.assertIn(
            "src/rtos/box.c: it does not include include/keel/internal/rtos/box.h", problem
        )

    def test_a_ghost_function_that_leads_back_to_itself_fails(self) -> None:
        ghost = "/*@ ghost\nstatic void {}(int n)\n{{\n    {}(n);\n}}\n*/\n"
        path = self.root / "src/rtos/ghost.c"
        path.write_text(ghost.format("one", "two") + ghost.format("two", "one"), encoding="utf-8")
        self.assertEqual(len(completeness.endless([path])), 2)
        path.write_text(ghost.format("one", "two") + ghost.format("two", "put"), encoding="utf-8")
        self.assertEqual(completeness.endless([path]), [])
        path.write_text("int one(int n)\n{\n    return one(n - 1);\n}\n", encoding="utf-8")
        [problem] = completeness.endless([path])
        self.assertIn("one calls itself", problem)

    def test_code_of_no_unit_is_proved_nowhere(self) -> None:
        units = find_units(self.root).values()
        self.assertEqual(completeness.strays(self.root, units), [])
        (self.root / "src/rtos/hidden.c").write_text("int hidden;\n", encoding="utf-8")
        [problem] = completeness.strays(self.root, units)
        self.assertIn("src/rtos/hidden.c: it belongs to no unit", problem)

    def test_a_function_is_defined_in_one_source(self) -> None:
        self.assertEqual(completeness.defined_twice(self.root), [])
        for name, called in (("one", "keel_queue_add"), ("two", "one_more"), ("three", "one_more")):
            text = f"void {called}(void)\n{{\n}}\nstatic void own(void)\n{{\n}}\n"
            (self.root / f"src/rtos/{name}.c").write_text(text, encoding="utf-8")
        self.assertEqual(
            completeness.defined_twice(self.root),
            [
                "src/rtos/one.c:1: keel_queue_add is defined in queue.c, too",
                "src/rtos/two.c:1: one_more is defined in three.c, too",
            ],
        )

    def test_a_function_that_files_share_is_declared_in_a_header(self) -> None:
        self.assertEqual(completeness.undeclared(self.root), [])
        text = "void keel_more(void)\n{\n}\nint abs(int x)\n{\n    return x;\n}\n"
        (self.root / "src/rtos/more.c").write_text(text, encoding="utf-8")
        header = self.root / "include/keel/rtos/more.h"
        header.write_text("int abs(int x);\n", encoding="utf-8")
        self.assertEqual(
            completeness.undeclared(self.root),
            [
                "src/rtos/more.c:1: keel_more is not static, and no header declares it",
                "src/rtos/more.c:4: abs is the C library's: a compiler knows what that one does",
            ],
        )

    def test_a_function_has_one_contract(self) -> None:
        self.assertEqual(completeness.contracts_elsewhere(self.root), [])
        contract = "/*@ assigns \\nothing; */\nvoid keel_queue_init(keel_queue_t *queue);\n"
        theorem = f"// wp: theorem\n{contract}"
        folder = self.root / "proofs/queue"
        folder.mkdir(parents=True)
        (folder / "more.c").write_text(theorem, encoding="utf-8")
        [problem] = completeness.contracts_elsewhere(self.root)
        self.assertIn("more.c: a second contract of keel_queue_init, see", problem)

    def test_headers_that_include_each_other(self) -> None:
        self.assertEqual(completeness.include_circles(self.root), [])
        for name, other in (("one", "keel/rtos/two.h"), ("two", "one.h"), ("three", "one.h")):
            path = self.root / f"include/keel/rtos/{name}.h"
            path.write_text(f'#include "{other}"\n', encoding="utf-8")
        self.assertEqual(
            completeness.include_circles(self.root),
            [
                "include/keel/rtos/one.h: it includes itself, by way of other headers",
                "include/keel/rtos/two.h: it includes itself, by way of other headers",
            ],
        )

    def test_two_functions_that_point_at_each_other(self) -> None:
        path = self.root / "src/rtos/turn.c"
        turn = "int {0}(int n)\n{{\n    int (*f)(int) = &{1};\n    return f(n);\n}}\n"
        path.write_text(turn.format("one", "two") + turn.format("two", "one"), encoding="utf-8")
        self.assertEqual(len(completeness.endless([path])), 2)

    def test_a_vanished_goal_is_a_failure(self) -> None:
        [problem] = completeness.compare_goals(["a", "b"], ["a"], "goals.txt")
        self.assertIn("b is listed, but WP has no such goal", problem)

    def test_a_new_goal_must_be_reviewed(self) -> None:
        [problem] = completeness.compare_goals(["a"], ["a", "b"], "goals.txt")
        self.assertIn("b is a new goal", problem)

    def test_goals_have_names_of_their_own(self) -> None:
        self.assertIn("2 goals are called a", completeness.compare_goals(["a"], ["a", "a"], "x")[0])
        self.assertIn("not sorted", completeness.compare_goals(["b", "a"], ["a", "b"], "x")[0])

    def test_equal_lists_are_fine(self) -> None:
        self.assertEqual(completeness.compare_goals(["a", "b"], ["b", "a"], "x"), [])

    def test_a_function_without_harness_is_a_failure(self) -> None:
        self.assertEqual(completeness.missing_harnesses(self.unit, {}, self.root), [])
        (self.unit.folder / "keel_box_put_harness.c").unlink()
        unit = find_units(self.root)["box"]
        [problem] = completeness.missing_harnesses(unit, {}, self.root)
        self.assertIn("write proofs/box/keel_box_put_harness.c", problem)
        self.assertEqual(
            completeness.missing_harnesses(unit, {"keel_box_put": "why"}, self.root), []
        )

    def test_a_needless_exception_is_a_failure(self) -> None:
        [problem] = completeness.missing_harnesses(self.unit, {"keel_box_put": "why"}, self.root)
        self.assertIn("no exception any more", problem)

    def test_a_contract_without_body_is_a_failure(self) -> None:
        self.assertEqual(completeness.undefined_functions(self.unit, {}, self.root), [])
        self.unit.source.write_text('#include "keel/rtos/box.h"\n', encoding="utf-8")
        [problem] = completeness.undefined_functions(self.unit, {}, self.root)
        self.assertIn("keel_box_put has a contract and no body", problem)
        self.assertEqual(
            completeness.undefined_functions(self.unit, {"keel_box_put": "w"}, self.root), []
        )

    def test_what_wp_leaves_must_be_covered_by_a_harness(self) -> None:
        self.assertEqual(completeness.left_by_wp(self.unit, {"keel_box_put": "why"}, self.root), [])
        [problem] = completeness.left_by_wp(self.unit, {"helper": "why"}, self.root)
        self.assertIn("helper is proved by neither engine", problem)
        [problem] = completeness.left_by_wp(self.unit, {"gone": "why"}, self.root)
        self.assertIn("there is no function gone", problem)

    def test_assumptions_are_failures(self) -> None:
        self.unit.source.write_text("//@ admit x;\n#ifdef __FRAMAC__\n#endif\n", encoding="utf-8")
        self.assertEqual(len(completeness.assumptions_in([self.unit.source], self.root)), 2)
        self.unit.source.write_text("#pragma CPROVER check disable\n", encoding="utf-8")
        self.assertEqual(len(completeness.switched_off_checks([self.unit.source], self.root)), 1)

    def test_an_exception_needs_a_reason(self) -> None:
        path = self.root / "units.toml"
        path.write_text('[box]\nno_harness = [{ function = "f", reason = "why" }]\n')
        self.assertEqual(settings.read_exceptions(path, ["box"])["box"].no_harness, {"f": "why"})
        for text in (
            '[box]\nno_harness = [{ function = "f" }]\n',
            "[bax]\n",
            '[box]\nno_harness = [{ function = "f", reason = " " }]\n',
            "[box]\nno_hardness = []\n",
        ):
            path.write_text(text)
            with self.subTest(text), self.assertRaises(ProjectError):
                settings.read_exceptions(path, ["box"])


def item(name: str, status: str, description: str, line: int = 9) -> dict[str, Any]:
    """A property in CBMC's JSON output."""
    location = {"file": "proofs/box/keel_box_put_harness.c", "line": str(line), "function": "f"}
    return {
        "property": name,
        "status": status,
        "description": description,
        "sourceLocation": location,
    }


def cbmc_output(*items: dict[str, Any], **more: Any) -> str:
    """CBMC's JSON output."""
    failed = any(entry["status"] != "SUCCESS" for entry in items)
    verdict = {"cProverStatus": "failure" if failed else "success"}
    return json.dumps([{"program": "CBMC"}, {"result": list(items)}, verdict, more])


ASSERTED = item("h.assertion.1", "SUCCESS", "BOX_001: it holds the value")


class CbmcVerdict(TreeTest):
    def problems(self, text: str) -> list[str]:
        return cbmc_answers.proof_problems(read_answer(text))

    def test_all_proved_is_success(self) -> None:
        self.assertEqual(self.problems(cbmc_output(ASSERTED)), [])

    def test_anything_but_success_is_a_failure(self) -> None:
        for status in ("FAILURE", "UNKNOWN", "ERROR", "NOT_CHECKED"):
            output = cbmc_output(ASSERTED, item("h.bounds.1", status, "upper bound", 12))
            [problem] = self.problems(output)
            self.assertIn("proofs/box/keel_box_put_harness.c:12: upper bound", problem)

    def test_a_harness_without_assertion_is_a_failure(self) -> None:
        output = cbmc_output(item("h.bounds.1", "SUCCESS", "upper bound"))
        self.assertEqual(self.problems(output), ["there is no assertion in it"])

    def test_output_that_breaks_off_is_a_failure(self) -> None:
        self.assertIn("CBMC did not finish", self.problems(cbmc_output(ASSERTED)[:-20]))
        self.assertIn("CBMC did not finish", self.problems(json.dumps([{"program": "CBMC"}])))

    def test_a_warning_is_a_failure(self) -> None:
        output = cbmc_output(ASSERTED, messageType="WARNING", messageText="ignoring forall")
        self.assertEqual(self.problems(output), ["ignoring forall"])

    def test_a_wrong_body_that_passes_is_a_failure(self) -> None:
        [body] = wrong.read_wrong_bodies(self.unit)
        passes = read_answer(cbmc_output(ASSERTED))
        [problem] = refutation_problems(passes, body)
        self.assertIn("does not refute this wrong body", problem)

    def test_a_wrong_body_must_fail_at_its_assertion(self) -> None:
        [body] = wrong.read_wrong_bodies(self.unit)
        other = read_answer(cbmc_output(item("h.assertion.2", "FAILURE", "BOX_002: x")))
        [problem] = refutation_problems(other, body)
        self.assertIn("not at BOX_001", problem)
        right = read_answer(cbmc_output(item("h.assertion.1", "FAILURE", "BOX_001: x")))
        self.assertEqual(refutation_problems(right, body), [])

    def test_a_run_that_breaks_off_refutes_nothing(self) -> None:
        [body] = wrong.read_wrong_bodies(self.unit)
        self.assertEqual(len(refutation_problems(read_answer("[{"), body)), 1)

    def test_only_the_expected_assertions_are_asked_for(self) -> None:
        listing = json.dumps(
            [
                {
                    "properties": [
                        {"name": "h.assertion.1", "description": "BOX_001: x"},
                        {"name": "h.assertion.2", "description": "BOX_002: x"},
                    ]
                }
            ]
        )
        self.assertEqual(cbmc.selection(listing, ["BOX_001"]), ["--property", "h.assertion.1"])


def goal(function: str, lines: str, reached: bool, file: str = "src/rtos/box.c") -> dict[str, Any]:
    """A block in CBMC's coverage output."""
    return {
        "basicBlockLines": {file: {function: lines}},
        "sourceLocation": {"file": file, "function": function, "line": lines.split(",")[0]},
        "status": "satisfied" if reached else "failed",
    }


class Coverage(TreeTest):
    def problems(self, *goals: dict[str, Any]) -> list[str]:
        parsed = harness.read_harness(self.unit, self.unit.harnesses[0])
        properties = read_answer(cbmc_output(ASSERTED)).properties
        return cbmc_answers.coverage_problems(cbmc_answers.blocks(goals), parsed, properties)

    own = "proofs/box/keel_box_put_harness.c"
    name = "keel_box_put_harness"

    def test_all_reached_is_success(self) -> None:
        goals = [goal(self.name, "7-9,10", True, self.own), goal("keel_box_put", "15", True)]
        self.assertEqual(self.problems(*goals), [])

    def test_the_end_must_be_reached(self) -> None:
        goals = [
            goal(self.name, "7-9", True, self.own),
            goal(self.name, "10", False, self.own),
            goal("keel_box_put", "15", True),
        ]
        self.assertIn("no execution reaches the harness's end", self.problems(*goals)[0])

    def test_assertions_must_be_reached(self) -> None:
        goals = [goal(self.name, "7,8,10", True, self.own), goal("keel_box_put", "15", True)]
        self.assertIn(":9: no execution reaches this assertion", self.problems(*goals)[0])

    def test_covered_functions_must_be_reached_everywhere(self) -> None:
        ends = goal(self.name, "7-10", True, self.own)
        [problem] = self.problems(ends, goal("keel_box_put", "15", False))
        self.assertEqual(problem, "src/rtos/box.c:15: not reached in keel_box_put")
        [problem] = self.problems(ends)
        self.assertIn("keel_box_put is covered nowhere", problem)


class Harnesses(TreeTest):
    def read(self, text: str) -> harness.Harness:
        path = self.unit.harnesses[0]
        path.write_text(text, encoding="utf-8")
        return harness.read_harness(self.unit, path)

    def test_directives(self) -> None:
        read = self.read(HARNESS)
        self.assertEqual(read.function, "keel_box_put")
        self.assertEqual(read.sources, (self.unit.source,))
        self.assertEqual(harness.text_problems(read), [])
        self.assertEqual(harness.without_solver(list(read.options)), ["--unwind", "3"])

    def test_the_coverage_run_may_search_in_a_way_of_its_own(self) -> None:
        read = self.read(HARNESS.replace("// cbmc:", "// reach: --z3 --unwindset f.0:2\n// cbmc:"))
        self.assertEqual(read.reach, ("--z3", "--unwindset", "f.0:2"))
        self.assertNotIn("--z3", read.options)
        checker = cbmc.Cbmc(["goto-cc"], ["cbmc"], Runner({}, self.root), self.root, self.root)
        with mock.patch.object(Runner, "run", return_value=Finished(0, "")) as run:
            checker._measure(read, self.root / "h.gb", cbmc.Result())
        for call in run.call_args_list:
            self.assertIn("--unwind 3 --z3 --unwindset f.0:2", " ".join(call.args[0]))
        with self.assertRaisesRegex(ProjectError, "a harness may not use --cover"):
            self.read(HARNESS.replace("// cbmc:", "// reach: --cover\n// cbmc:"))

    def test_options_that_weaken_are_refused(self) -> None:
        for option in ("--no-assertions", "--partial-loops", "--no-bounds-check", "--depth 3"):
            with self.subTest(option), self.assertRaisesRegex(ProjectError, option.split()[0]):
                self.read(HARNESS.replace("--unwind 3", option))

    def test_the_function_is_called_exactly_once(self) -> None:
        call = "keel_box_put(&box, 7);"
        for text in (
            HARNESS.replace(call, ""),
            HARNESS.replace(call, call + call),
            HARNESS.replace(call, "/* " + call + " */"),
            HARNESS + "void f(void)\n{\n" + call + "\n}\n",
        ):
            with self.subTest(text):
                self.assertEqual(len(harness.text_problems(self.read(text))), 1)

    def test_a_stand_in_has_the_contract_that_is_proved(self) -> None:
        own = (
            HARNESS.replace("keel_box_put", "keel_box_get")
            .replace("    int box;", "    __CPROVER_assume(keel_box_get_may(1));")
            .replace("box == 7", "keel_box_get_does(7)")
        )
        (self.unit.folder / "keel_box_get_harness.c").write_text(own, encoding="utf-8")
        stand_in = """
int keel_box_get_stand_in(int box)
{
    __CPROVER_assert(keel_box_get_may(box), "precondition");
    __CPROVER_assume(keel_box_get_does(box));
}
"""
        text = HARNESS.replace("// covers", "// replaces: keel_box_get\n// covers") + stand_in
        path = self.unit.folder / "keel_box_put_harness.c"

        def problems(text: str) -> list[str]:
            path.write_text(text, encoding="utf-8")
            return harness.text_problems(harness.read_harness(self.unit, path))

        self.assertEqual(problems(text), [])
        elsewhere = self.unit.folder.with_name("crate")
        elsewhere.mkdir()
        (self.unit.folder / "keel_box_get_harness.c").rename(elsewhere / "keel_box_get_harness.c")
        self.assertEqual(problems(text), [])
        (elsewhere / "keel_box_get_harness.c").unlink()
        self.assertIn("get_harness lacks __CPROVER_assume(", problems(text)[0])
        self.assertIn("stand_in lacks", problems(text.replace("assert(keel", "assume(keel"))[0])
        self.assertIn(
            "is to prove",
            problems(text.replace("s: keel_box_put", "s: keel_box_get keel_box_put"))[0],
        )
        own = own.replace("keel_box_get_may(1)", "true")
        (self.unit.folder / "keel_box_get_harness.c").write_text(own, encoding="utf-8")
        self.assertIn("get_harness lacks __CPROVER_assume(", problems(text)[0])

    def test_the_very_source_must_be_linked(self) -> None:
        (self.root / "src/rtos/copy.c").write_text(SOURCE, encoding="utf-8")
        read = self.read("// sources: src/rtos/copy.c\n" + HARNESS)
        self.assertIn("does not link src/rtos/box.c", harness.text_problems(read)[0])
        (self.root / "copy.c").write_text(SOURCE, encoding="utf-8")
        with self.assertRaisesRegex(ProjectError, "copy.c is linked from elsewhere than src"):
            self.read("// sources: src/rtos/box.c copy.c\n" + HARNESS)

    def test_a_definition_is_a_number(self) -> None:
        self.assertEqual(
            self.read("// defines: -DKEEL_BOX=4u\n" + HARNESS).defines, ("-DKEEL_BOX=4u",)
        )
        for word in ("-D__CPROVER_assert(c,t)=", "-Dfloat_same(a,b)=1", "-DKEEL_OK=KEEL_ERR_NULL"):
            with self.assertRaisesRegex(ProjectError, "takes -DNAME=NUMBER, NAME in"):
                self.read(f"// defines: {word}\n" + HARNESS)

    def test_one_solver_answers(self) -> None:
        with self.assertRaisesRegex(ProjectError, "one solver answers"):
            self.read("// cbmc: --external-sat-solver cadical --refine\n" + HARNESS)


class WrongBodies(TreeTest):
    def read(self, text: str) -> wrong.WrongBody:
        self.unit.wrong_list.write_text(text, encoding="utf-8")
        return wrong.read_wrong_bodies(self.unit)[0]

    def jobs(self) -> list[driver.Job]:
        checker = cbmc.Cbmc(["goto-cc"], ["cbmc"], Runner({}, self.root), self.root, self.root)
        return job_list.cbmc_jobs([self.unit], checker, self.root, {})

    def assert_refused(self, text: str, why: str, place: str = ":3: zero: ") -> None:
        with self.assertRaisesRegex(ProjectError, f"^proofs/box/wrong.toml{place}.*{why}"):
            self.read(text).text()

    @staticmethod
    def with_key(line: str) -> str:
        """The wrong body with one key more."""
        return WRONG.replace("\n\n[[wrong.replace]]", f"\n{line}\n\n[[wrong.replace]]")

    def test_it_is_the_source_with_the_text_replaced(self) -> None:
        read = self.read(WRONG)
        self.assertEqual((read.name, read.harness), ("zero", "keel_box_put_harness"))
        self.assertEqual((read.expect, read.file), (("BOX_001",), self.unit.source))
        self.assertEqual(read.text(), SOURCE.replace("*box = value;", "*box = 0;"))

    def test_replacements_are_made_in_their_order(self) -> None:
        more = '[[wrong.replace]]\nold = "    *box = 0;\\n"\nnew = ""\n'
        self.assertEqual(self.read(WRONG + more).text(), SOURCE.replace("    *box = value;\n", ""))

    def test_a_text_that_is_gone_is_an_error(self) -> None:
        self.assert_refused(WRONG.replace("value;", "worth;"), "box.c: .*worth.* occurs 0 times")

    def test_a_text_that_occurs_twice_is_an_error(self) -> None:
        self.assert_refused(WRONG.replace("*box = value;", "*box"), "occurs 2 times, and must")

    def test_a_function_narrows_the_search(self) -> None:
        twice = WRONG.replace("*box = value;", "int")
        inside = twice + 'function = "helper"\n'
        self.assertIn("    *box = 0; i = 0;", self.read(inside).text())
        self.assert_refused(twice + 'function = "keel_box_put"\n', "0 times in keel_box_put")
        self.assert_refused(twice + 'function = "gone"\n', "there is no function gone")

    def test_what_is_missing_or_unknown_is_an_error(self) -> None:
        inline = WRONG.partition("\n[[wrong.replace]]")[0]
        cases = {
            WRONG.replace("expect", "expects"): "unknown key expects; known: defines, description,",
            WRONG + 'count = "1"\n': "unknown key count; known: function, new, old",
            WRONG.replace("description", "about"): "unknown key about",
            WRONG.replace('"It forgets the value."', '""'): "`description` must be a text that is",
            WRONG.replace('"zero"', '"../zero"'): "`name` takes letters, digits, _ and -",
            WRONG.replace('expect = ["BOX_001"]\n', ""): "`expect` must",
            self.with_key('defines = "BOXES=4u"'): "`defines` takes",
            WRONG.replace('["BOX_001"]', "[]"): "`expect` must",
            WRONG.replace('["BOX_001"]', "[1]"): "`expect` must",
            WRONG.replace('harness = "keel_box_put_harness"\n', ""): "`harness` must",
            WRONG.replace("put_harness", "get_harness"): "there is no harness keel_box_get_harness",
            WRONG.replace('old = "*box = value;"', 'old = ""'): "`old` must",
            WRONG.replace('new = "*box = 0;"\n', ""): "`new` must",
            inline: "`replace` must be an array of tables, with one at least",
            inline + "replace = []\n": "`replace` must be an array of tables, with one at least",
            inline + "replace = [1]\n": "`replace` must hold tables only",
            WRONG.replace("[[wrong.replace]]", "[wrong.replace]"): "`replace` must be an array",
            self.with_key('file = "gone.c"'): "no file gone.c",
            self.with_key('file = "/etc/passwd"'): "no file /etc",
        }
        for text, why in cases.items():
            with self.subTest(why):
                if '"../zero"' in text:
                    self.assert_refused(text, why, ":3: ../zero: ")
                else:
                    self.assert_refused(text, why)

    def test_a_file_that_is_no_list_of_wrong_bodies_is_an_error(self) -> None:
        cases = {
            "": ": `wrong` must be an array of tables, with one at least",
            "wrong = []\n": ": `wrong` must be an array of tables, with one at least",
            "[wrong]\n": ": `wrong` must be an array of tables",
            WRONG + '\n[[right]]\nname = "x"\n': ": unknown key right; known: wrong",
            WRONG.replace("[[wrong]]", "[[", 1): ": .*line 3",
            WRONG.replace('name = "zero"\n', ""): ":3: number 1: `name` must be a text",
            'wrong = [{ name = "zero" }]\n': ":1: zero: `expect` must",
        }
        for text, why in cases.items():
            with self.subTest(text=text):
                self.assert_refused(text, "", why)

    def test_a_name_is_of_one_wrong_body(self) -> None:
        again = OTHER.replace('"one"', '"zero"')
        self.assert_refused(WRONG + again, "line 3 has this name, too", ":13: zero: ")

    def test_a_unit_without_the_file_has_none(self) -> None:
        self.unit.wrong_list.unlink()
        self.assertEqual(wrong.read_wrong_bodies(self.unit), [])

    def test_wrong_bodies_stand_in_the_order_of_the_file(self) -> None:
        self.unit.wrong_list.write_text(WRONG + OTHER, encoding="utf-8")
        shown = [body.shown for body in wrong.read_wrong_bodies(self.unit)]
        self.assertEqual(shown, [f"proofs/box/wrong.toml:{at}" for at in ("3: zero", "13: one")])

    def test_a_file_that_the_harness_does_not_see_is_an_error(self) -> None:
        (self.root / "src" / "rtos" / "sail.c").write_text(SOURCE, encoding="utf-8")
        self.read(self.with_key('file = "src/rtos/sail.c"'))
        with self.assertRaisesRegex(ProjectError, "3: zero: keel_box_put_harness does not depend"):
            [job.key() for job in self.jobs()]

    def test_a_file_of_its_own_is_refused(self) -> None:
        folder = self.unit.folder / "wrong"
        folder.mkdir()
        (folder / "bound.g").touch()
        self.assertEqual(len(wrong.read_wrong_bodies(self.unit)), 1)
        for name in ("nought.toml", "copy.c"):
            (folder / name).write_text(WRONG, encoding="utf-8")
            why = (
                rf"^proofs/box/wrong/{name}: a wrong body belongs into proofs/box/wrong.toml, as"
                rf" a \[\[wrong\]\] with the name {name.partition('.')[0]};"
            )
            with self.assertRaisesRegex(ProjectError, why):
                self.jobs()
            (folder / name).unlink()

    def built(self, text: str) -> list[str]:
        """The words of the compiler's commands for a wrong body."""
        tools = FakeTools(self.root)
        tools.play()
        runner = Runner(tools.environment(), self.root)
        scratch = self.root / "scratch"
        checker = cbmc.Cbmc(tools.goto_cc(), tools.command("cbmc"), runner, self.root, scratch)
        body = self.read(text)
        binary, complaint = checker.build(
            harness.read_harness(self.unit, self.unit.harnesses[0]), "zero", body
        )
        self.assertEqual(complaint, "")
        return [
            word
            for path in sorted(binary.parent.parent.glob("*.gb"))
            for word in path.read_text(encoding="utf-8").split()
        ]

    def test_a_wrong_source_is_compiled_in_place_of_the_right_one(self) -> None:
        words = self.built(WRONG)
        made = "build/prove/wrong/box/zero/src/rtos/box.c"
        self.assertIn(made, words)
        self.assertNotIn("src/rtos/box.c", words)
        self.assertIn("*box = 0;", (self.root / made).read_text(encoding="utf-8"))
        self.assertEqual(self.unit.source.read_text(encoding="utf-8"), SOURCE)

    def compiled(self, *bodies: wrong.WrongBody | None) -> list[str]:
        """What is compiled, in this order, for these bodies."""
        runner = Runner({}, self.root)
        checker = cbmc.Cbmc(["goto-cc"], ["cbmc"], runner, self.root, self.root / "scratch")
        read = harness.read_harness(self.unit, self.unit.harnesses[0])

        def run(command: list[str]) -> Finished:
            Path(command[command.index("-o") + 1]).touch()
            return Finished(0, "")

        with mock.patch.object(runner, "run", side_effect=run) as started:
            for body in bodies:
                self.assertEqual(checker.build(read, body.name if body else read.name, body)[1], "")
        commands = [call.args[0] for call in started.call_args_list]
        return [one[one.index("-c") + 1] for one in commands if "-c" in one]

    def test_what_is_the_same_is_compiled_once(self) -> None:
        source, proof = "src/rtos/box.c", "proofs/box/keel_box_put_harness.c"
        body = self.read(WRONG)
        changed = f"build/prove/wrong/box/zero/{source}"
        self.assertEqual(self.compiled(None, body, None), [source, proof, changed])

    def test_what_includes_a_wrong_header_is_compiled_with_it(self) -> None:
        self.inline()
        proof = "proofs/box/keel_box_put_harness.c"
        self.assertEqual(self.compiled(None, self.read(WRONG)), [proof, proof])

    def test_names_of_assertions_hold_for_all_bodies_names_of_checks_do_not(self) -> None:
        kept = {"name": "h.assertion.1", "description": "BOX_001: x"}
        check = {"name": "keel_box_put.array_bounds.1", "description": "upper bound"}
        listing = json.dumps([{"properties": [kept, check]}])
        self.assertTrue(cbmc.are_assertions(listing, ["BOX_001"]))
        for expect in (["upper bound"], ["BOX_001", "upper bound"], ["gone"]):
            self.assertFalse(cbmc.are_assertions(listing, expect))
        self.assertFalse(cbmc.are_assertions("[", ["BOX_001"]))

    def inline(self) -> None:
        self.unit.source.unlink()
        body = "static inline void keel_box_put(int *box, int value)\n{\n    *box = value;\n}\n"
        text = HEADER.replace("void keel_box_put(int *box, int value);\n", body)
        self.unit.header.write_text(text, encoding="utf-8")

    def test_a_wrong_header_comes_before_the_right_one(self) -> None:
        self.inline()
        words = self.built(WRONG)
        tree = self.root / "build/prove/wrong/box/zero/include"
        self.assertLess(words.index(f"-I{tree}"), words.index("-Iinclude"))
        text = (tree / "keel/rtos/box.h").read_text(encoding="utf-8")
        self.assertIn("*box = 0;", text)

    def test_a_header_may_be_named(self) -> None:
        text = self.with_key('file = "include/keel/rtos/box.h"')
        text = text.replace("*box = value;", "int *box").replace("*box = 0;", "long *box")
        words = self.built(text)
        self.assertIn("src/rtos/box.c", words)
        made = self.root / "build/prove/wrong/box/zero/include/keel/rtos/box.h"
        self.assertIn("long *box", made.read_text(encoding="utf-8"))


FAKE = """\
import json, os, sys, time
name, arguments = sys.argv[1], sys.argv[2:]
play = json.load(open(os.environ["PLAY"]))
if name == "frama-c":
    if "-wp" not in arguments:
        print("[rte:annot] annotating function helper")
        print("[rte:annot] annotating function keel_box_put")
        print(*play.get("told", []), sep=chr(10))
        print("keel: looked")
        sys.exit()
    if "sleep" in play:
        print("started", flush=True)
        time.sleep(600)
    function = arguments[arguments.index("-wp-fct") + 1]
    goals = play["goals"][function]
    print("[rte:annot] annotating function " + function)
    for goal, status in goals.items():
        print(f"[wp] [Alt-Ergo 2.0.0] Goal typed_{function}_{goal} : {status} (1ms)")
    valid = sum(status == "Valid" for status in goals.values())
    entry = {"wp:main": {"total": len(goals), "valid": valid}}
    report = {"wp:global": entry, "wp:functions": {function: {"all": entry}}}
    open(arguments[arguments.index("-wp-report-json") + 1], "w").write(json.dumps(report))
elif name == "goto-cc":
    open(arguments[arguments.index("-o") + 1], "w").write(" ".join(arguments))
elif name == "cbmc":
    print(json.dumps(play["cover" if "--cover" in arguments else
                     "wrong" if any("-zero/" in a for a in arguments) else "cbmc"]))
"""
GOALS = {
    "helper": {"assigns": "Valid", "loop_variant_decrease": "Valid"},
    "keel_box_put": {"ensures_BOX_001": "Valid", "assigns": "Valid"},
}
COVERED = [
    {
        "goals": [
            goal("keel_box_put_harness", "7-10", True, Coverage.own),
            goal("keel_box_put", "15", True),
        ],
        "goalsCovered": 2,
    }
]


class FakeTools:
    """What Session asks of a Toolchain."""

    def __init__(self, root: Path) -> None:
        self._start = [sys.executable, str(root / "fake.py")]
        (root / "fake.py").write_text(FAKE, encoding="utf-8")
        (root / "m.ml").write_text("", encoding="utf-8")
        self._script = root / "m.ml"
        self._play = root / "play.json"

    def play(self, **parts: Any) -> None:
        """What the engines are to say."""
        self._play.write_text(json.dumps(parts), encoding="utf-8")

    def environment(self) -> dict[str, str]:
        return {"PLAY": str(self._play)}

    def frama_c(self) -> list[str]:
        return [*self._start, "frama-c", "-load-script", str(self._script)]

    def goto_cc(self) -> list[str]:
        return [*self._start, "goto-cc"]

    def command(self, tool: str) -> list[str]:
        return [*self._start, tool]

    def versions(self, *_: str) -> dict[str, Any]:
        return {}

    def header_folders(self) -> list[Path]:
        return []


class WholeRunCase(TreeTest):
    """A project whose engines say what a test has them say."""

    fresh = False

    def setUp(self) -> None:
        super().setUp()
        self.verdict_folder = self.root / "verdicts"
        self.tools = FakeTools(self.root)
        self.unit.wrong_list.unlink()
        self.play()
        names = [f"{f}_{g}\n" for f, goals in GOALS.items() for g in goals]
        self.unit.goal_list.write_text("".join(sorted(names)), encoding="utf-8")
        asserted = "keel_box_put_harness BOX_001: it holds the value\n"
        (self.unit.folder / "assertions.txt").write_text(asserted, encoding="utf-8")
        self.report_file = self.root / "build" / "prove" / "report.json"

    def play(self, **changes: Any) -> None:
        parts = {"goals": GOALS, "cbmc": json.loads(cbmc_output(ASSERTED)), "cover": COVERED}
        self.tools.play(**(parts | changes))

    def prove(
        self, update: bool = False, partial: bool = False, **more: Any
    ) -> tuple[int, str, dict[str, Any]]:
        """A run: its status, its output, and its report."""
        unit = find_units(self.root)["box"]
        choice = Choice(
            (unit,),
            partial,
            ("wp", "cbmc"),
            2,
            self.verdict_folder,
            self.fresh,
            update_goals=update,
            **more,
        )
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            tools: Any = self.tools
            status = Session(self.root, tools, choice).run()
        return status, output.getvalue(), json.loads(self.report_file.read_text(encoding="utf-8"))


class WholeRun(WholeRunCase):
    def test_a_proof(self) -> None:
        status, output, report = self.prove()
        self.assertEqual(status, 0, output)
        self.assertEqual(output.splitlines()[-1], "proved 5 of 5 goals (WP 4, CBMC 1, Gappa 0)")
        self.assertEqual((report["verdict"], report["goals"], report["proved"]), ("proved", 5, 5))
        self.assertNotIn("partial", report)
        assertion = report["units"]["box"]["cbmc"]["harnesses"]["keel_box_put_harness"][
            "assertions"
        ]
        self.assertEqual(assertion[0]["description"], "BOX_001: it holds the value")
        self.assertIn("known", self.prove()[1])

    def test_part_of_the_units_is_marked(self) -> None:
        self.assertIs(self.prove(partial=True)[2]["partial"], True)

    def failing(self, text: str, last: str) -> None:
        for _ in range(2):
            status, output, report = self.prove()
            self.assertEqual((status, report["verdict"]), (1, "failed"))
            self.assertIn(text, output)
            many = len(report["problems"])
            problems = "1 problem" if many == 1 else f"{many} problems"
            self.assertEqual(output.splitlines()[-1], f"FAILED, {problems}: {last}")

    def test_an_unproved_goal_fails_each_time(self) -> None:
        goals = {**GOALS, "keel_box_put": {"ensures_BOX_001": "Timeout", "assigns": "Valid"}}
        self.play(goals=goals)
        last = "proved 4 of 5 goals (WP 3, CBMC 1, Gappa 0)"
        self.failing("keel_box_put_ensures_BOX_001 is not", last)

    def test_a_vanished_goal_fails(self) -> None:
        self.play(goals={**GOALS, "keel_box_put": {"assigns": "Valid"}})
        self.failing("BOX_001 is listed, but", "proved 4 of 5 goals (WP 3, CBMC 1, Gappa 0)")

    def test_goals_can_be_accepted(self) -> None:
        self.play(goals={**GOALS, "keel_box_put": {"assigns": "Valid"}})
        self.assertEqual(self.prove(update=True)[0], 0)
        self.assertNotIn("BOX_001", self.unit.goal_list.read_text(encoding="utf-8"))

    def test_a_missing_list_fails(self) -> None:
        self.unit.goal_list.unlink()
        self.failing("goals.txt is missing", "proved 5 of 5 goals (WP 4, CBMC 1, Gappa 0)")

    def test_a_vanished_assertion_fails_until_it_is_accepted(self) -> None:
        path = self.unit.folder / "assertions.txt"
        asserted = path.read_text(encoding="utf-8")
        path.write_text(asserted + "keel_box_put_harness BOX_002: gone\n", encoding="utf-8")
        self.failing("BOX_002: gone: is listed, but", "proved 5 of 5 goals (WP 4, CBMC 1, Gappa 0)")
        self.assertEqual(self.prove(update=True)[0], 0)
        self.assertEqual(path.read_text(encoding="utf-8"), asserted)

    def test_a_wrong_body_that_passes_fails(self) -> None:
        self.unit.wrong_list.write_text(WRONG, encoding="utf-8")
        self.play(wrong=json.loads(cbmc_output(ASSERTED)))
        self.failing("does not refute", "proved 5 of 5 goals (WP 4, CBMC 1, Gappa 0)")
        log = json.loads((self.report_file.parent / exports.SARIF).read_text(encoding="utf-8"))
        places = [
            place["physicalLocation"]
            for one in log["runs"][0]["results"]
            for place in one["locations"]
        ]
        self.assertIn(
            {"artifactLocation": {"uri": "proofs/box/wrong.toml"}, "region": {"startLine": 3}},
            places,
        )

    def test_a_wrong_body_that_fails_is_refuted(self) -> None:
        self.unit.wrong_list.write_text(WRONG, encoding="utf-8")
        self.play(wrong=json.loads(cbmc_output(ASSERTED | {"status": "FAILURE"})))
        status, output, report = self.prove()
        self.assertEqual(status, 0, output)
        negative = report["units"]["box"]["cbmc"]["negative"]
        self.assertEqual((negative["bodies"], negative["refuted"]), (1, 1))

    def test_a_function_that_only_frama_c_sees_fails(self) -> None:
        text = SOURCE.replace("static int helper", "static int MACRO(helper)")
        self.unit.source.write_text(text, encoding="utf-8")
        self.assertIn("Frama-C sees the function helper", self.prove()[1])

    def test_what_annotations_take_for_granted_fails(self) -> None:
        said = {
            "keel: assumed: src/rtos/box.c:3: admit": "src/rtos/box.c:3: admit: it is assumed, not",
            "keel: declared: keel_stray": "box.c: keel_stray is declared here, and proved nowhere",
        }
        for told, problem in said.items():
            self.play(told=[told])
            status, output, _ = self.prove()
            self.assertEqual(status, 1)
            self.assertIn(problem, output)

    def test_an_old_report_does_not_outlive_the_start_of_a_run(self) -> None:
        self.prove()
        self.tools.play()
        with self.assertRaises(KeyError), contextlib.redirect_stdout(io.StringIO()):
            self.unit.source.write_text(SOURCE.replace("value;", "value + 0;"), encoding="utf-8")
            with mock.patch.object(self.tools, "frama_c", side_effect=KeyError):
                self.prove()
        self.assertFalse(self.report_file.exists())


class Pool(unittest.TestCase):
    def test_an_interrupt_while_tasks_are_handed_in_stops_those_that_run(self) -> None:
        runner = mock.Mock()
        handed_in: list[Callable[[], int]] = []

        def submit(_pool: object, task: Callable[[], int]) -> Future[int]:
            if handed_in:
                raise KeyboardInterrupt
            handed_in.append(task)
            return Future()

        with (
            mock.patch.object(ThreadPoolExecutor, "submit", submit),
            self.assertRaises(KeyboardInterrupt),
        ):
            list(in_pool([lambda: 1, lambda: 2], 2, runner))
        runner.stop.assert_called_once()

    def test_an_interrupt_while_a_program_runs_ends_the_program(self) -> None:
        runner = Runner(dict(os.environ), Path("/"))
        started: list[subprocess.Popen[str]] = []

        def interrupt(process: subprocess.Popen[str], **_: object) -> None:
            started.append(process)
            raise KeyboardInterrupt

        with (
            mock.patch.object(subprocess.Popen, "communicate", interrupt),
            self.assertRaises(KeyboardInterrupt),
        ):
            runner.run(["sleep", "600"])
        try:
            self.assertEqual(started[0].wait(timeout=WAIT_S), -signal.SIGKILL)
        finally:
            started[0].kill()
            assert started[0].stdout
            started[0].stdout.close()


# Ctrl-C is heard whoever runs the tests: what is started in the background may ignore it.
INTERRUPTED = """\
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.path[:0] = [{tools!r}, {tests!r}]
from pathlib import Path
import test_prove as t
root = Path({root!r})
unit = t.find_units(root)["box"]
t.prove.end_as_by_ctrl_c()
t.Session(root, t.FakeTools(root), t.Choice((unit,), False, ("wp",), 2, root / "v")).run()
"""


class Interruption(TreeTest):
    def test_ctrl_c_leaves_no_report_and_no_process(self) -> None:
        self.interrupt(signal.SIGINT)

    def test_a_request_to_end_does_so_as_well(self) -> None:
        self.interrupt(signal.SIGTERM)

    def interrupt(self, number: signal.Signals) -> None:
        tools = FakeTools(self.root)
        tools.play(sleep=True)
        script = INTERRUPTED.format(
            tools=str(ROOT / "tools"), tests=str(Path(__file__).parent), root=str(self.root)
        )
        (self.root / "tmp").mkdir()
        process = subprocess.Popen(
            [sys.executable, "-c", script],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
            env={**os.environ, "TMPDIR": str(self.root / "tmp")},
        )
        self.assertTrue(wait_for(lambda: bool(running(str(self.root)))), "nothing was started")
        os.kill(process.pid, number)
        process.wait(timeout=WAIT_S)
        self.assertTrue(wait_for(lambda: not running(str(self.root))), running(str(self.root)))
        self.assertFalse((self.root / "build" / "prove" / "report.json").exists())
        self.assertEqual(list((self.root / "tmp").iterdir()), [])


def running(text: str) -> list[str]:
    """The command lines of running engines that contain a text."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            line = path.read_bytes().replace(b"\0", b" ").decode(errors="replace")
            if f"{text}/fake.py frama-c" in line and "-wp " in line:
                found.append(line)
    return found


class CommandLine(unittest.TestCase):
    def test_an_unknown_unit_is_named_with_those_there_are(self) -> None:
        error = io.StringIO()
        with contextlib.redirect_stderr(error), self.assertRaises(SystemExit) as stopped:
            prove.parse(["--unit", "box", "kite"], ["box", "sail"])
        self.assertEqual(stopped.exception.code, 2)
        self.assertIn("no such unit: kite (there are: box, sail)", error.getvalue())

    def test_a_tool_that_is_missing_is_no_traceback(self) -> None:
        error = io.StringIO()
        missing = ToolchainError("cbmc is missing")
        with (
            mock.patch.object(Toolchain, "ensure", side_effect=missing),
            contextlib.redirect_stderr(error),
        ):
            self.assertEqual(prove.main([]), 2)
        self.assertEqual(error.getvalue(), "prove: cbmc is missing\n")

    def refused(self, *words: str, **variables: str) -> str:
        """What the program says, as a user starts it, of something that could not be tried."""
        ended = subprocess.run(
            [sys.executable, str(ROOT / "tools/keel"), "prove", *words],
            env={**os.environ, **variables},
            capture_output=True,
            text=True,
            check=False,
            timeout=300,
        )
        self.assertEqual(ended.returncode, 2, ended.stdout + ended.stderr)
        return ended.stderr

    def test_what_could_not_be_tried_is_status_2(self) -> None:
        self.assertIn("no such unit: queu (there are: ", self.refused("--unit", "queu"))
        self.assertIn("unrecognized arguments: --units", self.refused("--units", "queue"))
        self.assertIn("/nowhere: there is no unit", self.refused("--project", "/nowhere"))

    def test_a_tool_that_is_missing_is_status_2(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            nothing = {"KEEL_NO_INSTALL": "1", "KEEL_CACHE": folder, "PATH": folder}
            told = "KEEL_NO_INSTALL=1 forbids to install"
            self.assertIn(told, self.refused("--unit", "clock", **nothing))
            # With what reads C, and with pip, it is a prover that is missing.
            reader = Path(Toolchain().command("c-syntax-packages")[0])
            (Path(folder) / "tools").mkdir()
            (Path(folder) / "tools" / reader.name).symlink_to(reader)
            (Path(folder) / "python3").symlink_to(sys.executable)
            said = self.refused("--unit", "clock", **nothing)
            self.assertRegex(said, f"prove: .*cbmc.*: missing; {told}")


class Logs(unittest.TestCase):
    def test_continued_messages_are_one(self) -> None:
        text = "[wp:pedantic-assigns] include/a.h:81: Warning: \n  No \\from\n  for it\n[wp] 3\n"
        [message] = wplog.read_log(text).messages
        self.assertEqual(
            (message.who, message.place, message.text),
            ("wp:pedantic-assigns", "include/a.h:81", "No \\from for it"),
        )

    def test_goals_of_lemmas(self) -> None:
        log = wplog.read_log("[wp] [Z3 4.8.12] Goal typed_lemma_PRI_scale : Valid (22890)\n")
        self.assertTrue(log.goals["lemma_PRI_scale"].proved)

    def test_a_failed_goal_tells_the_attempts(self) -> None:
        text = "[wp] [Failed] Goal typed_f_ensures\n  CVC4 1.8: Unknown (Qed:7ms)\n"
        self.assertEqual(wplog.read_log(text).goals["f_ensures"].attempts, ["CVC4 1.8: Unknown"])
