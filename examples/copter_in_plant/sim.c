/* SPDX-License-Identifier: Apache-2.0 */
#include "sim.h"

#include "console.h"
#include "copter.h"
#include "file_medium.h"
#include "host/host_board.h"
#include "parameter_value.h"
#include "telemetry.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* The cost of the scheduler's own work, as the analysed task set has it (urpilot.toml), and a turn
 * of the main loop. */
#define TURN_NS     1000u
#define PASS_NS     11000u
#define DISPATCH_NS 1000u
#define HUNDRED     100u

/* Of two times that are counted modulo 2^32 the later one is ahead by less than this. */
#define HALF_OF_TIME 0x80000000u

/* The room of a line in either direction. */
#define LINE_BYTES 4096u

/* The counts of the samples that the copter took last. */
typedef struct taken {
    uint32_t imu[SIM_IMUS];
    uint32_t magnetometer;
    uint32_t barometer;
    uint32_t bytes[SIM_RECEIVERS];
    uint32_t at_us[SIM_RECEIVERS]; /* When the last one came. */
    uint32_t power[SIM_MODULES];
    uint32_t chip;
} taken_t;

/* Runs of a task that take longer. */
typedef struct delay {
    uint32_t runs;
    uint32_t extra_us;
} delay_t;

/* Bytes that wait on a line, the oldest first. */
typedef struct line {
    uint8_t bytes[LINE_BYTES];
    uint32_t count;
} line_t;

static copter_t copter;
static copter_telemetry_t telemetry;
static line_t up[SIM_LINKS];   /* For the copter. */
static line_t down[SIM_LINKS]; /* Of the copter. */
static copter_port_t port;
static host_board_t board;
static sim_options_t options;
static sim_sensors_t sensors;
static sim_view_t view;
static taken_t taken;
static delay_t delay[COPTER_TASKS];
static sim_task_t tasks[SIM_TASKS]; /* Those of table 2. */
static char answer[SIM_ANSWER + 1];
static float motors[COPTER_MOTORS];
static FILE *log_file; /* Null: nobody wants the log. */
static int log_errors;
static keel_medium_t memory;
static bool reboots;      /* The copter asked to start anew. */
static uint64_t begun_ns; /* When it started: the board's time counts from there. */
static const uint8_t uid[COPTER_UID_BYTES] = {'K', 'e', 'e', 'l', 0u, 's', 'i', 'm'};

/* Whether a device's count has moved; it is taken then. */
static bool is_new(uint32_t *last, uint32_t count)
{
    const bool moved = *last != count;

    *last = count;
    return moved;
}

static bool read_imu(void *context, uint32_t unit, copter_imu_sample_t *sample)
{
    const sim_imu_t *const imu = &sensors.imu[unit];
    const bool there = is_new(&taken.imu[unit], imu->count);

    (void)context;
    if (there) {
        memcpy(sample->accelerometer, imu->accelerometer, sizeof sample->accelerometer);
        memcpy(sample->gyroscope, imu->gyroscope, sizeof sample->gyroscope);
        sample->temperature = imu->temperature;
    }
    return there;
}

static bool read_magnetometer(void *context, copter_magnetometer_sample_t *sample)
{
    const bool there = is_new(&taken.magnetometer, sensors.magnetometer.count);

    (void)context;
    if (there) {
        memcpy(sample->value, sensors.magnetometer.field, sizeof sample->value);
    }
    return there;
}

static bool read_barometer(void *context, copter_barometer_sample_t *sample)
{
    const bool there = is_new(&taken.barometer, sensors.barometer.count);

    (void)context;
    if (there) {
        *sample = (copter_barometer_sample_t){.pressure_pa = sensors.barometer.pressure,
                                              .temperature = sensors.barometer.temperature};
    }
    return there;
}

static bool read_byte(void *context, uint32_t receiver, copter_byte_t *byte)
{
    const sim_receiver_t *const from = &sensors.receiver[receiver];
    const uint32_t now_us = (uint32_t)((begun_ns + board.now_ns) / HOST_NS_PER_US);
    uint32_t *const next = &taken.bytes[receiver];
    uint32_t at;
    bool there;

    (void)context;
    if ((from->count - *next) > (uint32_t)SIM_RING) {
        *next = from->count - (uint32_t)SIM_RING; /* Too late for those before. */
    }
    at = *next % (uint32_t)SIM_RING;
    there = (*next != from->count) && ((now_us - from->at_us[at]) < HALF_OF_TIME);
    if (there) {
        *byte = (copter_byte_t){.value = (uint8_t)from->byte[at],
                                .elapsed_us = from->at_us[at] - taken.at_us[receiver]};
        taken.at_us[receiver] = from->at_us[at];
        (*next)++;
    }
    return there;
}

