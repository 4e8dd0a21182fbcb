# SPDX-License-Identifier: Apache-2.0
"""The graphs of the site: the neighbours of one thing, the trace of a unit, all units."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from keel.evidence.assemble import Entry
from keel.evidence.site.addresses import Address
from keel.evidence.site.graph import Node, draw
from keel.evidence.site.model import Model, by_kind, count, plural

FEW = 5  # So many neighbours of a kind are drawn one by one.
COLUMNS = {"requirement": 0, "function": 1, "harness": 2, "goal": 3, "test": 3, "mutant": 4}
ONE_BY_ONE = ("requirement", "function", "harness")

Edge = tuple[str, str]


class Tracer:
    """Draws for pages at one depth of the package."""

    def __init__(self, model: Model, places: Mapping[str, Address], root: str) -> None:
        self.model = model
        self.places = places
        self.root = root

    def _node(self, entry: Entry, column: int) -> Node:
        address = self.places[entry.key].seen_from(self.root)
        return Node(entry.key, entry.id, address, entry.state, column, entry.title)

    def _bundle(
        self, key: str, kind: str, entries: Sequence[Entry], address: str, column: int
    ) -> Node:
        """Many things of a kind as one node."""
        counted = count(entries)
        many = kind if counted.total == 1 else plural(kind)
        return Node(key, f"{counted.total} {many}", address, counted.state, column, counted.text)

    def _side(self, entries: Iterable[Entry], column: int) -> list[Node]:
        """The neighbours on one side; of many of a kind a node that leads to their list below."""
        nodes = []
        for kind, some in by_kind(entries).items():
            if len(some) <= FEW:
                nodes += [self._node(one, column) for one in some]
            else:
                nodes.append(self._bundle(f"{column}{kind}", kind, some, f"#{kind}", column))
        return nodes

    def around(self, entry: Entry) -> str:
        """One thing between what it rests on and what refers to it; empty when it stands alone."""
        rests = self._side(self.model.existing(entry.links), 0)
        back = [key for key in entry.back if key not in entry.links]
        refers = self._side(self.model.existing(back), 2)
        if not rests and not refers:
            return ""
        own = self._node(entry, 1)
        edges = [(node.key, own.key) for node in rests] + [(own.key, node.key) for node in refers]
        return draw([*rests, own, *refers], edges, f"What {entry.id} is linked with")

    def _bundles(self, members: Sequence[Entry], keys: set[str]) -> tuple[list[Node], list[Edge]]:
        """Goals, tests and mutants, together for each thing that they belong to."""
        nodes: list[Node] = []
        edges: list[Edge] = []
        for kind in ("goal", "test", "mutant"):
            some = [one for one in members if one.kind == kind]
            for owner, owned in self._owned(some, keys).items():
                key = f"{kind}s of {owner}"
                address = f"{self.places[owner].seen_from(self.root)}#{kind}"
                nodes.append(self._bundle(key, kind, owned, address, COLUMNS[kind]))
                edges.append((owner, key))
        return nodes, edges

    @staticmethod
    def _owned(entries: Iterable[Entry], keys: set[str]) -> dict[str, list[Entry]]:
        """Things by the first that is drawn of what they are linked with: harness, function,
        requirement."""
        found: dict[str, list[Entry]] = {}
        for entry in entries:
            near = sorted((one for one in entry.near if one in keys), key=rank)
            if near:
                found.setdefault(near[0], []).append(entry)
        return found

    def of_unit(self, unit: str) -> str:
        """Requirements, functions, harnesses, and how many goals, tests and mutants they have."""
        members = self.model.members[unit]
        single = [one for one in members if one.kind in ONE_BY_ONE]
        keys = {one.key for one in single}
        nodes = [self._node(one, COLUMNS[one.kind]) for one in single]
        edges = [
            (start, end)
            for end in keys
            for start in self.model.entries[end].near
            if start in keys and COLUMNS[kind_of(start)] < COLUMNS[kind_of(end)]
        ]
        more, others = self._bundles(members, keys)
        return draw([*nodes, *more], [*sorted(edges), *others], f"The trace of {unit}")

    def of_all(self, address: Callable[[str], str]) -> str:
        """The units, each between its requirements and its evidence."""
        nodes: list[Node] = []
        edges: list[Edge] = []
        for unit in self.model.units:
            entry = self.model.entries[f"unit:{unit}"]
            nodes.append(Node(entry.key, unit, address(unit), entry.state, 1, entry.title))
            for kind, some in by_kind(self.model.members[unit]).items():
                if kind in COLUMNS and kind != "function":
                    column = 0 if kind == "requirement" else COLUMNS[kind]
                    key = f"{kind} of {unit}"
                    leads = f"{self.places[entry.key].seen_from(self.root)}#{kind}"
                    nodes.append(self._bundle(key, kind, some, leads, column))
                    edges.append((entry.key, key) if column else (key, entry.key))
        return draw(nodes, edges, "All units")


def kind_of(key: str) -> str:
    """The kind in a key."""
    return key.partition(":")[0]


def rank(key: str) -> tuple[int, str]:
    """The nearest to a piece of evidence first."""
    return -COLUMNS[kind_of(key)], key
