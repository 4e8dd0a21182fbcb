/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/bmi055.h"

#include <string.h>

#define IDENTITY_AT 0x00u
#define SAMPLE      0x02u
#define SAMPLE_END  0x08u
#define BANDWIDTH   0x10u
#define POWER       0x11u
#define SOFTRESET   0x14u
#define RESET       0xB6u
#define SUSPENDED   0x80u

/* Not what the registers are after a reset: whatever they are, a driver must set what it needs. */
void simulated_bmi055_brown_out(simulated_bmi055_part_t *part)
{
    memset(part->value, part->fill, sizeof part->value);
    part->value[POWER] = SUSPENDED | part->fill;
}

static void simulated_bmi055_power_up(simulated_bmi055_part_t *part)
{
    part->fill = 0x5Au;
    part->stays = -1;
    part->waited_us = part->starts_us;
    simulated_bmi055_brown_out(part);
}

void simulated_bmi055_init(simulated_bmi055_t *sensor)
{
    memset(sensor, 0, sizeof *sensor);
    sensor->gyroscope.identity = 0x0Fu;
    sensor->gyroscope.fixed_bandwidth = 0x80u;
    sensor->gyroscope.starts_us = 30000u;
    sensor->accelerometer.identity = 0xFAu;
    sensor->accelerometer.tells_new = true;
    sensor->accelerometer.starts_us = 3000u;
    simulated_bmi055_power_up(&sensor->gyroscope);
    simulated_bmi055_power_up(&sensor->accelerometer);
}

static void simulated_bmi055_store(simulated_bmi055_part_t *part, uint32_t axis, unsigned bits)
{
    part->value[SAMPLE + (2u * axis)] = (uint8_t)(bits & 0xFFu);
    part->value[SAMPLE + (2u * axis) + 1u] = (uint8_t)((bits >> 8u) & 0xFFu);
}

void simulated_bmi055_sample(simulated_bmi055_t *sensor, const int16_t *rate,
                             const int16_t *acceleration)
{
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        const unsigned left = ((unsigned)acceleration[axis] & 0xFFFu) << 4u;

        simulated_bmi055_store(&sensor->gyroscope, axis, (unsigned)rate[axis] & 0xFFFFu);
        simulated_bmi055_store(&sensor->accelerometer, axis, left | 1u);
    }
}

static uint8_t simulated_bmi055_answer(simulated_bmi055_part_t *part, uint8_t address)
{
    const uint8_t value = part->value[address];

    if (part->waited_us < part->starts_us) {
        return 0u; /* Still starting. */
    }
    if (part->tells_new && (address >= SAMPLE) && (address < SAMPLE_END) &&
        ((address % 2u) == 0u)) {
        part->value[address] = (uint8_t)(value & 0xFEu);
    }
    if (address == BANDWIDTH) {
        return value | part->fixed_bandwidth;
    }
    return (address == IDENTITY_AT) ? part->identity : value;
}

/* While suspended it takes a reset and its end only. */
static void simulated_bmi055_take(simulated_bmi055_part_t *part, uint8_t address, uint8_t value)
{
    const bool is_awake = (part->value[POWER] & SUSPENDED) == 0u;

    if ((address == SOFTRESET) && (value == RESET)) {
        simulated_bmi055_brown_out(part);
        part->waited_us = 0u;
        part->was_reset = true;
    } else if (((int)address != part->stays) && (is_awake || (address == POWER))) {
        part->value[address] = value;
    } else {
        /* Not taken. */
    }
}

keel_bsp_status_t simulated_bmi055_exchange(void *context, const uint8_t *out, uint8_t *in,
                                            uint32_t length, uint32_t *done)
{
    simulated_bmi055_part_t *const part = context;
    const keel_bsp_status_t status = simulated_exchange(&part->faults, length, done);

    if ((status != KEEL_BSP_OK) || (*done == 0u)) {
        return status;
    }
    in[0] = 0u;
    for (uint32_t i = 1u; i < *done; i++) {
        const uint8_t address = (uint8_t)((out[0] + (i - 1u)) % SIMULATED_BMI055_REGISTERS);

        if ((out[0] & 0x80u) == 0u) {
            simulated_bmi055_take(part, address, out[i]);
            in[i] = 0u;
        } else {
            in[i] = simulated_line(&part->faults, simulated_bmi055_answer(part, address));
        }
    }
    return KEEL_BSP_OK;
}

keel_bsp_status_t simulated_bmi055_delay(void *context, uint32_t time_us)
{
    simulated_bmi055_t *const sensor = context;

    sensor->gyroscope.waited_us += time_us;
    sensor->accelerometer.waited_us += time_us;
    return sensor->delay_fails ? KEEL_BSP_TIMEOUT : KEEL_BSP_OK;
}
