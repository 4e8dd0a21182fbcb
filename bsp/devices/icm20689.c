/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/icm20689.h"

#define REG_SMPLRT_DIV    0x19u
#define REG_CONFIG        0x1Au
#define REG_GYRO_CONFIG   0x1Bu
#define REG_ACCEL_CONFIG  0x1Cu
#define REG_ACCEL_CONFIG2 0x1Du
#define REG_INT_ENABLE    0x38u
#define REG_INT_STATUS    0x3Au
#define REG_ACCEL_XOUT_H  0x3Bu
#define REG_USER_CTRL     0x6Au
#define REG_PWR_MGMT_1    0x6Bu
#define REG_WHO_AM_I      0x75u

#define READ           0x80u /* Bit 7 of the address. */
#define IDENTITY       0x98u
#define DEVICE_RESET   0x80u
#define DATA_READY     0x01u
#define ALL_ONES       0xFFu
#define SETTLE_US      1000u
#define SAMPLE_BYTES   14u
#define TRANSFER_BYTES (SAMPLE_BYTES + 1u)
#define SETTINGS       8u

/* A register with what it is set to. */
typedef struct setting {
    uint8_t address;
    uint8_t value;
} setting_t;

/* One exchange in which all bytes must come. */
static keel_bsp_status_t exchange(const keel_icm20689_t *sensor, const uint8_t *out, uint8_t *in,
                                  uint32_t length)
{
    uint32_t done = 0u;
    const keel_bsp_status_t status = sensor->bus.exchange(sensor->bus.context, out, in, length,
                                                          &done);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    return (done == length) ? KEEL_BSP_OK : KEEL_BSP_SHORT;
}

static keel_bsp_status_t read_register(const keel_icm20689_t *sensor, uint8_t address,
                                       uint8_t *value)
{
    const uint8_t out[2] = {(uint8_t)(address | READ), 0u};
    uint8_t in[2] = {0u, 0u};
    const keel_bsp_status_t status = exchange(sensor, out, in, 2u);

    if (status == KEEL_BSP_OK) {
        *value = in[1];
    }
    return status;
}

static keel_bsp_status_t write_register(const keel_icm20689_t *sensor, uint8_t address,
                                        uint8_t value)
{
    const uint8_t out[2] = {address, value};
    uint8_t in[2] = {0u, 0u};

    return exchange(sensor, out, in, 2u);
}

static keel_bsp_status_t check_identity(const keel_icm20689_t *sensor)
{
    uint8_t identity = 0u;
    const keel_bsp_status_t status = read_register(sensor, REG_WHO_AM_I, &identity);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if ((identity == 0u) || (identity == ALL_ONES)) {
        return KEEL_BSP_STUCK;
    }
    return (identity == IDENTITY) ? KEEL_BSP_OK : KEEL_BSP_ID;
}

static keel_bsp_status_t apply(const keel_icm20689_t *sensor, setting_t wanted)
{
    uint8_t value = 0u;
    keel_bsp_status_t status = write_register(sensor, wanted.address, wanted.value);

    if (status == KEEL_BSP_OK) {
        status = sensor->delay(sensor->delay_context, SETTLE_US);
    }
    if (status == KEEL_BSP_OK) {
        status = read_register(sensor, wanted.address, &value);
    }
    if (status != KEEL_BSP_OK) {
        return status;
    }
    return (value == wanted.value) ? KEEL_BSP_OK : KEEL_BSP_VERIFY;
}

keel_bsp_status_t keel_icm20689_start(const keel_icm20689_t *sensor)
{
    /* In this order: awake and on the gyroscope's clock first, the I2C interface off before the
     * bus is shared, data ready last. */
    static const setting_t setting[SETTINGS] = {
        {REG_PWR_MGMT_1, 0x01u},    /* Best clock available. */
        {REG_USER_CTRL, 0x10u},     /* No I2C. */
        {REG_SMPLRT_DIV, 0x00u},    /* 1 kHz. */
        {REG_CONFIG, 0x01u},        /* Low-pass at 176 Hz; 0 would sample at 8 kHz. */
        {REG_GYRO_CONFIG, 0x18u},   /* 2000 degrees per second. */
        {REG_ACCEL_CONFIG, 0x18u},  /* 16 g. */
        {REG_ACCEL_CONFIG2, 0x01u}, /* Accelerometer's low-pass at 218 Hz. */
        {REG_INT_ENABLE, DATA_READY},
    };
    keel_bsp_status_t status = write_register(sensor, REG_PWR_MGMT_1, DEVICE_RESET);

    if (status == KEEL_BSP_OK) {
        status = sensor->delay(sensor->delay_context, KEEL_ICM20689_RESET_US);
    }
    if (status == KEEL_BSP_OK) {
        status = check_identity(sensor);
    }
    for (uint32_t i = 0u; (i < SETTINGS) && (status == KEEL_BSP_OK); i++) {
        status = apply(sensor, setting[i]);
    }
    return status;
}

keel_bsp_status_t keel_icm20689_ready(const keel_icm20689_t *sensor, bool *ready)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = read_register(sensor, REG_INT_STATUS, &value);

    if (status == KEEL_BSP_OK) {
        *ready = (value & DATA_READY) != 0u;
    }
    return status;
}

/* A number of two bytes, the most significant first, as two's complement. */
static int16_t number_at(const uint8_t *byte)
{
    const int32_t value = ((int32_t)byte[0] * 256) + (int32_t)byte[1];

    return (int16_t)((value > INT16_MAX) ? (value - 65536) : value);
}

/* Whether all bytes are zeros, or all are ones: a sensor that answers is never so still. */
static bool is_stuck(const uint8_t *byte, uint32_t length)
{
    bool same = (byte[0] == 0u) || (byte[0] == ALL_ONES);

    for (uint32_t i = 1u; i < length; i++) {
        same = same && (byte[i] == byte[0]);
    }
    return same;
}

keel_bsp_status_t keel_icm20689_read(const keel_icm20689_t *sensor, keel_icm20689_sample_t *sample)
{
    /* The rest of what is sent does not matter. */
    static const uint8_t out[TRANSFER_BYTES] = {[0] = REG_ACCEL_XOUT_H | READ};
    uint8_t in[TRANSFER_BYTES] = {[0] = 0u};
    const uint8_t *const data = &in[1];
    const keel_bsp_status_t status = exchange(sensor, out, in, TRANSFER_BYTES);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (is_stuck(data, SAMPLE_BYTES)) {
        return KEEL_BSP_STUCK;
    }
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        sample->acceleration[axis] = number_at(&data[2u * axis]);
        sample->rate[axis] = number_at(&data[8u + (2u * axis)]);
    }
    sample->temperature = number_at(&data[6]);
    return KEEL_BSP_OK;
}
