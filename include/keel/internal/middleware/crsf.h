/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/crsf.h
 * @brief The contracts of crsf.h, as the provers read them.
 *
 * Gaps and headers show where a frame begins. A byte that comes late begins a frame; and what
 * can be no frame, by its length or its CRC, is searched for the next byte that may be a header. So
 * - a right frame that begins after a gap, or with nothing held, is taken by its last byte,
 *   whatever was before, when no gap is within it;
 * - without any gap, a right frame is taken by the 126th byte behind its first at the latest,
 *   whatever was before, unless some of its bytes were taken as another frame, whose CRC was right.
 *   A gap before then drops it, so that nothing old delays the frame behind the gap.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_CRSF_H
#define KEEL_INTERNAL_MIDDLEWARE_CRSF_H

#include "keel/c_declarations.h"
#include "keel/internal/middleware/crc.h"
#include "keel/internal/middleware/framing.h"
#include "keel/middleware/crsf.h"

KEEL_C_BEGIN

/*@ predicate crsf_header(integer byte) =
  @     byte == KEEL_CRSF_HEADER || byte == KEEL_CRSF_HEADER_ALL ||
  @     byte == KEEL_CRSF_HEADER_RECEIVER || byte == KEEL_CRSF_HEADER_MODULE;
  @
  @ // How many are held of a byte that comes first.
  @ logic integer crsf_first(integer byte) =
  @     byte == KEEL_CRSF_HEADER || byte == KEEL_CRSF_HEADER_ALL ||
  @     byte == KEEL_CRSF_HEADER_RECEIVER || byte == KEEL_CRSF_HEADER_MODULE ? 1 : 0;
  @
  @ // A frame begins as it was made.
  @ predicate crsf_headers(keel_crsf_t *s) =
  @     s->framing.header[0] == KEEL_CRSF_HEADER &&
  @     s->framing.header[1] == KEEL_CRSF_HEADER_ALL &&
  @     s->framing.header[2] == KEEL_CRSF_HEADER_RECEIVER &&
  @     s->framing.header[3] == KEEL_CRSF_HEADER_MODULE;
  @
  @ // Between any two calls: a partial frame begins with a header.
  @ predicate crsf_valid(keel_crsf_t *s) = framing_valid(&s->framing) && crsf_headers(s);
  @
  @ // The CRC of so many bytes, each taken into that of those before it.
  @ logic integer crsf_crc{L}(uint8_t *bytes, integer count) =
  @     count <= 0 ? KEEL_CRC8_FIRST :
  @         (crc_up(crsf_crc(bytes, count - 1) ^ bytes[count - 1], 8) & 0xFF);
  @
  @ // The bytes held, and behind them a byte that came.
  @ logic integer crsf_came(keel_crsf_t *s, integer byte, integer j) =
  @     j < s->framing.held ? s->framing.byte[j] : byte;
  @
  @ // The three of these bytes from this one on, the lowest first.
  @ logic integer crsf_window(keel_crsf_t *s, integer byte, integer first) =
  @     crsf_came(s, byte, first) + 256 * crsf_came(s, byte, first + 1) +
  @     65536 * crsf_came(s, byte, first + 2);
  @
  @ // Bits 11 i to 11 i + 10 of those behind header, length and type.
  @ logic integer crsf_field(keel_crsf_t *s, integer byte, integer i) =
  @     (crsf_window(s, byte, 3 + (11 * i) / 8) >> ((11 * i) % 8)) & 2047;
  @
  @ // The kind of a frame of this type and length.
  @ logic integer crsf_kind(integer type, integer length) =
  @     type == KEEL_CRSF_TYPE_CHANNELS ?
  @         (length >= KEEL_CRSF_LENGTH_CHANNELS ? (integer)KEEL_CRSF_TOOK_CHANNELS
  @                                              : (integer)KEEL_CRSF_TOOK_SHORT) :
  @     type == KEEL_CRSF_TYPE_LINK ?
  @         (length >= KEEL_CRSF_LENGTH_LINK ? (integer)KEEL_CRSF_TOOK_LINK
  @                                          : (integer)KEEL_CRSF_TOOK_SHORT) :
  @         (integer)KEEL_CRSF_TOOK_OTHER;
  @
  @ predicate crsf_channels_say{L, M}(keel_crsf_t *s, integer byte) =
  @     \forall integer i; 0 <= i < KEEL_CRSF_CHANNELS ==>
  @         \at(s->channel[i], M) == crsf_field{L}(s, byte, i);
  @
  @ predicate crsf_link_says{L, M}(keel_crsf_t *s, integer byte) =
  @     \at(s->link.rssi[0], M) == crsf_came{L}(s, byte, 3) &&
  @     \at(s->link.rssi[1], M) == crsf_came{L}(s, byte, 4) &&
  @     \at(s->link.quality, M) == crsf_came{L}(s, byte, 5) &&
  @     \at(s->link.snr, M) ==
  @         (crsf_came{L}(s, byte, 6) < 128 ? crsf_came{L}(s, byte, 6)
  @                                         : crsf_came{L}(s, byte, 6) - 256) &&
  @     \at(s->link.antenna, M) == crsf_came{L}(s, byte, 7) &&
  @     \at(s->link.mode, M) == crsf_came{L}(s, byte, 8);
  @
  @ // Bytes were dropped from the beginning, or none; behind the first of them no header.
  @ predicate crsf_dropped{L, M}(keel_crsf_t *s) =
  @     \let n = \at(s->framing.held, L) - \at(s->framing.held, M);
  @         0 <= n &&
  @         (\forall integer j; 1 <= j < n ==> !crsf_header(\at(s->framing.byte[j], L))) &&
  @         (\forall integer j; 0 <= j < \at(s->framing.held, M) ==>
  @             \at(s->framing.byte[j], M) == \at(s->framing.byte[n + j], L));
  @
  @ predicate crsf_channels_kept{L, M}(keel_crsf_t *s) =
  @     \forall integer i; 0 <= i < KEEL_CRSF_CHANNELS ==>
  @         \at(s->channel[i], M) == \at(s->channel[i], L);
  @
  @ predicate crsf_link_kept{L, M}(keel_crsf_t *s) =
  @     \at(s->link.rssi[0], M) == \at(s->link.rssi[0], L) &&
  @     \at(s->link.rssi[1], M) == \at(s->link.rssi[1], L) &&
  @     \at(s->link.quality, M) == \at(s->link.quality, L) &&
  @     \at(s->link.snr, M) == \at(s->link.snr, L) &&
  @     \at(s->link.antenna, M) == \at(s->link.antenna, L) &&
  @     \at(s->link.mode, M) == \at(s->link.mode, L);
  @*/

