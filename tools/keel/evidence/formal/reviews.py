# SPDX-License-Identifier: Apache-2.0
"""Reviews by people: specs/reviews/UNIT.toml says who has looked at what, and when.

    [[review]]
    person = "a name"
    date = "2026-11-30"
    digest = "…"          # of what was looked at, as make review UNIT=queue tells it
    remarks = "what was found"

A unit without an entry has not been reviewed. A signature over another digest than the one of what
is there now is stale: it says nothing about the present text.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from keel.base.verdict_cache import digest, digest_of_files
from keel.c.project import Unit, find_units
from keel.config import Field, Table, Text, read_toml
from keel.evidence.part import State
from keel.evidence.part import Table as Shown
from keel.judge.goals import read_goals
from keel.judge.harness import MODELS

FOLDER = "specs/reviews"
NOT_REVIEWED = "not reviewed"


class Review(Table):
    """One person's signature."""

    person: Text
    date: Annotated[str, Field(pattern=r"^\d{4}-\d{2}-\d{2}$")]
    digest: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
    remarks: Text


class Form(Table):
    """The form of a unit."""

    review: list[Review] = []


@dataclass(frozen=True)
class Reviewed:
    """A unit, its form, and the digest of what is there now."""

    unit: str
    reviews: Sequence[Review]
    digest: str

    @property
    def stale(self) -> list[Review]:
        """Signatures over something else, of people who have not signed what is there now."""
        now = {one.person for one in self.reviews if one.digest == self.digest}
        return [one for one in self.reviews if one.digest != self.digest and one.person not in now]

    @property
    def state(self) -> State:
        """Good if somebody has signed what is there now."""
        if any(one.digest == self.digest for one in self.reviews):
            return "good"
        return "bad" if self.stale else "open"


def reviewed_files(unit: Unit) -> list[Path]:
    """What a reviewer of a unit looks at: requirements, contract, code, model, and proofs."""
    root = unit.root
    requirements = root / "specs/requirements" / f"{unit.name}.sdoc"
    models = [root / MODELS / f"{unit.name}.{ending}" for ending in ("h", "c")]
    proofs = [path for path in unit.folder.rglob("*") if path.is_file()]
    found = [requirements, *unit.own_files, *models, *proofs]
    return sorted(path for path in found if path.is_file())


def digest_of(unit: Unit) -> str:
    """SHA-256 over what a reviewer of a unit looks at."""
    files = [path for path in reviewed_files(unit) if path != unit.goal_list]
    goals = read_goals(unit.goal_list, unit.goal_list.name).names  # Not who proves them.
    return digest([digest_of_files(files, unit.root), goals])


def form_of(unit: Unit) -> Path:
    """Where the form of a unit is."""
    return unit.root / FOLDER / f"{unit.name}.toml"


def read_reviews(root: Path) -> list[Reviewed]:
    """The state of review of each unit that has proofs."""
    return [
        Reviewed(
            unit.name, read_toml(form_of(unit), Form).review if form_of(unit).is_file() else (),
            digest_of(unit),
        )
        for unit in find_units(root).values()
        if unit.folder.is_dir()
    ]  # fmt: skip


def problems(root: Path, reviewed: Sequence[Reviewed]) -> Iterator[str]:
    """A form that is missing, or of no unit, and a signature that is stale."""
    forms = {path.stem for path in (root / FOLDER).glob("*.toml")}
    for one in reviewed:
        shown = f"{FOLDER}/{one.unit}.toml"
        if one.unit not in forms:
            yield f"{shown}: is missing"
        for review in one.stale:
            yield (f"{shown}: the review by {review.person} on {review.date} is stale: what it"
                   f" was of has changed")  # fmt: skip
    for name in sorted(forms - {one.unit for one in reviewed}):
        yield f"{FOLDER}/{name}.toml: there is no unit {name} with proofs"


def table(reviewed: Sequence[Reviewed]) -> Shown:
    """Who has reviewed which unit."""
    rows: list[tuple[str, ...]] = []
    for one in reviewed:
        for review in one.reviews:
            how = "signed" if review.digest == one.digest else "STALE: of an earlier text"
            rows.append((f"unit:{one.unit}", how, review.person, review.date, review.remarks))
        if not one.reviews:
            rows.append((f"unit:{one.unit}", NOT_REVIEWED, "", "", ""))
    return Shown(
        title="Reviews", columns=("unit", "state", "person", "date", "remarks"), rows=tuple(rows),
        note="Whether a clause says what its requirement says is for people to judge. Where nobody"
             " has signed, nobody has been recorded to have judged it.",
    )  # fmt: skip
