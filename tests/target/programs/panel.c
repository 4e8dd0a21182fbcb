/* SPDX-License-Identifier: Apache-2.0 */
/* The panel by itself, by the clock: the switch is used from 0.5 to 9.5 s, and motors turn from 5
 * to 6.5 s. Says when motors may start, or no longer. Attempts to arm are made at 1 s, when it is
 * refused, and at 5 s, when motors turn. The radio is heard from 0.8 s on and not from 2 to 5 s;
 * the battery is low from 3 to 4 s. The buzzer is silenced from 7 to 8 s, within the tune of a
 * second time without a radio, which goes on to 9 s. */
#include "../../../examples/copter_on_board/board_panel.h"
#include "board.h"
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
            keel_console_text("\n");
        }
    }
}
