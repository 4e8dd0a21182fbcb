// cbmc: --unwind 17
// sources: src/rtos/decision.c src/rtos/priority.c
// replaces: keel_priority_dynamic
// covers: keel_decision_other priority_of fits
// defines: -DKEEL_QUEUE_CAPACITY=2u
//
// Bounded to a capacity of 2 tasks, periods and budgets of 6 bits and times of 10: eq. 3, of which its
// contract stands in (priority_contracts.h), is evaluated for each of them. The contract under WP has
// no such bound.
#include "../common/decision_contracts.h"
#include "../common/priority_contracts.h"

uint32_t keel_priority_dynamic_stand_in(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    const uint32_t priority = nondet_u32();

    __CPROVER_assert(keel_priority_dynamic_may(sp, age_us, period_us),
                     "precondition: keel_priority_dynamic");
    __CPROVER_assume(keel_priority_dynamic_does(priority, sp, age_us, period_us));
    return priority;
}

void keel_decision_other_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = any_bits64(10u);
    const uint32_t room_us = nondet_u32();
    const uint32_t i = any_below(CAPACITY);
    uint32_t priority;
    keel_choice_t choice;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    narrow_tasks(&queue, 6u);
    narrow_releases(&queue, 10u);
    before = queue;

    __CPROVER_assume(keel_decision_other_may(&queue, now_us));
    choice = keel_decision_other(&queue, now_us, room_us);

    __CPROVER_assert(keel_decision_other_does(&choice, &queue, now_us, room_us, i),
                     "DEC_003_part: as the pass takes it to do");
    priority = competing(&queue, i, now_us, room_us);
    __CPROVER_assert(choice.priority <= KEEL_PRIORITY_REALTIME, "DEC_003_range: within the scale");
    __CPROVER_assert(!is_other(&queue, i) ||
                         (choice.earliest_us <= queue.release_us[queue.order[i]]),
                     "DEC_003_earliest: no other task is released before it");
    __CPROVER_assert(is_some_release(&queue, queue.realtime_count, queue.count, choice.earliest_us),
                     "DEC_003_earliest: it is another task's release, or never");
    if (choice.priority > 0u) {
        __CPROVER_assert(is_other(&queue, choice.position) &&
                             ((i != choice.position) || (choice.priority == priority)),
                         "DEC_003_eligible: it is eligible, with its dynamic priority");
        __CPROVER_assert(priority <= choice.priority,
                         "DEC_003_highest: no eligible task has a higher dynamic priority");
        __CPROVER_assert((i >= choice.position) || (priority < choice.priority),
                         "DEC_003_first: nor one before it the same");
    } else {
        __CPROVER_assert(priority == 0u, "DEC_003_none: none is eligible");
    }
    __CPROVER_assert(queue_same(&queue, &before, i), "DEC_003_frame: nothing is written");
}
