# SPDX-License-Identifier: Apache-2.0
"""What the analyser prints and draws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from rich.console import Console

from keel.base.plotting import BLUE, RED, grid_along, new_figure, write_svg
from keel.timing.analysis import Analysis, ChainRow, ClassLoad
from keel.timing.isolation import UNPROMOTED, WHATEVER, Isolation
from keel.timing.output import Cell, table

PUBLISHED_LABELS = {
    "realtime_utilisation": "U_FCFS, eq. 10",
    "other_utilisation": "U_EDF, eq. 12",
    "total_utilisation": "total",
}

NOTE_BOUNDS = (
    "Eq. 8, its hyperbolic form and eq. 11 assume preemption, which Keel does not have: they are\n"
    "shown as the paper's, not as sufficient here."
)
NOTE_PUBLISHED = (
    "The printed figures do not follow from the table: C / T of its rows adds up to the computed "
    "ones (eq. 10's own\nsentence even names the EDF tasks, for which eq. 12 stands).\n"
)
NOTE_REALTIME = (
    "Textbook: non-preemptive fixed priorities in queue order, the scheduler free of cost. Keel: "
    "its FCFS pass serves each\ntask once in turn, so all share one bound, with passes, dispatches "
    "and (promotion) one promoted task in it. A task\nthat falls due just after the pass has "
    "looked at it waits for all the others: no order of priorities describes that.\n"
)
NOTE_ISOLATION = (
    "From the release to the start, by the theorems of specs/soundness.md. ISO-001, as long as "
    "nothing is promoted: the other\nreal-time budgets and the guard. ISO-002, whatever is "
    "promoted: the guard twice and the longest other budget more, and\nits own where that exceeds "
    "its period. Budgets are the declared ones.\n"
)
NOTE_CHAINS = (
    "Eq. 5 to 7 are no bounds: they take each task to respond at once and to use the sample that "
    "arrives, and tasks do\nexceed them. Safe are the sum of T + R and, with phases that keep all "
    "tasks apart, what following each sample gives:\nfrom an event that just misses its sample to "
    "the end of the run that acts on it, which is also how old a value gets\nuntil it is replaced. "
    "Eq. 7 is defined for two tasks; each further one is taken to add its producer's period and "
    "its\nown budget.\n"
)


def load_row(load: ClassLoad) -> list[Cell]:
    """A row of the table of utilisations."""
    return [
        load.name,
        load.tasks,
        load.utilisation,
        f"{load.liu_layland:.4f} {'yes' if load.utilisation <= load.liu_layland else 'NO'}",
        f"{load.hyperbolic:.4f} {'yes' if load.hyperbolic <= 2.0 else 'NO'}",
        "yes" if load.utilisation <= 1.0 else "NO",
    ]


def print_utilisation(analysis: Analysis, out: Console) -> None:
    """Utilisation by class, against eq. 8 and 11, and beside what was printed."""
    rows = [load_row(load) for load in analysis.classes]
    rows += [load_row(load) for load in (analysis.realtime, analysis.others, analysis.total)]
    columns = [
        "class",
        "tasks",
        "U",
        "U <= Liu-Layland (eq. 8)",
        "hyperbolic <= 2",
        "U <= 1 (eq. 11)",
    ]
    out.print(table("Utilisation", columns, rows))
    out.print(NOTE_BOUNDS)
    out.print(f"Total {100.0 * analysis.total.utilisation:.2f} %: {analysis.load_zone}.\n")
    if analysis.published:
        computed = [analysis.realtime, analysis.others, analysis.total]
        rows = [
            [label, float(analysis.published[key] or 0.0), load.utilisation]
            for (key, label), load in zip(PUBLISHED_LABELS.items(), computed, strict=True)
        ]
        out.print(
            table("Printed in the paper, and from its own table", ["", "printed", "computed"], rows)
        )
        if any(abs(float(str(row[1])) - float(str(row[2]))) > 0.011 for row in rows):
            out.print(NOTE_PUBLISHED)


def print_realtime(analysis: Analysis, out: Console) -> None:
    """Real-time response times and Jeffay's condition."""
    rows: list[list[Cell]] = [
        [
            row.label,
            row.name,
            row.period,
            row.budget,
            row.unguarded,
            row.guarded,
            row.bound,
            row.bound_promotion,
            row.bound_apart,
        ]
        for row in analysis.realtime_rows
    ]
    columns = [
        "",
        "real-time task",
        "T = D",
        "C",
        "textbook, no guard",
        "textbook, guard",
        "Keel, guard",
        "Keel, promotion",
        "with these phases",
    ]
    out.print(table("Worst response times, us", columns, rows, 2))
    out.print(NOTE_REALTIME)
    why = analysis.isolation.unpromoted
    text = f"cannot happen: {why}" if why else "cannot be excluded: its column counts"
    out.print(f"Promotion {text}.\n")
    found = analysis.jeffay
    verdict = (
        "holds" if found.holds else ("fails" if found.decided else "too many points to decide")
    )
    where = (
        ""
        if found.slack is None
        else (
            f", least slack {found.slack} us at L = {found.interval} us, blocked by {found.blocker}"
        )
    )
    out.print(f"Jeffay's condition for non-preemptive EDF over all tasks: {verdict}{where}.\n")


