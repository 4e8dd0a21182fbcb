# SPDX-License-Identifier: Apache-2.0
"""A schedule as a table: a row for each task, with how late its runs started."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from rich.markup import escape
from rich.table import Table

from keel.timeline.runs import Schedule

# Edges of the lateness, in us: a run counts where it lies from one up to below the next.
EDGES = (0, 10, 30, 100, 300, 1000, 3000)


@dataclass(frozen=True)
class Row:
    """What became of a task. Times are in us, the load in percent."""

    name: str
    period_us: int
    runs: int
    mean_us: float
    longest_us: int
    budget_us: int
    load: float
    latest_us: int
    late: tuple[int, ...]  # Runs by EDGES; the last is what is later than all of them.
    overruns: int
    promotions: int
    skipped: int
    missed: int


def rows_of(schedule: Schedule) -> list[Row]:
    """Every task that ran. The load is over the time from the first run to the end of the last."""
    every = schedule.runs
    span_us = max(int(every["end"][-1] - every["start"][0]), 1)
    rows = []
    for number, task in enumerate(schedule.tasks):
        own = schedule.of(number)
        if not len(own):
            continue
        lengths, late = own["end"] - own["start"], own["start"] - own["release"]
        counts, _ = np.histogram(late, [*EDGES, np.inf])
        rows.append(
            Row(
                task.name,
                task.period_us,
                len(own),
                float(lengths.mean()),
                int(lengths.max()),
                task.budget_us,
                100.0 * float(lengths.sum()) / span_us,
                int(late.max()),
                tuple(int(count) for count in counts),
                int((lengths > task.budget_us).sum()),
                int(own["promoted"].sum()),
                int(own["skipped"].sum()),
                int((own["end"] > own["deadline"]).sum()),
            )
        )
    return rows


HEADINGS = (
    "task",
    "T, ms",
    "runs",
    "mean",
    "longest",
    "budget",
    "load, %",
    "latest",
    *(f"< {high}" for high in EDGES[1:]),
    "more",
    "over",
    "promoted",
    "skipped",
    "missed",
)


def table(schedule: Schedule) -> Table:
    """For people."""
    found = Table(
        title="Times in us; from latest to over: runs by how late they started",
        title_justify="left",
        box=None,
        padding=(0, 1, 0, 0),
    )
    for heading in HEADINGS:
        found.add_column(heading, justify="left" if heading == "task" else "right", no_wrap=True)
    for row in rows_of(schedule):
        cells = [
            f"{row.period_us / 1000:g}",
            row.runs,
            f"{row.mean_us:.1f}",
            row.longest_us,
            row.budget_us,
            f"{row.load:.2f}",
            row.latest_us,
            *row.late,
            row.overruns,
            row.promotions,
            row.skipped,
            row.missed,
        ]
        found.add_row(escape(row.name), *(str(cell) for cell in cells))
    return found
