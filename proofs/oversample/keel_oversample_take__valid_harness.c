// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c specs/model/oversample.c specs/model/range.c
// covers: keel_oversample_take add_excess begin
#include "oversample_proof.h"

void keel_oversample_take__valid_harness(void)
{
    keel_oversample_t o = any_oversample();
    const keel_oversample_t before = o;
    float mean = nondet_float();
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));

    status = keel_oversample_take(&o, &mean);

    __CPROVER_assert(valid_here(&o), "OVS_005_anew: it stays valid");
    __CPROVER_assert((status != KEEL_OK) || ((before.least <= mean) && (mean <= before.most)),
                     "OVS_004_mean: the mean lies among the samples");
}
