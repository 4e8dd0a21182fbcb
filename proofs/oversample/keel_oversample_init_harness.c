// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c
// covers: keel_oversample_init begin
#include "../common/oversample_proof.h"

void keel_oversample_init_harness(void)
{
    keel_oversample_t o = any_oversample();
    const keel_oversample_t before = o;
    const uint16_t factor = nondet_u16();
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));

    status = keel_oversample_init(&o, factor);

    if (factor == 0u) {
        __CPROVER_assert((status == KEEL_ERR_FACTOR) && (o.sum == before.sum) &&
                             (o.count == before.count) && (o.runs == before.runs) &&
                             (o.missed == before.missed) && (o.extra == before.extra) &&
                             (o.factor == before.factor),
                         "OVS_001_refused: a refusal changes nothing");
    } else {
        __CPROVER_assert((status == KEEL_OK) && valid_here(&o) && (o.factor == factor) &&
                             (o.count == 0u) && (o.runs == 0u) && (o.missed == 0u) &&
                             (o.extra == 0u),
                         "OVS_001_ready: nothing is in it");
    }
}
