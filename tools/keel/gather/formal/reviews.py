# SPDX-License-Identifier: Apache-2.0
"""Reviews by people: specs/reviews.toml says who has looked at which unit, and when.

    [[review]]
    unit = "queue"
    person = "a name"
    date = "2026-11-30"
    digest = "…"          # of what was looked at, as make check NAME=review UNIT=queue tells it
    remarks = "what was found"

A unit without an entry has not been reviewed. A signature over another digest than the one of what
is there now is stale: it says nothing about the present text.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from keel.base.files import read_text
from keel.base.verdict_cache import digest, digest_of_files
from keel.c.project import Unit, find_units
from keel.config import Field, Mistake, Table, Text, parse_toml
from keel.gather.part import State
from keel.gather.part import Table as Shown
from keel.judge.goals import read_goals
from keel.judge.harness import MODELS

FILE = "specs/reviews.toml"
NOT_REVIEWED = "not reviewed"


class Review(Table):
    """One person's signature on a unit."""

    unit: Text
    person: Text
    date: Annotated[str, Field(pattern=r"^\d{4}-\d{2}-\d{2}$")]
    digest: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
    remarks: Text


class Reviews(Table):
    """The file."""

    review: list[Review] = []


@dataclass(frozen=True)
class Reviewed:
    """A unit, the signatures on it, and the digest of what is there now."""

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


def proved_units(root: Path) -> dict[str, Unit]:
    """The units that have proofs to review."""
    return {name: unit for name, unit in find_units(root).items() if unit.folder.is_dir()}


def read_reviews(root: Path) -> list[Reviewed]:
    """The state of review of each unit that has proofs; a signature on no such unit is refused."""
    units = proved_units(root)

    def strangers(read: Reviews) -> Iterator[Mistake]:
        for number, one in enumerate(read.review):
            if one.unit not in units:
                yield ("review", number, "unit"), f"there is no unit {one.unit} with proofs"

    signed = parse_toml(read_text(root / FILE), Reviews, FILE, strangers).review
    return [
        Reviewed(name, [one for one in signed if one.unit == name], digest_of(unit))
        for name, unit in units.items()
    ]


def problems(reviewed: Sequence[Reviewed]) -> Iterator[str]:
    """The signatures that are stale."""
    for one in reviewed:
        for review in one.stale:
            yield (
                f"{FILE}: {one.unit}: the review by {review.person} on {review.date} is stale:"
                f" what it was of has changed"
            )


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
        title="Reviews",
        columns=("unit", "state", "person", "date", "remarks"),
        rows=tuple(rows),
        note="Whether a clause says what its requirement says is for people to judge. Where nobody"
        " has signed, nobody has been recorded to have judged it.",
    )
