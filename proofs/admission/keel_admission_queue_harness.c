// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity --external-sat-solver cadical
// sources: src/rtos/admission.c specs/model/admission_queue.c
// replaces: keel_admission_admit
// defines: -DKEEL_QUEUE_CAPACITY=8u
// covers: keel_admission_queue admit_at model_admission_queue
//
// Bounded to a capacity of 8 tasks, with which the solver comes to an end in half a minute.
// What each task comes to is an unknown, the same for the code and for the model: the i-th task's
// totals and verdict. So the code admits the tasks in order, each with the totals of those before
// it, up to the first that is refused. That the rules for all tasks together follow is WP's.
#include "../../specs/model/admission.h"
#include "admission_proof.h"

static keel_queue_t queue;
static keel_admission_t told[CAPACITY + 1u]; /* The totals of the first i tasks. */
static keel_status_t verdict[CAPACITY];
static uint32_t tasks; /* How many were admitted. */

static keel_status_t answer(keel_admission_t *admission, uint32_t i)
{
    if (verdict[i] == KEEL_OK) {
        *admission = told[i + 1u];
    }
    return verdict[i];
}

keel_status_t model_admission_admit(keel_admission_t *admission, uint32_t priority,
                                    uint32_t period_us, uint32_t budget_us)
{
    const uint32_t x = queue.order[tasks % CAPACITY];

    __CPROVER_assert((priority == queue.priority[x]) && (period_us == queue.period_us[x]) &&
                         (budget_us == queue.budget_us[x]),
                     "ADM_004_order: the model admits one task after the other");
    return answer(admission, tasks++);
}

keel_status_t keel_admission_admit_stand_in(keel_admission_t *admission, uint32_t priority,
                                            uint32_t period_us, uint32_t budget_us)
{
    const uint32_t x = queue.order[tasks % CAPACITY];
    keel_admission_t modelled = *admission;
    keel_status_t status;

    __CPROVER_assert(keel_admission_admit_may(admission, period_us, budget_us),
                     "precondition: keel_admission_admit");
    __CPROVER_assert(totals_same(admission, &told[tasks]) && (priority == queue.priority[x]) &&
                         (period_us == queue.period_us[x]) && (budget_us == queue.budget_us[x]),
                     "ADM_004_asked: each task in order, with the totals of those before it");
    status = answer(&modelled, tasks);
    *admission = modelled;
    tasks++;
    __CPROVER_assume(keel_admission_admit_does(status, admission, &modelled));
    return status;
}

/* Any totals and verdicts; those of the first i tasks count i. */
static void any_answers(void)
{
    for (uint32_t i = 0u; i <= CAPACITY; i++) {
        told[i] = any_totals();
        told[i].tasks = i;
    }
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const keel_status_t reasons[4] = {KEEL_OK, KEEL_ERR_REALTIME_DEMAND, KEEL_ERR_BUDGET_GAP,
                                          KEEL_ERR_UTILISATION};

        verdict[i] = reasons[any_below(4u)];
    }
}

void keel_admission_queue_harness(void)
{
    const uint32_t x = any_below(CAPACITY);
    keel_queue_t before;
    keel_admission_t totals;
    keel_admission_t expected;
    keel_status_t modelled;
    keel_status_t status;

    any_queue(&queue, CAPACITY);
    any_answers();
    before = queue;
    totals = told[0];
    expected = totals;
    modelled = model_admission_queue(&expected, &queue);
    tasks = 0u;

    __CPROVER_assume(keel_admission_queue_may(&totals, &queue));
    status = keel_admission_queue(&totals, &queue);

    __CPROVER_assert(keel_admission_queue_does(status, &totals, &queue),
                     "ADM_004_all: every task is admitted, or the first that is not is told");
    __CPROVER_assert((status == modelled) && totals_same(&totals, &expected),
                     "ADM_004_model: as the model says");
    __CPROVER_assert(queue_same(&queue, &before, x), "ADM_004_frame: the queue is not written");
}
