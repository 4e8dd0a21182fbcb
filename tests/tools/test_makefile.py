# SPDX-License-Identifier: Apache-2.0
"""Tests of the Makefile: its help, and that a wrong name or value is told in one line."""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def make(*words: str) -> tuple[int, list[str]]:
    """The exit status of make, and what the tools and it say, but for its own last line."""
    command = ["make", "--no-print-directory", *words]
    # As from a shell, also when these tests are run by make themselves.
    outside = {
        name: text
        for name, text in os.environ.items()
        if "MAKE" not in name and name not in ("ARGS", "UNIT", "BOARD", "TASKSET", "MFLAGS")
    }
    done = subprocess.run(
        command, cwd=ROOT, env=outside, capture_output=True, text=True, check=False
    )
    lines = [line for line in done.stderr.splitlines() if not line.startswith("make: *** [")]
    return done.returncode, done.stdout.splitlines() + lines


class Help(unittest.TestCase):
    def test_every_target_with_a_text_is_in_one_group(self) -> None:
        status, lines = make("help")
        self.assertEqual(status, 0)
        heads = [line for line in lines if line and not line.startswith(" ")]
        self.assertEqual(heads, ["Everyday", "Boards", "Evidence", "Research"])
        text = (ROOT / "Makefile").read_text(encoding="utf-8")
        targets = sorted(re.findall(r"^([a-z-]+):[^#\n]*## ", text, re.MULTILINE))
        self.assertEqual(sorted(re.findall(r"^  make ([a-z-]+)", "\n".join(lines), re.M)), targets)
        self.assertLess(
            lines.index("Boards"),
            next(
                number for number, line in enumerate(lines) if line.startswith("  make firmware ")
            ),
        )
        self.assertLess(max(map(len, lines)), 120)


class Refusals(unittest.TestCase):
    """One line that names what is wrong, with the nearest right name; make ends with 2."""

    def refused(self, *words: str) -> str:
        status, lines = make(*words)
        self.assertEqual(status, 2, lines)
        [line] = lines
        return line

    def test_a_variable(self) -> None:
        for word, like in (("UNTI=queue", "UNIT"), ("ARG=--fix", "ARGS"), ("BORD=x", "BOARD")):
            line = self.refused("prove", word)
            self.assertIn(f"there is no variable {word.split('=')[0]}; did you mean {like}?", line)

    def test_a_target(self) -> None:
        self.assertIn("there is no target tets; did you mean test?", self.refused("tets"))
        self.assertIn("there is no target xyzzy (targets: help, ", self.refused("xyzzy"))

    def test_a_board(self) -> None:
        for target in ("firmware", "stack", "flash"):
            with self.subTest(target):
                status, lines = make(target, "BOARD=nucleo")
                self.assertEqual(status, 2)
                told = [line for line in lines if line.startswith(f"{target}: ")]
                self.assertEqual(told, lines[-1:])
                self.assertIn("there is no board nucleo; did you mean nucleo_f767zi?", told[0])

    def test_a_suite(self) -> None:
        self.assertEqual(
            self.refused("test", "ARGS=--filter unit/queu3"),
            "test: no suite's name contains 'unit/queu3'; did you mean unit/queue?",
        )

    def test_an_option(self) -> None:
        for target, option in (
            ("lint", "--fxi"),
            ("bench", "--chek"),
            ("trace", "--updaet"),
            ("test-target", "--filtre=x"),
            ("coverage", "--all"),
        ):
            with self.subTest(target):
                self.assertIn(
                    f"{target}: unrecognized arguments: {option}",
                    self.refused(target, f"ARGS={option}"),
                )

    def test_a_task_set_that_is_missing_or_broken(self) -> None:
        status, lines = make("analyze", "TASKSET=specs/tasksets/urpilo.toml")
        self.assertEqual(status, 2)
        self.assertIn("specs/tasksets/urpilo.toml", lines[0])
        self.assertIn("No such file", lines[0])
        with tempfile.TemporaryDirectory() as name:
            broken = Path(name) / "broken.toml"
            broken.write_text('name = "x"\n[[task]\n', encoding="utf-8")
            status, lines = make("analyze", f"TASKSET={broken}")
        self.assertEqual(status, 2)
        self.assertIn(f"{broken}:2: ", lines[0])

    def test_a_missing_tool_that_may_not_be_installed(self) -> None:
        with tempfile.TemporaryDirectory() as cache:
            status, lines = make("lint", "KEEL_NO_INSTALL=1", f"KEEL_CACHE={cache}")
        self.assertEqual(status, 2)
        told = [line for line in lines if "KEEL_NO_INSTALL=1 forbids to install" in line]
        self.assertEqual(len(told), 1, lines)
        self.assertIn("common-packages: missing", told[0])
