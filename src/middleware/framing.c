/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/framing.h"

#include <stdbool.h>

/*@ requires \valid_read(framing);
  @ assigns \nothing;
  @ ensures \result <==> framing_header(framing, byte);
  @*/
static bool is_header(const keel_framing_t *framing, uint8_t byte)
{
    return (byte == framing->header[0]) || (byte == framing->header[1]) ||
           (byte == framing->header[2]) || (byte == framing->header[3]);
}

void keel_framing_begin(keel_framing_t *framing, uint32_t gap_us, const uint8_t *header)
{
    framing->gap_us = gap_us;
    framing->quiet_us = UINT32_MAX;
    framing->gaps = 0u;
    framing->strays = 0u;
    /*@ loop invariant 0 <= i <= KEEL_FRAMING_BYTES;
      @ loop assigns i, framing->byte[0 .. KEEL_FRAMING_BYTES - 1];
      @ loop variant KEEL_FRAMING_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_FRAMING_BYTES; i++) {
        framing->byte[i] = 0u;
    }
    framing->header[0] = header[0];
    framing->header[1] = header[1];
    framing->header[2] = header[2];
    framing->header[3] = header[3];
    framing->held = 0u;
}

void keel_framing_pass_time(keel_framing_t *framing, uint32_t elapsed_us)
{
    framing->quiet_us = keel_framing_sum(framing->quiet_us, elapsed_us);
}

void keel_framing_take(keel_framing_t *framing, uint8_t byte, uint32_t elapsed_us)
{
    keel_framing_pass_time(framing, elapsed_us);
    if ((framing->held > 0u) && (framing->quiet_us > framing->gap_us)) {
        framing->gaps = keel_framing_sum(framing->gaps, 1u);
        framing->held = 0u;
    }
    framing->quiet_us = 0u;
    if ((framing->held == 0u) && !is_header(framing, byte)) {
        framing->strays = keel_framing_sum(framing->strays, 1u);
    } else {
        framing->byte[framing->held] = byte;
        framing->held++;
    }
}

void keel_framing_drop(keel_framing_t *framing, uint32_t count)
{
    uint32_t from = count;

    /*@ loop invariant count <= from <= framing->held;
      @ loop invariant \forall integer j; count <= j < from ==>
      @     !framing_header(framing, framing->byte[j]);
      @ loop assigns from;
      @ loop variant framing->held - from;
      @*/
    while ((from < framing->held) && !is_header(framing, framing->byte[from])) {
        from++;
    }
    /*@ loop invariant from <= i <= framing->held;
      @ loop invariant from < i ==> framing_header(framing, framing->byte[0]);
      @ loop invariant \forall integer j; from <= j < i ==>
      @     framing->byte[j - from] == \at(framing->byte[j], Pre);
      @ loop invariant \forall integer j; i - from <= j < KEEL_FRAMING_BYTES ==>
      @     framing->byte[j] == \at(framing->byte[j], Pre);
      @ loop assigns i, framing->byte[0 .. KEEL_FRAMING_BYTES - 1];
      @ loop variant framing->held - i;
      @*/
    for (uint32_t i = from; i < framing->held; i++) {
        framing->byte[i - from] = framing->byte[i];
    }
    framing->held = (uint8_t)(framing->held - from);
}
