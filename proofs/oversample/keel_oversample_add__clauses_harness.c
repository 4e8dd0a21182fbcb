// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c specs/model/range.c
// covers: keel_oversample_add
//
// Each clause of the contract, without the model: every valid channel, and every value.
#include "oversample_proof.h"

void keel_oversample_add__clauses_harness(void)
{
    keel_oversample_t o = any_oversample();
    const keel_oversample_t before = o;
    const float value = nondet_float();
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));

    status = keel_oversample_add(&o, value);

    __CPROVER_assert(o.runs == ((before.runs < UINT16_MAX) ? (before.runs + 1u) : UINT16_MAX),
                     "OVS_002_runs: each run is counted, up to the largest number");
    __CPROVER_assert((status != KEEL_OK) || (o.count == (before.count + 1u)),
                     "OVS_002_count: a sample that is taken is counted");
    __CPROVER_assert((status == KEEL_OK) ||
                         ((o.count == before.count) && float_same(o.sum, before.sum) &&
                          float_same(o.least, before.least) && float_same(o.most, before.most)),
                     "OVS_003_refused: a sample that is refused does not enter the mean");
    __CPROVER_assert((status == KEEL_ERR_FULL) == (before.runs == UINT16_MAX),
                     "OVS_003_full: refused as full when no more runs can be counted");
    __CPROVER_assert((status == KEEL_ERR_VALUE) == ((before.runs < UINT16_MAX) && !in_range(value)),
                     "OVS_003_value: refused for its value when that is no number in range");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_FULL) || (status == KEEL_ERR_VALUE),
                     "OVS_003_status: nothing else is returned");
}
