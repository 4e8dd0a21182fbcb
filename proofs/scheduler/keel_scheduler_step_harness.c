// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// replaces: keel_pass_run
// covers: keel_scheduler_step keel_pass_begin read_clock
//
// A step is begin with a reading of the clock, and the pass if one opens; the pass is whatever its
// contract allows (step_contracts.h).
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

static uint32_t x;                /* The position and slot at which all is seen. */
static keel_scheduler_t expected; /* As begin leaves the scheduler, then as the pass does. */
static keel_status_t expected_status;
static uint32_t passes;

/* Reads what the harness has decided. */
static uint32_t planned_clock(void *context)
{
    (void)context;
    clock_readings++;
    return clock_reading;
}

/* What begin makes of the expected scheduler. */
static void expect_begin(void)
{
    const uint64_t step_us = elapsed(expected.clock.raw_us, clock_reading);

    if (expected.stage != KEEL_STAGE_READY) {
        expected_status = KEEL_ERR_STATE;
    } else if (step_us >= 0x80000000u) {
        expected_status = KEEL_ERR_CLOCK;
    } else {
        expected_status = KEEL_OK;
        expected.clock.now_us += step_us;
        expected.clock.raw_us = clock_reading;
        if (expected.clock.now_us >= expected.wake_us) {
            expected.stage = KEEL_STAGE_PASS;
            expected.wake_us = 0u;
            expected.cursor = 0u;
            expected.pass_end = expected.queue.realtime_count;
        }
    }
}

keel_status_t keel_pass_run_stand_in(keel_scheduler_t *given)
{
    __CPROVER_assert(keel_pass_run_may(given), "precondition: keel_pass_run");
    __CPROVER_assert(scheduler_same(given, &expected, x) && (expected_status == KEEL_OK),
                     "SCH_020_sequence: the pass follows begin, which alone has written");
    passes++;
    expected_status = nondet_bool() ? KEEL_OK : KEEL_ERR_CLOCK;
    given->stage = nondet_s16();
    given->clock.now_us = nondet_u64();
    given->clock.raw_us = nondet_u32();
    given->wake_us = nondet_u64();
    given->busy_us = nondet_u64();
    given->cursor = nondet_s16();
    given->running = nondet_s16();
    __CPROVER_assume(keel_pass_run_does(expected_status, given));
    expected = *given;
    return expected_status;
}

void keel_scheduler_step_harness(void)
{
    keel_scheduler_t scheduler;
    const bool given = nondet_bool();
    bool opens;
    keel_status_t status;

    x = any_below(CAPACITY);
    clock_reading = nondet_u32();
    any_scheduler(&scheduler, CAPACITY);
    scheduler.config.read_clock = planned_clock;
    expected = scheduler;
    expected_status = KEEL_ERR_NULL;
    if (given) {
        expect_begin();
    }
    opens = given && (expected_status == KEEL_OK) && (expected.stage == KEEL_STAGE_PASS);

    status = keel_scheduler_step(given ? &scheduler : NULL);

    __CPROVER_assert((status == KEEL_ERR_NULL) == !given, "SCH_020_null: no scheduler");
    __CPROVER_assert(clock_readings == (given ? 1u : 0u),
                     "SCH_020_reading: the clock is read once, for begin");
    __CPROVER_assert(passes == (opens ? 1u : 0u), "SCH_020_sequence: a pass that opens is run");
    __CPROVER_assert(status == expected_status, "SCH_020_result: that of begin, or of the pass");
    __CPROVER_assert((status != KEEL_OK) || (scheduler.stage == KEEL_STAGE_READY),
                     "SCH_020_closed: no pass stays open");
    __CPROVER_assert(scheduler_same(&scheduler, &expected, x),
                     "SCH_020_sequence: only its parts change the scheduler");
}
