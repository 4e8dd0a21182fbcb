# SPDX-License-Identifier: Apache-2.0
"""A recording in Keel's frames: body forward, right, down; Earth north, east, down.

Times are in seconds from its first sample on; what was made to precede it is before 0.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from dataclasses import field as kept
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from keel.base.errors import ToolError
from keel.replay import turns

GRAVITY = 9.80665
FIRST_S, LEAD_S = 1.0, 8.0
LONGEST_S = 7200.0
FIELD_LEAST, FIELD_MOST = 0.0625, 80.0  # Of a horizontal field, and a part of it, in uT.
STILL = (0.6, 0.06, 0.3)  # Deviation of force and rate, and their mean rate: m/s^2, rad/s, rad/s.
NOISE = (0.02, 0.002)  # Of what is made up: m/s^2, rad/s.
FLAT = np.array([1.0, -1.0, -1.0])  # From forward, left, up to forward, right, down; and back.


class Series(NamedTuple):
    """Rows of numbers, and when each was so."""

    time: Any
    value: Any

    def where(self, keep: Any) -> Series:
        """Some of the rows."""
        return Series(self.time[keep], self.value[keep])

    def shifted(self, by: float) -> Series:
        """The same at another time."""
        return Series(self.time + by, self.value)


@dataclass
class Recording:
    """What was recorded. Of the optional parts None says that there is none."""

    path: Path
    units: list[Series]  # Each row: specific force in m/s^2, angular rate in rad/s.
    field: Series | None = None  # In uT.
    reference: Series | None = None  # Quaternions from body to Earth, where they are known.
    estimate: Series | None = None  # The same by whoever recorded it.
    moving: Series | None = None
    pressure: Series | None = None  # In Pa.
    height: Series | None = None  # The recorder's, in m.
    fixes: Series | None = None  # Degrees twice, m, m/s north, east, down, accuracies m, m/s.
    expected: tuple[float, float] | None = None  # The horizontal field, north and east, in uT.
    notes: list[str] = kept(default_factory=list)

    @property
    def judge(self) -> Series | None:
        """What errors are measured by."""
        return self.reference or self.estimate

    @property
    def duration_s(self) -> float:
        """To the last inertial sample."""
        return float(max(unit.time[-1] for unit in self.units))


def checked(path: Path, what: str, time: Any, value: Any, place: Callable[[int], str]) -> Series:
    """A series whose numbers are finite and whose time does not run backwards; of rows of one time
    the last stays."""
    times, values = np.asarray(time, float), np.asarray(value, float)
    if len(times) != len(values):
        raise ToolError(f"{path}: {what}: {len(values)} rows, but {len(times)} times")
    if len(times) < 2:
        raise ToolError(f"{path}: {what}: {len(times)} rows, at least 2 are needed")
    bad = ~(np.isfinite(values.reshape(len(values), -1)).all(1) & np.isfinite(times))
    if bad.any():
        raise ToolError(
            f"{path}: {place(int(np.argmax(bad)))}: {what} has a value that is no finite number"
        )
    steps = np.diff(times)
    if (steps < 0.0).any():
        row = int(np.argmax(steps < 0.0)) + 1
        raise ToolError(
            f"{path}: {place(row)}: time runs backwards in {what}, from "
            f"{times[row - 1]:.6f} to {times[row]:.6f} s"
        )
    return Series(times, values).where(np.append(steps > 0.0, True))


def unit_quaternions(path: Path, what: str, found: Series) -> Series:
    """Quaternions that are of length 1 nearly, and so exactly."""
    length = np.linalg.norm(found.value, axis=1)
    wrong = np.abs(length - 1.0) > 0.02
    if wrong.any():
        row = int(np.argmax(wrong))
        raise ToolError(
            f"{path}: at {found.time[row]:.3f} s: {what} is no unit quaternion: its "
            f"length is {length[row]:.3f}"
        )
    return Series(found.time, found.value / length[:, None])


def begun(recording: Recording) -> Recording:
    """Times from the first inertial sample on; what is earlier is left out."""
    start = min(float(unit.time[0]) for unit in recording.units)
    if recording.duration_s - start > LONGEST_S:
        raise ToolError(
            f"{recording.path}: lasts {recording.duration_s - start:.0f} s, from "
            f"{start:.3f} s on; at most {LONGEST_S:.0f} are replayed"
        )
    moved: dict[str, Any] = {"units": [unit.shifted(-start) for unit in recording.units]}
    for name in ("field", "reference", "estimate", "moving", "pressure", "height", "fixes"):
        series = getattr(recording, name)
        if series is not None:
            later = series.shifted(-start)
            kept = later.where((later.time >= 0.0) & (later.time <= recording.duration_s - start))
            moved[name] = kept if len(kept.time) > 1 else None
    return replace(recording, **moved)


def aligned(recording: Recording) -> Recording:
    """Each unit turned and shifted by constants so that it fits the mean of all best: units that
    stand askew on their carrier."""
    time = recording.units[0].time
    mean = np.mean([columns(unit, time) for unit in recording.units], axis=0)
    units = []
    for unit in recording.units:
        here = columns(unit, time)
        turn = fitted(here[:, 3:], mean[:, 3:])
        value = np.hstack([unit.value[:, :3] @ turn.T, unit.value[:, 3:] @ turn.T])
        offset = mean.mean(0) - np.hstack([here[:, :3] @ turn.T, here[:, 3:] @ turn.T]).mean(0)
        units.append(Series(unit.time, value + offset))
    note = "each unit is turned and shifted by constants onto the mean of all"
    return replace(recording, units=units, notes=[*recording.notes, note])


def fitted(seen: Any, wanted: Any) -> Any:
    """The turn that takes vectors nearest to others, but for their means."""
    u, _, v = np.linalg.svd((wanted - wanted.mean(0)).T @ (seen - seen.mean(0)))
    return u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))]) @ v


def columns(series: Series, at: Any) -> Any:
    """Numbers at other times, interpolated linearly."""
    return np.stack([np.interp(at, series.time, column) for column in series.value.T], 1)


def mean_unit(units: list[Series]) -> Series:
    """The plain mean, at the first one's times."""
    time = units[0].time
    return Series(time, np.mean([columns(unit, time) for unit in units], axis=0))


