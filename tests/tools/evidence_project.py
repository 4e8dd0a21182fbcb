# SPDX-License-Identifier: Apache-2.0
"""A small project with good reports of all that the evidence is made from, and tools/keel evidence
run on it as one runs it: with its own parts, in a folder of its own.

It has one unit, one board and one tool. Stood in for are the programs that would be started:
StrictDoc, LOBSTER, the second build of the image, and the search for tools.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

from keel.install.packages import provide

provide("common")
provide("evidence")

import test_requirements_trace as small
from evidence_proofs import report_of

from keel.base.files import write_json, write_text
from keel.base.junit import JUnitSuite, write_junit
from keel.base.source import STAMP, VERDICT, stamp_of
from keel.boards.semantics import COMPILED_AS_PROVED
from keel.evidence import command
from keel.evidence.assemble import assemble
from keel.gather.part import Context
from keel.gather.parts import tools as part_tools
from keel.install import Found, Toolchain
from keel.install.lock import Spec

ROOT = Path(__file__).resolve().parents[2]

# Those that faults of a project or of a run show in; the others speak of Keel's documents.
PARTS = ("requirements", "trace", "formal", "strength", "tests", "object", "tools", "configuration")
HARNESS = "proofs/widget/keel_widget_turn_harness.c"
HEADER = "include/keel/rtos/widget.h"
LEDGER = """\
The theorem (WID-003).

