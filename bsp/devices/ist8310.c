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
#define BURST       (1u + FIELD_BYTES) /* The status, and behind it the field. */
#define SETTINGS    3u
#define UNITS       2u /* The setting that changes what a sample counts. */
#define TEMPERATURE SETTINGS
#define ASIDES      (SETTINGS + 1u)
#define AXIS_UP     2u
#define HALF        4u /* Of squares. */

/* The start: identity, end of the reset, and each setting written and read back. */
#define START_IDENTITY 0u
#define START_RESET    1u
#define START_SETTINGS 2u
#define START_END      (START_SETTINGS + (2u * SETTINGS))

/* A register with what it is set to. */
typedef struct ist8310_setting {
    uint8_t address;
    uint8_t value;
} ist8310_setting_t;

/* After a reset each of them reads 0, or other bits. */
static const ist8310_setting_t ist8310_setting[SETTINGS] = {
    {REG_AVERAGE, 0x24u},            /* 16 times, all axes. */
    {REG_PULSE, 0xC0u},              /* As its maker asks for. */
    [UNITS] = {REG_CONTROL_3, 0x70u} /* 16 bits, all axes: 1320 counts a gauss. */
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
    const uint8_t out[BURST + 1u] = {[0] = address};
    uint8_t in[BURST + 1u] = {[0] = 0u};
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

static keel_bsp_status_t check_identity(const keel_ist8310_t *sensor)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = get(sensor, REG_IDENTITY, &value, 1u);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (keel_bus_is_still(&value, 1u)) {
        return KEEL_BSP_STUCK;
    }
    return (value == IDENTITY) ? KEEL_BSP_OK : KEEL_BSP_ID;
}

static keel_bsp_status_t check_reset(const keel_ist8310_t *sensor)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = get(sensor, REG_CONTROL_2, &value, 1u);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    return ((value & SOFT_RESET) == 0u) ? KEEL_BSP_OK : KEEL_BSP_TIMEOUT;
}

/* Writes the settings in turn, and reads each back. */
static keel_bsp_status_t set_up(const keel_ist8310_t *sensor, uint32_t step)
{
    const uint32_t index = step / 2u;

    return ((step % 2u) == 0u)
               ? put(sensor, ist8310_setting[index].address, ist8310_setting[index].value)
               : check_back(sensor, index);
}

/* The next exchange of the start; a start that fails begins with a reset again. */
static keel_bsp_status_t start_on(keel_ist8310_t *sensor)
{
    keel_bsp_status_t status;

    if (sensor->started == START_IDENTITY) {
        status = check_identity(sensor);
    } else if (sensor->started == START_RESET) {
        status = check_reset(sensor);
    } else {
        status = set_up(sensor, sensor->started - START_SETTINGS);
    }
    sensor->started++;
    if (status != KEEL_BSP_OK) {
        turn_to(sensor, KEEL_IST8310_OFF);
        return status;
    }
    turn_to(sensor, (sensor->started < START_END) ? KEEL_IST8310_STARTING : KEEL_IST8310_IDLE);
    return KEEL_BSP_WAIT;
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

/* A sensor that is reset is not known any more: its first sample is proved, and behind it the
 * temperature is read. */
static keel_bsp_status_t begin_reset(keel_ist8310_t *sensor)
{
    sensor->started = 0u;
    sensor->aside = TEMPERATURE;
    sensor->since_aside = KEEL_IST8310_ASIDE - 1u;
    sensor->strength = UINT32_MAX;
    return start_doing(sensor, REG_CONTROL_2, SOFT_RESET, KEEL_IST8310_RESETTING);
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

/* How strong a field is, squared: three squares of 2^30 at most. */
static uint32_t strength_of(const int16_t field[3])
{
    uint32_t sum = 0u;

    for (uint32_t axis = 0u; axis < 3u; axis++) {
        const int32_t square = (int32_t)field[axis] * field[axis];

        sum += (uint32_t)square;
    }
    return sum;
}

/* There is a sample. */
static keel_bsp_status_t tell_sample(keel_ist8310_t *sensor)
{
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        sensor->sample.field[axis] = sensor->field[axis];
    }
    sensor->sample.temperature = sensor->temperature;
    sensor->strength = strength_of(sensor->field);
    sensor->since_aside++;
    keel_progress_sample(&sensor->progress);
    turn_to(sensor, (sensor->since_aside < KEEL_IST8310_ASIDE) ? KEEL_IST8310_IDLE
                                                               : KEEL_IST8310_ASIDE_DUE);
    return KEEL_BSP_OK;
}

static keel_bsp_status_t take_magnetic_field(keel_ist8310_t *sensor, const uint8_t *byte)
{
    if (keel_bus_is_still(byte, FIELD_BYTES) ||
        (keel_bus_repeats(&sensor->repeats, byte, FIELD_BYTES) > KEEL_IST8310_REPEATS)) {
        return KEEL_BSP_STUCK;
    }
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        sensor->field[axis] = little_at(&byte[2u * axis]);
    }
    sensor->field[AXIS_UP] = turned_down(sensor->field[AXIS_UP]);
    if ((sensor->strength == UINT32_MAX) ||
        (strength_of(sensor->field) < (sensor->strength / HALF))) {
        turn_to(sensor, KEEL_IST8310_PROVING);
        return KEEL_BSP_WAIT;
    }
    return tell_sample(sensor);
}

