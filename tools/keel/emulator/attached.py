# SPDX-License-Identifier: Apache-2.0
"""Peripherals of the chip that are models of their own: an I2C, UARTs, a timer that captures, and
the DMA behind them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

from keel.base.errors import ToolError
from keel.emulator.capture import OWN, TIM8, Capture
from keel.emulator.dma_uart import UARTS, DmaUartError, Line
from keel.emulator.i2c import I2c
from keel.emulator.spi import Pin
from keel.emulator.wiring import AHB1ENR, APB1ENR, APB2ENR, LineWiring

DMAS = {1: 0x4002_6000, 2: 0x4002_6400}
I2C3 = 0x4000_5C00
STREAMS, STREAM_SIZE = 0x10, 0x18  # The first stream's registers, and how many bytes each has.
FLAG_PLACES = (0, 6, 16, 22)  # Of a stream's six flags in its word.
FLAGS = 0x3F


class ClockError(ToolError):
    """A peripheral is used without its clock."""

    status = 1


class Block(Protocol):
    """A peripheral, by the offsets of its registers."""

    def read(self, offset: int, now_us: int) -> int: ...

    def write(self, offset: int, value: int, now_us: int) -> None: ...


class Stream(Protocol):
    """A stream of DMA, by the offsets of its registers."""

    flags: int

    def read_stream(self, offset: int, now_us: float) -> int: ...

    def write_stream(self, offset: int, value: int, now_us: float) -> None: ...

    def clear(self, flags: int) -> None: ...


@dataclass
class UartBlock:
    """The registers of a UART."""

    line: Line

    def read(self, offset: int, now_us: int) -> int:
        return self.line.read_uart(offset, now_us)

    def write(self, offset: int, value: int, now_us: int) -> None:
        self.line.write_uart(offset, value, now_us)


@dataclass
class DmaBlock:
    """The registers of a DMA, of whose streams some are used."""

    streams: Mapping[int, Stream]

    def read(self, offset: int, now_us: int) -> int:
        if offset >= STREAMS:
            stream, register = divmod(offset - STREAMS, STREAM_SIZE)
            used = self.streams.get(stream)
            return used.read_stream(register, now_us) if used else 0
        if offset in (0, 4):
            return sum(used.flags << place for used, place in self._of(offset))
        return 0

    def write(self, offset: int, value: int, now_us: int) -> None:
        if offset >= STREAMS:
            stream, register = divmod(offset - STREAMS, STREAM_SIZE)
            if stream not in self.streams:
                raise DmaUartError(f"stream {stream} of a DMA is used, which hears no line")
            self.streams[stream].write_stream(register, value, now_us)
        elif offset in (8, 0xC):
            for used, place in self._of(offset - 8):
                used.clear(value >> place & FLAGS)

    def _of(self, offset: int) -> list[tuple[Stream, int]]:
        """The streams that have their flags in a word, each with its place there."""
        first = offset  # The lower word is of streams 0 to 3, the upper one of 4 to 7.
        return [
            (used, FLAG_PLACES[stream - first])
            for stream, used in self.streams.items()
            if first <= stream < first + 4
        ]


class Attached:
    """All of them on a board."""

    def __init__(
        self,
        wirings: Mapping[str, LineWiring],
        i2c: I2c | None,
        ppm: Capture | None,
        clocked: Callable[[tuple[int, int]], bool],
        function_of: Callable[[Pin], int | None],
        store: Callable[[int, int], None],
    ) -> None:
        def joined(wiring: LineWiring) -> Callable[[], bool]:
            return lambda: function_of(wiring.rx) == wiring.function

        self.clocked = clocked
        self.i2c, self.ppm = i2c, ppm
        self.lines = {
            name: Line(
                wiring.uart, wiring.dma, wiring.stream, wiring.clock_hz, store, joined(wiring)
            )
            for name, wiring in wirings.items()
        }
        # Each with its name, and its clock's register and bit.
        self.blocks: dict[int, tuple[str, Block, tuple[int, int]]] = {}
        for name, wiring in wirings.items():
            block = UartBlock(self.lines[name])
            self.blocks[UARTS[wiring.uart].base] = (wiring.uart, block, wiring.clock)
        for number, base in DMAS.items():
            own: dict[int, Stream] = {
                line.stream: line for line in self.lines.values() if line.dma == number
            }
            if ppm and number == OWN[0]:
                own[OWN[1]] = ppm
            clock = (AHB1ENR, 20 + number)
            self.blocks[base] = (f"DMA {number}", DmaBlock(own), clock)
        if ppm:
            self.blocks[TIM8] = ("timer 8", ppm, (APB2ENR, 1))
        if i2c:
            self.blocks[I2C3] = ("I2C 3", i2c, (APB1ENR, 23))

    def reset(self) -> None:
        for line in self.lines.values():
            line.reset()
        if self.i2c:
            self.i2c.reset()
        if self.ppm:
            self.ppm.reset()

    def read(self, base: int, offset: int, now_us: int) -> int:
        return self._block(base).read(offset, now_us)

    def write(self, base: int, offset: int, value: int, now_us: int) -> None:
        self._block(base).write(offset, value, now_us)

    def _block(self, base: int) -> Block:
        name, block, clock = self.blocks[base]
        if not self.clocked(clock):
            raise ClockError(f"{name} is used without its clock")
        return block
