// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c specs/model/decision.c
// replaces: keel_priority_promotion_age_us
// covers: keel_decision_event_us event_of model_decision_event_us
// defines: -DKEEL_QUEUE_CAPACITY=3u
//
// Bounded to a capacity of 3 tasks, with which the solver comes to an end in a minute; the contract
// under WP has no bound and determines the time. The age of promotion is any function of a priority
// and a period, the same one on both sides.
#include "../../specs/model/decision.h"
#include "../../specs/model/priority.h"
#include "../common/decision_contracts.h"
#include "../common/priority_contracts.h"

uint64_t __CPROVER_uninterpreted_age_us(uint32_t sp, uint32_t period_us);

uint64_t model_priority_promotion_age_us(uint32_t sp, uint32_t period_us)
{
    const uint64_t age_us = __CPROVER_uninterpreted_age_us(sp, period_us);

    __CPROVER_assume(keel_priority_promotion_age_us_does(age_us, sp, period_us));
    return age_us;
}

uint64_t keel_priority_promotion_age_us_stand_in(uint32_t sp, uint32_t period_us)
{
    const uint64_t age_us = __CPROVER_uninterpreted_age_us(sp, period_us);

    __CPROVER_assert(keel_priority_promotion_age_us_may(sp, period_us),
                     "precondition: keel_priority_promotion_age_us");
    __CPROVER_assume(keel_priority_promotion_age_us_does(age_us, sp, period_us));
    return age_us;
}

void keel_decision_event_us_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = nondet_u64();
    const bool without_promotion = nondet_bool();
    const uint32_t x = any_below(CAPACITY);
    uint64_t expected_us;
    uint64_t event_us;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    __CPROVER_assume(keel_decision_event_us_may(&queue, now_us));
    before = queue;
    expected_us = model_decision_event_us(&before, now_us, without_promotion);

    event_us = keel_decision_event_us(&queue, now_us, without_promotion);

    __CPROVER_assert(keel_decision_event_us_does(event_us, expected_us),
                     "DEC_004_model: as the model says");
    __CPROVER_assert(queue_same(&queue, &before, x), "DEC_004_frame: nothing is written");
}
