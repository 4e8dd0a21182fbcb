/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file reset.h
 * @brief A reset of the core and of all that belongs to the chip.
 */
#ifndef KEEL_BSP_CORTEX_M7_RESET_H
#define KEEL_BSP_CORTEX_M7_RESET_H

/** Resets, once outputs have been off long enough and all that was written has arrived. */
void keel_core_reset(void) __attribute__((noreturn));

#endif
