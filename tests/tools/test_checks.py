# SPDX-License-Identifier: Apache-2.0
"""Tests of harnesses that check assertions alone, and of what a failing solver makes of a proof.

The last class runs CBMC with a solver that a test plays, and is skipped without CBMC.
"""

from __future__ import annotations

import json
import os
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

from test_prove import ASSERTED, HARNESS, TreeTest, WholeRunCase, cbmc_output, item

from keel.audit import completeness
from keel.base.jobs import Finished, Runner
from keel.c.project import ProjectError, find_units
from keel.engines import cbmc
from keel.install import Toolchain, ToolchainError
from keel.judge import cbmc_answers, harness
from keel.prove import job_list

ROOT = Path(__file__).resolve().parents[2]

ALONE = "// checks: assertions\n" + HARNESS
CASE = HARNESS.replace("keel_box_put_harness", "keel_box_put__all_harness")
MODEL = """\
static int twice(int x)
{
    return x + x;
}

void model_box_put(int *box, int value)
{
    *box = value;
}
"""


class Directive(TreeTest):
    def read(self, text: str, name: str = "keel_box_put_harness") -> harness.Harness:
        path = self.unit.folder / f"{name}.c"
        path.write_text(text, encoding="utf-8")
        return harness.read_harness(self.unit, path)

    def test_only_the_choice_of_assertions_is_one(self) -> None:
        self.assertFalse(self.read(HARNESS).assertions_only)
        self.assertTrue(self.read(ALONE).assertions_only)
        for other in ("none", "", "assertions bounds"):
            with self.subTest(other), self.assertRaisesRegex(ProjectError, "`checks` takes"):
                self.read(ALONE.replace("checks: assertions", f"checks: {other}"))

    def test_prose_behind_an_empty_line_is_no_directive(self) -> None:
        prose = "//\n// All other\n// checks: keel_box_put__all_harness.c\n"
        read = self.read(ALONE.replace("#include", f"{prose}#include", 1))
        self.assertTrue(read.assertions_only)

    def test_unwinding_is_checked_in_any_case(self) -> None:
        alone = cbmc.checks_of(self.read(ALONE))
        self.assertIn("--unwinding-assertions", alone)
        self.assertNotIn("--bounds-check", alone)
        self.assertEqual(cbmc.checks_of(self.read(HARNESS)), cbmc.CHECKS)

    def test_the_formula_is_sliced_but_for_z3_and_a_trace_which_is_to_show_all(self) -> None:
        checker = cbmc.Cbmc(["goto-cc"], ["cbmc"], Runner({}, self.root), self.root, self.root)
        run = mock.Mock(return_value=Finished(0, "[]"))
        for extra, sliced in (((), True), (("--property", "a"), True), (("--trace",), False)):
            with self.subTest(extra), mock.patch.object(Runner, "run", run):
                checker.check(self.read(HARNESS), self.root / "harness.gb", extra)
                self.assertEqual(cbmc.SLICE in run.call_args.args[0], sliced)
        with mock.patch.object(Runner, "run", run):
            z3 = HARNESS.replace("--external-sat-solver cadical", "--z3")
            checker.check(self.read(z3), self.root / "harness.gb")
        self.assertNotIn(cbmc.SLICE, run.call_args.args[0])

    def test_the_choice_is_part_of_the_key(self) -> None:
        checker = cbmc.Cbmc(["goto-cc"], ["cbmc"], Runner({}, self.root), self.root, self.root)
        keys = {
            job_list.cbmc_key(self.read(text), checker, self.root, {"z3": version})
            for text in (HARNESS, ALONE)
            for version in ("4.8.12", "4.9")
        }
        self.assertEqual(len(keys), 4)

    def test_the_solvers_are_those_whose_versions_are_in_every_key(self) -> None:
        lock = json.loads((ROOT / "tools/toolchain.lock.json").read_text(encoding="utf-8"))
        self.assertLessEqual({"z3", *harness.EXTERNAL}, set(lock["groups"]["prove"]))
        for option in ("--cvc5", "--external-sat-solver ./yes", "--external-sat-solver minisat"):
            with self.subTest(option), self.assertRaises(ProjectError):
                self.read(HARNESS.replace("--external-sat-solver cadical", option))

    def test_the_coverage_run_does_without_z3(self) -> None:
        options = self.read(HARNESS.replace("--external-sat-solver cadical", "--z3 --fpa")).options
        self.assertEqual(options, ("--unwind", "3", "--z3", "--fpa"))
        self.assertEqual(harness.without_solver(list(options)), ["--unwind", "3"])

    def test_another_harness_must_make_all_checks(self) -> None:
        alone = self.read(ALONE)
        [problem] = harness.unchecked([alone])
        self.assertIn("no other harness of keel_box_put on the same sources", problem)
        self.assertEqual(harness.unchecked([self.read(HARNESS)]), [])
        self.assertEqual(harness.unchecked([alone, self.case(CASE)]), [])

    def case(self, text: str) -> harness.Harness:
        return self.read(text, "keel_box_put__all_harness")

    def test_the_other_one_must_look_at_the_same(self) -> None:
        alone = self.read(ALONE.replace("covers: ", "covers: helper "))
        [problem] = harness.unchecked([alone, self.case(CASE)])
        self.assertIn("covers helper with all checks", problem)
        (self.root / "src/rtos/copy.c").write_text("", encoding="utf-8")
        copied = "// sources: src/rtos/copy.c\n" + CASE
        self.assertEqual(len(harness.unchecked([alone, self.case(copied)])), 2)
        lazy = self.case("// checks: assertions\n" + CASE)
        self.assertEqual(len(harness.unchecked([alone, lazy])), 3)

    def test_a_model_bears_no_checks(self) -> None:
        model = self.root / "specs/model/box.c"
        model.parent.mkdir(parents=True)
        model.write_text(MODEL, encoding="utf-8")
        alone = self.read(
            "// sources: src/rtos/box.c specs/model/box.c\n"
            + ALONE.replace("covers: ", "covers: twice model_box_put ")
        )
        self.assertEqual(harness.unchecked([alone, self.case(CASE)]), [])
        model.write_text(
            MODEL.replace("    *box", "    __CPROVER_assume(0);\n    *box"), encoding="utf-8"
        )
        self.assertEqual(len(completeness.assumptions_in([model], self.root)), 1)


