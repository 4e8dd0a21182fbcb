/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file oversample_proof.h
 * @brief What the CBMC harnesses of the oversampling share.
 */
#ifndef OVERSAMPLE_PROOF_H
#define OVERSAMPLE_PROOF_H

#include "../../specs/model/oversample.h"
#include "../common/same.h"

#include <stdbool.h>

uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
float nondet_float(void); /* Any bit pattern. */

static bool in_range(float x)
{
    return (-KEEL_OVERSAMPLE_RANGE <= x) && (x <= KEEL_OVERSAMPLE_RANGE);
}

/* Each sample adds less than 2^30 to the sum. */
static bool valid_here(const keel_oversample_t *o)
{
    return (o->factor > 0u) && (o->count <= o->runs) && ((-0x1p30f * (float)o->count) <= o->sum) &&
           (o->sum <= (0x1p30f * (float)o->count)) && in_range(o->least) && in_range(o->most) &&
           ((o->count > 0u)
                ? (o->least <= o->most)
                : ((o->least == KEEL_OVERSAMPLE_RANGE) && (o->most == -KEEL_OVERSAMPLE_RANGE)));
}

static bool oversample_same(const keel_oversample_t *a, const keel_oversample_t *b)
{
    return float_same(a->sum, b->sum) && float_same(a->least, b->least) &&
           float_same(a->most, b->most) && (a->missed == b->missed) && (a->extra == b->extra) &&
           (a->count == b->count) && (a->runs == b->runs) && (a->factor == b->factor);
}

static keel_oversample_t any_oversample(void)
{
    keel_oversample_t o;

    o.sum = nondet_float();
    o.least = nondet_float();
    o.most = nondet_float();
    o.missed = nondet_u32();
    o.extra = nondet_u32();
    o.count = nondet_u16();
    o.runs = nondet_u16();
    o.factor = nondet_u16();
    return o;
}

#endif
