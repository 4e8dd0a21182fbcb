# SPDX-License-Identifier: Apache-2.0
"""The CRSF decoder, handed frames that crsf-parser encodes, and what came between.

crsf-parser lists channels from the last to the first, as all of them are one number to it.
"""

from __future__ import annotations

import contextlib
import ctypes
import importlib
import io
import random
import shutil
import unittest
from pathlib import Path
from typing import Any, ClassVar

from shim import library_of

from keel.install.packages import provide

ROOT = Path(__file__).resolve().parents[2]

BYTE_US, SILENT_US = 24, 3000
NOTHING, CHANNELS, LINK, _SHORT, OTHER = range(5)
HEADERS = b"\xc8\x00\xec\xee"
LATEST = 126

# A decoder behind functions of whole numbers alone, so that nothing here knows how it is laid out.
SHIM = """\
#include "keel/middleware/crsf.h"
static keel_crsf_t crsf;
int begin(void)
{
    const keel_crsf_config_t config = {300u, 200000u, 1000000u};
    return (int)keel_crsf_init(&crsf, &config);
}
int take(int byte, unsigned us) { return (int)keel_crsf_take(&crsf, (uint8_t)byte, us); }
int channel(int i) { return crsf.channel[i]; }
int link(int i)
{
    const int all[6] = {crsf.link.rssi[0], crsf.link.rssi[1], crsf.link.quality,
                        crsf.link.snr, crsf.link.antenna, crsf.link.mode};
    return all[i];
}
"""

