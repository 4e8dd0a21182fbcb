/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file calibration.h
 * @brief Offsets of inertial sensors, found at rest, and of magnetometers, found by turning
 *        (table 2 of the paper: Calibration IMU, Calibration magnetometer).
 *
 * Three axes, x, y and z, in the sensor's or the body's frame; units are the caller's, and the same
 * in all that is given: rad/s, m/s^2, uT, or the sensor's own counts.
 *
 * At rest (keel_calibration_rest_t) it is known what a sensor ought to measure: a gyroscope 0, an
 * accelerometer that is held level (0, 0, -g), forward, right, down. From `samples` samples in a
 * row that lie within `spread` of the first of them, on each axis,
 *
 *     mean   = first + (sum of (sample - first)) / samples
 *     offset = mean - expected
 *
 * A sample that lies farther off, or that is no number within KEEL_CALIBRATION_LIMIT, ends the run;
 * the next number begins another. So what is moved is not calibrated. As differences to the
 * first are added up, a large mean takes no digits from a small spread: single precision loses at
 * most samples * 2^-24 of the spread.
 *
 * Turned about (keel_calibration_field_t), a magnetometer that is fixed to the vehicle sees the
 * Earth's field from all sides, and on each axis as much of it as its opposite: what the vehicle
 * adds (hard iron) is the middle between the lowest and the highest value of each axis,
 *
 *     offset = (lowest + highest) / 2
 *
 * Soft iron and scale are not found. An axis fits once it has spanned span_min, no more than
 * span_max, as it would near a magnet, and its offset is believed.
 *
 * Both take an offset only when it is within `limit` on each axis, and all three or none: until
 * then, and whenever a calibration is refused, the offset before stays in force. Whatever sensors
 * say, every number is finite and within its bound (requirement CAL-013).
 *
 * On its six sides (keel_calibration_sides_t) an accelerometer says what gravity is on each axis,
 * once up and once down. Its mean on a side is that of a calibration at rest that expects 0; which
 * side it is, keel_calibration_side tells. From them
 *
 *     offset = (up + down) / 2,  scale = 2 gravity / (up - down)
 *
 * Single precision. No division and no library call in a step. Sources must be compiled without
 * contraction of products and sums, as all builds of Keel do.
 */
#ifndef KEEL_FLIGHT_CALIBRATION_H
#define KEEL_FLIGHT_CALIBRATION_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** The axes of a sensor: x, y, z. */
#define KEEL_CALIBRATION_AXES 3u

/** The greatest magnitude of a sample, and of all that is configured, in the caller's unit: what
 * sensors of 16 bits can say in counts. */
#define KEEL_CALIBRATION_LIMIT 32768.0f

/** The sides that keel_calibration_side distinguishes. 2 k: axis k points up; 2 k + 1: down. */
#define KEEL_CALIBRATION_SIDES 6u

/** The scales that are believed. */
#define KEEL_CALIBRATION_SCALE_MIN 0.875f
#define KEEL_CALIBRATION_SCALE_MAX 1.125f

/** The most samples of a mean. */
#define KEEL_CALIBRATION_SAMPLES_MAX 65536u

/* How far a calibration is: keel_calibration_state_t. */
#define KEEL_CALIBRATION_IDLE       0u /**< None was begun. */
#define KEEL_CALIBRATION_COLLECTING 1u /**< Samples are looked at. */
#define KEEL_CALIBRATION_DONE       2u /**< The offset was taken. */
#define KEEL_CALIBRATION_REFUSED    3u /**< At rest: it was beyond its limit, and is as before. */

/** A sample of which the offset was taken off. */
typedef struct keel_calibration_vector {
    float axis[KEEL_CALIBRATION_AXES]; /**< In the unit of the sample. */
} keel_calibration_vector_t;

/** A correction: what is right is (raw - offset) * scale, on each axis. */
typedef struct keel_calibration_correction {
    float offset[KEEL_CALIBRATION_AXES]; /**< In the unit of the sample. */
    float scale[KEEL_CALIBRATION_AXES];  /**< 1: as it is. */
} keel_calibration_correction_t;

/** Readings of an accelerometer at rest on its six sides. */
typedef struct keel_calibration_sides {
    float up[KEEL_CALIBRATION_AXES];   /**< On an axis that points up: gravity, were it right. */
    float down[KEEL_CALIBRATION_AXES]; /**< On one that points down: -gravity. */
    float gravity;                     /**< In the unit of the sample, above 0, to LIMIT. */
    float limit;                       /**< The greatest offset that is believed, 0 to LIMIT. */
} keel_calibration_sides_t;

