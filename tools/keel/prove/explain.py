# SPDX-License-Identifier: Apache-2.0
"""Explains one thing by its name: an open goal, a harness, an assertion, a wrong body.

For CBMC that is the counterexample as a state; for WP the clause, where it stands, what is known
there of the names in it and what the provers said. Nothing is kept: this is to look at.
"""

from __future__ import annotations

import difflib
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.audit import assertions
from keel.c.declarations import structures
from keel.c.project import Unit
from keel.engines.cbmc import Cbmc
from keel.engines.wp import Wp
from keel.judge import wp_frames
from keel.judge.cbmc_answers import Answer
from keel.judge.goals import read_goals
from keel.judge.harness import Harness, read_harness
from keel.judge.settings import Exceptions
from keel.judge.wp_targets import Target, targets
from keel.judge.wp_verdict import clause_at, place_of
from keel.judge.wrong_bodies import WrongBody, read_wrong_bodies
from keel.prove import sequents
from keel.prove.counterexample import changes, lines, read_trace
from keel.prove.located import in_words

GOAL, HARNESS, ASSERTION, WRONG = "goal", "harness", "assertion", "wrong body"
NEAREST = 3


@dataclass(frozen=True)
class Subject:
    """What bears a name; `where` is the harness of an assertion."""

    kind: str
    unit: Unit
    name: str
    where: str = ""

    @property
    def label(self) -> str:
        """The name, of an assertion only what stands before its colon."""
        return self.name.partition(":")[0]


class UnknownName(Exception):
    """Nothing bears the name; the message names what is nearest."""


def subjects(units: Iterable[Unit], report: Path) -> list[Subject]:
    """All that can be explained; `report` is the last run's, which knows goals that are new."""
    try:
        reported = json.loads(report.read_text(encoding="utf-8"))["units"]
    except (OSError, ValueError, KeyError):
        reported = {}
    found: list[Subject] = []
    for unit in units:
        seen = reported.get(unit.name, {})
        goals = [*read_goals(unit.goal_list, "goals.txt").names]
        goals += [goal["name"] for goal in seen.get("wp", {}).get("goal_list", [])]
        found += [Subject(GOAL, unit, name) for name in dict.fromkeys(goals)]
        found += [Subject(HARNESS, unit, path.stem) for path in unit.harnesses]
        found += [Subject(WRONG, unit, wrong.name) for wrong in read_wrong_bodies(unit)]
        found += [
            Subject(ASSERTION, unit, text, harness)
            for harness, text in sorted(_assertions(unit, seen))
        ]
    return found


def _assertions(unit: Unit, reported: Mapping[str, Mapping[str, object]]) -> set[tuple[str, str]]:
    """The assertions of a unit as they are listed, and as the last run saw them."""
    path = assertions.list_of(unit)
    listed = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    found = {(line.partition(" ")[0], line.partition(" ")[2]) for line in listed}
    harnesses = reported.get("cbmc", {}).get("harnesses", {})
    seen = assertions.lines(harnesses) if isinstance(harnesses, dict) else []
    return found | {(line.partition(" ")[0], line.partition(" ")[2]) for line in seen}


def named(every: Sequence[Subject], name: str) -> list[Subject]:
    """The subjects of a name; an assertion may be called by its label alone."""
    found = [one for one in every if name in (one.name, one.label)]
    if found:
        return found
    names = {one.label for one in every}
    near = difflib.get_close_matches(name, sorted(names), NEAREST, 0.4)
    hint = f"did you mean {' or '.join(near)}?" if near else "no name is like it"
    raise UnknownName(f"no goal, harness, assertion or wrong body is called {name}: {hint}")


@dataclass(frozen=True)
class Engines:
    """What answers questions."""

    cbmc: Cbmc
    wp: Wp
    exceptions: Mapping[str, Exceptions]
    # The texts of all headers, by whose structures fields are told.
    headers: Sequence[str]


