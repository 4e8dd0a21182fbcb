# SPDX-License-Identifier: Apache-2.0
"""What a person beside an FMUv5 presses, sees and hears, on the model of its chip: the safety
switch, and the buzzer."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from own_program import builder_of, sources_with
from test_copter_image import PINS, mistaken, tools

from keel.boards import firmware
from keel.boards.chip import Chip, ModelError
from keel.boards.processor import Processor
from keel.boards.pulses import LOW, Pulse
from keel.boards.wiring import WIRINGS
from keel.install import Toolchain

__all__ = ["tools"]  # A fixture.

# The panel by itself, by the clock: the switch is used from 0.5 to 9.5 s, and motors turn from 5 to
# 6.5 s. Says when motors may start, or no longer. Attempts to arm are made at 1 s, when it is
# refused, and at 5 s, when motors turn. The radio is heard from 0.8 s on and not from 2 to 5 s; the
# battery is low from 3 to 4 s. The buzzer is silenced from 7 to 8 s, within the tune of a second
# time without a radio, which goes on to 9 s.
PANELLER = """\
#include "board.h"
#include "../copter_on_board/board_panel.h"
#include "console.h"
#include "stm32f767/target/chip.h"

#include <stddef.h>

static board_panel_t panel KEEL_REALTIME_ZERO;

static bool is_within(uint32_t now_us, uint32_t from_us, uint32_t to_us)
{
    return (now_us >= from_us) && (now_us < to_us);
}

