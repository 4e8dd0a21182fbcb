/* SPDX-License-Identifier: Apache-2.0 */
/* The log: its beginning, samples of its topics, and its task, which moves them to the port. */
#include "common/trace_log.h"
#include "copter.h"
#include "obstacle.h"

#include <string.h>

#define PERIOD_US 10000u
#define WCET_US   100u
#define BUDGET_US 112u
#define PHASE_US  3500u

#define ROUNDS_PER_S 100u
#define DEFINITIONS  4u    /* In a run. */
#define CHUNK        1280u /* Bytes in a run, and so 125 kB/s: two runs of 100 move none. */
#define LINE         50u   /* Letters of a line of text. */

static const keel_ulog_name_t system_name = {"sys_name"};
static const char keel_name[] = "Keel";
static const keel_ulog_name_t restart_name = {"restart"};

static const keel_ulog_field_t time_field = {
    .name = {"timestamp"}, .type = KEEL_ULOG_UINT64, .count = 1u};

static const char *const state_name[KEEL_MODE_STATES] = {
    [KEEL_MODE_DISARMED] = "disarmed",    [KEEL_MODE_ARMED] = "armed",
    [KEEL_MODE_FLYING] = "flying",        [KEEL_MODE_HOLDING] = "holding",
    [KEEL_MODE_RETURNING] = "returning",  [KEEL_MODE_LANDING] = "landing",
    [KEEL_MODE_TERMINATED] = "terminated"};

static bool define_format(copter_log_t *log, const copter_topic_t *topic)
{
    keel_ulog_format_t format = {.name = topic->name, .fields = (uint8_t)(topic->fields + 1u)};

    format.field[0] = time_field;
    for (uint32_t i = 0u; i < topic->fields; i++) {
        format.field[i + 1u] = topic->field[i].is;
    }
    return (topic->instance == 0u) && keel_ulog_format(&log->message, &format);
}

/* The formats of runs and of tasks, then their numbers, which are behind those of the topics. */
static void define_trace(copter_log_t *log, uint32_t number)
{
    const uint32_t topic = number % KEEL_TRACE_TOPICS;
    keel_ulog_format_t format;

    keel_trace_format(&format, topic);
    if (number < KEEL_TRACE_TOPICS) {
        (void)keel_ulog_format(&log->message, &format);
    } else {
        keel_ulog_subscription(&log->message, 0u, (uint16_t)(copter_topics + topic), &format.name);
    }
}

/* The value in force. A bool is an int32 of 0 or 1. */
static bool define_parameter(copter_t *copter, uint16_t index)
{
    const keel_parameters_t *const table = &copter->parameters.table;
    const keel_parameter_value_t value = copter->parameters.in_force[index].value;
    const uint32_t bits = keel_parameter_bits(value);
    keel_ulog_name_t name = {.text = {0}};
    uint8_t bytes[sizeof bits];

    memcpy(name.text, keel_parameters_name(table, index), KEEL_PARAMETER_NAME_LENGTH);
    memcpy(bytes, &bits, sizeof bytes);
    copter->log.parameter[index] = bits;
    return keel_ulog_parameter(&copter->log.message, &name,
                               (value.type == KEEL_PARAMETER_FLOAT) ? KEEL_ULOG_FLOAT
                                                                    : KEEL_ULOG_INT32,
                               bytes);
}

/* The begin, flag bits, the system's name, and why it started if nobody wanted it to. */
static bool define_head(copter_t *copter, uint32_t number)
{
    copter_log_t *const log = &copter->log;

    if (number == 0u) {
        keel_ulog_begin(&log->message, copter->scheduler.clock.now_us);
    } else if (number == 1u) {
        keel_ulog_flags(&log->message);
    } else if (number == 2u) {
        (void)keel_ulog_information(&log->message, &system_name, keel_name,
                                    (uint8_t)(sizeof keel_name - 1u));
    } else {
        (void)keel_ulog_information(&log->message, &restart_name, copter->port->restart,
                                    (uint8_t)strlen(copter->port->restart));
    }
    return true;
}

/* Whether a topic is in the log. */
static bool is_logged(const copter_log_t *log, const copter_topic_t *topic)
{
    return !(log->traces && topic->gives_way);
}

static bool define_subscription(copter_log_t *log, uint32_t number)
{
    const copter_topic_t *const topic = &copter_topic[number];

    keel_ulog_subscription(&log->message, topic->instance, (uint16_t)number, &topic->name);
    return is_logged(log, topic);
}