static bool read_power(void *context, uint32_t module, copter_power_reading_t *reading)
{
    const sim_power_t *const power = &sensors.power[module];
    const bool there = is_new(&taken.power[module], power->count);

    (void)context;
    if (there) {
        *reading = (copter_power_reading_t){.voltage = power->voltage, .current = power->current};
    }
    return there;
}

static void read_chip(void *context, copter_chip_t *chip)
{
    const bool there = is_new(&taken.chip, sensors.chip.count);

    (void)context;
    *chip = (copter_chip_t){.supply_mv = there ? sensors.chip.supply : (uint16_t)0,
                            .temperature = there ? sensors.chip.temperature : (int16_t)0,
                            .has_supply = there,
                            .has_temperature = there};
}

static uint32_t stack_free(void *context)
{
    (void)context;
    return UINT32_MAX; /* This machine has enough. */
}

static void write_motors(void *context, const float output[COPTER_MOTORS])
{
    (void)context;
    memcpy(motors, output, sizeof motors);
}

static uint32_t log_room(void *context)
{
    (void)context;
    return UINT32_MAX; /* A file takes what there is. */
}

static void write_log(void *context, const uint8_t *bytes, uint32_t length)
{
    (void)context;
    if ((log_file != NULL) && (fwrite(bytes, 1u, length, log_file) != length)) {
        log_errors++;
    }
}

static void end_run(void *context, uint32_t row, uint32_t wcet_us)
{
    uint64_t work_us = ((uint64_t)wcet_us * options.costs_percent) / HUNDRED;

    (void)context;
    if (delay[row].runs > 0u) {
        delay[row].runs--;
        work_us += delay[row].extra_us;
    }
    host_board_work(&board, work_us * HOST_NS_PER_US);
}

static void reboot(void *context)
{
    (void)context;
    reboots = true;
}

static uint32_t put(line_t *line, const uint8_t *bytes, uint32_t size)
{
    const uint32_t room = LINE_BYTES - line->count;
    const uint32_t taken_now = (size < room) ? size : room;

    memcpy(&line->bytes[line->count], bytes, taken_now);
    line->count += taken_now;
    return taken_now;
}

static uint32_t take(line_t *line, uint8_t *bytes, uint32_t size)
{
    const uint32_t given = (size < line->count) ? size : line->count;

    memcpy(bytes, line->bytes, given);
    line->count -= given;
    memmove(line->bytes, &line->bytes[given], line->count);
    return given;
}

static uint32_t read_line(void *context, uint32_t link, uint8_t *bytes, uint32_t size)
{
    (void)context;
    return take(&up[link], bytes, size);
}

static uint32_t room_of(void *context, uint32_t link)
{
    (void)context;
    return LINE_BYTES - down[link].count;
}

static void write_line(void *context, uint32_t link, const uint8_t *bytes, uint32_t size)
{
    (void)context;
    (void)put(&down[link], bytes, size);
}

uint32_t sim_link_send(uint32_t link, const uint8_t *bytes, uint32_t size)
{
    return (link < SIM_LINKS) ? put(&up[link], bytes, size) : 0u;
}

uint32_t sim_link_receive(uint32_t link, uint8_t *bytes, uint32_t size)
{
    return (link < SIM_LINKS) ? take(&down[link], bytes, size) : 0u;
}

static keel_status_t start_telemetry(void)
{
    copter_telemetry_config_t config = {
        .key = {.key = (options.hash != NULL) ? options.key : NULL,
                .hash = options.hash,
                .timestamp = options.timestamp},
        .lines = {.read = read_line, .room = room_of, .write = write_line}};
    bool wanted = false;

    for (uint32_t i = 0u; i < SIM_LINKS; i++) {
        config.link[i] = (copter_link_config_t){.bytes_per_s = options.bytes_per_s[i],
                                                .commands = options.listens[i] == 0u};
        wanted = wanted || (options.bytes_per_s[i] > 0u);
    }
    return wanted ? copter_telemetry_start(&copter, &telemetry, &config) : KEEL_OK;
}

