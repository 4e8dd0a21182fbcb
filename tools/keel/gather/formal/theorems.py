# SPDX-License-Identifier: Apache-2.0
"""The headline theorems (specs/theorems.toml), and which engines prove what they rest on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from keel.config import Table, Text, read_toml
from keel.gather.formal.goals import requirements_in
from keel.gather.part import Item
from keel.gather.part import Table as Shown

FILE = "specs/theorems.toml"
ENGINES = ("WP", "CBMC", "Gappa")

Proved = Mapping[str, Counter[str]]  # By requirement: how many goals each engine has proved.


class Theorem(Table):
    """What holds, and what that rests on."""

    id: Text
    statement: Text
    rests_on: list[Text]
    assuming: list[Text] = []
    alone: dict[str, Text] = {}
    by_hand: str = ""


class Theorems(Table):
    """The file."""

    theorem: list[Theorem]


def read_theorems(root: Path) -> list[Theorem]:
    """All theorems."""
    return read_toml(root / FILE, Theorems).theorem


def proved(goals: Sequence[Item]) -> tuple[Proved, set[str]]:
    """What each engine proved of each requirement, and the requirements with a goal that is not."""
    counts: dict[str, Counter[str]] = {}
    broken = set()
    for goal in goals:
        for one in requirements_in(goal.id):
            if goal.state == "good":
                counts.setdefault(one, Counter())[goal.facts["engine"]] += 1
            else:
                broken.add(one)
    return counts, broken


def problems(
    theorems: Sequence[Theorem], goals: Sequence[Item], assumptions: Sequence[str]
) -> Iterator[str]:
    """What keeps a theorem from being one, and what is said of it that is not so."""
    counts, broken = proved(goals)
    for theorem in theorems:
        start = f"{FILE}: theorem {theorem.id}"
        for one in theorem.rests_on:
            if one in broken:
                yield f"{start}: {one} has a goal that is not proved"
            elif not counts.get(one):
                yield f"{start}: no goal bears the label of {one}"
            elif len(counts[one]) == 1 and one not in theorem.alone:
                engine = next(iter(counts[one]))
                yield f"{start}: {one} is proved by {engine} alone, without a reason"
        for one in theorem.alone:
            if one not in theorem.rests_on:
                yield f"{start}: alone: does not rest on {one}"
            elif len(counts.get(one, ())) > 1:
                yield f"{start}: alone: needless, {one} is proved by {', '.join(counts[one])}"
        for one in sorted(set(theorem.assuming) - set(assumptions)):
            yield f"{start}: assuming: the ledger has no {one}"


def _by(counts: Counter[str]) -> str:
    """How many goals by which engine."""
    return ", ".join(f"{engine} {counts[engine]}" for engine in ENGINES if counts[engine]) or "none"


def table(theorems: Sequence[Theorem], goals: Sequence[Item]) -> Shown:
    """A line for each requirement that a theorem rests on."""
    counts, _ = proved(goals)
    rows = [
        (
            theorem.id,
            " ".join(theorem.statement.split()),
            f"requirement:{one}",
            _by(counts.get(one, Counter())),
            " ".join(theorem.alone.get(one, "").split()),
            " ".join(f"assumption:{one}" for one in theorem.assuming),
            " ".join(theorem.by_hand.split()),
        )
        for theorem in theorems
        for one in theorem.rests_on
    ]
    return Shown(
        title="Headline theorems",
        columns=(
            "theorem",
            "statement",
            "rests on",
            "goals proved by",
            "why one engine alone",
            "assuming besides A-01 to A-06, A-26 to A-30",
            "composed by hand",
        ),
        rows=tuple(rows),
        note="Two engines share no code and work on different models. Within which bounds CBMC"
        " proves is in the table of harnesses; what is composed by hand no prover has seen.",
    )
