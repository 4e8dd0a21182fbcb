# SPDX-License-Identifier: Apache-2.0
"""Tests of the table that opens specs/soundness.md: each check that a row names is there, and runs.

A row names commands, each with the files that it runs or reads in brackets behind it, and tests.
"""

from __future__ import annotations

import ast
import re
import unittest
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from makefile import rule_of

from keel.cli.commands import COMMANDS

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "specs/soundness.md"
HEAD = ["no.", "risk", "what closes it", "which check runs", "what is left"]
NOTHING = "none"

SPAN = re.compile(r"`([^`]+)`")
COMMAND = re.compile(r"make [a-z-]+(?: [A-Z]+=\S+)*")
# What a cell has in a row: a command with its files, or a file alone.
CHECK = re.compile(r"`(make [^`]+)`(?: \(((?:`[^`]+`(?:, )?)+)\))?|`([^`]+)`")
PROGRAM = re.compile(r"\btools/keel ([a-z-]+)")
TEST = re.compile(r"tests/(tools|timing|flight|clients)/test_\w+\.py")


class Row(NamedTuple):
    """A line of the table."""

    number: str
    risk: str
    closes: str
    check: str
    left: str


def rows_of(text: str) -> list[Row]:
    """The rows of the first table of a document."""
    lines = [line for line in text.split("\n\n## ")[0].splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert cells[0] == HEAD, cells[0]
    return [Row(*line) for line in cells[2:]]


def recipe(command: str) -> str:
    """What the Makefile runs for a command; empty where there is none."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    rule = re.escape(rule_of(command))
    found = re.search(rf"^{rule}:(?!=).*\n((?:\t.*\n)+)", makefile, re.MULTILINE)
    return found[1] if found else ""


@cache
def text_of(path: Path) -> str:
    """A source."""
    return path.read_text(encoding="utf-8")


def imports(path: Path) -> Iterator[str]:
    """The modules that a program names, those in its own package with the package's name."""
    package = ".".join(path.parent.relative_to(ROOT / "tools").parts)
    for node in ast.walk(ast.parse(text_of(path))):
        if isinstance(node, ast.Import):
            yield from (one.name for one in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package if node.level else ""
            module = ".".join(part for part in (base, node.module) if part)
            yield module
            yield from (f"{module}.{one.name}" for one in node.names)


def source_of(module: str) -> Path | None:
    """The file of a module of the tools."""
    place = ROOT / "tools" / module.replace(".", "/")
    found = (place.with_suffix(".py"), place / "__init__.py")
    return next((path for path in found if path.is_file()), None)


@cache
def sources(module: str) -> frozenset[Path]:
    """The files of a module and of all that it reaches."""
    reached: set[Path] = set()
    waiting = [path for path in [source_of(module)] if path]
    while waiting:
        path = waiting.pop()
        if path not in reached and path.is_file():
            reached.add(path)
            waiting += [found for module in imports(path) if (found := source_of(module))]
    return frozenset(reached)


def runs(command: str, name: str) -> bool:
    """Whether a command's program has a file among its sources, or names it."""
    modules = [COMMANDS[name].module for name in PROGRAM.findall(recipe(command))]
    reached = {path for module in modules for path in sources(module)}
    last = [part for part in Path(name).parts if "*" not in part][-1]
    words = (last, f'"{Path(last).stem}"')  # Modules that are chosen by name have no suffix.
    texts = map(text_of, reached)
    return ROOT / name in reached or any(word in text for text in texts for word in words)


def problems(row: Row) -> Iterator[str]:
    """What is wrong with the check that a row names."""
    if row.check == NOTHING:
        return
    checks = CHECK.findall(row.check)
    if not checks:
        yield f"{row.number}: names no check"
    for command, brackets, alone in checks:
        files = SPAN.findall(brackets) or ([alone] if alone else [])
        yield from (f"{row.number}: there is no {name}" for name in files if not there(name))
        if command:
            yield from of_command(row.number, command, files)
        elif not TEST.fullmatch(alone):
            yield f"{row.number}: {alone} is neither a command's nor a suite of make test"


def of_command(number: str, command: str, files: list[str]) -> Iterator[str]:
    """What is wrong with a command and its files."""
    if not COMMAND.fullmatch(command) or not recipe(command):
        yield f"{number}: there is no {command}"
        return
    yield from (
        f"{number}: {command} does not run {name}"
        for name in files
        if there(name) and not runs(command, name)
    )


def there(name: str) -> bool:
    """Whether a file or folder is there; * stands for any."""
    return any(True for _ in ROOT.glob(name))


class SoundnessTable(unittest.TestCase):
    """The table as it is."""

    def setUp(self) -> None:
        self.rows = rows_of(TABLE.read_text(encoding="utf-8"))

    def test_rows_are_numbered_and_whole(self) -> None:
        self.assertEqual(
            [row.number for row in self.rows],
            [str(number) for number in range(1, len(self.rows) + 1)],
        )
        self.assertEqual([], [row.number for row in self.rows if not all(row)])

    def test_each_row_names_checks_that_run(self) -> None:
        found = [text for row in self.rows for text in problems(row)]
        self.assertEqual([], found, "\n" + "\n".join(found))

    def test_what_is_left_of_a_row_without_a_check_is_said(self) -> None:
        bare = [row for row in self.rows if row.check == NOTHING]
        self.assertEqual([], [row.number for row in bare if len(row.left.split()) < 3])


class FalseRows(unittest.TestCase):
    """Rows that are wrong are told."""

    def told(self, check: str) -> list[str]:
        return list(problems(Row("7", "risk", "closes", check, "left")))

    def test_what_is_not_there(self) -> None:
        self.assertEqual(["7: there is no make prov"], self.told("`make prov`"))
        self.assertEqual(
            ["7: there is no make check NAME=prove"], self.told("`make check NAME=prove`")
        )
        self.assertEqual(
            ["7: there is no tests/tools/test_nothing.py"],
            self.told("`tests/tools/test_nothing.py`"),
        )
        self.assertEqual(
            ["7: there is no tools/keel/judge/gone.py"],
            self.told("`make prove` (`tools/keel/judge/gone.py`)"),
        )

    def test_what_does_not_run(self) -> None:
        self.assertEqual(
            ["7: make check NAME=trace does not run tools/keel/test/fuzz.py"],
            self.told("`make check NAME=trace` (`tools/keel/test/fuzz.py`)"),
        )
        self.assertEqual(
            ["7: tools/keel/test/fuzz.py is neither a command's nor a suite of make test"],
            self.told("`make check NAME=trace`, `tools/keel/test/fuzz.py`"),
        )
        self.assertEqual(["7: names no check"], self.told("somebody looks"))

    def test_what_is_right(self) -> None:
        self.assertEqual([], self.told("`make prove ARGS=--fresh` (`tools/keel/engines/cbmc.py`)"))
        self.assertEqual([], self.told("`tests/tools/test_docs.py`"))
