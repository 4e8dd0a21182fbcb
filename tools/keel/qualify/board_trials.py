# SPDX-License-Identifier: Apache-2.0
"""Short runs of a board's image on the model of its chip, each with what must come of it.

Tests run the right code through them, and qualify code with mistakes: of each, one of them must
complain, by an AssertionError, or the model itself. Where Python has assertions switched off, no
mistake is noticed, and qualify fails.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from keel.base.errors import ROOT
from keel.boards.board import application_of
from keel.boards.firmware import Builder
from keel.boards.sockets import read_sockets
from keel.emulator.bmi055 import Bmi055Part
from keel.emulator.chip import Chip
from keel.emulator.dma_uart import PLAIN, SBUS, Bits
from keel.emulator.icm20689 import Icm20689
from keel.emulator.motion import Motion
from keel.emulator.processor import Processor
from keel.emulator.pulses import FLOATS, LOW, Pulse, State
from keel.emulator.wiring import WIRINGS
from keel.flight import device_frames
from keel.install import Toolchain

PROGRAMS = "tests/target/programs"
ON_BOARD = "examples/copter_on_board"


class Trial(NamedTuple):
    """A run."""

    chip: Callable[[str], Chip]  # A board's, with all that will happen to it.
    until_us: int
    check: Callable[[str, Chip], None]
    parts: tuple[str, ...] = ()  # Of the image, besides the board's own; none: the copter's image.

    def objects(self, builder: Builder) -> list[Path]:
        """What the image is linked of, besides the board's own objects."""
        parts = self.parts or application_of(builder.board, "copter").application
        return [*builder.objects(parts), *builder.fatfs()]

    def run(self, tools: Toolchain, builder: Builder, name: str = "keel") -> None:
        """Build the image, run it, and look at what came of it."""
        board = builder.board
        image = builder.link(name, self.objects(builder))
        chip = self.chip(board.name)
        binary = image.binary.read_bytes()
        Processor(tools, binary, board.load_address, chip).run(self.until_us)
        self.check(board.name, chip)


def chip_of(board: str, step_us: int, watched: list[str]) -> Chip:
    """A board's chip, of which some pins are watched."""
    chip = Chip(WIRINGS[board], "", watched)
    chip.step_us = step_us
    return chip


# --- What comes out of which socket. ---


def watched(board: str) -> Chip:
    return chip_of(board, 1, read_sockets(ROOT)[board].watched)


def check_outputs(board: str, chip: Chip) -> None:
    """What each output did up to the reset, 36.4 ms after the start, and past it."""
    count = 4 if board == "nucleo_f767zi" else 8
    assert len(read_sockets(ROOT)[board].outputs) == count
    for number, log in enumerate(chip.outputs.log[:count]):
        pulses = [Pulse(1000 + 100 * number, 2500), LOW, Pulse(1500, 2500), LOW]
        expected = [FLOATS, LOW, *pulses, FLOATS, LOW]
        assert [state for _, state in log][: len(expected)] == expected, number
        assert log[1][0] == 0, "low from the reset on"
        assert log[6][0] - log[5][0] >= 6000, "the hold before a reset"
    for log in chip.outputs.log[count:]:  # Low from arming until the outputs are off.
        states = [state for _, state in log]
        assert states[:5] == [FLOATS, LOW, FLOATS, LOW, FLOATS]
        first = chip.outputs.log[0]
        assert log[1][0] <= first[2][0]
        assert [log[2][0], log[4][0]] == [first[3][0], first[5][0]]


# --- Pulses and axes by the copter's port. ---

UNITS_OF = {"fmuv5": 2, "cuav_v5": 3, "nucleo_f767zi": 1}


def socketed(board: str) -> Chip:
    return chip_of(board, 2, read_sockets(ROOT)[board].outputs)


