/* SPDX-License-Identifier: Apache-2.0 */
#include "drive.h"

#include "keel/rtos/scheduler.h"
#include "lockstep.h"
#include "model.h"

#include <inttypes.h>
#include <stdarg.h>
#include <string.h>

/* A few more tasks than the queue holds, so that it can be full. */
#define TASKS      ((int)KEEL_QUEUE_CAPACITY + 4)
#define MAX_RUNS   (2 * MODEL_TASKS) /* In one step; more means that it does not end. */
#define MAX_INSIDE 3                 /* Operations inside one run. */

/* The model has room for all of them. */
typedef char tasks_fit_the_model[(TASKS <= MODEL_TASKS) ? 1 : -1];

typedef enum inside_kind {
    INSIDE_ADD,
    INSIDE_REMOVE,
    INSIDE_REPORT,
    INSIDE_STEP,
    INSIDE_RESYNC
} inside_kind_t;

/* An operation inside a run, with what the kernel answered. */
typedef struct inside {
    inside_kind_t kind;
    int task;
    model_declaration_t is;
    keel_task_report_t report;
    keel_status_t status;
} inside_t;

/* A run, as it happened in the kernel; the model repeats it. */
typedef struct run {
    int task;
    uint32_t start_raw, end_raw;
    int insides;
    inside_t inside[MAX_INSIDE];
} run_t;

typedef struct session session_t;

typedef struct actor {
    keel_task_config_t config; /* Its address is the task. */
    session_t *session;
    bool queued; /* By the kernel's own answers. */
} actor_t;

struct session {
    const uint8_t *bytes;
    size_t left;
    keel_scheduler_t *kernel; /* It lies apart from the declarations. */
    actor_t actor[MODEL_TASKS];
    model_t model;
    uint32_t raw;  /* The counter. */
    uint32_t pace; /* How fast it goes on between steps. */
    run_t run[MAX_RUNS];
    int runs;
    drive_tally_t *tally;
    bool differs;
    char *difference;
    size_t room;
    FILE *trace;
};

/* --- Bytes into decisions --- */

/* A number below a bound; 0 when the bytes are used up. */
static uint32_t pick(session_t *s, uint32_t bound)
{
    uint32_t value = 0;

    for (uint32_t span = bound - 1; span > 0; span >>= 8) {
        value <<= 8;
        if (s->left > 0) {
            value |= *s->bytes;
            s->bytes++;
            s->left--;
        }
    }
    return value % bound;
}

static bool one_in(session_t *s, uint32_t bound)
{
    return pick(s, bound) == (bound - 1);
}

static uint32_t pick_period(session_t *s)
{
    switch (pick(s, 8)) {
    case 0:
        return 1 + pick(s, 16);
    case 1:
        return 1 + pick(s, 0x7FFFFFFF);
    case 2:
        return 1 + pick(s, 0x100000);
    case 3:
    case 4:
        return 100 * (1 + pick(s, 20)); /* Harmonic periods make ties. */
    default:
        return 50 + pick(s, 3000);
    }
}

static uint32_t pick_budget(session_t *s, uint32_t period)
{
    if (one_in(s, 16)) {
        return 1 + pick(s, period);
    }
    return 1 + (period / (8 + pick(s, 120)));
}

static uint32_t pick_priority(session_t *s)
{
    const uint32_t class = pick(s, 8);

    return (class < 4) ? (class + 1) : ((class < 7) ? KEEL_PRIORITY_REALTIME : KEEL_PRIORITY_HIGH);
}

/* Makes a declaration wrong in one way. */
static void spoil(session_t *s, model_declaration_t *is)
{
    switch (pick(s, 8)) {
    case 0:
    case 1:
        is->has_body = false;
        break;
    case 2:
        is->period = 0;
        break;
    case 3:
        is->period = 0x80000000u + pick(s, 2);
        break;
    case 4:
        is->phase = is->period;
        break;
    case 5:
        is->budget = 0;
        break;
    case 6:
        is->priority = 5 + pick(s, 11);
        break;
    default:
        is->priority = 0;
        break;
    }
}

