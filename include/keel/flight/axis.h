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
 *
 * Single precision: far from 0, a position moves in steps of its last place, 2^-11 m at half of
 * KEEL_AXIS_POSITION_LIMIT. No division and no library call in a step. Sources must be compiled
 * without contraction of products and sums, as all builds of Keel do.
 */
#ifndef KEEL_FLIGHT_AXIS_H
#define KEEL_FLIGHT_AXIS_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Steps per second. */
#define KEEL_AXIS_RATE_MIN_HZ 10.0f
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

/*@ predicate axis_number(float value, real least, real most) =
  @     \is_finite(value) && least <= value <= most;
  @
  @ predicate axis_rate(keel_axis_config_t c) =
  @     axis_number(c.rate_hz, KEEL_AXIS_RATE_MIN_HZ, KEEL_AXIS_RATE_MAX_HZ);
  @
  @ predicate axis_gains(keel_axis_config_t c) =
  @     axis_number(c.position_gain, 0, KEEL_AXIS_PART_LIMIT) &&
  @     axis_number(c.velocity_gain, 0, KEEL_AXIS_VELOCITY_GAIN_LIMIT) &&
  @     axis_number(c.rate_gain, 0, KEEL_AXIS_PART_LIMIT) &&
  @     axis_number(c.bias_gain, 0, KEEL_AXIS_BIAS_GAIN_LIMIT);
  @
  @ predicate axis_limits(keel_axis_config_t c) =
  @     axis_number(c.bias_limit, 0, KEEL_AXIS_BIAS_LIMIT) &&
  @     axis_number(c.position_gate, 0, KEEL_AXIS_POSITION_LIMIT) &&
  @     axis_number(c.velocity_gate, 0, KEEL_AXIS_VELOCITY_LIMIT) &&
  @     0 < c.late_steps <= c.lost_steps && 0 < c.settle_fixes && 0 < c.jump_fixes;
  @
  @ // Of an axis, what a step needs.
  @ predicate axis_limited(keel_axis_t *axis) =
  @     axis_number(axis->config.bias_limit, 0, KEEL_AXIS_BIAS_LIMIT) &&
  @     \is_finite(axis->config.position_gate) && \is_finite(axis->config.velocity_gate);
  @
  @ // A fix that counts.
  @ predicate axis_counts(keel_axis_sample_t *s) = s->has_fix && s->is_usable &&
  @     axis_number(s->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
  @     (!s->has_velocity ||
  @         axis_number(s->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT));
  @
  @ predicate axis_told(keel_axis_t *axis, integer flag) = (axis->flags & flag) != 0;
  @*/

/**
 * Makes an axis of which nothing is known (requirements AXI-001 to AXI-003).
 *
 * @param axis   the axis
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_RATE (rate_hz), KEEL_ERR_GAIN or KEEL_ERR_LIMITS (a limit, a gate or a
 *         number), the first that applies, NaN included: then nothing is changed
 */
/*@ requires \valid(axis) && \valid_read(config) && \separated(axis, config);
  @ assigns *axis;
  @ ensures AXI_001_rate: !axis_rate(*config) ==> \result == KEEL_ERR_RATE;
  @ ensures AXI_001_gains: axis_rate(*config) && !axis_gains(*config) ==> \result == KEEL_ERR_GAIN;
  @ ensures AXI_001_limits: axis_rate(*config) && axis_gains(*config) && !axis_limits(*config) ==>
  @     \result == KEEL_ERR_LIMITS;
  @ ensures AXI_001_kept: \result != KEEL_OK ==> *axis == \old(*axis);
  @ ensures AXI_002_taken: axis_rate(*config) && axis_gains(*config) && axis_limits(*config) ==>
  @     \result == KEEL_OK && axis->config == *config && axis_limited(axis);
  @ ensures AXI_003_none: \result == KEEL_OK ==> axis->quality == KEEL_AXIS_NONE;
  @*/
keel_status_t keel_axis_init(keel_axis_t *axis, const keel_axis_config_t *config);

/**
 * Forgets all that was measured (requirement AXI-003).
 *
 * @param axis the axis, initialised
 */
/*@ requires \valid(axis);
  @ assigns axis->position, axis->velocity, axis->bias, axis->jump, axis->age, axis->agreed,
  @     axis->jumped, axis->flags, axis->quality;
  @ ensures AXI_003_zero: axis->position == 0 && axis->velocity == 0 && axis->bias == 0 &&
  @     axis->jump == 0;
  @ ensures AXI_003_age: axis->age == axis->config.lost_steps;
  @ ensures AXI_003_forgotten: axis->agreed == 0 && axis->jumped == 0 && axis->flags == 0 &&
  @     axis->quality == KEEL_AXIS_NONE;
  @*/
void keel_axis_restart(keel_axis_t *axis);

/**
 * One step (requirements AXI-004 to AXI-013). Call it at the configured rate, whether something was
 * measured or not.
 *
 * @param axis   the axis, initialised
 * @param sample what was measured since the last step
 */