def known_at_start(recording: Recording) -> float | None:
    """When its attitude is known first, if that is in its first second, or before it moves."""
    judge = recording.judge
    if judge is None:
        return None
    begin = float(judge.time[0])
    still = not moving_of(recording, np.arange(0.0, begin + FIRST_S, 0.1)).any()
    return begin if begin <= FIRST_S or still else None


def with_expected_field(recording: Recording, given: tuple[float, float] | None) -> Recording:
    """How the horizontal field lies in the Earth's frame: as given, as the recording says, or as
    its first second shows."""
    if given or recording.expected or recording.field is None:
        return with_field(recording, given or recording.expected)
    begin = max(known_at_start(recording) or 0.0, float(recording.field.time[0]))
    first = recording.field.where(
        (recording.field.time >= begin) & (recording.field.time <= begin + FIRST_S)
    )
    if known_at_start(recording) is not None and recording.judge is not None:
        by = "the reference" if recording.reference else "the recorder's estimate"
        turn = turns.between(recording.judge.value, recording.judge.time, first.time)
        seen = turns.turned(turn, first.value).mean(0)
        expected = float(seen[0]), float(seen[1])
        why = f"the second from {begin:.1f} s on, turned by {by}"
    else:
        unit = mean_unit(recording.units)
        force = unit.value[unit.time <= FIRST_S, :3].mean(0)
        seen = turns.turned(
            turns.level(-force, first.value.mean(0), (1.0, 0.0)), first.value.mean(0)
        )
        expected, why = (
            (float(np.hypot(seen[0], seen[1])), 0.0),
            "the first second, turned by gravity; north is magnetic",
        )
    note = f"expected field {expected[0]:.2f} uT north, {expected[1]:.2f} uT east: of {why}"
    return with_field(replace(recording, notes=[*recording.notes, note]), expected)


