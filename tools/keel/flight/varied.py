# SPDX-License-Identifier: Apache-2.0
"""The flight of a seed: aircraft, devices, wind, mission and fault, all drawn from it."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from keel.base.errors import ROOT
from keel.base.files import sha256_of
from keel.flight import library
from keel.flight.loop import Order
from keel.flight.scenario import Quality, Scenario, Shaking
from keel.install.groups import HASHES, PROJECT, requirements_of
from keel.plants import plants
from keel.plants.plants import Airframe

TAG = 0x6B65656C  # Sets these draws apart from those of the noise, which has the same seed.
DURATION_S = 100.0
BLIND_M_S = 5.0  # Without a place it lands as fast as the wind blows, and may tip over at 7 m/s.
# In m/s, for an aircraft with the F450's drag and mass: to stand against more takes 25 degrees, and
# legs as wide as its own tip over at 34.
WINDY_M_S = 20.0
DECK_S = 8.0  # Since power-up: by then it has calibrated its gyroscopes at rest.
HEALTHY = "no fault"
TOOLS = ("tools/keel/flight", "tools/keel/plants", "tools/keel/base/plotting.py")
PINS = ("fly", "timing")  # Groups of Python packages.


def digest_of(root: Path = ROOT) -> str:
    """SHA-256 of all that a flight of a seed depends on, beside the seed."""
    total = hashlib.sha256(library.digest_of(root).encode())
    for group in PINS:
        total.update(
            requirements_of(group, root / PROJECT.name, root / "tools" / HASHES.name).encode()
        )
    files = [path for name in TOOLS for path in below(root / name)]
    for path in files:
        total.update(path.relative_to(root).as_posix().encode())
        total.update(sha256_of(path).encode())
    return total.hexdigest()


def below(path: Path) -> list[Path]:
    """A file, or the Python files of a folder; there is one of the two."""
    if path.is_file():
        return [path]
    return sorted(one for one in path.iterdir() if one.suffix == ".py")


class Draw:
    """Draws from a seed."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.Generator(np.random.PCG64(np.random.SeedSequence([TAG, seed])))

    def between(self, least: float, most: float) -> float:
        """Any number between."""
        return round(float(self._rng.uniform(least, most)), 4)

    def factor(self, most: float) -> float:
        """Between 1 / most and most, as often below 1 as above."""
        return round(float(most ** self._rng.uniform(-1.0, 1.0)), 4)

    def one_of(self, items: Any) -> Any:
        """Any of them."""
        return items[int(self._rng.integers(len(items)))]


def order_of(seed: int) -> Order:
    """The flight of a seed."""
    draw = Draw(seed)
    plant = draw.one_of(plants.NAMES)
    airframe = Airframe(
        mass=draw.between(0.6, 1.5),
        inertia=draw.between(0.7, 1.5),
        motor_speed=draw.between(0.93, 1.07),
        motor_lag=draw.factor(1.5),
        drag=draw.factor(2.0),
        motors=tuple(draw.between(0.92, 1.08) for _ in range(plants.MOTORS)),
        forward_m=draw.between(-0.01, 0.01),
        right_m=draw.between(-0.01, 0.01),
        esc_ms=draw.one_of((0, 1, 2, 4, 8)),
    )
    iron, wires = any_way(draw, 3.0, 115.0), any_way(draw, 0.1, 1.0)
    gps_noise = draw.factor(2.0)
    quality = Quality(
        noise=draw.factor(2.0),
        bias=draw.between(0.3, 1.5),
        vibration=draw.between(0.0, 2.0),
        gps_delay_ms=int(draw.between(80, 200)),
        imu_delay_ms=draw.one_of((1, 2)),
        baro_delay_ms=int(draw.between(5, 30)),
        gps_noise=gps_noise,
        gps_wander=round(draw.between(1.0, 20.0) / gps_noise, 4),  # 0.15 to 3 m.
        scale=draw.between(0.0, 0.03),
        cross_axis=draw.between(0.0, 0.01),
        iron=iron,
        wires=wires,
        wash=draw.between(0.0, 20.0),
        warmth=draw.between(0.0, 0.02),
        shaking=shaking_of(draw),
        field_noise=draw.between(1.0, 7.0),
    )
    found = calibrated(draw, iron, wires)
    return Order(scenario_of(draw, plant, found, airframe), plant, seed, airframe, quality)


