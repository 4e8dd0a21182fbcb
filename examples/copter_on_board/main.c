/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file main.c
 * @brief The copter on a real board: the tasks that fly on the host, with the board's own devices.
 *
 * It has not flown yet. Each device that is missing is named on the console, and the copter refuses
 * to arm without one that it needs. The watchdog is fed only while every real-time task meets its
 * releases.
 *
 * A line on the console tells every second how it goes. A refusal of the kernel ends as a fault
 * does, with the outputs off.
 *
 * Behind a fault, a bite of the watchdog among them, it starts again, disarmed as after power-on,
 * and tells why. It never flies on: nobody could check an attitude from before, and motors would
 * start next to people at a fallen aircraft. A fault within the first second of its run ends in the
 * safe state of all images (bsp/cortex_m7/fault.h).
 */
#include "board.h"
#include "board_port.h"
#include "console.h"
#include "copter.h"
#include "cortex_m7/fault.h"

#define REPORT_EVERY_US 1000000u

/* What a step of the log takes at most: a sector of the card, as examples/recorder has it. */
#define CARD_US 212u

/* What keel_fault_stop records. */
#define FAULT_SETUP 0xC0980001u
#define FAULT_STEP  0xC0980002u

static copter_t copter KEEL_REALTIME_ZERO;
static copter_port_t port KEEL_REALTIME_ZERO;
static board_port_t board;
static copter_telemetry_t telemetry;

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

/* The real-time tasks' part of all that went wrong. */
static void print_tasks(void)
{
    uint64_t skipped = 0u;
    uint64_t overruns = 0u;

    for (uint32_t i = 0u; i < copter.tasks; i++) {
        keel_task_report_t report = {0};

        (void)keel_scheduler_report(&copter.scheduler, copter_declaration(i), &report);
        skipped += report.skipped;
        overruns += report.stats.overruns;
    }
    print_number(" skipped ", skipped);
    print_number(" overruns ", overruns);
}

static void print_units(void)
{
    for (uint32_t i = 0u; i < keel_chip_inertial_count(); i++) {
        print_number(" imu", i + 1u);
        print_number(" ", board.imu[i].samples);
        print_number(" failed", i + 1u);
        print_number(" ", board.imu[i].failures);
    }
}

static void print_report(void)
{
    print_number("t ", copter.scheduler.clock.now_us / REPORT_EVERY_US);
    print_number(" s state ", copter.state.mode.state);
    print_number(" load ", copter.health.load_ppm);
    print_tasks();
    print_units();
    print_number(" barometer ", board.pressures);
    print_number(" pa ", (uint64_t)copter.barometer.pressure_pa);
    print_number(" fields ", board.fields);
    print_number(" radio ", copter.pilot.rc.protocol);
    print_number(" fixes ", copter.gps.fixes);
    print_number(" battery ", copter.power.battery.level);
    print_number(" kept ", board.box.kept);
    keel_console_text("\n");
}

/* Time that no release wants is the card's, where it is long enough for a sector. */
static void use_idle_time(void)
{
    const uint32_t idle_us = keel_scheduler_idle_us(&copter.scheduler, KEEL_BOARD_WAKE_US, CARD_US);

    if (idle_us == CARD_US) {
        (void)keel_black_box_step(&board.box, keel_board_clock_us(NULL));
    } else {
        keel_board_sleep_us((idle_us < KEEL_BOARD_SLEEP_US) ? idle_us : KEEL_BOARD_SLEEP_US);
    }
}

/* A board without a line for it flies without. */
static void start_telemetry(void)
{
    const copter_telemetry_config_t config = board_lines_telemetry(&board.lines);

    if (board.lines.telemetry == KEEL_BSP_OK) {
        require(copter_telemetry_start(&copter, &telemetry, &config), FAULT_SETUP);
    }
}

static void turn_lines(void)
{
    const board_heard_t heard = {.chosen = copter_settings.rc.protocol,
                                 .heard = copter.pilot.rc.protocol,
                                 .fixes = copter.gps.receiver.count.fixes};

    board_lines_turn(&board.lines, &heard, keel_board_clock_us(NULL));
}

static void turn_panel(void)
{
    const keel_mode_t *const mode = &copter.state.mode;
    const board_shown_t shown = {.uses_safety = copter_settings.safety_switch,
                                 .sounds = copter_settings.buzzer,
                                 .motors = mode->motors,
                                 .can_try = mode->ready,
                                 .is_linked = (mode->settled & KEEL_MODE_RC_LINKED) != 0u,
                                 .is_low = copter.power.battery.level >= KEEL_BATTERY_LOW};

    board_panel_turn(&board.panel, &shown, keel_board_clock_us(NULL));
}

int main(void)
{
    uint64_t reported_us = 0u;

    keel_console_text("Keel on ");
    keel_console_text(keel_board_name);
    keel_console_text(": copter\n");
    port = board_port_start(&board);
    keel_fault_watch(&copter.scheduler);
    require(copter_start(&copter, &port, false), FAULT_SETUP);
    if (board.box.state == KEEL_BLACK_BOX_OPEN) {
        require(copter_log_start(&copter), FAULT_SETUP);
    }
    start_telemetry();
    keel_chip_watchdog_start(&copter.scheduler);
    for (;;) {
        require(keel_scheduler_step(&copter.scheduler), FAULT_STEP);
        keel_chip_turn();
        turn_lines();
        turn_panel();
        if ((copter.scheduler.clock.now_us - reported_us) >= REPORT_EVERY_US) {
            reported_us = copter.scheduler.clock.now_us;
            keel_fault_allow_restart(true);
            print_report();
        }
        use_idle_time();
    }
}
