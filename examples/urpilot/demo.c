/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file demo.c
 * @brief The paper's 21 tasks on a virtual clock, for one simulated minute.
 *
 *     demo [POLL_US]
 *
 * What Keel does, seen without any hardware: `make check NAME=demo` builds it for this machine and
 * runs it.
 *
 * Time is a number that the demo owns. A task's body moves it on by the task's worst-case
 * execution time, and each turn of the main loop by POLL_US (5 us unless given): that is what the
 * scheduler itself and the loop around it are taken to cost. The counter starts half a minute
 * before it wraps, so the run crosses the wrap.
 *
 * Exit status: 0 when every task ran once per period and in time, 1 when not, 2 for a wrong
 * command line.
 */
#include "keel/rtos/deviation.h"
#include "keel/rtos/load.h"
#include "keel/rtos/scheduler.h"
#include "urpilot_tasks.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define DEMO_LENGTH_US  60000000u                /* One minute. */
#define DEMO_WINDOW_US  100000u                  /* Load is also measured in windows, as in V-C. */
#define DEMO_POLL_US    5u                       /* One turn of the main loop. */
#define DEMO_POLL_MAX   1000000u                 /* A slower loop is a typing error. */
#define DEMO_FIRST_TICK (UINT32_MAX - 30000000u) /* The counter at the start. */
#define EXIT_USAGE      2
#define PPM_PER_PERCENT 10000.0

/* The state of a task that the demo watches: the context of its body. */
typedef struct demo_task {
    const keel_task_config_t *declaration;
    const keel_scheduler_t *scheduler;
    uint32_t *ticks;  /* The counter, which the body moves on. */
    uint32_t wcet_us; /* Of each run. */
    keel_deviation_t deviation;
    uint64_t latest_us; /* The longest time from a release to the start of its run. */
    uint32_t missed;    /* Runs that ended behind their deadline. */
} demo_task_t;

typedef struct demo {
    keel_scheduler_t scheduler;
    uint32_t ticks; /* The free-running microsecond counter. */
    uint32_t poll_us;
    uint32_t peak_ppm; /* The highest load of a window. */
    demo_task_t task[URPILOT_TASK_COUNT];
} demo_t;

/* The tasks: the scheduler knows each by the address of its declaration, which lies outside of the
 * scheduler and does not change while the task is in its queue. */
static keel_task_config_t declaration[URPILOT_TASK_COUNT];

static uint32_t demo_clock(void *context)
{
    return *(const uint32_t *)context;
}

/* The scheduler's report of a task. */
static keel_task_report_t demo_report(const demo_task_t *self)
{
    keel_task_report_t report = {0};

    (void)keel_scheduler_report(self->scheduler, self->declaration, &report);
    return report;
}

/* The body of every task: works for its worst-case time, and notes when it started and ended. */
static void demo_body(void *context)
{
    demo_task_t *const self = context;
    const uint32_t period_us = self->declaration->period_us;
    const uint64_t start_us = self->scheduler->clock.now_us;
    /* The kernel has moved the release on to the next one already. */
    const uint64_t release_us = demo_report(self).release_us - period_us;

    if ((start_us - release_us) > self->latest_us) {
        self->latest_us = start_us - release_us;
    }
    if ((start_us + self->wcet_us) > (release_us + period_us)) {
        self->missed++;
    }
    (void)keel_deviation_add(&self->deviation, start_us, period_us);
    *self->ticks += self->wcet_us;
}

static keel_status_t demo_add(demo_t *demo, uint32_t i)
{
    demo_task_t *const self = &demo->task[i];

    *self = (demo_task_t){.declaration = &declaration[i],
                          .scheduler = &demo->scheduler,
                          .ticks = &demo->ticks,
                          .wcet_us = urpilot_task[i].wcet_us};
    declaration[i] = urpilot_task_config(i, demo_body, self);
    return keel_scheduler_add(&demo->scheduler, &declaration[i]);
}

static keel_status_t demo_start(demo_t *demo, uint32_t poll_us)
{
    const keel_scheduler_config_t config = urpilot_scheduler_config(demo_clock, &demo->ticks);
    keel_status_t status = keel_scheduler_init(&demo->scheduler, &config);

    demo->ticks = DEMO_FIRST_TICK;
    demo->poll_us = poll_us;
    demo->peak_ppm = 0u;
    for (uint32_t i = 0u; (i < URPILOT_TASK_COUNT) && (status == KEEL_OK); i++) {
        status = demo_add(demo, i);
    }
    return (status == KEEL_OK) ? keel_scheduler_start(&demo->scheduler) : status;
}

/* Closes the window of the load when it is long enough, and begins the next. */
static void demo_watch_load(demo_t *demo, keel_load_t *window)
{
    const uint64_t now_us = demo->scheduler.clock.now_us;
    const uint64_t busy_us = demo->scheduler.busy_us;

    if ((now_us - window->start_us) >= DEMO_WINDOW_US) {
        const uint32_t load_ppm = keel_load_ppm(window, now_us, busy_us);

        demo->peak_ppm = (load_ppm > demo->peak_ppm) ? load_ppm : demo->peak_ppm;
        keel_load_begin(window, now_us, busy_us);
    }
}

/* The main loop of a firmware, but for the virtual clock. */
static keel_status_t demo_run(demo_t *demo)
{
    keel_status_t status = KEEL_OK;
    keel_load_t window;

    keel_load_begin(&window, 0u, 0u);
    while (((demo->ticks - DEMO_FIRST_TICK) < DEMO_LENGTH_US) && (status == KEEL_OK)) {
        status = keel_scheduler_step(&demo->scheduler);
        demo_watch_load(demo, &window);
        demo->ticks += demo->poll_us;
    }
    return status;
}

