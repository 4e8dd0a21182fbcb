# SPDX-License-Identifier: Apache-2.0
"""MAVLink's signatures beside pymavlink's, with HACL*'s SHA-256, which builds for the target, too.

Needs the group "mavlink" of the toolchain: pymavlink, and a crate that carries HACL*'s C sources.
"""

from __future__ import annotations

import ctypes
import random
import shutil
import tempfile
import unittest
from pathlib import Path
from typing import Any, ClassVar

from shim import library_of
from test_mavlink_frames import pymavlink

from keel.base.run import output_of
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

KEY, OTHER_KEY, TIME = bytes(range(32)), bytes(range(1, 33)), 2**41
SOURCES = ["src/middleware/signing.c", "src/middleware/mavlink.c", "src/middleware/crc.c"]

# How Keel's hash is made of HACL*'s.
HASH = """\
#include "Hacl_Hash_SHA2.h"
#include <string.h>
#include "keel/middleware/signing.h"
static void sha256(const uint8_t *data, uint32_t size, uint8_t *digest)
{
    Hacl_Hash_SHA2_hash_256(digest, (uint8_t *)data, size);
}
"""
SHIM = (
    HASH
    + """\
static const keel_mavlink_message_t table[] = {{0u, 50u, 1u, 9u}, {76u, 152u, 1u, 33u}};
static keel_mavlink_t mavlink;
static keel_signing_t signing;
static keel_mavlink_sender_t sender = {7u, 8u, 0u, false};
int begin(int link)
{
    keel_signing_init(&signing, (uint8_t)link, sha256);
    return (int)keel_mavlink_init(&mavlink, table, 2u);
}
void set_key(const unsigned char *key) { keel_signing_set_key(&signing, key); }
void clear_key(void) { keel_signing_clear_key(&signing); }
void advance(unsigned long long timestamp) { keel_signing_advance(&signing, timestamp); }
unsigned long long timestamp(void) { return signing.timestamp; }
/* Frames accepted, and frames that were right but for their signatures. */
int take(const unsigned char *bytes, int count)
{
    int taken = 0;
    for (int i = 0; i < count; i++) {
        keel_mavlink_look_t seen = KEEL_MAVLINK_AGAIN;
        (void)keel_mavlink_take(&mavlink, bytes[i]);
        while (seen != KEEL_MAVLINK_NOTHING) {
            seen = keel_mavlink_look(&mavlink);
            if (seen == KEEL_MAVLINK_FRAME) {
                taken += keel_signing_accepts(&signing, &mavlink.frame) ? 1 : 100;
            }
        }
    }
    return taken;
}
unsigned counted(int what)
{
    const keel_signing_count_t *c = &signing.count;
    const unsigned all[] = {c->accepted, c->missing, c->wrong, c->replayed, c->old, c->full};
    return all[what];
}
int put(int place, const unsigned char *bytes, int length, unsigned char *out)
{
    keel_mavlink_packet_t packet;
    const int whole =
        keel_signing_write(&signing, &sender, &table[place], bytes, (uint8_t)length, &packet);
    memcpy(out, packet.bytes, (size_t)whole);
    return whole;
}
void hashed(const unsigned char *bytes, unsigned size, unsigned char *digest)
{
    sha256(bytes, size, digest);
}
"""
)
TARGET = (
    HASH
    + """\
static keel_signing_t signing;
static keel_mavlink_frame_t frame;
int main(void)
{
    keel_signing_init(&signing, 1u, sha256);
    return keel_signing_accepts(&signing, &frame) ? 0 : 1;
}
"""
)
ACCEPTED, MISSING, WRONG, REPLAYED, OLD, FULL = range(6)


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Signing(unittest.TestCase):
    """Each frame that the key's owner signed, once, and no other."""

    library: ClassVar[ctypes.CDLL]
    common: ClassVar[Any]
    folder: ClassVar[Path]
    hacl: ClassVar[list[str | Path]]

    @classmethod
    def setUpClass(cls) -> None:
        cls.common = pymavlink()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder, carried = Path(folder.name), Path(Toolchain().command("hacl")[0]) / "c"
        cls.hacl = [
            carried / "src/Hacl_Hash_SHA2.c",
            f"-I{carried / 'include'}",
            f"-I{carried / 'karamel/include'}",
            f"-I{carried / 'karamel/krmllib/dist/minimal'}",
        ]
        flags = ("-std=gnu11", "-w", "-Iinclude")
        cls.library = library_of(cls, SHIM, [*SOURCES, *map(str, cls.hacl)], flags)
        cls.library.timestamp.restype = ctypes.c_ulonglong

    def setUp(self) -> None:
        self.random = random.Random(20261126)
        self.begin(KEY)

    def begin(self, key: bytes | None) -> None:
        self.assertEqual(self.library.begin(5), 0)
        if key is not None:
            self.library.set_key(key)
        self.library.advance(ctypes.c_ulonglong(TIME))

    def station(self, key: bytes | None = KEY, timestamp: int = TIME, link: int = 1) -> Any:
        """Whoever talks to the vehicle."""
        mav = self.common.MAVLink(None, 255, 190)
        mav.robust_parsing = True
        if key is not None:
            mav.signing.secret_key, mav.signing.sign_outgoing = key, True
            mav.signing.link_id, mav.signing.timestamp = link, timestamp
        return mav

    def said(self, mav: Any) -> bytes:
        """A command, signed or not."""
        numbers = [self.random.uniform(-1.0, 1.0) for _ in range(7)]
        return bytes(self.common.MAVLink_command_long_message(7, 8, 400, 0, *numbers).pack(mav))

    def take(self, frame: bytes) -> int:
        return int(self.library.take(frame, len(frame)))

    def count(self, what: int) -> int:
        return int(self.library.counted(what))

    def test_the_hash_is_known(self) -> None:
        """FIPS 180-4's examples."""
        expected = {
            b"abc": "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad",
            b"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq": (
                "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"
            ),
        }
        for text, digest in expected.items():
            out = (ctypes.c_ubyte * 32)()
            self.library.hashed(text, len(text), out)
            self.assertEqual(bytes(out).hex(), digest)

    def test_what_it_signs_is_accepted_once(self) -> None:
        mav = self.station()
        for turn in range(500):
            frame = self.said(mav)
            self.assertEqual(self.take(frame), 1)
            self.assertEqual(self.take(frame), 100)
            self.assertEqual((self.count(ACCEPTED), self.count(REPLAYED)), (turn + 1, turn + 1))

    def test_nothing_else_is_accepted(self) -> None:
        self.assertEqual(self.take(self.said(self.station(None))), 100)
        self.assertEqual(self.count(MISSING), 1)
        self.assertEqual(self.take(self.said(self.station(OTHER_KEY))), 100)
        self.assertEqual(self.count(WRONG), 1)
        mav = self.station()
        for _ in range(500):
            frame = bytearray(self.said(mav))
            # Behind the checksum: link, timestamp and seal, which nothing else protects.
            frame[-1 - self.random.randrange(13)] ^= 1 << self.random.randrange(8)
            self.assertEqual(self.take(bytes(frame)), 100)
        self.assertEqual(self.count(ACCEPTED), 0)
        self.assertEqual(self.take(self.said(mav)), 1)

    def test_recorded_frames_are_refused_in_any_order(self) -> None:
        mav = self.station()
        recorded = [self.said(mav) for _ in range(50)]
        for frame in recorded:
            self.assertEqual(self.take(frame), 1)
        for frame in self.random.sample(recorded, 50):
            self.assertEqual(self.take(frame), 100)
        self.assertEqual(self.count(REPLAYED), 50)
        # Behind a restart, as far as the time that was stored goes on: all are too old.
        stored = self.library.timestamp()
        self.begin(KEY)
        self.library.advance(ctypes.c_ulonglong(stored + 6_000_001))
        for frame in recorded:
            self.assertEqual(self.take(frame), 100)
        self.assertEqual(self.count(OLD), 50)

    def test_new_streams(self) -> None:
        early = self.station(timestamp=TIME - 6_000_001, link=9)
        self.assertEqual(self.take(self.said(early)), 100)
        self.assertEqual(self.take(self.said(early)), 1)
        for link in range(10, 17):
            self.assertEqual(self.take(self.said(self.station(link=link))), 1)
        self.assertEqual(self.take(self.said(self.station(link=17))), 100)
        self.assertEqual((self.count(OLD), self.count(FULL)), (1, 1))

    def test_without_a_key(self) -> None:
        self.begin(None)
        for key in (None, KEY, OTHER_KEY):
            frame = self.said(self.station(key))
            self.assertEqual([self.take(frame), self.take(frame)], [1, 1])

    def test_what_is_signed_it_accepts(self) -> None:
        out = (ctypes.c_ubyte * 280)()
        mav = self.station(timestamp=TIME)
        for _ in range(500):
            payload = self.random.randbytes(33) if self.random.random() < 0.5 else bytes(33)
            written = self.library.put(1, payload, 33, out)
            message = mav.parse_char(bytes(out[:written]))
            self.assertEqual(message.get_type(), "COMMAND_LONG")
            self.assertEqual(message.get_srcSystem(), 7)
        self.assertEqual((mav.signing.goodsig_count, mav.signing.badsig_count), (500, 0))
        self.assertEqual(mav.signing.timestamp, TIME + 500)
        self.library.set_key(OTHER_KEY)
        written = self.library.put(1, bytes(33), 33, out)
        mav.parse_char(bytes(out[:written]))
        self.assertEqual(mav.signing.badsig_count, 1)

    def test_the_hash_builds_for_the_target_without_a_heap(self) -> None:
        program, image = self.folder / "target.c", self.folder / "target.elf"
        program.write_text(TARGET)
        flags = [
            "-std=c11",
            "-Os",
            "-ffreestanding",
            "-ffunction-sections",
            "-fdata-sections",
            "-w",
        ]
        chip = ["-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard"]
        output_of(
            [
                "arm-none-eabi-gcc",
                *chip,
                *flags,
                f"-I{ROOT / 'include'}",
                program,
                *[ROOT / name for name in SOURCES],
                *self.hacl,
                "-nostartfiles",
                "-Wl,--gc-sections,-e,main",
                "-o",
                image,
            ]
        )
        symbols = output_of(["arm-none-eabi-nm", image]).split()
        self.assertIn("Hacl_Hash_SHA2_hash_256", symbols)
        self.assertIn("keel_signing_accepts", symbols)
        self.assertEqual({"malloc", "calloc", "free", "_sbrk"} & set(symbols), set())
