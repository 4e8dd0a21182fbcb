# SPDX-License-Identifier: Apache-2.0
"""Gain, phase and delay margin of each loop that flies the copter.

    make check NAME=margins

A linear model at the hover: the gains are the parameters' defaults, the aircraft is the F450 as
MuJoCo's plant has it. Each loop is opened at its controller, with the loops inside it closed; "at
the motors" opens rate and angle at once, as a late sample is late for both. How far the copter is
from the model shows in tests/flight/test_margins.py, which flies with delays below and above the
margin.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from keel.base.errors import ROOT
from keel.base.files import write_json
from keel.plants import mujoco_plant as plant
from keel.plants.plants import THRUST_POWER

PARAMETERS = ROOT / "specs/parameters/copter.toml"
REPORT = Path("build/margins.json")
CONTROL_S, POSITION_S = 0.002, 0.010  # Table 2: the rates and angles, and positions.
DERIVATIVE_HZ = 90.0  # Of the rate controllers, in examples/copter/settings.c.
HOVER = 0.37  # The command that hovers.
MOTORS = 4
GRAVITY = 9.8066
# A sample is 1 ms old, the mean of two is half a millisecond older; an output is held for a period.
AGE_S, OVERSAMPLED_S = 0.001, 0.0005
RADIANS = np.geomspace(0.05, 1500.0, 60000)  # Frequencies, in rad/s.

Response = Any  # A complex number for each of RADIANS.


@dataclass(frozen=True)
class Margins:
    """Of a loop: a factor of its gain, a phase, a delay, and where it crosses over."""

    loop: str
    gain: float
    phase_deg: float
    delay_ms: float
    crossover: float  # In rad/s.


def defaults() -> dict[str, float]:
    """The parameters' defaults by name."""
    data = tomllib.loads(PARAMETERS.read_text())
    items = [item for group in data["group"] for item in group["parameter"]]
    return {item["name"]: item["default"] for item in items}


def low_pass(hertz: float, period: float) -> Response:
    """Butterworth's of two poles, as sampled: the bilinear transform with its frequency kept."""
    warped = np.tan(np.pi * hertz * period)
    turned = 1j * np.tan(RADIANS * period / 2.0) / warped
    return 1.0 / (1.0 + np.sqrt(2.0) * turned + turned**2)


def late(seconds: float) -> Response:
    """A delay."""
    return np.exp(-1j * RADIANS * seconds)


def controller(kp: float, ki: float, kd: float, period: float) -> Response:
    """A PID controller, its error's difference filtered."""
    back = np.exp(-1j * RADIANS * period)
    integral = ki * period / (1.0 - back)
    return kp + integral + kd * (1.0 - back) / period * low_pass(DERIVATIVE_HZ, period)


def authority() -> dict[str, float]:
    """The acceleration by a unit of roll, yaw and thrust at the hover, in rad/s^2 and m/s^2."""
    slope = MOTORS * plant.THRUST_N * THRUST_POWER * HOVER ** (THRUST_POWER - 1.0)
    return {
        "roll": plant.ARM_M * slope / plant.INERTIA[0],
        "yaw": plant.TORQUE_M * slope / plant.INERTIA[2],
        "thrust": slope / plant.MASS_KG,
    }


def loops(gains: Mapping[str, float]) -> dict[str, Response]:
    """The open loops."""
    turns, motor = authority(), 1.0 / (1j * RADIANS * plant.MOTOR_S + 1.0)
    integrates = 1.0 / (1j * RADIANS)
    seen = low_pass(gains["IMU_GYRO_CUTOFF"], CONTROL_S) * late(
        AGE_S + OVERSAMPLED_S + CONTROL_S / 2.0
    )
    opened: dict[str, Response] = {}
    for name, prefix in (("roll", "ROLL"), ("yaw", "YAW")):
        kp, ki, kd = (gains[f"{prefix}_RATE_{letter}"] for letter in "PID")
        rate = controller(kp, ki, kd, CONTROL_S)
        opened[f"{name} rate"] = rate * turns[name] * motor * integrates * seen
    opened["roll angle"] = gains["ROLL_P"] * closed(opened["roll rate"]) * integrates
    opened["roll at the motors"] = opened["roll rate"] * (1.0 + gains["ROLL_P"] * integrates)
    held = late(1.5 * POSITION_S)
    tilts = closed(opened["roll angle"])
    speeds = controller(gains["VEL_P"], gains["VEL_I"], 0.0, POSITION_S)
    opened["speed"] = speeds * tilts * integrates * held
    opened["position"] = gains["POS_P"] * closed(opened["speed"]) * integrates
    climbs = controller(gains["CLIMB_P"], gains["CLIMB_I"], 0.0, POSITION_S)
    opened["climb rate"] = climbs * turns["thrust"] * motor * integrates * held
    opened["height"] = gains["HEIGHT_P"] * closed(opened["climb rate"]) * integrates
    return opened


def closed(opened: Response) -> Response:
    """The loop closed: from what is asked for to what is seen."""
    return opened / (1.0 + opened)


def margins_of(loop: str, opened: Response) -> Margins:
    """Where it is 1, and where it turns the sign."""
    size, phase = np.abs(opened), np.unwrap(np.angle(opened))
    phase -= 2.0 * np.pi * np.round((phase[0] + np.pi / 2.0) / (2.0 * np.pi))
    at = int(np.flatnonzero((size[:-1] >= 1.0) & (size[1:] < 1.0))[-1])
    turned = np.flatnonzero((phase[:-1] > -np.pi) & (phase[1:] <= -np.pi))
    gain = float(1.0 / size[turned[0]]) if len(turned) else float("inf")
    left = float(phase[at] + np.pi)
    return Margins(
        loop, gain, float(np.degrees(left)), 1000.0 * left / float(RADIANS[at]), float(RADIANS[at])
    )


def all_margins() -> list[Margins]:
    """Of all loops, by the defaults."""
    return [margins_of(name, opened) for name, opened in loops(defaults()).items()]


def shown(found: list[Margins], make: Callable[..., Table] = Table) -> Table:
    """As a table."""
    table = make(title="Stability margins at the hover", title_justify="left")
    for name in ("loop", "gain", "phase, deg", "delay, ms", "crosses over, rad/s"):
        table.add_column(name, justify="left" if name == "loop" else "right")
    for item in found:
        table.add_row(
            item.loop,
            f"{item.gain:.1f}",
            f"{item.phase_deg:.0f}",
            f"{item.delay_ms:.0f}",
            f"{item.crossover:.1f}",
        )
    return table


def main(_arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    found = all_margins()
    Console().print(shown(found))
    write_json(ROOT / REPORT, {"schema": 1, "loops": [asdict(item) for item in found]})
    least = min(found, key=lambda item: item.delay_ms)
    print(
        f"margins: {len(found)} loops; {least.loop} stands the least delay, "
        f"{least.delay_ms:.0f} ms; {REPORT} has them"
    )
    return 0