/** A turn of a sensor's axes into those of the vehicle. */
typedef struct keel_calibration_rotation {
    float x[KEEL_CALIBRATION_AXES]; /**< The vehicle's x axis, as the sensor sees it. */
    float y[KEEL_CALIBRATION_AXES]; /**< Its y axis. */
    float z[KEEL_CALIBRATION_AXES]; /**< Its z axis. */
} keel_calibration_rotation_t;

/** How far a calibration is: KEEL_CALIBRATION_IDLE, ... A plain number, as structures hold it: an
 * enumeration's size differs between compilers. */
typedef uint8_t keel_calibration_state_t;

/** The configuration of a calibration at rest. */
typedef struct keel_calibration_rest_config {
    float expected[KEEL_CALIBRATION_AXES]; /**< The right value at rest, within +-LIMIT. */
    float spread;     /**< How far a sample may lie from the first, on an axis, 0 to LIMIT. */
    float limit;      /**< The greatest offset that is believed, on an axis, 0 to LIMIT. */
    uint32_t samples; /**< Samples of a mean, 1 to SAMPLES_MAX. */
} keel_calibration_rest_config_t;

/** A calibration at rest. Only the functions below write it; all of it may be read. */
typedef struct keel_calibration_rest {
    keel_calibration_rest_config_t config; /**< As checked by init. */
    float per_sample;                      /**< 1 / samples. */
    float offset[KEEL_CALIBRATION_AXES];   /**< In force; 0 before the first calibration. */
    float first[KEEL_CALIBRATION_AXES];    /**< The first sample of the run. */
    float sum[KEEL_CALIBRATION_AXES];      /**< Of how far the run's samples lie from it. */
    uint32_t count;                        /**< Samples of the run, 0 to samples. */
    keel_calibration_state_t state;        /**< How far it is: one of four. */
    uint16_t restarts; /**< Runs that were broken off since begin; stays at 65535. */
    uint16_t beyond;   /**< Refused: bit k is set when axis k was beyond the limit. */
} keel_calibration_rest_t;

/** The configuration of a calibration of a magnetometer. */
typedef struct keel_calibration_field_config {
    float lowest;   /**< The lowest value that the sensor gives, within +-LIMIT. */
    float highest;  /**< The highest, lowest to LIMIT. */
    float span_min; /**< The least span of each axis, above 0, to span_max. */
    float span_max; /**< The greatest span without a disturbance, to 2 LIMIT. */
    float limit;    /**< The greatest offset that is believed, on an axis, 0 to LIMIT. */
} keel_calibration_field_config_t;

/** How an axis of a magnetometer is. */
typedef enum keel_calibration_verdict {
    KEEL_CALIBRATION_FIT = 0, /**< Its offset can be taken. */
    KEEL_CALIBRATION_NARROW,  /**< It has not been turned enough: its span is below span_min. */
    KEEL_CALIBRATION_WIDE,    /**< The field was disturbed: its span is above span_max. */
    KEEL_CALIBRATION_BEYOND   /**< Its offset is beyond the limit. */
} keel_calibration_verdict_t;

/** A calibration of a magnetometer. Only the functions below write it; all may be read. */
typedef struct keel_calibration_field {
    keel_calibration_field_config_t config; /**< As checked by init. */
    float offset[KEEL_CALIBRATION_AXES];    /**< In force; 0 before the first calibration. */
    float lowest[KEEL_CALIBRATION_AXES];    /**< Seen since begin; config.highest before. */
    float highest[KEEL_CALIBRATION_AXES];   /**< Seen since begin; config.lowest before. */
    keel_calibration_state_t state;         /**< How far it is: one of four, never REFUSED. */
    uint16_t dropped;                       /**< Samples out of the range; stays at 65535. */
} keel_calibration_field_t;

/**
 * Makes a calibration at rest; its offset is 0 (requirements CAL-001 to CAL-003).
 *
 * @param rest   the calibration
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_VALUE (expected) or KEEL_ERR_LIMITS (any other number), the first that
 *         applies, NaN included: then nothing is changed
 */
keel_status_t keel_calibration_rest_init(keel_calibration_rest_t *rest,
                                         const keel_calibration_rest_config_t *config);

/**
 * Begins to collect samples, whatever was before; the offset stays (requirement CAL-003).
 *
 * @param rest the calibration, initialised
 */
void keel_calibration_rest_begin(keel_calibration_rest_t *rest);

/**
 * Looks at a sample (requirements CAL-004 to CAL-007). Nothing happens unless samples are
 * collected.
 *
 * @param rest   the calibration, initialised
 * @param sample what was measured, as it came, without an offset taken off; any bit pattern
 */