def any_way(draw: Draw, least: float, most: float) -> list[float]:
    """A vector of a length between these, in any direction."""
    way = [draw.between(-1.0, 1.0) for _ in range(3)]
    amount = draw.between(least, most) / max(0.1, math.hypot(*way))
    return [round(amount * part, 3) for part in way]


def calibrated(draw: Draw, iron: Sequence[float], wires: Sequence[float]) -> dict[str, float]:
    """What the pilot's calibration found: iron to a microtesla, an ampere's field to a tenth."""
    tenth = 0.1 * math.hypot(*wires)
    off = {f"MAG_OFF_{way}": (part, 1.0) for way, part in zip("XYZ", iron, strict=True)}
    off |= {f"MAG_CUR_{way}": (part, tenth) for way, part in zip("XYZ", wires, strict=True)}
    return {name: round(part + draw.between(-by, by), 3) for name, (part, by) in off.items()}


def ground_of(draw: Draw, plant: str, mode: str, fault: str) -> dict[str, float]:
    """Level for JSBSim. Else every third is a slope, where it knows its place: who drifts up a
    slope hits it. Every sixth is a deck, which stands still for calibration and landing."""
    kind = draw.one_of(("level", "level", "level", "slope", "slope", "deck"))
    towards = draw.between(0.0, 360.0)
    drifts = mode != "position" or fault.startswith("gps_")
    if plant == "jsbsim" or kind == "level" or (kind == "slope" and drifts):
        return {}
    if kind == "slope":
        return {"slope_deg": draw.between(0.0, 15.0), "towards_deg": towards}
    return {
        "towards_deg": towards,
        "heave_m": draw.between(0.1, 0.4),
        "roll_deg": draw.between(1.0, 4.0),
        "period_s": draw.between(5.0, 8.0),
        "from_s": DECK_S,
        "until_s": DECK_S + 20.0,
    }


def wind_of(draw: Draw, most: float) -> dict[str, Any]:
    """With a gust or two."""
    gusts = [
        {
            "at_s": draw.between(4.0, 25.0),
            "length_s": draw.between(1.0, 6.0),
            "speed": draw.between(-3.0, 3.0),
        }
        for _ in range(draw.one_of((0, 1, 2)))
    ]
    return {
        "speed": draw.between(0.0, most),
        "from_deg": draw.between(0.0, 360.0),
        "turbulence": draw.between(0.0, 0.2),
        "shear": draw.between(0.0, 0.2),
        "gust": gusts,
    }


def shaking_of(draw: Draw) -> Shaking:
    """Vibration up to what is called too strong by half: normal is below 15 m/s^2 rms."""
    acceleration = draw.between(0.0, 15.0)
    return Shaking(
        acceleration=acceleration, rate=0.01 * acceleration, alike=draw.one_of((True, False))
    )


