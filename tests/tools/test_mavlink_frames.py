# SPDX-License-Identifier: Apache-2.0
"""MAVLink's frames beside pymavlink: what one writes, the other reads, and both refuse the same;
and among any bytes each frame that pymavlink takes where it begins is found.

Needs the group "mavlink" of the toolchain: pymavlink, with its definitions of the common messages.
"""

from __future__ import annotations

import ctypes
import os
import random
import shutil
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

from shim import library_of

from keel.install.packages import provide

ROOT = Path(__file__).resolve().parents[2]

FIRST, SIGNED, PAYLOAD_MAX = 0xFD, 1, 255

# Decoder and encoder behind functions of numbers and bytes alone, so that nothing here knows how
# they are laid out.
SHIM = """\
#include "keel/middleware/mavlink.h"
#include <string.h>
static keel_mavlink_message_t table[KEEL_MAVLINK_MESSAGES_MAX];
static keel_mavlink_t mavlink;
int begin(const unsigned *rows, unsigned known)
{
    for (unsigned i = 0; i < known; i++) {
        table[i].id = rows[4 * i];
        table[i].crc_extra = (uint8_t)rows[4 * i + 1];
        table[i].shortest = (uint8_t)rows[4 * i + 2];
        table[i].longest = (uint8_t)rows[4 * i + 3];
    }
    return (int)keel_mavlink_init(&mavlink, table, known);
}
/* 1: the bytes that are held are full. */
int take(int byte) { return keel_mavlink_take(&mavlink, (uint8_t)byte) != KEEL_OK ? 1 : 0; }
/* 0: nothing, 1: look again, 2: a frame. */
int look(void) { return (int)keel_mavlink_look(&mavlink); }
int gap(void) { return (int)keel_mavlink_gap(&mavlink); }
int says(int what)
{
    const keel_mavlink_frame_t *f = &mavlink.frame;
    const int all[] = {(int)f->id, f->sequence, f->system, f->component, f->compatible, f->length,
                       f->checksum, f->is_signed, f->link};
    return all[what];
}
unsigned long long timestamp(void) { return mavlink.frame.timestamp; }
const unsigned char *payload(void) { return mavlink.frame.payload; }
const unsigned char *seal(void) { return mavlink.frame.seal; }
unsigned counted(int what)
{
    const keel_mavlink_count_t *c = &mavlink.count;
    const unsigned all[] = {c->frames, c->checksums, c->unknown, c->lengths, c->flags, c->others};
    return all[what];
}
int put(int place, int sequence, int system, int component, const unsigned char *bytes, int length,
        unsigned char *out)
{
    keel_mavlink_sender_t sender = {(uint8_t)system, (uint8_t)component, (uint8_t)sequence, false};
    keel_mavlink_packet_t packet;
    const int whole =
        keel_mavlink_write(&sender, &table[place], bytes, (uint8_t)length, &packet);
    memcpy(out, packet.bytes, (size_t)whole);
    return whole;
}
"""
FRAMES, CHECKSUMS, UNKNOWN, LENGTHS, FLAGS, OTHERS = range(6)
NOTHING, AGAIN, FRAME = range(3)
# A frame is found so many bytes behind its last one at the latest.
LATEST = 265


