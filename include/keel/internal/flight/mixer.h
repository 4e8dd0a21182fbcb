/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/mixer.h
 * @brief The contracts of mixer.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_MIXER_H
#define KEEL_INTERNAL_FLIGHT_MIXER_H

#include "keel/c_declarations.h"
#include "keel/flight/mixer.h"

KEEL_C_BEGIN

/*@ predicate mixer_factor(float value) = \is_finite(value) && -1 <= value <= 1;
  @
  @ predicate mixer_geometry(keel_mixer_geometry_t geometry) =
  @     KEEL_MIXER_MOTORS_MIN <= geometry.motors <= KEEL_MIXER_MOTORS &&
  @     \forall integer i; 0 <= i < geometry.motors ==>
  @         mixer_factor(geometry.motor[i].roll) && mixer_factor(geometry.motor[i].pitch) &&
  @         mixer_factor(geometry.motor[i].yaw);
  @
  @ predicate mixer_range(keel_mixer_config_t config) =
  @     \is_finite(config.idle) && KEEL_MIXER_IDLE_MIN <= config.idle <= KEEL_MIXER_IDLE_MAX &&
  @     \is_finite(config.highest) && KEEL_MIXER_HIGHEST_MIN <= config.highest <= 1 &&
  @     \is_finite(config.yaw_share) && 0 <= config.yaw_share <= KEEL_MIXER_YAW_SHARE_MAX;
  @
  @ // Init establishes this, and every step keeps it.
  @ predicate mixer_valid(keel_mixer_t *mixer) =
  @     mixer_geometry(mixer->config.geometry) && mixer_range(mixer->config) &&
  @     \forall integer i; mixer->config.geometry.motors <= i < KEEL_MIXER_MOTORS ==>
  @         \is_finite(mixer->output[i]) && mixer->output[i] == 0;
  @
  @ predicate mixer_command(keel_mixer_command_t command) =
  @     mixer_factor(command.roll) && mixer_factor(command.pitch) && mixer_factor(command.yaw) &&
  @     \is_finite(command.thrust) && 0 <= command.thrust <= 1;
  @
  @ // Disarmed: nothing turns. The comparison excludes NaN.
  @ predicate mixer_stopped(keel_mixer_t *mixer) =
  @     \forall integer i; 0 <= i < KEEL_MIXER_MOTORS ==>
  @         \is_finite(mixer->output[i]) && mixer->output[i] == 0;
  @
  @ // Armed: everything turns.
  @ predicate mixer_turning(keel_mixer_t *mixer) =
  @     \forall integer i; 0 <= i < mixer->config.geometry.motors ==>
  @         \is_finite(mixer->output[i]) &&
  @         mixer->config.idle <= mixer->output[i] <= mixer->config.highest;
  @*/

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures MIX_001_ok: \result == KEEL_OK ==>
  @     mixer_geometry(config->geometry) && mixer_range(*config);
  @*/
keel_status_t keel_mixer_check(const keel_mixer_config_t *config);

/*@ requires \valid(mixer) && \valid_read(config) && \separated(mixer, config);
  @ assigns *mixer;
  @ ensures MIX_002_made: \result == KEEL_OK ==> mixer_valid(mixer) && mixer_stopped(mixer) &&
  @     mixer->limited == 0;
  @ ensures MIX_002_unchanged: \result != KEEL_OK ==> *mixer == \old(*mixer);
  @*/
keel_status_t keel_mixer_init(keel_mixer_t *mixer, const keel_mixer_config_t *config);

/*@ requires \valid(mixer) && \valid_read(command) && \separated(mixer, command);
  @ requires mixer_valid(mixer);
  @ assigns mixer->output[0 .. KEEL_MIXER_MOTORS - 1], mixer->limited;
  @ ensures MIX_003_stopped: !armed ==> mixer_stopped(mixer) && mixer->limited == 0;
  @ ensures MIX_004_turning: armed ==> mixer_turning(mixer);
  @ ensures MIX_004_valid: mixer_valid(mixer);
  @*/
void keel_mixer_step(keel_mixer_t *mixer, const keel_mixer_command_t *command, bool armed);

KEEL_C_END

#endif
