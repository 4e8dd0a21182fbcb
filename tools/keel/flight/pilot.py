# SPDX-License-Identifier: Apache-2.0
"""The pilot: waits until he may start the motors, then does what the scenario says.

He sees the aircraft itself, not what it believes; when told to be at a height he moves the
throttle by what he sees.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from keel.flight.scenario import Hand, Scenario
from keel.plants.plants import Truth

MIDDLE, WAY = 1500, 512
OFF, ON = 1000, 2000
CHANNELS = 8
READY_S = 0.6  # He looks at "ready" for so long before he switches on.
CLIMB, SINK = 1.5, 0.7  # What he climbs and sinks with, in m/s.
TOUCH_M = 0.06


@dataclass
class Sight:
    """What he sees when a frame is sent."""

    time_s: float  # Of the flight; before the motors start, negative.
    truth: Truth
    ready: bool
    thrusts: bool  # The throttle is the thrust, not the climb rate.
    mode_channels: dict[str, int]
    turning: bool = False  # The motors.


@dataclass
class Pilot:
    """His hands."""

    scenario: Scenario
    frame_s: float
    sticks: dict[str, float] = field(default_factory=dict)
    waves: tuple[tuple[str, float, float, float], ...] = ()
    mode: str = ""
    armed: bool = False
    killed: bool = False
    height: float | None = None
    lands: bool = False
    ready_s: float = 0.0
    hover: float = 0.0  # Where his throttle hovers.
    on_ground_s: float = 0.0
    done: int = 0

    def __post_init__(self) -> None:
        self.sticks = {"roll": 0.0, "pitch": 0.0, "throttle": -1.0, "yaw": 0.0}
        self.mode = self.scenario.mode

    def frame(self, sight: Sight) -> list[int]:
        """The channels that his transmitter sends now."""
        if sight.time_s < 0.0:
            self._wait(sight)
        else:
            self._act(sight.time_s)
            self._fly(sight)
        sticks = [self._stick(name, sight.time_s) for name in ("roll", "pitch", "throttle", "yaw")]
        way = self.scenario.stick_way * WAY
        ends = [MIDDLE + round(way * max(-1.0, min(1.0, stick))) for stick in sticks]
        return [
            *ends,
            ON if self.armed else OFF,
            sight.mode_channels[self.mode],
            ON if self.killed else OFF,
            MIDDLE,
        ]

    def _wait(self, sight: Sight) -> None:
        """Throttle low; on when all is well."""
        self.ready_s = self.ready_s + self.frame_s if sight.ready else 0.0
        self.armed = self.armed or self.ready_s >= READY_S

    def _act(self, time_s: float) -> None:
        """What the scenario has for this time."""
        hands = self.scenario.pilot
        while self.done < len(hands) and hands[self.done].at_s <= time_s:
            self._take(hands[self.done])
            self.done += 1

    def _take(self, hand: Hand) -> None:
        """One entry of the scenario."""
        for name in self.sticks:
            value = getattr(hand, name)
            if value is not None:
                self.sticks[name] = value
                self.waves = tuple(wave for wave in self.waves if wave[0] != name)
                self.height = None if name == "throttle" else self.height
        if hand.still:
            self.waves = ()
        if hand.wave:
            self.waves = (
                *self.waves,
                *((wave.stick, wave.amplitude, wave.period_s, hand.at_s) for wave in hand.wave),
            )
        self.mode = hand.mode or self.mode
        self.armed = self.armed if hand.arm is None else hand.arm
        self.killed = self.killed if hand.kill is None else hand.kill
        self.height = self.height if hand.height_m is None else hand.height_m
        self.lands = self.lands or hand.lands

    def _stick(self, name: str, time_s: float) -> float:
        """A stick's place, with its waves."""
        return self.sticks[name] + sum(
            amplitude * math.sin(2.0 * math.pi * (time_s - start_s) / period_s)
            for stick, amplitude, period_s, start_s in self.waves
            if stick == name
        )

    def _fly(self, sight: Sight) -> None:
        """Move the throttle by sight."""
        up, climbing = sight.truth.place[2], sight.truth.speed[2]
        if self.lands:
            self._land(up - sight.truth.ground, climbing, sight.thrusts)
        elif self.height is not None:
            error = self.height - up
            wanted = max(-SINK, min(CLIMB, 0.8 * error))
            if not sight.thrusts and abs(error) < 0.15 and abs(climbing) < 0.2:
                wanted = 0.0  # It holds the height by itself: hands off.
            self._climb(wanted, climbing, sight.thrusts)

    def _climb(self, wanted: float, climbing: float, thrusts: bool) -> None:
        """The throttle for a climb rate."""
        if not thrusts:
            # What he wants beyond the dead band; climbing is asked for with more than sinking.
            push = (0.08 if wanted > 0 else -0.08) if wanted != 0.0 else 0.0
            self.sticks["throttle"] = max(-0.9, min(0.9, push + 0.6 * wanted))
            return
        self.hover = max(-0.3, min(0.3, self.hover + 0.1 * (wanted - climbing) * self.frame_s))
        self.sticks["throttle"] = max(-0.8, min(0.6, self.hover + 0.25 * (wanted - climbing)))

    def _land(self, up: float, climbing: float, thrusts: bool) -> None:
        """Down, slower near the ground; then throttle low and, a while later, off."""
        if self.on_ground_s > 0.0 or up < TOUCH_M:
            self.on_ground_s += self.frame_s
            self.sticks["throttle"] = -1.0
            self.armed = self.armed and self.on_ground_s < 2.5
            return
        self._climb(-max(0.35, min(SINK, 0.4 * up)), climbing, thrusts)


TAKES_OFF_S, STANDS_M = 2.0, 5.0


@dataclass
class Bystander(Pilot):
    """He leaves switches to a ground station. Once it has started the motors he climbs to 5 m, and
    lets go of the sticks until they stop."""

    turning_s: float = 0.0

    def frame(self, sight: Sight) -> list[int]:
        """As a pilot who is told to do so."""
        self.turning_s = self.turning_s + self.frame_s if sight.turning else 0.0
        up = sight.truth.place[2]
        if not sight.turning:
            self.sticks["throttle"], self.height = -1.0, None
        elif self.height is None and TAKES_OFF_S <= self.turning_s < TAKES_OFF_S + self.frame_s:
            self.height = STANDS_M
        elif self.height is not None and abs(self.height - up) < 0.15:
            self.sticks["throttle"], self.height = 0.0, None
        return super().frame(sight)

    def _wait(self, sight: Sight) -> None:
        """He does not switch on."""
