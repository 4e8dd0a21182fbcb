# SPDX-License-Identifier: Apache-2.0
"""Tests of what a verdict depends on besides the text that it is about.

Each changes a file of a copy of the tools, and says which verdicts must not be believed then.
"""

from __future__ import annotations

import shutil
import tempfile
import unittest
from collections.abc import Callable, Iterable
from pathlib import Path

from keel.install import Toolchain
from keel.install.lock import Lock
from keel.prove import verdict_keys

ROOT = Path(__file__).resolve().parents[2]

ENGINES = ("wp", "cbmc", "gappa")


class Copied(unittest.TestCase):
    """A copy of the tools."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tools = Path(folder.name) / "tools"
        shutil.copytree(ROOT / "tools/keel", self.tools / "keel")
        shutil.copy(ROOT / "pyproject.toml", self.tools.parent)

    def changed_by(
        self, name: str, digest: Callable[[str, Path], str], engines: Iterable[str]
    ) -> list[str]:
        """The engines of which a digest changes with a file of the tools."""
        folder = self.tools / "keel"
        before = {engine: digest(engine, folder) for engine in engines}
        with (folder / name).open("a", encoding="utf-8") as file:
            file.write("# a comment\n")
        return [engine for engine in engines if digest(engine, folder) != before[engine]]


class Proofs(Copied):
    """Verdicts of proofs."""

    def voided(self, name: str) -> list[str]:
        """The engines of which no verdict holds any more when a file of the tools changes."""
        return self.changed_by(name, verdict_keys.own_digest, ENGINES)

    def test_who_asks_one_engine_judges_for_that_one(self) -> None:
        for engine, names in verdict_keys.ASKERS.items():
            for name in names:
                self.assertEqual(self.voided(name), [engine], name)

    def test_what_serves_several_engines_judges_for_all(self) -> None:
        room = [f"judge/{path.name}" for path in (self.tools / "keel/judge").glob("*.py")]
        self.assertGreater(len(room), 5)
        for name in (*verdict_keys.READERS, *room):
            self.assertEqual(self.voided(name), list(ENGINES), name)

    def test_who_tells_what_others_found_judges_nothing(self) -> None:
        for name in (
            "prove/report.py",
            "prove/explain.py",
            "prove/times.py",
            "prove/proof_run.py",
            "prove/driver.py",
            "mutate/mutation.py",
            "base/shared_results.py",
            "audit/unused.py",
            "audit/determined.py",
            "audit/completeness.py",
        ):
            self.assertEqual(self.voided(name), [], name)

    def test_every_tool_counts_for_the_engines_that_may_start_it(self) -> None:
        stamp = dict.fromkeys(Toolchain().versions("prove"), "1")
        used = {
            name: [engine for engine in ENGINES if name in verdict_keys.started(engine, stamp)]
            for name in stamp
        }
        self.assertEqual(used["frama-c"], ["wp"])
        self.assertEqual(used["alt-ergo"], ["wp"])
        self.assertEqual(used["z3"], ["wp", "cbmc"])
        self.assertEqual(used["cbmc"], ["cbmc"])
        self.assertEqual(used["cadical"], ["cbmc"])
        self.assertIn("gappa", used["gappa"])
        self.assertEqual(used["gcc"], list(ENGINES))
        self.assertEqual([name for name, engines in used.items() if not engines], [])

    def test_what_is_said_not_to_be_started_is_a_tool(self) -> None:
        known = set(Lock.read().tools) | {"machdep"}
        for names in verdict_keys.NOT_STARTED.values():
            self.assertLessEqual(set(names), known)


class Mutants(Copied):
    """Verdicts on mutants."""

    def voided(self, name: str) -> list[str]:
        """The engines by which no verdict holds any more when a file of the tools changes."""
        return self.changed_by(name, verdict_keys.mutants_digest, verdict_keys.MUTANT_JUDGES)

    def test_another_judge_may_say_something_else(self) -> None:
        for name in (
            "engines/cbmc.py",
            "judge/cbmc_answers.py",
            "mutate/mutation.py",
            "mutate/small_harnesses.py",
        ):
            self.assertEqual(self.voided(name), ["cbmc"], name)
        for name in ("engines/wp.py", "judge/wp_verdict.py", "install/provers.py"):
            self.assertEqual(self.voided(name), ["wp"], name)

    def test_who_finds_makes_or_prints_judges_nothing(self) -> None:
        for name in (
            "c/source.py",
            "mutate/operators.py",
            "mutate/slips.py",
            "prove/report.py",
            "audit/clauses.py",
        ):
            self.assertEqual(self.voided(name), [], name)
