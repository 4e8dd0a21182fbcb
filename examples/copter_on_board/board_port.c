/* SPDX-License-Identifier: Apache-2.0 */
#include "board_port.h"

#include "board.h"
#include "common/wait.h"
#include "console.h"
#include "cortex_m7/fault.h"
#include "cortex_m7/memory.h"
#include "cortex_m7/startup.h"

#include <stddef.h>

#define MIB        0x100000u
#define ALLOCATION (128u * MIB) /* 24 minutes, at the 92 kB/s of the copter's log. */
#define PULSE_US   1000.0f      /* No throttle, and so much more for all. */
#define HALF       0.5f
#define MILLI      0.001f
#define CHANNELS   2u /* Of a power module. */

#define FIELD_UNIT (100.0f / (float)KEEL_IST8310_COUNTS_PER_GAUSS) /* In microtesla. */

/* Steps of the barometer's start: its reset, and its PROM. The magnetometer's, with its first
 * sample, are half as many again as they take when all goes well. */
#define BAROMETER_STEPS    2u
#define MAGNETOMETER_STEPS 24u
#define STEP_US            10000u
#define LOOKS              1000000u /* Far more than such a delay takes, but not for ever. */

#define STACK_WORDS 64u /* That a look at the stack takes 3 us for, at 216 MHz. */

/* --- Sensors. --- */

static bool read_imu(void *context, uint32_t unit, copter_imu_sample_t *sample)
{
    board_port_t *const board = context;
    keel_chip_motion_t motion;

    if ((unit >= keel_chip_inertial_count()) || (board->imu[unit].status != KEEL_BSP_OK)) {
        return false;
    }
    if (keel_chip_motion(unit, &motion) != KEEL_BSP_OK) {
        board->imu[unit].failures++;
        return false;
    }
    for (uint32_t i = 0u; i < 3u; i++) {
        sample->accelerometer[i] = motion.force[i];
        sample->gyroscope[i] = motion.rate[i];
    }
    sample->temperature = motion.temperature_cdeg;
    board->imu[unit].samples++;
    return true;
}

static bool read_magnetometer(void *context, copter_magnetometer_sample_t *sample)
{
    board_port_t *const board = context;
    const uint32_t now_us = keel_board_clock_us(NULL);
    const uint32_t elapsed_us = now_us - board->looked_us;

    if (!board->has_magnetometer) {
        return false;
    }
    board->looked_us = now_us;
    if (keel_ist8310_step(&board->magnetometer, elapsed_us) != KEEL_BSP_OK) {
        return false;
    }
    keel_mounting_turn(&board->mounting, board->magnetometer.sample.field, FIELD_UNIT,
                       sample->value);
    board->fields++;
    return true;
}

static bool read_barometer(void *context, copter_barometer_sample_t *sample)
{
    board_port_t *const board = context;
    const uint32_t now_us = keel_board_clock_us(NULL);
    const uint32_t elapsed_us = now_us - board->stepped_us;

    if (!board->has_barometer) {
        return false;
    }
    board->stepped_us = now_us;
    if (keel_ms5611_step(&board->barometer, elapsed_us) != KEEL_BSP_OK) {
        return false;
    }
    sample->pressure_pa = (float)board->barometer.sample.pressure_pa;
    sample->temperature = (int16_t)board->barometer.sample.temperature_cdeg;
    board->pressures++;
    return true;
}

static bool read_byte(void *context, uint32_t receiver, copter_byte_t *byte)
{
    board_port_t *const board = context;

    return board_lines_read(&board->lines, receiver, byte);
}

static bool is_ready(void *context)
{
    const board_port_t *const board = context;

    return board_panel_is_ready(&board->panel);
}

/* --- What the converter measures. --- */

/* The next channel of the modules in turn. A conversion takes 12 us. */
static void measure(board_port_t *board)
{
    const uint32_t channel = board->measured % (CHANNELS * COPTER_POWER_MODULES);
    board_module_t *const module = &board->module[channel / CHANNELS];
    const bool is_current = (channel % CHANNELS) != 0u;
    uint16_t count;

    /* By keel_analogue_name_t, voltage and current of the first, then those of the second. */
    if (keel_chip_analogue(channel, &count) == KEEL_BSP_OK) {
        if (is_current) {
            module->current = count;
            module->is_new = true;
        } else {
            module->voltage = count;
        }
    }
    board->measured++;
}