/*@ requires \valid(axis) && \valid_read(sample) && \separated(axis, sample);
  @ requires axis_limits: axis_limited(axis);
  @ assigns axis->position, axis->velocity, axis->bias, axis->jump, axis->age, axis->agreed,
  @     axis->jumped, axis->flags, axis->quality;
  @ ensures AXI_004_bias: !sample->has_fix && \is_finite(\old(axis->bias)) ==>
  @     axis->bias == \old(axis->bias);
  @ ensures AXI_004_velocity: !sample->has_fix && axis_told(axis, KEEL_AXIS_BLIND) &&
  @     axis_number(\old(axis->velocity), -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT) &&
  @     \is_finite(axis->step) ==> axis->velocity == \old(axis->velocity);
  @ ensures AXI_005_blind: axis_told(axis, KEEL_AXIS_BLIND) <==> !(sample->has_acceleration &&
  @     axis_number(sample->acceleration, -KEEL_AXIS_ACCELERATION_LIMIT,
  @         KEEL_AXIS_ACCELERATION_LIMIT));
  @ ensures AXI_006_position:
  @     axis_number(axis->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT);
  @ ensures AXI_006_velocity:
  @     axis_number(axis->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);
  @ ensures AXI_006_bias:
  @     axis_number(\old(axis->bias), -axis->config.bias_limit, axis->config.bias_limit) ==>
  @     axis_number(axis->bias, -axis->config.bias_limit, axis->config.bias_limit);
  @ ensures AXI_007_unusable: axis_told(axis, KEEL_AXIS_UNUSABLE) <==>
  @     sample->has_fix && !axis_counts(sample);
  @ ensures AXI_008_counts: axis_counts(sample) <==>
  @     (axis_told(axis, KEEL_AXIS_FIXED) || axis_told(axis, KEEL_AXIS_JUMPED));
  @ ensures AXI_008_either: !(axis_told(axis, KEEL_AXIS_FIXED) &&
  @     axis_told(axis, KEEL_AXIS_JUMPED));
  @ ensures AXI_009_set: axis_told(axis, KEEL_AXIS_BEGUN) ==>
  @     axis_told(axis, KEEL_AXIS_FIXED) && axis->position == sample->position &&
  @     (sample->has_velocity ==> axis->velocity == sample->velocity) &&
  @     (!sample->has_velocity ==> axis->velocity == 0);
  @ ensures AXI_009_lost: axis_counts(sample) &&
  @     \old(axis->age) + 1 >= axis->config.lost_steps ==> axis_told(axis, KEEL_AXIS_BEGUN);
  @ ensures AXI_009_only: axis_told(axis, KEEL_AXIS_BEGUN) ==>
  @     \old(axis->age) + 1 >= axis->config.lost_steps || axis->config.jump_fixes <= 1 ||
  @     (axis_told(axis, KEEL_AXIS_AGAIN) &&
  @         \old(axis->jumped) + 1 >= axis->config.jump_fixes);
  @ ensures AXI_009_jumped: axis->jumped == ((axis->flags & KEEL_AXIS_FIXED) != 0 ? 0 :
  @     (axis->flags & KEEL_AXIS_JUMPED) == 0 ? \old(axis->jumped) :
  @     (axis->flags & KEEL_AXIS_AGAIN) != 0 ? \old(axis->jumped) + 1 : 1);
  @ ensures AXI_013_again: axis_told(axis, KEEL_AXIS_AGAIN) ==> \old(axis->jumped) > 0 &&
  @     (axis_told(axis, KEEL_AXIS_JUMPED) || axis_told(axis, KEEL_AXIS_BEGUN));
  @ ensures AXI_013_jump: axis_told(axis, KEEL_AXIS_JUMPED) ==> axis->jump == sample->position;
  @ ensures AXI_013_kept: !axis_told(axis, KEEL_AXIS_JUMPED) && \is_finite(\old(axis->jump)) ==>
  @     axis->jump == \old(axis->jump);
  @ ensures AXI_009_believed: axis_told(axis, KEEL_AXIS_JUMPED) ==>
  @     axis->jumped < axis->config.jump_fixes;
  @ ensures AXI_010_age: axis->age == ((axis->flags & KEEL_AXIS_FIXED) != 0 ? 0 :
  @     \old(axis->age) < axis->config.lost_steps ? \old(axis->age) + 1 :
  @     axis->config.lost_steps);
  @ ensures AXI_011_disagreed: axis_told(axis, KEEL_AXIS_JUMPED) ||
  @     axis_told(axis, KEEL_AXIS_UNUSABLE) || axis_told(axis, KEEL_AXIS_BEGUN) ==>
  @     axis->agreed == 0;
  @ ensures AXI_011_agreed: axis_told(axis, KEEL_AXIS_FIXED) &&
  @     !axis_told(axis, KEEL_AXIS_BEGUN) ==> axis->agreed ==
  @     (\old(axis->agreed) < axis->config.settle_fixes ? \old(axis->agreed) + 1 :
  @     axis->config.settle_fixes);
  @ ensures AXI_011_kept: !sample->has_fix ==> axis->agreed == \old(axis->agreed);
  @ ensures AXI_012_none: axis->quality == KEEL_AXIS_NONE <==>
  @     axis->age >= axis->config.lost_steps;
  @ ensures AXI_012_good: axis->quality == KEEL_AXIS_GOOD <==>
  @     axis->age < axis->config.late_steps && axis->age < axis->config.lost_steps &&
  @     axis->agreed >= axis->config.settle_fixes && !axis_told(axis, KEEL_AXIS_BLIND);
  @ ensures AXI_012_one: axis->quality <= KEEL_AXIS_GOOD;
  @*/
void keel_axis_step(keel_axis_t *axis, const keel_axis_sample_t *sample);

KEEL_C_END

#endif
