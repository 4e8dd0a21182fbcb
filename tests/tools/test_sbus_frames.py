# SPDX-License-Identifier: Apache-2.0
"""The SBUS decoder, handed frames that Python's whole numbers encode, and what came between."""

from __future__ import annotations

import ctypes
import random
import shutil
import unittest
from pathlib import Path
from typing import ClassVar

from shim import library_of

from keel.flight import device_frames

ROOT = Path(__file__).resolve().parents[2]

GAP_US, BYTE_US, SILENT_US = 1000, 120, 4000
LOWEST, HIGHEST = 172, 1811
ALL, STICKS = 0xFFFF, 0x000F
FOOTERS = b"\x00\x04\x14\x24\x34"

# A decoder behind functions of whole numbers alone, so that nothing here knows how it is laid out.
SHIM = """\
#include "keel/middleware/sbus.h"
static keel_sbus_t sbus;
int begin(int judged)
{
    const keel_sbus_config_t config = {1000u, 172u, 1811u, (uint16_t)judged};
    return (int)keel_sbus_init(&sbus, &config);
}
int take(int byte, unsigned us) { return keel_sbus_take(&sbus, (uint8_t)byte, us) ? 1 : 0; }
int channel(int i) { return sbus.frame.channel[i]; }
int flags(void)
{
    return sbus.frame.digital_17 + 2 * sbus.frame.digital_18 + 4 * sbus.frame.lost +
           8 * sbus.frame.failsafe;
}
"""

Channels = tuple[int, ...]


def encoded(channels: Channels, flags: int = 0, footer: int = 0) -> bytes:
    """A frame: all channels are one number of 176 bits."""
    number = sum(value << (11 * index) for index, value in enumerate(channels))
    return bytes([0x0F]) + number.to_bytes(22, "little") + bytes([flags, footer])


def decoded(frame: bytes) -> Channels:
    number = int.from_bytes(frame[1:23], "little")
    return tuple((number >> (11 * index)) & 2047 for index in range(16))


def is_right(frame: bytes, judged: int = ALL) -> bool:
    plausible = all(
        LOWEST <= value <= HIGHEST
        for index, value in enumerate(decoded(frame))
        if judged >> index & 1
    )
    return frame[0] == 0x0F and frame[23] < 16 and frame[24] in FOOTERS and plausible


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Frames(unittest.TestCase):
    """Each frame that is right, and no other."""

    library: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.library = library_of(cls, SHIM, ["src/middleware/sbus.c"])

    def setUp(self) -> None:
        self.random = random.Random(20261124)
        self.begin(ALL)

    def begin(self, judged: int) -> None:
        self.assertEqual(self.library.begin(judged), 0)

    def feed(self, data: bytes, first_us: int = BYTE_US) -> list[int]:
        """Behind which bytes a frame was taken."""
        times = [first_us] + [BYTE_US] * len(data)
        return [at for at, byte in enumerate(data) if self.library.take(byte, times[at])]

    def says(self) -> tuple[Channels, int]:
        return tuple(self.library.channel(index) for index in range(16)), self.library.flags()

    def any_channels(self) -> Channels:
        return tuple(self.random.randint(LOWEST, HIGHEST) for _ in range(16))

    def test_a_known_frame(self) -> None:
        vector = bytes.fromhex("0fac00dfc4c1073ef0810f7ce0031ff8c0073ef0810f7c0c00")
        channels = (172, 992, 1811, *[992] * 13)
        self.assertEqual(encoded(channels, 0x0C), vector)
        self.assertEqual(self.feed(vector, SILENT_US), [24])
        self.assertEqual(self.says(), (channels, 12))

    def test_the_simulated_receiver(self) -> None:
        """tools/keel/flight/device_frames.py, which sends the frames in simulated flights."""
        for failsafe in (False, True):
            pulses = [988, 1500, 2012, 1000, 2000, 1050, 1501, 1499]
            frame = device_frames.sbus(pulses, failsafe)
            self.assertEqual(self.feed(frame, SILENT_US), [24])
            channels, flags = self.says()
            self.assertEqual([880 + (5 * value + 4) // 8 for value in channels[:8]], pulses)
            self.assertEqual((channels[8:], flags), ((992,) * 8, 8 * failsafe))

    def test_frames_behind_gaps_and_garbage(self) -> None:
        for _ in range(2000):
            channels, flags = self.any_channels(), self.random.randrange(16)
            garbage = self.random.randbytes(self.random.randrange(40))
            self.feed(garbage)
            self.assertEqual(self.feed(encoded(channels, flags), SILENT_US), [24])
            self.assertEqual(self.says(), (channels, flags))

    def test_every_change_of_one_byte(self) -> None:
        frame = encoded((992,) * 16)
        for at in range(25):
            for value in range(256):
                changed = frame[:at] + bytes([value]) + frame[at + 1 :]
                right = is_right(changed)
                self.assertEqual(self.feed(changed, SILENT_US), [24] if right else [])
                if right:
                    self.assertEqual(self.says(), (decoded(changed), changed[23]))

    def test_any_frame_is_taken_when_it_is_right(self) -> None:
        for judged in (ALL, STICKS, 0x8421, 0):
            self.begin(judged)
            taken = 0
            for _ in range(4000):
                frame = bytearray(encoded(self.any_channels(), self.random.randrange(16)))
                frame[24] = self.random.choice(FOOTERS)
                if self.random.random() < 0.7:
                    frame[self.random.randrange(25)] ^= 1 << self.random.randrange(8)
                before = self.says()
                right = is_right(frame, judged)
                self.assertEqual(self.feed(bytes(frame), SILENT_US), [24] if right else [])
                self.assertEqual(self.says(), (decoded(frame), frame[23]) if right else before)
                taken += right
            self.assertGreater(taken, 400)

    def test_a_stream_without_gaps(self) -> None:
        """The frames are those that a search finds which looks at all bytes at once."""
        for _ in range(200):
            stream = b"".join(
                encoded(self.any_channels())
                if self.random.random() < 0.7
                else self.random.randbytes(self.random.randrange(1, 60))
                for _ in range(20)
            )
            expected, at = [], 0
            while at + 25 <= len(stream):
                right = is_right(stream[at : at + 25])
                expected += [at + 24] if right else []
                at += 25 if right else 1
            self.begin(ALL)
            self.assertEqual(self.feed(stream), expected)
