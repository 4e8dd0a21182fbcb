# SPDX-License-Identifier: Apache-2.0
"""A log's picture and its tables: attitude, motors, votes, time of the tasks, vibration.

Of what a log has: of another autopilot's what is alike, by PX4's names. A log may be damaged, so
whatever a number is, it only looks wrong.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from keel.base.plotting import BLUE, COLOURS, GREEN, GREY, ORANGE, RED, new_figure, write_svg
from keel.flight.library import states
from keel.logs.spectrum import Spectrum, rate_of, spectrum
from keel.timeline.ulog import Log

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOTORS = ("front right", "aft right", "aft left", "front left")
PLACES = ("north", "east", "up")
POINTS = 1500  # Of a curve.
PEAKS = 4
LEAST = 64  # Samples of which a spectrum says anything.
MOST = 1e9  # No number of a flight is greater.
KINDS = (("accelerometer", "m/s^2", 0), ("gyroscope", "rad/s", 3))  # Of imu.value, from where on.
SENSORS = {0: "accelerometer_m_s2", 3: "gyro_rad"}  # The same in PX4's sensor_combined.
Found = tuple[Any, Any]  # When, in seconds since power-up, and numbers, a row for each time.


def columns(log: Log, topic: str, *fields: str, instance: int = 0) -> tuple[Any, ...] | None:
    """When, and these fields, each with a row for a sample; None when the log has no sample, or not
    all of them."""
    data = log.data.get((topic, instance))
    if data is None or not len(data):
        return None
    names = data.dtype.names
    if any(
        name not in names or data[name].dtype.kind not in "biuf" for name in ("timestamp", *fields)
    ):
        return None
    time = data["timestamp"]
    return (time.reshape(len(data), -1)[:, 0] / 1e6, *(numbers(data[name]) for name in fields))


def numbers(values: Any) -> Any:
    """As floats, a row for a sample; what cannot be of a flight is none."""
    wide = values.reshape(len(values), -1).astype(float)
    return np.where(np.abs(wide) <= MOST, wide, np.nan)


def joined(log: Log, topic: str, *fields: str) -> Found | None:
    """When, and fields of one number each, side by side."""
    found = columns(log, topic, *fields)
    return (found[0], np.hstack([each[:, :1] for each in found[1:]])) if found else None


def wide(log: Log, topic: str, name: str, least: int, instance: int = 0) -> Found | None:
    """When, and a field of at least so many numbers."""
    found = columns(log, topic, name, instance=instance)
    return (found[0], found[1]) if found and found[1].shape[1] >= least else None


def attitude_of(log: Log) -> Found | None:
    """Quaternions, w first."""
    return wide(log, "attitude", "q", 4) or wide(log, "vehicle_attitude", "q", 4)


def place_of(log: Log) -> Found | None:
    """North, east and up from home, or from where PX4's estimator began."""
    theirs = joined(log, "vehicle_local_position", "x", "y", "z")
    return wide(log, "estimate", "position", 3) or (
        (theirs[0], theirs[1] * (1.0, 1.0, -1.0)) if theirs else None
    )


def motors_of(log: Log) -> Found | None:
    """What they are told: 0 to 1, or in us."""
    return (
        wide(log, "control", "motor", 4)
        or wide(log, "actuator_motors", "control", 4)
        or wide(log, "actuator_outputs", "output", 4)
    )


def votes_of(log: Log) -> Found | None:
    """Which channels of which unit are used, a bit each."""
    return wide(log, "vote", "used", 1)


def load_of(log: Log) -> Found | None:
    """Of the processor, in percent."""
    ours, theirs = joined(log, "health", "load_ppm"), joined(log, "cpuload", "load")
    return (ours[0], ours[1] / 1e4) if ours else (theirs[0], 1e2 * theirs[1]) if theirs else None


def thin(values: Any) -> Any:
    """What is drawn of a column."""
    return values[:: max(1, len(values) // POINTS)]


def angles(q: Any) -> tuple[Any, Any]:
    """Roll and pitch of quaternions, in radians."""
    w, x, y, z = (q[:, column].astype(float) for column in range(4))
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    return roll, np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))


def draw_attitude(axes: Axes, log: Log, found: Found) -> None:
    """Roll and pitch, and what was asked."""
    asked = joined(log, "control", "tilt_roll", "tilt_pitch")
    for number, (name, colour) in enumerate((("roll", BLUE), ("pitch", ORANGE))):
        if asked:
            tilt = np.arcsin(np.clip(asked[1][:, number], -1.0, 1.0))
            axes.plot(thin(asked[0]), np.degrees(thin(tilt)), color=GREY, linewidth=0.7)
        seen = np.degrees(thin(angles(found[1])[number]))
        axes.plot(thin(found[0]), seen, color=colour, label=name)
    axes.set_ylabel("angle, degrees" + ("\n(grey: asked for)" if asked else ""))


