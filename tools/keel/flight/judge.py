# SPDX-License-Identifier: Apache-2.0
"""Holds a flight against its scenario's limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from keel.flight.library import modes, states
from keel.flight.loop import Trace, runs_of
from keel.flight.scenario import Limits, Reach, Scenario

GROUND_M = 0.25  # The centre of gravity above where it stood, and the slope of the ground.
UPRIGHT_DEG = 30.0
REAL_TIME = ("Background IMU", "Foreground IMU", "Angle rate control", "Angle control")
FLIES_M = 0.3


@dataclass(frozen=True)
class Finding:
    """A limit and what the flight made of it."""

    name: str
    value: str
    limit: str
    good: bool
    number: float | None = None

    def as_json(self) -> dict[str, Any]:
        """For reports."""
        return asdict(self)


def wrapped(angle: Any) -> Any:
    """Within half a turn of 0."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


def believed(trace: Trace) -> tuple[Any, Any, Any]:
    """Roll, pitch and yaw of the copter's quaternion."""
    w, x, y, z = (trace.view["quaternion"][:, column].astype(float) for column in range(4))
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    return roll, pitch, np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def asked(trace: Trace) -> tuple[Any, Any]:
    """Roll and pitch that were asked for."""
    sines = np.clip(trace.view["asked_tilt"].astype(float), -1.0, 1.0)
    return np.arcsin(sines[:, 0]), np.arcsin(sines[:, 1])


def rms(values: Any) -> float:
    """The root of the mean square; of nothing, no number."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else math.nan


def most(values: Any) -> float:
    """The largest, whatever its sign."""
    return float(np.max(np.abs(values))) if len(values) else math.nan


class Judge:
    """The numbers of one flight within the limits' time."""

    def __init__(self, scenario: Scenario, trace: Trace, unbroken: Trace | None) -> None:
        self._limits = scenario.limits
        self._trace, self._unbroken = trace, unbroken
        time = trace.column("time")
        self._in = (time >= self._limits.from_s) & (time <= self._limits.to_s)

    def _errors(self, first: int) -> tuple[Any, Any]:
        """Of roll and pitch, in degrees: belief less truth (0), truth less what was asked (1)."""
        true = (self._trace.column("roll"), self._trace.column("pitch"))
        other = believed(self._trace)[:2] if first == 0 else asked(self._trace)
        roll, pitch = (np.degrees(a - b)[self._in] for a, b in zip(other, true, strict=True))
        return roll, pitch

    def _from_start(self, name: str) -> Any:
        """A place, from where it was when the limits began."""
        values = self._trace.column(name)[self._in]
        return values - values[0] if len(values) else values

    def attitude_rms_deg(self) -> float:
        """Of roll or pitch, whichever is worse."""
        return max(map(rms, self._errors(0)))

    def attitude_max_deg(self) -> float:
        """The same at its worst."""
        return max(map(most, self._errors(0)))

    def heading_max_deg(self) -> float:
        """Belief less truth."""
        error = wrapped(believed(self._trace)[2] - self._trace.column("yaw"))
        return most(np.degrees(error)[self._in])

    def tracking_rms_deg(self) -> float:
        """Truth less what was asked."""
        return max(map(rms, self._errors(1)))

    def turning_rms_dps(self) -> float:
        """Of the nose, in degrees a second: truth less what was asked."""
        time = self._trace.column("time")
        turned = np.gradient(np.unwrap(self._trace.column("yaw")), time)
        wanted = self._trace.view["asked_rate"][:, 2].astype(float)
        return rms(np.degrees(turned - wanted)[self._in])

    def tilt_max_deg(self) -> float:
        """From level."""
        roll, pitch = self._trace.column("roll"), self._trace.column("pitch")
        tilt = np.arccos(np.clip(np.cos(roll) * np.cos(pitch), -1.0, 1.0))
        return most(np.degrees(tilt)[self._in])

    def _hold(self) -> Any:
        """Horizontal distance from where it was."""
        return np.hypot(self._from_start("north"), self._from_start("east"))

    def hold_rms_m(self) -> float:
        """Root mean square."""
        return rms(self._hold())

    def hold_max_m(self) -> float:
        """At its worst."""
        return most(self._hold())

    def away_max_m(self) -> float:
        """From home, to the side that is farthest."""
        return max(most(self._trace.column(name)[self._in]) for name in ("north", "east"))

    def place_max_m(self) -> float:
        """Belief less truth. Home is where it took off."""
        place = self._trace.view["position"].astype(float)
        north = place[:, 0] - self._trace.column("north")
        east = place[:, 1] - self._trace.column("east")
        return most(np.hypot(north, east)[self._in])

    def height_max_m(self) -> float:
        """From where it was."""
        return most(self._from_start("up"))

    def height_error_max_m(self) -> float:
        """Belief less truth."""
        believed_up = self._trace.view["position"][:, 2].astype(float)
        return most((believed_up - self._trace.column("up"))[self._in])

    def sink_max(self) -> float:
        """The fastest descent just above the ground, after it has flown."""
        up, speed = self._trace.column("up"), self._trace.column("v_up")
        flown = np.maximum.accumulate(up) > FLIES_M
        near = flown & (up - self._trace.column("ground") < 0.1) & (speed < 0.0)
        return most(speed[near]) if near.any() else 0.0

    def skipped_max(self) -> float:
        """Runs that real-time tasks left out since the motors started."""
        before, after = self._trace.done
        skipped = after["skipped"].astype(int) - before["skipped"].astype(int)
        return float(
            max(
                count
                for name, count in zip(self._trace.tasks, skipped, strict=True)
                if name in REAL_TIME
            )
        )

    def without_fault_deg(self) -> float:
        """Of roll and pitch, from the same flight unbroken."""
        if self._unbroken is None:
            return math.nan
        rows = min(len(self._trace.truth), len(self._unbroken.truth))
        inside = self._in[:rows]
        return max(
            most(
                np.degrees(self._trace.column(name)[:rows] - self._unbroken.column(name)[:rows])[
                    inside
                ]
            )
            for name in ("roll", "pitch")
        )


