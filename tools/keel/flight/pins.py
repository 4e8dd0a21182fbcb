# SPDX-License-Identifier: Apache-2.0
"""What the outputs of a board did over a flight, by each change of their pins.

    no pulse while they are not armed, which the board says by nARMED
    pulses of 1000 to 2000 us, 400 a second to within 0.1 %
    low within 1 ms of a fault and of a reset, until they are armed again

The last pulse before they are switched off may be cut short. A pin may float behind a reset, and
for as long as it may then be anything but low.
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

OUTPUTS, ARMED, EVENT, RESET = 8, 8, 9, 256
FLOATS, LOW, HIGH = range(3)
TICKS = 432  # Of a microsecond.
SHORTEST_US, LONGEST_US, PERIOD_US = 1000.0, 2000.0, 2500.0
PERIOD_SHARE = 0.001
LOW_WITHIN_US = 1000.0
OFF_US = 1000.0  # From the first output that is switched off to nARMED, at most.
CAUSES = ("supply", "software", "watchdog")
NMI = 2


@dataclass(frozen=True)
class Event:
    """An exception, or a reset."""

    at_us: float
    number: int

    @property
    def is_reset(self) -> bool:
        return self.number >= RESET

    @property
    def name(self) -> str:
        """In words."""
        if self.is_reset:
            return f"reset by {CAUSES[self.number - RESET]}"
        return "NMI" if self.number == NMI else f"exception {self.number}"


@dataclass(frozen=True)
class Stretch:
    """For how long a pin is at a level."""

    from_us: float
    to_us: float
    level: int


@dataclass
class Pins:
    """What came out."""

    pulses: int = 0
    cut: int = 0  # By switching off.
    width_us: tuple[float, float] = (math.inf, -math.inf)
    period_us: tuple[float, float] = (math.inf, -math.inf)
    low_after_us: dict[str, float] = field(default_factory=dict)  # At the latest, by events' names.
    armed: list[tuple[float, float]] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    mistakes: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        words = [f"{self.pulses} pulses"]
        if self.pulses > self.cut:
            words[0] += f" of {self.width_us[0]:.1f} to {self.width_us[1]:.1f} us"
        if self.period_us[1] > 0.0:
            slow, fast = 1e6 / self.period_us[1], 1e6 / self.period_us[0]
            words.append(f"{slow:.2f} to {fast:.2f} Hz")
        words += [f"low {late:.1f} us after {name}" for name, late in self.low_after_us.items()]
        return "; ".join([*words, *self.mistakes[:3]])


def stretches(edges: Any, line: int, end_us: float) -> list[Stretch]:
    """What a line did, from its first change to the end."""
    own = edges[edges["line"] == line]
    times = [*(own["at"] / TICKS).tolist(), end_us]
    levels = own["level"].tolist()
    found = zip(times, times[1:], levels, strict=False)
    return [Stretch(*one) for one in found if one[1] > one[0]]


def measured(edges: Any, end_us: float) -> Pins:
    """All outputs of a flight that ended at a time since power-up."""
    told = edges[edges["line"] == EVENT]
    pins = Pins(
        armed=[(it.from_us, it.to_us) for it in stretches(edges, ARMED, end_us) if it.level == LOW],
        events=[Event(float(at) / TICKS, int(number)) for at, _, number in told.tolist()],
    )
    for output in range(OUTPUTS):
        line = stretches(edges, output, end_us)
        pins.mistakes += [f"output {output + 1} {words}" for words in judged(pins, line)]
    return pins


def judged(pins: Pins, line: list[Stretch]) -> Iterator[str]:
    """What is wrong with an output; what it did is noted."""
    yield from judged_pulses(pins, [it for it in line if it.level == HIGH])
    for number, event in enumerate(pins.events):
        late_us = low_after(pins, number, line)
        before = pins.low_after_us.get(event.name, 0.0)
        pins.low_after_us[event.name] = max(before, late_us)
        if late_us > LOW_WITHIN_US:
            yield f"is not low {late_us:.0f} us after {event.name} at {event.at_us / 1e6:.4f} s"
    resets = [event.at_us for event in pins.events if event.is_reset]
    for it in line:
        behind = bisect.bisect_right(resets, it.from_us)
        if it.level == FLOATS and (not behind or it.from_us > resets[behind - 1]):
            yield f"floats from {it.from_us / 1e6:.4f} s on"


def judged_pulses(pins: Pins, pulses: list[Stretch]) -> Iterator[str]:
    """Of an output."""
    begins = [from_us for from_us, _ in pins.armed]
    last: tuple[int, float] | None = None
    for pulse in pulses:
        at, width_us = f"at {pulse.from_us / 1e6:.4f} s", pulse.to_us - pulse.from_us
        turn = bisect.bisect_right(begins, pulse.from_us) - 1
        if turn < 0 or pulse.from_us >= pins.armed[turn][1]:
            yield f"rises {at}, while it is not armed"
            continue
        pins.pulses += 1
        if pulse.to_us >= pins.armed[turn][1] - OFF_US and width_us < SHORTEST_US:
            pins.cut += 1
        else:
            pins.width_us = widened(pins.width_us, width_us)
            if not SHORTEST_US - 0.01 <= width_us <= LONGEST_US + 0.01:
                yield f"has a pulse of {width_us:.1f} us {at}"
        if last and last[0] == turn:
            period_us = pulse.from_us - last[1]
            pins.period_us = widened(pins.period_us, period_us)
            if abs(period_us - PERIOD_US) > PERIOD_SHARE * PERIOD_US:
                yield f"has a period of {period_us:.1f} us {at}"
        last = (turn, pulse.from_us)


def widened(span: tuple[float, float], value: float) -> tuple[float, float]:
    """With another value."""
    return min(span[0], value), max(span[1], value)


def low_after(pins: Pins, number: int, line: list[Stretch]) -> float:
    """From an event on, up to the next one or the next arming: how long until it stays low, us."""
    from_us = pins.events[number].at_us
    ends = [event.at_us for event in pins.events[number + 1 :]]
    ends += [armed for armed, _ in pins.armed if armed > from_us]
    to_us = min(ends, default=math.inf)
    inside = [it for it in line if it.to_us > from_us and it.from_us < to_us and it.level != LOW]
    return max((min(it.to_us, to_us) - from_us for it in inside), default=0.0)