static const char *demo_class(uint32_t priority)
{
    switch (priority) {
    case KEEL_PRIORITY_LOW:
        return "low";
    case KEEL_PRIORITY_MEDIUM:
        return "medium";
    case KEEL_PRIORITY_MEDIUM_HIGH:
        return "medium-high";
    case KEEL_PRIORITY_HIGH:
        return "high";
    default:
        return "real time";
    }
}

/* How often a task has to run: all periods of table 2 divide a minute. */
static uint32_t demo_expected(const demo_task_t *self)
{
    return DEMO_LENGTH_US / self->declaration->period_us;
}

static bool demo_in_time(const demo_task_t *self)
{
    const keel_task_report_t report = demo_report(self);

    return (report.stats.runs == demo_expected(self)) && (report.skipped == 0u) &&
           (self->missed == 0u);
}

static void demo_print_task(const demo_task_t *self)
{
    const keel_task_config_t *const task = self->declaration;
    const keel_task_report_t report = demo_report(self);
    const keel_stats_t *const stats = &report.stats;
    const double sigma_us = sqrt((double)keel_deviation_variance_us2(&self->deviation));

    (void)printf("%-26s %-11s %5u %6u %6u %5u %5u %6u %8.2f %6.2f %5u %5u %5u %5u\n", task->name,
                 demo_class(task->priority), (unsigned)(task->period_us / 1000u),
                 (unsigned)stats->runs, (unsigned)demo_expected(self),
                 (unsigned)keel_stats_mean_us(stats), (unsigned)stats->longest_us,
                 (unsigned)self->latest_us, sigma_us, (sigma_us * 100.0) / (double)task->period_us,
                 (unsigned)self->missed, (unsigned)report.skipped, (unsigned)stats->overruns,
                 (unsigned)stats->promotions);
}

static void demo_print_tasks(const demo_t *demo)
{
    (void)
        printf("21 tasks (table 2), guard %u us, one turn of the loop %u us, times in us but for "
               "the period in ms.\nlatest: from a release to the start of its run; sigma: eq. 15, "
               "also in %% of the period.\n\n",
               (unsigned)URPILOT_GUARD_US, (unsigned)demo->poll_us);
    (void)printf("%-26s %-11s %5s %6s %6s %5s %5s %6s %8s %6s %5s %5s %5s %5s\n", "task", "class",
                 "T", "runs", "wanted", "mean", "long", "latest", "sigma", "%", "late", "skip",
                 "over", "promo");
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        demo_print_task(&demo->task[i]);
    }
}

static void demo_print_load(const demo_t *demo)
{
    const keel_load_t minute = {.start_us = 0u, .busy_us = 0u};
    const uint32_t load_ppm = keel_load_ppm(&minute, demo->scheduler.clock.now_us,
                                            demo->scheduler.busy_us);
    double declared = 0.0;

    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        declared += (100.0 * (double)urpilot_task[i].wcet_us) / (double)urpilot_task[i].period_us;
    }
    (void)printf("\nCPU load (eq. 13 and 14): %.3f %% over the minute, at most %.3f %% in %u ms; "
                 "sum of C / T in table 2: %.3f %%.\n",
                 (double)load_ppm / PPM_PER_PERCENT, (double)demo->peak_ppm / PPM_PER_PERCENT,
                 DEMO_WINDOW_US / 1000u, declared);
}

/* The last line, which tells how it went; returns whether it went well. */
static bool demo_print_verdict(const demo_t *demo)
{
    uint32_t bad = 0u;
    uint64_t runs = 0u;

    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        bad += demo_in_time(&demo->task[i]) ? 0u : 1u;
        runs += demo_report(&demo->task[i]).stats.runs;
    }
    if (bad > 0u) {
        (void)printf("FAILED: %u of 21 tasks did not run once per period and in time.\n",
                     (unsigned)bad);
    } else {
        (void)printf("All 21 tasks ran once per period and ended before their deadlines: %u runs "
                     "in 60 s of virtual time.\n",
                     (unsigned)runs);
    }
    return bad == 0u;
}

/* The time of one turn of the loop from the command line; 0 when it is not a sensible number. */
static uint32_t demo_poll_us(int argc, char **argv)
{
    char *end = NULL;
    unsigned long poll_us;

    if (argc < 2) {
        return DEMO_POLL_US;
    }
    poll_us = strtoul(argv[1], &end, 10);
    return ((argc == 2) && (*end == '\0') && (poll_us <= DEMO_POLL_MAX)) ? (uint32_t)poll_us : 0u;
}

int main(int argc, char **argv)
{
    static demo_t demo;
    const uint32_t poll_us = demo_poll_us(argc, argv);
    keel_status_t status;

    if (poll_us == 0u) {
        (void)fprintf(stderr, "usage: demo [POLL_US], 1 to %u\n", DEMO_POLL_MAX);
        return EXIT_USAGE;
    }
    status = demo_start(&demo, poll_us);
    if (status == KEEL_OK) {
        status = demo_run(&demo);
    }
    if (status != KEEL_OK) {
        (void)printf("FAILED: the kernel refused with status %d.\n", (int)status);
        return EXIT_FAILURE;
    }
    demo_print_tasks(&demo);
    demo_print_load(&demo);
    return demo_print_verdict(&demo) ? EXIT_SUCCESS : EXIT_FAILURE;
}
