// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c
// replaces: keel_priority_promotion_age_us
// covers: keel_decision_event_us
// defines: -DKEEL_QUEUE_CAPACITY=3u
//
// Bounded to a capacity of 3 tasks, periods and budgets of 6 bits and times of 10; the age of
// promotion is what its contract says, of which the assertions here need no more than that it is
// the same for the same arguments. The contract under WP has no bound.
#include "../common/decision_contracts.h"
#include "../common/priority_contracts.h"

static keel_queue_t queue;
static uint64_t age_us[CAPACITY];

/* The slot that stands for a priority and a period: the first that has them. */
static uint32_t first_like(uint32_t sp, uint32_t period_us)
{
    uint32_t x = 0u;

    while ((x < (CAPACITY - 1u)) &&
           ((queue.priority[x] != sp) || (queue.period_us[x] != period_us))) {
        x++;
    }
    return x;
}

uint64_t keel_priority_promotion_age_us_stand_in(uint32_t sp, uint32_t period_us)
{
    const uint64_t age = age_us[first_like(sp, period_us)];

    __CPROVER_assert(keel_priority_promotion_age_us_may(sp, period_us),
                     "precondition: keel_priority_promotion_age_us");
    __CPROVER_assume(keel_priority_promotion_age_us_does(age, sp, period_us));
    return age;
}

void keel_decision_event_us_harness(void)
{
    const uint64_t now_us = any_bits64(10u);
    const uint32_t i = any_below(CAPACITY);
    bool met = false;
    uint64_t event_us;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    narrow_tasks(&queue, 6u);
    narrow_releases(&queue, 10u);
    any_priorities();
    for (uint32_t x = 0u; x < CAPACITY; x++) {
        const uint32_t like = first_like(queue.priority[x], queue.period_us[x]);

        age_us[x] = any_bits64(11u);
        __CPROVER_assume(age_us[like] >= queue.period_us[x]);
        if (queue.release_us[x] <= KEEL_CLOCK_TIME_LIMIT_US) {
            proof_promotion_us[x] = queue.release_us[x] + (age_us[like] - queue.period_us[x]);
        }
    }
    before = queue;

    __CPROVER_assume(keel_decision_event_us_may(&queue, now_us));
    event_us = keel_decision_event_us(&queue, now_us);

    __CPROVER_assert(keel_decision_event_us_does(event_us, &queue, now_us, i),
                     "DEC_004_bound: no other task is released or promoted before it");
    for (uint32_t k = 0u; k < CAPACITY; k++) {
        met = met ||
              (is_other(&queue, k) && (event_us == event_of(&queue, queue.order[k], now_us)));
    }
    __CPROVER_assert(met || (event_us == KEEL_TIME_NEVER_US),
                     "DEC_004_exact: it is a release or a promotion of some other task");
    __CPROVER_assert(queue_same(&queue, &before, i), "DEC_004_frame: nothing is written");
}
