// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c specs/model/oversample.c specs/model/range.c
// covers: keel_oversample_take add_excess begin
//
// Means that are whole numbers, and the clamp.
#include "oversample_proof.h"

void keel_oversample_take__exact_harness(void)
{
    const uint32_t quotient = nondet_u16() & 7u;
    const uint32_t least = nondet_u16() & 7u;
    const uint32_t most = nondet_u16() & 7u;
    keel_oversample_t o = any_oversample();
    float mean = -1.0f;
    uint32_t expected = quotient;
    keel_status_t status;

    o.count = nondet_u16() & 7u;
    o.sum = (float)(quotient * o.count);
    o.least = (o.count > 0u) ? (float)least : KEEL_OVERSAMPLE_RANGE;
    o.most = (o.count > 0u) ? (float)most : -KEEL_OVERSAMPLE_RANGE;
    __CPROVER_assume(valid_here(&o));
    if (quotient < least) {
        expected = least;
    } else if (quotient > most) {
        expected = most;
    } else {
        /* The quotient itself. */
    }

    status = keel_oversample_take(&o, &mean);

    __CPROVER_assert((status != KEEL_OK) || (mean == (float)expected),
                     "OVS_004_mean: the sum over the count, or the sample next to it");
}
