# SPDX-License-Identifier: Apache-2.0
"""A flight's picture: attitude and what was asked, place, motors, votes, the processor's load."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from keel.base.plotting import BLUE, COLOURS, GREEN, GREY, ORANGE, RED, new_figure, write_svg
from keel.flight.judge import asked, believed
from keel.flight.library import states
from keel.flight.loop import Trace
from keel.flight.scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.axes import Axes

EVERY = 8  # Rows of the trace for a point of a curve: 25 points a second.
STICKS = ("angle", "altitude")
MOTORS = ("front right", "aft right", "aft left", "front left")


def thin(values: Any) -> Any:
    """What is drawn of a column."""
    return values[::EVERY]


def draw_attitude(axes: Axes, trace: Trace, time: Any) -> None:
    """Roll and pitch: truth, belief, and what was asked."""
    wanted, seen = asked(trace), believed(trace)
    for number, (name, colour) in enumerate((("roll", BLUE), ("pitch", ORANGE))):
        axes.plot(
            time,
            np.degrees(thin(wanted[number])),
            color=GREY,
            linewidth=0.7,
            label="asked for" if number == 0 else None,
        )
        axes.plot(time, np.degrees(thin(trace.column(name))), color=colour, label=name)
        axes.plot(time, np.degrees(thin(seen[number])), color=colour, linestyle=":")
    axes.set_ylabel("angle, degrees\n(dotted: belief)")


def draw_error(axes: Axes, trace: Trace, time: Any) -> None:
    """Belief less truth."""
    seen = believed(trace)
    for number, name in enumerate(("roll", "pitch")):
        error = np.degrees(seen[number] - trace.column(name))
        axes.plot(time, thin(error), label=name)
    axes.set_ylabel("error, degrees")


def draw_place(axes: Axes, trace: Trace, time: Any) -> None:
    """North, east, up."""
    for number, (name, colour) in enumerate(zip(("north", "east", "up"), COLOURS, strict=False)):
        axes.plot(time, thin(trace.column(name)), color=colour, label=name)
        axes.plot(time, thin(trace.view["position"][:, number]), color=colour, linestyle=":")
    axes.set_ylabel("from home, m")


def draw_motors(axes: Axes, trace: Trace, time: Any) -> None:
    """What they are told."""
    for number, name in enumerate(MOTORS):
        axes.plot(time, thin(trace.view["motor"][:, number]), linewidth=0.7, label=name)
    axes.set_ylabel("motors")
    axes.set_ylim(0.0, 1.0)


def draw_votes(axes: Axes, trace: Trace, time: Any) -> None:
    """Of each unit: how many of its six channels are in the vote."""
    used = trace.view["used"]
    counts = np.array([[bin(int(word)).count("1") for word in row] for row in thin(used)])
    for unit in range(used.shape[1]):
        axes.plot(time, counts[:, unit] + 0.08 * unit, drawstyle="steps", label=f"unit {unit + 1}")
    axes.set_ylabel("channels\nin the vote")


def draw_load(axes: Axes, trace: Trace, time: Any) -> None:
    """The processor, and the states below it."""
    axes.plot(time, thin(trace.view["load_ppm"]) / 1e4, color=GREEN, label="load")
    axes.set_ylabel("load, %")
    axes.set_ylim(0.0, 100.0)
    numbers = trace.view["state"]
    changes = [0, *(np.flatnonzero(np.diff(numbers)) + 1).tolist()]
    for place, row in enumerate(changes):
        axes.axvline(trace.column("time")[row], color=GREY, linewidth=0.6)
        axes.text(
            trace.column("time")[row],
            95 - 12 * (place % 3),
            f" {states()[numbers[row]]}",
            va="top",
            fontsize=7,
        )


def draw_tasks(axes: Axes, trace: Trace) -> None:
    """How long each task ran at most, and what it left out."""
    _, after = trace.done
    places = np.arange(len(trace.tasks))
    axes.barh(places, after["longest_us"], color=BLUE)
    for place, task in zip(places, after, strict=True):
        left_out = f", {task['skipped']} left out" if task["skipped"] else ""
        over = f", {task['overruns']} too long" if task["overruns"] else ""
        if left_out or over:
            words = f" {task['runs']} runs{left_out}{over}"
            axes.text(float(task["longest_us"]), float(place), words, va="center", fontsize=6.5)
    axes.set_yticks(places, trace.tasks, fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("longest run, us")


DRAWN = (draw_attitude, draw_error, draw_place, draw_motors, draw_votes, draw_load)


def plot_flight(title: str, scenario: Scenario, trace: Trace, path: Path) -> None:
    """All of it, one above the other."""
    figure = new_figure(9.0, 15.0)
    rows = figure.subplots(len(DRAWN) + 1, 1, height_ratios=[*[1.0] * len(DRAWN), 1.7])
    time = thin(trace.column("time"))
    for axes, draw in zip(rows, DRAWN, strict=False):
        draw(axes, trace, time)
        axes.set_xlim(0.0, scenario.duration_s)
        for fault in scenario.fault:
            axes.axvline(fault.at_s, color=RED, linestyle="--", linewidth=0.8)
        axes.legend(loc="upper right", ncols=4)
    rows[len(DRAWN) - 1].set_xlabel("time since the motors started, s")
    draw_tasks(rows[-1], trace)
    figure.suptitle(f"{title}: {scenario.description}", x=0.01, ha="left")
    write_svg(path, figure)
