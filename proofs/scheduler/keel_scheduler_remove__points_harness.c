// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// checks: assertions
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// replaces: keel_queue_remove
// defines: -DKEEL_QUEUE_CAPACITY=32u
// covers: keel_scheduler_remove remove_task shift_pass
//
// Of as many tasks as fit one goes, before, in or behind the pass and the task that runs, or none
// as it is not there: the same as the model's. Mistakes that only many tasks show are refuted here
// in seconds; keel_scheduler_remove_harness has any scheduler of few.
#include "many_scheduled.h"

/* Positions in the later half of a full queue. */
#define LATE  ((int16_t)CAPACITY - 12)
#define LATER ((int16_t)CAPACITY - 7)
#define LAST  ((int16_t)CAPACITY - 1)

typedef struct {
    int16_t gone; /* -1: it is not there; -2: there is no scheduler */
    int16_t cursor;
    int16_t pass_end;
    int16_t running;
} point_t;

static const point_t point[] = {
    {LATE, LATER, LAST, LAST},
    {LATER, LATER, LATER, LATE},
    {LATER + 1, LATE, LATER, LATER + 1},
    {LAST, LATE, LATER, LATER},
    {LAST, LAST + 1, LAST + 1, LAST},
    {2, LAST + 1, LAST + 1, KEEL_POSITION_NONE},
    {2, 1, LATE, LATER},
    {-1, LATE, LATER, LATE},
    {-2, LATE, LATER, LATE},
};

static void choose(const point_t *one)
{
    choose_scheduler(CAPACITY, CAPACITY, KEEL_STAGE_PASS);
    if (one->gone >= 0) {
        scheduler.queue.task[scheduler.queue.order[one->gone]] = &proof_task;
    }
    scheduler.cursor = one->cursor;
    scheduler.pass_end = one->pass_end;
    scheduler.running = one->running;
    begin();
}

void keel_scheduler_remove__points_harness(void)
{
    at = any_below(CAPACITY);
    for (uint32_t i = 0u; i < (sizeof(point) / sizeof(point[0])); i++) {
        const bool given = point[i].gone >= -1;
        keel_status_t modelled;
        keel_status_t status;

        choose(&point[i]);
        modelled = model_scheduler_remove(given ? &expected : NULL, &proof_task);
        status = keel_scheduler_remove(given ? &scheduler : NULL, &proof_task);
        __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, at),
                         "SCH_007_model: as the model says");
    }
}
