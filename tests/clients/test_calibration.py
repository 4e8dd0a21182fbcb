# SPDX-License-Identifier: Apache-2.0
"""Calibration on the virtual clock, with pymavlink on the other side.

Equal runs are equal: nothing here waits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import pytest
from flight import library
from flight.library import Copter, checks_of
from flight.plants import Plant, Truth
from test_telemetry import Rig
from toolchain import Toolchain

TURNS = "not calibrated: it turns, or iron moves nearby"


@pytest.fixture(scope="module")
def copter(tmp_path_factory: pytest.TempPathFactory) -> Copter:
    """The library; what is undefined ends it."""
    flags = ("-O1", "-fsanitize=undefined", "-fno-sanitize-recover=all")
    return Copter(library.build(Toolchain(), tmp_path_factory.mktemp("copter"), more=flags))


@dataclass
class Turntable:
    """A plant that stands in the middle of a turntable, which turns to the right."""

    plant: Plant
    rate: float = 0.0  # In rad/s.
    angle: float = 0.0

    def step(self, motors: Sequence[float]) -> None:
        """A millisecond."""
        self.angle += self.rate / 1000.0
        self.plant.step(motors)

    def inertial(self) -> Sequence[float]:
        """In the middle nothing pulls outwards."""
        *force, roll, pitch, yaw = self.plant.inertial()
        return (*force, roll, pitch, yaw + self.rate)

    def field(self) -> Sequence[float]:
        """What stands still turns to the left."""
        x, y, z = self.plant.field()
        cos, sin = math.cos(self.angle), math.sin(self.angle)
        return (x * cos + y * sin, y * cos - x * sin, z)

    def pressure(self) -> float:
        """As it was."""
        return self.plant.pressure()

    def truth(self) -> Truth:
        """As it was, but for the heading, which nobody asks for."""
        return self.plant.truth()

    def blow(self, north: float, east: float, down: float) -> None:
        """There is no wind."""


def on_a_table(copter: Copter, rate: float, milliseconds: int) -> tuple[Rig, Turntable]:
    """A copter that was powered up on a table that turns."""
    rig = Rig(copter, warm_ms=0)
    flight: Any = rig.flight
    table = Turntable(flight._plant, rate)
    flight._plant = table
    rig.run(milliseconds)
    return rig, table


def blocking(rig: Rig) -> Sequence[str]:
    """The checks that do not hold."""
    rig.copter.look()
    return checks_of(int(rig.copter.view["blocking_checks"]))


@pytest.mark.parametrize("rate", [0.03, -0.08])
def test_a_turntable_is_no_rest(copter: Copter, rate: float) -> None:
    """The greatest offset that is believed is 0.1 rad/s: by gyroscopes alone this is rest."""
    rig, table = on_a_table(copter, rate, 20_000)
    assert "calibration" in blocking(rig)
    heard = rig.texts().count(TURNS)
    assert 1 <= heard <= 4  # Again and again, but not each second.
    table.rate = 0.0
    rig.run(12_000)
    assert not blocking(rig)
    rig.run(10_000)
    assert rig.texts().count(TURNS) <= heard + 1
    rig.copter.look()
    assert rig.copter.view["heading_valid"]
    assert rig.copter.view["bias"] == pytest.approx([0.0] * 3, abs=0.005)


def test_a_table_that_begins_to_turn_is_seen_too(copter: Copter) -> None:
    """Gyroscopes have their samples after 2.5 s; the field has to rest for longer."""
    rig, table = on_a_table(copter, 0.05, 3500)
    table.rate = 0.0
    rig.run(3500)  # For 6 s of rest it is too early, and what was taken while it turned is gone.
    assert "calibration" in blocking(rig)
    rig.run(8000)
    assert not blocking(rig)


def test_rest_is_rest(copter: Copter) -> None:
    rig, _ = on_a_table(copter, 0.0, 10_000)
    assert not blocking(rig)
    assert TURNS not in rig.texts()
