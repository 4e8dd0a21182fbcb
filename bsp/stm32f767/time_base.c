/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/time_base.h"

#define MICROSECOND_HZ 1000000u
#define PSC_LIMIT      65536u

keel_bsp_status_t keel_timer_prescaler(uint32_t timer_hz, uint32_t rate_hz, uint32_t *word)
{
    const uint32_t divisor = timer_hz / rate_hz;

    if ((divisor == 0u) || (divisor > PSC_LIMIT) || ((timer_hz % rate_hz) != 0u)) {
        return KEEL_BSP_ARGUMENT;
    }
    *word = divisor - 1u;
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_time_base_start(keel_tim_t *tim, uint32_t timer_hz)
{
    uint32_t prescaler;

    if (keel_timer_prescaler(timer_hz, MICROSECOND_HZ, &prescaler) != KEEL_BSP_OK) {
        return KEEL_BSP_ARGUMENT;
    }
    tim->CR1 = 0u;
    tim->PSC = prescaler;
    tim->ARR = UINT32_MAX;
    tim->EGR = TIM_EGR_UG; /* Takes the prescaler over and clears the counter. */
    tim->CR1 = TIM_CR1_CEN;
    return KEEL_BSP_OK;
}

uint32_t keel_time_base_us(void *context)
{
    const keel_tim_t *const tim = context;

    return tim->CNT;
}
