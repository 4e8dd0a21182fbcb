/* SPDX-License-Identifier: Apache-2.0 */
#include "desk.h"

#include "keel/flight/cascade.h"
#include "keel/flight/mode.h"

#include <stddef.h>

/* How often devices have a sample, in us. */
#define IMU_US          1000u
#define ROOM_CDEG       2000
#define CHIP_CDEG       3500
#define SUPPLY_MV       3300u
#define MAGNETOMETER_US 10000u
#define BAROMETER_US    10000u
#define GPS_US          100000u
#define RADIO_US        20000u
#define POWER_US        20000u

/* The pilot's actions, in us since the start. */
#define ARMS_US  7000000u
#define LIFTS_US 8000000u

/* The time of a byte on its line: 100000 baud and 12 bits, 115200 and 10. */
#define RADIO_BYTE_US 120u
#define GPS_BYTE_US   87u

/* A frame of SBUS, and what stands for 1500, 988, 1000, 2000 and 1050 us, and for 180 us more, in
 * its channels (see copter/pilot.c). */
#define SBUS_BYTES   25u
#define SBUS_HEADER  0x0Fu
#define CHANNELS     16u
#define CHANNEL_BITS 11u
#define MIDDLE       992u
#define LEAST        173u
#define SWITCH_OFF   192u
#define SWITCH_ON    1792u
#define MODE_FIRST   272u
#define MODE_STEP    288u

/* A NAV-PVT of UBX: where its payload begins, and a fix in three dimensions that is vouched for. */
#define UBX_BYTES    100u
#define UBX_PAYLOAD  6u
#define UBX_GOOD_FIX 0x0E000103u

#define THROTTLE 2u
#define ARM      4u
#define MODE     5u
#define KILL     6u

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

static bool read_imu(void *context, uint32_t unit, copter_imu_sample_t *sample)
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
    sample->temperature = ROOM_CDEG;
    return true;
}

static bool read_magnetometer(void *context, copter_magnetometer_sample_t *sample)
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

static bool read_barometer(void *context, copter_barometer_sample_t *sample)
{
    desk_t *const desk = context;

    if (!is_due(desk, &desk->barometer, BAROMETER_US)) {
        return false;
    }
    sample->pressure_pa = 101325.0f + dither(desk, 2.0f);
    sample->temperature = ROOM_CDEG;
    return true;
}

/* Sixteen channels of 11 bits, the lowest first. */
static void write_sbus(desk_receiver_t *to, uint32_t now_us)
{
    to->size = SBUS_BYTES;
    for (uint32_t i = 0u; i < SBUS_BYTES; i++) {
        to->byte[i] = 0u;
    }
    to->byte[0] = SBUS_HEADER;
    for (uint32_t i = 0u; i < CHANNELS; i++) {
        uint32_t value = MIDDLE;

        if (i == THROTTLE) {
            value = (now_us < LIFTS_US) ? LEAST : MIDDLE;
        } else if (i == ARM) {
            value = (now_us < ARMS_US) ? SWITCH_OFF : SWITCH_ON;
        } else if (i == MODE) {
            value = MODE_FIRST + (MODE_STEP * KEEL_MODE_POSITION);
        } else if (i == KILL) {
            value = SWITCH_OFF;
        } else {
            /* Let go. */
        }
        for (uint32_t k = 0u; k < CHANNEL_BITS; k++) {
            const uint32_t bit = (CHANNEL_BITS * i) + k;

            to->byte[1u + (bit / 8u)] |= (uint8_t)(((value >> k) & 1u) << (bit % 8u));
        }
    }
}

static void write_word(desk_receiver_t *to, uint32_t at, uint32_t value)
{
    for (uint32_t i = 0u; i < 4u; i++) {
        to->byte[UBX_PAYLOAD + at + i] = (uint8_t)((value >> (8u * i)) & 0xFFu);
    }
}

/* A NAV-PVT: see keel/middleware/ubx.h. */
static void write_ubx(desk_t *desk, desk_receiver_t *to, uint32_t now_us)
{
    static const uint8_t header[UBX_PAYLOAD] = {0xB5u, 0x62u, 0x01u, 0x07u, 0x5Cu, 0x00u};
    uint32_t a = 0u;
    uint32_t b = 0u;

    to->size = UBX_BYTES;
    for (uint32_t i = 0u; i < UBX_BYTES; i++) {
        to->byte[i] = (i < UBX_PAYLOAD) ? header[i] : 0u;
    }
    write_word(to, 0u, now_us / 1000u);
    write_word(to, 20u, UBX_GOOD_FIX);
    write_word(to, 24u, 85455940u + (uint32_t)(int32_t)dither(desk, 5.0f));
    write_word(to, 28u, 473977420u + (uint32_t)(int32_t)dither(desk, 5.0f));
    write_word(to, 40u, 1000u);
    write_word(to, 48u, (uint32_t)(int32_t)dither(desk, 50.0f));
    write_word(to, 52u, (uint32_t)(int32_t)dither(desk, 50.0f));
    write_word(to, 68u, 200u);
    for (uint32_t i = 2u; i < (UBX_BYTES - 2u); i++) {
        a = (a + to->byte[i]) % 256u;
        b = (b + a) % 256u;
    }
    to->byte[UBX_BYTES - 2u] = (uint8_t)a;
    to->byte[UBX_BYTES - 1u] = (uint8_t)b;
}

/* The first byte of a frame or message comes after silence, the others close behind it. */
static bool read_byte(void *context, uint32_t number, copter_byte_t *byte)
{
    static const uint32_t period_us[COPTER_RECEIVERS] = {RADIO_US, GPS_US};
    static const uint32_t byte_us[COPTER_RECEIVERS] = {RADIO_BYTE_US, GPS_BYTE_US};
    desk_t *const desk = context;
    desk_receiver_t *const from = &desk->receiver[number];

    if (from->sent == from->size) {
        if (!is_due(desk, &from->device, period_us[number])) {
            return false;
        }
        if (number == COPTER_RC) {
            write_sbus(from, desk->read_clock(desk->clock));
        } else {
            write_ubx(desk, from, desk->read_clock(desk->clock));
        }
        from->sent = 0u;
    }
    byte->elapsed_us = (from->sent == 0u) ? (period_us[number] - (byte_us[number] * from->size))
                                          : byte_us[number];
    byte->value = from->byte[from->sent];
    from->sent++;
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

static void read_chip(void *context, copter_chip_t *chip)
{
    (void)context;
    *chip = (copter_chip_t){.supply_mv = SUPPLY_MV,
                            .temperature = CHIP_CDEG,
                            .has_supply = true,
                            .has_temperature = true};
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
                           .imus = COPTER_IMUS,
                           .read_imu = read_imu,
                           .read_magnetometer = read_magnetometer,
                           .read_barometer = read_barometer,
                           .read_byte = read_byte,
                           .read_power = read_power,
                           .read_chip = read_chip,
                           .stack_free = stack_free,
                           .write_motors = write_motors,
                           .end_run = end_run};
}