def draw_place(axes: Axes, log: Log, found: Found) -> None:
    """North, east, up."""
    for number, name in enumerate(("north", "east", "up")):
        axes.plot(thin(found[0]), thin(found[1][:, number]), label=name)
    axes.set_ylabel("from home, m")


def draw_motors(axes: Axes, log: Log, found: Found) -> None:
    """What they are told; another's have numbers, as its frame may be another."""
    ours = wide(log, "control", "motor", 4)
    for number, name in enumerate(MOTORS):
        axes.plot(
            thin(found[0]),
            thin(found[1][:, number]),
            linewidth=0.7,
            label=name if ours else str(number + 1),
        )
    axes.set_ylabel("motors")
    if ours:
        axes.set_ylim(0.0, 1.0)


def draw_votes(axes: Axes, log: Log, found: Found) -> None:
    """Of each unit: how many of its six channels are in the vote."""
    used = thin(np.nan_to_num(found[1])).astype(np.int64)
    for unit in range(min(units_of(log), used.shape[1])):
        counts = [bin(int(word)).count("1") for word in used[:, unit]]
        axes.plot(
            thin(found[0]),
            np.array(counts) + 0.08 * unit,
            drawstyle="steps",
            label=f"unit {unit + 1}",
        )
    axes.set_ylabel("channels\nin the vote")


def draw_load(axes: Axes, log: Log, found: Found) -> None:
    """The processor, the states below it, and where the log has gaps."""
    axes.plot(found[0], found[1], color=GREEN, label="load")
    axes.set_ylabel("load, %")
    axes.set_ylim(0.0, 100.0)
    draw_states(axes, log)
    for time_us, length_ms in log.dropouts:
        axes.axvspan(time_us / 1e6, time_us / 1e6 + length_ms / 1e3, color=RED, alpha=0.3)


def draw_states(axes: Axes, log: Log) -> None:
    """Where the state machine's state changes, and to which."""
    found = joined(log, "state", "state")
    if not found:
        return
    numbered, names = np.nan_to_num(found[1][:, 0]).astype(int), states()
    changes = [0, *(np.flatnonzero(np.diff(numbered)) + 1).tolist()]
    for place, row in enumerate(changes):
        name = names[numbered[row]] if 0 <= numbered[row] < len(names) else f"state {numbered[row]}"
        axes.axvline(found[0][row], color=GREY, linewidth=0.6)
        axes.text(
            found[0][row], 95 - 12 * (place % 3), f" {name}", va="top", fontsize=7, clip_on=True
        )


# What is found in a log, and what draws it: from the top.
OVER_TIME: tuple[tuple[Callable[[Log], Found | None], Callable[[Axes, Log, Found], None]], ...] = (
    (attitude_of, draw_attitude),
    (place_of, draw_place),
    (motors_of, draw_motors),
    (votes_of, draw_votes),
    (load_of, draw_load),
)


def units_of(log: Log) -> int:
    """How many inertial units were logged."""
    return sum(1 for name, _ in log.data if name == "imu")


def turned(log: Log) -> tuple[float, float] | None:
    """From when until when motors turned."""
    found = joined(log, "state", "motors")
    if not found:
        return None
    times = found[0][found[1][:, 0] > 0]
    return (float(times[0]), float(times[-1])) if len(times) else None


def samples(log: Log, unit: int, first: int) -> Found | None:
    """Three axes of a unit's, while the motors turned, or all of it, when they never did, or the
    log does not say."""
    found = columns(log, "imu", "value", "present", instance=unit)
    if not found or found[1].shape[1] < first + 3:
        return wide(log, "sensor_combined", SENSORS[first], 3) if unit == 0 else None
    is_there = found[2][:, 0] > 0
    if turning := turned(log):
        is_there &= (found[0] >= turning[0]) & (found[0] <= turning[1])
    return found[0][is_there], found[1][is_there, first : first + 3]


def spectra(log: Log, unit: int, first: int) -> list[Spectrum]:
    """Of a unit's three axes of a kind; none when there is too little."""
    found = samples(log, unit, first)
    if not found:
        return []
    whole = np.isfinite(found[1]).all(axis=1)
    time, value = found[0][whole], found[1][whole]
    rate_hz = rate_of(1e6 * time) if len(time) >= LEAST else 0.0
    return [spectrum(value[:, axis], rate_hz) for axis in range(3)] if rate_hz else []


def together(parts: list[Spectrum]) -> Spectrum:
    """Of three axes: the length of what they shake by."""
    squares = [part.amplitude**2 for part in parts]
    return Spectrum(parts[0].frequency, np.sqrt(np.sum(squares, axis=0)))


