/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file main.c
 * @brief The paper's 21 tasks on the virtual board, each run of them in a log: see the schedule.
 *
 *     traced FILE [SECONDS]
 *
 * `make generate NAME=schedule` builds it for this machine, runs it, and draws the log. It shows
 * what a firmware does to be traced: the body that all tasks share makes a record of each run in a
 * ring, and what the ring holds goes out while nothing can be due. Without keel_trace_start it is
 * as any other.
 *
 * A task's body takes the task's worst-case time. Standard output gets a line for each task, with
 * what the scheduler itself counted, to hold the log against.
 *
 * Exit status: 0, or 1 when the log cannot be written, and 2 for a wrong command line.
 */
#include "common/trace.h"
#include "common/trace_log.h"
#include "host/host_board.h"
#include "keel/rtos/scheduler.h"
#include "urpilot_tasks.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define SECONDS      10u
#define SECONDS_MOST 3600u
#define NS_PER_S     UINT64_C(1000000000)
#define FIRST_US     (UINT32_MAX - 3000000u) /* The counter wraps 3 s after the start. */
#define EXIT_USAGE   2
#define DECIMAL      10

/* The cost of the scheduler's own work, as the analysed task set has it (urpilot.toml). */
#define TURN_NS     1000u
#define PASS_NS     11000u
#define DISPATCH_NS 1000u

static keel_scheduler_t scheduler;
static host_board_t board;
static keel_trace_t trace;
static keel_log_ring_t ring;
static keel_trace_log_t trace_log;
static keel_task_config_t declaration[URPILOT_TASK_COUNT];

static void body(void *context)
{
    const urpilot_task_t *const task = context;

    keel_trace_begin(&trace, &scheduler);
    host_board_work(&board, (uint64_t)task->wcet_us * HOST_NS_PER_US);
    keel_trace_end(&trace, &scheduler);
    keel_trace_store(&trace, &ring);
}

static keel_status_t start(void)
{
    const host_costs_t costs = {.turn_ns = TURN_NS, .pass_ns = PASS_NS, .dispatch_ns = DISPATCH_NS};
    const keel_scheduler_config_t config = urpilot_scheduler_config(host_board_read, &board);
    keel_status_t status;

    host_board_init(&board, &scheduler, &costs, FIRST_US);
    status = keel_scheduler_init(&scheduler, &config);
    for (uint32_t i = 0u; (i < URPILOT_TASK_COUNT) && (status == KEEL_OK); i++) {
        declaration[i] = urpilot_task_config(i, body, (void *)&urpilot_task[i]);
        status = keel_scheduler_add(&scheduler, &declaration[i]);
    }
    return (status == KEEL_OK) ? keel_scheduler_start(&scheduler) : status;
}

/* All that the trace has now; whether it could be written. */
static bool drain(FILE *file)
{
    bool good = true;

    while (good && keel_trace_log_next(&trace_log)) {
        const keel_ulog_message_t *const message = &trace_log.message;

        good = fwrite(message->bytes, 1u, message->size, file) == message->size;
    }
    return good;
}

/* The main loop of a firmware, but for the virtual clock and its end. */
static bool run(FILE *file, uint64_t end_ns)
{
    bool good = start() == KEEL_OK;

    keel_trace_start(&trace, &scheduler);
    keel_log_ring_init(&ring);
    keel_trace_log_start(&trace_log, &scheduler, &ring);
    while (good && (board.now_ns < end_ns)) {
        good = (keel_scheduler_step(&scheduler) == KEEL_OK) && drain(file);
        host_board_turn(&board);
        host_board_idle(&board, end_ns);
    }
    return good;
}

static void print_tasks(void)
{
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        keel_task_report_t report = {0};

        (void)keel_scheduler_report(&scheduler, &declaration[i], &report);
        (void)printf("task %s: runs %lu busy %llu longest %lu skipped %u promotions %u\n",
                     declaration[i].name, (unsigned long)report.stats.runs,
                     (unsigned long long)report.stats.total_us,
                     (unsigned long)report.stats.longest_us, (unsigned)report.skipped,
                     (unsigned)report.stats.promotions);
    }
}

/* 0 when it is none. */
static uint32_t seconds_of(const char *text)
{
    char *end = NULL;
    const unsigned long seconds = strtoul(text, &end, DECIMAL);

    return ((end != text) && (*end == '\0') && (seconds <= SECONDS_MOST)) ? (uint32_t)seconds : 0u;
}

int main(int argc, char **argv)
{
    const uint32_t seconds = (argc == 3) ? seconds_of(argv[2]) : SECONDS;
    FILE *file;
    bool good;

    if ((argc < 2) || (argc > 3) || (seconds == 0u)) {
        (void)fprintf(stderr, "usage: traced FILE [SECONDS], 1 to %u\n", SECONDS_MOST);
        return EXIT_USAGE;
    }
    file = fopen(argv[1], "wb");
    good = (file != NULL) && run(file, seconds * NS_PER_S);
    good = (file != NULL) && (fclose(file) == 0) && good;
    if (!good) {
        (void)fprintf(stderr, "traced: %s cannot be written\n", argv[1]);
        return EXIT_FAILURE;
    }
    print_tasks();
    return EXIT_SUCCESS;
}
