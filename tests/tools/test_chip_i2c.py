# SPDX-License-Identifier: Apache-2.0
"""The models of an I2C and of the magnetometer on it: what they do, and what they refuse."""

from __future__ import annotations

import unittest

from keel.emulator.i2c import (
    AUTOEND,
    BUSY,
    CR1,
    CR2,
    ICR,
    ISR,
    NACKF,
    READS,
    RXDR,
    RXNE,
    START,
    STOP,
    STOPF,
    TC,
    TIMINGR,
    TXDR,
    TXIS,
    I2c,
    I2cError,
    timing_faults,
)
from keel.emulator.ist8310 import ADDRESS, Ist8310

TIMING = 0x10A6102D  # That of the driver, at 54 MHz.


class BusCase(unittest.TestCase):
    """A bus that is on, with a magnetometer."""

    def setUp(self) -> None:
        self.sensor = Ist8310()
        self.bus = I2c({ADDRESS: self.sensor})
        self.now_us = 0
        self.bus.write(TIMINGR, TIMING, 0)
        self.bus.write(CR1, 1, 0)

    def flags(self) -> int:
        return self.bus.read(ISR, self.now_us) & ~1

    def begin(self, count: int, options: int = 0, address: int = ADDRESS) -> None:
        self.bus.write(CR2, address << 1 | count << 16 | options | START, self.now_us)

    def put(self, *values: int) -> None:
        """As the driver writes."""
        self.begin(len(values), AUTOEND)
        for value in values:
            self.assertEqual(self.flags(), BUSY | TXIS)
            self.bus.write(TXDR, value, self.now_us)
        self.assertEqual(self.flags(), STOPF)
        self.bus.write(ICR, STOPF, self.now_us)

    def get(self, place: int, count: int) -> bytes:
        """As the driver reads."""
        self.begin(1)
        self.bus.write(TXDR, place, self.now_us)
        self.assertEqual(self.flags(), BUSY | TC)
        self.begin(count, READS | AUTOEND)
        come = []
        for _ in range(count):
            self.assertEqual(self.flags(), BUSY | RXNE)
            come.append(self.bus.read(RXDR, self.now_us))
        self.assertEqual(self.flags(), STOPF)
        self.bus.write(ICR, STOPF, self.now_us)
        return bytes(come)

    def off(self, accesses: int = 3) -> None:
        self.bus.write(CR1, 0, self.now_us)
        for _ in range(accesses):
            self.bus.read(CR1, self.now_us)


class BusTest(BusCase):
    def test_bytes_go_and_come(self) -> None:
        self.assertEqual(self.get(0, 1), b"\x10")
        self.put(0x0D, 0x70)
        self.assertEqual(self.get(0x0C, 2), b"\x00\x70")
        self.assertEqual(self.bus.transfers, 5)
        self.assertEqual(self.flags(), 0)

    def test_nobody_at_an_address(self) -> None:
        self.begin(2, AUTOEND, 0x1E)
        self.assertEqual(self.flags(), NACKF | STOPF)
        self.sensor.there = False
        self.bus.write(ICR, NACKF | STOPF, 0)
        self.begin(2, AUTOEND)
        self.assertEqual(self.flags(), NACKF | STOPF)

    def test_a_byte_that_is_not_acknowledged(self) -> None:
        self.sensor.take = lambda byte, now_us: False  # type: ignore[method-assign]
        self.begin(2, AUTOEND)
        self.bus.write(TXDR, 0x0A, 0)
        self.assertEqual(self.flags(), NACKF | STOPF)

    def test_a_stop_that_is_asked_for(self) -> None:
        self.begin(1)
        self.bus.write(TXDR, 0, 0)
        self.bus.write(CR2, STOP, 0)
        self.assertEqual(self.flags(), STOPF)

    def test_off_ends_all(self) -> None:
        self.begin(2, AUTOEND)
        self.off()
        self.assertEqual(self.flags(), 0)
        self.bus.write(CR1, 1, 0)
        self.assertEqual(self.get(0, 1), b"\x10")

    def test_a_bus_that_is_held(self) -> None:
        self.bus.held = 3
        self.assertEqual(self.bus.lines(), (True, False))
        self.begin(1)
        self.assertEqual(self.flags(), BUSY)
        for _ in range(3):
            self.assertEqual(self.bus.lines(), (True, False))
            self.bus.drive(False, True)
            self.bus.drive(True, True)
        self.assertEqual(self.bus.lines(), (True, True))
        self.bus.drive(True, False)
        self.assertEqual(self.bus.lines(), (True, False))
        self.bus.drive(True, True)
        self.off()
        self.bus.write(CR1, 1, 0)
        self.assertEqual(self.get(0, 1), b"\x10")