static model_declaration_t pick_declaration(session_t *s)
{
    const uint32_t period = pick_period(s);
    const uint32_t budget = pick_budget(s, period);
    const uint32_t phase = (pick(s, 2) == 0) ? 0 : pick(s, period);
    model_declaration_t is = {true, period, budget, phase, pick_priority(s)};

    if (one_in(s, 24)) {
        spoil(s, &is);
    }
    return is;
}

/* --- Differences --- */

__attribute__((format(printf, 2, 3))) static void tell(const session_t *s, const char *format, ...)
{
    va_list arguments;

    if (s->trace != NULL) {
        va_start(arguments, format);
        vfprintf(s->trace, format, arguments);
        va_end(arguments);
    }
}

__attribute__((format(printf, 2, 3))) static void differ(session_t *s, const char *format, ...)
{
    va_list arguments;

    if (!s->differs) {
        va_start(arguments, format);
        vsnprintf(s->difference, s->room, format, arguments);
        va_end(arguments);
    }
    s->differs = true;
}

static void same(session_t *s, const char *what, int task, uint64_t kernel, uint64_t model)
{
    if (kernel != model) {
        differ(s, "%s (task %d): kernel %" PRIu64 ", model %" PRIu64, what, task, kernel, model);
    }
}

static void same_status(session_t *s, const char *what, keel_status_t kernel, keel_status_t model)
{
    tell(s, "  %s -> %d\n", what, (int)kernel);
    s->tally->operations++;
    s->tally->status[(unsigned)kernel < DRIVE_STATUSES ? kernel : KEEL_OK]++;
    same(s, what, MODEL_NO_TASK, (uint64_t)kernel, (uint64_t)model);
}

static uint64_t at_most(uint64_t value, uint64_t limit)
{
    return (value < limit) ? value : limit;
}

static void same_report(session_t *s, int i, const keel_task_report_t *kernel)
{
    const model_task_t *const model = &s->model.task[i];

    same(s, "release", i, kernel->release_us, model->release);
    same(s, "skipped", i, kernel->skipped, at_most(model->skipped, UINT16_MAX));
    same(s, "runs", i, kernel->stats.runs, at_most(model->runs, UINT32_MAX));
    same(s, "total", i, kernel->stats.total_us, model->total);
    same(s, "last", i, kernel->stats.last_us, model->last);
    same(s, "longest", i, kernel->stats.longest_us, model->longest);
    same(s, "remembered", i, kernel->stats.remembered_us, model->remembered);
    same(s, "forgotten in", i, kernel->stats.forgotten_in,
         (model->remembered > 0) ? (8 - model->in_a_row) : 0);
    same(s, "overruns", i, kernel->stats.overruns, at_most(model->overruns, UINT16_MAX));
    same(s, "promotions", i, kernel->stats.promotions, at_most(model->promotions, UINT16_MAX));
}

static keel_status_t report_status(const session_t *s, int task)
{
    return model_holds(&s->model, task) ? KEEL_OK : KEEL_ERR_UNKNOWN_TASK;
}

static void same_task(session_t *s, int i)
{
    keel_task_report_t report;
    const keel_status_t status = keel_scheduler_report(s->kernel, &s->actor[i].config, &report);

    same(s, "report", i, (uint64_t)status, (uint64_t)report_status(s, i));
    if (status == KEEL_OK) {
        same_report(s, i, &report);
    }
}

static const keel_task_config_t *task_of(session_t *s, int task)
{
    return (task == MODEL_NO_TASK) ? NULL : &s->actor[task].config;
}

static void same_position(session_t *s, int position, int task)
{
    if (keel_scheduler_task(s->kernel, (uint32_t)position) != task_of(s, task)) {
        differ(s, "queue: position %d does not hold task %d", position, task);
    }
}

