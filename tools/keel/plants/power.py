# SPDX-License-Identifier: Apache-2.0
"""A battery of lithium cells and what the motors draw from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

CELLS = 4
# What a cell has without load, by the part of the charge that is left.
LEFT = (0.0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
CELL_V = (3.2, 3.5, 3.62, 3.7, 3.78, 3.88, 4.02, 4.18)
AVIONICS_A = 0.5
FULL_A = 18.0  # Of a motor at its nominal voltage.
CURRENT_POWER = 2.2
RESISTANCE = 0.02  # When it is new and warm.


@dataclass
class Battery:
    """What is in it; it changes."""

    capacity_ah: float = 5.0
    left: float = 0.95
    resistance: float = RESISTANCE  # In ohm, of all cells.
    voltage: float = 16.0
    current: float = 0.0

    def step(self, motors: Sequence[float], seconds: float) -> None:
        """The motors run so for a time; motors are shares of the nominal voltage."""
        drawn = sum(motor**CURRENT_POWER for motor in motors if motor > 0.0)
        self.current = AVIONICS_A + FULL_A * drawn
        self.left = max(0.0, self.left - self.current * seconds / (3600.0 * self.capacity_ah))
        free = CELLS * float(np.interp(self.left, LEFT, CELL_V))
        self.voltage = max(0.0, free - self.resistance * self.current)
