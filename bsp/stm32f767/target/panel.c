/* SPDX-License-Identifier: Apache-2.0 */
/* What a person at the board presses, sees and hears: the safety switch. */
#include "stm32f767/target/chip.h"
#include "stm32f767/target/chip_parts.h"

#include <stddef.h>

#define PINS (&keel_board_pins)

bool keel_chip_safety_start(void)
{
    const keel_board_safety_t *const safety = PINS->safety;

    if (safety == NULL) {
        return false;
    }
    keel_pin_input(safety->button, KEEL_PULL_DOWN);
    keel_chip_give_light(&safety->light);
    return true;
}

bool keel_chip_safety_is_pressed(void)
{
    return (PINS->safety != NULL) && keel_pin_read(PINS->safety->button);
}

void keel_chip_safety_light(bool on)
{
    if (PINS->safety != NULL) {
        keel_chip_shine(&PINS->safety->light, on);
    }
}
