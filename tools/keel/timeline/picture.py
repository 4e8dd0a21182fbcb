# SPDX-License-Identifier: Apache-2.0
"""A part of a schedule as a picture: a row for each task, and the slack below."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from keel.base.errors import ToolError
from keel.base.plotting import BLUE, GREEN, GREY, ORANGE, RED, new_figure, write_svg
from keel.timeline.runs import Schedule, slack

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MS = 1000.0
HEIGHT = 0.7  # Of a run, in rows.


def within(schedule: Schedule, from_us: int, to_us: int) -> Any:
    """The runs that are at least in part between two times."""
    runs = schedule.runs
    found = runs[(runs["start"] < to_us) & (runs["end"] > from_us)]
    if not len(found):
        raise ToolError(f"nothing runs from {from_us} to {to_us} us")
    return found


def draw_tasks(axes: Axes, schedule: Schedule, runs: Any) -> None:
    """Runs as bars, waits as lines, deadlines as strokes."""
    for number, task in enumerate(schedule.tasks):
        own = runs[runs["task"] == number]
        colour = BLUE if task.is_realtime else GREEN
        bars = np.column_stack((own["start"], own["end"] - own["start"])) / MS
        axes.broken_barh([tuple(bar) for bar in bars], (number - HEIGHT / 2, HEIGHT), color=colour)
        late = own[own["start"] > own["release"]]
        axes.hlines(
            np.full(len(late), number),
            late["release"] / MS,
            late["start"] / MS,
            color=ORANGE,
            linewidth=1.5,
        )
        axes.vlines(own["deadline"] / MS, number, number + 0.5, color=GREY, linewidth=0.8)
    axes.set_yticks(range(len(schedule.tasks)), [task.name for task in schedule.tasks], fontsize=8)
    axes.set_ylim(len(schedule.tasks) - 0.4, -0.6)


def draw_slack(axes: Axes, schedule: Schedule, runs: Any) -> None:
    """It falls with time from each end of a run on, until the release."""
    values = slack(schedule.runs, schedule.tasks, runs["end"])
    until = runs["end"] + values
    axes.plot(
        np.column_stack((runs["end"], until)).T / MS,
        np.column_stack((values, 0 * values)).T,
        color=BLUE,
        linewidth=0.8,
    )
    guard = f"guard, {schedule.guard_us} us"
    axes.axhline(schedule.guard_us, color=RED, linewidth=1.0, label=guard)
    axes.set_ylabel("slack, us")
    axes.set_xlabel("time since the start, ms")
    axes.legend(loc="upper right")


def plot(path: Path, schedule: Schedule, from_us: int, to_us: int) -> None:
    """Draw what ran between two times."""
    runs = within(schedule, from_us, to_us)
    figure = new_figure(9.0, 5.2)
    rows: Any = figure.subplots(2, 1, sharex=True, height_ratios=(5, 1))
    draw_tasks(rows[0], schedule, runs)
    draw_slack(rows[1], schedule, runs)
    rows[0].set_xlim(from_us / MS, to_us / MS)
    rows[0].set_title(
        "runs of real-time tasks (blue) and others (green); orange: it waits; "
        "grey strokes: deadlines"
    )
    write_svg(path, figure)
