/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file task_table.h
 * @brief How each task has run since it was added, as lines of text: for a console or a link.
 *
 * The scheduler counts all of it but how late runs started. For that the body that all tasks share
 * hands over each run; the kernel knows nothing of it:
 *
 *     static void body(void *context)
 *     {
 *         keel_trace_begin(&trace, &scheduler);
 *         work(context);
 *         keel_task_table_add(&table, &trace.run);
 *     }
 *
 * A table is made a line at a time, so whoever prints it need not do so at once. A line tells of
 * its own moment.
 */
#ifndef KEEL_BSP_COMMON_TASK_TABLE_H
#define KEEL_BSP_COMMON_TASK_TABLE_H

#include "common/trace.h"
#include "keel/rtos/scheduler.h"

#include <stdint.h>

/** Ranges of lateness: less than 10, 30, 100, 300, 1000 and 3000 us, and what is left. */
#define KEEL_TASK_TABLE_BUCKETS 7u

/** Room for a line, which has its end of line, and a zero behind that. */
#define KEEL_TASK_TABLE_LINE 192u

/** How late runs started: how many in each range, by slots of the queue. All zero at first. */
typedef struct keel_task_table {
    uint32_t late[KEEL_QUEUE_CAPACITY][KEEL_TASK_TABLE_BUCKETS]; /**< Each stays at UINT32_MAX. */
} keel_task_table_t;

/**
 * Counts a run by its lateness (requirement TBL-001).
 *
 * @param table the table
 * @param run   of which keel_trace_begin has noted slot, lateness and flags
 */
void keel_task_table_add(keel_task_table_t *table, const keel_trace_run_t *run);

/**
 * Makes a line (requirements TBL-002 to TBL-004): line 0 is about all tasks, line 1 has headings,
 * each other one is a task's, in the queue's order.
 *
 * @param table     the table
 * @param scheduler whose tasks they are
 * @param number    of the line
 * @param line      written
 * @return its characters, without the zero behind them; 0: there is no such line
 */
uint32_t keel_task_table_line(const keel_task_table_t *table, const keel_scheduler_t *scheduler,
                              uint32_t number, char line[KEEL_TASK_TABLE_LINE]);

#endif
