// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --no-array-field-sensitivity
// sources: src/rtos/pass.c
// replaces: keel_pass_next keel_pass_finish
// covers: keel_pass_turn run_task
//
// One arbitrary real-time task is followed through a pass, by its position: if it is due when the
// pass begins, and nobody removes it, it runs, once, and none before it in the queue runs later.
// What is known of it when the pass begins, each turn keeps, and from that the claim follows when
// the pass ends: an induction over the turns of a pass, of which there are any number, for any
// number of tasks; that a pass is its turns, keel_pass_run_harness.c shows. Next and finish are
// whatever their contracts allow (step_contracts.h), a body is whatever adding and removing tasks
// do to a pass. Which parts a turn calls, when and with what: keel_pass_turn_harness.c.
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

#define GONE UINT32_MAX

static keel_scheduler_t scheduler;
static keel_task_config_t declaration;
static uint32_t followed; /* The position of the task that is followed; GONE when it was removed. */
static bool due;
static bool was_due; /* When the pass began. */
static uint32_t runs;

/* The task is due, and the pass has yet to look at it. */
static bool waits(void)
{
    return due && ((uint32_t)scheduler.cursor <= followed) &&
           (followed < (uint32_t)scheduler.pass_end);
}

/* What holds of the task between two turns: one that was due still waits, or has run. */
static bool is_followed(void)
{
    return (followed == GONE) || ((runs == 0u) && (!was_due || waits())) ||
           ((runs == 1u) && (followed < (uint32_t)scheduler.cursor));
}

/* One who may change the scheduler does. */
static void change(void)
{
    scheduler.stage = nondet_s16();
    scheduler.cursor = nondet_s16();
    scheduler.pass_end = nondet_s16();
    scheduler.running = nondet_s16();
    scheduler.wake_us = nondet_u64();
    scheduler.busy_us = nondet_u64();
    scheduler.clock.now_us = nondet_u64();
    scheduler.clock.raw_us = nondet_u32();
    scheduler.earliest_realtime_us = nondet_u64();
    scheduler.earliest_other_us = nondet_u64();
}

const keel_task_config_t *keel_pass_next_stand_in(keel_scheduler_t *given)
{
    const keel_scheduler_t before = scheduler;
    const keel_task_config_t *const chosen = nondet_bool() ? &declaration : NULL;

    __CPROVER_assert(keel_pass_next_may(given), "precondition: keel_pass_next");
    change();
    __CPROVER_assume(keel_pass_next_does(chosen, &before, &scheduler, followed, due));
    if (scheduler.stage == KEEL_STAGE_REALTIME) {
        __CPROVER_assert((runs == 0u) || (followed == GONE) || (followed < scheduler.running),
                         "SCH_023_order: real-time tasks run in queue order");
        if (scheduler.running == followed) {
            runs++;
            due = false;
        }
    }
    return chosen;
}

/* Adding puts no task before one of the pass, removing moves up all that stand behind: a task
 * stays on its side of the cursor and of the pass' end (SCH_004_order, SCH_007_order,
 * SCH_007_pass). */
static void body(void *context)
{
    const keel_scheduler_t before = scheduler;
    const uint32_t was = followed;

    (void)context;
    change();
    __CPROVER_assume((scheduler.stage == before.stage) && (0 <= scheduler.cursor) &&
                     (scheduler.cursor <= before.cursor) &&
                     (scheduler.cursor <= scheduler.pass_end) &&
                     ((scheduler.pass_end - scheduler.cursor) <=
                      (before.pass_end - before.cursor)));
    followed = nondet_u32();
    __CPROVER_assume((followed == GONE) ||
                     ((was != GONE) && (followed <= was) &&
                      ((followed < scheduler.cursor) == (was < before.cursor)) &&
                      ((followed < scheduler.pass_end) == (was < before.pass_end))));
    due = due && (followed != GONE);
}

keel_status_t keel_pass_finish_stand_in(keel_scheduler_t *given, uint32_t raw_us)
{
    const keel_scheduler_t before = scheduler;
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_CLOCK;

    (void)raw_us;
    __CPROVER_assert(keel_pass_finish_may(given), "precondition: keel_pass_finish");
    change();
    __CPROVER_assume(keel_pass_finish_does(status, &before, &scheduler));
    due = due || ((followed != GONE) && nondet_bool());
    return status;
}

void keel_pass_turn__once_harness(void)
{
    keel_status_t status;

    declaration.run = body;
    scheduler.config.read_clock = any_clock;
    change();
    followed = nondet_u32();
    due = nondet_bool();
    was_due = nondet_bool();
    runs = any_below(2u);
    __CPROVER_assume(keel_pass_turn_may(&scheduler) && (scheduler.stage == KEEL_STAGE_PASS));
    __CPROVER_assume((followed == GONE) || (followed < UINT8_MAX));
    __CPROVER_assert((runs != 0u) || (was_due && !waits()) || is_followed(),
                     "SCH_023_begun: it holds when the pass begins");
    __CPROVER_assume(is_followed());

    status = keel_pass_turn(&scheduler);

    __CPROVER_assert(runs <= 1u, "SCH_023_once: no real-time task runs twice in a pass");
    __CPROVER_assert((scheduler.stage != KEEL_STAGE_PASS) || is_followed(),
                     "SCH_023_kept: what is known of the task holds after a turn");
    __CPROVER_assert((scheduler.stage == KEEL_STAGE_PASS) || (status != KEEL_OK) || !was_due ||
                         (followed == GONE) || (runs == 1u),
                     "SCH_023_all: no due real-time task that is left is left out");
}
