/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/framing.h
 * @brief The functions of framing.h, which the kernel alone calls, and their contracts.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_FRAMING_H
#define KEEL_INTERNAL_MIDDLEWARE_FRAMING_H

#include "keel/c_declarations.h"
#include "keel/middleware/framing.h"

KEEL_C_BEGIN

/*@ predicate framing_header(keel_framing_t *f, integer byte) =
  @     byte == f->header[0] || byte == f->header[1] || byte == f->header[2] ||
  @     byte == f->header[3];
  @
  @ // How many are held of a byte that comes first.
  @ logic integer framing_first(keel_framing_t *f, integer byte) =
  @     byte == f->header[0] || byte == f->header[1] || byte == f->header[2] ||
  @     byte == f->header[3] ? 1 : 0;
  @
  @ // The bytes held begin with a header.
  @ predicate framing_begins(keel_framing_t *f) =
  @     f->held <= KEEL_FRAMING_BYTES && (f->held > 0 ==> framing_header(f, f->byte[0]));
  @
  @ // There is room for a byte, too.
  @ predicate framing_valid(keel_framing_t *f) =
  @     framing_begins(f) && f->held < KEEL_FRAMING_BYTES;
  @
  @ // Whether a byte that comes so late drops those before it.
  @ predicate framing_late(keel_framing_t *f, integer elapsed_us) =
  @     framing_sum(f->quiet_us, elapsed_us) > f->gap_us;
  @*/

/**
 * Begins with nothing held, as if no byte had come for ever (requirement FRG-002).
 *
 * @param framing what is begun
 * @param gap_us  silence that drops what is held when it is longer, in us
 * @param header  what a frame may begin with, KEEL_FRAMING_HEADERS bytes; copied
 */
/*@ requires \valid(framing) && \valid_read(header + (0 .. KEEL_FRAMING_HEADERS - 1)) &&
  @     \separated(framing, header + (0 .. KEEL_FRAMING_HEADERS - 1));
  @ assigns *framing;
  @ ensures FRG_002_begun: framing_valid(framing) && framing->held == 0 &&
  @     framing->gap_us == gap_us && framing->quiet_us == UINT32_MAX &&
  @     framing->gaps == 0 && framing->strays == 0;
  @ ensures FRG_002_headers: framing->header[0] == \old(header[0]) &&
  @     framing->header[1] == \old(header[1]) && framing->header[2] == \old(header[2]) &&
  @     framing->header[3] == \old(header[3]);
  @*/
void keel_framing_begin(keel_framing_t *framing, uint32_t gap_us, const uint8_t *header);

/**
 * Lets time pass in which no byte came (requirement FRG-003).
 *
 * @param framing    begun
 * @param elapsed_us the time since the last call, in us
 */
/*@ requires \valid(framing);
  @ assigns framing->quiet_us;
  @ ensures FRG_003_quiet: framing->quiet_us == framing_sum(\old(framing->quiet_us), elapsed_us);
  @*/
void keel_framing_pass_time(keel_framing_t *framing, uint32_t elapsed_us);

/**
 * Takes a byte (requirements FRG-003 to FRG-005): drops what is held when the byte comes late, and
 * holds it, unless nothing is held and it is no header.
 *
 * @param framing    begun, fewer than KEEL_FRAMING_BYTES held
 * @param byte       what came
 * @param elapsed_us the time since the last call, in us
 */
/*@ requires \valid(framing) && framing_valid(framing);
  @ assigns framing->quiet_us, framing->gaps, framing->strays,
  @     framing->byte[0 .. KEEL_FRAMING_BYTES - 1], framing->held;
  @ ensures FRG_003_now: framing->quiet_us == 0;
  @ ensures FRG_004_late: framing_late{Pre}(framing, elapsed_us) ==>
  @     framing->held == framing_first(framing, byte) &&
  @     framing->gaps == framing_sum(\old(framing->gaps), \old(framing->held) > 0 ? 1 : 0);
  @ ensures FRG_005_begins: framing_begins(framing);
  @ ensures FRG_005_adds: !framing_late{Pre}(framing, elapsed_us) ==>
  @     framing->held == \old(framing->held) +
  @         (\old(framing->held) == 0 ? framing_first(framing, byte) : 1) &&
  @     framing->gaps == \old(framing->gaps);
  @ ensures FRG_005_byte: framing->held > 0 ==> framing->byte[framing->held - 1] == byte;
  @ ensures FRG_005_others: \forall integer j; 0 <= j < framing->held - 1 ==>
  @     framing->byte[j] == \old(framing->byte[j]);
  @ ensures FRG_005_strays: framing->strays ==
  @     framing_sum(\old(framing->strays), framing->held == 0 ? 1 : 0);
  @*/
void keel_framing_take(keel_framing_t *framing, uint8_t byte, uint32_t elapsed_us);

/**
 * Drops bytes from the beginning, and those behind them up to the next header (requirement
 * FRG-006).
 *
 * @param framing begun
 * @param count   how many at least, 1 to those that are held
 */
/*@ requires \valid(framing) && 1 <= count <= framing->held <= KEEL_FRAMING_BYTES;
  @ assigns framing->byte[0 .. KEEL_FRAMING_BYTES - 1], framing->held;
  @ ensures FRG_006_valid: framing_valid(framing);
  @ ensures FRG_006_first: \let n = \old(framing->held) - framing->held; count <= n &&
  @     \forall integer j; count <= j < n ==>
  @         !framing_header(framing, \at(framing->byte[j], Pre));
  @ ensures FRG_006_shifted: \let n = \old(framing->held) - framing->held;
  @     \forall integer j; 0 <= j < framing->held ==>
  @         framing->byte[j] == \at(framing->byte[n + j], Pre);
  @ ensures FRG_006_rest: \forall integer j; framing->held <= j < KEEL_FRAMING_BYTES ==>
  @     framing->byte[j] == \at(framing->byte[j], Pre);
  @*/
void keel_framing_drop(keel_framing_t *framing, uint32_t count);

KEEL_C_END

#endif
