# SPDX-License-Identifier: Apache-2.0
"""The image that records on a card, on the model of its chip: what is on the card when the power
goes, by another's file system and another's reader of logs."""

from __future__ import annotations

import contextlib
import io
import re
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pyulog import ULog
from test_black_box import MIB, OTHERS, files_of, new_card, pyfatfs

from keel.base.errors import ROOT
from keel.boards import firmware, stack
from keel.boards.rebuilt import SOURCES
from keel.emulator import chip_model
from keel.emulator.card import SdCard
from keel.emulator.chip import Chip
from keel.emulator.wiring import WIRINGS
from keel.install import Toolchain

__all__ = ["pyfatfs"]  # A fixture.
APPLICATION = ["examples/recorder"]
STEP_US = 4
SIZE = 80 * MIB  # For a file of 64.


@pytest.fixture(scope="module")
def boards() -> Iterator[tuple[Toolchain, Path]]:
    """The images of both boards, in a copy: they do not replace the user's."""
    tools = Toolchain()
    tools.ensure("firmware", "fatfs", "model")
    with tempfile.TemporaryDirectory(prefix="keel-test-") as name:
        root = Path(name)
        for part in (*SOURCES, "specs"):
            shutil.copytree(ROOT / part, root / part)
        for board in WIRINGS:
            with contextlib.redirect_stdout(io.StringIO()):
                firmware.build(tools, board, APPLICATION, root, fatfs=True)
        yield tools, root


@pytest.fixture(scope="module")
def content(pyfatfs: tuple[Any, Any]) -> bytes:
    """A card with others' files, as the recorder finds it."""
    return new_card(pyfatfs, "FAT32", SIZE)


def run(
    boards: tuple[Toolchain, Path],
    seconds: float,
    card: SdCard | None = None,
    keys: list[tuple[int, str]] | None = None,
    board: str = "fmuv5",
) -> Chip:
    """The power is cut at the end."""
    return chip_model.simulate(*boards, board, seconds, keys or [], "", STEP_US, card=card)


def log_of(pyfatfs: tuple[Any, Any], card: SdCard) -> tuple[ULog, Any]:
    """The log, with the topic's data; what others had there is as it was."""
    files = files_of(pyfatfs, bytes(card.image))
    assert {name: files[name] for name in OTHERS} == OTHERS
    (name,) = set(files) - set(OTHERS)
    assert name == "/LOG00005.ULG"  # Behind that of another flight.
    log = ULog(io.BytesIO(files[name]))
    assert not log.file_corruption
    (topic,) = log.data_list
    assert topic.name == "sensor_imu"
    return log, topic.data


def samples_are_right(data: Any) -> None:
    """The model's sensor: 1 g and in every second sample a step more, a steady rate, and a number
    that counts, of seven bits; a sample every millisecond, in its order, none twice."""
    assert set(data["acceleration[2]"]) == {2048, 2064}
    assert set(np.abs(np.diff(data["acceleration[2]"]))) == {16}
    assert set(data["acceleration[0]"]) == set(data["acceleration[1]"]) == {0}
    assert set(data["rate[1]"]) == {0}
    assert set(data["rate[2]"]) == {1}
    assert set(np.diff(data["rate[0]"]) % 128) == {1}
    assert np.all(np.abs(np.diff(data["timestamp"].astype(np.int64)) - 1000) < 300)


def second_lines(text: str) -> list[tuple[int, ...]]:
    """Samples, failed, lost, state, kept, taken, busy and errors, a line each second."""
    words = r"samples (\d+) failed (\d+) lost (\d+) box (\d) kept (\d+) of (\d+) busy (\d+) errors"
    return [tuple(map(int, found)) for found in re.findall(words + r" (\d+)", text)]


