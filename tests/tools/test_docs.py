# SPDX-License-Identifier: Apache-2.0
"""Tests of the documents: what they name exists, what they link to is there, and all can be
found.
"""

from __future__ import annotations

import re
import subprocess
import unittest
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from makefile import rule_of, rules

ROOT = Path(__file__).resolve().parents[2]
README_LINES = 150
INDEX = "docs/README.md"
PICTURES = "docs/pictures"
GENERATED = frozenset({"build", "__pycache__", ".git", ".mypy_cache", ".ruff_cache", ".venv"})

# Written by a command, which compares it: it names functions of proofs.
MADE = ("proofs/determined.md",)

# Names that stand for the reader's own.
PLACEHOLDERS = frozenset({"my.toml", "keel_x"})
CHECKED_NAMES = (".h", ".py", ".g", ".sdoc", ".toml")

FENCE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^()\s]+)\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
TARGET = re.compile(r"^(?:\S+=\S* )*(make [a-z].*)")
# In comments and messages: with its NAME, if it has one.
CALLED = re.compile(r"`(make [a-z-]+(?: NAME=[a-z-]+)?)")
WRONG = ("tests/tools/test_docs_soundness.py",)  # Has commands that are none.
SOURCES = (".py", ".c", ".h", ".toml", ".sdoc", ".ld", ".xml", ".mk", ".yml", ".sh")
IDENTIFIER = re.compile(r"\bkeel_[a-z0-9_]+\b")
TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)


class Place(NamedTuple):
    """Something that a document says, and where."""

    file: str
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.text}"


@cache
def files() -> frozenset[str]:
    """The project's files and folders, generated ones apart."""
    paths = [path.relative_to(ROOT) for path in ROOT.rglob("*")]
    return frozenset(p.as_posix() for p in paths if GENERATED.isdisjoint(p.parts))


@cache
def documents() -> dict[str, str]:
    """Every document by its path."""
    names = sorted(name for name in files() if name.endswith(".md") and name not in MADE)
    return {name: (ROOT / name).read_text(encoding="utf-8") for name in names}


def found(pattern: re.Pattern[str], name: str, text: str) -> Iterator[Place]:
    """What a pattern finds in a document."""
    for match in pattern.finditer(text):
        yield Place(name, text.count("\n", 0, match.start()) + 1, match[match.lastindex or 0])


def everywhere(pattern: re.Pattern[str]) -> Iterator[Place]:
    """What a pattern finds in all documents."""
    for name, text in documents().items():
        yield from found(pattern, name, text)


def commands() -> Iterator[Place]:
    """Everything that is shown as code: spans, and the lines of blocks."""
    yield from everywhere(SPAN)
    for block in everywhere(FENCE):
        for number, line in enumerate(block.text.splitlines()):
            yield Place(block.file, block.line + number, line.strip())


def anchors(text: str) -> set[str]:
    """The anchors of a document's headings, as code hosts make them."""
    slugs: list[str] = []
    for heading in HEADING.findall(FENCE.sub("", text)):
        words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        slug = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        slugs.append(slug if slug not in slugs else f"{slug}-{slugs.count(slug)}")
    return set(slugs)


def linked(link: Place) -> tuple[str, str]:
    """The file that a link leads to, and the anchor in it."""
    path, _, anchor = link.text.partition("#")
    if not path:
        return link.file, anchor
    target = (ROOT / link.file).parent / path
    return Path(target).resolve().relative_to(ROOT).as_posix(), anchor


def links() -> Iterator[Place]:
    """The links that lead to files of the project."""
    return (link for link in everywhere(LINK) if "://" not in link.text)


def leads_nowhere(link: Place) -> bool:
    """Whether file or anchor are missing."""
    path, anchor = linked(link)
    if path not in files():
        return True
    return bool(anchor) and anchor not in anchors(documents().get(path, ""))


def is_uneven(table: str) -> bool:
    """Whether a table has no heading, or rows of different lengths."""
    rows = [re.split(r"(?<!\\)\|", row) for row in table.splitlines()]
    headed = len(rows) > 1 and re.fullmatch(r"[-:]+", rows[1][1].strip()) is not None
    return not headed or len({len(row) for row in rows}) != 1


