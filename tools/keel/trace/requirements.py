# SPDX-License-Identifier: Apache-2.0
"""Reads specs/requirements: two levels, in StrictDoc's grammar.

HLR-003 is a high-level requirement: its SOURCE cites the paper, or DERIVED says why there is none.
QUE-003 is a low-level requirement: its parents are high-level ones, or DERIVED says why it has
none. Every other level of detail is in the clauses of the contracts.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

HIGH = "HLR-"
FOLDER = "specs/requirements"
FIELD = re.compile(r"^([A-Z]+):(?: >>>\n((?:.*\n)*?)<<<| ?(.*))$", re.MULTILINE)
PARENT = re.compile(r"^- TYPE: Parent\n {2}VALUE: (\S+)$", re.MULTILINE)
CITED = re.compile(r"eqs?\. \d|sections? [IVX]+|figs?\. \d|tables? \d")
WAYS = {HIGH: ("proof", "test"), "": ("proof", "test", "theorem")}


def names(text: str) -> list[str]:
    """The names in a list with commas."""
    return re.findall(r"[^\s,]+", text)


@dataclass
class Requirement:
    """One entry, with what names it."""

    uid: str
    document: str = ""
    text: Mapping[str, str] = field(default_factory=dict)
    parents: list[str] = field(default_factory=list)
    clauses: list[str] = field(default_factory=list)
    harnesses: list[str] = field(default_factory=list)
    tests: list[str] = field(default_factory=list)

    @property
    def high(self) -> bool:
        """Whether it is a high-level one."""
        return self.uid.startswith(HIGH)

    def of(self, name: str) -> str:
        """A field's text; empty where there is none."""
        return self.text.get(name, "")

    @property
    def verification(self) -> list[str]:
        """How it is verified."""
        return names(self.of("VERIFICATION"))

    @property
    def listed_clauses(self) -> list[str]:
        """The labels that the entry lists."""
        return names(self.of("CLAUSES"))

    @property
    def listed_tests(self) -> list[str]:
        """The tests, or files of tests, that the entry lists."""
        return names(self.of("TESTS"))


def read_requirements(root: Path) -> list[Requirement]:
    """Every entry, in order."""
    found = []
    for path in sorted((root / FOLDER).glob("*.sdoc")):
        for entry in path.read_text(encoding="utf-8").split("\n[REQUIREMENT]\n")[1:]:
            text = {
                match[1]: (match[2] or match[3] or "").strip() for match in FIELD.finditer(entry)
            }
            found.append(Requirement(text["UID"], path.stem, text, PARENT.findall(entry)))
    return found


Requirements = Mapping[str, Requirement]


def children(known: Requirements) -> dict[str, list[Requirement]]:
    """The low-level requirements of each high-level one."""
    found: dict[str, list[Requirement]] = {uid: [] for uid, one in known.items() if one.high}
    for one in known.values():
        for uid in one.parents:
            found.setdefault(uid, []).append(one)
    return found


def level_problems(known: Requirements, paper: str) -> list[str]:
    """What is wrong between the levels; `paper` is the document that lists the departures."""
    below = children(known)
    found = []
    for one in known.values():
        texts = _high(one, below[one.uid], paper) if one.high else _low(one, known)
        found += [f"{one.uid}: {text}" for text in (*_either(one), *texts)]
    return found


def _either(one: Requirement) -> Iterator[str]:
    """What is wrong with an entry of either level."""
    ways = WAYS[HIGH if one.high else ""]
    if not one.verification or set(one.verification) - set(ways):
        yield f"VERIFICATION is not of {', '.join(ways)}"
    if not one.of("STATEMENT"):
        yield "it has no STATEMENT"


def _low(one: Requirement, known: Requirements) -> Iterator[str]:
    for uid in one.parents:
        if uid not in known:
            yield f"its parent {uid} does not exist"
        elif not known[uid].high:
            yield f"its parent {uid} is no high-level requirement"
    if not one.parents and not one.of("DERIVED"):
        yield "it has no parent, and no DERIVED says why"
    if one.parents and one.of("DERIVED"):
        yield "it has a parent, so it is not DERIVED"


def _high(one: Requirement, below: list[Requirement], paper: str) -> Iterator[str]:
    if one.parents:
        yield "a high-level requirement has no parent"
    if not one.of("RATIONALE"):
        yield "it has no RATIONALE"
    if one.of("DERIVED") and one.of("SOURCE"):
        yield "it has a SOURCE, so it is not DERIVED"
    elif not one.of("DERIVED") and not CITED.search(one.of("SOURCE")):
        yield "its SOURCE cites no equation, section, figure or table, and no DERIVED says why"
    if not below and not one.listed_tests:
        yield "no low-level requirement has it as its parent, and it lists no tests"
    if "proof" in one.verification and not any(_proved(low) for low in below):
        yield "VERIFICATION says proof, and none of its low-level requirements is proved"
    tested = one.listed_tests or any(low.tests or low.listed_tests for low in below)
    if "test" in one.verification and not tested:
        yield "VERIFICATION says test, and neither it nor a low-level requirement of it has tests"
    if bool(one.of("DEPARTURE")) != bool(re.search(rf"\b{one.uid}\b", paper)):
        yield "DEPARTURE and docs/paper.md do not agree on whether it departs from the paper"


def _proved(low: Requirement) -> bool:
    return low.verification in (["proof"], ["theorem"])
