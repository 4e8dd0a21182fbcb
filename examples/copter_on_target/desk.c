/* SPDX-License-Identifier: Apache-2.0 */
#include "desk.h"

#include "keel/flight/cascade.h"
#include "keel/flight/mode.h"

#include <stddef.h>

/* How often devices have a sample, in us. */
#define IMU_US          1000u
#define MAGNETOMETER_US 10000u
#define BAROMETER_US    10000u
#define GPS_US          100000u
#define RADIO_US        20000u
#define POWER_US        20000u

/* What the pilot does, in us since the start. */
#define ARMS_US  7000000u
#define LIFTS_US 8000000u

/* Channels of the radio: see copter/pilot.c. */
#define MIDDLE     1500u
#define LEAST      988u
#define SWITCH_OFF 1000u
#define SWITCH_ON  2000u
#define MODE_FIRST 1050u
#define MODE_STEP  180u
#define THROTTLE   2u
#define ARM        4u
#define MODE       5u
#define KILL       6u

#define HALF_SEQUENCE 32768.0f

/* A number from -size to size, of a sequence (Numerical Recipes' "quick and dirty" generator). */
static float dither(desk_t *desk, float size)
{
    desk->dither = (desk->dither * 1664525u) + 1013904223u;
    return size * (((float)(desk->dither >> 16) / HALF_SEQUENCE) - 1.0f);
}

/* Whether a device has a new sample. */
static bool is_due(desk_t *desk, desk_device_t *device, uint32_t period_us)
{
    const uint32_t now_us = desk->read_clock(desk->clock);
    const bool due = !device->started || ((now_us - device->last_us) >= period_us);

    if (due) {
        device->last_us = device->started ? (device->last_us + period_us) : now_us;
        device->started = true;
    }
    return due;
}

static bool read_imu(void *context, uint32_t unit, copter_inertial_t *sample)
{
    desk_t *const desk = context;

    if (!is_due(desk, &desk->imu[unit], IMU_US)) {
        return false;
    }
    for (uint32_t k = 0u; k < 3u; k++) {
        sample->accelerometer[k] = dither(desk, 0.05f);
        sample->gyroscope[k] = dither(desk, 0.002f);
    }
    sample->accelerometer[2] -= KEEL_CASCADE_GRAVITY;
    return true;
}

static bool read_magnetometer(void *context, copter_field_t *sample)
{
    desk_t *const desk = context;

    if (!is_due(desk, &desk->magnetometer, MAGNETOMETER_US)) {
        return false;
    }
    sample->value[0] = 21.6f + dither(desk, 0.2f);
    sample->value[1] = 1.25f + dither(desk, 0.2f);
    sample->value[2] = 40.0f + dither(desk, 0.2f);
    return true;
}

static bool read_barometer(void *context, float *pressure_pa)
{
    desk_t *const desk = context;

    if (!is_due(desk, &desk->barometer, BAROMETER_US)) {
        return false;
    }
    *pressure_pa = 101325.0f + dither(desk, 2.0f);
    return true;
}

static bool read_gps(void *context, copter_fix_t *fix)
{
    desk_t *const desk = context;

    if (!is_due(desk, &desk->gps, GPS_US)) {
        return false;
    }
    *fix = (copter_fix_t){.latitude = 473977420 + (int32_t)dither(desk, 5.0f),
                          .longitude = 85455940 + (int32_t)dither(desk, 5.0f),
                          .north = dither(desk, 0.05f),
                          .east = dither(desk, 0.05f),
                          .accuracy = 1.0f,
                          .speed_accuracy = 0.2f,
                          .is_valid = true};
    return true;
}

static bool read_radio(void *context, copter_frame_t *frame)
{
    desk_t *const desk = context;
    const uint32_t now_us = desk->read_clock(desk->clock);

    if (!is_due(desk, &desk->radio, RADIO_US)) {
        return false;
    }
    for (uint32_t i = 0u; i < COPTER_CHANNELS; i++) {
        frame->channel[i] = MIDDLE;
    }
    frame->channel[THROTTLE] = (now_us < LIFTS_US) ? LEAST : MIDDLE;
    frame->channel[ARM] = (now_us < ARMS_US) ? SWITCH_OFF : SWITCH_ON;
    frame->channel[MODE] = MODE_FIRST + (MODE_STEP * KEEL_MODE_POSITION);
    frame->channel[KILL] = SWITCH_OFF;
    frame->failsafe = false;
    return true;
}

static bool read_power(void *context, uint32_t module, copter_power_reading_t *reading)
{
    desk_t *const desk = context;

    if (!is_due(desk, &desk->power[module], POWER_US)) {
        return false;
    }
    *reading = (copter_power_reading_t){.voltage = 16.0f + dither(desk, 0.02f), .current = 6.0f};
    return true;
}

static uint32_t stack_free(void *context)
{
    (void)context;
    return 0u;
}

static void write_motors(void *context, const float output[COPTER_MOTORS])
{
    desk_t *const desk = context;

    for (uint32_t i = 0u; i < COPTER_MOTORS; i++) {
        desk->motor[i] = output[i];
    }
}

static void end_run(void *context, uint32_t row, uint32_t wcet_us)
{
    (void)context;
    (void)row;
    (void)wcet_us;
}

copter_port_t desk_port(desk_t *desk, keel_clock_fn_t read_clock, void *clock)
{
    *desk = (desk_t){.read_clock = read_clock, .clock = clock, .dither = 1u};
    return (copter_port_t){.read_clock = read_clock,
                           .clock = clock,
                           .context = desk,
                           .read_imu = read_imu,
                           .read_magnetometer = read_magnetometer,
                           .read_barometer = read_barometer,
                           .read_gps = read_gps,
                           .read_radio = read_radio,
                           .read_power = read_power,
                           .stack_free = stack_free,
                           .write_motors = write_motors,
                           .end_run = end_run};
}
