# SPDX-License-Identifier: Apache-2.0
"""What every plant can do, and what it may be told to be.

Frames are those of the copter: body is forward, right, down; Earth is north, east, down, but places
and speeds are told as north, east, up from where the flight began.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from keel.base.errors import ToolError

STEP_S = 0.001
MOTORS = 4  # Front right, aft right, aft left, front left.

HOME_LATITUDE = 47.3977  # Degrees; any place will do.
HOME_LONGITUDE = 8.5456
HOME_ALTITUDE_M = 430.0

NOMINAL_V = 14.63  # For which JSBSim's motors are given: four cells in the middle of their charge.
THRUST_POWER = 1.69  # Thrust goes about with this power of a motor's command.

# WGS 84.
EQUATOR_M = 6378137.0
FLATNESS = 1.0 / 298.257223563


@dataclass(frozen=True)
class Airframe:
    """What may differ from the F450 as its authors describe it: factors, where no unit is said."""

    mass: float = 1.0
    inertia: float = 1.0
    motor_speed: float = 1.0  # Turns per volt.
    motor_lag: float = 1.0
    drag: float = 1.0
    motors: tuple[float, ...] = (1.0,) * MOTORS  # Of the thrust of each.
    forward_m: float = 0.0  # Where the centre of mass is, from the middle of the motors.
    right_m: float = 0.0
    esc_ms: int = 0  # After which speed controllers begin to do what they were told.


@dataclass(frozen=True)
class Ground:
    """What the aircraft starts from and lands on. A plane through the place where it starts; one
    that moves swings about this place, as a deck does."""

    slope_deg: float = 0.0
    towards_deg: float = 0.0  # Where it falls to; also the direction in which a deck rolls.
    heave_m: float = 0.0  # Up and down by so much.
    roll_deg: float = 0.0  # To both sides by so much.
    period_s: float = 6.0
    from_s: float = 0.0  # Since power-up; it begins to move, and ...
    until_s: float = 0.0  # ... stands level again.

    @property
    def is_level(self) -> bool:
        """Whether it is as every plant can have it."""
        return not (self.slope_deg or self.heave_m or self.roll_deg)

    def at(self, time_s: float) -> tuple[float, float]:
        """How high it is where the aircraft started, in m, and how steep, in degrees; it begins
        and ends without a jump."""
        if not self.from_s < time_s < self.until_s:
            return 0.0, self.slope_deg
        near_s = min(time_s - self.from_s, self.until_s - time_s)
        share = min(1.0, near_s / self.period_s)
        turn = 2.0 * math.pi * (time_s - self.from_s) / self.period_s
        rolled = share * self.roll_deg * math.sin(0.7 * turn)  # Never both at once.
        return share * self.heave_m * math.sin(turn), self.slope_deg + rolled


@dataclass
class Truth:
    """What a plant knows of the aircraft now."""

    place: tuple[float, float, float] = (0.0, 0.0, 0.0)  # North, east, up, in m.
    speed: tuple[float, float, float] = (0.0, 0.0, 0.0)  # In m/s.
    angles: tuple[float, float, float] = (0.0, 0.0, 0.0)  # Roll, pitch, yaw, in rad.
    latitude: float = HOME_LATITUDE
    longitude: float = HOME_LONGITUDE
    ground: float = 0.0  # What `place` has up where it would stand on the ground below it.


class Plant(Protocol):
    """An aircraft in the air, stepped by whoever owns time."""

    def step(self, motors: Sequence[float]) -> None:
        """1 ms with these shares of the nominal voltage, from 0 to 1."""

    def inertial(self) -> Sequence[float]:
        """Specific force in m/s^2 and rate in rad/s, body: six numbers."""

    def field(self) -> Sequence[float]:
        """The Earth's magnetic field, body, in microtesla."""

    def pressure(self) -> float:
        """Of the air where the aircraft is, in Pa."""

    def truth(self) -> Truth:
        """Where it is and how it moves."""

    def blow(self, north: float, east: float, down: float) -> None:
        """From now on the air moves so, in m/s."""


def metres_per_degree(latitude: float) -> tuple[float, float]:
    """What a degree of latitude and one of longitude are on the ground."""
    radians = math.radians(latitude)
    eccentricity = FLATNESS * (2.0 - FLATNESS)
    root = 1.0 - eccentricity * math.sin(radians) ** 2
    meridian = EQUATOR_M * (1.0 - eccentricity) / root**1.5
    parallel = EQUATOR_M / math.sqrt(root) * math.cos(radians)
    return math.radians(1.0) * meridian, math.radians(1.0) * parallel


NORTH_M, EAST_M = metres_per_degree(HOME_LATITUDE)


def standard_pressure(altitude_m: float) -> float:
    """Of the standard atmosphere, in Pa."""
    return float(101325.0 * (1.0 - 2.25577e-5 * altitude_m) ** 5.25588)


def standard_temperature(pressure_pa: float) -> float:
    """Where the standard atmosphere has this pressure, in degrees Celsius."""
    return float(288.15 * (pressure_pa / 101325.0) ** 0.190263 - 273.15)


def make(name: str, airframe: Airframe, heading_deg: float, ground: Ground | None = None) -> Plant:
    """A plant by its name, on the ground, with its nose there."""
    ground = ground or Ground()
    if name == "jsbsim":
        if not ground.is_level:
            raise ToolError(f"{name} has level ground only")
        from keel.plants.jsbsim_plant import JsbsimPlant

        return JsbsimPlant(airframe, heading_deg)
    from keel.plants.mujoco_plant import MujocoPlant

    return MujocoPlant(airframe, heading_deg, ground)


NAMES = ("jsbsim", "mujoco")
