/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/ms5611.h"

#include <string.h>

#define RESET_US 2800u

/* The longest that each oversampling may take, from 256 times on. */
static const uint32_t longest_us[5] = {600u, 1170u, 2280u, 4540u, 9040u};

void simulated_ms5611_init(simulated_ms5611_t *sensor, const uint16_t *prom)
{
    memset(sensor, 0, sizeof *sensor);
    memcpy(sensor->prom, prom, sizeof sensor->prom);
}

static void end_conversion(simulated_ms5611_t *sensor)
{
    const bool of_pressure = (sensor->converting & 0xF0u) == 0x40u;

    if ((sensor->converting != 0u) && !sensor->lost) {
        sensor->result = of_pressure ? sensor->pressure : sensor->temperature;
    }
    sensor->converting = 0u;
}

void simulated_ms5611_pass(simulated_ms5611_t *sensor, uint32_t time_us)
{
    if (time_us < sensor->busy_us) {
        sensor->busy_us -= time_us;
    } else {
        sensor->busy_us = 0u;
        end_conversion(sensor);
    }
}

/* What it does at a command; before its first reset it does not convert. */
static void simulated_ms5611_obey(simulated_ms5611_t *sensor, uint8_t command)
{
    const uint8_t kind = command & 0xF0u;
    const uint8_t oversampling = (uint8_t)((command & 0x0Fu) / 2u);

    if (command == 0x1Eu) {
        sensor->converting = 0u;
        sensor->result = 0u;
        sensor->busy_us = RESET_US;
        sensor->resets++;
    } else if (((kind == 0x40u) || (kind == 0x50u)) && (oversampling < 5u) &&
               (sensor->busy_us == 0u) && (sensor->resets > 0u)) {
        sensor->converting = command;
        sensor->lost = false;
        sensor->result = 0u;
        sensor->busy_us = longest_us[oversampling] + sensor->slow_us;
    } else {
        /* Nothing happens. */
    }
}

/* Bytes of the answer, the most significant first. */
static uint8_t simulated_ms5611_answer(simulated_ms5611_t *sensor, uint8_t command, uint32_t index)
{
    uint8_t byte = 0xFFu; /* Nobody drives the line. */

    if ((sensor->busy_us > 0u) && (sensor->converting == 0u)) {
        byte = 0u; /* It loads its PROM. */
    } else if ((command >= 0xA0u) && (command <= 0xAEu) && (index < 2u)) {
        byte = (uint8_t)(sensor->prom[(command - 0xA0u) / 2u] >> (8u - (8u * index)));
    } else if ((command == 0x00u) && (index < 3u)) {
        byte = (uint8_t)(sensor->result >> (16u - (8u * index)));
    } else {
        /* No such answer. */
    }
    return byte;
}

keel_bsp_status_t simulated_ms5611_exchange(void *context, const uint8_t *out, uint8_t *in,
                                            uint32_t length, uint32_t *done)
{
    simulated_ms5611_t *const sensor = context;
    const keel_bsp_status_t status = simulated_exchange(&sensor->faults, length, done);

    if ((status != KEEL_BSP_OK) || (*done == 0u)) {
        return status;
    }
    in[0] = simulated_line(&sensor->faults, 0xFEu); /* Whatever it says meanwhile. */
    for (uint32_t i = 1u; i < *done; i++) {
        in[i] = simulated_line(&sensor->faults, simulated_ms5611_answer(sensor, out[0], i - 1u));
    }
    if (out[0] == 0x00u) { /* Read once; and before its end, a conversion comes to nothing. */
        sensor->lost = sensor->converting != 0u;
        sensor->result = 0u;
    }
    simulated_ms5611_obey(sensor, out[0]);
    return KEEL_BSP_OK;
}
