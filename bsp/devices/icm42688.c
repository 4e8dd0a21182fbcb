/* SPDX-License-Identifier: Apache-2.0 */
/* Registers, values and scales are those on which the drivers of PX4, ArduPilot, Linux and Zephyr
 * agree, who cite DS-000347. The registers' chapters of the data sheet were not at hand. */
#include "devices/icm42688.h"

/* Bank 0. */
#define REG_DEVICE_CONFIG      0x11u
#define REG_INT_CONFIG         0x14u
#define REG_TEMP_DATA1         0x1Du
#define REG_INT_STATUS         0x2Du
#define REG_INTF_CONFIG0       0x4Cu
#define REG_INTF_CONFIG1       0x4Du
#define REG_PWR_MGMT0          0x4Eu
#define REG_GYRO_CONFIG0       0x4Fu
#define REG_ACCEL_CONFIG0      0x50u
#define REG_GYRO_ACCEL_CONFIG0 0x52u
#define REG_INT_CONFIG1        0x64u
#define REG_INT_SOURCE0        0x65u
#define REG_WHO_AM_I           0x75u
#define REG_BANK_SEL           0x76u /* Of all banks. */

/* Bank 1. */
#define REG_GYRO_CONFIG_STATIC2 0x0Bu
#define REG_GYRO_CONFIG_STATIC3 0x0Cu
#define REG_GYRO_CONFIG_STATIC4 0x0Du
#define REG_GYRO_CONFIG_STATIC5 0x0Eu

/* Bank 2. */
#define REG_ACCEL_CONFIG_STATIC2 0x03u
#define REG_ACCEL_CONFIG_STATIC3 0x04u
#define REG_ACCEL_CONFIG_STATIC4 0x05u

#define IDENTITY        0x47u
#define SOFT_RESET      0x01u
#define RESET_DONE      0x10u
#define DATA_READY      0x08u
#define SAMPLE_BYTES    14u
#define TRANSFER_BYTES  (SAMPLE_BYTES + 1u)
#define NUMBERS         7u
#define OF_ACCELERATION 1u
#define OF_RATE         4u
#define COUNT(of)       ((uint32_t)(sizeof(of) / sizeof((of)[0])))

/* 132.48 steps a degree from 25 degrees on: a hundredth of a degree is 828 / 625 steps. */
#define ZERO_CDEG   2500
#define COUNTS      828
#define COUNTS_CDEG 625

static const keel_setting_t who_am_i = {REG_WHO_AM_I, 0xFFu, IDENTITY};

/* Bit 7 of INTF_CONFIG0 is 0, so that what was not measured reads -32768, and nothing else does.
 * Bits 7 and 6 of INTF_CONFIG1, which the data sheet reserves, end a change of range by the sensor
 * itself, which holds the rates for up to 2 ms (ArduPilot, issue 25025). */
static const keel_setting_t bank_0_settings[] = {
    {REG_INTF_CONFIG0, 0xF3u, 0x33u},       /* Most significant byte first, no I2C. */
    {REG_INTF_CONFIG1, 0xC7u, 0x41u},       /* Best clock available, none from outside. */
    {REG_INT_CONFIG, 0x07u, 0x03u},         /* Pin INT1: pulses, high, driven. */
    {REG_INT_CONFIG1, 0x10u, 0x00u},        /* What the pins need to work. */
    {REG_INT_SOURCE0, 0x7Fu, DATA_READY},   /* INT1 tells data ready, and nothing else. */
    {REG_GYRO_ACCEL_CONFIG0, 0xFFu, 0x11u}, /* Low-pass at a quarter of 1 kHz. */
    {REG_GYRO_CONFIG0, 0xEFu, 0x06u},       /* 2000 degrees per second, 1 kHz. */
    {REG_ACCEL_CONFIG0, 0xEFu, 0x06u},      /* 16 g, 1 kHz. */
};

/* Both in low-noise mode, the thermometer on. */
static const keel_setting_t power = {REG_PWR_MGMT0, 0x3Fu, 0x0Fu};

static keel_bsp_status_t select_bank(const keel_registers_t *device, uint8_t bank)
{
    const keel_setting_t setting = {REG_BANK_SEL, 0x07u, bank};
    const keel_bsp_status_t status = keel_register_write(device, setting, 0u);

    return (status == KEEL_BSP_OK) ? keel_settings_check(device, &setting, 1u) : status;
}

/* Which bank is selected is not known, as the processor may have been reset in the midst of a
 * start. After the reset it is 0. */
static keel_bsp_status_t reset_sensor(const keel_registers_t *device)
{
    const keel_setting_t bank = {REG_BANK_SEL, 0x07u, 0u};
    const keel_setting_t reset = {REG_DEVICE_CONFIG, 0xFFu, SOFT_RESET};
    const keel_setting_t done = {REG_INT_STATUS, RESET_DONE, RESET_DONE};
    keel_bsp_status_t status = keel_register_write(device, bank, 0u);

    if (status == KEEL_BSP_OK) {
        status = keel_register_write(device, reset, KEEL_ICM42688_RESET_US);
    }
    if (status == KEEL_BSP_OK) {
        status = keel_register_identify(device, who_am_i);
    }
    return (status == KEEL_BSP_OK) ? keel_settings_check(device, &done, 1u) : status;
}

