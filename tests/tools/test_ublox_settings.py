# SPDX-License-Identifier: Apache-2.0
"""The settings that bsp/devices/ublox.c sends to a receiver, beside those that pyubx2 builds."""

from __future__ import annotations

import ctypes
import importlib
import shutil
import unittest
from io import BytesIO
from pathlib import Path
from typing import Any, ClassVar

from shim import library_of

from keel.install.packages import provide

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("bsp/devices/ublox.c", "bsp/common/progress.c", "src/middleware/ubx.c")

BAUDS = (9600, 38400, 57600, 115200, 230400)
PERIODS_MS = (105, 200, 500, 1000)

# Whole numbers alone, so that nothing here knows how a driver is laid out.
SHIM = """\
#include "devices/ublox.h"
static keel_ublox_t ublox;
static uint8_t taken[1024];
static int count;
static bool send(void *context, uint8_t byte)
{
    (void)context;
    taken[count % 1024] = byte;
    count++;
    return true;
}
static void set_baud(void *context, uint32_t baud) { (void)context; (void)baud; }
int begin(unsigned baud, unsigned period_ms)
{
    const keel_ublox_port_t port = {send, set_baud, 0};
    count = 0;
    return (int)keel_ublox_begin(&ublox, port, baud, period_ms);
}
void step(unsigned us) { (void)keel_ublox_step(&ublox, us, 0u); }
int sent(void) { return count; }
int byte(int at) { return taken[at]; }
"""


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Settings(unittest.TestCase):
    """All that the driver sends at one rate."""

    library: ClassVar[ctypes.CDLL]
    pyubx2: ClassVar[Any]

    @classmethod
    def setUpClass(cls) -> None:
        provide("ubx")
        cls.pyubx2 = importlib.import_module("pyubx2")
        cls.library = library_of(cls, SHIM, SOURCES, ("-Iinclude", "-Ibsp"))

    def sent(self, baud: int, period_ms: int) -> bytes:
        """The bytes of one attempt: the line is set, two seconds pass, and 14 steps send."""
        self.assertEqual(self.library.begin(baud, period_ms), 0)
        for elapsed_us in (0, 2000000, *[1000] * 20):
            self.library.step(elapsed_us)
        return bytes(self.library.byte(at) for at in range(self.library.sent()))

    def message(self, name: str, **fields: int) -> bytes:
        data: bytes = self.pyubx2.UBXMessage("CFG", name, self.pyubx2.SET, **fields).serialize()
        return data

    def items(self, baud: int, period_ms: int) -> list[bytes]:
        """Into the RAM (layer 1), in no transaction."""
        values = (
            ("CFG_UART1OUTPROT_NMEA", 0),
            ("CFG_UART1INPROT_UBX", 1),
            ("CFG_UART1OUTPROT_UBX", 1),
            ("CFG_NAVSPG_DYNMODEL", 8),
            ("CFG_MSGOUT_UBX_NAV_PVT_UART1", 1),
            ("CFG_RATE_MEAS", period_ms),
            ("CFG_UART1_BAUDRATE", baud),
        )
        return [self.pyubx2.UBXMessage.config_set(1, 0, [item]).serialize() for item in values]

    def port(self, baud: int) -> bytes:
        """Bit 4 of the mode is set as receivers report it; pyubx2 calls it reserved."""
        mode = {"charLen": 3, "parity": 4, "nStopBits": 0}
        data = self.message("CFG-PRT", portID=1, baudRate=baud, inUBX=1, outUBX=1, **mode)
        payload = data[6:10] + bytes([data[10] | 0x10]) + data[11:-2]
        built: bytes = self.pyubx2.UBXMessage(6, 0, self.pyubx2.SET, payload=payload).serialize()
        return built

    def test_all_bytes_are_what_pyubx2_builds(self) -> None:
        pvt = self.pyubx2.UBXMessage(6, 1, self.pyubx2.SET, payload=b"\1\7\1").serialize()
        model = self.message("CFG-NAV5", dyn=1, dynModel=8)
        for baud in BAUDS:
            for period_ms in PERIODS_MS:
                *items, rate = self.items(baud, period_ms)
                period = self.message("CFG-RATE", measRate=period_ms, navRate=1, timeRef=1)
                expected = [*items, pvt, period, model, rate, self.port(baud)]
                self.assertEqual(self.sent(baud, period_ms), b"".join(expected))

    def test_all_bytes_are_messages_that_pyubx2_reads(self) -> None:
        """It reads the same from them, so that no message is built from a wrong idea of it."""
        data = self.sent(115200, 100)
        stream = self.pyubx2.UBXReader(BytesIO(data), msgmode=self.pyubx2.SET, quitonerror=2)
        raws, read = zip(*stream, strict=True)
        self.assertEqual(b"".join(raws), data)
        names = ["CFG-MSG", "CFG-RATE", "CFG-NAV5", "CFG-VALSET", "CFG-PRT"]
        self.assertEqual([one.identity for one in read], ["CFG-VALSET"] * 6 + names)
        self.assertEqual((read[7].measRate, read[7].navRate, read[7].timeRef), (100, 1, 1))
        nav5 = read[8]
        others = (nav5.minEl, nav5.posFixMode, nav5.drLim, nav5.posMask, nav5.timeMask)
        self.assertEqual((nav5.dyn, nav5.dynModel, *others), (1, 8, 0, 0, 0, 0, 0))
        layers = {(one.ram, one.bbr, one.flash) for one in (*read[:6], read[9])}
        self.assertEqual((layers, read[9].CFG_UART1_BAUDRATE), ({(1, 0, 0)}, 115200))
        self.assertEqual((read[10].portID, read[10].baudRate), (1, 115200))
