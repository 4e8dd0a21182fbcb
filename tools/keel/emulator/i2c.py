# SPDX-License-Identifier: Apache-2.0
"""A model of an I2C of the STM32F767 as a polled master, strict about what it is told.

By the reference manual (RM0410, chapter 33), and by UM10204 for the times of fast mode. A byte
takes no time, and a transfer ends as soon as nothing more is asked of the processor.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from keel.base.errors import ToolError

# Offsets of the registers.
CR1, CR2, TIMINGR, ISR, ICR, RXDR, TXDR = 0x00, 0x04, 0x10, 0x18, 0x1C, 0x24, 0x28

# Bits of I2C_CR2 and of I2C_ISR.
READS, ADD10, START, STOP, RELOAD, AUTOEND = 1 << 10, 1 << 11, 1 << 13, 1 << 14, 1 << 24, 1 << 25
TXE, TXIS, RXNE, NACKF, STOPF, TC, BUSY = 1, 1 << 1, 1 << 2, 1 << 4, 1 << 5, 1 << 6, 1 << 15
CLEARED = NACKF | STOPF | 7 << 8

OFF_CLOCKS = 3  # Of its bus, each of which an access takes at least.


class I2cError(ToolError):
    """The host did what must not be; the message says what."""

    status = 1


class Device(Protocol):
    """A device on the bus. The time is the chip's."""

    def begin(self, reads: bool, now_us: int) -> bool:
        """It is addressed; whether it acknowledges that."""

    def take(self, byte: int, now_us: int) -> bool:
        """A byte to it; whether it acknowledges that."""

    def give(self, now_us: int) -> int:
        """A byte from it."""


def timing_faults(timing: int, clock_hz: int) -> list[str]:
    """What is wrong with a timing in fast mode, with the analogue filter (RM0410, 33.4.5)."""
    clock_ns = 1e9 / clock_hz
    tick_ns = ((timing >> 28) + 1) * clock_ns
    low_ns, high_ns = ((timing & 0xFF) + 1) * tick_ns, ((timing >> 8 & 0xFF) + 1) * tick_ns
    hold_ns, setup_ns = (timing >> 16 & 0xF) * tick_ns, ((timing >> 20 & 0xF) + 1) * tick_ns
    period_ns = low_ns + high_ns + 4 * clock_ns + 2 * 50
    rules = {
        f"SCL runs at {1e6 / period_ns:.0f} kHz": period_ns >= 2500,
        f"SCL is low for {low_ns:.0f} ns": low_ns >= 1300,
        f"SCL is high for {high_ns:.0f} ns": high_ns >= 600,
        f"data change {hold_ns:.0f} ns behind an edge": 250 - 3 * clock_ns
        <= hold_ns
        <= 340 - 4 * clock_ns,
        f"data are set up for {setup_ns:.0f} ns": setup_ns >= 400,
    }
    return [reason for reason, held in rules.items() if not held]


