# SPDX-License-Identifier: Apache-2.0
"""The part `constraints` of a project: how it keeps each constraint of Keel's safety manual."""

from __future__ import annotations

from typing import Annotated

from keel import config
from keel.base.errors import ROOT
from keel.base.files import read_text
from keel.config import Field, Text, read_toml
from keel.gather.part import Context, Item, Part
from keel.gather.parts.safety import LEDGER, OWNER, constraint, entries

FILE = "specs/constraints.toml"
TEXT = """\
Keel's proofs hold under assumptions that only its user can ensure; its safety manual numbers them.
For each, this project says how it is kept."""


class Answer(config.Table):
    """How a constraint is kept."""

    id: Annotated[str, Field(pattern=r"^SC-[0-9]{2}$")]
    how: Text


class Answers(config.Table):
    """The file."""

    constraint: list[Answer]


def make(context: Context) -> Part:
    """All constraints, with their answers."""
    answers = {one.id: one.how for one in read_toml(context.root / FILE, Answers).constraint}
    rows = list(entries(read_text(ROOT / LEDGER)))
    asked = {item.id: item for item in map(constraint, rows)}
    owned = [constraint(row).id for row in rows if row.get("owner") == OWNER]
    problems = [f"{uid}: {FILE} does not say how it is kept" for uid in owned if uid not in answers]
    problems += [f"{uid}: there is no such constraint" for uid in answers if uid not in asked]
    items = tuple(
        Item(
            kind="constraint",
            id=uid,
            title=asked[uid].title,
            text=how,
            state="good",
            facts=asked[uid].facts,
        )
        for uid, how in answers.items()
        if uid in asked
    )
    return Part(
        name="constraints",
        title="Constraints of Keel's safety manual",
        text=TEXT,
        items=items,
        summary={"constraints kept": str(len(items))},
        problems=tuple(problems),
    )
