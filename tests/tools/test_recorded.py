# SPDX-License-Identifier: Apache-2.0
"""Tests of recorded provers: asked first and alone, never believed, and easy to record anew.

Frama-C is played by a small script.
"""

from __future__ import annotations

import dataclasses
import sys
from pathlib import Path
from typing import Any
from unittest import mock

from test_prove import GOALS, GOOD, TreeTest, WholeRunCase, wp_log, wp_report

from keel.base.jobs import Finished, Runner
from keel.c.project import ProjectError
from keel.engines import wp
from keel.judge import goals, wp_targets, wp_verdict

ROOT = Path(__file__).resolve().parents[2]

PUT = "keel_box_put"


class Lists(TreeTest):
    def read(self, text: str) -> goals.GoalList:
        self.unit.goal_list.write_text(text, encoding="utf-8")
        return goals.read_goals(self.unit.goal_list, "goals.txt")

    def test_a_goal_has_a_prover_or_none(self) -> None:
        read = self.read("a cvc4\nb\nc qed\nd pruned\n")
        self.assertEqual(read.names, ["a", "b", "c", "d"])
        self.assertEqual(read.provers, {"a": "cvc4", "c": "qed", "d": "pruned"})

    def test_an_unknown_prover_is_an_error_that_names_the_line(self) -> None:
        for text in ("a\nb simplify\n", "a\nb cvc4 z3\n"):
            with self.assertRaisesRegex(ProjectError, r"goals\.txt:2: .*, z3, qed, pruned"):
                self.read(text)

    def test_it_is_written_as_it_is_read(self) -> None:
        text = "a cvc4\nb\nc qed\n"
        read = self.read(text)
        self.assertEqual(goals.as_text(reversed(read.names), read.provers), text)

    def test_a_list_that_is_not_there_is_empty(self) -> None:
        self.assertEqual(goals.read_goals(self.root / "none", "none").names, [])

    def test_versions_are_not_recorded(self) -> None:
        shown = [goals.short_name(title) for title in ("Alt-Ergo 2.0.0", "Qed", "Script", "")]
        self.assertEqual(shown, ["alt-ergo", "qed", "", ""])


class Judgement(TreeTest):
    def judge(self, log: str, report: str, recorded: dict[str, str]) -> wp_targets.Result:
        target = wp_targets.Target(self.unit, self.unit.source, PUT)
        return wp_verdict.judge(target, log, report, self.root, (), recorded, frozenset([2]))

    def test_what_only_a_search_for_dead_branches_proves_is_pruned(self) -> None:
        running = "[wp] Running WP plugin..."
        tried = "[wp] [Alt-Ergo 2.0.0] Goal typed_keel_box_put_assigns : Timeout (2s)"
        early = self.judge(wp_log(running, *GOOD), wp_report(3, 3), {})
        self.assertEqual(early.pruned, [])
        late = wp_log(running, GOOD[0], tried, running, *GOOD[1:])
        self.assertEqual(self.judge(late, wp_report(3, 3), {}).pruned, [f"{PUT}_assigns"])
        later = wp_log(running, GOOD[0], tried, running, tried, running, *GOOD[1:])
        self.assertEqual(self.judge(later, wp_report(3, 3), {}).pruned, [])

    def test_whoever_proves_what_is_recorded_as_pruned_is_right(self) -> None:
        result = self.judge(wp_log(*GOOD), wp_report(3, 3), {f"{PUT}_assigns": "pruned"})
        self.assertEqual(result.stale, [])

    def test_another_prover_than_the_recorded_one_is_told(self) -> None:
        recorded = {f"{PUT}_assigns": "cvc4", f"{PUT}_ensures_BOX_001": "qed"}
        result = self.judge(wp_log(*GOOD), wp_report(3, 3), recorded)
        self.assertEqual(result.problems, [])
        self.assertEqual(result.stale, [f"{PUT}_assigns: recorded is cvc4, but alt-ergo proved it"])

    def test_what_qed_proves_needs_no_prover(self) -> None:
        recorded = {f"{PUT}_ensures_BOX_001": "cvc4", f"{PUT}_assigns": "alt-ergo"}
        self.assertEqual(self.judge(wp_log(*GOOD), wp_report(3, 3), recorded).stale, [])

    def test_what_is_recorded_proves_nothing(self) -> None:
        log = wp_log(GOOD[0], GOOD[1].replace("Valid", "Timeout"), GOOD[2])
        result = self.judge(log, wp_report(3, 2, f"{PUT}_assigns"), {f"{PUT}_assigns": "alt-ergo"})
        self.assertIn(f"{PUT}_assigns is not proved", result.problems[0])

    def test_a_list_without_provers_tells_nothing(self) -> None:
        self.assertEqual(self.judge(wp_log(*GOOD), wp_report(3, 3), {}).stale, [])