/* Power up, of a board and devices that are there. */
static keel_status_t start_copter(void)
{
    const host_costs_t costs = {.turn_ns = TURN_NS, .pass_ns = PASS_NS, .dispatch_ns = DISPATCH_NS};
    keel_status_t status;

    reboots = false;
    host_board_init(&board, &copter.scheduler, &costs, (uint32_t)(begun_ns / HOST_NS_PER_US));
    memset(motors, 0, sizeof motors);
    memset(&copter, 0, sizeof copter);
    status = copter_start(&copter, &port, options.plain_mean != 0u);
    status = (status == KEEL_OK) ? copter_log_start(&copter) : status;
    if (options.trace != 0u) {
        copter_log_runs(&copter);
    }
    return (status == KEEL_OK) ? start_telemetry() : status;
}

/* Devices, lines and time go on. A log is of one start: it ends here. Frames signed from now on are
 * later than all that was signed. */
static keel_status_t start_anew(void)
{
    if (log_file != NULL) {
        log_errors += (fclose(log_file) != 0) ? 1 : 0;
        log_file = NULL;
    }
    options.timestamp = telemetry.signing.timestamp + 1u;
    begun_ns += board.now_ns;
    return start_copter();
}

int sim_start(const sim_options_t *chosen)
{
    options = *chosen;
    begun_ns = HOST_NS_PER_US * (uint64_t)options.boot_us;
    memset(&sensors, 0, sizeof sensors);
    memset(&taken, 0, sizeof taken);
    memset(delay, 0, sizeof delay);
    memset(up, 0, sizeof up);
    memset(down, 0, sizeof down);
    if (options.memory != NULL) {
        memory = file_medium(options.memory);
    }
    port = (copter_port_t){.read_clock = host_board_read,
                           .clock = &board,
                           .imus = options.imus,
                           .read_imu = read_imu,
                           .read_magnetometer = read_magnetometer,
                           .read_barometer = read_barometer,
                           .read_byte = read_byte,
                           .read_power = read_power,
                           .read_chip = read_chip,
                           .stack_free = stack_free,
                           .write_motors = write_motors,
                           .log_room = log_room,
                           .write_log = write_log,
                           .end_run = end_run,
                           .memory = (options.memory != NULL) ? &memory : NULL,
                           .uid = uid,
                           .reboot = reboot};
    return (int)start_copter();
}

int sim_set(const char *name, double value)
{
    copter_parameter_store_t *const store = &copter.parameters;
    const uint16_t index = keel_parameters_find(&store->table, name);
    keel_parameter_value_t wanted;
    keel_status_t status = KEEL_ERR_VALUE;

    if (index >= keel_parameters_count(&store->table)) {
        return 1;
    }
    if (sim_parameter_value(keel_parameters_get(&store->table, index).type, value, &wanted)) {
        status = keel_parameters_set(&store->table, index, wanted);
    }
    if (status != KEEL_OK) {
        return (status == KEEL_ERR_VALUE) ? 2 : 3;
    }
    if (copter_parameter_store_save(store) != KEEL_OK) {
        return 4;
    }
    while (store->saved == KEEL_SLOTS_BUSY) {
        copter_parameter_store_step(store);
    }
    return (store->saved == KEEL_SLOTS_DONE) ? 0 : 4;
}

int sim_log(const char *path)
{
    const int errors = log_errors + (((log_file != NULL) && (fclose(log_file) != 0)) ? 1 : 0);

    log_errors = 0;
    log_file = (path[0] != '\0') ? fopen(path, "wb") : NULL;
    return errors + (((path[0] != '\0') && (log_file == NULL)) ? 1 : 0);
}

sim_sensors_t *sim_sensors(void)
{
    return &sensors;
}

int sim_run_until(uint64_t time_us)
{
    const uint64_t end_ns = time_us * HOST_NS_PER_US;
    keel_status_t status = KEEL_OK;

    while (((begun_ns + board.now_ns) < end_ns) && (status == KEEL_OK)) {
        status = keel_scheduler_step(&copter.scheduler);
        host_board_turn(&board);
        status = (reboots && (status == KEEL_OK)) ? start_anew() : status;
        host_board_idle(&board, (end_ns > begun_ns) ? (end_ns - begun_ns) : 0u);
    }
    return (int)status;
}

