/* SPDX-License-Identifier: Apache-2.0 */
#include "board_panel.h"

#include "board.h"
#include "stm32f767/target/chip.h"

#include <stddef.h>

void board_panel_start(board_panel_t *panel)
{
    *panel = (board_panel_t){.has_safety = keel_chip_safety_start(),
                             .stepped_us = keel_board_clock_us(NULL)};
    keel_safety_switch_init(&panel->safety);
}

/* A button that is touched in flight changes nothing, on the ground behind it either. */
static void turn_safety(board_panel_t *panel, const board_shown_t *shown, uint32_t elapsed_us)
{
    if (!shown->uses_safety) {
        keel_safety_switch_init(&panel->safety);
    } else {
        (void)keel_safety_switch_step(&panel->safety,
                                      !shown->motors && keel_chip_safety_is_pressed(), elapsed_us);
    }
    keel_chip_safety_light(shown->uses_safety && keel_safety_switch_is_lit(&panel->safety));
}

void board_panel_turn(board_panel_t *panel, const board_shown_t *shown, uint32_t now_us)
{
    const uint32_t elapsed_us = now_us - panel->stepped_us;

    panel->stepped_us = now_us;
    if (panel->has_safety) {
        turn_safety(panel, shown, elapsed_us);
    }
}

bool board_panel_is_ready(const board_panel_t *panel)
{
    return panel->has_safety && !panel->safety.is_safe;
}
