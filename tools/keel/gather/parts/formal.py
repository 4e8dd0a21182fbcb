# SPDX-License-Identifier: Apache-2.0
"""What is proved, by whom, within what bounds, and under which assumptions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from keel.base.errors import ToolError
from keel.base.files import read_text
from keel.gather.formal import bounds, goals, ledger, opinion, reviews, theorems
from keel.gather.part import Context, Item, Part, Table

Report = Mapping[str, Any]
Read = TypeVar("Read")

TEXT = """\
Each goal, assertion and bound of the last make prove is here, with its verdict and who found it. \
Verdicts are taken from the goals, never from an exit status; a goal that has vanished since the \
list of goals was reviewed is a failure of make prove. CBMC's built-in checks (overflow, bounds, \
pointers, NaN, conversions, unwinding) are counted with each harness.

WP proves for all inputs; it takes a callee's contract for granted where it calls it, which is \
proved where the callee is. It assumes that what is separate by a contract is separate, and that \
memory is read by the type by which it was written. Smoke tests look for preconditions that cannot \
hold and for code that cannot be reached; they are best effort. CBMC proves bit by bit, within the \
bounds of each harness; the table of harnesses says what these leave out, and what covers that.

The soundness case follows as the repository has it; its tables stand below.

"""


def smoke_table(report: Report) -> Table:
    """What WP was asked besides: can this be reached at all? And what it was told to accept."""
    rows = []
    for name, unit in report.get("units", {}).items():
        failed = [text for text in unit["problems"] if text.startswith("smoke test")]
        accepted = [f"{text}: {why}" for text, why in unit["wp"]["accepted_warnings"].items()]
        rows.append(
            (
                f"unit:{name}",
                str(unit["wp"]["smoke_tests"]),
                str(len(failed)),
                str(len(unit["wp"]["not_by_wp"])),
                str(len(unit["wp"]["by_cbmc"])),
                "; ".join(accepted),
            )
        )
    return Table(
        title="Smoke tests, and what WP leaves",
        columns=(
            "unit",
            "smoke tests",
            "failed",
            "functions whose postconditions CBMC proves",
            "clauses that CBMC proves",
            "warnings accepted, with the reason",
        ),
        rows=tuple(rows),
        note="A smoke test that passes does not show that there is no contradiction; one that fails"
        " shows a contradiction, or code that nothing reaches.",
    )


def left_table(report: Report) -> Table:
    """What WP does not prove, one by one, with the reason and the harness that does."""
    rows = []
    for name, unit in report.get("units", {}).items():
        wp = unit["wp"]
        rows += [
            (f"unit:{name}", function, "postconditions", "", why)
            for function, why in wp["not_by_wp"].items()
        ]
        for key, why in wp["by_cbmc"].items():
            function, clause, harness = key.split()
            rows.append((f"unit:{name}", function, clause, f"harness:{name}/{harness}", why))
        rows += [
            (f"unit:{name}", function, "everything: it has no body", "", why)
            for function, why in wp["not_proved_here"].items()
        ]
    return Table(
        title="What WP does not prove",
        columns=("unit", "function", "clause", "harness that proves it", "reason"),
        rows=tuple(rows),
    )


def prover_table(items: Sequence[Item]) -> Table:
    """How many goals each prover proved."""
    counts = Counter(
        (item.facts["engine"], item.facts.get("prover", ""))
        for item in items
        if item.state == "good"
    )
    rows = [(engine, prover, str(count)) for (engine, prover), count in sorted(counts.items())]
    return Table(
        title="Goals by prover",
        columns=("engine", "prover", "goals"),
        rows=tuple(rows),
        note="CBMC's are the labels of its assertions, each counted once.",
    )


def determined_table(report: Report) -> Table:
    """What determines the outcome of each public function."""
    rows = [
        (
            f"function:{outcome['function']}",
            outcome["by"],
            "; ".join(f"harness:{name}/{harness}" for harness in outcome["harnesses"]),
            "; ".join(
                dict.fromkeys(text for texts in outcome["harnesses"].values() for text in texts)
            ),
            outcome["reason"],
        )
        for name, unit in report.get("units", {}).items()
        for outcome in unit["determined"]
    ]
    return Table(
        title="What determines the outcome of each function",
        columns=("function", "by", "shown by", "within", "reason"),
        rows=tuple(rows),
        note="equality: result and every field written are proved to be those of the executable"
        " specification (specs/model).",
    )


def summary(
    report: Report, items: Sequence[Item], reviewed: Sequence[reviews.Reviewed]
) -> dict[str, str]:
    """The figures that a reader wants first."""
    units = report.get("units", {}).values()
    checks = sum(unit["cbmc"]["properties"] for unit in units)
    signed = sum(one.state == "good" for one in reviewed)
    engines = Counter(item.facts["engine"] for item in items if item.state == "good")
    asserted = sum(int(item.facts.get("places", 0)) for item in items)
    return {
        "verdict of make prove": str(report.get("verdict", "none")),
        "goals proved": f"{report.get('proved', 0)} of {report.get('goals', 0)}",
        "WP goals proved": str(engines["WP"]),
        "CBMC properties": f"{checks}, of which {asserted} labelled assertions",
        "Gappa bounds proved": str(engines["Gappa"]),
        "smoke tests": str(sum(unit["wp"]["smoke_tests"] for unit in units)),
        "units reviewed by a person": f"{signed} of {len(reviewed)}",
    }


def _kept(problems: list[str], read: Callable[[], list[Read]]) -> list[Read]:
    """What was read; nothing, with the reason among the problems, if it could not be."""
    try:
        return read()
    except ToolError as error:
        problems += str(error).splitlines()
        return []


def make(context: Context) -> Part:
    """The part."""
    problems: list[str] = []
    report = context.report("prove/report.json", problems)
    items = goals.items(report)
    problems += goals.problems(report, items)
    problems += goals.listed_problems(context.root, report) if report else []
    harnesses = _kept(problems, lambda: bounds.read_all(context.root))
    problems += bounds.problems(harnesses, report)
    soundness = read_text(context.root / ledger.FILE)
    assumptions = _kept(problems, lambda: ledger.read_ledger(soundness))
    claims = _kept(problems, lambda: theorems.read_theorems(context.root))
    known = [one.id for one in assumptions]
    problems += theorems.problems(claims, items, known) if report else []
    asked = _kept(problems, lambda: [opinion.read_opinions(context.root)])
    answers = context.report(opinion.REPORT, problems)
    given = {name: why for one in asked for name, why in opinion.reasons(one, harnesses).items()}
    problems += [text for one in asked for text in opinion.problems(answers, one, harnesses, given)]
    reviewed = _kept(problems, lambda: reviews.read_reviews(context.root))
    problems += reviews.problems(reviewed)
    return Part(
        name="formal",
        title="Formal verification",
        summary=summary(report, items, reviewed) | opinion.summary(answers, harnesses),
        text=TEXT + ledger.prose_of(soundness),
        tables=(
            theorems.table(claims, items),
            determined_table(report),
            *(opinion.table(answers, harnesses, given) for _ in asked),
            bounds.table(harnesses, report),
            smoke_table(report),
            left_table(report),
            prover_table(items),
            ledger.ledger_table(assumptions),
            reviews.table(reviewed),
            *ledger.tables(soundness),
        ),
        items=(
            *goals.unit_items(report),
            *bounds.items(harnesses, report),
            *items,
            *(one.item for one in assumptions),
        ),
        files={
            "soundness.md": context.root / ledger.FILE,
            "theorems.toml": context.root / theorems.FILE,
        },
        measured=goals.measured(report),
        problems=tuple(dict.fromkeys(problems)),
    )
