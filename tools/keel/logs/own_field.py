# SPDX-License-Identifier: Apache-2.0
"""The magnetic field that the battery's current makes, by a log: MAG_CUR_X and so on.

A magnetometer that is fixed to the aircraft measures

    b = o + R^T m + k I

with its own offset o, the Earth's field m in the Earth's frame, the attitude R, and what the
current I adds. `raw` of the log is b: what is in force is taken off behind it. Least squares give
o, m and k. Where the aircraft is held fast and the throttle raised, as on a bench, o and R^T m
cannot be told from one another, which does not matter to k. In flight R has the error of the
heading that the current itself makes: what is left of k is found by another flight with the first
one in force.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from keel.logs.log_plots import columns

if TYPE_CHECKING:
    from keel.timeline.ulog import Log

LEAST = 200  # Samples of the field: 4 s of them.
SPREAD_A = 3.0  # Between the least and the greatest current: with less the answer is noise.


class OwnField(NamedTuple):
    """What a log says."""

    per_ampere: tuple[float, float, float]  # In microtesla per ampere, body axes.
    left: float  # Root of the mean square of what the fit leaves, in microtesla.
    lowest: float  # The currents that it is from, in A.
    highest: float

    def __str__(self) -> str:
        x, y, z = self.per_ampere
        return (
            f"magnetometer: an ampere adds {x:.3f}, {y:.3f}, {z:.3f} uT (MAG_CUR_X, _Y, _Z), by"
            f" {self.lowest:.1f} to {self.highest:.1f} A; {self.left:.2f} uT are left"
        )


def own_field(log: Log) -> OwnField | None:
    """What the current adds; None where the log does not tell."""
    field = columns(log, "compass", "raw")
    energy = columns(log, "energy", "current")
    attitude = columns(log, "attitude", "q")
    if field is None or energy is None or attitude is None:
        return None
    if field[1].shape[1] < 3 or attitude[1].shape[1] < 4:
        return None
    time, raw = field[0], field[1][:, :3]
    current = np.interp(time, energy[0], energy[1][:, 0])
    turn = np.column_stack([np.interp(time, attitude[0], attitude[1][:, i]) for i in range(4)])
    with np.errstate(invalid="ignore"):  # What is no attitude becomes no number.
        turn = turn / np.linalg.norm(turn, axis=1, keepdims=True)
    whole = np.isfinite(np.column_stack([raw, current, turn])).all(axis=1)
    raw, current, turn = raw[whole], current[whole], turn[whole]
    if len(raw) < LEAST or np.ptp(current) < SPREAD_A:
        return None
    found, left = fitted(raw, current, body_from_earth(turn))
    x, y, z = (float(value) for value in found)
    return OwnField((x, y, z), left, float(current.min()), float(current.max()))


def body_from_earth(q: Any) -> Any:
    """R^T of unit quaternions from body to Earth, w first."""
    w, x, y, z = q.T
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
        (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
        (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), 2, 0)


def fitted(raw: Any, current: Any, turn: Any) -> tuple[Any, float]:
    """k, and the root of the mean square of what is left of the field."""
    count = len(raw)
    unit = np.broadcast_to(np.eye(3), (count, 3, 3))
    model = np.concatenate([unit, turn, current[:, None, None] * unit], axis=2)
    model, measured = model.reshape(3 * count, 9), raw.reshape(3 * count)
    answer, _, _, _ = np.linalg.lstsq(model, measured, rcond=None)
    return answer[6:], float(np.sqrt(np.mean((model @ answer - measured) ** 2)))
