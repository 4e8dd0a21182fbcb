# SPDX-License-Identifier: Apache-2.0
"""The copter's radio: which protocol is found, what is told when nobody is heard, task by task."""

from __future__ import annotations

import bisect
import ctypes
import itertools
import tomllib
import unittest
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from copter_shim import copter_of

ROOT = Path(__file__).resolve().parents[2]

ANY, SBUS, CRSF, IBUS, PPM = range(5)
BYTE_US = {SBUS: 120, CRSF: 24, IBUS: 87}
EVERY_US = {SBUS: 9000, CRSF: 4000, IBUS: 7000}

# The tasks behind functions of plain numbers, with a port that hands over what it is told to.
SHIM = """\
#include "copter.h"
#include <string.h>
static copter_t copter;
static copter_port_t port;
static const uint8_t *data;
static const uint32_t *times;
static uint32_t left;
static uint32_t now_us;
static uint32_t byte_us;
static uint32_t read_clock(void *context)
{
    (void)context;
    return now_us;
}
static bool read_byte(void *context, uint32_t receiver, copter_byte_t *byte)
{
    (void)context;
    if ((left == 0u) || (receiver != COPTER_RC)) { return false; }
    *byte = (copter_byte_t){.value = *data++, .elapsed_us = *times++};
    left--;
    now_us += byte_us;
    return true;
}
int start(int protocol)
{
    memset(&copter, 0, sizeof copter);
    port = (copter_port_t){.read_byte = read_byte, .read_clock = read_clock};
    byte_us = 0u;
    copter.port = &port;
    copter_settings = copter_defaults;
    copter_settings.rc.protocol = (uint8_t)protocol;
    return (int)copter_pilot_init(&copter.pilot);
}
void hand(const uint8_t *bytes, const uint32_t *us, uint32_t count)
{
    data = bytes;
    times = us;
    left = count;
    while (left > 0u) { copter_background_radio(&copter.pilot, &copter); }
    copter_foreground_radio(&copter.pilot);
}
int run_of(const uint8_t *bytes, const uint32_t *us, uint32_t count, uint32_t cost_us)
{
    data = bytes;
    times = us;
    left = count;
    byte_us = cost_us;
    copter_background_radio(&copter.pilot, &copter);
    return (int)(count - left);
}
int heard(void) { return (int)copter.pilot.rc.frames; }
int protocol(void) { return copter.pilot.rc.protocol; }
int frames(void) { return (int)copter.pilot.frames; }
int channel(int i) { return copter.pilot.rc.channel[i]; }
double roll(void) { return copter.pilot.sticks.roll; }
void push(double roll) { copter.pilot.sticks.roll = (float)roll; }
double smooth(void) { copter_pilot_smooth(&copter.pilot); return copter.pilot.smooth.roll; }
double rate(void) { return copter.pilot.reference.setpoints.roll_rate; }
int asked(void) { return copter.pilot.asked; }
int last_mode(void) { return KEEL_MODE_NONE - 1; }
const char *words(void)
{
    return copter_rc_words((copter_heard_t)copter.pilot.ear.heard, copter.pilot.rc.protocol);
}
"""


PERIOD_US = 10_000  # Of background radio.
WIDTHS = (1500, 1500, 1000, 1500, 1000, 1500, 2000, 1500, 8500)  # A train of PPM, 20 ms long.


@dataclass
class Line:
    """What a receiver sends, in us and bytes, and how much of it was read."""

    sent: list[tuple[int, int]]
    read: int = 0

    @classmethod
    def of_frames(cls, protocol: int, data: bytes, every_us: int, until_us: int) -> Line:
        begins = range(0, until_us, every_us)
        return cls(
            [
                (begin + BYTE_US[protocol] * (at + 1), byte)
                for begin in begins
                for at, byte in enumerate(data)
            ]
        )

    @classmethod
    def of_edges(cls, until_us: int) -> Line:
        trains = until_us // sum(WIDTHS)
        return cls([(at, 0) for at in itertools.accumulate(WIDTHS * trains)])

    def waiting(self, now_us: int) -> tuple[bytes, list[int]]:
        """What has come and was not read, each with the time since the one before."""
        end = bisect.bisect_right(self.sent, (now_us, 255))
        at = [0, *(us for us, _ in self.sent)]
        return (
            bytes(byte for _, byte in self.sent[self.read : end]),
            [at[i + 1] - at[i] for i in range(self.read, end)],
        )


def corpus(name: str) -> bytes:
    """The first frame of a stream of tests/corpus/radio.toml."""
    streams = tomllib.loads((ROOT / "tests/corpus/radio.toml").read_text())["stream"]
    part = next(stream for stream in streams if stream["name"] == name)["part"][0]
    return bytes.fromhex(part["bytes"])


