# SPDX-License-Identifier: Apache-2.0
"""The model of a UART with circular DMA, and what it refuses."""

from __future__ import annotations

import unittest

from keel.emulator.dma_uart import (
    BRR,
    COMPLETE,
    CR1,
    CR2,
    CR3,
    CRSF,
    DMAR,
    EN,
    FCR,
    FE,
    HALF,
    ICR,
    ISR,
    M0,
    M0AR,
    NDTR,
    ORE,
    PAR,
    PCE,
    PE,
    PLAIN,
    RDR,
    RE,
    RXINV,
    RXNE,
    SBUS,
    STREAM_CR,
    TC,
    TDR,
    TE,
    TXE,
    UARTS,
    UE,
    Bits,
    DmaUartError,
    Line,
)

RING, SIZE = 0x2000_1000, 8
RING_OF_BYTES = 5 << 25 | 2 << 16 | 1 << 10 | 1 << 8
SBUS_CR1, SBUS_CR2 = UE | RE | M0 | PCE, 2 << 12 | RXINV


class LineTest(unittest.TestCase):
    def setUp(self) -> None:
        self.memory: dict[int, int] = {}
        self.line = Line("USART6", 2, 1, 54_000_000, self.memory.__setitem__)

    def place(self, **changed: int) -> None:
        """The stream's registers, but for its control."""
        registers = {"PAR": 0x4001_1424, "M0AR": RING, "NDTR": SIZE, "FCR": 0} | changed
        for name, offset in (("PAR", PAR), ("M0AR", M0AR), ("NDTR", NDTR), ("FCR", FCR)):
            self.line.write_stream(offset, registers[name], 0)

    def begin(self, cr1: int = SBUS_CR1, cr2: int = SBUS_CR2, brr: int = 540) -> None:
        """As the driver does."""
        self.place()
        self.line.write_stream(STREAM_CR, RING_OF_BYTES, 0)
        self.line.write_stream(STREAM_CR, RING_OF_BYTES | EN, 0)
        for offset, value in ((CR2, cr2), (CR3, DMAR), (BRR, brr), (CR1, cr1)):
            self.line.write_uart(offset, value, 0)

    def ring(self) -> bytes:
        return bytes(self.memory.get(RING + i, 0) for i in range(SIZE))

    def status(self, now_us: float) -> int:
        return self.line.read_uart(ISR, now_us) & ~(TC | TXE)

    def refuses(self, words: str, offset: int, value: int, stream: bool = True) -> None:
        write = self.line.write_stream if stream else self.line.write_uart
        with self.assertRaisesRegex(DmaUartError, words):
            write(offset, value, 0)

    def test_bytes_come_when_their_last_bit_is_there(self) -> None:
        self.begin()
        self.line.send(1000, b"\x0f\xe0", SBUS)
        for now_us, left in ((1119, 8), (1120, 7), (1239, 7), (1240, 6)):
            self.assertEqual(self.line.read_stream(NDTR, now_us), left, now_us)
        self.assertEqual(self.ring()[:3], b"\x0f\xe0\x00")
        self.assertEqual(self.status(1240), 0)

    def test_it_goes_round(self) -> None:
        self.begin()
        self.line.send(0, bytes(range(1, 5)), SBUS)
        self.line.advance(480)
        self.assertEqual(self.line.flags, HALF)
        self.line.send(0, bytes(range(5, 11)), SBUS)  # Behind those before.
        self.line.advance(10_000)
        self.assertEqual(self.line.read_stream(NDTR, 10_000), 6)
        self.assertEqual(self.ring(), bytes((9, 10, 3, 4, 5, 6, 7, 8)))
        self.assertEqual((self.line.moved, self.line.flags), (10, HALF | COMPLETE))
        self.line.clear(0x3D)
        self.assertEqual(self.line.flags, 0)

    def meets(self, bits: Bits, flags: int, spoilt: bool = False) -> None:
        self.line.send(0, b"A", bits, spoilt)
        self.line.advance(1_000_000)
        self.assertEqual(self.status(1_000_000), flags, bits)
        self.assertEqual(self.line.moved, 0 if flags else 1, bits)

    def test_what_comes_otherwise_is_flagged_and_not_moved(self) -> None:
        for bits, flags, spoilt in (
            (SBUS, 0, False),
            (SBUS._replace(two_stops=False), 0, False),
            (SBUS._replace(baud=101_900), 0, False),
            (SBUS._replace(baud=103_000), FE, False),
            (SBUS._replace(baud=97_900), FE, False),
            (SBUS._replace(inverted=False), FE, False),
            (SBUS._replace(even_parity=False), PE, False),
            (SBUS, PE, True),
        ):
            self.setUp()
            self.begin()
            self.meets(bits, flags, spoilt)
        for bits, flags in ((CRSF, 0), (PLAIN, FE), (CRSF._replace(even_parity=True), FE)):
            self.setUp()
            self.begin(UE | RE, 0, 129)
            self.meets(bits, flags)

    def test_the_next_right_byte_is_moved_and_flags_stay_until_cleared(self) -> None:
        self.begin()
        self.line.send(0, b"A", SBUS, spoilt=True)
        self.line.send(0, b"B", SBUS)
        self.assertEqual(self.status(500), PE)
        self.assertEqual(self.ring()[:1], b"B")
        self.line.write_uart(ICR, PE, 500)
        self.assertEqual(self.status(500), 0)

    def test_odd_parity_is_not_even(self) -> None:
        self.begin(SBUS_CR1 | 1 << 9)
        self.meets(SBUS, PE)

    def test_without_dma_bytes_overrun_until_the_flag_is_cleared(self) -> None:
        self.begin()
        self.line.write_stream(STREAM_CR, RING_OF_BYTES, 0)
        self.line.send(0, b"ABC", SBUS)
        self.assertEqual(self.status(130), RXNE)
        self.assertEqual(self.status(400), RXNE | ORE)
        self.assertEqual(self.line.read_uart(RDR, 400), ord("A"))
        self.line.send(500, b"D", SBUS)
        self.assertEqual(self.status(700), ORE)
        self.line.write_uart(ICR, ORE, 700)
        self.line.send(800, b"E", SBUS)
        self.assertEqual(self.status(1000), RXNE)
        self.line.write_stream(STREAM_CR, RING_OF_BYTES | EN, 1000)  # It takes what waits.
        self.assertEqual((self.status(1000), self.ring()[:1]), (0, b"E"))

    def test_a_uart_that_is_off_hears_nothing_and_forgets(self) -> None:
        self.begin(UE | M0 | PCE)
        self.meets_nothing()
        self.setUp()
        self.begin()
        self.line.send(0, b"A", SBUS, spoilt=True)
        self.assertEqual(self.status(200), PE)
        self.line.write_uart(CR1, 0, 200)
        self.assertEqual(self.status(200), 0)
        self.meets_nothing()

    def meets_nothing(self) -> None:
        self.line.send(300, b"A", SBUS)
        self.line.advance(1000)
        self.assertEqual((self.line.moved, self.status(1000)), (0, 0))

    def test_it_sends_a_byte_while_one_is_on_its_way(self) -> None:
        self.begin(UE | RE | TE, 0, 540)  # 100 us a byte.
        self.assertEqual(self.line.read_uart(ISR, 0), TXE | TC)
        self.line.write_uart(TDR, ord("a"), 0)
        self.assertEqual(self.line.read_uart(ISR, 1), TXE)
        self.line.write_uart(TDR, ord("b"), 1)
        self.assertEqual(self.line.read_uart(ISR, 99), 0)
        self.refuses("sent over another", TDR, 0, stream=False)
        self.assertEqual(self.line.read_uart(ISR, 101), TXE)
        self.assertEqual(self.line.read_uart(ISR, 201), TXE | TC)
        self.assertEqual(self.line.sent, b"ab")

    def test_what_must_not_be_of_the_uart(self) -> None:
        self.begin()
        self.refuses("changed while it is on", BRR, 541, stream=False)
        self.refuses("changed while it is on", CR2, 0, stream=False)
        self.refuses("changed while it is on", CR1, UE | RE, stream=False)
        self.refuses("while it does not send", TDR, 0, stream=False)
        self.line.write_uart(CR1, 0, 0)
        self.refuses("8 data bits", CR1, UE | RE | PCE, stream=False)
        self.refuses("8 data bits", CR1, UE | RE | M0, stream=False)

    def test_what_must_not_be_of_a_stream(self) -> None:
        on = RING_OF_BYTES | EN
        for words, changed, control in (
            ("cached", {"M0AR": 0x2002_0000}, on),
            ("cached", {"M0AR": 0x2001_FFFC}, on),
            ("RDR", {"PAR": 0x4001_1428}, on),
            ("RDR", {"PAR": 0x4001_1024}, on),
            ("empty", {"NDTR": 0}, on),
            ("direct mode", {"FCR": 4}, on),
            ("ring of bytes", {}, on & ~(1 << 8)),
            ("ring of bytes", {}, on & ~(1 << 10)),
            ("ring of bytes", {}, on | 1 << 6),
            ("ring of bytes", {}, on | 1 << 11),
            ("ring of bytes", {}, on | 1 << 13),
            ("channel 4 does not hear USART6", {}, on ^ 1 << 25),
        ):
            self.setUp()
            self.place(**changed)
            self.refuses(words, STREAM_CR, control)

    def test_a_stream_is_changed_while_it_is_off_alone(self) -> None:
        self.begin()
        for offset, value in ((NDTR, 9), (M0AR, 0), (PAR, 0), (FCR, 1), (STREAM_CR, 1)):
            self.refuses("changed while it is on", offset, value)
        self.line.stops_after = 2
        self.line.write_stream(STREAM_CR, RING_OF_BYTES, 0)
        self.refuses("changed while it is on", NDTR, 9)
        looks = [self.line.read_stream(STREAM_CR, 0) & EN for _ in range(3)]
        self.assertEqual(looks, [1, 1, 0])
        self.line.write_stream(NDTR, 9, 0)
        self.line.flags = COMPLETE
        self.refuses("flags are left", STREAM_CR, RING_OF_BYTES | EN)

    def test_every_stream_of_the_table_is_taken(self) -> None:
        for name, uart in UARTS.items():
            for dma, stream, channel in uart.streams:
                self.line = Line(name, dma, stream, 54_000_000, self.memory.__setitem__)
                self.place(PAR=uart.base + RDR)
                self.line.write_stream(STREAM_CR, 1 << 10 | 1 << 8 | channel << 25 | EN, 0)
                self.line = Line(name, dma, stream + 1, 54_000_000, self.memory.__setitem__)
                self.place(PAR=uart.base + RDR)
                self.refuses("does not hear", STREAM_CR, 1 << 10 | 1 << 8 | 3 << 25 | EN)


if __name__ == "__main__":
    unittest.main()
