// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --no-array-field-sensitivity
// sources: src/rtos/pass.c specs/model/pass_turn.c
// replaces: keel_pass_next keel_pass_finish
// covers: keel_pass_turn decide_turn run_task model_pass_turn
//
// One turn, from any state of the scheduler, with any number of tasks. Next, the bodies, the clock
// and finish are unknown functions, the same for the code and for the model, of what they are given
// and of the fields that they write here: the stage, the pass, and busy_us in the place of all
// others. So a part that is called at another moment, with another argument, or once more or less,
// leaves another state behind; and what the turn writes of itself stays to be seen. Of the parts no
// more is known than their contracts (step_contracts.h), and that outside a pass next and finish
// change nothing (SCH-014, SCH-018).
#include "../../specs/model/pass.h"
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

uint32_t __CPROVER_uninterpreted_next(uint64_t mark, uint64_t pass);
uint32_t __CPROVER_uninterpreted_body(uint64_t mark, uint64_t pass, uint32_t which, uint32_t given);
uint32_t __CPROVER_uninterpreted_clock(uint64_t mark, uint64_t pass, uint32_t nth, uint32_t given);
uint32_t __CPROVER_uninterpreted_finish(uint64_t mark, uint64_t pass, uint32_t raw_us);

static keel_scheduler_t *acting; /* The scheduler whose turn it is: the model's or the code's. */
static keel_task_config_t declared[2];
static uint32_t contexts[3]; /* The two tasks' and the clock's. */

static uint32_t number_of(const void *context)
{
    uint32_t number = 3u;

    for (uint32_t i = 0u; i < 3u; i++) {
        number = (context == &contexts[i]) ? i : number;
    }
    return number;
}

static uint64_t pass_of(const keel_scheduler_t *scheduler)
{
    return ((uint64_t)(uint16_t)scheduler->cursor << 48u) |
           ((uint64_t)(uint16_t)scheduler->pass_end << 32u) |
           ((uint64_t)(uint16_t)(scheduler->running + 1) << 16u) | (uint16_t)scheduler->stage;
}

/* What a part leaves behind, out of one number. */
static void leave(keel_scheduler_t *scheduler, uint32_t mark)
{
    scheduler->busy_us = mark;
    scheduler->stage = (int16_t)(mark & 7u);
    scheduler->running = (int16_t)((mark >> 8u) & UINT8_MAX) - 1;
    scheduler->cursor = (int16_t)((mark >> 16u) & UINT8_MAX);
    scheduler->pass_end = (int16_t)((mark >> 24u) & UINT8_MAX);
}

/* The bit of such a number that decides what a part returns. */
static bool chooses(uint32_t mark, uint32_t bit)
{
    return ((mark >> (3u + bit)) & 1u) != 0u;
}

const keel_task_config_t *model_pass_next(keel_scheduler_t *scheduler)
{
    const keel_scheduler_t before = *scheduler;
    const uint32_t mark = __CPROVER_uninterpreted_next(before.busy_us, pass_of(&before));
    const keel_task_config_t *task = NULL;

    if (before.stage == KEEL_STAGE_PASS) {
        leave(scheduler, mark);
        task = chooses(mark, 0u) ? &declared[chooses(mark, 1u) ? 1u : 0u] : NULL;
        __CPROVER_assume(keel_pass_next_does(task, &before, scheduler, CAPACITY, false));
    }
    return task;
}

const keel_task_config_t *keel_pass_next_stand_in(keel_scheduler_t *scheduler)
{
    const keel_scheduler_t before = *scheduler;
    const keel_task_config_t *task;

    __CPROVER_assert(keel_pass_next_may(scheduler), "precondition: keel_pass_next");
    task = model_pass_next(scheduler);
    __CPROVER_assume(keel_pass_next_does(task, &before, scheduler, CAPACITY, false));
    return task;
}

/* What a body does, adding and removing tasks: the pass does not grow longer (SCH_007_pass). */
static void run_body(uint32_t which, const void *context)
{
    const keel_scheduler_t before = *acting;

    leave(acting, __CPROVER_uninterpreted_body(before.busy_us, pass_of(&before), which,
                                               number_of(context)));
    __CPROVER_assume((acting->stage == before.stage) && (acting->cursor <= acting->pass_end) &&
                     ((acting->pass_end - acting->cursor) <= (before.pass_end - before.cursor)));
}

static void first_body(void *context)
{
    run_body(0u, context);
}

static void second_body(void *context)
{
    run_body(1u, context);
}

static uint32_t unknown_clock(void *context)
{
    clock_readings++;
    return __CPROVER_uninterpreted_clock(acting->busy_us, pass_of(acting), clock_readings,
                                         number_of(context));
}

keel_status_t model_pass_finish(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const keel_scheduler_t before = *scheduler;
    const uint32_t mark = __CPROVER_uninterpreted_finish(before.busy_us, pass_of(&before), raw_us);
    keel_status_t status = KEEL_ERR_STATE;

    if ((before.stage == KEEL_STAGE_REALTIME) || (before.stage == KEEL_STAGE_OTHER)) {
        leave(scheduler, mark);
        status = chooses(mark, 0u) ? KEEL_OK : KEEL_ERR_CLOCK;
        __CPROVER_assume(keel_pass_finish_does(status, &before, scheduler));
    }
    return status;
}

keel_status_t keel_pass_finish_stand_in(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const keel_scheduler_t before = *scheduler;
    keel_status_t status;

    __CPROVER_assert(keel_pass_finish_may(scheduler), "precondition: keel_pass_finish");
    status = model_pass_finish(scheduler, raw_us);
    __CPROVER_assume(keel_pass_finish_does(status, &before, scheduler));
    return status;
}

void keel_pass_turn_harness(void)
{
    const uint32_t x = any_below(CAPACITY);
    keel_scheduler_t scheduler;
    keel_scheduler_t expected;
    keel_scheduler_t before;
    keel_status_t modelled;
    keel_status_t status;

    scheduler.config.read_clock = unknown_clock;
    scheduler.config.clock_context = &contexts[2];
    declared[0].run = first_body;
    declared[0].context = &contexts[0];
    declared[1].run = second_body;
    declared[1].context = &contexts[1];
    __CPROVER_assume(keel_pass_turn_may(&scheduler));
    before = scheduler;
    expected = scheduler;
    acting = &expected;
    modelled = model_pass_turn(&expected);
    read_again();
    acting = &scheduler;

    status = keel_pass_turn(&scheduler);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x) &&
                         is_read_as_often(),
                     "SCH_026_model: as the model says");
    __CPROVER_assert((before.stage == KEEL_STAGE_PASS) || scheduler_same(&scheduler, &before, x),
                     "SCH_026_closed: without a pass it does nothing");
    __CPROVER_assert(keel_pass_turn_does(status, &before, &scheduler),
                     "SCH_023_part: as the pass takes it to do");
}
