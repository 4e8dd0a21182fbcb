# SPDX-License-Identifier: Apache-2.0
"""Tests of the part `tools` of the evidence package, and of `make check NAME=qualify`: wrong
versions, other files, entries that are missing, and tools that no longer detect a fault.
"""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest import mock

from evidence_sample import STAMP, PartTest

from keel.base.errors import ToolError
from keel.base.files import write_text
from keel.base.source import PRODUCT
from keel.base.source import STAMP as MADE_FROM
from keel.base.verdict_cache import Cache
from keel.gather.part import Context
from keel.gather.parts import tools as part_tools
from keel.gather.parts.tools import SETTINGS, Settings
from keel.install import Found, Toolchain
from keel.install.lock import Spec
from keel.qualify import command as qualify
from keel.qualify import mistakes
from keel.qualify.board_trials import TRIALS
from keel.qualify.mistakes import TABLE, read_mistakes
from keel.qualify.seeds import SEEDS

ROOT = Path(__file__).resolve().parents[2]

RUN = {"tool": "cbmc", "fault": "an overflow", "how": "cbmc", "version": "6.6.0", "wrong": ""}
PINNED = Spec("cbmc", "deb", at_least="6.6", below="6.7", sha256="aa")


def cbmc(version: str = "6.6.0", digest: str = "aa", program: str = "01") -> dict[str, Found]:
    """What is found of one tool."""
    parts = [{"name": "cbmc", "version": version, "sha256": digest}]
    return {"cbmc": Found("cbmc", version, "cache", "/x", program, 1, 1, {}, {}, parts)}


class Rules(unittest.TestCase):
    """One rule, one fault."""

    specs = {"cbmc": PINNED}

    def identity(self, found: dict[str, Found]) -> list[str]:
        return list(part_tools.identity_problems(self.specs, found))

    def test_the_locked_tool_is_good(self) -> None:
        self.assertEqual(self.identity(cbmc()), [])

    def test_a_wrong_version(self) -> None:
        told = "cbmc: is 6.7.1, locked is 6.6 or later, before 6.7"
        self.assertEqual(self.identity(cbmc("6.7.1")), [told])

    def test_another_package_than_the_pinned_one(self) -> None:
        told = "cbmc: what was fetched is not what is pinned (aa)"
        self.assertEqual(self.identity(cbmc(digest="bb")), [told])

    def test_a_tool_that_is_missing(self) -> None:
        self.assertEqual(self.identity({}), ["cbmc: is missing on this machine"])

    def report(self, told: Any) -> list[str]:
        report = {"tools": {"cbmc": told, "stranger": "1"}}
        return list(part_tools.report_problems("x.json", report, self.specs, cbmc()))

    def test_a_report_made_with_the_tools_that_are_here(self) -> None:
        self.assertEqual(self.report("6.6.0"), [])
        self.assertEqual(self.report({"version": "6.6.0", "sha256": "01"}), [])

    def test_a_report_made_with_another_version_or_file(self) -> None:
        for told, problem in (
            ("6.5.0", "build/x.json: was made with cbmc 6.5.0, locked is 6.6 or later, before 6.7"),
            ("6.6.1", "build/x.json: was made with cbmc 6.6.1, here is 6.6.0"),
            (
                {"version": "6.6.0", "sha256": "02"},
                "build/x.json: was made with another file of cbmc than the one that is here",
            ),
        ):
            self.assertEqual(self.report(told), [problem])

    def test_a_tool_without_an_entry_and_an_entry_without_a_tool(self) -> None:
        problems = part_tools.entry_problems(Settings(tool=[]), self.specs, ROOT)
        self.assertEqual(list(problems), ["specs/tools.toml: tool cbmc has no entry"])


