/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file altitude.h
 * @brief Height and climb rate, from a barometer and the vertical acceleration.
 *
 * A pressure p says how high it is above where a pressure r was measured: by the barometric formula
 * of the International Standard Atmosphere (ISO 2533), below 11 km, as a series without powers and
 * logarithms,
 *
 *     x = (r - p) / (r + p)
 *     y = 2 H (x + x^3 / 3)          H ln(r / p), the height at an even temperature
 *     h = y (1 - y / (2 M))          M = 44330.77 m is where the temperature would come to 0 K
 *
 * with H = 8434.5 m. From sea level it is off by 0.1 m at 1000 m, 1 m at 2000 m (tested). In air
 * that is not the standard's, a height is off as its temperature is: by 3.5 % at 10 K.
 *
 * The first pressure is the reference: heights are above the place where it came. They are the
 * fixes of an axis (axis.h), upwards positive, which joins them with acceleration and says how old
 * and how good the result is. A spike of the pressure, near the ground or in a gust, is a jump.
 *
 * One division in a step, when there is a pressure; no library call.
 */
#ifndef KEEL_FLIGHT_ALTITUDE_H
#define KEEL_FLIGHT_ALTITUDE_H

#include "keel/c_declarations.h"
#include "keel/flight/axis.h"
#include "keel/status.h"

#include <stdbool.h>

KEEL_C_BEGIN

/** Pressures that count, in Pa: from 9 km above sea level to 1.4 km below. */
#define KEEL_ALTITUDE_PRESSURE_MIN 30000.0f
#define KEEL_ALTITUDE_PRESSURE_MAX 120000.0f

/** 2 H, in m: H = R T / g at 288.15 K, R being that of the standard's air (ISO 2533). */
#define KEEL_ALTITUDE_TWICE_SCALE 16869.0f

/** 1 / (2 M), 1.1278848e-5 per m: M is 288.15 K over 6.5 K per km (ISO 2533). */
#define KEEL_ALTITUDE_PER_LAPSE 0x1.7a749p-17f

/** 1 / 3. */
#define KEEL_ALTITUDE_THIRD 0.333333343267440795898437500f

/** The measurements. Numbers may be any bit pattern. */
typedef struct keel_altitude_sample {
    float pressure;        /**< Static pressure, in Pa. */
    float acceleration;    /**< Upwards, gravity taken off, in m/s^2. */
    bool has_pressure;     /**< Whether there is a new one. */
    bool has_acceleration; /**< Whether there is one. */
} keel_altitude_sample_t;

/** An altitude estimator. Only the functions below write it; all of it may be read. */
typedef struct keel_altitude {
    keel_axis_t axis;   /**< Above the reference: climb rate, age, quality and flags are here. */
    float reference;    /**< The first pressure, in Pa; 0 before. */
    float zero;         /**< The zero of the height, above the reference, in m. */
    float height;       /**< Above what is called 0, in m. */
    bool has_reference; /**< Whether a pressure came. */
} keel_altitude_t;

/**
 * Makes an altitude estimator (requirements ALT-001, ALT-002).
 *
 * @param altitude the estimator
 * @param config   of its axis: see keel_axis_init; its velocity gate and rate gain are not used
 * @return as keel_axis_init: what is refused changes nothing
 */
keel_status_t keel_altitude_init(keel_altitude_t *altitude, const keel_axis_config_t *config);

/**
 * Calls the present height 0 (requirement ALT-003): at take-off, for instance.
 *
 * @param altitude the estimator, initialised
 */
void keel_altitude_zero(keel_altitude_t *altitude);

/**
 * One step (requirements ALT-004 to ALT-007). Call it at the configured rate, whether something was
 * measured or not.
 *
 * @param altitude the estimator, initialised
 * @param sample   what was measured since the last step
 */
void keel_altitude_step(keel_altitude_t *altitude, const keel_altitude_sample_t *sample);

KEEL_C_END

#endif
