/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file position.h
 * @brief Horizontal position and velocity, from a satellite receiver and acceleration.
 *
 * Latitude and longitude become metres north and east of an origin, on the plane that touches the
 * ellipsoid of WGS 84 there. Per degree, f being the origin's latitude and c its cosine,
 *
 *     north  111132.954 - 559.822 cos 2f           cos 2f = 2 c^2 - 1
 *     east   111412.84 cos f - 93.5 cos 3f         cos 3f = (4 c^2 - 3) c
 *
 * the series for the lengths of a degree on that ellipsoid, to 2e-5 of it (tested). c is a
 * polynomial of f; it is worked out once, when the origin is set. A step computes two differences
 * of integers and two products; longitudes are met across the 180th meridian.
 *
 * Each direction has an axis (axis.h) of its own, with the same configuration, which joins the
 * receiver's positions and velocities with acceleration. The quality is that of the worse one. A
 * fix can be used when the receiver calls it valid, its accuracy is not beyond what is configured,
 * there is an origin, and it lies near that; its velocity when that is accurate enough, too. The
 * axis reports a value that is beyond its limits or its gates.
 *
 * No division and no library call in a step.
 */
#ifndef KEEL_FLIGHT_POSITION_H
#define KEEL_FLIGHT_POSITION_H

#include "keel/c_declarations.h"
#include "keel/flight/axis.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Degrees are counted in 1e-7. */
#define KEEL_POSITION_HALF_TURN INT32_C(1800000000)
#define KEEL_POSITION_FULL_TURN INT64_C(3600000000)

/** An origin's greatest latitude, north or south: 80 degrees. */
#define KEEL_POSITION_LATITUDE_LIMIT INT32_C(800000000)

/** Differences in degrees up to here are exact as floats, and further than an axis goes. */
#define KEEL_POSITION_NEAR INT32_C(16777216)

/** The greatest accuracies that may be asked for, in m and m/s. */
#define KEEL_POSITION_ACCURACY_LIMIT       100.0f
#define KEEL_POSITION_SPEED_ACCURACY_LIMIT 10.0f

/** The configuration of a position estimator. */
typedef struct keel_position_config {
    keel_axis_config_t axis; /**< Of both directions. */
    float accuracy;          /**< Of a fix, at worst, 0 to ACCURACY_LIMIT, in m. */
    float speed_accuracy;    /**< Of its velocity, 0 to SPEED_ACCURACY_LIMIT, in m/s. */
} keel_position_config_t;

/** A receiver's fix. Numbers may be any bit pattern. */
typedef struct keel_position_fix {
    int32_t latitude;     /**< In 1e-7 degrees, north positive. */
    int32_t longitude;    /**< In 1e-7 degrees, east positive. */
    float north;          /**< Velocity, in m/s. */
    float east;           /**< Velocity, in m/s. */
    float accuracy;       /**< Of the position, one standard deviation, in m. */
    float speed_accuracy; /**< Of the velocity, in m/s. */
    bool is_valid;        /**< Whether the receiver calls it a good fix, in three dimensions. */
} keel_position_fix_t;

/** The measurements. Numbers may be any bit pattern. */
typedef struct keel_position_sample {
    keel_position_fix_t fix; /**< The receiver's. */
    float north;             /**< Acceleration, in m/s^2. */
    float east;              /**< Acceleration, in m/s^2. */
    bool has_fix;            /**< Whether a fix came since the last step. */
    bool has_acceleration;   /**< Whether there is one. */
} keel_position_sample_t;

/** A position estimator. Only the functions below write it; all of it may be read. */
typedef struct keel_position {
    keel_position_config_t config; /**< As checked by init. */
    keel_axis_t north;             /**< Position, velocity, age and flags. */
    keel_axis_t east;              /**< Position, velocity, age and flags. */
    int32_t latitude;              /**< The origin's, in 1e-7 degrees. */
    int32_t longitude;             /**< The origin's, in 1e-7 degrees. */
    float north_scale;             /**< Metres per 1e-7 degrees of latitude. */
    float east_scale;              /**< Metres per 1e-7 degrees of longitude. */
    bool has_origin;               /**< Whether there is one. */
    keel_axis_quality_t quality;   /**< The worse of both directions'. */
} keel_position_t;

/**
 * Makes a position estimator without an origin (requirements POS-001, POS-002).
 *
 * @param position the estimator
 * @param config   what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_LIMITS for an accuracy, else what keel_axis_init says, the first that
 *         applies, NaN included: then nothing is changed
 */
keel_status_t keel_position_init(keel_position_t *position, const keel_position_config_t *config);

/**
 * Measures from here on from an origin; what was known before is forgotten (requirements POS-003,
 * POS-004).
 *
 * @param position  the estimator, initialised
 * @param latitude  in 1e-7 degrees
 * @param longitude in 1e-7 degrees
 * @return KEEL_OK; KEEL_ERR_VALUE when the latitude is beyond 80 degrees or the longitude beyond
 *         180: then nothing is changed
 */
keel_status_t keel_position_set_origin(keel_position_t *position, int32_t latitude,
                                       int32_t longitude);

/**
 * One step (requirements POS-005 to POS-009). Call it at the configured rate, whether something was
 * measured or not.
 *
 * @param position the estimator, initialised
 * @param sample   what was measured since the last step
 */
void keel_position_step(keel_position_t *position, const keel_position_sample_t *sample);

KEEL_C_END

#endif
