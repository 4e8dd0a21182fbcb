# SPDX-License-Identifier: Apache-2.0
"""The lines of an FMUv5's image on the model of its chip: what radios, satellite receivers and
ground stations send and hear there, from power-on to turning motors."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import shared_builds
from test_copter_image import tools

from keel.boards.built import read_built
from keel.boards.packages import load
from keel.emulator.chip import Chip
from keel.emulator.dma_uart import CRSF, PLAIN, Bits
from keel.emulator.processor import Processor
from keel.emulator.pulses import LOW, Pulse
from keel.flight import device_frames
from keel.install import Toolchain
from keel.qualify.board_trials import FIX_MS, HEIGHT_M, PLACE, reports, resting, send_radio

__all__ = ["tools"]  # A fixture.

ARM, KILL = 4, 6  # Channels.


@pytest.fixture(scope="module")
def images(tools: Toolchain) -> Path:
    return shared_builds.images(tools, ("fmuv5",))


def run_built(tools: Toolchain, root: Path, chip: Chip, until_ms: int) -> None:
    """The whole image, on a chip."""
    image = read_built(root, "fmuv5")
    Processor(tools, image.binary.read_bytes(), image.address, chip).run(1000 * until_ms)


def test_the_whole_image_arms_tells_and_stops(
    tools: Toolchain, images: Path, pymavlink: Any
) -> None:
    """From power-on to turning motors and to the kill switch, by all sensors and lines at once."""
    chip = resting()
    end_ms, arm_ms, kill_ms = 11_600, 9_600, 11_000
    send_radio(chip, "spare", end_ms, {ARM: arm_ms, KILL: kill_ms})
    for now_ms in range(100, end_ms, FIX_MS):
        fix = device_frames.nav_pvt(100_000 + now_ms, PLACE, HEIGHT_M, (0.0, 0.0, 0.0), 1.0, 0.1)
        chip.lines["satellites"].send(1000 * now_ms, fix, PLAIN)
    run_built(tools, images, chip, end_ms)
    last = reports(chip)[-1]
    assert chip.resets == 0
    assert (last["radio"], last["state"] > 0) == (1, True), chip.text
    assert (last["skipped"], last["overruns"], last["failed1"], last["failed2"]) == (0, 0, 0, 0)
    assert last["fixes"] >= 95
    for number, log in enumerate(chip.outputs.log):
        states = [state for _, state in log]
        pulses = [Pulse(1050, 2500), LOW] if number < 4 else []
        assert states == ["floats", LOW, *pulses], number
    started_us, stopped_us = (time for time, _ in chip.outputs.log[0][2:])
    # Each switch is on for 0.3 s before it counts, behind one frame at most.
    assert 300_000 <= started_us - 1000 * arm_ms <= 350_000
    assert 300_000 <= stopped_us - 1000 * kill_ms <= 350_000
    told = pymavlink.MAVLink(None)
    messages = told.parse_buffer(bytes(chip.lines["telemetry"].sent))
    kinds = {message.get_type() for message in messages}
    assert {"HEARTBEAT", "ATTITUDE", "GPS_RAW_INT", "SYS_STATUS", "RC_CHANNELS"} <= kinds
    armed = [
        bool(message.base_mode & pymavlink.MAV_MODE_FLAG_SAFETY_ARMED)
        for message in messages
        if message.get_type() == "HEARTBEAT"
    ]
    assert armed[0] is False
    assert True in armed
    (fix,) = [message for message in messages if message.get_type() == "GPS_RAW_INT"][-1:]
    assert (fix.lat, fix.lon) == (473_977_000, 85_456_000)


@pytest.mark.parametrize(
    ("line", "frame", "bits", "radio"),
    [("pilot", device_frames.crsf, CRSF, 2), ("spare", device_frames.ibus, PLAIN, 3)],
)
def test_the_pilots_receiver_is_looked_for(
    tools: Toolchain, images: Path, line: str, frame: Any, bits: Bits, radio: int
) -> None:
    """At both sockets and with the bits of each protocol, for half a second each."""
    chip = resting()
    send_radio(chip, line, 4500, {}, frame, bits)
    run_built(tools, images, chip, 4500)
    assert reports(chip)[-1]["radio"] == radio


def test_ppm_is_looked_for_at_its_own_pin(tools: Toolchain, images: Path) -> None:
    """In the seventh half of a second, behind three protocols at two sockets."""
    chip = resting()
    for begin_us in range(100_000, 4_500_000, 22_500):
        chip.ppm.send(begin_us, [1500, 1500, 1000, 1500, 1000, 1500, 1000, 1500])
    run_built(tools, images, chip, 4500)
    third, fourth = reports(chip)[-2:]
    assert (third["radio"], fourth["radio"]) == (0, 4)


@pytest.fixture(scope="module")
def pymavlink(tools: Toolchain) -> Any:
    """The dialect that ground stations speak, by another's decoder."""
    tools.ensure("mavlink")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MAVLINK20", "1")
        return load(tools, "mavlink-packages", "pymavlink.dialects.v20.common")
