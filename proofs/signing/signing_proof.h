/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file signing_proof.h
 * @brief What the harnesses of signatures share: arbitrary states, a hash that may be any function,
 *        and when two states are the same.
 */
#ifndef SIGNING_PROOF_H
#define SIGNING_PROOF_H

#include "../../specs/model/signing.h"
#include "../common/any_below.h"

#include <stdbool.h>

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
uint64_t nondet_u64(void);
keel_signing_t nondet_signing(void);
keel_mavlink_frame_t nondet_frame(void);

/* What the hash of all texts is here, and what it was last asked: how often, of whose text, how
 * many bytes, and one of them, at an arbitrary place. Where two are asked the same, any function
 * gives both the same, so this one stands for any. */
static uint8_t digest_of_all[KEEL_SIGNING_DIGEST_BYTES];
static const keel_signing_t *subject;
static uint32_t asked;
static bool asked_own;
static uint32_t asked_size;
static uint32_t asked_at;
static uint8_t asked_byte;

static void any_hash(const uint8_t *data, uint32_t size, uint8_t *digest)
{
    asked++;
    asked_own = data == subject->text;
    asked_size = size;
    asked_byte = (asked_at < size) ? subject->text[asked_at] : 0u;
    for (uint32_t i = 0u; i < KEEL_SIGNING_DIGEST_BYTES; i++) {
        digest[i] = digest_of_all[i];
    }
}

/* Nothing was asked yet, and what will be is of this one's text. */
static void ask_for(const keel_signing_t *signing)
{
    subject = signing;
    asked = 0u;
    asked_own = true;
    asked_size = 0u;
    asked_byte = 0u;
}

static void begin_hash(void)
{
    for (uint32_t i = 0u; i < KEEL_SIGNING_DIGEST_BYTES; i++) {
        digest_of_all[i] = nondet_u8();
    }
    asked_at = nondet_u32();
    __CPROVER_assume(asked_at < KEEL_SIGNING_TEXT_MAX);
}

/* signing_valid */
static bool signing_valid_here(const keel_signing_t *s)
{
    bool valid = (s->streams <= 8u) && (s->timestamp <= 0xFFFFFFFFFFFFu);

    for (uint32_t j = 0u; j < KEEL_SIGNING_STREAMS; j++) {
        for (uint32_t i = 0u; i < j; i++) {
            valid = valid && ((j >= s->streams) || (s->stream[i].system != s->stream[j].system) ||
                              (s->stream[i].component != s->stream[j].component) ||
                              (s->stream[i].link != s->stream[j].link));
        }
    }
    return valid;
}

/* Any bits, but that a bool is one and that the hash is the one here. */
static keel_signing_t any_signing(void)
{
    keel_signing_t signing = nondet_signing();

    signing.has_key = nondet_bool();
    signing.hash = any_hash;
    begin_hash();
    return signing;
}

static keel_signing_t any_valid_signing(void)
{
    const keel_signing_t signing = any_signing();

    __CPROVER_assume(signing_valid_here(&signing));
    return signing;
}

static keel_mavlink_frame_t any_frame(void)
{
    keel_mavlink_frame_t frame = nondet_frame();

    frame.is_signed = nondet_bool();
    __CPROVER_assume(frame.timestamp <= 0xFFFFFFFFFFFFu);
    return frame;
}

static bool stream_same(const keel_signing_stream_t *a, const keel_signing_stream_t *b)
{
    return (a->timestamp == b->timestamp) && (a->system == b->system) &&
           (a->component == b->component) && (a->link == b->link);
}

static bool is_stream_of(const keel_signing_stream_t *stream, const keel_mavlink_frame_t *frame)
{
    return (stream->system == frame->system) && (stream->component == frame->component) &&
           (stream->link == frame->link);
}

/* But for the text and the counts. */
static bool decisions_same(const keel_signing_t *a, const keel_signing_t *b)
{
    return (a->streams == b->streams) && (a->timestamp == b->timestamp) && (a->hash == b->hash) &&
           (a->link == b->link) && (a->has_key == b->has_key) &&
           stream_same(&a->stream[0u], &b->stream[0u]) &&
           stream_same(&a->stream[1u], &b->stream[1u]) &&
           stream_same(&a->stream[2u], &b->stream[2u]) &&
           stream_same(&a->stream[3u], &b->stream[3u]) &&
           stream_same(&a->stream[4u], &b->stream[4u]) &&
           stream_same(&a->stream[5u], &b->stream[5u]) &&
           stream_same(&a->stream[6u], &b->stream[6u]) &&
           stream_same(&a->stream[7u], &b->stream[7u]);
}

static bool signing_count_same(const keel_signing_count_t *a, const keel_signing_count_t *b)
{
    return (a->accepted == b->accepted) && (a->missing == b->missing) && (a->wrong == b->wrong) &&
           (a->replayed == b->replayed) && (a->old == b->old) && (a->full == b->full);
}

static bool signing_same(const keel_signing_t *a, const keel_signing_t *b, uint32_t i)
{
    return (a->streams == b->streams) && signing_count_same(&a->count, &b->count) &&
           (a->timestamp == b->timestamp) && (a->hash == b->hash) && (a->link == b->link) &&
           (a->has_key == b->has_key) && stream_same(&a->stream[0u], &b->stream[0u]) &&
           stream_same(&a->stream[1u], &b->stream[1u]) &&
           stream_same(&a->stream[2u], &b->stream[2u]) &&
           stream_same(&a->stream[3u], &b->stream[3u]) &&
           stream_same(&a->stream[4u], &b->stream[4u]) &&
           stream_same(&a->stream[5u], &b->stream[5u]) &&
           stream_same(&a->stream[6u], &b->stream[6u]) &&
           stream_same(&a->stream[7u], &b->stream[7u]) && (a->text[i] == b->text[i]);
}

static bool sender_same(const keel_mavlink_sender_t *a, const keel_mavlink_sender_t *b)
{
    return (a->system == b->system) && (a->component == b->component) &&
           (a->sequence == b->sequence) && (a->is_signing == b->is_signing);
}

#endif
