// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity --external-sat-solver cadical
// sources: src/rtos/lateness.c src/rtos/admission.c src/rtos/queue.c
// sources: specs/model/lateness.c specs/model/admission_queue.c specs/model/queue.c
// replaces: keel_admission_admit
// defines: -DKEEL_QUEUE_CAPACITY=3u
// covers: keel_scheduler_lateness admitted_totals bound_realtime bound_other may_promote
// covers: model_scheduler_lateness
//
// Any arguments; of the state nothing but the queue and the guard is looked at. Bounded to a
// capacity of 3 tasks and to times up to 2^12 us; the contract under WP has no bound and determines
// every field. Whether a task is admitted is an unknown, the same for the code and for the model;
// the demand and the longest other budget are what ADM-002 makes of them.
#include "../../specs/model/admission.h"
#include "../../specs/model/lateness.h"
#include "../common/admission_contracts.h"
#include "../common/keel_scheduler_proof.h"

keel_lateness_t nondet_lateness(void);

static keel_status_t verdict[CAPACITY];

static void any_verdicts(void)
{
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const keel_status_t reasons[4] = {KEEL_OK, KEEL_ERR_REALTIME_DEMAND, KEEL_ERR_BUDGET_GAP,
                                          KEEL_ERR_UTILISATION};

        verdict[i] = reasons[any_below(4u)];
    }
}

/* Of no consequence: the model adds up by itself. */
void model_admission_init(keel_admission_t *admission, uint32_t guard_us,
                          uint32_t utilisation_limit_ppm)
{
    (void)guard_us;
    (void)utilisation_limit_ppm;
    admission->tasks = 0u;
}

keel_status_t model_admission_admit(keel_admission_t *admission, uint32_t priority,
                                    uint32_t period_us, uint32_t budget_us)
{
    const keel_status_t status = verdict[admission->tasks % CAPACITY];

    (void)priority;
    (void)period_us;
    (void)budget_us;
    if (status == KEEL_OK) {
        admission->tasks++;
    }
    return status;
}

keel_status_t keel_admission_admit_stand_in(keel_admission_t *admission, uint32_t priority,
                                            uint32_t period_us, uint32_t budget_us)
{
    keel_admission_t modelled = *admission;
    keel_status_t status;

    __CPROVER_assert(keel_admission_admit_may(admission, period_us, budget_us),
                     "precondition: keel_admission_admit");
    status = model_admission_admit(&modelled, priority, period_us, budget_us);
    if (status == KEEL_OK) {
        if (priority == KEEL_PRIORITY_REALTIME) {
            modelled.realtime_demand_us += budget_us;
        } else if (budget_us > modelled.longest_other_us) {
            modelled.longest_other_us = budget_us;
        }
    }
    *admission = modelled;
    __CPROVER_assume(keel_admission_admit_does(status, admission, &modelled));
    return status;
}

static bool lateness_same(const keel_lateness_t *left, const keel_lateness_t *right)
{
    return (left->late_us == right->late_us) && (left->unpromoted_us == right->unpromoted_us) &&
           (left->promotes == right->promotes) && (left->skips == right->skips);
}

void keel_scheduler_lateness_harness(void)
{
    keel_scheduler_t scheduler;
    keel_lateness_t lateness = nondet_lateness();
    keel_lateness_t expected = lateness;
    const uint32_t x = any_below(CAPACITY);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    const bool wanted = nondet_bool();
    keel_scheduler_t before;
    keel_status_t modelled;
    keel_status_t status;

    any_queue(&scheduler.queue, any_below(CAPACITY + 1u));
    narrow_tasks(&scheduler.queue, 12u);
    scheduler.config.guard_us = any_bits(12u);
    any_verdicts();
    before = scheduler;
    modelled = model_scheduler_lateness(given ? &before : NULL, task, wanted ? &expected : NULL);

    status = keel_scheduler_lateness(given ? &scheduler : NULL, task, wanted ? &lateness : NULL);

    __CPROVER_assert((status == modelled) && lateness_same(&lateness, &expected),
                     "LAT_001_model: as the model says");
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "LAT_001_frame: nothing is written");
}
