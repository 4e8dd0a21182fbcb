# SPDX-License-Identifier: Apache-2.0
"""What a log says of the field that the battery's current makes.

The logs are made here, of an attitude, a field and a current that are known; one is a flight's.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from keel.flight import loop, scenario
from keel.flight.library import Copter
from keel.flight.loop import Order
from keel.logs.own_field import own_field
from keel.timeline import ulog
from keel.timeline.ulog import Log

EARTH = np.array([21.0, 1.5, 43.0])  # North, east, down, in microtesla.
OFFSET = np.array([12.0, -30.0, 7.0])
PER_AMPERE = np.array([0.6, -0.8, 0.25])
SCENARIOS = Path(__file__).resolve().parents[2] / "examples/copter/scenarios"


def rotation(roll: float, pitch: float, yaw: float) -> Any:
    """From body to Earth: about z, then y, then x, each by its matrix."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def quaternion(roll: float, pitch: float, yaw: float) -> list[float]:
    """The same as w, x, y, z, by half angles."""
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return [
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ]


def rows(**fields: Any) -> Any:
    """A topic's samples."""
    shapes = [(name, "<f8", np.asarray(value).shape[1:]) for name, value in fields.items()]
    data = np.zeros(len(fields["timestamp"]), dtype=shapes)
    for name, value in fields.items():
        data[name] = value
    return data


def log_of(angles: Any, current: Any) -> Log:
    """A log of 50 samples a second."""
    stamps = 20_000.0 * np.arange(len(angles))
    field = [
        rotation(*angle).T @ EARTH + OFFSET + ampere * PER_AMPERE
        for angle, ampere in zip(angles, current, strict=True)
    ]
    log = Log(0)
    log.data[("compass", 0)] = rows(timestamp=stamps, raw=np.array(field))
    log.data[("energy", 0)] = rows(timestamp=stamps, current=current)
    turns = np.array([quaternion(*angle) for angle in angles])
    log.data[("attitude", 0)] = rows(timestamp=stamps, q=turns)
    return log


def raised(count: int) -> Any:
    """The current of a throttle that is raised and lowered."""
    return 10.0 + 9.0 * np.sin(np.linspace(0.0, 9.0, count))


def moved(count: int) -> Any:
    """Roll, pitch and yaw of a flight about all axes."""
    time = np.linspace(0.0, 1.0, count)
    return np.column_stack(
        [0.3 * np.sin(11 * time), 0.25 * np.cos(7 * time), 2.5 * np.sin(3 * time)]
    )


@pytest.mark.parametrize("angles", [moved(600), np.tile([0.02, -0.05, 1.1], (600, 1))])
def test_it_is_found_in_motion_and_on_a_bench(angles: Any) -> None:
    found = own_field(log_of(angles, raised(600)))
    assert found is not None
    assert found.per_ampere == pytest.approx(PER_AMPERE, abs=1e-6)
    assert found.left < 1e-6
    assert (found.lowest, found.highest) == pytest.approx((1.0, 19.0), abs=0.01)
    assert "an ampere adds 0.600, -0.800, 0.250 uT (MAG_CUR_X, _Y, _Z), by 1.0 to 19.0" in str(
        found
    )


def test_a_current_that_does_not_change_tells_nothing() -> None:
    assert own_field(log_of(moved(600), np.full(600, 12.0))) is None
    assert own_field(log_of(moved(100), raised(100))) is None


def test_a_log_without_it_and_numbers_that_are_none_are_no_fault() -> None:
    assert own_field(Log(0)) is None
    log = log_of(moved(600), raised(600))
    log.data[("compass", 0)]["raw"][7] = np.nan
    log.data[("energy", 0)]["current"][300] = np.inf
    found = own_field(log)
    assert found is not None
    assert found.per_ampere == pytest.approx(PER_AMPERE, abs=0.02)
    log.data[("attitude", 0)]["q"][100:103] = 0.0  # A flipped bit's, and no attitude.
    found = own_field(log)
    assert found is not None
    assert found.per_ampere == pytest.approx(PER_AMPERE, abs=0.02)


def test_a_flight_tells_what_its_parameters_leave(copter: Copter, tmp_path: Path) -> None:
    """The current adds 0.6 and -0.8 uT/A, and a hundredth in a direction of the flight's own."""
    told = scenario.read("magnetometer_current_known", SCENARIOS)
    loop.fly(copter, Order(told, "mujoco", 1), tmp_path / "flight.ulg")
    found = own_field(ulog.read(tmp_path / "flight.ulg"))
    assert found is not None
    assert found.per_ampere == pytest.approx((0.6, -0.8, 0.0), abs=0.06)
