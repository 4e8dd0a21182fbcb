# SPDX-License-Identifier: Apache-2.0
"""The model of a timer that captures edges by DMA, and what it refuses."""

from __future__ import annotations

import unittest

from keel.emulator.capture import Capture
from keel.emulator.dma_uart import COMPLETE, EN, FCR, HALF, M0AR, NDTR, PAR, STREAM_CR, DmaUartError
from keel.emulator.pulses import ARR, CCER, CCMR1, CCR1, CR1, DIER, EGR, PSC, SR

RING, SIZE = 0x2000_1000, 4
# RM0410: channel 7, high priority, half words at both ends, memory counts, circular.
RING_OF_EDGES = 7 << 25 | 2 << 16 | 1 << 13 | 1 << 11 | 1 << 10 | 1 << 8
REQUEST, TAKEN, OVER = 1 << 9, 1 << 1, 1 << 9


class CaptureTest(unittest.TestCase):
    def setUp(self) -> None:
        self.memory: dict[int, int] = {}
        self.joined = True
        self.capture = Capture(self.memory.__setitem__, lambda: 216.0, lambda: self.joined)

    def place(self, **changed: int) -> None:
        """The stream's registers, but for its control."""
        registers = {"PAR": 0x4001_0434, "M0AR": RING, "NDTR": SIZE, "FCR": 0} | changed
        for name, offset in (("PAR", PAR), ("M0AR", M0AR), ("NDTR", NDTR), ("FCR", FCR)):
            self.capture.write_stream(offset, registers[name], 0)

    def begin(self, **changed: int) -> None:
        """As the driver does, at 0."""
        self.place()
        self.capture.write_stream(STREAM_CR, RING_OF_EDGES | EN, 0)
        registers = {"PSC": 215, "CCMR1": 0xF1, "DIER": REQUEST, "CCER": 1, "CR1": 0x201} | changed
        for name, offset in (("PSC", PSC), ("CCMR1", CCMR1), ("DIER", DIER), ("CCER", CCER)):
            self.capture.write(offset, registers[name], 0)
        self.capture.write(ARR, 0xFFFF, 0)
        self.capture.write(EGR, 1, 0)
        self.capture.write(CR1, registers["CR1"], 0)

    def ring(self) -> list[int]:
        def byte(place: int) -> int:
            return self.memory.get(RING + place, 0)

        return [byte(2 * i) | byte(2 * i + 1) << 8 for i in range(SIZE)]

    def test_edges_are_counted_in_microseconds_and_wrap(self) -> None:
        self.begin()
        self.capture.send(1000, [1500, 70_000], 100_000)
        self.assertEqual(self.capture.read_stream(NDTR, 999), 4)
        self.assertEqual(self.capture.read_stream(NDTR, 1000), 3)
        self.assertEqual(self.capture.read_stream(NDTR, 80_000), 1)
        self.assertEqual(self.ring()[:3], [1000, 2500, 72_500 - 65_536])

    def test_it_goes_round(self) -> None:
        self.begin()
        self.capture.send(1000, [1000] * 5)
        self.capture.advance(3000)
        self.assertEqual(self.capture.flags, HALF)
        self.capture.advance(10_000)
        self.assertEqual(self.ring(), [5000, 6000, 3000, 4000])
        self.assertEqual((self.capture.moved, self.capture.flags), (6, HALF | COMPLETE))

    def test_another_prescaler_counts_otherwise(self) -> None:
        self.begin(PSC=107)
        self.capture.send(1000, [])
        self.capture.advance(1000)
        self.assertEqual(self.ring()[0], 2000)

    def test_the_prescaler_is_taken_over_by_an_update_alone(self) -> None:
        self.begin()
        self.capture.write(PSC, 107, 0)
        self.capture.send(1000, [])
        self.capture.advance(1000)
        self.assertEqual(self.ring()[0], 1000)

    def test_nothing_comes_unless_all_is_set(self) -> None:
        for changed in (
            {"CCER": 0},
            {"CCER": 16},
            {"CCMR1": 0xF0},
            {"CCMR1": 0xF2},
            {"CR1": 0x200},
        ):
            self.setUp()
            self.begin(**changed)
            self.capture.send(1000, [])
            self.assertEqual(self.capture.read(SR, 2000), 0, changed)
        self.setUp()
        self.joined = False
        self.begin()
        self.capture.send(1000, [])
        self.assertEqual(self.capture.read(SR, 2000), 0)

    def test_an_edge_that_nobody_takes_and_one_over_it(self) -> None:
        self.begin(DIER=0)
        self.capture.send(1000, [1000])
        self.assertEqual(self.capture.read(SR, 1500), TAKEN)
        self.assertEqual(self.capture.read(SR, 2500), TAKEN | OVER)
        self.assertEqual(self.capture.read(CCR1, 2500), 2000)
        self.capture.write(SR, ~OVER & 0xFFFF_FFFF, 2500)
        self.assertEqual(self.capture.read(SR, 2500), TAKEN)

    def test_the_filter_takes_what_lasts(self) -> None:
        """8 samples, 32 clocks of 54 MHz apart: 4.74 us."""
        self.begin()
        for low_us, moved in ((4.7, 0), (4.8, 1)):
            self.capture.spike(1000, low_us)
            self.capture.advance(1000)
            self.assertEqual(self.capture.moved, moved, low_us)

    def refuses(self, words: str, **changed: int) -> None:
        control = changed.pop("CR", RING_OF_EDGES)
        self.setUp()
        self.place(**changed)
        with self.assertRaisesRegex(DmaUartError, words):
            self.capture.write_stream(STREAM_CR, control | EN, 0)

    def test_a_stream_that_is_set_up_otherwise_is_refused(self) -> None:
        self.refuses("does not hear timer 8", CR=RING_OF_EDGES ^ 1 << 25)
        self.refuses("does not read CCR1", PAR=0x4001_0438)
        self.refuses("half words", CR=RING_OF_EDGES ^ 1 << 13)
        self.refuses("half words", CR=RING_OF_EDGES ^ 1 << 11)
        self.refuses("half words", CR=RING_OF_EDGES ^ 1 << 8)
        self.refuses("direct mode", FCR=4)
        self.refuses("empty", NDTR=0)
        self.refuses("cached", M0AR=0x2002_0000)
        self.refuses("cached", M0AR=0x2001_FFFA)

    def test_flags_that_are_left_are_refused(self) -> None:
        self.begin()
        self.capture.send(0, [1000] * 4)
        self.capture.advance(10_000)
        self.capture.write_stream(STREAM_CR, RING_OF_EDGES, 0)
        with self.assertRaisesRegex(DmaUartError, "flags are left"):
            self.capture.write_stream(STREAM_CR, RING_OF_EDGES | EN, 0)
        self.capture.clear(0x3D)
        self.capture.write_stream(STREAM_CR, RING_OF_EDGES | EN, 0)

    def test_what_is_changed_while_it_is_on_is_refused(self) -> None:
        self.begin()
        with self.assertRaisesRegex(DmaUartError, "changed while it is on"):
            self.capture.write_stream(NDTR, 8, 0)
        with self.assertRaisesRegex(DmaUartError, "set up while it is on"):
            self.capture.write(CCMR1, 0x1, 0)


if __name__ == "__main__":
    unittest.main()
