# SPDX-License-Identifier: Apache-2.0
"""Reads from a document what parts need: sections, tables, and words without marks."""

from __future__ import annotations

import re
from collections.abc import Iterator

CELL = re.compile(r"(?<!\\)\|")
RULE = re.compile(r"[-: ]+")
LINK = re.compile(r"\[([^]]*)\]\([^)]*\)")


def plain(text: str) -> str:
    """Words without links and marks."""
    return LINK.sub(r"\1", text).replace("**", "").replace("`", "").replace("\\|", "|").strip()


def sections(text: str) -> dict[str, str]:
    """What stands below each heading of the second level."""
    parts = re.split(r"^## (.*)$", text, flags=re.MULTILINE)
    return {parts[at].strip(): parts[at + 1].strip() for at in range(1, len(parts) - 1, 2)}


def cells(line: str) -> list[str]:
    """The cells of a row."""
    return [plain(cell) for cell in CELL.split(line.strip())[1:-1]]


def tables(text: str) -> Iterator[list[dict[str, str]]]:
    """Each table as its rows, by the names of the columns."""
    for match in re.finditer(r"(?:^\|.*\n?)+", text, re.MULTILINE):
        head, rule, *rows = match[0].splitlines()
        if all(RULE.fullmatch(cell) for cell in CELL.split(rule)[1:-1]):
            names = cells(head)
            yield [dict(zip(names, cells(row), strict=False)) for row in rows]


def paragraphs(text: str) -> str:
    """The text without its tables, a paragraph on one line each."""
    kept = re.sub(r"(?:^\|.*\n?)+", "\n", text, flags=re.MULTILINE)
    blocks = [block.strip() for block in re.split(r"\n\s*\n", kept) if block.strip()]
    joined = (re.sub(r"\n(?!\s*(?:-|\d+\.) )\s*", " ", block) for block in blocks)
    return "\n\n".join(plain(block) for block in joined)
