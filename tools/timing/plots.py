"""The experiments' plots."""

from __future__ import annotations

from pathlib import Path

from timing.experiments import (
    GOAL_MODEL,
    SIGMA_GOALS,
    Deviations,
    class_sigma,
    paper_class_sigma,
    sigma,
)  # fmt: skip
from timing.output import new_figure, write_svg
from timing.taskset import TaskSet

SHOWN = ("Keel", "RT phases", "no phases", "unguarded", "EDF")
FLOOR = 1e-4  # Percent; a logarithmic scale has no 0.


def plot_classes(tasks: TaskSet, results: Deviations, path: Path) -> None:
    """Fig. 12: deviation by class."""
    figure = new_figure(9.0, 4.5)
    axes = figure.add_subplot()
    series = {"paper": [paper_class_sigma(tasks, name) for name in SIGMA_GOALS]}
    for variant in SHOWN:
        result = results[variant, GOAL_MODEL]
        series[variant] = [class_sigma(tasks, result, name) for name in SIGMA_GOALS]
    width = 0.8 / len(series)
    for number, (name, values) in enumerate(series.items()):
        places = [place + (number - len(series) / 2 + 0.5) * width for place in range(len(values))]
        axes.bar(places, [max(value, FLOOR) for value in values], width, label=name)
    for place, goal in enumerate(SIGMA_GOALS.values()):
        label = "goal" if place == 0 else "_more"  # A legend leaves out names that begin so.
        axes.hlines(goal, place - 0.4, place + 0.4, color="black", linewidth=1.0, label=label)
    axes.set_xticks(range(len(SIGMA_GOALS)), list(SIGMA_GOALS))
    axes.set(yscale="log", ylabel="% of the period", title="Fig. 12: mean deviation by class")
    figure.legend(loc="outside lower center", fontsize=8, ncols=7)
    write_svg(path, figure)


def plot_tasks(tasks: TaskSet, results: Deviations, path: Path) -> None:
    """Table 2's last column."""
    figure = new_figure(9.0, 4.5)
    axes = figure.add_subplot()
    places = range(len(tasks.tasks))
    axes.plot(places, [task.sigma or FLOOR for task in tasks.tasks], "k_", label="paper")
    for variant, mark in zip(SHOWN, "ox^sd", strict=True):
        result = results[variant, GOAL_MODEL]
        values = [max(sigma(tasks, result, task.name), FLOOR) for task in tasks.tasks]
        axes.plot(places, values, mark, label=variant, markersize=5)
    axes.set_xticks(places, [task.label for task in tasks.tasks], fontsize=8)
    axes.set(yscale="log", ylabel="% of the period", title="Period deviation by task (eq. 15)")
    figure.legend(loc="outside lower center", fontsize=8, ncols=6)
    write_svg(path, figure)


def plot_paths(rows: list[list[str | int | float | None]], path: Path) -> None:
    """Fig. 10: reaction above, freshness below."""
    figure = new_figure(9.0, 6.0)
    names = [str(row[0]) for row in rows]
    for number, (title, first) in enumerate((("Reaction", 1), ("Freshness", 5))):
        axes = figure.add_subplot(2, 1, number + 1)
        labels = ("observed", "observed, no phases", "predicted (eq. 5 to 7)", "constraint")
        for column, label in enumerate(labels):
            values = [float(row[first + column] or 0.0) / 1000 for row in rows]
            axes.bar([place + 0.2 * (column - 1.5) for place in range(len(rows))], values, 0.2,
                     label=label)  # fmt: skip
        axes.set_xticks(range(len(rows)), names, fontsize=8)
        axes.set(ylabel="ms", title=f"Fig. 10: {title.lower()}")
        axes.legend(fontsize=8)
    write_svg(path, figure)
