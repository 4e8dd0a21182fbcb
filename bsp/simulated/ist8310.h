/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ist8310.h
 * @brief A simulated IST8310, register by register, on an I2C bus.
 *
 * It knows no field, only what it measures, in its own axes (the third is up): whoever simulates
 * the Earth sets that. Its time is moved on by simulated_ist8310_pass.
 */
#ifndef KEEL_BSP_SIMULATED_IST8310_H
#define KEEL_BSP_SIMULATED_IST8310_H

#include "common/bus.h"
#include "simulated/faults.h"

#include <stdbool.h>
#include <stdint.h>

/** A sensor on a bus. */
typedef struct simulated_ist8310 {
    simulated_faults_t faults;
    uint8_t value[256];  /**< Its registers. */
    uint8_t identity;    /**< What it says that it is. */
    int stays;           /**< This register does not take what is written, or -1. */
    int16_t field[3];    /**< In 16 bits, 1320 a gauss; forward, right and up. */
    int16_t temperature; /**< What it says of it. */
    uint32_t slow_us;    /**< A measurement takes so much longer than it may. */
    uint32_t reset_us;   /**< What is left of a reset. */
    uint32_t measure_us; /**< What is left of a measurement. */
    bool measuring;
    uint32_t resets;
} simulated_ist8310_t;

/** Powers up a sensor. */
void simulated_ist8310_init(simulated_ist8310_t *sensor);

/** Lets time pass. */
void simulated_ist8310_pass(simulated_ist8310_t *sensor, uint32_t time_us);

/** Takes its supply away for a moment: all settings are what they are after a reset. */
void simulated_ist8310_brown_out(simulated_ist8310_t *sensor);

/** As keel_bus_t's exchange; context is the sensor. */
keel_bsp_status_t simulated_ist8310_exchange(void *context, const uint8_t *out, uint8_t *in,
                                             uint32_t length, uint32_t *done);

#endif
