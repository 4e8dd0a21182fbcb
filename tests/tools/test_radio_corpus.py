# SPDX-License-Identifier: Apache-2.0
"""What receivers in the field send (tests/corpus/radio.toml), handed to the decoders.

Decoders are made as their headers call usual: the sticks alone are judged.
"""

from __future__ import annotations

import ctypes
import shutil
import tomllib
import unittest
from pathlib import Path
from typing import Any, ClassVar

from shim import library_of

ROOT = Path(__file__).resolve().parents[2]

CORPUS = ROOT / "tests/corpus/radio.toml"
BYTE_US = {"sbus": 120, "crsf": 24, "ibus": 87}
KINDS = ("nothing", "channels", "link", "short", "other")

# Decoders behind functions of whole numbers alone: nothing here knows how they are laid out.
SHIM = """\
#include "keel/middleware/crsf.h"
#include "keel/middleware/ibus.h"
#include "keel/middleware/ppm.h"
#include "keel/middleware/sbus.h"
static keel_sbus_t sbus;
static keel_crsf_t crsf;
static keel_ibus_t ibus;
static keel_ppm_t ppm;
int begin(int extended)
{
    const keel_sbus_config_t of_sbus = {
        .gap_us = 1000u, .lowest = 8u, .highest = 1976u, .judged = 0x000Fu};
    const keel_crsf_config_t of_crsf = {
        .gap_us = 300u, .channels_us = 200000u, .link_us = 1000000u};
    const keel_ibus_config_t of_ibus = {.gap_us = 500u, .judged = 0x0000Fu, .lowest = 885u,
                                        .highest = 2115u, .extended = extended != 0};
    const keel_ppm_config_t of_ppm = {.lost_us = 100000u, .lowest_us = 800u, .highest_us = 2200u,
                                      .sync_us = 2300u, .judged = 0x000Fu, .least = 4u,
                                      .frames_to_take = 3u};
    return (int)keel_sbus_init(&sbus, &of_sbus) + (int)keel_crsf_init(&crsf, &of_crsf) +
           (int)keel_ibus_init(&ibus, &of_ibus) + (int)keel_ppm_init(&ppm, &of_ppm);
}
int sbus_take(int byte, unsigned us) { return keel_sbus_take(&sbus, (uint8_t)byte, us) ? 1 : 0; }
int crsf_take(int byte, unsigned us) { return (int)keel_crsf_take(&crsf, (uint8_t)byte, us); }
int ibus_take(int byte, unsigned us) { return keel_ibus_take(&ibus, (uint8_t)byte, us) ? 1 : 0; }
int ppm_take(unsigned us) { return keel_ppm_take(&ppm, us) ? 1 : 0; }
int sbus_channel(int i) { return sbus.frame.channel[i]; }
int crsf_channel(int i) { return crsf.channel[i]; }
int ibus_channel(int i) { return ibus.channel[i]; }
int ppm_channel(int i) { return ppm.channel[i]; }
int sbus_flags(void)
{
    return sbus.frame.digital_17 + 2 * sbus.frame.digital_18 + 4 * sbus.frame.lost +
           8 * sbus.frame.failsafe;
}
int crsf_link(int i)
{
    const int all[6] = {crsf.link.rssi[0], crsf.link.rssi[1], crsf.link.quality,
                        crsf.link.snr, crsf.link.antenna, crsf.link.mode};
    return all[i];
}
int crsf_lost(void) { return keel_crsf_is_lost(&crsf) ? 1 : 0; }
unsigned sbus_ranges(void) { return sbus.count.ranges; }
unsigned sbus_flag_errors(void) { return sbus.count.flags; }
unsigned sbus_footers(void) { return sbus.count.footers; }
unsigned ibus_ranges(void) { return ibus.count.ranges; }
unsigned ppm_pulses(void) { return ppm.count.pulses; }
"""

# The count of a protocol's refusals by a reason.
COUNTS = {
    ("sbus", "ranges"): "sbus_ranges",
    ("sbus", "flags"): "sbus_flag_errors",
    ("sbus", "footers"): "sbus_footers",
    ("ibus", "ranges"): "ibus_ranges",
    ("ppm", "pulses"): "ppm_pulses",
}

Part = dict[str, Any]


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Corpus(unittest.TestCase):
    """Each frame of the corpus says what the corpus says that it does."""

    library: ClassVar[ctypes.CDLL]
    streams: ClassVar[list[dict[str, Any]]]

    @classmethod
    def setUpClass(cls) -> None:
        units = ("sbus", "crsf", "ibus", "ppm", "framing", "crc")
        cls.library = library_of(cls, SHIM, [f"src/middleware/{unit}.c" for unit in units])
        cls.streams = tomllib.loads(CORPUS.read_text())["stream"]

    def call(self, name: str, *values: int) -> int:
        return int(getattr(self.library, name)(*values))

    def fed(self, protocol: str, part: Part) -> list[int]:
        """What each byte or edge ended."""
        if protocol == "ppm":
            return [self.call("ppm_take", width) for width in part["edges"]]
        data = bytes.fromhex(part["bytes"])
        times = [part["after_us"]] + [BYTE_US[protocol]] * len(data)
        return [
            self.call(f"{protocol}_take", byte, us) for byte, us in zip(data, times, strict=False)
        ]

    def said(self, protocol: str, part: Part) -> list[int]:
        what = "crsf_link" if part.get("kind") == "link" else f"{protocol}_channel"
        return [self.call(what, index) for index in range(len(part["says"]))]

    def check_bytes(self, protocol: str, part: Part) -> None:
        """Taken by its last byte alone, or by none."""
        kind = KINDS.index(part.get("kind", "channels" if "says" in part else "nothing"))
        taken = self.fed(protocol, part)
        self.assertEqual(taken, [0] * (len(taken) - 1) + [kind])
        if "says" in part:
            self.assertEqual(self.said(protocol, part), part["says"])
        if "flags" in part:
            self.assertEqual(self.call("sbus_flags"), part["flags"])

    def check(self, protocol: str, part: Part) -> None:
        count = COUNTS.get((protocol, part.get("refused", "")))
        before = self.call(count) if count else 0
        if protocol == "ppm":
            self.fed(protocol, part)
        else:
            self.check_bytes(protocol, part)
        if count:
            self.assertEqual(self.call(count), before + 1)

    def of(self, *protocols: str) -> list[dict[str, Any]]:
        found = [stream for stream in self.streams if stream["protocol"] in protocols]
        self.assertGreater(len(found), 4)
        return found

    def test_frames_of_bytes(self) -> None:
        for stream in self.of("sbus", "crsf", "ibus"):
            with self.subTest(stream["name"]):
                self.assertEqual(self.call("begin", int(stream.get("extended", False))), 0)
                for part in stream["part"]:
                    self.check(stream["protocol"], part)
                if "lost" in stream:
                    self.assertEqual(self.call("crsf_lost"), int(stream["lost"]))

    def test_rows_of_edges(self) -> None:
        """Each stream is as often right as is asked for, and says the last part's channels then."""
        for stream in self.of("ppm"):
            with self.subTest(stream["name"]):
                self.assertEqual(self.call("begin", 0), 0)
                self.call("ppm_take", 9000)
                self.call("ppm_take", 9000)
                for part in stream["part"]:
                    self.check("ppm", part)
                last = stream["part"][-1]
                self.assertEqual(self.said("ppm", last), last["says"])

    def test_refusals_have_a_count(self) -> None:
        for stream in self.streams:
            for part in stream["part"]:
                if "refused" in part:
                    self.assertIn((stream["protocol"], part["refused"]), COUNTS)
