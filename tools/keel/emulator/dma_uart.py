# SPDX-License-Identifier: Apache-2.0
"""A model of a UART of the STM32F767 whose bytes DMA moves round a ring, and of who sends them.

By the reference manual (RM0410, chapters 8 and 34): what comes in other bits than the registers say
is flagged and not moved, and the stream must be set up as it says.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

from keel.base.errors import ToolError

# Offsets of a UART's registers, and of a stream's.
CR1, CR2, CR3, BRR, ISR, ICR, RDR, TDR = 0, 4, 8, 0xC, 0x1C, 0x20, 0x24, 0x28
STREAM_CR, NDTR, PAR, M0AR, FCR = 0, 4, 8, 0xC, 0x14
# Bits of CR1, CR2 and CR3.
UE, RE, TE, PS, PCE, M0, M1 = 1, 1 << 2, 1 << 3, 1 << 9, 1 << 10, 1 << 12, 1 << 28
STOPS, RXINV, DMAR = 3 << 12, 1 << 16, 1 << 6
SWITCHES = UE | RE | TE  # The rest of CR1 is of the bits, as are CR2 and BRR.
# Flags of the UART.
PE, FE, NF, ORE, RXNE, TC, TXE = (1 << i for i in (0, 1, 2, 3, 5, 6, 7))
# A stream: on, and what a ring of bytes needs: to memory, byte by byte, one behind the other.
EN, CIRC, MINC = 1, 1 << 8, 1 << 10
MODE = 0x0004_7FE0  # Double buffer, sizes, increments, circular, direction, who controls the flow.
HALF, COMPLETE = 1 << 4, 1 << 5
DTCM = range(0x2000_0000, 0x2002_0000)
TOLERANCE = 0.02


class DmaUartError(ToolError):
    """The image did what must not be; the message says what."""

    status = 1


class Uart(NamedTuple):
    """A UART: its base, and the streams that hear its receiver: DMA, stream, and channel."""

    base: int
    streams: tuple[tuple[int, int, int], ...]


# RM0410, tables 27 and 28.
UARTS = {
    "USART1": Uart(0x4001_1000, ((2, 2, 4), (2, 5, 4))),
    "USART2": Uart(0x4000_4400, ((1, 5, 4),)),
    "USART3": Uart(0x4000_4800, ((1, 1, 4),)),
    "UART4": Uart(0x4000_4C00, ((1, 2, 4),)),
    "USART6": Uart(0x4001_1400, ((2, 1, 5), (2, 2, 5))),
}


class Bits(NamedTuple):
    """How somebody sends bytes of 8 data bits."""

    baud: float
    even_parity: bool = False
    two_stops: bool = False
    inverted: bool = False

    @property
    def byte_us(self) -> float:
        return (10 + self.even_parity + self.two_stops) * 1e6 / self.baud


SBUS = Bits(100_000, True, True, True)
CRSF = Bits(416_666)
PLAIN = Bits(115_200)


class Coming(NamedTuple):
    """A byte, when its last bit is there, how it is sent, and whether its parity is wrong."""

    at_us: float
    value: int
    bits: Bits
    spoilt: bool


@dataclass
class Line:
    """A UART with its stream, by the offsets of their registers, and the line to it."""

    name: str
    dma: int  # 1 or 2.
    stream: int
    clock_hz: int
    store: Callable[[int, int], None]  # Writes a byte at an address.
    joined: Callable[[], bool] = lambda: True  # Whether its pin is the UART's.
    stops_after: int = 0  # So often a stream still reads as on when it was switched off.
    sent: bytearray = field(default_factory=bytearray)  # By the UART.
    flags: int = 0  # Of the stream, as stream 0 has them in LISR.
    moved: int = 0  # Bytes, by DMA.
    _coming: deque[Coming] = field(default_factory=deque)
    _words: dict[int, int] = field(default_factory=dict)
    _stream: dict[int, int] = field(default_factory=lambda: {FCR: 0x21})
    _status: int = 0
    _received: int = 0
    _size: int = 0  # Of the ring.
    _stopping: int = 0
    _sent_until_us: float = 0

    def reset(self) -> None:
        """The registers as a reset leaves them; what is on its way comes all the same."""
        self._words, self._stream = {}, {FCR: 0x21}
        self._status = self._stopping = self.flags = 0

    # Who sends.

    def send(self, at_us: float, data: bytes, bits: Bits, spoilt: bool = False) -> None:
        """Bytes that begin at a time, or behind those before; `spoilt`: with a wrong parity."""
        begin_us = max(at_us, self._coming[-1].at_us if self._coming else 0)
        for i, value in enumerate(data, 1):
            self._coming.append(Coming(begin_us + i * bits.byte_us, value, bits, spoilt))

    def advance(self, now_us: float) -> None:
        """What has come until then."""
        while self._coming and self._coming[0].at_us <= now_us:
            self._receive(self._coming.popleft())

    def _errors(self, coming: Coming) -> int:
        """The flags of a byte that is not received as it was sent."""
        control, bits = self._words.get(CR1, 0), coming.bits
        made = self.clock_hz / max(self._words.get(BRR, 0), 1)
        inverted = bool(self._words.get(CR2, 0) & RXINV)
        if abs(made - bits.baud) > TOLERANCE * bits.baud or inverted != bits.inverted:
            return FE
        if bool(control & PCE) != bits.even_parity:
            return PE if control & PCE else FE
        return PE if control & PCE and (coming.spoilt or control & PS) else 0

    def _receive(self, coming: Coming) -> None:
        """After an overrun nothing is received until its flag is cleared."""
        if self._words.get(CR1, 0) & (UE | RE) != UE | RE or self._status & ORE:
            return
        if not self.joined():
            return
        errors = self._errors(coming)
        self._status |= errors
        if errors and self._words.get(CR3, 0) & DMAR:
            return  # DDRE is 0: no request.
        if self._status & RXNE:
            self._status |= ORE
            return
        self._received = coming.value
        self._status |= RXNE
        self._request()

    def _request(self) -> None:
        """DMA moves what the UART has, if it may."""
        wanted = self._words.get(CR3, 0) & DMAR and self._status & RXNE
        if not wanted or not self._stream.get(STREAM_CR, 0) & EN:
            return
        self._status &= ~RXNE
        left = self._stream[NDTR]
        self.store(self._stream[M0AR] + self._size - left, self._received)
        self.moved += 1
        self._stream[NDTR] = left - 1 or self._size
        self.flags |= COMPLETE if left == 1 else 0
        self.flags |= HALF if left - 1 == self._size // 2 else 0

    # The UART's registers.

    def read_uart(self, offset: int, now_us: float) -> int:
        """What a register of the UART reads."""
        self.advance(now_us)
        if offset == ISR:
            return self._status | self._free(now_us)
        if offset == RDR:
            self._status &= ~RXNE
            return self._received
        return 0 if offset in (ICR, TDR) else self._words.get(offset, 0)

    def write_uart(self, offset: int, value: int, now_us: float) -> None:
        """What writing a register of the UART does."""
        self.advance(now_us)
        if offset == ICR:
            self._status &= ~(value & (PE | FE | NF | ORE))
        elif offset == TDR:
            self._transmit(value & 0xFF, now_us)
        else:
            self._check_uart(offset, value)
            self._words[offset] = value
            if not self._words.get(CR1, 0) & UE:
                self._status = 0
            self._request()

    def _check_uart(self, offset: int, value: int) -> None:
        before = self._words.get(offset, 0)
        fixed = {CR1: ~SWITCHES, CR2: ~0, BRR: ~0}.get(offset, 0)
        control = value if offset == CR1 else self._words.get(CR1, 0)
        if self._words.get(CR1, 0) & control & UE and (before ^ value) & fixed:
            raise DmaUartError(f"{self.name}: its bits are changed while it is on")
        if control & UE and control & (M0 | M1) != (M0 if control & PCE else 0):
            raise DmaUartError(f"{self.name}: its characters do not have 8 data bits")

    def _byte_us(self) -> float:
        """How long the UART sends a byte."""
        rate = self.clock_hz / max(self._words.get(BRR, 0), 1)
        two_stops = self._words.get(CR2, 0) & STOPS == 2 << 12
        return Bits(rate, bool(self._words.get(CR1, 0) & PCE), two_stops).byte_us

    def _free(self, now_us: float) -> int:
        """A byte may be on its way, and another one wait."""
        behind_us = self._sent_until_us - now_us
        if behind_us <= 0:  # First, as it is read by every turn of a task that has nothing to send.
            return TC | TXE
        return TXE if behind_us <= self._byte_us() else 0

    def _transmit(self, value: int, now_us: float) -> None:
        if self._words.get(CR1, 0) & (UE | TE) != UE | TE:
            raise DmaUartError(f"{self.name}: a byte is sent while it does not send")
        if not self._free(now_us) & TXE:
            raise DmaUartError(f"{self.name}: a byte is sent over another one")
        self.sent.append(value)
        self._sent_until_us = max(self._sent_until_us, now_us) + self._byte_us()

    # The stream's registers.

    def clear(self, flags: int) -> None:
        """Flags of the stream, as stream 0 has them in LIFCR."""
        self.flags &= ~flags

    def read_stream(self, offset: int, now_us: float) -> int:
        """What a register of the stream reads."""
        self.advance(now_us)
        if offset == STREAM_CR and self._stopping:
            self._stopping -= 1
            return self._stream[STREAM_CR] | EN
        return self._stream.get(offset, 0)

    def write_stream(self, offset: int, value: int, now_us: float) -> None:
        """What writing a register of the stream does."""
        self.advance(now_us)
        before = self._stream.get(STREAM_CR, 0)
        if offset == STREAM_CR and before & EN and value == before & ~EN:
            self._stopping = self.stops_after
        elif (before & EN or self._stopping) and value != self._stream.get(offset, 0):
            raise DmaUartError(f"{self._title()} is changed while it is on")
        self._stream[offset] = value
        if offset == STREAM_CR and value & ~before & EN:
            self._check_stream(value)
            self._size = self._stream[NDTR]
            self._request()

    def _title(self) -> str:
        return f"DMA {self.dma}, stream {self.stream}"

    def _check_stream(self, control: int) -> None:
        """What must hold when it is switched on (RM0410, 8.3)."""
        uart = UARTS[self.name]
        size, memory = self._stream.get(NDTR, 0), self._stream.get(M0AR, 0)
        own = (self.dma, self.stream, control >> 25 & 0xF)
        for reason, held in {
            f"its channel {own[2]} does not hear {self.name}": own in uart.streams,
            "it does not read the UART's RDR": self._stream.get(PAR, 0) == uart.base + RDR,
            "it does not go round a ring of bytes": control & MODE == CIRC | MINC,
            "it is not in direct mode": not self._stream.get(FCR, 0) & 4,
            "its ring is empty": size > 0,
            "flags are left of what it did before": not self.flags,
            "that is DMA to memory that is cached": memory in DTCM and memory + size - 1 in DTCM,
        }.items():
            if not held:
                raise DmaUartError(f"{self._title()} is switched on, but {reason}")