int main(void)
{
    bool was_ready = false;

    board_panel_start(&panel);
    for (;;) {
        const uint32_t now_us = keel_board_clock_us(NULL);
        const board_shown_t shown = {.uses_safety = is_within(now_us, 500000u, 9500000u),
                                     .sounds = !is_within(now_us, 7000000u, 8000000u),
                                     .motors = is_within(now_us, 5000000u, 6500000u),
                                     .can_try = is_within(now_us, 900000u, 1000000u) ||
                                                is_within(now_us, 4900000u, 5000000u),
                                     .is_linked = (now_us >= 800000u) &&
                                                  !is_within(now_us, 2000000u, 5000000u) &&
                                                  !is_within(now_us, 6600000u, 9000000u),
                                     .is_low = is_within(now_us, 3000000u, 4000000u)};

        keel_chip_turn();
        board_panel_turn(&panel, &shown, now_us);
        if (board_panel_is_ready(&panel) != was_ready) {
            was_ready = !was_ready;
            keel_console_text(was_ready ? "ready " : "safe ");
            keel_console_number(now_us / 1000u);
            keel_console_text("\\n");
        }
    }
}
"""
# Before it is used; too short; long; while motors turn; long again; and once more, before its end.
PRESSES = (
    (100_000, 400_000),
    (1_000_000, 1_900_000),
    (2_000_000, 3_500_000),
    (5_100_000, 6_400_000),
    (7_000_000, 8_200_000),
    (8_300_000, 9_400_000),
)
WATCHED = ["PE12", "PE5 TIM9_CH1"]
LIGHT, BUZZER = range(2)
STEP_US = 500


@pytest.fixture(scope="module")
def sources() -> Iterator[Path]:
    with sources_with("paneller", PANELLER) as root:
        yield root


def panel(tools: Toolchain, builder: firmware.Builder) -> Chip:
    """Ten seconds of the panel."""
    parts = ["examples/paneller", "examples/copter_on_board/board_panel.c"]
    image = builder.link("keel", builder.objects(parts))
    chip = Chip(WIRINGS["fmuv5"], "", WATCHED)
    chip.step_us = STEP_US
    chip.presses = [*PRESSES]
    address = builder.board.load_address
    Processor(tools, image.binary.read_bytes(), address, chip).run(10_000_000)
    return chip


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
    assert [state for _, state in log] == ["floats", "high", *["low", "high"] * 6]
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
    assert log[0] == (0, "floats")
    tones = []
    for (begin_us, state), (end_us, after) in pairwise(log):
        if isinstance(state, Pulse):
            tones.append((begin_us / 1e6, state, (end_us - begin_us) / 1e6))
        else:
            assert state in ("floats", LOW)
            assert isinstance(after, Pulse) or state == "floats"
    assert log[-1][1] == LOW
    assert len(tones) == len(TONES_S), tones
    for (begin_s, pulse, s), (due_s, hz, long_s) in zip(tones, TONES_S, strict=True):
        assert abs(begin_s - due_s) < 0.06, tones
        assert abs(s - long_s) < 0.02, tones
        assert abs(1e6 / pulse.period_us - hz) <= 0.002 * hz
        assert abs(pulse.us / pulse.period_us - 0.5) < 0.002


def test_the_switch_its_light_and_the_buzzer(tools: Toolchain, sources: Path) -> None:
    chip = panel(tools, builder_of(tools, sources, "right"))
    check_switch(chip)
    check_light(chip)
    check_buzzer(chip)
    assert chip.resets == 0


PANEL, OWN = "bsp/stm32f767/target/panel.c", "examples/copter_on_board/board_panel.c"
BUZZER_FILE = "bsp/stm32f767/buzzer.c"
MISTAKES = (
    (PINS, "KEEL_SAFETY(E, 10u, E, 12u)", "KEEL_SAFETY(E, 12u, E, 10u)"),
    (PINS, "KEEL_SAFETY(E, 10u, E, 12u)", "KEEL_SAFETY(E, 11u, E, 12u)"),
    (PANEL, "(safety->button, KEEL_PULL_DOWN)", "(safety->button, KEEL_PULL_UP)"),
    (PANEL, "(safety->button, KEEL_PULL_DOWN)", "(safety->button, KEEL_PULL_NONE)"),
    (PANEL, "keel_pin_input(safety->button, KEEL_PULL_DOWN);", ""),
    (PANEL, "keel_chip_give_light(&safety->light);", ""),
    (PANEL, "shine(&PINS->safety->light, on)", "shine(&PINS->safety->light, !on)"),
    (OWN, "!shown->motors &&", ""),
    (OWN, "uses_safety && keel_safety_switch_is_lit", "uses_safety || keel_safety_switch_is_lit"),
    (OWN, "panel->stepped_us = now_us;", ""),
    (OWN, "panel->has_safety && !panel->safety.is_safe", "panel->has_safety"),
    (OWN, "if (!shown->uses_safety) {", "if (false) {"),
    (PINS, "KEEL_BUZZER(E, 5u, 3u, TIM9, CH1)", "KEEL_BUZZER(E, 6u, 3u, TIM9, CH2)"),
    (PINS, "KEEL_BUZZER(E, 5u, 3u, TIM9, CH1)", "KEEL_BUZZER(E, 5u, 2u, TIM9, CH1)"),
    (PANEL, "keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_TIM9EN);", ""),
    (PANEL, "((keel_tim_t *)TIM9_BASE)", "((keel_tim_t *)TIM12_BASE)"),
    (PANEL, "keel_timer_hz(KEEL_CORE_HZ, apb2)", "keel_timer_hz(KEEL_CORE_HZ, apb2) / 2u"),
    (PANEL, "keel_chip_give(*PINS->buzzer, KEEL_PULL_DOWN);", ""),
    (BUZZER_FILE, "tim->CCER = TIM_CCER_CC1E;", "tim->CCER = TIM_CCER_CC2E;"),
    (BUZZER_FILE, "fall_silent(tim);\n if ((tone->hz >=", "if ((tone->hz >="),
    (OWN, "panel->is_greeted = true;", ""),
    (OWN, "panel->could_try && !shown->can_try && !shown->motors", "!shown->can_try"),
    (OWN, "panel->was_linked && !shown->is_linked", "!shown->is_linked"),
    (OWN, "(!plays || (tune > panel->tune))", "!plays"),
    (OWN, "if (!shown->sounds) {", "if (false) {"),
)


def test_mistakes_at_the_panel_are_noticed(tools: Toolchain, sources: Path) -> None:
    """By the model, which refuses, or by what is seen."""
    builder = builder_of(tools, sources, "wrong")
    unnoticed = []
    for path, old, new in MISTAKES:
        with mistaken(sources, builder, path, old, new):
            try:
                chip = panel(tools, builder)
                check_switch(chip)
                check_light(chip)
                check_buzzer(chip)
                unnoticed.append(new)
            except (AssertionError, ModelError):
                pass
    assert unnoticed == []
