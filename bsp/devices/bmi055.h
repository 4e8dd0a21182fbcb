/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bmi055.h
 * @brief The inertial sensor BMI055 (Bosch Sensortec, BST-BMI055-DS000): a gyroscope and an
 *        accelerometer in one package, each with a select pin of its own on an SPI bus.
 *
 * Full scale is 2000 degrees per second and 16 g, samples come at 1 kHz, low-pass at 116 Hz
 * (gyroscope) and 500 Hz (accelerometer). The accelerometer has 12 bits, so acceleration goes in
 * steps of 16 / 2048 g, from -32768 to 32752.
 *
 * Unlike the ICM sensors it has no status that tells a sample that was read from one that was not:
 * its data-ready bit goes out by itself when the next measurement begins. So it is read at a fixed
 * rate, and a sample may come twice.
 *
 * @code
 * keel_bmi055_t sensor = {.gyroscope = {.bus = gyroscope_bus, .delay = wait_us},
 *                         .accelerometer = {.bus = accelerometer_bus, .delay = wait_us}};
 * keel_inertial_sample_t sample;
 *
 * if ((keel_bmi055_start(&sensor) == KEEL_BSP_OK) &&
 *     (keel_bmi055_read(&sensor, &sample) == KEEL_BSP_OK)) {
 *     use(sample.rate[0]);
 * }
 * @endcode
 */
#ifndef KEEL_BSP_DEVICES_BMI055_H
#define KEEL_BSP_DEVICES_BMI055_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "devices/inertial.h"
#include "devices/registers.h"

/** The fastest that the bus may be, in Hz (table of the SPI's timing). */
#define KEEL_BMI055_BUS_LIMIT_HZ 10000000u

/** The time that both get after a reset, in us: the gyroscope's start-up, the longer of the two. */
#define KEEL_BMI055_RESET_US 30000u

/** How often the same rates, or the same accelerations, may be read again: noise moves each. */
#define KEEL_BMI055_REPEATS 100u

/** A sensor. The caller owns it. */
typedef struct keel_bmi055 {
    keel_registers_t gyroscope;     /**< Its registers, on a bus with the gyroscope selected. */
    keel_registers_t accelerometer; /**< The same of the accelerometer. */
    keel_repeats_t rates;           /**< Of the gyroscope's samples; 0 at the start. */
    keel_repeats_t accelerations;   /**< Of the accelerometer's; 0 at the start. */
} keel_bmi055_t;

/**
 * Resets both, makes sure that each is the one, and configures them; what is written is read back
 * (requirements BMI-001 to BMI-004).
 *
 * @param sensor the sensor, with its buses
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when an identity reads all zeros or all ones; KEEL_BSP_ID;
 *         KEEL_BSP_VERIFY; KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT of a bus, of the
 *         gyroscope first
 */
keel_bsp_status_t keel_bmi055_start(const keel_bmi055_t *sensor);

/**
 * Whether it is still the sensor that was started: identities and settings are read back
 * (requirement BMI-007). After a brown-out it would go on in other units.
 *
 * @param sensor the sensor
 * @return as keel_bmi055_start
 */
keel_bsp_status_t keel_bmi055_check(const keel_bmi055_t *sensor);

/**
 * Reads a sample: rates in one burst, acceleration and temperature in another, each with the
 * identity of what answers (requirements BMI-005, BMI-006 and BMI-008).
 *
 * @param sensor the sensor
 * @param sample the sample
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when all bits of a burst are the same, or the same rates or
 *         accelerations have been read again more than KEEL_BMI055_REPEATS times; KEEL_BSP_ID when
 *         another device answers; KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT; with sample as
 *         it was unless KEEL_BSP_OK
 */
keel_bsp_status_t keel_bmi055_read(keel_bmi055_t *sensor, keel_inertial_sample_t *sample);

#endif
