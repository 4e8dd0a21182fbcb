// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/pass.c src/rtos/queue.c src/rtos/decision.c src/rtos/priority.c src/rtos/stats.c
// sources: specs/model/pass.c specs/model/clock.c specs/model/queue.c specs/model/decision.c
// sources: specs/model/priority.c specs/model/stats.c
// covers: keel_pass_begin model_pass_begin
//
// That a step which opens no pass leaves nothing due (SCH_011_idle) and the wake-up time right
// (SCH_012_wake) follows of what is written here, and is WP's: it multiplies priorities and ages.
#include "../../specs/model/pass.h"
#include "../common/keel_scheduler_proof.h"

void keel_pass_begin_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const uint32_t raw_us = nondet_u32();
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    expected = scheduler;
    modelled = model_pass_begin(&expected, raw_us);

    status = keel_pass_begin(&scheduler, raw_us);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SCH_011_model: as the model says");
}