/* A part of what a log begins with becomes log->message; whether there is such a message. */
static bool define_part(copter_t *copter, uint32_t number)
{
    copter_log_t *const log = &copter->log;
    const uint32_t formats = (copter->port->restart != NULL) ? 4u : 3u;
    const uint32_t parameters = formats + copter_topics;
    const uint32_t trace = parameters + COPTER_PARAMETER_COUNT;
    const uint32_t subscriptions = trace + (log->traces ? (2u * KEEL_TRACE_TOPICS) : 0u);
    bool is_made = true;

    if (number < formats) {
        is_made = define_head(copter, number);
    } else if (number < parameters) {
        is_made = define_format(log, &copter_topic[number - formats]);
    } else if (number < trace) {
        is_made = define_parameter(copter, (uint16_t)(number - parameters));
    } else if (number < subscriptions) {
        define_trace(log, number - trace);
    } else {
        is_made = define_subscription(log, number - subscriptions);
    }
    log->samples = number == (subscriptions + copter_topics - 1u);
    return is_made;
}

static void write_definitions(copter_t *copter)
{
    copter_log_t *const log = &copter->log;
    const copter_port_t *const port = copter->port;

    for (uint32_t i = 0u; (i < DEFINITIONS) && !log->samples; i++) {
        if (port->log_room(port->context) < KEEL_ULOG_MESSAGE_BYTES) {
            return;
        }
        if (define_part(copter, log->defined)) {
            port->write_log(port->context, log->message.bytes, log->message.size);
        }
        log->defined++;
    }
}

/* A topic's data become log->message; whether they fit. */
static bool fill_topic(copter_t *copter, uint32_t number)
{
    copter_log_t *const log = &copter->log;
    const copter_topic_t *const topic = &copter_topic[number];
    const uint64_t now_us = copter->scheduler.clock.now_us;
    uint8_t time[sizeof now_us];
    bool fits;

    memcpy(time, &now_us, sizeof time);
    keel_ulog_data(&log->message, (uint16_t)number);
    fits = keel_ulog_add(&log->message, time, sizeof time);
    for (uint32_t i = 0u; i < topic->fields; i++) {
        const copter_log_field_t *const field = &topic->field[i];

        fits = keel_ulog_add(&log->message, (const uint8_t *)copter + field->offset,
                             keel_ulog_field_bytes(&field->is));
    }
    return fits;
}

/* Into the ring; when there is room again, behind what tells how long there was none. */
static void store_sample(copter_log_t *log, uint64_t now_us)
{
    keel_log_ring_loss_t loss;

    if (keel_log_ring_take_loss(&log->ring, KEEL_ULOG_DROPOUT_BYTES + log->message.size, &loss)) {
        keel_ulog_dropout(&log->dropout, now_us - loss.since_us);
        (void)keel_log_ring_write(&log->ring, log->dropout.bytes, log->dropout.size, now_us);
        log->lost += loss.records;
    }
    (void)keel_log_ring_write(&log->ring, log->message.bytes, log->message.size, now_us);
}

void copter_log_run(copter_t *copter)
{
    copter_log_t *const log = &copter->log;
    const keel_trace_run_t *const run = &log->trace.run;

    if (!log->samples) {
        return;
    }
    if (!log->told[run->slot] || ((run->flags & KEEL_TRACE_FIRST) != 0u)) {
        keel_trace_task_message(&log->message, (uint16_t)(copter_topics + KEEL_TRACE_TOPIC_TASK),
                                &copter->scheduler, run->slot);
        store_sample(log, run->start_us);
        log->told[run->slot] = true;
    }
    keel_trace_run_message(&log->message, (uint16_t)(copter_topics + KEEL_TRACE_TOPIC_RUN), run);
    store_sample(log, run->start_us);
}

void copter_log_runs(copter_t *copter)
{
    copter->log.traces = true;
    keel_trace_start(&copter->log.trace, &copter->scheduler);
}

/* A line of text for each state that begins. */
static void tell_state(copter_t *copter)
{
    copter_log_t *const log = &copter->log;
    const uint8_t state = copter->state.mode.state;
    const uint64_t now_us = copter->scheduler.clock.now_us;

    if (log->state != state) {
        log->state = state;
        if (keel_ulog_logging(&log->message, KEEL_ULOG_INFORMATION, now_us, state_name[state],
                              (uint8_t)strlen(state_name[state]))) {
            store_sample(log, now_us);
        }
    }
}

