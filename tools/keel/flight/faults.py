# SPDX-License-Identifier: Apache-2.0
"""Breaks things at their time, and mends them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from keel.base.errors import ToolError, unknown
from keel.flight.library import NO_BOARD, Copter
from keel.flight.scenario import Fault, FirstFix, Shaking
from keel.flight.sensors import UNITS, Broken
from keel.plants.plants import MOTORS, THRUST_POWER
from keel.plants.power import Battery

DRIFT_MOST = 3.0  # rad/s


def shaking_of(fault: Fault) -> Shaking:
    """The vibration of a fault."""
    return Shaking(
        acceleration=fault.acceleration or 0.0, rate=fault.rate or 0.0, alike=bool(fault.alike)
    )


@dataclass
class Faults:
    """The faults of a flight and what they do now."""

    faults: Sequence[Fault]
    copter: Copter
    battery: Battery
    first_fix: FirstFix | None = None
    broken: Broken = field(default_factory=Broken)
    shares: list[float] = field(default_factory=lambda: [1.0] * MOTORS)  # Of motors' commands.
    struck: set[int] = field(default_factory=set)
    mended: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        for fault in self.faults:
            if fault.is_of_board and not self.copter.has_board:
                raise ToolError(NO_BOARD.format(fault.kind))
            if fault.task is not None and fault.task not in self.copter.tasks:
                raise ToolError(unknown("task", fault.task, self.copter.tasks))

    def before_flight(self, since_power_up_s: float) -> None:
        """What is so from power-up on, and ends at a time since then."""
        first = self.first_fix
        if first:
            wrong = since_power_up_s < first.until_s
            self.broken.first_fix = (first.north_m, first.east_m) if wrong else (0.0, 0.0)

    def step(self, time_s: float) -> None:
        """What begins or ends at this time of the flight."""
        for number, fault in enumerate(self.faults):
            if time_s >= fault.at_s and number not in self.struck:
                self.struck.add(number)
                self._set(fault, True)
            if fault.until_s is not None and time_s >= fault.until_s and number not in self.mended:
                self.mended.add(number)
                self._set(fault, False)
            if fault.kind == "imu_drift" and number in self.struck - self.mended:
                drift = min(DRIFT_MOST, (fault.rate or 0.0) * (time_s - fault.at_s))
                self.broken.drift[(fault.unit or 1) - 1] = drift
            if fault.kind == "gps_drift" and number in self.struck - self.mended:
                seconds = time_s - fault.at_s
                self.broken.gps_drift = (
                    seconds * (fault.north_m or 0.0),
                    seconds * (fault.east_m or 0.0),
                )

    def _set(self, fault: Fault, on: bool) -> None:
        """Begin or end a fault."""
        unit, broken = (fault.unit or 1) - 1, self.broken
        sets = {
            "imu_freeze": broken.frozen,
            "imu_silent": broken.silent,
            "imu_shout": broken.shouting,
        }
        if fault.is_of_board:
            self._break(fault, on)
        elif fault.kind in sets:
            (sets[fault.kind].add if on else sets[fault.kind].discard)(unit)
        elif fault.kind == "imu_vibration":
            broken.shaking = shaking_of(fault) if on else None
        elif fault.kind == "imu_scale":
            broken.scale[unit] = 1.0 + float(on) * (fault.share or 0.0)
        elif fault.kind == "imu_drift" and not on:
            broken.drift.pop(unit, None)
        elif fault.kind == "imu_silent_all":
            broken.silent.update(range(UNITS)) if on else broken.silent.clear()
        elif fault.kind == "radio_loss":
            broken.radio_lost = on
        elif fault.kind == "radio_failsafe":
            broken.radio_failsafe = on
        elif fault.kind == "gps_loss":
            broken.gps_lost = on
        elif fault.kind == "barometer_loss":
            broken.barometer_lost = on
        elif fault.kind == "barometer_stuck":
            broken.barometer_stuck = on
        else:
            self._set_value(fault, on)

    def _break(self, fault: Fault, on: bool) -> None:
        """The same for those of the board."""
        task = self.copter.tasks.index(fault.task) if fault.task else 0
        which = fault.unit or fault.bus or task
        amount = fault.clocks or fault.saved_bytes or round(1000 * (fault.share or 0.0))
        self.copter.breaks(fault.kind, which, amount, on)

    def _set_value(self, fault: Fault, on: bool) -> None:
        """The same for faults that have a value."""
        broken, factor = self.broken, float(on)
        if fault.kind == "gps_jump":
            broken.gps_jump = (factor * (fault.north_m or 0.0), factor * (fault.east_m or 0.0))
        elif fault.kind == "gps_noise":
            broken.gps_noise = factor * (fault.share or 0.0)
        elif fault.kind == "gps_wild":
            broken.gps_wild = factor * (fault.metres or 0.0)
        elif fault.kind == "radio_noise":
            broken.radio_noise = factor * (fault.share or 0.0)
        elif fault.kind == "barometer_spike":
            broken.pascal = factor * (fault.pascal or 0.0)
        elif fault.kind == "magnetometer_current":
            broken.microtesla_per_ampere = factor * (fault.microtesla_per_ampere or 0.0)
            broken.along = fault.along
        elif fault.kind == "motor_weak":
            share = (fault.share or 0.0) if on else 1.0  # Of its thrust.
            self.shares[(fault.motor or 1) - 1] = share ** (1.0 / THRUST_POWER)
        elif fault.kind == "motor_stalls":
            self.shares[(fault.motor or 1) - 1] = 0.0 if on else 1.0
        elif fault.kind == "gps_drift" and not on:
            broken.gps_drift = (0.0, 0.0)
        elif fault.kind == "battery_low" and on:
            self.battery.left = min(self.battery.left, fault.share or 0.0)
        elif fault.kind == "task_overrun" and on:
            number = self.copter.tasks.index(fault.task or "")
            self.copter.overrun(number, fault.runs or 1, fault.extra_us or 1)
