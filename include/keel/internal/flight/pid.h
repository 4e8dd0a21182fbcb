/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/pid.h
 * @brief The contracts of pid.h, and the functions that no user calls.
 */
#ifndef KEEL_INTERNAL_FLIGHT_PID_H
#define KEEL_INTERNAL_FLIGHT_PID_H

#include "keel/c_declarations.h"
#include "keel/flight/pid.h"
#include "keel/internal/flight/filter.h"

KEEL_C_BEGIN

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