Said = tuple[int, ...]


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Frames(unittest.TestCase):
    """Each frame that is right, and no other."""

    library: ClassVar[ctypes.CDLL]
    handling: ClassVar[Any]
    parser: ClassVar[Any]
    types: ClassVar[Any]

    @classmethod
    def setUpClass(cls) -> None:
        provide("radio")
        cls.parser = importlib.import_module("crsf_parser")
        cls.handling = importlib.import_module("crsf_parser.handling")
        cls.types = importlib.import_module("crsf_parser.payloads").PacketsTypes
        cls.library = library_of(
            cls, SHIM, ["src/middleware/crsf.c", "src/middleware/framing.c", "src/middleware/crc.c"]
        )

    def setUp(self) -> None:
        self.random = random.Random(20261125)
        self.assertEqual(self.library.begin(), 0)

    def feed(self, data: bytes, first_us: int = BYTE_US) -> list[tuple[int, int, Said]]:
        """Behind which bytes a frame was taken, which kind, and what it says."""
        taken = []
        for at, byte in enumerate(data):
            kind = self.library.take(byte, BYTE_US if at else first_us)
            if kind != NOTHING:
                taken.append((at, kind, self.says(kind)))
        return taken

    def says(self, kind: int) -> Said:
        if kind == CHANNELS:
            return tuple(self.library.channel(index) for index in range(16))
        return tuple(self.library.link(index) for index in range(6)) if kind == LINK else ()

    def channels_frame(self) -> tuple[bytes, Said]:
        said = tuple(self.random.randrange(2048) for _ in range(16))
        payload = {"channels": said[::-1]}
        return bytes(self.handling.crsf_build_frame(self.types.RC_CHANNELS_PACKED, payload)), said

    def link_frame(self) -> tuple[bytes, Said]:
        any_byte = self.random.randrange
        said = (
            any_byte(256),
            any_byte(256),
            any_byte(101),
            any_byte(-128, 128),
            any_byte(2),
            any_byte(3),
        )
        names = (
            "uplink_rssi_ant_1",
            "uplink_rssi_ant_2",
            "uplink_link_quality",
            "uplink_snr",
            "diversity_active_antenna",
            "rf_mode",
        )
        payload = dict(zip(names, said, strict=True))
        payload |= {
            "uplink_tx_power": any_byte(7),
            "downlink_rssi": any_byte(256),
            "downlink_link_quality": any_byte(101),
            "downlink_snr": -5,
        }
        return bytes(self.handling.crsf_build_frame(self.types.LINK_STATISTICS, payload)), said

    def other_frame(self) -> tuple[bytes, Said]:
        size = self.random.choice((0, 1, 6, 22, 60))
        payload = bytes([self.random.choice((0x02, 0x2B, 0xC8))]) + self.random.randbytes(size)
        return self.framed(payload), ()

    def framed(self, content: bytes) -> bytes:
        """A type and its payload as a frame."""
        crc = self.handling.crsf_crc(content)
        return bytes([0xC8, len(content) + 1]) + content + bytes([crc])

    def any_frame(self) -> tuple[bytes, int, Said]:
        kind = self.random.choice((CHANNELS, CHANNELS, LINK, OTHER))
        makers = {CHANNELS: self.channels_frame, LINK: self.link_frame, OTHER: self.other_frame}
        frame, said = makers[kind]()
        return bytes([self.random.choice(HEADERS)]) + frame[1:], kind, said

    def parsed(self, data: bytes) -> list[tuple[int, Said]]:
        """What crsf-parser finds in one frame of channels or statistics."""
        found: list[tuple[int, Said]] = []

        def consume(frame: Any, status: Any) -> None:
            if status == self.parser.PacketValidationStatus.VALID:
                rc = int(frame.header.type) == 0x16
                found.append((CHANNELS, tuple(frame.payload.channels)[::-1]) if rc else (LINK, ()))

        with contextlib.redirect_stdout(io.StringIO()):  # It prints each wrong CRC.
            self.parser.CRSFParser(consume).parse_stream(bytearray(data))
        return found

    def test_a_known_frame(self) -> None:
        vector = bytes.fromhex("c81816ac9838f8c0073ef0810f7ce0031ff8c0073ef0810f7c20")
        said = (172, 1811, *[992] * 14)
        self.assertEqual(self.parsed(vector), [(CHANNELS, said)])
        self.assertEqual(self.feed(vector, SILENT_US), [(25, CHANNELS, said)])

    def test_frames_behind_gaps_and_garbage(self) -> None:
        for _ in range(4000):
            frame, kind, said = self.any_frame()
            self.feed(self.random.randbytes(self.random.randrange(80)))
            self.assertEqual(self.feed(frame, SILENT_US), [(len(frame) - 1, kind, said)])

    def test_frames_with_changed_bytes(self) -> None:
        """Taken when crsf-parser takes it, too, and with the same channels."""
        taken = 0
        for _ in range(4000):
            frame, _ = self.channels_frame()
            changed = bytearray(frame)
            changed[self.random.randrange(3, 26)] ^= self.random.choice((1, 0x80, 0xD5))
            if self.random.random() < 0.3:
                changed[25] = self.handling.crsf_frame_crc(bytes(changed))
            expected = self.parsed(bytes(changed))
            got = self.feed(bytes(changed), SILENT_US)
            self.assertEqual([(kind, said) for _, kind, said in got], expected)
            taken += len(expected)
        self.assertGreater(taken, 1000)

    def found(self, stream: bytes) -> list[tuple[int, int]]:
        """First and last byte of each frame, by a search that looks at all bytes at once."""
        frames, at = [], 0
        while at + 4 <= len(stream):
            end = at + stream[at + 1] + 2
            possible = stream[at] in HEADERS and 2 <= stream[at + 1] <= 62 and end <= len(stream)
            if possible and self.handling.crsf_frame_crc(stream[at:end]) == stream[end - 1]:
                frames.append((at, end - 1))
                at = end
            else:
                at += 1
        return frames

    def test_a_stream_without_gaps(self) -> None:
        """All frames that such a search finds, in its order, and soon enough."""
        for _ in range(300):
            parts = []
            for _ in range(30):
                frame = bytearray(self.any_frame()[0])
                if self.random.random() < 0.3:
                    frame[self.random.randrange(len(frame))] = self.random.choice((0xC8, 2, 62))
                parts.append(bytes(frame))
                if self.random.random() < 0.3:
                    parts.append(self.random.randbytes(self.random.randrange(1, 60)))
            stream = b"".join(parts) + bytes(2 * LATEST)
            self.assertEqual(self.library.begin(), 0)
            got = self.feed(stream)
            expected = self.found(stream)
            self.assertEqual(len(got), len(expected))
            for (at, kind, said), (first, last) in zip(got, expected, strict=True):
                self.assertLessEqual(last, at)
                self.assertLessEqual(at, first + LATEST)
                if kind == CHANNELS:
                    # crsf-parser knows one first byte, and one length.
                    known = self.framed(stream[first + 2 : first + 25])
                    self.assertEqual(self.parsed(known), [(CHANNELS, said)])
