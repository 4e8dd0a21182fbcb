/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/ist8310.h"

#include <stddef.h>

#define REG_IDENTITY    0x00u
#define REG_STATUS      0x02u
#define REG_FIELD       0x03u /* X, Y and Z, the less significant byte first. */
#define REG_CONTROL_1   0x0Au
#define REG_CONTROL_2   0x0Bu
#define REG_CONTROL_3   0x0Du
#define REG_TEMPERATURE 0x1Cu
#define REG_AVERAGE     0x41u
#define REG_PULSE       0x42u

#define IDENTITY    0x10u
#define DATA_READY  0x01u
#define OVERRUN     0x02u
#define SINGLE      0x01u
#define SOFT_RESET  0x01u
#define FIELD_BYTES 6u
#define SETTINGS    3u
#define AXIS_UP     2u

/* A register with what it is set to. */
typedef struct ist8310_setting {
    uint8_t address;
    uint8_t value;
} ist8310_setting_t;

/* After a reset each of them reads 0, or other bits. */
static const ist8310_setting_t ist8310_setting[SETTINGS] = {
    {REG_AVERAGE, 0x24u},   /* 16 times, all axes. */
    {REG_PULSE, 0xC0u},     /* As its maker asks for. */
    {REG_CONTROL_3, 0x70u}, /* 16 bits, all axes: 1320 counts a gauss. */
};

static void turn_to(keel_ist8310_t *sensor, keel_ist8310_state_t state)
{
    sensor->state = state;
    keel_progress_begin(&sensor->progress);
}

static keel_bsp_status_t put(const keel_ist8310_t *sensor, uint8_t address, uint8_t value)
{
    const uint8_t out[2] = {address, value};

    return keel_bus_transfer(&sensor->bus, out, NULL, 2u);
}

/* Reads a few registers, from an address on. */
static keel_bsp_status_t get(const keel_ist8310_t *sensor, uint8_t address, uint8_t *value,
                             uint32_t count)
{
    const uint8_t out[FIELD_BYTES + 1u] = {[0] = address};
    uint8_t in[FIELD_BYTES + 1u] = {[0] = 0u};
    const keel_bsp_status_t status = keel_bus_transfer(&sensor->bus, out, in, count + 1u);

    for (uint32_t i = 0u; i < count; i++) {
        value[i] = in[i + 1u];
    }
    return status;
}

static keel_bsp_status_t check_back(const keel_ist8310_t *sensor, uint32_t index)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = get(sensor, ist8310_setting[index].address, &value, 1u);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    return (value == ist8310_setting[index].value) ? KEEL_BSP_OK : KEEL_BSP_VERIFY;
}

/* Whether it is one, and has come up. */
static keel_bsp_status_t check_ist8310(const keel_ist8310_t *sensor)
{
    uint8_t value = 0u;
    keel_bsp_status_t status = get(sensor, REG_IDENTITY, &value, 1u);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (keel_bus_is_still(&value, 1u)) {
        return KEEL_BSP_STUCK;
    }
    if (value != IDENTITY) {
        return KEEL_BSP_ID;
    }
    status = get(sensor, REG_CONTROL_2, &value, 1u);
    if (status != KEEL_BSP_OK) {
        return status;
    }
    return ((value & SOFT_RESET) == 0u) ? KEEL_BSP_OK : KEEL_BSP_TIMEOUT;
}

static keel_bsp_status_t set_up(const keel_ist8310_t *sensor)
{
    keel_bsp_status_t status = check_ist8310(sensor);

    for (uint32_t i = 0u; (i < SETTINGS) && (status == KEEL_BSP_OK); i++) {
        status = put(sensor, ist8310_setting[i].address, ist8310_setting[i].value);
        if (status == KEEL_BSP_OK) {
            status = check_back(sensor, i);
        }
    }
    return status;
}

/* Writes what makes the sensor begin something. */
static keel_bsp_status_t start_doing(keel_ist8310_t *sensor, uint8_t address, uint8_t value,
                                     keel_ist8310_state_t state)
{
    const keel_bsp_status_t status = put(sensor, address, value);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    turn_to(sensor, state);
    return KEEL_BSP_WAIT;
}

static keel_bsp_status_t begin_measuring(keel_ist8310_t *sensor)
{
    return start_doing(sensor, REG_CONTROL_1, SINGLE, KEEL_IST8310_MEASURING);
}

static keel_bsp_status_t configure(keel_ist8310_t *sensor)
{
    const keel_bsp_status_t status = set_up(sensor);

    if (status != KEEL_BSP_OK) {
        turn_to(sensor, KEEL_IST8310_OFF);
        return status;
    }
    turn_to(sensor, KEEL_IST8310_IDLE);
    return begin_measuring(sensor);
}

/* A number of two bytes, the less significant first, as two's complement. */
static int16_t little_at(const uint8_t *byte)
{
    const int32_t value = (int32_t)byte[0] + ((int32_t)byte[1] * 256);

    return (int16_t)((value > INT16_MAX) ? (value - 65536) : value);
}

/* The sensor's third axis is up. */
static int16_t turned_down(int16_t up)
{
    return (up == INT16_MIN) ? INT16_MAX : (int16_t)-up;
}

