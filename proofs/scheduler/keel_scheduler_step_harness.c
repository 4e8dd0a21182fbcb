// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/admission.c specs/model/admission_queue.c
// replaces: keel_pass_run
// covers: keel_scheduler_step keel_pass_begin read_clock model_scheduler_step
//
// What a pass does to the scheduler is the same unknown for the code and for the model, as far as
// the pass' contract goes (step_contracts.h); beginning one is the code's on both sides, as
// keel_pass_begin_harness compares it with its model.
#include "../../specs/model/pass.h"
#include "../../specs/model/scheduler.h"
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

static uint32_t x;                /* The position and slot at which all is seen. */
static keel_scheduler_t opened;   /* The scheduler that the model's pass is run on, */
static keel_scheduler_t passed;   /* what it leaves behind, */
static keel_status_t pass_status; /* and says. */
static uint32_t passes;

keel_status_t model_pass_begin(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    return keel_pass_begin(scheduler, raw_us);
}

keel_status_t model_pass_run(keel_scheduler_t *scheduler)
{
    opened = *scheduler;
    passes++;
    __CPROVER_assume(keel_pass_run_does(pass_status, &passed));
    scheduler->stage = passed.stage;
    scheduler->clock = passed.clock;
    scheduler->wake_us = passed.wake_us;
    scheduler->busy_us = passed.busy_us;
    scheduler->cursor = passed.cursor;
    scheduler->running = passed.running;
    return pass_status;
}

keel_status_t keel_pass_run_stand_in(keel_scheduler_t *scheduler)
{
    __CPROVER_assert(keel_pass_run_may(scheduler), "precondition: keel_pass_run");
    __CPROVER_assert((passes == 1u) && scheduler_same(scheduler, &opened, x),
                     "SCH_020_sequence: a pass that opens is run, once");
    passes--;
    scheduler->stage = passed.stage;
    scheduler->clock = passed.clock;
    scheduler->wake_us = passed.wake_us;
    scheduler->busy_us = passed.busy_us;
    scheduler->cursor = passed.cursor;
    scheduler->running = passed.running;
    __CPROVER_assume(keel_pass_run_does(pass_status, scheduler));
    return pass_status;
}

void keel_scheduler_step_harness(void)
{
    keel_scheduler_t scheduler;
    const bool given = nondet_bool();
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    x = any_below(CAPACITY);
    pass_status = nondet_bool() ? KEEL_OK : KEEL_ERR_CLOCK;
    passed.stage = nondet_s16();
    passed.clock.now_us = nondet_u64();
    passed.clock.raw_us = nondet_u32();
    passed.wake_us = nondet_u64();
    passed.busy_us = nondet_u64();
    passed.cursor = nondet_s16();
    passed.running = nondet_s16();
    any_scheduler(&scheduler, CAPACITY);
    expected = scheduler;
    modelled = model_scheduler_step(given ? &expected : NULL);
    read_again();

    status = keel_scheduler_step(given ? &scheduler : NULL);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x) &&
                         is_read_as_often() && (passes == 0u),
                     "SCH_020_model: as the model says");
}
