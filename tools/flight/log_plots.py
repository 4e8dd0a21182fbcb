# SPDX-License-Identifier: Apache-2.0
"""A log's picture and its tables: attitude, motors, votes, time of the tasks, vibration."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from flight.library import states
from flight.spectrum import Spectrum, rate_of, spectrum
from flight.ulog import Log
from plotting import BLUE, COLOURS, GREEN, GREY, ORANGE, RED, new_figure, write_svg

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOTORS = ("front right", "aft right", "aft left", "front left")
POINTS = 1500  # Of a curve.
PEAKS = 4
KINDS = (("accelerometer", "m/s^2", 0), ("gyroscope", "rad/s", 3))  # Of imu.value, from where on.


def seconds(data: Any) -> Any:
    """Since power-up."""
    return data["timestamp"] / 1e6


def thin(values: Any) -> Any:
    """What is drawn of a column."""
    return values[:: max(1, len(values) // POINTS)]


def angles(q: Any) -> tuple[Any, Any]:
    """Roll and pitch of quaternions, in radians."""
    w, x, y, z = (q[:, column].astype(float) for column in range(4))
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    return roll, np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))


def draw_attitude(axes: Axes, log: Log) -> None:
    """Roll and pitch, and what was asked."""
    attitude, control = log.topic("attitude"), log.topic("control")
    for name, seen, colour in zip(("roll", "pitch"), angles(attitude["q"]), (BLUE, ORANGE),
                                  strict=True):  # fmt: skip
        asked = np.arcsin(np.clip(control[f"tilt_{name}"].astype(float), -1.0, 1.0))
        axes.plot(thin(seconds(control)), np.degrees(thin(asked)), color=GREY, linewidth=0.7)
        axes.plot(thin(seconds(attitude)), np.degrees(thin(seen)), color=colour, label=name)
    axes.set_ylabel("angle, degrees\n(grey: asked for)")


def draw_place(axes: Axes, log: Log) -> None:
    """North, east, up."""
    estimate = log.topic("estimate")
    for number, name in enumerate(("north", "east", "up")):
        axes.plot(thin(seconds(estimate)), thin(estimate["position"][:, number]), label=name)
    axes.set_ylabel("from home, m")


def draw_motors(axes: Axes, log: Log) -> None:
    """What they are told."""
    control = log.topic("control")
    for number, name in enumerate(MOTORS):
        axes.plot(thin(seconds(control)), thin(control["motor"][:, number]), linewidth=0.7,
                  label=name)  # fmt: skip
    axes.set_ylabel("motors")
    axes.set_ylim(0.0, 1.0)


def draw_votes(axes: Axes, log: Log) -> None:
    """Of each unit: how many of its six channels are in the vote."""
    vote = log.topic("vote")
    used = thin(vote["used"])
    for unit in range(units_of(log)):
        counts = [bin(int(word)).count("1") for word in used[:, unit]]
        axes.plot(thin(seconds(vote)), np.array(counts) + 0.08 * unit, drawstyle="steps",
                  label=f"unit {unit + 1}")  # fmt: skip
    axes.set_ylabel("channels\nin the vote")


def draw_load(axes: Axes, log: Log) -> None:
    """The processor, the states below it, and where the log has gaps."""
    health, state = log.topic("health"), log.topic("state")
    axes.plot(seconds(health), health["load_ppm"] / 1e4, color=GREEN, label="load")
    axes.set_ylabel("load, %")
    axes.set_ylim(0.0, 100.0)
    numbers = state["state"]
    changes = [0, *(np.flatnonzero(np.diff(numbers)) + 1).tolist()] if len(numbers) else []
    for place, row in enumerate(changes):
        axes.axvline(seconds(state)[row], color=GREY, linewidth=0.6)
        axes.text(seconds(state)[row], 95 - 12 * (place % 3), f" {states()[numbers[row]]}",
                  va="top", fontsize=7)  # fmt: skip
    for time_us, length_ms in log.dropouts:
        axes.axvspan(time_us / 1e6, time_us / 1e6 + length_ms / 1e3, color=RED, alpha=0.3)


OVER_TIME = (draw_attitude, draw_place, draw_motors, draw_votes, draw_load)


def units_of(log: Log) -> int:
    """How many inertial units were logged."""
    return sum(1 for name, _ in log.data if name == "imu")


def in_flight(log: Log, unit: int) -> Any:
    """What a unit measured while the motors turned; all of it, when they never did."""
    imu, state = log.topic("imu", unit), log.topic("state")
    turning = state["timestamp"][state["motors"]]
    if not len(turning):
        return imu
    time = imu["timestamp"]
    return imu[(time >= turning[0]) & (time <= turning[-1])]


def spectra(log: Log, unit: int, first: int) -> list[Spectrum]:
    """Of a unit's three axes of a kind."""
    imu = in_flight(log, unit)
    imu = imu[imu["present"]]
    rate_hz = rate_of(imu["timestamp"])
    return [spectrum(imu["value"][:, first + axis], rate_hz) for axis in range(3)]


