/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/sbus.h
 * @brief The contracts of sbus.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_SBUS_H
#define KEEL_INTERNAL_MIDDLEWARE_SBUS_H

#include "keel/c_declarations.h"
#include "keel/middleware/sbus.h"

KEEL_C_BEGIN

/*@ // Between any two calls: a partial frame begins with a header.
  @ predicate sbus_valid(keel_sbus_t *s) =
  @     s->held < KEEL_SBUS_BYTES && (s->held > 0 ==> s->buffer[0] == KEEL_SBUS_HEADER);
  @
  @ predicate sbus_config(keel_sbus_config_t *c) =
  @     c->lowest <= c->highest <= KEEL_SBUS_CHANNEL_MAX && c->gap_us > 0;
  @
  @ logic integer sbus_sum(integer a, integer b) =
  @     a + b <= UINT32_MAX ? a + b : UINT32_MAX;
  @
  @ // The three bytes from this one on, the lowest first.
  @ logic integer sbus_window(keel_sbus_t *s, integer first) =
  @     s->buffer[first] + 256 * s->buffer[first + 1] + 65536 * s->buffer[first + 2];
  @
  @ // Bits 11 i to 11 i + 10 of those behind the header.
  @ logic integer sbus_field(keel_sbus_t *s, integer i) =
  @     (sbus_window(s, 1 + (11 * i) / 8) >> ((11 * i) % 8)) & 2047;
  @
  @ predicate sbus_footer(integer byte) =
  @     byte == 0x00 || byte == 0x04 || byte == 0x14 || byte == 0x24 || byte == 0x34;
  @
  @ predicate sbus_judged(keel_sbus_t *s, integer i) = ((s->config.judged >> i) & 1) != 0;
  @
  @ predicate sbus_ranges(keel_sbus_t *s) =
  @     \forall integer i; 0 <= i < KEEL_SBUS_CHANNELS && sbus_judged(s, i) ==>
  @         s->config.lowest <= sbus_field(s, i) <= s->config.highest;
  @
  @ predicate sbus_kept{L, M}(keel_sbus_t *s) =
  @     (\forall integer i; 0 <= i < KEEL_SBUS_CHANNELS ==>
  @         \at(s->frame.channel[i], M) == \at(s->frame.channel[i], L)) &&
  @     \at(s->frame.digital_17, M) == \at(s->frame.digital_17, L) &&
  @     \at(s->frame.digital_18, M) == \at(s->frame.digital_18, L) &&
  @     \at(s->frame.lost, M) == \at(s->frame.lost, L) &&
  @     \at(s->frame.failsafe, M) == \at(s->frame.failsafe, L);
  @*/

