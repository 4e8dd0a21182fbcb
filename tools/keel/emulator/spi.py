# SPDX-License-Identifier: Apache-2.0
"""The SPIs of the chip: which device is selected, and what must hold when a byte goes to it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

Pin = tuple[int, int]  # Port and number.

SPI1, SPI2, SPI4 = 0x4001_3000, 0x4000_3800, 0x4001_3400
CONTROL, FORMAT, STATUS, DATA = 0x0, 0x4, 0x8, 0xC
FUNCTION = 5  # Of all their pins.


class SpiError(Exception):
    """A byte goes where or how it must not; the message says what is wrong."""


class Device(Protocol):
    """What is at the end of a select."""

    def select(self, selected: bool) -> None: ...

    def exchange(self, byte: int, now_us: int) -> int: ...


@dataclass(frozen=True)
class Bus:
    """An SPI on a board: its pins, its clock's register and bit, and the clock's rate."""

    base: int
    pins: tuple[Pin, Pin, Pin]
    clock: tuple[int, int]
    mhz: int


@dataclass(frozen=True)
class Seat:
    """A device's place on a bus: what it bears, and since when it may be asked."""

    name: str
    bus: int
    select: Pin
    limit_mhz: float
    supply: Pin | None = None  # High: it has power.
    ready_us: int = 0  # After that.


@dataclass
class Registers:
    """What the chip knows of itself, as far as an SPI depends on it."""

    words: Mapping[int, int]
    high: Mapping[Pin, int]  # Pins that were set, with when.
    function_of: Callable[[Pin], int | None]
    is_output: Callable[[Pin], bool]


class Spis:
    """All SPIs of a board with their devices."""

    def __init__(self, buses: Sequence[Bus], seats: Sequence[tuple[Seat, Device]]) -> None:
        self.buses = {bus.base: bus for bus in buses}
        self.seats = seats
        self.selected: set[Pin] = set()
        self.good: set[tuple[int, str]] = set()  # Buses and seats whose rules hold as they are.

    def reset(self) -> None:
        self.selected.clear()
        self.good.clear()
        for _, device in self.seats:
            device.select(False)

    def changed(self) -> None:
        """Registers on which the rules depend have been written."""
        self.good.clear()

    def select(self, pin: Pin, selected: bool) -> None:
        """A pin has got a level."""
        for seat, device in self.seats:
            if seat.select == pin:
                (self.selected.add if selected else self.selected.discard)(pin)
                device.select(selected)

    def exchange(self, base: int, byte: int, now_us: int, registers: Registers) -> int:
        """One byte each way; without a device that is selected all ones are read."""
        if not registers.words.get(base + CONTROL, 0) & 0x40:
            raise SpiError("a byte is sent while the SPI is off")
        on_bus = [(seat, device) for seat, device in self.seats if seat.bus == base]
        chosen = [one for one in on_bus if one[0].select in self.selected]
        if len(chosen) > 1:
            names = " and the ".join(seat.name for seat, _ in chosen)
            raise SpiError(f"a byte goes to the {names} at once")
        for seat, device in chosen or on_bus[:1]:
            self._check(seat, now_us, registers, [other for other, _ in on_bus])
            return device.exchange(byte, now_us)
        return 0xFF

    def _check(self, seat: Seat, now_us: int, registers: Registers, others: Sequence[Seat]) -> None:
        since = registers.high.get(seat.supply, None) if seat.supply else 0
        if since is None:
            raise SpiError(f"a byte goes to the {seat.name}, but it has no supply")
        if seat.supply and now_us - since < seat.ready_us:
            raise SpiError(f"a byte goes to the {seat.name}, but it has not started yet")
        key = (seat.bus, seat.name)
        if key not in self.good:
            for reason, held in self._rules(seat, registers, others):
                if not held:
                    raise SpiError(f"a byte goes to the {seat.name}, but {reason}")
            self.good.add(key)

    def _rules(
        self, seat: Seat, registers: Registers, others: Sequence[Seat]
    ) -> Iterator[tuple[str, bool]]:
        """What must hold (RM0410, 35.5 and 35.9)."""
        bus, words = self.buses[seat.bus], registers.words
        control, form = words.get(bus.base + CONTROL, 0), words.get(bus.base + FORMAT, 0)
        rate_mhz = bus.mhz / (2 << (control >> 3 & 7))
        register, bit = bus.clock
        yield "its bus has no clock", bool(words.get(register, 0) >> bit & 1)
        yield (
            "a pin is not its own",
            all(registers.function_of(pin) == FUNCTION for pin in bus.pins),
        )
        yield f"at {rate_mhz:g} MHz", rate_mhz <= seat.limit_mhz
        yield "not in mode 0 or 3", control & 3 in (0, 3)
        yield "not of eight bits", form >> 8 & 0xF == 7
        yield "a single byte is not told (FRXTH)", bool(form >> 12 & 1)
        for other in others:
            yield f"the select of the {other.name} floats", registers.is_output(other.select)
