# SPDX-License-Identifier: Apache-2.0
"""What ESBMC was asked (specs/third_opinion.toml), and its answers as evidence.

Every harness is either asked, or there is a reason why not: it has stand-ins, which only CBMC's
tools put in; it compares by a function of CBMC's own; or the file says why.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

from keel.base.errors import ToolError
from keel.c import source as csource
from keel.c.project import closure
from keel.config import Field, Table, Text, read_toml
from keel.gather.formal.bounds import Bounded
from keel.gather.formal.esbmc import PROVED, REFUTED, Question, narrowed
from keel.gather.part import Table as Shown
from keel.judge.harness import Harness
from keel.judge.wrong_bodies import WrongBody, read_wrong_bodies

FILE = "specs/third_opinion.toml"
REPORT = "opinion/report.json"
STAND_INS = "has stand-ins, which only CBMC's tools put in"
OWN_WORDS = "compares by __CPROVER_equal, which ESBMC does not have"

Report = Mapping[str, Any]


class Ask(Table):
    """A harness that ESBMC is asked about."""

    harness: Text
    unwind: Annotated[int, Field(ge=1)] = 2
    defines: list[Text] = []
    seconds: Annotated[int, Field(ge=1)] = 120


class Cannot(Table):
    """Harnesses that it is not asked about."""

    harness: list[Text]
    reason: Text


class Opinions(Table):
    """The file."""

    ask: list[Ask]
    cannot: list[Cannot] = []


def read_opinions(root: Path) -> Opinions:
    """The file."""
    return read_toml(root / FILE, Opinions)


def why_not(harness: Harness) -> str:
    """What keeps ESBMC from a harness, by its text; nothing if it is worth asking."""
    if harness.replaces:
        return STAND_INS
    files = closure(harness.unit.root, [harness.path])
    own = any("__CPROVER_equal" in csource.essence(path.read_text("utf-8")) for path in files)
    return OWN_WORDS if own else ""


def reasons(opinions: Opinions, harnesses: Sequence[Bounded]) -> dict[str, str]:
    """Why ESBMC is not asked about a harness, of those that it is not asked about."""
    asked = {one.harness for one in opinions.ask}
    given = {name: " ".join(one.reason.split()) for one in opinions.cannot for name in one.harness}
    return {
        one.id: given.get(one.id) or why_not(one.harness)
        for one in harnesses
        if one.id not in asked
    }


def file_problems(
    opinions: Opinions, harnesses: Sequence[Bounded], given: Mapping[str, str]
) -> Iterator[str]:
    """A harness that is neither asked nor excused, and one that does not exist."""
    known = {one.id for one in harnesses}
    asked = {one.harness for one in opinions.ask}
    named = asked | {name for one in opinions.cannot for name in one.harness}
    for name in sorted(named - known):
        yield f"{FILE}: there is no harness {name}"
    for name, why in sorted(given.items()):
        if not why:
            yield f"{FILE}: {name} is neither asked about, nor is there a reason why not"
    for name in sorted(asked & {name for one in opinions.cannot for name in one.harness}):
        yield f"{FILE}: {name} is both asked about and excused"


def _first_wrong(harness: Harness) -> WrongBody | None:
    """A wrong body that the harness must refute; the first, if there are several."""
    every = read_wrong_bodies(harness.unit)
    return next((wrong for wrong in every if wrong.harness == harness.name), None)


def questions(opinions: Opinions, harnesses: Sequence[Bounded]) -> list[Question]:
    """What ESBMC is asked."""
    known = {one.id: one.harness for one in harnesses}
    found = []
    for one in opinions.ask:
        if one.harness not in known:
            raise ToolError(f"{FILE}: there is no harness {one.harness}")
        harness = known[one.harness]
        found.append(
            Question(
                harness,
                one.unwind,
                narrowed(harness, one.defines),
                one.seconds,
                _first_wrong(harness),
            )
        )
    return found


def good(answer: Report) -> bool:
    """Whether ESBMC agrees: proved, and what is wrong refuted."""
    return answer["verdict"] == PROVED and answer["wrong"] in ("", REFUTED)


def problems(
    report: Report, opinions: Opinions, harnesses: Sequence[Bounded], given: Mapping[str, str]
) -> Iterator[str]:
    """What is wrong with the file, a harness without an answer, and one ESBMC does not agree on."""
    yield from file_problems(opinions, harnesses, given)
    answers = report.get("harnesses", {})
    for one in opinions.ask if report else ():
        answer = answers.get(one.harness)
        if not answer:
            yield f"build/{REPORT}: has no answer on {one.harness}"
        elif answer["verdict"] != PROVED:
            yield f"ESBMC does not prove {one.harness}: {answer['verdict']}"
        elif not good(answer):
            yield f"ESBMC does not refute the wrong body of {one.harness}: {answer['wrong']}"


def summary(report: Report, harnesses: Sequence[Bounded]) -> dict[str, str]:
    """How often the third engine agrees."""
    answers = report.get("harnesses", {}).values()
    agreed = sum(good(answer) for answer in answers)
    said = f"{agreed} of {len(answers)} that it was asked about, of {len(harnesses)} harnesses"
    return {"ESBMC agrees on": said}


def table(report: Report, harnesses: Sequence[Bounded], given: Mapping[str, str]) -> Shown:
    """Every harness, with ESBMC's answer, or the reason why it was not asked."""
    answers = report.get("harnesses", {})
    rows = []
    for one in harnesses:
        answer = answers.get(one.id)
        if answer:
            rows.append(
                (
                    f"harness:{one.id}",
                    answer["verdict"],
                    str(answer["properties"]),
                    answer["bounds"],
                    answer["wrong_body"],
                    answer["wrong"] or "none names it",
                    "",
                )
            )
        else:
            rows.append((f"harness:{one.id}", "not asked", "", "", "", "", given.get(one.id, "")))
    return Shown(
        title="A third opinion: ESBMC",
        columns=(
            "harness",
            "verdict",
            "properties",
            "unwinding and definitions",
            "wrong body",
            "verdict on it",
            "why not asked",
        ),
        rows=tuple(rows),
        note="ESBMC's capacities are often smaller than CBMC's, and its processor is a 32-bit x86."
        " Its front end began as CBMC's, so it is a third opinion rather than a third proof."
        f" {len(answers)} of {len(harnesses)} harnesses were asked.",
    )
