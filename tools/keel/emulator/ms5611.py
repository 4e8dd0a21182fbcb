# SPDX-License-Identifier: Apache-2.0
"""A model of the barometer MS5611-01BA03 on a bus, command by command (data sheet, and AN520)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from keel.emulator.motion import mixed

# The data sheet's example: with these the pressure is 1000.09 mbar and it is 20.07 degrees warm.
COEFFICIENTS = (40127, 36924, 23317, 23282, 33464, 28312)
PRESSURE, TEMPERATURE = 9085466, 8569150
RESET, READ = 0x1E, 0x00
RESET_US, CONVERSION_US = 2800, 9040  # 4096 times oversampled.


def check_of(words: Sequence[int]) -> int:
    """The four bits that guard the PROM: a remainder by 0x3000, bit by bit."""
    rest = 0
    for byte in b"".join(word.to_bytes(2, "big") for word in (*words[:7], words[7] & 0xFF00)):
        rest ^= byte
        for _ in range(8):
            rest = (rest << 1 ^ 0x3000 if rest & 0x8000 else rest << 1) & 0xFFFF
    return rest >> 12


def prom() -> list[int]:
    words = [0x1234, *COEFFICIENTS, 0]
    words[7] |= check_of(words)
    return words


@dataclass
class Ms5611:
    """The barometer. The time is the chip's: the model tells it with each byte."""

    there: bool = True
    noise: int = 8  # Counts; a sensor has some 300, a few Pa.
    words: list[int] = field(default_factory=prom)
    selected: bool = False
    come: list[int] = field(default_factory=list)  # Since it was selected.
    busy_until_us: int = 0
    converted: int = 0  # What the next reading gives; once.
    samples: int = 0
    resets: int = 0

    def select(self, selected: bool) -> None:
        self.selected = selected
        self.come.clear()

    def exchange(self, byte: int, now_us: int) -> int:
        """One byte each way; what is read comes behind its command."""
        if not self.selected or not self.there:
            return 0xFF
        self.come.append(byte)
        command, behind = self.come[0], len(self.come) - 2
        if behind < 0:
            self._obey(command, now_us)
            return 0xFE
        if 0xA0 <= command <= 0xAE and behind < 2:
            return self.words[(command - 0xA0) // 2] >> 8 * (1 - behind) & 0xFF
        if command == READ and behind < 3:
            answer = self.converted if now_us >= self.busy_until_us else 0
            if behind == 2:
                self.converted = 0
            return answer >> 8 * (2 - behind) & 0xFF
        return 0xFF

    def _obey(self, command: int, now_us: int) -> None:
        if command == RESET:
            self.resets += 1
            self.busy_until_us = now_us + RESET_US
        elif command in (0x48, 0x58) and now_us >= self.busy_until_us:
            self.samples += command == 0x48
            raw = PRESSURE if command == 0x48 else TEMPERATURE
            self.converted = raw + mixed(self.samples, 0) % self.noise
            self.busy_until_us = now_us + CONVERSION_US
