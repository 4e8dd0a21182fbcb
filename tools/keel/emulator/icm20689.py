# SPDX-License-Identifier: Apache-2.0
"""A model of the inertial units ICM-20689 (DS-000143) and ICM-20602 (DS-000176) on an SPI, register
by register: in what the images use, they differ by their identity."""

from __future__ import annotations

from dataclasses import dataclass, field

from keel.emulator.motion import Motion

IDENTITY, OTHER = 0x98, 0x12  # Its own, and that of an ICM-20602.
WHO_AM_I, POWER, SAMPLE = 0x75, 0x6B, 0x3B
WARM = 327  # One degree above 25.


@dataclass
class Icm20689:
    """The unit: its registers, and where it is in an exchange."""

    identity: int = IDENTITY
    there: bool = True
    motion: Motion = field(default_factory=Motion)
    registers: bytearray = field(default_factory=lambda: bytearray(128))
    selected: bool = False
    address: int = -1
    samples: int = 0

    def select(self, selected: bool) -> None:
        self.selected = selected
        self.address = -1

    def exchange(self, byte: int, now_us: int) -> int:
        """One byte each way."""
        del now_us
        if not self.selected or not self.there:
            return 0xFF
        if self.address < 0:
            self.address = byte
            return 0
        place = self.address & 0x7F
        answer = self._read(place)
        if not self.address & 0x80:
            self._write(place, byte)
        self.address = (self.address & 0x80) | ((place + 1) & 0x7F)
        return answer

    def _read(self, place: int) -> int:
        if place == WHO_AM_I:
            return self.identity
        if place == SAMPLE:  # A new sample with each burst.
            self.samples += 1
            force, rate = self.motion.force(self.samples), self.motion.rate(self.samples)
            values = (*force, WARM, *rate)
            data = b"".join(value.to_bytes(2, "big", signed=True) for value in values)
            self.registers[SAMPLE : SAMPLE + 14] = data
        return self.registers[place]

    def _write(self, place: int, value: int) -> None:
        if place == POWER and value & 0x80:
            self.registers[:] = bytes(128)
            self.registers[POWER] = 0x40
        else:
            self.registers[place] = value
