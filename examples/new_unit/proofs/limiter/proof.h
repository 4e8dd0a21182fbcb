/* SPDX-License-Identifier: Apache-2.0 */
/* What the harnesses of limiter share: any valid state, and when two are the same. */
#ifndef LIMITER_PROOF_H
#define LIMITER_PROOF_H

#include "../../specs/model/limiter.h"

limiter_t nondet_limiter(void);
uint16_t nondet_u16(void);

static limiter_t any_limiter(void)
{
    limiter_t limiter = nondet_limiter();

    __CPROVER_assume(limiter.count <= LIMITER_COUNT_MAX);
    return limiter;
}

static bool limiter_same(const limiter_t *a, const limiter_t *b)
{
    return (a->limit == b->limit) && (a->count == b->count);
}

#endif
