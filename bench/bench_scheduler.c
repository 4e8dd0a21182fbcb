/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bench_scheduler.c
 * @brief Runs the scheduler on a virtual clock so that callgrind can count the instructions of
 *        each pass. Started by tools/keel bench; counts nothing outside valgrind.
 *
 *     bench_scheduler TASKS
 *
 * The simulation is run three times, each time the same. The first run learns what each pass does,
 * the second collects the passes of steady waiting in one dump, the third dumps every other pass
 * by itself. Each dump is labelled with the kind of its passes and their number.
 */
#include "keel/rtos/scheduler.h"
#include "urpilot_tasks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <valgrind/callgrind.h>

#define SIMULATED_US 100000u /* How long polling is simulated. */
#define POLL_US      5u      /* What one turn of the main loop takes, the tasks apart. */
#define PASSES_MAX   (SIMULATED_US / POLL_US + 1u)
#define SUBSET_COUNT 8u
#define LABEL_SIZE   64u

/* What a pass did. */
typedef enum bench_kind {
    BENCH_WAITED,   /* Returned early: before the wake-up time. */
    BENCH_IDLE,     /* Found no task to run, and computed the wake-up time. */
    BENCH_REALTIME, /* Ran exactly one task, a real-time one. */
    BENCH_OTHER,    /* Ran exactly one task, not a real-time one. */
    BENCH_SEVERAL,  /* Ran several tasks. */
    BENCH_KINDS
} bench_kind_t;

static const char *const bench_kind_name[BENCH_KINDS] = {"waited", "idle", "realtime", "other",
                                                         "several"};

/* One of each class and the three real-time tasks: indices into table 2. */
static const uint32_t bench_subset[SUBSET_COUNT] = {10u, 11u, 17u, 18u, 7u, 6u, 13u, 3u};

typedef struct bench {
    uint32_t now_us;       /* The virtual clock. */
    uint32_t ran_realtime; /* Real-time tasks that the current pass has run. */
    uint32_t ran_other;    /* Others that it has run. */
    keel_scheduler_t scheduler;
} bench_t;

typedef struct bench_body {
    bench_t *bench;
    uint32_t wcet_us;
    uint32_t *counter; /* ran_realtime or ran_other. */
} bench_body_t;

static bench_t bench;
static bench_body_t bench_bodies[KEEL_QUEUE_CAPACITY];
static keel_task_config_t bench_configs[KEEL_QUEUE_CAPACITY];
static bench_kind_t bench_kinds[PASSES_MAX];

static uint32_t bench_clock(void *context)
{
    return ((bench_t *)context)->now_us;
}

static void bench_run(void *context)
{
    const bench_body_t *body = context;

    body->bench->now_us += body->wcet_us;
    (*body->counter)++;
}

static void bench_require(int condition, const char *what)
{
    if (!condition) {
        (void)fprintf(stderr, "bench_scheduler: %s\n", what);
        exit(EXIT_FAILURE);
    }
}

/* Row i of a set of n tasks: the subset for a small one, else table 2 again and again. */
static uint32_t bench_row(uint32_t i, uint32_t n)
{
    return (n <= SUBSET_COUNT) ? bench_subset[i] : (i % URPILOT_TASK_COUNT);
}

static void bench_add(uint32_t i, uint32_t n)
{
    const uint32_t table_row = bench_row(i, n);
    const urpilot_task_t *row = &urpilot_task[table_row];
    const bool realtime = row->priority == KEEL_PRIORITY_REALTIME;
    /* As many copies of table 2 as the set holds, each as much slower. */
    const uint32_t stretch = (n + URPILOT_TASK_COUNT - 1u) / URPILOT_TASK_COUNT;

    bench_bodies[i] = (bench_body_t){&bench, row->wcet_us,
                                     realtime ? &bench.ran_realtime : &bench.ran_other};
    bench_configs[i] = urpilot_task_config(table_row, bench_run, &bench_bodies[i]);
    bench_configs[i].period_us *= stretch;
    bench_configs[i].phase_us = 0u; /* All released together: the longest passes. */
    bench_require(keel_scheduler_add(&bench.scheduler, &bench_configs[i]) == KEEL_OK,
                  "add refuses");
}

