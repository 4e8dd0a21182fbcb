/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/ubx.h
 * @brief The contracts of ubx.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_UBX_H
#define KEEL_INTERNAL_MIDDLEWARE_UBX_H

#include "keel/c_declarations.h"
#include "keel/middleware/ubx.h"

KEEL_C_BEGIN

/*@ // Between any two calls: of a payload at least a byte is to come, and at most all of it; a
  @ // fix's has what every NAV-PVT has.
  @ predicate ubx_valid(keel_ubx_t *u) =
  @     u->step <= KEEL_UBX_SUM_B && u->window < 0x1000000000000 && u->left <= u->length &&
  @     (u->step == KEEL_UBX_DATA ==> u->left > 0) &&
  @     (u->kind == KEEL_UBX_PVT ==> u->length >= KEEL_UBX_PAYLOAD_LEAST);
  @
  @ predicate ubx_limits(keel_ubx_config_t *c) = c->accuracy_mm > 0 && c->speed_accuracy > 0;
  @
  @ predicate ubx_config(keel_ubx_config_t *c) =
  @     ubx_limits(c) && c->gap_us > 0 && c->max_age_us > 0;
  @
  @ logic integer ubx_sum(integer a, integer b) =
  @     a + b <= UINT32_MAX ? a + b : UINT32_MAX;
  @
  @ // The last six bytes with one more.
  @ logic integer ubx_shifted(integer window, integer byte) =
  @     window / 256 + 0x10000000000 * byte;
  @
  @ // The length that a header in it tells, and whether it is a NAV-PVT's.
  @ logic integer ubx_length(integer window) = (window / 0x10000) / 0x10000;
  @
  @ predicate ubx_is_pvt(integer window) =
  @     window % 0x10000 == 0x62B5 && (window / 0x10000) % 0x10000 == 0x0701 &&
  @     ubx_length(window) >= KEEL_UBX_PAYLOAD_LEAST;
  @
  @ // Whether a message begins with it, whatever is under way.
  @ predicate ubx_begins(integer window) =
  @     window == KEEL_UBX_HEADER || window == KEEL_UBX_HEADER_14;
  @
  @ // The fix stays as it is.
  @ predicate ubx_kept{L, M}(keel_ubx_t *u) =
  @     \at(u->fix.tow_ms, M) == \at(u->fix.tow_ms, L) &&
  @     \at(u->fix.longitude, M) == \at(u->fix.longitude, L) &&
  @     \at(u->fix.latitude, M) == \at(u->fix.latitude, L) &&
  @     \at(u->fix.height_mm, M) == \at(u->fix.height_mm, L) &&
  @     \at(u->fix.accuracy_mm, M) == \at(u->fix.accuracy_mm, L) &&
  @     \at(u->fix.height_accuracy, M) == \at(u->fix.height_accuracy, L) &&
  @     \at(u->fix.north, M) == \at(u->fix.north, L) &&
  @     \at(u->fix.east, M) == \at(u->fix.east, L) &&
  @     \at(u->fix.down, M) == \at(u->fix.down, L) &&
  @     \at(u->fix.speed_accuracy, M) == \at(u->fix.speed_accuracy, L) &&
  @     \at(u->fix.type, M) == \at(u->fix.type, L) &&
  @     \at(u->fix.satellites, M) == \at(u->fix.satellites, L) &&
  @     \at(u->fix.is_ok, M) == \at(u->fix.is_ok, L) &&
  @     \at(u->fix.is_invalid, M) == \at(u->fix.is_invalid, L);
  @
  @ // The fix becomes what came of the next one.
  @ predicate ubx_published{L, M}(keel_ubx_t *u) =
  @     \at(u->fix.tow_ms, M) == \at(u->pending.tow_ms, L) &&
  @     \at(u->fix.longitude, M) == \at(u->pending.longitude, L) &&
  @     \at(u->fix.latitude, M) == \at(u->pending.latitude, L) &&
  @     \at(u->fix.height_mm, M) == \at(u->pending.height_mm, L) &&
  @     \at(u->fix.accuracy_mm, M) == \at(u->pending.accuracy_mm, L) &&
  @     \at(u->fix.height_accuracy, M) == \at(u->pending.height_accuracy, L) &&
  @     \at(u->fix.north, M) == \at(u->pending.north, L) &&
  @     \at(u->fix.east, M) == \at(u->pending.east, L) &&
  @     \at(u->fix.down, M) == \at(u->pending.down, L) &&
  @     \at(u->fix.speed_accuracy, M) == \at(u->pending.speed_accuracy, L) &&
  @     \at(u->fix.type, M) == \at(u->pending.type, L) &&
  @     \at(u->fix.satellites, M) == \at(u->pending.satellites, L) &&
  @     \at(u->fix.is_ok, M) == \at(u->pending.is_ok, L) &&
  @     \at(u->fix.is_invalid, M) == \at(u->pending.is_invalid, L);
  @
  @ // The second of two times of week is after the first, by less than half a week.
  @ predicate ubx_advances(integer from, integer to) =
  @     from < KEEL_UBX_WEEK_MS && to < KEEL_UBX_WEEK_MS &&
  @     (from < to ? to - from < KEEL_UBX_WEEK_MS / 2 : from - to > KEEL_UBX_WEEK_MS / 2);
  @
  @ // The part of a key that tells its value's length.
  @ logic integer ubx_size(integer key) = (key / 0x10000000) % 8;
  @
  @ // A message with this payload's length is whole but for its payload and checksum.
  @ predicate ubx_begun(keel_ubx_message_t *m, integer group, integer id, integer length) =
  @     m->bytes[0] == 0xB5 && m->bytes[1] == 0x62 && m->bytes[2] == group && m->bytes[3] == id &&
  @     m->bytes[4] == length && m->bytes[5] == 0 && m->size == length + 8;
  @*/

