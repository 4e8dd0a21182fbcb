# SPDX-License-Identifier: Apache-2.0
"""The IBUS decoder, handed frames that Python encodes, and what came between."""

from __future__ import annotations

import ctypes
import random
import shutil
import struct
import unittest
from itertools import product
from pathlib import Path
from typing import ClassVar

from shim import library_of

ROOT = Path(__file__).resolve().parents[2]

BYTE_US, SILENT_US = 87, 4000
LOWEST, HIGHEST = 900, 2100
ALL, STICKS = 0x3FFFF, 0x0000F

# A decoder behind functions of whole numbers alone, so that nothing here knows how it is laid out.
SHIM = """\
#include "keel/middleware/ibus.h"
static keel_ibus_t ibus;
int begin(int extended, unsigned judged)
{
    const keel_ibus_config_t config = {500u, judged, 900u, 2100u, extended != 0};
    return (int)keel_ibus_init(&ibus, &config);
}
int take(int byte, unsigned us) { return keel_ibus_take(&ibus, (uint8_t)byte, us) ? 1 : 0; }
int channel(int i) { return ibus.channel[i]; }
"""

Channels = tuple[int, ...]


def summed(content: bytes) -> bytes:
    return content + struct.pack("<H", 0xFFFF - sum(content))


def encoded(channels: Channels) -> bytes:
    """A frame of 14 or of 18 channels: those from 15 on as hexadecimal digits, the last first."""
    digits = "".join(f"{value:03x}"[::-1] for value in channels[14:]).ljust(14, "0")
    words = (int(digit, 16) << 12 | value for digit, value in zip(digits, channels, strict=False))
    return summed(b"\x20\x40" + struct.pack("<14H", *words))


def decoded(frame: bytes, extended: bool) -> Channels:
    words = struct.unpack_from("<14H", frame, 2)
    if not extended:
        return (*words, 0, 0, 0, 0)
    digits = [f"{word:04x}" for word in words]
    extras = (
        int("".join(digit[0] for digit in digits[at : at + 3])[::-1], 16) for at in range(0, 12, 3)
    )
    return (*(int(digit[1:], 16) for digit in digits), *extras)


def is_right(frame: bytes, extended: bool, judged: int = ALL) -> bool:
    channels = decoded(frame, extended)[: 18 if extended else 14]
    return (
        frame[:2] == b"\x20\x40"
        and summed(frame[:30]) == frame
        and all(
            LOWEST <= value <= HIGHEST
            for index, value in enumerate(channels)
            if judged >> index & 1
        )
    )


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Frames(unittest.TestCase):
    """Each frame that is right, and no other."""

    library: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.library = library_of(cls, SHIM, ["src/middleware/ibus.c", "src/middleware/framing.c"])

    def setUp(self) -> None:
        self.random = random.Random(20261126)
        self.begin(extended=False)

    def begin(self, *, extended: bool, judged: int = ALL) -> None:
        self.assertEqual(self.library.begin(int(extended), judged), 0)

    def feed(self, data: bytes, first_us: int = BYTE_US) -> list[int]:
        """Behind which bytes a frame was taken."""
        times = [first_us] + [BYTE_US] * len(data)
        return [at for at, byte in enumerate(data) if self.library.take(byte, times[at])]

    def says(self) -> Channels:
        return tuple(self.library.channel(index) for index in range(18))

    def any_channels(self, count: int = 14) -> Channels:
        return tuple(self.random.randint(LOWEST, HIGHEST) for _ in range(count))

    def test_a_known_frame(self) -> None:
        vector = bytes.fromhex("2040dc05dc05e803" + "dc05" * 11 + "47f3")
        channels = (1500, 1500, 1000, *[1500] * 11)
        self.assertEqual(encoded(channels), vector)
        self.assertEqual(self.feed(vector, SILENT_US), [31])
        self.assertEqual(self.says(), (*channels, 0, 0, 0, 0))

    def test_frames_behind_gaps_and_garbage(self) -> None:
        for extended in (False, True):
            self.begin(extended=extended)
            for _ in range(2000):
                channels = self.any_channels(18 if extended else 14)
                self.feed(self.random.randbytes(self.random.randrange(50)))
                self.assertEqual(self.feed(encoded(channels), SILENT_US), [31])
                self.assertEqual(self.says()[: len(channels)], channels)

    def test_every_change_of_one_byte(self) -> None:
        frame = encoded((1500,) * 14)
        for at in range(32):
            for value in range(256):
                changed = frame[:at] + bytes([value]) + frame[at + 1 :]
                right = is_right(changed, extended=False)
                self.assertEqual(right, changed == frame)
                self.assertEqual(self.feed(changed, SILENT_US), [31] if right else [])

    def test_any_frame_is_taken_when_it_is_right(self) -> None:
        for extended, judged in product((False, True), (ALL, STICKS, 0x28421)):
            self.begin(extended=extended, judged=judged)
            taken = 0
            for _ in range(4000):
                content = bytearray(encoded(self.any_channels(18 if extended else 14))[:30])
                if self.random.random() < 0.7:
                    content[self.random.randrange(30)] ^= 1 << self.random.randrange(8)
                frame = summed(bytes(content))
                before, right = self.says(), is_right(frame, extended, judged)
                self.assertEqual(self.feed(frame, SILENT_US), [31] if right else [])
                self.assertEqual(self.says(), decoded(frame, extended) if right else before)
                taken += right
            self.assertGreater(taken, 400)

    def test_a_stream_without_gaps(self) -> None:
        """The frames are those that a search finds which looks at all bytes at once."""
        for _ in range(200):
            stream = b"".join(
                encoded(self.any_channels())
                if self.random.random() < 0.7
                else bytes(self.random.choices(b"\x20\x40\x05\xdc", k=self.random.randrange(1, 60)))
                for _ in range(20)
            )
            expected, at = [], 0
            while at + 32 <= len(stream):
                right = is_right(stream[at : at + 32], extended=False)
                expected += [at + 31] if right else []
                at += 32 if right else 1
            self.begin(extended=False)
            self.assertEqual(self.feed(stream), expected)
