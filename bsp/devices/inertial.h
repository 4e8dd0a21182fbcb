/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file inertial.h
 * @brief What drivers of inertial sensors have in common: the sample, in the same units of each.
 */
#ifndef KEEL_BSP_DEVICES_INERTIAL_H
#define KEEL_BSP_DEVICES_INERTIAL_H

#include <stdint.h>

/** One sample, in the sensor's axes. Full scale is 16 g and 2000 degrees per second. */
typedef struct keel_inertial_sample {
    int16_t acceleration[3];  /**< 1 / 2048 g. */
    int16_t temperature_cdeg; /**< Hundredths of a degree Celsius. */
    int16_t rate[3];          /**< 1 / 16.4 degree per second. */
} keel_inertial_sample_t;

/**
 * A number of two bytes as two's complement.
 *
 * @param high its most significant byte
 * @param low  the other
 * @return the number
 */
static inline int16_t keel_inertial_number(uint8_t high, uint8_t low)
{
    const int32_t value = ((int32_t)high * 256) + (int32_t)low;

    return (int16_t)((value > INT16_MAX) ? (value - 65536) : value);
}

#endif
