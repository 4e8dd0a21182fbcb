/* SPDX-License-Identifier: Apache-2.0 */
/* Registers, values and scales are those on which the drivers of PX4, ArduPilot, Linux and Zephyr
 * agree. The registers' chapters of the data sheet (BST-BMI055-DS000) were not at hand. The pin PS
 * chooses the interface, so no first read must be thrown away, as a BMI088 wants. */
#include "devices/bmi055.h"

/* The same of both. */
#define REG_CHIP_ID   0x00u
#define REG_RANGE     0x0Fu
#define REG_BANDWIDTH 0x10u
#define REG_POWER     0x11u
#define REG_HBW       0x13u
#define REG_SOFTRESET 0x14u

#define RESET               0xB6u
#define GYROSCOPE_ID        0x0Fu
#define ACCELEROMETER_ID    0xFAu
#define SETTINGS            4u
#define BURST_MOST          10u /* The address, and registers from the identity on: … */
#define GYROSCOPE_BURST     9u  /* … to 0x07, the last byte of the rates; … */
#define ACCELEROMETER_BURST 10u /* … to 0x08, the temperature. */
#define OF_ID               1u
#define OF_DATA             3u
#define OF_TEMPERATURE      9u
#define DATA_BYTES          6u
#define ACCELERATION_BITS   0xF0u /* Of the lower byte; bit 0 says whether it was read. */
#define ZERO_CDEG           2300  /* 23 degrees, and … */
#define STEP_CDEG           50    /* … half a degree a step. */

static const keel_setting_t identity_of_gyroscope = {REG_CHIP_ID, 0xFFu, GYROSCOPE_ID};
static const keel_setting_t identity_of_accelerometer = {REG_CHIP_ID, 0xFFu, ACCELEROMETER_ID};

/* In this order: awake first, as a sleeping device takes no other setting. */
static const keel_setting_t gyroscope_settings[SETTINGS] = {
    {REG_POWER, 0xA0u, 0x00u},     /* LPM1: neither suspended nor deeply so. */
    {REG_RANGE, 0x07u, 0x00u},     /* 2000 degrees per second. */
    {REG_BANDWIDTH, 0x0Fu, 0x02u}, /* 1 kHz, low-pass at 116 Hz; bit 7 always reads 1. */
    {REG_HBW, 0xC0u, 0x00u},       /* Filtered; reading a lower byte holds the upper one. */
};

static const keel_setting_t accelerometer_settings[SETTINGS] = {
    {REG_POWER, 0xE0u, 0x00u},     /* PMU_LPW: neither suspended nor in low power. */
    {REG_RANGE, 0x0Fu, 0x0Cu},     /* 16 g. */
    {REG_BANDWIDTH, 0x1Fu, 0x0Eu}, /* A sample each 1 ms, low-pass at 500 Hz. */
    {REG_HBW, 0xC0u, 0x00u},       /* As above. */
};

static keel_bsp_status_t reset_part(const keel_registers_t *device, uint32_t time_us)
{
    const keel_setting_t reset = {REG_SOFTRESET, 0xFFu, RESET};

    return keel_register_write(device, reset, time_us);
}

/* They start side by side, in KEEL_BMI055_RESET_US. */
static keel_bsp_status_t reset_both(const keel_bmi055_t *sensor)
{
    const keel_bsp_status_t status = reset_part(&sensor->gyroscope, 0u);

    return (status == KEEL_BSP_OK) ? reset_part(&sensor->accelerometer, KEEL_BMI055_RESET_US)
                                   : status;
}

static keel_bsp_status_t configure_part(const keel_registers_t *device, keel_setting_t identity,
                                        const keel_setting_t *setting)
{
    const keel_bsp_status_t status = keel_register_identify(device, identity);

    return (status == KEEL_BSP_OK) ? keel_settings_write(device, setting, SETTINGS) : status;
}

static keel_bsp_status_t check_part(const keel_registers_t *device, keel_setting_t identity,
                                    const keel_setting_t *setting)
{
    const keel_bsp_status_t status = keel_register_identify(device, identity);

    return (status == KEEL_BSP_OK) ? keel_settings_check(device, setting, SETTINGS) : status;
}

