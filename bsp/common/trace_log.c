/* SPDX-License-Identifier: Apache-2.0 */
#include "common/trace_log.h"

#include <stddef.h>
#include <string.h>

#define NAME_LENGTH 32u

#define BEGIN         0u
#define FLAGS         1u
#define FORMATS       2u
#define SUBSCRIPTIONS (FORMATS + KEEL_TRACE_TOPICS)
#define DEFINITIONS   (SUBSCRIPTIONS + KEEL_TRACE_TOPICS)

#define RUN_FIELDS  6u
#define TASK_FIELDS 7u

typedef struct field {
    const char *name;
    uint8_t type;
    uint8_t count;
} field_t;

/* Up to its end, or as much of it as there is room for; the rest is left. */
static void copy_text(char *to, const char *text, uint32_t room)
{
    for (uint32_t i = 0u; (i < room) && (text[i] != '\0'); i++) {
        to[i] = text[i];
    }
}

static void set_format(keel_ulog_format_t *format, const char *name, const field_t *field,
                       uint32_t fields)
{
    (void)memset(format, 0, sizeof *format);
    copy_text(format->name.text, name, KEEL_ULOG_NAME_LENGTH);
    format->fields = (uint8_t)fields;
    for (uint32_t i = 0u; i < fields; i++) {
        copy_text(format->field[i].name.text, field[i].name, KEEL_ULOG_NAME_LENGTH);
        format->field[i].type = field[i].type;
        format->field[i].count = field[i].count;
    }
}

void keel_trace_format(keel_ulog_format_t *format, uint32_t topic)
{
    static const field_t run[RUN_FIELDS] = {
        {"timestamp", KEEL_ULOG_UINT64, 1u}, {"late_us", KEEL_ULOG_UINT32, 1u},
        {"length_us", KEEL_ULOG_UINT32, 1u}, {"skipped", KEEL_ULOG_UINT16, 1u},
        {"slot", KEEL_ULOG_UINT8, 1u},       {"flags", KEEL_ULOG_UINT8, 1u}};
    static const field_t task[TASK_FIELDS] = {
        {"timestamp", KEEL_ULOG_UINT64, 1u},  {"period_us", KEEL_ULOG_UINT32, 1u},
        {"budget_us", KEEL_ULOG_UINT32, 1u},  {"guard_us", KEEL_ULOG_UINT32, 1u},
        {"slot", KEEL_ULOG_UINT8, 1u},        {"priority", KEEL_ULOG_UINT8, 1u},
        {"name", KEEL_ULOG_CHAR, NAME_LENGTH}};

    if (topic == KEEL_TRACE_TOPIC_RUN) {
        set_format(format, "run", run, RUN_FIELDS);
    } else {
        set_format(format, "task", task, TASK_FIELDS);
    }
}

/* The topic `task` but for its name, as it lies in memory. */
typedef struct task_head {
    uint64_t time_us;
    uint32_t period_us;
    uint32_t budget_us;
    uint32_t guard_us;
    uint8_t slot;
    uint8_t priority;
} task_head_t;

#define TASK_HEAD_BYTES (offsetof(task_head_t, priority) + 1u)

void keel_trace_run_message(keel_ulog_message_t *message, uint16_t number,
                            const keel_trace_run_t *run)
{
    keel_ulog_data(message, number);
    (void)keel_ulog_add(message, (const uint8_t *)run, KEEL_TRACE_RUN_BYTES);
}

void keel_trace_task_message(keel_ulog_message_t *message, uint16_t number,
                             const keel_scheduler_t *scheduler, uint8_t slot)
{
    const keel_queue_t *const queue = &scheduler->queue;
    const keel_task_config_t *const task = queue->task[slot];
    const task_head_t head = {.time_us = scheduler->clock.now_us,
                              .period_us = queue->period_us[slot],
                              .budget_us = queue->budget_us[slot],
                              .guard_us = scheduler->config.guard_us,
                              .slot = slot,
                              .priority = queue->priority[slot]};
    char name[NAME_LENGTH] = {0};

    if ((task != NULL) && (task->name != NULL)) {
        copy_text(name, task->name, NAME_LENGTH);
    }
    keel_ulog_data(message, number);
    (void)keel_ulog_add(message, (const uint8_t *)&head, TASK_HEAD_BYTES);
    (void)keel_ulog_add(message, (const uint8_t *)name, NAME_LENGTH);
}

void keel_trace_log_start(keel_trace_log_t *log, const keel_scheduler_t *scheduler,
                          keel_log_ring_t *ring)
{
    *log = (keel_trace_log_t){.scheduler = scheduler, .ring = ring};
}

/* A part of what a log begins with. */
static void define(keel_trace_log_t *log, uint32_t number)
{
    keel_ulog_format_t format;

    if (number == BEGIN) {
        keel_ulog_begin(&log->message, log->scheduler->clock.now_us);
    } else if (number == FLAGS) {
        keel_ulog_flags(&log->message);
    } else if (number < SUBSCRIPTIONS) {
        keel_trace_format(&format, number - FORMATS);
        (void)keel_ulog_format(&log->message, &format);
    } else {
        keel_trace_format(&format, number - SUBSCRIPTIONS);
        keel_ulog_subscription(&log->message, 0u, (uint16_t)(number - SUBSCRIPTIONS), &format.name);
    }
}

/* The next record, unless one is at hand. */
static bool take(keel_trace_log_t *log)
{
    if (!log->has_run && (keel_log_ring_held(log->ring) >= KEEL_TRACE_RUN_BYTES)) {
        (void)keel_log_ring_read(log->ring, (uint8_t *)&log->run, KEEL_TRACE_RUN_BYTES);
        log->has_run = true;
        if ((log->run.flags & KEEL_TRACE_FIRST) != 0u) {
            log->told[log->run.slot] = false; /* Who was in the slot before is another one. */
        }
    }
    return log->has_run;
}

static void tell(keel_trace_log_t *log)
{
    const uint8_t slot = log->run.slot;

    if ((log->run.flags & KEEL_TRACE_LOST) != 0u) {
        keel_ulog_dropout(&log->message, log->run.length_us);
        log->has_run = false;
    } else if (!log->told[slot]) {
        keel_trace_task_message(&log->message, KEEL_TRACE_TOPIC_TASK, log->scheduler, slot);
        log->told[slot] = true;
    } else {
        keel_trace_run_message(&log->message, KEEL_TRACE_TOPIC_RUN, &log->run);
        log->has_run = false;
    }
}

bool keel_trace_log_next(keel_trace_log_t *log)
{
    bool there = true;

    if (log->defined < DEFINITIONS) {
        define(log, log->defined);
        log->defined++;
    } else if (take(log)) {
        tell(log);
    } else {
        there = false;
    }
    return there;
}
