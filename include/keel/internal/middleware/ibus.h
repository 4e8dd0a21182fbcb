/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/ibus.h
 * @brief The contracts of ibus.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_IBUS_H
#define KEEL_INTERNAL_MIDDLEWARE_IBUS_H

#include "keel/c_declarations.h"
#include "keel/internal/middleware/framing.h"
#include "keel/middleware/ibus.h"

KEEL_C_BEGIN

/*@ predicate ibus_headers(keel_ibus_t *s) =
  @     s->framing.header[0] == KEEL_IBUS_HEADER && s->framing.header[1] == KEEL_IBUS_HEADER &&
  @     s->framing.header[2] == KEEL_IBUS_HEADER && s->framing.header[3] == KEEL_IBUS_HEADER;
  @
  @ // Between any two calls: fewer bytes than those of a frame are held, the first a header.
  @ predicate ibus_valid(keel_ibus_t *s) =
  @     framing_valid(&s->framing) && ibus_headers(s) && s->framing.held < KEEL_IBUS_BYTES;
  @
  @ predicate ibus_config(keel_ibus_config_t *c) =
  @     c->lowest <= c->highest <= KEEL_IBUS_CHANNEL_MAX && c->gap_us > 0;
  @
  @ logic integer ibus_sum{L}(uint8_t *bytes, integer count) =
  @     count <= 0 ? 0 : ibus_sum(bytes, count - 1) + bytes[count - 1];
  @
  @ logic integer ibus_word(keel_ibus_t *s, integer i) =
  @     s->framing.byte[2 * i + 2] + 256 * s->framing.byte[2 * i + 3];
  @
  @ // Upper bits of three channels, the lowest first.
  @ logic integer ibus_extra(keel_ibus_t *s, integer k) =
  @     ibus_word(s, 3 * k) / 4096 + 16 * (ibus_word(s, 3 * k + 1) / 4096) +
  @     256 * (ibus_word(s, 3 * k + 2) / 4096);
  @
  @ logic integer ibus_field(keel_ibus_t *s, integer i) =
  @     i >= KEEL_IBUS_WORDS ?
  @         (s->config.extended != 0 ? ibus_extra(s, i - KEEL_IBUS_WORDS) : 0) :
  @     s->config.extended != 0 ? ibus_word(s, i) % 4096 : ibus_word(s, i);
  @
  @ predicate ibus_in_range(keel_ibus_t *s, integer value) =
  @     s->config.lowest <= value <= s->config.highest;
  @
  @ // A bit without a channel judges nothing.
  @ predicate ibus_judged(keel_ibus_t *s, integer i) =
  @     0 <= i < (s->config.extended != 0 ? KEEL_IBUS_CHANNELS : KEEL_IBUS_WORDS) &&
  @     ((s->config.judged >> i) & 1) != 0;
  @
  @ // The bytes held are right, but for the first two.
  @ predicate ibus_right(keel_ibus_t *s) =
  @     ibus_sum(&s->framing.byte[0], 30) + ibus_word(s, 14) == 65535 &&
  @     \forall integer i; ibus_judged(s, i) ==> ibus_in_range(s, ibus_field(s, i));
  @
  @ predicate ibus_says{L, M}(keel_ibus_t *s) =
  @     \forall integer i; 0 <= i < KEEL_IBUS_CHANNELS ==>
  @         \at(s->channel[i], M) == ibus_field{L}(s, i);
  @
  @ predicate ibus_kept{L, M}(keel_ibus_t *s) =
  @     \forall integer i; 0 <= i < KEEL_IBUS_CHANNELS ==>
  @         \at(s->channel[i], M) == \at(s->channel[i], L);
  @*/

