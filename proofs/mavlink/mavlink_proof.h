/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mavlink_proof.h
 * @brief What the harnesses of MAVLink's frames share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef MAVLINK_PROOF_H
#define MAVLINK_PROOF_H

#include "../../specs/model/mavlink.h"

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

static bool mavlink_frame_same(const keel_mavlink_frame_t *a, const keel_mavlink_frame_t *b)
{
    bool same = (a->id == b->id) && (a->sequence == b->sequence) && (a->system == b->system) &&
                (a->component == b->component) && (a->compatible == b->compatible) &&
                (a->length == b->length) && (a->checksum == b->checksum) &&
                (a->is_signed == b->is_signed) && (a->link == b->link) &&
                (a->timestamp == b->timestamp);

    for (uint32_t i = 0u; i < KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        same = same && (a->payload[i] == b->payload[i]);
    }
    for (uint32_t j = 0u; j < KEEL_MAVLINK_SEAL_BYTES; j++) {
        same = same && (a->seal[j] == b->seal[j]);
    }
    return same;
}

static bool mavlink_count_same(const keel_mavlink_count_t *a, const keel_mavlink_count_t *b)
{
    return (a->frames == b->frames) && (a->checksums == b->checksums) &&
           (a->unknown == b->unknown) && (a->lengths == b->lengths) && (a->flags == b->flags) &&
           (a->others == b->others) && (a->gaps == b->gaps);
}

static bool mavlink_same(const keel_mavlink_t *a, const keel_mavlink_t *b)
{
    bool same = (a->messages == b->messages) && (a->known == b->known) &&
                mavlink_frame_same(&a->frame, &b->frame) &&
                mavlink_count_same(&a->count, &b->count) && (a->held == b->held) &&
                (a->crc == b->crc) && (a->message == b->message);

    for (uint32_t i = 0u; i < KEEL_MAVLINK_HEADER_BYTES; i++) {
        same = same && (a->header[i] == b->header[i]);
    }
    for (uint32_t j = 0u; j < KEEL_MAVLINK_PAYLOAD_MAX; j++) {
        same = same && (a->payload[j] == b->payload[j]);
    }
    for (uint32_t k = 0u; k < KEEL_MAVLINK_TAIL_MAX; k++) {
        same = same && (a->tail[k] == b->tail[k]);
    }
    return same;
}

static bool mavlink_sender_same(const keel_mavlink_sender_t *a, const keel_mavlink_sender_t *b)
{
    return (a->system == b->system) && (a->component == b->component) &&
           (a->sequence == b->sequence) && (a->is_signing == b->is_signing);
}

#endif