class Report(WholeRunCase):
    def test_such_harnesses_are_named_and_refused_without_another(self) -> None:
        (self.unit.folder / "keel_box_put_harness.c").write_text(ALONE, encoding="utf-8")
        located = json.loads(json.dumps(ASSERTED).replace('"9"', '"10"'))
        covered = [
            {
                "goals": [
                    self.block("keel_box_put_harness", "8-11"),
                    self.block("keel_box_put", "15"),
                ],
                "goalsCovered": 2,
            }
        ]
        self.play(cbmc=json.loads(cbmc_output(located)), cover=covered)
        status, output, report = self.prove()
        self.assertEqual(status, 1)
        self.assertIn("checked for assertions and unwinding alone: keel_box_put_harness", output)
        entry = report["units"]["box"]["cbmc"]
        self.assertEqual(entry["assertions_only"], ["keel_box_put_harness"])
        self.assertEqual(entry["harnesses"]["keel_box_put_harness"]["checks"], "assertions")
        self.assertEqual(len(report["problems"]), 1, report["problems"])
        self.assertIn("no other harness of keel_box_put", report["problems"][0])

    @staticmethod
    def block(function: str, lines: str) -> dict[str, Any]:
        file = "proofs/box/keel_box_put_harness.c" if "harness" in function else "src/rtos/box.c"
        location = {"file": file, "function": function, "line": lines.split("-")[0]}
        return {
            "basicBlockLines": {file: {function: lines}},
            "sourceLocation": location,
            "status": "satisfied",
        }


