# SPDX-License-Identifier: Apache-2.0
"""The copter's image of the real boards, on the model of their chip: what it says is there and what
not, and its log on a card."""

from __future__ import annotations

import contextlib
import io
import json
from pathlib import Path
from typing import Any

import pytest
import shared_builds
from pyulog import ULog
from test_black_box import MIB, OTHERS, files_of, new_card, pyfatfs

from keel.base.errors import ROOT
from keel.boards import firmware, stack
from keel.boards.board import application_of, read_board
from keel.emulator import chip_model
from keel.emulator.card import SdCard
from keel.emulator.chip import Chip
from keel.install import Toolchain
from keel.qualify.board_trials import STEP_US, reports

__all__ = ["pyfatfs"]  # A fixture.
BOARDS = ("fmuv5", "cuav_v5", "nucleo_f767zi")


@pytest.fixture(scope="module")
def tools() -> Toolchain:
    tools = Toolchain()
    tools.ensure("firmware", "fatfs", "model", "stack")
    return tools


@pytest.fixture(scope="module")
def images(tools: Toolchain) -> Path:
    return shared_builds.images(tools, BOARDS)


def run(
    tools: Toolchain,
    root: Path,
    board: str,
    seconds: float,
    broken: str = "",
    card: SdCard | None = None,
) -> Chip:
    chip = chip_model.simulate(tools, root, board, seconds, [], broken, STEP_US, card=card)
    assert chip.resets == 0, chip.text
    return chip


@pytest.mark.parametrize("board", BOARDS)
def test_two_folders_give_the_same_bits(
    tools: Toolchain, images: Path, tmp_path: Path, board: str
) -> None:
    again = shared_builds.copy_sources(tmp_path / "another/and/deeper", images)
    with contextlib.redirect_stdout(io.StringIO()):
        assert firmware.main([board, "--named", "copter"], again) == 0
    for file in ("keel.elf", "keel.bin", "report.json"):
        place = f"build/firmware/{board}/{file}"
        assert (images / place).read_bytes() == (again / place).read_bytes(), file


@pytest.mark.parametrize("board", BOARDS)
def test_every_stack_has_room_and_itcm_no_dead_code(
    tools: Toolchain, images: Path, board: str
) -> None:
    """What calls nobody, or what nobody calls, is an error of stack.measure."""
    stacks = stack.measure(tools, images, board)["stacks"]
    assert isinstance(stacks, dict)
    assert all(one["bound"] <= one["size"] for one in stacks.values())
    report = json.loads((images / f"build/firmware/{board}/report.json").read_text())
    assert report["regions"]["ITCM"]["used"] <= 16384 - 256
    placed = {
        check["what"].rpartition(": ")[2]: check["region"]
        for check in report["checks"]
        if not check["what"].startswith("load of")
    }
    for name in (
        "keel_scheduler_step",
        "keel_voter_step",
        "keel_attitude_step",
        "keel_mixer_step",
        "keel_pid_step",
    ):
        assert placed[name] == "ITCM"
    for name in ("keel_invensense_read", "keel_bmi055_read", "keel_chip_motion"):
        places = [check for check in report["checks"] if name in check["what"]]
        assert places, name
        assert places[0]["region"] == "ITCM"


def test_what_is_there_runs_and_what_is_missing_is_named(tools: Toolchain, images: Path) -> None:
    chip = run(tools, images, "fmuv5", 2.6)
    for line in (
        "Keel on fmuv5: copter",
        "imu 1 status 0",
        "imu 2 status 0",
        "imu 3 missing: the board has none",
        "barometer status 0",
        "magnetometer status 0",
        "parameters status 0",
        "card status 1",
        "receiver of the pilot status 0",
        "receiver of satellites status 0",
        "telemetry status 0",
        "safety switch status 0",
        "buzzer status 0",
    ):
        assert f"{line}\r\n" in chip.text
    first, second = reports(chip)
    # A thousand samples a second, and fifty pressures: those of the data sheet's example.
    assert second["imu1"] - first["imu1"] == 1000
    assert second["imu2"] - first["imu2"] == 1000
    assert second["barometer"] - first["barometer"] == 50
    assert abs(second["pa"] - 100009) <= 1
    for key in ("state", "skipped", "overruns", "failed1", "failed2"):
        assert second[key] == 0, key
    assert [state for log in chip.outputs.log for _, state in log] == ["floats", "low"] * 8