static keel_bsp_status_t read_sample(keel_ist8310_t *sensor, keel_ist8310_sample_t *sample)
{
    uint8_t field[FIELD_BYTES];
    uint8_t temperature[2];
    keel_bsp_status_t status = get(sensor, REG_FIELD, field, FIELD_BYTES);

    if (status == KEEL_BSP_OK) {
        status = get(sensor, REG_TEMPERATURE, temperature, 2u);
    }
    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (keel_bus_is_still(field, FIELD_BYTES) ||
        (keel_bus_repeats(&sensor->repeats, field, FIELD_BYTES) > KEEL_IST8310_REPEATS)) {
        return KEEL_BSP_STUCK;
    }
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        sample->field[axis] = little_at(&field[2u * axis]);
    }
    sample->field[AXIS_UP] = turned_down(sample->field[AXIS_UP]);
    sample->temperature = little_at(temperature);
    return KEEL_BSP_OK;
}

/* Reads back the next setting; whichever it is, it is lost if the sensor has been reset. */
static keel_bsp_status_t check_next(keel_ist8310_t *sensor)
{
    const keel_bsp_status_t status = check_back(sensor, sensor->checked);

    sensor->checked = (sensor->checked + 1u) % SETTINGS;
    if (status == KEEL_BSP_VERIFY) {
        turn_to(sensor, KEEL_IST8310_OFF);
    }
    return status;
}

static void count_ist8310_failure(keel_ist8310_t *sensor)
{
    if (keel_progress_fail(&sensor->progress, KEEL_IST8310_FAILURES)) {
        turn_to(sensor, KEEL_IST8310_OFF);
    }
}

/* There is a sample even if the next measurement cannot be begun: that is counted, and told by the
 * step that tries again. */
static keel_bsp_status_t take_measured(keel_ist8310_t *sensor)
{
    keel_ist8310_sample_t sample = {.temperature = 0};
    keel_bsp_status_t status;

    turn_to(sensor, KEEL_IST8310_IDLE);
    status = read_sample(sensor, &sample);
    if (status == KEEL_BSP_OK) {
        status = check_next(sensor);
    }
    if (status == KEEL_BSP_OK) {
        sensor->sample = sample;
        keel_progress_sample(&sensor->progress);
        if (begin_measuring(sensor) != KEEL_BSP_WAIT) {
            count_ist8310_failure(sensor);
        }
    }
    return status;
}

static keel_bsp_status_t end_measuring(keel_ist8310_t *sensor)
{
    uint8_t state = 0u;
    const keel_bsp_status_t status = get(sensor, REG_STATUS, &state, 1u);

    if (status != KEEL_BSP_OK) {
        turn_to(sensor, KEEL_IST8310_IDLE);
        return status;
    }
    if ((state & OVERRUN) != 0u) {
        sensor->overruns = keel_progress_next(sensor->overruns);
    }
    if ((state & DATA_READY) != 0u) {
        return take_measured(sensor);
    }
    if (sensor->progress.passed_us < KEEL_IST8310_LATE_US) {
        return KEEL_BSP_WAIT;
    }
    turn_to(sensor, KEEL_IST8310_IDLE);
    return KEEL_BSP_TIMEOUT;
}

/* How long the sensor takes for what it is doing. */
static uint32_t least_time_of(keel_ist8310_state_t state)
{
    uint32_t time_us = 0u;

    if (state == KEEL_IST8310_RESETTING) {
        time_us = KEEL_IST8310_RESET_US;
    } else if (state == KEEL_IST8310_MEASURING) {
        time_us = KEEL_IST8310_MEASURE_US;
    } else {
        /* It waits for us. */
    }
    return time_us;
}

static keel_bsp_status_t do_next(keel_ist8310_t *sensor)
{
    keel_bsp_status_t status;

    switch (sensor->state) {
    case KEEL_IST8310_RESETTING:
        status = configure(sensor);
        break;
    case KEEL_IST8310_IDLE:
        status = begin_measuring(sensor);
        break;
    case KEEL_IST8310_MEASURING:
        status = end_measuring(sensor);
        break;
    default: /* KEEL_IST8310_OFF, and what cannot be. */
        status = start_doing(sensor, REG_CONTROL_2, SOFT_RESET, KEEL_IST8310_RESETTING);
        break;
    }
    return status;
}

void keel_ist8310_begin(keel_ist8310_t *sensor, keel_bus_t bus)
{
    static const keel_ist8310_t off = {.state = KEEL_IST8310_OFF};

    *sensor = off;
    sensor->bus = bus;
    sensor->progress = keel_progress_none();
}

keel_bsp_status_t keel_ist8310_step(keel_ist8310_t *sensor, uint32_t elapsed_us)
{
    keel_bsp_status_t status;

    keel_progress_pass(&sensor->progress, elapsed_us);
    if (sensor->progress.passed_us < least_time_of(sensor->state)) {
        return KEEL_BSP_WAIT;
    }
    status = do_next(sensor);
    if ((status != KEEL_BSP_OK) && (status != KEEL_BSP_WAIT)) {
        count_ist8310_failure(sensor);
    }
    return status;
}
