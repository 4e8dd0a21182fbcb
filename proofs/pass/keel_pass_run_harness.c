// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity --arrays-uf-always
// sources: src/rtos/pass.c specs/model/pass_run.c
// replaces: keel_pass_turn
// covers: keel_pass_run model_pass_run
//
// Any number of tasks that there is room for, from any state of the scheduler: each turn but the
// last leaves the pass fewer tasks to look at, so there is at most one turn more than the capacity,
// and each of them is looked at here. The nth turn of a pass is an unknown function of the
// scheduler that is given to it: as the code's scheduler is seen to be the one that the turn before
// it left, it is the same for the code and for the model. What a turn writes here is the stage, the
// pass, and busy_us in the place of all other fields; of what it does no more is known than its
// contract (step_contracts.h), and that outside of a pass it does nothing.
#include "../../specs/model/pass.h"
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

/* What each turn leaves behind, in one number. */
typedef struct marks {
    uint64_t of[KEEL_QUEUE_CAPACITY + 1u];
} marks_t;

marks_t nondet_marks(void);

static marks_t marks;
static uint32_t modelled_turns; /* How many turns the model has taken, */
static uint32_t turns;          /* and the code. */
static keel_scheduler_t left;   /* The scheduler as the code's last turn has left it. */
static keel_scheduler_t before; /* The stage and the pass with which a turn began. */

/* Whether nothing has been written since, but for the arrays of the queue: no turn writes them
 * here, and that nobody does is seen when the pass is over. */
static bool is_as_left(const keel_scheduler_t *scheduler)
{
    return setup_same(&scheduler->config, &left.config) &&
           clock_same(&scheduler->clock, &left.clock) && (scheduler->wake_us == left.wake_us) &&
           (scheduler->busy_us == left.busy_us) &&
           (scheduler->earliest_realtime_us == left.earliest_realtime_us) &&
           (scheduler->earliest_other_us == left.earliest_other_us) &&
           (scheduler->stage == left.stage) && (scheduler->cursor == left.cursor) &&
           (scheduler->pass_end == left.pass_end) && (scheduler->running == left.running) &&
           (scheduler->queue.count == left.queue.count) &&
           (scheduler->queue.realtime_count == left.queue.realtime_count);
}

static void note_before(const keel_scheduler_t *scheduler)
{
    before.stage = scheduler->stage;
    before.cursor = scheduler->cursor;
    before.pass_end = scheduler->pass_end;
}

/* The nth turn, whoever takes it. */
static keel_status_t any_turn(keel_scheduler_t *scheduler, uint32_t nth)
{
    const uint64_t mark = marks.of[nth];

    scheduler->busy_us = mark;
    scheduler->stage = ((mark & 2u) != 0u) ? KEEL_STAGE_PASS : KEEL_STAGE_READY;
    scheduler->running = (int16_t)((mark >> 8u) & UINT8_MAX) - 1;
    scheduler->cursor = (int16_t)((mark >> 16u) & UINT8_MAX);
    scheduler->pass_end = (int16_t)((mark >> 24u) & UINT8_MAX);
    return ((mark & 1u) != 0u) ? KEEL_OK : KEEL_ERR_CLOCK;
}

keel_status_t model_pass_turn(keel_scheduler_t *scheduler)
{
    keel_status_t status = KEEL_OK;

    note_before(scheduler);
    if (scheduler->stage == KEEL_STAGE_PASS) {
        status = any_turn(scheduler, modelled_turns);
    }
    modelled_turns++;
    __CPROVER_assume(keel_pass_turn_does(status, &before, scheduler));
    return status;
}

keel_status_t keel_pass_turn_stand_in(keel_scheduler_t *scheduler)
{
    keel_status_t status;

    __CPROVER_assert(keel_pass_turn_may(scheduler), "precondition: keel_pass_turn");
    __CPROVER_assert((scheduler->stage == KEEL_STAGE_PASS) && is_as_left(scheduler),
                     "SCH_023_turns: a turn begins with what the one before it has left");
    __CPROVER_assert(pass_left(scheduler) <= (int32_t)(CAPACITY - turns),
                     "SCH_023_ends: each turn leaves fewer tasks to look at");
    __CPROVER_assume(pass_left(scheduler) <= (int32_t)(CAPACITY - turns));
    note_before(scheduler);
    status = any_turn(scheduler, turns);
    turns++;
    __CPROVER_assume(keel_pass_turn_does(status, &before, scheduler));
    left.busy_us = scheduler->busy_us;
    left.stage = scheduler->stage;
    left.running = scheduler->running;
    left.cursor = scheduler->cursor;
    left.pass_end = scheduler->pass_end;
    return status;
}

void keel_pass_run_harness(void)
{
    const uint32_t x = any_below(CAPACITY);
    keel_scheduler_t scheduler;
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    marks = nondet_marks();
    __CPROVER_assume(keel_pass_run_may(&scheduler));
    left = scheduler;
    expected = scheduler;
    modelled = model_pass_run(&expected);

    status = keel_pass_run(&scheduler);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SCH_023_model: as the model says");
    __CPROVER_assert(keel_pass_run_does(status, &scheduler),
                     "SCH_023_closed: the pass is closed, refused by the clock alone");
}
