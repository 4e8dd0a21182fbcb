/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/ms5611.h"

#include <stdbool.h>

#define COMMAND_RESET       0x1Eu
#define COMMAND_READ        0x00u
#define COMMAND_PRESSURE    0x48u /* D1, 4096 times oversampled. */
#define COMMAND_TEMPERATURE 0x58u /* D2 likewise. */
#define COMMAND_PROM        0xA0u /* Its first word; each next is 2 higher. */

#define WORD_BYTES    2u
#define READING_BYTES 3u

static void enter(keel_ms5611_device_t *device, keel_ms5611_state_t state)
{
    device->state = state;
    keel_progress_begin(&device->progress);
}

/* Asks for a few bytes, the most significant first. */
static keel_bsp_status_t ask(const keel_ms5611_device_t *device, uint8_t code, uint8_t *byte,
                             uint32_t count)
{
    const uint8_t out[READING_BYTES + 1u] = {[0] = code};
    uint8_t in[READING_BYTES + 1u] = {[0] = 0u};
    const keel_bsp_status_t status = keel_bus_transfer(&device->bus, out, in, count + 1u);

    for (uint32_t i = 0u; i < count; i++) {
        byte[i] = in[i + 1u];
    }
    return status;
}

/* All words of the PROM, with their check. All zeros, or all ones, come from a line that does not
 * move. */
static keel_bsp_status_t read_prom(keel_ms5611_device_t *device)
{
    uint16_t word[KEEL_MS5611_WORDS] = {[0] = 0u};
    bool still = true;
    uint8_t first = 0u;

    for (uint32_t i = 0u; i < (uint32_t)KEEL_MS5611_WORDS; i++) {
        uint8_t byte[WORD_BYTES];
        const keel_bsp_status_t status = ask(device, (uint8_t)(COMMAND_PROM + (WORD_BYTES * i)),
                                             byte, WORD_BYTES);

        if (status != KEEL_BSP_OK) {
            return status;
        }
        first = (i == 0u) ? byte[0] : first;
        still = still && keel_bus_is_still(byte, WORD_BYTES) && (byte[0] == first);
        word[i] = (uint16_t)((256u * byte[0]) + byte[1]);
    }
    if (still) {
        return KEEL_BSP_STUCK;
    }
    return (keel_ms5611_init(&device->coefficients, word) == KEEL_OK) ? KEEL_BSP_OK
                                                                      : KEEL_BSP_VERIFY;
}

/* A conversion that has not ended reads 0, and what it comes to is lost then. */
static keel_bsp_status_t read_conversion(const keel_ms5611_device_t *device, uint32_t *reading)
{
    uint8_t byte[READING_BYTES];
    const keel_bsp_status_t status = ask(device, COMMAND_READ, byte, READING_BYTES);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    *reading = (65536u * byte[0]) + (256u * byte[1]) + byte[2];
    if (*reading == 0u) {
        return KEEL_BSP_TIMEOUT;
    }
    return (*reading == (uint32_t)KEEL_MS5611_READING_MAX) ? KEEL_BSP_STUCK : KEEL_BSP_OK;
}

/* Sends a command with which the sensor begins something. */
static keel_bsp_status_t order(keel_ms5611_device_t *device, uint8_t command,
                               keel_ms5611_state_t state)
{
    uint8_t in = 0u;
    const keel_bsp_status_t status = keel_bus_transfer(&device->bus, &command, &in, 1u);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    enter(device, state);
    return KEEL_BSP_WAIT;
}

/* Whether both readings have been the same for too long. */
static bool is_frozen(keel_ms5611_device_t *device, uint32_t pressure)
{
    const uint32_t temperature = device->temperature;
    const uint8_t byte[2u * READING_BYTES] = {
        (uint8_t)(pressure >> 16u),    (uint8_t)(pressure >> 8u),    (uint8_t)pressure,
        (uint8_t)(temperature >> 16u), (uint8_t)(temperature >> 8u), (uint8_t)temperature};

    return keel_bus_repeats(&device->repeats, byte, 2u * READING_BYTES) > KEEL_MS5611_REPEATS;
}

