# SPDX-License-Identifier: Apache-2.0
"""What the copter's image does behind a reset that nobody wanted: it comes up disarmed, its outputs
stay low, it tells why, and only the pilot arms it again, who has switched off before."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from pyulog import ULog
from test_black_box import MIB, OTHERS, files_of, new_card, pyfatfs
from test_board_lines import ARM, images, pymavlink, run_built
from test_copter_image import tools

from keel.emulator.card import SdCard
from keel.emulator.chip import Chip
from keel.emulator.dma_uart import PLAIN, SBUS
from keel.emulator.pulses import FLOATS, LOW, Pulse
from keel.flight import device_frames
from keel.install import Toolchain
from keel.qualify.board_trials import (
    FIX_MS,
    FRAME_MS,
    HEIGHT_M,
    MISHAP_US,
    PLACE,
    RESTART,
    reports,
    resting,
)

__all__ = ["images", "pyfatfs", "pymavlink", "tools"]  # Fixtures.

UP_US = 1_000_000  # So soon it is ready again.


def states_behind(chip: Chip, from_us: int) -> set[Any]:
    """What outputs do from a time on."""
    return {state for log in chip.outputs.log for time_us, state in log if time_us >= from_us}


def reasons_of(pymavlink: Any, chip: Chip) -> list[str]:
    """Which restarts it told to ground stations."""
    told = pymavlink.MAVLink(None)
    told.robust_parsing = True  # A reset may come within a frame.
    messages = told.parse_buffer(bytes(chip.lines["telemetry"].sent))
    return [
        text.removeprefix(RESTART)
        for message in messages
        if message.get_type() == "STATUSTEXT" and (text := message.text).startswith(RESTART)
    ]


def befallen(tools: Toolchain, root: Path, mishap: str, until_ms: int = 3400) -> Chip:
    chip = resting()
    chip.mishaps = [(MISHAP_US, mishap)]
    run_built(tools, root, chip, until_ms)
    return chip


@pytest.mark.parametrize(
    ("mishap", "resets", "cause", "record"),
    [
        ("watchdog", 2, "watchdog", "exception 6 code 0xb0a20200"),
        ("fault", 1, "fault", "exception 6 code 0x00000000"),
        ("clock", 1, "clock lost", "exception 2 code 0x00000000"),
        ("brown-out", 1, "brown-out", ""),
        ("pin", 1, "reset pin", ""),
    ],
)
def test_it_comes_up_disarmed_within_a_second_and_tells_why(
    tools: Toolchain,
    images: Path,
    pymavlink: Any,
    mishap: str,
    resets: int,
    cause: str,
    record: str,
) -> None:
    """RST-001 to RST-003."""
    chip = befallen(tools, images, mishap)
    assert chip.resets == resets
    _, before, behind = chip.text.split("Keel on fmuv5: copter\r\n")
    assert before.startswith("start by: power\r\n") and "fault" not in before
    assert behind.startswith(f"start by: {cause}\r\n")
    assert (record in behind) and (("fault 1 " in behind) == bool(record))
    first, again = chip.begun_us
    assert again - chip.reset_us[0] < UP_US
    assert states_behind(chip, chip.reset_us[0]) == {FLOATS, LOW}
    assert [report["state"] for report in reports(chip)] == [0, 0]
    assert reasons_of(pymavlink, chip) == [cause]
    # A bite of the watchdog takes 50 ms; all else is at once.
    assert chip.reset_us[0] - MISHAP_US < 60_000


def test_power_is_no_news(tools: Toolchain, images: Path, pymavlink: Any) -> None:
    chip = resting()
    run_built(tools, images, chip, 1500)
    assert "start by: power\r\n" in chip.text
    assert reasons_of(pymavlink, chip) == []


def test_without_its_clock_it_stays_safe(tools: Toolchain, images: Path) -> None:
    """No bus would have its rate: the record is told on the console, and no application starts."""
    chip = befallen(tools, images, "clock for good", 2400)
    assert chip.text.count("Keel on fmuv5: copter") == 1
    assert "safe state: fault 1 exception 2" in chip.text
    assert chip.begun_us[1:] == []
    assert states_behind(chip, chip.reset_us[0]) == {FLOATS, LOW}


def test_it_stays_safe_behind_a_fault_at_its_start(tools: Toolchain, images: Path) -> None:
    """Or fault would follow fault for ever: RST-001."""
    chip = resting()
    chip.mishaps = [(MISHAP_US, "fault"), (MISHAP_US + 700_000, "fault")]
    run_built(tools, images, chip, 3200)
    assert chip.text.count("Keel on fmuv5: copter") == 2
    assert "start by: fault\r\n" in chip.text
    assert "safe state: fault 2 exception 6" in chip.text
    assert chip.resets == 2


def test_the_reason_is_in_the_next_log(
    tools: Toolchain, images: Path, pyfatfs: tuple[Any, Any]
) -> None:
    """RST-003."""
    chip = resting()
    chip.card = SdCard(bytearray(new_card(pyfatfs, "FAT32", 300 * MIB)))  # For two logs.
    chip.mishaps = [(2_500_000, "brown-out")]
    run_built(tools, images, chip, 5600)
    files = files_of(pyfatfs, bytes(chip.card.image))
    logs = [ULog(io.BytesIO(files[name])) for name in sorted(set(files) - set(OTHERS))]
    assert [log.msg_info_dict.get("restart") for log in logs] == [None, "brown-out"]


def test_only_the_pilot_arms_it_again(tools: Toolchain, images: Path, pymavlink: Any) -> None:
    """From power-on to a bite of the watchdog while motors turn, and to the next arming. The switch
    stays on until all checks would hold again: it does not arm by itself. RST-002."""
    chip = resting()
    arm_ms, bite_ms, off_ms, again_ms, end_ms = 9_600, 10_400, 21_400, 22_400, 23_200
    for now_ms in range(100, end_ms, FRAME_MS):
        on = arm_ms <= now_ms < off_ms or now_ms >= again_ms
        channels = [1500, 1500, 1000, 1500, 1000, 1500, 1000, 1500]
        channels[ARM] = 2000 if on else 1000
        chip.lines["spare"].send(1000 * now_ms, device_frames.sbus(channels), SBUS)
    for now_ms in range(100, end_ms, FIX_MS):
        fix = device_frames.nav_pvt(100_000 + now_ms, PLACE, HEIGHT_M, (0.0, 0.0, 0.0), 1.0, 0.1)
        chip.lines["satellites"].send(1000 * now_ms, fix, PLAIN)
    chip.mishaps = [(1000 * bite_ms, "watchdog")]
    run_built(tools, images, chip, end_ms)
    bite_us = chip.reset_us[0]
    assert 0 < bite_us - 1000 * bite_ms < 60_000
    assert chip.begun_us[1] - bite_us < UP_US
    for number, log in enumerate(chip.outputs.log):
        pulse = [Pulse(1050, 2500)] if number < 4 else []
        states = [state for _, state in log]
        assert states == [FLOATS, LOW, *pulse, FLOATS, LOW, FLOATS, LOW, *pulse], number
    started_us, stopped_us, *_, again_us = (time_us for time_us, _ in chip.outputs.log[0][2:])
    assert started_us < stopped_us == bite_us
    # The switch is off for long enough, then on for 0.3 s, behind one frame at most.
    assert 300_000 <= again_us - 1000 * again_ms <= 350_000
    assert set(reasons_of(pymavlink, chip)) == {"watchdog"}