static bool read_power(void *context, uint32_t module, copter_power_reading_t *reading)
{
    board_port_t *const board = context;
    board_module_t *const own = &board->module[module];
    keel_power_module_reading_t read;

    if ((board->adc != KEEL_BSP_OK) || (keel_chip_analogue_count() == 0u)) {
        return false;
    }
    if (module == 0u) {
        measure(board);
    }
    if (!own->is_new) {
        return false;
    }
    own->is_new = false;
    keel_power_module_read(&board->scale, own->voltage, own->current, &read);
    if ((read.told & (uint32_t)KEEL_POWER_MODULE_OPEN) != 0u) {
        return false;
    }
    reading->voltage = (float)read.voltage_mv * MILLI;
    reading->current = (float)read.current_ma * MILLI;
    return true;
}

/* Two conversions do not fit into a run: one a call. */
static void read_chip(void *context, copter_chip_t *chip)
{
    board_port_t *const board = context;
    int32_t cdeg;

    if (board->adc != KEEL_BSP_OK) {
        return;
    }
    if (board->wants_temperature && (board->supply_mv != 0u)) {
        if (keel_chip_temperature(board->supply_mv, &cdeg) == KEEL_BSP_OK) {
            chip->temperature = (int16_t)cdeg;
            chip->has_temperature = true;
        }
    } else if (keel_chip_supply(&board->supply_mv) == KEEL_BSP_OK) {
        chip->supply_mv = (uint16_t)board->supply_mv;
        chip->has_supply = true;
    } else {
        /* The values are as they were. */
    }
    board->wants_temperature = !board->wants_temperature;
}

static void reboot(void *context)
{
    (void)context;
    keel_chip_reset();
}

/* A look at all of the stack would take a hundred times what its task may, so each call looks at
 * the next words, from below, up to the first that was used. */
static uint32_t stack_free(void *context)
{
    board_port_t *const board = context;
    const uint32_t *const end = board->stack_looked + STACK_WORDS;

    while ((board->stack_looked < end) && (board->stack_looked < keel_stack_top) &&
           (*board->stack_looked == KEEL_STACK_PAINT)) {
        board->stack_looked++;
    }
    if (board->stack_looked < end) {
        board->stack_free_b = (uint32_t)board->stack_looked - (uint32_t)keel_stack_bottom;
        board->stack_looked = keel_stack_bottom;
    }
    return board->stack_free_b;
}

/* --- Motors, log. --- */

/* Without motors the outputs are off and low: a speed controller's first pulse comes with them. */
static void write_motors(void *context, const float output[COPTER_MOTORS])
{
    board_port_t *const board = context;
    bool turns = false;

    for (uint32_t i = 0u; i < COPTER_MOTORS; i++) {
        turns = turns || (output[i] > 0.0f);
    }
    if (turns) {
        for (uint32_t i = 0u; i < COPTER_MOTORS; i++) {
            (void)keel_chip_pulse(i, (uint32_t)(PULSE_US + (PULSE_US * output[i]) + HALF));
        }
        if (!board->turning) {
            keel_chip_arm();
        }
    } else if (board->turning) {
        keel_board_outputs_off();
    } else {
        /* They are off. */
    }
    board->turning = turns;
}

static uint32_t log_room(void *context)
{
    const board_port_t *const board = context;

    return keel_black_box_room(&board->box);
}

static void write_log(void *context, const uint8_t *bytes, uint32_t length)
{
    board_port_t *const board = context;

    (void)keel_black_box_write(&board->box, bytes, length);
}

static void end_run(void *context, uint32_t row, uint32_t wcet_us)
{
    (void)context;
    (void)row;
    (void)wcet_us;
}

/* --- The start. --- */

static void say(const char *device, uint64_t status, const char *missing)
{
    keel_console_text(device);
    if (missing != NULL) {
        keel_console_text(" missing: ");
        keel_console_text(missing);
    } else {
        keel_console_text(" status ");
        keel_console_number(status);
    }
    keel_console_text("\n");
}

/* The pilot is to hear of a device as well, who does not see the console. */
static void note(board_port_t *board, const copter_notice_t *notice)
{
    if (board->notices < COPTER_NOTICES) {
        board->notice[board->notices] = *notice;
        board->notices++;
    }
}

