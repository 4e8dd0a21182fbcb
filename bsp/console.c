/* SPDX-License-Identifier: Apache-2.0 */
#include "console.h"

#include "board.h"

#define DECIMAL_DIGITS 20u /* Of 2^64 - 1. */
#define HEX_DIGITS     8u
#define HEX_BITS       4u

void keel_console_text(const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        keel_board_put(*c);
    }
}

void keel_console_number(uint64_t value)
{
    char digit[DECIMAL_DIGITS];
    uint32_t count = 0u;
    uint64_t rest = value;

    do {
        digit[count] = (char)('0' + (int)(rest % 10u));
        count++;
        rest /= 10u;
    } while (rest > 0u);
    while (count > 0u) {
        count--;
        keel_board_put(digit[count]);
    }
}

void keel_console_hex(uint32_t value)
{
    static const char digit[] = "0123456789abcdef";

    keel_console_text("0x");
    for (uint32_t i = HEX_DIGITS; i > 0u; i--) {
        keel_board_put(digit[(value >> (HEX_BITS * (i - 1u))) & 0xFu]);
    }
}
