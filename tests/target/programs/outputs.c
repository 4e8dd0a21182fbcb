/* SPDX-License-Identifier: Apache-2.0 */
/* Pulses that tell a board's outputs apart; then off, and on again, which forgets them; one that is
 * too long; others; and all anew. */
#include "board.h"
#include "stm32f767/target/chip.h"

#include <stddef.h>

static uint32_t turns KEEL_REALTIME_ZERO; /* The board's file asks for something of the kind. */

static void wait(uint32_t us)
{
    const uint32_t start_us = keel_board_clock_us(NULL);

    while ((keel_board_clock_us(NULL) - start_us) < us) {
        turns++;
    }
}

static void set_all(uint32_t first_us, uint32_t step_us)
{
    for (uint32_t i = 0u; i < keel_chip_output_count(); i++) {
        (void)keel_chip_pulse(i, first_us + (step_us * i));
    }
}

int main(void)
{
    wait(100u);
    set_all(1000u, 100u);
    wait(5300u);
    keel_chip_arm();
    wait(6000u);
    keel_chip_arm();
    wait(6000u);
    keel_board_outputs_off();
    wait(1000u);
    keel_chip_arm();
    wait(6000u);
    set_all(2101u, 0u);
    wait(6000u);
    set_all(1500u, 0u);
    wait(6000u);
    keel_chip_reset();
}
