/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/invensense.h"

#define REG_SMPLRT_DIV        0x19u
#define REG_CONFIG            0x1Au
#define REG_GYRO_CONFIG       0x1Bu
#define REG_ACCEL_CONFIG      0x1Cu
#define REG_ACCEL_CONFIG2     0x1Du
#define REG_INT_ENABLE        0x38u
#define REG_INT_STATUS        0x3Au
#define REG_ACCEL_XOUT_H      0x3Bu
#define REG_SIGNAL_PATH_RESET 0x68u
#define REG_USER_CTRL         0x6Au
#define REG_PWR_MGMT_1        0x6Bu
#define REG_I2C_IF            0x70u
#define REG_WHO_AM_I          0x75u

#define ALL            0xFFu /* Bits of a register: each setting is of the whole of it. */
#define DEVICE_RESET   0x80u
#define DATA_READY     0x01u
#define SAMPLE_BYTES   14u
#define TRANSFER_BYTES (SAMPLE_BYTES + 1u)
#define SETTINGS       8u
#define OF_INTERFACE   1u
#define OF_FILTER      6u

/* 326.8 steps a degree from 25 degrees on. */
#define ICM_TEMPERATURE .counts = 817, .counts_cdeg = 250, .zero_cdeg = 2500

const keel_invensense_kind_t keel_icm20689 = {
    .bus_limit_hz = 8000000u,
    .sample_limit_hz = 8000000u,
    ICM_TEMPERATURE,
    .identity = 0x98u,
    .interface_address = REG_USER_CTRL,
    .interface_value = 0x10u,
    .signal_paths = 0u,
    .has_second_filter = true,
};

const keel_invensense_kind_t keel_icm20602 = {
    .bus_limit_hz = 10000000u,
    .sample_limit_hz = 10000000u,
    ICM_TEMPERATURE,
    .identity = 0x12u,
    .interface_address = REG_I2C_IF,
    .interface_value = 0x40u,
    .signal_paths = 0u,
    .has_second_filter = true,
};

/* 340 steps a degree from 36.53 degrees on. */
const keel_invensense_kind_t keel_mpu6000 = {
    .bus_limit_hz = 1000000u,
    .sample_limit_hz = 20000000u,
    .counts = 17,
    .counts_cdeg = 5,
    .zero_cdeg = 3653,
    .identity = 0x68u,
    .interface_address = REG_USER_CTRL,
    .interface_value = 0x10u,
    .signal_paths = 0x07u,
    .has_second_filter = false,
};

static keel_bsp_status_t reset_device(const keel_invensense_t *sensor)
{
    const keel_setting_t device = {REG_PWR_MGMT_1, ALL, DEVICE_RESET};
    const keel_setting_t paths = {REG_SIGNAL_PATH_RESET, ALL, sensor->kind->signal_paths};
    const keel_bsp_status_t status = keel_register_write(&sensor->registers, device,
                                                         KEEL_INVENSENSE_RESET_US);

    if ((status != KEEL_BSP_OK) || (sensor->kind->signal_paths == 0u)) {
        return status;
    }
    return keel_register_write(&sensor->registers, paths, KEEL_INVENSENSE_RESET_US);
}

/* Writes the settings if asked to, and reads them back. */
static keel_bsp_status_t go_through(const keel_invensense_t *sensor, bool write)
{
    /* In this order: awake and on the gyroscope's clock first, the I2C interface off before the
     * bus is shared, data ready last. */
    const keel_setting_t setting[SETTINGS] = {
        {REG_PWR_MGMT_1, ALL, 0x01u}, /* Best clock available. */
        [OF_INTERFACE] = {sensor->kind->interface_address, ALL, sensor->kind->interface_value},
        {REG_SMPLRT_DIV, ALL, 0x00u},                  /* 1 kHz. */
        {REG_CONFIG, ALL, 0x01u},                      /* Low-pass; 0 would sample at 8 kHz. */
        {REG_GYRO_CONFIG, ALL, 0x18u},                 /* 2000 degrees per second. */
        {REG_ACCEL_CONFIG, ALL, 0x18u},                /* 16 g. */
        [OF_FILTER] = {REG_ACCEL_CONFIG2, ALL, 0x01u}, /* Accelerometer's low-pass. */
        {REG_INT_ENABLE, ALL, DATA_READY},
    };
    const keel_setting_t identity = {REG_WHO_AM_I, ALL, sensor->kind->identity};
    keel_bsp_status_t status = keel_register_identify(&sensor->registers, identity);

    for (uint32_t i = 0u; (i < SETTINGS) && (status == KEEL_BSP_OK); i++) {
        const bool is_there = (i != OF_FILTER) || sensor->kind->has_second_filter;

        if (is_there && write) {
            status = keel_register_write(&sensor->registers, setting[i], KEEL_REGISTERS_SETTLE_US);
        }
        if (is_there && (status == KEEL_BSP_OK)) {
            status = keel_settings_check(&sensor->registers, &setting[i], 1u);
        }
    }
    return status;
}

keel_bsp_status_t keel_invensense_start(const keel_invensense_t *sensor)
{
    const keel_bsp_status_t status = reset_device(sensor);

    return (status == KEEL_BSP_OK) ? go_through(sensor, true) : status;
}

keel_bsp_status_t keel_invensense_check(const keel_invensense_t *sensor)
{
    return go_through(sensor, false);
}

keel_bsp_status_t keel_invensense_ready(const keel_invensense_t *sensor, bool *ready)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = keel_register_read(&sensor->sample_bus, REG_INT_STATUS,
                                                        &value);

    if (status == KEEL_BSP_OK) {
        *ready = (value & DATA_READY) != 0u;
    }
    return status;
}

keel_bsp_status_t keel_invensense_read(keel_invensense_t *sensor, keel_inertial_sample_t *sample)
{
    /* The rest of what is sent does not matter. */
    static const uint8_t out[TRANSFER_BYTES] = {[0] = REG_ACCEL_XOUT_H | KEEL_REGISTERS_READ};
    const keel_invensense_kind_t *const kind = sensor->kind;
    uint8_t in[TRANSFER_BYTES] = {[0] = 0u};
    const uint8_t *const data = &in[1];
    const keel_bsp_status_t status = keel_bus_transfer(&sensor->sample_bus, out, in,
                                                       TRANSFER_BYTES);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (keel_bus_is_still(data, SAMPLE_BYTES) ||
        (keel_bus_repeats(&sensor->repeats, data, SAMPLE_BYTES) > KEEL_INVENSENSE_REPEATS)) {
        return KEEL_BSP_STUCK;
    }
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        sample->acceleration[axis] = keel_inertial_number(data[2u * axis], data[(2u * axis) + 1u]);
        sample->rate[axis] = keel_inertial_number(data[8u + (2u * axis)], data[9u + (2u * axis)]);
    }
    sample->temperature_cdeg = (int16_t)(kind->zero_cdeg +
                                         ((keel_inertial_number(data[6], data[7]) *
                                           kind->counts_cdeg) /
                                          kind->counts));
    return KEEL_BSP_OK;
}