keel_bsp_status_t keel_bmi055_start(const keel_bmi055_t *sensor)
{
    keel_bsp_status_t status = reset_both(sensor);

    if (status == KEEL_BSP_OK) {
        status = configure_part(&sensor->gyroscope, identity_of_gyroscope, gyroscope_settings);
    }
    return (status == KEEL_BSP_OK)
               ? configure_part(&sensor->accelerometer, identity_of_accelerometer,
                                accelerometer_settings)
               : status;
}

keel_bsp_status_t keel_bmi055_check(const keel_bmi055_t *sensor)
{
    const keel_bsp_status_t status = check_part(&sensor->gyroscope, identity_of_gyroscope,
                                                gyroscope_settings);

    return (status == KEEL_BSP_OK) ? check_part(&sensor->accelerometer, identity_of_accelerometer,
                                                accelerometer_settings)
                                   : status;
}

/* A burst from the identity on: of a gyroscope at rest all rates may be zero, so the data would
 * not tell it from a line that does not move. */
static keel_bsp_status_t read_burst(const keel_registers_t *device, uint8_t identity, uint8_t *in,
                                    uint32_t length)
{
    /* The rest of what is sent does not matter. */
    static const uint8_t out[BURST_MOST] = {[0] = REG_CHIP_ID | KEEL_REGISTERS_READ};
    const keel_bsp_status_t status = keel_bus_transfer(&device->bus, out, in, length);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (keel_bus_is_still(&in[OF_ID], length - OF_ID)) {
        return KEEL_BSP_STUCK;
    }
    return (in[OF_ID] == identity) ? KEEL_BSP_OK : KEEL_BSP_ID;
}

/* Three numbers of two bytes, the least significant first. */
static void store_axes(int16_t *number, const uint8_t *data)
{
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        number[axis] = keel_inertial_number(data[(2u * axis) + 1u], data[2u * axis]);
    }
}

static keel_bsp_status_t read_rates(keel_bmi055_t *sensor, keel_inertial_sample_t *sample)
{
    uint8_t in[GYROSCOPE_BURST] = {[0] = 0u};
    const keel_bsp_status_t status = read_burst(&sensor->gyroscope, GYROSCOPE_ID, in,
                                                GYROSCOPE_BURST);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    store_axes(sample->rate, &in[OF_DATA]);
    return (keel_bus_repeats(&sensor->rates, &in[OF_DATA], DATA_BYTES) > KEEL_BMI055_REPEATS)
               ? KEEL_BSP_STUCK
               : KEEL_BSP_OK;
}

static keel_bsp_status_t read_accelerations(keel_bmi055_t *sensor, keel_inertial_sample_t *sample)
{
    uint8_t in[ACCELEROMETER_BURST] = {[0] = 0u};
    const keel_bsp_status_t status = read_burst(&sensor->accelerometer, ACCELEROMETER_ID, in,
                                                ACCELEROMETER_BURST);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    /* 12 bits, left-justified: as a number of 16 bits they count 1 / 2048 g. */
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        in[OF_DATA + (2u * axis)] &= ACCELERATION_BITS;
    }
    store_axes(sample->acceleration, &in[OF_DATA]);
    sample->temperature_cdeg = (int16_t)(ZERO_CDEG +
                                         ((keel_inertial_number(in[OF_TEMPERATURE], 0u) / 256) *
                                          STEP_CDEG));
    return (keel_bus_repeats(&sensor->accelerations, &in[OF_DATA], DATA_BYTES) >
            KEEL_BMI055_REPEATS)
               ? KEEL_BSP_STUCK
               : KEEL_BSP_OK;
}

keel_bsp_status_t keel_bmi055_read(keel_bmi055_t *sensor, keel_inertial_sample_t *sample)
{
    keel_inertial_sample_t fresh = {{0, 0, 0}, 0, {0, 0, 0}};
    keel_bsp_status_t status = read_rates(sensor, &fresh);

    if (status == KEEL_BSP_OK) {
        status = read_accelerations(sensor, &fresh);
    }
    if (status == KEEL_BSP_OK) {
        *sample = fresh;
    }
    return status;
}