class Explainer:
    """Explains subjects."""

    def __init__(self, engines: Engines, root: Path) -> None:
        self._engines = engines
        self._root = root

    def explain(self, subject: Subject) -> tuple[list[str], bool]:
        """The explanation, and whether all is well with the subject."""
        ways: dict[str, Callable[[Subject], tuple[list[str], bool]]] = {
            GOAL: self._goal,
            HARNESS: self._harness,
            ASSERTION: self._harness,
            WRONG: self._wrong,
        }
        return ways[subject.kind](subject)

    def _harness(self, subject: Subject) -> tuple[list[str], bool]:
        where = subject.where or subject.name
        path = next((path for path in subject.unit.harnesses if path.stem == where), None)
        if path is None:
            return [f"{where} is no harness any more"], False
        harness = read_harness(subject.unit, path)
        expect = [subject.name] if subject.kind == ASSERTION else []
        answer, complaint = self._engines.cbmc.counterexample(harness, None, expect)
        return self._answered(f"{where}", harness, answer, complaint)

    def _wrong(self, subject: Subject) -> tuple[list[str], bool]:
        every = read_wrong_bodies(subject.unit)
        wrong = next(wrong for wrong in every if wrong.name == subject.name)
        harness = read_harness(subject.unit, subject.unit.folder / f"{wrong.harness}.c")
        answer, complaint = self._engines.cbmc.counterexample(harness, wrong, wrong.expect)
        found, _ = self._answered(wrong.harness, harness, answer, complaint)
        refuted = bool(answer.trace)
        return [f"{wrong.shown}: what is wrong there:", *_fault(wrong), "", *found], refuted

    @staticmethod
    def _answered(
        name: str, harness: Harness, answer: Answer, complaint: str
    ) -> tuple[list[str], bool]:
        """What CBMC found."""
        if complaint:
            return [f"{name} does not build: {complaint}"], False
        if not answer.trace:
            unfinished = "" if answer.complete else f": {' '.join(answer.warnings)}"
            how = "there is no counterexample, it holds" if answer.complete else "no answer"
            return [f"{name}: {how}{unfinished}"], answer.complete
        return [f"{name} fails:", *counterexample_lines(harness, answer)], False

    def _goal(self, subject: Subject) -> tuple[list[str], bool]:
        target = _target_of(subject, self._engines.exceptions[subject.unit.name])
        if target is None:
            return [f"{subject.name}: no function of {subject.unit.name} has such a goal"], False
        tags = [name.removesuffix("_t") for name in structures(self._engines.headers)]
        every = sequents.read_sequents(self._engines.wp.printed(target), tags)
        found = sequents.of_goal(subject.name, every)
        if not found:
            return [f"{subject.name}: WP makes no such goal any more"], False
        text = [line for one in found for line in self._sequent(target, subject.name, one)]
        return text, all(one.proved for one in found)

    def _sequent(self, target: Target, goal: str, one: sequents.Sequent) -> Iterator[str]:
        """A goal of WP."""
        verdict = "proved" if one.proved else "not proved"
        yield f"{goal} is {verdict}: {in_words(', '.join(one.said))}"
        yield f"  {one.title}"
        for place in dict.fromkeys([place_of(target, goal, self._root), one.place]):
            if text := clause_at(self._root, place):
                yield f"  {place}: {text}"
        known, rest = sequents.relevant(one)
        if known or rest:
            yield "  known there:"
            yield from (f"    {text}    ({why})" for why, text in known)
            yield f"    and {rest} more, about other names or memory"
        yield "  to be proved:"
        yield f"    {one.claim}"


def counterexample_lines(harness: Harness, answer: Answer) -> Iterator[str]:
    """A counterexample, for people."""
    found = read_trace(answer.trace, harness.name, harness.function)
    yield f"  {found.reason}"
    yield f"  at {found.place}"
    yield from (f"  in {call}" for call in reversed(found.calls))
    yield ""
    called = f" at {found.called_at}" if found.called_at else ""
    yield f"before {harness.function} is called{called}:" if called else "at the end:"
    yield from (f"  {line}" for line in lines(found.before))
    if called:
        yield "after it:"
        yield from (f"  {line}" for line in changes(found.before, found.after))
        yield from (
            f"  {name} returned {value}"
            for name, value in found.returned.items()
            if not name.startswith(("any_", "nondet_"))
        )


def _fault(wrong: WrongBody) -> Iterator[str]:
    """The difference between the code and a wrong body."""
    place = str(wrong.file.relative_to(wrong.unit.root))
    before = wrong.file.read_text(encoding="utf-8").splitlines()
    after = wrong.text().splitlines()
    difference = difflib.unified_diff(before, after, place, "wrong", n=1, lineterm="")
    yield from (f"  {line}" for line in list(difference)[2:])


def _target_of(subject: Subject, exceptions: Exceptions) -> Target | None:
    """The function, or the lemmas, that a goal is of: the one with the longest name."""
    fits = [
        target
        for target in targets(subject.unit)
        if any(
            subject.name.startswith(name)
            for name in (
                [f"{target.function}_"]
                if target.function
                else [f"lemma_{name}" for name in target.lemmas]
            )
        )
    ]
    best = max(fits, key=lambda target: len(target.name), default=None)
    return wp_frames.restricted(best, exceptions) if best else None
