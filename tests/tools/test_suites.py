# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/suites: suites run side by side and end together, and `make test` installs every
tool that they need.
"""

from __future__ import annotations

import contextlib
import io
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any
from unittest import mock

from asked_groups import asked, closure
from waiting import WAIT_S, wait_for

from keel.base.arguments import Parser
from keel.base.errors import ToolError
from keel.config import ConfigError, parse_toml
from keel.install import Toolchain
from keel.install.lock import Lock
from keel.test import command as run_tests
from keel.test import suites as running
from keel.test.needs import Needs, mistakes, read_needs
from keel.test.outcomes import Outcome
from keel.test.suites import Suite

ROOT = Path(__file__).resolve().parents[2]


def passed() -> Outcome:
    """One good test."""
    outcome = Outcome()
    outcome.add("good")
    return outcome


class FakeTools:
    """Notes which groups are asked for; one of them cannot be had."""

    def __init__(self, missing: str = "") -> None:
        self.missing = missing
        self.asked: list[tuple[str, ...]] = []

    def ensure(self, *groups: str) -> None:
        self.asked.append(groups)
        if self.missing in groups:
            raise ToolError(f"{self.missing} is missing")


class SideBySide(unittest.TestCase):
    """What becomes of suites that run at the same time."""

    def run_all(
        self, suites: Iterable[Suite], jobs: int = 2, tools: FakeTools | None = None
    ) -> tuple[dict[str, Outcome], str]:
        """The outcomes, and what is told."""
        fake: Any = tools or FakeTools()
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            found = running.run_all(fake, list(suites), jobs)
        return found, output.getvalue()

    def test_two_run_at_once_and_a_third_waits(self) -> None:
        both = threading.Barrier(2, timeout=WAIT_S)
        now: list[str] = []
        most: list[int] = []

        def meet(name: str) -> Callable[[], Outcome]:
            def act() -> Outcome:
                now.append(name)
                most.append(len(now))
                if name != "c":
                    both.wait()  # Alone it would wait for ever.
                now.remove(name)
                return passed()

            return act

        found, _ = self.run_all(Suite(name, (), meet(name)) for name in "abc")
        self.assertEqual([outcome.failures for outcome in found.values()], [[], [], []])
        self.assertLessEqual(max(most), 2)

    def test_one_that_waits_runs_beside_those_of_all_cores(self) -> None:
        others = threading.Barrier(3, timeout=WAIT_S)
        now: list[str] = []
        most: list[int] = []

        def wait() -> Outcome:
            now.append("waits")
            most.append(now.count("waits"))
            if len(most) == 1:
                others.wait()  # With both of those that do not wait.
            now.remove("waits")
            return passed()

        def meet() -> Outcome:
            others.wait()
            return passed()

        waiting = [Suite(f"w{number}", (), wait, waits=True) for number in range(2)]
        found, _ = self.run_all([*waiting, Suite("a", (), meet), Suite("b", (), meet)])
        self.assertEqual([outcome.failures for outcome in found.values()], [[], [], [], []])
        self.assertEqual(most, [1, 1])

    def test_one_at_a_time_is_possible(self) -> None:
        threads = threading.active_count()
        counts: list[int] = []

        def act() -> Outcome:
            counts.append(threading.active_count() - threads)
            return passed()

        self.run_all([Suite(name, (), act, waits=name == "b") for name in "abc"], jobs=1)
        self.assertEqual(counts, [1, 1, 1])

    def test_the_longest_begin_and_the_report_keeps_its_order(self) -> None:
        begun: list[str] = []

        def act(name: str) -> Callable[[], Outcome]:
            def begin() -> Outcome:
                begun.append(name)
                return passed()

            return begin

        seconds = {"a": 1.0, "b": 30.0, "c": 0.0, "d": 4.0}
        suites = [Suite(name, (), act(name), taken) for name, taken in seconds.items()]
        found, output = self.run_all(suites, jobs=1)
        self.assertEqual(begun, ["b", "d", "a", "c"])
        self.assertEqual(list(found), ["a", "b", "c", "d"])
        self.assertEqual([line.split()[0] for line in output.splitlines()], begun)

    def test_the_report_has_its_order_whoever_ends_first(self) -> None:
        told = threading.Event()
        tell = running.tell

        def tell_first(name: str, outcome: Outcome) -> None:
            tell(name, outcome)
            told.set()

        def late() -> Outcome:
            self.assertTrue(told.wait(WAIT_S))
            return passed()

        suites = [Suite("late", (), late), Suite("early", (), passed)]
        with mock.patch.object(running, "tell", tell_first):
            found, output = self.run_all(suites)
        self.assertEqual(list(found), ["late", "early"])
        self.assertEqual([line.split()[0] for line in output.splitlines()], ["early", "late"])

    def test_a_failure_in_one_leaves_the_other_alone(self) -> None:
        failed = threading.Event()

        def bad() -> Outcome:
            failed.set()
            raise ToolError("it does not build")

        def good() -> Outcome:
            self.assertTrue(failed.wait(WAIT_S))
            return passed()

        found, output = self.run_all([Suite("good", (), good), Suite("bad", (), bad)])
        self.assertEqual(found["bad"].failures, ["bad: it does not build"])
        self.assertEqual((found["good"].passed, found["good"].failures), (1, []))
        lines = output.splitlines()
        place = next(number for number, line in enumerate(lines) if line.startswith("bad "))
        self.assertIn("1 FAILED", lines[place])
        self.assertEqual(lines[place + 1], "bad: it does not build")  # Nobody's line between.

    def test_an_error_of_the_runner_is_a_failure_with_its_place(self) -> None:
        def wrong() -> Outcome:
            raise KeyError("no such key")

        found, output = self.run_all([Suite("wrong", (), wrong), Suite("good", (), passed)])
        self.assertEqual(len(found["wrong"].failures), 1)
        self.assertRegex(
            output,
            r"wrong: an error of the runner\nTraceback(.|\n)*test_suites\.py"
            r"(.|\n)*KeyError: 'no such key'",
        )
        self.assertEqual(found["good"].passed, 1)

    def test_tools_are_there_before_any_suite_begins(self) -> None:
        tools = FakeTools()
        seen: list[int] = []

        def act() -> Outcome:
            seen.append(len(tools.asked))
            return passed()

        groups = (("a",), ("a",), ("b", "c"))
        self.run_all([Suite(f"s{i}", words, act) for i, words in enumerate(groups)], tools=tools)
        self.assertEqual(tools.asked, [("a",), ("b", "c")])
        self.assertEqual(seen, [2, 2, 2])

    def test_a_tool_that_cannot_be_had_fails_those_that_need_it(self) -> None:
        suites = [Suite("x", ("a", "b"), passed), Suite("y", ("a",), passed)]
        found, _ = self.run_all(suites, tools=FakeTools("b"))
        self.assertEqual(found["x"].failures, ["x: b is missing"])
        self.assertEqual(found["y"].failures, [])


class CommandLine(unittest.TestCase):
    """How many at once."""

    def test_none_at_once_is_refused(self) -> None:
        for words in (["--jobs", "0"], ["-j", "-1"]):
            error = io.StringIO()
            with contextlib.redirect_stderr(error), self.assertRaises(SystemExit) as caught:
                run_tests.main(words)
            self.assertEqual(caught.exception.code, 2)
            self.assertIn("test: --jobs needs at least 1", error.getvalue())

    def test_as_many_as_there_are_cores(self) -> None:
        with mock.patch.object(os, "cpu_count", return_value=7):
            parser = Parser("x", "test")
            running.add_options(parser)
        self.assertEqual(running.parse(parser, []).jobs, 7)


class Totals(unittest.TestCase):
    """How a run ends."""

    def test_what_failed_is_named_again_at_the_end(self) -> None:
        bad = passed()
        bad.add("holds", "x.c:7: 1 is not 2")
        output = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(output):
            status = running.end(Path(folder), "t", {"unit/a": passed(), "unit/b": bad}, {})
        self.assertEqual(status, 1)
        self.assertEqual(output.getvalue(), "FAILED unit/b: holds\n2 passed, 1 failed\n")


# Two suites of programs, of which one runs programs itself, and a third that must not begin.
# Ctrl-C is heard whoever runs the tests: what is started in the background may ignore it.
INTERRUPTED = """\
import signal, sys
from pathlib import Path
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.path[:0] = [{tools!r}, {tests!r}]
from keel.base.run import run
from keel.test import command as run_tests
from keel.test.outcomes import program_outcome
from keel.test.suites import Suite
from test_suites import FakeTools

