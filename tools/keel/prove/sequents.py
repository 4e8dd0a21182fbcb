# SPDX-License-Identifier: Apache-2.0
"""Reads the goals that WP prints, and writes them as nearly as can be in the words of the contract.

WP names an address before it reads it (`Let a = shiftfield_F6_keel_queue_count(q)`, `Mchar_0[a]`).
Here that is `q->count` again. Hypotheses that share no name with what is to be proved are counted.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from keel.c.declarations import closing, split

TITLE = re.compile(
    r"^Goal (?P<title>.*?)(?: \(file (?P<file>[^,]+), line (?P<line>\d+)\))?"
    r"(?: in '(?P<function>\w+)')?:$"
)
LET = re.compile(r"^Let (\w+) = (.*?)\.$", re.M | re.S)
KINDS = r"(?:Have|When|Type|Init|If|Then|Else|Either|Stmt)"
ENTRY = re.compile(
    rf"^  (?:\(\* (?P<why>.*?) \*\)\n  )?(?P<kind>{KINDS})\b:? ?(?P<text>.*?)"
    rf"(?=^  \(\*|^  {KINDS}\b|\Z)",
    re.M | re.S,
)
VERDICT = re.compile(r"^Prover (.+?) returns (\w+)", re.M)
WORD = re.compile(r"[A-Za-z_]\w*")
MEMORY = re.compile(r"(?<!\w)M\w+?_\d+\s*\[")
FIELD = re.compile(r"\bshiftfield_F\d+_(\w+)\(")
SHIFT = re.compile(r"\bshift_\w+\(")
LABEL = re.compile(r"'([^']+)'")
# What is about WP's own model of memory and types.
MODEL = ("Type", "Init")
# Words of a title, and what they are in a goal's name.
WORDS = {
    "Preservation": "preserved",
    "Establishment": "established",
    "Post-condition": "ensures",
    "Pre-condition": "requires",
    "Invariant": "invariant",
    "Assertion": "assert",
    "Decreasing": "decrease",
    "Positivity": "positive",
    "assigns": "assigns",
    "Assigns": "assigns",
    "Loop": "loop",
    "Lemma": "lemma",
}


@dataclass(frozen=True)
class Sequent:
    """A goal: what is to be proved, and what is known there."""

    title: str
    place: str
    # Why it is known (a contract's clause, a branch), and what.
    known: tuple[tuple[str, str], ...]
    claim: str
    proved: bool
    # Each prover and what it said.
    said: tuple[str, ...]


def read_sequents(output: str, structs: Iterable[str]) -> list[Sequent]:
    """The goals in WP's output, when it is asked to print them."""
    tags = sorted(structs, key=len, reverse=True)
    blocks = re.split(r"^-{20,}$", output, flags=re.M)
    return [one for block in blocks if (one := _sequent(block, tags))]


def _sequent(block: str, tags: Sequence[str]) -> Sequent | None:
    start = block.find("\nGoal ")
    head, end, body = block[start + 1 :].partition(":\n")
    match = TITLE.match(" ".join((head + end.strip()).split())) if start >= 0 else None
    claim = re.search(r"^Prove: (.*?)\.$", body, re.M | re.S)
    if not match or not claim:
        return None
    lets = {name: " ".join(text.split()) for name, text in LET.findall(body)}
    assumed = re.search(r"^Assume \{\n(.*?)^\}$", body, re.M | re.S)
    entries = [
        entry
        for entry in ENTRY.finditer(assumed[1] if assumed else "")
        if entry["kind"] not in MODEL
    ]
    known = [
        (entry["why"] or entry["kind"], readable(entry["text"].strip(" \n."), lets, tags))
        for entry in entries
    ]
    said = VERDICT.findall(body)
    place = f"{match['file']}:{match['line']}" if match["file"] else ""
    return Sequent(
        match["title"],
        place,
        tuple(known),
        readable(claim[1], lets, tags),
        any(status == "Valid" for _, status in said),
        tuple(f"{prover}: {status}" for prover, status in said),
    )


def readable(text: str, lets: dict[str, str], tags: Sequence[str]) -> str:
    """A formula of WP with its abbreviations written out and reads of memory as in C."""
    text = " ".join(text.split())
    for _ in range(len(lets) + 1):
        text = WORD.sub(lambda word: lets.get(word[0], word[0]), text)
    for pattern, rewrite in ((FIELD, _field), (SHIFT, _shift)):
        while match := pattern.search(text):
            end = closing(text, match.end() - 1)
            inner = split(text[match.end() : end - 1], ",")
            text = text[: match.start()] + rewrite(match, inner, tags) + text[end:]
    text = _reads(text)
    text = re.sub(r"&\((\w+)\)->", r"\1.", text).replace("/\\", "&&").replace("\\/", "||")
    return re.sub(r"\b[PL]_(\w+\()(?:M\w+_\d+, )*", r"\1", text)


def _field(match: re.Match[str], inner: Sequence[str], tags: Sequence[str]) -> str:
    tag = next((tag for tag in tags if match[1].startswith(f"{tag}_")), "")
    name = match[1].removeprefix(f"{tag}_")
    owner = inner[0]
    return f"&{{{owner}->{name}}}" if not owner.startswith("&{") else f"&{{{owner[2:-1]}.{name}}}"


def _shift(_match: re.Match[str], inner: Sequence[str], _tags: Sequence[str]) -> str:
    owner = inner[0][2:-1] if inner[0].startswith("&{") else inner[0]
    return f"&{{{owner}[{inner[1]}]}}"


def _reads(text: str) -> str:
    """Reads of memory, innermost last: M[&{x}] is x, M[p] is *p."""
    while matches := list(MEMORY.finditer(text)):
        match = matches[-1]
        depth, end = 1, match.end()
        while depth and end < len(text):
            depth += {"[": 1, "]": -1}.get(text[end], 0)
            end += 1
        inner = text[match.end() : end - 1].strip()
        read = inner[2:-1] if inner.startswith("&{") else f"*{inner}"
        text = text[: match.start()] + read + text[end:]
    return text.replace("&{", "&").replace("}", "")


def bearing(goal: str, sequents: Sequence[Sequent]) -> list[Sequent]:
    """The sequents that bear a goal's name, its number aside, in WP's order."""
    found = []
    for one in sequents:
        labels = [re.sub(r"\W", "_", text) for text in LABEL.findall(one.title)]
        words = re.findall(r"[\w-]+", LABEL.sub("", one.title))
        fits = all(WORDS[word] in goal for word in words if word in WORDS)
        if fits and all(re.search(rf"_{label}(_|$)", goal) for label in labels[:1]):
            found.append(one)
    return found


def of_goal(goal: str, sequents: Sequence[Sequent]) -> list[Sequent]:
    """The sequents that bear a goal's name: those that are open, if any is."""
    found = bearing(goal, sequents)
    return [one for one in found if not one.proved] or found


def relevant(sequent: Sequent) -> tuple[list[tuple[str, str]], int]:
    """What is known of the names in the claim; and how much is known besides."""
    names = set(WORD.findall(sequent.claim))
    about = [(why, text) for why, text in sequent.known if names & set(WORD.findall(text))]
    about = [(why, text) for why, text in about if not text.startswith(("valid_r", "(region("))]
    return about, len(sequent.known) - len(about)
