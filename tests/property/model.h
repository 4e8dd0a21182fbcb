/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file model.h
 * @brief A reference model of the queue, admission and the scheduler, written to be obvious.
 *
 * It shares no code with the kernel: tasks are numbers, lists are searched and shifted, nothing
 * is remembered that can be worked out, and it never sleeps: where the kernel waits for wake_us,
 * the model decides at every step. Only the names of the statuses are the kernel's.
 */
#ifndef KEEL_TESTS_PROPERTY_MODEL_H
#define KEEL_TESTS_PROPERTY_MODEL_H

#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

#define MODEL_TASKS   40
#define MODEL_NO_TASK (-1)

/** What a task declares. */
typedef struct model_declaration {
    bool has_body;
    uint64_t period, budget, phase, priority;
} model_declaration_t;

/** A task: its declaration, and what is known about its runs. Counters never wrap here. */
typedef struct model_task {
    model_declaration_t is;
    uint64_t release, skipped;
    uint64_t runs, total, last, longest, overruns, promotions;
    uint64_t remembered; /* The longest overrun since eight runs in a row were within the budget. */
    uint64_t forgotten;  /* How often it was forgotten. */
    uint64_t in_a_row;   /* Runs within the budget since the last overrun, or the first run. */
} model_task_t;

/** Numbers of tasks in order. */
typedef struct model_list {
    int length;
    int item[MODEL_TASKS];
} model_list_t;

typedef enum model_stage {
    SETTING_UP,
    BETWEEN,
    DECIDING,
    RUNNING
} model_stage_t;

typedef struct model {
    int capacity;
    uint64_t guard, limit;
    bool without_promotion;
    model_task_t task[MODEL_TASKS];
    model_list_t realtime, others;
    model_list_t pass; /* Real-time tasks that this pass still has to look at. */
    model_stage_t stage;
    bool serving_realtime;
    int running; /* The running task, unless it was removed. */
    bool idle;   /* The last pass ended with nothing to run, and no task came or went since. */
    uint64_t now, busy;
    uint64_t raw; /* The last reading of the counter. */
} model_t;

void model_init(model_t *m, int capacity, uint64_t guard, uint64_t limit, bool without_promotion);
bool model_holds(const model_t *m, int task);
keel_status_t model_check(const model_t *m, int *admitted);
keel_status_t model_add(model_t *m, int task);
keel_status_t model_remove(model_t *m, int task);
keel_status_t model_start(model_t *m, uint64_t raw);
keel_status_t model_begin(model_t *m, uint64_t raw);
int model_next(model_t *m);
keel_status_t model_finish(model_t *m, uint64_t raw);
uint64_t model_wake(const model_t *m);
keel_status_t model_resync(model_t *m, uint64_t raw);

#endif
