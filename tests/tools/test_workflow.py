#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of .github/workflows and of the commands in docs/ci.md: what they call exists.

    python3 tests/tools/test_workflow.py
"""

from __future__ import annotations

import re
import subprocess
import sys
import unittest
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from common.packages import provide  # noqa: E402

provide("ci")
import yaml  # noqa: E402

WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
SETTING = r"-f +\S+|[A-Z]+=(?:\"[^\"]*\"|'[^']*'|[^\s`]+)"
MAKE = re.compile(rf"(?:^|`|&& |run: )[ ]*make((?: +(?:{SETTING}|[a-z][\w-]*))+)", re.M)
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]+")


def jobs() -> dict[str, Any]:
    """The jobs of all workflows."""
    return {name: job for path in WORKFLOWS
            for name, job in yaml.safe_load(path.read_text("utf-8"))["jobs"].items()}  # fmt: skip


def commands() -> Iterator[str]:
    """The calls of make in the workflows' steps, and in the documents about CI."""
    texts = [str(step.get("run", "")) for job in jobs().values() for step in job["steps"]]
    texts += [(ROOT / "docs" / name).read_text("utf-8") for name in ("ci.md", "own_unit.md")]
    for text in texts:
        yield from (match[1].strip() for match in MAKE.finditer(text))


def targets(file: Path) -> set[str]:
    """The targets of a makefile."""
    text = file.read_text(encoding="utf-8")
    return set(re.findall(r"^([a-z][\w-]*)(?: [a-z][\w-]*)*:(?!=)", text, re.M))


class Workflows(unittest.TestCase):
    def test_the_workflow_proves_joins_and_tests(self) -> None:
        self.assertLessEqual({"prove", "verdict", "check"}, set(jobs()))
        said = " ".join(commands())
        for option in ("--shard", "--join"):
            self.assertIn(option, said)

    def test_every_target_of_make_exists(self) -> None:
        for command in commands():
            file = "keel.mk" if "keel.mk" in command else "Makefile"
            for target in re.sub(SETTING, "", command).split():
                self.assertIn(target, targets(ROOT / file), command)

    def test_every_option_of_prove_exists(self) -> None:
        helped = subprocess.run([sys.executable, str(ROOT / "tools/prove.py"), "--help"],
                                capture_output=True, text=True, check=True).stdout  # fmt: skip
        known = set(OPTION.findall(helped))
        asked = {option for command in commands() for option in OPTION.findall(command)}
        self.assertIn("--explain", asked)
        self.assertLessEqual(asked, known)

    def test_all_shards_are_proved(self) -> None:
        job = jobs()["prove"]
        numbers = job["strategy"]["matrix"]["shard"]
        [command] = [step["run"] for step in job["steps"] if "--shard" in step.get("run", "")]
        self.assertIn(f"/{len(numbers)} ", command)
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))

    def test_what_is_shown_and_kept_is_what_the_driver_writes(self) -> None:
        written = {"summary.md", "results.sarif", "junit.xml", "report.json", "determined.md"}
        text = "\n".join(path.read_text("utf-8") for path in WORKFLOWS)
        named = set(re.findall(r"build/prove/([\w.]+)", text)) - {"shard"}
        self.assertLessEqual({name for name in named if not name.startswith("shard")}, written)
        self.assertIn("bash .ci/run", text)
        self.assertTrue((ROOT / ".ci/run").is_file())

    def test_the_evidence_rests_on_the_other_jobs_and_is_kept(self) -> None:
        job = jobs()["evidence"]
        self.assertLessEqual({"verdict", "check"}, set(job["needs"]))
        kept = [step["with"]["path"] for step in job["steps"]
                if "upload-artifact" in step.get("uses", "")]  # fmt: skip
        self.assertIn("build/evidence", kept)
        text = " ".join(str(step.get("run", "")) for step in job["steps"])
        self.assertIn("build/evidence-work/summary.md", text)
        program = (ROOT / "tools/evidence.py").read_text("utf-8")
        self.assertIn('context.work / "summary.md"', program)

    def test_the_verdicts_of_all_shards_are_fetched_for_the_evidence(self) -> None:
        keys = [str(step["with"]["key"]) for step in jobs()["evidence"]["steps"]
                if "verdicts" in str(step.get("with", {}).get("key", ""))]  # fmt: skip
        shards = jobs()["prove"]["strategy"]["matrix"]["shard"]
        self.assertEqual([key.split("-")[1] for key in keys], [str(shard) for shard in shards])


if __name__ == "__main__":
    unittest.main()
