# SPDX-License-Identifier: Apache-2.0
"""An aircraft that lies on its side has its motors stopped, and one that flies has not."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from keel.flight import loop, scenario
from keel.flight.library import Copter
from keel.flight.loop import Order
from keel.plants import plants
from keel.plants.plants import Plant, Truth

HOVERS = """description = "hovers"
duration_s = 14.0
mode = "altitude"

[[pilot]]
at_s = 0.5
height_m = 2.0

[limits]
from_s = 0.0
end = { on_ground = false, motors_on = true }
"""
G = 9.80665
TURN_S, RATE = 1.0, math.radians(100.0)  # It rolls to 100 degrees, and lies there.


class Tipped:
    """A plant that hits something at a time, rolls over, and lies still from then on.

    The truth that is told stays as it was, so that the flight is not broken off.
    """

    def __init__(self, plant: Plant, at_ms: int) -> None:
        self.plant, self.at_ms, self.now_ms = plant, at_ms, 0
        self.field_before: Sequence[float] = plant.field()
        self.pressure_before = plant.pressure()
        self.truth_before = plant.truth()

    @property
    def since_s(self) -> float:
        """Since it was hit; negative before."""
        return (self.now_ms - self.at_ms) / 1000.0

    def step(self, motors: Sequence[float]) -> None:
        """A millisecond."""
        self.now_ms += 1
        if self.since_s < 0.0:
            self.plant.step(motors)
            self.field_before = [float(one) for one in self.plant.field()]
            self.pressure_before, self.truth_before = self.plant.pressure(), self.plant.truth()

    def inertial(self) -> Sequence[float]:
        """The ground carries it; on its side it does so sideways."""
        if self.since_s < 0.0:
            return self.plant.inertial()
        turning = self.since_s < TURN_S
        roll = RATE * min(self.since_s, TURN_S)
        rate = RATE if turning else 0.0
        return (0.0, -G * math.sin(roll), -G * math.cos(roll), rate, 0.0, 0.0)

    def field(self) -> Sequence[float]:
        """The field as it was, turned with the body."""
        if self.since_s < 0.0:
            return self.plant.field()
        roll = RATE * min(self.since_s, TURN_S)
        x, y, z = self.field_before
        return (x, y * math.cos(roll) + z * math.sin(roll), z * math.cos(roll) - y * math.sin(roll))

    def pressure(self) -> float:
        """It stays where it is."""
        return self.plant.pressure() if self.since_s < 0.0 else self.pressure_before

    def truth(self) -> Truth:
        """As it was when it was hit, but standing."""
        return (
            self.plant.truth()
            if self.since_s < 0.0
            else replace(self.truth_before, speed=(0.0, 0.0, 0.0))
        )

    def blow(self, north: float, east: float, down: float) -> None:
        """Nothing moves it any more."""
        if self.since_s < 0.0:
            self.plant.blow(north, east, down)


def flown(copter: Copter, folder: Path, monkeypatch: pytest.MonkeyPatch, at_ms: int) -> loop.Trace:
    """The flight of HOVERS, hit then."""
    (folder / "hovers.toml").write_text(HOVERS)
    make = plants.make
    monkeypatch.setattr(plants, "make", lambda *words: Tipped(make(*words), at_ms))
    order = Order(scenario.read("hovers", folder), "mujoco", 1)
    return loop.fly(copter, order)


def test_motors_stop_two_seconds_after_it_lies_on_its_side(
    copter: Copter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trace = flown(copter, tmp_path, monkeypatch, 14_000)
    hit_s = 14.0 - trace.armed_s
    turning = trace.view["motor"].max(axis=1) > 0.0
    times = trace.column("time")
    stopped = times[~turning & (times > hit_s)]
    assert turning[(times > 0.1) & (times < hit_s)].all()
    # It lies from TURN_S on; two seconds later, and a step of navigation and one of the control.
    assert stopped[0] == pytest.approx(hit_s + TURN_S + 2.0, abs=0.3)
    assert not turning[times >= stopped[0]].any()


def test_one_that_flies_goes_on(
    copter: Copter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trace = flown(copter, tmp_path, monkeypatch, 10**9)
    assert (trace.view["motor"].max(axis=1) > 0.0)[trace.column("time") > 0.1].all()
