# SPDX-License-Identifier: Apache-2.0
"""The timers that make pulses and the pins that put them out, in the model of the STM32F767."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from keel.base.errors import ToolError
from keel.boards.sockets import pin_of

GPIOA, RCC = 0x4002_0000, 0x4002_3800
APB1ENR, APB2ENR, CFGR = RCC + 0x40, RCC + 0x44, RCC + 8
# Offsets of a timer's registers.
CR1, CR2, SMCR, DIER, SR, EGR, CCMR1, CCMR2, CCER, CNT, PSC, ARR, RCR, CCR1, BDTR = (
    0,
    4,
    8,
    0xC,
    0x10,
    0x14,
    0x18,
    0x1C,
    0x20,
    0x24,
    0x28,
    0x2C,
    0x30,
    0x34,
    0x44,
)
PWM_1 = 6  # The mode of a channel: high while the counter is below the compare value.

FLOATS, LOW, HIGH, OTHER = "floats", "low", "high", "other"


class PulseError(ToolError):
    """The image puts out what must not be."""

    status = 1


class Pulse(NamedTuple):
    """What comes out of a pin again and again, in us."""

    us: float
    period_us: float


State = str | Pulse


@dataclass
class Timer:
    """A timer that makes pulses."""

    base: int
    channels: int
    has_gate: bool
    enable: tuple[int, int]  # Its clock: the register, and the bit.
    active: list[int] = field(default_factory=lambda: [0, 0, 0, 0])  # What it works with.
    from_us: float = 0  # When its counter was 0.

    def lacks(self, offset: int) -> bool:
        """Whether it has no such register."""
        missing = set() if self.has_gate else {RCR, BDTR}
        if self.channels == 2:
            missing |= {CR2, CCMR2, CCR1 + 8, CCR1 + 12}
        return offset in missing

    def mhz(self, words: Mapping[int, int]) -> float:
        """Its clock: twice the bus's, where that is divided (RM0410, 5.2)."""
        word = words.get(CFGR, 0)
        core = 216 if word & 0xC == 8 else 16
        code = word >> (13 if self.enable[0] == APB2ENR else 10) & 7
        return core / (1 << code - 4) if code >= 4 else core

    def tick_us(self, words: Mapping[int, int]) -> float:
        """How long its counter stays at a value."""
        return (words.get(self.base + PSC, 0) + 1) / self.mhz(words)

    def period_us(self, words: Mapping[int, int]) -> float:
        return (words.get(self.base + ARR, 0xFFFF) + 1) * self.tick_us(words)

    def preloads(self, words: Mapping[int, int], channel: int) -> bool:
        """Whether a channel takes its pulse over at a new period only."""
        word = words.get(self.base + (CCMR1 if channel < 2 else CCMR2), 0)
        return bool(word & (8 << 8 * (channel & 1)))

    def take_over(self, words: Mapping[int, int]) -> None:
        self.active = [words.get(self.base + CCR1 + 4 * i, 0) for i in range(4)]

    def state(self, words: Mapping[int, int], channel: int) -> State:
        """What it would do with a pin of a channel, from 0 on."""
        word = words.get(self.base + (CCMR1 if channel < 2 else CCMR2), 0)
        if not words.get(self.base + CCER, 0) >> 4 * channel & 1:
            return FLOATS
        if self.has_gate and not words.get(self.base + BDTR, 0) >> 15 & 1:
            return LOW if words.get(self.base + BDTR, 0) >> 10 & 1 else FLOATS
        inverted = words.get(self.base + CCER, 0) >> 4 * channel + 1 & 1
        if word >> 8 * (channel & 1) + 4 & 7 != PWM_1 or inverted:
            return OTHER
        if not words.get(self.base + CR1, 0) & 1:
            return OTHER
        if not self.active[channel]:
            return LOW
        return Pulse(
            round(self.active[channel] * self.tick_us(words), 3), round(self.period_us(words), 3)
        )