/* Every slot stands in the order once, and a free one holds no task. */
static void whole_queue(session_t *s)
{
    const keel_queue_t *const queue = &s->kernel->queue;
    bool seen[KEEL_QUEUE_CAPACITY] = {false};

    for (uint32_t i = 0; i < KEEL_QUEUE_CAPACITY; i++) {
        const uint32_t slot = queue->order[i];

        if ((slot >= KEEL_QUEUE_CAPACITY) || seen[slot]) {
            differ(s, "queue: the order holds slot %" PRIu32 " twice, or it is none", slot);
            return;
        }
        seen[slot] = true;
        if ((i >= queue->count) && (queue->task[slot] != NULL)) {
            differ(s, "queue: free slot %" PRIu32 " holds a task", slot);
        }
    }
}

static void same_queue(session_t *s)
{
    const model_t *const m = &s->model;
    const int count = m->realtime.length + m->others.length;

    same(s, "count", MODEL_NO_TASK, s->kernel->queue.count, (uint64_t)count);
    same(s, "realtime_count", MODEL_NO_TASK, s->kernel->queue.realtime_count,
         (uint64_t)m->realtime.length);
    for (int i = 0; i <= (int)KEEL_QUEUE_CAPACITY; i++) {
        if (i < m->realtime.length) {
            same_position(s, i, m->realtime.item[i]);
        } else if (i < count) {
            same_position(s, i, m->others.item[i - m->realtime.length]);
        } else {
            same_position(s, i, MODEL_NO_TASK);
        }
    }
    whole_queue(s);
}

static void same_running(session_t *s)
{
    const keel_scheduler_t *const k = s->kernel;

    if (keel_scheduler_task(k, (uint32_t)k->running) != task_of(s, s->model.running)) {
        differ(s, "running: position %d is not task %d", k->running, s->model.running);
    }
    if (s->model.running == MODEL_NO_TASK) {
        same(s, "running", MODEL_NO_TASK, (uint64_t)k->running, (uint64_t)KEEL_POSITION_NONE);
    }
}

/* The kernel sleeps as long as it may, and only behind a pass that found nothing to run. */
static void same_wake(session_t *s)
{
    const model_t *const m = &s->model;

    same(s, "wake", MODEL_NO_TASK, s->kernel->wake_us, m->idle ? model_wake(m) : 0);
}

/* A sleeping kernel is between two passes; the model, which never sleeps, has closed its pass. */
static void same_stage(session_t *s)
{
    static const int16_t stage[] = {KEEL_STAGE_SETUP, KEEL_STAGE_READY, KEEL_STAGE_PASS};
    const model_t *const m = &s->model;
    const int16_t running = m->serving_realtime ? KEEL_STAGE_REALTIME : KEEL_STAGE_OTHER;

    same(s, "stage", MODEL_NO_TASK, (uint64_t)s->kernel->stage,
         (uint64_t)((m->stage == RUNNING) ? running : stage[m->stage]));
}

/* Each call so far has left and answered what the executable specification says. */
static void same_as_specified(session_t *s)
{
    const char *const function = lockstep_difference();

    if (function != NULL) {
        differ(s, "%s: not what specs/model says", function);
    }
}

static void same_everything(session_t *s)
{
    same_as_specified(s);
    same_queue(s);
    for (int i = 0; i < TASKS; i++) {
        same_task(s, i);
    }
    same(s, "now", MODEL_NO_TASK, s->kernel->clock.now_us, s->model.now);
    same(s, "raw", MODEL_NO_TASK, s->kernel->clock.raw_us, s->model.raw);
    same(s, "busy", MODEL_NO_TASK, s->kernel->busy_us, s->model.busy);
    same_stage(s);
    same_running(s);
    same_wake(s);
}

/* --- Operations on both --- */

static uint32_t read_counter(void *context)
{
    return ((session_t *)context)->raw;
}

static void body(void *context);