code = "import sys; sys.path.insert(0, {tools!r}); from keel.base.run import run; "
code += "run(['sleep', '{mark}.2'])"
commands = {{"a": ["sleep", "{mark}.1"], "b": [sys.executable, "-c", code],
            "c": ["touch", "{folder}/begun"]}}

def suite(name):
    return Suite(name, (), lambda: program_outcome(name, run(commands[name])))

run_tests.ROOT = Path({folder!r})
run_tests.all_suites = lambda *_: [suite(name) for name in commands]
run_tests.Toolchain = FakeTools
sys.exit(run_tests.main(["--jobs", "2"]))
"""


def alive(mark: str) -> list[str]:
    """The sleeping programs that have a mark."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            words = path.read_bytes().decode(errors="replace").split("\0")
            if words[0] == "sleep" and words[1].startswith(mark):
                found.append(words[1])
    return sorted(found)


class Interruption(unittest.TestCase):
    """Ctrl-C, and a request to end, end all suites and what they have started."""

    def test_ctrl_c(self) -> None:
        self.interrupt(signal.SIGINT)

    def test_a_request_to_end(self) -> None:
        self.interrupt(signal.SIGTERM)

    def interrupt(self, number: signal.Signals) -> None:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        mark = str(1_000_000 + os.getpid())  # Seconds, longer than any test.
        script = INTERRUPTED.format(
            tools=str(ROOT / "tools"),
            folder=str(folder),
            mark=mark,
            tests=str(Path(__file__).resolve().parent),
        )
        process = subprocess.Popen(
            [sys.executable, "-c", script],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        wanted = [f"{mark}.1", f"{mark}.2"]
        self.assertTrue(wait_for(lambda: alive(mark) == wanted), alive(mark))
        process.send_signal(number)
        output, _ = process.communicate(timeout=WAIT_S)
        self.assertEqual((process.returncode, output), (130, "test: interrupted\n"))
        self.assertTrue(wait_for(lambda: not alive(mark)), alive(mark))
        self.assertFalse((folder / "begun").exists())
        self.assertEqual(list((folder / run_tests.BUILD).iterdir()), [])  # No report.


class File(unittest.TestCase):
    """tests/suites.toml."""

    def refused(self, text: str) -> str:
        """What is said of a file."""
        with self.assertRaises(ConfigError) as caught:
            parse_toml(text, Needs, "x.toml", mistakes)
        return str(caught.exception)

    def test_mistakes_are_told_with_their_line(self) -> None:
        entry = '[[suite]]\nname = "tools/x"\n'
        told = self.refused(f'{entry}groups = ["prov"]\n')
        self.assertRegex(told, r"^x\.toml:3: .*there is no group prov$")
        self.assertRegex(self.refused(entry + entry), r"^x\.toml:4: .*tools/x is named twice$")
        self.assertIn("x.toml:3: ", self.refused(f"{entry}second = 3\n"))
        self.assertIn("x.toml:3: ", self.refused(f"{entry}seconds = -3\n"))
        absent = '[[absent]]\ngroups = ["oponion"]\nreason = "x"\n'
        self.assertIn("there is no group oponion", self.refused(f"suite = []\n{absent}"))

    def test_every_entry_is_of_a_suite_and_serves(self) -> None:
        needs = read_needs()
        names = {suite.name for suite in every_suite(needs)}
        self.assertEqual([need.name for need in needs.suite if need.name not in names], [])
        self.assertEqual(
            [need.name for need in needs.suite if not need.groups and not need.seconds], []
        )


def every_suite(needs: Needs) -> list[Suite]:
    """What `make test` runs."""
    return run_tests.all_suites(run_tests.HostBuilds(Toolchain()), needs)


FOLDERS = (ROOT / "tools", ROOT / "tests/tools", ROOT / "tests/timing")
# It asks for groups of lock files of its own, and has them all in its texts.
APART = ("test_toolchain.py", "test_suites.py")


def lacking(needs: Needs) -> list[str]:
    """What suites, or the programs that they test, ask for, and `make test` does not install."""
    lock = Lock.read()
    named = {group for suite in every_suite(needs) for group in suite.groups}
    tools = {tool for group in named for tool in lock.groups[group]}
    installed = {group for group in lock.groups if tools.issuperset(lock.groups[group])}
    excused = {group for entry in needs.absent for group in entry.groups}
    files = [
        path
        for folder in FOLDERS[1:]
        for path in sorted(folder.glob("test_*.py"))
        if path.name not in APART
    ]
    users = {path: file for file in files for path in closure(file, FOLDERS)}
    wanted = {
        groups: f"{file.name}, by {path.name}"
        for path, file in sorted(users.items())
        for groups in asked(path, lock)
    }
    told = [
        f"{' or '.join(groups)}: {who}"
        for groups, who in wanted.items()
        if not installed & set(groups) and not excused >= set(groups)
    ]
    needless = excused & installed | excused - {group for groups in wanted for group in groups}
    return sorted([*told, *(f"{group}: needs no excuse" for group in needless)])


class Installed(unittest.TestCase):
    """A fresh machine gets what the suites need: what asks for a group says so in its source."""

    def test_every_group_that_is_asked_for_is_installed(self) -> None:
        self.assertEqual(lacking(read_needs()), [])

    def test_one_that_is_not_installed_is_named_with_who_asks(self) -> None:
        needs = read_needs()
        left = [need for need in needs.suite if need.name != "tools/contracts_run"]
        self.assertEqual(
            lacking(needs.model_copy(update={"suite": left})),
            ["contracts-run: test_contracts_run.py, by contracts_run.py"],
        )

    def test_one_without_an_excuse_and_one_with_a_needless_one_are_named(self) -> None:
        needs = read_needs()
        none = lacking(needs.model_copy(update={"absent": []}))
        self.assertTrue(any(line.startswith("opinion: ") for line in none), none)
        entry = needs.absent[0]
        more = with_excused(needs, [*entry.groups, "prove"])
        self.assertEqual(lacking(more), ["prove: needs no excuse"])


def with_excused(needs: Needs, groups: list[str]) -> Needs:
    """The file with these groups in its first excuse."""
    first = needs.absent[0].model_copy(update={"groups": groups})
    return needs.model_copy(update={"absent": [first, *needs.absent[1:]]})
