# SPDX-License-Identifier: Apache-2.0
"""What the devices say: a plant's truth with noise, bias, misalignment, delay, and what is broken.

All noise comes from one seeded generator, in blocks, whatever the plant does and whichever fault
is active: the same flight with and without a fault meets the same noise.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from keel.flight import device_frames
from keel.flight.receivers import SATELLITES, Receiver
from keel.flight.scenario import Place, Quality, Shaking
from keel.plants.plants import (
    EAST_M,
    HOME_ALTITUDE_M,
    NORTH_M,
    Plant,
    Truth,
    metres_per_degree,
    standard_temperature,
)
from keel.plants.power import Battery

BLOCK = 1000
UNITS = 3
TEMPERATURES = (4150, 4420, 4280)  # Of the units, in hundredths of a degree Celsius.
BAROMETER_WARMER = 740  # Than the air, by what is around it; in the same unit.
CHIP_TEMPERATURE, SUPPLY_MV = 5130, 3287
ACCELERATION_LIMIT, RATE_LIMIT = 156.9, 34.9  # Full scale: 16 g, 2000 degrees per second.

# Standard deviations of a sample, unit by unit: three parts of three makes.
ACCELEROMETER_NOISE = (0.03, 0.05, 0.04)  # In m/s^2.
GYROSCOPE_NOISE = (0.002, 0.003, 0.0025)  # In rad/s.
ACCELEROMETER_BIAS, GYROSCOPE_BIAS = 0.04, 0.01
MISALIGNMENT = math.radians(0.15)
VIBRATION = (0.6, 0.02)  # With all motors at full: in m/s^2, in rad/s.
TONES_HZ = (140.0, 238.0)  # Of vibration with all motors at full: blades pass, and a harmonic.
# In radians a millisecond, for both tones.
TURNS_A_STEP = 2e-3 * math.pi * np.array(TONES_HZ).reshape(2, 1, 1)
SHAKEN_FROM = 0.3  # Of full thrust: what is less shakes less, as thrust does.
WARM_S = 40.0  # In which two thirds of the change by warmth has come about.
FIELD_NOISE, FIELD_BIAS, FIELD_PER_AMPERE = 0.3, 0.3, 0.01  # In microtesla.
WASH_M = 0.5  # Above the ground, where a third of the propellers' push on the barometer is left.
PRESSURE_NOISE, PRESSURE_WANDER, PRESSURE_S = 1.5, 2.0, 100.0  # In Pa.
PLACE_NOISE, PLACE_WANDER, PLACE_S, SPEED_NOISE = 0.03, 0.15, 120.0, 0.04  # In m, in m/s.
# A receiver filters: at 3 m of wander its place runs from its speed by 0.12 m in a second and by a
# fifth of it in a fifth of a second, as in PX4's sample_log_small.ulg (0.118 and 0.028 m).
PLACE_SMOOTH_S = 5.0


@dataclass
class Broken:
    """What faults do to devices now."""

    frozen: set[int] = field(default_factory=set)
    silent: set[int] = field(default_factory=set)
    shouting: set[int] = field(default_factory=set)
    drift: dict[int, float] = field(default_factory=dict)  # By unit: rad/s.
    scale: dict[int, float] = field(default_factory=dict)  # By unit: a factor of its rates.
    shaking: Shaking | None = None
    gps_lost: bool = False
    gps_jump: tuple[float, float] = (0.0, 0.0)
    gps_drift: tuple[float, float] = (0.0, 0.0)
    first_fix: tuple[float, float] = (0.0, 0.0)  # As it is wrong after power-up.
    gps_wild: float = 0.0  # Each fix is off by up to so much, in m, north and east.
    gps_noise: float = 0.0  # Of its line: the share of its bytes.
    pascal: float = 0.0
    barometer_lost: bool = False
    barometer_stuck: bool = False  # Samples come, all of them the last good one.
    microtesla_per_ampere: float = 0.0
    along: list[float] | None = None  # Its direction, body axes; none: drawn.
    radio_lost: bool = False
    radio_failsafe: bool = False
    radio_noise: float = 0.0

    @property
    def imu(self) -> bool:
        """Whether an inertial unit is broken."""
        return bool(self.frozen or self.silent or self.shouting or self.drift or self.scale)


def turned(rng: np.random.Generator, most: float) -> Any:
    """A small rotation about any axis."""
    x, y, z = most * rng.standard_normal(3)
    return np.array([[1.0, -z, y], [z, 1.0, -x], [-y, x, 1.0]])


class Wander:
    """A random walk that is drawn back to 0, behind a low-pass if it is to be smooth."""

    def __init__(
        self,
        rng: np.random.Generator,
        deviation: float,
        time_s: float,
        step_s: float,
        size: int,
        smooth_s: float = 0.0,
    ) -> None:
        self._keep = math.exp(-step_s / time_s)
        # The low-pass takes some of the deviation.
        self._push = deviation * math.sqrt((1.0 - self._keep**2) * (1.0 + smooth_s / time_s))
        self._follow = 1.0 - math.exp(-step_s / smooth_s) if smooth_s > 0.0 else 1.0
        self._state = deviation * rng.standard_normal(size)
        self._smooth = self._state

    def step(self, drawn: Any) -> Any:
        """The next value, of standard normal numbers."""
        self._state = self._keep * self._state + self._push * drawn
        self._smooth = self._smooth + self._follow * (self._state - self._smooth)
        return self._smooth


def body_to_earth(roll: float, pitch: float, yaw: float) -> Any:
    """The matrix that turns a vector of the body (forward, right, down) to north, east, down."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return np.array(
        [
            [cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy],
            [cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy],
            [-sp, sr * cp, cr * cp],
        ]
    )


