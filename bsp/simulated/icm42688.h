/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file icm42688.h
 * @brief A simulated ICM-42688-P, register by register, in the banks that a driver needs.
 *
 * It knows no motion: whoever simulates that sets samples, each of which is ready until its status
 * is read. Its time is that of the delays which its driver asks for.
 */
#ifndef KEEL_BSP_SIMULATED_ICM42688_H
#define KEEL_BSP_SIMULATED_ICM42688_H

#include "common/bus.h"
#include "simulated/faults.h"

#include <stdbool.h>
#include <stdint.h>

/** Its banks; what is in others reads 0. */
#define SIMULATED_ICM42688_BANKS 3u

/** The registers of a bank. */
#define SIMULATED_ICM42688_REGISTERS 128u

/** A sensor on a bus. */
typedef struct simulated_icm42688 {
    simulated_faults_t faults;
    uint8_t value[SIMULATED_ICM42688_BANKS][SIMULATED_ICM42688_REGISTERS];
    uint8_t identity;
    uint8_t fill;        /**< What registers are after a reset. */
    uint32_t stays_bank; /**< A register that does not take what is written: its bank … */
    int stays;           /**< … and its address, or -1. */
    bool ignores_reset;
    bool delay_fails;
    bool was_reset;
    uint32_t waited_us; /**< In delays since the last reset. */
    uint32_t on_us;     /**< In delays since the sensors were switched on. */
    uint32_t misplaced; /**< What was written when it may not be: so many times. */
} simulated_icm42688_t;

/** Powers up a sensor. */
void simulated_icm42688_init(simulated_icm42688_t *sensor);

/** Takes its supply away for a moment. */
void simulated_icm42688_brown_out(simulated_icm42688_t *sensor);

/** Measures: temperature, acceleration and rate, seven numbers in the order of the registers. */
void simulated_icm42688_sample(simulated_icm42688_t *sensor, const int16_t *number);

/** As keel_bus_t's exchange; context is the sensor. */
keel_bsp_status_t simulated_icm42688_exchange(void *context, const uint8_t *out, uint8_t *in,
                                              uint32_t length, uint32_t *done);

/** As keel_delay_fn_t; context is the sensor. */
keel_bsp_status_t simulated_icm42688_delay(void *context, uint32_t time_us);

#endif
