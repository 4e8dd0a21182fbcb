# SPDX-License-Identifier: Apache-2.0
"""What devices say: delay, noise, faults. The plant is one that stands still."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from keel.flight import device_frames, sensors
from keel.flight.receivers import RADIO, SATELLITES, Receiver
from keel.flight.scenario import Place, Quality
from keel.flight.sensors import Broken, Inertial, Slow
from keel.plants import wind
from keel.plants.plants import HOME_LATITUDE, HOME_LONGITUDE, NORTH_M, Truth
from keel.plants.power import Battery

REST = [0.0, 0.0, -9.81, 0.0, 0.0, 0.0]
IMU = [
    ("accelerometer", "<f4", (3,)),
    ("gyroscope", "<f4", (3,)),
    ("temperature", "<i2"),
    ("count", "<u4"),
]
MEMORY = [
    ("imu", IMU, (3,)),
    ("magnetometer", [("field", "<f4", (3,)), ("count", "<u4")]),
    ("barometer", [("pressure", "<f4"), ("temperature", "<i2"), ("count", "<u4")]),
    ("receiver", [("byte", "<u4", (512,)), ("at_us", "<u4", (512,)), ("count", "<u4")], (2,)),
    ("power", [("voltage", "<f4"), ("current", "<f4"), ("count", "<u4")], (2,)),
    ("chip", [("supply", "<u2"), ("temperature", "<i2"), ("count", "<u4")]),
]


@dataclass
class Still:
    """A plant that does not move."""

    told: Truth = field(default_factory=Truth)

    def step(self, motors: Any) -> None:
        """It stays."""

    def inertial(self) -> list[float]:
        return REST

    def field(self) -> list[float]:
        return [21.0, 1.0, 43.0]

    def pressure(self) -> float:
        return 96000.0

    def truth(self) -> Truth:
        return self.told

    def blow(self, north: float, east: float, down: float) -> None:
        """Nothing moves it."""


def memory() -> Any:
    """The devices' memory."""
    return np.zeros(1, dtype=MEMORY)[0]


def inertial(quality: Quality = Quality(), seed: int = 5) -> tuple[Any, Inertial]:
    """Three units."""
    there = memory()
    return there, Inertial(there["imu"], np.random.Generator(np.random.PCG64(seed)), quality)


def said(there: Any) -> Any:
    """What the units say: 3 times 6 numbers."""
    return np.hstack([there["imu"]["accelerometer"], there["imu"]["gyroscope"]]).copy()


def test_units_differ_but_not_by_much() -> None:
    there, units = inertial()
    total = np.zeros((3, 6))
    for _ in range(2000):
        units.step(REST, 0.0, Broken())
        total += said(there)
    mean = total / 2000
    assert np.all(np.abs(mean - REST) < [0.12] * 3 + [0.012] * 3)
    assert np.abs(mean[0] - mean[1]).max() > 0.001  # Bias.


def test_a_sample_is_late() -> None:
    there, units = inertial(Quality(noise=0.0, bias=0.0, imu_delay_ms=2))
    heard = []
    for step in range(5):
        units.step([float(step), 0.0, 0.0, 0.0, 0.0, 0.0], 0.0, Broken())
        heard.append(float(there["imu"]["accelerometer"][0][0]))
    assert heard == [0.0, 0.0, 0.0, 1.0, 2.0]


def test_a_frozen_unit_repeats_itself_and_the_others_meet_the_same_noise() -> None:
    (whole, healthy), (broken, sick) = inertial(), inertial()
    for _ in range(10):
        healthy.step(REST, 0.3, Broken())
        sick.step(REST, 0.3, Broken())
    frozen = said(broken)[2]
    for _ in range(1500):  # Beyond a block of noise.
        healthy.step(REST, 0.3, Broken())
        sick.step(REST, 0.3, Broken(frozen={2}))
    assert np.array_equal(said(broken)[2], frozen)
    assert np.array_equal(said(broken)[:2], said(whole)[:2])
    assert broken["imu"]["count"].tolist() == [1510] * 3


def test_a_silent_unit_has_no_samples() -> None:
    there, units = inertial()
    for _ in range(5):
        units.step(REST, 0.0, Broken(silent={0}))
    assert there["imu"]["count"].tolist() == [0, 5, 5]


def test_shouting_is_full_scale_and_drift_is_added() -> None:
    there, units = inertial(Quality(noise=0.0, bias=0.0))
    units.step(REST, 0.0, Broken(shouting={0}, drift={1: 0.5}))
    assert np.abs(said(there)[0]) == pytest.approx([156.9] * 3 + [34.9] * 3, rel=1e-6)
    assert there["imu"]["gyroscope"][1] == pytest.approx([0.5] * 3)