/* A device that the board has. */
static void say_status(board_port_t *board, const char *device, uint64_t status)
{
    say(device, status, NULL);
    if (status != 0u) {
        note(board, &(copter_notice_t){device, ": fails", false});
    }
}

/* A device that a board may lack. */
static void say_device(board_port_t *board, const char *device, uint64_t status, bool is_there)
{
    if (is_there) {
        say_status(board, device, status);
    } else {
        say(device, status, "the board has none");
    }
}

static bool is_failure(keel_bsp_status_t status)
{
    return (status != KEEL_BSP_OK) && (status != KEEL_BSP_WAIT);
}

static void wait_a_step(void)
{
    (void)keel_wait_us(keel_board_clock_us, NULL, STEP_US, LOOKS);
}

/* Its reset, and the reading of its PROM: what is wrong with it shows there. */
static keel_bsp_status_t start_barometer(board_port_t *board)
{
    keel_bsp_status_t worst = KEEL_BSP_OK;
    keel_bus_t bus;

    board->has_barometer = keel_chip_barometer(&bus);
    if (board->has_barometer) {
        keel_ms5611_begin(&board->barometer, bus);
    }
    for (uint32_t i = 0u; (i < BAROMETER_STEPS) && board->has_barometer; i++) {
        const keel_bsp_status_t status = keel_ms5611_step(&board->barometer, STEP_US);

        if (is_failure(status) && (worst == KEEL_BSP_OK)) {
            worst = status;
        }
        wait_a_step();
    }
    board->stepped_us = keel_board_clock_us(NULL);
    return worst;
}

/* To its first sample, or to what is wrong with it. */
static keel_bsp_status_t start_magnetometer(board_port_t *board)
{
    keel_bsp_status_t status = KEEL_BSP_WAIT;
    keel_bus_t bus;

    board->has_magnetometer = keel_chip_magnetometer(&bus, &board->mounting);
    if (board->has_magnetometer) {
        keel_ist8310_begin(&board->magnetometer, bus);
    }
    for (uint32_t i = 0u;
         (i < MAGNETOMETER_STEPS) && board->has_magnetometer && (status == KEEL_BSP_WAIT); i++) {
        status = keel_ist8310_step(&board->magnetometer, STEP_US);
        wait_a_step();
    }
    board->looked_us = keel_board_clock_us(NULL);
    return status;
}

/* Each is named, those of the vote that the board lacks as well. */
static void start_units(board_port_t *board)
{
    static const char *const name[COPTER_IMUS] = {"imu 1", "imu 2", "imu 3"};
    const uint32_t count = keel_chip_inertial_count();

    keel_chip_inertial_begin();
    for (uint32_t i = 0u; i < count; i++) {
        board->imu[i].status = keel_chip_inertial_start(i);
        say_status(board, name[i], (uint64_t)board->imu[i].status);
    }
    for (uint32_t i = count; i < COPTER_IMUS; i++) {
        say(name[i], 0u, "the board has none");
    }
}

static void start_sensors(board_port_t *board)
{
    keel_bsp_status_t status;

    start_units(board);
    status = start_barometer(board);
    say_device(board, "barometer", (uint64_t)status, board->has_barometer);
    status = start_magnetometer(board);
    say_device(board, "magnetometer", (uint64_t)status, board->has_magnetometer);
}

static void start_lines(board_lines_t *lines)
{
    static const char missing[] = "the board has no such line";

    board_lines_start(lines);
    say("receiver of the pilot", (uint64_t)lines->pilot,
        (keel_chip_has_line(KEEL_LINE_PILOT) || keel_chip_has_line(KEEL_LINE_SPARE)) ? NULL
                                                                                     : missing);
    say("receiver of satellites", (uint64_t)lines->satellites,
        keel_chip_has_line(KEEL_LINE_SATELLITES) ? NULL : missing);
    say("telemetry", (uint64_t)lines->telemetry,
        keel_chip_has_line(KEEL_LINE_TELEMETRY) ? NULL : missing);
}

static void start_panel(board_panel_t *panel)
{
    board_panel_start(panel);
    say("safety switch", 0u, panel->has_safety ? NULL : "the board has none");
    say("buzzer", 0u, panel->has_buzzer ? NULL : "the board has none");
}

