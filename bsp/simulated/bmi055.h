/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bmi055.h
 * @brief A simulated BMI055, register by register: a gyroscope and an accelerometer, which answer
 *        for themselves.
 *
 * It knows no motion: whoever simulates that sets samples. Its time is that of the delays which its
 * driver asks for.
 */
#ifndef KEEL_BSP_SIMULATED_BMI055_H
#define KEEL_BSP_SIMULATED_BMI055_H

#include "common/bus.h"
#include "simulated/faults.h"

#include <stdbool.h>
#include <stdint.h>

/** The registers of a part. */
#define SIMULATED_BMI055_REGISTERS 128u

/** One of the two, on a bus. */
typedef struct simulated_bmi055_part {
    simulated_faults_t faults;
    uint8_t value[SIMULATED_BMI055_REGISTERS];
    uint8_t identity;
    uint8_t fill;            /**< What registers are after a reset. */
    uint8_t fixed_bandwidth; /**< The bits of the bandwidth's register that always read 1. */
    bool tells_new;          /**< Bit 0 of an axis's lower byte tells whether it was read. */
    int stays;               /**< This register does not take what is written, or -1. */
    uint32_t starts_us;      /**< What it needs after a reset. */
    uint32_t waited_us;      /**< In delays since the last reset. */
    bool was_reset;
} simulated_bmi055_part_t;

/** Both in their package. */
typedef struct simulated_bmi055 {
    simulated_bmi055_part_t gyroscope;
    simulated_bmi055_part_t accelerometer;
    bool delay_fails;
} simulated_bmi055_t;

/** Powers up a sensor. */
void simulated_bmi055_init(simulated_bmi055_t *sensor);

/** Takes the supply of one part away for a moment. */
void simulated_bmi055_brown_out(simulated_bmi055_part_t *part);

/** Measures: three rates, and three accelerations of 12 bits. */
void simulated_bmi055_sample(simulated_bmi055_t *sensor, const int16_t *rate,
                             const int16_t *acceleration);

/** As keel_bus_t's exchange; context is the part. */
keel_bsp_status_t simulated_bmi055_exchange(void *context, const uint8_t *out, uint8_t *in,
                                            uint32_t length, uint32_t *done);

/** As keel_delay_fn_t; context is the sensor. */
keel_bsp_status_t simulated_bmi055_delay(void *context, uint32_t time_us);

#endif