/*@ requires \valid(crsf) && \valid_read(config) && \separated(crsf, config);
  @ assigns *crsf;
  @ behavior age:
  @   assumes config->gap_us == 0 || config->channels_us == 0;
  @   assigns \nothing;
  @   ensures CRF_001_age: \result == KEEL_ERR_AGE;
  @ behavior made:
  @   assumes config->gap_us > 0 && config->channels_us > 0;
  @   ensures CRF_002_made: \result == KEEL_OK && crsf_valid(crsf) && crsf->framing.held == 0 &&
  @       crsf->framing.gap_us == config->gap_us;
  @   ensures CRF_002_config: crsf->config.gap_us == config->gap_us &&
  @       crsf->config.channels_us == config->channels_us &&
  @       crsf->config.link_us == config->link_us;
  @   ensures CRF_002_none: crsf->channels_age_us == UINT32_MAX &&
  @       crsf->link_age_us == UINT32_MAX && crsf->link.quality == 0 &&
  @       crsf->count.channels == 0 && crsf->count.links == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_crsf_init(keel_crsf_t *crsf, const keel_crsf_config_t *config);

/*@ requires \valid(crsf) && crsf_valid(crsf);
  @ assigns crsf->framing.quiet_us, crsf->framing.gaps, crsf->framing.strays,
  @     crsf->framing.byte[0 .. KEEL_FRAMING_BYTES - 1], crsf->framing.held,
  @     crsf->count.channels, crsf->count.links, crsf->count.shorts, crsf->count.others,
  @     crsf->count.lengths, crsf->count.crcs, crsf->channels_age_us, crsf->link_age_us,
  @     crsf->channel[0 .. KEEL_CRSF_CHANNELS - 1], crsf->link.rssi[0 .. 1], crsf->link.quality,
  @     crsf->link.snr, crsf->link.antenna, crsf->link.mode;
  @ ensures CRF_003_valid: crsf_valid(crsf);
  @ ensures CRF_004_whole: \result != KEEL_CRSF_NOTHING ==>
  @     \let length = crsf_came{Pre}(crsf, byte, 1);
  @         KEEL_CRSF_LENGTH_MIN <= length <= KEEL_CRSF_LENGTH_MAX &&
  @         length + 2 <= \old(crsf->framing.held) + 1;
  @ ensures CRF_004_kind: \result != KEEL_CRSF_NOTHING ==>
  @     \result == crsf_kind(crsf_came{Pre}(crsf, byte, 2), crsf_came{Pre}(crsf, byte, 1));
  @ ensures CRF_005_fields: \result == KEEL_CRSF_TOOK_CHANNELS ==>
  @     crsf_channels_say{Pre, Post}(crsf, byte);
  @ ensures CRF_006_link: \result == KEEL_CRSF_TOOK_LINK ==>
  @     crsf_link_says{Pre, Post}(crsf, byte);
  @ ensures CRF_007_channels: \result != KEEL_CRSF_TOOK_CHANNELS ==>
  @     crsf_channels_kept{Pre, Post}(crsf);
  @ ensures CRF_007_link: \result != KEEL_CRSF_TOOK_LINK ==> crsf_link_kept{Pre, Post}(crsf);
  @ ensures CRF_008_channels: crsf->count.channels ==
  @     framing_sum(\old(crsf->count.channels), \result == KEEL_CRSF_TOOK_CHANNELS ? 1 : 0);
  @ ensures CRF_008_links: crsf->count.links ==
  @     framing_sum(\old(crsf->count.links), \result == KEEL_CRSF_TOOK_LINK ? 1 : 0);
  @ ensures CRF_008_shorts: crsf->count.shorts ==
  @     framing_sum(\old(crsf->count.shorts), \result == KEEL_CRSF_TOOK_SHORT ? 1 : 0);
  @ ensures CRF_008_others: crsf->count.others ==
  @     framing_sum(\old(crsf->count.others), \result == KEEL_CRSF_TOOK_OTHER ? 1 : 0);
  @ ensures CRF_009_channels: crsf->channels_age_us ==
  @     (\result == KEEL_CRSF_TOOK_CHANNELS ?
  @         0 : framing_sum(\old(crsf->channels_age_us), elapsed_us));
  @ ensures CRF_009_link: crsf->link_age_us ==
  @     (\result == KEEL_CRSF_TOOK_LINK ? 0 : framing_sum(\old(crsf->link_age_us), elapsed_us));
  @ ensures CRF_010_gap: framing_late{Pre}(&crsf->framing, elapsed_us) ==>
  @     \result == KEEL_CRSF_NOTHING &&
  @     crsf->framing.held == crsf_first(byte);
  @ ensures CRF_011_first: \result == KEEL_CRSF_NOTHING && \old(crsf->framing.held) > 0 &&
  @     !framing_late{Pre}(&crsf->framing, elapsed_us) ==>
  @     \let n = \old(crsf->framing.held) + 1 - crsf->framing.held; 0 <= n &&
  @         \forall integer j; 1 <= j < n ==> !crsf_header(crsf_came{Pre}(crsf, byte, j));
  @ ensures CRF_011_shifted: \result == KEEL_CRSF_NOTHING && \old(crsf->framing.held) > 0 &&
  @     !framing_late{Pre}(&crsf->framing, elapsed_us) ==>
  @     \let n = \old(crsf->framing.held) + 1 - crsf->framing.held;
  @         \forall integer j; 0 <= j < crsf->framing.held ==>
  @             crsf->framing.byte[j] == crsf_came{Pre}(crsf, byte, n + j);
  @*/