static void declare(actor_t *actor, const model_declaration_t *is)
{
    actor->config.run = is->has_body ? body : NULL;
    actor->config.context = actor;
    actor->config.period_us = (uint32_t)is->period;
    actor->config.budget_us = (uint32_t)is->budget;
    actor->config.phase_us = (uint32_t)is->phase;
    actor->config.priority = (uint32_t)is->priority;
}

/* Lets the counter go on. */
static void pass_time(session_t *s, uint32_t us)
{
    const uint32_t before = s->raw;

    s->raw = (uint32_t)((uint64_t)before + us);
    s->tally->wraps += (s->raw < before) ? 1 : 0;
}

static keel_status_t kernel_add(session_t *s, int task, const model_declaration_t *is)
{
    actor_t *const actor = &s->actor[task];
    keel_status_t status;

    if (!actor->queued) {
        declare(actor, is);
    }
    status = lockstep_add(s->kernel, &actor->config);
    actor->queued = actor->queued || (status == KEEL_OK);
    return status;
}

static keel_status_t kernel_remove(session_t *s, int task)
{
    const keel_status_t status = lockstep_remove(s->kernel, &s->actor[task].config);

    s->actor[task].queued = s->actor[task].queued && (status != KEEL_OK);
    return status;
}

static keel_status_t add_to_model(session_t *s, int task, const model_declaration_t *is)
{
    if (!model_holds(&s->model, task)) {
        s->model.task[task].is = *is;
    }
    return model_add(&s->model, task);
}

static void add_task(session_t *s, int task, model_declaration_t is)
{
    const keel_status_t status = kernel_add(s, task, &is);

    tell(s, "add task %d: period %" PRIu64 " budget %" PRIu64 " phase %" PRIu64, task, is.period,
         is.budget, is.phase);
    tell(s, " priority %" PRIu64 "%s\n", is.priority, is.has_body ? "" : " bodiless");
    same_status(s, "add", status, add_to_model(s, task, &is));
}

static void do_add(session_t *s)
{
    const int task = (int)pick(s, (uint32_t)TASKS);

    add_task(s, task, pick_declaration(s));
}

/* Tasks so light that the queue is full before the processor is. */
static void add_crowd(session_t *s)
{
    for (int i = 0; i < TASKS; i++) {
        const model_declaration_t is = {true, 100000, 1 + pick(s, 8), 0, 1 + pick(s, 4)};

        add_task(s, i, is);
    }
}

static void remove_task(session_t *s, int task)
{
    const keel_status_t status = kernel_remove(s, task);

    tell(s, "remove task %d\n", task);
    same_status(s, "remove", status, model_remove(&s->model, task));
}

static void do_check(session_t *s)
{
    uint32_t kernel = UINT32_MAX;
    int model = -1;
    const keel_status_t status = lockstep_check(s->kernel, &kernel);

    same_status(s, "check", status, model_check(&s->model, &model));
    same(s, "admitted", MODEL_NO_TASK, kernel, (uint64_t)model);
}

static void do_start(session_t *s)
{
    const keel_status_t status = lockstep_start(s->kernel);

    same_status(s, "start", status, model_start(&s->model, s->raw));
}

static void do_resync(session_t *s)
{
    const keel_status_t status = lockstep_resync(s->kernel);

    same_status(s, "resync", status, model_resync(&s->model, s->raw));
}

static void report_nulls(session_t *s)
{
    const keel_task_config_t *const task = &s->actor[0].config;
    keel_task_report_t report;

    same_status(s, "report null", keel_scheduler_report(s->kernel, NULL, &report), KEEL_ERR_NULL);
    same_status(s, "report of null", keel_scheduler_report(NULL, task, &report), KEEL_ERR_NULL);
    same_status(s, "report to null", keel_scheduler_report(s->kernel, task, NULL), KEEL_ERR_NULL);
    if (keel_scheduler_task(NULL, 0) != NULL) {
        differ(s, "no scheduler has a task");
    }
}

