// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34
// sources: src/rtos/pass.c src/rtos/queue.c src/rtos/decision.c src/rtos/priority.c src/rtos/stats.c
// sources: specs/model/pass.c specs/model/clock.c
// replaces: keel_stats_record
// covers: keel_pass_finish end_run record_run model_pass_finish
// defines: -DKEEL_QUEUE_CAPACITY=8u
//
// Bounded to a capacity of 8 tasks, with which the solver comes to an end in half a minute; the
// contract under WP has no bound and determines every field.
// What a run adds to its task's statistics is the same unknown for the code and for the model.
#include "../../specs/model/pass.h"
#include "../../specs/model/stats.h"
#include "../common/keel_scheduler_proof.h"
#include "../common/stats_contracts.h"
#include "../common/step_contracts.h"

static keel_scheduler_t scheduler;
static keel_scheduler_t before;

/* What the model was asked, and the answer. */
static uint32_t slot;
static uint32_t ran_us;
static keel_stats_t recorded;

void model_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us)
{
    (void)budget_us;
    ran_us = elapsed_us;
    *stats = recorded;
}

void keel_stats_record_stand_in(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us)
{
    __CPROVER_assert(keel_stats_record_may(stats), "precondition: keel_stats_record");
    __CPROVER_assert((stats == &scheduler.queue.stats[slot]) && (elapsed_us == ran_us) &&
                         (budget_us == before.queue.budget_us[slot]) &&
                         stats_same(stats, &before.queue.stats[slot]),
                     "SCH_017_recorded: the run of the task that ran, once");
    *stats = recorded;
    __CPROVER_assume(keel_stats_record_does(stats, &recorded));
}

void keel_pass_finish_harness(void)
{
    const uint32_t x = any_below(CAPACITY);
    const uint32_t raw_us = nondet_u32();
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    recorded = nondet_stats();
    slot = scheduler.queue.order[(scheduler.running >= 0) ? scheduler.running : 0];
    before = scheduler;
    expected = scheduler;
    modelled = model_pass_finish(&expected, raw_us);

    __CPROVER_assume(keel_pass_finish_may(&scheduler));
    status = keel_pass_finish(&scheduler, raw_us);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SCH_017_model: as the model says");
    __CPROVER_assert(keel_pass_finish_does(status, &before, &scheduler),
                     "SCH_023_part: as the pass takes it to do");
}
