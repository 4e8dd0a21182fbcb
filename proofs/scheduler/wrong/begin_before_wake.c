// harness: keel_scheduler_begin_harness
// expect: SCH_011_idle
//
// A pass opens before the wake-up time.
#include "keel/rtos/scheduler.h"

static bool config_is_valid(const keel_scheduler_config_t *config)
{
    return (config->guard_us < KEEL_PERIOD_LIMIT_US) &&
           (config->utilisation_limit <= KEEL_UTILISATION_FULL_PPM);
}

keel_status_t keel_scheduler_init(keel_scheduler_t *scheduler,
                                  const keel_scheduler_config_t *config)
{
    if ((scheduler == NULL) || (config == NULL) || (config->read_clock == NULL)) {
        return KEEL_ERR_NULL;
    }
    if (!config_is_valid(config)) {
        return KEEL_ERR_CONFIG;
    }
    keel_queue_init(&scheduler->queue);
    scheduler->config = *config;
    keel_clock_init(&scheduler->clock, 0u);
    scheduler->wake_us = 0u;
    scheduler->busy_us = 0u;
    scheduler->stage = KEEL_STAGE_SETUP;
    scheduler->cursor = 0u;
    scheduler->pass_end = 0u;
    scheduler->running = KEEL_INDEX_NONE;
    scheduler->ran = false;
    return KEEL_OK;
}

/* Admits the tasks in the queue in order, up to the first that is refused. */
static keel_status_t admit_queue(const keel_scheduler_t *scheduler, keel_admission_t *admission)
{
    keel_admission_init(admission, scheduler->config.guard_us, scheduler->config.utilisation_limit);
    return keel_admission_queue(admission, &scheduler->queue);
}

keel_status_t keel_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted)
{
    keel_admission_t admission;
    const keel_status_t status = admit_queue(scheduler, &admission);

    *admitted = (uint32_t)admission.tasks;
    return status;
}

/* Whether the queue with one more task can be scheduled. */
static keel_status_t admit_one_more(const keel_scheduler_t *scheduler,
                                    const keel_task_config_t *config)
{
    keel_admission_t admission;
    const keel_status_t status = admit_queue(scheduler, &admission);

    if (status != KEEL_OK) {
        return status;
    }
    return keel_admission_admit(&admission, config);
}

/* Puts a task that was found fit into the queue; the running task may move down by one slot. */
static keel_status_t insert(keel_scheduler_t *scheduler, keel_task_t *task)
{
    const uint32_t place = scheduler->queue.realtime_count;
    const keel_status_t status = keel_queue_add(&scheduler->queue, task);

    if (keel_task_is_realtime(task) && (scheduler->running != KEEL_INDEX_NONE) &&
        (scheduler->running >= place)) {
        scheduler->running++;
    }
    scheduler->wake_us = 0u;
    keel_task_arm(task, scheduler->clock.now_us);
    return status;
}

keel_status_t keel_scheduler_add(keel_scheduler_t *scheduler, keel_task_t *task)
{
    keel_status_t status;

    if ((scheduler == NULL) || (task == NULL)) {
        return KEEL_ERR_NULL;
    }
    status = keel_task_check(task->config);
    if (status != KEEL_OK) {
        return status;
    }
    if (keel_queue_find(&scheduler->queue, task) < scheduler->queue.count) {
        return KEEL_ERR_DUPLICATE;
    }
    if (scheduler->queue.count == KEEL_QUEUE_CAPACITY) {
        return KEEL_ERR_FULL;
    }
    if (scheduler->stage != KEEL_STAGE_SETUP) {
        status = admit_one_more(scheduler, task->config);
        if (status != KEEL_OK) {
            return status;
        }
    }
    return insert(scheduler, task);
}

/* Keeps the indices of a pass right when the task at an index goes. */
static void shift_up(keel_scheduler_t *scheduler, uint32_t index)
{
    if (index < scheduler->cursor) {
        scheduler->cursor--;
    }
    if (index < scheduler->pass_end) {
        scheduler->pass_end--;
    }
    if (scheduler->running == index) {
        scheduler->running = KEEL_INDEX_NONE;
    } else if ((scheduler->running != KEEL_INDEX_NONE) && (scheduler->running > index)) {
        scheduler->running--;
    } else {
        /* The running task stands before the gap, or there is none. */
    }
}

/* Takes the task at an index out of the queue and keeps the indices of the pass right. */
static keel_status_t take_out(keel_scheduler_t *scheduler, uint32_t index)
{
    keel_status_t status;

    shift_up(scheduler, index);
    scheduler->wake_us = 0u;
    status = keel_queue_remove(&scheduler->queue, index);
    return status;
}

keel_status_t keel_scheduler_remove(keel_scheduler_t *scheduler, keel_task_t *task)
{
    uint32_t index;

    if ((scheduler == NULL) || (task == NULL)) {
        return KEEL_ERR_NULL;
    }
    index = keel_queue_find(&scheduler->queue, task);
    if (index == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK;
    }
    return take_out(scheduler, index);
}

keel_status_t keel_scheduler_start_at(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    keel_admission_t admission;
    keel_status_t status;

    if (scheduler->stage != KEEL_STAGE_SETUP) {
        return KEEL_ERR_STATE;
    }
    status = admit_queue(scheduler, &admission);
    if (status != KEEL_OK) {
        return status;
    }
    keel_clock_init(&scheduler->clock, raw_us);
    scheduler->stage = KEEL_STAGE_READY;
    return KEEL_OK;
}

