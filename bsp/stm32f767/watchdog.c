/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/watchdog.h"

#define KEY_START     0xCCCCu
#define KEY_UNLOCK    0x5555u
#define KEY_FEED      0xAAAAu
#define PRESCALER_MAX 6u
#define RELOAD_MAX    4095u
#define DIVISOR_MIN   4u
#define SECOND_US     1000000u

/* Ticks of the oscillator that one step of the counter takes. */
static uint64_t step_ticks(uint32_t prescaler)
{
    return (uint64_t)DIVISOR_MIN << prescaler;
}

/* The longest time-out of a prescaler, in ticks. */
static uint64_t most_ticks(uint32_t prescaler)
{
    return step_ticks(prescaler) * (RELOAD_MAX + 1u);
}

keel_bsp_status_t keel_watchdog_plan(uint32_t timeout_us, keel_watchdog_plan_t *plan)
{
    /* Rounded up. */
    const uint64_t ticks = (((uint64_t)timeout_us * KEEL_WATCHDOG_CLOCK_HZ) + (SECOND_US - 1u)) /
                           SECOND_US;
    uint32_t prescaler = 0u;
    uint64_t steps;

    while ((prescaler < PRESCALER_MAX) && (ticks > most_ticks(prescaler))) {
        prescaler++;
    }
    if ((ticks < DIVISOR_MIN) || (ticks > most_ticks(prescaler))) {
        return KEEL_BSP_ARGUMENT;
    }
    steps = (ticks + (step_ticks(prescaler) - 1u)) / step_ticks(prescaler);
    plan->prescaler = prescaler;
    plan->reload = (uint32_t)steps - 1u;
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_watchdog_start(keel_iwdg_t *iwdg, uint32_t timeout_us,
                                      const keel_wait_t *wait)
{
    keel_watchdog_plan_t plan;

    if (keel_watchdog_plan(timeout_us, &plan) != KEEL_BSP_OK) {
        return KEEL_BSP_ARGUMENT;
    }
    iwdg->KR = KEY_START;
    iwdg->KR = KEY_UNLOCK;
    iwdg->PR = plan.prescaler;
    iwdg->RLR = plan.reload;
    if (!keel_wait_for(&iwdg->SR, IWDG_SR_PVU | IWDG_SR_RVU, 0u, wait)) {
        return KEEL_BSP_TIMEOUT;
    }
    keel_watchdog_feed(iwdg);
    return KEEL_BSP_OK;
}

void keel_watchdog_feed(keel_iwdg_t *iwdg)
{
    iwdg->KR = KEY_FEED;
}