class Inertial:
    """Three units; each sample is what was so some milliseconds ago."""

    def __init__(self, memory: Any, rng: np.random.Generator, quality: Quality) -> None:
        self._force, self._rate = memory["accelerometer"], memory["gyroscope"]
        self._count = memory["count"]
        memory["temperature"] = TEMPERATURES  # They are warm, and stay so.
        self._rng = rng
        turns = [turned(rng, quality.bias * MISALIGNMENT) for _ in range(UNITS)]
        self._turn = np.zeros((6 * UNITS, 6))
        for unit, turn in enumerate(turns):
            self._turn[6 * unit : 6 * unit + 3, :3] = turn
            self._turn[6 * unit + 3 : 6 * unit + 6, 3:] = turn
        spread = np.array([ACCELEROMETER_BIAS] * 3 + [GYROSCOPE_BIAS] * 3)
        self._bias = (quality.bias * spread * rng.uniform(-1.0, 1.0, (UNITS, 6))).reshape(-1)
        self._noise = quality.noise * np.array(
            [
                [force] * 3 + [rate] * 3
                for force, rate in zip(ACCELEROMETER_NOISE, GYROSCOPE_NOISE, strict=True)
            ]
        ).reshape(-1)
        shake = np.array([VIBRATION[0]] * 3 + [VIBRATION[1]] * 3)
        self._shake = quality.vibration * np.tile(shake, UNITS)
        self._own(rng.spawn(1)[0], quality)
        self._late: deque[Sequence[float]] = deque(maxlen=quality.imu_delay_ms + 1)
        limits = np.array([ACCELERATION_LIMIT] * 3 + [RATE_LIMIT] * 3)
        self._limits = np.tile(limits, UNITS)
        self._least = -self._limits
        self._draw()

    def _own(self, rng: np.random.Generator, quality: Quality) -> None:
        """What each unit has of its own: scale, phases of vibration, what warmth does."""
        self._scale = 1.0 + quality.scale * rng.uniform(-1.0, 1.0, 6 * UNITS)
        phase = rng.uniform(0.0, 2.0 * math.pi, (2, UNITS, 6))
        # Each unit's own, or all as the first one's.
        self._phase = (phase, np.repeat(phase[:, :1], UNITS, axis=1))
        warmth = rng.uniform(-1.0, 1.0, (UNITS, 6)) * np.array([0.0] * 3 + [quality.warmth] * 3)
        self._warmth, self._warms = warmth.reshape(-1), quality.warmth > 0.0
        for row in range(0, 6 * UNITS, 3):
            skew = quality.cross_axis * rng.uniform(-1.0, 1.0, (3, 3))
            self._turn[row : row + 3, row % 6 : row % 6 + 3] += skew * (1.0 - np.eye(3))
        self._shaking = quality.shaking
        self._turned = np.zeros((2, 1, 1))  # What tones have turned, in radians.
        self._steps = 0

    def _draw(self) -> None:
        """A second's noise at once."""
        self._drawn = self._rng.standard_normal((BLOCK, 6 * UNITS))
        self._next = 0

    def step(self, true: Sequence[float], thrust: float, broken: Broken) -> None:
        """A sample of each."""
        if self._next == BLOCK:
            self._draw()
        drawn = self._drawn[self._next]
        self._next += 1
        self._late.append(true)
        noise = (self._noise + thrust * self._shake) * drawn
        self._steps += 1
        bias = self._bias
        if self._warms:
            bias = bias + self._warmth * (1.0 - math.exp(-1e-3 * self._steps / WARM_S))
        said = self._scale * (self._turn @ self._late[0]) + bias + noise
        said += self._tones(broken.shaking or self._shaking, thrust)
        np.minimum(said, self._limits, out=said)  # Much quicker than numpy's clip.
        np.maximum(said, self._least, out=said)
        units = said.reshape(UNITS, 6)
        if broken.imu:
            self._break(units, drawn, broken)
            return
        self._force[:] = units[:, :3]
        self._rate[:] = units[:, 3:]
        self._count += 1

    def _tones(self, shaking: Shaking, thrust: float) -> Any:
        """Two tones on every axis; thrust is as the speed's square."""
        if not shaking.acceleration and not shaking.rate:
            return 0.0
        self._turned += math.sqrt(thrust) * TURNS_A_STEP
        first, second = np.sin(self._turned + self._phase[int(shaking.alike)])
        heights = np.array([shaking.acceleration] * 3 + [shaking.rate] * 3)
        heights *= min(1.0, thrust / SHAKEN_FROM)
        return (heights * (first + second)).reshape(-1)

    def _break(self, units: Any, drawn: Any, broken: Broken) -> None:
        """The same with units that fail. Those that freeze repeat their last sample."""
        for unit in range(UNITS):
            if unit in broken.silent:
                continue
            self._count[unit] += 1
            if unit in broken.frozen:
                continue
            if unit in broken.shouting:
                units[unit] = self._limits[:6] * np.sign(drawn[6 * unit : 6 * unit + 6])
            units[unit, 3:] *= broken.scale.get(unit, 1.0)
            units[unit, 3:] += broken.drift.get(unit, 0.0)
            units[unit, :3] += 5.0 * broken.drift.get(unit, 0.0)
            self._force[unit] = units[unit, :3]
            self._rate[unit] = units[unit, 3:]