def is_path(text: str) -> bool:
    """Whether a piece of code is the path of a file of the project, or a file's name."""
    if text in PLACEHOLDERS or not re.fullmatch(r"[\w.*<>/-]+", text):
        return False
    first, slash, _ = text.partition("/")
    if slash:
        named = first in files() or text.endswith((".c", *CHECKED_NAMES))
        return named and first not in GENERATED
    return text.endswith(CHECKED_NAMES)


ANY = re.compile(r"<\w+>|(?<![A-Za-z])(UNIT|LAYER|F)(?![A-Za-z])")


def is_missing(path: str) -> bool:
    """Whether no file has this path, here or in the example of a user's project; <unit>, UNIT and *
    stand for any. Headers are named as included."""
    pattern = re.escape(ANY.sub("*", path.rstrip("/"))).replace(r"\*", "[^/]*")
    before = ".*/" if path.endswith(".h") or "/" not in path else "examples/own_unit/"
    whole = re.compile(f"({before})?{pattern}")
    return not any(whole.fullmatch(name) for name in files())


@cache
def targets() -> frozenset[str]:
    """The rules of Keel's Makefile, and of what a user's project includes."""
    return rules("Makefile") | rules("keel.mk")


@cache
def identifiers() -> frozenset[str]:
    """What the headers and the harnesses call by Keel's name."""
    names = {Path(name).stem for name in files()}
    for name in files():
        if name.endswith(".h") and name.startswith(("include/", "bsp/")):
            names.update(IDENTIFIER.findall((ROOT / name).read_text(encoding="utf-8")))
    return frozenset(names)


class DocumentsTest(unittest.TestCase):
    """All documents of the project."""

    def none(self, places: Iterable[Place], wrong: Callable[[str], bool]) -> None:
        """Fail with every place that is wrong."""
        found_wrong = sorted({str(place) for place in places if wrong(place.text)})
        self.assertEqual([], found_wrong, "\n" + "\n".join(found_wrong))

    def test_links_lead_somewhere(self) -> None:
        broken = [str(link) for link in links() if leads_nowhere(link)]
        self.assertEqual([], broken, "\n" + "\n".join(broken))

    def test_the_readme_is_short(self) -> None:
        self.assertLessEqual(len(documents()["README.md"].splitlines()), README_LINES)

    def test_every_page_and_picture_is_linked(self) -> None:
        indexed = {linked(link)[0] for link in links() if link.file == INDEX}
        pages = {name for name in documents() if name.startswith("docs/")} - {INDEX}
        self.assertEqual(set(), pages - indexed)
        pictures = {name for name in files() if name.startswith(f"{PICTURES}/")}
        self.assertEqual(set(), pictures - {linked(link)[0] for link in links()})

    def test_tables_have_a_heading_and_even_rows(self) -> None:
        self.none(everywhere(TABLE), is_uneven)

    def test_commands_of_make_exist(self) -> None:
        def none_such(text: str) -> bool:
            return not {rule_of(command) for command in TARGET.findall(text)} <= targets()

        self.none(commands(), none_such)

    def test_commands_of_make_exist_that_sources_name(self) -> None:
        names = [name for name in files() if name.endswith(SOURCES) and name not in WRONG]
        places = [
            place
            for name in names
            for place in found(CALLED, name, (ROOT / name).read_text(encoding="utf-8"))
        ]
        self.assertGreater(len(places), 50)
        self.none(places, lambda text: rule_of(text) not in targets())

    def test_files_exist(self) -> None:
        self.none(everywhere(SPAN), lambda text: is_path(text) and is_missing(text))

    def test_functions_exist(self) -> None:
        known = identifiers() | PLACEHOLDERS
        self.none(everywhere(IDENTIFIER), lambda text: text not in known)

    def test_the_picture_shows_every_unit(self) -> None:
        picture = (ROOT / PICTURES / "layers.svg").read_text(encoding="utf-8")
        for header in (ROOT / "include/keel").glob("*/*.h"):
            if header.stem != "scheduler_state":  # A part of the scheduler.
                self.assertRegex(picture, rf">[^<]*\b{header.stem}\b")

    def test_the_example_compiles(self) -> None:
        examples = re.findall(r"^```c\n(.*?)^```$", documents()["README.md"], re.M | re.S)
        self.assertEqual(len(examples), 1)
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{ROOT / 'include'}"]
        done = subprocess.run(
            ["gcc", *flags, "-fsyntax-only", "-x", "c", "-"],
            input=examples[0],
            text=True,
            capture_output=True,
            timeout=60,
            check=False,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