keel_crsf_taken_t keel_crsf_take(keel_crsf_t *crsf, uint8_t byte, uint32_t elapsed_us);

/*@ requires \valid(crsf);
  @ assigns crsf->channels_age_us, crsf->link_age_us, crsf->framing.quiet_us;
  @ ensures CRF_009_ages: crsf->channels_age_us ==
  @         framing_sum(\old(crsf->channels_age_us), elapsed_us) &&
  @     crsf->link_age_us == framing_sum(\old(crsf->link_age_us), elapsed_us);
  @ ensures CRF_009_silence: crsf->framing.quiet_us ==
  @     framing_sum(\old(crsf->framing.quiet_us), elapsed_us);
  @*/
void keel_crsf_pass_time(keel_crsf_t *crsf, uint32_t elapsed_us);

/*@ requires \valid_read(crsf);
  @ assigns \nothing;
  @ ensures CRF_012_lost: \result <==>
  @     crsf->channels_age_us > crsf->config.channels_us ||
  @     (crsf->config.link_us > 0 &&
  @         (crsf->link_age_us > crsf->config.link_us || crsf->link.quality == 0));
  @*/
bool keel_crsf_is_lost(const keel_crsf_t *crsf);

/*@ requires \valid_read(bytes + (0 .. count - 1)) && count <= KEEL_CRSF_LENGTH_MAX;
  @ assigns \nothing;
  @ ensures CRF_013_crc: \result == crsf_crc(bytes, count);
  @*/
uint8_t keel_crsf_crc(const uint8_t *bytes, uint32_t count);

KEEL_C_END

#endif
