# SPDX-License-Identifier: Apache-2.0
"""The experiments' plots."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from keel.base.plotting import BLUE, COLOURS, GREY, SKY, grid_along, new_figure, write_svg
from keel.timing.experiments import (
    GOAL_MODEL,
    SIGMA_GOALS,
    Deviations,
    class_sigma,
    paper_class_sigma,
    sigma,
)
from keel.timing.taskset import TaskSet

Row = Sequence[str | int | float | None]

# Variants of the experiments, with what the legend calls them.
SHOWN = {
    "Keel": "Keel",
    "RT phases": "Keel, phases of real-time tasks only",
    "no phases": "Keel without phases",
    "unguarded": "without guard or phases",
    "EDF": "plain EDF without phases",
}
PAPER = "paper"
STYLES = dict(zip([PAPER, *SHOWN], [GREY, *COLOURS], strict=False))
FLOOR = 1e-4  # Percent; a logarithmic scale has no 0.


def plot_classes(tasks: TaskSet, results: Deviations, path: Path) -> None:
    """Fig. 12: deviation by class."""
    figure = new_figure(9.0, 4.5)
    axes = figure.add_subplot()
    series = {PAPER: [paper_class_sigma(tasks, name) for name in SIGMA_GOALS]}
    for variant in SHOWN:
        result = results[variant, GOAL_MODEL]
        series[variant] = [class_sigma(tasks, result, name) for name in SIGMA_GOALS]
    width = 0.8 / len(series)
    for number, (name, values) in enumerate(series.items()):
        places = [place + (number - len(series) / 2 + 0.5) * width for place in range(len(values))]
        axes.bar(
            places,
            [max(value, FLOOR) for value in values],
            width,
            color=STYLES[name],
            label=SHOWN.get(name, name),
        )
    for place, goal in enumerate(SIGMA_GOALS.values()):
        label = "goal" if place == 0 else "_more"  # A legend leaves out names that begin so.
        axes.hlines(goal, place - 0.4, place + 0.4, color="black", linewidth=1.0, label=label)
    axes.set_xticks(range(len(SIGMA_GOALS)), list(SIGMA_GOALS))
    axes.set(
        yscale="log",
        ylim=(FLOOR, 10.0),
        xlabel="priority class",
        ylabel="standard deviation of the period, % of it",
        title="How steady tasks start, by priority class (fig. 12)",
    )
    grid_along(axes, "y")
    figure.legend(loc="outside lower center", ncols=4)
    write_svg(path, figure)


def plot_tasks(tasks: TaskSet, results: Deviations, path: Path) -> None:
    """Table 2's last column."""
    figure = new_figure(9.0, 4.5)
    axes = figure.add_subplot()
    places = range(len(tasks.tasks))
    axes.plot(
        places,
        [max(task.sigma or 0.0, FLOOR) for task in tasks.tasks],
        "_",
        color=STYLES[PAPER],
        label=PAPER,
        markersize=12,
    )
    for (variant, label), mark in zip(SHOWN.items(), "ox^sd", strict=True):
        result = results[variant, GOAL_MODEL]
        values = [max(sigma(tasks, result, task.name), FLOOR) for task in tasks.tasks]
        axes.plot(places, values, mark, color=STYLES[variant], label=label, markersize=5)
    axes.set_xticks(places, [task.label for task in tasks.tasks])
    axes.set(
        yscale="log",
        ylim=(0.7 * FLOOR, 20.0),
        xlabel="task of table 2",
        ylabel="standard deviation of the period, % of it",
        title="How steady each task starts (eq. 15)",
    )
    grid_along(axes, "y")
    figure.legend(loc="outside lower center", ncols=3)
    write_svg(path, figure)


def plot_paths(rows: Sequence[Row], path: Path) -> None:
    """Fig. 10: reaction above, freshness below."""
    figure = new_figure(9.0, 6.0)
    kinds = {"observed": BLUE, "observed without phases": SKY, "predicted by eq. 5 to 7": GREY}
    upper, lower = figure.subplots(2, 1, sharex=True)
    for axes, title, first in ((upper, "Reaction", 1), (lower, "Freshness", 5)):
        for column, (label, colour) in enumerate(kinds.items()):
            values = [float(row[first + column] or 0.0) / 1000 for row in rows]
            places = [place + 0.25 * (column - 1) for place in range(len(rows))]
            axes.bar(places, values, 0.25, color=colour, label=label)
        for place, row in enumerate(rows):
            limit = float(row[first + len(kinds)] or 0.0) / 1000
            axes.hlines(
                limit,
                place - 0.4,
                place + 0.4,
                color="black",
                linewidth=1.0,
                label="limit" if place == 0 else "_more",
            )
        axes.set(ylabel="time, ms", title=f"{title} of each path (fig. 10)")
        grid_along(axes, "y")
    lower.set_xticks(range(len(rows)), [str(row[0]).replace(", ", ",\n") for row in rows])
    figure.legend(*upper.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    write_svg(path, figure)
