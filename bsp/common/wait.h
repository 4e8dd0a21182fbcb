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

#endif
