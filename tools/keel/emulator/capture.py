# SPDX-License-Identifier: Apache-2.0
"""A model of a timer of the STM32F767 whose channel 1 captures edges, of the stream of DMA that
moves them, and of a receiver of PPM that only pulls its line low.

By the reference manual (RM0410, chapters 8 and 25): an edge is captured where the registers say so,
and the stream must be set up as it says.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from keel.emulator.dma_uart import (
    CIRC,
    COMPLETE,
    DTCM,
    EN,
    FCR,
    HALF,
    M0AR,
    MINC,
    MODE,
    NDTR,
    PAR,
    STREAM_CR,
    DmaUartError,
)
from keel.emulator.pulses import ARR, CCER, CCMR1, CCR1, CR1, DIER, EGR, PSC, SR

TIM8 = 0x4001_0400
OWN = (2, 2, 7)  # DMA, stream and channel that hear channel 1 (RM0410, table 28).
HALF_WORDS = 1 << 11 | 1 << 13
ON, CHANNEL_ON, FALLING, DMA_ASKED, TAKEN, OVER = 1, 1, 2, 1 << 9, 1 << 1, 1 << 9
DIRECT = 1  # CC1S.
# Samples that must agree, and the divider of the filter's clock, by IC1F.
FILTERS = (
    *((1, 1), (2, 1), (4, 1), (8, 1), (6, 2), (8, 2), (6, 4), (8, 4)),
    *((6, 8), (8, 8), (5, 16), (6, 16), (8, 16), (5, 32), (6, 32), (8, 32)),
)
LOW_US = 300  # A receiver pulls its line low for so long before each edge.


class Edge(NamedTuple):
    """When the line rises, and how long it was low before, in us."""

    at_us: float
    low_us: float


@dataclass
class Capture:
    """The timer with its stream, by the offsets of their registers, and the line to it."""

    store: Callable[[int, int], None]  # Writes a byte at an address.
    mhz: Callable[[], float]  # The timer's clock.
    joined: Callable[[], bool]  # Whether its pin is the timer's, and pulled up.
    flags: int = 0  # Of the stream, as stream 0 has them in LISR.
    moved: int = 0  # Edges, by DMA.
    _coming: list[Edge] = field(default_factory=list)  # In order.
    _words: dict[int, int] = field(default_factory=dict)
    _stream: dict[int, int] = field(default_factory=lambda: {FCR: 0x21})
    _prescaler: int = 0  # That it works with.
    _from_us: float = 0
    _size: int = 0  # Of the ring.

    def reset(self) -> None:
        """The registers as a reset leaves them; what is on its way comes all the same."""
        self._words, self._stream, self.flags, self._prescaler = {}, {FCR: 0x21}, 0, 0

    # Who sends.

    def send(self, at_us: float, channels_us: Sequence[int], period_us: int = 22_500) -> None:
        """A frame of PPM that begins at a time: an edge, and one behind each channel. The gap to
        the next frame is what is left of the period."""
        assert sum(channels_us) + 2500 <= period_us
        for channel_us in (*channels_us, 0):
            insort(self._coming, Edge(at_us, LOW_US))
            at_us += channel_us

    def spike(self, at_us: float, low_us: float) -> None:
        """A disturbance: the line is low for a moment."""
        insort(self._coming, Edge(at_us, low_us))

    def advance(self, now_us: float) -> None:
        """What has come until then."""
        while self._coming and self._coming[0].at_us <= now_us:
            self._capture(self._coming.pop(0))

    def _filter_us(self) -> float:
        samples, divider = FILTERS[self._words.get(CCMR1, 0) >> 4 & 0xF]
        clock = self._words.get(CR1, 0) >> 8 & 3 if self._words.get(CCMR1, 0) >> 4 & 0xF > 3 else 0
        return samples * divider * (1 << clock) / self.mhz() if samples > 1 else 0.0

    def _capture(self, edge: Edge) -> None:
        enabled = self._words.get(CR1, 0) & ON and self._words.get(CCER, 0) & CHANNEL_ON
        direct = self._words.get(CCMR1, 0) & 3 == DIRECT
        if not (enabled and direct and self.joined() and edge.low_us >= self._filter_us()):
            return
        falling = self._words.get(CCER, 0) & FALLING
        at_us = edge.at_us - edge.low_us if falling else edge.at_us
        ticks = int((at_us - self._from_us) * self.mhz() / (self._prescaler + 1))
        status = self._words.get(SR, 0)
        self._words[SR] = status | TAKEN | (OVER if status & TAKEN else 0)
        self._words[CCR1] = ticks % ((self._words.get(ARR, 0xFFFF) & 0xFFFF) + 1)
        self._request()

    def _request(self) -> None:
        """DMA moves what was captured, if it may."""
        wanted = self._words.get(DIER, 0) & DMA_ASKED and self._words.get(SR, 0) & TAKEN
        if not wanted or not self._stream.get(STREAM_CR, 0) & EN:
            return
        self._words[SR] &= ~TAKEN
        left = self._stream[NDTR]
        place = self._stream[M0AR] + 2 * (self._size - left)
        self.store(place, self._words[CCR1] & 0xFF)
        self.store(place + 1, self._words[CCR1] >> 8)
        self.moved += 1
        self._stream[NDTR] = left - 1 or self._size
        self.flags |= COMPLETE if left == 1 else 0
        self.flags |= HALF if left - 1 == self._size // 2 else 0

    # The timer's registers.

    def read(self, offset: int, now_us: int) -> int:
        """What a register of the timer reads."""
        self.advance(now_us)
        return self._words.get(offset, 0)

    def write(self, offset: int, value: int, now_us: int) -> None:
        """What writing a register of the timer does."""
        self.advance(now_us)
        if offset == SR:
            self._words[SR] = self._words.get(SR, 0) & value  # Zeros clear.
            return
        if offset == CCMR1 and self._words.get(CCER, 0) & CHANNEL_ON:
            raise DmaUartError("timer 8: its channel is set up while it is on")
        self._words[offset] = value
        if offset == EGR and value & 1:
            self._prescaler = self._words.get(PSC, 0)
            self._from_us = now_us
        self._request()

    # The stream's registers.

    def clear(self, flags: int) -> None:
        """Flags of the stream, as stream 0 has them in LIFCR."""
        self.flags &= ~flags

    def read_stream(self, offset: int, now_us: float) -> int:
        """What a register of the stream reads."""
        self.advance(now_us)
        return self._stream.get(offset, 0)

    def write_stream(self, offset: int, value: int, now_us: float) -> None:
        """What writing a register of the stream does."""
        self.advance(now_us)
        before = self._stream.get(STREAM_CR, 0)
        stops = offset == STREAM_CR and value == before & ~EN
        if before & EN and not stops and value != self._stream.get(offset, 0):
            raise DmaUartError("the stream of timer 8 is changed while it is on")
        self._stream[offset] = value
        if offset == STREAM_CR and value & ~before & EN:
            self._check_stream(value)
            self._size = self._stream[NDTR]
            self._request()

    def _check_stream(self, control: int) -> None:
        """What must hold when it is switched on (RM0410, 8.3)."""
        size, memory = self._stream.get(NDTR, 0), self._stream.get(M0AR, 0)
        last = memory + 2 * size - 1
        for reason, held in {
            "its channel does not hear timer 8": control >> 25 & 0xF == OWN[2],
            "it does not read CCR1": self._stream.get(PAR, 0) == TIM8 + CCR1,
            "it does not go round a ring of half words": control & MODE == CIRC | MINC | HALF_WORDS,
            "it is not in direct mode": not self._stream.get(FCR, 0) & 4,
            "its ring is empty": size > 0,
            "flags are left of what it did before": not self.flags,
            "that is DMA to memory that is cached": memory in DTCM and last in DTCM,
        }.items():
            if not held:
                raise DmaUartError(f"the stream of timer 8 is switched on, but {reason}")