# Frama-C as far as lemmas need it: CVC4 is the only one who can prove them.
LEMMAS = """\
import json, os, sys
arguments = sys.argv[1:]
if "-print-lib-path" in arguments:
    sys.exit()
named = [word.partition("=")[2] for word in arguments if word.startswith("-wp-prover=")]
with open("asked", "a") as stream:
    stream.write(" ".join(named) + "\\n")
provers = set(",".join(named).split(","))
status = "Valid" if "cvc4" in provers else "Timeout"
print(f"[wp] [CVC4 1.8] Goal typed_lemma_BOX_two : {status} (1ms)")
entry = {"wp:main": {"total": 1, "valid": int(status == "Valid")}}
report = {"wp:global": entry, "wp:axiomatics": {"": {"lemma_BOX_two": entry}}}
open(arguments[arguments.index("-wp-report-json") + 1], "w").write(json.dumps(report))
"""


class Asking(TreeTest):
    def setUp(self) -> None:
        super().setUp()
        (self.root / "m.ml").write_text("", encoding="utf-8")
        (self.root / "lemmas.py").write_text(LEMMAS, encoding="utf-8")
        frama_c = [sys.executable, str(self.root / "lemmas.py")]
        frama_c += ["-load-script", str(self.root / "m.ml")]
        runner = Runner({}, self.root)
        self.prover = wp.Wp(frama_c, runner, self.root, self.root, ocamlfind=["true"])
        self.function = wp_targets.Target(self.unit, self.unit.source, PUT)
        self.lemmas = wp_targets.Target(self.unit, self.unit.source, None, ("BOX_two",))

    def asked(self, recorded: dict[str, str]) -> list[str]:
        (self.root / "asked").unlink(missing_ok=True)
        result = self.prover.prove(self.lemmas, recorded=recorded)
        self.assertEqual(result.problems, [])
        return (self.root / "asked").read_text(encoding="utf-8").splitlines()

    def test_a_lemma_is_tried_by_its_prover_alone(self) -> None:
        self.assertEqual(self.asked({"lemma_BOX_two": "cvc4"}), ["cvc4"])

    def test_lemmas_of_several_provers_have_a_pass_each(self) -> None:
        names = ("BOX_one", "BOX_two", "BOX_three")
        lemmas = wp_targets.Target(self.unit, self.unit.source, None, names)
        recorded = {f"lemma_{name}": "cvc4" for name in names} | {"lemma_BOX_two": "z3"}
        run = mock.Mock(return_value=Finished(0, ""))
        with mock.patch.object(Runner, "run", run):
            self.prover._prove_lemmas(lemmas, (), recorded)
        [command] = run.call_args.args
        chosen = [command[i + 1] for i, word in enumerate(command) if word == "-wp-prop"]
        self.assertEqual(chosen, ["BOX_one,BOX_three", "BOX_two"])
        provers = [word for word in command if word.startswith("-wp-prover=")]
        self.assertEqual(provers, ["-wp-prover=cvc4", "-wp-prover=-cvc4,z3"])

    def test_a_lemma_whose_prover_fails_is_tried_by_all(self) -> None:
        self.assertEqual(self.asked({"lemma_BOX_two": "z3"}), ["z3", "alt-ergo,cvc4,z3"])

    def test_a_lemma_without_prover_is_tried_by_all(self) -> None:
        for recorded in ({}, {"lemma_BOX_two": "qed"}):
            self.assertEqual(self.asked(recorded), ["alt-ergo,cvc4,z3"])

    def test_the_recorded_pass_comes_before_the_others(self) -> None:
        report = self.root / "r.json"
        plain = self.prover.command(self.function, wp.THOROUGH, True, report)
        command = self.prover.command(self.function, wp.THOROUGH, True, report, True)
        first = command[: command.index("-then")]
        self.assertEqual(sum("ask_recorded.cmxs" in word for word in first), 1)
        self.assertNotIn("-wp", first)
        # All passes that there are without it follow.
        rest = command[command.index("-then") + 2 :]
        self.assertEqual(rest, plain[len(plain) - len(rest) :])
        self.assertEqual(rest[0], "-wp")

    def test_of_a_function_that_is_left_to_cbmc_in_part_the_rest_is_selected(self) -> None:
        whole, part = (None, [PUT], 0), (("BOX_3",), [PUT, "-@ensures", "-BOX_3"], 1)
        for left, told, options in (whole, part):
            target = dataclasses.replace(self.function, left=left)
            file = self.prover._recorded_file(target, {f"{PUT}_assigns": "z3"})
            assert file
            lines = file.read_text(encoding="utf-8").splitlines()
            self.assertEqual(lines, [" ".join(told), f"{PUT}_assigns z3"])
            command = self.prover.command(target, wp.QUICK, True, self.root / "r.json", True)
            first = command[: command.index("-then")]
            self.assertEqual(first.count("-warn-special-float"), options)

    def test_the_search_for_dead_branches_comes_first_where_a_goal_is_recorded_for_it(self) -> None:
        for name, expected in (("cvc4", [False, True, False]), ("pruned", [True, False, False])):
            run = mock.Mock(return_value=Finished(0, ""))
            with mock.patch.object(Runner, "run", run), mock.patch.object(wp, "judge") as judged:
                recorded = {f"{PUT}_assigns": name, f"{PUT}_b": "z3"}
                self.prover.prove(self.function, wp.THOROUGH, False, recorded=recorded)
            [command] = run.call_args.args
            searched = [
                word == "-wp-pruning"
                for word in command[command.index("-then") :]
                if word.endswith("-pruning") or word == "-wp-no-pruning"
            ]
            self.assertEqual(searched, expected)
            self.assertEqual(judged.call_args.args[-1], frozenset([expected.index(True) + 1]))

    def test_a_goal_of_another_function_does_not_change_the_order(self) -> None:
        run = mock.Mock(return_value=Finished(0, ""))
        with mock.patch.object(Runner, "run", run):
            self.prover.prove(self.function, wp.THOROUGH, recorded={"helper_b": "pruned"})
        [command] = run.call_args.args
        self.assertLess(command.index("-wp-no-pruning"), command.index("-wp-pruning"))

    def recorded(self, provers: dict[str, str]) -> list[str]:
        file = self.prover._recorded_file(self.function, provers)
        return file.read_text(encoding="utf-8").splitlines() if file else []

    def test_frama_c_is_told_the_function_and_its_goals(self) -> None:
        provers = {f"{PUT}_a": "z3", f"{PUT}_b": "qed", f"{PUT}_c": "cvc4", "helper_a": "z3"}
        told = [PUT, f"{PUT}_a z3", f"{PUT}_b cvc4", f"{PUT}_c cvc4"]
        self.assertEqual(self.recorded(provers), told)

    def test_goals_that_qed_proves_need_no_pass_of_their_own(self) -> None:
        self.assertEqual(self.recorded({f"{PUT}_b": "qed", "helper_a": "z3"}), [])
        self.assertEqual(self.recorded({f"{PUT}_b": "pruned"}), [])