static void bench_begin(uint32_t n)
{
    const keel_scheduler_config_t config = urpilot_scheduler_config(bench_clock, &bench);

    (void)memset(&bench, 0, sizeof(bench));
    bench_require(keel_scheduler_init(&bench.scheduler, &config) == KEEL_OK, "init refuses");
    for (uint32_t i = 0u; i < n; i++) {
        bench_add(i, n);
    }
    bench_require(keel_scheduler_start(&bench.scheduler) == KEEL_OK, "start refuses");
}

/* What the pass that just ended did; waits tells whether it began before the wake-up time. */
static bench_kind_t bench_kind(bool waits)
{
    const uint32_t ran = bench.ran_realtime + bench.ran_other;

    if (ran == 0u) {
        return waits ? BENCH_WAITED : BENCH_IDLE;
    }
    if (ran > 1u) {
        return BENCH_SEVERAL;
    }
    return (bench.ran_realtime == 1u) ? BENCH_REALTIME : BENCH_OTHER;
}

static void bench_step(bool collect)
{
    keel_status_t status;

    if (collect) {
        CALLGRIND_TOGGLE_COLLECT;
    }
    status = keel_scheduler_step(&bench.scheduler);
    if (collect) {
        CALLGRIND_TOGGLE_COLLECT;
    }
    bench_require(status == KEEL_OK, "step fails");
}

static void bench_dump(bench_kind_t kind, uint32_t passes)
{
    char label[LABEL_SIZE];

    (void)snprintf(label, sizeof(label), "keel %s %u", bench_kind_name[kind], (unsigned)passes);
    CALLGRIND_DUMP_STATS_AT(label);
}

/* One pass: its kind is learnt, or is the one that was learnt. */
static bench_kind_t bench_pass(bool collect)
{
    const bool waits = bench.now_us < bench.scheduler.wake_us;

    bench.ran_realtime = 0u;
    bench.ran_other = 0u;
    bench_step(collect);
    return bench_kind(waits);
}

static uint32_t bench_learn(uint32_t n)
{
    uint32_t passes = 0u;

    bench_begin(n);
    while (bench.now_us < SIMULATED_US) {
        bench_kinds[passes++] = bench_pass(false);
        bench.now_us += POLL_US;
    }
    return passes;
}

/* Collects the passes of steady waiting, all in one dump. */
static void bench_collect_waiting(uint32_t n, uint32_t passes)
{
    uint32_t waited = 0u;

    bench_begin(n);
    for (uint32_t i = 0u; i < passes; i++) {
        const bool collect = bench_kinds[i] == BENCH_WAITED;

        bench_require(bench_pass(collect) == bench_kinds[i], "two runs differ");
        waited += collect ? 1u : 0u;
        bench.now_us += POLL_US;
    }
    bench_dump(BENCH_WAITED, waited);
}

/* Collects every other pass, one dump each. */
static void bench_collect_passes(uint32_t n, uint32_t passes)
{
    bench_begin(n);
    for (uint32_t i = 0u; i < passes; i++) {
        const bool collect = bench_kinds[i] != BENCH_WAITED;

        bench_require(bench_pass(collect) == bench_kinds[i], "two runs differ");
        if (collect) {
            bench_dump(bench_kinds[i], 1u);
        }
        bench.now_us += POLL_US;
    }
}

int main(int argc, char **argv)
{
    const unsigned long n = (argc == 2) ? strtoul(argv[1], NULL, 10) : 0u;
    uint32_t passes;

    bench_require((n > 0u) && (n <= KEEL_QUEUE_CAPACITY), "usage: bench_scheduler TASKS");
    passes = bench_learn((uint32_t)n);
    bench_collect_waiting((uint32_t)n, passes);
    bench_collect_passes((uint32_t)n, passes);
    (void)printf("%u passes\n", (unsigned)passes);
    return EXIT_SUCCESS;
}
