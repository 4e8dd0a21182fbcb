# SPDX-License-Identifier: Apache-2.0
"""The goals of the provers as items: WP's, CBMC's labelled assertions, and Gappa's bounds."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.audit import assertions
from keel.audit.completeness import compare_goals
from keel.c.project import find_units
from keel.gather.part import Item
from keel.judge.goals import read_goals

Report = Mapping[str, Any]

# A requirement's id as the label of a clause, and as it is written everywhere else.
LABEL = re.compile(r"(?<![A-Z])([A-Z]{3,4})_(\d{3})(?!\d)")


def requirements_in(text: str) -> list[str]:
    """The requirements that a name or a description bears."""
    return list(dict.fromkeys(f"{unit}-{number}" for unit, number in LABEL.findall(text)))


def _required(text: str) -> list[str]:
    """The same, as links."""
    return [f"requirement:{one}" for one in requirements_in(text)]


def target_of(goal: Mapping[str, str]) -> tuple[str, str]:
    """The file of theorems that a goal of WP belongs to, if any, and the function, or "lemmas"."""
    theorem, _, function = goal["target"].rpartition(":")
    return theorem, function


def public_functions(unit: Report) -> set[str]:
    """The functions that a unit offers."""
    return {outcome["function"] for outcome in unit["determined"]}


def wp_items(name: str, unit: Report) -> Iterator[Item]:
    """WP's goals."""
    public = public_functions(unit)
    for goal in unit["wp"]["goal_list"]:
        theorem, function = target_of(goal)
        own = [f"function:{function}"] if function in public else [f"unit:{name}"]
        facts = {"engine": "WP", "prover": goal["prover"] or "none", "of": goal["target"]}
        if theorem:
            facts["theorem"] = f"proofs/{name}/{theorem}.c"
        links = [*own, *_required(goal["name"])]
        yield Item(
            kind="goal",
            id=f"{name}/{goal['name']}",
            title=goal["name"],
            state="good" if goal["status"] == "Valid" else "bad",
            facts={**facts, "verdict": goal["status"]},
            links=tuple(links),
        )


def assertions_of(harness: Report) -> dict[str, list[Mapping[str, str]]]:
    """CBMC's labelled assertions; one label may stand at several places."""
    found: dict[str, list[Mapping[str, str]]] = {}
    for assertion in harness["assertions"]:
        found.setdefault(assertion["description"].partition(":")[0], []).append(assertion)
    return found


def cbmc_items(name: str, unit: Report) -> Iterator[Item]:
    """CBMC's labelled assertions. Its built-in checks are counted with their harness."""
    for harness, result in unit["cbmc"]["harnesses"].items():
        for label, places in assertions_of(result).items():
            good = result["sound"] and all(one["status"] == "SUCCESS" for one in places)
            links = [f"harness:{name}/{harness}", *_required(label)]
            yield Item(
                kind="goal",
                id=f"{name}/{harness}/{label}",
                title=f"{harness}: {label}",
                text="\n".join(dict.fromkeys(one["description"] for one in places)),
                state="good" if good else "bad",
                facts={
                    "engine": "CBMC",
                    "places": str(len(places)),
                    "verdict": ", ".join(dict.fromkeys(one["status"] for one in places)),
                },
                links=tuple(links),
            )


def gappa_items(name: str, unit: Report) -> Iterator[Item]:
    """Gappa's bounds of rounding errors."""
    for goal in unit["gappa"]["goal_list"]:
        yield Item(
            kind="goal",
            id=f"{name}/{goal['name']}",
            title=goal["name"],
            state="good" if goal["status"] == "Valid" else "bad",
            facts={
                "engine": "Gappa",
                "verdict": goal["status"],
                "bound": goal["bound"],
                "enclosure found": goal["enclosure"],
            },
            links=(f"unit:{name}", *_required(goal["name"])),
        )


def items(report: Report) -> list[Item]:
    """All goals of all units."""
    found: list[Item] = []
    for name, unit in report.get("units", {}).items():
        found += [*wp_items(name, unit), *cbmc_items(name, unit), *gappa_items(name, unit)]
    return found


def measured(report: Report) -> dict[str, float]:
    """How long each job took: WP on a function, CBMC on a harness, Gappa on a file."""
    return {
        f"{name}/{job}": seconds
        for name, unit in report.get("units", {}).items()
        for job, seconds in unit["seconds"].items()
    }


def problems(report: Report, goals: Sequence[Item]) -> list[str]:
    """Every goal that is not proved, and what the run itself complained about."""
    found = [str(text) for text in report.get("problems", [])]
    if report.get("partial"):
        found.append("build/prove/report.json: speaks of a part of the proofs alone")
    if report and report.get("verdict") != "proved" and not found:
        found.append(f"build/prove/report.json: the verdict is {report.get('verdict')!r}")
    found += [
        f"goal {goal.id}: not proved, {goal.facts['engine']} says {goal.facts['verdict']}"
        for goal in goals
        if goal.state == "bad"
    ]
    return found


def listed_problems(root: Path, report: Report) -> Iterator[str]:
    """A goal, assertion or unit that the repository lists and the report lacks, or has anew."""
    for unit in find_units(root).values():
        if not unit.folder.is_dir():
            continue
        found = report["units"].get(unit.name)
        if not found:
            yield f"unit {unit.name}: build/prove/report.json says nothing of it"
            continue
        shown = str(unit.goal_list.relative_to(root))
        seen = [goal["name"] for goal in found["wp"]["goal_list"]]
        yield from compare_goals(read_goals(unit.goal_list, shown).names, seen, shown)
        yield from assertions.problems(unit, found["cbmc"]["harnesses"])


def unit_items(report: Report) -> Iterator[Item]:
    """Each unit, and each function that it offers, with what was proved of it."""
    for name, unit in report.get("units", {}).items():
        wp, cbmc, gappa = unit["wp"], unit["cbmc"], unit["gappa"]
        yield Item(
            kind="unit",
            id=name,
            title=name,
            facts={
                "WP goals": f"{wp['proved']} of {wp['goals']} proved",
                "smoke tests": str(wp["smoke_tests"]),
                "CBMC properties": f"{cbmc['proved']} of {cbmc['properties']} proved",
                "harnesses": str(len(cbmc["harnesses"])),
                "Gappa bounds": f"{gappa['proved']} of {gappa['goals']} proved",
            },
        )
        yield from _function_items(name, unit)


def _function_items(name: str, unit: Report) -> Iterator[Item]:
    for outcome in unit["determined"]:
        harnesses = outcome["harnesses"]
        facts = {"outcome determined by": outcome["by"]}
        if outcome["function"] in unit["wp"]["not_by_wp"]:
            facts["postconditions by CBMC alone"] = unit["wp"]["not_by_wp"][outcome["function"]]
        yield Item(
            kind="function",
            id=outcome["function"],
            title=outcome["function"],
            facts=facts,
            links=(f"unit:{name}", *(f"harness:{name}/{one}" for one in harnesses)),
        )