def check_port(board: str, chip: Chip) -> None:
    """A unit says 1 g along its third axis, 1 count of rate there, and how often it was read about
    its first: all boards have it upside down, so that a board at rest feels -9.807 m/s^2
    downwards, and a count of 1 / 16.4 degrees a second is 1.064 mrad/s."""
    about = 3 if board == "nucleo_f767zi" else 4  # An FMUv5 has the units' x to the right.
    units = re.findall(r"^body (.*)\r$", chip.text, re.MULTILINE)
    assert len(units) == UNITS_OF[board], chip.text
    samples = [chip.sensor.samples, chip.gyroscope.samples, chip.third.samples]
    for unit, read in zip(units, samples, strict=False):
        words = unit.split()
        assert words[:3] == ["0", "0", "-9807"]
        assert words[5] == "-1"
        assert read == 1
        assert (words[about], words[7 - about]) == ("1", "0")
    assert chip.accelerometer.samples == chip.gyroscope.samples
    for number, log in enumerate(chip.outputs.log):
        pulses: list[State] = (
            [Pulse(1000 + 50 * (0, 1, 5, 10, 20)[number + 1], 2500), Pulse(1050, 2500), LOW]
            if number < 4
            else []
        )
        if number == 0:
            del pulses[1]  # The same pulse goes on.
        assert [state for _, state in log] == [FLOATS, LOW, *pulses], number


# --- The lines of the copter's image. ---

STEP_US = 4
FRAME_MS, FIX_MS = 14, 100
PLACE, HEIGHT_M = (47.3977, 8.5456), 500.0
FIELD = (284, 7, 570)  # There: 21.5 uT along the magnetometer's x, and 43.2 downwards.
LINES_MS = 1400  # The first report comes after a second.


def resting(board: str = "fmuv5") -> Chip:
    """A board on a desk, with two power modules and sensors that have noise."""
    chip = chip_of(board, STEP_US, read_sockets(ROOT)[board].outputs)
    units: list[Icm20689 | Bmi055Part] = [chip.sensor, chip.gyroscope, chip.accelerometer]
    for seed, unit in enumerate(units):
        unit.motion = Motion(noise=2, seed=seed)
    chip.barometer.noise = 300
    chip.magnetometer.counts = FIELD
    chip.counts[2], chip.counts[3] = chip.counts[0], chip.counts[1]
    return chip


def send_radio(
    chip: Chip,
    line: str,
    until_ms: int,
    switched: dict[int, int],
    frame: Callable[[list[int]], bytes] = device_frames.sbus,
    bits: Bits = SBUS,
) -> None:
    """Frames of the pilot's receiver: sticks at rest, throttle low, and switches that are on from a
    time on, in ms."""
    for now_ms in range(100, until_ms, FRAME_MS):
        channels = [1500, 1500, 1000, 1500, 1000, 1500, 1000, 1500]
        for channel, on_ms in switched.items():
            channels[channel] = 2000 if now_ms >= on_ms else 1000
        chip.lines[line].send(1000 * now_ms, frame(channels), bits)


def reports(chip: Chip) -> list[dict[str, int]]:
    """The lines of each second."""
    lines = re.findall(r"^t (\d+) s (.*)\r$", chip.text, re.MULTILINE)
    return [
        {key: int(value) for key, value in re.findall(r"(\w+) (\d+)", text)} for _, text in lines
    ]


def spoken_to(board: str) -> Chip:
    """Frames of the pilot at the second socket, and fixes."""
    chip = resting(board)
    send_radio(chip, "spare", LINES_MS, {})
    for now_ms in range(100, LINES_MS, FIX_MS):
        fix = device_frames.nav_pvt(now_ms, PLACE, HEIGHT_M, (0.0, 0.0, 0.0), 1.0, 0.1)
        chip.lines["satellites"].send(1000 * now_ms, fix, PLAIN)
    return chip


