/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file console.h
 * @brief Text on the board's console, without a heap and without the C library's streams.
 */
#ifndef KEEL_BSP_CONSOLE_H
#define KEEL_BSP_CONSOLE_H

#include <stdint.h>

/** Writes a text. */
void keel_console_text(const char *text);

/** Writes a number in decimal. */
void keel_console_number(uint64_t value);

/** Writes a number as 8 hexadecimal digits with 0x before them. */
void keel_console_hex(uint32_t value);

#endif