static void do_nulls(session_t *s)
{
    same_status(s, "add null", lockstep_add(s->kernel, NULL), KEEL_ERR_NULL);
    same_status(s, "add to null", keel_scheduler_add(NULL, &s->actor[0].config), KEEL_ERR_NULL);
    same_status(s, "remove null", lockstep_remove(s->kernel, NULL), KEEL_ERR_NULL);
    same_status(s, "start null", keel_scheduler_start(NULL), KEEL_ERR_NULL);
    same_status(s, "step null", keel_scheduler_step(NULL), KEEL_ERR_NULL);
    same_status(s, "resync null", keel_scheduler_resync(NULL), KEEL_ERR_NULL);
    if (keel_scheduler_idle_us(NULL, 0, UINT32_MAX) != 0) {
        differ(s, "no scheduler may sleep");
    }
    report_nulls(s);
}

/* --- Runs --- */

static inside_kind_t pick_inside(session_t *s)
{
    static const inside_kind_t kinds[] = {
        INSIDE_ADD,    INSIDE_ADD,    INSIDE_ADD,    INSIDE_ADD,    INSIDE_ADD,    INSIDE_ADD,
        INSIDE_REMOVE, INSIDE_REMOVE, INSIDE_REMOVE, INSIDE_REMOVE, INSIDE_REMOVE, INSIDE_REMOVE,
        INSIDE_REPORT, INSIDE_REPORT, INSIDE_STEP,   INSIDE_RESYNC};

    return kinds[pick(s, (uint32_t)(sizeof kinds / sizeof kinds[0]))];
}

static void act_inside(session_t *s, run_t *run)
{
    inside_t *const inside = &run->inside[run->insides];

    run->insides++;
    inside->kind = pick_inside(s);
    inside->task = one_in(s, 3) ? run->task : (int)pick(s, (uint32_t)TASKS);
    switch (inside->kind) {
    case INSIDE_ADD:
        inside->is = pick_declaration(s);
        inside->status = kernel_add(s, inside->task, &inside->is);
        break;
    case INSIDE_REMOVE:
        inside->status = kernel_remove(s, inside->task);
        break;
    case INSIDE_REPORT:
        inside->status = keel_scheduler_report(s->kernel, &s->actor[inside->task].config,
                                               &inside->report);
        break;
    case INSIDE_STEP:
        inside->status = keel_scheduler_step(s->kernel);
        break;
    default:
        inside->status = lockstep_resync(s->kernel);
        break;
    }
}

static uint32_t pick_cost(session_t *s, uint32_t budget)
{
    switch (pick(s, 16)) {
    case 0:
        return 0;
    case 1:
        return budget;
    case 2:
        return budget + 1 + pick(s, 64);
    case 3:
        return 1 + pick(s, 4096);
    case 4:
        return one_in(s, 32) ? (0x7FFFFFF0u + pick(s, 32)) : budget;
    default:
        return pick(s, budget);
    }
}

/* The body of every task: notes that it runs, does something, and takes its time. */
static void body(void *context)
{
    const actor_t *const actor = context;
    session_t *const s = actor->session;
    const uint32_t budget = (actor->config.budget_us > 0) ? actor->config.budget_us : 1;
    run_t *run;

    if (s->runs == MAX_RUNS) {
        differ(s, "the step does not end");
        s->raw = (uint32_t)((uint64_t)s->raw + 0x80000000u); /* A clock that ends it. */
        return;
    }
    run = &s->run[s->runs];
    s->runs++;
    memset(run, 0, sizeof *run);
    run->task = (int)(actor - s->actor);
    run->start_raw = s->raw;
    while ((run->insides < MAX_INSIDE) && one_in(s, 10)) {
        act_inside(s, run);
    }
    pass_time(s, pick_cost(s, budget));
    run->end_raw = s->raw;
}

