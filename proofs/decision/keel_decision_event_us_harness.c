// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c
// replaces: keel_priority_promotion_age_us
// covers: keel_decision_event_us
// defines: -DKEEL_QUEUE_CAPACITY=2u
//
// Bounded to a capacity of 2 tasks, periods of 6 bits and times of 10: the age of promotion, of which its
// contract stands in (priority_contracts.h), is asked for each of them. The contract under WP has no
// such bound.
#include "../common/decision_contracts.h"
#include "../common/priority_contracts.h"

uint64_t keel_priority_promotion_age_us_stand_in(uint32_t sp, uint32_t period_us)
{
    const uint64_t age_us = any_bits64(35u);

    __CPROVER_assert(keel_priority_promotion_age_us_may(sp, period_us),
                     "precondition: keel_priority_promotion_age_us");
    __CPROVER_assume(keel_priority_promotion_age_us_does(age_us, sp, period_us));
    return age_us;
}

void keel_decision_event_us_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = any_bits64(10u);
    const uint32_t i = any_below(CAPACITY);
    bool met = false;
    uint64_t event_us;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    narrow_tasks(&queue, 6u);
    narrow_releases(&queue, 10u);
    before = queue;

    __CPROVER_assume(keel_decision_event_us_may(&queue, now_us));
    event_us = keel_decision_event_us(&queue, now_us);

    __CPROVER_assert(keel_decision_event_us_does(event_us, &queue, now_us, i),
                     "DEC_004_bound: no other task is released or promoted before it");
    for (uint32_t k = 0u; k < CAPACITY; k++) {
        met = met || (is_other(&queue, k) && is_event(&queue, queue.order[k], now_us, event_us));
    }
    __CPROVER_assert(met || (event_us == KEEL_TIME_NEVER_US),
                     "DEC_004_exact: it is a release or a promotion of some other task");
    __CPROVER_assert(queue_same(&queue, &before, i), "DEC_004_frame: nothing is written");
}