static void start_converter(board_port_t *board)
{
    /* Of Pixhawk 4's power modules. */
    static const keel_power_module_config_t config = {3300u, 18100000u, 36367515u, 5600u};

    (void)keel_power_module_init(&board->scale, &config);
    board->adc = keel_chip_adc_start();
    say_status(board, "adc", (uint64_t)board->adc);
    say("power modules", 0u, (keel_chip_analogue_count() == 0u) ? "the board has none" : NULL);
}

/* Flash would stop the processor for seconds, in flight as well: parameters are kept in a memory
 * that needs no erasing, or not at all. */
static void start_memory(board_port_t *board)
{
    uint32_t slot_bytes = 0u;

    board->memory = keel_chip_memory(&board->medium, &slot_bytes);
    board->keeps = (board->memory == KEEL_BSP_OK) && (board->medium.erase == NULL);
    if (board->medium.erase != NULL) {
        say("parameters", (uint64_t)board->memory, "not kept in flash");
    } else {
        say_status(board, "parameters", (uint64_t)board->memory);
    }
}

static void start_log(board_port_t *board)
{
    const keel_black_box_config_t config = {&board->disk, ALLOCATION, 1u};

    board->has_slot = keel_chip_card(&board->disk);
    if (board->has_slot && (keel_black_box_init(&board->box, &config) == KEEL_OK)) {
        board->card = keel_black_box_open(&board->box, keel_board_clock_us(NULL));
    }
    if (board->has_slot) {
        say_status(board, "card", (uint64_t)board->card);
    } else {
        say("card", (uint64_t)board->card, "the board has no slot");
    }
}

/* Why it started, on the console, and for the port if nobody wanted it. Behind a fault the console
 * gets its record as well. */
static void tell_restart(board_port_t *board)
{
    static const struct {
        const char *words;
        bool is_wanted;
        bool has_record;
    } row[] = {[KEEL_RESTART_POWER] = {"power", true, false},
               [KEEL_RESTART_ASKED] = {"asked for", true, false},
               [KEEL_RESTART_PIN] = {"reset pin", false, false},
               [KEEL_RESTART_UNTOLD] = {"not told by the chip", true, false},
               [KEEL_RESTART_BROWNOUT] = {"brown-out", false, false},
               [KEEL_RESTART_WATCHDOG] = {"watchdog", false, true},
               [KEEL_RESTART_CLOCK] = {"clock lost", false, true},
               [KEEL_RESTART_FAULT] = {"fault", false, true}};
    const keel_restart_t restart = keel_chip_restart();

    keel_console_text("start by: ");
    keel_console_text(row[restart].words);
    keel_console_text("\n");
    if (row[restart].has_record) {
        keel_fault_print();
    }
    if (!row[restart].is_wanted) {
        board->restart = row[restart].words;
        note(board, &(copter_notice_t){"disarmed by a restart: ", row[restart].words, true});
    }
}

/* What the board declares. A copter has two at least, so a board with one never arms: the check of
 * calibration names what lacks. */
static uint32_t imus(void)
{
    const uint32_t count = keel_chip_inertial_count();

    return (count < COPTER_IMUS_LEAST) ? COPTER_IMUS_LEAST : count;
}

copter_port_t board_port_start(board_port_t *board)
{
    *board = (board_port_t){.turning = false, .stack_looked = keel_stack_bottom};
    board->stack_free_b = ((uint32_t)keel_stack_top - (uint32_t)keel_stack_bottom) -
                          keel_stack_used_b();
    tell_restart(board);
    start_sensors(board);
    start_converter(board);
    start_memory(board);
    start_log(board);
    start_lines(&board->lines);
    start_panel(&board->panel);
    keel_chip_uid(board->uid);
    return (copter_port_t){.read_clock = keel_board_clock_us,
                           .context = board,
                           .imus = imus(),
                           .read_imu = read_imu,
                           .read_magnetometer = read_magnetometer,
                           .read_barometer = read_barometer,
                           .read_byte = read_byte,
                           .read_power = read_power,
                           .read_chip = read_chip,
                           .is_ready = is_ready,
                           .stack_free = stack_free,
                           .write_motors = write_motors,
                           .log_room = log_room,
                           .write_log = write_log,
                           .end_run = end_run,
                           .memory = board->keeps ? &board->medium : NULL,
                           .uid = board->uid,
                           .restart = board->restart,
                           .notices = board->notice,
                           .notice_count = board->notices,
                           .reboot = reboot};
}