static keel_status_t repeat_inside(session_t *s, const inside_t *inside)
{
    switch (inside->kind) {
    case INSIDE_ADD:
        return add_to_model(s, inside->task, &inside->is);
    case INSIDE_REMOVE:
        return model_remove(&s->model, inside->task);
    case INSIDE_REPORT:
        if (inside->status == KEEL_OK) {
            same_report(s, inside->task, &inside->report);
        }
        return report_status(s, inside->task);
    case INSIDE_STEP:
        return model_begin(&s->model, 0);
    default:
        return model_resync(&s->model, 0);
    }
}

static void tally_inside(session_t *s, const run_t *run, const inside_t *inside)
{
    if (inside->status != KEEL_OK) {
        return;
    }
    s->tally->inside_reports += (inside->kind == INSIDE_REPORT) ? 1 : 0;
    s->tally->inside_adds += (inside->kind == INSIDE_ADD) ? 1 : 0;
    if (inside->kind == INSIDE_REMOVE) {
        s->tally->self_removes += (inside->task == run->task) ? 1 : 0;
        s->tally->inside_removes += (inside->task != run->task) ? 1 : 0;
    }
}

/* The model has decided for a task; the kernel must have run the same at the same time. */
static void repeat_run(session_t *s, const run_t *run, int task)
{
    static const char *const names[] = {"add inside", "remove inside", "report inside",
                                        "step inside", "resync inside"};

    tell(s, "  ran task %d from %" PRIu32 " to %" PRIu32 "\n", run->task, run->start_raw,
         run->end_raw);
    same(s, "task run", MODEL_NO_TASK, (uint64_t)run->task, (uint64_t)task);
    same(s, "start of the run", task, run->start_raw, s->model.raw);
    for (int i = 0; (i < run->insides) && !s->differs; i++) {
        tell(s, "  inside, task %d:\n", run->inside[i].task);
        same_status(s, names[run->inside[i].kind], run->inside[i].status,
                    repeat_inside(s, &run->inside[i]));
        tally_inside(s, run, &run->inside[i]);
    }
    s->tally->realtime_runs += s->model.serving_realtime ? 1 : 0;
    s->tally->other_runs += s->model.serving_realtime ? 0 : 1;
    s->tally->unpromoted += (s->model.without_promotion && !s->model.serving_realtime) ? 1 : 0;
}

static keel_status_t model_step(session_t *s, uint32_t raw)
{
    keel_status_t status = model_begin(&s->model, raw);
    int repeated = 0;

    while ((status == KEEL_OK) && !s->differs) {
        const int task = model_next(&s->model);

        if (task == MODEL_NO_TASK) {
            break;
        }
        if (repeated == s->runs) {
            differ(s, "the model runs task %d, the kernel nothing", task);
            break;
        }
        repeat_run(s, &s->run[repeated], task);
        status = model_finish(&s->model, s->run[repeated].end_raw);
        repeated++;
    }
    if (repeated < s->runs) {
        differ(s, "the kernel runs task %d, the model nothing", s->run[repeated].task);
    }
    return status;
}

static void do_step(session_t *s)
{
    const uint32_t raw = s->raw;
    const uint64_t wake = s->kernel->wake_us;
    keel_status_t status;

    tell(s, "step at %" PRIu32 "\n", raw);
    s->runs = 0;
    status = keel_scheduler_step(s->kernel);
    same_status(s, "step", status, model_step(s, raw));
    if ((status == KEEL_OK) && (s->kernel->clock.now_us < wake)) {
        s->tally->sleeping_steps++;
    }
}

/* --- Time --- */

/* How long until the kernel means to wake up, if that is soon. */
static uint32_t until_wake(const session_t *s)
{
    const uint64_t wake = s->kernel->wake_us;
    const uint64_t now = s->kernel->clock.now_us;

    return ((wake > now) && ((wake - now) < 0x7FFFFFFFu)) ? (uint32_t)(wake - now) : 1;
}

