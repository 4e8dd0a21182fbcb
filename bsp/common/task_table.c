/* SPDX-License-Identifier: Apache-2.0 */
#include "common/task_table.h"

#include <stddef.h>

#define HEAD_LINES  2u
#define NAME_LENGTH 24u
#define DECIMAL     10u
#define NUMBER_ROOM 13u /* For the digits of 2^32 - 1, a point, a sign before it and a zero. */
#define US_PER_MS   1000u
#define MS_DIGITS   3u
#define PER_UNIT    10u    /* A mean has one digit behind the point. */
#define PER_WHOLE   10000u /* A load is in percent, and has two. */
#define LOAD_DIGITS 2u

/* Columns behind the name: those before the lateness, and those behind it. */
#define BEFORE 6u
#define BEHIND 3u

typedef struct column {
    const char *heading;
    uint32_t width; /* With a space before it. A number that needs more takes more. */
} column_t;

static const column_t before[BEFORE] = {{"period", 8u},  {"runs", 8u},   {"mean", 7u},
                                        {"longest", 8u}, {"budget", 7u}, {"load %", 7u}};
static const column_t behind[BEHIND] = {{"over", 6u}, {"prom", 6u}, {"skip", 6u}};

/* Of the buckets the last has what is later than all edges. */
#define LATE_WIDTH 7u
static const uint32_t edge_us[KEEL_TASK_TABLE_BUCKETS - 1u] = {10u, 30u, 100u, 300u, 1000u, 3000u};

/* A line that grows; what it has no room for is left out. */
typedef struct row_text {
    char *text;
    uint32_t length;
} row_text_t;

static void row_put(row_text_t *line, char c)
{
    if (line->length < (KEEL_TASK_TABLE_LINE - 1u)) {
        line->text[line->length] = c;
        line->length++;
    }
}

static void row_spaces(row_text_t *line, uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        row_put(line, ' ');
    }
}

static void row_append(row_text_t *line, const char *text)
{
    for (uint32_t i = 0u; text[i] != '\0'; i++) {
        row_put(line, text[i]);
    }
}

/* On the right of its column; behind a space at least. */
static void row_right(row_text_t *line, const char *text, uint32_t width)
{
    uint32_t length = 0u;

    while (text[length] != '\0') {
        length++;
    }
    row_spaces(line, (length < width) ? (width - length) : 1u);
    row_append(line, text);
}

/* A number, so many of whose digits are behind a point, and a zero, at the end of a text; returns
 * where it begins. */
static uint32_t row_digits(char text[NUMBER_ROOM], uint32_t value, uint32_t decimals)
{
    static const char digit[] = "0123456789";
    uint32_t first = NUMBER_ROOM - 1u;
    uint32_t rest = value;
    uint32_t digits = 0u;

    text[first] = '\0';
    while ((rest > 0u) || (digits <= decimals)) {
        if ((digits == decimals) && (digits > 0u)) {
            first--;
            text[first] = '.';
        }
        first--;
        text[first] = digit[rest % DECIMAL];
        rest /= DECIMAL;
        digits++;
    }
    return first;
}

static void row_number(row_text_t *line, uint32_t value, uint32_t decimals, uint32_t width)
{
    char text[NUMBER_ROOM];

    row_right(line, &text[row_digits(text, value, decimals)], width);
}

static uint32_t at_most_32_bits(uint64_t value)
{
    return (value < UINT32_MAX) ? (uint32_t)value : UINT32_MAX;
}

/* In hundredths of a percent. */
static uint32_t row_load(uint64_t busy_us, const keel_scheduler_t *scheduler)
{
    const uint64_t now_us = scheduler->clock.now_us;

    return (now_us > 0u) ? at_most_32_bits((busy_us * PER_WHOLE) / now_us) : 0u;
}

static void row_summary(row_text_t *line, const keel_scheduler_t *scheduler)
{
    row_append(line, "up");
    row_number(line, at_most_32_bits(scheduler->clock.now_us / US_PER_MS), MS_DIGITS, 0u);
    row_append(line, " s, load");
    row_number(line, row_load(scheduler->busy_us, scheduler), LOAD_DIGITS, 0u);
    row_append(line, " %; times in us, and runs by how late they started");
}

