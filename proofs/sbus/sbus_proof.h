/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sbus_proof.h
 * @brief What the harnesses of the SBUS decoder share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef SBUS_PROOF_H
#define SBUS_PROOF_H

#include "../../specs/model/sbus.h"
#include "../common/any_below.h"

#include <stdbool.h>

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
keel_sbus_t nondet_sbus(void);
keel_sbus_config_t nondet_sbus_config(void);

/* sbus_valid */
static bool sbus_valid_here(const keel_sbus_t *s)
{
    return (s->held < 25u) && ((s->held == 0u) || (s->buffer[0] == 0x0Fu));
}

/* sbus_config */
static bool sbus_config_valid(const keel_sbus_config_t *c)
{
    return (c->lowest <= c->highest) && (c->highest <= 2047u) && (c->gap_us > 0u);
}

static bool sbus_config_same(const keel_sbus_config_t *a, const keel_sbus_config_t *b)
{
    return (a->gap_us == b->gap_us) && (a->lowest == b->lowest) && (a->highest == b->highest) &&
           (a->judged == b->judged);
}

static bool sbus_frame_same(const keel_sbus_frame_t *a, const keel_sbus_frame_t *b)
{
    return (a->digital_17 == b->digital_17) && (a->digital_18 == b->digital_18) &&
           (a->lost == b->lost) && (a->failsafe == b->failsafe) &&
           (a->channel[0u] == b->channel[0u]) && (a->channel[1u] == b->channel[1u]) &&
           (a->channel[2u] == b->channel[2u]) && (a->channel[3u] == b->channel[3u]) &&
           (a->channel[4u] == b->channel[4u]) && (a->channel[5u] == b->channel[5u]) &&
           (a->channel[6u] == b->channel[6u]) && (a->channel[7u] == b->channel[7u]) &&
           (a->channel[8u] == b->channel[8u]) && (a->channel[9u] == b->channel[9u]) &&
           (a->channel[10u] == b->channel[10u]) && (a->channel[11u] == b->channel[11u]) &&
           (a->channel[12u] == b->channel[12u]) && (a->channel[13u] == b->channel[13u]) &&
           (a->channel[14u] == b->channel[14u]) && (a->channel[15u] == b->channel[15u]);
}

static bool sbus_count_same(const keel_sbus_count_t *a, const keel_sbus_count_t *b)
{
    return (a->frames == b->frames) && (a->headers == b->headers) && (a->footers == b->footers) &&
           (a->flags == b->flags) && (a->ranges == b->ranges) && (a->gaps == b->gaps);
}

static bool sbus_same(const keel_sbus_t *a, const keel_sbus_t *b, uint32_t i)
{
    return sbus_config_same(&a->config, &b->config) && sbus_frame_same(&a->frame, &b->frame) &&
           sbus_count_same(&a->count, &b->count) && (a->age_us == b->age_us) &&
           (a->quiet_us == b->quiet_us) && (a->held == b->held) && (a->buffer[i] == b->buffer[i]);
}

/* Any bits, but that a bool is one. */
static keel_sbus_t any_sbus(void)
{
    keel_sbus_t sbus = nondet_sbus();

    sbus.frame.digital_17 = nondet_bool();
    sbus.frame.digital_18 = nondet_bool();
    sbus.frame.lost = nondet_bool();
    sbus.frame.failsafe = nondet_bool();
    return sbus;
}

static void any_bytes(uint8_t *frame)
{
    for (uint32_t i = 0u; i < KEEL_SBUS_BYTES; i++) {
        frame[i] = nondet_u8();
    }
}

/* Whether these bytes of a frame are all that the decoder holds of any. */
static bool holds_just(const keel_sbus_t *s, const uint8_t *frame, uint32_t count)
{
    bool holds = s->held == count;

    for (uint32_t i = 0u; i < KEEL_SBUS_BYTES; i++) {
        holds = holds && ((i >= count) || (s->buffer[i] == frame[i]));
    }
    return holds;
}

/* Whether the last bytes that it holds are these of a frame. */
static bool holds_last(const keel_sbus_t *s, const uint8_t *frame, uint32_t count)
{
    bool holds = s->held >= count;

    for (uint32_t i = 0u; i < KEEL_SBUS_BYTES; i++) {
        holds = holds && ((i >= count) || (s->buffer[(s->held - count) + i] == frame[i]));
    }
    return holds;
}

/* Whether what was published is this frame. */
static bool says(const keel_sbus_frame_t *is, const uint8_t *frame)
{
    bool same = (is->digital_17 == ((frame[23] & 1u) != 0u)) &&
                (is->digital_18 == ((frame[23] & 2u) != 0u)) &&
                (is->lost == ((frame[23] & 4u) != 0u)) &&
                (is->failsafe == ((frame[23] & 8u) != 0u));

    for (uint32_t i = 0u; i < KEEL_SBUS_CHANNELS; i++) {
        same = same && (is->channel[i] == model_sbus_channel(frame, i));
    }
    return same;
}

#endif
