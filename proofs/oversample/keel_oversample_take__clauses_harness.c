// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c specs/model/range.c
// covers: keel_oversample_take add_excess begin
//
// Each clause that counts, and those of a channel without a sample, without the model: every valid
// channel.
#include "oversample_proof.h"

/* The total with what one number exceeds the other by, if it does. */
static uint32_t total_here(uint32_t total, uint32_t larger, uint32_t smaller)
{
    const uint64_t sum = (uint64_t)total + ((larger > smaller) ? (larger - smaller) : 0u);

    return (sum > UINT32_MAX) ? UINT32_MAX : (uint32_t)sum;
}

void keel_oversample_take__clauses_harness(void)
{
    keel_oversample_t o = any_oversample();
    const keel_oversample_t before = o;
    const float old_mean = nondet_float();
    float mean = old_mean;
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));

    status = keel_oversample_take(&o, &mean);

    __CPROVER_assert((before.count > 0u) || (status == KEEL_ERR_STATE),
                     "OVS_004_none: without a sample there is no mean");
    __CPROVER_assert((status == KEEL_OK) || float_same(mean, old_mean),
                     "OVS_004_stays: without a mean the last one stays");
    __CPROVER_assert(o.missed == total_here(before.missed, o.factor, before.runs),
                     "OVS_006_missed: runs that were missing are counted");
    __CPROVER_assert(o.extra == total_here(before.extra, before.runs, o.factor),
                     "OVS_006_extra: runs that were too many are counted");
}