static void put_rights(row_text_t *line)
{
    row_append(line, "task");
    row_spaces(line, NAME_LENGTH - 4u);
    for (uint32_t i = 0u; i < BEFORE; i++) {
        row_right(line, before[i].heading, before[i].width);
    }
    for (uint32_t i = 0u; i < (KEEL_TASK_TABLE_BUCKETS - 1u); i++) {
        char text[NUMBER_ROOM];
        const uint32_t first = row_digits(text, edge_us[i], 0u) - 1u;

        text[first] = '<';
        row_right(line, &text[first], LATE_WIDTH);
    }
    row_right(line, "more", LATE_WIDTH);
    for (uint32_t i = 0u; i < BEHIND; i++) {
        row_right(line, behind[i].heading, behind[i].width);
    }
}

static void row_name(row_text_t *line, const char *name)
{
    uint32_t length = 0u;

    while ((name != NULL) && (length < NAME_LENGTH) && (name[length] != '\0')) {
        row_put(line, name[length]);
        length++;
    }
    row_spaces(line, NAME_LENGTH - length);
}

static void row_task(row_text_t *line, const keel_task_table_t *table,
                     const keel_scheduler_t *scheduler, uint32_t slot)
{
    const keel_queue_t *const queue = &scheduler->queue;
    const keel_stats_t *const stats = &queue->stats[slot];
    const uint64_t tenths_us = (stats->runs > 0u) ? ((stats->total_us * PER_UNIT) / stats->runs)
                                                  : 0u;

    row_name(line, queue->task[slot]->name);
    row_number(line, queue->period_us[slot], 0u, before[0].width);
    row_number(line, stats->runs, 0u, before[1].width);
    row_number(line, at_most_32_bits(tenths_us), 1u, before[2].width);
    row_number(line, stats->longest_us, 0u, before[3].width);
    row_number(line, queue->budget_us[slot], 0u, before[4].width);
    row_number(line, row_load(stats->total_us, scheduler), LOAD_DIGITS, before[5].width);
    for (uint32_t i = 0u; i < KEEL_TASK_TABLE_BUCKETS; i++) {
        row_number(line, table->late[slot][i], 0u, LATE_WIDTH);
    }
    row_number(line, stats->overruns, 0u, behind[0].width);
    row_number(line, stats->promotions, 0u, behind[1].width);
    row_number(line, queue->skipped[slot], 0u, behind[2].width);
}

void keel_task_table_add(keel_task_table_t *table, const keel_trace_run_t *run)
{
    uint32_t *const late = table->late[run->slot];
    uint32_t bucket = 0u;

    if ((run->flags & KEEL_TRACE_FIRST) != 0u) { /* What was there is of another task. */
        for (uint32_t i = 0u; i < KEEL_TASK_TABLE_BUCKETS; i++) {
            late[i] = 0u;
        }
    }
    while ((bucket < (KEEL_TASK_TABLE_BUCKETS - 1u)) && (run->late_us >= edge_us[bucket])) {
        bucket++;
    }
    late[bucket] += (late[bucket] < UINT32_MAX) ? 1u : 0u;
}

uint32_t keel_task_table_line(const keel_task_table_t *table, const keel_scheduler_t *scheduler,
                              uint32_t number, char line[KEEL_TASK_TABLE_LINE])
{
    const keel_queue_t *const queue = &scheduler->queue;
    row_text_t made = {.text = line};

    if (number == 0u) {
        row_summary(&made, scheduler);
    } else if (number == 1u) {
        put_rights(&made);
    } else if ((number - HEAD_LINES) < queue->count) {
        row_task(&made, table, scheduler, queue->order[number - HEAD_LINES]);
    } else {
        line[0] = '\0';
        return 0u;
    }
    row_put(&made, '\n');
    line[made.length] = '\0';
    return made.length;
}