def slow(broken: Broken, milliseconds: int, truth: Truth | None = None) -> Any:
    """The other devices after a time."""
    there = memory()
    devices = Slow(there, np.random.SeedSequence(3), Quality())
    plant, battery = Still(truth or Truth()), Battery(voltage=16.0, current=10.0)
    for now in range(1, milliseconds + 1):
        devices.step(now, plant, battery, broken)
    return there


def last_fix(there: Any) -> Any:
    """The numbers of the last NAV-PVT."""
    sent = there["receiver"][SATELLITES]
    places = np.arange(int(sent["count"]) - 100, int(sent["count"])) % len(sent["byte"])
    message = bytes(sent["byte"][places].tolist())
    assert message == device_frames.ubx(0x01, 0x07, message[6:-2])
    return device_frames.NAV_PVT.unpack(message[6:-2])


def north_of(fix: Any) -> float:
    """In m from home."""
    return float((fix[15] * 1e-7 - HOME_LATITUDE) * NORTH_M)


def sent_by(number: int, noise: float) -> Any:
    """A thousand times ten bytes."""
    there = memory()
    receiver = Receiver(there, number, np.random.Generator(np.random.PCG64(1)))
    for turn in range(1000):
        receiver.send(20_000 * turn, bytes(range(10)), noise)
    return there["receiver"][number]


def test_bytes_come_one_after_the_other() -> None:
    sent = sent_by(RADIO, 0.0)
    assert sent["count"] == 10_000
    last = np.arange(9_990, 10_000) % 512
    assert sent["byte"][last].tolist() == list(range(10))
    assert sent["at_us"][last].tolist() == [19_980_000 + 120 * n for n in range(1, 11)]


def test_a_line_that_is_busy_is_waited_for() -> None:
    there = memory()
    receiver = Receiver(there, SATELLITES, np.random.Generator(np.random.PCG64(1)))
    receiver.send(0, bytes(2))
    receiver.send(100, bytes(1))
    assert there["receiver"][SATELLITES]["at_us"][:3].tolist() == [87, 174, 261]


def test_times_are_counted_modulo_their_word() -> None:
    there = memory()
    receiver = Receiver(there, RADIO, np.random.Generator(np.random.PCG64(1)))
    receiver.send((1 << 32) - 200, bytes(3))
    assert there["receiver"][RADIO]["at_us"][:3].tolist() == [(1 << 32) - 80, 40, 160]


def test_disturbed_bytes() -> None:
    # One in five is lost for good (with parity two), one has others before it, 2.5 in the mean.
    assert sent_by(RADIO, 0.2)["count"] == pytest.approx(10_000 * (1 + 0.05 * (2.5 - 2)), rel=0.02)
    assert sent_by(SATELLITES, 0.2)["count"] == pytest.approx(10_000 * (1 + 0.05 * 1.5), rel=0.02)
    assert np.array_equal(sent_by(RADIO, 0.2)["byte"], sent_by(RADIO, 0.2)["byte"])


def test_a_barometer_that_is_lost_gives_nothing() -> None:
    assert slow(Broken(barometer_lost=True), 10_000)["barometer"]["count"] == 0


def test_a_barometer_that_sticks_gives_samples_that_are_all_the_same() -> None:
    there = memory()
    devices = Slow(there, np.random.SeedSequence(3), Quality())
    plant, battery, broken = Still(Truth()), Battery(voltage=16.0, current=10.0), Broken()
    seen = []
    for now in range(1, 4001):
        broken.barometer_stuck = now > 2000
        devices.step(now, plant, battery, broken)
        seen.append((float(there["barometer"]["pressure"]), int(there["barometer"]["count"])))
    assert len({pressure for pressure, _ in seen[1000:2000]}) == 50
    assert len({pressure for pressure, _ in seen[2000:]}) == 1
    assert seen[-1][1] == pytest.approx(200, abs=1)


def test_a_first_fix_is_off_by_what_is_said() -> None:
    right = last_fix(slow(Broken(), 1000))
    wrong = last_fix(slow(Broken(first_fix=(150.0, 0.0)), 1000))
    assert north_of(wrong) - north_of(right) == pytest.approx(150.0, abs=0.05)


