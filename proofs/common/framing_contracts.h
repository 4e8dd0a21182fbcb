/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file framing_contracts.h
 * @brief What the harnesses of keel/middleware/framing.h and of the decoders on it share: arbitrary
 *        bytes of a port, valid ones, and when two are the same.
 */
#ifndef FRAMING_CONTRACTS_H
#define FRAMING_CONTRACTS_H

#include "any_below.h"
#include "keel/internal/middleware/framing.h"

#include <stdbool.h>

uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
keel_framing_t nondet_framing(void);

/* framing_header */
static bool framing_header_here(const keel_framing_t *f, uint8_t byte)
{
    return (byte == f->header[0]) || (byte == f->header[1]) || (byte == f->header[2]) ||
           (byte == f->header[3]);
}

/* framing_begins */
static bool framing_begins_here(const keel_framing_t *f)
{
    return (f->held <= 64u) && ((f->held == 0u) || framing_header_here(f, f->byte[0]));
}

/* framing_valid */
static bool framing_valid_here(const keel_framing_t *f)
{
    return framing_begins_here(f) && (f->held < 64u);
}

/* framing_late */
static bool framing_late_here(const keel_framing_t *f, uint32_t elapsed_us)
{
    return (f->gap_us < UINT32_MAX) &&
           ((f->quiet_us > f->gap_us) || (elapsed_us > (f->gap_us - f->quiet_us)));
}

static bool framing_same(const keel_framing_t *a, const keel_framing_t *b, uint32_t i)
{
    return (a->gap_us == b->gap_us) && (a->quiet_us == b->quiet_us) && (a->gaps == b->gaps) &&
           (a->strays == b->strays) && (a->held == b->held) && (a->byte[i] == b->byte[i]) &&
           (a->header[0u] == b->header[0u]) && (a->header[1u] == b->header[1u]) &&
           (a->header[2u] == b->header[2u]) && (a->header[3u] == b->header[3u]);
}

/* What keel_framing_drop asks for and does, as far as decoders need to know. */
static bool keel_framing_drop_may(const keel_framing_t *f, uint32_t count)
{
    return (1u <= count) && (count <= f->held) && (f->held <= 64u);
}

static bool keel_framing_drop_does(const keel_framing_t *f, uint32_t held, uint32_t count)
{
    return framing_valid_here(f) && ((f->held + count) <= held);
}

/* What is at one place when n bytes are dropped: no header among those dropped behind count of
 * them, and the byte n places behind. */
static bool framing_left_at(const keel_framing_t *f, const keel_framing_t *before, uint32_t count,
                            uint32_t place)
{
    const uint32_t n = (uint32_t)before->held - f->held;

    return ((place < count) || (place >= n) || !framing_header_here(before, before->byte[place])) &&
           ((place >= f->held) || (f->byte[place] == before->byte[n + place]));
}

#endif