@pytest.mark.parametrize(
    ("broken", "line"),
    [
        ("sensor", "imu 1 status 5"),
        ("other-sensor", "imu 1 status 6"),
        ("second-sensor", "imu 2 status 5"),
        ("barometer", "barometer status 5"),
        ("magnetometer", "magnetometer status 3"),
        ("memory", "parameters status 5"),
    ],
)
def test_what_is_broken_is_named_and_the_rest_runs(
    tools: Toolchain, images: Path, broken: str, line: str
) -> None:
    chip = run(tools, images, "fmuv5", 1.6, broken)
    assert f"{line}\r\n" in chip.text
    # A ground station reads of it as well; frames of texts end with their zeros cut off.
    name = line.partition(" status ")[0]
    assert f"{name}: fails".encode() in bytes(chip.lines["telemetry"].sent)
    assert b"card: fails" in bytes(chip.lines["telemetry"].sent)
    (report,) = reports(chip)
    assert (report["skipped"], report["overruns"], report["state"]) == (0, 0, 0)
    assert (report["imu1"] == 0) == (broken in ("sensor", "other-sensor"))
    assert (report["imu2"] == 0) == (broken == "second-sensor")
    assert (report["barometer"] == 0) == (broken == "barometer")
    assert (report["fields"] == 0) == (broken == "magnetometer")


@pytest.mark.parametrize(("broken", "status"), [("", 0), ("third-sensor", 5)])
def test_a_third_unit_is_read(tools: Toolchain, images: Path, broken: str, status: int) -> None:
    """As well as the others; and when it is missing, it is named."""
    chip = run(tools, images, "cuav_v5", 1.8, broken)
    for number, told in (1, 0), (2, 0), (3, status):
        assert f"imu {number} status {told}\r\n" in chip.text
    (report,) = reports(chip)
    assert (report["skipped"], report["overruns"]) == (0, 0)
    assert [report[f"failed{i}"] for i in (1, 2, 3)] == [0, 0, 0]
    assert report["imu3"] == (0 if broken else report["imu1"])
    assert report["imu1"] > 800


def test_a_board_with_less_says_so(tools: Toolchain, images: Path) -> None:
    chip = run(tools, images, "nucleo_f767zi", 1.4)
    for line in (
        "imu 2 missing: the board has none",
        "barometer missing: the board has none",
        "magnetometer missing: the board has none",
        "receiver of the pilot missing: the board has no such line",
        "parameters missing: not kept in flash",
        "card missing: the board has no slot",
        "safety switch missing: the board has none",
        "buzzer missing: the board has none",
    ):
        assert f"{line}\r\n" in chip.text
    (report,) = reports(chip)
    assert report["imu1"] >= 1000


def test_the_log_is_on_the_card(tools: Toolchain, images: Path, pyfatfs: tuple[Any, Any]) -> None:
    """By another's file system and another's reader, though the power goes without a word."""
    card = SdCard(bytearray(new_card(pyfatfs, "FAT32", 150 * MIB)))
    chip = run(tools, images, "fmuv5", 4.0, card=card)
    assert "card status 0\r\n" in chip.text
    assert all(report["skipped"] == 0 for report in reports(chip))
    files = files_of(pyfatfs, bytes(card.image))
    assert {name: files[name] for name in OTHERS} == OTHERS
    (name,) = set(files) - set(OTHERS)
    log = ULog(io.BytesIO(files[name]))
    assert not log.file_corruption
    assert log.msg_info_dict["sys_name"] == "Keel"
    topics = {topic.name: topic.data for topic in log.data_list}
    assert {"air", "attitude", "energy"} <= set(topics)
    last_us = max(int(data["timestamp"][-1]) for data in topics.values())
    assert last_us > 2_000_000


VARIANT = "bsp/fmuv5/variant.c"


@pytest.mark.parametrize("mounting", ["2, 1, 3)", "1, 1, 3)", "1, 2, 4)", "0, 2, 3)"])
def test_a_mounting_that_is_no_rotation_does_not_compile(
    tools: Toolchain, tmp_path: Path, mounting: str
) -> None:
    root = shared_builds.copy_sources(tmp_path)
    file = root / VARIANT
    text = file.read_text()
    builder = firmware.Builder(tools, read_board(root, "fmuv5"), root / "build", root)
    builder.object(VARIANT)
    builder.build.made.clear()
    file.write_text(text.replace("F, 2u, 2, 1, -3)", f"F, 2u, {mounting}"))
    with pytest.raises(firmware.ToolError, match="negative"):
        builder.object(VARIANT)


def test_an_unknown_name() -> None:
    with pytest.raises(firmware.ToolError, match="there is no application kopter"):
        application_of(read_board(ROOT, "fmuv5"), "kopter")
