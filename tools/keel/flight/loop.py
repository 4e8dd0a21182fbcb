# SPDX-License-Identifier: Apache-2.0
"""One flight: plant, devices and copter, millisecond by millisecond.

    plant moves -> devices hold what they say -> copter runs up to now -> its motors, from now on

Nothing here reads a clock or draws a number that does not come from the flight's seed, so that
equal flights have equal traces, bit for bit.
"""

from __future__ import annotations

import hashlib
import math
import tempfile
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from keel.flight import device_frames, pins
from keel.flight.faults import Faults
from keel.flight.library import Copter, Key, Link, checks_of, facts_of, modes, states
from keel.flight.pilot import Pilot, Sight
from keel.flight.pins import Pins
from keel.flight.receivers import RADIO, RADIO_LINES, Receiver
from keel.flight.scenario import Quality, Scenario
from keel.flight.sensors import Broken, Inertial, Slow
from keel.plants import plants, wind
from keel.plants.plants import Airframe, Plant, Truth
from keel.plants.power import RESISTANCE, Battery

ROW_MS = 5  # A row of the trace.
RADIO_FRAMES = {"sbus": device_frames.sbus, "crsf": device_frames.crsf, "ibus": device_frames.ibus}
WIND_MS = round(1000 * wind.PERIOD_S)
POWER_MS = 10
ARMS_WITHIN_S = 30.0
LIES, LIES_M = 1.4, 0.5  # Tilted by 80 degrees so near the ground, it has crashed.
TRUTH = (
    "time",
    "north",
    "east",
    "up",
    "v_north",
    "v_east",
    "v_up",
    "roll",
    "pitch",
    "yaw",
    "wind_north",
    "wind_east",
    "voltage",
    "current",
    "ground",
)


class NotFlown(Exception):
    """The flight did not begin, or the copter's scheduler refused to go on."""


class Crashed(Exception):
    """The aircraft lies on its back, or a plant no longer knows where it is."""


@dataclass(frozen=True)
class Order:
    """All that a flight depends on, beside the sources."""

    scenario: Scenario
    plant: str
    seed: int
    airframe: Airframe = Airframe()
    quality: Quality = Quality()


@dataclass
class Trace:
    """What a flight left: rows every ROW_MS, from the motors' start on."""

    truth: Any = None
    view: Any = None
    digest: str = ""
    problem: str = ""  # Why the flight could not be flown to its end.
    crash: str = ""  # How it ended before its end.
    armed_s: float = 0.0  # When the motors started, since power-up.
    tasks: list[str] = field(default_factory=list)
    done: Any = None  # What became of each task, when the motors started and at the end.
    pins: Pins | None = None  # What a board's outputs did.

    def column(self, name: str) -> Any:
        """A column of the truth."""
        return self.truth[:, TRUTH.index(name)]


def airframe_of(order: Order) -> Airframe:
    """Of the order, unless the scenario has its own."""
    own = order.scenario.airframe
    if own == type(own)():
        return order.airframe
    return Airframe(**{**own.model_dump(), "motors": tuple(own.motors)})


def delayed(airframe: Airframe) -> deque[Sequence[float]]:
    """What the speed controllers were told in the last milliseconds, the oldest first."""
    count = airframe.esc_ms + 1
    return deque([[0.0] * plants.MOTORS] * count, maxlen=count)


def without_faults(order: Order) -> Order:
    """The same flight, unbroken."""
    scenario = order.scenario.model_copy(update={"fault": []})
    return Order(scenario, order.plant, order.seed, order.airframe, order.quality)


def start_with(
    copter: Copter, scenario: Scenario, links: Sequence[Link], key: Key | None, keep: Path | None
) -> None:
    """Power up, with the scenario's parameters in the memory: they are set on the ground and are in
    force after a restart, as a pilot's are."""
    built = scenario.options

    def start(memory: Path | None) -> None:
        copter.start(built.costs_percent, built.plain_mean, links, key, memory, built.imus)

    start(keep)
    for name, value in scenario.parameters.items():
        copter.set(name, value)
    if scenario.parameters:
        start(keep)


