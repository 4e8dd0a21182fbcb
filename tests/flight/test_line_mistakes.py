# SPDX-License-Identifier: Apache-2.0
"""Mistakes in the lines of an FMUv5's image, each of which the model of its chip notices."""

from __future__ import annotations

from pathlib import Path

from test_board_lines import FIX_MS, HEIGHT_M, PLACE, resting, send_radio
from test_copter_image import PINS, mistaken, reports, sources, tools

from keel.boards import firmware
from keel.boards.board import application_of, read_board
from keel.boards.chip import ModelError
from keel.boards.dma_uart import PLAIN
from keel.boards.processor import Processor
from keel.flight import device_frames
from keel.install import Toolchain

__all__ = ["sources", "tools"]  # Fixtures.

UNTIL_MS = 1400  # The first report comes after a second.


def lined(tools: Toolchain, root: Path, builder: firmware.Builder) -> None:
    """In 1.4 s the pilot is heard at the second socket, fixes and samples of the field come."""
    board = read_board(root, "fmuv5")
    parts = application_of(board, "copter").application
    image = builder.link("keel", [*builder.objects(parts), *builder.fatfs()])
    chip = resting()
    send_radio(chip, "spare", UNTIL_MS, {})
    for now_ms in range(100, UNTIL_MS, FIX_MS):
        fix = device_frames.nav_pvt(now_ms, PLACE, HEIGHT_M, (0.0, 0.0, 0.0), 1.0, 0.1)
        chip.lines["satellites"].send(1000 * now_ms, fix, PLAIN)
    Processor(tools, image.binary.read_bytes(), board.load_address, chip).run(1000 * UNTIL_MS)
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


LINES, FIELDS, OWN_LINES = (
    "bsp/stm32f767/target/lines.c",
    "bsp/stm32f767/target/magnetometer.c",
    "examples/copter_on_board/board_lines.c",
)
WRONG_LINES = (
    (LINES, "place->on_apb2 ? KEEL_APB2_LIMIT_HZ : KEEL_APB1_LIMIT_HZ", "KEEL_APB1_LIMIT_HZ"),
    (LINES, "RCC_AHB1ENR_DMA1EN | RCC_AHB1ENR_DMA2EN", "RCC_AHB1ENR_DMA1EN"),
    (LINES, "keel_chip_give(place->rx, KEEL_PULL_NONE);", ""),
    (LINES, "receiver[KEEL_CHIP_LINES] KEEL_REALTIME_ZERO;", "receiver[KEEL_CHIP_LINES];"),
    (LINES, "place->on_apb2 ? &RCC->APB2ENR", "!place->on_apb2 ? &RCC->APB2ENR"),
    (PINS, "KEEL_UART(USART3, APB1, DMA1, 1u, 4u)", "KEEL_UART(USART3, APB1, DMA1, 3u, 4u)"),
    (PINS, "KEEL_UART(USART1, APB2, DMA2, 5u, 4u)", "KEEL_UART(USART1, APB2, DMA2, 5u, 5u)"),
    (FIELDS, "keel_pin_alternate_open_drain(place->scl.pin", "keel_pin_alternate(place->scl.pin"),
    (FIELDS, "keel_bits_enable(&RCC->APB1ENR, RCC_APB1ENR_I2C3EN);", ""),
    (FIELDS, "keel_i2c_start(I2C3, KEEL_APB1_LIMIT_HZ)", "keel_i2c_start(I2C3, 27000000u)"),
    (OWN_LINES, "listen_at(lines, lines->turn + i,", "listen_at(lines, lines->turn,"),
    (OWN_LINES, "(receiver == COPTER_RC)", "(receiver != COPTER_RC)"),
    (OWN_LINES, "lines->tail++;", "lines->tail += 2u;"),
)


def test_mistakes_in_the_lines_are_noticed(tools: Toolchain, sources: Path) -> None:
    """By the model, which refuses, or by what does not come."""
    builder = firmware.Builder(tools, read_board(sources, "fmuv5"), sources / "build/bad", sources)
    lined(tools, sources, builder)
    unnoticed = []
    for path, old, new in WRONG_LINES:
        with mistaken(sources, builder, path, old, new):
            try:
                lined(tools, sources, builder)
                unnoticed.append(new)
            except (AssertionError, ModelError):
                pass
    assert unnoticed == []
