/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file memory.h
 * @brief What a board's linker script says about its memories. Only the addresses have a meaning.
 *
 * Sections that are filled at the start have a copy in flash (load); sections that are cleared
 * have none.
 */
#ifndef KEEL_BSP_CORTEX_M7_MEMORY_H
#define KEEL_BSP_CORTEX_M7_MEMORY_H

#include <stdint.h>

extern const uint32_t keel_vectors[];

/* Code in ITCM. */
extern const uint32_t keel_itcm_load[];
extern uint32_t keel_itcm_start[];
extern uint32_t keel_itcm_end[];

/* Data in DTCM: with values, and without. */
extern const uint32_t keel_dtcm_load[];
extern uint32_t keel_dtcm_start[];
extern uint32_t keel_dtcm_end[];
extern uint32_t keel_dtcm_bss_start[];
extern uint32_t keel_dtcm_bss_end[];

/* All other data. */
extern const uint32_t keel_data_load[];
extern uint32_t keel_data_start[];
extern uint32_t keel_data_end[];
extern uint32_t keel_bss_start[];
extern uint32_t keel_bss_end[];

/* The main stack: a guard that nobody may touch, above it the stack, which grows down to it. */
extern uint32_t keel_stack_guard[];
extern uint32_t keel_stack_bottom[];
extern uint32_t keel_stack_top[];

/* The stack of the fault handler. */
extern uint32_t keel_fault_stack_top[];

#endif
