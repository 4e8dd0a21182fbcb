// cbmc: --unwind 35
// sources: src/rtos/pass.c
// replaces: keel_pass_next keel_pass_finish
// covers: keel_pass_run run_task
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// A pass is, for each task that next hands out, its body and finish, until it ends: each at the
// stage that it asks for, with a reading of the clock made for it, and with nothing done to the
// scheduler by the pass itself. Next and finish are whatever their contracts allow
// (step_contracts.h), a body is whatever adding and removing tasks do to a pass. One arbitrary
// real-time task is followed through it, by its position: if it is due, and nobody removes it, it
// runs, once, and none before it in the queue runs later. Bounded to a capacity of 4 tasks, with
// which the solver comes to an end in a minute; the contract under WP has no bound.
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

#define GONE UINT32_MAX

typedef enum moment {
    IN_PASS,
    HANDED_OUT,
    HAS_RUN,
    OVER
} moment_t;

static keel_scheduler_t scheduler;
static keel_scheduler_t left; /* The scheduler as one who may change it has left it. */
static keel_task_config_t declaration;
static uint32_t body_context;
static moment_t moment;
static keel_status_t expected;
static uint32_t followed; /* The position of the task that is followed; GONE when it was removed. */
static bool due;
static uint32_t runs;

static bool is_as_left(void)
{
    return scheduler_same(&scheduler, &left, 0u);
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
    left = scheduler;
}

static uint32_t counted_clock(void *context)
{
    (void)context;
    __CPROVER_assert(moment == HAS_RUN, "SCH_023_reading: the clock is read after a body");
    clock_readings++;
    clock_reading = nondet_u32();
    return clock_reading;
}

const keel_task_config_t *keel_pass_next_stand_in(keel_scheduler_t *given)
{
    const keel_scheduler_t before = scheduler;
    const keel_task_config_t *const chosen = nondet_bool() ? &declaration : NULL;

    __CPROVER_assert(keel_pass_next_may(given), "precondition: keel_pass_next");
    __CPROVER_assert((given == &scheduler) && is_as_left() && (moment == IN_PASS),
                     "SCH_023_sequence: next opens, or follows finish, in a pass");
    change();
    __CPROVER_assume(keel_pass_next_does(chosen, &before, &scheduler, followed, due));
    moment = (chosen != NULL) ? HANDED_OUT : OVER;
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

    __CPROVER_assert((context == &body_context) && is_as_left() && (moment == HANDED_OUT),
                     "SCH_023_sequence: the body of the task handed out follows, with its context");
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
    moment = HAS_RUN;
}

keel_status_t keel_pass_finish_stand_in(keel_scheduler_t *given, uint32_t raw_us)
{
    const keel_scheduler_t before = scheduler;

    __CPROVER_assert(keel_pass_finish_may(given), "precondition: keel_pass_finish");
    __CPROVER_assert((given == &scheduler) && is_as_left() && (moment == HAS_RUN),
                     "SCH_023_sequence: finish follows the body");
    __CPROVER_assert((clock_readings == 1u) && (raw_us == clock_reading),
                     "SCH_023_reading: one reading for each body");
    clock_readings = 0u;
    expected = nondet_bool() ? KEEL_OK : KEEL_ERR_CLOCK;
    change();
    __CPROVER_assume(keel_pass_finish_does(expected, &before, &scheduler));
    due = due || ((followed != GONE) && nondet_bool());
    moment = (scheduler.stage == KEEL_STAGE_PASS) ? IN_PASS : OVER;
    return expected;
}

void keel_pass_run_harness(void)
{
    bool must_run;
    bool is_open;
    keel_status_t status;

    declaration.run = body;
    declaration.context = &body_context;
    scheduler.queue.count = nondet_u8();
    scheduler.queue.realtime_count = nondet_u8();
    scheduler.config.read_clock = counted_clock;
    change();
    __CPROVER_assume(keel_pass_run_may(&scheduler));
    followed = any_below(CAPACITY);
    due = nondet_bool();
    is_open = scheduler.stage == KEEL_STAGE_PASS;
    must_run = is_open && due && (scheduler.cursor <= followed) && (followed < scheduler.pass_end);
    moment = is_open ? IN_PASS : OVER;
    expected = KEEL_OK;

    status = keel_pass_run(&scheduler);

    __CPROVER_assert(keel_pass_run_does(status, &scheduler),
                     "SCH_023_closed: the pass is closed, refused by the clock alone");
    __CPROVER_assert(
        (moment == OVER) && is_as_left() && (clock_readings == 0u),
        "SCH_023_sequence: it ends with the pass, only its parts change the scheduler");
    __CPROVER_assert(status == expected, "SCH_023_result: that of the last finish");
    __CPROVER_assert(runs <= 1u, "SCH_023_once: no real-time task runs twice in a pass");
    __CPROVER_assert((status != KEEL_OK) || !must_run || (followed == GONE) || (runs == 1u),
                     "SCH_023_all: no due real-time task that is left is left out");
}