def test_another_place_has_its_own_field_and_degrees() -> None:
    place = Place(latitude=0.0, longitude=103.0, north=40.0, east=0.5, down=-9.0)
    there = memory()
    quiet = Quality(noise=0.0, bias=0.0, field_noise=0.0)
    devices = Slow(there, np.random.SeedSequence(3), quiet, place)
    # Nose east, right wing down by 90 degrees: forward is east, right is down, down is north.
    truth = Truth(place=(100.0, 0.0, 0.0), angles=(math.pi / 2.0, 0.0, math.pi / 2.0))
    plant, battery = Still(truth), Battery(voltage=16.0, current=0.0)
    for now in range(1, 1001):
        devices.step(now, plant, battery, Broken())
    assert there["magnetometer"]["field"].tolist() == pytest.approx([0.5, -9.0, 40.0], abs=1e-4)
    # A degree of latitude is 110.574 km long at the equator (WGS 84).
    assert last_fix(there)[15] * 1e-7 * 110_574.0 == pytest.approx(100.0, abs=1.0)


def test_rates() -> None:
    there = slow(Broken(), 10_000)
    assert there["magnetometer"]["count"] == 1000
    assert there["barometer"]["count"] == 500
    assert there["receiver"]["count"].tolist() == [0, 9900]  # The last fix is still on its way.
    assert there["power"]["count"].tolist() == [1000, 1000]
    assert there["chip"]["count"] == 100


def test_the_barometer_is_warmer_than_the_air() -> None:
    # The standard atmosphere has 960 hPa at 453 m: 15 - 0.0065 * 453 = 12.06 degrees.
    there = slow(Broken(pascal=500.0), 1000)  # A fault of the pressure is none of the temperature.
    assert int(there["barometer"]["temperature"]) == pytest.approx(1206 + 740, abs=1)


def test_the_chip_says_what_it_measures_of_itself() -> None:
    chip = slow(Broken(), 1000)["chip"]
    assert (int(chip["supply"]), int(chip["temperature"])) == (3287, 5130)


def test_the_satellites_tell_where_it_was() -> None:
    place = Truth(latitude=HOME_LATITUDE + 100.0 / NORTH_M, longitude=HOME_LONGITUDE)
    there = slow(Broken(), 1000, place)
    north = north_of(last_fix(there))
    assert north == pytest.approx(100.0, abs=1.0)
    assert last_fix(there)[10] & 3 == 3  # In three dimensions,
    assert last_fix(there)[11] & 1 == 1  # and vouched for.
    jumped = last_fix(slow(Broken(gps_jump=(30.0, 0.0)), 1000, place))
    assert north_of(jumped) - north == pytest.approx(30.0, abs=0.05)
    assert last_fix(slow(Broken(gps_lost=True), 1000))[11] & 1 == 0


def test_modules_share_the_current() -> None:
    power = slow(Broken(), 1000)["power"]
    assert power["current"].sum() == pytest.approx(10.0, abs=0.6)
    assert power["voltage"] == pytest.approx([16.0, 16.03], abs=0.1)


def test_current_disturbs_the_magnetometer() -> None:
    calm, disturbed = slow(Broken(), 500), slow(Broken(microtesla_per_ampere=0.5), 500)
    moved = disturbed["magnetometer"]["field"] - calm["magnetometer"]["field"]
    assert np.linalg.norm(moved) == pytest.approx(5.0, rel=1e-3)


def test_a_battery_sags_and_empties() -> None:
    battery = Battery(capacity_ah=1.0, left=1.0, resistance=0.02)
    battery.step([0.0] * 4, 0.0)
    free = battery.voltage
    battery.step([1.0] * 4, 36.0)  # 72.5 A for a hundredth of an hour.
    assert battery.current == pytest.approx(sensors_current(4))
    assert battery.left == pytest.approx(1.0 - 0.725)
    assert battery.voltage < free - 0.02 * 72.5


def sensors_current(motors: int) -> float:
    """18 A for each motor and half an ampere for the rest."""
    return 18.0 * motors + 0.5


def test_wind_comes_from_where_it_is_said() -> None:
    rng = np.random.Generator(np.random.PCG64(1))
    air = wind.drawn(rng, 10.0, 5.0, 270.0, 0.0)  # From the west: it blows east.
    assert air[:, 1] == pytest.approx(np.full(len(air), 5.0))
    assert np.abs(air[:, 0]).max() < 1e-9


def test_a_gust_is_its_speed_in_its_middle() -> None:
    rng = np.random.Generator(np.random.PCG64(1))
    air = wind.drawn(rng, 10.0, 0.0, 180.0, 0.0, [(2.0, 4.0, 6.0)])
    assert air[400, 0] == pytest.approx(6.0)
    assert air[100, 0] == 0.0 and air[700, 0] == 0.0


