/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ms5611.h
 * @brief A simulated MS5611, command by command, as its data sheet describes it.
 *
 * It knows no pressure, only raw readings: whoever simulates the air sets them. Its time is moved
 * on by simulated_ms5611_pass.
 */
#ifndef KEEL_BSP_SIMULATED_MS5611_H
#define KEEL_BSP_SIMULATED_MS5611_H

#include "common/bus.h"
#include "simulated/faults.h"

#include <stdbool.h>
#include <stdint.h>

/** A sensor on a bus. */
typedef struct simulated_ms5611 {
    simulated_faults_t faults;
    uint16_t prom[8];
    uint32_t pressure;    /**< D1, at the end of a conversion. */
    uint32_t temperature; /**< D2. */
    uint32_t slow_us;     /**< A conversion takes so much longer than it may. */
    bool lost;            /**< The conversion that runs was asked for too early. */
    uint8_t converting;   /**< The command of the conversion, or 0. */
    uint32_t busy_us;     /**< Time until it, or the reset, has ended. */
    uint32_t result;      /**< What the next reading of the converter says. */
    uint32_t resets;
} simulated_ms5611_t;

/**
 * Powers up a sensor: with this PROM, but not reset yet.
 *
 * @param sensor the sensor
 * @param prom   its words, the check in the last
 */
void simulated_ms5611_init(simulated_ms5611_t *sensor, const uint16_t *prom);

/** Lets time pass. */
void simulated_ms5611_pass(simulated_ms5611_t *sensor, uint32_t time_us);

/** As keel_bus_t's exchange; context is the sensor. */
keel_bsp_status_t simulated_ms5611_exchange(void *context, const uint8_t *out, uint8_t *in,
                                            uint32_t length, uint32_t *done);

#endif
