# SPDX-License-Identifier: Apache-2.0
"""Receivers that send bytes, one after the other, and what disturbs these on their way.

A disturbed byte is lost, or two of its bits change, or others come before it. Bytes of which one
bit has changed are lost where there is parity; the port's driver drops them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

RADIO, SATELLITES = range(2)
MOST_BETWEEN = 4  # Bytes that come from nowhere.


@dataclass(frozen=True)
class Line:
    """How a receiver is wired."""

    byte_us: int
    has_parity: bool


# Of SBUS and UBX 100000 baud 8E2 and 115200 baud 8N1; of CRSF 416666 baud, of IBUS 115200.
LINES = (Line(120, True), Line(87, False))
RADIO_LINES = {"sbus": LINES[RADIO], "crsf": Line(24, False), "ibus": Line(87, False)}


class Receiver:
    """What it sends stands in the simulated device, with the times at which it comes."""

    def __init__(
        self, memory: Any, number: int, rng: np.random.Generator, line: Line | None = None
    ) -> None:
        self._memory = memory["receiver"][number]
        self._line = line or LINES[number]
        self._rng = rng
        self._free_us = 0

    def send(self, now_us: int, data: bytes, noise: float = 0.0) -> None:
        """From now on, or when the line is free; a share of the bytes is disturbed."""
        sent = self._disturbed(data, noise) if noise > 0.0 else data
        memory, count, size = self._memory, int(self._memory["count"]), len(sent)
        ring = len(memory["byte"])
        places = np.arange(count, count + size) % ring
        start_us = max(now_us, self._free_us)
        memory["byte"][places] = np.frombuffer(sent, dtype=np.uint8)
        times_us = start_us + self._line.byte_us * np.arange(1, size + 1)
        memory["at_us"][places] = times_us % (1 << 32)
        memory["count"] = count + size
        self._free_us = start_us + self._line.byte_us * size

    def _disturbed(self, data: bytes, noise: float) -> bytes:
        """What comes of it."""
        sent = bytearray()
        for byte in data:
            if self._rng.random() >= noise:
                sent.append(byte)
                continue
            kind = int(self._rng.integers(4))
            bits = self._rng.choice(8, 2, replace=False)
            if kind == 1 and not self._line.has_parity:
                sent.append(byte ^ (1 << int(bits[0])))
            elif kind == 2:
                sent.append(byte ^ (1 << int(bits[0])) ^ (1 << int(bits[1])))
            elif kind == 3:
                sent += self._rng.bytes(int(self._rng.integers(1, MOST_BETWEEN + 1)))
                sent.append(byte)
        return bytes(sent)