def timers() -> dict[str, Timer]:
    """The timers of the chip that the boards use (RM0410, table 1 and 5.3)."""
    return {
        "TIM1": Timer(0x4001_0000, 4, True, (APB2ENR, 0)),
        "TIM4": Timer(0x4000_0800, 4, False, (APB1ENR, 2)),
        "TIM12": Timer(0x4000_1800, 2, False, (APB1ENR, 6)),
        "TIM9": Timer(0x4001_4000, 2, False, (APB2ENR, 16)),
    }


# That give a pin to each (data sheet, table 13).
FUNCTIONS = {"TIM1": 1, "TIM4": 2, "TIM12": 9, "TIM9": 3}


class Outputs:
    """A board's outputs, each a pin and its timer's channel, or a pin alone: what each does, and
    since when."""

    def __init__(self, names: Sequence[str]) -> None:
        self.pins = [pin_of(name.split()[0]) for name in names]
        self.ports = {GPIOA + 0x400 * port for port, _ in self.pins}  # By their bases.
        self.owners = [name.partition(" ")[2].partition("_CH") for name in names]
        self.timers = timers()
        self.by_base = {timer.base: timer for timer in self.timers.values()}
        self.log: list[list[tuple[float, State]]] = [[] for _ in names]
        self.due_us: float | None = None  # When a timer takes pulses over.

    def state(
        self, words: Mapping[int, int], high: Collection[tuple[int, int]], number: int
    ) -> State:
        """What an output does now."""
        port, pin = self.pins[number]
        base = GPIOA + 0x400 * port
        mode = words.get(base, 0) >> 2 * pin & 3
        if mode == 1:
            return HIGH if (port, pin) in high else LOW
        if mode != 2:
            return FLOATS
        name, _, channel = self.owners[number]
        if not name:
            return OTHER
        if words.get(base + 0x20 + 4 * (pin // 8), 0) >> 4 * (pin % 8) & 0xF != FUNCTIONS[name]:
            return OTHER
        return self.timers[name].state(words, int(channel) - 1)

    def note(
        self,
        time_us: float,
        words: Mapping[int, int],
        high: Collection[tuple[int, int]],
        at_period: bool = False,
    ) -> None:
        """Writes down what has changed; only a new period begins pulses."""
        for number, log in enumerate(self.log):
            now = self.state(words, high, number)
            if log and log[-1][1] == now:
                continue
            if isinstance(now, Pulse) and not at_period:
                raise PulseError(f"output {number + 1} puts out a part of a pulse")
            log.append((time_us, now))

    def reset(self, time_us: float) -> None:
        self.timers = timers()
        self.by_base = {timer.base: timer for timer in self.timers.values()}
        self.due_us = None
        for log in self.log:
            if not log or log[-1][1] != FLOATS:
                log.append((time_us, FLOATS))

    def write(self, base: int, offset: int, time_us: float, words: dict[int, int]) -> bool:
        """A timer's register was written; whether a period begins by it."""
        timer = self.by_base[base]
        if timer.lacks(offset):
            raise PulseError(f"0x{base + offset:08x} is no register of this timer")
        if offset == EGR and words[base + EGR] & 1:
            timer.take_over(words)
            timer.from_us = time_us
            return True
        channel = (offset - CCR1) // 4
        if CCR1 <= offset < BDTR and not timer.preloads(words, channel):
            timer.active[channel] = words[base + offset]
        elif CCR1 <= offset < BDTR and words.get(base + CR1, 0) & 1:
            period_us = timer.period_us(words)
            begun = (time_us - timer.from_us) // period_us
            next_us = timer.from_us + (begun + 1) * period_us
            self.due_us = min(next_us, self.due_us or next_us)
        return False

    def advance(self, time_us: float, words: Mapping[int, int]) -> None:
        """Timers whose period has begun take their pulses over."""
        self.due_us = None
        for timer in self.timers.values():
            period_us = timer.period_us(words)
            begun = (time_us - timer.from_us) // period_us
            if words.get(timer.base + CR1, 0) & 1 and begun > 0:
                timer.take_over(words)
                timer.from_us += begun * period_us
            elif words.get(timer.base + CR1, 0) & 1:
                next_us = timer.from_us + period_us
                pending = [words.get(timer.base + CCR1 + 4 * i, 0) for i in range(4)]
                if pending != timer.active:
                    self.due_us = min(next_us, self.due_us or next_us)
