/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/ppm.h
 * @brief The contracts of ppm.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_PPM_H
#define KEEL_INTERNAL_MIDDLEWARE_PPM_H

#include "keel/c_declarations.h"
#include "keel/internal/middleware/framing.h"
#include "keel/middleware/ppm.h"

KEEL_C_BEGIN

/*@ // Channel i is right when it is so long.
  @ predicate ppm_right(keel_ppm_t *s, integer i, integer us) =
  @     ((s->config.judged >> i) & 1) == 0 || s->config.lowest_us <= us <= s->config.highest_us;
  @
  @ predicate ppm_limits(keel_ppm_config_t *c) =
  @     c->lowest_us <= c->highest_us < c->sync_us < c->lost_us;
  @
  @ // Between any two calls: what came of a frame that is right so far is right.
  @ predicate ppm_valid(keel_ppm_t *s) =
  @     ppm_limits(&s->config) &&
  @     s->come <= KEEL_PPM_CHANNELS && s->channels <= KEEL_PPM_CHANNELS &&
  @     s->row <= s->config.frames_to_take && s->config.frames_to_take > 0 &&
  @     (s->begun == 0 ==> s->row == 0) &&
  @     (s->begun != 0 ==>
  @         \forall integer i; 0 <= i < s->come ==> ppm_right(s, i, s->next[i]));
  @
  @ // How long it is since the last edge when the next one comes.
  @ logic integer ppm_width(keel_ppm_t *s, integer elapsed_us) =
  @     framing_sum(s->quiet_us, elapsed_us);
  @
  @ // An edge that ends a frame of enough channels, all of them right.
  @ predicate ppm_ends(keel_ppm_t *s, integer elapsed_us) =
  @     s->config.sync_us <= ppm_width(s, elapsed_us) <= s->config.lost_us && s->begun != 0 &&
  @     s->come >= s->config.least;
  @
  @ // An edge behind one more channel of a frame that was right so far.
  @ predicate ppm_goes_on(keel_ppm_t *s, integer elapsed_us) =
  @     ppm_width(s, elapsed_us) < s->config.sync_us && s->begun != 0 &&
  @     ppm_right(s, s->come, ppm_width(s, elapsed_us)) && s->come < KEEL_PPM_CHANNELS;
  @
  @ // How many frames of as many channels have come in a row, with one that ends.
  @ logic integer ppm_row(keel_ppm_t *s) =
  @     s->row > 0 && s->row_of == s->come ?
  @         (s->row < s->config.frames_to_take ? s->row + 1 : (integer)s->row) : 1;
  @
  @ predicate ppm_kept{L, M}(keel_ppm_t *s) =
  @     \at(s->channels, M) == \at(s->channels, L) &&
  @     \forall integer i; 0 <= i < KEEL_PPM_CHANNELS ==>
  @         \at(s->channel[i], M) == \at(s->channel[i], L);
  @*/

