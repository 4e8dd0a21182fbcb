// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 3 --external-sat-solver cadical
// cbmc: --unwindset tried_phase_us.0:5,falls_into.0:9,is_free.0:2,model_spread_divisor.0:5
// sources: src/rtos/spread.c specs/model/spread.c
// replaces: keel_spread_divisor
// defines: -DKEEL_QUEUE_CAPACITY=2u -DKEEL_SPREAD_ROUNDS_MAX=2u
// covers: keel_scheduler_spread place_tasks place_task first_phase_us one_round need_us
// covers: next_other begin_placing not_placed model_scheduler_spread
//
// Any arguments, at any stage. Bounded to 2 tasks, periods and budgets up to 2^2 us and guards up
// to 1 us: 2 rounds are enough there. A third task: keel_scheduler_spread__three_harness, and
// tests/unit/test_spread_specified.c, which goes through all sets of 3 tasks up to 2^3 us.
#include "spread_contracts.h"

/* Of periods up to 2^3 us. The solver sees at once that the bits above are 0. */
uint32_t keel_spread_divisor_stand_in(uint32_t a, uint32_t b)
{
    const uint32_t divisor = any_bits(3u) + 1u;

    __CPROVER_assert(keel_spread_divisor_may(a, b), "precondition: keel_spread_divisor");
    __CPROVER_assume(keel_spread_divisor_does(divisor, a, b));
    return divisor;
}

void keel_scheduler_spread_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const bool given = nondet_bool();
    const bool asked = nondet_bool();
    uint32_t crowded = nondet_u32();
    uint32_t counted = crowded;
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    narrow_tasks(&scheduler.queue, 2u);
    scheduler.config.guard_us = any_bits(1u);
    expected = scheduler;
    modelled = model_scheduler_spread(given ? &expected : NULL, asked ? &counted : NULL);

    status = keel_scheduler_spread(given ? &scheduler : NULL, asked ? &crowded : NULL);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SPR_002_model: as the model says");
    __CPROVER_assert(crowded == counted, "SPR_002_model: as many as it says are not placed");
}