def spectra_of(log: Log, first: int) -> list[tuple[int, Spectrum]]:
    """Of a kind, for each unit that has one."""
    parts = [(unit, spectra(log, unit, first)) for unit in range(max(1, units_of(log)))]
    return [(unit, together(part)) for unit, part in parts if part]


def draw_spectra(axes: Axes, found: list[tuple[int, Spectrum]]) -> None:
    """All units' spectra of a kind, one over the other (fig. 13)."""
    for (unit, line), colour in zip(found, COLOURS, strict=False):
        axes.semilogy(
            line.frequency[1:],
            line.amplitude[1:],
            color=colour,
            linewidth=0.7,
            label=f"unit {unit + 1}",
        )


def span_of(log: Log) -> tuple[float, float]:
    """From when until when the log is, but for single samples whose times are far off."""
    times = [
        found[0] for name, instance in log.data if (found := columns(log, name, instance=instance))
    ]
    first, last = (float(end) for end in np.quantile(max(times, key=len), (0.002, 0.998)))
    margin = 0.03 * (last - first) + 0.1
    return first - margin, last + margin


def plot_log(title: str, log: Log, path: Path) -> bool:
    """What the log has of all of it, one above the other; whether it has anything."""
    over_time = [(draw, found) for find, draw in OVER_TIME if (found := find(log))]
    shakes = [(kind, lines) for kind in KINDS if (lines := spectra_of(log, kind[2]))]
    if not over_time and not shakes:
        return False
    figure = new_figure(9.0, 1.0 + 2.0 * (len(over_time) + len(shakes)))
    rows = figure.subplots(len(over_time) + len(shakes), 1, squeeze=False)[:, 0]
    for axes, (draw, found) in zip(rows, over_time, strict=False):
        draw(axes, log, found)
        axes.set_xlim(span_of(log))
        axes.legend(loc="upper right", ncols=4)
    if over_time:
        rows[len(over_time) - 1].set_xlabel("time since power-up, s")
    for axes, ((name, unit_of_measure, _), lines) in zip(
        rows[len(over_time) :], shakes, strict=True
    ):
        draw_spectra(axes, lines)
        axes.set_ylabel(f"{name},\n{unit_of_measure}")
        axes.legend(loc="upper right", ncols=4)
    if shakes:
        rows[-1].set_xlabel("frequency, Hz; the length of the three axes' amplitudes")
    figure.suptitle(title, x=0.01, ha="left")
    write_svg(path, figure)
    return True


def topics(log: Log) -> Table:
    """A row for each topic."""
    table = Table(title="Topics", title_justify="left")
    for heading in ("topic", "samples", "a second"):
        table.add_column(heading, justify="left" if heading == "topic" else "right")
    for (name, instance), data in log.data.items():
        found = columns(log, name, instance=instance)
        rate = rate_of(1e6 * found[0]) if found and len(data) > 1 else 0.0
        table.add_row(f"{name} {instance}", str(len(data)), f"{rate:.1f}" if rate else "")
    return table


def tasks(log: Log, names: list[str]) -> Table | None:
    """A row for each task: its part of the processor, and how long it ran; None without any."""
    found = columns(log, "tasks", "runs", "busy_us", "longest_us", "skipped")
    if not found:
        return None
    table = Table(title="Tasks", title_justify="left")
    for heading in ("task", "runs", "load, %", "mean, us", "longest, us", "left out"):
        table.add_column(heading, justify="left" if heading == "task" else "right")
    last_us = max(1.0, 1e6 * found[0][-1])
    lasts = zip(*(np.nan_to_num(each[-1]) for each in found[1:]), strict=False)
    for row, (runs, busy, longest, skipped) in enumerate(lasts):
        if runs:
            table.add_row(
                names[row] if row < len(names) else f"own task {row}",
                f"{runs:.0f}",
                f"{100.0 * busy / last_us:.2f}",
                f"{busy / runs:.1f}",
                f"{longest:.0f}",
                f"{skipped:.0f}",
            )
    return table


def vibration(log: Log) -> Table | None:
    """A row for each unit and kind: the frequencies at which it shakes most; None without any."""
    rows = [
        (unit, name, unit_of_measure, line)
        for name, unit_of_measure, first in KINDS
        for unit, line in spectra_of(log, first)
    ]
    if not rows:
        return None
    table = Table(title="Vibration: the strongest lines", title_justify="left")
    for heading in ("unit", "of", *[f"{number + 1}." for number in range(PEAKS)]):
        table.add_column(heading)
    for unit, name, unit_of_measure, line in sorted(rows, key=lambda row: row[0]):
        cells = [
            f"{hertz:.1f} Hz: {size:.3g} {unit_of_measure}" for hertz, size in line.peaks(PEAKS)
        ]
        table.add_row(str(unit + 1), name, *cells)
    return table