/*@ requires \valid(ubx) && \valid_read(config) && \separated(ubx, config);
  @ assigns *ubx;
  @ behavior limits:
  @   assumes !ubx_limits(config);
  @   assigns \nothing;
  @   ensures UBX_001_limits: \result == KEEL_ERR_LIMITS;
  @ behavior age:
  @   assumes ubx_limits(config) && !ubx_config(config);
  @   assigns \nothing;
  @   ensures UBX_001_age: \result == KEEL_ERR_AGE;
  @ behavior made:
  @   assumes ubx_config(config);
  @   ensures UBX_002_made: \result == KEEL_OK && ubx_valid(ubx) && ubx->step == KEEL_UBX_SEARCH;
  @   ensures UBX_002_config: ubx->config.gap_us == config->gap_us &&
  @       ubx->config.max_age_us == config->max_age_us &&
  @       ubx->config.accuracy_mm == config->accuracy_mm &&
  @       ubx->config.speed_accuracy == config->speed_accuracy;
  @   ensures UBX_002_none: ubx->age_us == UINT32_MAX && ubx->count.fixes == 0 &&
  @       ubx->is_advancing == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_ubx_init(keel_ubx_t *ubx, const keel_ubx_config_t *config);

/*@ requires \valid(ubx) && ubx_valid(ubx);
  @ assigns ubx->fix, ubx->count, ubx->is_advancing, ubx->age_us, ubx->quiet_us, ubx->pending,
  @     ubx->window, ubx->length, ubx->left, ubx->sum_a, ubx->sum_b, ubx->kind, ubx->step;
  @ ensures UBX_003_valid: ubx_valid(ubx);
  @ ensures UBX_004_last: \result ==> \old(ubx->step) == KEEL_UBX_SUM_B &&
  @     \old(ubx->kind) == KEEL_UBX_PVT && byte == \old(ubx->sum_b);
  @ ensures UBX_004_first: ubx->step == KEEL_UBX_SUM_B ==>
  @     \old(ubx->step) == KEEL_UBX_SUM_A && byte == \old(ubx->sum_a);
  @ ensures UBX_005_says: \result ==> ubx_published{Pre, Post}(ubx);
  @ ensures UBX_006_kept: !\result ==> ubx_kept{Pre, Post}(ubx) &&
  @     ubx->is_advancing == \old(ubx->is_advancing);
  @ ensures UBX_007_fixes: ubx->count.fixes ==
  @     (\result ? ubx_sum(\old(ubx->count.fixes), 1) : \old(ubx->count.fixes));
  @ ensures UBX_007_bytes: ubx->count.bytes == ubx_sum(\old(ubx->count.bytes), 1);
  @ ensures UBX_008_age: ubx->age_us ==
  @     (\result ? 0 : ubx_sum(\old(ubx->age_us), elapsed_us));
  @ ensures UBX_008_quiet: ubx->quiet_us == 0;
  @ ensures UBX_009_gap: ubx_sum(\old(ubx->quiet_us), elapsed_us) > ubx->config.gap_us ==>
  @     !\result && ubx->step == KEEL_UBX_SEARCH && ubx->window == 0x10000000000 * byte;
  @ ensures UBX_010_header:
  @     ubx_sum(\old(ubx->quiet_us), elapsed_us) <= ubx->config.gap_us &&
  @     !(\old(ubx->step) == KEEL_UBX_SUM_B && byte == \old(ubx->sum_b)) &&
  @     ubx_shifted(\old(ubx->window), byte) == KEEL_UBX_HEADER ==>
  @         ubx->step == KEEL_UBX_DATA && ubx->kind == KEEL_UBX_PVT &&
  @         ubx->length == KEEL_UBX_PAYLOAD && ubx->left == KEEL_UBX_PAYLOAD &&
  @         ubx->sum_a == 0x64 && ubx->sum_b == 0xD1;
  @ ensures UBX_010_header_14:
  @     ubx_sum(\old(ubx->quiet_us), elapsed_us) <= ubx->config.gap_us &&
  @     !(\old(ubx->step) == KEEL_UBX_SUM_B && byte == \old(ubx->sum_b)) &&
  @     ubx_shifted(\old(ubx->window), byte) == KEEL_UBX_HEADER_14 ==>
  @         ubx->step == KEEL_UBX_DATA && ubx->kind == KEEL_UBX_PVT &&
  @         ubx->length == KEEL_UBX_PAYLOAD_LEAST && ubx->left == KEEL_UBX_PAYLOAD_LEAST &&
  @         ubx->sum_a == 0x5C && ubx->sum_b == 0xC1;
  @ ensures UBX_016_begins:
  @     ubx_sum(\old(ubx->quiet_us), elapsed_us) <= ubx->config.gap_us &&
  @     \old(ubx->step) == KEEL_UBX_SEARCH && ubx_is_pvt(ubx_shifted(\old(ubx->window), byte)) ==>
  @         ubx->step == KEEL_UBX_DATA && ubx->kind == KEEL_UBX_PVT &&
  @         ubx->length == ubx_length(ubx_shifted(\old(ubx->window), byte)) &&
  @         ubx->left == ubx->length;
  @ ensures UBX_011_skipped:
  @     ubx_sum(\old(ubx->quiet_us), elapsed_us) <= ubx->config.gap_us &&
  @     \old(ubx->step) == KEEL_UBX_DATA && !ubx_begins(ubx_shifted(\old(ubx->window), byte)) ==>
  @         ubx->left == \old(ubx->left) - 1 && ubx->length == \old(ubx->length) &&
  @         ubx->step == (ubx->left > 0 ? KEEL_UBX_DATA : KEEL_UBX_SUM_A);
  @ ensures UBX_012_advancing: \result ==> (ubx->is_advancing != 0 <==>
  @     (\old(ubx->count.fixes) > 0 &&
  @      ubx_advances(\old(ubx->fix.tow_ms), \old(ubx->pending.tow_ms))));
  @*/
