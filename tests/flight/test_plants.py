# SPDX-License-Identifier: Apache-2.0
"""The plants: frames, signs, the order of motors, wind and what sensors say, by hand."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest

from keel.base.errors import ToolError
from keel.flight import loop
from keel.plants import plants
from keel.plants.jsbsim_plant import on_skids
from keel.plants.plants import Airframe, Ground, Plant, Truth

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


@BOTH
def test_a_mass_in_front_puts_the_nose_down_and_one_on_the_right_that_side(name: str) -> None:
    """Thrust acts behind it, or to its left: at 13.7 N, 1 cm is 0.14 N m, 7.2 rad/s^2 of pitch."""
    made_ones = [made(name, 0.0, Airframe(forward_m=0.01)), made(name, 0.0, Airframe(right_m=0.01))]
    for plant in made_ones:
        run(plant, [1.2 * HOVER] * 4, 250)
    ahead, right = (plant.inertial()[3:] for plant in made_ones)
    assert ahead[1] < -0.2 and abs(ahead[0]) < 0.1 * abs(ahead[1])
    assert right[0] > 0.2 and abs(right[1]) < 0.2 * right[0]


@pytest.mark.parametrize(("heading_deg", "pitch", "roll"), [(60.0, -1, 0), (150.0, 0, -1)])
def test_on_a_slope_it_stands_as_the_slope_does(heading_deg: float, pitch: int, roll: int) -> None:
    """Nose downhill it looks down; with the hill on its right its left wing is low: a force along
    the body of g sin 10 degrees."""
    ground = Ground(slope_deg=10.0, towards_deg=60.0)
    plant = plants.make("mujoco", Airframe(), heading_deg, ground)
    truth = run(plant, [0.0] * 4, 500)
    steep = math.radians(10.0)
    assert truth.angles[1] == pytest.approx(pitch * steep, abs=0.01)
    assert truth.angles[0] == pytest.approx(roll * steep, abs=0.01)
    x, y, z = plant.inertial()[:3]
    assert x == pytest.approx(pitch * 9.81 * math.sin(steep), abs=0.05)
    assert y == pytest.approx(-roll * 9.81 * math.sin(steep), abs=0.05)
    assert z == pytest.approx(-9.81 * math.cos(steep), abs=0.05)
    assert truth.place[2] - truth.ground == pytest.approx(0.0, abs=0.01)


def test_the_ground_lies_lower_where_it_falls_to() -> None:
    ground = Ground(slope_deg=10.0, towards_deg=0.0)
    plant = plants.make("mujoco", Airframe(), 0.0, ground)
    truth = run(plant, [1.2 * HOVER] * 4, 2000)  # Its thrust leans downhill, to the north.
    north = truth.place[0]
    assert north > 0.3
    # As it stands on it: legs of 0.1524 m are across the slope.
    stands = -north * math.tan(math.radians(10.0))
    assert truth.ground == pytest.approx(stands + 0.1524 * 0.0154, abs=0.05)


def test_a_deck_carries_it_up_and_down_and_rolls_it_and_ends_level() -> None:
    deck = Ground(heave_m=0.3, roll_deg=4.0, period_s=4.0, from_s=1.0, until_s=13.0)
    plant = plants.make("mujoco", Airframe(), 90.0, deck)  # Nose east, the deck rolls northward.
    heights, rolls = [], []
    for _ in range(15_000):
        plant.step([0.0] * 4)
        truth = plant.truth()
        heights.append(truth.place[2])
        rolls.append(math.degrees(truth.angles[0]))
        assert abs(truth.place[2] - truth.ground) < 0.03
    assert max(map(abs, heights[:1000])) < 0.01
    assert max(heights) == pytest.approx(0.3, abs=0.05) == -min(heights)
    assert max(map(abs, rolls)) == pytest.approx(4.0, abs=0.5)
    assert max(map(abs, heights[-500:])) < 0.01 and max(map(abs, rolls[-500:])) < 0.3


def test_jsbsim_has_no_slope() -> None:
    with pytest.raises(ToolError, match="level ground only"):
        plants.make("jsbsim", Airframe(), 0.0, Ground(slope_deg=5.0))


def test_speed_controllers_begin_late() -> None:
    told = loop.delayed(Airframe(esc_ms=3))
    heard = []
    for number in range(1, 7):
        told.append([float(number)] * 4)
        heard.append(told[0][0])
    assert heard == [0.0, 0.0, 0.0, 1.0, 2.0, 3.0]


@pytest.mark.parametrize("from_deg", range(0, 360, 45))
def test_wind_does_not_blow_it_over(from_deg: int) -> None:
    """Its skids are 0.10 m away from its centre of mass on every side, which is 0.15 m above them:
    it takes two thirds of its weight. Over an edge between three legs three tenths did."""
    plant = made("jsbsim", 0.0, Airframe(drag=2.0))
    way = math.radians(from_deg)
    plant.blow(16.0 * math.cos(way), 16.0 * math.sin(way), 0.0)
    roll, pitch, _ = run(plant, [0.05] * 4, 2500).angles
    assert max(abs(roll), abs(pitch)) < math.radians(1.0)


def test_legs_that_are_not_those_known_are_refused() -> None:
    with pytest.raises(ToolError, match="Gear.xml of JSBSim's F450 has no"):
        on_skids("Gear.xml", '<contact name="Front_Left" type="BOGEY"></contact>')


@BOTH
def test_wind_does_not_move_what_stands(name: str) -> None:
    """Legs are no wheels: 10 m/s push with less than a fifth of what friction holds."""
    plant = made(name)
    before = plant.truth().place
    plant.blow(10.0, 0.0, 0.0)
    after = run(plant, [0.0] * 4, 3000).place
    assert math.dist(before, after) < 0.02
