// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/pass.c src/rtos/queue.c src/rtos/decision.c src/rtos/priority.c src/rtos/stats.c
// sources: specs/model/pass_idle.c specs/model/clock.c
// covers: keel_pass_idle_us model_pass_idle_us rest least
//
// That no step meanwhile runs a task, and that the step behind the sleep comes no later than a
// release, is WP's: proofs/scheduler/sleeping.c.
#include "../../specs/model/pass.h"
#include "../common/any_time.h"

void keel_pass_idle_us_harness(void)
{
    keel_scheduler_t scheduler;
    keel_scheduler_t before;
    const uint32_t x = any_below(CAPACITY);
    const uint32_t raw_us = nondet_u32();
    const uint32_t latency_us = nondet_u32();
    const uint32_t longest_us = nondet_u32();
    uint32_t modelled;
    uint32_t idle_us;

    any_time(&scheduler);
    before = scheduler;
    modelled = model_pass_idle_us(&scheduler, raw_us, latency_us, longest_us);

    idle_us = keel_pass_idle_us(&scheduler, raw_us, latency_us, longest_us);

    __CPROVER_assert(idle_us == modelled, "SCH_027_model: as the model says");
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "SCH_027_frame: nothing is written");
}
