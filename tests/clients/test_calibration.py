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

import numpy as np
import pytest
from plant_through import Through
from pymavlink.dialects.v20 import common as mavlink
from test_telemetry import Rig, armed, value_in

from keel.flight.library import Copter, checks_of
from keel.flight.sensors import body_to_earth

ACCEPTED, REJECTED, UNSUPPORTED = 0, 1, 3
PREFLIGHT_CALIBRATION, ARM = 241, 400
G = 9.80665
CALIBRATE, ON, OFF = 7, 2000, 1500  # The pilot's switch.
TURNS = "not calibrated: it turns, or iron moves nearby"


@dataclass
class Turntable(Through):
    """A plant that stands in the middle of a turntable, which turns to the right. Nobody asks for
    its heading."""

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


def with_iron(
    copter: Copter, iron: tuple[float, float, float], memory: Path | None
) -> tuple[Rig, InHands]:
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


@dataclass
class Held(Through):
    """A plant that is held in some way, and its sensors' board is mounted in another.

    The magnetometer is mounted elsewhere, and sees what the plant does.
    """

    mounted: Any  # The matrix that turns what sensors see into the vehicle's axes.
    up: tuple[float, float, float] = (0.0, 0.0, -1.0)  # Which of the vehicle's axes points up.
    shaken: bool = False
    now_ms: int = 0

    def step(self, motors: Sequence[float]) -> None:
        """A millisecond."""
        self.now_ms += 1
        self.plant.step(motors)

    def inertial(self) -> Sequence[float]:
        """Gravity's reaction, upwards, and nothing turns."""
        shake = 3.0 * math.sin(self.now_ms / 50.0) if self.shaken else 0.0
        seen = np.transpose(self.mounted) @ ((G + shake) * np.array(self.up))
        return (*(float(one) for one in seen), 0.0, 0.0, 0.0)

    def blow(self, north: float, east: float, down: float) -> None:
        """There is no wind."""


SIDES = {
    "down": (0.0, 0.0, -1.0),
    "up": (0.0, 0.0, 1.0),
    "left": (0.0, 1.0, 0.0),
    "right": (0.0, -1.0, 0.0),
    "front": (-1.0, 0.0, 0.0),
    "back": (1.0, 0.0, 0.0),
}
OFFSET = np.array([[0.6, -0.4, 0.8], [-0.5, 0.7, 0.3], [0.2, 0.1, -0.9]])
SCALE = np.array([[1.03, 0.98, 1.02], [0.97, 1.01, 1.04], [1.0, 1.02, 0.96]])


def with_errors(
    copter: Copter, memory: Path | None, angles: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> tuple[Rig, Held]:
    """A copter whose accelerometers have these offsets and scales, and nothing else is wrong."""
    rig = Rig(copter, warm_ms=0, memory=memory)
    flight: Any = rig.flight
    held = Held(flight._plant, body_to_earth(*angles))
    flight._plant = held
    units = flight._inertial
    units._bias[:] = np.hstack([OFFSET, np.zeros((3, 3))]).reshape(-1)
    units._turn[:] = 0.0
    for unit in range(3):
        units._turn[6 * unit : 6 * unit + 6, :] = np.diag([*SCALE[unit], 1.0, 1.0, 1.0])
    rig.run(2000)
    return rig, held


def cal_texts(rig: Rig, begun: int) -> list[str]:
    """What stations see of a calibration."""
    return [text for text in rig.texts()[begun:] if text.startswith("[cal] ")]


def corrections(rig: Rig) -> tuple[Any, Any]:
    """Offsets and scales as the parameters are told."""
    told = [
        [[value_in(rig, f"ACC{unit}_{what}_{axis}") for axis in "XYZ"] for unit in (1, 2, 3)]
        for what in ("OFF", "SCALE")
    ]
    return np.array(told[0]), np.array(told[1])


def six_sides(rig: Rig, held: Held, sides: Sequence[str]) -> None:
    """Put on each side, shaken in between."""
    for side in sides:
        held.shaken = True
        rig.run(700)
        held.shaken = False
        held.up = SIDES[side]
        rig.run(3500)


def test_six_sides_are_offset_and_scale(copter: Copter, tmp_path: Path) -> None:
    memory = tmp_path / "memory"
    rig, held = with_errors(copter, memory)
    begun = len(rig.texts())
    assert rig.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 1) == ACCEPTED
    assert rig.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 1) == REJECTED  # It goes on.
    six_sides(rig, held, list(SIDES))
    rig.run(2000)
    expected = ["[cal] calibration started: 2 accel"]
    for number, side in enumerate(SIDES, 1):
        expected += [
            f"[cal] {side} orientation detected",
            f"[cal] {side} side done, rotate to a different side"[:50],
            f"[cal] progress <{round(100 * number / 6)}>",
        ]
    assert cal_texts(rig, begun) == [*expected, "[cal] calibration done: accel"]
    offset, scale = corrections(rig)
    # A unit says scale * true + offset; noise of a mean of 40 is 0.006 m/s^2 at most.
    assert np.abs(offset - OFFSET).max() < 0.02
    assert np.abs(scale - 1.0 / SCALE).max() < 0.002
    held.up = SIDES["down"]
    rig.run(9000)
    rig.copter.look()
    assert rig.copter.view["vote"][:3] == pytest.approx([0.0, 0.0, -G], abs=0.15)
    rig.run(5000)  # The save.
    again, _ = with_errors(copter, memory)
    assert np.array_equal(corrections(again)[0], offset)
    again.run(9000)
    again.copter.look()
    assert again.copter.view["vote"][:3] == pytest.approx([0.0, 0.0, -G], abs=0.15)


