/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/ist8310.h"

#include <stddef.h>
#include <string.h>

#define STATUS    0x02u
#define FIELD     0x03u
#define CONTROL_1 0x0Au
#define CONTROL_2 0x0Bu
#define CONTROL_3 0x0Du
#define HEAT      0x1Cu

#define RESET_US   50000u
#define MEASURE_US 6000u
#define COARSE     4 /* Without 16 bits an axis counts 330 a gauss. */

static void simulated_ist8310_defaults(simulated_ist8310_t *sensor)
{
    memset(sensor->value, 0, sizeof sensor->value);
    sensor->value[0x00] = sensor->identity;
    sensor->measuring = false;
}

void simulated_ist8310_init(simulated_ist8310_t *sensor)
{
    memset(sensor, 0, sizeof *sensor);
    sensor->identity = 0x10u;
    sensor->stays = -1;
    simulated_ist8310_defaults(sensor);
}

void simulated_ist8310_brown_out(simulated_ist8310_t *sensor)
{
    simulated_ist8310_defaults(sensor);
}

static void simulated_ist8310_write_number(simulated_ist8310_t *sensor, uint32_t at, int value)
{
    const unsigned bits = (unsigned)value & 0xFFFFu;

    sensor->value[at] = (uint8_t)(bits & 0xFFu);
    sensor->value[at + 1u] = (uint8_t)(bits >> 8u);
}

/* A sample that was not read is overrun. */
static void simulated_ist8310_measure(simulated_ist8310_t *sensor)
{
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        const bool fine = (sensor->value[CONTROL_3] & (0x10u << axis)) != 0u;

        simulated_ist8310_write_number(sensor, FIELD + (2u * axis),
                                       fine ? sensor->field[axis] : sensor->field[axis] / COARSE);
    }
    simulated_ist8310_write_number(sensor, HEAT, sensor->temperature);
    sensor->value[STATUS] = ((sensor->value[STATUS] & 1u) != 0u) ? 3u : 1u;
    sensor->value[CONTROL_1] = 0u;
    sensor->measuring = false;
}

void simulated_ist8310_pass(simulated_ist8310_t *sensor, uint32_t time_us)
{
    if ((sensor->reset_us > 0u) && (time_us >= sensor->reset_us)) {
        simulated_ist8310_defaults(sensor);
    }
    sensor->reset_us -= (time_us < sensor->reset_us) ? time_us : sensor->reset_us;
    if (sensor->measuring) {
        sensor->measure_us -= (time_us < sensor->measure_us) ? time_us : sensor->measure_us;
        if (sensor->measure_us == 0u) {
            simulated_ist8310_measure(sensor);
        }
    }
}

static void simulated_ist8310_write(simulated_ist8310_t *sensor, uint8_t address, uint8_t value)
{
    if ((sensor->reset_us > 0u) || ((int)address == sensor->stays)) {
        return;
    }
    sensor->value[address] = value;
    if ((address == CONTROL_2) && ((value & 1u) != 0u)) {
        sensor->reset_us = RESET_US;
        sensor->resets++;
    }
    if ((address == CONTROL_1) && ((value & 0x0Fu) == 1u)) {
        sensor->measuring = true;
        sensor->measure_us = MEASURE_US + sensor->slow_us;
    }
}

/* Reading a byte of the field takes the sample away. */
static uint8_t simulated_ist8310_read(simulated_ist8310_t *sensor, uint8_t address)
{
    if ((address >= FIELD) && (address < (FIELD + 6u))) {
        sensor->value[STATUS] = 0u;
    }
    return sensor->value[address];
}

keel_bsp_status_t simulated_ist8310_exchange(void *context, const uint8_t *out, uint8_t *in,
                                             uint32_t length, uint32_t *done)
{
    simulated_ist8310_t *const sensor = context;
    const keel_bsp_status_t status = simulated_exchange(&sensor->faults, length, done);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    for (uint32_t i = 1u; i < *done; i++) {
        const uint8_t address = (uint8_t)(out[0] + (i - 1u));

        if (in == NULL) {
            simulated_ist8310_write(sensor, address, out[i]);
        } else {
            in[i] = simulated_line(&sensor->faults, simulated_ist8310_read(sensor, address));
        }
    }
    return KEEL_BSP_OK;
}
