/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file startup.h
 * @brief From the reset to main() and its end: what is the same on every board. What it asks of the
 *        board stands in board.h.
 */
#ifndef KEEL_BSP_CORTEX_M7_STARTUP_H
#define KEEL_BSP_CORTEX_M7_STARTUP_H

#include <stdint.h>

/** What every word of the stack holds that was never used. */
#define KEEL_STACK_PAINT 0xC5C5C5C5u

/** The entry of the image. */
void keel_reset(void) __attribute__((noreturn));

/** The most that the main stack was used since the reset, in bytes. */
uint32_t keel_stack_used_b(void);

#endif
