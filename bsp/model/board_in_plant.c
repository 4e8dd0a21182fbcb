/* SPDX-License-Identifier: Apache-2.0 */
#include "board_in_plant.h"

#include "file_medium.h"
#include "model.h"
#include "parameter_store.h"
#include "parameter_value.h"
#include "urpilot_tasks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define HUNDRED   100u
#define PIECE     64u
#define NAME      4096u
#define PLACES    128u
#define UNITS     2u
#define SECTOR    512u
#define CARD_UNIT (1024u * SECTOR)
#define CARD_MOST 0x80000000u

static board_image_t image; /* Its path and places are these: */
static char path[NAME];
static board_place_t places[PLACES];
static sim_view_t view;
static sim_task_t tasks[SIM_TASKS];
static keel_medium_t file; /* That keeps what the FRAM holds, … */
static bool has_file;      /* … if there is one. */

int board_load(const board_image_t *chosen)
{
    if ((strlen(chosen->path) >= NAME) || (chosen->place_count > PLACES)) {
        return 1;
    }
    image = *chosen;
    memcpy(path, chosen->path, strlen(chosen->path) + 1u);
    memcpy(places, chosen->places, chosen->place_count * sizeof places[0]);
    return 0;
}

void board_pilot_sends(uint32_t baud, uint32_t even_parity, uint32_t two_stops, uint32_t inverted)
{
    const model_bits_t bits = {baud, even_parity != 0u, two_stops != 0u, inverted != 0u};

    model_pilot_sends(&bits);
}

int board_insert(uint8_t *bytes, uint32_t size)
{
    if (((size % CARD_UNIT) != 0u) || (size > CARD_MOST)) {
        return 1;
    }
    model_card_insert((size > 0u) ? bytes : NULL, size / SECTOR);
    return 0;
}

const char *board_problem(void)
{
    return model_problem();
}

const char *board_text(void)
{
    return model_text();
}

/* --- The memory of parameters. --- */

static bool read_fram(void *context, uint32_t address, uint8_t *bytes, uint32_t count)
{
    (void)context;
    memcpy(bytes, &model_fram()[address], count);
    return true;
}

static bool write_fram(void *context, uint32_t address, const uint8_t *bytes, uint32_t count)
{
    (void)context;
    memcpy(&model_fram()[address], bytes, count);
    return true;
}

static bool load_fram(void)
{
    bool good = true;

    for (uint32_t at = 0u; (at < MODEL_FRAM_BYTES) && has_file && good; at += PIECE) {
        good = file.read(file.context, at, &model_fram()[at], PIECE);
    }
    return good;
}

static bool keep_fram(void)
{
    return !has_file || file.write(file.context, 0u, model_fram(), MODEL_FRAM_BYTES);
}

/* --- The flight. --- */

/* What is asked for that the image does not have. */
static const char *refusal_of(const sim_options_t *options)
{
    if (path[0] == '\0') {
        return "no image was loaded";
    }
    if (options->costs_percent != HUNDRED) {
        return "an image's tasks take the time that they take";
    }
    if ((options->plain_mean != 0u) || (options->hash != NULL)) {
        return "the image has neither a plain mean nor signed frames";
    }
    for (uint32_t i = 1u; i < SIM_LINKS; i++) {
        if (options->bytes_per_s[i] != 0u) {
            return "the board has one link of telemetry";
        }
    }
    return NULL;
}

int sim_start(const sim_options_t *options)
{
    const char *const refusal = refusal_of(options);

    model_clock_start();
    if (refusal != NULL) {
        model_fail("%s", refusal);
        return 1;
    }
    model_registers_start();
    model_pins_start();
    model_buses_start();
    model_devices_start();
    model_lines_start();
    model_card_start();
    model_watch(image.end_run);
    has_file = options->memory != NULL;
    if (has_file) {
        file = file_medium(options->memory);
    }
    if (!load_fram()) {
        model_fail("%s could not be read", options->memory);
    }
    return (model_processor_start(path, image.address) && !model_clock.failed) ? 0 : 1;
}

