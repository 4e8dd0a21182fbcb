/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file main.c
 * @brief The copter on a board, lying on a desk, for ten seconds of the board's own time.
 *
 * The tasks are those that fly (examples/copter), not one line of them is another; what they read
 * is a desk's (desk.h). At the end a table tells how often each task ran and how long its longest
 * run took, with the pass before it. A refusal of the kernel or of a unit ends as a fault does.
 */
#include "board.h"
#include "console.h"
#include "copter.h"
#include "cortex_m7/fault.h"
#include "desk.h"

/* Ends before the releases at 10 s: all periods divide it, so each task has run 10 s / T times. */
#define LENGTH_US 9999500u

/* What keel_fault_stop records. */
#define FAULT_SETUP 0xC0970001u
#define FAULT_STEP  0xC0970002u

#define MILLION 1.0e6f

static copter_t copter KEEL_REALTIME_ZERO;
static copter_port_t port KEEL_REALTIME_ZERO;
static desk_t desk KEEL_REALTIME_ZERO;

static void require(keel_status_t status, uint32_t code)
{
    if (status != KEEL_OK) {
        keel_fault_stop(code);
    }
}

static void print_number(const char *label, uint64_t value)
{
    keel_console_text(label);
    keel_console_number(value);
}

/* One line for each task, which tools/keel test-target reads. */
static void print_tasks(void)
{
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        const keel_task_config_t *const declaration = copter_declaration(i);
        keel_task_report_t report = {0};

        (void)keel_scheduler_report(&copter.scheduler, declaration, &report);
        keel_console_text("task ");
        keel_console_text(declaration->name);
        print_number(": period ", declaration->period_us);
        print_number(" runs ", report.stats.runs);
        print_number(" longest ", report.stats.longest_us);
        print_number(" skipped ", report.skipped);
        print_number(" overruns ", report.stats.overruns);
        print_number(" promotions ", report.stats.promotions);
        keel_console_text("\n");
    }
}

/* The copter's state at the end, which tools/keel test-target reads. */
static void print_copter(void)
{
    const keel_mode_t *const mode = &copter.state.mode;

    print_number("copter state ", mode->state);
    print_number(" mode ", mode->mode);
    print_number(" phase ", copter.imu.attitude.phase);
    print_number(" level ", copter.power.battery.level);
    print_number(" load ", copter.health.load_ppm);
    for (uint32_t i = 0u; i < COPTER_MOTORS; i++) {
        print_number(" motor ", (uint32_t)(desk.motor[i] * MILLION));
    }
    keel_console_text("\n");
}

int main(void)
{
    keel_console_text("Keel on ");
    keel_console_text(keel_board_name);
    keel_console_text(": a copter on a desk, 10 s\n");
    keel_fault_watch(&copter.scheduler);
    port = desk_port(&desk, keel_board_clock_us, NULL);
    require(copter_start(&copter, &port, false), FAULT_SETUP);
    while (copter.scheduler.clock.now_us < LENGTH_US) {
        require(keel_scheduler_step(&copter.scheduler), FAULT_STEP);
        keel_board_sleep_us(keel_scheduler_idle_us(&copter.scheduler, KEEL_BOARD_WAKE_US,
                                                   KEEL_BOARD_SLEEP_US));
    }
    print_tasks();
    print_number("time ", copter.scheduler.clock.now_us);
    print_number(" us, busy ", copter.scheduler.busy_us);
    keel_console_text(" us\n");
    print_copter();
    keel_console_text("demo ended\n");
    return 0;
}