class Entries(unittest.TestCase):
    """The file of tools."""

    def test_a_known_problem_of_no_tool_is_refused_with_its_line(self) -> None:
        with tempfile.TemporaryDirectory(prefix="keel-test-") as folder:
            (Path(folder) / "specs").mkdir()
            text = (ROOT / SETTINGS).read_text()
            text += '\n[[problem]]\ntool = "cmbc"\nsource = "s"\nwhat = "w"\nhere = "h"\n'
            (Path(folder) / SETTINGS).write_text(text)
            context = Context(Path(folder), Path(folder), Path(folder), STAMP, lambda _: None)
            with self.assertRaisesRegex(ToolError, "there is no tool cmbc"):
                part_tools.make(context)

    def refused(self, tool: str, old: str, new: str) -> str:
        """What the file is refused with when the entry of a tool is changed."""
        head, _, rest = (ROOT / SETTINGS).read_text().partition(f'name = "{tool}"\n')
        self.assertIn(old, rest.partition("[[")[0])
        with tempfile.TemporaryDirectory(prefix="keel-test-") as folder:
            (Path(folder) / "specs").mkdir()
            text = f'{head}name = "{tool}"\n{rest.replace(old, new, 1)}'
            (Path(folder) / SETTINGS).write_text(text)
            with self.assertRaises(ToolError) as caught:
                part_tools.read_settings(Path(folder))
        return str(caught.exception)

    def test_a_review_that_does_not_say_when_where_or_what_it_left(self) -> None:
        for old, new, told in (
            ("on = 2026-11-22\n", "", "read, but on does not say when"),
            ('left = "The vendor\'s tracker"\n', "", "left does not say what was not read"),
            ('known = "read"', 'known = "complete"', "known"),
            ("on = 2026-11-22", "on = 2026-13-22", "no TOML"),
        ):
            self.assertRegex(self.refused("why3", old, new), rf"tools\.toml:\d+: .*({told})")
        without = self.refused("cadical", "sources = [", "#")
        self.assertRegex(without, r"tool cadical: .*read, but no source is named")

    def test_an_open_review_needs_no_source_but_says_what_was_searched(self) -> None:
        read = part_tools.read_settings(ROOT).tool[0]
        opened = read.model_copy(update={"known": "open", "sources": []})
        self.assertEqual(list(part_tools.review_slips(opened)), [])
        silent = opened.model_copy(update={"left": ""})
        told = list(part_tools.review_slips(silent))
        self.assertEqual(told, ["open, but left does not say what was not read"])

    def test_a_test_that_is_not_there(self) -> None:
        read = part_tools.read_settings(ROOT)
        changed = [
            one.model_copy(update={"tests": ["test_lint/test_nothing"]})
            if one.name == "cppcheck"
            else one
            for one in read.tool
        ]
        specs = part_tools.wanted(Toolchain().lock)
        problems = list(part_tools.entry_problems(Settings(tool=changed), specs, ROOT))
        told = "specs/tools.toml: tool cppcheck: there is no test test_lint/test_nothing"
        self.assertEqual(problems, [told])


class Whole(PartTest):
    """The part, on good reports with one fault each."""

    maker = staticmethod(part_tools.make)

    def setUp(self) -> None:
        super().setUp()
        for name in part_tools.VERSIONED:
            self.write(name, {"tools": {}})
        self.write(part_tools.QUALIFY, {"verdict": "good", "problems": [], "runs": [RUN]})

    def mine(self) -> list[str]:
        """The problems, but for tools that are not installed on this machine."""
        return [one for one in self.make().problems if "is missing on this machine" not in one]

    def test_good_reports_give_no_problem_and_an_item_for_each_tool(self) -> None:
        self.assertEqual(self.mine(), [])
        names = {item.id for item in self.make().items}
        self.assertEqual(names, set(part_tools.wanted(Toolchain().lock)))

    def test_each_page_tells_how_far_known_problems_were_reviewed(self) -> None:
        part = self.make()
        items = {item.id: item for item in part.items}
        self.assertEqual(items["why3"].facts["known problems"], "read, 2026-11-22")
        self.assertEqual(items["gappa"].facts["known problems"], "compared, 2026-11-24")
        self.assertIn("tracker", items["why3"].facts["what was not"])
        self.assertNotIn("where", items["machdep"].facts)
        (table,) = [one for one in part.tables if one.title == "Reviews of known problems"]
        told = [row[1] for row in table.rows]
        kinds = ("read", "searched", "compared", "open", "not needed")
        counts = (f"{told.count(how)} {how}" for how in kinds)
        shown = part.summary["tools by review of their known problems"]
        self.assertEqual(shown, ", ".join(counts))
        self.assertEqual(len(told), len(items))

    def test_a_fault_that_is_no_longer_detected(self) -> None:
        wrong = "cbmc: an overflow: does not say 'x', but: nothing"
        runs = [{**RUN, "wrong": "does not say 'x', but: nothing"}]
        self.write(part_tools.QUALIFY, {"problems": [wrong], "runs": runs})
        self.assertEqual(self.mine(), [wrong])
        (item,) = [one for one in self.make().items if one.id == "cbmc"]
        self.assertEqual(item.state, "bad")

    def test_reports_that_are_missing_or_of_another_source(self) -> None:
        (self.build / part_tools.QUALIFY).unlink()
        self.write("lint/report.json", {MADE_FROM: {**STAMP, "tree": "other"}})
        shown = [one.partition(": ")[0] for one in self.mine()]
        self.assertEqual(shown, ["build/qualify/report.json", "build/lint/report.json"])


