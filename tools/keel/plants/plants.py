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
    """What may differ from the F450 as its authors describe it: factors."""

    mass: float = 1.0
    inertia: float = 1.0
    motor_speed: float = 1.0  # Turns per volt.
    motor_lag: float = 1.0
    drag: float = 1.0


@dataclass
class Truth:
    """What a plant knows of the aircraft now."""

    place: tuple[float, float, float] = (0.0, 0.0, 0.0)  # North, east, up, in m.
    speed: tuple[float, float, float] = (0.0, 0.0, 0.0)  # In m/s.
    angles: tuple[float, float, float] = (0.0, 0.0, 0.0)  # Roll, pitch, yaw, in rad.
    latitude: float = HOME_LATITUDE
    longitude: float = HOME_LONGITUDE


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


def make(name: str, airframe: Airframe, heading_deg: float) -> Plant:
    """A plant by its name, on the ground, with its nose there."""
    if name == "jsbsim":
        from keel.plants.jsbsim_plant import JsbsimPlant

        return JsbsimPlant(airframe, heading_deg)
    from keel.plants.mujoco_plant import MujocoPlant

    return MujocoPlant(airframe, heading_deg)


NAMES = ("jsbsim", "mujoco")
