# SPDX-License-Identifier: Apache-2.0
"""The plants: frames, signs, the order of motors, wind and what sensors say, by hand."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest

from keel.plants import plants
from keel.plants.plants import Airframe, Plant, Truth

HOVER = 0.41
BOTH = pytest.mark.parametrize("name", plants.NAMES)
# Of front right, aft right, aft left and front left: what a little more of one does.
ROLLS, PITCHES, YAWS = (-1, -1, 1, 1), (1, -1, -1, 1), (1, -1, 1, -1)


def made(name: str, heading_deg: float = 0.0, airframe: Airframe | None = None) -> Plant:
    """A plant that has settled on the ground."""
    plant = plants.make(name, airframe or Airframe(), heading_deg)
    run(plant, [0.0] * 4, 500)
    return plant


def run(plant: Plant, motors: Sequence[float], steps: int) -> Truth:
    """Some milliseconds with these motors."""
    for _ in range(steps):
        plant.step(motors)
    return plant.truth()


@BOTH
def test_at_rest_gravity_is_up_against_the_body(name: str) -> None:
    x, y, z, *rate = made(name).inertial()
    assert z == pytest.approx(-9.81, abs=0.02)
    assert math.hypot(x, y) < 0.1  # The F450's legs let it stand a third of a degree nose down.
    assert max(map(abs, rate)) < 0.001


@BOTH
def test_it_stands_where_it_was_put(name: str) -> None:
    truth = made(name, 90.0).truth()
    assert max(map(abs, truth.place)) < 0.01
    assert truth.angles[2] == pytest.approx(math.pi / 2, abs=0.01)
    assert truth.latitude == pytest.approx(plants.HOME_LATITUDE, abs=1e-6)


@BOTH
def test_the_field_points_north_and_down(name: str) -> None:
    x, y, z = made(name, 0.0).field()
    assert 18 < x < 25 and abs(y) < 3 and 38 < z < 48
    x, y, _ = made(name, 90.0).field()  # Nose east: north is on its left.
    assert abs(x) < 3 and -25 < y < -18


@BOTH
@pytest.mark.parametrize("motor", range(4))
def test_what_each_motor_does(name: str, motor: int) -> None:
    plant = made(name)
    run(plant, [1.2 * HOVER] * 4, 800)
    before = plant.inertial()[3:]
    run(plant, [1.2 * HOVER + (0.1 if number == motor else 0.0) for number in range(4)], 100)
    turned = [after - was for after, was in zip(plant.inertial()[3:], before, strict=True)]
    for rate, signs in zip(turned, (ROLLS, PITCHES, YAWS), strict=True):
        assert rate * signs[motor] > 0.01


@BOTH
def test_it_climbs_with_more_and_pressure_falls(name: str) -> None:
    plant = made(name)
    below = plant.pressure()
    truth = run(plant, [1.2 * HOVER] * 4, 2000)
    assert truth.place[2] > 1.0 and truth.speed[2] > 0.5
    # Near the ground 12 Pa for each metre.
    assert below - plant.pressure() == pytest.approx(11.4 * truth.place[2], rel=0.1)


@BOTH
def test_wind_carries_it_along(name: str) -> None:
    calm, windy = made(name, 45.0), made(name, 45.0)
    windy.blow(3.0, -5.0, 0.0)
    places = [run(plant, [1.15 * HOVER] * 4, 1200).place for plant in (calm, windy)]
    assert places[1][0] > places[0][0] + 0.02 and places[1][1] < places[0][1] - 0.02


@BOTH
def test_a_tilt_to_the_right_goes_to_the_right(name: str) -> None:
    plant = made(name, 90.0)  # Nose east: right is south.
    run(plant, [1.2 * HOVER] * 4, 600)
    left, right = 1.2 * HOVER + 0.02, 1.2 * HOVER - 0.02
    truth = run(plant, [right, right, left, left], 250)
    assert truth.angles[0] > 0.02
    assert run(plant, [1.2 * HOVER] * 4, 300).speed[0] < -0.05


@BOTH
def test_a_heavier_one_climbs_less(name: str) -> None:
    light, heavy = (
        run(made(name, 0.0, Airframe(mass=mass)), [1.3 * HOVER] * 4, 1200).place[2]
        for mass in (0.9, 1.2)
    )
    assert light > heavy + 0.2


@BOTH
def test_equal_flights_are_equal(name: str) -> None:
    ends = [run(made(name), [0.45, 0.46, 0.44, 0.45], 700) for _ in range(2)]
    assert ends[0] == ends[1]