def check_lines(board: str, chip: Chip) -> None:
    """The pilot is heard, fixes and samples of the field come, and whole frames are sent."""
    assert chip.resets == 0
    (report,) = reports(chip)
    assert report["radio"] == 1
    assert report["fixes"] >= 5
    assert report["fields"] >= 40
    told, frames = bytes(chip.lines["telemetry"].sent), 0
    while len(told) > 300:  # The last frames may not be whole.
        assert told[0] == 0xFD
        told, frames = told[12 + told[1] :], frames + 1
    assert frames > 5


# --- Restarts of the copter's image. ---

MISHAP_US = 1_700_000  # On the ground, behind the first second of its run.
RESTART = "disarmed by a restart: "


def unlucky(board: str) -> Chip:
    """A bite of the watchdog restarts it; a fault within the second behind that leaves it safe.
    Then somebody resets it."""
    chip = resting(board)
    later = ((0, "watchdog"), (900_000, "fault"), (1_100_000, "pin"))
    chip.mishaps = [(MISHAP_US + us, mishap) for us, mishap in later]
    return chip


def check_restart(board: str, chip: Chip) -> None:
    """The restart is told once, on the console and by telemetry."""
    assert "start by: watchdog\r\nfault 1 " in chip.text
    assert "safe state: fault 2 exception 6" in chip.text
    assert chip.text.partition("safe state")[2].count("start by: reset pin\r\n") == 1
    assert (chip.resets, len(chip.begun_us)) == (4, 2)
    sent = bytes(chip.lines["telemetry"].sent)
    assert sent.count(RESTART.encode()) == sent.count(f"{RESTART}watchdog".encode()) == 1


# --- What a person beside the board presses, sees and hears. ---

# Before it is used; too short; long; while motors turn; long again; and once more, before its end.
PRESSES = (
    (100_000, 400_000),
    (1_000_000, 1_900_000),
    (2_000_000, 3_500_000),
    (5_100_000, 6_400_000),
    (7_000_000, 8_200_000),
    (8_300_000, 9_400_000),
)
PANEL = ["PE12", "PE5 TIM9_CH1"]
LIGHT, BUZZER = range(2)


def pressed(board: str) -> Chip:
    chip = chip_of(board, 500, PANEL)
    chip.presses = [*PRESSES]
    return chip


def check_panel(board: str, chip: Chip) -> None:
    check_switch(chip)
    check_light(chip)
    check_buzzer(chip)
    assert chip.resets == 0


def check_switch(chip: Chip) -> None:
    """A second of holding makes it ready or safe, behind 20 ms in which the press settles. At its
    end it is safe at once, for it is not used any more."""
    told = [(word, int(ms)) for word, ms in re.findall(r"(?m)^(ready|safe) (\d+)\r$", chip.text)]
    assert [word for word, _ in told] == ["ready", "safe", "ready", "safe"]
    for (_, ms), expected in zip(told, (3020, 8020, 9320, 9500), strict=True):
        assert abs(ms - expected) <= 8, told  # A turn takes some milliseconds here.


# It blinks by halves of a second from 0.5 s on, and shines from 3.02 s on, when it becomes ready,
# at the beginning of a dark half. That ends within a dark half, too, as does the last hold.
LIGHT_S = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.02, 8.02, 8.5, 9.0, 9.32, 9.5)


def check_light(chip: Chip) -> None:
    """Lit by a low level; dark before and after."""
    log = chip.outputs.log[LIGHT]
    assert [state for _, state in log] == [FLOATS, "high", *["low", "high"] * 6]
    for (time_us, _), expected_s in zip(log[2:], LIGHT_S, strict=True):
        assert abs(time_us / 1e6 - expected_s) < 0.02, log


