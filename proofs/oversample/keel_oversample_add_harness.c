// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c
// covers: keel_oversample_add
#include "../common/oversample_proof.h"
#include "../common/unchanged.h"

void keel_oversample_add_harness(void)
{
    keel_oversample_t o = any_oversample();
    const keel_oversample_t before = o;
    keel_oversample_t expected = before;
    const float value = nondet_float();
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));

    status = keel_oversample_add(&o, value);

    __CPROVER_assert(valid_here(&o), "OVS_002_valid: it stays valid");
    __CPROVER_assert(o.runs == ((before.runs < UINT16_MAX) ? (before.runs + 1) : UINT16_MAX),
                     "OVS_002_runs: the run is counted");
    __CPROVER_assert((status == KEEL_ERR_FULL) == (before.runs == UINT16_MAX),
                     "OVS_003_full: no more than 65535 runs");
    __CPROVER_assert((status == KEEL_ERR_VALUE) == (!in_range(value) && (before.runs < UINT16_MAX)),
                     "OVS_003_value: just the samples in range are taken");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_FULL) || (status == KEEL_ERR_VALUE),
                     "OVS_003_status: there is no other reason");
    if (status == KEEL_OK) {
        __CPROVER_assert(((uint32_t)o.count == (before.count + 1u)) &&
                             (o.sum == (before.sum + value)),
                         "OVS_002_count: the sample is in the sum");
        __CPROVER_assert((o.least <= value) && (value <= o.most) && (o.least <= before.least) &&
                             (before.most <= o.most) &&
                             ((o.least == value) || (o.least == before.least)) &&
                             ((o.most == value) || (o.most == before.most)),
                         "OVS_002_hull: and between the smallest and the largest");
    } else {
        expected.runs = o.runs;
        __CPROVER_assert(unchanged(&o, &expected, sizeof(o)),
                         "OVS_003_refused: another is not; the run is all that is counted");
    }
    __CPROVER_assert((status != KEEL_ERR_FULL) || unchanged(&o, &before, sizeof(o)),
                     "STA_001_kept: when the runs are full, nothing changes");
    __CPROVER_assert((o.factor == before.factor) && (o.missed == before.missed) &&
                         (o.extra == before.extra),
                     "OVS_002_frame: the rest stays");
}
