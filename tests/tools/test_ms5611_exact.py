# SPDX-License-Identifier: Apache-2.0
"""The MS5611's formulas beside exact fractions, and its check beside division of polynomials."""

from __future__ import annotations

import ctypes
import random
import shutil
import unittest
from fractions import Fraction
from pathlib import Path
from typing import ClassVar, NamedTuple

from shim import library_of

ROOT = Path(__file__).resolve().parents[2]

# A sensor behind functions of whole numbers alone, so that nothing here knows how it is laid out.
SHIM = """\
#include "keel/middleware/ms5611.h"
static keel_ms5611_t ms5611;
static keel_ms5611_sample_t sample;
int check(const uint16_t *word) { return keel_ms5611_crc(word); }
int begin(const uint16_t *word) { return (int)keel_ms5611_init(&ms5611, word); }
int measure(unsigned d1, unsigned d2)
{
    sample = (keel_ms5611_sample_t){-1, -1};
    return (int)keel_ms5611_compensate(&ms5611, d1, d2, &sample);
}
int pressure(void) { return sample.pressure_pa; }
int temperature(void) { return sample.temperature_cdeg; }
"""

OK, NOT_READY, COLD_OR_HOT, NO_AIR = 0, 2, 21, 25  # Positions in keel_status_t.
TYPICAL = (40127, 36924, 23317, 23282, 33464, 28312)
ENDS = (0, 1, 32767, 32768, 65534, 65535)


class Measured(NamedTuple):
    pressure: Fraction
    temperature: Fraction


def exact(coefficients: tuple[int, ...], d1: int, d2: int) -> Measured:
    """The data sheet's formulas without any rounding, but for TEMP, which decides the branches."""
    c1, c2, c3, c4, c5, c6 = coefficients
    difference = d2 - c5 * 2**8
    first = 2000 + int(Fraction(difference * c6, 2**23))
    offset = c2 * 2**16 + Fraction(c4 * difference, 2**7)
    sensitivity = c1 * 2**15 + Fraction(c3 * difference, 2**8)
    temperature = Fraction(first)
    if first < 2000:
        temperature -= Fraction(difference**2, 2**31)
        offset -= Fraction(5 * (first - 2000) ** 2, 2)
        sensitivity -= Fraction(5 * (first - 2000) ** 2, 4)
    if first < -1500:
        offset -= 7 * (first + 1500) ** 2
        sensitivity -= Fraction(11 * (first + 1500) ** 2, 2)
    return Measured((d1 * sensitivity / 2**21 - offset) / 2**15, temperature)


def rest(words: list[int]) -> int:
    """What is left of the first 15 bytes, as one polynomial, divided by x^4 + x + 1."""
    number = 0
    for word in words:
        number = number << 16 | word
    number = number >> 8 << 4
    for bit in range(123, 3, -1):
        if number >> bit & 1:
            number ^= 0b10011 << (bit - 4)
    return number


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Exact(unittest.TestCase):
    """Any PROM, any readings."""

    library: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.library = library_of(cls, SHIM, ["src/middleware/ms5611.c"])

    def setUp(self) -> None:
        self.random = random.Random(20261123)

    def words(self, coefficients: tuple[int, ...]) -> list[int]:
        words = [self.random.getrandbits(16), *coefficients, self.random.getrandbits(16)]
        words[0] |= 1  # Not all of them 0.
        return [*words[:7], words[7] & 0xFFF0 | rest(words)]

    def begin(self, words: list[int]) -> int:
        status: int = self.library.begin((ctypes.c_uint16 * 8)(*words))
        return status

    def same(self, coefficients: tuple[int, ...], d1: int, d2: int) -> int:
        """Within a step of the exact result, and refused if and only if that is out of range."""
        is_exact = exact(coefficients, d1, d2)
        status: int = self.library.measure(d1, d2)
        if status == OK:
            self.assertLess(abs(self.library.pressure() - is_exact.pressure), Fraction(1001, 1000))
            self.assertLess(abs(self.library.temperature() - is_exact.temperature), 1)
        elif status == COLD_OR_HOT:
            self.assertFalse(-4000 < is_exact.temperature < 8500)
        else:
            self.assertEqual(status, NO_AIR)
            self.assertFalse(1000 < is_exact.pressure - 1 and is_exact.pressure + 1 < 120000)
        return status

    def test_the_check(self) -> None:
        for _ in range(5000):
            words = [self.random.getrandbits(16) for _ in range(8)]
            check = self.library.check((ctypes.c_uint16 * 8)(*words))
            self.assertEqual(check, rest(words))
            self.assertEqual(self.begin(words) == OK, words[7] % 16 == check)

    def test_random_sensors(self) -> None:
        taken = 0
        for _ in range(300):
            coefficients = tuple(value + self.random.randint(-3000, 3000) for value in TYPICAL)
            self.assertEqual(self.begin(self.words(coefficients)), OK)
            for _ in range(50):
                d1 = self.random.randint(1, 2**24 - 1)
                d2 = self.random.randint(6_000_000, 11_000_000)
                taken += self.same(coefficients, d1, d2) == OK
        self.assertGreater(taken, 3000)

    def test_coefficients_and_readings_at_their_ends(self) -> None:
        met = set()
        for _ in range(2000):
            coefficients = tuple(self.random.choice(ENDS) for _ in range(6))
            self.assertEqual(self.begin(self.words(coefficients)), OK)
            for d1 in (1, 2**23, 2**24 - 1, self.random.randint(1, 2**24 - 1)):
                for d2 in (1, 2**23, 2**24 - 1, self.random.randint(1, 2**24 - 1)):
                    met.add(self.same(coefficients, d1, d2))
        self.assertEqual(met, {OK, COLD_OR_HOT, NO_AIR})

    def test_no_reading(self) -> None:
        self.assertEqual(self.begin(self.words(TYPICAL)), OK)
        self.assertEqual(self.library.measure(0, 8569150), NOT_READY)
        self.assertEqual(self.library.measure(9085466, 0), NOT_READY)