class RefusedTest(BusCase):
    def test_use_while_it_is_off(self) -> None:
        self.off()
        with self.assertRaisesRegex(I2cError, "while the I2C is off"):
            self.begin(1)

    def test_off_for_too_short(self) -> None:
        self.off(2)
        with self.assertRaisesRegex(I2cError, "three clocks"):
            self.bus.write(CR1, 1, 0)

    def test_two_at_once(self) -> None:
        self.begin(2, AUTOEND)
        with self.assertRaisesRegex(I2cError, "under way"):
            self.begin(2, AUTOEND)

    def test_flags_of_the_one_before(self) -> None:
        self.begin(1, AUTOEND)
        self.bus.write(TXDR, 0, 0)
        with self.assertRaisesRegex(I2cError, "flags of the one before"):
            self.begin(1)

    def test_no_bytes(self) -> None:
        with self.assertRaisesRegex(I2cError, "reads no bytes"):
            self.begin(0, READS | AUTOEND)

    def test_another_kind(self) -> None:
        for options in (1, 1 << 11, 1 << 24):
            with self.assertRaisesRegex(I2cError, "another kind"):
                self.begin(1, options)

    def test_bytes_that_nobody_asked_for(self) -> None:
        with self.assertRaisesRegex(I2cError, "did not ask"):
            self.bus.write(TXDR, 0, 0)
        with self.assertRaisesRegex(I2cError, "has not come"):
            self.bus.read(RXDR, 0)

    def test_timings(self) -> None:
        with self.assertRaisesRegex(I2cError, "while the I2C is on"):
            self.bus.write(TIMINGR, TIMING, 0)
        self.assertEqual(timing_faults(TIMING, 54_000_000), [])
        for timing, text in {
            TIMING - 1: "SCL runs at 40[1-9] kHz",
            0x10A62022: "SCL is low for 1296 ns",
            0x10A60F2E: "SCL is high for 593 ns",
            0x10A5102D: "data change 185 ns",
            0x10A8102D: "data change 296 ns",
            0x1096102D: "set up for 370 ns",
            0: "kHz",
        }.items():
            self.off()
            self.bus.write(TIMINGR, timing, 0)
            with self.assertRaisesRegex(I2cError, text):
                self.bus.write(CR1, 1, 0)


class SensorTest(BusCase):
    def started(self) -> None:
        for place, value in ((0x41, 0x24), (0x42, 0xC0), (0x0D, 0x70)):
            self.put(place, value)

    def test_a_reset_takes_50_ms(self) -> None:
        self.started()
        self.put(0x0B, 1)
        self.now_us = 49_999
        self.put(0x0D, 0x70)
        self.assertEqual(self.get(0x0B, 1), b"\x01")
        self.now_us = 50_000
        self.assertEqual(self.get(0x0B, 3), b"\x00\x00\x00")
        self.assertEqual(self.sensor.resets, 1)

    def test_a_measurement_takes_6_ms(self) -> None:
        self.started()
        self.put(0x0A, 1)
        self.now_us = 5_999
        self.assertEqual(self.get(0x02, 1), b"\x00")
        self.now_us = 6_000
        self.assertEqual(self.get(0x02, 7), bytes.fromhex("01 0901 0800 1102"))
        self.assertEqual(self.get(0x02, 1), b"\x00")  # Once.
        self.assertEqual(self.get(0x0A, 1), b"\x00")
        self.assertEqual(self.get(0x1C, 2), bytes.fromhex("4101"))

    def test_overruns(self) -> None:
        self.started()
        for _ in range(2):
            self.put(0x0A, 1)
            self.now_us += 6_000
        self.assertEqual(self.get(0x02, 1), b"\x03")

    def test_a_brown_out_changes_the_units(self) -> None:
        self.started()
        self.sensor.counts = (-264, 400, 800)
        self.put(0x0A, 1)
        self.sensor.brown_out()
        self.now_us += 10_000
        self.assertEqual(self.get(0x02, 1), b"\x00")
        self.put(0x0A, 1)
        self.now_us += 6_000
        # (-264 + 1) / 4, rounded down: -66; then 100 and 200.
        self.assertEqual(self.get(0x02, 7), bytes.fromhex("01 BEFF 6400 C800"))

    def test_what_cannot_be_written(self) -> None:
        self.put(0x00, 0x48)
        self.assertEqual(self.get(0x00, 1), b"\x10")


if __name__ == "__main__":
    unittest.main()