| id | assumption | stated in | owner | who ensures it | how it is verified |
|---|---|---|---|---|---|
| A-01 | it is wound up | header | integrator | its user | review |
"""
TOOL = """\
[[tool]]
name = "cbmc"
use = "proves"
criterion = 2
class = "T2"
impact = "TI2"
detection = "TD2"
instead = "tests"
tests = []
known = "not needed"
reviewed = "all"
"""
OPINION = """\
ask = []
[[cannot]]
harness = ["widget/keel_widget_turn_harness"]
reason = "Nobody asked."
"""
FILES = {
    **{
        name: text
        for name, text in small.FILES.items()
        if name not in ("include/keel/widget.h", "proofs/widget/turn_harness.c")
    },
    HEADER: small.HEADER,
    HARNESS: "// covers: keel_widget_turn nudge push\n"
    + small.FILES["proofs/widget/turn_harness.c"],
    "proofs/widget/goals.txt": "keel_widget_turn_ensures_WID_001_range qed\n"
    "keel_widget_turn_ensures_WID_001_turns qed\n",
    "proofs/widget/assertions.txt": "keel_widget_turn_harness WID_001_turns: it turns\n",
    "proofs/units.toml": "",
    "specs/soundness.md": LEDGER,
    "specs/theorems.toml": "theorem = []\n",
    "specs/third_opinion.toml": OPINION,
    "specs/unreached.toml": "unreached = []\n",
    "specs/reviews.toml": "review = []\n",
    "specs/tools.toml": TOOL,
    "bsp/toy/board.toml": "",
    "tools/toolchain.lock.json": "{}",
}
PINNED = Spec("cbmc", "deb", at_least="6.6", below="6.7")
VERSION = "6.6.0"


def suites_of(suite: str, test: str) -> dict[str, Any]:
    """A run with one test, which passed."""
    outcome = {"passed": 1, "failed": 0, "tests": {test: "passed"}, "failures": [], "skipped": {}}
    return {"passed": 1, "failed": 0, "filter": "", "suites": {suite: outcome}}


def good_reports(root: Path) -> dict[str, dict[str, Any]]:
    """The report of each command."""
    none = {
        "gaps": [],
        "excluded": [],
        "explained": [],
        "unused_exclusions": [],
        "stale_reasons": [],
        "untraced": [],
        "files": {},
    }
    image = {"file": "keel.elf", "sha256": hashlib.sha256(b"image").hexdigest(), "size": 5}
    made = {"tools": {"cbmc": VERSION}}
    seeded = {"tool": "cbmc", "fault": "overflow", "how": "cbmc", "version": VERSION, "wrong": ""}
    proved = report_of(root)
    for unit in proved["units"].values():
        unit["cbmc"]["without_harness"] = {}
    return {
        "prove/report.json": {
            **proved,
            "tools": {"cbmc": {"version": VERSION, "sha256": "01", "parts": []}},
        },
        "test/report.json": suites_of("unit/widget", "it_loops"),
        "test-target/report.json": {
            **suites_of("differential", "differential/widget"),
            **made,
            "vectors_per_unit": 9,
        },
        "coverage/report.json": {
            **none,
            "total": {"lines": [1, 1], "branches": [0, 0], "mcdc": [0, 0]},
        },
        "coverage-target/report.json": {**none, "total": {"seen": 2, "outcomes": 2}},
        "contracts-run/report.json": {"units": {}, "left_out": []},
        "opinion/report.json": {"harnesses": {}},
        "qualify/report.json": {"problems": [], "runs": [seeded]},
        "lint/report.json": made,
        "firmware/toy/report.json": {
            **made,
            "flags": [*COMPILED_AS_PROVED, "-O2"],
            "link_flags": [],
            "load_address": 0,
            "sources": {},
            "checks": [],
            "regions": {},
            "elf": image,
            "binary": {**image, "file": "keel.bin"},
        },
    }


class WholeProject(unittest.TestCase):
    """A project of which a package can be made, to be broken in one place."""

    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        self.root, self.out = self.folder / "project", self.folder / "evidence"
        self.program = command
        for name, text in FILES.items():
            write_text(self.root / name, text)
        for file in ("keel.elf", "keel.bin", "keel.map"):
            write_text(self.root / "build/firmware/toy" / file, "image")
        self.tool: Found | None = Found("cbmc", VERSION, "cache", "/x", "01", 1, 1, {}, {}, [])
        self.stand_in()

    def stand_in(self) -> None:
        """Put what no program has to be started for in the place of what starts one."""

        def parts(context: Context) -> Any:
            return assemble(context, PARTS)

        def versions(*_: str) -> dict[str, Found]:
            return {"cbmc": self.tool} if self.tool else {}

        for patch in (
            mock.patch("keel.gather.parts.requirements.written", return_value={}),
            mock.patch("keel.gather.parts.trace.second_look", return_value={}),
            mock.patch("keel.gather.parts.object.differences", return_value=[]),
            mock.patch.object(part_tools, "VERSIONED", ("prove/report.json", "lint/report.json")),
            mock.patch.object(part_tools, "wanted", return_value={"cbmc": PINNED}),
            mock.patch.object(Toolchain, "versions", side_effect=versions),
            # No bill of materials: that is of all tools.
            mock.patch("keel.release.dist.LOCK", "none"),
            mock.patch.multiple(self.program, ROOT=self.root, assemble=parts),
        ):
            self.enterContext(patch)

    def write_reports(self, seconds: float = 1.5) -> None:
        """What the commands would write about the project as it is now."""
        stamp = stamp_of(self.root)
        for name, report in good_reports(self.root).items():
            for suite in report.get("suites", {}).values():
                suite["seconds"] = seconds
            for unit in report["units"].values() if name.startswith("prove/") else ():
                unit["seconds"] = dict.fromkeys(unit["seconds"], seconds)
            self.write_report(name, {VERDICT: "good", **report, STAMP: stamp})
        for folder, suite, test in (
            ("test", "unit/widget", "it_loops"),
            ("test-target", "differential", "differential/widget"),
        ):
            write_junit(
                self.root / "build" / folder / "junit.xml",
                "Keel",
                {suite: JUnitSuite({test: ""}, seconds)},
            )

    def write_report(self, name: str, report: dict[str, Any]) -> None:
        """Write a report as it is given."""
        write_json(self.root / "build" / name, report)

    def change(self, name: str, old: str, new: str) -> None:
        """Replace a text of the project, which must be there."""
        path = self.root / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new), encoding="utf-8")

    def run_it(self, *words: str) -> tuple[int, list[str]]:
        """The program's exit status, and what it says."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = self.program.main(list(words) or ["--as-is", "--out", str(self.out)])
        return status, said.getvalue().splitlines()
