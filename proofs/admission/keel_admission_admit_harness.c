// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/admission.c
// covers: keel_admission_admit minimum utilisation_of gap_of
//
// Totals, guard and limit have their full width. Bounded to periods up to 2^3 us and budgets below
// 2^6 us, as the utilisation divides. The contract under WP has no such bound.
#include "../common/admission_contracts.h"

/* Any totals, valid or not. */
static keel_admission_t any_totals(void)
{
    keel_admission_t totals;

    totals.guard_us = any_bits64(31u);
    totals.utilisation_limit = any_bits64(20u);
    totals.utilisation = any_bits64(20u);
    totals.realtime_demand_us = any_bits64(31u);
    totals.shortest_realtime_us = nondet_u64();
    totals.shortest_gap_us = nondet_u64();
    totals.longest_other_us = any_bits64(32u);
    totals.tasks = any_below(CAPACITY);
    return totals;
}

void keel_admission_admit_harness(void)
{
    keel_admission_t totals = any_totals();
    const uint32_t priority = nondet_u32();
    const uint32_t period_us = any_bits(3u) + 1u;
    const uint32_t budget_us = any_bits(6u);
    const uint64_t scaled = (uint64_t)budget_us * 1000000u;
    const uint64_t share = any_bits64(SHARE_BITS);
    const keel_admission_t before = totals;
    const keel_admission_t with = totals_with(&before, priority, period_us, budget_us, share);
    keel_status_t status;

    __CPROVER_assume(keel_admission_admit_may(&totals, period_us, budget_us));
    /* C / T in ppm, rounded up: only one number satisfies this. */
    __CPROVER_assume((scaled <= (share * period_us)) &&
                     ((share * period_us) < (scaled + period_us)));

    status = keel_admission_admit(&totals, priority, period_us, budget_us);

    __CPROVER_assert(keel_admission_admit_does(status, &before, &totals, &with),
                     "ADM_004_part: as a whole queue takes it to do");
    __CPROVER_assert(totals_valid(&totals), "ADM_002_valid: the totals stay valid");
    __CPROVER_assert((totals.guard_us == before.guard_us) &&
                         (totals.utilisation_limit == before.utilisation_limit),
                     "ADM_002_limits: the limits stay");
    __CPROVER_assert((status == KEEL_ERR_REALTIME_DEMAND) == !demand_met(&with),
                     "ADM_003_demand: a period would not hold all real-time budgets and 2 W");
    __CPROVER_assert((status == KEEL_ERR_BUDGET_GAP) == (demand_met(&with) && !gap_met(&with)),
                     "ADM_003_gap: a budget would not fit a real-time task's gap");
    __CPROVER_assert((status == KEEL_ERR_UTILISATION) ==
                         (demand_met(&with) && gap_met(&with) &&
                          (with.utilisation > with.utilisation_limit)),
                     "ADM_003_utilisation: the limit would be exceeded");
    if (status != KEEL_OK) {
        __CPROVER_assert(totals_same(&totals, &before), "ADM_002_kept: a refusal keeps the totals");
    } else {
        __CPROVER_assert(totals.tasks == with.tasks, "ADM_002_tasks: one task more");
        __CPROVER_assert(totals.utilisation == with.utilisation,
                         "ADM_002_utilisation: C / T in ppm, rounded up, is added");
        __CPROVER_assert(totals.realtime_demand_us == with.realtime_demand_us,
                         "ADM_002_demand: a real-time budget is added");
        __CPROVER_assert(totals.shortest_realtime_us == with.shortest_realtime_us,
                         "ADM_002_period: the shortest real-time period");
        __CPROVER_assert(totals.shortest_gap_us == with.shortest_gap_us,
                         "ADM_002_gap: the shortest gap");
        __CPROVER_assert(totals.longest_other_us == with.longest_other_us,
                         "ADM_002_other: the longest other budget");
    }
}
