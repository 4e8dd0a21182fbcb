/* SPDX-License-Identifier: Apache-2.0 */
/* What a person at the board presses, sees and hears: the safety switch, and the buzzer. */
#include "stm32f767/buzzer.h"
#include "stm32f767/clock_tree.h"
#include "stm32f767/registers/rcc.h"
#include "stm32f767/target/chip.h"
#include "stm32f767/target/chip_parts.h"

#include <stddef.h>

#define RCC  ((keel_rcc_t *)RCC_BASE)
#define TIM9 ((keel_tim_t *)TIM9_BASE)
#define PINS (&keel_board_pins)

static keel_buzzer_t buzzer;

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

/* The pin is the timer's when that holds it low. */
bool keel_chip_buzzer_start(void)
{
    const uint32_t apb2 = keel_bus_divisor(KEEL_CORE_HZ, KEEL_APB2_LIMIT_HZ);

    if (PINS->buzzer == NULL) {
        return false;
    }
    keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_TIM9EN);
    keel_chip_require(keel_buzzer_start(&buzzer, TIM9, keel_timer_hz(KEEL_CORE_HZ, apb2)));
    keel_chip_give(*PINS->buzzer, KEEL_PULL_DOWN);
    return true;
}

void keel_chip_buzzer_play(const keel_tone_t *tones, uint32_t count)
{
    if (PINS->buzzer != NULL) {
        keel_buzzer_play(&buzzer, tones, count);
    }
}

void keel_chip_buzzer_turn(uint32_t elapsed_us)
{
    if (PINS->buzzer != NULL) {
        keel_buzzer_turn(&buzzer, elapsed_us);
    }
}

bool keel_chip_buzzer_plays(void)
{
    return keel_buzzer_plays(&buzzer);
}