class Flight:
    """A flight that is being made."""

    def __init__(
        self,
        copter: Copter,
        order: Order,
        pilot: type[Pilot] = Pilot,
        links: Sequence[Link] = (),
        key: Key | None = None,
        keep: Path | None = None,
    ) -> None:
        scenario = order.scenario
        self._copter, self._scenario = copter, scenario
        if scenario.parameters and keep is None:
            self._folder = tempfile.TemporaryDirectory(prefix="keel-parameters-")
            keep = Path(self._folder.name) / "memory"
        start_with(copter, scenario, links, key, keep)
        copter.hear(scenario.radio)
        seeds = np.random.SeedSequence(order.seed).spawn(4)
        rng = [np.random.Generator(np.random.PCG64(seed)) for seed in seeds]
        airframe = airframe_of(order)
        self._plant: Plant = plants.make(
            order.plant, airframe, scenario.heading_deg, scenario.plane
        )
        self._battery = Battery(
            left=scenario.battery_left, resistance=RESISTANCE * scenario.battery_resistance
        )
        self._battery.step([0.0] * plants.MOTORS, 0.0)
        memory = copter.sensors
        quality = scenario.devices or order.quality
        self._inertial = Inertial(memory["imu"], rng[0], quality)
        self._slow = Slow(memory, seeds[1], quality, scenario.place)
        self._radio = Receiver(memory, RADIO, rng[3], RADIO_LINES[scenario.radio])
        self._radio_ms = 1000 // scenario.radio_hz
        self._pilot = pilot(scenario, self._radio_ms / 1000.0)
        self._faults = Faults(scenario.fault, copter, self._battery, scenario.first_fix)
        air = scenario.wind
        self._wind = wind.drawn(
            rng[2],
            ARMS_WITHIN_S + scenario.duration_s,
            air.speed,
            air.from_deg,
            air.turbulence,
            [(gust.at_s, gust.length_s, gust.speed) for gust in air.gust],
        )
        self._still_air = scenario.wind == type(air)()
        # Factors of commands; those of the airframe are of thrust.
        self._uneven = [share ** (1.0 / plants.THRUST_POWER) for share in airframe.motors]
        self._told = delayed(airframe)
        self._motors: Sequence[float] = [0.0] * plants.MOTORS
        self._stood_ms = 0
        self._begun_ms = -1
        self._now_ms = 0
        self._mode_channels = {
            mode: copter.mode_channel(number) for number, mode in enumerate(modes())
        }
        self._rows: list[tuple[float, ...]] = []
        self._views: list[bytes] = []
        self._done_before = copter.done()

    def fly(self) -> Trace:
        """From its begin to its end."""
        return self.fly_on(0)

    def fly_on(self, now_ms: int) -> Trace:
        """From a time on to its end."""
        problem, crash = "", ""
        try:
            while not self._is_over(now_ms):
                now_ms += 1
                self.step(now_ms)
        except NotFlown as error:
            problem = str(error)
        except Crashed as error:
            crash = str(error)
        return self._trace(problem, crash)

    def _is_over(self, now_ms: int) -> bool:
        """When the motors have stood, after the scenario's time, or when they do not start."""
        if self._begun_ms >= 0:
            stood = self._stood_ms >= 1000.0 * self._scenario.over_s
            return stood or now_ms - self._begun_ms >= 1000.0 * self._scenario.duration_s
        if now_ms > 1000.0 * ARMS_WITHIN_S:
            self._copter.look()
            view = self._copter.view
            checks = ", ".join(checks_of(int(view["blocking_checks"]))) or "none"
            facts = ", ".join(facts_of(int(view["blocking_facts"]))) or "none"
            raise NotFlown(
                f"not armed after {ARMS_WITHIN_S:.0f} s: checks that do not hold: "
                f"{checks}; facts: {facts}"
            )
        return False

    def step(self, now_ms: int) -> None:
        """A millisecond, which ends now."""
        self._now_ms = now_ms
        time_s = self._time_s(now_ms)
        plant, copter = self._plant, self._copter
        self._faults.before_flight(now_ms / 1000.0)
        if time_s >= 0.0:
            self._faults.step(time_s)
        broken = self._faults.broken
        thrust = sum(self._motors) / plants.MOTORS
        # As it was when this began.
        self._slow.step(now_ms, plant, self._battery, broken, thrust)
        plant.step(self._motors)
        self._inertial.step(plant.inertial(), thrust, broken)  # It is given what was before.
        if now_ms % POWER_MS == 0:
            self._breathe(now_ms)
        if now_ms % self._radio_ms == 0:
            self._send(now_ms, time_s, broken)
        if status := copter.run_until(1000 * now_ms):
            raise NotFlown(f"at {time_s:.3f} s: {copter.why(status)}")
        copter.look()
        self._turn(copter.motor.tolist())
        if self._begun_ms < 0 and copter.view["motors_on"]:
            self._begun_ms = now_ms
            self._done_before = copter.done()
        self._stood_ms = 0 if copter.view["motors_on"] else self._stood_ms + 1
        if self._begun_ms >= 0 and (now_ms - self._begun_ms) % ROW_MS == 0:
            self._record(now_ms)

    def _turn(self, told: Sequence[float]) -> None:
        """What the motors do from now on; they were told a dead time ago."""
        self._told.append(told)
        scale = self._battery.voltage / plants.NOMINAL_V
        shares = [share * own for share, own in zip(self._faults.shares, self._uneven, strict=True)]
        self._motors = [
            min(1.0, scale * share * motor)
            for share, motor in zip(shares, self._told[0], strict=True)
        ]

    def _time_s(self, now_ms: int) -> float:
        """Of the flight; negative before."""
        return (now_ms - self._begun_ms) / 1000.0 if self._begun_ms >= 0 else -1.0

    def _breathe(self, now_ms: int) -> None:
        """Wind and battery. A scenario's gusts count from the motors' start."""
        self._battery.step(self._motors, POWER_MS / 1000.0)
        if not self._still_air:
            flown_ms = max(0, now_ms - self._begun_ms) if self._begun_ms >= 0 else 0
            share = wind.sheared(self._plant.truth().place[2], self._scenario.wind.shear)
            air = self._wind[(flown_ms // WIND_MS) % len(self._wind)]
            self._plant.blow(*(share * air).tolist())

    def _send(self, now_ms: int, time_s: float, broken: Broken) -> None:
        """A frame of the radio."""
        view = self._copter.view
        ready = not view["blocking_checks"] and not view["blocking_facts"]
        thrusts = int(view["mode"]) in (modes().index("acro"), modes().index("angle"))
        truth = self._plant.truth()
        if not is_whole(truth):
            raise Crashed(f"crashed at {time_s:.2f} s")
        sight = Sight(
            time_s, truth, bool(ready), thrusts, self._mode_channels, bool(view["motors_on"])
        )
        channels = self._pilot.frame(sight)
        if not broken.radio_lost:
            frame = RADIO_FRAMES[self._scenario.radio](channels, broken.radio_failsafe)
            self._radio.send(1000 * now_ms, frame, broken.radio_noise)

    def _record(self, now_ms: int) -> None:
        """A row."""
        truth = self._plant.truth()
        time_s = (now_ms - self._begun_ms) / 1000.0
        air = self._wind[(now_ms - self._begun_ms) // WIND_MS]
        self._rows.append(
            (
                time_s,
                *truth.place,
                *truth.speed,
                *truth.angles,
                air[0],
                air[1],
                self._battery.voltage,
                self._battery.current,
                truth.ground,
            )
        )
        self._views.append(bytes(self._copter.view_bytes))

    def _trace(self, problem: str, crash: str) -> Trace:
        """What was recorded."""
        truth = np.array(self._rows, dtype=np.float64).reshape(-1, len(TRUTH))
        views = b"".join(self._views)
        digest = hashlib.sha256(truth.tobytes() + views).hexdigest()
        return Trace(
            truth,
            np.frombuffer(views, self._copter.view_type),
            digest,
            problem,
            crash,
            max(0, self._begun_ms) / 1000.0,
            self._copter.tasks,
            (self._done_before, self._copter.done()),
            self._pins(),
        )

    def _pins(self) -> Pins | None:
        """What a board's outputs did."""
        edges = self._copter.edges()
        return None if edges is None else pins.measured(edges, 1000.0 * self._now_ms)


def is_whole(truth: Truth) -> bool:
    """Whether it flies or stands, and is where an aircraft can be."""
    roll, pitch, _ = truth.angles
    known = all(math.isfinite(value) for value in (*truth.place, *truth.speed, *truth.angles))
    above = truth.place[2] - truth.ground
    lies = max(abs(roll), abs(pitch)) > LIES and above < LIES_M
    return known and not lies and above > -1.0


def fly(copter: Copter, order: Order, log: Path | None = None, runs: bool = False) -> Trace:
    """Make a flight, and its log, if there is to be one, with each run of a task if so wanted."""
    copter.log(log, runs)
    trace = Flight(copter, order).fly()
    copter.log(None)
    return trace


def state_names(trace: Trace) -> list[str]:
    """The states that a flight went through, in order."""
    return runs_of([states()[number] for number in trace.view["state"]])


def runs_of(names: Sequence[str]) -> list[str]:
    """Each name once for each time that it begins."""
    return [name for number, name in enumerate(names) if number == 0 or names[number - 1] != name]
