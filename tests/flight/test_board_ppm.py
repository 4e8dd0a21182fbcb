# SPDX-License-Identifier: Apache-2.0
"""A receiver of PPM at an FMUv5, on the model of its chip: from edges at the pin to channels."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from own_program import builder_of, sources_with
from test_copter_image import PINS, mistaken, tools

from keel.boards import firmware
from keel.boards.chip import Chip, ModelError
from keel.boards.processor import Processor
from keel.boards.wiring import WIRINGS
from keel.install import Toolchain

__all__ = ["tools"]  # A fixture.

# Says each frame's channels.
EDGER = """\
#include "board.h"
#include "console.h"
#include "keel/middleware/ppm.h"
#include "stm32f767/target/chip.h"

static keel_ppm_t ppm KEEL_REALTIME_ZERO;

static void say_channels(void)
{
    keel_console_text("channels");
    for (uint32_t i = 0u; i < ppm.channels; i++) {
        keel_console_text(" ");
        keel_console_number(ppm.channel[i]);
    }
    keel_console_text("\\n");
}

int main(void)
{
    static const keel_ppm_config_t config = {100000u, 800u, 2200u, 2300u, 0x000Fu, 4u, 2u};

    (void)keel_ppm_init(&ppm, &config);
    keel_console_text("ppm status ");
    keel_console_number((uint64_t)keel_chip_ppm_start());
    keel_console_text("\\n");
    for (;;) {
        uint32_t elapsed_us;

        keel_chip_turn();
        while (keel_chip_ppm_read(&elapsed_us)) {
            if (keel_ppm_take(&ppm, elapsed_us)) {
                say_channels();
            }
        }
    }
}
"""
CHANNELS = (1000, 1234, 1500, 1777, 2000, 1100, 2150, 805)
FRAMES, FRAME_US = 18, 22_500
STEP_US = 40


@pytest.fixture(scope="module")
def sources() -> Iterator[Path]:
    with sources_with("edger", EDGER) as root:
        yield root


def hear(tools: Toolchain, builder: firmware.Builder) -> Chip:
    """Frames from 20 ms on, between the sixth and the seventh a pause of a wrap of the timer, and
    in each a disturbance of 2 us."""
    image = builder.link("keel", builder.objects(["examples/edger"]))
    chip = Chip(WIRINGS["fmuv5"], "", [])
    chip.step_us = STEP_US
    for number in range(FRAMES):
        at_us = 20_000 + FRAME_US * number + (65_536 if number > 5 else 0)
        chip.ppm.send(at_us, CHANNELS)
        chip.ppm.spike(at_us + 500, 2.0)
    address = builder.board.load_address
    Processor(tools, image.binary.read_bytes(), address, chip).run(600_000)
    return chip


def check(chip: Chip) -> None:
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


def test_channels_come_as_they_were_sent(tools: Toolchain, sources: Path) -> None:
    check(hear(tools, builder_of(tools, sources, "right")))


LINES, CAPTURE = "bsp/stm32f767/target/lines.c", "bsp/stm32f767/capture.c"
GIVEN = "keel_chip_give(*PINS->ppm, KEEL_PULL_UP)"
MISTAKES = (
    (PINS, "KEEL_PPM(I, 5u, 3u, TIM8, CH1)", "KEEL_PPM(I, 6u, 3u, TIM8, CH2)"),
    (PINS, "KEEL_PPM(I, 5u, 3u, TIM8, CH1)", "KEEL_PPM(I, 5u, 2u, TIM8, CH1)"),
    (LINES, "((keel_tim_t *)TIM8_BASE)", "((keel_tim_t *)TIM1_BASE)"),
    (LINES, "keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_TIM8EN);", ""),
    (LINES, "keel_bits_enable(&RCC->AHB1ENR, RCC_AHB1ENR_DMA2EN);", ""),
    (LINES, "#define PPM_STREAM 2u", "#define PPM_STREAM 3u"),
    (LINES, "#define PPM_CHANNEL 7u", "#define PPM_CHANNEL 0u"),
    (LINES, GIVEN, GIVEN.replace("UP", "DOWN")),
    (LINES, GIVEN, GIVEN.replace("UP", "NONE")),
    (LINES, f"{GIVEN};", ""),
    (LINES, "keel_timer_hz(KEEL_CORE_HZ, apb2)", "keel_timer_hz(KEEL_CORE_HZ, apb2) / 2u"),
    (LINES, "keel_capture_t capture KEEL_REALTIME_ZERO;", "keel_capture_t capture;"),
    (CAPTURE, "tim->EGR = TIM_EGR_UG; /* Takes the prescaler over. */", ""),
    (CAPTURE, "tim->DIER = TIM_DIER_CC1DE;", ""),
    (CAPTURE, "tim->CCER = TIM_CCER_CC1E;", "tim->CCER = TIM_CCER_CC2E;"),
    (CAPTURE, " | FIELD(TIM_CCMR1_IC1F, SLOWEST_FILTER)", ""),
    (CAPTURE, "FIELD(TIM_CR1_CKD, QUARTER_CLOCK) | TIM_CR1_CEN", "TIM_CR1_CEN"),
    (CAPTURE, "config.tim->CCR1", "config.tim->CCR2"),
    (CAPTURE, "KEEL_DMA_HALF_WORD);", "KEEL_DMA_BYTE);"),
    (CAPTURE, "#define WRAP 0x10000u", "#define WRAP 0x1000u"),
    (CAPTURE, "(uint32_t)now - capture->last) % WRAP", "(uint32_t)capture->last - now) % WRAP"),
)


def test_mistakes_are_noticed(tools: Toolchain, sources: Path) -> None:
    """By the model, which refuses, or by what does not come."""
    builder = builder_of(tools, sources, "wrong")
    unnoticed = []
    for path, old, new in MISTAKES:
        with mistaken(sources, builder, path, old, new):
            try:
                check(hear(tools, builder))
                unnoticed.append((path, new))
            except (AssertionError, ModelError):
                pass
    assert unnoticed == []
