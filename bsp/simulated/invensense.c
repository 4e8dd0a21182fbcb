/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/invensense.h"

#include <string.h>

#define INT_STATUS  0x3Au
#define SAMPLE      0x3Bu
#define SAMPLE_END  0x49u
#define PATHS_RESET 0x68u
#define POWER       0x6Bu
#define IDENTITY_AT 0x75u
#define RESET_US    100000u
#define GARBLED     0xA5u

/* Not what the registers are after a reset: whatever they are, a driver must set what it needs. */
void simulated_invensense_brown_out(simulated_invensense_t *sensor)
{
    memset(sensor->value, 0x5A, sizeof sensor->value);
    sensor->value[POWER] = 0x40u; /* Asleep. */
}

void simulated_invensense_init(simulated_invensense_t *sensor, uint8_t identity)
{
    memset(sensor, 0, sizeof *sensor);
    sensor->identity = identity;
    sensor->stays = -1;
    sensor->waited_us = RESET_US;
    simulated_invensense_brown_out(sensor);
}

void simulated_invensense_sample(simulated_invensense_t *sensor, const int16_t *number)
{
    for (uint32_t i = 0u; i < 7u; i++) {
        const unsigned bits = (unsigned)number[i] & 0xFFFFu;

        sensor->value[SAMPLE + (2u * i)] = (uint8_t)(bits >> 8u);
        sensor->value[SAMPLE + (2u * i) + 1u] = (uint8_t)(bits & 0xFFu);
    }
    sensor->value[INT_STATUS] |= 1u;
}

static uint8_t simulated_invensense_answer(simulated_invensense_t *sensor, uint8_t address)
{
    const uint8_t value = sensor->value[address];

    if (sensor->waited_us < RESET_US) {
        return 0u; /* Still starting. */
    }
    if (address == INT_STATUS) {
        sensor->value[INT_STATUS] = (uint8_t)(value & 0xFEu);
    }
    return (address == IDENTITY_AT) ? sensor->identity : value;
}

static void simulated_invensense_take(simulated_invensense_t *sensor, uint8_t address,
                                      uint8_t value)
{
    if ((address == POWER) && ((value & 0x80u) != 0u)) {
        simulated_invensense_brown_out(sensor);
        sensor->waited_us = 0u;
        sensor->was_reset = true;
        sensor->paths_reset = 0u;
    } else if ((address == PATHS_RESET) && (sensor->waited_us >= RESET_US)) {
        sensor->paths_reset |= value;
        sensor->waited_us = 0u;
    } else if ((int)address != sensor->stays) {
        sensor->value[address] = value;
    } else {
        /* Not taken. */
    }
}

keel_bsp_status_t simulated_invensense_exchange(void *context, const uint8_t *out, uint8_t *in,
                                                uint32_t length, uint32_t *done)
{
    simulated_invensense_t *const sensor = context;
    const keel_bsp_status_t status = simulated_exchange(&sensor->faults, length, done);

    if ((status != KEEL_BSP_OK) || (*done == 0u)) {
        return status;
    }
    in[0] = 0u;
    for (uint32_t i = 1u; i < *done; i++) {
        const uint8_t address = (uint8_t)((out[0] + (i - 1u)) % SIMULATED_INVENSENSE_REGISTERS);

        if ((out[0] & 0x80u) == 0u) {
            simulated_invensense_take(sensor, address, out[i]);
            in[i] = 0u;
        } else {
            in[i] = simulated_line(&sensor->faults, simulated_invensense_answer(sensor, address));
        }
    }
    return KEEL_BSP_OK;
}

keel_bsp_status_t simulated_invensense_fast_exchange(void *context, const uint8_t *out, uint8_t *in,
                                                     uint32_t length, uint32_t *done)
{
    const uint8_t first = out[0] & 0x7Fu;
    const bool is_read = (out[0] & 0x80u) != 0u;

    if (is_read && (first >= INT_STATUS) && ((first + (length - 1u)) <= SAMPLE_END)) {
        return simulated_invensense_exchange(context, out, in, length, done);
    }
    memset(in, GARBLED, length);
    *done = length;
    return KEEL_BSP_OK;
}

keel_bsp_status_t simulated_invensense_delay(void *context, uint32_t time_us)
{
    simulated_invensense_t *const sensor = context;

    sensor->waited_us += time_us;
    return sensor->delay_fails ? KEEL_BSP_TIMEOUT : KEEL_BSP_OK;
}
