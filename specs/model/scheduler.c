/* SPDX-License-Identifier: Apache-2.0 */
#include "scheduler.h"

#include "admission.h"
#include "clock.h"
#include "pass.h"
#include "queue.h"
#include "task.h"

#include <stdbool.h>
#include <stddef.h>

/* What is known of the releases after the queue has changed: nothing. */
static void forget(keel_scheduler_t *scheduler)
{
    scheduler->earliest_realtime_us = 0u;
    scheduler->earliest_other_us = 0u;
    scheduler->wake_us = 0u;
}

keel_status_t model_scheduler_init(keel_scheduler_t *scheduler,
                                   const keel_scheduler_config_t *config)
{
    if ((scheduler == NULL) || (config == NULL) || (config->read_clock == NULL)) {
        return KEEL_ERR_NULL; /* SCH-002 */
    }
    if ((config->guard_us >= KEEL_PERIOD_LIMIT_US) ||
        (config->utilisation_limit_ppm > KEEL_UTILISATION_FULL_PPM)) {
        return KEEL_ERR_CONFIG; /* SCH-002 */
    }
    /* SCH-001: no task, no time, not started. */
    model_queue_init(&scheduler->queue);
    model_clock_init(&scheduler->clock, 0u);
    forget(scheduler);
    scheduler->config = *config;
    scheduler->busy_us = 0u;
    scheduler->stage = KEEL_STAGE_SETUP;
    scheduler->cursor = 0;
    scheduler->pass_end = 0;
    scheduler->running = KEEL_POSITION_NONE;
    return KEEL_OK;
}

/* The set's totals, as far as it is admitted. */
static keel_status_t admit_all(const keel_scheduler_t *scheduler, keel_admission_t *admission)
{
    model_admission_init(admission, scheduler->config.guard_us,
                         scheduler->config.utilisation_limit_ppm);
    return model_admission_queue(admission, &scheduler->queue);
}

keel_status_t model_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted)
{
    keel_admission_t admission;
    const keel_status_t status = admit_all(scheduler, &admission);

    *admitted = (uint32_t)admission.tasks; /* SCH-003: the offender's position */
    return status;
}

/* SCH-005: why a task is not added, or KEEL_OK. */
static keel_status_t refusal_of(const keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    keel_admission_t admission;
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    status = model_task_check(task);
    if (status != KEEL_OK) {
        return status;
    }
    if (model_queue_find(&scheduler->queue, task) < scheduler->queue.count) {
        return KEEL_ERR_DUPLICATE;
    }
    if (scheduler->queue.count == KEEL_QUEUE_CAPACITY) {
        return KEEL_ERR_FULL;
    }
    if (scheduler->stage == KEEL_STAGE_SETUP) {
        return KEEL_OK; /* SCH-004: the set is admitted at the start */
    }
    status = admit_all(scheduler, &admission);
    if (status != KEEL_OK) {
        return status;
    }
    return model_admission_admit(&admission, task->priority, task->period_us, task->budget_us);
}

keel_status_t model_scheduler_add(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    const keel_status_t status = refusal_of(scheduler, task);

    if (status == KEEL_OK) {
        const int16_t place = (int16_t)scheduler->queue.realtime_count;

        /* SCH-004: last of its class, released a phase from now. */
        model_queue_add(&scheduler->queue, task, scheduler->clock.now_us + task->phase_us);
        if ((task->priority == KEEL_PRIORITY_REALTIME) && (scheduler->running >= place)) {
            scheduler->running++; /* the running task has moved down by one */
        }
        forget(scheduler);
    }
    return status;
}

keel_status_t model_scheduler_remove(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    uint32_t position;
    int16_t gone;

    if ((scheduler == NULL) || (task == NULL)) {
        return KEEL_ERR_NULL; /* SCH-008 */
    }
    position = model_queue_find(&scheduler->queue, task);
    if (position == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK; /* SCH-008 */
    }
    /* SCH-007: the pass goes on with the same tasks, the running task is known unless it went. */
    gone = (int16_t)position;
    if (gone < scheduler->cursor) {
        scheduler->cursor--;
    }
    if (gone < scheduler->pass_end) {
        scheduler->pass_end--;
    }
    if (gone == scheduler->running) {
        scheduler->running = KEEL_POSITION_NONE;
    } else if (gone < scheduler->running) {
        scheduler->running--;
    }
    model_queue_remove(&scheduler->queue, position);
    forget(scheduler);
    return KEEL_OK;
}

static uint32_t reading(const keel_scheduler_t *scheduler)
{
    return scheduler->config.read_clock(scheduler->config.clock_context);
}

keel_status_t model_scheduler_start(keel_scheduler_t *scheduler)
{
    keel_admission_t admission;
    uint32_t raw_us;
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL; /* SCH-010 */
    }
    raw_us = reading(scheduler);
    if (scheduler->stage != KEEL_STAGE_SETUP) {
        return KEEL_ERR_STATE; /* SCH-010 */
    }
    status = admit_all(scheduler, &admission);
    if (status == KEEL_OK) {
        /* SCH-009: time begins at 0 with this reading. */
        model_clock_init(&scheduler->clock, raw_us);
        scheduler->earliest_realtime_us = 0u; /* what was known was of another time */
        scheduler->stage = KEEL_STAGE_READY;
    }
    return status; /* SCH-010: for the first rule that the set breaks */
}

keel_status_t model_scheduler_step(keel_scheduler_t *scheduler)
{
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL; /* SCH-020 */
    }
    status = model_pass_begin(scheduler, reading(scheduler));
    if ((status == KEEL_OK) && (scheduler->stage == KEEL_STAGE_PASS)) {
        status = model_pass_run(scheduler); /* SCH-020, SCH-023 */
    }
    return status;
}

uint32_t model_scheduler_idle_us(const keel_scheduler_t *scheduler, uint32_t latency_us,
                                 uint32_t longest_us)
{
    /* SCH-028: as from a reading now. */
    return (scheduler == NULL)
               ? 0u
               : model_pass_idle_us(scheduler, reading(scheduler), latency_us, longest_us);
}

keel_status_t model_scheduler_resync(keel_scheduler_t *scheduler)
{
    if (scheduler == NULL) {
        return KEEL_ERR_NULL; /* SCH-021 */
    }
    if (scheduler->stage != KEEL_STAGE_READY) {
        return KEEL_ERR_STATE; /* SCH-021 */
    }
    scheduler->clock.raw_us = reading(scheduler); /* SCH-021: the reading, and no time */
    return KEEL_OK;
}

const keel_task_config_t *model_scheduler_task(const keel_scheduler_t *scheduler, uint32_t position)
{
    if ((scheduler == NULL) || (position >= scheduler->queue.count)) {
        return NULL; /* SCH-024 */
    }
    return scheduler->queue.task[scheduler->queue.order[position]];
}

keel_status_t model_scheduler_report(const keel_scheduler_t *scheduler,
                                     const keel_task_config_t *task, keel_task_report_t *report)
{
    uint32_t position;
    uint32_t slot;

    if ((scheduler == NULL) || (task == NULL) || (report == NULL)) {
        return KEEL_ERR_NULL; /* SCH-025 */
    }
    position = model_queue_find(&scheduler->queue, task);
    if (position == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK; /* SCH-025 */
    }
    slot = scheduler->queue.order[position];
    report->release_us = scheduler->queue.release_us[slot];
    report->skipped = scheduler->queue.skipped[slot];
    report->stats = scheduler->queue.stats[slot];
    return KEEL_OK;
}