bool keel_ubx_take(keel_ubx_t *ubx, uint8_t byte, uint32_t elapsed_us);

/*@ requires \valid(ubx);
  @ assigns ubx->age_us, ubx->quiet_us;
  @ ensures UBX_008_ages: ubx->age_us == ubx_sum(\old(ubx->age_us), elapsed_us);
  @ ensures UBX_008_silence: ubx->quiet_us == ubx_sum(\old(ubx->quiet_us), elapsed_us);
  @*/
void keel_ubx_pass_time(keel_ubx_t *ubx, uint32_t elapsed_us);

/*@ requires \valid_read(ubx);
  @ assigns \nothing;
  @ ensures UBX_013_usable: \result == KEEL_UBX_USABLE <==>
  @     (ubx->count.fixes > 0 && ubx->age_us <= ubx->config.max_age_us && ubx->fix.is_ok != 0 &&
  @      ubx->fix.type == KEEL_UBX_3D && ubx->fix.is_invalid == 0 &&
  @      ubx->fix.accuracy_mm <= ubx->config.accuracy_mm &&
  @      ubx->fix.speed_accuracy <= ubx->config.speed_accuracy && ubx->is_advancing != 0);
  @ ensures UBX_013_none: \result == KEEL_UBX_NONE <==> ubx->count.fixes == 0;
  @ ensures UBX_013_old: \result == KEEL_UBX_OLD ==> ubx->age_us > ubx->config.max_age_us;
  @ ensures UBX_013_not_ok: \result == KEEL_UBX_NOT_OK ==> ubx->fix.is_ok == 0;
  @ ensures UBX_013_not_3d: \result == KEEL_UBX_NOT_3D ==> ubx->fix.type != KEEL_UBX_3D;
  @ ensures UBX_013_invalid: \result == KEEL_UBX_INVALID ==> ubx->fix.is_invalid != 0;
  @ ensures UBX_013_wide: \result == KEEL_UBX_WIDE ==>
  @     ubx->fix.accuracy_mm > ubx->config.accuracy_mm;
  @ ensures UBX_013_wide_speed: \result == KEEL_UBX_WIDE_SPEED ==>
  @     ubx->fix.speed_accuracy > ubx->config.speed_accuracy;
  @ ensures UBX_013_stuck: \result == KEEL_UBX_STUCK ==> ubx->is_advancing == 0;
  @*/
