/**
 * @file board.h
 * @brief What an application needs of a board. Each board implements it; nothing of it names one.
 *
 * Before main() runs, the board has set up its clocks, memories, FPU, memory protection, time base
 * and console, with all outputs off.
 */
#ifndef KEEL_BSP_BOARD_H
#define KEEL_BSP_BOARD_H

#include <stdint.h>

/* Where code and data of real-time tasks lie: memories that the core reaches without waiting. */
#define KEEL_REALTIME_CODE __attribute__((section(".itcm")))
#define KEEL_REALTIME_DATA __attribute__((section(".dtcm_data")))
#define KEEL_REALTIME_ZERO __attribute__((section(".dtcm_bss"))) /* For objects without a value. */

/** The board's name. */
extern const char keel_board_name[];

/**
 * Reads the board's time base, as a scheduler's read_clock.
 *
 * @param context unused
 * @return microseconds; wraps at 2^32
 */
uint32_t keel_board_clock_us(void *context);

/** Writes one character to the console; waits at most as long as two characters take. */
void keel_board_put(char c);

/**
 * Ends the application: interrupts and outputs off.
 *
 * An emulator ends with this exit status; a board stays in its safe state.
 *
 * @param status 0 when all went well
 */
void keel_board_end(int status) __attribute__((noreturn));

#endif
