# SPDX-License-Identifier: Apache-2.0
"""Plain English in documents and in the kernel's comments: no sentence begins with What or Who and
asks nothing, and a few words stay rare."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from keel.lint.texts import Finding, Text

# Written by `make prove ARGS=--update-goals`: it names functions.
GENERATED = "determined.md"
# The most uses of a word in a thousand words of all documents: just above what a revision left,
# which wrote only, again, next to or separate for most of them. Before it they had alone 1.5 times
# and told once in a thousand words, ten times as often as documents of comparable projects.
RARE = {"alone": 0.1, "told": 0.1, "anew": 0.1, "beside": 0.1, "apart": 0.1}

HIDDEN = re.compile(r"^```.*?^```$|`[^`\n]+`|^#.*?$|\]\([^)\s]+\)", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', re.DOTALL)
MARGIN = re.compile(r"^[ \t]*(?:/[*/]+!?<?|\*+/?)|@\w+|\*/", re.MULTILINE)
BREAK = "\0"
# Where a sentence ends: by its sign, a blank line, an item, or what breaks it.
END = re.compile(r"[.!?:][\"*)]*(?=\s)|\n[ \t]*\n|\n[ \t]*(?:[-*]|\d+\.)(?=\s)|\0")
INVERTED = re.compile(r"[*_\"(\s]*(?:What|Who)\b")
WORD = re.compile(r"[a-z][\w'-]*")


class Sentence(NamedTuple):
    """A sentence, and the line that it begins in."""

    line: int
    words: str


def blank(match: re.Match[str]) -> str:
    """Nothing, on as many lines."""
    return "\n" * match[0].count("\n") or " "


def in_contract(contract: str) -> str:
    """The comments in a contract, each on its line."""
    return "\n".join(line.partition("//")[2] or BREAK for line in contract[3:].split("\n"))


def prose_of(text: Text) -> str:
    """A document without code, headings and addresses; a source's comments, also in contracts."""
    whole = "\n".join(text.lines)
    if not text.is_kernel:
        return HIDDEN.sub(blank, whole).replace("|", BREAK)
    prose, last = "", 0
    for match in COMMENT.finditer(whole):
        if match[0].startswith('"'):
            continue
        is_contract = match[0][2:3] == "@"
        words = in_contract(match[0]) if is_contract else MARGIN.sub("", match[0])
        lines = "\n" * whole.count("\n", last, match.start())
        prose, last = prose + lines + words + BREAK, match.end()
    return prose


def sentences(text: Text) -> Iterator[Sentence]:
    """The sentences of a text, each with the sign at its end."""
    prose, start = prose_of(text), 0
    for end in [*(match.end() for match in END.finditer(prose)), len(prose)]:
        if words := prose[start:end].strip(f" \t\n{BREAK}"):
            line = prose.count("\n", 0, prose.index(words, start)) + 1
            yield Sentence(line, " ".join(words.split()))
        start = end


def check_prose(texts: Sequence[Text]) -> Iterator[Finding]:
    """The rules of sentences and of words, over all texts."""
    total, uses = 0, defaultdict[str, list[Finding]](list)
    for text in texts:
        is_document = text.path.endswith(".md") and not text.path.endswith(GENERATED)
        for line, sentence in sentences(text) if is_document or text.is_kernel else ():
            if INVERTED.match(sentence) and not sentence.rstrip('"*)').endswith("?"):
                yield Finding(text.path, line, f"a sentence begins with What or Who: {sentence}")
            words = WORD.findall(sentence.lower()) if is_document else []
            total += len(words)
            for word in filter(RARE.__contains__, words):
                uses[word].append(Finding(text.path, line, f"{word!r} is too frequent: {sentence}"))
    for word, found in uses.items():
        if len(found) * 1000 > RARE[word] * total:
            yield from found