/* The longest sleep, of which the step behind it must be in time; or a shorter one. */
static void sleep_on(session_t *s)
{
    const uint32_t latency = pick(s, 0x100);
    const uint32_t longest = one_in(s, 4) ? pick(s, 0x1000) : UINT32_MAX;
    const uint32_t idle = lockstep_idle(s->kernel, latency, longest);

    if ((idle > 0) && ((s->kernel->clock.now_us + idle + latency) > model_wake(&s->model))) {
        differ(s, "a sleep of %" PRIu32 " is too long", idle);
    }
    pass_time(s, idle);
}

static void let_time_pass(session_t *s)
{
    switch (pick(s, 13)) {
    case 0:
    case 1:
        break;
    case 2:
        pass_time(s, 1);
        break;
    case 3:
        pass_time(s, until_wake(s));
        break;
    case 4:
        pass_time(s, until_wake(s) - 1);
        break;
    case 5:
        pass_time(s, pick(s, 0x10000));
        break;
    case 6:
        pass_time(s, one_in(s, 64) ? pick(s, 0x7FFFFFFF) : pick(s, 0x1000));
        break;
    case 7:
        sleep_on(s);
        break;
    default:
        pass_time(s, pick(s, s->pace));
        break;
    }
}

static void do_step_back(session_t *s)
{
    s->raw = (uint32_t)((uint64_t)s->raw + 0xFFFFFFFFu - pick(s, 4096));
    tell(s, "clock back to %" PRIu32 "\n", s->raw);
    do_step(s);
    if (!one_in(s, 4)) {
        do_resync(s);
    }
}

/* --- A step by its parts, with other operations in between --- */

static void do_outside(session_t *s)
{
    switch (pick(s, 8)) {
    case 0:
    case 1:
        do_add(s);
        break;
    case 2:
    case 3:
        remove_task(s, (int)pick(s, (uint32_t)TASKS));
        break;
    case 4:
        do_step(s); /* Refused. */
        break;
    case 5:
        do_resync(s);
        break;
    default:
        break;
    }
}

static int kernel_next(session_t *s)
{
    const keel_task_config_t *const task = lockstep_next(s->kernel);

    for (int i = 0; (i < TASKS) && (task != NULL); i++) {
        if (task == &s->actor[i].config) {
            return i;
        }
    }
    return MODEL_NO_TASK;
}

static void do_begin(session_t *s)
{
    const keel_status_t status = lockstep_begin(s->kernel, s->raw);
    const keel_status_t expected = model_begin(&s->model, s->raw);

    same_status(s, "begin", status, expected);
    if ((status == KEEL_OK) && (s->kernel->stage == KEEL_STAGE_READY)) {
        /* The kernel sleeps; then the model must have nothing to run. */
        same(s, "sleeps through", MODEL_NO_TASK, (uint64_t)MODEL_NO_TASK,
             (uint64_t)model_next(&s->model));
    }
}

static void do_next(session_t *s)
{
    const int task = kernel_next(s);

    tell(s, "next -> task %d\n", task);
    s->tally->operations++;
    same(s, "next", MODEL_NO_TASK, (uint64_t)task, (uint64_t)model_next(&s->model));
}

static void do_finish(session_t *s)
{
    const keel_status_t status = lockstep_finish(s->kernel, s->raw);

    same_status(s, "finish", status, model_finish(&s->model, s->raw));
}

static void do_parts(session_t *s)
{
    tell(s, "parts of a step at %" PRIu32 "\n", s->raw);
    do_begin(s);
    same_everything(s);
    for (int i = 0; (i < MAX_RUNS) && !s->differs; i++) {
        do_outside(s);
        same_everything(s);
        do_next(s);
        same_everything(s);
        if (s->model.stage != RUNNING) {
            return;
        }
        do_outside(s);
        same_everything(s);
        pass_time(s, pick(s, 200));
        do_finish(s);
        same_everything(s);
    }
}

/* --- A session --- */

