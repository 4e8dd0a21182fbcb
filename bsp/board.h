/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file board.h
 * @brief What a board owes: to applications, and to the start-up code, the console and the handler
 *        of faults. Each board implements all of it; nothing of it names one.
 *
 * So all arrows point down to this header: an application and the code that all boards share call
 * what it declares, and a board needs to know neither of them for it.
 *
 * Before main() runs, the board has set up its clocks, memories, FPU, memory protection, time base
 * and console, with all outputs off.
 */
#ifndef KEEL_BSP_BOARD_H
#define KEEL_BSP_BOARD_H

#include "cortex_m7/mpu.h"

#include <stdint.h>

/* Where code and data of real-time tasks lie: memories that the core reaches without waiting. */
#define KEEL_REALTIME_CODE KEEL_REALTIME_LINE(__LINE__)
#define KEEL_REALTIME_DATA __attribute__((section(".dtcm_data")))
#define KEEL_REALTIME_ZERO __attribute__((section(".dtcm_bss"))) /* For objects without a value. */

/* A section for each function, of which the linker drops those that nobody calls. */
#define KEEL_REALTIME_LINE(line)    KEEL_REALTIME_SECTION(line)
#define KEEL_REALTIME_SECTION(line) __attribute__((section(".itcm." #line)))

/* For applications. */

/** The board's name. */
extern const char keel_board_name[];

/**
 * Reads the board's time base, as a scheduler's read_clock.
 *
 * @param context unused
 * @return microseconds; wraps at 2^32
 */
uint32_t keel_board_clock_us(void *context);

/**
 * Sleeps, with the core stopped and all else running: what a main loop does with what
 * keel_scheduler_idle_us says.
 *
 * @param us how long at most
 */
void keel_board_sleep_us(uint32_t us);

/** How long after such a sleep a step reads the clock, at most, in us. Not measured on a chip. */
#define KEEL_BOARD_WAKE_US 2u

/** The longest sleep of a main loop that looks at the console, in us: a character comes each 87 us,
 *  and the chip holds one. */
#define KEEL_BOARD_SLEEP_US 80u

/** Writes one character to the console; waits at most as long as two characters take. */
void keel_board_put(char c);

/** Puts all outputs into their safe state; may be called with anything broken. */
void keel_board_outputs_off(void);

/** Holds them there for as long as what they drive needs to notice it: a reset lets pins float, and
 *  what floats may be read as a pulse. Called before every reset; may be called with anything
 *  broken. */
void keel_board_outputs_hold(void);

/* For the start-up code, in the order in which it needs them. */

/** Its first steps: outputs low. No memory is filled, so it calls nothing in ITCM; keeps to its
 *  stack. */
void keel_board_early(void);

/** Opens the memory that keeps the record of a fault. ITCM is filled, no other memory is. */
void keel_board_open_record(void);

/** The regions for the MPU. */
extern const keel_mpu_region_t keel_board_regions[];
extern const uint32_t keel_board_region_count;

/** Clocks, time base, console; memory is filled, the FPU and the MPU are on. */
void keel_board_start(void);

/** The status of an end in the safe state, after a fault. */
#define KEEL_SAFE_STATUS 70

/**
 * Halts for good, with outputs off and all that was written shown on the console.
 *
 * An emulator ends with this exit status; a board stays as it is and tells it with its lights.
 *
 * @param status 0 when all went well, KEEL_SAFE_STATUS in the safe state
 */
void keel_board_halt(int status) __attribute__((noreturn));

#endif
