# SPDX-License-Identifier: Apache-2.0
"""A model of the ferroelectric memory FM25V02 on a bus, opcode by opcode (data sheet 001-84498)."""

from __future__ import annotations

from dataclasses import dataclass, field

SIZE = 32768
ENABLE, WRITE, READ, IDENTIFY = 0x06, 0x02, 0x03, 0x9F
IDENTITY = bytes([0x7F] * 6 + [0xC2, 0x22, 0x08])


@dataclass
class Fram:
    """The memory; what it holds outlasts a reset."""

    there: bool = True
    content: bytearray = field(default_factory=lambda: bytearray(SIZE))
    selected: bool = False
    writable: bool = False  # By the opcode before, for one write.
    come: bytearray = field(default_factory=bytearray)  # Since it was selected.

    def select(self, selected: bool) -> None:
        """A write ends, or is enabled, when the memory is deselected."""
        if self.selected and not selected and self.come:
            self.writable = self.come[0] == ENABLE or (self.writable and self.come[0] != WRITE)
        self.selected = selected
        self.come.clear()

    def exchange(self, byte: int, now_us: int = 0) -> int:
        """One byte each way; without a memory all ones are read. It is never busy."""
        del now_us
        if not self.selected or not self.there:
            return 0xFF
        self.come.append(byte)
        opcode, behind = self.come[0], len(self.come) - 4  # Opcode and address.
        if opcode == IDENTIFY and len(self.come) > 1:
            return IDENTITY[(len(self.come) - 2) % len(IDENTITY)]
        if behind < 0 or opcode not in (READ, WRITE):
            return 0
        place = (int.from_bytes(self.come[1:3], "big") + behind) % SIZE
        if opcode == READ:
            return self.content[place]
        if self.writable:
            self.content[place] = byte
        return 0
