/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file serial.h
 * @brief A serial console: text goes into a buffer at once, and to the line when it takes it.
 *
 * Printing must not hold up real-time tasks: 100 characters at 115 200 baud take 8.7 ms. A task
 * only fills the buffer, therefore, and the main loop moves a character on when the line is free.
 */
#ifndef KEEL_BSP_STM32F767_SERIAL_H
#define KEEL_BSP_STM32F767_SERIAL_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/registers/uart.h"

#include <stdbool.h>
#include <stdint.h>

/** Characters that the buffer holds; a power of two. */
#define KEEL_SERIAL_CAPACITY 4096u

/** A console. The caller owns it; only the functions below write it. */
typedef struct keel_serial {
    keel_uart_t *uart;                  /**< The line. */
    uint32_t head;                      /**< Characters put in, modulo 2^32. */
    uint32_t tail;                      /**< Characters sent, modulo 2^32. */
    uint32_t dropped;                   /**< Characters that found no room; stays at its maximum. */
    uint8_t text[KEEL_SERIAL_CAPACITY]; /**< The buffer. */
} keel_serial_t;

/**
 * The divisor for a rate, with 16 samples to a bit (requirement SER-001).
 *
 * @param clock_hz the line's clock
 * @param baud     bits per second, at least 1
 * @param divisor  the content of BRR
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT when the divisor is not 16 to 65535 or the rate is
 *         off by more than 2 %, with divisor as it was
 */
keel_bsp_status_t keel_serial_divisor(uint32_t clock_hz, uint32_t baud, uint32_t *divisor);

/**
 * Starts a console with 8 data bits, no parity, one stop bit (requirement SER-002).
 *
 * @param serial   the console
 * @param uart     the line, with its clock on
 * @param clock_hz the line's clock
 * @param baud     bits per second
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT as keel_serial_divisor, with the line as it was
 */
keel_bsp_status_t keel_serial_start(keel_serial_t *serial, keel_uart_t *uart, uint32_t clock_hz,
                                    uint32_t baud);

/**
 * Puts a character into the buffer; when it is full, it is dropped and counted (SER-003).
 *
 * @param serial    the console
 * @param character the character
 */
void keel_serial_put(keel_serial_t *serial, char character);

/**
 * Sends one character if there is one and the line is free; never waits (requirement SER-004).
 *
 * @param serial the console
 */
void keel_serial_pump(keel_serial_t *serial);

/**
 * Sends all, for the end of a program and for faults (requirement SER-005).
 *
 * @param serial the console
 * @param wait   the bound for each character
 * @return KEEL_BSP_OK, or KEEL_BSP_TIMEOUT when the line takes none within the bound
 */
keel_bsp_status_t keel_serial_flush(keel_serial_t *serial, const keel_wait_t *wait);

/**
 * Takes a character that came, if one did; never waits (requirement SER-006). After an overrun,
 * when characters were lost, it goes on with the next.
 *
 * @param serial    the console
 * @param character the character
 * @return whether one came; else character is as it was
 */
bool keel_serial_get(keel_serial_t *serial, char *character);

#endif