void keel_calibration_rest_step(keel_calibration_rest_t *rest,
                                const float sample[KEEL_CALIBRATION_AXES]);

/**
 * Makes a calibration of a magnetometer; its offset is 0 (requirements CAL-008, CAL-009).
 *
 * @param field  the calibration
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_VALUE (lowest, highest) or KEEL_ERR_LIMITS (any other number), the
 *         first that applies, NaN included: then nothing is changed
 */
keel_status_t keel_calibration_field_init(keel_calibration_field_t *field,
                                          const keel_calibration_field_config_t *config);

/**
 * Begins to collect samples, whatever was before; the offset stays (requirement CAL-009).
 *
 * @param field the calibration, initialised
 */
void keel_calibration_field_begin(keel_calibration_field_t *field);

/**
 * Looks at a sample (requirement CAL-010). Nothing happens unless samples are collected.
 *
 * @param field  the calibration, initialised
 * @param sample what was measured, as it came, without an offset taken off; any bit pattern. One
 *               that is not within the sensor's range on each axis is dropped as a whole
 */
void keel_calibration_field_step(keel_calibration_field_t *field,
                                 const float sample[KEEL_CALIBRATION_AXES]);

/**
 * How an axis is: what still has to be turned, and why a calibration is refused (requirement
 * CAL-011).
 *
 * @param field the calibration, initialised
 * @param axis  the axis, 0 to 2
 * @return the first that applies of KEEL_CALIBRATION_NARROW, KEEL_CALIBRATION_WIDE and
 *         KEEL_CALIBRATION_BEYOND, else KEEL_CALIBRATION_FIT
 */
keel_calibration_verdict_t keel_calibration_field_axis(const keel_calibration_field_t *field,
                                                       uint32_t axis);

/**
 * Takes the offset, and ends the calibration, when every axis fits (requirement CAL-012). A refusal
 * changes nothing: more samples may follow, or keel_calibration_field_begin.
 *
 * @param field the calibration, initialised
 * @return KEEL_OK; KEEL_ERR_STATE (no samples are collected) or KEEL_ERR_LIMITS (an axis does not
 *         fit: keel_calibration_field_axis tells which, and why), the first that applies
 */
keel_status_t keel_calibration_field_finish(keel_calibration_field_t *field);

/**
 * Takes an offset off a sample (requirement CAL-014).
 *
 * @param offset the offset, finite
 * @param raw    the measurement; any bit pattern. A NaN stays one: its user has to look for it
 * @param out    raw - offset, of each axis; raw may be its own axes
 */
void keel_calibration_apply(const float offset[KEEL_CALIBRATION_AXES],
                            const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out);

/**
 * Takes an offset off a sample and scales it (requirement CAL-015).
 *
 * @param correction the correction
 * @param raw        the measurement; any bit pattern. A NaN stays one
 * @param out        (raw - offset) * scale, of each axis; raw may be its own axes
 */
void keel_calibration_correct(const keel_calibration_correction_t *correction,
                              const float raw[KEEL_CALIBRATION_AXES],
                              keel_calibration_vector_t *out);

/**
 * The side that points up, by an accelerometer at rest: one axis has at least so much of
 * gravity, the others at most so much (requirement CAL-016).
 *
 * @param mean  what it says; any bit pattern
 * @param least what an axis says at least that points up or down, to KEEL_CALIBRATION_LIMIT
 * @param most  what the others say at most, to either side, 0 to below least
 * @return 2 k: axis k points up; 2 k + 1: down; KEEL_CALIBRATION_SIDES: none does
 */
uint32_t keel_calibration_side(const float mean[KEEL_CALIBRATION_AXES], float least, float most);

/**
 * Makes a correction of what an accelerometer said on its six sides (requirement CAL-017).
 *
 * @param sides      what it said; any bit pattern
 * @param correction the correction
 * @return KEEL_OK; KEEL_ERR_VALUE (gravity, limit) or KEEL_ERR_LIMITS (on any axis what was said
 *         is no number within KEEL_CALIBRATION_LIMIT, or offset or scale cannot be believed), the
 *         first that applies: then nothing is changed
 */
keel_status_t keel_calibration_six(const keel_calibration_sides_t *sides,
                                   keel_calibration_correction_t *correction);

/**
 * Turns a sample into the vehicle's axes (requirement CAL-018).
 *
 * @param turn the turn
 * @param raw  the measurement; any bit pattern. A NaN stays one
 * @param out  x times raw, y times raw, z times raw; separate from raw
 */
void keel_calibration_turn(const keel_calibration_rotation_t *turn,
                           const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out);

KEEL_C_END

#endif