@dataclass
class I2c:
    """An I2C, by the offsets of its registers."""

    devices: Mapping[int, Device] = field(default_factory=dict)  # By their addresses, of 7 bits.
    clock_hz: int = 54_000_000
    held: int = 0  # A device holds SDA for so many clocks.
    words: dict[int, int] = field(default_factory=dict)
    flags: int = 0
    left: int = 0  # Bytes of the transfer.
    transfers: int = 0  # Addresses that were sent.
    _device: Device | None = None  # That is addressed.
    _accesses: int = OFF_CLOCKS  # Since it is off.
    _scl: bool = True  # As the pins drive them.
    _sda: bool = True

    @property
    def on(self) -> bool:
        return bool(self.words.get(CR1, 0) & 1)

    def reset(self) -> None:
        """The registers as a reset leaves them."""
        self.words, self.flags, self.left, self._device = {}, 0, 0, None
        self._accesses, self._scl, self._sda = OFF_CLOCKS + 1, True, True

    def read(self, offset: int, now_us: int) -> int:
        """What a register reads."""
        self._accesses += 1
        if offset == ISR:
            empty = 0 if self.flags & RXNE or self.words.get(CR2, 0) & START else TXE
            return self.flags | empty
        if offset == RXDR:
            return self._receive(now_us)
        return self.words.get(offset, 0)

    def write(self, offset: int, value: int, now_us: int) -> None:
        """What writing a register does."""
        self._accesses += 1
        if offset == CR1:
            self._switch(bool(value & 1))
        elif offset == TIMINGR and self.on:
            raise I2cError("the timing changes while the I2C is on")
        elif offset == ICR:
            self.flags &= ~(value & CLEARED)
        self.words[offset] = value
        if offset == CR2:
            self._control(value, now_us)
        elif offset == TXDR:
            self._send(value & 0xFF, now_us)

    # The lines, while the processor drives them by its pins.

    def drive(self, scl: bool, sda: bool) -> None:
        """The pins let the lines go, or not; a device that holds SDA counts clocks."""
        if scl and not self._scl and self.held:
            self.held -= 1
        self._scl, self._sda = scl, sda

    def lines(self) -> tuple[bool, bool]:
        """Whether SCL and SDA are high."""
        return self._scl, self._sda and not self.held

    # The transfers.

    def _switch(self, on: bool) -> None:
        if self.on and not on:
            self.flags, self._device, self.left = 0, None, 0
            self.words[CR2] = self.words.get(CR2, 0) & ~(START | STOP)
            self._accesses = 0
        elif on and not self.on:
            if self._accesses <= OFF_CLOCKS:
                raise I2cError("the I2C is switched on before it was off for three clocks")
            if faults := timing_faults(self.words.get(TIMINGR, 0), self.clock_hz):
                raise I2cError(f"the I2C is switched on, but {faults[0]}")

    def _control(self, value: int, now_us: int) -> None:
        if value & START:
            self._check_start(value)
            self._start(value, now_us)
        elif value & STOP:
            self._end(STOPF)

    def _check_start(self, value: int) -> None:
        """What must hold when a transfer begins."""
        for reason, held in {
            "while the I2C is off": self.on,
            "while one is under way": not self.flags & BUSY or self.flags & TC,
            "while flags of the one before are set": not self.flags & CLEARED,
            "that reads no bytes": value >> 16 & 0xFF or not value & READS,
            "of another kind than a master's of 7 bits": not value & (ADD10 | RELOAD | STOP | 1),
        }.items():
            if not held:
                raise I2cError(f"a transfer begins {reason}")

    def _start(self, value: int, now_us: int) -> None:
        """The address goes out; on a bus that is held nothing happens."""
        self.left = value >> 16 & 0xFF
        self.flags = BUSY
        if not all(self.lines()):
            return
        self.words[CR2] &= ~START
        self.transfers += 1
        self._device = self.devices.get(value >> 1 & 0x7F)
        if self._device is None or not self._device.begin(bool(value & READS), now_us):
            self._end(NACKF | STOPF)
        else:
            self._go_on(bool(value & READS), now_us)

    def _go_on(self, reads: bool, now_us: int) -> None:
        """The next byte, or the end."""
        if self.left == 0 and self.words[CR2] & AUTOEND:
            self._end(STOPF)
        elif self.left == 0:
            self.flags = BUSY | TC
        elif reads and self._device is not None:
            self.words[RXDR] = self._device.give(now_us)
            self.flags = BUSY | RXNE
        else:
            self.flags = BUSY | TXIS

    def _end(self, flags: int) -> None:
        self.flags, self._device, self.left = flags, None, 0

    def _send(self, byte: int, now_us: int) -> None:
        if not self.flags & TXIS or self._device is None:
            raise I2cError("a byte is sent that the I2C did not ask for")
        self.left -= 1
        if self._device.take(byte, now_us):
            self._go_on(False, now_us)
        else:
            self._end(NACKF | STOPF)

    def _receive(self, now_us: int) -> int:
        if not self.flags & RXNE:
            raise I2cError("a byte is read that has not come")
        byte = self.words[RXDR]
        self.left -= 1
        self._go_on(True, now_us)
        return byte