def test_the_power_goes_and_all_but_the_last_second_is_there(
    boards: tuple[Toolchain, Path], pyfatfs: tuple[Any, Any], content: bytes
) -> None:
    card = SdCard(bytearray(content))
    chip = run(boards, 2.6, card)
    assert "Keel on fmuv5: recorder\r\nsensor status 0\r\ncard status 0 file 5\r\n" in chip.text
    log, data = log_of(pyfatfs, card)
    assert not log.dropouts
    samples_are_right(data)
    assert data["timestamp"][0] < 3000
    last = second_lines(chip.text)[-1]
    assert last[1:4] == (0, 0, 1)
    assert last[7] == 0
    assert last[6] > 0  # The card was busy behind writes.
    # What the console told as kept is there, and of the whole run all but a second.
    assert len(data["timestamp"]) * 27 > last[4] - 600
    assert data["timestamp"][-1] > last[0] * 1000 - 1_000_000
    # 400 kHz on one line until the card is known, 16 MHz on four lines then.
    assert chip.slot.rates == {(400_000, False), (16_000_000, True)}
    assert chip.resets == 0


def test_a_recording_that_is_ended_has_all(
    boards: tuple[Toolchain, Path], pyfatfs: tuple[Any, Any], content: bytes
) -> None:
    card = SdCard(bytearray(content))
    chip = run(boards, 2.6, card, [(2_000_000, "q")])
    found = re.search(r"closed, status 0, bytes (\d+)\r\n", chip.text)
    assert found
    files = files_of(pyfatfs, bytes(card.image))
    assert len(files["/LOG00005.ULG"]) == int(found[1])
    _, data = log_of(pyfatfs, card)
    samples_are_right(data)
    # The sensor's number counts from its first sample, which is in the log.
    assert len(data["timestamp"]) == chip.sensor.samples


def test_what_the_card_cannot_take_is_told_in_the_log(
    boards: tuple[Toolchain, Path], pyfatfs: tuple[Any, Any], content: bytes
) -> None:
    class Slow(SdCard):
        """Busy for long behind one write, of the data."""

        def receive(self, block: bytes) -> None:
            self.busy_looks = 300 if self.written == 2100 else 0
            super().receive(block)

    card = Slow(bytearray(content))
    chip = run(boards, 4.0, card)
    lost = second_lines(chip.text)[-1][2]
    assert lost > 100
    log, data = log_of(pyfatfs, card)
    samples = set(range(int(data["timestamp"][0] // 1000), int(data["timestamp"][-1] // 1000)))
    missing = samples - set((data["timestamp"] // 1000).tolist())
    assert abs(len(missing) - lost) <= 3
    (dropout,) = log.dropouts
    assert abs(dropout.duration - lost) <= 3


def test_a_card_that_is_pulled_out_costs_the_log_alone(
    boards: tuple[Toolchain, Path], content: bytes
) -> None:
    class Pulled(SdCard):
        """Not there any more behind so many sectors."""

        def receive(self, block: bytes) -> None:
            super().receive(block)
            self.there = self.written < 2120

    chip = run(boards, 3.0, Pulled(bytearray(content)))
    first, second = second_lines(chip.text)[:2]
    assert first[3] in (1, 2)
    assert second[3] == 2  # Failed,
    assert second[7] == 4  # behind the write and its three repetitions.
    assert second[0] >= first[0] + 990


def test_without_a_card_or_a_slot(boards: tuple[Toolchain, Path]) -> None:
    chip = run(boards, 1.5)
    assert "card status 1 file 0" in chip.text
    assert second_lines(chip.text)[0][0] >= 1000
    chip = run(boards, 0.2, board="nucleo_f767zi")
    assert "this board has no slot for a card" in chip.text


def test_its_stacks_have_room(boards: tuple[Toolchain, Path]) -> None:
    boards[0].ensure("stack")
    stacks = stack.measure(*boards, "fmuv5")["stacks"]
    assert isinstance(stacks, dict)
    for bound in stacks.values():
        assert 0 < bound["bound"] < bound["size"]


def test_a_card_without_a_file_system(boards: tuple[Toolchain, Path]) -> None:
    chip = run(boards, 0.3, SdCard(bytearray(MIB)))
    assert "card status 2 file 0" in chip.text
