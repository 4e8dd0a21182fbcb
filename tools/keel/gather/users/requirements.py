# SPDX-License-Identifier: Apache-2.0
"""The part `requirements` of a project: its own, each with what proves and tests it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from keel import config
from keel.config import Field, Text, read_toml
from keel.gather.part import Context, Item, Part, State
from keel.gather.users.labels import requirements_of

FILE = "specs/requirements.toml"
TEXT = """\
Each requirement is named by clauses of contracts, by assertions of harnesses and by tests, which
bear its id: BAT_001_limit belongs to BAT-001."""


class Requirement(config.Table):
    """What the project's code shall do."""

    id: Annotated[str, Field(pattern=r"^[A-Z]{3}-[0-9]{3}$")]
    title: Text
    text: Text


class Requirements(config.Table):
    """The file."""

    requirement: list[Requirement]


def labels(context: Context, problems: list[str]) -> dict[str, set[str]]:
    """The requirements that proofs name, and those that tests name."""
    proofs = context.report("prove/report.json", problems)
    tests = context.report("test/report.json", problems)
    units = proofs.get("units", {}).values()
    goals = [goal["name"] for unit in units for goal in unit["wp"]["goal_list"]]
    asserted = [
        one["description"]
        for unit in units
        for harness in unit["cbmc"]["harnesses"].values()
        for one in harness["assertions"]
    ]
    tested = [test for suite in tests.get("suites", {}).values() for test in suite]
    return {"proof": requirements_of(*goals, *asserted), "test": requirements_of(*tested)}


def orphans(known: set[str], named: dict[str, set[str]]) -> Iterator[str]:
    """Requirements that nothing shows, and labels of requirements that there are not."""
    for what, seen in named.items():
        yield from (f"{uid}: no {what} names it" for uid in sorted(known - seen))
        yield from (
            f"{uid}: a {what} names it, but {FILE} does not have it" for uid in sorted(seen - known)
        )


def make(context: Context) -> Part:
    """All requirements."""
    problems: list[str] = []
    every = read_toml(context.root / FILE, Requirements).requirement
    named = labels(context, problems)
    if not problems:
        problems += orphans({one.id for one in every}, named)
    state: State = "bad" if problems else "good"
    items = tuple(
        Item(kind="requirement", id=one.id, title=one.title, text=one.text, state=state)
        for one in every
    )
    return Part(
        name="requirements",
        title="Requirements",
        text=TEXT,
        items=items,
        summary={"requirements": str(len(items))},
        problems=tuple(problems),
    )
