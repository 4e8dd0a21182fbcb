# SPDX-License-Identifier: Apache-2.0
"""A model of the magnetometer IST8310 on an I2C, register by register."""

from __future__ import annotations

from dataclasses import dataclass, field

ADDRESS, IDENTITY = 0x0E, 0x10
STATUS, FIELD, CONTROL_1, CONTROL_2, CONTROL_3 = 0x02, 0x03, 0x0A, 0x0B, 0x0D
HEAT, AVERAGE, PULSE = 0x1C, 0x41, 0x42
READY, OVERRUN, SINGLE, SOFT_RESET = 1, 2, 1, 1
RESET_US, MEASURE_US = 50_000, 6_000  # 16 times averaged.
WRITABLE = (CONTROL_1, CONTROL_2, 0x0C, CONTROL_3, AVERAGE, PULSE)


def defaults() -> bytearray:
    """Its registers after a reset."""
    registers = bytearray(256)
    registers[0] = IDENTITY
    return registers


@dataclass
class Ist8310:
    """The magnetometer: it knows no field, only what it measures, in its own axes."""

    there: bool = True
    counts: tuple[int, int, int] = (264, 7, 528)  # 1320 a gauss: forward, right and up.
    temperature: int = 321
    registers: bytearray = field(default_factory=defaults)
    resets: int = 0
    samples: int = 0
    _place: int | None = None  # The register that is next; None: it comes with the next byte.
    _reset_until_us: int | None = None
    _measured_at_us: int | None = None

    def begin(self, reads: bool, now_us: int) -> bool:
        """It is addressed."""
        self._pass(now_us)
        if not reads:
            self._place = None
        return self.there

    def take(self, byte: int, now_us: int) -> bool:
        """The register's address first, then what is written there and behind it."""
        self._pass(now_us)
        if self._place is None:
            self._place = byte
        else:
            self._write(self._place, byte, now_us)
            self._place = (self._place + 1) & 0xFF
        return True

    def give(self, now_us: int) -> int:
        """The next register; reading the field takes the sample away."""
        self._pass(now_us)
        place = self._place or 0
        self._place = (place + 1) & 0xFF
        if FIELD <= place < FIELD + 6:
            self.registers[STATUS] = 0
        return self.registers[place]

    def brown_out(self) -> None:
        """Its supply fails for a moment."""
        self.registers = defaults()
        self._reset_until_us = self._measured_at_us = None

    def _write(self, place: int, byte: int, now_us: int) -> None:
        if self._reset_until_us is not None or place not in WRITABLE:
            return
        self.registers[place] = byte
        if place == CONTROL_2 and byte & SOFT_RESET:
            self.resets += 1
            self._reset_until_us = now_us + RESET_US
            self._measured_at_us = None
        elif place == CONTROL_1 and byte & 0xF == SINGLE:
            self._measured_at_us = now_us + MEASURE_US

    def _pass(self, now_us: int) -> None:
        """What has ended by now."""
        if self._reset_until_us is not None and now_us >= self._reset_until_us:
            self._reset_until_us = None
            self.registers = defaults()
        if self._measured_at_us is not None and now_us >= self._measured_at_us:
            self._measured_at_us = None
            self._measure()

    def _measure(self) -> None:
        """A sample, with a little noise; one that was not read is overrun."""
        self.samples += 1
        for axis, value in enumerate(self.counts):
            count = value + self.samples % 4
            fine = self.registers[CONTROL_3] & 0x10 << axis
            self._put(FIELD + 2 * axis, count if fine else count // 4)
        self._put(HEAT, self.temperature)
        waiting = self.registers[STATUS] & READY
        self.registers[STATUS] = READY | (OVERRUN if waiting else 0)
        self.registers[CONTROL_1] = 0

    def _put(self, place: int, value: int) -> None:
        self.registers[place : place + 2] = value.to_bytes(2, "little", signed=True)