static keel_bsp_status_t take_sample(keel_ms5611_device_t *device, uint32_t pressure)
{
    if (is_frozen(device, pressure)) {
        return KEEL_BSP_STUCK;
    }
    if (keel_ms5611_compensate(&device->coefficients, pressure, device->temperature,
                               &device->sample) != KEEL_OK) {
        return KEEL_BSP_RANGE;
    }
    keel_progress_sample(&device->progress);
    return KEEL_BSP_OK;
}

static keel_bsp_status_t load(keel_ms5611_device_t *device)
{
    const keel_bsp_status_t status = read_prom(device);

    if (status != KEEL_BSP_OK) {
        enter(device, KEEL_MS5611_OFF);
        return status;
    }
    enter(device, KEEL_MS5611_IDLE);
    return order(device, COMMAND_TEMPERATURE, KEEL_MS5611_TEMPERATURE);
}

static keel_bsp_status_t end_temperature(keel_ms5611_device_t *device)
{
    uint32_t reading = 0u;
    const keel_bsp_status_t status = read_conversion(device, &reading);

    enter(device, KEEL_MS5611_IDLE);
    if (status != KEEL_BSP_OK) {
        return status;
    }
    device->temperature = reading;
    return order(device, COMMAND_PRESSURE, KEEL_MS5611_PRESSURE);
}

static void count_failure(keel_ms5611_device_t *device)
{
    if (keel_progress_fail(&device->progress, KEEL_MS5611_FAILURES)) {
        enter(device, KEEL_MS5611_OFF);
    }
}

/* There is a sample even if what comes next cannot be begun: that is counted, and told by the step
 * that tries again. */
static keel_bsp_status_t end_pressure(keel_ms5611_device_t *device)
{
    uint32_t reading = 0u;
    keel_bsp_status_t status = read_conversion(device, &reading);

    enter(device, KEEL_MS5611_IDLE);
    if (status == KEEL_BSP_OK) {
        status = take_sample(device, reading);
    }
    if ((status == KEEL_BSP_OK) &&
        (order(device, COMMAND_TEMPERATURE, KEEL_MS5611_TEMPERATURE) != KEEL_BSP_WAIT)) {
        count_failure(device);
    }
    return status;
}

/* How long the sensor takes for what it is doing. */
static uint32_t time_of(keel_ms5611_state_t state)
{
    uint32_t time_us = 0u;

    if (state == KEEL_MS5611_RESETTING) {
        time_us = KEEL_MS5611_RESET_US;
    } else if ((state == KEEL_MS5611_TEMPERATURE) || (state == KEEL_MS5611_PRESSURE)) {
        time_us = KEEL_MS5611_CONVERSION_US;
    } else {
        /* It waits for us. */
    }
    return time_us;
}

static keel_bsp_status_t go_on(keel_ms5611_device_t *device)
{
    keel_bsp_status_t status;

    switch (device->state) {
    case KEEL_MS5611_RESETTING:
        status = load(device);
        break;
    case KEEL_MS5611_IDLE:
        status = order(device, COMMAND_TEMPERATURE, KEEL_MS5611_TEMPERATURE);
        break;
    case KEEL_MS5611_TEMPERATURE:
        status = end_temperature(device);
        break;
    case KEEL_MS5611_PRESSURE:
        status = end_pressure(device);
        break;
    default: /* KEEL_MS5611_OFF, and what cannot be. */
        status = order(device, COMMAND_RESET, KEEL_MS5611_RESETTING);
        break;
    }
    return status;
}

void keel_ms5611_begin(keel_ms5611_device_t *device, keel_bus_t bus)
{
    static const keel_ms5611_device_t off = {.state = KEEL_MS5611_OFF};

    *device = off;
    device->bus = bus;
    device->progress = keel_progress_none();
}

keel_bsp_status_t keel_ms5611_step(keel_ms5611_device_t *device, uint32_t elapsed_us)
{
    keel_bsp_status_t status;

    keel_progress_pass(&device->progress, elapsed_us);
    if (device->progress.passed_us < time_of(device->state)) {
        return KEEL_BSP_WAIT;
    }
    status = go_on(device);
    if ((status != KEEL_BSP_OK) && (status != KEEL_BSP_WAIT)) {
        count_failure(device);
    }
    return status;
}
