/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/buzzer.h"

#include "common/progress.h"
#include "stm32f767/time_base.h"

#define TICK_HZ     1000000u
#define US_PER_MS   1000u
#define PWM_MODE_1  6u /* High while the counter is below the compare value. */
#define SILENT_TICK 1000u

/* The timer takes over what was preloaded, at the beginning of a period. */
static void take_over(keel_tim_t *tim)
{
    tim->EGR = TIM_EGR_UG;
}

/* Low from now on; a tone that follows begins with a whole period. */
static void fall_silent(keel_tim_t *tim)
{
    tim->CCR1 = 0u;
    take_over(tim);
}

/* Half of each period high. */
static void sound(keel_tim_t *tim, const keel_tone_t *tone)
{
    fall_silent(tim);
    if ((tone->hz >= KEEL_BUZZER_MIN_HZ) && (tone->hz <= KEEL_BUZZER_MAX_HZ)) {
        const uint32_t ticks = (TICK_HZ + (tone->hz / 2u)) / tone->hz;

        tim->ARR = ticks - 1u;
        tim->CCR1 = ticks / 2u;
        take_over(tim);
    }
}

keel_bsp_status_t keel_buzzer_start(keel_buzzer_t *buzzer, keel_tim_t *tim, uint32_t timer_hz)
{
    uint32_t prescaler;

    if (keel_timer_prescaler(timer_hz, TICK_HZ, &prescaler) != KEEL_BSP_OK) {
        return KEEL_BSP_ARGUMENT;
    }
    *buzzer = (keel_buzzer_t){.tim = tim};
    tim->CR1 = 0u;
    tim->PSC = prescaler;
    tim->ARR = SILENT_TICK - 1u;
    tim->CCMR1 = FIELD(TIM_CCMR1_OC1M, PWM_MODE_1) | TIM_CCMR1_OC1PE;
    tim->CCER = TIM_CCER_CC1E;
    fall_silent(tim);
    tim->CR1 = TIM_CR1_ARPE | TIM_CR1_CEN;
    return KEEL_BSP_OK;
}

void keel_buzzer_play(keel_buzzer_t *buzzer, const keel_tone_t *tones, uint32_t count)
{
    buzzer->tone = tones;
    buzzer->left = count;
    buzzer->passed_us = 0u;
    if (count > 0u) {
        sound(buzzer->tim, tones);
    } else {
        fall_silent(buzzer->tim);
    }
}

/* The time by which a turn is late is not taken off the next tone. */
void keel_buzzer_turn(keel_buzzer_t *buzzer, uint32_t elapsed_us)
{
    if (buzzer->left == 0u) {
        return;
    }
    buzzer->passed_us = keel_progress_sum(buzzer->passed_us, elapsed_us);
    if (buzzer->passed_us >= (buzzer->tone->ms * US_PER_MS)) {
        keel_buzzer_play(buzzer, &buzzer->tone[1], buzzer->left - 1u);
    }
}

bool keel_buzzer_plays(const keel_buzzer_t *buzzer)
{
    return buzzer->left > 0u;
}
