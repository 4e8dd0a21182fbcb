/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/mode.h
 * @brief The contracts of mode.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_MODE_H
#define KEEL_INTERNAL_FLIGHT_MODE_H

#include "keel/c_declarations.h"
#include "keel/flight/mode.h"

KEEL_C_BEGIN

/*@ predicate mode_has(integer word, integer bits) = (word & bits) == bits;
  @
  @ predicate mode_lacks(integer word, integer bits) = (word & bits) == 0;
  @
  @ predicate mode_runs(keel_mode_t *m) =
  @     m->state != KEEL_MODE_DISARMED && m->state < KEEL_MODE_TERMINATED;
  @
  @ predicate mode_piloted(integer state) =
  @     state == KEEL_MODE_ARMED || state == KEEL_MODE_FLYING;
  @
  @ // Nobody flies it: it holds, returns or lands.
  @ predicate mode_alone(integer state) = KEEL_MODE_HOLDING <= state <= KEEL_MODE_LANDING;
  @
  @ // A good frame: one that tells a mode.
  @ predicate mode_frame(keel_mode_input_t *i) =
  @     mode_has(i->facts, KEEL_MODE_RC_LINKED) && i->asked < KEEL_MODE_NONE;
  @
  @ // A fact that has to hold for a time holds for at least the longest silence.
  @ predicate mode_settling(keel_mode_config_t *c, integer time_us) =
  @     c->loss_us <= time_us <= KEEL_MODE_TIME_MOST_US;
  @
  @ predicate mode_times_valid(keel_mode_config_t *c) =
  @     KEEL_MODE_LOSS_LEAST_US <= c->loss_us <= KEEL_MODE_LOSS_MOST_US &&
  @     mode_settling(c, c->regain_us) && mode_settling(c, c->request_us) &&
  @     mode_settling(c, c->kill_us) && mode_settling(c, c->landed_us) &&
  @     mode_settling(c, c->estimate_us) && mode_settling(c, c->alarm_us) &&
  @     mode_settling(c, c->idle_us) && c->hold_us <= KEEL_MODE_TIME_MOST_US &&
  @     c->return_us <= KEEL_MODE_TIME_MOST_US;
  @
  @ predicate mode_config_valid(keel_mode_config_t *c) = mode_times_valid(c) && c->required != 0;
  @
  @ predicate mode_numbers_valid(keel_mode_t *m) =
  @     m->state < KEEL_MODE_STATES && m->mode <= KEEL_MODE_NONE && m->asked <= KEEL_MODE_NONE &&
  @     m->rests_at <= KEEL_MODE_NONE;
  @
  @ // The time that each fact takes to settle.
  @ predicate mode_settle_valid(keel_mode_t *m) =
  @     m->settle_us[0] == m->config.regain_us && m->settle_us[1] == m->config.request_us &&
  @     m->settle_us[2] == m->config.request_us && m->settle_us[3] == m->config.request_us &&
  @     m->settle_us[4] == m->config.kill_us && m->settle_us[5] == m->config.request_us &&
  @     m->settle_us[6] == m->config.landed_us && m->settle_us[7] == m->config.alarm_us &&
  @     m->settle_us[8] == m->config.estimate_us && m->settle_us[9] == m->config.estimate_us &&
  @     m->settle_us[10] == m->config.estimate_us && m->settle_us[11] == m->config.alarm_us &&
  @     m->settle_us[12] == m->config.alarm_us && m->settle_us[13] == m->config.alarm_us;
  @
  @ // Init establishes this, and every step keeps it.
  @ predicate mode_valid(keel_mode_t *m) =
  @     mode_config_valid(&m->config) && mode_numbers_valid(m) && mode_settle_valid(m) &&
  @     (m->motors <==> mode_runs(m)) && (m->mode == KEEL_MODE_NONE <==> !mode_runs(m)) &&
  @     mode_lacks(m->settled & ~m->seen, 0x3F) && mode_lacks(m->overridden, ~0x3800) &&
  @     (mode_has(m->settled, KEEL_MODE_RC_LINKED) ==> m->silence_us < m->config.loss_us) &&
  @     (m->ready ==> mode_has(m->settled, KEEL_MODE_RC_LINKED) &&
  @         mode_lacks(m->settled, KEEL_MODE_ARM_SWITCH_ON)) &&
  @     (mode_piloted(m->state) ==> mode_has(m->settled, KEEL_MODE_RC_LINKED) &&
  @         m->asked != KEEL_MODE_NONE) &&
  @     (m->state != KEEL_MODE_DISARMED ==> m->cause != 0);
  @*/

