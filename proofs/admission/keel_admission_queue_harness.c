// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/rtos/admission.c
// replaces: keel_admission_admit
// covers: keel_admission_queue admit_at
// defines: -DKEEL_QUEUE_CAPACITY=2u
//
// Bounded to a capacity of 2 tasks: with 4 the solver takes over a minute. The contract under WP
// has no such bound. Numbers have their full width: the one function that divides is what its
// contract says (admission_contracts.h). What a task adds to the utilisation is any function of
// its period and its budget.
#include "../common/admission_contracts.h"

uint64_t __CPROVER_uninterpreted_share(uint32_t period_us, uint32_t budget_us);

static keel_admission_t with_task(const keel_admission_t *totals, uint32_t priority,
                                  uint32_t period_us, uint32_t budget_us)
{
    const uint64_t share = __CPROVER_uninterpreted_share(period_us, budget_us) &
                           (((uint64_t)1u << SHARE_BITS) - 1u);

    return totals_with(totals, priority, period_us, budget_us, share);
}

keel_status_t keel_admission_admit_stand_in(keel_admission_t *admission, uint32_t priority,
                                            uint32_t period_us, uint32_t budget_us)
{
    const keel_admission_t before = *admission;
    const keel_admission_t with = with_task(&before, priority, period_us, budget_us);
    const keel_status_t status = verdict_on(&with);

    __CPROVER_assert(keel_admission_admit_may(&before, period_us, budget_us),
                     "precondition: keel_admission_admit");
    if (status == KEEL_OK) {
        *admission = with;
    }
    __CPROVER_assume(keel_admission_admit_does(status, &before, admission, &with));
    return status;
}

/* What the first n tasks of the queue come to, for each n. */
static keel_admission_t first[CAPACITY + 1u];

static void add_up(const keel_admission_t *empty, const keel_queue_t *queue)
{
    first[0] = *empty;
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const uint32_t x = slot_at(i);

        first[i + 1u] = with_task(&first[i], queue->priority[x], queue->period_us[x],
                                  queue->budget_us[x]);
    }
}

/* The rules as they are told (demand_admitted, gaps_admitted). */
static bool are_met(const keel_queue_t *queue, uint64_t demand_us, uint64_t guard_us)
{
    bool met = true;

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const uint64_t period_us = queue->period_us[slot_at(i)];
        const uint64_t budget_us = queue->budget_us[slot_at(i)];

        met = met && ((i >= queue->realtime_count) || ((demand_us + (2u * guard_us)) <= period_us));
        for (uint32_t j = i + 1u; j < CAPACITY; j++) {
            met = met && ((i >= queue->realtime_count) || (j < queue->realtime_count) ||
                          (j >= queue->count) ||
                          ((queue->budget_us[slot_at(j)] + guard_us + budget_us) <= period_us));
        }
    }
    return met;
}

void keel_admission_queue_harness(void)
{
    keel_queue_t queue;
    keel_admission_t totals;
    const uint32_t x = any_below(CAPACITY);
    keel_queue_t before;
    keel_admission_t empty;
    keel_admission_t all;
    keel_status_t status;

    any_queue(&queue, CAPACITY);
    keel_admission_init(&totals, any_bits(31u), any_below(KEEL_UTILISATION_FULL_PPM + 1u));
    before = queue;
    empty = totals;
    add_up(&empty, &queue);
    all = first[queue.count];

    status = keel_admission_queue(&totals, &queue);

    __CPROVER_assert(totals_valid(&totals), "ADM_004_valid: the totals are valid");
    __CPROVER_assert((totals.guard_us == empty.guard_us) &&
                         (totals.utilisation_limit == empty.utilisation_limit),
                     "ADM_004_limits: the limits stay");
    __CPROVER_assert(totals.tasks <= queue.count, "ADM_004_range: no more than there are");
    __CPROVER_assert((status == KEEL_OK) == (totals.tasks == queue.count),
                     "ADM_004_all: every task is admitted, or the first that is not is told");
    __CPROVER_assert((totals.tasks > CAPACITY) || totals_same(&totals, &first[totals.tasks]),
                     "ADM_004_totals: those of the first tasks");
    __CPROVER_assert((status == KEEL_OK) || (totals.tasks >= CAPACITY) ||
                         (status == verdict_on(&first[totals.tasks + 1u])),
                     "ADM_004_offender: with the next one they break this rule first");
    __CPROVER_assert((status == KEEL_OK) == (verdict_on(&all) == KEEL_OK),
                     "ADM_004_complete: all are admitted if all together keep the rules");
    __CPROVER_assert((status == KEEL_OK) ==
                         (are_met(&queue, all.realtime_demand_us, all.guard_us) &&
                          (all.utilisation <= all.utilisation_limit)),
                     "ADM_004_told: if each period and each gap has room");
    __CPROVER_assert(queue_same(&queue, &before, x), "ADM_004_frame: the queue is not written");
}
