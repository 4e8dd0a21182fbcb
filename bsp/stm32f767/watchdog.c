#include "stm32f767/watchdog.h"

#define KEY_START     0xCCCCu
#define KEY_UNLOCK    0x5555u
#define KEY_FEED      0xAAAAu
#define PRESCALER_MAX 6u
#define RELOAD_MAX    4095u
#define DIVISOR_MIN   4u
#define SECOND_US     1000000u

keel_bsp_status_t keel_watchdog_plan(uint32_t timeout_us, keel_watchdog_plan_t *plan)
{
    /* Ticks of the oscillator, rounded up. */
    const uint64_t ticks = (((uint64_t)timeout_us * KEEL_WATCHDOG_CLOCK_HZ) + (SECOND_US - 1u)) /
                           SECOND_US;
    uint32_t prescaler = 0u;

    while ((prescaler < PRESCALER_MAX) &&
           (ticks > ((uint64_t)(RELOAD_MAX + 1u) * (DIVISOR_MIN << prescaler)))) {
        prescaler++;
    }
    if ((ticks < DIVISOR_MIN) ||
        (ticks > ((uint64_t)(RELOAD_MAX + 1u) * (DIVISOR_MIN << prescaler)))) {
        return KEEL_BSP_ARGUMENT;
    }
    plan->prescaler = prescaler;
    plan->reload = (uint32_t)((ticks + ((DIVISOR_MIN << prescaler) - 1u)) /
                              (DIVISOR_MIN << prescaler)) -
                   1u;
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
