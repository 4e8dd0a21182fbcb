/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ulog_proof.h
 * @brief What the harnesses of the writer of ULog share: arbitrary names and messages, and when two
 *        messages are the same.
 */
#ifndef ULOG_PROOF_H
#define ULOG_PROOF_H

#include "../../specs/model/ulog.h"
#include "../common/any_below.h"

#include <stdbool.h>

/* Characters of a text: so many that some do not fit. */
#define TEXT_MOST 36u

char nondet_char(void);
bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint64_t nondet_u64(void);
keel_ulog_message_t nondet_message(void);
keel_ulog_name_t nondet_name(void);
keel_ulog_field_t nondet_field(void);
keel_ulog_format_t nondet_format(void);

/* Whatever was in it. */
static keel_ulog_message_t any_message(void)
{
    keel_ulog_message_t message = nondet_message();

    message.overflowed = nondet_bool();
    return message;
}

static void any_text(char *text)
{
    for (uint32_t i = 0u; i < TEXT_MOST; i++) {
        text[i] = nondet_char();
    }
}

static void any_bytes(uint8_t *bytes)
{
    for (uint32_t i = 0u; i < TEXT_MOST; i++) {
        bytes[i] = nondet_u8();
    }
}

static uint8_t any_length(void)
{
    const uint8_t length = nondet_u8();

    __CPROVER_assume(length <= TEXT_MOST);
    return length;
}

static uint8_t any_count(void)
{
    const uint8_t count = nondet_u8();

    __CPROVER_assume(count <= 8u);
    return count;
}

static bool message_same(const keel_ulog_message_t *a, const keel_ulog_message_t *b, uint32_t i)
{
    return (a->size == b->size) && (a->overflowed == b->overflowed) && (a->bytes[i] == b->bytes[i]);
}

#endif
