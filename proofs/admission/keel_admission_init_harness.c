// cbmc: --unwind 2
// sources: src/rtos/admission.c
// covers: keel_admission_init
#include "../common/admission_contracts.h"

void keel_admission_init_harness(void)
{
    keel_admission_t totals;
    const uint32_t guard_us = any_bits(31u);
    const uint32_t limit = any_below(KEEL_UTILISATION_FULL_PPM + 1u);

    keel_admission_init(&totals, guard_us, limit);

    __CPROVER_assert(totals_valid(&totals), "ADM_001_valid: the totals are valid");
    __CPROVER_assert((totals.guard_us == guard_us) && (totals.utilisation_limit == limit),
                     "ADM_001_limits: the limits are kept");
    __CPROVER_assert((totals.utilisation == 0u) && (totals.realtime_demand_us == 0u) &&
                         (totals.shortest_realtime_us == UINT64_MAX) &&
                         (totals.shortest_gap_us == UINT64_MAX) &&
                         (totals.longest_other_us == 0u) && (totals.tasks == 0u),
                     "ADM_001_empty: the set is empty");
}
