// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/queue.c
// sources: specs/model/clock.c specs/model/task.c specs/model/decision.c specs/model/priority.c
// sources: specs/model/stats.c specs/model/admission.c specs/model/admission_queue.c
// covers: keel_scheduler_idle_us read_clock model_scheduler_idle_us
//
// How long a pass leaves is the code's on both sides, as keel_pass_idle_us_harness compares it with
// its model: of any scheduler with a time within the limits.
#include "../../specs/model/pass.h"
#include "../../specs/model/scheduler.h"
#include "../common/any_time.h"

uint32_t model_pass_idle_us(const keel_scheduler_t *scheduler, uint32_t raw_us, uint32_t latency_us,
                            uint32_t longest_us)
{
    return keel_pass_idle_us(scheduler, raw_us, latency_us, longest_us);
}

void keel_scheduler_idle_us_harness(void)
{
    keel_scheduler_t scheduler;
    keel_scheduler_t before;
    const uint32_t x = any_below(CAPACITY);
    const keel_scheduler_t *const given = nondet_bool() ? &scheduler : NULL;
    const uint32_t latency_us = nondet_u32();
    const uint32_t longest_us = nondet_u32();
    uint32_t modelled;
    uint32_t idle_us;

    any_time(&scheduler);
    before = scheduler;
    modelled = model_scheduler_idle_us(given, latency_us, longest_us);
    read_again();

    idle_us = keel_scheduler_idle_us(given, latency_us, longest_us);

    __CPROVER_assert((idle_us == modelled) && is_read_as_often(),
                     "SCH_028_model: as the model says");
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "SCH_028_frame: nothing is written");
}
