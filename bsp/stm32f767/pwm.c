/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/pwm.h"

#include "stm32f767/time_base.h"

#define TICK_HZ    1000000u
#define PWM_MODE_1 6u /* Active while the counter is below the compare value. */
#define CHANNELS   4u

/* With the main output off, OSSI keeps the outputs driven at their idle level, which CR2 leaves
 * low, rather than floating. */
#define GATE_SHUT TIM_BDTR_OSSI

#define MODES_1                                                                                    \
    (FIELD(TIM_CCMR1_OC1M, PWM_MODE_1) | TIM_CCMR1_OC1PE | FIELD(TIM_CCMR1_OC2M, PWM_MODE_1) |     \
     TIM_CCMR1_OC2PE)
#define MODES_2                                                                                    \
    (FIELD(TIM_CCMR2_OC3M, PWM_MODE_1) | TIM_CCMR2_OC3PE | FIELD(TIM_CCMR2_OC4M, PWM_MODE_1) |     \
     TIM_CCMR2_OC4PE)

/* The register with the pulse of a channel; the timer takes it over at its next period. */
static volatile uint32_t *pulse_of(const keel_pwm_timer_t *timer, uint32_t channel)
{
    keel_tim_t *const tim = timer->tim;
    volatile uint32_t *pulse;

    switch (channel) {
    case 1u:
        pulse = &tim->CCR1;
        break;
    case 2u:
        pulse = &tim->CCR2;
        break;
    case 3u:
        pulse = &tim->CCR3;
        break;
    default:
        pulse = &tim->CCR4;
        break;
    }
    return pulse;
}

static void shut_gate(const keel_pwm_timer_t *timer)
{
    if (timer->has_gate) {
        timer->tim->BDTR = GATE_SHUT;
    }
}

/* Timers with two channels have neither CR2 nor CCMR2. */
static void set_modes(const keel_pwm_timer_t *timer)
{
    timer->tim->CCMR1 = MODES_1;
    if (timer->channels == CHANNELS) {
        timer->tim->CR2 = 0u;
        timer->tim->CCMR2 = MODES_2;
        timer->tim->CCER = TIM_CCER_CC1E | TIM_CCER_CC2E | TIM_CCER_CC3E | TIM_CCER_CC4E;
    } else {
        timer->tim->CCER = TIM_CCER_CC1E | TIM_CCER_CC2E;
    }
}

keel_bsp_status_t keel_pwm_start(const keel_pwm_timer_t *timer, uint32_t timer_hz, uint32_t rate_hz)
{
    uint32_t prescaler;

    if ((rate_hz < KEEL_PWM_RATE_MIN_HZ) || (rate_hz > KEEL_PWM_RATE_MAX_HZ) ||
        (keel_timer_prescaler(timer_hz, TICK_HZ, &prescaler) != KEEL_BSP_OK)) {
        return KEEL_BSP_ARGUMENT;
    }
    shut_gate(timer);
    timer->tim->CR1 = 0u;
    timer->tim->PSC = prescaler;
    timer->tim->ARR = (TICK_HZ / rate_hz) - 1u;
    if (timer->has_gate) {
        timer->tim->RCR = 0u;
    }
    for (uint32_t channel = 1u; channel <= timer->channels; channel++) {
        *pulse_of(timer, channel) = 0u;
    }
    set_modes(timer);
    timer->tim->EGR = TIM_EGR_UG; /* Takes the preloaded values over. */
    timer->tim->CR1 = TIM_CR1_ARPE | TIM_CR1_CEN;
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_pwm_set(const keel_pwm_output_t *output, uint32_t pulse_us)
{
    const bool in_range = (pulse_us >= KEEL_PWM_PULSE_MIN_US) &&
                          (pulse_us <= KEEL_PWM_PULSE_MAX_US);

    if ((pulse_us != 0u) && !in_range) {
        return KEEL_BSP_ARGUMENT;
    }
    *pulse_of(output->timer, output->channel) = pulse_us;
    return KEEL_BSP_OK;
}

/* From now on a timer makes no pulse, not even the rest of one. */
static void silence(const keel_pwm_output_t *output)
{
    *pulse_of(output->timer, output->channel) = 0u;
    output->timer->tim->EGR = TIM_EGR_UG;
}

/* A pin that is given to its timer within a pulse would put out the rest of it. So the timers make
 * none until all pins are theirs, and take the pulses over at their next periods. */
keel_bsp_status_t keel_pwm_arm(const keel_pwm_output_t *outputs, uint32_t count)
{
    uint32_t pulse_us[KEEL_PWM_OUTPUTS_MAX];

    if ((count == 0u) || (count > KEEL_PWM_OUTPUTS_MAX)) {
        return KEEL_BSP_ARGUMENT;
    }
    if (keel_pin_is_alternate(outputs[0].pin)) { /* They are out, all of them. */
        return KEEL_BSP_OK;
    }
    for (uint32_t i = 0u; i < count; i++) {
        pulse_us[i] = *pulse_of(outputs[i].timer, outputs[i].channel);
        silence(&outputs[i]);
    }
    for (uint32_t i = 0u; i < count; i++) {
        keel_pin_alternate(outputs[i].pin, outputs[i].function, KEEL_PULL_DOWN);
        if (outputs[i].timer->has_gate) {
            outputs[i].timer->tim->BDTR = GATE_SHUT | TIM_BDTR_MOE;
        }
    }
    for (uint32_t i = 0u; i < count; i++) {
        *pulse_of(outputs[i].timer, outputs[i].channel) = pulse_us[i];
    }
    return KEEL_BSP_OK;
}

/* The gates first: each is one store for up to four outputs. */
void keel_pwm_off(const keel_pwm_output_t *outputs, uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        shut_gate(outputs[i].timer);
    }
    for (uint32_t i = 0u; i < count; i++) {
        keel_pin_output(outputs[i].pin, KEEL_DRIVE_PUSH_PULL, false);
    }
    for (uint32_t i = 0u; i < count; i++) {
        silence(&outputs[i]);
    }
}
