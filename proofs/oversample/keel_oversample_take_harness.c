// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c
// covers: keel_oversample_take add_excess begin
#include "../common/oversample_proof.h"
#include "../common/unchanged.h"

/* total + max(0, larger - smaller), saturated. */
static uint32_t excess(uint32_t total, uint16_t larger, uint16_t smaller)
{
    const uint64_t sum = (uint64_t)total +
                         ((larger > smaller) ? (uint64_t)(uint32_t)(larger - smaller) : 0u);

    return (sum < UINT32_MAX) ? (uint32_t)sum : UINT32_MAX;
}

void keel_oversample_take_harness(void)
{
    keel_oversample_t o = any_oversample();
    const keel_oversample_t before = o;
    float mean = 0.5f;
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));

    status = keel_oversample_take(&o, &mean);

    if (before.count > 0u) {
        __CPROVER_assert((status == KEEL_OK) && (before.least <= mean) && (mean <= before.most),
                         "OVS_004_mean: the mean lies among the samples");
    } else {
        keel_oversample_t expected = before;

        expected.runs = 0u;
        expected.sum = 0.0f;
        expected.missed = o.missed;
        expected.extra = o.extra;
        __CPROVER_assert((status == KEEL_ERR_STATE) && (mean == 0.5f),
                         "OVS_004_none: no sample, no mean");
        __CPROVER_assert(unchanged(&o, &expected, sizeof(o)),
                         "OVS_004_written: the runs are accounted for, and nothing else");
    }
    __CPROVER_assert(valid_here(&o) && (o.count == 0u) && (o.runs == 0u) &&
                         (o.factor == before.factor),
                     "OVS_005_anew: nothing is in it");
    __CPROVER_assert(o.missed == excess(before.missed, before.factor, before.runs),
                     "OVS_006_missed: missing runs are counted");
    __CPROVER_assert(o.extra == excess(before.extra, before.runs, before.factor),
                     "OVS_006_extra: and those too many");
}