/*@ requires \valid(ibus) && \valid_read(config) && \separated(ibus, config);
  @ assigns *ibus;
  @ behavior limits:
  @   assumes !(config->lowest <= config->highest <= KEEL_IBUS_CHANNEL_MAX);
  @   assigns \nothing;
  @   ensures IBU_001_limits: \result == KEEL_ERR_LIMITS;
  @ behavior gap:
  @   assumes config->lowest <= config->highest <= KEEL_IBUS_CHANNEL_MAX && config->gap_us == 0;
  @   assigns \nothing;
  @   ensures IBU_001_gap: \result == KEEL_ERR_AGE;
  @ behavior made:
  @   assumes ibus_config(config);
  @   ensures IBU_002_made: \result == KEEL_OK && ibus_valid(ibus) && ibus->framing.held == 0 &&
  @       ibus->framing.gap_us == config->gap_us;
  @   ensures IBU_002_config: ibus->config.gap_us == config->gap_us &&
  @       ibus->config.lowest == config->lowest && ibus->config.highest == config->highest &&
  @       ibus->config.extended == config->extended && ibus->config.judged == config->judged;
  @   ensures IBU_002_none: ibus->age_us == UINT32_MAX && ibus->count.frames == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_ibus_init(keel_ibus_t *ibus, const keel_ibus_config_t *config);

/*@ requires \valid(ibus) && ibus_valid(ibus);
  @ assigns ibus->framing.quiet_us, ibus->framing.gaps, ibus->framing.strays,
  @     ibus->framing.byte[0 .. KEEL_FRAMING_BYTES - 1], ibus->framing.held, ibus->count.frames,
  @     ibus->count.headers, ibus->count.sums, ibus->count.ranges, ibus->age_us,
  @     ibus->channel[0 .. KEEL_IBUS_CHANNELS - 1];
  @ ensures IBU_003_valid: ibus_valid(ibus);
  @ ensures IBU_004_whole: \result ==> \old(ibus->framing.held) == KEEL_IBUS_BYTES - 1 &&
  @     \old(ibus->framing.byte[0]) == KEEL_IBUS_HEADER &&
  @     \old(ibus->framing.byte[1]) == KEEL_IBUS_COMMAND && ibus->framing.held == 0;
  @ ensures IBU_004_sum: \result ==>
  @     \at(ibus_sum(&ibus->framing.byte[0], 30), Pre) + \old(ibus->framing.byte[30]) +
  @     256 * byte == 65535;
  @ ensures IBU_004_range: \result ==> \forall integer i; ibus_judged(ibus, i) ==>
  @     ibus_in_range(ibus, ibus->channel[i]);
  @ ensures IBU_005_fields: \result ==> \forall integer i; 0 <= i < KEEL_IBUS_CHANNELS ==>
  @     ibus->channel[i] == ibus_field{Pre}(ibus, i);
  @ ensures IBU_006_kept: !\result ==> ibus_kept{Pre, Post}(ibus);
  @ ensures IBU_007_frames: ibus->count.frames ==
  @     framing_sum(\old(ibus->count.frames), \result ? 1 : 0);
  @ ensures IBU_008_age: ibus->age_us ==
  @     (\result ? 0 : framing_sum(\old(ibus->age_us), elapsed_us));
  @ ensures IBU_009_gap: framing_late{Pre}(&ibus->framing, elapsed_us) ==>
  @     !\result && ibus->framing.held == (byte == KEEL_IBUS_HEADER ? 1 : 0);
  @ ensures IBU_010_first: !\result && \old(ibus->framing.held) > 0 &&
  @     !framing_late{Pre}(&ibus->framing, elapsed_us) ==>
  @     \let n = \old(ibus->framing.held) + 1 - ibus->framing.held; 0 <= n &&
  @         \forall integer j; 1 <= j < n ==>
  @             (j < \old(ibus->framing.held) ? \at(ibus->framing.byte[j], Pre) : byte) !=
  @                 KEEL_IBUS_HEADER;
  @ ensures IBU_010_shifted: !\result && \old(ibus->framing.held) > 0 &&
  @     !framing_late{Pre}(&ibus->framing, elapsed_us) ==>
  @     \let n = \old(ibus->framing.held) + 1 - ibus->framing.held;
  @         \forall integer j; 0 <= j < ibus->framing.held ==> ibus->framing.byte[j] ==
  @             (n + j < \old(ibus->framing.held) ? \at(ibus->framing.byte[n + j], Pre) : byte);
  @*/
bool keel_ibus_take(keel_ibus_t *ibus, uint8_t byte, uint32_t elapsed_us);

/*@ requires \valid(ibus);
  @ assigns ibus->age_us, ibus->framing.quiet_us;
  @ ensures IBU_008_ages: ibus->age_us == framing_sum(\old(ibus->age_us), elapsed_us);
  @ ensures IBU_008_silence: ibus->framing.quiet_us ==
  @     framing_sum(\old(ibus->framing.quiet_us), elapsed_us);
  @*/
void keel_ibus_pass_time(keel_ibus_t *ibus, uint32_t elapsed_us);

KEEL_C_END

#endif