class Solver(unittest.TestCase):
    """What CBMC 6.6 says when its solver does not answer."""

    def test_an_error_of_the_solver_is_no_proof(self) -> None:
        failed = item("h.assertion.2", "ERROR", "BOX_002: equal")
        text = json.dumps([{"result": [ASSERTED, failed]}, {"cProverStatus": "error"}])
        problems = cbmc_answers.proof_problems(cbmc_answers.read_answer(text))
        self.assertTrue(any("BOX_002: equal: ERROR" in problem for problem in problems), problems)
        self.assertIn("CBMC did not finish", problems)

    def test_an_error_is_an_answer_neither_way(self) -> None:
        answer = cbmc_answers.read_answer(json.dumps([{"cProverStatus": "error"}]))
        self.assertEqual((answer.complete, answer.failed), (False, False))


def cbmc_tools() -> Toolchain | None:
    """The tools, if CBMC is among them."""
    try:
        tools = Toolchain()
        tools.command("cbmc")
    except ToolchainError:
        return None
    return tools


SUM = HARNESS.replace("--external-sat-solver cadical", "--z3 --fpa").replace(
    "    keel_box_put(&box, 7);\n",
    "    float f;\n    float g = f;\n    keel_box_put(&box, 7);\n"
    '    __CPROVER_assert(!(f + 1.0f > g + 1.0f), "BOX_002: the same sum");\n',
)
HARD = (
    SUM.replace(
        "\nvoid",
        """
static int differ(float f, float g)
{
    if (f * g < g * f) {
        return 1;
    }
    return 0;
}

void""",
    )
    .replace("float g = f;", "float g;")
    .replace("!(f + 1.0f > g + 1.0f)", "differ(f, g) == 0")
)


@unittest.skipUnless(cbmc_tools(), "needs CBMC")
class PlayedSolver(TreeTest):
    def checker(self, z3: str) -> cbmc.Cbmc:
        """CBMC, with a z3 that runs these commands."""
        tools = cbmc_tools()
        assert tools
        bin_folder = self.root / "bin"
        bin_folder.mkdir(exist_ok=True)
        player = bin_folder / "z3"
        player.write_text(f"#!/bin/sh\n{z3}\n", encoding="utf-8")
        player.chmod(0o755)
        variables = {**os.environ, **tools.environment()}
        variables["PATH"] = f"{bin_folder}{os.pathsep}{variables['PATH']}"
        runner = Runner(variables, self.root)
        return cbmc.Cbmc(tools.goto_cc(), tools.command("cbmc"), runner, self.root, self.root)

    def read(self, text: str, timeout: int) -> harness.Harness:
        path = self.unit.folder / "keel_box_put_harness.c"
        path.write_text(f"// checks: assertions\n// timeout: {timeout}\n{text}", encoding="utf-8")
        return harness.read_harness(find_units(self.root)["box"], path)

    def prove(self, answer: str, timeout: int = 60) -> list[str]:
        """What is wrong with a proof by CBMC, with this answer of z3, in so many seconds."""
        checker = self.checker(answer)
        read = self.read(SUM, timeout)
        binary, complaint = checker.build(read, read.name)
        self.assertEqual(complaint, "")
        return cbmc_answers.proof_problems(checker.check(read, binary))

    def test_only_unsat_proves(self) -> None:
        self.assertEqual(self.prove("echo unsat"), [])

    def test_what_is_not_to_be_covered_does_not_hold_up_the_coverage_run(self) -> None:
        """Whether a product differs with its factors swapped takes a SAT solver for ever."""
        result = self.checker("echo unsat").prove(self.read(HARD, 60))
        self.assertEqual(result.problems, [])
        self.assertEqual((result.covered, result.blocks), (1, 1))

    def test_anything_else_is_a_failure(self) -> None:
        for answer in (
            "echo unknown",
            "kill -SEGV $$",
            "exit 1",
            "echo timeout",
            "echo '(error \"no such logic\")'; echo unsat",
        ):
            with self.subTest(answer):
                self.assertIn("CBMC did not finish", self.prove(answer))

    def test_no_answer_in_time_is_a_failure(self) -> None:
        self.assertIn("CBMC did not finish", self.prove("sleep 20", 2))
