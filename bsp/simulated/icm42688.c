/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/icm42688.h"

#include <string.h>

#define DEVICE_CONFIG 0x11u
#define SAMPLE        0x1Du
#define INT_STATUS    0x2Du
#define POWER         0x4Eu
#define RANGES_END    0x51u
#define IDENTITY_AT   0x75u
#define BANK          0x76u
#define RESET_DONE    0x10u
#define DATA_READY    0x08u
#define RESET_US      1000u
#define NO_WRITE_US   200u

/* Not what the registers are after a reset: whatever they are, a driver must set what it needs. But
 * nothing is measured yet, and bank 0 is selected. */
void simulated_icm42688_brown_out(simulated_icm42688_t *sensor)
{
    static const int16_t nothing[7] = {INT16_MIN, INT16_MIN, INT16_MIN, INT16_MIN,
                                       INT16_MIN, INT16_MIN, INT16_MIN};

    memset(sensor->value, sensor->fill, sizeof sensor->value);
    simulated_icm42688_sample(sensor, nothing);
    sensor->value[0][DEVICE_CONFIG] = 0x00u;
    sensor->value[0][INT_STATUS] = RESET_DONE;
    sensor->value[0][POWER] = 0x00u;
    sensor->value[0][BANK] = 0x00u;
}

void simulated_icm42688_init(simulated_icm42688_t *sensor)
{
    memset(sensor, 0, sizeof *sensor);
    sensor->identity = 0x47u;
    sensor->fill = 0x5Au;
    sensor->stays = -1;
    sensor->waited_us = RESET_US;
    simulated_icm42688_brown_out(sensor);
}

void simulated_icm42688_sample(simulated_icm42688_t *sensor, const int16_t *number)
{
    for (uint32_t i = 0u; i < 7u; i++) {
        const unsigned bits = (unsigned)number[i] & 0xFFFFu;

        sensor->value[0][SAMPLE + (2u * i)] = (uint8_t)(bits >> 8u);
        sensor->value[0][SAMPLE + (2u * i) + 1u] = (uint8_t)(bits & 0xFFu);
    }
    sensor->value[0][INT_STATUS] |= DATA_READY;
}

static uint8_t simulated_icm42688_answer(simulated_icm42688_t *sensor, uint8_t address)
{
    const uint32_t bank = sensor->value[0][BANK];
    uint8_t value = 0u;

    if (sensor->waited_us < RESET_US) {
        return 0u; /* Still starting. */
    }
    if (address == BANK) {
        return (uint8_t)bank;
    }
    if (bank < SIMULATED_ICM42688_BANKS) {
        value = sensor->value[bank][address];
    }
    if ((bank == 0u) && (address == INT_STATUS)) {
        sensor->value[0][INT_STATUS] = 0u;
    }
    if (address == IDENTITY_AT) {
        return (bank == 0u) ? sensor->identity : 0u;
    }
    return value;
}

/* While the sensors are on only ranges, rates, power and the bank may be written, and nothing just
 * after they were switched on. */
static bool simulated_icm42688_may_take(const simulated_icm42688_t *sensor, uint32_t bank,
                                        uint8_t address)
{
    const bool is_on = sensor->value[0][POWER] != 0u;
    const bool is_range = (bank == 0u) && (address >= POWER) && (address < RANGES_END);

    return !is_on || ((is_range || (address == BANK)) && (sensor->on_us >= NO_WRITE_US));
}

static void simulated_icm42688_set(simulated_icm42688_t *sensor, uint32_t bank, uint8_t address,
                                   uint8_t value)
{
    if ((address == POWER) && (bank == 0u)) {
        sensor->on_us = 0u;
    }
    if (address == BANK) {
        sensor->value[0][BANK] = value;
    } else if (bank < SIMULATED_ICM42688_BANKS) {
        sensor->value[bank][address] = value;
    } else {
        /* There is nothing. */
    }
}

static void simulated_icm42688_take(simulated_icm42688_t *sensor, uint8_t address, uint8_t value)
{
    const uint32_t bank = sensor->value[0][BANK];

    if ((bank == 0u) && (address == DEVICE_CONFIG) && ((value & 1u) != 0u)) {
        if (!sensor->ignores_reset) {
            simulated_icm42688_brown_out(sensor);
            sensor->waited_us = 0u;
            sensor->was_reset = true;
        }
    } else if (((int)address == sensor->stays) && (bank == sensor->stays_bank)) {
        /* Not taken. */
    } else {
        sensor->misplaced += simulated_icm42688_may_take(sensor, bank, address) ? 0u : 1u;
        simulated_icm42688_set(sensor, bank, address, value);
    }
}

keel_bsp_status_t simulated_icm42688_exchange(void *context, const uint8_t *out, uint8_t *in,
                                              uint32_t length, uint32_t *done)
{
    simulated_icm42688_t *const sensor = context;
    const keel_bsp_status_t status = simulated_exchange(&sensor->faults, length, done);

    if ((status != KEEL_BSP_OK) || (*done == 0u)) {
        return status;
    }
    in[0] = 0u;
    for (uint32_t i = 1u; i < *done; i++) {
        const uint8_t address = (uint8_t)((out[0] + (i - 1u)) % SIMULATED_ICM42688_REGISTERS);

        if ((out[0] & 0x80u) == 0u) {
            simulated_icm42688_take(sensor, address, out[i]);
            in[i] = 0u;
        } else {
            in[i] = simulated_line(&sensor->faults, simulated_icm42688_answer(sensor, address));
        }
    }
    return KEEL_BSP_OK;
}

keel_bsp_status_t simulated_icm42688_delay(void *context, uint32_t time_us)
{
    simulated_icm42688_t *const sensor = context;

    sensor->waited_us += time_us;
    sensor->on_us += time_us;
    return sensor->delay_fails ? KEEL_BSP_TIMEOUT : KEEL_BSP_OK;
}
