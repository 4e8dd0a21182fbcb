// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c specs/model/decision.c
// replaces: keel_priority_dynamic
// covers: keel_decision_other priority_of task_fits model_decision_other
// defines: -DKEEL_QUEUE_CAPACITY=2u
//
// Bounded to a capacity of 2 tasks, periods and budgets of 6 bits and times of 10, with which the
// solver comes to an end in a minute. The contract under WP has no bound and determines the choice.
// Eq. 3 is any function with its contract, the same one on both sides.
#include "../../specs/model/decision.h"
#include "../../specs/model/priority.h"
#include "../common/decision_contracts.h"
#include "../common/priority_contracts.h"

uint32_t __CPROVER_uninterpreted_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us);

/* Eq. 3 as the harness knows it: one more than sp while a task is on time and sp * late below T,
 * which the code takes from it. */
static uint32_t eq_3(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    const uint32_t priority = __CPROVER_uninterpreted_dynamic(sp, age_us, period_us);

    __CPROVER_assume(keel_priority_dynamic_does(priority, sp, age_us, period_us));
    return priority;
}

uint32_t model_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    return eq_3(sp, age_us, period_us);
}

uint32_t keel_priority_dynamic_stand_in(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    const uint32_t priority = eq_3(sp, age_us, period_us);

    __CPROVER_assert(keel_priority_dynamic_may(sp, age_us, period_us),
                     "precondition: keel_priority_dynamic");
    __CPROVER_assume(keel_priority_dynamic_does(priority, sp, age_us, period_us));
    return priority;
}

static bool choice_same(const keel_choice_t *a, const keel_choice_t *b)
{
    return (a->earliest_us == b->earliest_us) && (a->position == b->position) &&
           (a->priority == b->priority);
}

void keel_decision_other_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = any_bits64(10u);
    const uint32_t room_us = nondet_u32();
    const bool without_promotion = nondet_bool();
    const uint32_t x = any_below(CAPACITY);
    keel_choice_t choice;
    keel_choice_t expected;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    narrow_tasks(&queue, 6u);
    narrow_releases(&queue, 10u);
    __CPROVER_assume(keel_decision_other_may(&queue, now_us));
    before = queue;
    expected = model_decision_other(&before, now_us, room_us, without_promotion);

    choice = keel_decision_other(&queue, now_us, room_us, without_promotion);

    __CPROVER_assert(keel_decision_other_does(&choice, &queue, now_us),
                     "DEC_003_earliest: as the pass takes it to do");
    __CPROVER_assert(choice_same(&choice, &expected), "DEC_003_model: as the model says");
    __CPROVER_assert(queue_same(&queue, &before, x), "DEC_003_frame: nothing is written");
}