/* The settings of a bank; afterwards it stays selected. */
static keel_bsp_status_t configure_bank(const keel_registers_t *device, uint8_t bank,
                                        const keel_setting_t *setting, uint32_t count)
{
    const keel_bsp_status_t status = select_bank(device, bank);

    return (status == KEEL_BSP_OK) ? keel_settings_write(device, setting, count) : status;
}

/* Its anti-alias filter at 258 Hz, and its notch. */
static keel_bsp_status_t configure_gyroscope(const keel_registers_t *device)
{
    static const keel_setting_t setting[] = {
        {REG_GYRO_CONFIG_STATIC2, 0x03u, 0x00u}, /* Both on; … */
        {REG_GYRO_CONFIG_STATIC3, 0x3Fu, 6u},    /* … delt, … */
        {REG_GYRO_CONFIG_STATIC4, 0xFFu, 36u},   /* … its square, … */
        {REG_GYRO_CONFIG_STATIC5, 0xFFu, 0xA0u}, /* … and a shift of 10. */
    };

    return configure_bank(device, 1u, setting, COUNT(setting));
}

/* Its anti-alias filter at 213 Hz. */
static keel_bsp_status_t configure_accelerometer(const keel_registers_t *device)
{
    static const keel_setting_t setting[] = {
        {REG_ACCEL_CONFIG_STATIC2, 0x7Fu, 0x0Au}, /* On, with a delt of 5; … */
        {REG_ACCEL_CONFIG_STATIC3, 0xFFu, 25u},   /* … its square, … */
        {REG_ACCEL_CONFIG_STATIC4, 0xFFu, 0xA0u}, /* … and a shift of 10. */
    };

    return configure_bank(device, 2u, setting, COUNT(setting));
}

/* While gyroscope and accelerometer are off: only ranges, rates and power may be written while they
 * run. Bank 0 is last, as it is the one to stay in. */
static keel_bsp_status_t configure_banks(const keel_registers_t *device)
{
    keel_bsp_status_t status = configure_gyroscope(device);

    if (status == KEEL_BSP_OK) {
        status = configure_accelerometer(device);
    }
    return (status == KEEL_BSP_OK)
               ? configure_bank(device, 0u, bank_0_settings, COUNT(bank_0_settings))
               : status;
}

static keel_bsp_status_t switch_sensors_on(const keel_registers_t *device)
{
    const keel_bsp_status_t status = keel_register_write(device, power, KEEL_ICM42688_START_US);

    return (status == KEEL_BSP_OK) ? keel_settings_check(device, &power, 1u) : status;
}

keel_bsp_status_t keel_icm42688_start(const keel_icm42688_t *sensor)
{
    keel_bsp_status_t status = reset_sensor(&sensor->registers);

    if (status == KEEL_BSP_OK) {
        status = configure_banks(&sensor->registers);
    }
    return (status == KEEL_BSP_OK) ? switch_sensors_on(&sensor->registers) : status;
}

/* The identity is read of bank 0 only: another bank would answer with something else. */
keel_bsp_status_t keel_icm42688_check(const keel_icm42688_t *sensor)
{
    keel_bsp_status_t status = keel_register_identify(&sensor->registers, who_am_i);

    if (status == KEEL_BSP_OK) {
        status = keel_settings_check(&sensor->registers, bank_0_settings, COUNT(bank_0_settings));
    }
    return (status == KEEL_BSP_OK) ? keel_settings_check(&sensor->registers, &power, 1u) : status;
}

keel_bsp_status_t keel_icm42688_ready(const keel_icm42688_t *sensor, bool *ready)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = keel_register_read(&sensor->registers.bus, REG_INT_STATUS,
                                                        &value);

    if (status == KEEL_BSP_OK) {
        *ready = (value & DATA_READY) != 0u;
    }
    return status;
}

/* Temperature, acceleration and rate; returns whether all were measured. */
static bool store_measured(int16_t *number, const uint8_t *data)
{
    bool measured = true;

    for (uint32_t i = 0u; i < NUMBERS; i++) {
        number[i] = keel_inertial_number(data[2u * i], data[(2u * i) + 1u]);
        measured = measured && (number[i] != INT16_MIN);
    }
    return measured;
}

keel_bsp_status_t keel_icm42688_read(keel_icm42688_t *sensor, keel_inertial_sample_t *sample)
{
    /* The rest of what is sent does not matter. */
    static const uint8_t out[TRANSFER_BYTES] = {[0] = REG_TEMP_DATA1 | KEEL_REGISTERS_READ};
    uint8_t in[TRANSFER_BYTES] = {[0] = 0u};
    const uint8_t *const data = &in[1];
    int16_t number[NUMBERS] = {0, 0, 0, 0, 0, 0, 0};
    const keel_bsp_status_t status = keel_bus_transfer(&sensor->registers.bus, out, in,
                                                       TRANSFER_BYTES);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (keel_bus_is_still(data, SAMPLE_BYTES) ||
        (keel_bus_repeats(&sensor->repeats, data, SAMPLE_BYTES) > KEEL_ICM42688_REPEATS)) {
        return KEEL_BSP_STUCK;
    }
    if (!store_measured(number, data)) {
        return KEEL_BSP_RANGE;
    }
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        sample->acceleration[axis] = number[OF_ACCELERATION + axis];
        sample->rate[axis] = number[OF_RATE + axis];
    }
    sample->temperature_cdeg = (int16_t)(ZERO_CDEG + ((number[0] * COUNTS_CDEG) / COUNTS));
    return KEEL_BSP_OK;
}