static void show_vector(float to[3], keel_attitude_vector_t from)
{
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

static void show_place(float to[3], keel_cascade_vector_t from)
{
    to[0] = from.north;
    to[1] = from.east;
    to[2] = from.up;
}

static void show_state(void)
{
    const keel_mode_t *const mode = &copter.state.mode;

    view.state = mode->state;
    view.mode = mode->mode;
    view.motors_on = mode->motors ? 1u : 0u;
    view.cause = mode->cause;
    view.blocking_checks = mode->blocking.checks;
    view.blocking_facts = mode->blocking.facts;
    view.battery_level = copter.power.battery.level;
    view.battery_left = copter.power.battery.remaining;
    view.load_ppm = copter.health.load_ppm;
}

static void show_inertia(void)
{
    const copter_imu_t *const imu = &copter.imu;
    const keel_attitude_t *const attitude = &imu->attitude;

    view.phase = attitude->phase;
    view.heading_valid = attitude->heading_valid ? 1u : 0u;
    view.attitude_flags = attitude->flags;
    view.quaternion[0] = attitude->quaternion.w;
    view.quaternion[1] = attitude->quaternion.x;
    view.quaternion[2] = attitude->quaternion.y;
    view.quaternion[3] = attitude->quaternion.z;
    show_vector(view.bias, attitude->bias);
    show_vector(view.rate, attitude->rate);
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        view.vote[k] = imu->virtual_imu.channel[k].vote.output;
        view.vote_state[k] = imu->virtual_imu.channel[k].vote.state;
    }
    for (uint32_t unit = 0u; unit < COPTER_IMUS; unit++) {
        view.used[unit] = imu->virtual_imu.used[unit];
        view.latched[unit] = imu->virtual_imu.latched[unit];
    }
}

static void show_control(void)
{
    const keel_cascade_t *const cascade = &copter.control.cascade;

    show_place(view.asked_place, copter.control.place);
    show_place(view.asked_velocity, copter.control.asked);
    view.asked_tilt[0] = cascade->axis[KEEL_CASCADE_ROLL].pid.setpoint;
    view.asked_tilt[1] = cascade->axis[KEEL_CASCADE_PITCH].pid.setpoint;
    for (uint32_t i = 0u; i < 3u; i++) {
        view.asked_rate[i] = cascade->axis[KEEL_CASCADE_ROLL_RATE + i].pid.setpoint;
    }
    view.command[0] = cascade->command.roll;
    view.command[1] = cascade->command.pitch;
    view.command[2] = cascade->command.yaw;
    view.command[3] = cascade->command.thrust;
    view.limited = copter.control.mixer.limited;
    memcpy(view.motor, motors, sizeof view.motor);
}

const sim_view_t *sim_view(void)
{
    const copter_estimate_t *const estimate = &copter.estimate;

    show_state();
    show_inertia();
    show_control();
    show_place(view.position, estimate->here.position);
    show_place(view.velocity, estimate->here.velocity);
    view.place_quality = estimate->position.quality;
    view.height_quality = estimate->altitude.axis.quality;
    return &view;
}

const sim_task_t *sim_tasks(void)
{
    for (uint32_t i = 0u; i < SIM_TASKS; i++) {
        keel_task_report_t report = {0};

        (void)keel_scheduler_report(&copter.scheduler, copter_declaration(i), &report);
        tasks[i] = (sim_task_t){.runs = report.stats.runs,
                                .skipped = report.skipped,
                                .overruns = report.stats.overruns,
                                .longest_us = report.stats.longest_us};
    }
    return tasks;
}

const char *sim_console(const char *typed)
{
    copter_said_t asked;
    uint32_t length = 0u;
    uint32_t line;

    copter_console_ask(&asked, typed, (uint32_t)strlen(typed));
    do {
        line = copter_console_line(&copter, &asked, &answer[length]);
        length += line;
    } while ((line > 0u) && ((length + COPTER_CONSOLE_LINE) <= sizeof answer));
    answer[length] = '\0';
    return answer;
}

void sim_overrun(uint32_t task, uint32_t runs, uint32_t extra_us)
{
    if (task < SIM_TASKS) {
        delay[task] = (delay_t){.runs = runs, .extra_us = extra_us};
    }
}

uint16_t sim_mode_channel(uint32_t mode)
{
    return (uint16_t)(1050u + (180u * mode));
}

const char *sim_task_name(uint32_t task)
{
    return (task < SIM_TASKS) ? urpilot_task[task].name : "";
}
