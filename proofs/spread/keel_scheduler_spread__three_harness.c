// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// cbmc: --unwindset tried_phase_us.0:6,falls_into.0:11,is_free.0:3,model_spread_divisor.0:6
// sources: src/rtos/spread.c specs/model/spread.c
// replaces: keel_spread_divisor
// defines: -DKEEL_QUEUE_CAPACITY=3u -DKEEL_SPREAD_ROUNDS_MAX=3u
// covers: keel_scheduler_spread place_tasks place_task first_phase_us one_round next_free need_us
// covers: next_other begin_placing not_placed model_scheduler_spread
//
// A third task, which the others send to and fro. Chosen points: every period is 5 us, budgets are
// 1 or 2 us, of which some leave room for two, and there is no guard.
#include "spread_contracts.h"

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
    for (uint32_t y = 0u; y < CAPACITY; y++) {
        scheduler.queue.period_us[y] = 5u;
    }
    scheduler.config.guard_us = 0u;
    expected = scheduler;
    modelled = model_scheduler_spread(&expected, asked ? &counted : NULL);

    status = keel_scheduler_spread(&scheduler, asked ? &crowded : NULL);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SPR_002_model: as the model says of three tasks");
    __CPROVER_assert(crowded == counted, "SPR_002_model: as many of three are not placed");
}