METRICS = (
    "attitude_rms_deg",
    "attitude_max_deg",
    "heading_max_deg",
    "tracking_rms_deg",
    "turning_rms_dps",
    "tilt_max_deg",
    "hold_rms_m",
    "hold_max_m",
    "away_max_m",
    "place_max_m",
    "height_max_m",
    "height_error_max_m",
    "sink_max",
    "skipped_max",
    "without_fault_deg",
)


def judged(scenario: Scenario, trace: Trace, unbroken: Trace | None) -> list[Finding]:
    """Every limit of the scenario."""
    if trace.problem:
        return [Finding("flown", trace.problem, "to its end", False), *outputs(trace)]
    if trace.crash:
        return [Finding("flown", trace.crash, "without a crash", False), *outputs(trace)]
    return [
        *outputs(trace),
        *risen(scenario.rises_m, trace),
        *numbers(scenario.limits, Judge(scenario, trace, unbroken)),
        *stayed(scenario.limits, trace),
        *reached(scenario.limits.reach, trace),
        *ended(scenario, trace),
    ]


def numbers(limits: Limits, judge: Judge) -> Iterator[Finding]:
    """Limits that are numbers."""
    for name in METRICS:
        limit = getattr(limits, name)
        if limit is not None:
            value = float(getattr(judge, name)())
            yield Finding(name, f"{value:.3f}", f"{limit:g}", value <= limit, value)


def outputs(trace: Trace) -> Iterator[Finding]:
    """What the pins of a board did."""
    if trace.pins is not None:
        limit = "1000 to 2000 us, 400 Hz, low in 1000 us"
        yield Finding("outputs", str(trace.pins), limit, not trace.pins.mistakes)


def risen(height_m: float, trace: Trace) -> Iterator[Finding]:
    """Whether it flew at all, if it is to."""
    if height_m > 0.0:
        up = float(trace.column("up").max())
        yield Finding("rises_m", f"{up:.2f} m", f"at least {height_m:g} m", up >= height_m, up)


def stayed(limits: Limits, trace: Trace) -> Iterator[Finding]:
    """The states that it was in, where the scenario says which may be."""
    if limits.stays:
        time = trace.column("time")
        inside = (time >= limits.from_s) & (time <= limits.to_s)
        seen = runs_of([states()[number] for number in trace.view["state"][inside]])
        good = set(seen) <= set(limits.stays)
        yield Finding("stays", ", ".join(seen), " or ".join(limits.stays), good)


def measured(scenario: Scenario, trace: Trace, unbroken: Trace | None = None) -> dict[str, float]:
    """Every number, whether it has a limit or not, but for those that are none."""
    if trace.problem or trace.crash:
        return {}
    judge = Judge(scenario, trace, unbroken)
    found = {name: float(getattr(judge, name)()) for name in METRICS}
    return {name: value for name, value in found.items() if not math.isnan(value)}


def reached(reaches: list[Reach], trace: Trace) -> Iterator[Finding]:
    """States and modes that must be seen in time."""
    time = trace.column("time")
    for reach in reaches:
        names, key = (states(), "state") if reach.state else (modes(), "mode")
        wanted = reach.state or reach.mode or ""
        seen = time[trace.view[key] == names.index(wanted)]
        after = seen[seen >= reach.from_s]
        value = f"at {after[0]:.2f} s" if len(after) else "never"
        good = bool(len(after) and after[0] <= reach.by_s)
        limit = f"{reach.from_s:g} to {reach.by_s:g} s"
        yield Finding(f"{key} {wanted}", value, limit, good)


def ended(scenario: Scenario, trace: Trace) -> Iterator[Finding]:
    """How it was at the end."""
    end, view = scenario.limits.end, trace.view[-1]
    north, east, up, ground = (
        float(trace.column(name)[-1]) for name in ("north", "east", "up", "ground")
    )
    roll, pitch = (math.degrees(trace.column(name)[-1]) for name in ("roll", "pitch"))
    state = states()[int(view["state"])]
    if end.on_ground:
        above = up - ground
        low = above <= GROUND_M
        yield Finding("ends on the ground", f"{above:.2f} m up", f"{GROUND_M:g} m", low)
    if end.upright:
        tilt = max(abs(roll), abs(pitch))
        most_deg = UPRIGHT_DEG + scenario.ground.slope_deg
        yield Finding("ends upright", f"{tilt:.1f} deg", f"{most_deg:g} deg", tilt <= most_deg)
    turns = bool(view["motors_on"])
    told = {True: "motors turn", False: "motors stand"}
    yield Finding("ends with", told[turns], told[end.motors_on], turns == end.motors_on)
    if end.state is not None:
        yield Finding("ends", state, end.state, state == end.state)
    if end.home_m is not None:
        away = math.hypot(north, east)
        limit = f"{end.home_m:g} m"
        yield Finding("ends at home", f"{away:.2f} m", limit, away <= end.home_m, away)


def is_good(scenario: Scenario, trace: Trace, findings: list[Finding]) -> bool:
    """Whether all limits hold or, where that is expected, one does not. A flight that could not be
    flown is never good."""
    kept = all(finding.good for finding in findings)
    return not trace.problem and kept != scenario.expects_failure
