# SPDX-License-Identifier: Apache-2.0
"""The PPM decoder, handed edges, beside a search that looks at all times between them at once."""

from __future__ import annotations

import ctypes
import random
import shutil
import unittest
from itertools import groupby
from pathlib import Path
from typing import ClassVar

from shim import library_of

ROOT = Path(__file__).resolve().parents[2]

LOWEST, HIGHEST, SYNC, LOST = 800, 2200, 2300, 100_000
LEAST, IN_A_ROW = 4, 3
ALL, STICKS = 0xFFFF, 0x000F

# A decoder behind functions of whole numbers alone, so that nothing here knows how it is laid out.
SHIM = """\
#include "keel/middleware/ppm.h"
static keel_ppm_t ppm;
int begin(int judged)
{
    const keel_ppm_config_t config = {100000u, 800u, 2200u, 2300u, (uint16_t)judged, 4u, 3u};
    return (int)keel_ppm_init(&ppm, &config);
}
int take(unsigned us) { return keel_ppm_take(&ppm, us) ? 1 : 0; }
void pass_time(unsigned us) { keel_ppm_pass_time(&ppm, us); }
int lost(void) { return keel_ppm_is_lost(&ppm) ? 1 : 0; }
int channels(void) { return ppm.channels; }
int channel(int i) { return ppm.channel[i]; }
"""

Channels = tuple[int, ...]
Taken = dict[int, Channels]


def kind(width: int) -> str:
    if width < SYNC:
        return "pulse"
    return "gap" if width <= LOST else "silence"


def taken_of(widths: list[int], judged: int = ALL) -> Taken:
    """What is taken, by the edge that ends it. The first time, since ever, is a silence."""
    ends = [0] + [at for at, width in enumerate(widths) if at > 0 and kind(width) != "pulse"]
    # Each frame by its last edge: its channels, or none where it is no right one.
    frames: list[tuple[int, Channels]] = []
    for begin, end in zip(ends, ends[1:], strict=False):
        channels = tuple(widths[begin + 1 : end])
        right = (
            begin > 0
            and kind(widths[begin]) == "gap"
            and kind(widths[end]) == "gap"
            and LEAST <= len(channels) <= 16
            and all(
                LOWEST <= width <= HIGHEST
                for index, width in enumerate(channels)
                if judged >> index & 1
            )
        )
        frames.append((end, channels if right else ()))
    taken: Taken = {}
    for number, row in groupby(frames, lambda frame: len(frame[1])):
        if number > 0:
            taken.update(list(row)[IN_A_ROW - 1 :])
    return taken


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Edges(unittest.TestCase):
    """Each row of right frames, and nothing else."""

    library: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.library = library_of(cls, SHIM, ["src/middleware/ppm.c", "src/middleware/framing.c"])

    def setUp(self) -> None:
        self.random = random.Random(20261128)
        self.assertEqual(self.library.begin(ALL), 0)

    def says(self) -> Channels:
        return tuple(self.library.channel(at) for at in range(self.library.channels()))

    def feed(self, widths: list[int]) -> Taken:
        """What was taken; some of the time is told before the edge."""
        taken: Taken = {}
        for at, width in enumerate(widths):
            before = self.random.randrange(width) if self.random.random() < 0.3 else 0
            self.library.pass_time(before)
            last = self.says()
            if self.library.take(width - before):
                taken[at] = self.says()
            else:
                self.assertEqual(self.says(), last)
        return taken

    def any_frame(self, number: int) -> list[int]:
        return [8000, *(self.random.randint(LOWEST, HIGHEST) for _ in range(number))]

    def disturbed(self, widths: list[int]) -> list[int]:
        """An edge lost, added, moved or late, or a silence."""
        at, widths = self.random.randrange(len(widths)), list(widths)
        match self.random.randrange(5):
            case 0 if at > 0:
                widths[at - 1 : at + 1] = [widths[at - 1] + widths[at]]
            case 1:
                early = self.random.randrange(1, widths[at])
                widths[at : at + 1] = [early, widths[at] - early]
            case 2:
                widths[at] = self.random.choice((799, 800, 2200, 2201, 2299, 2300))
            case 3:
                widths[at] = self.random.choice((99_999, 100_000, 100_001, 2**32 - 1))
            case _:
                widths[at] = max(1, widths[at] + self.random.randint(-2000, 2000))
        return widths

    def test_a_known_stream(self) -> None:
        frame = [8000, 1000, 1500, 2000, 1200, 1800, 1500, 1100, 1900]
        self.assertEqual(
            self.feed([5, *frame * 4, 8000]), {28: tuple(frame[1:]), 37: tuple(frame[1:])}
        )

    def test_streams(self) -> None:
        seen = 0
        for _ in range(1500):
            self.assertEqual(self.library.begin(ALL), 0)
            widths = [1]
            number = self.random.randint(2, 18)
            for _ in range(self.random.randrange(4, 14)):
                number = number if self.random.random() < 0.9 else self.random.randint(2, 18)
                frame = self.any_frame(number)
                widths += frame if self.random.random() < 0.8 else self.disturbed(frame)
            widths.append(8000)
            expected = taken_of(widths)
            self.assertEqual(self.feed(widths), expected)
            seen += len(expected)
        self.assertGreater(seen, 1000)

    def test_any_times(self) -> None:
        edges = (
            1,
            799,
            800,
            801,
            1500,
            1500,
            2199,
            2200,
            2201,
            2299,
            2300,
            2301,
            8000,
            8000,
            100_000,
            100_001,
        )
        for _ in range(1000):
            judged = self.random.choice((ALL, STICKS, 0x8421))
            self.assertEqual(self.library.begin(judged), 0)
            widths = self.random.choices(edges, k=self.random.randrange(2, 120))
            self.assertEqual(self.feed(widths), taken_of(widths, judged))

    def test_the_radio_is_lost_and_comes_back(self) -> None:
        self.assertEqual(self.library.lost(), 1)
        frame = self.any_frame(8)
        self.assertNotEqual(self.feed([1, *frame * 4]), {})
        self.assertEqual(self.library.lost(), 0)
        self.library.pass_time(LOST)
        self.assertEqual(self.library.lost(), 1)
        self.assertEqual(self.says(), tuple(frame[1:]))
        self.assertEqual(list(self.feed([*frame * 4, 8000])), [36])
        self.assertEqual(self.library.lost(), 0)