class Slow:
    """Magnetometer, barometer, satellites, power modules and the chip, each at its own pace."""

    def __init__(
        self,
        memory: Any,
        seed: np.random.SeedSequence,
        quality: Quality,
        place: Place | None = None,
    ) -> None:
        self._home = place
        own = [np.random.Generator(np.random.PCG64(part)) for part in seed.spawn(6)]
        self._field_rng, self._air_rng, self._gps_rng, self._power_rng, line_rng = own[:5]
        self._wild_rng = own[5]
        self._receiver = Receiver(memory, SATELLITES, line_rng)
        self._memory, self._quality = memory, quality
        self._field_turn = turned(self._field_rng, quality.bias * math.radians(0.3))
        own_bias = quality.bias * FIELD_BIAS * self._field_rng.uniform(-1.0, 1.0, 3)
        self._field_bias = own_bias + np.array(quality.iron)
        per_ampere = self._field_rng.uniform(-1.0, 1.0, 3)
        self._per_ampere = per_ampere / np.linalg.norm(per_ampere)
        self._wires = np.array(quality.wires)
        self._air = Wander(self._air_rng, quality.noise * PRESSURE_WANDER, PRESSURE_S, 0.02, 1)
        wander = quality.gps_noise * quality.gps_wander * PLACE_WANDER
        self._place = Wander(self._gps_rng, wander, PLACE_S, 0.1, 2, PLACE_SMOOTH_S)
        self._start = [float(value) for value in self._place.step(np.zeros(2))]
        self._late: deque[tuple[int, bytes]] = deque()
        self._pressures: deque[tuple[int, float, int]] = deque()

    def step(
        self, now_ms: int, plant: Plant, battery: Battery, broken: Broken, thrust: float = 0.0
    ) -> None:
        """What is due in this millisecond, with the motors at this share of their thrust."""
        if now_ms % 10 == 3:
            self._magnetometer(plant, battery, broken)
        if now_ms % 20 == 7:
            self._barometer(now_ms, plant, broken, thrust)
        if self._pressures and self._pressures[0][0] <= now_ms:
            _, pressure, temperature = self._pressures.popleft()
            self._tell_pressure(pressure, temperature, broken)
        if now_ms % 100 == 50:
            self._satellites(now_ms, plant, broken)
        if self._late and self._late[0][0] <= now_ms:
            self._receiver.send(1000 * now_ms, self._late.popleft()[1], broken.gps_noise)
        if now_ms % 10 == 9:
            self._modules(battery)
        if now_ms % 100 == 61:
            self._chip()

    def _magnetometer(self, plant: Plant, battery: Battery, broken: Broken) -> None:
        quality = self._quality
        noise = quality.field_noise * FIELD_NOISE * self._field_rng.standard_normal(3)
        own = quality.field_per_ampere * FIELD_PER_AMPERE * self._per_ampere + self._wires
        along = self._per_ampere if broken.along is None else np.array(broken.along)
        per_ampere = own + broken.microtesla_per_ampere * along
        bias = self._field_bias + battery.current * per_ampere
        self._memory["magnetometer"]["field"] = self._field_turn @ self._field(plant) + bias + noise
        self._memory["magnetometer"]["count"] += 1

    def _field(self, plant: Plant) -> Any:
        """The plant's, or that of the place where it is flown, turned as the aircraft is."""
        if self._home is None:
            return plant.field()
        return np.transpose(body_to_earth(*plant.truth().angles)) @ np.array(
            [self._home.north, self._home.east, self._home.down]
        )

    def _place_of(self, truth: Truth, north_m: float, east_m: float) -> tuple[float, float]:
        """Latitude and longitude of an aircraft that is taken to be so far off."""
        if self._home is None:
            return truth.latitude + north_m / NORTH_M, truth.longitude + east_m / EAST_M
        north, east = metres_per_degree(self._home.latitude)
        return (
            self._home.latitude + (truth.place[0] + north_m) / north,
            self._home.longitude + (truth.place[1] + east_m) / east,
        )

    def _barometer(self, now_ms: int, plant: Plant, broken: Broken, thrust: float) -> None:
        white, walk = self._air_rng.standard_normal(2)
        noise = self._quality.noise * PRESSURE_NOISE * white
        true = plant.pressure()
        said = true + noise + self._air.step(walk)[0] + broken.pascal
        said += self._washed(plant, thrust)
        warm = round(100.0 * standard_temperature(true)) + BAROMETER_WARMER
        self._pressures.append((now_ms + self._quality.baro_delay_ms, said, warm))

    def _washed(self, plant: Plant, thrust: float) -> float:
        """What the propellers' air does to the barometer near the ground, where it piles up."""
        if not self._quality.wash:
            return 0.0
        truth = plant.truth()
        above = max(0.0, truth.place[2] - truth.ground)
        return self._quality.wash * thrust * math.exp(-above / WASH_M)

    def _tell_pressure(self, pressure: float, temperature: int, broken: Broken) -> None:
        if broken.barometer_lost:
            return
        device = self._memory["barometer"]
        if not broken.barometer_stuck:
            device["pressure"], device["temperature"] = pressure, temperature
        device["count"] += 1

    def _satellites(self, now_ms: int, plant: Plant, broken: Broken) -> None:
        drawn = self._gps_rng.standard_normal(6)
        if broken.gps_lost:
            nowhere = device_frames.nav_pvt(
                now_ms, (0.0, 0.0), 0.0, (0.0, 0.0, 0.0), 99.0, 9.0, False
            )
            self._late.append((now_ms + self._quality.gps_delay_ms, nowhere))
            return
        truth = plant.truth()
        quality = self._quality.gps_noise
        north, east = quality * PLACE_NOISE * drawn[:2] + self._place.step(drawn[2:4])
        wild = broken.gps_wild * self._wild_rng.uniform(-1.0, 1.0, 2)
        jump_north, jump_east = wild + [
            sum(parts)
            for parts in zip(broken.gps_jump, broken.gps_drift, broken.first_fix, strict=True)
        ]
        place = self._place_of(truth, north + jump_north, east + jump_east)
        speed = (
            truth.speed[0] + quality * SPEED_NOISE * drawn[4],
            truth.speed[1] + quality * SPEED_NOISE * drawn[5],
            -truth.speed[2],
        )
        fix = device_frames.nav_pvt(
            now_ms, place, HOME_ALTITUDE_M + truth.place[2], speed, 0.8 * max(1.0, quality), 0.2
        )
        self._late.append((now_ms + self._quality.gps_delay_ms, fix))

    def _chip(self) -> None:
        """It is warm, and stays so."""
        chip = self._memory["chip"]
        chip["supply"], chip["temperature"] = SUPPLY_MV, CHIP_TEMPERATURE
        chip["count"] += 1

    def _modules(self, battery: Battery) -> None:
        """Side by side: each has half of the current."""
        noise = self._power_rng.standard_normal((2, 2))
        for unit, module in enumerate(self._memory["power"]):
            module["voltage"] = battery.voltage + 0.02 * noise[unit, 0] + 0.03 * unit
            module["current"] = battery.current / 2.0 + 0.05 * noise[unit, 1]
            module["count"] += 1
