// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// checks: assertions
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// replaces: keel_admission_queue keel_admission_admit keel_queue_add
// defines: -DKEEL_QUEUE_CAPACITY=32u
// covers: keel_scheduler_add insert_task add_to_queue
//
// A task comes to many, of which one before or behind it runs, or is refused: the same as the
// model's. Mistakes that only many tasks show are refuted here in seconds;
// keel_scheduler_add_harness has any scheduler of few.
#include "many_scheduled.h"

#define PLACE (CAPACITY - 12u)
#define ABOVE ((int16_t)PLACE - 3)
#define BELOW ((int16_t)PLACE + 5)

typedef enum {
    NO_SCHEDULER,
    NEWCOMER,
    DUPLICATE
} given_t;

typedef struct {
    given_t given;
    uint8_t count;
    uint8_t priority;
    int16_t running;
    int16_t stage;
    keel_status_t admitted;
} point_t;

static const point_t point[] = {
    {NEWCOMER, CAPACITY - 1u, KEEL_PRIORITY_REALTIME, BELOW, KEEL_STAGE_READY, KEEL_OK},
    {NEWCOMER, CAPACITY - 1u, KEEL_PRIORITY_REALTIME, ABOVE, KEEL_STAGE_OTHER, KEEL_OK},
    {NEWCOMER, CAPACITY - 1u, KEEL_PRIORITY_HIGH, BELOW, KEEL_STAGE_SETUP, KEEL_OK},
    {NEWCOMER, CAPACITY - 1u, KEEL_PRIORITY_HIGH, BELOW, KEEL_STAGE_READY, KEEL_ERR_UTILISATION},
    {NEWCOMER, CAPACITY, KEEL_PRIORITY_LOW, BELOW, KEEL_STAGE_SETUP, KEEL_OK},
    {NEWCOMER, CAPACITY - 1u, 0u, BELOW, KEEL_STAGE_SETUP, KEEL_OK}, /* no priority */
    {DUPLICATE, CAPACITY - 1u, KEEL_PRIORITY_HIGH, BELOW, KEEL_STAGE_SETUP, KEEL_OK},
    {NO_SCHEDULER, CAPACITY - 1u, KEEL_PRIORITY_HIGH, BELOW, KEEL_STAGE_SETUP, KEEL_OK},
};

static void choose(const point_t *one)
{
    choose_scheduler(one->count, PLACE, one->stage);
    scheduler.running = one->running;
    if (one->given == DUPLICATE) {
        scheduler.queue.task[scheduler.queue.order[PLACE]] = &proof_task;
    }
    newcomer_status = one->admitted;
    proof_task.priority = one->priority;
    begin();
}

void keel_scheduler_add__points_harness(void)
{
    at = any_below(CAPACITY);
    totals = nondet_admission();
    set_status = KEEL_OK;
    any_config(&proof_task);
    proof_task.period_us = 2000u;
    proof_task.phase_us = 30u;
    proof_task.budget_us = 4u;
    for (uint32_t i = 0u; i < (sizeof(point) / sizeof(point[0])); i++) {
        const bool given = point[i].given != NO_SCHEDULER;
        keel_status_t modelled;
        keel_status_t status;

        choose(&point[i]);
        modelled = model_scheduler_add(given ? &expected : NULL, &proof_task);
        status = keel_scheduler_add(given ? &scheduler : NULL, &proof_task);
        __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, at),
                         "SCH_004_model: as the model says");
    }
}
