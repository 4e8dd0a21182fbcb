# SPDX-License-Identifier: Apache-2.0
"""Makes the parts, in a fixed order, and joins what they say of one thing."""

from __future__ import annotations

import importlib
import re
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from keel.base.errors import ToolError
from keel.gather.part import KINDS, PARTS, Context, Item, Part, State

WORST: tuple[State, ...] = ("bad", "open", "good", "told")
REFERENCE = re.compile(rf"(?:{'|'.join(KINDS)}):\S+")

# Those of a project that uses Keel.
OWN_PARTS = (
    "requirements",
    "contracts",
    "proofs",
    "tests",
    "tasks",
    "constraints",
    "configuration",
)
PARTS_OF_BOTH = ("contracts", "configuration")

Maker = Callable[[Context], Part]


@dataclass
class Entry:
    """All that the parts say of one thing."""

    key: str  # kind:id
    items: list[tuple[str, Item]] = field(default_factory=list)  # The part, and what it says.
    links: list[str] = field(default_factory=list)
    back: list[str] = field(default_factory=list)

    @property
    def kind(self) -> str:
        """requirement, function, ..."""
        return self.key.partition(":")[0]

    @property
    def id(self) -> str:
        """Unique within its kind."""
        return self.key.partition(":")[2]

    @property
    def title(self) -> str:
        """The first that says more than the id does."""
        titles = (item.title for _, item in self.items if item.title)
        return next((title for title in titles if title != self.id), self.id)

    @property
    def state(self) -> State:
        """The worst that a part says."""
        said = {item.state for _, item in self.items}
        return next((state for state in WORST if state in said), "told")

    @property
    def near(self) -> list[str]:
        """All that it is linked with, in either direction, each once."""
        return list(dict.fromkeys([*self.links, *self.back]))


@dataclass
class Assembled:
    """The parts, and what they speak of by its key."""

    parts: list[Part]
    entries: dict[str, Entry]
    problems: list[str]
    product: str = "Keel"

    def of_kind(self, kind: str) -> list[Entry]:
        """All things of a kind, in order."""
        return [entry for key, entry in self.entries.items() if entry.kind == kind]


def maker_of(name: str) -> Maker:
    """The function that makes a part."""
    module = f"keel.gather.parts.{name}"
    try:
        made: Maker = importlib.import_module(module).make
    except ModuleNotFoundError as error:
        if error.name != module:
            raise
        raise ToolError(f"is missing: there is no tools/keel/gather/parts/{name}.py") from error
    return made


def own_maker_of(name: str) -> Maker:
    """The same for a project that uses Keel; what says nothing of Keel alone serves both."""
    made: Maker = importlib.import_module(
        f"keel.gather.{'parts' if name in PARTS_OF_BOTH else 'users'}.{name}"
    ).make
    return made


def make_part(context: Context, name: str, find: Callable[[str], Maker]) -> tuple[Part, list[str]]:
    """A part and what is wrong with it; a part that cannot be made is empty."""
    try:
        part = find(name)(context)
    except ToolError as error:
        return Part(name=name, title=name), [f"{name}: {line}" for line in str(error).splitlines()]
    except Exception as error:  # A report with another content than its reader takes for granted.
        told = f"{name}: cannot be made: {type(error).__name__}: {error}"
        return Part(name=name, title=name), [told]
    missing = [
        f"{name}: {file}: is missing: {path}"
        for file, path in sorted(part.files.items())
        if not path.is_file()
    ]
    strange = [f"{name}: the part calls itself {part.name}"] if part.name != name else []
    return part, [*(f"{name}: {text}" for text in part.problems), *strange, *missing]


def doubled(part: Part) -> Iterator[str]:
    """Items that a part has twice."""
    counted = Counter(f"{item.kind}:{item.id}" for item in part.items)
    yield from (f"{part.name}: {key} is there twice" for key, times in counted.items() if times > 1)


def join(parts: Sequence[Part]) -> dict[str, Entry]:
    """What all parts say of each thing, with links in both directions."""
    entries: dict[str, Entry] = {}
    for part in parts:
        own = Item(kind="part", id=part.name, title=part.title)
        for item in (*part.items, own):
            key = f"{item.kind}:{item.id}"
            entry = entries.setdefault(key, Entry(key))
            entry.items.append((part.name, item))
            entry.links = list(dict.fromkeys([*entry.links, *item.links]))
    order = {kind: number for number, kind in enumerate(KINDS)}
    entries = dict(sorted(entries.items(), key=lambda one: (order[one[1].kind], one[0])))
    for key, entry in entries.items():
        for link in entry.links:
            if link in entries:
                entries[link].back.append(key)
    return entries


def cells(part: Part) -> Iterator[tuple[str, str]]:
    """The references in a part's tables, each with the table's title."""
    for table in part.tables:
        for row in table.rows:
            yield from ((table.title, cell) for cell in row if REFERENCE.fullmatch(cell))


def dangling(parts: Sequence[Part], entries: Mapping[str, Entry]) -> Iterator[str]:
    """Links that lead to nothing."""
    for part in parts:
        for item in part.items:
            for link in item.links:
                if link not in entries:
                    yield f"{part.name}: {item.kind}:{item.id} links to {link}, which is nowhere"
        for title, cell in cells(part):
            if cell not in entries:
                yield f"{part.name}: table {title!r} names {cell}, which is nowhere"
        for table in part.tables:
            for row in table.rows:
                if len(row) != len(table.columns):
                    yield f"{part.name}: table {table.title!r} has an uneven row: {row[:1]}"


def bad(entries: Mapping[str, Entry], problems: Sequence[str]) -> Iterator[str]:
    """Things that a part calls bad, and of which no problem speaks."""
    told = "\n".join(problems)
    for key, entry in entries.items():
        if entry.state == "bad" and entry.id not in told:
            by = ", ".join(part for part, item in entry.items if item.state == "bad")
            yield f"{by}: {key} is bad: {entry.title}"


def assemble(
    context: Context, names: Sequence[str] = PARTS, find: Callable[[str], Maker] = maker_of
) -> Assembled:
    """Make all parts, and look whether they hang together."""
    parts: list[Part] = []
    problems: list[str] = []
    for name in names:
        begun = time.monotonic()
        part, wrong = make_part(context, name, find)
        wrong += doubled(part)
        seconds = time.monotonic() - begun
        context.say(f"part {name}: {len(part.items)} items, {len(wrong)} problems, {seconds:.0f} s")
        parts.append(part)
        problems += wrong
    entries = join(parts)
    problems += dangling(parts, entries)
    problems += bad(entries, problems)
    return Assembled(parts, entries, list(dict.fromkeys(problems)))