/*@ requires \valid(ppm) && \valid_read(config) && \separated(ppm, config);
  @ assigns *ppm;
  @ behavior limits:
  @   assumes !(ppm_limits(config) && 1 <= config->least <= KEEL_PPM_CHANNELS);
  @   assigns \nothing;
  @   ensures PPM_001_limits: \result == KEEL_ERR_LIMITS;
  @ behavior frames:
  @   assumes ppm_limits(config) && 1 <= config->least <= KEEL_PPM_CHANNELS &&
  @       config->frames_to_take == 0;
  @   assigns \nothing;
  @   ensures PPM_001_frames: \result == KEEL_ERR_LATCH;
  @ behavior made:
  @   assumes ppm_limits(config) && 1 <= config->least <= KEEL_PPM_CHANNELS &&
  @       config->frames_to_take > 0;
  @   ensures PPM_002_made: \result == KEEL_OK && ppm_valid(ppm) && ppm->row == 0 &&
  @       ppm->begun == 0;
  @   ensures PPM_002_config: ppm->config.lost_us == config->lost_us &&
  @       ppm->config.lowest_us == config->lowest_us &&
  @       ppm->config.highest_us == config->highest_us &&
  @       ppm->config.sync_us == config->sync_us && ppm->config.judged == config->judged &&
  @       ppm->config.least == config->least &&
  @       ppm->config.frames_to_take == config->frames_to_take;
  @   ensures PPM_002_none: ppm->age_us == UINT32_MAX && ppm->channels == 0 &&
  @       ppm->count.frames == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_ppm_init(keel_ppm_t *ppm, const keel_ppm_config_t *config);

/*@ requires \valid(ppm) && ppm_valid(ppm);
  @ assigns ppm->count.frames, ppm->count.pulses, ppm->count.numbers, ppm->count.gaps,
  @     ppm->age_us, ppm->quiet_us, ppm->channel[0 .. KEEL_PPM_CHANNELS - 1],
  @     ppm->next[0 .. KEEL_PPM_CHANNELS - 1], ppm->channels, ppm->come, ppm->row_of, ppm->row,
  @     ppm->begun;
  @ ensures PPM_003_valid: ppm_valid(ppm);
  @ ensures PPM_004_ends: \result ==> ppm_ends{Pre}(ppm, elapsed_us);
  @ ensures PPM_004_range: \result ==> ppm->config.least <= ppm->channels <= KEEL_PPM_CHANNELS &&
  @     \forall integer i; 0 <= i < ppm->channels ==> ppm_right(ppm, i, ppm->channel[i]);
  @ ensures PPM_005_taken: \result ==> ppm->channels == \old(ppm->come) &&
  @     (\forall integer i; 0 <= i < ppm->channels ==>
  @         ppm->channel[i] == \at(ppm->next[i], Pre)) &&
  @     (\forall integer i; ppm->channels <= i < KEEL_PPM_CHANNELS ==> ppm->channel[i] == 0);
  @ ensures PPM_006_kept: !\result ==> ppm_kept{Pre, Post}(ppm);
  @ ensures PPM_007_frames: ppm->count.frames ==
  @     framing_sum(\old(ppm->count.frames), \result ? 1 : 0);
  @ ensures PPM_008_age: ppm->age_us ==
  @     (\result ? 0 : framing_sum(\old(ppm->age_us), elapsed_us));
  @ ensures PPM_008_quiet: ppm->quiet_us == 0;
  @ ensures PPM_009_row: ppm_ends{Pre}(ppm, elapsed_us) ==>
  @     ppm->row == ppm_row{Pre}(ppm) && ppm->row_of == \old(ppm->come) &&
  @     (\result <==> ppm->row == ppm->config.frames_to_take);
  @ ensures PPM_009_goes_on: ppm_goes_on{Pre}(ppm, elapsed_us) ==>
  @     !\result && ppm->row == \old(ppm->row) && ppm->row_of == \old(ppm->row_of) &&
  @     ppm->come == \old(ppm->come) + 1 && ppm->begun != 0 &&
  @     ppm->next[ppm->come - 1] == ppm_width{Pre}(ppm, elapsed_us) &&
  @     \forall integer i; 0 <= i < ppm->come - 1 ==>
  @         ppm->next[i] == \at(ppm->next[i], Pre);
  @ ensures PPM_009_breaks: !ppm_ends{Pre}(ppm, elapsed_us) &&
  @     !ppm_goes_on{Pre}(ppm, elapsed_us) ==> !\result && ppm->row == 0;
  @ ensures PPM_010_begins: ppm->config.sync_us <= ppm_width{Pre}(ppm, elapsed_us) ==>
  @     ppm->come == 0 &&
  @     (ppm->begun != 0 <==> ppm_width{Pre}(ppm, elapsed_us) <= ppm->config.lost_us);
  @*/
bool keel_ppm_take(keel_ppm_t *ppm, uint32_t elapsed_us);

/*@ requires \valid(ppm);
  @ assigns ppm->age_us, ppm->quiet_us;
  @ ensures PPM_008_ages: ppm->age_us == framing_sum(\old(ppm->age_us), elapsed_us);
  @ ensures PPM_008_silence: ppm->quiet_us == framing_sum(\old(ppm->quiet_us), elapsed_us);
  @*/
void keel_ppm_pass_time(keel_ppm_t *ppm, uint32_t elapsed_us);

/*@ requires \valid_read(ppm);
  @ assigns \nothing;
  @ ensures PPM_011_lost: \result <==> ppm->age_us > ppm->config.lost_us;
  @*/
bool keel_ppm_is_lost(const keel_ppm_t *ppm);

KEEL_C_END

#endif