def pymavlink() -> Any:
    """Its common messages, of MAVLink 2."""
    provide("mavlink")
    os.environ["MAVLINK20"] = "1"
    from pymavlink.dialects.v20 import common

    return common


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Frames(unittest.TestCase):
    """Each frame that is right, and no other."""

    library: ClassVar[ctypes.CDLL]
    common: ClassVar[Any]
    known: ClassVar[list[int]]

    @classmethod
    def setUpClass(cls) -> None:
        cls.common = pymavlink()
        cls.known = sorted(cls.common.mavlink_map)[:256]
        cls.library = library_of(cls, SHIM, ["src/middleware/mavlink.c", "src/middleware/crc.c"])
        cls.library.payload.restype = ctypes.POINTER(ctypes.c_ubyte)
        cls.library.seal.restype = ctypes.POINTER(ctypes.c_ubyte)
        cls.library.timestamp.restype = ctypes.c_ulonglong

    def setUp(self) -> None:
        self.random = random.Random(20261125)
        self.begin()

    def begin(self) -> None:
        rows: list[int] = []
        for number in self.known:
            message = self.common.mavlink_map[number]
            rows += [number, message.crc_extra, 1, message.unpacker.size]
        table = (ctypes.c_uint * len(rows))(*rows)
        self.assertEqual(self.library.begin(table, len(self.known)), 0)

    def found(self, look: Callable[[], int]) -> int:
        """How many frames looks find until there is nothing."""
        frames = 0
        for _ in range(2 * 280 + 1):
            seen = look()
            frames += seen == FRAME
            if seen == NOTHING:
                return frames
        raise AssertionError("looks are more than twice the bytes")

    def feed(self, data: bytes) -> list[int]:
        """Behind which bytes a frame was found; as often as there were frames."""
        ends: list[int] = []
        for at, byte in enumerate(data):
            self.assertEqual(self.library.take(byte), 0)
            ends += [at] * self.found(self.library.look)
        return ends

    def gap(self) -> int:
        """How many frames are found when nothing follows."""
        return self.found(self.library.gap)

    def payload(self) -> bytes:
        return bytes(self.library.payload()[:PAYLOAD_MAX])

    def any_payload(self, number: int) -> bytes:
        """All fields of a message, some of which are 0, as some of its last ones."""
        size = self.common.mavlink_map[number].unpacker.size
        kept = self.random.randrange(size + 1)
        odds = self.random.random()
        some = [
            self.random.randrange(256) if self.random.random() < odds else 0 for _ in range(kept)
        ]
        return bytes(some).ljust(size, b"\0")

    def sender(self, key: bytes = b"") -> Any:
        mav = self.common.MAVLink(None, self.random.randrange(256), self.random.randrange(256))
        mav.seq = self.random.randrange(256)
        if key:
            mav.signing.secret_key, mav.signing.sign_outgoing = key, True
            mav.signing.link_id = self.random.randrange(256)
            mav.signing.timestamp = self.random.randrange(2**48)
        return mav

    def packed(self, number: int, payload: bytes, mav: Any) -> bytes:
        """The frame as pymavlink writes it."""
        message = self.common.MAVLink_message(number, self.common.mavlink_map[number].msgname)
        extra = self.common.mavlink_map[number].crc_extra
        return bytes(message._pack(mav, extra, payload))

    def accepts(self, frame: bytes) -> bool:
        """Whether pymavlink takes these bytes as a frame of a message that it knows."""
        receiver = self.common.MAVLink(None)
        receiver.robust_parsing = True
        message = receiver.parse_char(frame)
        return message is not None and message.get_msgId() in self.common.mavlink_map

    def test_what_it_writes_is_read(self) -> None:
        for turn in range(4000):
            number = self.random.choice(self.known)
            payload = self.any_payload(number)
            mav = self.sender(bytes(32) if turn % 3 == 0 else b"")
            expected = [number, mav.seq, mav.srcSystem, mav.srcComponent, 0]
            frame = self.packed(number, payload, mav)
            self.assertEqual(self.feed(frame), [len(frame) - 1])
            self.assertEqual([self.library.says(what) for what in range(5)], expected)
            self.assertEqual(self.library.says(5), frame[1])
            self.assertEqual(self.payload(), payload.ljust(PAYLOAD_MAX, b"\0"))
            self.assertEqual(self.library.says(7), frame[2])
            if turn % 3 == 0:
                self.assertEqual(self.library.says(8), mav.signing.link_id)
                self.assertEqual(self.library.timestamp(), mav.signing.timestamp - 1)
                self.assertEqual(bytes(self.library.seal()[:6]), frame[-6:])

    def test_what_is_written_is_what_it_writes(self) -> None:
        out = (ctypes.c_ubyte * 280)()
        for _ in range(4000):
            number = self.random.choice(self.known)
            payload, mav = self.any_payload(number), self.sender()
            sequence, place = mav.seq, self.known.index(number)
            expected = self.packed(number, payload, mav)
            who = (sequence, mav.srcSystem, mav.srcComponent)
            written = self.library.put(place, *who, payload, len(payload), out)
            self.assertEqual(bytes(out[:written]), expected)
            self.assertTrue(self.accepts(bytes(out[:written])))

    def test_both_refuse_the_same_damaged_frames(self) -> None:
        taken = 0
        for _ in range(6000):
            number = self.random.choice(self.known)
            frame = bytearray(self.packed(number, self.any_payload(number), self.sender()))
            for _ in range(self.random.randrange(3)):
                frame[self.random.randrange(3, len(frame))] ^= 1 << self.random.randrange(8)
            self.gap()
            right = self.accepts(bytes(frame))
            self.assertEqual(self.feed(bytes(frame)), [len(frame) - 1] if right else [])
            taken += right
        self.assertGreater(taken, 1500)
        self.assertGreater(self.library.counted(CHECKSUMS), 1000)
        self.assertGreater(self.library.counted(UNKNOWN), 10)

    def test_shortened_frames_and_what_follows_a_gap(self) -> None:
        for _ in range(1000):
            number = self.random.choice(self.known)
            frame = self.packed(number, self.any_payload(number), self.sender())
            self.assertEqual(self.feed(frame[: self.random.randrange(len(frame))]), [])
            self.gap()
            self.assertEqual(self.feed(frame), [len(frame) - 1])

    def expected(self, stream: bytes) -> list[tuple[int, int]]:
        """Where frames begin and end: at each place, behind the last frame, pymavlink is asked."""
        frames, at = [], stream.find(FIRST)
        while at >= 0:
            whole = self.whole(stream[at:])
            if 0 < whole <= len(stream) - at and self.accepts(stream[at : at + whole]):
                frames.append((at, at + whole - 1))
                at += whole - 1
            at = stream.find(FIRST, at + 1)
        return frames

    def whole(self, frame: bytes) -> int:
        """The bytes of the frame that begins so; 0: none does."""
        if len(frame) < 3 or frame[2] > SIGNED:
            return 0
        return 12 + frame[1] + 13 * frame[2]

    def any_stretch(self) -> bytes:
        """A frame, whole or not; or bytes that are none; or beginnings of one."""
        number = self.random.choice(self.known)
        frame = self.packed(number, self.any_payload(number), self.sender())
        choice = self.random.random()
        if choice < 0.6:
            return frame
        if choice < 0.65:
            return frame[: self.random.randrange(len(frame))]
        if choice < 0.7:
            return frame[self.random.randrange(len(frame)) :]
        if choice < 0.75:
            return bytes([FIRST] * self.random.randrange(1, 5))
        if choice < 0.8:
            return bytes([FIRST, 0xFF, 0])
        if choice < 0.85:
            return self.carrier(frame)
        if choice < 0.9:
            return self.any_beginnings()
        return self.random.randbytes(self.random.randrange(1, 40))

    def any_beginnings(self) -> bytes:
        """Headers of messages that are known, one in the other, without their frames."""
        some = bytearray()
        for _ in range(self.random.randrange(1, 20)):
            number = self.random.choice(self.known)
            length = self.common.mavlink_map[number].unpacker.size
            header = bytes([FIRST, length, self.random.randrange(2), 0, 0, 1, 1])
            some += (header + number.to_bytes(3, "little"))[: self.random.randrange(3, 11)]
        return bytes(some)

    def carrier(self, frame: bytes) -> bytes:
        """A frame whose payload has a frame in it, or what looks like beginnings of some."""
        inner = frame if self.random.random() < 0.5 else bytes([FIRST, 0x20, 0]) * 40
        number = 385 if self.random.random() < 0.5 else 12918 * 1000  # TUNNEL, and none
        payload = bytes(5) + inner[:120] + b"\1"
        if number in self.common.mavlink_map:
            return self.packed(number, payload.ljust(133, b"\0"), self.sender())
        return (
            bytes([FIRST, len(payload), 0, 0, 0, 1, 1])
            + number.to_bytes(3, "little")
            + payload
            + b"\0\0"
        )

    def test_each_frame_in_a_stream_is_found(self) -> None:
        frames = late = 0
        for _ in range(100):
            stream = b"".join(self.any_stretch() for _ in range(40))
            expected = self.expected(stream)
            self.begin()
            ends = self.feed(stream)
            count = len(ends) + self.gap()
            self.assertEqual(count, len(expected))
            for (_, last), found in zip(expected, ends, strict=False):
                self.assertTrue(last <= found <= last + LATEST, (last, found))
                late += found > last
            self.assertEqual(self.library.counted(FRAMES), len(expected))
            frames += len(expected)
        self.assertGreater(frames, 1500)
        self.assertGreater(late, 100)

    def test_what_a_datagram_holds_behind_garbage_is_found(self) -> None:
        for _ in range(500):
            garbage = self.random.choice([bytes([FIRST, 0xFF, 0]), self.any_beginnings()])
            commands = b"".join(
                self.packed(76, self.any_payload(76), self.sender()) for _ in range(6)
            )
            expected = self.expected(garbage + commands)
            self.assertEqual(len(self.feed(garbage + commands)) + self.gap(), len(expected))

    def test_frames_of_a_whole_log_one_behind_the_other(self) -> None:
        """Whoever begins to listen in the middle of frames full of beginnings."""
        payload = bytes([FIRST, 0x20, 0]) * 44 + b"\1"
        stream = b"".join(self.packed(385, payload, self.sender()) for _ in range(30))
        ends = self.feed(stream[50:])
        self.assertEqual(len(ends) + self.gap(), 29)
