/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file framing.h
 * @brief Where frames begin among the bytes of a port: what decoders of a radio's bytes share.
 *
 * A frame begins with a header byte, one of up to KEEL_FRAMING_HEADERS. Bytes are held from a
 * header on, up to KEEL_FRAMING_BYTES of them; a byte that comes late drops those before it and
 * starts again. The decoder looks at what is held after each byte: what is a frame, or cannot be
 * one, it drops, and what is held then begins at the next header behind it. So no byte is thrown
 * away that may begin a frame.
 *
 * All counts and times stay at UINT32_MAX.
 */
#ifndef KEEL_MIDDLEWARE_FRAMING_H
#define KEEL_MIDDLEWARE_FRAMING_H

#include "keel/c_declarations.h"

#include <stdint.h>

KEEL_C_BEGIN

/** The most bytes that are held: those of the longest frame. */
#define KEEL_FRAMING_BYTES 64

/** How many bytes may be headers; where fewer are, one of them stands again. */
#define KEEL_FRAMING_HEADERS 4

/** The bytes of a port from a header on. A decoder writes it; all of it may be read. */
typedef struct keel_framing {
    uint32_t gap_us;                  /**< Silence that drops what is held, when it is longer. */
    uint32_t quiet_us;                /**< Since the last byte, in us. */
    uint32_t gaps;                    /**< How often a gap dropped something. */
    uint32_t strays;                  /**< Bytes that were no header, with nothing held. */
    uint8_t byte[KEEL_FRAMING_BYTES]; /**< Those held, and behind them what was before. */
    uint8_t held;                     /**< How many are held. */
    uint8_t header[KEEL_FRAMING_HEADERS]; /**< The bytes that may begin a frame. */
} keel_framing_t;

/*@ logic integer framing_sum(integer a, integer b) =
  @     a + b <= UINT32_MAX ? a + b : UINT32_MAX;
  @*/

/**
 * A sum that stays at its end (requirement FRG-001): of times, and of counts.
 *
 * @param a any
 * @param b any
 * @return a + b, or UINT32_MAX when that is less
 */
/*@ assigns \nothing;
  @ ensures FRG_001_sum: \result == framing_sum(a, b);
  @*/
static inline uint32_t keel_framing_sum(uint32_t a, uint32_t b)
{
    return (a <= (UINT32_MAX - b)) ? (a + b) : UINT32_MAX;
}

KEEL_C_END

#endif
