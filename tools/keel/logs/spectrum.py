# SPDX-License-Identifier: Apache-2.0
"""The spectrum of a signal: at which frequencies it shakes, and how much (the paper's fig. 13)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

LENGTH = 1024  # Samples of a piece; half of it is in the next one, too.
AROUND = 3  # Lines to each side over which a window spreads a peak.
OUTSTANDS = 4.0  # A peak is that much above the median of all lines.


@dataclass(frozen=True)
class Spectrum:
    """Amplitudes by frequency: a sine of amplitude a shows as a at its frequency."""

    frequency: Any  # In Hz.
    amplitude: Any  # In the signal's unit, the root mean square over pieces.

    def peaks(self, count: int) -> list[tuple[float, float]]:
        """The frequencies that stand out, the strongest first, with their amplitudes."""
        left = self.amplitude.copy()
        left[:AROUND] = 0.0  # What does not move is no vibration.
        least = OUTSTANDS * float(np.median(self.amplitude))
        found: list[tuple[float, float]] = []
        while len(found) < count and left.max() > least:
            at = int(left.argmax())
            found.append((float(self.frequency[at]), float(self.amplitude[at])))
            left[max(0, at - AROUND) : at + AROUND + 1] = 0.0
        return found


def rate_of(time_us: Any) -> float:
    """Samples per second, by the usual time between two; 0 when that is none."""
    period_us = float(np.median(np.diff(time_us.astype(float))))
    return 1e6 / period_us if period_us > 0.0 else 0.0


def spectrum(values: Any, rate_hz: float) -> Spectrum:
    """Of evenly sampled values: Welch's mean over pieces that overlap by half, windowed by Hann."""
    length = min(LENGTH, len(values))
    window = np.hanning(length)
    starts = range(0, len(values) - length + 1, max(1, length // 2))
    pieces = np.array([values[start : start + length] for start in starts], dtype=np.float64)
    lines = np.fft.rfft((pieces - pieces.mean(axis=1, keepdims=True)) * window)
    power = np.mean(np.abs(lines) ** 2, axis=0)
    return Spectrum(np.fft.rfftfreq(length, 1.0 / rate_hz), 2.0 * np.sqrt(power) / window.sum())
