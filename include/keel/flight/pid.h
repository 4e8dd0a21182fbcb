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

/*@ predicate pid_gain(float gain) = \is_finite(gain) && 0 <= gain <= KEEL_PID_GAIN_LIMIT;
  @
  @ predicate pid_gains(keel_pid_gains_t gains) =
  @     pid_gain(gains.kp) && pid_gain(gains.ki) && pid_gain(gains.kd) && pid_gain(gains.kff);
  @
  @ predicate pid_within(float value, float least, float greatest) =
  @     \is_finite(value) && \is_finite(least) && \is_finite(greatest) &&
  @     least <= value <= greatest;
  @
  @ predicate pid_limits(keel_pid_config_t config) =
  @     filter_magnitude(config.output_min, KEEL_PID_OUTPUT_LIMIT) &&
  @     filter_magnitude(config.output_max, KEEL_PID_OUTPUT_LIMIT) &&
  @     filter_magnitude(config.integral_min, KEEL_PID_OUTPUT_LIMIT) &&
  @     filter_magnitude(config.integral_max, KEEL_PID_OUTPUT_LIMIT) &&
  @     config.output_min < config.output_max &&
  @     config.integral_min <= 0 && 0 <= config.integral_max;
  @
  @ predicate pid_input(float value) = filter_magnitude(value, KEEL_PID_INPUT_LIMIT);
  @
  @ // The output and the integral never leave this.
  @ predicate pid_bounded(keel_pid_t pid) =
  @     pid_within(pid.output, pid.config.output_min, pid.config.output_max) &&
  @     pid_within(pid.integral, pid.config.integral_min, pid.config.integral_max);
  @
  @ // The last step left this behind for a change of gains.
  @ predicate pid_remembers(keel_pid_t pid) =
  @     pid_input(pid.setpoint) && filter_input(pid.error) &&
  @     filter_magnitude(pid.derivative, KEEL_PID_DERIVATIVE_LIMIT);
  @
  @ // Init establishes this, and reset, set_gains and every step keep it.
  @ predicate pid_valid(keel_pid_t pid) =
  @     pid_gains(pid.config.gains) && pid_limits(pid.config) && filter_rate(pid.config.rate_hz) &&
  @     filter_magnitude(pid.integral_gain, KEEL_PID_INTEGRAL_GAIN_LIMIT) &&
  @     filter_valid(pid.filter) && pid_bounded(pid) && pid_remembers(pid) &&
  @     pid.saturation <= KEEL_PID_AT_MAX;
  @*/

/**
 * Makes a controller, reset (requirements PID-001, PID-002).
 *
 * @param pid    the controller
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_GAIN, KEEL_ERR_LIMITS, KEEL_ERR_RATE or KEEL_ERR_CUTOFF, the first that
 *         applies, when the configuration is not as keel_pid_config_t and keel_filter_init say, NaN
 *         included: then nothing is changed
 */
/*@ requires \valid(pid) && \valid_read(config) && \separated(pid, config);
  @ assigns *pid;
  @ ensures PID_001_gains: !pid_gains(config->gains) ==> \result == KEEL_ERR_GAIN;
  @ ensures PID_001_limits: pid_gains(config->gains) && !pid_limits(*config) ==>
  @     \result == KEEL_ERR_LIMITS;
  @ ensures PID_001_rate: pid_gains(config->gains) && pid_limits(*config) &&
  @     !filter_rate(config->rate_hz) ==> \result == KEEL_ERR_RATE;
  @ ensures PID_001_cutoff: pid_gains(config->gains) && pid_limits(*config) &&
  @     filter_rate(config->rate_hz) && !filter_cutoff(config->rate_hz, config->cutoff_hz) ==>
  @     \result == KEEL_ERR_CUTOFF;
  @ ensures PID_001_unchanged: \result != KEEL_OK ==> *pid == \old(*pid);
  @ ensures PID_002_valid: \result == KEEL_OK ==> pid_valid(*pid) && !pid->started;
  @*/
keel_status_t keel_pid_init(keel_pid_t *pid, const keel_pid_config_t *config);

/**
 * Forgets all that was: the integral is 0, the output is 0 or the limit next to it, and the next
 * step is the first (requirement PID-003).
 *
 * @param pid the controller
 */
