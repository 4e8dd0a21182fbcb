/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file main.c
 * @brief The paper's 21 tasks on a board, for ten seconds of the board's own time.
 *
 * For the emulated Cortex-M7 first, and for tests, which judge what it prints: the kernel, the vote
 * and the controllers run as on a board, compiled for it.
 *
 * Two of the real-time tasks vote and control (flight.h); every body keeps the CPU busy for the
 * rest of the task's worst-case time of table 2. Its budget is a little more, because a run's
 * measured time includes the pass before it: the task set says how long that may take. At the end
 * a table on the console tells how often each task ran. A refusal of the kernel ends as a fault
 * does.
 */
#include "board.h"
#include "console.h"
#include "cortex_m7/fault.h"
#include "flight.h"
#include "keel/rtos/scheduler.h"
#include "urpilot_tasks.h"

/* Ends before the releases at 10 s: all periods divide it, so each task has run 10 s / T times. */
#define DEMO_LENGTH_US 9999500u

/* What keel_fault_stop records. */
#define FAULT_SETUP 0xDE300001u
#define FAULT_STEP  0xDE300002u

/* The context of a body. */
typedef struct demo_work {
    uint32_t wcet_us;
    void (*work)(void); /* Null for a task that only takes its time. */
} demo_work_t;

static keel_scheduler_t scheduler KEEL_REALTIME_ZERO;
static demo_work_t demo_work[URPILOT_TASK_COUNT] KEEL_REALTIME_ZERO;

/* The tasks: the scheduler knows each by the address of its declaration, and reads it when it runs
 * the task. */
static keel_task_config_t declaration[URPILOT_TASK_COUNT] KEEL_REALTIME_ZERO;

KEEL_REALTIME_CODE static void demo_body(void *context)
{
    const demo_work_t *const self = context;
    const uint32_t start_us = keel_board_clock_us(NULL);

    if (self->work != NULL) {
        self->work();
    }
    while ((keel_board_clock_us(NULL) - start_us) < self->wcet_us) {
    }
}

static void require(keel_status_t status, uint32_t code)
{
    if (status != KEEL_OK) {
        keel_fault_stop(code);
    }
}

static void demo_start(void)
{
    const keel_scheduler_config_t config = urpilot_scheduler_config(keel_board_clock_us, NULL);

    require(flight_init(), FAULT_SETUP);
    demo_work[URPILOT_FOREGROUND_IMU].work = flight_vote;
    demo_work[URPILOT_ANGLE_RATE_CONTROL].work = flight_control;
    require(keel_scheduler_init(&scheduler, &config), FAULT_SETUP);
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        demo_work[i].wcet_us = urpilot_task[i].wcet_us;
        declaration[i] = urpilot_task_config(i, demo_body, &demo_work[i]);
        require(keel_scheduler_add(&scheduler, &declaration[i]), FAULT_SETUP);
    }
    require(keel_scheduler_start(&scheduler), FAULT_SETUP);
}

static void print_number(const char *label, uint64_t value)
{
    keel_console_text(label);
    keel_console_number(value);
}

/* One line for each task, which tools/keel test-target reads. */
static void demo_print(void)
{
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        keel_task_report_t report = {0};

        (void)keel_scheduler_report(&scheduler, &declaration[i], &report);
        keel_console_text("task ");
        keel_console_text(declaration[i].name);
        print_number(": period ", declaration[i].period_us);
        print_number(" runs ", report.stats.runs);
        print_number(" longest ", report.stats.longest_us);
        print_number(" skipped ", report.skipped);
        print_number(" overruns ", report.stats.overruns);
        print_number(" promotions ", report.stats.promotions);
        keel_console_text("\n");
    }
    print_number("time ", scheduler.clock.now_us);
    print_number(" us, busy ", scheduler.busy_us);
    keel_console_text(" us\n");
}

int main(void)
{
    keel_console_text("Keel on ");
    keel_console_text(keel_board_name);
    keel_console_text(": 21 tasks, 10 s\n");
    keel_fault_watch(&scheduler);
    demo_start();
    while (scheduler.clock.now_us < DEMO_LENGTH_US) {
        require(keel_scheduler_step(&scheduler), FAULT_STEP);
        keel_board_sleep_us(keel_scheduler_idle_us(&scheduler, KEEL_BOARD_WAKE_US,
                                                   KEEL_BOARD_SLEEP_US));
    }
    demo_print();
    flight_print();
    keel_console_text("demo ended\n");
    return 0;
}