def print_isolation(analysis: Analysis, out: Console) -> None:
    """How late real-time tasks start, by the theorem that holds."""
    isolation = analysis.isolation
    if not isolation.starts:
        return
    rows: list[list[Cell]] = [
        [
            row.label,
            row.name,
            row.period,
            row.unpromoted,
            row.whatever,
            "may be" if row.skipping else "none",
            row.bound,
        ]
        for row in isolation.starts
    ]
    columns = ["", "real-time task", "T", UNPROMOTED, WHATEVER, "skipped by it", "holds"]
    out.print(table("Latest starts, us from the release", columns, rows, 2))
    out.print(NOTE_ISOLATION)
    out.print(f"{isolation_verdict(isolation)}.\n")


def isolation_verdict(isolation: Isolation) -> str:
    """Which theorem holds, and why."""
    if isolation.theorem is None:
        return f"No isolation theorem holds: {isolation.reason}"
    latest = max((row.bound or 0 for row in isolation.starts), default=0)
    return (
        f"Isolation: {isolation.theorem} holds, a start at most {latest} us after its release: "
        f"{isolation.reason}"
    )


def print_others(analysis: Analysis, out: Console) -> None:
    """The other tasks: gaps, bounds, promotion."""
    rows: list[list[Cell]] = [
        [
            row.label,
            row.name,
            row.class_name,
            row.period,
            row.budget,
            row.fits,
            row.bound,
            row.bound_apart,
            row.promotion_wait,
            row.promoted_bound,
        ]
        for row in analysis.other_rows
    ]
    columns = [
        "",
        "task",
        "class",
        "T = D",
        "C",
        "gaps it fits",
        "response <=",
        "with these phases",
        "promoted after",
        "then done by",
    ]
    out.print(table("Tasks that are not real-time, us from the release", columns, rows, 3))
    if analysis.gaps.shortest is not None:
        out.print(
            "Gaps between real-time tasks that take their declared budgets, with the phases of the "
            f"set: {analysis.gaps.shortest} to {analysis.gaps.longest} us; admission looks at one "
            f"task at a time: {analysis.gaps.admission} us."
        )
    elif analysis.realtime_rows:
        out.print("Real-time tasks have too many releases in a common period to look at every gap.")
    out.print(f"Hyperperiod: {analysis.hyperperiod} us.\n")


def print_collisions(analysis: Analysis, out: Console) -> None:
    """Whether the phases keep tasks apart."""
    if not analysis.collisions:
        out.print(
            "With these phases no two tasks ever want the processor at the same time, so none\n"
            "waits for another: the responses under 'with these phases' count. They rest on every "
            "phase\nand budget; the other columns do not rest on the phases of tasks that are not "
            "real-time.\n"
        )
        return
    realtime = {row.label for row in analysis.realtime_rows}
    pairs = [f"{one} and {two}" for one, two in analysis.collisions if {one, two} <= realtime]
    out.print(
        f"{len(analysis.collisions)} pairs of tasks may want the processor at the same time, of "
        f"real-time tasks: {', '.join(pairs) or 'none'}.\n`make analyze ARGS=--phases` looks for "
        "phases with which none do.\n"
    )


def chain_verdict(row: ChainRow) -> str:
    """How a path stands against its limits."""
    if row.within:
        return "within"
    return "exceeded (advice)" if row.advisory else "EXCEEDED"


