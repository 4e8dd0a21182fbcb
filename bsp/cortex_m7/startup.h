/**
 * @file startup.h
 * @brief From the reset to main(): what the start-up code of every board does, and what it asks of
 *        the board.
 */
#ifndef KEEL_BSP_CORTEX_M7_STARTUP_H
#define KEEL_BSP_CORTEX_M7_STARTUP_H

#include "cortex_m7/mpu.h"

#include <stdint.h>

/** What every word of the stack holds that was never used. */
#define KEEL_STACK_PAINT 0xC5C5C5C5u

/** The entry of the image. */
void keel_reset(void) __attribute__((noreturn));

/** The most that the main stack was used since the reset, in bytes. */
uint32_t keel_stack_used_b(void);

/** Board: its first steps. ITCM is filled, no other memory is; keeps to its stack. */
void keel_board_early(void);

/** Board: clocks, time base, console; memory is filled, the FPU and the MPU are on. */
void keel_board_start(void);

/** Board: the regions for the MPU. */
extern const keel_mpu_region_t keel_board_regions[];
extern const uint32_t keel_board_region_count;

/** Board: where a reset ends that follows a fault: outputs off, the fault told, no application. */
void keel_board_safe(void) __attribute__((noreturn));

#endif
