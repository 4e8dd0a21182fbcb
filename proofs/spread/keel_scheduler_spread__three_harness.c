// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4
// cbmc: --unwindset tried_phase_us.0:6,falls_into.0:11,is_free.0:3,model_spread_divisor.0:6
// sources: src/rtos/spread.c specs/model/spread.c
// replaces: keel_spread_divisor
// defines: -DKEEL_QUEUE_CAPACITY=3u -DKEEL_SPREAD_ROUNDS_MAX=3u
// covers: keel_scheduler_spread place_tasks place_task first_phase_us one_round next_free need_us
// covers: next_other begin_placing not_placed model_scheduler_spread
//
// A third task, which the others send to and fro. Chosen points: every period is 5 us, budgets are
// 1 or 2 us, of which some leave room for two, the declared phases are below 8 us, and there is no
// guard.
#include "spread_contracts.h"

#define PERIOD_US 5u

/* Of periods that are all the same, which is asserted: a constant, as no solver likes to divide. */
uint32_t keel_spread_divisor_stand_in(uint32_t a, uint32_t b)
{
    const uint32_t divisor = PERIOD_US;

    __CPROVER_assert(keel_spread_divisor_may(a, b), "precondition: keel_spread_divisor");
    __CPROVER_assert((a == PERIOD_US) && (b == PERIOD_US), "every period is the same");
    __CPROVER_assume(keel_spread_divisor_does(divisor, a, b));
    return divisor;
}

void keel_scheduler_spread__three_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const bool asked = nondet_bool();
    uint32_t crowded = nondet_u32();
    uint32_t counted = crowded;
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    narrow_tasks(&scheduler.queue, 1u);
    narrow_releases(&scheduler.queue, 3u);
    for (uint32_t y = 0u; y < CAPACITY; y++) {
        scheduler.queue.period_us[y] = PERIOD_US;
    }
    scheduler.config.guard_us = 0u;
    expected = scheduler;
    modelled = model_scheduler_spread(&expected, asked ? &counted : NULL);

    status = keel_scheduler_spread(&scheduler, asked ? &crowded : NULL);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SPR_002_model: as the model says of three tasks");
    __CPROVER_assert(crowded == counted, "SPR_002_model: as many of three are not placed");
}