/*@ requires \valid(sbus) && \valid_read(config) && \separated(sbus, config);
  @ assigns *sbus;
  @ behavior limits:
  @   assumes !(config->lowest <= config->highest <= KEEL_SBUS_CHANNEL_MAX);
  @   assigns \nothing;
  @   ensures RAD_001_limits: \result == KEEL_ERR_LIMITS;
  @ behavior gap:
  @   assumes config->lowest <= config->highest <= KEEL_SBUS_CHANNEL_MAX && config->gap_us == 0;
  @   assigns \nothing;
  @   ensures RAD_001_gap: \result == KEEL_ERR_AGE;
  @ behavior made:
  @   assumes sbus_config(config);
  @   ensures RAD_002_made: \result == KEEL_OK && sbus_valid(sbus) && sbus->held == 0;
  @   ensures RAD_002_config: sbus->config.gap_us == config->gap_us &&
  @       sbus->config.lowest == config->lowest && sbus->config.highest == config->highest &&
  @       sbus->config.judged == config->judged;
  @   ensures RAD_002_none: sbus->age_us == UINT32_MAX && sbus->frame.failsafe != 0 &&
  @       sbus->count.frames == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_sbus_init(keel_sbus_t *sbus, const keel_sbus_config_t *config);

/*@ requires \valid(sbus) && sbus_valid(sbus);
  @ assigns sbus->frame.channel[0 .. KEEL_SBUS_CHANNELS - 1], sbus->frame.digital_17,
  @     sbus->frame.digital_18, sbus->frame.lost, sbus->frame.failsafe, sbus->count.frames,
  @     sbus->count.headers, sbus->count.footers, sbus->count.flags, sbus->count.ranges,
  @     sbus->count.gaps, sbus->age_us, sbus->quiet_us,
  @     sbus->buffer[0 .. KEEL_SBUS_BYTES - 1], sbus->held;
  @ ensures RAD_003_valid: sbus_valid(sbus);
  @ ensures RAD_004_footer: \result ==> sbus_footer(sbus->buffer[KEEL_SBUS_BYTES - 1]);
  @ ensures RAD_004_last: \result ==> byte == sbus->buffer[KEEL_SBUS_BYTES - 1] &&
  @     sbus->buffer[0] == KEEL_SBUS_HEADER;
  @ ensures RAD_004_flags: \result ==> sbus->buffer[KEEL_SBUS_BYTES - 2] < 16;
  @ ensures RAD_004_range: \result ==>
  @     \forall integer i; 0 <= i < KEEL_SBUS_CHANNELS && sbus_judged(sbus, i) ==>
  @     sbus->config.lowest <= sbus->frame.channel[i] <= sbus->config.highest;
  @ ensures RAD_005_fields: \result ==> \forall integer i; 0 <= i < KEEL_SBUS_CHANNELS ==>
  @     sbus->frame.channel[i] == sbus_field(sbus, i);
  @ ensures RAD_006_kept: !\result ==> sbus_kept{Pre, Post}(sbus);
  @ ensures RAD_007_frames: sbus->count.frames ==
  @     (\result ? sbus_sum(\old(sbus->count.frames), 1) : \old(sbus->count.frames));
  @ ensures RAD_008_age: sbus->age_us ==
  @     (\result ? 0 : sbus_sum(\old(sbus->age_us), elapsed_us));
  @ ensures RAD_008_quiet: sbus->quiet_us == 0;
  @ ensures RAD_009_gap: sbus_sum(\old(sbus->quiet_us), elapsed_us) > sbus->config.gap_us ==>
  @     !\result && sbus->held == (byte == KEEL_SBUS_HEADER ? 1 : 0);
  @ ensures RAD_009_adds: \old(sbus->held) < KEEL_SBUS_BYTES - 1 &&
  @     sbus_sum(\old(sbus->quiet_us), elapsed_us) <= sbus->config.gap_us ==> !\result &&
  @     sbus->held == \old(sbus->held) +
  @         (\old(sbus->held) == 0 && byte != KEEL_SBUS_HEADER ? 0 : 1);
  @ ensures RAD_010_whole: \result ==> \old(sbus->held) == KEEL_SBUS_BYTES - 1 &&
  @     sbus->held == 0;
  @ ensures RAD_011_first: \old(sbus->held) == KEEL_SBUS_BYTES - 1 && !\result &&
  @     sbus_sum(\old(sbus->quiet_us), elapsed_us) <= sbus->config.gap_us ==>
  @     \let n = KEEL_SBUS_BYTES - sbus->held; 1 <= n && \forall integer j; 1 <= j < n ==>
  @         (j < KEEL_SBUS_BYTES - 1 ? \at(sbus->buffer[j], Pre) : byte) != KEEL_SBUS_HEADER;
  @ ensures RAD_011_shifted: \old(sbus->held) == KEEL_SBUS_BYTES - 1 && !\result &&
  @     sbus_sum(\old(sbus->quiet_us), elapsed_us) <= sbus->config.gap_us ==>
  @     \let n = KEEL_SBUS_BYTES - sbus->held; \forall integer j; 0 <= j < sbus->held ==>
  @         sbus->buffer[j] ==
  @             (n + j < KEEL_SBUS_BYTES - 1 ? \at(sbus->buffer[n + j], Pre) : byte);
  @*/
bool keel_sbus_take(keel_sbus_t *sbus, uint8_t byte, uint32_t elapsed_us);

/*@ requires \valid(sbus);
  @ assigns sbus->age_us, sbus->quiet_us;
  @ ensures RAD_008_ages: sbus->age_us == sbus_sum(\old(sbus->age_us), elapsed_us);
  @ ensures RAD_008_silence: sbus->quiet_us == sbus_sum(\old(sbus->quiet_us), elapsed_us);
  @*/
void keel_sbus_pass_time(keel_sbus_t *sbus, uint32_t elapsed_us);

/*@ assigns \nothing;
  @ ensures RAD_012_scale: \result ==
  @     KEEL_SBUS_US_MIN +
  @     (5 * (raw < KEEL_SBUS_CHANNEL_MAX ? raw : KEEL_SBUS_CHANNEL_MAX) + 4) / 8;
  @ ensures RAD_012_bounds: KEEL_SBUS_US_MIN <= \result <= KEEL_SBUS_US_MAX;
  @*/
uint16_t keel_sbus_us(uint16_t raw);

KEEL_C_END

#endif
