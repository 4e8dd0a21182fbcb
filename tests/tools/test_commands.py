# SPDX-License-Identifier: Apache-2.0
"""Tests of python3 tools/keel: its commands, its help, and what it refuses."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import unittest
from pathlib import Path

from keel.cli.commands import COMMANDS, source_of, summary_of
from keel.install.lock import Lock

ROOT = Path(__file__).resolve().parents[2]
CALLERS = ("Makefile", "keel.mk", ".ci/run", ".github/workflows/ci.yml", "docs/ci.md")
CALL = re.compile(r"tools/keel\"? ([a-z][a-z0-9-]*)")


def called(*words: str) -> subprocess.CompletedProcess[str]:
    """The program as a user starts it, from another folder."""
    program = [sys.executable, str(ROOT / "tools/keel"), *words]
    return subprocess.run(program, cwd="/", capture_output=True, text=True, check=False)


class Commands(unittest.TestCase):
    """The table of commands."""

    def test_each_has_an_entry_point_and_says_what_it_does(self) -> None:
        for name, command in COMMANDS.items():
            tree = ast.parse(source_of(command).read_text(encoding="utf-8"))
            functions = [one.name for one in tree.body if isinstance(one, ast.FunctionDef)]
            self.assertIn("main", functions, name)
            self.assertTrue(summary_of(command), name)

    def test_the_packages_of_each_are_a_group(self) -> None:
        groups = {command.group for command in COMMANDS.values()} - {""}
        self.assertLessEqual(groups, set(Lock.read().groups))

    def test_whoever_calls_one_calls_one_that_is_there(self) -> None:
        for caller in CALLERS:
            names = set(CALL.findall((ROOT / caller).read_text(encoding="utf-8")))
            self.assertTrue(names, caller)
            self.assertLessEqual(names, {*COMMANDS, "with"}, caller)


class Program(unittest.TestCase):
    """The program itself."""

    def test_help_names_every_command(self) -> None:
        for words in ((), ("--help",)):
            done = called(*words)
            self.assertEqual(done.returncode, 0)
            named = set(re.findall(r"^  ([a-z0-9-]+) ", done.stdout, re.MULTILINE))
            self.assertEqual(named, {*COMMANDS, "with"})

    def test_a_wrong_name_is_refused_with_the_nearest(self) -> None:
        done = called("prov")
        self.assertEqual(done.returncode, 2)
        self.assertIn("keel: there is no command prov; did you mean prove?", done.stderr)

    def test_names_without_names_are_refused(self) -> None:
        for words in ((), ("variable",), ("variable", "UNTI"), ("variable", "--", "UNIT")):
            done = called("names", *words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertIn("names: expected KIND WORD", done.stderr)

    def test_a_group_without_a_program_is_refused(self) -> None:
        done = called("with", "timing")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("usage: keel with GROUP PROGRAM", done.stderr)

    def test_an_unknown_group_is_refused(self) -> None:
        done = called("with", "timimg", "-c", "pass")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no group timimg", done.stderr)