def with_field(recording: Recording, expected: tuple[float, float] | None) -> Recording:
    """With a field that the copter's parameters take."""
    if expected and not (
        max(map(abs, expected)) <= FIELD_MOST and np.hypot(*expected) >= FIELD_LEAST
    ):
        raise ToolError(
            f"{recording.path}: the horizontal field would be {expected[0]:.3g} uT "
            f"north and {expected[1]:.3g} uT east, expected {FIELD_LEAST:g} to "
            f"{FIELD_MOST:g}: is the magnetometer in uT?"
        )
    return replace(recording, expected=expected)


def is_still(units: list[Series]) -> bool:
    """Whether the first second is at rest."""
    rows = [unit.value[unit.time <= FIRST_S] for unit in units]
    spread = np.max([row.std(0) for row in rows], axis=0)
    rate = max(np.abs(row[:, 3:].mean(0)).max() for row in rows)
    return bool(spread[:3].max() < STILL[0] and spread[3:].max() < STILL[1] and rate < STILL[2])


def repeated(series: Series | None, lead_s: float) -> Series | None:
    """A series with its first second before it, backwards and forwards in turn."""
    if series is None or series.time[0] > FIRST_S:
        return series
    first = series.where(series.time < FIRST_S)
    times, values = [series.time], [series.value]
    for second in range(int(np.ceil(lead_s))):
        backwards = second % 2 == 0
        turn = slice(None, None, -1) if backwards else slice(None)
        at = (-first.time - second) if backwards else (first.time - second - 1.0)
        times.append(at[turn])
        values.append(first.value[turn])
    time, value = np.concatenate(times[::-1]), np.concatenate(values[::-1])
    return Series(time, value).where(np.append(np.diff(time) > 1e-6, True))


def made_up(series: Series, rest: Any, lead_s: float, noise: Any) -> Series:
    """A series with rest before it, at its pace."""
    step = float(np.median(np.diff(series.time)))
    time = series.time[0] - step * np.arange(int(lead_s / step), 0, -1)
    drawn = np.random.Generator(np.random.PCG64(1)).standard_normal((len(time), len(rest)))
    return Series(
        np.concatenate([time, series.time]), np.concatenate([rest + noise * drawn, series.value])
    )


def with_lead_in(recording: Recording, lead_s: float) -> Recording:
    """Rest before the recording: a flight controller is switched on before it flies."""
    judge = recording.judge
    if lead_s <= 0.0:
        return recording
    if is_still(recording.units):
        note = f"{lead_s:g} s of rest before it: its first second, backwards and forwards"
        units = [repeated(unit, lead_s) or unit for unit in recording.units]
        return replace(
            recording,
            units=units,
            field=repeated(recording.field, lead_s),
            pressure=repeated(recording.pressure, lead_s),
            notes=[*recording.notes, note],
        )
    if judge is None or judge.time[0] > FIRST_S:
        note = "begins in motion, and no attitude is known then: no rest is put before it"
        return replace(recording, notes=[*recording.notes, note])
    turn = turns.back(judge.value[0])
    rest = np.concatenate([turns.turned(turn, np.array([0.0, 0.0, -GRAVITY])), np.zeros(3)])
    noise = np.repeat(NOISE, 3)
    units = [made_up(unit, rest, lead_s, noise) for unit in recording.units]
    seen = recording.field and made_up(recording.field, recording.field.value[0], lead_s, 0.1)
    note = (
        f"begins in motion: {lead_s:g} s of rest are made up before it, in its attitude at "
        f"{judge.time[0]:.2f} s, with gyroscopes without an offset"
    )
    return replace(recording, units=units, field=seen, notes=[*recording.notes, note])


def moving_of(recording: Recording, at: Any) -> Any:
    """Whether it moves at some times: as recorded, or where its rate is above 0.1 rad/s within half
    a second."""
    if recording.moving is not None:
        place = np.searchsorted(recording.moving.time, at, side="right") - 1
        return recording.moving.value[np.clip(place, 0, None)].astype(bool)
    unit = recording.units[0]
    fast = unit.time[np.linalg.norm(unit.value[:, 3:], axis=1) > 0.1]
    if not len(fast):
        return np.zeros(len(at), bool)
    after = np.searchsorted(fast, at)
    before, after = np.clip(after - 1, 0, None), np.clip(after, None, len(fast) - 1)
    return np.minimum(np.abs(fast[before] - at), np.abs(fast[after] - at)) <= 0.5
