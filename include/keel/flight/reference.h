/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file reference.h
 * @brief Reference generator: from the pilot's sticks to set-points (section III-D.2, fig. 8).
 *
 * Each stick is a number from -1 to 1, 0 at its centre, positive in the sense of what it asks for:
 *
 *     roll   right side down, to the right      pitch  nose up, backwards: the stick is pulled
 *     yaw    nose to the right                  climb  up (the throttle stick about its middle)
 *
 * A stick x is first made a deflection s, by a curve of its own with dead band d and expo e:
 *
 *     u = min(max(|x| - d, 0) / (1 - d), 1)     0 within the dead band, from there without a step
 *     s = sign(x) u ((1 - e) + e u^2)           the field's cubic expo; 1 at the end of the stick
 *
 * and then set-points, of which the flight mode takes those that it needs:
 *
 *     body rates             limit s                         of roll, pitch and yaw
 *     roll and pitch angle   tilt limit q                    with the deflections s, t of both
 *     velocity               speed limit q                   sticks q = s (1 - k t^2)
 *     heading's rate         limit s                         with angles and velocities
 *     climb rate             climb limit s or descent limit s
 *
 * A stick in a corner asks for both angles at once. k = 1 - 1/sqrt(2) rounds the corners off: the
 * square of the sticks becomes nearly a disc (to 1.1 %), whose radius is the limit. So the angle
 * between the aircraft's vertical axis and the true one, and the horizontal speed, are limited in
 * total, without a square root or a trigonometric function (requirement REF-010).
 * Single precision. Sources must be compiled without contraction of products and sums.
 */
#ifndef KEEL_FLIGHT_REFERENCE_H
#define KEEL_FLIGHT_REFERENCE_H

#include "keel/c_declarations.h"
#include "keel/status.h"

KEEL_C_BEGIN

/** Dead bands, as a part of the stick's way from its centre. The least, 2^-12, is below half a step
 * of a receiver with 11 bits; with it no set-point is too small to be exact. */
#define KEEL_REFERENCE_DEAD_BAND_MIN 0.000244140625f
#define KEEL_REFERENCE_DEAD_BAND_MAX 0.5f

#define KEEL_REFERENCE_EXPO_MAX 1.0f /**< Only the cubic. More would not be monotone. */

#define KEEL_REFERENCE_LIMIT_MIN 0.0009765625f /**< Of each limit, in its own unit: 2^-10. */

/** The greatest limits: of a rate, in rad/s (3667 degrees per second); of the tilt, in rad (just
 * below a right angle); of a climb rate or speed, in m/s. */
#define KEEL_REFERENCE_RATE_MAX  64.0f
#define KEEL_REFERENCE_TILT_MAX  1.5f
#define KEEL_REFERENCE_SPEED_MAX 100.0f

#define KEEL_REFERENCE_CORNER 0.292893230915069580078125f /**< k, rounded up. */

/** Compensates for the rounding of 1 / (1 - d): 1 + 2^-22. So the end of the stick is reached,
 * some 2^-22 before it is. */
#define KEEL_REFERENCE_REACH 1.0000002384185791015625f

/** How a stick feels. */
typedef struct keel_reference_shape {
    float dead_band; /**< From KEEL_REFERENCE_DEAD_BAND_MIN to KEEL_REFERENCE_DEAD_BAND_MAX. */
    float expo;      /**< From 0, straight, to KEEL_REFERENCE_EXPO_MAX. */
} keel_reference_shape_t;

/** Set-points of full sticks, each from KEEL_REFERENCE_LIMIT_MIN to the greatest of its kind. */
typedef struct keel_reference_limits {
    float roll_rate;    /**< Body rate, in rad/s. */
    float pitch_rate;   /**< Body rate, in rad/s. */
    float yaw_rate;     /**< Body rate, in rad/s. */
    float heading_rate; /**< Yaw rate beside angles and velocities, in rad/s. */
    float tilt;         /**< Angle from the vertical, of roll and pitch together, in rad. */
    float speed;        /**< Horizontal, in total, in m/s. */
    float climb_rate;   /**< Upwards, in m/s. */
    float descent_rate; /**< Downwards, a positive number, in m/s. */
} keel_reference_limits_t;

/** The configuration of a reference generator. */
typedef struct keel_reference_config {
    keel_reference_shape_t roll;    /**< The roll stick. */
    keel_reference_shape_t pitch;   /**< The pitch stick. */
    keel_reference_shape_t yaw;     /**< The yaw stick. */
    keel_reference_shape_t climb;   /**< The climb stick. */
    keel_reference_limits_t limits; /**< The set-points of full sticks. */
} keel_reference_config_t;

/** The sticks, each from -1 to 1. */
typedef struct keel_reference_sticks {
    float roll;  /**< Positive: right side down, to the right. */
    float pitch; /**< Positive: nose up, backwards. */
    float yaw;   /**< Positive: nose to the right. */
    float climb; /**< Positive: up. */
} keel_reference_sticks_t;

/** The set-points that the sticks ask for. Body axes: x forwards, y to the right, z down. */
typedef struct keel_reference_setpoints {
    float roll_rate;    /**< About x, in rad/s. */
    float pitch_rate;   /**< About y, in rad/s. */
    float yaw_rate;     /**< About z, in rad/s. */
    float heading_rate; /**< Yaw rate beside angles and velocities, in rad/s. */
    float roll;         /**< Positive: right side down, in rad. */
    float pitch;        /**< Positive: nose up, in rad. */
    float forward;      /**< Velocity in the direction of the heading, in m/s. */
    float right;        /**< Velocity to the right of the heading, in m/s. */
    float climb_rate;   /**< Positive: up, in m/s. */
} keel_reference_setpoints_t;

/** A stick's curve, as worked out by init. */
typedef struct keel_reference_curve {
    float dead_band; /**< d. */
    float scale;     /**< KEEL_REFERENCE_REACH / (1 - d). */
    float linear;    /**< 1 - e. */
    float expo;      /**< e. */
} keel_reference_curve_t;

/** A reference generator. */
typedef struct keel_reference {
    keel_reference_curve_t roll;          /**< Of the roll stick. */
    keel_reference_curve_t pitch;         /**< Of the pitch stick. */
    keel_reference_curve_t yaw;           /**< Of the yaw stick. */
    keel_reference_curve_t climb;         /**< Of the climb stick. */
    keel_reference_limits_t limits;       /**< As checked by init. */
    keel_reference_setpoints_t setpoints; /**< Those of the last sticks; all 0 before. */
} keel_reference_t;

/**
 * Makes a reference generator, whose set-points are all 0 (requirements REF-001 to REF-003).
 *
 * @param reference the reference generator
 * @param config    what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_GAIN when an expo, else KEEL_ERR_LIMITS when a dead band or a limit, is
 *         not as keel_reference_config_t says, NaN included: then nothing is changed
 */
keel_status_t keel_reference_init(keel_reference_t *reference,
                                  const keel_reference_config_t *config);

/**
 * Makes set-points of the sticks; the result is reference->setpoints (requirements REF-004 to
 * REF-010).
 *
 * @param reference the reference generator
 * @param sticks    where the sticks are, any bit patterns
 * @return KEEL_OK; KEEL_ERR_INPUT when one is not from -1 to 1, NaN included: then nothing is
 *         changed, the set-points are held
 */
keel_status_t keel_reference_step(keel_reference_t *reference,
                                  const keel_reference_sticks_t *sticks);

KEEL_C_END

#endif
