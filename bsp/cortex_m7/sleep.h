/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sleep.h
 * @brief Waiting with the core asleep, without an interrupt being taken.
 */
#ifndef KEEL_BSP_CORTEX_M7_SLEEP_H
#define KEEL_BSP_CORTEX_M7_SLEEP_H

#include <stdint.h>

/**
 * Stops the core until a time is over (requirement BRD-011). SysTick counts it and wakes the core;
 * its exception is masked and forgotten, as no handler but those of faults exists. Meanwhile a
 * fault would be a hard fault.
 *
 * @param us       how long; 0 is not at all, and what 24 bits of SysTick cannot count is as long
 *                 as they can
 * @param core_mhz the core's clock, in MHz
 */
void keel_core_sleep_us(uint32_t us, uint32_t core_mhz);

#endif
