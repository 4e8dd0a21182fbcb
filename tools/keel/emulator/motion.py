# SPDX-License-Identifier: Apache-2.0
"""What the inertial units of a modelled board feel, in counts along their own axes."""

from __future__ import annotations

from dataclasses import dataclass

Counts = tuple[int, int, int]
GRAVITY: Counts = (0, 0, 2048)  # 1 g, on the third axis.
STEP = 16  # The smallest that a unit of 12 bits tells.


@dataclass(frozen=True)
class Motion:
    """Without noise a unit counts its samples about its first axis, and turns by one count about
    its third: what it says can be told from what another axis says. Every second sample its force
    differs, as one that repeats itself is stuck. With noise it rests."""

    noise: int = 0  # Counts to both sides; of forces, steps.
    seed: int = 0

    def force(self, sample: int) -> Counts:
        """In 2048ths of g."""
        if self.noise:
            return self._noisy(GRAVITY, sample, 0)
        return (*GRAVITY[:2], GRAVITY[2] + STEP * ((sample - 1) % 2))

    def rate(self, sample: int) -> Counts:
        """In 1 / 16.4 degrees a second."""
        return self._noisy((0, 0, 0), sample, 3) if self.noise else (sample & 0x7F, 0, 1)

    def _noisy(self, values: Counts, sample: int, kind: int) -> Counts:
        span, step = 2 * self.noise + 1, 1 if kind else STEP
        x, y, z = (
            value + step * (mixed(6 * sample + axis + kind, self.seed) % span - self.noise)
            for axis, value in enumerate(values)
        )
        return x, y, z


def mixed(number: int, seed: int) -> int:
    """A number that looks like chance, the same each time: the finalizer of MurmurHash3."""
    word = (number + 0x9E37_79B9 * (seed + 1)) & 0xFFFF_FFFF
    word = (word ^ word >> 16) * 0x85EB_CA6B & 0xFFFF_FFFF
    word = (word ^ word >> 13) * 0xC2B2_AE35 & 0xFFFF_FFFF
    return word ^ word >> 16
