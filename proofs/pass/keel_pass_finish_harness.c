// cbmc: --unwind 34
// sources: src/rtos/pass.c src/rtos/queue.c src/rtos/decision.c src/rtos/priority.c src/rtos/load.c
// covers: keel_pass_finish end_run record_run keel_stats_record
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

/* Statistics with one more run (stats_recorded). */
static keel_stats_t recorded(const keel_stats_t *stats, uint32_t ran_us, uint32_t budget_us)
{
    keel_stats_t with = *stats;

    with.last_us = ran_us;
    if (ran_us > stats->longest_us) {
        with.longest_us = ran_us;
    }
    if ((ran_us > budget_us) && (stats->overruns < UINT16_MAX)) {
        with.overruns++;
    }
    if ((stats->runs < UINT32_MAX) && (stats->total_us <= (UINT64_MAX - ran_us))) {
        with.runs++;
        with.total_us += ran_us;
    }
    return with;
}

void keel_pass_finish_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const uint32_t raw_us = nondet_u32();
    uint64_t ran_us;
    keel_scheduler_t before;
    keel_scheduler_t expected;
    bool running;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    ran_us = elapsed(scheduler.clock.raw_us, raw_us);
    running = (scheduler.stage == KEEL_STAGE_REALTIME) || (scheduler.stage == KEEL_STAGE_OTHER);
    before = scheduler;
    expected = scheduler;

    __CPROVER_assume(keel_pass_finish_may(&scheduler));
    status = keel_pass_finish(&scheduler, raw_us);

    __CPROVER_assert(keel_pass_finish_does(status, &before, &scheduler),
                     "SCH_023_part: as the pass takes it to do");
    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert(scheduler.busy_us <= scheduler.clock.now_us,
                     "SCH_017_busy_bound: no more is spent in tasks than time has passed");
    __CPROVER_assert((status == KEEL_ERR_STATE) == !running, "SCH_018_state: no task runs");
    __CPROVER_assert((status == KEEL_ERR_CLOCK) == (running && (ran_us >= 0x80000000u)),
                     "SCH_018_clock: the clock jumped backwards");
    if (running) {
        expected.running = KEEL_POSITION_NONE;
        expected.stage = KEEL_STAGE_READY;
    }
    if (running && (ran_us < 0x80000000u)) {
        __CPROVER_assert(status == KEEL_OK, "SCH_017_ok: else it is done");
        expected.clock.now_us += ran_us;
        expected.clock.raw_us = raw_us;
        expected.busy_us += ran_us;
        __CPROVER_assert(clock_same(&scheduler.clock, &expected.clock),
                         "SCH_017_time: time moves on to the reading");
        __CPROVER_assert(scheduler.busy_us == expected.busy_us,
                         "SCH_017_busy: what it ran counts as busy");
        if (before.stage == KEEL_STAGE_REALTIME) {
            expected.stage = KEEL_STAGE_PASS;
        }
        if (before.running != KEEL_POSITION_NONE) {
            const uint32_t slot = before.queue.order[before.running];

            expected.queue.stats[slot] = recorded(&before.queue.stats[slot], (uint32_t)ran_us,
                                                  before.queue.budget_us[slot]);
            __CPROVER_assert(stats_same(&scheduler.queue.stats[slot], &expected.queue.stats[slot]),
                             "SCH_017_recorded: its run is recorded");
        }
    }
    __CPROVER_assert((scheduler.stage == expected.stage) && (scheduler.running == expected.running),
                     "SCH_017_stage: after a real-time task the pass goes on");
    __CPROVER_assert(scheduler_same(&scheduler, &expected, x),
                     "SCH_017_others: nothing else is written, of no other task");
}
