# SPDX-License-Identifier: Apache-2.0
"""Calibration on the virtual clock, with pymavlink on the other side.

Equal runs are equal: nothing here waits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from flight import library
from flight.library import Copter, checks_of
from flight.plants import Plant, Truth
from test_telemetry import Rig, value_in
from toolchain import Toolchain

CALIBRATE, ON, OFF = 7, 2000, 1500  # The pilot's switch.
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


@dataclass
class InHands(Turntable):
    """One with iron aboard. It is turned about all axes in half a minute, if so wanted."""

    iron: tuple[float, float, float] = (0.0, 0.0, 0.0)  # In microtesla.
    turns: bool = False
    now_s: float = 0.0

    def step(self, motors: Sequence[float]) -> None:
        """A millisecond."""
        self.now_s += 0.001 if self.turns else 0.0
        self.plant.step(motors)

    def field(self) -> Sequence[float]:
        """As strong as it is, from each side once, and the iron's, which goes with it."""
        if not self.turns:
            return [one + iron for one, iron in zip(self.plant.field(), self.iron, strict=True)]
        strength = math.hypot(*self.plant.field())
        along = math.cos(math.pi * self.now_s / 30.0)  # From +z to -z.
        around = 2.0 * math.pi * self.now_s / 2.5
        across = math.sqrt(1.0 - along**2)
        seen = (across * math.cos(around), across * math.sin(around), along)
        return [strength * one + iron for one, iron in zip(seen, self.iron, strict=True)]


def with_iron(copter: Copter, iron: tuple[float, float, float],
              memory: Path | None) -> tuple[Rig, InHands]:  # fmt: skip
    """A copter that was powered up with iron aboard."""
    rig = Rig(copter, warm_ms=0, memory=memory)
    flight: Any = rig.flight
    hands = InHands(flight._plant, iron=iron)
    flight._plant = hands
    rig.run(9000)
    return rig, hands


def turn_about(rig: Rig, hands: InHands, milliseconds: int) -> list[str]:
    """The pilot asks for a calibration and turns the copter; what is said when he ends it."""
    begun = len(rig.texts())
    rig.channels[CALIBRATE] = ON
    rig.run(100)
    hands.turns = True
    rig.run(milliseconds)
    rig.channels[CALIBRATE] = OFF
    rig.run(200)
    hands.turns = False
    rig.run(3000)
    return [text for text in rig.texts()[begun:] if text.startswith("magnetometer: ")]


def offsets(rig: Rig) -> list[float]:
    """As the parameters are told."""
    return [value_in(rig, f"MAG_OFF_{axis}") for axis in "XYZ"]


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


IRON = (70.0, -40.0, 110.0)


def test_offsets_of_a_magnetometer_outlive_the_power(copter: Copter, tmp_path: Path) -> None:
    memory = tmp_path / "memory"
    rig, hands = with_iron(copter, IRON, memory)
    assert "magnetometer" in blocking(rig)  # The field is anything but that of the place.
    assert turn_about(rig, hands, 30_000) == ["magnetometer: calibrated"]
    rig.run(8000)
    assert "magnetometer" not in blocking(rig)
    # Noise is 0.3 uT; of a thousand samples near an end the farthest is 3 times that.
    kept = offsets(rig)
    assert kept == pytest.approx(IRON, abs=1.5)
    rig.run(10_000)  # The save.
    again, _ = with_iron(copter, IRON, memory)
    assert offsets(again) == kept
    assert not blocking(again)


def test_a_magnetometer_that_was_turned_too_little_is_turned_on(copter: Copter) -> None:
    rig, hands = with_iron(copter, IRON, None)
    few = ["magnetometer: turn it about all axes"]
    assert turn_about(rig, hands, 10_000) == few
    assert offsets(rig) == [0.0] * 3
    assert turn_about(rig, hands, 20_000) == ["magnetometer: calibrated"]
    assert offsets(rig) == pytest.approx(IRON, abs=1.5)


def test_a_field_that_was_disturbed_is_forgotten(copter: Copter) -> None:
    rig, hands = with_iron(copter, IRON, None)
    rig.channels[CALIBRATE] = ON
    rig.run(200)
    hands.iron = (-70.0, 40.0, -110.0)  # As a magnet does that passes by.
    assert turn_about(rig, hands, 5000) == ["magnetometer: refused, the field is disturbed"]
    hands.iron, hands.now_s = IRON, 0.0
    rig.run(100)
    assert turn_about(rig, hands, 30_000) == ["magnetometer: calibrated"]
    assert offsets(rig) == pytest.approx(IRON, abs=1.5)


def test_iron_that_is_too_near_is_told(copter: Copter) -> None:
    rig, hands = with_iron(copter, (0.0, 170.0, 0.0), None)
    assert turn_about(rig, hands, 30_000) == ["magnetometer: refused, iron is too near"]
    assert offsets(rig) == [0.0] * 3
