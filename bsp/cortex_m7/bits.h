/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bits.h
 * @brief Fields of 32-bit registers, described by their masks alone.
 */
#ifndef KEEL_BSP_CORTEX_M7_BITS_H
#define KEEL_BSP_CORTEX_M7_BITS_H

#include <stdbool.h>
#include <stdint.h>

/** The mask of a field of up to 31 bits. */
#define BITS(position, width) ((((uint32_t)1u << (width)) - 1u) << (position))

/** The lowest bit of a mask, by which a value is shifted to its field's place. */
#define BITS_LOWEST(mask) ((mask) & (~(mask) + 1u))

/** A value at the place of its field; it must not be wider than the field. */
#define FIELD(mask, value) ((mask) & ((value) * BITS_LOWEST(mask)))

/**
 * The value of a field.
 *
 * @param word a register's content
 * @param mask the field, not 0
 */
static inline uint32_t keel_bits_get(uint32_t word, uint32_t mask)
{
    return (word & mask) / BITS_LOWEST(mask);
}

/**
 * Replaces fields of a register and keeps the rest of it.
 *
 * @param target the register
 * @param mask   all fields that change
 * @param value  their new content, at their places
 */
static inline void keel_bits_put(volatile uint32_t *target, uint32_t mask, uint32_t value)
{
    *target = (*target & ~mask) | (value & mask);
}

/**
 * Sets bits that switch something on, and reads them back: what is switched on may be used only
 * after that (for a peripheral's clock, RM0410, 5.2.12).
 *
 * @param target the register
 * @param mask   the bits
 */
static inline void keel_bits_enable(volatile uint32_t *target, uint32_t mask)
{
    *target |= mask;
    (void)*target;
}

#endif
