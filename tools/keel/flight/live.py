# SPDX-License-Identifier: Apache-2.0
"""A flight in real time, with telemetry over UDP, until it is interrupted."""

from __future__ import annotations

import contextlib
import socket
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from keel.base.errors import ToolError
from keel.flight.keyboard import Keyboard
from keel.flight.library import Copter, Key, Link
from keel.flight.loop import Flight, Order
from keel.flight.pilot import Pilot

TURN_MS = 5  # Bytes are exchanged so often.
LATE_S = 0.25  # Whoever is so late does not catch up.
DATAGRAM = 1400
LOCAL = ("127.", "localhost")


@dataclass(frozen=True)
class Address:
    """Where a ground station listens."""

    host: str
    port: int

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"


def address_of(text: str) -> Address:
    """host:port, or a port of this machine."""
    host, _, port = text.rpartition(":")
    if not port.isascii() or not port.isdigit() or not 0 < int(port) < 65536:
        raise ToolError(f"{text}: expected host:port, as in 127.0.0.1:14550")
    return Address(host or "127.0.0.1", int(port))


class Line:
    """A link's datagrams: to an address, and from there alone."""

    def __init__(self, to: Address) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        try:
            self._to = (socket.gethostbyname(to.host), to.port)
            # What listens on this machine alone is spoken to from this machine alone.
            self._socket.bind(("127.0.0.1" if to.host.startswith(LOCAL) else "", 0))
        except OSError as error:
            raise ToolError(f"{to}: {error.strerror}") from error

    def exchange(self, copter: Copter, link: int) -> None:
        """What came goes to the copter, and what it sent goes out. Nobody may listen."""
        with contextlib.suppress(BlockingIOError, ConnectionRefusedError):
            while True:
                data, sender = self._socket.recvfrom(65536)
                if sender == self._to:
                    copter.send(link, data)
        data = copter.receive(link)
        with contextlib.suppress(OSError):
            for start in range(0, len(data), DATAGRAM):
                self._socket.sendto(data[start : start + DATAGRAM], self._to)

    def close(self) -> None:
        """No more."""
        self._socket.close()


class Live(Flight):
    """A flight whose millisecond is one. Nothing is recorded."""

    def __init__(
        self,
        copter: Copter,
        order: Order,
        pilot: type[Pilot],
        links: Sequence[Link],
        lines: Sequence[Line],
        key: Key | None,
        memory: Path,
    ) -> None:
        super().__init__(copter, order, pilot, links, key, memory)
        self._lines = lines
        self._keyboard = Keyboard()
        self._now_ms = 0

    def _record(self, now_ms: int) -> None:
        """For ever would be too long."""

    def warm_up(self, seconds: float) -> None:
        """As fast as it goes, with nobody listening."""
        while self._now_ms < 1000.0 * seconds:
            self._go_on(TURN_MS)
            for link in range(len(self._lines)):
                self._copter.receive(link)

    def _go_on(self, milliseconds: int) -> None:
        """Some steps."""
        for _ in range(milliseconds):
            self._now_ms += 1
            self.step(self._now_ms)

    def _answer(self) -> None:
        """What is typed here, at once: the aircraft stands still meanwhile."""
        for line in self._keyboard.lines():
            print(self._copter.console(line), end="", flush=True)

    def run(self) -> NoReturn:
        """Until it is interrupted, or crashes."""
        due = time.monotonic()
        while True:
            self._go_on(TURN_MS)
            for link, line in enumerate(self._lines):
                line.exchange(self._copter, link)
            self._answer()
            due += TURN_MS / 1000.0
            late = time.monotonic() - due
            if late > LATE_S:
                due += late
            elif late < 0.0:
                time.sleep(-late)
