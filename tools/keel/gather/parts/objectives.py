# SPDX-License-Identifier: Apache-2.0
"""The part `objectives`: which objectives of the standards the evidence serves, and how far.

The data are people's judgement, in specs/objectives. An artefact that does not exist is refused;
that a status is right is for people to judge.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from datetime import date
from pathlib import Path
from typing import Literal

from keel import config
from keel.config import ConfigError, Text, place_of, read_toml
from keel.gather.part import KINDS, PARTS, Context, Item, Part, State, Table

FOLDER = "specs/objectives"
WORDS = {"input": "met as input", "partly": "partly", "no": "not addressed"}
STATES: dict[str, State] = {"input": "good", "partly": "open", "no": "open"}
TEXT = """\
For each objective, in our own words, what in this package serves it. The standards' texts are with
those who publish them.

"Met as input" means that the artefacts named can be used for the objective as they are. It does not
mean that a system, or Keel, complies with a standard: compliance is shown by an applicant, for a
whole system, to an authority or an assessor. "Partly" says what is missing. "Not addressed" says
why.

The standards were not at hand when this was written. "Number compared with" names the public text
that was read for the number of a row and its subject; it is told below each table. Where it says
"nothing", both are from memory. Whoever uses a row looks it up in the standard first."""
UNCHECKED = "nothing"


class Source(config.Table):
    """A public text with which numbers of a standard were compared."""

    id: Text
    address: Text
    on: date
    what: Text


class Objective(config.Table):
    """One objective of a standard."""

    id: Text
    checked: str = ""
    what: Text
    status: Literal["input", "partly", "no"]
    by: list[Text] = []
    why: str = ""


class Standard(config.Table):
    """A standard, and what of it is looked at."""

    id: Text
    title: Text
    note: Text
    source: list[Source] = []
    objective: list[Objective]


def exists(root: Path, artefact: str) -> bool:
    """Whether an artefact is a part, a file, or may be something that a part has: the links of
    all parts are looked at when they are put together."""
    kind, _, name = artefact.partition(":")
    if kind == "part":
        return name in PARTS
    if kind == "file":
        return (root / name).is_file()
    return kind in KINDS and bool(name)


def mistakes(root: Path, standard: Standard) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """What types do not say: artefacts exist, what is missing is said, ids are unique."""
    seen: set[str] = set()
    sources = {source.id for source in standard.source}
    for number, one in enumerate(standard.objective):
        place = ("objective", number)
        if one.id in seen:
            yield (*place, "id"), "is there twice"
        seen.add(one.id)
        if one.checked and one.checked not in sources:
            yield (*place, "checked"), f"there is no source {one.checked}"
        for artefact in one.by:
            if not exists(root, artefact):
                yield (*place, "by"), f"there is no artefact {artefact}"
        if one.status != "no" and not one.by:
            yield (*place, "status"), f"{one.status}, but no artefact is named"
        if one.status != "input" and not one.why:
            yield (*place, "status"), f"{one.status}, but why does not say what is missing"


def read_standards(root: Path) -> list[Standard]:
    """All standards, in the order of their files."""
    paths = sorted((root / FOLDER).glob("*.toml"))
    if not paths:
        raise ConfigError(f"{place_of(root / FOLDER)}: there is no standard")
    return [read_toml(path, Standard, lambda found: mistakes(root, found)) for path in paths]


def compared(standard: Standard, one: Objective) -> str:
    """With what the number of an objective was compared, for its own page."""
    for source in standard.source:
        if source.id == one.checked:
            return f"{source.id}, {source.on}: {source.address}"
    return f"{UNCHECKED}: it is from memory"


def item_of(standard: Standard, one: Objective) -> Item:
    """An objective as a thing of the package."""
    return Item(
        kind="objective",
        id=f"{standard.id}/{one.id}",
        title=one.what,
        text=one.why,
        state=STATES[one.status],
        facts={"status": WORDS[one.status], "number compared with": compared(standard, one)},
        links=tuple(one.by),
    )


def table_of(standard: Standard) -> Table:
    """The objectives of a standard."""
    rows = tuple(
        (
            f"objective:{standard.id}/{one.id}",
            one.checked or UNCHECKED,
            one.what,
            WORDS[one.status],
            ", ".join(one.by).replace("part:", "").replace("file:", ""),
            one.why,
        )
        for one in standard.objective
    )
    columns = (
        "objective",
        "number compared with",
        "in our words",
        "status",
        "served by",
        "what is missing",
    )
    notes = [
        standard.note,
        *(
            f"{source.id} ({source.address}, read on {source.on}): {source.what}."
            for source in standard.source
        ),
    ]
    return Table(title=standard.title, columns=columns, rows=rows, note=" ".join(notes))


def figures(standard: Standard) -> str:
    """How many objectives have which status, and how many numbers are from memory alone."""
    counted = Counter[str](one.status for one in standard.objective)
    statuses = ", ".join(f"{counted[status]} {words}" for status, words in WORDS.items())
    unchecked = sum(not one.checked for one in standard.objective)
    return f"{statuses}; {unchecked} of {len(standard.objective)} numbers from memory alone"


def make(context: Context) -> Part:
    """The matrices of all standards."""
    standards = read_standards(context.root)
    items = tuple(item_of(standard, one) for standard in standards for one in standard.objective)
    return Part(
        name="objectives",
        title="Objectives of the standards",
        text=TEXT,
        items=items,
        summary={standard.title: figures(standard) for standard in standards},
        tables=tuple(table_of(standard) for standard in standards),
    )
