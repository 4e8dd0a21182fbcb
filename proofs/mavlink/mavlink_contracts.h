/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mavlink_contracts.h
 * @brief What the harnesses of MAVLink's frames share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef MAVLINK_CONTRACTS_H
#define MAVLINK_CONTRACTS_H

#include "../../specs/model/mavlink.h"
#include "../common/any_below.h"

#include <stdbool.h>

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
keel_mavlink_t nondet_mavlink(void);
keel_mavlink_message_t nondet_message(void);

/* All that may be known, drawn at once: one by one takes CBMC longer. */
typedef struct {
    keel_mavlink_message_t messages[KEEL_MAVLINK_MESSAGES_MAX];
} table_t;

table_t nondet_table(void);

static table_t table;

/* Any bits, but that a bool is one and that the table is the one here. */
static keel_mavlink_t any_mavlink(void)
{
    keel_mavlink_t mavlink = nondet_mavlink();

    table = nondet_table();
    mavlink.messages = table.messages;
    mavlink.frame.is_signed = nondet_bool();
    return mavlink;
}

static uint32_t id_of(const uint8_t *bytes)
{
    return bytes[7] + ((uint32_t)bytes[8] << 8u) + ((uint32_t)bytes[9] << 16u);
}

/* mavlink_fits */
static bool fits_here(const uint8_t *bytes, const keel_mavlink_message_t *message)
{
    return (bytes[2] <= 1u) && (message->id == id_of(bytes)) && (message->shortest <= bytes[1]) &&
           (bytes[1] <= message->longest);
}

/* mavlink_whole */
static uint32_t whole_here(const uint8_t *bytes)
{
    return 12u + bytes[1] + ((bytes[2] == 0u) ? 0u : 13u);
}

/* mavlink_valid */
static bool mavlink_valid_here(const keel_mavlink_t *m)
{
    const bool begins = (m->held <= 280u) && ((m->held == 0u) || (m->bytes[0] == 0xFDu));

    return begins && ((m->awaited == 10u) || ((m->held >= 10u) && (m->message < m->known) &&
                                              (m->awaited == whole_here(m->bytes)) &&
                                              fits_here(m->bytes, &table.messages[m->message])));
}

/* Also of tables that are in no order. */
static keel_mavlink_t any_valid_mavlink(void)
{
    const keel_mavlink_t mavlink = any_mavlink();

    __CPROVER_assume((mavlink.known <= 256u) && mavlink_valid_here(&mavlink));
    return mavlink;
}

static bool mavlink_frame_same(const keel_mavlink_frame_t *a, const keel_mavlink_frame_t *b,
                               uint32_t i)
{
    return (a->id == b->id) && (a->sequence == b->sequence) && (a->system == b->system) &&
           (a->component == b->component) && (a->compatible == b->compatible) &&
           (a->length == b->length) && (a->checksum == b->checksum) &&
           (a->is_signed == b->is_signed) && (a->link == b->link) &&
           (a->timestamp == b->timestamp) && (a->payload[i] == b->payload[i]) &&
           (a->seal[0u] == b->seal[0u]) && (a->seal[1u] == b->seal[1u]) &&
           (a->seal[2u] == b->seal[2u]) && (a->seal[3u] == b->seal[3u]) &&
           (a->seal[4u] == b->seal[4u]) && (a->seal[5u] == b->seal[5u]);
}

static bool mavlink_count_same(const keel_mavlink_count_t *a, const keel_mavlink_count_t *b)
{
    return (a->frames == b->frames) && (a->checksums == b->checksums) &&
           (a->unknown == b->unknown) && (a->lengths == b->lengths) && (a->flags == b->flags) &&
           (a->gaps == b->gaps) && (a->others == b->others);
}

static bool mavlink_same(const keel_mavlink_t *a, const keel_mavlink_t *b, uint32_t i)
{
    return (a->messages == b->messages) && (a->known == b->known) &&
           mavlink_frame_same(&a->frame, &b->frame, (i < 255u) ? i : 0u) &&
           mavlink_count_same(&a->count, &b->count) && (a->message == b->message) &&
           (a->held == b->held) && (a->awaited == b->awaited) && (a->bytes[i] == b->bytes[i]);
}

/* What keel_mavlink_drop asks for and does, as far as its callers need to know. */
static bool keel_mavlink_drop_may(const keel_mavlink_t *m, uint32_t count)
{
    return (1u <= count) && (count <= m->held) && (m->held <= 280u);
}

static bool keel_mavlink_drop_does(const keel_mavlink_t *m, uint32_t held, uint32_t count)
{
    return ((m->held + count) <= held) && ((m->held == 0u) || (m->bytes[0] == 0xFDu)) &&
           (m->awaited == 10u);
}

/* What keel_mavlink_look asks for and does, as far as its callers need to know. */
static bool keel_mavlink_look_may(const keel_mavlink_t *m)
{
    return mavlink_valid_here(m);
}

static bool keel_mavlink_look_does(const keel_mavlink_t *m)
{
    return mavlink_valid_here(m);
}

static bool mavlink_packet_same(const keel_mavlink_packet_t *a, const keel_mavlink_packet_t *b,
                                uint32_t i)
{
    return a->bytes[i] == b->bytes[i];
}

static bool mavlink_sender_same(const keel_mavlink_sender_t *a, const keel_mavlink_sender_t *b)
{
    return (a->system == b->system) && (a->component == b->component) &&
           (a->sequence == b->sequence) && (a->is_signing == b->is_signing);
}

#endif