static void begin_session(session_t *s)
{
    static const uint32_t starts[] = {0u, 0xFFFFFF00u, 0x7FFFFFF0u, 0xFFFF0000u};
    const uint32_t guard = one_in(s, 16) ? pick(s, 0x80000000u) : pick(s, 24);
    const uint32_t limit = one_in(s, 4) ? pick(s, 1000001u) : 1000000u;
    const bool without = one_in(s, 4);
    const keel_scheduler_config_t config = {read_counter, s, guard, limit, without};

    memset(s->kernel, 0, sizeof *s->kernel);
    memset(s->actor, 0, sizeof s->actor);
    for (int i = 0; i < MODEL_TASKS; i++) {
        s->actor[i].session = s;
    }
    s->raw = starts[pick(s, 4)];
    s->pace = 4u << (2 * pick(s, 4)); /* 4, 16, 64 or 256 us */
    tell(s, "init: guard %" PRIu32 " limit %" PRIu32 "%s\n", guard, limit,
         without ? " without promotion" : "");
    model_init(&s->model, (int)KEEL_QUEUE_CAPACITY, guard, limit, without);
    same_status(s, "init", keel_scheduler_init(s->kernel, &config), KEEL_OK);
}

static void do_bad_init(session_t *s)
{
    const keel_scheduler_config_t config = {read_counter, s, pick(s, 2) * 0x80000000u, 1000001u,
                                            false};

    same_status(s, "bad init", keel_scheduler_init(s->kernel, &config), KEEL_ERR_CONFIG);
    same_status(s, "null init", keel_scheduler_init(s->kernel, NULL), KEEL_ERR_NULL);
}

/* Adds some tasks and starts, leaving out those that are not admitted. */
static void set_up(session_t *s)
{
    const uint32_t adds = pick(s, (uint32_t)TASKS);

    if (one_in(s, 16)) {
        add_crowd(s);
    }
    for (uint32_t i = 0; i < adds; i++) {
        do_add(s);
    }
    do_step(s); /* Refused: not started. */
    do_start(s);
    while ((s->model.stage == SETTING_UP) && !s->differs) {
        int offender = 0;

        model_check(&s->model, &offender);
        remove_task(s, (offender < s->model.realtime.length)
                           ? s->model.realtime.item[offender]
                           : s->model.others.item[offender - s->model.realtime.length]);
        do_start(s);
    }
}

static void operate(session_t *s)
{
    const uint32_t kind = pick(s, 64);

    let_time_pass(s);
    if (kind < 44) {
        do_step(s);
    } else if (kind < 49) {
        do_add(s);
    } else if (kind < 52) {
        remove_task(s, (int)pick(s, (uint32_t)TASKS));
    } else if (kind < 58) {
        do_parts(s);
    } else if (kind == 58) {
        do_check(s);
    } else if (kind == 59) {
        do_step_back(s);
    } else if (kind == 60) {
        do_resync(s);
    } else if (kind == 61) {
        do_start(s); /* Refused: started. */
    } else if (kind == 62) {
        do_nulls(s);
    } else {
        do_bad_init(s);
    }
}

bool drive(const uint8_t *bytes, size_t size, drive_tally_t *tally, char *difference, size_t room,
           FILE *trace)
{
    static keel_scheduler_t kernel;
    static session_t session;
    session_t *const s = &session;

    memset(s, 0, sizeof *s);
    s->kernel = &kernel;
    s->bytes = bytes;
    s->left = size;
    s->tally = tally;
    s->difference = difference;
    s->room = room;
    s->trace = trace;
    begin_session(s);
    set_up(s);
    same_everything(s);
    while ((s->left > 0) && !s->differs) {
        operate(s);
        same_everything(s);
    }
    for (int i = 0; i < TASKS; i++) {
        s->tally->promotions += s->model.task[i].promotions;
        s->tally->forgotten += s->model.task[i].forgotten;
        s->tally->missed_releases += s->model.task[i].skipped;
        s->tally->overruns += s->model.task[i].overruns;
    }
    return !s->differs;
}
