# SPDX-License-Identifier: Apache-2.0
"""Tests of `make evidence` as a whole: one fault at a time in a small project or its reports, and
no package is made, the cause is named, and the package that was there stays.

That each part sees each fault of its own is tested in test_evidence_<part>.py.
"""

from __future__ import annotations

import json
from typing import Any
from unittest import mock

from evidence_project import HARNESS, HEADER, VERSION, WholeProject

from keel.base.files import write_text
from keel.base.source import STAMP, VERDICT
from keel.evidence.package import SUMS, digests

GOAL = "keel_widget_turn_ensures_WID_001_turns"
OLDER = f"""\
[tools.a]
cbmc = "{VERSION}"
[unit.widget]
source = "{"0" * 64}"
proofs = "{"0" * 64}"
tools = "a"
killers = []
mutants = 1
killed = {{executed = 0, solved = 0, wp = 1}}
stillborn = 0
same_code = {{}}
accepted = []
open = []
problems = []
"""
ELSEWHERE = "speaks of another source than the one that is here"


class Whole(WholeProject):
    """Without a fault."""

    def test_a_good_project_gives_packages_that_differ_in_seconds_alone(self) -> None:
        places = [self.folder / name for name in ("one", "other")]
        for place, seconds in zip(places, (1.5, 99.25), strict=True):
            self.write_reports(seconds)
            status, lines = self.run_it("--as-is", "--out", str(place))
            self.assertEqual(status, 0, lines)
            self.assertEqual(self.run_it("--verify", str(place))[0], 0)
        took = json.loads((places[1] / "measured.json").read_text(encoding="utf-8"))
        self.assertEqual(took["seconds"]["formal"], {"widget/wp/lemmas": 99.25})
        self.assertEqual(set(took["seconds"]["tests"].values()), {99.25})
        same = ["--same", *map(str, places)]
        status, lines = self.run_it(*same)
        self.assertEqual(status, 0, lines)
        self.assertIn("the same but for measured seconds", lines[-1])
        (places[1] / "formal/part.json").write_text("{}", encoding="utf-8")
        status, lines = self.run_it(*same)
        self.assertEqual(status, 1)
        told = f"FAILED formal/part.json: was altered, {places[0]} has another digest"
        self.assertIn(told, lines)

    def test_a_file_of_the_finished_package_that_was_altered(self) -> None:
        self.write_reports()
        self.assertEqual(self.run_it()[0], 0)
        page = self.out / "index.html"
        page.write_text(page.read_text(encoding="utf-8") + " ", encoding="utf-8")
        status, lines = self.run_it("--verify", str(self.out))
        self.assertEqual(status, 1)
        self.assertIn(f"FAILED index.html: was altered, {SUMS} has another digest", lines)


