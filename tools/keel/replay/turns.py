# SPDX-License-Identifier: Apache-2.0
"""Quaternions w, x, y, z, a row each, in double precision."""

from __future__ import annotations

from typing import Any

import numpy as np


def times(first: Any, second: Any) -> Any:
    """The turn `second`, then `first`."""
    a, b, c, d = np.moveaxis(np.asarray(first, float), -1, 0)
    w, x, y, z = np.moveaxis(np.asarray(second, float), -1, 0)
    return np.stack(
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ],
        -1,
    )


def back(turn: Any) -> Any:
    """The turn the other way round."""
    return np.asarray(turn, float) * (1.0, -1.0, -1.0, -1.0)


def turned(turn: Any, vector: Any) -> Any:
    """Vectors, turned."""
    wide = np.concatenate([np.zeros((*np.shape(vector)[:-1], 1)), vector], -1)
    return times(times(turn, wide), back(turn))[..., 1:]


def between(turn: Any, time: Any, at: Any) -> Any:
    """Attitudes at other times: the nearest two, weighed, and made a unit's length again."""
    place = np.clip(np.searchsorted(time, at), 1, len(time) - 1)
    share = np.clip((at - time[place - 1]) / (time[place] - time[place - 1]), 0.0, 1.0)[:, None]
    before, after = turn[place - 1], turn[place]
    sign = np.where((before * after).sum(1) < 0.0, -1.0, 1.0)[:, None]
    mixed = (1.0 - share) * before + share * sign * after
    return mixed / np.linalg.norm(mixed, axis=1, keepdims=True)


def apart(estimate: Any, reference: Any) -> tuple[Any, Any]:
    """How far attitudes are apart, in degrees: in inclination, and in heading. The turn from one
    to the other, seen from the Earth, is one about a level axis, then one about the vertical."""
    w, x, y, z = times(estimate, back(reference)).T
    tilt = 2.0 * np.degrees(np.arctan2(np.hypot(x, y), np.hypot(w, z)))
    turn = 2.0 * np.degrees(np.arctan2(z, w))
    return tilt, (turn + 180.0) % 360.0 - 180.0


def level(down: Any, field: Any, expected: tuple[float, float]) -> Any:
    """The attitude in which down, and a field whose horizontal part is expected, are as seen."""
    d = np.asarray(down, float) / np.linalg.norm(down)
    seen = np.asarray(field, float) - d * (d @ np.asarray(field, float))
    if not np.linalg.norm(seen) > 0.0:
        seen = np.cross(d, (0.0, 1.0, 0.0) if abs(d[1]) < 0.9 else (0.0, 0.0, 1.0)) * -1.0
    along = seen / np.linalg.norm(seen)
    angle = np.arctan2(expected[1], expected[0])
    north = np.cos(angle) * along - np.sin(angle) * np.cross(d, along)
    return of_rows(np.array([north, np.cross(d, north), d]))


def of_rows(matrix: Any) -> Any:
    """The quaternion of a matrix from body to Earth."""
    m = np.asarray(matrix, float)
    outer = np.array(
        [
            [m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
            [0, m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
            [0, 0, m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1]],
            [0, 0, 0, m[2, 2] - m[0, 0] - m[1, 1]],
        ]
    )
    return np.linalg.eigh(outer, UPLO="U")[1][:, 3]
