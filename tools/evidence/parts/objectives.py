# SPDX-License-Identifier: Apache-2.0
"""The part `objectives`: which objectives of the standards the evidence serves, and how far.

The data are people's judgement, in specs/objectives. An artefact that does not exist is refused;
that a status is right is for people to judge.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from common import config
from common.config import ConfigError, Text, place_of, read_toml

from evidence.assemble import KINDS, PARTS
from evidence.part import Context, Item, Part, State, Table

FOLDER = "specs/objectives"
WORDS = {"input": "met as input", "partly": "partly", "no": "not addressed"}
STATES: dict[str, State] = {"input": "good", "partly": "open", "no": "open"}
TEXT = """\
For each objective, in our own words, what in this package serves it. The standards' texts are with
those who publish them.

"Met as input" means that the artefacts named can be used for the objective as they are. It does not
mean that a system, or Keel, complies with a standard: compliance is shown by an applicant, for a
whole system, to an authority or an assessor. "Partly" says what is missing. "Not addressed" says
why."""


class Objective(config.Table):
    """One objective of a standard."""

    id: Text
    what: Text
    status: Literal["input", "partly", "no"]
    by: list[Text] = []
    why: str = ""


class Standard(config.Table):
    """A standard, and what of it is looked at."""

    id: Text
    title: Text
    note: Text
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
    for number, one in enumerate(standard.objective):
        place = ("objective", number)
        if one.id in seen:
            yield (*place, "id"), "is there twice"
        seen.add(one.id)
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


def item_of(standard: Standard, one: Objective) -> Item:
    """An objective as a thing of the package."""
    return Item(kind="objective", id=f"{standard.id}/{one.id}", title=one.what, text=one.why,
                state=STATES[one.status], facts={"status": WORDS[one.status]},
                links=tuple(one.by))  # fmt: skip


def table_of(standard: Standard) -> Table:
    """The objectives of a standard."""
    rows = tuple(
        (f"objective:{standard.id}/{one.id}", one.what, WORDS[one.status],
         ", ".join(one.by).replace("part:", "").replace("file:", ""), one.why)
        for one in standard.objective
    )  # fmt: skip
    columns = ("objective", "in our words", "status", "served by", "what is missing")
    return Table(title=standard.title, columns=columns, rows=rows, note=standard.note)


def figures(standard: Standard) -> str:
    """How many objectives have which status."""
    counted = Counter[str](one.status for one in standard.objective)
    return ", ".join(f"{counted[status]} {words}" for status, words in WORDS.items())


def make(context: Context) -> Part:
    """The matrices of all standards."""
    standards = read_standards(context.root)
    items = tuple(item_of(standard, one) for standard in standards for one in standard.objective)
    return Part(
        name="objectives", title="Objectives of the standards", text=TEXT, items=items,
        summary={standard.title: figures(standard) for standard in standards},
        tables=tuple(table_of(standard) for standard in standards),
    )  # fmt: skip