def print_chains(analysis: Analysis, out: Console) -> None:
    """Reaction and freshness."""
    if not analysis.chains:
        return
    rows: list[list[Cell]] = [
        [
            row.name,
            " ".join(row.path),
            row.reaction,
            row.reaction_limit,
            row.freshness,
            row.freshness_limit,
            chain_verdict(row),
            row.conventional,
            row.followed,
            "safe" if row.safe_within else "NOT safe",
        ]
        for row in analysis.chains
    ]
    columns = [
        "path",
        "tasks",
        "E (eq. 5, 6)",
        "limit",
        "F (eq. 7)",
        "limit",
        "",
        "T + R",
        "with phases",
        "both limits",
    ]
    out.print(table("Paths from sensor to actuator, us", columns, rows, 2))
    out.print(NOTE_CHAINS)


def print_analysis(analysis: Analysis, out: Console) -> None:
    """All tables, and the verdict."""
    print_utilisation(analysis, out)
    print_realtime(analysis, out)
    print_isolation(analysis, out)
    print_others(analysis, out)
    print_collisions(analysis, out)
    print_chains(analysis, out)


def paths_verdict(chains: Sequence[ChainRow]) -> str:
    """What is known of the judged paths when all keep their limits by eq. 5 to 7."""
    unsafe = [row.name for row in chains if not row.safe_within]
    if not chains:
        return "no path is judged"
    if not unsafe:
        return f"{len(chains)} judged paths keep their limits, by eq. 5 to 7 and by a safe bound"
    return (
        f"{len(chains)} judged paths keep their limits by eq. 5 to 7, which are no bounds; by a "
        f"safe bound {len(unsafe)} do NOT: {'; '.join(unsafe)}"
    )


def verdict(analysis: Analysis) -> str:
    """The last line."""
    if analysis.schedulable:
        judged = [row for row in analysis.chains if not row.advisory]
        return (
            f"{analysis.name}: schedulable: every task meets its deadline; {paths_verdict(judged)}."
        )
    more = len(analysis.reasons) - 1
    rest = f" ({more} more)" if more else ""
    return f"{analysis.name}: {analysis.standing}: {analysis.reasons[0]}{rest}"


# --- Plots ---------------------------------------------------------------------------------------


def plot_utilisation(analysis: Analysis, path: Path) -> None:
    """Utilisation by class, with the bounds of eq. 8 and section IV-C."""
    figure = new_figure(8.0, 3.2)
    axes = figure.add_subplot()
    left = 0.0
    for load in analysis.classes:
        axes.barh(["utilisation"], [load.utilisation], left=left, label=load.name)
        left += load.utilisation
    for value, label in (
        (0.40, "target"),
        (0.65, "alarm"),
        (analysis.total.liu_layland, "eq. 8"),
        (1.0, "eq. 11"),
    ):
        axes.axvline(value, color="black", linewidth=0.8, linestyle="--")
        axes.text(value, 0.55, label, rotation=90, ha="right", va="bottom", fontsize=8)
    axes.set(
        xlim=(0.0, max(1.05, 1.05 * left)),
        ylim=(-0.5, 1.0),
        xlabel="C / T, summed by class",
        title=f"{analysis.name}: utilisation {left:.4f}",
    )
    axes.set_yticks([])
    grid_along(axes, "x")
    figure.legend(loc="outside lower center", ncols=5, fontsize=8)
    write_svg(path, figure)


def bars(analysis: Analysis) -> Iterator[tuple[str, int | None, int]]:
    """Every task's name, bound and deadline."""
    for realtime in analysis.realtime_rows:
        yield f"{realtime.label} {realtime.name}", realtime.response, realtime.period
    for other in analysis.other_rows:
        yield f"{other.label} {other.name}", other.response or other.promoted_bound, other.period


def plot_responses(analysis: Analysis, path: Path) -> None:
    """Response times against deadlines, on a logarithmic scale."""
    rows = list(bars(analysis))
    figure = new_figure(8.0, 1.2 + 0.24 * len(rows))
    axes = figure.add_subplot()
    places = range(len(rows))
    late = [bound is None or bound > deadline for _, bound, deadline in rows]
    axes.barh(
        places,
        [bound or deadline for _, bound, deadline in rows],
        color=[RED if wrong else BLUE for wrong in late],
    )
    axes.scatter(
        [deadline for _, _, deadline in rows],
        places,
        marker="|",
        s=80,
        color="black",
        label="deadline",
    )
    axes.set_yticks(places, [name for name, _, _ in rows], fontsize=8)
    axes.invert_yaxis()
    axes.set(
        xscale="log",
        xlabel="time from the release, us",
        title=f"{analysis.name}: bound of the response time",
    )
    grid_along(axes, "x")
    figure.legend(loc="outside lower right")
    write_svg(path, figure)