class Faults(WholeProject):
    """One fault each."""

    def setUp(self) -> None:
        super().setUp()
        (self.out / "site").mkdir(parents=True)
        (self.out / "evidence.json").write_text("{}", encoding="utf-8")
        (self.out / "site/page.html").write_text("an older package", encoding="utf-8")
        self.before = digests(self.out)

    def refused(self, *causes: str) -> None:
        """No package is made, each cause is told, and what was there is as it was."""
        status, lines = self.run_it()
        self.assertEqual(status, 1, lines)
        told = [line for line in lines if line.startswith("FAILED ")]
        for cause in causes:
            self.assertTrue(any(cause in line for line in told), f"{cause!r} in none of {told}")
        self.assertRegex(lines[-1], r"^evidence: \d+ problems?, nothing is written")
        self.assertEqual(digests(self.out), self.before)
        self.assertEqual(list(self.folder.glob(".*")), [])

    def report(self, name: str, **changes: Any) -> dict[str, Any]:
        """Change a report's fields, and write it."""
        path = self.root / "build" / name
        read: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        self.write_report(name, {**read, **changes})
        return read

    def test_a_proof_that_failed(self) -> None:
        self.write_reports()
        units = self.report("prove/report.json")["units"]
        units["widget"]["wp"]["goal_list"][1]["status"] = "Timeout"
        self.report(
            "prove/report.json", units=units, verdict="failed", problems=[f"goal {GOAL}: Timeout"]
        )
        self.refused(
            "build/prove/report.json: its verdict is 'failed': make prove",
            f"formal: goal {GOAL}: Timeout",
            f"requirements: WID-001: goal widget/{GOAL}: Timeout",
        )

    def test_a_proof_that_failed_under_a_verdict_that_is_good(self) -> None:
        self.write_reports()
        units = self.report("prove/report.json")["units"]
        units["widget"]["wp"]["goal_list"][1]["status"] = "Timeout"
        self.report("prove/report.json", units=units)
        self.refused(f"formal: goal widget/{GOAL}: not proved, WP says Timeout")

    def test_a_harness_that_was_removed(self) -> None:
        (self.root / HARNESS).unlink()
        (self.root / "proofs/widget/assertions.txt").write_text("", encoding="utf-8")
        self.write_reports()
        units = self.report("prove/report.json")["units"]
        self.assertEqual(units["widget"]["cbmc"]["harnesses"], {})
        self.refused(
            "function keel_widget_turn: build/prove/report.json has no harness of it",
            "WID-001: neither a harness nor a test names it",
        )

    def test_a_label_that_was_dropped(self) -> None:
        self.change(HEADER, "ensures WID_001_turns:", "ensures turns:")
        self.write_reports()
        self.refused("WID-001: CLAUSES is not what the headers say")

    def test_a_requirement_that_nothing_traces_to(self) -> None:
        alone = (
            "\n[REQUIREMENT]\nUID: WID-004\nTITLE: Alone\nVERIFICATION: proof\n"
            "STATEMENT: It shall stand alone.\n"
        )
        self.change("specs/requirements/widget.sdoc", "for ever.\n", f"for ever.\n{alone}")
        self.write_reports()
        self.refused("WID-004: no clause states it")

    def test_a_function_that_traces_to_nothing(self) -> None:
        self.change(
            "src/rtos/widget.c",
            "static void nudge",
            "void keel_extra(void)\n{\n}\n\nstatic void nudge",
        )
        self.write_reports()
        self.refused("keel_extra")

    def test_a_test_that_failed(self) -> None:
        self.write_reports()
        suites = self.report("test/report.json")["suites"]
        suites["unit/widget"]["tests"]["it_loops"] = "failed"
        self.report("test/report.json", suites=suites, failed=1, verdict="failed")
        self.refused(
            "build/test/report.json: its verdict is 'failed': make test",
            "tests: unit/widget/it_loops failed on the host",
        )

    def test_a_stale_result_of_mutation_is_told_before_any_command_is_run(self) -> None:
        write_text(self.root / "specs/mutation.toml", OLDER)
        with mock.patch.object(self.program, "run_commands") as run:
            status, lines = self.run_it("--dirty", "--out", str(self.out))
        run.assert_not_called()
        self.assertEqual(status, 1)
        self.assertEqual(
            lines[-2],
            "FAILED specs/mutation.toml: widget: is stale, source, proofs"
            " changed since: make mutate again",
        )
        self.assertIn("no command is run, nothing is written", lines[-1])

    def test_reports_of_an_older_source(self) -> None:
        self.write_reports()
        self.change("tests/unit/test_widget.c", "it_loops);", "it_loops); /* more */")
        self.refused(
            f"build/test/report.json: {ELSEWHERE}", f"build/prove/report.json: {ELSEWHERE}"
        )

    def test_a_source_that_changed_after_its_proof(self) -> None:
        self.write_reports()
        proved = self.report("prove/report.json")
        self.change("src/rtos/widget.c", "nudge();", "nudge(); /* again */")
        self.write_reports()
        self.write_report("prove/report.json", proved)
        self.refused(f"build/prove/report.json: {ELSEWHERE}", "object: toy: the source built (")

    def test_a_source_that_changes_meanwhile(self) -> None:
        self.write_reports()
        assemble = self.program.assemble

        def and_then_it_changes(context: Any) -> Any:
            made = assemble(context)
            self.change("src/rtos/widget.c", "nudge();", "nudge(); /* again */")
            return made

        self.program.assemble = and_then_it_changes
        self.refused("the source has changed meanwhile")

    def test_a_project_that_is_not_there_is_not_made(self) -> None:
        absent = self.folder / "projct"
        status, lines = self.run_it("--as-is", "--project", str(absent))
        self.assertEqual((status, lines), (2, [f"evidence: {absent}: there is no such folder"]))
        self.assertFalse(absent.exists())

    def test_a_tool_of_a_wrong_version(self) -> None:
        self.write_reports()
        self.report("lint/report.json", tools={"cbmc": "6.5.0"})
        self.refused("tools: build/lint/report.json: was made with cbmc 6.5.0, locked is")

    def test_a_tool_that_is_missing(self) -> None:
        self.write_reports()
        self.tool = None
        self.refused("tools: cbmc: is missing on this machine")

    def test_a_report_of_another_commit(self) -> None:
        self.write_reports()
        stamp = self.report("test/report.json")[STAMP]
        self.report("test/report.json", **{STAMP: {**stamp, "commit": "c" * 40}})
        self.refused(f"tests: build/test/report.json: {ELSEWHERE}")

    def test_a_report_that_is_half_written(self) -> None:
        self.write_reports()
        path = self.root / "build/prove/report.json"
        text = path.read_text(encoding="utf-8")
        path.write_text(text[: len(text) // 2], encoding="utf-8")
        self.refused("formal: build/prove/report.json: is not whole")

    def test_a_report_that_is_missing_and_one_without_a_verdict(self) -> None:
        self.write_reports()
        (self.root / "build/coverage/report.json").unlink()
        read = self.report("opinion/report.json")
        del read[VERDICT]
        self.write_report("opinion/report.json", read)
        self.refused(
            "tests: build/coverage/report.json: is missing",
            "build/opinion/report.json: has no verdict: make check NAME=opinion",
        )