static int save(copter_parameter_store_t *store)
{
    if (!has_file || (copter_parameter_store_save(store) != KEEL_OK)) {
        return 4;
    }
    while (store->saved == KEEL_SLOTS_BUSY) {
        copter_parameter_store_step(store);
    }
    return ((store->saved == KEEL_SLOTS_DONE) && keep_fram()) ? 0 : 4;
}

/* As the firmware keeps its parameters: by the very code, compiled for this machine. */
int sim_set(const char *name, double value)
{
    static copter_parameter_store_t store;
    static const keel_medium_t medium = {.read = read_fram, .write = write_fram};
    keel_parameter_value_t wanted;
    keel_status_t status = KEEL_ERR_VALUE;
    uint16_t index;

    if (copter_parameter_store_start(&store, &medium) != KEEL_OK) {
        return 4;
    }
    index = keel_parameters_find(&store.table, name);
    if (index >= keel_parameters_count(&store.table)) {
        return 1;
    }
    if (sim_parameter_value(keel_parameters_get(&store.table, index).type, value, &wanted)) {
        status = keel_parameters_set(&store.table, index, wanted);
    }
    if (status != KEEL_OK) {
        return (status == KEEL_ERR_VALUE) ? 2 : 3;
    }
    return save(&store);
}

/* Its log is on its card. */
int sim_log(const char *wanted)
{
    return (wanted[0] != '\0') ? 1 : 0;
}

sim_sensors_t *sim_sensors(void)
{
    return model_sensors();
}

int sim_run_until(uint64_t time_us)
{
    model_devices_turn();
    model_clock_limit(time_us * MODEL_TICKS_PER_US);
    model_processor_run();
    model_pins_pass();
    if (model_fram_has_changed() && !keep_fram()) {
        model_fail("what the FRAM holds could not be kept");
    }
    return model_clock.failed ? 1 : 0;
}

/* --- What breaks. --- */

void board_lack(uint32_t devices)
{
    static const uint32_t of[][2] = {
        {BOARD_HAS_NO_IMU_1, 1u << MODEL_ICM20689},
        {BOARD_HAS_NO_IMU_2, (1u << MODEL_GYROSCOPE) | (1u << MODEL_ACCELEROMETER)},
        {BOARD_HAS_NO_BAROMETER, 1u << MODEL_MS5611},
        {BOARD_HAS_NO_MAGNETOMETER, 1u << MODEL_IST8310},
        {BOARD_HAS_NO_MEMORY, 1u << MODEL_FRAM}};
    uint32_t left_out = 0u;

    for (uint32_t i = 0u; i < (sizeof of / sizeof of[0]); i++) {
        left_out |= ((devices & of[i][0]) != 0u) ? of[i][1] : 0u;
    }
    model_devices_leave_out(left_out);
}

static void break_line(uint32_t fault, uint32_t amount, bool on)
{
    const model_disturbance_t disturbance = {
        .silent = on && (fault == (uint32_t)BOARD_GPS_SILENT),
        .unplugged = on && (fault == (uint32_t)BOARD_RADIO_UNPLUGGED),
        .noise = (on && (fault == (uint32_t)BOARD_RADIO_LINE_NOISE)) ? amount : 0u};

    model_line_disturb((fault == (uint32_t)BOARD_GPS_SILENT) ? MODEL_SATELLITES : MODEL_PILOT,
                       &disturbance);
}

static void cut_supply(uint32_t bytes)
{
    if (bytes > 0u) {
        model_fram_cut(bytes);
    } else {
        model_reset(MODEL_BY_POWER);
    }
}

/* What the chip itself does not get over. */
static int break_chip(uint32_t fault, uint32_t which, uint32_t amount)
{
    switch (fault) {
    case BOARD_OSCILLATOR_LOST:
        model_lose_oscillator();
        break;
    case BOARD_TASK_HANGS:
        model_hang_task(which);
        break;
    case BOARD_CORE_STOPS:
        model_hang();
        break;
    case BOARD_BROWN_OUT:
        cut_supply(amount);
        break;
    default:
        return 1;
    }
    return 0;
}

