# SPDX-License-Identifier: Apache-2.0
"""What belongs together on a page: the members of a unit, the proof of a function."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from keel.evidence.assemble import Assembled, Entry
from keel.gather.part import KINDS

# What a reader of one thing looks for, in this order.
ORDER = (
    "requirement",
    "unit",
    "function",
    "goal",
    "harness",
    "test",
    "mutant",
    "assumption",
    "constraint",
    "deviation",
    "objective",
    "tool",
    "image",
    "file",
)
IN_MATRIX = ("requirement", "function", "goal", "harness", "test", "mutant", "deviation")


def plural(kind: str) -> str:
    """The kind's name for many."""
    return f"{kind}s" if kind != "harness" else "harnesses"


@dataclass(frozen=True)
class Count:
    """How many of some things are how."""

    total: int
    good: int
    bad: int
    open: int

    @property
    def state(self) -> str:
        """The state of all together."""
        if not self.total:
            return "none"
        if self.bad:
            return "bad"
        if self.open:
            return "open"
        return "good" if self.good else "told"

    @property
    def text(self) -> str:
        """In few words."""
        if not self.total:
            return "none"
        if self.good == self.total or self.state == "told":
            return str(self.total)
        words = [f"{self.good} of {self.total}"]
        words += [f"{self.bad} bad"] if self.bad else []
        words += [f"{self.open} open"] if self.open else []
        return ", ".join(words)


def count(entries: Iterable[Entry]) -> Count:
    """Count things by their states."""
    states = [entry.state for entry in entries]
    return Count(len(states), states.count("good"), states.count("bad"), states.count("open"))


def by_kind(entries: Iterable[Entry]) -> dict[str, list[Entry]]:
    """Things by their kinds, in the reader's order."""
    found: dict[str, list[Entry]] = {}
    for entry in entries:
        found.setdefault(entry.kind, []).append(entry)
    known = [kind for kind in (*ORDER, *KINDS) if kind in found]
    return {kind: found[kind] for kind in dict.fromkeys(known)}


class Model:
    """The things of a package, and which unit each belongs to."""

    def __init__(self, made: Assembled) -> None:
        self.made = made
        self.entries = made.entries
        self.units = [entry.id for entry in made.of_kind("unit")]
        self.unit_of = self._units()
        self.members = self._members()

    def _own_unit(self, entry: Entry) -> str:
        """The unit that a thing names itself: by a link, or by the first part of its id."""
        if entry.kind == "unit":
            return entry.id
        linked = next((link[5:] for link in entry.links if link.startswith("unit:")), "")
        first = entry.id.split("/")[0]
        return linked or (first if first in self.units else "")

    def _units(self) -> dict[str, str]:
        """The unit of each thing: its own, or that of most of what it is linked with."""
        own = {key: self._own_unit(entry) for key, entry in self.entries.items()}
        units = dict(own)
        for key, entry in self.entries.items():
            if not own[key] and entry.kind in IN_MATRIX:
                near = Counter(own[link] for link in entry.near if own.get(link))
                units[key] = near.most_common(1)[0][0] if near else ""
        return units

    def _members(self) -> dict[str, list[Entry]]:
        found: dict[str, list[Entry]] = {unit: [] for unit in self.units}
        for key, unit in self.unit_of.items():
            if unit in found and key != f"unit:{unit}":
                found[unit].append(self.entries[key])
        return found

    def existing(self, keys: Iterable[str]) -> list[Entry]:
        """The things with these keys; a package with a dangling link is drawn, too, as a draft."""
        return [self.entries[key] for key in dict.fromkeys(keys) if key in self.entries]

    def matrix(self) -> list[tuple[Entry, list[Count]]]:
        """For each unit how much there is of each kind of evidence."""
        rows = []
        for unit in self.units:
            members = self.members[unit]
            counts = [count(one for one in members if one.kind == kind) for kind in IN_MATRIX]
            rows.append((self.entries[f"unit:{unit}"], counts))
        return rows

    def related(self, entry: Entry) -> dict[str, list[Entry]]:
        """What a page shows of a thing: its neighbours; of a function also what its harnesses
        show and what its mutants are; of a unit its members."""
        near = self.existing(entry.near)
        if entry.kind == "unit":
            near = [*self.members[entry.id], *near]
        if entry.kind == "function":
            far = [key for one in near if one.kind == "harness" for key in one.near]
            keep = ("goal", "mutant")
            near += [one for one in self.existing(far) if one.kind in keep]
        unique = {one.key: one for one in near if one.key != entry.key}
        return by_kind(unique.values())