def together(parts: list[Spectrum]) -> Spectrum:
    """Of three axes: the length of what they shake by."""
    squares = [part.amplitude**2 for part in parts]
    return Spectrum(parts[0].frequency, np.sqrt(np.sum(squares, axis=0)))


def draw_spectrum(axes: Axes, log: Log, kind: tuple[str, str, int]) -> None:
    """All units' spectra of a kind, one over the other (fig. 13)."""
    name, unit_of_measure, first = kind
    for unit, colour in zip(range(units_of(log)), COLOURS, strict=False):
        found = together(spectra(log, unit, first))
        axes.semilogy(found.frequency[1:], found.amplitude[1:], color=colour, linewidth=0.7,
                      label=f"unit {unit + 1}")  # fmt: skip
    axes.set_ylabel(f"{name},\n{unit_of_measure}")


def name_lines(axes: Axes) -> None:
    """A legend, if there is a line: a log that has each run has no samples of inertial units."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper right", ncols=4)


def plot_log(title: str, log: Log, path: Path) -> None:
    """All of it, one above the other."""
    figure = new_figure(9.0, 15.0)
    rows = figure.subplots(len(OVER_TIME) + len(KINDS), 1)
    for axes, draw in zip(rows, OVER_TIME, strict=False):
        draw(axes, log)
        name_lines(axes)
    rows[len(OVER_TIME) - 1].set_xlabel("time since power-up, s")
    for axes, kind in zip(rows[len(OVER_TIME) :], KINDS, strict=True):
        draw_spectrum(axes, log, kind)
        name_lines(axes)
    rows[-1].set_xlabel("frequency, Hz; the length of the three axes' amplitudes")
    figure.suptitle(title, x=0.01, ha="left")
    write_svg(path, figure)


def topics(log: Log) -> Table:
    """A row for each topic."""
    table = Table(title="Topics", title_justify="left")
    for heading in ("topic", "samples", "a second"):
        table.add_column(heading, justify="left" if heading == "topic" else "right")
    for (name, instance), data in log.data.items():
        rate = f"{rate_of(data['timestamp']):.1f}" if len(data) > 1 else ""
        table.add_row(f"{name} {instance}", str(len(data)), rate)
    return table


def tasks(log: Log, names: list[str]) -> Table:
    """A row for each task: its part of the processor, and how long it ran."""
    table = Table(title="Tasks", title_justify="left")
    for heading in ("task", "runs", "load, %", "mean, us", "longest, us", "left out"):
        table.add_column(heading, justify="left" if heading == "task" else "right")
    data = log.topic("tasks")
    if not len(data):
        return table
    last = data[-1]
    for row, runs in enumerate(last["runs"]):
        if runs:
            busy = int(last["busy_us"][row])
            table.add_row(names[row] if row < len(names) else f"own task {row}", str(runs),
                          f"{100.0 * busy / int(last['timestamp']):.2f}", f"{busy / runs:.1f}",
                          str(last["longest_us"][row]), str(last["skipped"][row]))  # fmt: skip
    return table


def vibration(log: Log) -> Table:
    """A row for each unit and kind: the frequencies at which it shakes most."""
    table = Table(title="Vibration: the strongest lines", title_justify="left")
    for heading in ("unit", "of", *[f"{number + 1}." for number in range(PEAKS)]):
        table.add_column(heading)
    for unit in range(units_of(log)):
        for name, unit_of_measure, first in KINDS:
            found = together(spectra(log, unit, first)).peaks(PEAKS)
            cells = [f"{hertz:.1f} Hz: {size:.3g} {unit_of_measure}" for hertz, size in found]
            table.add_row(str(unit + 1), name, *cells)
    return table