/* Whatever is wrong with a measurement, the next one is begun behind it. A field that comes within
 * the burst is lost, as reading takes it away; then this is told as late. */
static keel_bsp_status_t end_measuring(keel_ist8310_t *sensor)
{
    uint8_t byte[BURST];
    const keel_bsp_status_t status = get(sensor, REG_STATUS, byte, BURST);

    if (status != KEEL_BSP_OK) {
        turn_to(sensor, KEEL_IST8310_IDLE);
        return status;
    }
    if ((byte[0] & OVERRUN) != 0u) {
        sensor->overruns = keel_progress_next(sensor->overruns);
    }
    if ((byte[0] & DATA_READY) != 0u) {
        turn_to(sensor, KEEL_IST8310_IDLE);
        return take_magnetic_field(sensor, &byte[1]);
    }
    if (sensor->progress.passed_us < KEEL_IST8310_LATE_US) {
        return KEEL_BSP_WAIT;
    }
    turn_to(sensor, KEEL_IST8310_IDLE);
    return KEEL_BSP_TIMEOUT;
}

/* Reads a setting back; whichever it is, it is lost if the sensor has been reset. */
static keel_bsp_status_t check_kept(keel_ist8310_t *sensor, uint32_t index)
{
    const keel_bsp_status_t status = check_back(sensor, index);

    turn_to(sensor, (status == KEEL_BSP_VERIFY) ? KEEL_IST8310_OFF : KEEL_IST8310_IDLE);
    return status;
}

/* The sample is in the right units if they are set now: it would have gone with them. */
static keel_bsp_status_t prove_sample(keel_ist8310_t *sensor)
{
    const keel_bsp_status_t status = check_kept(sensor, UNITS);

    return (status == KEEL_BSP_OK) ? tell_sample(sensor) : status;
}

static keel_bsp_status_t read_temperature(keel_ist8310_t *sensor)
{
    uint8_t byte[2];
    const keel_bsp_status_t status = get(sensor, REG_TEMPERATURE, byte, 2u);

    turn_to(sensor, KEEL_IST8310_IDLE);
    if (status == KEEL_BSP_OK) {
        sensor->temperature = little_at(byte);
    }
    return status;
}

/* One that fails is tried again behind the next sample. */
static keel_bsp_status_t step_aside(keel_ist8310_t *sensor)
{
    const keel_bsp_status_t status = (sensor->aside == TEMPERATURE)
                                         ? read_temperature(sensor)
                                         : check_kept(sensor, sensor->aside);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    sensor->aside = (sensor->aside + 1u) % ASIDES;
    sensor->since_aside = 0u;
    return KEEL_BSP_WAIT;
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
    case KEEL_IST8310_STARTING:
        status = start_on(sensor);
        break;
    case KEEL_IST8310_IDLE:
        status = start_doing(sensor, REG_CONTROL_1, SINGLE, KEEL_IST8310_MEASURING);
        break;
    case KEEL_IST8310_MEASURING:
        status = end_measuring(sensor);
        break;
    case KEEL_IST8310_PROVING:
        status = prove_sample(sensor);
        break;
    case KEEL_IST8310_ASIDE_DUE:
        status = step_aside(sensor);
        break;
    default: /* KEEL_IST8310_OFF, and what cannot be. */
        status = begin_reset(sensor);
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
    if ((status != KEEL_BSP_OK) && (status != KEEL_BSP_WAIT) &&
        keel_progress_fail(&sensor->progress, KEEL_IST8310_FAILURES)) {
        turn_to(sensor, KEEL_IST8310_OFF);
    }
    return status;
}
