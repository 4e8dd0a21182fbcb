/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/pwm.h"

#include "stm32f767/time_base.h"

#define TICK_HZ    1000000u
#define PWM_MODE_1 6u /* Active while the counter is below the compare value. */

/* With the main output off, OSSI keeps the outputs driven at their idle level, which CR2 leaves
 * low, rather than floating. */
#define OUTPUTS_OFF TIM_BDTR_OSSI

keel_bsp_status_t keel_pwm_start(keel_tim_t *tim, uint32_t timer_hz, uint32_t rate_hz)
{
    uint32_t prescaler;

    if ((rate_hz < KEEL_PWM_RATE_MIN_HZ) || (rate_hz > KEEL_PWM_RATE_MAX_HZ) ||
        (keel_timer_prescaler(timer_hz, TICK_HZ, &prescaler) != KEEL_BSP_OK)) {
        return KEEL_BSP_ARGUMENT;
    }
    keel_pwm_off(tim);
    tim->CR1 = 0u;
    tim->CR2 = 0u;
    tim->PSC = prescaler;
    tim->ARR = (TICK_HZ / rate_hz) - 1u;
    tim->RCR = 0u;
    tim->CCR1 = 0u;
    tim->CCR2 = 0u;
    tim->CCR3 = 0u;
    tim->CCR4 = 0u;
    tim->CCMR1 = FIELD(TIM_CCMR1_OC1M, PWM_MODE_1) | TIM_CCMR1_OC1PE |
                 FIELD(TIM_CCMR1_OC2M, PWM_MODE_1) | TIM_CCMR1_OC2PE;
    tim->CCMR2 = FIELD(TIM_CCMR2_OC3M, PWM_MODE_1) | TIM_CCMR2_OC3PE |
                 FIELD(TIM_CCMR2_OC4M, PWM_MODE_1) | TIM_CCMR2_OC4PE;
    tim->CCER = TIM_CCER_CC1E | TIM_CCER_CC2E | TIM_CCER_CC3E | TIM_CCER_CC4E;
    tim->EGR = TIM_EGR_UG; /* Takes the preloaded values over. */
    tim->CR1 = TIM_CR1_ARPE | TIM_CR1_CEN;
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_pwm_set(keel_tim_t *tim, uint32_t channel, uint32_t pulse_us)
{
    const bool in_range = (pulse_us >= KEEL_PWM_PULSE_MIN_US) &&
                          (pulse_us <= KEEL_PWM_PULSE_MAX_US);
    keel_bsp_status_t status = KEEL_BSP_OK;

    if ((pulse_us != 0u) && !in_range) {
        return KEEL_BSP_ARGUMENT;
    }
    switch (channel) {
    case 0u:
        tim->CCR1 = pulse_us;
        break;
    case 1u:
        tim->CCR2 = pulse_us;
        break;
    case 2u:
        tim->CCR3 = pulse_us;
        break;
    case 3u:
        tim->CCR4 = pulse_us;
        break;
    default:
        status = KEEL_BSP_ARGUMENT;
        break;
    }
    return status;
}

void keel_pwm_arm(keel_tim_t *tim)
{
    tim->BDTR = OUTPUTS_OFF | TIM_BDTR_MOE;
}

void keel_pwm_off(keel_tim_t *tim)
{
    tim->BDTR = OUTPUTS_OFF;
}