# When each begins, its frequency, and for how long it sounds; silence between them is what is left.
TONES_S = (
    *((0.0, 880, 0.12), (0.12, 1109, 0.12), (0.24, 1319, 0.24)),  # The start.
    *((1.0, 440, 0.2), (1.25, 330, 0.4)),  # Refused.
    *((2.0, 1760, 0.1), (2.2, 1760, 0.1)),  # The radio is lost,
    *((3.0, 2637, 0.4), (3.8, 2637, 0.4)),  # the battery is low,
    *((4.6, 1760, 0.1), (4.8, 1760, 0.1)),  # and the radio still lost.
    *((6.6, 1760, 0.1), (6.8, 1760, 0.1)),  # Again, until it is silenced,
    *((8.0, 1760, 0.1), (8.2, 1760, 0.1)),  # and once more.
)


def check_buzzer(chip: Chip) -> None:
    """Each tone, half of its period high, from when it is due and for as long as it is to last."""
    log = chip.outputs.log[BUZZER]
    assert log[0] == (0, FLOATS)
    tones = []
    for (begin_us, state), (end_us, after) in pairwise(log):
        if isinstance(state, Pulse):
            tones.append((begin_us / 1e6, state, (end_us - begin_us) / 1e6))
        else:
            assert state in (FLOATS, LOW)
            assert isinstance(after, Pulse) or state == FLOATS
    assert log[-1][1] == LOW
    assert len(tones) == len(TONES_S), tones
    for (begin_s, pulse, s), (due_s, hz, long_s) in zip(tones, TONES_S, strict=True):
        assert abs(begin_s - due_s) < 0.06, tones
        assert abs(s - long_s) < 0.02, tones
        assert abs(1e6 / pulse.period_us - hz) <= 0.002 * hz
        assert abs(pulse.us / pulse.period_us - 0.5) < 0.002


# --- A receiver of PPM: from edges at the pin to channels. ---

CHANNELS = (1000, 1234, 1500, 1777, 2000, 1100, 2150, 805)
FRAMES, FRAME_US = 18, 22_500


def edged(board: str) -> Chip:
    """Frames from 20 ms on, between the sixth and the seventh a pause of a wrap of the timer, and
    in each a disturbance of 2 us."""
    chip = chip_of(board, 40, [])
    for number in range(FRAMES):
        at_us = 20_000 + FRAME_US * number + (65_536 if number > 5 else 0)
        chip.ppm.send(at_us, CHANNELS)
        chip.ppm.spike(at_us + 500, 2.0)
    return chip


def check_ppm(board: str, chip: Chip) -> None:
    """The decoder wants two right frames in a row, and a gap before: so none of the first, nor of
    the two around the pause, which is no gap of PPM that it believes."""
    assert "ppm status 0\r\n" in chip.text
    found = re.findall(r"(?m)^channels ([ \d]+)\r$", chip.text)
    assert FRAMES - 5 <= len(found) <= FRAMES - 2, chip.text
    for line in found:
        channels = [int(word) for word in line.split()]
        assert len(channels) == len(CHANNELS)
        assert all(abs(a - b) <= 1 for a, b in zip(channels, CHANNELS, strict=True)), channels
    assert chip.ppm.moved == FRAMES * (len(CHANNELS) + 1)
    assert chip.resets == 0


TRIALS = {
    "outputs": Trial(watched, 65_000, check_outputs, (f"{PROGRAMS}/outputs.c",)),
    "port": Trial(
        socketed,
        700_000,
        check_port,
        (
            f"{PROGRAMS}/port.c",
            *(f"{ON_BOARD}/board_{name}.c" for name in ("port", "lines", "panel")),
        ),
    ),
    "lines": Trial(spoken_to, 1000 * LINES_MS, check_lines),
    "restart": Trial(unlucky, 3_000_000, check_restart),
    "panel": Trial(
        pressed, 10_000_000, check_panel, (f"{PROGRAMS}/panel.c", f"{ON_BOARD}/board_panel.c")
    ),
    "ppm": Trial(edged, 600_000, check_ppm, (f"{PROGRAMS}/ppm.c",)),
}