keel_status_t keel_scheduler_begin(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    keel_status_t status;

    if (scheduler->stage != KEEL_STAGE_READY) {
        return KEEL_ERR_STATE;
    }
    status = keel_clock_advance(&scheduler->clock, raw_us);
    if (status != KEEL_OK) {
        return status;
    }
    if ((scheduler->clock.now_us + 1u) < scheduler->wake_us) {
        return KEEL_OK;
    }
    scheduler->wake_us = 0u;
    scheduler->stage = KEEL_STAGE_PASS;
    scheduler->cursor = 0u;
    scheduler->pass_end = (uint16_t)scheduler->queue.realtime_count;
    scheduler->ran = false;
    return KEEL_OK;
}

/* Takes the task at an index into service: its next release, and what finish has to know. */
static keel_task_t *dispatch(keel_scheduler_t *scheduler, uint16_t index, uint16_t cursor,
                             uint8_t stage)
{
    keel_task_t *const task = scheduler->queue.task[index];

    keel_task_advance(task, scheduler->clock.now_us);
    scheduler->cursor = cursor;
    scheduler->running = index;
    scheduler->stage = stage;
    scheduler->ran = true;
    return task;
}

static bool is_promoted(const keel_task_t *task, uint64_t now_us)
{
    const uint32_t period_us = task->config->period_us;

    return keel_priority_promoted(task->config->priority, (now_us - task->release_us) + period_us,
                                  period_us);
}

/* Ends a pass in which nothing is left to run; sets the wake-up time if nothing ran at all, as
 * otherwise time has passed since the pass looked at the first tasks. */
static void close_pass(keel_scheduler_t *scheduler)
{
    if (!scheduler->ran) {
        scheduler->wake_us = keel_decision_wake_us(&scheduler->queue, scheduler->clock.now_us);
    }
    scheduler->cursor = scheduler->pass_end;
    scheduler->stage = KEEL_STAGE_READY;
}

keel_task_t *keel_scheduler_next(keel_scheduler_t *scheduler)
{
    const uint64_t now_us = scheduler->clock.now_us;
    keel_task_t *task = NULL;
    uint64_t slack_us;
    uint32_t index;

    if (scheduler->stage != KEEL_STAGE_PASS) {
        return NULL;
    }
    index = keel_decision_realtime(&scheduler->queue, scheduler->cursor, scheduler->pass_end,
                                   now_us);
    if (index < scheduler->pass_end) {
        return dispatch(scheduler, (uint16_t)index, (uint16_t)(index + 1u), KEEL_STAGE_REALTIME);
    }
    slack_us = keel_decision_slack_us(&scheduler->queue, now_us);
    index = keel_decision_other(&scheduler->queue, now_us, slack_us, scheduler->config.guard_us);
    if (index < scheduler->queue.count) {
        const bool by_promotion = is_promoted(scheduler->queue.task[index], now_us);

        task = dispatch(scheduler, (uint16_t)index, scheduler->pass_end, KEEL_STAGE_OTHER);
        if (by_promotion) {
            keel_stats_promote(&task->stats);
        }
    } else {
        close_pass(scheduler);
    }
    return task;
}

keel_status_t keel_scheduler_finish(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const uint64_t start_us = scheduler->clock.now_us;
    const uint16_t index = scheduler->running;
    const bool realtime = scheduler->stage == KEEL_STAGE_REALTIME;
    keel_status_t status;

    if (!realtime && (scheduler->stage != KEEL_STAGE_OTHER)) {
        return KEEL_ERR_STATE;
    }
    status = keel_clock_advance(&scheduler->clock, raw_us);
    /* With a broken clock the pass ends here; the caller learns why. */
    scheduler->stage = ((status == KEEL_OK) && realtime) ? KEEL_STAGE_PASS : KEEL_STAGE_READY;
    scheduler->running = KEEL_INDEX_NONE;
    scheduler->busy_us += scheduler->clock.now_us - start_us;
    if ((status == KEEL_OK) && (index != KEEL_INDEX_NONE)) {
        keel_task_t *const task = scheduler->queue.task[index];

        keel_stats_record(&task->stats, (uint32_t)(scheduler->clock.now_us - start_us),
                          task->config->budget_us);
    }
    return status;
}

static uint32_t read_clock(const keel_scheduler_t *scheduler)
{
    return scheduler->config.read_clock(scheduler->config.clock_context);
}

keel_status_t keel_scheduler_start(keel_scheduler_t *scheduler)
{
    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    return keel_scheduler_start_at(scheduler, read_clock(scheduler));
}

keel_status_t keel_scheduler_step(keel_scheduler_t *scheduler)
{
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    status = keel_scheduler_begin(scheduler, read_clock(scheduler));
    if (status != KEEL_OK) {
        return status;
    }
    while (scheduler->stage == KEEL_STAGE_PASS) {
        const keel_task_t *const task = keel_scheduler_next(scheduler);

        if (task != NULL) {
            task->config->run(task->config->context);
            status = keel_scheduler_finish(scheduler, read_clock(scheduler));
        }
    }
    return status;
}

keel_status_t keel_scheduler_resync(keel_scheduler_t *scheduler)
{
    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    if (scheduler->stage != KEEL_STAGE_READY) {
        return KEEL_ERR_STATE;
    }
    scheduler->clock.raw_us = read_clock(scheduler);
    return KEEL_OK;
}
