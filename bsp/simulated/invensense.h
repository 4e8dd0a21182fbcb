/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file invensense.h
 * @brief A simulated inertial sensor of InvenSense, register by register: an ICM-20689, an
 *        ICM-20602 or an MPU-6000.
 *
 * It knows no motion: whoever simulates that sets samples, each of which is ready until its status
 * is read. Its time is that of the delays which its driver asks for.
 */
#ifndef KEEL_BSP_SIMULATED_INVENSENSE_H
#define KEEL_BSP_SIMULATED_INVENSENSE_H

#include "common/bus.h"
#include "simulated/faults.h"

#include <stdbool.h>
#include <stdint.h>

/** Its registers. */
#define SIMULATED_INVENSENSE_REGISTERS 128u

/** A sensor on a bus. */
typedef struct simulated_invensense {
    simulated_faults_t faults;
    uint8_t value[SIMULATED_INVENSENSE_REGISTERS];
    uint8_t identity;
    int stays;          /**< This register does not take what is written, or -1. */
    uint32_t waited_us; /**< In delays since the last reset. */
    bool delay_fails;
    bool was_reset;
    uint8_t paths_reset; /**< The signal paths that were. */
} simulated_invensense_t;

/**
 * Powers up a sensor.
 *
 * @param sensor   the sensor
 * @param identity what it says that it is: 0x98 (ICM-20689), 0x12 (ICM-20602) or 0x68 (MPU-6000)
 */
void simulated_invensense_init(simulated_invensense_t *sensor, uint8_t identity);

/** Takes its supply away for a moment. */
void simulated_invensense_brown_out(simulated_invensense_t *sensor);

/** Measures: acceleration, temperature and rate, seven numbers in the order of the registers. */
void simulated_invensense_sample(simulated_invensense_t *sensor, const int16_t *number);

/** As keel_bus_t's exchange; context is the sensor. */
keel_bsp_status_t simulated_invensense_exchange(void *context, const uint8_t *out, uint8_t *in,
                                                uint32_t length, uint32_t *done);

/** The same on a bus as fast as only samples and their status may be read: all else is garbled. */
keel_bsp_status_t simulated_invensense_fast_exchange(void *context, const uint8_t *out, uint8_t *in,
                                                     uint32_t length, uint32_t *done);

/** As keel_delay_fn_t; context is the sensor. */
keel_bsp_status_t simulated_invensense_delay(void *context, uint32_t time_us);

#endif
