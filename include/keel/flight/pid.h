/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pid.h
 * @brief PID controller in parallel form with feed-forward (eq. 4).
 *
 *     u(t) = kp e + ki integral(e) + kd d(e_f)/dt + kff r,    e = r - y
 *
 * r is the set-point, y the measurement, e_f the error behind a two-pole low-pass (filter.h).
 * Sampled at a fixed rate with T = 1 / rate, step n computes
 *
 *     e_n = r_n - y_n
 *     d_n = (e_f,n - e_f,n-1) / T         0 at the first step: no kick
 *     i_n = clamp(i_n-1 + ki T e_n)       what the integral contributes, in the output's unit
 *     u_n = clamp(kp e_n + kd d_n + kff r_n + i_n)
 *
 * - The integral is kept in the output's unit: a new ki acts on what is still to come only.
 * - Anti-windup: while the output would be beyond a limit, the integral does not move any further
 *   in that direction. It has limits of its own as well.
 * - When the output is at a limit, `saturation` says so.
 * - Set-points and measurements that are not finite or beyond KEEL_PID_INPUT_LIMIT are refused with
 *   KEEL_ERR_INPUT: the output and everything else stay what they were.
 *
 * No division and no library call in a step. Single precision throughout.
 */
#ifndef KEEL_FLIGHT_PID_H
#define KEEL_FLIGHT_PID_H

#include "keel/c_declarations.h"
#include "keel/flight/filter.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The greatest set-point and measurement: half of what the filter takes, so that it takes every
 * error. */
#define KEEL_PID_INPUT_LIMIT 5.0e5f

/** The greatest gain. */
#define KEEL_PID_GAIN_LIMIT 1.0e6f

/** The greatest limit of an output or an integral. */
#define KEEL_PID_OUTPUT_LIMIT 1.0e9f

/** The bounds of ki T and the derivative, in any state: 2^30 and 2^70, far from overflow. */
#define KEEL_PID_INTEGRAL_GAIN_LIMIT 1073741824.0f
#define KEEL_PID_DERIVATIVE_LIMIT    1180591620717411303424.0f

/* Whether the last output is at a limit: keel_pid_saturation_t. */
#define KEEL_PID_FREE   0u /**< Within the limits. */
#define KEEL_PID_AT_MIN 1u /**< Would have been below output_min. */
#define KEEL_PID_AT_MAX 2u /**< Would have been above output_max. */

/** The gains of eq. 4, each from 0 to KEEL_PID_GAIN_LIMIT. u is the unit of the output, e that of
 * the error. */
typedef struct keel_pid_gains {
    float kp;  /**< Proportional, in u/e. */
    float ki;  /**< Integral, in u/(e s). */
    float kd;  /**< Derivative, in u s/e. */
    float kff; /**< Feed-forward on the set-point, in u/e. */
} keel_pid_gains_t;

/** The configuration of a controller. */
typedef struct keel_pid_config {
    keel_pid_gains_t gains; /**< May be changed later: keel_pid_set_gains. */
    float rate_hz;          /**< Steps per second: see keel_filter_init. */
    float cutoff_hz;        /**< Cut-off of the derivative's low-pass: see keel_filter_init. */
    float output_min;       /**< Least output, below output_max. */
    float output_max;       /**< Greatest output, up to KEEL_PID_OUTPUT_LIMIT. */
    float integral_min;     /**< Least contribution of the integral, not above 0. */
    float integral_max;     /**< Greatest contribution of the integral, not below 0. */
} keel_pid_config_t;

/** Whether the last output is at a limit because it would have been beyond it: KEEL_PID_FREE, ... A
 * plain number, as structures hold it: an enumeration's size differs between compilers. */
typedef uint8_t keel_pid_saturation_t;

/** A controller. */
typedef struct keel_pid {
    keel_pid_config_t config; /**< As checked by init, with the gains in force. */
    keel_filter_t filter;     /**< The low-pass of the error. */
    float integral_gain;      /**< ki T. */
    float integral;           /**< The integral's contribution, in the output's unit. */
    float setpoint;           /**< The last set-point; 0 before the first step. */
    float error;              /**< The last error; 0 before the first step. */
    float derivative;         /**< The last d(e_f)/dt, in e/s; 0 before the second step. */
    float output;             /**< The last output. */
    keel_pid_saturation_t
        saturation; /**< Whether that is at a limit: KEEL_PID_FREE, _AT_MIN or _AT_MAX. */
    bool started;   /**< Whether a step was made since the last reset. */
} keel_pid_t;

/**
 * Makes a controller, reset (requirements PID-001, PID-002).
 *
 * @param pid    the controller
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_GAIN, KEEL_ERR_LIMITS, KEEL_ERR_RATE or KEEL_ERR_CUTOFF, the first that
 *         applies, when the configuration is not as keel_pid_config_t and keel_filter_init say, NaN
 *         included: then nothing is changed
 */
keel_status_t keel_pid_init(keel_pid_t *pid, const keel_pid_config_t *config);

/**
 * Forgets all that was: the integral is 0, the output is 0 or the limit next to it, and the next
 * step is the first (requirement PID-003).
 *
 * @param pid the controller
 */
void keel_pid_reset(keel_pid_t *pid);

/**
 * Changes the gains without a bump (requirements PID-004, PID-005): the integral takes over what
 * the other terms lose or gain, as far as its limits let it, so that the same set-point and
 * measurement lead to the same output. With ki = 0 it keeps that share until the next reset.
 *
 * @param pid   the controller
 * @param gains the new gains; copied
 * @return KEEL_OK, or KEEL_ERR_GAIN when a gain is negative, not finite or beyond
 *         KEEL_PID_GAIN_LIMIT: then nothing is changed
 */
keel_status_t keel_pid_set_gains(keel_pid_t *pid, const keel_pid_gains_t *gains);

/**
 * One step of eq. 4; the result is pid->output (requirements PID-006 to PID-010). Call it at the
 * configured rate.
 *
 * @param pid         the controller
 * @param setpoint    where the measurement should be, any bit pattern
 * @param measurement where it is, any bit pattern
 * @return KEEL_OK; KEEL_ERR_INPUT when one is not finite or beyond KEEL_PID_INPUT_LIMIT, or the
 *         low-pass refuses the error (see filter.h): then nothing is changed, the output is held
 */
keel_status_t keel_pid_step(keel_pid_t *pid, float setpoint, float measurement);

KEEL_C_END

#endif
