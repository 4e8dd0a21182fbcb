# SPDX-License-Identifier: Apache-2.0
"""A plant behind which another one is: for tests that change a little of what it does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from keel.plants.plants import Plant, Truth


@dataclass
class Through:
    """All as the plant behind it has it."""

    plant: Plant

    def step(self, motors: Sequence[float]) -> None:
        """A millisecond."""
        self.plant.step(motors)

    def inertial(self) -> Sequence[float]:
        """Specific force and rate."""
        return self.plant.inertial()

    def field(self) -> Sequence[float]:
        """The magnetic field."""
        return self.plant.field()

    def pressure(self) -> float:
        """Of the air."""
        return self.plant.pressure()

    def truth(self) -> Truth:
        """Where it is."""
        return self.plant.truth()

    def blow(self, north: float, east: float, down: float) -> None:
        """The wind."""
        self.plant.blow(north, east, down)