class CopterRadio(unittest.TestCase):
    """One receiver at a time."""

    copter: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.copter = copter_of(cls, SHIM)
        cls.copter.roll.restype = ctypes.c_double
        cls.copter.words.restype = ctypes.c_char_p

    def setUp(self) -> None:
        self.start(ANY)

    def start(self, protocol: int) -> None:
        self.assertEqual(self.copter.start(protocol), 0)

    def hand(self, data: bytes, times: list[int]) -> None:
        """A run of both tasks with these bytes."""
        count = len(data)
        self.copter.hand((ctypes.c_uint8 * count)(*data), (ctypes.c_uint32 * count)(*times), count)

    def frame(self, protocol: int, data: bytes) -> None:
        silence = EVERY_US[protocol] - (len(data) - 1) * BYTE_US[protocol]
        self.hand(data, [silence] + [BYTE_US[protocol]] * (len(data) - 1))

    def edges(self, widths: list[int]) -> None:
        """Of PPM: a byte is an edge."""
        self.hand(bytes(len(widths)), widths)

    def second(self) -> None:
        """Nothing comes for so long."""
        for _ in range(50):
            self.hand(b"", [])

    def words(self) -> str:
        return str(self.copter.words().decode())

    def found_after(self, protocol: int, data: bytes) -> int:
        for count in range(1, 100):
            self.frame(protocol, data)
            if self.copter.protocol() != ANY:
                return count
        return 0

    def test_each_protocol_is_found(self) -> None:
        for protocol, name, enough in (
            (SBUS, "frsky_knob_110", 20),
            (CRSF, "edgetx_2_11", 5),
            (IBUS, "fs_ia6b", 5),
        ):
            with self.subTest(name):
                self.start(ANY)
                self.assertEqual(self.found_after(protocol, corpus(name)), enough)
                self.assertEqual(self.copter.protocol(), protocol)
                self.assertEqual(self.copter.frames(), 1)
                self.assertAlmostEqual(self.copter.roll(), 0.0)

    def test_ppm_is_found(self) -> None:
        for _ in range(3 + 5):
            self.edges([1500, 1500, 1000, 1500, 1000, 1500, 2000, 1500, 8500])
        self.assertEqual(self.copter.protocol(), PPM)
        self.assertEqual(
            [self.copter.channel(at) for at in range(9)],
            [1500, 1500, 1000, 1500, 1000, 1500, 2000, 1500, 0],
        )

    def run_once(self, line: Line, now_us: int, cost_us: int) -> int:
        """A run of background radio alone, in which a byte costs so much; what it left."""
        data, times = line.waiting(now_us)
        count = len(data)
        took = self.copter.run_of(
            (ctypes.c_uint8 * count)(*data), (ctypes.c_uint32 * count)(*times), count, cost_us
        )
        line.read += took
        return count - took

    def listen(self, line: Line, listening_us: int, found_us: int) -> int:
        """Runs until all is read; when its protocol was found, or 0. A byte costs the first until
        then, and the second from then on."""
        found = 0
        for now_us in range(PERIOD_US, 100 * PERIOD_US, PERIOD_US):
            left = self.run_once(line, now_us, found_us if found else listening_us)
            if not found and self.copter.protocol() != ANY:
                found = now_us
            if line.read == len(line.sent):
                self.assertEqual(left, 0)
                return found
        return 0

    def test_a_run_ends_in_time_and_leaves_what_is_left(self) -> None:
        """At 7 us a byte the last of 25 begins after 168 us, and at 170 us one that is begun is
        the last, too."""
        for cost_us, count in ((7, 25), (17, 10), (10, 17), (200, 1), (1, 170)):
            with self.subTest(cost_us):
                self.start(SBUS)
                line = Line([(120 * i, 0x55) for i in range(1, 251)])
                self.assertEqual(self.run_once(line, 1_000_000, cost_us), 250 - count)

    def test_when_a_protocol_is_found_and_that_none_of_its_bytes_is_lost(self) -> None:
        """At the first run behind the frame that is enough, by hand: SBUS's 20th begins at 19
        periods and takes 3 ms. At 500 Hz CRSF's fifth has come with the first run, at 10 ms; the
        second gets to it, and what has come by then is read while the next come. Costs are those
        counted on the Cortex-M7 (docs/copter.md), rounded up: 2 us a byte, and 1."""
        for protocol, name, every_us, found_ms, enough in (
            (SBUS, "frsky_knob_110", 6000, 120, 20),
            (SBUS, "frsky_knob_110", 9000, 180, 20),
            (SBUS, "frsky_knob_110", 14000, 270, 20),
            (CRSF, "edgetx_2_11", 2000, 20, 5),
            (CRSF, "edgetx_2_11", 4000, 20, 5),
            (CRSF, "edgetx_2_11", 20000, 90, 5),
            (IBUS, "fs_ia6b", 7000, 40, 5),
        ):
            with self.subTest(name, every_us=every_us):
                self.start(ANY)
                line = Line.of_frames(protocol, corpus(name), every_us, 900_000)
                self.assertEqual(self.listen(line, 2, 1), found_ms * 1000)
                self.assertEqual(self.copter.protocol(), protocol)
                frames = len(line.sent) // len(corpus(name))
                self.assertEqual(self.copter.heard(), frames - (enough - 1))

    def test_a_stair_of_the_sticks_becomes_smooth(self) -> None:
        """A Butterworth low-pass of two poles answers a stair by a slope of at most w exp(-pi/4)
        sin(pi/4) sqrt(2), w = 2 pi 15 Hz, which is 42.98 a second; its way back is as smooth."""
        self.start(SBUS)
        self.copter.smooth.restype = self.copter.rate.restype = ctypes.c_double
        steepest = 42.98 * 0.002
        at = 0.0
        for stick, asked in ((1.0, 5.0), (0.0, 0.0)):
            self.copter.push(ctypes.c_double(stick))
            steps = []
            for _ in range(100):
                before, at = at, self.copter.smooth()
                self.assertLessEqual(abs(at), 1.0)
                steps.append(abs(at - before))
            self.assertLess(max(steps), 1.01 * steepest)
            self.assertGreater(max(steps), 0.95 * steepest)
            self.assertAlmostEqual(at, stick, 4)
            self.assertAlmostEqual(self.copter.rate(), asked, 2)
        self.assertEqual(self.copter.rate(), 0.0)

    def test_when_ppm_is_found(self) -> None:
        """The first train's beginning is unknown, three are asked for in a row, and five of that:
        the eighth's end, at 160 ms, is read by the run at that time."""
        line = Line.of_edges(900_000)
        self.assertEqual(self.listen(line, 2, 1), 160_000)
        self.assertEqual((self.copter.protocol(), self.copter.heard()), (PPM, 45 - 7))

    def test_a_frame_of_ibus_that_looks_like_sbus(self) -> None:
        """Channel 1 is 1551 us, 0x060F, and channels from 9 on are none: what begins at 0x0F ends
        with flags and footer of 0, in each frame before IBUS's own end."""
        words = [1551, 1500, 1000, 1500, 1000, 1000, 1000, 1000] + [0] * 6
        content = b"\x20\x40" + b"".join(word.to_bytes(2, "little") for word in words)
        data = content + (0xFFFF - sum(content)).to_bytes(2, "little")
        self.assertEqual((data[2], data[25] >> 4, data[26]), (0x0F, 0, 0))
        self.found_after(IBUS, data)
        self.assertEqual(self.copter.protocol(), IBUS)

    def test_the_one_that_is_set_alone(self) -> None:
        self.start(CRSF)
        for _ in range(50):
            self.frame(SBUS, corpus("frsky_100"))
        self.assertEqual((self.copter.protocol(), self.copter.frames()), (CRSF, 0))
        self.frame(CRSF, corpus("elrs_500_hz"))
        self.assertEqual(self.copter.frames(), 1)

    def test_the_first_frame_counts_when_it_is_set(self) -> None:
        self.start(SBUS)
        self.frame(SBUS, corpus("eight_channels"))
        self.assertEqual(self.copter.frames(), 1)

    def test_what_is_beyond_an_end_is_the_end(self) -> None:
        """The mode switch's channel at 150 %, and roll at 115 %."""
        self.start(IBUS)
        words = [2115, 1500, 1000, 1500, 1000, 2250] + [1500] * 8
        content = b"\x20\x40" + b"".join(word.to_bytes(2, "little") for word in words)
        self.frame(IBUS, content + (0xFFFF - sum(content)).to_bytes(2, "little"))
        self.assertEqual(self.copter.roll(), 1.0)
        self.assertEqual(self.copter.asked(), self.copter.last_mode())

    def test_why_nobody_is_heard(self) -> None:
        zeros, lost = b"\x0f" + bytes(24), bytearray(corpus("frsky_100"))
        lost[23] = 0x0C
        flags = bytearray(corpus("frsky_100"))
        flags[23] = 0x40
        for data, words in (
            (zeros, "refused: a stick is beyond its range"),
            (bytes(lost), "the receiver has lost the transmitter"),
            (bytes(flags), "refused: flags that SBUS has none of"),
            (b"\x55" * 25, "no frames: protocol, baud or inversion?"),
            (corpus("frsky_100"), "heard by SBUS"),
        ):
            with self.subTest(words):
                self.start(SBUS)
                self.assertEqual(self.words(), "listening")
                for _ in range(50):
                    self.frame(SBUS, data)
                self.assertEqual(self.words(), words)
                self.assertLessEqual(len(words), 43)
        self.second()
        self.assertEqual(self.words(), "nothing comes from the receiver")

    def test_crossfire_that_holds_channels_is_lost(self) -> None:
        """A quality of 0 says so."""
        self.start(CRSF)
        self.frame(CRSF, corpus("crossfire_nano"))
        self.assertEqual(self.copter.frames(), 1)
        streams = tomllib.loads((ROOT / "tests/corpus/radio.toml").read_text())["stream"]
        parts = next(one for one in streams if one["name"] == "crossfire_lost")["part"]
        for part in parts[1:]:
            self.frame(CRSF, bytes.fromhex(part["bytes"]))
        self.assertEqual(self.copter.frames(), 1)
