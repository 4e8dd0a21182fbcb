/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file attitude.h
 * @brief Attitude estimator: a quaternion from voted inertial samples and a magnetometer.
 *
 * A complementary filter whose corrections go by directions that are low-passed in the Earth's
 * frame, where gravity and field stand still however the body turns and vibrates: D. Laidig and
 * T. Seel ("VQF: Highly accurate IMU orientation estimation with bias estimation and magnetic
 * disturbance rejection", Information Fusion 91, 2023) low-pass the specific force so. How rates,
 * errors and bias make the quaternion is the passive filter of R. Mahony, T. Hamel and
 * J.-M. Pflimlin ("Nonlinear complementary filters on the special orthogonal group", IEEE
 * Transactions on Automatic Control 53(5), 2008, section IV-B).
 *
 * Frames: the Earth's is north, east, down; the body's is forward, right, down. The quaternion
 * q = (w, x, y, z) turns body to Earth: v_E = q v_B q*. Its matrix has the rows n, e and v, which
 * are north, east and down as the body sees them:
 *
 *     n = (1 - 2 (y^2 + z^2), 2 (xy - wz), 2 (xz + wy))
 *     e = (2 (xy + wz), 1 - 2 (x^2 + z^2), 2 (yz - wx))
 *     v = (2 (xz - wy), 2 (yz + wx), 1 - 2 (x^2 + y^2))
 *
 * A step, T = 1 / rate_hz, from the angular rate W, the specific force f, the field b and, where it
 * is known, the acceleration a of the vehicle in the Earth's frame; R has the rows n, e and v:
 *
 *     D <- D + force_gain T ((a - R f) / g - D)       down, low-passed; Earth's frame
 *     F <- F + field_share (R b - F)                  the field, low-passed, at each sample of it
 *     E = (D_y, -D_x, 0)       while |D|^2 is 0.719 to 1.32, else 0
 *     H = (F_N, F_E) x (north, east) / |(north, east)|^2   the sine of the heading's error; it is
 *                      taken at samples at which its cosine C has H^2 + C^2 from 0.5 to 1.5, as +-1
 *                      when C is not above 0, and kept until the next one for field_steps at most
 *     B <- clamp(B - bias_gain T R^-1 clamp((E_x, E_y, H), tolerance), bias_limit)
 *                                                     the bias, while |W - B| is at most quiet_rate
 *     u = (tilt_gain E_x, tilt_gain E_y, heading_gain H)   what is corrected, a rate
 *     D <- D + T u x D,  F <- F + T u x F             turned along with the frame they are in
 *     h = clamp(T/2 (W - B + R^-1 u), 2^-4)           half of the angle to turn
 *     p = q + q (0, h),  q <- p (3/2 - |p|^2 / 2)
 *
 * As D and F turn along, an error that is corrected is not in them any more: low pass and
 * correction are two first-order filters one behind the other, with the time constants
 * 1 / force_gain and 1 / tilt_gain, and no loop with a lag. Nothing is judged by a single sample of
 * force or field: a vibration leaves little in D, and accelerations that end add up to little.
 *
 * Where D_z < 0, at which E gets smaller while the error grows, KEEL_ATTITUDE_NUDGE is added to E:
 * upside down by exactly half a turn is no point of rest. D and F begin with 0, and do again when a
 * quaternion is replaced, F also when no sample of the field was good for field_steps: what was
 * low-passed in another frame says nothing.
 *
 * No division, square root or trigonometry in a step: the last line is Newton's iteration for
 * 1 / |p|. As q (0, h) is orthogonal to q, |p|^2 = |q|^2 (1 + |h|^2) in exact arithmetic, from
 * which one iteration leads back to 1 - 3/4 (|p|^2 - 1)^2 nearly. In single precision |q|^2
 * therefore stays between 1 - 1.30e-4 and 1 + 7.7e-6 for ever (requirement ATT-010).
 *
 * In lasting accelerated flight, for longer than the time constants, an accelerometer measures
 * thrust, not gravity, and the estimate creeps towards thrust until |D|^2 is beyond its bounds. The
 * remedy is a, from GPS or from what is commanded.
 *
 * From the start, or a restart, an estimator goes through three phases; in all but the last
 * align_gain stands for force_gain and tilt_gain:
 *
 * - KEEL_ATTITUDE_STILL: until gyroscope and accelerometer have been within still_rate and
 *   still_acceleration of where they began for still_steps samples in a row. The mean rate is then
 *   the bias. Meanwhile the attitude is turned to the accelerometer, with align_gain.
 * - KEEL_ATTITUDE_ALIGNING: until E has been within tolerance for settle_steps samples in a row.
 * - KEEL_ATTITUDE_RUNNING: tilt is valid. Back to aligning when a count up per lost or clipped
 *   sample, down per good one, comes to lost_steps; or when one down per step at which D_z is below
 *   1/2, which is some 60 degrees, up per other one, comes from settle_steps to 0.
 *
 * The heading has a validity of its own, heading_valid, which begins and ends in the same way while
 * running, with the field's samples; it ends when none has come for field_steps. Without a
 * magnetometer (north = east = 0) it is never valid, and turns with what is left of the bias.
 *
 * A rate that does not come is held, until lost_steps; from then on the vehicle is taken not to
 * turn.
 *
 * Single precision throughout. Sources must be compiled without contraction of products and sums
 * (ISO C mode, -std=c99, as all builds of Keel do).
 */
#ifndef KEEL_FLIGHT_ATTITUDE_H
#define KEEL_FLIGHT_ATTITUDE_H

#include "keel/c_declarations.h"
#include "keel/middleware/virtual_imu.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Steps per second. From 500 Hz on, no rate and gain that are taken reach the clamp of h. */
#define KEEL_ATTITUDE_RATE_MIN_HZ 500.0f
#define KEEL_ATTITUDE_RATE_MAX_HZ 32000.0f

/** The greatest gain of tilt, heading and alignment, in 1/s, and of the bias, in 1/s^2. */
#define KEEL_ATTITUDE_GAIN_LIMIT 8.0f

/** The greatest limit of the bias, in rad/s. */
#define KEEL_ATTITUDE_BIAS_LIMIT 0.5f

/** The greatest rate that is taken from a gyroscope, in rad/s: 2292 degrees per second. */
#define KEEL_ATTITUDE_RATE_LIMIT 40.0f

/** The greatest acceleration of the vehicle that is taken, and the greatest specific force, in
 * m/s^2. */
#define KEEL_ATTITUDE_FORCE_LIMIT 320.0f

/** The greatest component of the expected field, and its least horizontal part, in the
 * magnetometer's unit (gauss, microtesla). */
#define KEEL_ATTITUDE_FIELD_LIMIT 1000.0f
#define KEEL_ATTITUDE_FIELD_MIN   0.0625f

/** The greatest spread of samples that count as still: rad/s, m/s^2. */
#define KEEL_ATTITUDE_STILL_RATE_LIMIT         1.0f
#define KEEL_ATTITUDE_STILL_ACCELERATION_LIMIT 10.0f

/** Bounds of the components of the low-passed vectors: of down, in g; and of the field, of
 * which a sample beyond is not taken, in the magnetometer's unit. */
#define KEEL_ATTITUDE_DOWN_REACH  16.0f
#define KEEL_ATTITUDE_FIELD_REACH 4096.0f

/** |D|^2 within these is taken for gravity: a specific force of 0.848 g to 1.149 g. */
#define KEEL_ATTITUDE_DOWN_MIN 0.71875f
#define KEEL_ATTITUDE_DOWN_MAX 1.3203125f

/** The same of the field's horizontal part, over that of the expected one: 0.707 to 1.224. */
#define KEEL_ATTITUDE_FIELD_RATIO_MIN 0.5f
#define KEEL_ATTITUDE_FIELD_RATIO_MAX 1.5f

/** Half of the greatest angle turned in a step, per axis, in rad. */
#define KEEL_ATTITUDE_HALF_ANGLE_LIMIT 0.0625f

/** Added to E about the Earth's axes where D_z < 0. */
#define KEEL_ATTITUDE_NUDGE_X 0.25f
#define KEEL_ATTITUDE_NUDGE_Y 0.125f

/** D_z below which measured and estimated down contradict: the cosine of the angle between. */
#define KEEL_ATTITUDE_AGREEMENT 0.5f

/** The bounds of |q|^2, as computed: a quaternion beyond was not left by a step. */
#define KEEL_ATTITUDE_NORM_MIN 0.999755859375f
#define KEEL_ATTITUDE_NORM_MAX 1.000244140625f

/* Events of the last step: keel_attitude_t, flags. */
#define KEEL_ATTITUDE_LOST        0x01u /**< No rate came, or none that can be: the last is held. */
#define KEEL_ATTITUDE_CLIPPED     0x02u /**< A rate is beyond clip_rate: it may have been more. */
#define KEEL_ATTITUDE_COMPENSATED 0x04u /**< The vehicle's acceleration was taken off. */
#define KEEL_ATTITUDE_DOWN        0x08u /**< D was taken for down, with a new sample. */
#define KEEL_ATTITUDE_FIELD       0x10u /**< F was taken for the field, likewise. */
#define KEEL_ATTITUDE_BIASED      0x20u /**< Still, but the mean rate is beyond bias_limit. */
#define KEEL_ATTITUDE_CORRUPTED   0x40u /**< No unit quaternion was found: restarted. */

/* How far an estimator is: keel_attitude_phase_t. */
#define KEEL_ATTITUDE_STILL    0u /**< Waits for the vehicle to be still. */
#define KEEL_ATTITUDE_ALIGNING 1u /**< Has a bias, converges. */
#define KEEL_ATTITUDE_RUNNING  2u /**< Tilt and rate are valid. */

/** A vector in the body's frame (forward, right, down) or the Earth's (north, east, down). */
typedef struct keel_attitude_vector {
    float x;
    float y;
    float z;
} keel_attitude_vector_t;

/** A quaternion, w its scalar part. */
typedef struct keel_attitude_quaternion {
    float w;
    float x;
    float y;
    float z;
} keel_attitude_quaternion_t;

/** The configuration of an estimator. */
typedef struct keel_attitude_config {
    float rate_hz;            /**< Steps per second, RATE_MIN_HZ to RATE_MAX_HZ. */
    float tilt_gain;          /**< Of E while running, 0 to GAIN_LIMIT, in 1/s. */
    float heading_gain;       /**< Of H while the heading is valid, 0 to GAIN_LIMIT, in 1/s. */
    float align_gain;         /**< Of both before, and of the force's low pass; likewise. */
    float bias_gain;          /**< Of both in the bias, 0 to GAIN_LIMIT, in 1/s^2. */
    float force_gain;         /**< Of the force's low pass while running; likewise, in 1/s. */
    float field_share;        /**< Of a field's sample in the low-passed one, 0 to 1. */
    float bias_limit;         /**< |B| per axis, 0 to BIAS_LIMIT, in rad/s. */
    float quiet_rate;         /**< The bias moves up to this rate, 0 to clip_rate, in rad/s. */
    float clip_rate;          /**< A rate beyond, per axis, is clipped; to RATE_LIMIT, in rad/s. */
    float still_rate;         /**< Spread of the rates, 0 to STILL_RATE_LIMIT, in rad/s. */
    float still_acceleration; /**< Of the forces, 0 to STILL_ACCELERATION_LIMIT, in m/s^2. */
    float tolerance;          /**< Sine of the error that counts as converged, 0 to 1; the bias
                                   follows no more of it. */
    float north;              /**< The expected field's horizontal part; both 0: */
    float east;               /**< no magnetometer. In the magnetometer's unit. */
    uint16_t still_steps;     /**< Still samples in a row that make a bias; at least 1. */
    uint16_t settle_steps;    /**< Samples in a row that make an attitude valid; at least 1. */
    uint16_t lost_steps;      /**< Lost samples that make it invalid; at least 1. */
    uint16_t field_steps;     /**< Steps for which a field's sample is good; at least 1. */
} keel_attitude_config_t;

/** The measurements. Values may be any bit pattern. */
typedef struct keel_attitude_sample {
    keel_attitude_vector_t gyroscope; /**< Angular rate, body, in rad/s. */
    keel_attitude_vector_t
        accelerometer;                   /**< Specific force, body, in m/s^2: (0, 0, -g) at rest. */
    keel_attitude_vector_t magnetometer; /**< Field, body, in its own unit. */
    keel_attitude_vector_t acceleration; /**< Of the vehicle, Earth, in m/s^2: 0 at rest. */
    bool has_gyroscope;                  /**< Whether there is a new one of each. */
    bool has_accelerometer;
    bool has_magnetometer;
    bool has_acceleration;
} keel_attitude_sample_t;

/** How far an estimator is: KEEL_ATTITUDE_STILL, ... A plain number, as structures hold it: an
 * enumeration's size differs between compilers. */
typedef uint8_t keel_attitude_phase_t;

/** Values that init computes from a configuration. */
typedef struct keel_attitude_scale {
    float step;      /**< T, in s. */
    float half_step; /**< T / 2, in s. */
    float bias_step; /**< bias_gain T, in 1/s. */
    float quiet;     /**< quiet_rate^2. */
    float tolerance; /**< tolerance^2. */
    float north;     /**< north / (north^2 + east^2). */
    float east;      /**< east / (north^2 + east^2). */
    float still;     /**< 1 / still_steps. */
} keel_attitude_scale_t;

/** An estimator. Only the functions below write it; all of it may be read. */
typedef struct keel_attitude {
    keel_attitude_config_t config;         /**< As checked by init. */
    keel_attitude_scale_t scale;           /**< Values derived from it. */
    keel_attitude_quaternion_t quaternion; /**< From body to Earth. */
    keel_attitude_vector_t bias;           /**< B, of the gyroscope, in rad/s. */
    keel_attitude_vector_t rate;           /**< W - B of the last step: for rate control. */
    keel_attitude_vector_t gyroscope;      /**< W, the last rate that came. */
    keel_attitude_vector_t first_rate;     /**< The first of the still samples. */
    keel_attitude_vector_t first_force;    /**< The first of the still samples. */
    keel_attitude_vector_t sum;            /**< Of the still rates less the first. */
    keel_attitude_vector_t down;           /**< D: down as measured, low-passed; Earth, in g. */
    keel_attitude_vector_t field;          /**< F: the field, low-passed; Earth. */
    float heading_error;                   /**< H; 0 when no sample is recent enough. */
    uint16_t still;                        /**< Still samples in a row. */
    uint16_t settled;                      /**< Samples that agree in tilt, to settle_steps. */
    uint16_t heading_settled;              /**< Samples that agree in heading. */
    uint16_t lost;                         /**< Up per lost sample, down per good, to lost_steps. */
    uint16_t field_age;                    /**< Steps since the field was taken, to field_steps. */
    uint32_t flags;                        /**< KEEL_ATTITUDE_LOST, ...: what the last step did. */
    bool heading_valid;                    /**< Whether the heading is that of the field. */
    keel_attitude_phase_t phase;           /**< Whether tilt and rate are valid: one of three. */
} keel_attitude_t;

/**
 * Makes an estimator, which then waits for the vehicle to be still (requirements ATT-001 to
 * ATT-003).
 *
 * @param attitude the estimator
 * @param config   what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_RATE (rate_hz), KEEL_ERR_GAIN, KEEL_ERR_LIMITS (a limit, a rate, a
 *         spread, the tolerance, or a number of steps that is 0) or KEEL_ERR_INPUT (the field is
 *         not finite, too large, or too small and not 0), the first that applies, NaN included:
 *         then nothing is changed
 */
keel_status_t keel_attitude_init(keel_attitude_t *attitude, const keel_attitude_config_t *config);

/**
 * Starts again: level, without bias, waiting for the vehicle to be still (requirement ATT-003). Not
 * in flight.
 *
 * @param attitude the estimator, initialised
 */
void keel_attitude_restart(keel_attitude_t *attitude);

/**
 * Fills in what a virtual inertial unit's last vote gave (requirement ATT-004). Rate and force are
 * there when a sensor contributed to each of their three channels; a held output is none.
 *
 * @param sample the sample; magnetometer and acceleration stay as they are
 * @param imu    the virtual unit, initialised
 */
void keel_attitude_take(keel_attitude_sample_t *sample, const keel_virtual_imu_t *imu);

/**
 * One step of the estimator (requirements ATT-005 to ATT-018, ATT-020). Call it at the configured
 * rate, whether there are samples or not; attitude->flags says what it could do.
 *
 * @param attitude the estimator, initialised
 * @param sample   what was measured since the last step
 */
void keel_attitude_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample);

/**
 * Down as the body sees it, v (requirement ATT-019): what tilt is controlled by. Its z component is
 * the cosine of the tilt.
 *
 * @param attitude the estimator, initialised
 * @return a vector of length 1, but for what |q|^2 is off (requirement ATT-010)
 */
keel_attitude_vector_t keel_attitude_down(const keel_attitude_t *attitude);

KEEL_C_END

#endif