/*@ requires \valid(pid);
  @ requires pid_limits(pid->config);
  @ assigns pid->integral, pid->setpoint, pid->error, pid->derivative, pid->output, pid->saturation,
  @     pid->started;
  @ ensures PID_003_fresh: pid->integral == 0 && pid->setpoint == 0 && pid->error == 0 &&
  @     pid->derivative == 0 && pid->saturation == KEEL_PID_FREE && !pid->started;
  @ ensures PID_003_output: pid->output == ((pid->config.output_max < 0) ? pid->config.output_max
  @     : (pid->config.output_min > 0) ? pid->config.output_min : 0);
  @ ensures PID_003_integral: pid_within(pid->integral, pid->config.integral_min,
  @     pid->config.integral_max);
  @ ensures PID_003_bounded: pid_within(pid->output, pid->config.output_min,
  @     pid->config.output_max);
  @ ensures PID_003_remembers: pid_remembers(*pid);
  @*/
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
/*@ requires \valid(pid) && \valid_read(gains) && \separated(pid, gains);
  @ requires pid_valid(*pid);
  @ assigns pid->config.gains, pid->integral_gain, pid->integral;
  @ ensures PID_004_valid: pid_valid(*pid);
  @ ensures PID_004_status: \result == KEEL_OK || \result == KEEL_ERR_GAIN;
  @ ensures PID_004_ok: \result == KEEL_OK <==> pid_gains(*gains);
  @ ensures PID_004_unchanged: \result != KEEL_OK ==>
  @     pid->config.gains == \old(pid->config.gains) && pid->integral == \old(pid->integral);
  @ ensures PID_005_taken: \result == KEEL_OK ==> pid->config.gains == *gains;
  @*/
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
/*@ requires \valid(pid);
  @ requires pid_valid(*pid);
  @ assigns pid->filter.s1, pid->filter.s2, pid->filter.output, pid->integral, pid->setpoint,
  @     pid->error, pid->derivative, pid->output, pid->saturation, pid->started;
  @ ensures PID_006_bounded: pid_valid(*pid);
  @ ensures PID_007_input: \result == KEEL_OK ==> pid_input(setpoint) && pid_input(measurement);
  @ ensures PID_007_held: \result == KEEL_ERR_INPUT ==> *pid == \old(*pid);
  @ ensures PID_007_status: \result == KEEL_OK || \result == KEEL_ERR_INPUT;
  @ ensures PID_008_started: \result == KEEL_OK ==> pid->started && pid->setpoint == setpoint;
  @ ensures PID_009_no_kick: \result == KEEL_OK && !\old(pid->started) ==> pid->derivative == 0;
  @ ensures PID_010_at_max: pid->saturation == KEEL_PID_AT_MAX && \result == KEEL_OK ==>
  @     pid->output == pid->config.output_max && pid->integral <= \old(pid->integral);
  @ ensures PID_010_at_min: pid->saturation == KEEL_PID_AT_MIN && \result == KEEL_OK ==>
  @     pid->output == pid->config.output_min && pid->integral >= \old(pid->integral);
  @*/
keel_status_t keel_pid_step(keel_pid_t *pid, float setpoint, float measurement);

/**
 * Begins at a given output: as after a reset, but that the integral is what makes the first step
 * with the same set-point and measurement put out this (requirement PID-011). It does as far as its
 * limits let it, and not at all with ki = 0, where nothing would take that share away again.
 *
 * @param pid         the controller
 * @param setpoint    the first set-point, any bit pattern
 * @param measurement the first measurement, any bit pattern
 * @param output      the output to begin at, any bit pattern; beyond the output's limits it counts
 *                    as the limit next to it
 * @return KEEL_OK; KEEL_ERR_INPUT when set-point or measurement is not as keel_pid_step takes it,
 * or
 *         the output not finite or beyond KEEL_PID_OUTPUT_LIMIT: then nothing is changed
 */
/*@ requires \valid(pid);
  @ requires enter_valid: pid_valid(*pid);
  @ assigns pid->integral, pid->setpoint, pid->error, pid->derivative, pid->output, pid->saturation,
  @     pid->started;
  @ ensures PID_011_bounded: pid_valid(*pid);
  @ ensures PID_011_status: \result == KEEL_OK || \result == KEEL_ERR_INPUT;
  @ ensures PID_011_ok: \result == KEEL_OK <==> pid_input(setpoint) && pid_input(measurement) &&
  @     filter_magnitude(output, KEEL_PID_OUTPUT_LIMIT);
  @ ensures PID_011_held: \result == KEEL_ERR_INPUT ==> *pid == \old(*pid);
  @ ensures PID_011_fresh: \result == KEEL_OK ==> !pid->started &&
  @     pid->saturation == KEEL_PID_FREE;
  @ ensures PID_011_output: \result == KEEL_OK &&
  @     pid_within(output, pid->config.output_min, pid->config.output_max) ==>
  @     pid->output == output;
  @*/
keel_status_t keel_pid_enter(keel_pid_t *pid, float setpoint, float measurement, float output);

/**
 * One step like keel_pid_step, of a controller whose output is taken by something with limits of
 * its own: where that is at one, the integral does not move further towards it (requirement
 * PID-012). The output is that of the step; what it would have added to the integral is put back.
 *
 * @param pid         the controller
 * @param setpoint    where the measurement should be, any bit pattern
 * @param measurement where it is, any bit pattern
 * @param rises       whether the integral may rise
 * @param falls       whether it may fall
 * @return as keel_pid_step
 */
/*@ requires \valid(pid);
  @ requires within_valid: pid_valid(*pid);
  @ assigns pid->filter.s1, pid->filter.s2, pid->filter.output, pid->integral, pid->setpoint,
  @     pid->error, pid->derivative, pid->output, pid->saturation, pid->started;
  @ ensures PID_012_bounded: pid_valid(*pid);
  @ ensures PID_012_status: \result == KEEL_OK || \result == KEEL_ERR_INPUT;
  @ ensures PID_012_input: \result == KEEL_OK ==> pid_input(setpoint) && pid_input(measurement);
  @ ensures PID_012_held: \result == KEEL_ERR_INPUT ==> *pid == \old(*pid);
  @ ensures PID_012_started: \result == KEEL_OK ==> pid->started && pid->setpoint == setpoint;
  @ ensures PID_012_rises: !rises ==> pid->integral <= \old(pid->integral);
  @ ensures PID_012_falls: !falls ==> pid->integral >= \old(pid->integral);
  @*/
keel_status_t keel_pid_step_within(keel_pid_t *pid, float setpoint, float measurement, bool rises,
                                   bool falls);

KEEL_C_END

#endif
