# SPDX-License-Identifier: Apache-2.0
"""Where in a TOML file each key stands. tomllib reads values but does not say where they were."""

from __future__ import annotations

import re
from collections.abc import Iterator

KeyPath = tuple[str | int, ...]

DEEPEST = 8  # No key of ours lies deeper; one of a hostile file would take n^2 of memory.
KEY = re.compile(r"""[ \t]*("(?:\\.|[^"\\\n])*"|'[^'\n]*'|[A-Za-z0-9_-]+)[ \t]*""")
BLANK = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)+")
# What a value is made of. Strings and comments may hold brackets and line ends of their own.
TOKEN = re.compile(
    r""""{3}(?:\\.|[^\\])*?"{3,5}|'{3}.*?'{3,5}|"""
    r""""(?:\\.|[^"\\\n])*"|'[^'\n]*'|\#[^\n]*|[][{}\n]|.""",
    re.DOTALL,
)


def bare(key: str) -> str:
    """A key without its quotes. Escapes in keys stay as written: no key of ours has any."""
    return key[1:-1] if key[0] in "\"'" else key


class Scanner:
    """Walks over a valid TOML text, statement by statement."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.position = 0
        self.tables: dict[KeyPath, int] = {}  # Arrays of tables: how many elements so far.
        self.lines: dict[KeyPath, int] = {}

    def keys(self) -> KeyPath:
        """A key, dotted or not."""
        parts: list[str] = []
        while match := KEY.match(self.text, self.position):
            parts.append(bare(match[1]))
            self.position = match.end()
            if not self.text.startswith(".", self.position):
                break
            self.position += 1
        return tuple(parts)

    def skip_value(self) -> None:
        """Move behind a value: to the end of a line outside all brackets."""
        depth = 0
        while self.position < len(self.text):
            match = TOKEN.match(self.text, self.position)
            assert match is not None
            self.position = match.end()
            depth += {"[": 1, "{": 1, "]": -1, "}": -1}.get(match[0], 0)
            if match[0] == "\n" and depth <= 0:
                return

    def note(self, path: KeyPath, position: int) -> None:
        """Remember the line of a path, and of the tables it lies in if they are new."""
        line = self.text.count("\n", 0, position) + 1
        for length in range(1, min(len(path), DEEPEST) + 1):
            self.lines.setdefault(path[:length], line)

    def full(self, keys: KeyPath) -> KeyPath:
        """The path of a header: an array of tables means its last element."""
        path: KeyPath = ()
        for key in keys:
            path = (*path, key)
            if path in self.tables:
                path = (*path, self.tables[path] - 1)
        return path

    def header(self) -> KeyPath:
        """A header: the path of the table that it opens."""
        start = self.position
        double = self.text.startswith("[[", start)
        self.position += 2 if double else 1
        keys = self.keys()
        if double and keys:
            path = (*self.full(keys[:-1]), keys[-1])
            self.tables[path] = self.tables.get(path, 0) + 1
        path = self.full(keys)
        self.note(path, start)
        self.skip_value()
        return path

    def statements(self) -> Iterator[tuple[KeyPath, int]]:
        """Every key with its whole path and its position."""
        table: KeyPath = ()
        while self.position < len(self.text):
            if match := BLANK.match(self.text, self.position):
                self.position = match.end()
            elif self.text.startswith("[", self.position):
                table = self.header()
            else:
                start = self.position
                keys = self.keys()
                self.skip_value()
                yield (*table, *keys), start


def line_index(text: str) -> dict[KeyPath, int]:
    """The line of every key and table of a text that tomllib accepts."""
    scanner = Scanner(text)
    for path, position in scanner.statements():
        scanner.note(path, position)
    return scanner.lines


def line_of(lines: dict[KeyPath, int], path: KeyPath) -> int:
    """The line of a path, or of the nearest table around it that has one; at least 1."""
    for length in range(len(path), 0, -1):
        if path[:length] in lines:
            return lines[path[:length]]
    return 1