class Qualify(unittest.TestCase):
    """Seeded faults, asked of a real tool."""

    gappa = next(seed for seed in SEEDS if seed.tool == "gappa")

    def setUp(self) -> None:
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        for folder in PRODUCT:
            (self.root / folder).mkdir()
        self.known = self.root / "known"

    def qualify(self, **changes: str) -> tuple[int, dict[str, Any]]:
        with contextlib.redirect_stdout(io.StringIO()):
            seeds = [replace(self.gappa, **changes)]
            status = qualify.main([], self.root, seeds, self.known, [])
        report = json.loads((self.root / qualify.REPORT).read_text())
        assert isinstance(report, dict)
        return status, report

    def test_a_fault_that_is_detected_is_known_afterwards(self) -> None:
        status, report = self.qualify()
        self.assertEqual((status, report["problems"]), (0, []))
        self.assertEqual(len(list(self.known.iterdir())), 1)

    def test_a_fault_that_is_not_detected(self) -> None:
        status, report = self.qualify(new="|d - 1| <= 0x1p-23")
        self.assertEqual((status, report["verdict"]), (1, "failed"))
        self.assertIn("gappa: a bound that is too narrow: does not say", report["problems"][0])
        self.assertFalse(self.known.exists())

    def test_a_tool_that_refuses_everything_detects_nothing(self) -> None:
        text = self.gappa.text.replace("|e| <= 0x1p-24", "|e| <= 0x1p-20")
        status, report = self.qualify(text=text)
        self.assertEqual(status, 1)
        self.assertIn("also where there is no fault", report["problems"][0])

    def test_every_fault_can_be_put_into_its_text_and_has_a_name_of_its_own(self) -> None:
        self.assertEqual(len({seed.name for seed in SEEDS}), len(SEEDS))
        for seed in SEEDS:
            self.assertNotEqual(seed.faulty, seed.text)


class Mistakes(unittest.TestCase):
    """The table of mistakes in the boards' code; tests/flight/test_board_trials.py tries one."""

    def test_each_can_be_put_into_its_file_and_each_trial_has_some(self) -> None:
        self.assertEqual({one.trial for one in read_mistakes()}, set(TRIALS))

    def test_a_trial_that_the_right_code_fails_shows_nothing(self) -> None:
        known = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        tools = mock.Mock(**{"versions.return_value": {mistakes.TOOL: cbmc()["cbmc"]}})
        said = iter(["the right code fails: 1 != 2", ""])
        with (
            mock.patch.object(mistakes, "answers", return_value=said),
            contextlib.redirect_stdout(io.StringIO()),
        ):
            [row] = mistakes.rows(tools, read_mistakes()[:1], Cache(known))
        self.assertEqual(row["wrong"], "the right code fails: 1 != 2")
        self.assertEqual(list(known.iterdir()), [])

    def test_what_cannot_be_put_in_is_refused_with_its_line(self) -> None:
        first = "[[mistake]]" + (ROOT / TABLE).read_text().split("\n[[mistake]]")[1]
        path = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")), "x.toml")
        for old, new, told in (
            ("E, 14u, 1u, TIM1, CH4", "E, 14u, 1u, TIM1, CH5", "old: stands 0 times in bsp/fmuv5"),
            ("KEEL_OUTPUT(E, 14u, 1u, TIM1, CH4)", "KEEL_OUTPUT(", "old: stands 8 times in bsp/"),
            ("outputs", "output", "trial: there is none; there are outputs, port"),
        ):
            write_text(path, first.replace(old, new, 1))
            with self.assertRaisesRegex(ToolError, rf"x\.toml:\d+: .*{told}"):
                read_mistakes(path)
        write_text(path, f"{first}\n{first}")
        with self.assertRaisesRegex(ToolError, "stands twice"):
            read_mistakes(path)
