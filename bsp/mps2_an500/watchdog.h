/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file watchdog.h
 * @brief The board's watchdog (CMSDK): a non-maskable interrupt when it was not fed in time, which
 *        ends as any other fault, and a reset when that does not help within the same time again.
 */
#ifndef KEEL_BSP_MPS2_AN500_WATCHDOG_H
#define KEEL_BSP_MPS2_AN500_WATCHDOG_H

#include <stdint.h>

/**
 * Starts the watchdog.
 *
 * @param limit_us the longest time between two feedings, 1 us to 171 s
 */
void keel_watchdog_start(uint32_t limit_us);

/** Feeds the watchdog: its time begins anew. */
void keel_watchdog_feed(void);

/** Stops the watchdog: this one can be, which a real board's must not. */
void keel_watchdog_stop(void);

#endif
