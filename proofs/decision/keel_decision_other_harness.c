// cbmc: --unwind 17
// sources: src/rtos/decision.c src/rtos/priority.c
// replaces: keel_priority_dynamic
// covers: keel_decision_other priority_of fits
// defines: -DKEEL_QUEUE_CAPACITY=2u
//
// Bounded to a capacity of 2 tasks, periods and budgets of 6 bits and times of 10; eq. 3 is what
// its contract says, of which the assertions here need no more than that it is the same for the
// same arguments. The contract under WP has no bound.
#include "../common/decision_contracts.h"
#include "../common/priority_contracts.h"

static keel_queue_t queue;
static uint64_t now_us;

/* The slot that stands for the arguments of eq. 3: the first whose task has them. */
static uint32_t first_like(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    uint32_t x = 0u;

    while ((x < (CAPACITY - 1u)) &&
           ((queue.priority[x] != sp) || (queue.period_us[x] != period_us) ||
            (queue.release_us[x] > now_us) ||
            (((now_us - queue.release_us[x]) + period_us) != age_us))) {
        x++;
    }
    return x;
}

uint32_t keel_priority_dynamic_stand_in(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    const uint32_t priority = proof_priority[first_like(sp, age_us, period_us)];

    __CPROVER_assert(keel_priority_dynamic_may(sp, age_us, period_us),
                     "precondition: keel_priority_dynamic");
    __CPROVER_assume(keel_priority_dynamic_does(priority, sp, age_us, period_us));
    return priority;
}

/* Any dynamic priorities that are a function of what eq. 3 reads; 1 + sp, as it says, while sp *
 * late is below a period. */
static void any_function(void)
{
    any_priorities();
    for (uint32_t x = 0u; x < CAPACITY; x++) {
        if (queue.release_us[x] <= now_us) {
            const uint64_t late_us = now_us - queue.release_us[x];

            proof_priority[x] = proof_priority[first_like(
                queue.priority[x], late_us + queue.period_us[x], queue.period_us[x])];
            __CPROVER_assume((late_us >= queue.period_us[x]) ||
                             ((queue.priority[x] * late_us) >= queue.period_us[x]) ||
                             (proof_priority[x] == (1u + queue.priority[x])));
        }
    }
}

void keel_decision_other_harness(void)
{
    const uint32_t room_us = nondet_u32();
    const uint32_t i = any_below(CAPACITY);
    uint32_t priority;
    keel_choice_t choice;
    keel_queue_t before;

    now_us = any_bits64(10u);
    any_queue(&queue, CAPACITY);
    narrow_tasks(&queue, 6u);
    narrow_releases(&queue, 10u);
    any_function();
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
