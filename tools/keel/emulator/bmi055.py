# SPDX-License-Identifier: Apache-2.0
"""A model of the inertial unit BMI055 on an SPI (BST-BMI055-DS000): two devices in one package,
each with a select of its own."""

from __future__ import annotations

from dataclasses import dataclass, field

from keel.emulator.motion import Motion

GYROSCOPE_ID, ACCELEROMETER_ID = 0x0F, 0xFA
CHIP_ID, SAMPLE, TEMPERATURE, BANDWIDTH, POWER, RESET = 0x00, 0x02, 0x08, 0x10, 0x11, 0x14
SUSPENDED = 0x80
START_US = {GYROSCOPE_ID: 30_000, ACCELEROMETER_ID: 3_000}
WARM = 4  # Half degrees above 23: as warm as the model's other unit.


@dataclass
class Bmi055Part:
    """The gyroscope or the accelerometer: its registers, and where it is in an exchange."""

    identity: int
    there: bool = True
    motion: Motion = field(default_factory=Motion)
    registers: bytearray = field(default_factory=lambda: bytearray(64))
    selected: bool = False
    address: int = -1
    samples: int = 0
    started_us: int = 0

    def select(self, selected: bool) -> None:
        self.selected = selected
        self.address = -1

    def exchange(self, byte: int, now_us: int) -> int:
        """One byte each way; while it starts, zeros are read."""
        if not self.selected or not self.there:
            return 0xFF
        if self.address < 0:
            self.address = byte
            return 0
        place = self.address & 0x7F
        answer = self._read(place) if now_us >= self.started_us else 0
        if not self.address & 0x80:
            self._write(place, byte, now_us)
        self.address = (self.address & 0x80) | ((place + 1) & 0x7F)
        return answer

    def _read(self, place: int) -> int:
        if place == CHIP_ID:
            return self.identity
        if place == SAMPLE:  # A new sample with each burst.
            self.samples += 1
            data = b"".join(value.to_bytes(2, "little") for value in self._measured())
            self.registers[SAMPLE : SAMPLE + 6] = data
        if place == TEMPERATURE:
            return WARM
        if place == BANDWIDTH and self.identity == GYROSCOPE_ID:
            return self.registers[place] | 0x80  # It always reads so.
        return self.registers[place]

    def _measured(self) -> list[int]:
        """Rates in 16 bits; forces in the upper 12, of which one count is a 128th of g."""
        if self.identity == GYROSCOPE_ID:
            return [value & 0xFFFF for value in self.motion.rate(self.samples)]
        return [value & 0xFFF0 | 1 for value in self.motion.force(self.samples)]

    def _write(self, place: int, value: int, now_us: int) -> None:
        if place == RESET and value == 0xB6:
            self.registers[:] = bytes(64)
            self.registers[POWER] = SUSPENDED
            self.started_us = now_us + START_US[self.identity]
        elif place == POWER or not self.registers[POWER] & SUSPENDED:
            self.registers[place] = value
