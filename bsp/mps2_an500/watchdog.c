/* SPDX-License-Identifier: Apache-2.0 */
#include "mps2_an500/watchdog.h"

typedef struct watchdog {
    volatile uint32_t LOAD;
    volatile uint32_t VALUE;
    volatile uint32_t CONTROL;
    volatile uint32_t INTCLR;
} watchdog_t;

#define WATCHDOG     ((watchdog_t *)0x40008000u)
#define LOCK         (*(volatile uint32_t *)0x40008C00u)
#define UNLOCKED     0x1ACCE551u
#define ON           3u /* The interrupt, and the reset behind it. */
#define TICKS_PER_US 25u

void keel_watchdog_start(uint32_t limit_us)
{
    LOCK = UNLOCKED;
    WATCHDOG->LOAD = limit_us * TICKS_PER_US;
    WATCHDOG->CONTROL = ON;
    LOCK = 0u;
}

void keel_watchdog_feed(void)
{
    LOCK = UNLOCKED;
    WATCHDOG->INTCLR = 1u;
    LOCK = 0u;
}

void keel_watchdog_stop(void)
{
    LOCK = UNLOCKED;
    WATCHDOG->CONTROL = 0u;
    LOCK = 0u;
}
