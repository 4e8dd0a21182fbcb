# SPDX-License-Identifier: Apache-2.0
"""Mistakes in what a restart does, each of which is noticed on the model of an FMUv5's chip."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from test_board_lines import pymavlink, resting
from test_copter_image import mistaken, sources, tools
from test_restart import AT_US, reasons_of

from keel.boards import firmware
from keel.boards.board import application_of, read_board
from keel.boards.chip import ModelError
from keel.boards.processor import Processor
from keel.install import Toolchain

__all__ = ["pymavlink", "sources", "tools"]  # Fixtures.

START, FAULT, CHIP, PORT, MAIN = (
    "bsp/cortex_m7/startup.c",
    "bsp/cortex_m7/fault.c",
    "bsp/stm32f767/target/chip.c",
    "examples/copter_on_board/board_port.c",
    "examples/copter_on_board/main.c",
)
MISTAKES = (
    (START, "keel_fault_take() && !restarts", "keel_fault_take() && restarts"),
    (START, "= keel_fault_take_restart();", "= keel_fault_take_restart() || true;"),
    (FAULT, "allowed ? RESTARTS : 0u", "(allowed || true) ? RESTARTS : 0u"),
    (FAULT, "keel_fault_allow_restart(false);", ""),
    (CHIP, "restart = told ?", "restart = (told && !good) ?"),
    (CHIP, "RCC->CSR |= RCC_CSR_RMVF;", ""),
    (CHIP, "record->code == KEEL_FAULT_WATCHDOG", "record->code != KEEL_FAULT_WATCHDOG"),
    (PORT, ".notice_count = board->notices,", ""),
    (PORT, '{"watchdog", false, true}', '{"watchdog", true, true}'),
    (MAIN, "keel_fault_allow_restart(true);", ""),
)


def bitten_then_faulty(tools: Toolchain, root: Path, made: firmware.Builder, mavlink: Any) -> None:
    """A bite of the watchdog restarts it; a fault within the second behind that leaves it safe.
    Then somebody resets it."""
    board = read_board(root, "fmuv5")
    parts = application_of(board, "copter").application
    image = made.link("keel", [*made.objects(parts), *made.fatfs()])
    chip = resting()
    chip.mishaps = [(AT_US, "watchdog"), (AT_US + 900_000, "fault"), (AT_US + 1_100_000, "pin")]
    Processor(tools, image.binary.read_bytes(), board.load_address, chip).run(3_000_000)
    assert "start by: watchdog\r\nfault 1 " in chip.text
    assert "safe state: fault 2 exception 6" in chip.text
    assert chip.text.partition("safe state")[2].count("start by: reset pin\r\n") == 1
    assert (chip.resets, len(chip.begun_us)) == (4, 2)
    assert reasons_of(mavlink, chip) == ["watchdog"]


def test_mistakes_in_the_restart_are_noticed(
    tools: Toolchain, sources: Path, pymavlink: Any
) -> None:
    made = firmware.Builder(tools, read_board(sources, "fmuv5"), sources / "build/again", sources)
    bitten_then_faulty(tools, sources, made, pymavlink)
    unnoticed = []
    for path, old, new in MISTAKES:
        with mistaken(sources, made, path, old, new):
            try:
                bitten_then_faulty(tools, sources, made, pymavlink)
                unnoticed.append((path, new))
            except (AssertionError, ModelError):
                pass
    assert unnoticed == []
