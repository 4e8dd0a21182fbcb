// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c
// covers: keel_oversample_init begin
#include "../common/oversample_proof.h"
#include "../common/unchanged.h"

void keel_oversample_init_harness(void)
{
    keel_oversample_t o = any_oversample();
    const keel_oversample_t before = o;
    const uint16_t factor = nondet_u16();
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));

    status = keel_oversample_init(&o, factor);

    if (factor == 0u) {
        __CPROVER_assert(status == KEEL_ERR_FACTOR, "OVS_001_refused: there must be a run");
        __CPROVER_assert(unchanged(&o, &before, sizeof(o)),
                         "STA_001_kept: a refusal changes nothing");
    } else {
        __CPROVER_assert((status == KEEL_OK) && valid_here(&o) && (o.factor == factor) &&
                             (o.count == 0u) && (o.runs == 0u) && (o.missed == 0u) &&
                             (o.extra == 0u),
                         "OVS_001_ready: nothing is in it");
    }
}
