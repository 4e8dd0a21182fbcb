# SPDX-License-Identifier: Apache-2.0
"""An aircraft that something carries lets go of its motors, and takes them up when it falls."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from plant_through import Through

from keel.flight import loop, scenario
from keel.flight.library import Copter, states
from keel.flight.loop import Order
from keel.plants import plants
from keel.plants.mujoco_plant import MujocoPlant

LANDS = """description = "lands"
duration_s = 30.0
mode = "position"

[[pilot]]
at_s = 0.5
height_m = 8.0

[[pilot]]
at_s = 12.0
mode = "land"

[limits]
from_s = 0.0
end = { state = "disarmed" }
"""
G = 9.80665
CAUGHT_M, IDLE = 6.0, 0.1  # It is caught on its way down; motors that turn so do not carry it.
HANDS_MS = 60  # So long after its motors idle the hand lets go: before it has landed for a second.


class Caught(Through):
    """A plant that a hand catches once, at a height on the way down, and lets go of again."""

    def __init__(self, plant: MujocoPlant) -> None:
        super().__init__(plant)
        self.moving = plant  # As MuJoCo has it: its speed can be taken from it.
        self.highest = 0.0
        self.holds, self.held_ms, self.idle_ms, self.let_go = False, 0, 0, False

    def step(self, motors: Sequence[float]) -> None:
        """A millisecond. While it is held it stays, as the plant's world does."""
        truth = self.plant.truth()
        self.highest = max(self.highest, truth.place[2])
        if not self.let_go and self.highest > 7.0 and truth.place[2] < CAUGHT_M:
            self.holds = True
            self.moving._velocity[:] = 0.0  # The hand took its speed.
        if not self.holds:
            self.plant.step(motors)
            return
        self.held_ms += 1
        self.idle_ms = self.idle_ms + 1 if max(motors) < IDLE else 0
        self.let_go = self.idle_ms >= HANDS_MS
        self.holds = not self.let_go

    def inertial(self) -> Sequence[float]:
        """A hand carries it as the ground would."""
        if not self.holds:
            return self.plant.inertial()
        roll, pitch, _ = self.plant.truth().angles
        level = math.cos(pitch)
        return (
            G * math.sin(pitch),
            -G * math.sin(roll) * level,
            -G * math.cos(roll) * level,
            0.0,
            0.0,
            0.0,
        )


def test_what_is_caught_idles_and_what_falls_flies(
    copter: Copter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "lands.toml").write_text(LANDS)
    made: list[Caught] = []
    make = plants.make

    def caught(*words: object) -> Caught:
        made.append(Caught(make(*words)))  # type: ignore[arg-type]
        return made[-1]

    monkeypatch.setattr(plants, "make", caught)
    trace = loop.fly(copter, Order(scenario.read("lands", tmp_path), "mujoco", 1))
    assert not trace.crash and not trace.problem
    (plant,) = made
    assert plant.let_go and plant.held_ms < 3000
    lands = trace.column("time") > 12.0
    up, speed = trace.column("up")[lands], trace.column("v_up")[lands]
    # A fall of 0.35 s gives 3.4 m/s; a little later the motors have it again.
    assert -4.0 < speed.min() < -1.0
    assert up[np.argmin(speed)] > CAUGHT_M - 1.5
    assert np.abs(speed[up < 0.1]).max() < 1.0
    assert states()[trace.view["state"][-1]] == "disarmed"
