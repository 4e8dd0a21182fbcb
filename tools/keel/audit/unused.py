# SPDX-License-Identifier: Apache-2.0
"""Finds what contracts define and nothing uses: it looks like a guarantee, and is none.

A predicate, a logic function or a macro counts as used when a clause uses it, or a definition that
is itself used, or the code. Lemmas are left alone: provers use them without naming them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from keel.c import source as csource

DEFINITION = re.compile(
    r"\b(?:predicate|logic\s+\w+(?:\s*\*)*)\s+(?P<name>\w+)\s*(?:\{[^}]*\})?\s*(?:\([^)]*\))?\s*"
    r"(?:reads\b[^=;]*)?(?:=(?P<body>[^;]*))?;"
)
MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.MULTILINE)
WORD = re.compile(r"\b[A-Za-z_]\w*")
PROVED = ("include/**/*.h", "src/**/*.c", "proofs/**/*.[ch]")
OTHERS = ("bsp/**/*.[chS]", "examples/**/*.[ch]", "tests/**/*.[ch]", "tests/**/*.[ch]pp")


def problems(root: Path) -> list[str]:
    """Definitions of contracts, and macros of headers, that nothing uses."""
    proved = _read(root, PROVED)
    defined: dict[str, tuple[str, str]] = {}
    roots: set[str] = set()
    for path, text in proved.items():
        for line, inner in csource.acsl(text):
            for match in DEFINITION.finditer(inner):
                place = f"{path.relative_to(root)}:{line + inner.count(chr(10), 0, match.start())}"
                defined[match["name"]] = (place, match["body"] or "")
            roots |= set(WORD.findall(DEFINITION.sub(" ", inner)))
    used = _reached(roots, {name: body for name, (_, body) in defined.items()})
    found = [
        f"{place}: {name} is used by no contract and no proof, remove it"
        for name, (place, _) in defined.items()
        if name not in used
    ]
    return found + _macros(root, proved)


def _read(root: Path, patterns: Iterable[str]) -> dict[Path, str]:
    paths = sorted({path for pattern in patterns for path in root.glob(pattern)})
    return {path: path.read_text(encoding="utf-8") for path in paths}


def _reached(roots: set[str], bodies: dict[str, str]) -> set[str]:
    """The definitions that the roots lead to."""
    reached: set[str] = set()
    waiting = [name for name in bodies if name in roots]
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached.add(name)
            waiting += [other for other in WORD.findall(bodies[name]) if other in bodies]
    return reached


def _macros(root: Path, proved: dict[Path, str]) -> list[str]:
    """Macros of Keel's headers whose name stands nowhere else; guards of headers aside."""
    texts = proved | _read(root, OTHERS)
    words: dict[str, int] = {}
    for text in texts.values():
        for word in WORD.findall(_without_notes(text)):
            words[word] = words.get(word, 0) + 1
    found = []
    for path, text in proved.items():
        if not path.is_relative_to(root / "include"):
            continue
        for match in MACRO.finditer(text):
            if words.get(match[1], 0) < 2:
                line = text.count("\n", 0, match.start()) + 1
                place = f"{path.relative_to(root)}:{line}"
                found.append(f"{place}: nothing uses the macro {match[1]}, remove it")
    return found


def _without_notes(text: str) -> str:
    """The text without comments, but with annotations: to be named in prose is no use."""

    def replace(match: re.Match[str]) -> str:
        comment = match.group("comment")
        if comment and comment[2:3] != "@":
            return csource.blanked(match)
        return re.sub(r"//[^\n]*", csource.blanked, match.group()) if comment else match.group()

    return csource.TOKEN.sub(replace, text)
