# SPDX-License-Identifier: Apache-2.0
"""Wind: a mean, turbulence as Dryden's spectra have it, and single gusts, drawn before a flight."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

PERIOD_S = 0.01
REFERENCE_M, LEAST_M = 10.0, 0.3  # Where a wind's speed is told; below, it is that of the least.
HEIGHT_M = 6.0  # Dryden's lengths near the ground are about the height; it hardly matters here.


def turbulence(rng: np.random.Generator, count: int, mean: float, strength: float) -> Any:
    """Along, across and up, in m/s: three processes of first order. `strength` is the share of the
    mean that the standard deviation along it is."""
    lengths = np.array([8.0, 8.0, 1.0]) * HEIGHT_M
    deviations = strength * mean * np.array([1.0, 0.8, 0.5])
    keep = np.exp(-PERIOD_S * max(mean, 1.0) / lengths)
    pushes = rng.standard_normal((count, 3)) * deviations * np.sqrt(1.0 - keep**2)
    found = np.empty((count, 3))
    state = deviations * rng.standard_normal(3)
    for number in range(count):
        state = keep * state + pushes[number]
        found[number] = state
    return found


def sheared(height_m: float, exponent: float) -> float:
    """The share of the speed at REFERENCE_M that the wind has so high: the power law."""
    return float((max(height_m, LEAST_M) / REFERENCE_M) ** exponent)


def gust(count: int, start_s: float, length_s: float, speed: float) -> Any:
    """1 - cos, along the wind."""
    time = np.arange(count) * PERIOD_S - start_s
    inside = (time >= 0.0) & (time <= length_s)
    return np.where(inside, speed / 2.0 * (1.0 - np.cos(2.0 * np.pi * time / length_s)), 0.0)


def drawn(
    rng: np.random.Generator,
    duration_s: float,
    speed: float,
    from_deg: float,
    strength: float,
    gusts: Sequence[tuple[float, float, float]] = (),
) -> Any:
    """How the air moves north, east and down every PERIOD_S; `from_deg` is where it comes from."""
    count = int(duration_s / PERIOD_S) + 2
    along_across_up = turbulence(rng, count, speed, strength)
    along = speed + along_across_up[:, 0]
    for start_s, length_s, amount in gusts:
        along = along + gust(count, start_s, length_s, amount)
    to = math.radians(from_deg) + math.pi
    north = math.cos(to) * along - math.sin(to) * along_across_up[:, 1]
    east = math.sin(to) * along + math.cos(to) * along_across_up[:, 1]
    return np.stack([north, east, -along_across_up[:, 2]], axis=1)