int board_break(uint32_t fault, uint32_t which, uint32_t amount, uint32_t on)
{
    model_expect_faults();
    switch (fault) {
    case BOARD_IMU_UNPLUGGED:
        if ((which < 1u) || (which > UNITS)) {
            return 1;
        }
        model_unit_unplug(which - 1u, on != 0u);
        return 0;
    case BOARD_SPI_LOW:
        if ((which != 1u) && (which != 2u) && (which != 4u)) {
            return 1;
        }
        model_spi_hold(which, on != 0u);
        return 0;
    case BOARD_I2C_LOW:
        model_i2c_hold(on != 0u, amount);
        return 0;
    case BOARD_GPS_SILENT:
    case BOARD_RADIO_UNPLUGGED:
    case BOARD_RADIO_LINE_NOISE:
        break_line(fault, amount, on != 0u);
        return 0;
    case BOARD_CARD_BUSY:
        return model_card_stick(on != 0u) ? 0 : 1;
    case BOARD_CARD_GONE:
        return model_card_pull(on != 0u) ? 0 : 1;
    default:
        return break_chip(fault, which, amount);
    }
}

/* --- What it shows. --- */

const board_edge_t *board_edges(uint32_t *count)
{
    return model_edges(count);
}

uint32_t board_number(uint32_t address, uint32_t size)
{
    const uint8_t *const bytes = model_memory(address, size);
    uint32_t number = 0u;

    if ((bytes != NULL) && (size <= sizeof number)) {
        memcpy(&number, bytes, size);
    }
    return number;
}

/* From 1000 to 2000 us. */
static float throttle_of(uint32_t pulse_us)
{
    const float throttle = ((float)pulse_us - 1000.0f) / 1000.0f;

    return (pulse_us == 0u) ? 0.0f : fminf(1.0f, fmaxf(0.0f, throttle));
}

/* Before the main loop begins memory means nothing: the copter is not ready. */
const sim_view_t *sim_view(void)
{
    memset(&view, 0, sizeof view);
    view.blocking_checks = UINT32_MAX;
    view.blocking_facts = UINT32_MAX;
    for (uint32_t i = 0u; (i < image.place_count) && model_is_up(); i++) {
        const uint32_t number = board_number(places[i].address, places[i].size);

        memcpy((uint8_t *)&view + places[i].view, &number, sizeof number);
    }
    for (uint32_t i = 0u; (i < SIM_MOTORS) && model_is_up(); i++) {
        view.motor[i] = throttle_of(model_pulse_us(i));
    }
    return &view;
}

static void show_slot(sim_task_t *task, uint32_t slot)
{
    const board_queue_t *const queue = &image.queue;
    const uint32_t stats = queue->stats + (slot * queue->stats_bytes);

    *task = (sim_task_t){.runs = board_number(stats + queue->runs, 4u),
                         .skipped = board_number(queue->skipped + (2u * slot), 2u),
                         .overruns = board_number(stats + queue->overruns, 2u),
                         .longest_us = board_number(stats + queue->longest, 4u)};
}

const sim_task_t *sim_tasks(void)
{
    const board_queue_t *const queue = &image.queue;

    memset(tasks, 0, sizeof tasks);
    for (uint32_t slot = 0u; (slot < queue->slots) && model_is_up(); slot++) {
        const uint32_t task = board_number(queue->tasks + (4u * slot), 4u) - queue->declarations;
        const uint32_t row = task / queue->declaration_bytes;

        if ((row < SIM_TASKS) && ((task % queue->declaration_bytes) == 0u)) {
            show_slot(&tasks[row], slot);
        }
    }
    return tasks;
}

const char *sim_console(const char *typed)
{
    (void)typed;
    return "";
}

void sim_overrun(uint32_t task, uint32_t runs, uint32_t extra_us)
{
    model_delay(task, runs, extra_us);
}

uint32_t sim_link_send(uint32_t link, const uint8_t *bytes, uint32_t size)
{
    return (link == 0u) ? model_telemetry_send(bytes, size) : 0u;
}

uint32_t sim_link_receive(uint32_t link, uint8_t *bytes, uint32_t size)
{
    return (link == 0u) ? model_telemetry_receive(bytes, size) : 0u;
}

uint16_t sim_mode_channel(uint32_t mode)
{
    return (uint16_t)(1050u + (180u * mode));
}

const char *sim_task_name(uint32_t task)
{
    return (task < SIM_TASKS) ? urpilot_task[task].name : "";
}