class Recording(WholeRunCase):
    def test_provers_are_recorded_with_the_goals(self) -> None:
        self.assertEqual(self.prove(update=True)[0], 0)
        text = self.unit.goal_list.read_text(encoding="utf-8")
        self.assertIn("keel_box_put_assigns alt-ergo\n", text)
        self.assertEqual(self.prove()[0], 0)

    def test_a_prover_that_would_be_asked_in_vain_is_not_recorded(self) -> None:
        self.unit.goal_list.write_text(f"{PUT}_assigns alt-ergo\n", encoding="utf-8")

        def late(*arguments: Any) -> wp_targets.Result:
            result = wp_verdict.judge(*arguments)
            result.pruned = [f"{PUT}_assigns"]
            return result

        with mock.patch.object(wp, "judge", late):
            self.prove(update=True)
        text = self.unit.goal_list.read_text(encoding="utf-8")
        self.assertIn(f"{PUT}_assigns pruned\n", text)

    def test_a_goal_that_is_not_proved_keeps_its_prover(self) -> None:
        broken: dict[str, Any] = {**GOALS, PUT: {"ensures_BOX_001": "Timeout", "assigns": "Valid"}}
        self.unit.goal_list.write_text(f"{PUT}_ensures_BOX_001 cvc4\n", encoding="utf-8")
        self.play(goals=broken)
        self.assertEqual(self.prove(update=True)[0], 1)
        text = self.unit.goal_list.read_text(encoding="utf-8")
        self.assertIn(f"{PUT}_ensures_BOX_001 cvc4\n", text)
        self.assertIn(f"{PUT}_assigns alt-ergo\n", text)

    def test_a_stale_prover_is_told_and_is_no_failure(self) -> None:
        text = self.unit.goal_list.read_text(encoding="utf-8")
        self.unit.goal_list.write_text(text.replace("put_assigns", "put_assigns z3"), "utf-8")
        status, output, report = self.prove()
        told = f"{PUT}_assigns: recorded is z3, but alt-ergo proved it"
        self.assertEqual(status, 0, output)
        self.assertIn(f"note   {told}", output)
        self.assertEqual(report["units"]["box"]["wp"]["stale_provers"], [told])
        self.assertEqual(self.prove()[2]["units"]["box"]["wp"]["stale_provers"], [told])
