# SPDX-License-Identifier: Apache-2.0
"""Joins requirements and functions with what the reports say: of goals, harnesses and tests."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from keel.trace.functions import Function
from keel.trace.requirements import Requirement

Report = Mapping[str, Any]

LABEL = re.compile(r"(?<![A-Z])([A-Z]{3,4})_(\d{3})(?!\d)")
WP, CBMC, GAPPA, HARNESS, TEST = "WP", "CBMC", "Gappa", "harness", "test"
# Suites that stand for a file of tests whose name is not theirs.
SUITES = {"tests/target/faults.c": "fault/", "tests/target/differential.c": "differential"}
FILE = re.compile(r"tests/(\w+)/(?:test_)?(\w+)\.\w+")


@dataclass(frozen=True)
class Verdict:
    """What a report says of a goal, a harness or a test."""

    key: str  # kind:id, as an item of the evidence package
    by: str
    good: bool
    said: str
    uids: tuple[str, ...]
    unit: str = ""
    function: str = ""


def uids_in(*texts: str) -> tuple[str, ...]:
    """The requirements that labels name, each once."""
    found = (f"{unit}-{number}" for text in texts for unit, number in LABEL.findall(text))
    return tuple(dict.fromkeys(found))


def of_proofs(report: Report) -> Iterator[Verdict]:
    """The goals of all engines, and the harnesses."""
    for unit, found in report.get("units", {}).items():
        for goal in found["wp"]["goal_list"]:
            name, status = goal["name"], goal["status"]
            function = goal.get("target", "").rpartition(":")[2]
            yield Verdict(
                f"goal:{unit}/{name}", WP, status == "Valid", status, uids_in(name), unit, function
            )
        for name, harness in found["cbmc"]["harnesses"].items():
            yield from _of_harness(unit, name, harness)
        for goal in found["gappa"]["goal_list"]:
            name, status = goal["name"], goal["status"]
            yield Verdict(
                f"goal:{unit}/{name}", GAPPA, status == "Valid", status, uids_in(name), unit
            )


def _of_harness(unit: str, name: str, harness: Report) -> Iterator[Verdict]:
    """A harness, and its labelled assertions; one label may stand at several places."""
    function = name.removesuffix("_harness").partition("__")[0]
    said: dict[str, list[str]] = {}
    for assertion in harness["assertions"]:
        said.setdefault(assertion["description"].partition(":")[0], []).append(assertion["status"])
    for label, statuses in said.items():
        yield Verdict(
            f"goal:{unit}/{name}/{label}",
            CBMC,
            set(statuses) == {"SUCCESS"},
            ", ".join(dict.fromkeys(statuses)),
            uids_in(label),
            unit,
            function,
        )
    proved = f"{harness['proved']} of {harness['properties']} proved"
    good = bool(harness["sound"]) and harness["proved"] == harness["properties"] > 0
    sound = "" if harness["sound"] else ", not sound"
    yield Verdict(
        f"harness:{unit}/{name}", HARNESS, good, proved + sound, uids_in(*said), unit, function
    )


def of_tests(*reports: Report) -> list[Verdict]:
    """The tests of several runs; one that failed in any of them failed."""
    said: dict[str, dict[str, None]] = {}
    for report in reports:
        for suite, outcome in report.get("suites", {}).items():
            for test, verdict in outcome["tests"].items():
                said.setdefault(f"{suite}/{test}", {})[verdict] = None
    found = []
    for name, verdicts in said.items():
        suite, _, test = name.rpartition("/")
        named = uids_in(test) if LABEL.match(test) else ()
        good = list(verdicts) == ["passed"]
        unit = suite.partition("/")[2]
        found.append(Verdict(f"test:{name}", TEST, good, ", ".join(verdicts), named[:1], unit))
    return found


@dataclass
class Verdicts:
    """All verdicts, by what they speak of."""

    every: list[Verdict]
    functions: Iterable[Function] = ()
    by_uid: dict[str, list[Verdict]] = field(default_factory=dict)
    by_function: dict[str, list[Verdict]] = field(default_factory=dict)
    tests: dict[str, list[Verdict]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for one in self.every:
            for uid in one.uids:
                self.by_uid.setdefault(uid, []).append(one)
            if one.function:
                self.by_function.setdefault(one.function, []).append(one)
            if one.by == TEST:
                self.tests.setdefault(one.key.rpartition("/")[2], []).append(one)

    def listed(self, name: str) -> list[Verdict]:
        """The tests that TESTS means by a name, or by a file."""
        match = FILE.fullmatch(name)
        if not match:
            return self.tests.get(name, [])
        start = SUITES.get(name, f"{match[1]}/{match[2]}/")
        return [one for one in self.every if one.key.startswith(f"test:{start}")]

    def states_clause(self, one: Requirement, label: str) -> bool:
        """Whether a goal or an assertion bears the label. WP splits goals into parts, and shortens
        what makes a name too long: then the id is left, which counts if it is no label itself."""
        short = one.uid.replace("-", "_")
        said = label if short in one.clauses else f"(?:{label}|{short})"
        whole = re.compile(rf"(?<![A-Za-z]){said}(?:_part\d+|_\d+)*$")
        return any(whole.search(verdict.key) for verdict in self.by_uid.get(one.uid, ()))

    def bearing(self, uid: str) -> list[Function]:
        """The functions that trace to a requirement by their own contracts."""
        return [one for one in self.functions if uid in one.requirements and not one.helper]

    def of(self, one: Requirement) -> list[Verdict]:
        """All that speaks of a requirement: by its label, by its list, or of its functions."""
        own = list(self.by_uid.get(one.uid, ()))
        own += [verdict for name in one.listed_tests for verdict in self.listed(name)]
        names = [function.name for function in self.bearing(one.uid)]
        own += [
            verdict
            for name in names
            for verdict in self.by_function.get(name, ())
            if verdict.by == HARNESS
        ]
        return list({verdict.key: verdict for verdict in own}.values())


def modelled(one: Requirement) -> bool:
    """Whether a model with which harnesses compare the code names the requirement."""
    return any(name.startswith("specs/model/") for name in one.harnesses)


def state_of(one: Requirement, own: Iterable[Verdict]) -> str:
    """How a low-level requirement stands: bad, open, told (composed by hand), or good."""
    verdicts = list(own)
    if any(not verdict.good for verdict in verdicts):
        return "bad"
    kinds = {verdict.by for verdict in verdicts}
    # A harness that compares the function with a model proves what the model says.
    needed = {"proof": {WP, CBMC, GAPPA, *([HARNESS] if modelled(one) else [])}, "test": {TEST}}
    if any(way in needed and not kinds & needed[way] for way in one.verification):
        return "open"
    return "told" if "theorem" in one.verification else "good"


def states(
    known: Mapping[str, Requirement], verdicts: Verdicts, below: Mapping[str, list[Requirement]]
) -> dict[str, str]:
    """How each requirement stands; a high-level one as the worst below it and of its own tests."""
    found = {uid: state_of(one, verdicts.of(one)) for uid, one in known.items() if not one.high}
    for uid, one in known.items():
        if one.high:
            own = ["good" if verdict.good else "bad" for verdict in verdicts.of(one)]
            own += ["open" for name in one.listed_tests if not verdicts.listed(name)]
            own += [found[low.uid] for low in below[uid]]
            found[uid] = next((state for state in ("bad", "open") if state in own), "good")
            found[uid] = found[uid] if own else "open"
    return found


def problems(known: Mapping[str, Requirement], verdicts: Verdicts) -> Iterator[str]:
    """Every verdict that is not good, and every verification that has none, by requirement."""
    for uid, one in known.items():
        own = verdicts.of(one)
        for verdict in own:
            if not verdict.good:
                kind, _, name = verdict.key.partition(":")
                yield f"{uid}: {kind} {name}: {verdict.said}"
        missing = [name for name in one.listed_tests if not verdicts.listed(name)]
        for name in missing:
            yield f"{uid}: TESTS lists {name}, of which no report has a verdict"
        if not one.high and not missing and state_of(one, own) == "open":
            yield f"{uid}: VERIFICATION says {', '.join(one.verification)}, and no report has one"