/* And one for each attempt to arm that failed. */
static void tell_refusal(copter_t *copter)
{
    copter_log_t *const log = &copter->log;
    const uint64_t now_us = copter->scheduler.clock.now_us;

    if (log->refusals != copter->state.refusals) {
        char line[LINE] = COPTER_NOT_ARMED;
        const uint32_t begun = (uint32_t)(sizeof COPTER_NOT_ARMED - 1u);
        const char *const words = copter_obstacle_first(&copter->state.mode);
        const uint32_t length = (uint32_t)strlen(words);
        const uint32_t taken = (length < (LINE - begun)) ? length : (LINE - begun);

        log->refusals = copter->state.refusals;
        memcpy(&line[begun], words, taken);
        if (keel_ulog_logging(&log->message, KEEL_ULOG_WARNING, now_us, line,
                              (uint8_t)(begun + taken))) {
            store_sample(log, now_us);
        }
    }
}

void copter_log_sample(copter_t *copter, uint32_t row)
{
    copter_log_t *const log = &copter->log;

    for (uint32_t i = 0u; log->samples && (i < copter_topics); i++) {
        const copter_topic_t *const topic = &copter_topic[i];

        if ((topic->row == row) && is_logged(log, topic)) {
            if (log->left[i] == 0u) {
                log->left[i] = topic->every;
                if (fill_topic(copter, i)) {
                    store_sample(log, copter->scheduler.clock.now_us);
                }
            }
            log->left[i]--;
        }
    }
    if (log->samples && (row == (uint32_t)URPILOT_STATE_MACHINE)) {
        tell_state(copter);
        tell_refusal(copter);
    }
}

/* How the tasks ran until now. */
static void look_at_tasks(copter_t *copter)
{
    copter_log_t *const log = &copter->log;

    for (uint32_t row = 0u; row < copter->tasks; row++) {
        keel_task_report_t report;

        if (keel_scheduler_report(&copter->scheduler, copter_declaration(row), &report) ==
            KEEL_OK) {
            log->runs[row] = report.stats.runs;
            log->busy_us[row] = (uint32_t)report.stats.total_us;
            log->longest_us[row] = report.stats.longest_us;
            log->skipped[row] = report.skipped;
        }
    }
}

/* The next one of all parameters, if its value in force is another than the log has. */
static void log_parameter(copter_t *copter)
{
    copter_log_t *const log = &copter->log;
    const uint16_t index = (uint16_t)((log->looked_at + 1u) % COPTER_PARAMETER_COUNT);

    log->looked_at = index;
    if ((keel_parameter_bits(copter->parameters.in_force[index].value) != log->parameter[index]) &&
        define_parameter(copter, index)) {
        store_sample(log, copter->scheduler.clock.now_us);
    }
}

/* From the ring to the port, as far as it has room. */
static void move_bytes(copter_t *copter)
{
    const copter_port_t *const port = copter->port;
    uint8_t chunk[CHUNK];
    const uint32_t room = port->log_room(port->context);

    port->write_log(port->context, chunk,
                    keel_log_ring_read(&copter->log.ring, chunk, (room < CHUNK) ? room : CHUNK));
}

/* Once a second a run looks at the tasks, and the next one logs them: all would be too much for
 * one. */
static void copter_log_task(copter_t *copter)
{
    copter_log_t *const log = &copter->log;

    write_definitions(copter);
    if (log->samples) {
        log_parameter(copter);
    }
    log->rounds = (log->rounds + 1u) % ROUNDS_PER_S;
    if (log->rounds == 1u) {
        look_at_tasks(copter);
    } else if (log->rounds == 2u) {
        copter_log_sample(copter, COPTER_LOG_ROW);
    } else {
        move_bytes(copter);
    }
}

keel_status_t copter_log_start(copter_t *copter)
{
    const copter_own_task_t own = {.name = "Log",
                                   .body = copter_log_task,
                                   .period_us = PERIOD_US,
                                   .wcet_us = WCET_US,
                                   .budget_us = BUDGET_US,
                                   .phase_us = PHASE_US};

    keel_log_ring_init(&copter->log.ring);
    for (uint32_t i = 0u; i < copter_topics; i++) { /* Topics of a task come in other runs of it. */
        copter->log.left[i] = (uint16_t)(i % copter_topic[i].every);
    }
    return copter_add(copter, &own);
}
