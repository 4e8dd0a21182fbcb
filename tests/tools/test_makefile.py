# SPDX-License-Identifier: Apache-2.0
"""Tests of the Makefile: its lists, how checks and generators are called by their names, and that a
wrong name or value is told in one line."""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from makefile import COLLECTIVE, rules

ROOT = Path(__file__).resolve().parents[2]


def make(*words: str) -> tuple[int, list[str]]:
    """The exit status of make, and what the tools and it say, but for its own last line."""
    command = ["make", "--no-print-directory", *words]
    # As from a shell, also when these tests are run by make themselves.
    outside = {
        name: text
        for name, text in os.environ.items()
        if "MAKE" not in name and name not in ("ARGS", "UNIT", "BOARD", "TASKSET", "NAME", "MFLAGS")
    }
    done = subprocess.run(
        command, cwd=ROOT, env=outside, capture_output=True, text=True, check=False
    )
    lines = [line for line in done.stderr.splitlines() if not line.startswith("make: *** [")]
    return done.returncode, done.stdout.splitlines() + lines


MOST_COMMANDS = 20  # A list that nobody reads to its end is none.


def listed(lines: list[str], before: str = "") -> list[str]:
    """The names in a list, each of which has a text."""
    pattern = re.compile(rf"^  make {before}([a-z-]+) +\S.*$", re.MULTILINE)
    return pattern.findall("\n".join(lines))


def names_of(target: str) -> set[str]:
    """The names that a collective target knows."""
    return {rule.split("/")[1] for rule in rules() if rule.startswith(f"{target}/")}


class Lists(unittest.TestCase):
    """What `make help`, `make check` and `make generate` show: all there is."""

    def test_help_has_every_target_below_a_heading(self) -> None:
        status, lines = make("help")
        self.assertEqual(status, 0)
        self.assertEqual(make(), (0, lines))
        inner = {rule for rule in rules() if "/" in rule} | {"python"}
        self.assertEqual(sorted(listed(lines)), sorted(rules() - inner))
        self.assertLess(len(listed(lines)), MOST_COMMANDS)
        heads = [line for line in lines if line and not line.startswith(" ")]
        self.assertEqual(len(heads), 2)
        below = lines[lines.index(heads[1]) :]
        self.assertLessEqual({"firmware", "flash", "fly"}, set(listed(below)))
        self.assertNotIn("prove", listed(below))
        self.assertLess(max(map(len, lines)), 120)

    def test_without_a_name_all_are_listed_and_nothing_was_done(self) -> None:
        for target in COLLECTIVE:
            with self.subTest(target):
                status, lines = make(target)
                self.assertEqual(status, 2)
                self.assertEqual(set(listed(lines, f"{target} NAME=")), names_of(target))
                self.assertEqual(len(lines), len(names_of(target)))


class Names(unittest.TestCase):
    """A check or a generator by its name, of which make only tells what it would run."""

    def told(self, *words: str) -> list[str]:
        """The programs of Keel that would run."""
        status, lines = make("-n", *words)
        self.assertEqual(status, 0, lines)
        return [line.partition("tools/keel ")[2] for line in lines if "tools/keel " in line]

    def test_what_each_takes(self) -> None:
        for words, program in (
            ("eva ARGS=--fresh", "eva --fresh"),
            ("stack BOARD=fmuv5", 'stack "fmuv5" '),
            ("model BOARD=fmuv5 ARGS=--x", 'model "fmuv5" --x'),
            ("fuzz SECONDS=5", "fuzz --seconds 5 "),
            ("review UNIT=queue", "review --unit queue "),
            ("replay FILE=a.ulg ARGS=--compare", 'replay "a.ulg" --compare'),
            ("tools", "tools versions "),
        ):
            with self.subTest(words):
                name, *settings = words.split()
                self.assertEqual(self.told("check", f"NAME={name}", *settings), [program])

    def test_of_flights_all_can_be_set(self) -> None:
        words = ("N=7", "SEED=3", "JOBS=2", "DASK=tcp://host:1", "ARGS=--x")
        status, lines = make("-n", "check", "NAME=flights", *words)
        self.assertEqual(status, 0)
        for part in ('--flights "7"', '--seed "3"', '--jobs "2"', 'DASK="tcp://host:1"', "--x"):
            self.assertIn(part, "\n".join(lines))

    def test_several_run_in_their_order(self) -> None:
        self.assertEqual(self.told("check", "NAME=trace eva"), ["trace ", "eva "])

    def test_pictures_come_from_what_is_run_before(self) -> None:
        programs = [program.split()[0] for program in self.told("generate", "NAME=pictures")]
        self.assertEqual(programs, ["campaign", "timing", "flight-picture", "schedule", "pictures"])

    def test_all_tools_are_installed_on_request(self) -> None:
        ensure, versions = self.told("check", "NAME=tools", "ARGS=--install")
        self.assertEqual(ensure.split(), ["tools", "ensure"])  # Of no group: of all.
        self.assertEqual(versions.split(), ["tools", "versions"])

    def test_a_variable_of_the_system_is_no_name(self) -> None:
        done = subprocess.run(
            ["make", "-n", "check"],
            cwd=ROOT,
            env={"PATH": os.environ["PATH"], "NAME": "eva"},
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertNotIn("tools/keel eva", done.stdout)


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

    def test_a_name(self) -> None:
        line = self.refused("check", "NAME=evaa")
        self.assertIn("there is no name evaa; did you mean eva? (names: ", line)
        for name in names_of("check"):
            self.assertIn(name, line)
        self.assertIn("there is no name eva (names: ", self.refused("generate", "NAME=eva"))
        self.assertIn("there is no name xyzzy", self.refused("check", "NAME=demo xyzzy"))

    def test_a_name_in_the_place_of_a_target_is_told_how_it_is_called(self) -> None:
        # There is a folder of the second's name, too.
        for target, name in (("check", "eva"), ("check", "tools"), ("generate", "tables")):
            line = self.refused(name)
            self.assertIn(f"there is no target {name}; make {target} NAME={name} does it", line)

    def test_a_board(self) -> None:
        for words in ("firmware", "check NAME=stack", "flash"):
            with self.subTest(words):
                status, lines = make(*words.split(), "BOARD=nucleo")
                self.assertEqual(status, 2)
                program = words.rpartition("=")[2]
                told = [line for line in lines if line.startswith(f"{program}: ")]
                self.assertEqual(told, lines[-1:])
                self.assertIn("there is no board nucleo; did you mean nucleo_f767zi?", told[0])

    def test_a_suite(self) -> None:
        self.assertEqual(
            self.refused("test", "ARGS=--filter unit/queu3"),
            "test: no suite's name contains 'unit/queu3'; did you mean unit/queue?",
        )

    def test_an_option(self) -> None:
        for words, option in (
            ("lint", "--fxi"),
            ("bench", "--chek"),
            ("check NAME=trace", "--updaet"),
            ("test-target", "--filtre=x"),
            ("coverage", "--all"),
        ):
            with self.subTest(words):
                self.assertIn(
                    f"{words.rpartition('=')[2]}: unrecognized arguments: {option}",
                    self.refused(*words.split(), f"ARGS={option}"),
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
