/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file wait.h
 * @brief Waiting for hardware with a bound, so that nothing waits for ever.
 */
#ifndef KEEL_BSP_COMMON_WAIT_H
#define KEEL_BSP_COMMON_WAIT_H

#include <stdbool.h>
#include <stdint.h>

/** How long to wait: so many looks at a register, and what happens between two of them. */
typedef struct keel_wait {
    uint32_t looks;                 /**< How often the register is looked at, at least once. */
    void (*between)(void *context); /**< Called between two looks, or null: nothing happens. */
    void *context;                  /**< Handed to between; may be null. */
} keel_wait_t;

/**
 * Waits until the masked bits of a register have a value (requirement WAI-001).
 *
 * @param word  the register
 * @param mask  the bits to look at
 * @param value what they are to be
 * @param wait  the bound
 * @return whether they became that within the bound
 */
bool keel_wait_for(const volatile uint32_t *word, uint32_t mask, uint32_t value,
                   const keel_wait_t *wait);

/**
 * Waits for a time, but not for ever should the clock stand still (requirement WAI-002).
 *
 * @param read    reads a counter of microseconds, which wraps at 2^32
 * @param context handed to read
 * @param time_us how long, below 2^31 us
 * @param looks   how often the counter is read at most, after its first reading
 * @return whether the time has passed
 */
bool keel_wait_us(uint32_t (*read)(void *context), void *context, uint32_t time_us, uint32_t looks);

#endif
