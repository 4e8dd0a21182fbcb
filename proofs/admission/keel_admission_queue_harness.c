// cbmc: --unwind 6 --external-sat-solver cadical
// sources: src/rtos/admission.c
// replaces: keel_admission_admit
// covers: keel_admission_queue
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// Bounded to a capacity of 4 tasks, with numbers of their full width: the one function that
// divides is what its contract says (admission_contracts.h).
#include "../common/admission_contracts.h"
#include "../common/keel_proof.h"

static keel_status_t any_answer(void)
{
    static const keel_status_t answer[4] = {KEEL_OK, KEEL_ERR_REALTIME_DEMAND, KEEL_ERR_BUDGET_GAP,
                                            KEEL_ERR_UTILISATION};

    return answer[any_bits(2u)];
}

keel_status_t keel_admission_admit_stand_in(keel_admission_t *admission,
                                            const keel_task_config_t *config)
{
    const keel_admission_t before = *admission;
    const keel_status_t status = any_answer();

    __CPROVER_assert(keel_admission_admit_may(admission, config),
                     "precondition: keel_admission_admit");
    admission->utilisation = nondet_u64();
    if (status == KEEL_OK) {
        const uint64_t utilisation = admission->utilisation;

        *admission = totals_with(&before, config);
        admission->utilisation = utilisation;
    }
    __CPROVER_assume(keel_admission_admit_does(status, &before, admission, config));
    return status;
}

void keel_admission_queue_harness(void)
{
    keel_queue_t queue;
    keel_admission_t totals;
    const uint32_t r = any_below(CAPACITY);
    const uint32_t o = any_below(CAPACITY);
    uint64_t demand_us = 0u;
    keel_status_t status;

    any_queue(&queue);
    assume_checked(CAPACITY);
    keel_admission_init(&totals, any_bits(31u), any_below(KEEL_UTILISATION_FULL_PPM + 1u));
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        if (i < queue.realtime_count) {
            demand_us += proof_config[i]->budget_us;
        }
    }

    status = keel_admission_queue(&totals, &queue);

    __CPROVER_assert((status == KEEL_OK) == (totals.tasks == queue.count),
                     "ADM_004_all: every task is admitted");
    __CPROVER_assert(totals.tasks <= queue.count, "ADM_004_offender: or the first that is not");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_REALTIME_DEMAND) ||
                         (status == KEEL_ERR_BUDGET_GAP) || (status == KEEL_ERR_UTILISATION),
                     "ADM_004_status: with its reason");
    __CPROVER_assert((totals.utilisation <= totals.utilisation_limit),
                     "ADM_004_utilisation: within the limit");
    if ((status == KEEL_OK) && (r < queue.realtime_count)) {
        const keel_task_config_t *const realtime = proof_config[r];

        __CPROVER_assert(totals.realtime_demand_us == demand_us,
                         "ADM_004_totals: the sum of the real-time budgets");
        __CPROVER_assert((demand_us + (2u * totals.guard_us)) <= realtime->period_us,
                         "ADM_004_demand: each real-time period holds all budgets and 2 W");
        __CPROVER_assert((o < queue.realtime_count) || (queue.count <= o) ||
                             (((uint64_t)proof_config[o]->budget_us + totals.guard_us +
                               realtime->budget_us) <= realtime->period_us),
                         "ADM_004_gaps: each other budget and W fit what a real-time task leaves");
    }
}
