/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file watchdog.h
 * @brief The independent watchdog: it has its own oscillator and cannot be stopped once started.
 */
#ifndef KEEL_BSP_STM32F767_WATCHDOG_H
#define KEEL_BSP_STM32F767_WATCHDOG_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/registers/iwdg.h"

#include <stdint.h>

/** The watchdog's oscillator, nominally; it is 17 to 47 kHz (data sheet), so allow for half. */
#define KEEL_WATCHDOG_CLOCK_HZ 32000u

/** Prescaler and reload value for a time-out. */
typedef struct keel_watchdog_plan {
    uint32_t prescaler; /**< Content of PR: the divisor is 4 << prescaler. */
    uint32_t reload;    /**< Content of RLR. */
} keel_watchdog_plan_t;

/**
 * The finest prescaler with which a time-out can be had (requirement WDG-001).
 *
 * @param timeout_us the time-out, 125 us to 32.768 s
 * @param plan       the contents of the registers: not shorter than the time-out, nominally
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with plan as it was
 */
keel_bsp_status_t keel_watchdog_plan(uint32_t timeout_us, keel_watchdog_plan_t *plan);

/**
 * Starts the watchdog (requirement WDG-002).
 *
 * @param iwdg       the watchdog
 * @param timeout_us the time-out, as keel_watchdog_plan
 * @param wait       the bound for its registers to take effect
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT, and it is not started; KEEL_BSP_TIMEOUT, and it runs with
 *         whatever time-out it took
 */
keel_bsp_status_t keel_watchdog_start(keel_iwdg_t *iwdg, uint32_t timeout_us,
                                      const keel_wait_t *wait);

/**
 * Starts its time-out anew (requirement WDG-003).
 *
 * @param iwdg the watchdog
 */
void keel_watchdog_feed(keel_iwdg_t *iwdg);

#endif
