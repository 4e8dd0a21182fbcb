# SPDX-License-Identifier: Apache-2.0
"""What was found without running the code: MISRA C, undefined behaviour by abstract interpretation,
writes against contracts, the depth of every stack, and what passes and steps cost, from the reports
of make lint, eva, stack and bench.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from keel.analyse.eva import UNKNOWN
from keel.boards.board import board_names
from keel.gather.part import Context, Item, Part, Table

TEXT = """\
MISRA C:2012 is checked by Cppcheck and its addon over the kernel, the headers it includes and the \
drivers that also run on simulated hardware. A finding stands unless a numbered deviation covers \
it; a deviation that covers nothing is a finding itself. Code for a target alone is not checked.

Eva, the abstract interpretation of Frama-C, follows the demo from its start without any contract, \
and looks for undefined behaviour: another method than that of the proofs, over one application. \
From, upon Eva, computes a superset of what each public function writes, and compares it with what \
its contract names. Both over-approximate: what they call good is good in the contexts that were \
analysed, what they cannot tell is told here. They share the front end of Frama-C with the proofs.

The bound of a stack is the deepest path of the compiler's own call graph and frames, with a table \
of what may be called through a pointer; recursion, a frame without a bound and a function that no \
path reaches are errors. To it comes the frame that the core stacks for an exception.

Costs are instructions, counted on an emulated Cortex-M7. They are no times: the emulator knows \
neither pipeline nor caches, so they bound nothing on hardware. They show that a change did not \
make the code slower unnoticed."""

Report = Mapping[str, Any]


# --- MISRA C -------------------------------------------------------------------------------------


def lint_problems(lint: Report) -> Iterator[str]:
    """Every finding that no deviation covers."""
    for one in lint["findings"]:
        yield f"{one['file']}:{one['line']}: {one['rule']}: {one['reason']}"


def deviation_item(one: Report) -> Item:
    """A deviation from MISRA C."""
    return Item(
        kind="deviation",
        id=one["id"],
        title=f"MISRA C:2012 {one['rule']}",
        text=one["reason"],
        facts={
            "rule": one["rule"],
            "declared": f"specs/misra_deviations.toml:{one['declared']}",
            "where": ", ".join(one["where"]),
            "only lines that match": one["line"] or "any",
            "findings that it allows": str(sum(one["allows"].values())),
        },
    )


def deviation_table(lint: Report) -> Table:
    """The deviations, and what each allows."""
    rows = tuple(
        (f"deviation:{one['id']}", one["rule"], file, str(count))
        for one in lint["deviations"]
        for file, count in one["allows"].items()
    )
    without = ", ".join(lint["rules_without_checker"])
    return Table(
        title="MISRA C:2012: findings that a deviation allows",
        columns=("deviation", "rule or check", "file", "findings"),
        rows=rows,
        note=f"The checker has nothing for the rules {without}, and does not look for the "
        "directives, which are not decidable; the amendments' chapters are not checked.",
    )


# --- Abstract interpretation ---------------------------------------------------------------------


def eva_tables(eva: Report) -> Iterator[Table]:
    """What was found, how far it reached, and what may be written."""
    rows = [
        (f"{one['file']} {one['function']}", "alarm", one["text"], one["reason"])
        for one in eva["explained"]["alarm"]
    ] + [(one["function"], "writes", "", one["reason"]) for one in eva["explained"]["writes"]]
    yield Table(
        title="Abstract interpretation: what is explained",
        columns=("where", "kind", "what", "reason"),
        rows=tuple(rows),
        note="Unsigned overflow is no undefined behaviour and not looked for here; the "
        "proofs exclude it where it is not meant.",
    )
    yield Table(
        title="Statements of the demo and the kernel that Eva reached",
        columns=("function", "reached", "of"),
        rows=tuple((name, str(reached), str(of)) for name, (reached, of) in eva["reach"].items()),
        note="An inline function has a number for each file that uses it. Functions that the demo "
        "does not call are not analysed; what was not reached cannot be reached from the "
        "demo's start, such as the refusals of a wrong configuration.",
    )
    yield Table(
        title="What is written, against what the contract names",
        columns=("function", "verdict", "context", "reached of it"),
        rows=tuple(
            (one["function"], one["verdict"], one["run"], f"{100 * one['reached']:.0f} %")
            for one in eva["assigns"]
        ),
        note="Alone: called once, with objects that hold anything; what is not reached there was "
        "not compared. As far as arrays: the clause names an element by an index that is not "
        "known there, and the array is compared. WP proves every clause for all contexts.",
    )


# --- Stacks --------------------------------------------------------------------------------------


def short_path(path: list[str]) -> str:
    """The functions of a path, without their files."""
    return " > ".join(name.rpartition(":")[2] for name in path)


def stack_problems(board: str, report: Report) -> Iterator[str]:
    """Stacks without room, and bounds that a run has refuted."""
    for name, stack in report["stacks"].items():
        if stack["bound"] > stack["size"]:
            yield (
                f"{board}: the stack {name} needs up to {stack['bound']} bytes, and has "
                f"{stack['size']}"
            )
    deepest = report["painted"]
    main = report["stacks"]["main"]["bound"] - report["exception_frame_bytes"]
    if deepest is not None and deepest > main:
        yield (
            f"{board}: the painted stack was {deepest} bytes deep, deeper than the bound of "
            f"{main}: the bound is wrong"
        )


def stack_rows(board: str, report: Report) -> Iterator[tuple[str, ...]]:
    """The stacks of a board, and its tasks."""
    painted = "did not run" if report["painted"] is None else str(report["painted"])
    for name, stack in report["stacks"].items():
        yield (
            board,
            f"stack {name}",
            str(stack["bound"]),
            str(stack["size"]),
            painted if name == "main" else "",
            short_path(stack["path"]),
        )
    for name, task in report["tasks"].items():
        yield board, f"task {name}", str(task["bound"]), "", "", short_path(task["path"])


def stack_table(reports: Mapping[str, Report]) -> Table:
    """All boards."""
    return Table(
        title="Worst-case stack, in bytes",
        columns=("board", "of", "bound", "room", "painted", "deepest path"),
        rows=tuple(row for board, report in reports.items() for row in stack_rows(board, report)),
        note="People write down the targets of calls through pointers (specs/stack.toml), where a "
        "target that is missing shows as a function that nobody calls. Painted: how deep the "
        "stack was when this very image ran on the emulated board; the bounds of boards that "
        "no emulator runs are compared with nothing.",
    )


# --- Costs ---------------------------------------------------------------------------------------


def cost_problems(bench: Report) -> Iterator[str]:
    """What is above its budget."""
    if "cortex_m7" not in bench:
        yield "build/bench/report.json: has no figures of the Cortex-M7"
        return
    for one in bench["cortex_m7"]["over_budget"]:
        yield f"over the budget of bench/budget.toml: {one}"


def cost_table(figures: Mapping[str, Report]) -> Table:
    """Instructions on the Cortex-M7."""
    return Table(
        title="Instructions on the emulated Cortex-M7",
        columns=("what", "runs", "mean", "longest", "budget of the mean", "goal", "goal met"),
        rows=tuple(
            (
                name,
                str(one["passes"]),
                f"{one['mean']:.1f}",
                str(one["longest"]),
                f"{one['budget']:.1f}",
                str(one["goal"] or "none"),
                "" if not one["goal"] else "yes" if one["mean"] <= one["goal"] else "no",
            )
            for name, one in figures.items()
        ),
        note="A budget is what was measured when it was last accepted, and fails the build when it "
        "is exceeded; a goal is what the project wishes for. The longest is of the runs that "
        "were measured, no worst case.",
    )


# --- All of it -----------------------------------------------------------------------------------


def read_stacks(context: Context, problems: list[str]) -> dict[str, Report]:
    """The report on each board's stacks, those that serve."""
    names = board_names(context.root)
    found = {name: context.report(f"stack/{name}.json", problems) for name in names}
    return {name: report for name, report in found.items() if report}


