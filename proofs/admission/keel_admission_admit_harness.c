// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/admission.c
// covers: keel_admission_admit minimum utilisation_of gap_of
//
// Totals, guard and budgets have their full width. Bounded to periods up to 2^3 us, or budgets of
// up to 2^3: the utilisation divides. The contract under WP has no such bound.
#include "../common/admission_contracts.h"
#include "../common/keel_proof.h"

void keel_admission_admit_harness(void)
{
    keel_admission_t totals;
    keel_admission_t with;
    keel_admission_t before;
    const keel_task_config_t *config;
    uint64_t share;
    keel_status_t status;

    any_task(0u, nondet_bool());
    narrow_task(0u, 3u, 6u);
    config = proof_config[0];
    totals.guard_us = any_bits64(31u);
    totals.utilisation_limit = any_bits64(20u);
    totals.utilisation = any_bits64(20u);
    totals.realtime_demand_us = any_bits64(31u);
    totals.shortest_realtime_us = nondet_u64();
    totals.shortest_gap_us = nondet_u64();
    totals.longest_other_us = any_bits64(32u);
    totals.tasks = any_below(CAPACITY);
    __CPROVER_assume((totals.utilisation_limit <= KEEL_UTILISATION_FULL_PPM) &&
                     (totals.utilisation <= totals.utilisation_limit));
    __CPROVER_assume(demand_met(&totals) && gap_met(&totals));
    before = totals;
    with = totals_with(&totals, config);
    __CPROVER_assume(keel_admission_admit_may(&totals, config));

    status = keel_admission_admit(&totals, config);

    __CPROVER_assert(keel_admission_admit_does(status, &before, &totals, config),
                     "ADM_004_part: as a whole queue takes it to do");
    __CPROVER_assert((status == KEEL_ERR_REALTIME_DEMAND) == !demand_met(&with),
                     "ADM_003_demand: a period would not hold all real-time budgets and 2 W");
    __CPROVER_assert((status == KEEL_ERR_BUDGET_GAP) == (demand_met(&with) && !gap_met(&with)),
                     "ADM_003_gap: a budget would not fit a real-time task's gap");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_UTILISATION) ||
                         (status == KEEL_ERR_REALTIME_DEMAND) || (status == KEEL_ERR_BUDGET_GAP),
                     "ADM_002_status: there is no other reason");
    if (status == KEEL_OK) {
        share = totals.utilisation - before.utilisation;
        __CPROVER_assert((before.utilisation <= totals.utilisation) &&
                             (totals.utilisation <= totals.utilisation_limit),
                         "ADM_002_utilisation: within the limit");
        __CPROVER_assert(((share * config->period_us) >= (config->budget_us * 1000000u)) &&
                             (((share - 1u) * config->period_us) < (config->budget_us * 1000000u)),
                         "ADM_002_utilisation: C / T in ppm, rounded up, is added");
        __CPROVER_assert(totals.realtime_demand_us == with.realtime_demand_us,
                         "ADM_002_demand: a real-time budget is added");
        __CPROVER_assert(totals.shortest_realtime_us == with.shortest_realtime_us,
                         "ADM_002_period: the shortest real-time period");
        __CPROVER_assert(totals.shortest_gap_us == with.shortest_gap_us,
                         "ADM_002_gap: the shortest gap");
        __CPROVER_assert(totals.longest_other_us == with.longest_other_us,
                         "ADM_002_other: the longest other budget");
        __CPROVER_assert(totals.tasks == (before.tasks + 1u), "ADM_002_tasks: one task more");
    } else {
        __CPROVER_assert((totals.utilisation == before.utilisation) &&
                             (totals.realtime_demand_us == before.realtime_demand_us) &&
                             (totals.shortest_realtime_us == before.shortest_realtime_us) &&
                             (totals.shortest_gap_us == before.shortest_gap_us) &&
                             (totals.longest_other_us == before.longest_other_us) &&
                             (totals.tasks == before.tasks),
                         "ADM_003_unchanged: a refusal keeps the totals");
    }
    if (status == KEEL_ERR_UTILISATION) {
        share = (before.utilisation_limit - before.utilisation) * config->period_us;
        __CPROVER_assert(share < (config->budget_us * 1000000u),
                         "ADM_003_utilisation: the limit would be exceeded");
    }
    __CPROVER_assert((totals.guard_us == before.guard_us) &&
                         (totals.utilisation_limit == before.utilisation_limit),
                     "ADM_002_limits: the limits stay");
}
