/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mavlink_proof.h
 * @brief What the harnesses of MAVLink's frames share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef MAVLINK_PROOF_H
#define MAVLINK_PROOF_H

#include "../../specs/model/mavlink.h"
#include "../common/any_below.h"

#include <stdbool.h>

/* How many messages decoders know here: a number that CBMC sees, so that it looks no further. WP
 * shows the clauses for any number of them. */
#define MESSAGES 3u

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
keel_mavlink_t nondet_mavlink(void);
keel_mavlink_message_t nondet_message(void);

static keel_mavlink_message_t table[MESSAGES];

/* mavlink_table */
static bool table_in_order(uint32_t known)
{
    bool ordered = true;

    for (uint32_t i = 0u; i < MESSAGES; i++) {
        ordered = ordered && ((i >= known) || ((table[i].id <= 0xFFFFFFu) &&
                                               (table[i].shortest <= table[i].longest)));
        ordered = ordered && ((i == 0u) || (i >= known) || (table[i - 1u].id < table[i].id));
    }
    return ordered;
}

static void any_table(void)
{
    for (uint32_t i = 0u; i < MESSAGES; i++) {
        table[i] = nondet_message();
    }
}

/* Any bits, but that a bool is one and that the table is the one here. */
static keel_mavlink_t any_mavlink(void)
{
    keel_mavlink_t mavlink = nondet_mavlink();

    any_table();
    mavlink.messages = table;
    mavlink.known = MESSAGES;
    mavlink.frame.is_signed = nondet_bool();
    return mavlink;
}

static uint32_t id_of(const uint8_t *bytes)
{
    return bytes[7] + ((uint32_t)bytes[8] << 8u) + ((uint32_t)bytes[9] << 16u);
}

/* mavlink_is_of */
static bool is_of(const uint8_t *bytes, const keel_mavlink_message_t *message)
{
    return (message->id == id_of(bytes)) && (message->shortest <= bytes[1]) &&
           (bytes[1] <= message->longest);
}

/* mavlink_valid */
static bool mavlink_valid_here(const keel_mavlink_t *m)
{
    bool valid = (m->held < 280u) && ((m->held == 0u) || (m->header[0] == 0xFDu));

    valid = valid && ((m->held < 3u) ||
                      ((m->header[2] <= 1u) && (m->held < model_mavlink_whole(m->header))));
    if (m->held >= 10u) {
        valid = valid && (m->message <= MESSAGES);
        for (uint32_t i = 0u; i < MESSAGES; i++) {
            valid = valid && ((i != m->message) || is_of(m->header, &table[i]));
        }
    }
    return valid;
}

static keel_mavlink_t any_valid_mavlink(void)
{
    const keel_mavlink_t mavlink = any_mavlink();

    __CPROVER_assume(table_in_order(MESSAGES) && mavlink_valid_here(&mavlink));
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
           (a->others == b->others) && (a->gaps == b->gaps);
}

static bool mavlink_same(const keel_mavlink_t *a, const keel_mavlink_t *b, uint32_t i)
{
    return (a->messages == b->messages) && (a->known == b->known) &&
           mavlink_frame_same(&a->frame, &b->frame, i) &&
           mavlink_count_same(&a->count, &b->count) && (a->held == b->held) && (a->crc == b->crc) &&
           (a->message == b->message) && (a->header[0u] == b->header[0u]) &&
           (a->header[1u] == b->header[1u]) && (a->header[2u] == b->header[2u]) &&
           (a->header[3u] == b->header[3u]) && (a->header[4u] == b->header[4u]) &&
           (a->header[5u] == b->header[5u]) && (a->header[6u] == b->header[6u]) &&
           (a->header[7u] == b->header[7u]) && (a->header[8u] == b->header[8u]) &&
           (a->header[9u] == b->header[9u]) && (a->payload[i] == b->payload[i]) &&
           (a->tail[0u] == b->tail[0u]) && (a->tail[1u] == b->tail[1u]) &&
           (a->tail[2u] == b->tail[2u]) && (a->tail[3u] == b->tail[3u]) &&
           (a->tail[4u] == b->tail[4u]) && (a->tail[5u] == b->tail[5u]) &&
           (a->tail[6u] == b->tail[6u]) && (a->tail[7u] == b->tail[7u]) &&
           (a->tail[8u] == b->tail[8u]) && (a->tail[9u] == b->tail[9u]) &&
           (a->tail[10u] == b->tail[10u]) && (a->tail[11u] == b->tail[11u]) &&
           (a->tail[12u] == b->tail[12u]) && (a->tail[13u] == b->tail[13u]) &&
           (a->tail[14u] == b->tail[14u]);
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