keel_ubx_verdict_t keel_ubx_judge(const keel_ubx_t *ubx);

/*@ requires \valid(message);
  @ assigns *message;
  @ behavior length:
  @   assumes !(1 <= ubx_size(key) <= 4);
  @   assigns \nothing;
  @   ensures UBX_014_length: \result == KEEL_ERR_VALUE;
  @ behavior written:
  @   assumes 1 <= ubx_size(key) <= 4;
  @   ensures UBX_014_written: \result == KEEL_OK && ubx_begun(message, 0x06, 0x8A,
  @       ubx_size(key) == 4 ? 12 : (ubx_size(key) == 3 ? 10 : 9));
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_ubx_write_value(keel_ubx_message_t *message, uint32_t key, uint32_t value);

/*@ requires \valid(message);
  @ assigns *message;
  @ ensures UBX_015_begun: ubx_begun(message, 0x06, 0x01, 3);
  @ ensures UBX_015_says: message->bytes[6] == group && message->bytes[7] == id &&
  @     message->bytes[8] == every;
  @*/
void keel_ubx_write_output(keel_ubx_message_t *message, uint8_t group, uint8_t id, uint8_t every);

/*@ requires \valid(message);
  @ assigns *message;
  @ ensures UBX_015_rate: ubx_begun(message, 0x06, 0x08, 6);
  @ ensures UBX_015_period: message->bytes[6] + 256 * message->bytes[7] == period_ms &&
  @     message->bytes[8] == 1 && message->bytes[9] == 0 && message->bytes[10] == 1 &&
  @     message->bytes[11] == 0;
  @*/
void keel_ubx_write_rate(keel_ubx_message_t *message, uint16_t period_ms);

/*@ requires \valid(message);
  @ assigns *message;
  @ ensures UBX_015_port: ubx_begun(message, 0x06, 0x00, 20);
  @*/
void keel_ubx_write_port(keel_ubx_message_t *message, uint32_t baud);

KEEL_C_END

#endif
