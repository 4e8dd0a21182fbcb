# SPDX-License-Identifier: Apache-2.0
"""Other estimators on the same samples, at the recording's own rate: VQF, and a Mahony filter in
double precision whose gains suit recordings like BROAD's."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from keel.replay import turns
from keel.replay.recording import Recording, Series, columns, mean_unit

GAIN, BIAS_GAIN = 0.74, 0.0012  # In 1/s, in 1/s^2.
NED = (0.0, math.sqrt(0.5), math.sqrt(0.5), 0.0)  # The turn from east, north, up.
Vector = tuple[float, float, float]


def even(recording: Recording) -> tuple[float, Any, Any, Any]:
    """The step, times, the units' mean, and the field at even steps."""
    unit = mean_unit(recording.units[:3])
    step = float(np.median(np.diff(unit.time)))
    time = np.arange(unit.time[0], unit.time[-1], step)
    seen = None if recording.field is None else columns(recording.field, time)
    return step, time, columns(unit, time), seen


def vqf(recording: Recording) -> Series:
    """Versatile Quaternion-based Filter, with its own settings."""
    from vqf import VQF

    step, time, unit, seen = even(recording)
    gyro, accel = (np.ascontiguousarray(unit[:, part]) for part in (slice(3, 6), slice(0, 3)))
    if seen is None:
        found = VQF(step).updateBatch(gyro, accel)["quat6D"]
    else:
        found = VQF(step).updateBatch(gyro, accel, np.ascontiguousarray(seen))["quat9D"]
    north, east = recording.expected or (1.0, 0.0)
    half = math.atan2(east, north) / 2.0  # Its north is the field's.
    return Series(
        time,
        turns.times(
            np.array([math.cos(half), 0.0, 0.0, math.sin(half)]), turns.times(np.array(NED), found)
        ),
    )


def cross(a: Vector, b: Vector) -> Vector:
    """The product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit_of(x: float, y: float, z: float) -> Vector:
    """Of length 1; nothing stays nothing."""
    length = math.sqrt(x * x + y * y + z * z) or 1.0
    return x / length, y / length, z / length


class Mahony:
    """Down and north as the body sees them, corrected by what is measured of them."""

    def __init__(self, turn: Any, step: float, expected: tuple[float, float]) -> None:
        self.turn: tuple[float, ...] = tuple(float(part) for part in turn)
        self._bias = (0.0, 0.0, 0.0)
        self._step = step
        self._course = math.atan2(expected[1], expected[0])

    def _error(self, force: Any, seen: Any) -> Vector:
        """The turn that is left, about the body's axes."""
        w, x, y, z = self.turn
        north = 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)
        down = 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
        found = cross(unit_of(-force[0], -force[1], -force[2]), down)
        if seen is None:
            return found
        east = cross(down, north)
        here = unit_of(*seen)
        flat = math.hypot(
            *(sum(a * b for a, b in zip(here, axis, strict=True)) for axis in (north, east))
        )
        depth = sum(a * b for a, b in zip(here, down, strict=True))
        along = flat * math.cos(self._course), flat * math.sin(self._course)
        wanted = tuple(
            along[0] * n + along[1] * e + depth * d
            for n, e, d in zip(north, east, down, strict=True)
        )
        more = cross(here, (wanted[0], wanted[1], wanted[2]))
        return found[0] + more[0], found[1] + more[1], found[2] + more[2]

    def update(self, force: Any, rate: Any, seen: Any) -> None:
        """A step."""
        error = self._error(force, seen)
        b = self._bias
        b = self._bias = (
            b[0] - BIAS_GAIN * self._step * error[0],
            b[1] - BIAS_GAIN * self._step * error[1],
            b[2] - BIAS_GAIN * self._step * error[2],
        )
        x, y, z = (self._step * (rate[k] - b[k] + GAIN * error[k]) for k in range(3))
        angle = math.sqrt(x * x + y * y + z * z)
        scale = math.sin(angle / 2.0) / angle if angle > 0.0 else 0.5
        c, x, y, z = math.cos(angle / 2.0), scale * x, scale * y, scale * z
        p, q, r, s = self.turn
        w = p * c - q * x - r * y - s * z
        i = p * x + q * c + r * z - s * y
        j = p * y - q * z + r * c + s * x
        k = p * z + q * y - r * x + s * c
        length = math.sqrt(w * w + i * i + j * j + k * k)
        self.turn = w / length, i / length, j / length, k / length


def mahony(recording: Recording) -> Series:
    """As it is usual: from the first sample on, both errors with one gain."""
    step, time, unit, seen = even(recording)
    expected = recording.expected or (1.0, 0.0)
    first = (1.0, 0.0, 0.0) if seen is None else seen[0]
    one = Mahony(turns.level(-unit[0, :3], first, expected), step, expected)
    fields = [None] * len(time) if seen is None else seen.tolist()
    found = []
    for row, here in zip(unit.tolist(), fields, strict=True):
        one.update(row[:3], row[3:], here)
        found.append(one.turn)
    return Series(time, np.array(found))