def test_turbulence_has_the_strength_that_was_asked_for() -> None:
    rng = np.random.Generator(np.random.PCG64(1))
    gusts = wind.turbulence(rng, 200_000, 5.0, 0.2)
    assert gusts.std(axis=0) == pytest.approx([1.0, 0.8, 0.5], rel=0.15)


def test_a_place_wanders_smoothly() -> None:
    """As far in five times the time as five times as far; and no farther in the end."""
    rng = np.random.Generator(np.random.PCG64(4))
    walk = sensors.Wander(rng, 3.0, 120.0, 0.1, 2, sensors.PLACE_SMOOTH_S)
    places = np.array([walk.step(rng.standard_normal(2)) for _ in range(200_000)])
    assert places.std() == pytest.approx(3.0, rel=0.15)
    runs = {steps: (places[steps:] - places[:-steps]).std() for steps in (2, 10)}
    assert runs[10] == pytest.approx(0.12, abs=0.02)  # 3 m over the root of 120 s times 5 s.
    assert runs[2] == pytest.approx(runs[10] / 5.0, rel=0.1)


def test_wind_is_weaker_near_the_ground() -> None:
    assert wind.sheared(10.0, 0.143) == 1.0
    assert wind.sheared(5.0, 0.143) == pytest.approx(0.9056, abs=1e-4)
    assert wind.sheared(-2.0, 0.143) == wind.sheared(0.3, 0.143) == pytest.approx(0.6057, abs=1e-4)
    assert wind.sheared(-2.0, 0.0) == 1.0


def test_axes_feel_each_other() -> None:
    (plain, square), (there, skewed) = (
        inertial(Quality(noise=0.0, bias=0.0, cross_axis=share)) for share in (0.0, 0.02)
    )
    square.step(REST, 0.0, Broken())
    skewed.step(REST, 0.0, Broken())
    felt = said(there) - said(plain)
    assert 0.01 < np.abs(felt[:, :2]).max() <= 0.02 * 9.81
    assert np.abs(felt[:, 2:]).max() == 0.0  # Gravity is along z alone, and nothing turns.


def field_of(quality: Quality, ampere: float = 0.0) -> Any:
    """What the magnetometer says at rest, with this current."""
    there = memory()
    devices = Slow(there, np.random.SeedSequence(3), quality)
    for now in range(1, 101):
        devices.step(now, Still(), Battery(voltage=16.0, current=ampere), Broken())
    return there["magnetometer"]["field"].copy()


def test_iron_adds_to_the_field() -> None:
    quiet = Quality(noise=0.0, bias=0.0, field_noise=0.0)
    irons = quiet.model_copy(update={"iron": [40.0, -25.0, 3.0]})
    moved = field_of(irons) - field_of(quiet)
    assert moved.tolist() == pytest.approx([40.0, -25.0, 3.0], abs=1e-4)


def test_wires_add_to_the_field_as_their_current_does() -> None:
    wired = Quality(noise=0.0, bias=0.0, field_noise=0.0, field_per_ampere=0.0, wires=[0.3, -1, 2])
    moved = field_of(wired, 20.0) - field_of(wired)
    assert moved.tolist() == pytest.approx([6.0, -20.0, 40.0], abs=1e-4)


@pytest.mark.parametrize(("above_m", "pascal"), [(0.0, 8.0), (0.5, 8.0 / math.e), (20.0, 0.0)])
def test_propellers_press_on_the_barometer_near_the_ground(above_m: float, pascal: float) -> None:
    """20 Pa at full thrust are 8 at two fifths of it."""
    said_by = []
    for wash in (0.0, 20.0):
        there = memory()
        devices = Slow(there, np.random.SeedSequence(3), Quality(wash=wash))
        plant = Still(Truth(place=(0.0, 0.0, 3.0 + above_m), ground=3.0))
        for now in range(1, 101):
            devices.step(now, plant, Battery(), Broken(), 0.4)
        said_by.append(float(there["barometer"]["pressure"]))
    assert said_by[1] - said_by[0] == pytest.approx(pascal, abs=0.02)


def test_full_scale() -> None:
    there, units = inertial(Quality(noise=0.0, bias=0.0))
    units.step([1e6, 0.0, 0.0, -1e6, 0.0, 0.0], 0.0, Broken())
    assert said(there)[0][0] == pytest.approx(sensors.ACCELERATION_LIMIT, rel=1e-6)
    assert said(there)[0][3] == pytest.approx(-sensors.RATE_LIMIT, rel=1e-6)