/*@ requires \valid(mode) && \valid_read(config) && \separated(mode, config);
  @ assigns *mode;
  @ behavior bad_times:
  @   assumes !mode_times_valid(config);
  @   assigns \nothing;
  @   ensures MOD_001_times: \result == KEEL_ERR_LIMITS;
  @ behavior no_checks:
  @   assumes mode_times_valid(config) && config->required == 0;
  @   assigns \nothing;
  @   ensures MOD_001_required: \result == KEEL_ERR_INPUT;
  @ behavior made:
  @   assumes mode_config_valid(config);
  @   ensures MOD_001_made: \result == KEEL_OK && mode->config == *config;
  @   ensures MOD_002_still: !mode->motors && mode->state == KEEL_MODE_DISARMED;
  @   ensures MOD_002_unseen: mode->seen == 0 && mode->settled == 0 && !mode->ready;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_mode_init(keel_mode_t *mode, const keel_mode_config_t *config);

/*@ requires \valid(mode) && mode_valid(mode);
  @ requires \valid_read(input) && \separated(mode, input);
  @ assigns *mode;
  @ ensures MOD_003_valid: mode_valid(mode);
  @ ensures MOD_004_attempt: !\old(mode->motors) && mode->motors ==>
  @     \old(mode->state) == KEEL_MODE_DISARMED && \old(mode->ready) && mode_frame(input) &&
  @     mode_has(mode->settled, KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_RC_LINKED);
  @ ensures MOD_004_checks: !\old(mode->motors) && mode->motors ==>
  @     mode_has(input->checks, mode->config.required);
  @ ensures MOD_004_facts: !\old(mode->motors) && mode->motors ==>
  @     mode_has(mode->settled, KEEL_MODE_THROTTLE_LOW | KEEL_MODE_LANDED) &&
  @     mode_lacks(mode->seen, KEEL_MODE_KILL_SWITCH_ON | KEEL_MODE_FENCE_BREACHED |
  @         KEEL_MODE_BATTERY_CRITICAL | KEEL_MODE_BATTERY_EMPTY);
  @ ensures MOD_004_mode: !\old(mode->motors) && mode->motors ==> mode->mode == mode->asked;
  @ ensures MOD_004_off: mode->ready && !\old(mode->ready) ==>
  @     mode_has(mode->settled, KEEL_MODE_ARM_SWITCH_OFF | KEEL_MODE_RC_LINKED);
  @ ensures MOD_004_once: mode->ready ==> mode_has(mode->settled, KEEL_MODE_RC_LINKED) &&
  @     mode_lacks(mode->settled, KEEL_MODE_ARM_SWITCH_ON);
  @ ensures MOD_005_named: \old(mode->state) == KEEL_MODE_DISARMED && \old(mode->ready) &&
  @     mode_has(mode->settled, KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_RC_LINKED) && !mode->motors ==>
  @         (mode->refused.checks != 0 || mode->refused.facts != 0) &&
  @         mode->refused == mode->blocking;
  @ ensures MOD_006_stops: \old(mode->motors) && !mode->motors ==>
  @     mode->state == KEEL_MODE_TERMINATED ||
  @     (\old(mode->state) == KEEL_MODE_LANDING &&
  @         mode_has(mode->settled, KEEL_MODE_LANDED)) ||
  @     (\old(mode->state) == KEEL_MODE_ARMED &&
  @         mode_has(mode->seen, KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW));
  @ ensures MOD_006_ground: \old(mode->state) == KEEL_MODE_FLYING &&
  @     mode->state == KEEL_MODE_ARMED ==>
  @         mode_has(mode->settled, KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW);
  @ ensures MOD_007_lost: \old(mode->silence_us) + input->elapsed_us >= mode->config.loss_us ==>
  @     !mode_piloted(mode->state);
  @ ensures MOD_007_hold_ends: mode->state == KEEL_MODE_HOLDING ==>
  @     (\old(mode->state) == KEEL_MODE_HOLDING ?
  @         mode->state_us == \old(mode->state_us) + input->elapsed_us < mode->config.hold_us :
  @         mode->state_us == 0);
  @ ensures MOD_007_return_ends: mode->state == KEEL_MODE_RETURNING ==>
  @     (\old(mode->state) == KEEL_MODE_RETURNING ?
  @         mode->state_us == \old(mode->state_us) + input->elapsed_us < mode->config.return_us :
  @         mode->state_us == 0);
  @ ensures MOD_008_moves: mode_alone(\old(mode->state)) && mode_piloted(mode->state) ==>
  @     mode_frame(input) && \old(mode->asked) != KEEL_MODE_NONE &&
  @     mode->asked != \old(mode->asked) &&
  @     mode_has(mode->settled, KEEL_MODE_RC_LINKED | KEEL_MODE_SWITCH_UNMOVED);
  @ ensures MOD_009_why: mode_piloted(mode->state) ==>
  @     mode->mode == mode->asked || mode->missing != 0;
  @ ensures MOD_009_alone: mode_alone(mode->state) ==> mode->mode == KEEL_MODE_LAND ||
  @     KEEL_MODE_ALTITUDE <= mode->mode <= KEEL_MODE_RETURN;
  @ ensures MOD_009_cause: mode_alone(mode->state) ==> mode->cause != 0;
  @ ensures MOD_010_kill: mode->state == KEEL_MODE_TERMINATED &&
  @     \old(mode->state) != KEEL_MODE_TERMINATED ==>
  @         mode_frame(input) && mode_has(mode->settled, KEEL_MODE_KILL_SWITCH_ON);
  @ ensures MOD_010_latches: \old(mode->state) == KEEL_MODE_TERMINATED ==>
  @     mode->state == KEEL_MODE_TERMINATED && !mode->motors;
  @ ensures MOD_011_overridden: mode_has(\old(mode->overridden), mode->overridden) ||
  @     mode->state == KEEL_MODE_FLYING;
  @ ensures MOD_012_exit: \old(mode->motors) && mode_frame(input) &&
  @     mode_has(mode->settled, KEEL_MODE_KILL_SWITCH_ON) ==> mode->state == KEEL_MODE_TERMINATED;
  @*/
void keel_mode_step(keel_mode_t *mode, const keel_mode_input_t *input);

KEEL_C_END

#endif
