// cbmc: --unwind 35 --external-sat-solver cadical
// sources: src/rtos/scheduler.c
// replaces: keel_scheduler_begin keel_scheduler_next keel_scheduler_finish
// covers: keel_scheduler_step keel_scheduler_run_pass read_clock
//
// What joins the theorems to the step: it is begin, then for each task that next hands out its
// body and finish, until the pass ends, each at the stage that it asks for and each with a reading
// of the clock made for it; and it does nothing to the scheduler by itself. Begin, next and finish
// are whatever their contracts allow (step_contracts.h), and a body may shorten the pass, which is
// as long as the shipped capacity allows.
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

typedef enum moment {
    BEFORE,
    IN_PASS,
    HANDED_OUT,
    HAS_RUN,
    OVER
} moment_t;

static keel_scheduler_t scheduler;
static keel_scheduler_t left; /* The scheduler as one who may change it has left it. */
static keel_task_config_t declaration;
static keel_task_t task;
static moment_t moment;
static uint32_t readings; /* Of the clock, not handed on yet. */
static keel_status_t expected;
static uint32_t body_context;

static bool is_as_left(void)
{
    return (scheduler.stage == left.stage) && (scheduler.wake_us == left.wake_us) &&
           (scheduler.busy_us == left.busy_us) && clock_same(&scheduler.clock, &left.clock) &&
           (scheduler.cursor == left.cursor) && (scheduler.pass_end == left.pass_end) &&
           (scheduler.running == left.running) && (scheduler.ran == left.ran) &&
           (scheduler.queue.count == left.queue.count) &&
           (scheduler.queue.realtime_count == left.queue.realtime_count);
}

/* One who may change the scheduler does; the queue's counts matter to the step only here. */
static void change(void)
{
    scheduler.stage = any_below(KEEL_STAGE_OTHER + 1u);
    scheduler.cursor = nondet_u16();
    scheduler.pass_end = nondet_u16();
    scheduler.running = nondet_u16();
    scheduler.wake_us = nondet_u64();
    scheduler.busy_us = nondet_u64();
    scheduler.clock.now_us = nondet_u64();
    scheduler.clock.raw_us = nondet_u32();
    scheduler.ran = nondet_bool();
    left = scheduler;
}

static void go_on(void)
{
    moment = (scheduler.stage == KEEL_STAGE_PASS) ? IN_PASS : OVER;
}

static uint32_t counted_clock(void *context)
{
    (void)context;
    __CPROVER_assert((moment == BEFORE) || (moment == HAS_RUN),
                     "SCH_020_reading: the clock is read before begin and after a body");
    readings++;
    clock_reading = nondet_u32();
    return clock_reading;
}

static void take_reading(uint32_t raw_us)
{
    __CPROVER_assert((readings == 1u) && (raw_us == clock_reading),
                     "SCH_020_reading: one reading for each that asks for one");
    readings = 0u;
}

keel_status_t keel_scheduler_begin_stand_in(keel_scheduler_t *given, uint32_t raw_us)
{
    const keel_scheduler_t before = scheduler;

    __CPROVER_assert(keel_scheduler_begin_may(given), "precondition: keel_scheduler_begin");
    __CPROVER_assert((given == &scheduler) && is_as_left() && (moment == BEFORE),
                     "SCH_020_sequence: begin comes first");
    take_reading(raw_us);
    expected = nondet_bool() ? KEEL_OK : (nondet_bool() ? KEEL_ERR_CLOCK : KEEL_ERR_STATE);
    change();
    __CPROVER_assume(keel_scheduler_begin_does(expected, &before, &scheduler));
    go_on();
    moment = (expected == KEEL_OK) ? moment : OVER;
    return expected;
}

keel_task_t *keel_scheduler_next_stand_in(keel_scheduler_t *given)
{
    const keel_scheduler_t before = scheduler;
    keel_task_t *const chosen = nondet_bool() ? &task : NULL;

    __CPROVER_assert(keel_scheduler_next_may(given), "precondition: keel_scheduler_next");
    __CPROVER_assert((given == &scheduler) && is_as_left() && (moment == IN_PASS),
                     "SCH_020_sequence: next follows begin, or finish, in a pass");
    change();
    __CPROVER_assume(keel_scheduler_next_does(chosen, &before, &scheduler));
    moment = (chosen != NULL) ? HANDED_OUT : OVER;
    return chosen;
}

/* The pass gets no longer by what add and remove do to it (SCH_006_pass, SCH_006_cursor). */
static void body(void *context)
{
    const keel_scheduler_t before = scheduler;

    __CPROVER_assert((context == &body_context) && is_as_left() && (moment == HANDED_OUT),
                     "SCH_020_sequence: the body of the task handed out follows, with its context");
    change();
    __CPROVER_assume((scheduler.stage == before.stage) &&
                     (scheduler.cursor <= scheduler.pass_end) &&
                     ((before.stage == KEEL_STAGE_OTHER) ||
                      ((scheduler.pass_end - scheduler.cursor) <=
                       (before.pass_end - before.cursor))));
    moment = HAS_RUN;
}

keel_status_t keel_scheduler_finish_stand_in(keel_scheduler_t *given, uint32_t raw_us)
{
    const keel_scheduler_t before = scheduler;

    __CPROVER_assert(keel_scheduler_finish_may(given), "precondition: keel_scheduler_finish");
    __CPROVER_assert((given == &scheduler) && is_as_left() && (moment == HAS_RUN),
                     "SCH_020_sequence: finish follows the body");
    take_reading(raw_us);
    expected = nondet_bool() ? KEEL_OK : KEEL_ERR_CLOCK;
    change();
    __CPROVER_assume(keel_scheduler_finish_does(expected, &before, &scheduler));
    go_on();
    return expected;
}

void keel_scheduler_step__order_harness(void)
{
    const bool given = nondet_bool();
    keel_status_t status;

    declaration.run = body;
    declaration.context = &body_context;
    task.config = &declaration;
    scheduler.queue.realtime_count = any_below(CAPACITY + 1u);
    scheduler.config.read_clock = counted_clock;
    change();

    status = keel_scheduler_step(given ? &scheduler : NULL);

    if (given) {
        __CPROVER_assert((moment == OVER) && (readings == 0u),
                         "SCH_020_sequence: the step ends with the pass");
        __CPROVER_assert(status == expected, "SCH_020_status: of begin, or of the last finish");
    } else {
        __CPROVER_assert((moment == BEFORE) && (status == KEEL_ERR_NULL),
                         "SCH_020_null: no scheduler");
    }
    __CPROVER_assert(is_as_left(), "SCH_020_sequence: only its parts change the scheduler");
}
