# SPDX-License-Identifier: Apache-2.0
"""The UBX decoder and what sets a receiver up, beside pyubx2, which encodes and parses the same."""

from __future__ import annotations

import ctypes
import importlib
import random
import shutil
import unittest
from io import BytesIO
from pathlib import Path
from typing import Any, ClassVar

from shim import library_of

from keel.flight import device_frames
from keel.install.packages import provide

ROOT = Path(__file__).resolve().parents[2]

GAP_US, BYTE_US, SILENT_US = 20000, 87, 80000
FIELDS = (
    "tow_ms",
    "longitude",
    "latitude",
    "height_mm",
    "accuracy_mm",
    "height_accuracy",
    "north",
    "east",
    "down",
    "speed_accuracy",
    "type",
    "satellites",
    "is_ok",
    "is_invalid",
)
COUNTS = ("bytes", "fixes", "acks", "naks", "others", "checksums", "cut")
HEADER = bytes.fromhex("b56201075c00")
HEADER_14 = bytes.fromhex("b56201075400")

# Whole numbers alone, so that nothing here knows how a decoder is laid out.
SHIM = (
    """\
#include "keel/middleware/ubx.h"
static keel_ubx_t ubx;
static keel_ubx_message_t message;
int begin(void)
{
    const keel_ubx_config_t config = {20000u, 500000u, 5000u, 1000u};
    return (int)keel_ubx_init(&ubx, &config);
}
int take(int byte, unsigned us) { return keel_ubx_take(&ubx, (uint8_t)byte, us) ? 1 : 0; }
int judge(void) { return (int)keel_ubx_judge(&ubx); }
int value(unsigned key, unsigned value) { return (int)keel_ubx_write_value(&message, key, value); }
void output(int group, int id, int every)
{
    keel_ubx_write_output(&message, (uint8_t)group, (uint8_t)id, (uint8_t)every);
}
void rate(int ms) { keel_ubx_write_rate(&message, (uint16_t)ms); }
void port(unsigned baud) { keel_ubx_write_port(&message, baud); }
int size(void) { return message.size; }
int written(int at) { return message.bytes[at]; }
"""
    + "".join(f"long long {name}(void) {{ return ubx.fix.{name}; }}\n" for name in FIELDS)
    + "".join(f"unsigned count_{name}(void) {{ return ubx.count.{name}; }}\n" for name in COUNTS)
)


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Messages(unittest.TestCase):
    """What pyubx2 encodes is decoded; what is written, pyubx2 parses."""

    library: ClassVar[ctypes.CDLL]
    pyubx2: ClassVar[Any]

    @classmethod
    def setUpClass(cls) -> None:
        provide("ubx")
        cls.pyubx2 = importlib.import_module("pyubx2")
        cls.library = library_of(cls, SHIM, ["src/middleware/ubx.c"])
        for name in FIELDS:
            getattr(cls.library, name).restype = ctypes.c_longlong

    def setUp(self) -> None:
        self.random = random.Random(20261124)
        self.assertEqual(self.library.begin(), 0)

    def feed(self, data: bytes, first_us: int = BYTE_US) -> list[int]:
        """Behind which bytes a fix was taken."""
        times = [first_us] + [BYTE_US] * len(data)
        return [at for at, byte in enumerate(data) if self.library.take(byte, times[at])]

    def says(self) -> dict[str, int]:
        return {name: getattr(self.library, name)() for name in FIELDS}

    def counts(self) -> dict[str, int]:
        return {name: getattr(self.library, f"count_{name}")() for name in COUNTS}

    def any_fix(self) -> tuple[dict[str, int], bytes]:
        """What a fix is to say, and its bytes: pyubx2's."""
        whole, natural = self.random.randrange, lambda: self.random.randrange(1 << 31)
        said = {
            "tow_ms": whole(604800000),
            "longitude": whole(-1800000000, 1800000000),
            "latitude": whole(-900000000, 900000000),
            "height_mm": whole(-(1 << 31), 1 << 31),
            "accuracy_mm": natural(),
            "height_accuracy": natural(),
            "north": whole(-(1 << 31), 1 << 31),
            "east": whole(-500000, 500000),
            "down": whole(-500000, 500000),
            "speed_accuracy": natural(),
            "type": whole(6),
            "satellites": whole(100),
            "is_ok": whole(2),
            "is_invalid": whole(2),
        }
        message = self.pyubx2.UBXMessage(
            "NAV",
            "NAV-PVT",
            self.pyubx2.GET,
            iTOW=said["tow_ms"],
            year=2026,
            month=whole(1, 13),
            day=whole(1, 29),
            hour=whole(24),
            min=whole(60),
            second=whole(60),
            validDate=1,
            tAcc=natural(),
            nano=whole(-1000000, 1000000),
            fixType=said["type"],
            gnssFixOk=said["is_ok"],
            diffSoln=whole(2),
            carrSoln=whole(3),
            numSV=said["satellites"],
            lon=said["longitude"] * 1e-7,
            lat=said["latitude"] * 1e-7,
            height=natural(),
            hMSL=said["height_mm"],
            hAcc=said["accuracy_mm"],
            vAcc=said["height_accuracy"],
            velN=said["north"],
            velE=said["east"],
            velD=said["down"],
            gSpeed=natural(),
            sAcc=said["speed_accuracy"],
            invalidLlh=said["is_invalid"],
            lastCorrectionAge=whole(13),
        )
        return said, message.serialize()

    def test_every_field_is_what_pyubx2_encoded(self) -> None:
        for _ in range(1500):
            said, data = self.any_fix()
            self.assertEqual(len(data), 100)
            self.assertEqual(self.feed(data, SILENT_US), [99])
            is_said = self.says()
            # pyubx2 rounds what is in degrees by itself: by one unit at most.
            for name in ("longitude", "latitude"):
                self.assertLessEqual(abs(is_said.pop(name) - said.pop(name)), 1)
            self.assertEqual(is_said, said)
        self.assertEqual(self.counts()["fixes"], 1500)

    def test_every_field_is_what_pyubx2_parses(self) -> None:
        """Payloads of any bits, so that each bit of a field counts."""
        for _ in range(1500):
            payload = self.random.randbytes(92)
            data = self.pyubx2.UBXMessage(1, 7, self.pyubx2.GET, payload=payload).serialize()
            self.assertEqual(self.feed(data, SILENT_US), [99])
            parsed = self.pyubx2.UBXReader.parse(data)
            self.assertEqual(
                list(self.says().values()),
                [
                    parsed.iTOW,
                    round(1e7 * parsed.lon),
                    round(1e7 * parsed.lat),
                    parsed.hMSL,
                    parsed.hAcc,
                    parsed.vAcc,
                    parsed.velN,
                    parsed.velE,
                    parsed.velD,
                    parsed.sAcc,
                    parsed.fixType,
                    parsed.numSV,
                    parsed.gnssFixOk,
                    parsed.invalidLlh,
                ],
            )

    def test_other_protocols_say_the_same(self) -> None:
        """84 bytes of an u-blox 7, and more than today's: as pyubx2 encodes the part they share."""
        for length in [84, 92, *(self.random.randrange(84, 3000) for _ in range(100))]:
            said, data = self.any_fix()
            payload = (data[6:-2] + self.random.randbytes(3000))[:length]
            if any(head in payload for head in (HEADER, HEADER_14)):
                continue
            data = self.pyubx2.UBXMessage(1, 7, self.pyubx2.GET, payload=payload).serialize()
            self.assertEqual(self.feed(data, SILENT_US), [len(data) - 1])
            is_said = self.says()
            for name in ("longitude", "latitude"):
                self.assertLessEqual(abs(is_said.pop(name) - said.pop(name)), 1)
            said["is_invalid"] &= length >= 92
            self.assertEqual(is_said, said)
        self.assertGreater(self.counts()["fixes"], 95)

    def any_stream(self) -> list[bytes]:
        """Fixes, other messages, lines of NMEA, and noise."""
        pieces = []
        for _ in range(12):
            kind = self.random.randrange(5)
            if kind < 2:
                pieces.append(self.any_fix()[1])
            elif kind == 2:
                payload = self.random.randbytes(self.random.randrange(400))
                pieces.append(
                    self.pyubx2.UBXMessage(0x0A, 0x04, self.pyubx2.GET, payload=payload).serialize()
                )
            elif kind == 3:
                pieces.append(b"$GNGGA,120000.00,,,,,0,00,99.99,,,,,,*7E\r\n")
            else:
                pieces.append(self.random.randbytes(self.random.randrange(60)))
        return pieces

    def test_undisturbed_streams_as_pyubx2_reads_them(self) -> None:
        for _ in range(60):
            stream = b"".join(piece for piece in self.any_stream() if piece[:2] == b"\xb5\x62")
            reader = self.pyubx2.UBXReader(BytesIO(stream), protfilter=2, quitonerror=0)
            read = [raw[2:4] for raw, _ in reader]
            self.library.begin()
            self.assertEqual(len(self.feed(stream)), read.count(b"\x01\x07"))
            counts = self.counts()
            self.assertEqual(counts["others"], len(read) - counts["fixes"])
            self.assertEqual((counts["bytes"], counts["checksums"]), (len(stream), 0))

    def test_disturbed_streams(self) -> None:
        """Each fix whose bytes all come is taken, whatever came before it; and nothing else is."""
        taken = lost = 0
        for _ in range(400):
            stream, ends = b"", []
            for piece in self.any_stream():
                is_fix = piece[:6] == HEADER
                if self.random.random() < 0.4:
                    piece = self.disturbed(piece)
                    lost += is_fix
                    is_fix = False
                stream += piece
                ends += [len(stream) - 1] if is_fix else []
            self.library.begin()
            self.assertEqual(self.feed(stream), ends)
            self.assertEqual(self.counts()["fixes"], len(ends))
            taken += len(ends)
        self.assertGreater(min(taken, lost), 400)

    def disturbed(self, piece: bytes) -> bytes:
        """With a bit changed, bytes lost, or a header that promises too much before it."""
        if len(piece) < 2:
            return b"\xb5\x62"
        at = self.random.randrange(len(piece))
        kind = self.random.randrange(3)
        if kind == 0:
            return piece[:at] + bytes([piece[at] ^ 1 << self.random.randrange(8)]) + piece[at + 1 :]
        if kind == 1:
            return piece[:at] + piece[at + self.random.randrange(1, 4) :]
        return b"\xb5\x62\x0a\x04\xff\xff" + piece[:at]

    def test_the_simulated_receiver_encodes_as_pyubx2(self) -> None:
        """tools/keel/flight/device_frames.py, which sends the fixes in simulated flights."""
        for _ in range(300):
            draw = self.random.uniform
            place, speed = (draw(-90, 90), draw(-180, 180)), (draw(-9, 9), draw(-9, 9), draw(-9, 9))
            tow, height, fixed = self.random.randrange(604800000), draw(-99, 999), draw(0, 1) < 0.7
            accuracy, pace = draw(0, 99), draw(0, 9)
            data = device_frames.nav_pvt(tow, place, height, speed, accuracy, pace, fixed)
            parsed = self.pyubx2.UBXReader.parse(data)  # Refuses a wrong checksum.
            self.assertEqual((parsed.identity, parsed.iTOW), ("NAV-PVT", tow))
            self.assertEqual((parsed.fixType, parsed.gnssFixOk), (3, 1) if fixed else (0, 0))
            self.assertAlmostEqual(parsed.lat, place[0], delta=1e-7)
            self.assertAlmostEqual(parsed.lon, place[1], delta=1e-7)
            is_said = (parsed.hMSL, parsed.velN, parsed.velE, parsed.velD, parsed.hAcc, parsed.sAcc)
            meant = (height, *speed, accuracy, pace)
            self.assertEqual(is_said, tuple(round(1000 * value) for value in meant))
            self.assertEqual(parsed.invalidLlh, 0)
            again = self.pyubx2.UBXMessage(1, 7, self.pyubx2.GET, payload=data[6:-2])
            self.assertEqual(again.serialize(), data)

    def test_acknowledgements(self) -> None:
        for name in ("ACK-ACK", "ACK-NAK", "ACK-ACK"):
            data = self.pyubx2.UBXMessage("ACK", name, self.pyubx2.GET, clsID=6, msgID=1)
            self.assertEqual(self.feed(data.serialize()), [])
        self.assertEqual((self.counts()["acks"], self.counts()["naks"]), (2, 1))

    def written(self) -> bytes:
        return bytes(self.library.written(at) for at in range(self.library.size()))

    def test_items(self) -> None:
        items = (
            ("CFG_UART1_BAUDRATE", 0x40520001, 115200),
            ("CFG_RATE_MEAS", 0x30210001, 100),
            ("CFG_MSGOUT_UBX_NAV_PVT_UART1", 0x20910007, 1),
            ("CFG_UART1OUTPROT_NMEA", 0x10740002, 0),
        )
        for name, key, value in items:
            self.assertEqual(self.pyubx2.UBX_CONFIG_DATABASE[name][0], key)
            self.assertEqual(self.library.value(key, value), 0)
            expected = self.pyubx2.UBXMessage.config_set(1, 0, [(name, value)])
            self.assertEqual(self.written(), expected.serialize())

    def test_every_item_of_at_most_four_bytes(self) -> None:
        sizes = {"1": 1, "2": 2, "4": 4}
        for name, (key, kind, *_) in self.pyubx2.UBX_CONFIG_DATABASE.items():
            status = self.library.value(key, 1)
            if size := sizes.get(kind[-1]):
                self.assertEqual((status, self.library.size()), (0, 16 + size), name)
            else:
                self.assertNotEqual(status, 0, name)

    def test_older_configuration(self) -> None:
        message, set_it = self.pyubx2.UBXMessage, self.pyubx2.SET
        self.library.output(1, 7, 5)
        parsed = self.pyubx2.UBXReader.parse(self.written(), msgmode=set_it)
        self.assertEqual((parsed.identity, parsed.msgClass, parsed.msgID), ("CFG-MSG", 1, 7))
        self.assertEqual(self.written(), message(6, 1, set_it, payload=b"\1\7\5").serialize())
        self.library.rate(200)
        expected = message("CFG", "CFG-RATE", set_it, measRate=200, navRate=1, timeRef=1)
        self.assertEqual(self.written(), expected.serialize())
        self.library.port(38400)
        expected = message(
            "CFG",
            "CFG-PRT",
            set_it,
            portID=1,
            charLen=3,
            parity=4,
            nStopBits=0,
            baudRate=38400,
            inUBX=1,
            outUBX=1,
        )
        # Bit 4 of the mode is set as receivers report it; pyubx2 calls it reserved.
        parsed = self.pyubx2.UBXReader.parse(self.written(), msgmode=set_it)
        self.assertEqual(
            (parsed.portID, parsed.baudRate, parsed.charLen, parsed.parity, parsed.nStopBits),
            (1, 38400, 3, 4, 0),
        )
        self.assertEqual((parsed.inUBX, parsed.inNMEA, parsed.outUBX, parsed.outNMEA), (1, 0, 1, 0))
        self.assertEqual(len(self.written()), len(expected.serialize()))
