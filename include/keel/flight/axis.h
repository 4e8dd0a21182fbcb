/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file axis.h
 * @brief Position and velocity along one axis, from acceleration and from fixes of the position.
 *
 * A third-order fixed-gain observer, as barometer and satellites are joined with inertial samples
 * in the field: acceleration is integrated at every step, and whenever a fix z of the position
 * comes, with a velocity w or without, a part of how far it is off is made up for. T = 1 / rate_hz:
 *
 *     a  = acceleration - bias            0 when there is none
 *     v' = v + T a,  p' = p + T/2 (v + v')
 *     p <- p' + position_gain (z - p')    with a fix; otherwise p'
 *     v <- v' + velocity_gain (z - p') + rate_gain (w - v')
 *     bias <- bias - bias_gain (z - p')
 *
 * Position, velocity and bias are clamped: they are numbers within their limits whatever was given
 * (requirement AXI-006).
 *
 * A fix counts when its source calls it usable and its numbers are in range. One that is further
 * off than the gates is a jump, and is not taken. Jumps are believed that agree with one another:
 * after jump_fixes of them in a row, each within position_gate of the one before, position and
 * velocity are set to the last. So they are by the first fix, and by the first after lost_steps
 * without one. Jumps here and there are never believed, however many come.
 *
 * Each step says how good the result is:
 *
 * - KEEL_AXIS_NONE: no fix, or none for lost_steps; position and velocity are not to be used.
 * - KEEL_AXIS_POOR: neither this nor the next.
 * - KEEL_AXIS_GOOD: the last settle_fixes fixes agreed, the last one came less than late_steps ago,
 *   and the step had an acceleration.
 *
 * So a fix that jumps, that is not usable or that does not come lowers the quality in the very step
 * in which it is seen, and settle_fixes good ones in a row raise it again.
 */
#ifndef KEEL_FLIGHT_AXIS_H
#define KEEL_FLIGHT_AXIS_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

#define KEEL_AXIS_RATE_MIN_HZ 10.0f /**< Steps per second, at least and at most. */
#define KEEL_AXIS_RATE_MAX_HZ 1000.0f

/** The greatest gains: of what is off, in itself; in 1/s; in 1/s^2. */
#define KEEL_AXIS_PART_LIMIT          1.0f
#define KEEL_AXIS_VELOCITY_GAIN_LIMIT 16.0f
#define KEEL_AXIS_BIAS_GAIN_LIMIT     16.0f

/** The greatest values that are taken and kept: m, m/s, m/s^2. */
#define KEEL_AXIS_POSITION_LIMIT     16384.0f
#define KEEL_AXIS_VELOCITY_LIMIT     256.0f
#define KEEL_AXIS_ACCELERATION_LIMIT 320.0f

/** The greatest limit of the acceleration's bias, in m/s^2. */
#define KEEL_AXIS_BIAS_LIMIT 8.0f

/* Events of the last step: keel_axis_t, flags. */
#define KEEL_AXIS_FIXED    0x01u /**< A fix was taken. */
#define KEEL_AXIS_BEGUN    0x02u /**< Position and velocity were set to it. */
#define KEEL_AXIS_JUMPED   0x04u /**< A fix was further off than the gates, and not taken. */
#define KEEL_AXIS_UNUSABLE 0x08u /**< A fix came that does not count. */
#define KEEL_AXIS_BLIND    0x10u /**< No acceleration came, or none that can be: 0 was taken. */
#define KEEL_AXIS_AGAIN    0x20u /**< A fix beyond the gates is near the jump before it. */

/* How good position and velocity are, from worst to best: keel_axis_quality_t. */
#define KEEL_AXIS_NONE 0u /**< Not known. */
#define KEEL_AXIS_POOR 1u /**< Known, but see above. */
#define KEEL_AXIS_GOOD 2u /**< Fixes come, and agree. */

/** The configuration of an axis. */
typedef struct keel_axis_config {
    float rate_hz;         /**< Steps per second, RATE_MIN_HZ to RATE_MAX_HZ. */
    float position_gain;   /**< Part of its error that a fix corrects, 0 to PART_LIMIT. */
    float velocity_gain;   /**< In the velocity, 0 to VELOCITY_GAIN_LIMIT, in 1/s. */
    float rate_gain;       /**< In the velocity, by the fix's velocity, 0 to PART_LIMIT. */
    float bias_gain;       /**< In the bias, 0 to BIAS_GAIN_LIMIT, in 1/s^2. */
    float bias_limit;      /**< |bias|, 0 to BIAS_LIMIT, in m/s^2. */
    float position_gate;   /**< Beyond it a fix is a jump, 0 to POSITION_LIMIT, in m. */
    float velocity_gate;   /**< The same of a fix's velocity, 0 to VELOCITY_LIMIT, in m/s. */
    uint16_t late_steps;   /**< Steps without a fix that lower the quality; 1 to lost_steps. */
    uint16_t lost_steps;   /**< Steps without a fix after which there is none; at least 1. */
    uint16_t settle_fixes; /**< Fixes in a row that make the quality good; at least 1. */
    uint16_t jump_fixes;   /**< Jumps that agree, of which the last is believed; at least 1. */
} keel_axis_config_t;

/** The measurements. Numbers may be any bit pattern. */
typedef struct keel_axis_sample {
    float acceleration;    /**< Along the axis, gravity taken off, in m/s^2. */
    float position;        /**< The fix's, in m. */
    float velocity;        /**< The fix's, in m/s. */
    bool has_acceleration; /**< Whether there is one. */
    bool has_fix;          /**< Whether a fix came since the last step. */
    bool has_velocity;     /**< Whether it has a velocity. */
    bool is_usable;        /**< Whether its source says that it can be used. */
} keel_axis_sample_t;

/** How good position and velocity are: KEEL_AXIS_NONE, ... A plain number, as structures hold it:
 * an enumeration's size differs between compilers. */
typedef uint8_t keel_axis_quality_t;

/** An axis. Only the functions below write it; all of it may be read. */
typedef struct keel_axis {
    keel_axis_config_t config;   /**< As checked by init. */
    float step;                  /**< T, in s. */
    float half_step;             /**< T / 2, in s. */
    float position;              /**< p, in m. */
    float velocity;              /**< v, in m/s. */
    float bias;                  /**< Of the acceleration, in m/s^2. */
    float jump;                  /**< Where the last jump was, in m; 0 before. */
    uint16_t age;                /**< Steps since a fix was taken, to lost_steps. */
    uint16_t agreed;             /**< Fixes that agreed since one did not, to settle_fixes. */
    uint16_t jumped;             /**< Jumps that agree, since a fix was taken. */
    uint32_t flags;              /**< KEEL_AXIS_FIXED, ...: what the last step did. */
    keel_axis_quality_t quality; /**< How good all this is: KEEL_AXIS_NONE, _POOR or _GOOD. */
} keel_axis_t;

/**
 * Makes an axis of which nothing is known (requirements AXI-001 to AXI-003).
 *
 * @param axis   the axis
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_RATE (rate_hz), KEEL_ERR_GAIN or KEEL_ERR_LIMITS (a limit, a gate or a
 *         number), the first that applies, NaN included: then nothing is changed
 */
keel_status_t keel_axis_init(keel_axis_t *axis, const keel_axis_config_t *config);

/**
 * Forgets all that was measured (requirement AXI-003).
 *
 * @param axis the axis, initialised
 */
void keel_axis_restart(keel_axis_t *axis);

/**
 * One step (requirements AXI-004 to AXI-013). Call it at the configured rate, whether something was
 * measured or not.
 *
 * @param axis   the axis, initialised
 * @param sample what was measured since the last step
 */
void keel_axis_step(keel_axis_t *axis, const keel_axis_sample_t *sample);

KEEL_C_END

#endif