def scenario_of(
    draw: Draw, plant: str, parameters: dict[str, float], airframe: Airframe
) -> Scenario:
    """A mission in position or altitude mode, most with a fault in its middle."""
    mode = draw.one_of(("position", "position", "altitude"))
    ends = draw.one_of(("land", "land", "return"))
    height = draw.between(3.0, 8.0)
    pitch, roll = draw.between(-0.4, 0.4), draw.between(-0.4, 0.4)
    if mode == "altitude":
        pitch, roll = pitch / 4.0, roll / 4.0
    fault = fault_of(draw)
    if fault and fault["kind"] == "gps_loss":
        ends = "land"  # Nothing returns without a position.
    hands = [
        {"at_s": 1.0, "height_m": height},
        {"at_s": 9.0, "pitch": pitch, "roll": roll, "yaw": draw.between(-0.3, 0.3)},
        {"at_s": 12.0, "pitch": 0.0, "roll": 0.0, "yaw": 0.0},
        {"at_s": 26.0, "mode": ends},
    ]
    told = fault["kind"] if fault else HEALTHY
    windy = min(12.0, WINDY_M_S * airframe.mass / airframe.drag)
    return Scenario.model_validate(
        {
            "description": told,
            "plants": [plant],
            "duration_s": DURATION_S,
            "mode": mode,
            "heading_deg": draw.between(0.0, 360.0),
            "radio_hz": draw.one_of((50, 111)),
            "battery_left": draw.between(0.36, 1.0),  # With less it is not armed.
            "battery_resistance": draw.between(1.0, 2.5),
            "stick_way": draw.between(0.9, 1.2),
            "wind": wind_of(draw, min(BLIND_M_S, windy) if told == "gps_loss" else windy),
            "ground": ground_of(draw, plant, mode, told),
            "parameters": parameters,
            "pilot": hands,
            "first_fix": first_fix_of(draw),
            "fault": [fault] if fault else [],
            "limits": {
                "from_s": 1.0,
                "to_s": DURATION_S,
                "attitude_rms_deg": 2.5,
                "attitude_max_deg": 8.0,
                "tilt_max_deg": 45.0,
                "sink_max": 1.5,
                "end": {"state": "disarmed"},
            },
        }
    )


def first_fix_of(draw: Draw) -> dict[str, float] | None:
    """Every third receiver is wrong in its first seconds."""
    if draw.one_of((True, False, False)):
        return {
            "until_s": draw.between(2.0, 6.0),
            "north_m": draw.between(-300.0, 300.0),
            "east_m": draw.between(-300.0, 300.0),
        }
    return None


def fault_of(draw: Draw) -> dict[str, Any] | None:
    """Any fault, or none, between 12 and 20 s."""
    at_s, unit = draw.between(12.0, 20.0), draw.one_of((1, 2, 3))
    most = {
        "imu_freeze": {"unit": unit},
        "imu_silent": {"unit": unit},
        "imu_shout": {"unit": unit},
        "imu_drift": {"unit": unit, "rate": draw.between(0.03, 0.5)},
        "imu_scale": {"unit": unit, "share": draw.between(0.0, 0.06)},
        "imu_silent_all": {"until_s": at_s + draw.between(0.01, 0.3)},
        "radio_loss": {},
        "radio_failsafe": {},
        "gps_loss": {},
        "gps_jump": {
            "north_m": draw.between(-50, 50),
            "east_m": draw.between(-50, 50),
            "until_s": at_s + draw.between(0.5, 2.5),
        },
        "gps_drift": {
            "north_m": draw.between(-0.5, 0.5),
            "east_m": draw.between(-0.5, 0.5),
            "until_s": at_s + draw.between(5.0, 20.0),
        },
        "barometer_spike": {
            "pascal": draw.between(-300, 300),
            "until_s": at_s + draw.between(0.05, 0.6),
        },
        "barometer_loss": {},
        "barometer_stuck": {},
        "gps_wild": {"metres": draw.between(20.0, 300.0), "until_s": at_s + draw.between(1.0, 4.0)},
        "magnetometer_current": {"microtesla_per_ampere": draw.between(0.05, 0.4)},
        "motor_weak": {"motor": draw.one_of((1, 2, 3, 4)), "share": draw.between(0.7, 0.95)},
        "motor_stalls": {
            "motor": draw.one_of((1, 2, 3, 4)),
            "until_s": at_s + draw.between(0.01, 0.08),
        },
        "battery_low": {"share": draw.between(0.03, 0.06)},
        "radio_noise": {"share": draw.between(0.002, 0.03)},
        "gps_noise": {"share": draw.between(0.001, 0.01)},
        "task_overrun": {
            "task": draw.one_of(
                ("Navigation", "GPS", "Position control", "Foreground IMU", "State machine")
            ),
            "runs": 3,
            "extra_us": draw.one_of((300, 1000)),
        },
    }
    kind = draw.one_of((HEALTHY, HEALTHY, HEALTHY, *most))
    return None if kind == HEALTHY else {"kind": kind, "at_s": at_s, **most[kind]}