def test_a_side_that_was_seen_is_not_seen_again(copter: Copter) -> None:
    rig, held = with_errors(copter, None)
    begun = len(rig.texts())
    assert rig.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 1) == ACCEPTED
    six_sides(rig, held, ["down", "left", "down"])
    assert [text for text in cal_texts(rig, begun) if "side done" in text] == [
        "[cal] down side done, rotate to a different side",
        "[cal] left side done, rotate to a different side",
    ]
    assert "calibration" in blocking(rig)
    assert rig.ask(PREFLIGHT_CALIBRATION) == ACCEPTED  # Ends it.
    rig.run(500)
    assert cal_texts(rig, begun)[-1] == "[cal] calibration cancelled"
    assert corrections(rig)[0].tolist() == np.zeros((3, 3)).tolist()


def test_what_leans_is_no_side_and_patience_ends(copter: Copter) -> None:
    rig, held = with_errors(copter, None)
    begun = len(rig.texts())
    held.up = (0.0, -0.3, -0.954)  # By 17 degrees.
    assert rig.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 1) == ACCEPTED
    rig.run(121_000)
    assert cal_texts(rig, begun)[1:] == ["[cal] calibration failed: accel"]
    assert "not calibrated: it did not rest for two minutes" in rig.texts()[begun:]


def test_a_unit_beyond_limits_is_refused(copter: Copter) -> None:
    rig, held = with_errors(copter, None)
    flight: Any = rig.flight
    flight._inertial._turn[12:18, :] = np.diag([1.0, 0.85, 1.0, 1.0, 1.0, 1.0])
    begun = len(rig.texts())
    assert rig.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 1) == ACCEPTED
    six_sides(rig, held, list(SIDES))
    assert cal_texts(rig, begun)[-1] == "[cal] calibration failed: accel"
    assert "not calibrated: what was found is beyond limits" in rig.texts()[begun:]
    assert corrections(rig)[1].tolist() == np.ones((3, 3)).tolist()


def test_level_is_how_the_sensors_are_mounted(copter: Copter, tmp_path: Path) -> None:
    """Rolled by 5 degrees, nose down by 4."""
    roll, pitch = math.radians(5.0), -math.radians(4.0)
    rig, held = with_errors(copter, tmp_path / "memory", (roll, pitch, 0.0))
    flight: Any = rig.flight
    flight._inertial._bias[:] = 0.0
    flight._inertial._turn[:] = np.vstack([np.eye(6)] * 3)
    rig.run(8000)
    begun = len(rig.texts())
    assert rig.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 2) == ACCEPTED
    held.shaken = True
    rig.run(3000)
    assert cal_texts(rig, begun) == ["[cal] calibration started: 2 level"]
    held.shaken = False
    rig.run(3000)
    assert cal_texts(rig, begun)[1:] == ["[cal] calibration done: level"]
    assert value_in(rig, "TRIM_ROLL") == pytest.approx(roll, abs=0.002)
    assert value_in(rig, "TRIM_PITCH") == pytest.approx(pitch, abs=0.002)
    rig.run(10_000)
    rig.copter.look()
    assert rig.copter.view["vote"][:3] == pytest.approx([0.0, 0.0, -G], abs=0.03)


def test_a_board_may_be_mounted_any_way(copter: Copter, tmp_path: Path) -> None:
    """Turned by 90 degrees to the right and upside down: level is level, and right is right."""
    memory = tmp_path / "memory"
    roll, yaw = math.pi, math.pi / 2.0
    rig, _ = with_errors(copter, memory)
    for name, value in (("BOARD_ROLL", roll), ("BOARD_YAW", yaw)):
        rig.send(mavlink.MAVLink_param_set_message(1, 1, name.encode(), value, 9))
        rig.run(300)
    rig.run(8000)  # The save.
    again, held = with_errors(copter, memory, (roll, 0.0, yaw))
    flight: Any = again.flight
    flight._inertial._bias[:] = 0.0
    flight._inertial._turn[:] = np.vstack([np.eye(6)] * 3)
    again.run(1000)
    again.copter.look()
    assert again.copter.view["vote"][:3] == pytest.approx([0.0, 0.0, -G], abs=0.1)
    begun = len(again.texts())
    assert again.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 1) == ACCEPTED
    six_sides(again, held, ["right", "front"])
    assert [text for text in cal_texts(again, begun) if "side done" in text] == [
        "[cal] right side done, rotate to a different side",
        "[cal] front side done, rotate to a different side",
    ]


def test_armed_nothing_is_calibrated(copter: Copter) -> None:
    rig = Rig(copter)
    assert rig.ask(PREFLIGHT_CALIBRATION, 1) == UNSUPPORTED  # Gyroscopes do so by themselves.
    armed(rig)
    assert rig.ask(PREFLIGHT_CALIBRATION, 0, 0, 0, 0, 1) == REJECTED
    rig.run(500)
    assert "not calibrated: armed" in rig.texts()