def make(context: Context) -> Part:
    """The part."""
    problems: list[str] = []
    lint = context.report("lint/report.json", problems)
    eva = context.report("eva/report.json", problems)
    stacks = read_stacks(context, problems)
    bench = context.report("bench/report.json", problems)
    summary: dict[str, str] = {}
    tables: list[Table] = []
    items: list[Item] = []
    files: dict[str, Path] = {}
    if lint:
        problems += lint_problems(lint)
        items += map(deviation_item, lint["deviations"])
        tables.append(deviation_table(lint))
        files["misra.sarif"] = context.build / "lint/results.sarif"
        summary["MISRA C findings without a deviation"] = str(len(lint["findings"]))
        summary["MISRA C deviations"] = str(len(lint["deviations"]))
        summary["files checked for MISRA C"] = str(len(lint["files"]))
    if eva:
        problems += eva["problems"]
        tables += eva_tables(eva)
        summary["alarms of Eva"] = str(len(eva["alarms"]))
        summary["functions that Eva analysed from the demo's start"] = (
            f"{eva['analyzed']} of {eva['functions']}"
        )
        within = sum(one["verdict"] != UNKNOWN for one in eva["assigns"])
        summary["contracts that name all that is written"] = f"{within} of {len(eva['assigns'])}"
    if stacks:
        problems += [line for name, one in stacks.items() for line in stack_problems(name, one)]
        tables.append(stack_table(stacks))
        summary["boards whose stacks are bounded"] = ", ".join(stacks)
    if bench:
        problems += cost_problems(bench)
        figures = bench.get("cortex_m7", {}).get("figures", {})
        tables.append(cost_table(figures))
        summary["costs within their budgets"] = (
            f"{len(figures) - len(bench.get('cortex_m7', {}).get('over_budget', ()))} of "
            f"{len(figures)}"
        )
    return Part(
        name="static",
        title="Static analysis",
        summary=summary,
        text=TEXT,
        tables=tuple(tables),
        items=tuple(items),
        files=files,
        problems=tuple(problems),
    )
