# SPDX-License-Identifier: Apache-2.0
"""What hangs together: requirement, clause, function, goal, harness and test, both ways."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path, PurePosixPath
from typing import Any

from keel.base.errors import ToolError
from keel.gather.part import Context, Item, Part, State, Table
from keel.gather.traced import Traced, read
from keel.trace import lobster
from keel.trace.functions import Function
from keel.trace.packages import packages
from keel.trace.requirements import Requirement
from keel.trace.verdicts import CBMC, GAPPA, HARNESS, TEST, WP, Verdict

TEXT = """\
Every requirement is followed down to the clauses that state it, the functions whose contracts \
have them, the goals and assertions that prove them, the harnesses and the tests; every clause, \
function, harness, model and test that bears an id is followed up. One without a counterpart in \
either direction is a problem, and no package is made.

A function that a header offers traces to the requirements whose ids the clauses of its contract \
bear. A static function has no requirement of its own: it traces by its callers, to all that they \
trace to. The trace does not show whether a clause says what its sentence says: that is for a \
review."""


def unit_of(path: str) -> str:
    """The unit that a file belongs to."""
    return PurePosixPath(path).stem


def how_many(verdicts: Iterable[Verdict], by: str) -> str:
    """How many verdicts of a kind there are, and how many are not good."""
    own = [one for one in verdicts if one.by == by]
    bad = sum(not one.good for one in own)
    return (f"{len(own)}, {bad} bad" if bad else str(len(own))) if own else ""


def function_item(one: Function, traced: Traced) -> Item:
    """A function with what it traces to, and what speaks of it."""
    own = [] if one.helper else traced.verdicts.by_function.get(one.name, [])
    state: State = "good" if one.requirements else "bad"
    if any(not verdict.good for verdict in own):
        state = "bad"
    facts = {
        "file": f"{one.file}:{one.line}",
        "unit": unit_of(one.file),
        "traces": "by its callers" if one.helper else "by the clauses of its contract",
    }
    above = one.callers if one.helper else ()
    tests = [
        verdict.key
        for uid in one.requirements
        if not one.helper
        for verdict in traced.verdicts.by_uid.get(uid, ())
        if verdict.by == TEST
    ]
    links = [f"requirement:{uid}" for uid in one.requirements]
    links += [f"function:{name}" for name in above]
    links += [verdict.key for verdict in own] + tests
    return Item(
        kind="function",
        id=one.name,
        title=one.name,
        state=state,
        facts=facts,
        links=tuple(dict.fromkeys(links)),
    )


def units_table(traced: Traced) -> Table:
    """Units by kind of evidence."""
    units = sorted({unit_of(one.file) for one in traced.trace.functions})
    rows = []
    for unit in units:
        functions = [one for one in traced.trace.functions if unit_of(one.file) == unit]
        documents = [one for one in traced.trace.requirements.values() if one.document == unit]
        own = [one for one in traced.verdicts.every if one.unit == unit]
        rows.append(
            (
                unit,
                str(len(documents)),
                str(sum(not one.helper for one in functions)),
                str(sum(one.helper for one in functions)),
                *(how_many(own, by) for by in (WP, CBMC, GAPPA, HARNESS, TEST)),
            )
        )
    return Table(
        title="Units by kind of evidence",
        columns=(
            "unit",
            "low-level requirements",
            "functions offered",
            "static functions",
            "WP goals",
            "CBMC assertions",
            "Gappa bounds",
            "harnesses",
            "tests",
        ),
        rows=tuple(rows),
        note="CBMC's built-in checks are counted with each harness, not here. Tests are those of"
        " suites that bear the unit's name.",
    )


def requirement_row(one: Requirement, traced: Traced) -> tuple[str, ...]:
    """A requirement with all that states, proves and tests it."""
    own = traced.verdicts.of(one)
    bearing = traced.verdicts.bearing(one.uid)
    return (
        f"requirement:{one.uid}",
        " ".join(f"requirement:{uid}" for uid in one.parents) or "derived",
        " ".join(dict.fromkeys(one.clauses)),
        " ".join(f"function:{function.name}" for function in bearing),
        how_many(own, WP),
        how_many(own, CBMC),
        how_many(own, GAPPA),
        " ".join(verdict.key for verdict in own if verdict.by == HARNESS),
        how_many(own, TEST),
        traced.state[one.uid],
    )


def requirements_table(traced: Traced) -> Table:
    """Low-level requirements by kind of evidence."""
    low = [one for one in traced.trace.requirements.values() if not one.high]
    return Table(
        title="Low-level requirements by kind of evidence",
        columns=(
            "requirement",
            "parents",
            "clauses",
            "functions",
            "WP goals",
            "CBMC assertions",
            "Gappa bounds",
            "harnesses",
            "tests",
            "state",
        ),
        rows=tuple(requirement_row(one, traced) for one in low),
        note="Goals and assertions are those that bear the requirement's id; harnesses those with"
        " such an assertion, or of a function that bears it. Requirements of boards are"
        " tested; the functions of bsp are not traced one by one.",
    )


def unstated(traced: Traced, report: dict[str, Any]) -> tuple[Table, list[str]]:
    """The clauses that no goal bears: left to CBMC, with the reason, or else by mistake."""
    left = {
        function: why
        for unit in report.get("units", {}).values()
        for function, why in unit["wp"]["not_by_wp"].items()
    }
    rows, problems = [], []
    for uid, one in traced.trace.requirements.items():
        for label in dict.fromkeys(one.clauses):
            if not report or traced.verdicts.states_clause(one, label):
                continue
            names = [function.name for function in traced.verdicts.bearing(uid)]
            reasons = [f"{name}: {left[name]}" for name in names if name in left]
            if not reasons:
                problems.append(f"{uid}: no goal and no assertion bears the clause {label}")
            rows.append((f"requirement:{uid}", label, "; ".join(reasons)))
    table = Table(
        title="Clauses that bear no goal of their own",
        columns=("requirement", "clause", "why not"),
        rows=tuple(rows),
        note="Of these functions CBMC proves that they do what their models do, in every field."
        " That the models keep these clauses is for a review.",
    )
    return table, problems


def alone(traced: Traced) -> list[str]:
    """What stands alone in the tree, or has the name of something else."""
    names = Counter(one.name for one in traced.trace.functions)
    twice = [
        f"{name}: {count} functions have this name, which the package cannot tell apart"
        for name, count in names.items()
        if count > 1
    ]
    return sorted({*traced.trace.orphans, *twice})


def without_harness(traced: Traced, report: dict[str, Any]) -> list[str]:
    """Functions of which no harness has a verdict, but for those that units.toml excepts."""
    excepted = {
        name
        for unit in report.get("units", {}).values()
        for name in unit["cbmc"]["without_harness"]
    }
    proved = {one.function for one in traced.verdicts.every if one.by == HARNESS}
    return [
        f"function {one.name}: build/prove/report.json has no harness of it"
        for one in traced.trace.functions
        if report and not one.helper and one.name not in proved | excepted
    ]


def second_look(context: Context, traced: Traced, problems: list[str]) -> dict[str, Path]:
    """What LOBSTER finds, and its report. Without the reports on proofs it would find all alone."""
    levels = lobster.items(traced.trace.requirements, traced.trace.functions, traced.verdicts)
    try:
        found = lobster.gate(context.work, packages(), levels)
    except ToolError as error:
        problems.append(str(error).splitlines()[0])
        return {}
    problems += [] if problems else found
    return {name: context.work / name for name in (lobster.PAGE, lobster.REPORT)}


def make(context: Context) -> Part:
    """The part."""
    trouble: list[str] = []
    traced = read(context, trouble)
    trace = traced.trace
    files = second_look(context, traced, trouble)
    trouble += alone(traced)
    proofs = context.report("prove/report.json", [])
    open_clauses, unnamed = unstated(traced, proofs)
    trouble += [*without_harness(traced, proofs), *unnamed]
    counts = Counter(verdict.by for verdict in traced.verdicts.every if verdict.uids)
    return Part(
        name="trace",
        title="Traceability",
        text=TEXT,
        summary={
            "requirements": str(len(trace.requirements)),
            "functions": str(len(trace.functions)),
            "clauses": str(trace.clauses),
            "orphans": str(len(trace.orphans)),
            **{
                f"with a requirement's id: {by}": str(count) for by, count in sorted(counts.items())
            },
        },
        tables=(units_table(traced), requirements_table(traced), open_clauses),
        items=tuple({one.name: function_item(one, traced) for one in trace.functions}.values()),
        files=files,
        problems=tuple(trouble),
    )
