/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ibus.h
 * @brief The pilot's radio: a decoder of FlySky's IBUS, byte by byte.
 *
 * A frame is 32 bytes: 0x20, 0x40; 14 channels of 16 bits, the low byte first, in us; and a sum:
 * 0xFFFF less the 30 bytes before, the low byte first. A receiver sends one every 7 ms, at 115 200
 * baud with one stop bit, not inverted. Setting up the port is its driver's affair.
 *
 * Some receivers have 18 channels: then a channel has 12 bits, and the upper four of channels 1 to
 * 3 are channel 15, the lowest four bits first, those of 4 to 6 channel 16, 7 to 9 channel 17, and
 * 10 to 12 channel 18. A frame does not say which it is; `extended` does.
 *
 * IBUS has no flag for a lost radio: a receiver that loses it goes on with the last channels, or
 * with those that it was set to send then, or stops. Set it to stop; or to send a throttle below
 * `lowest`, so that its frames are refused: then age_us tells in either case. Some set upper bits
 * of channels instead; when `extended` is not set, those frames are refused, too, when the channel
 * is judged, as it is beyond any range. A frame of 18 channels is refused for the same bits: they
 * are not masked without being asked for, as then a lost radio would look like a pilot.
 *
 * Judge only the sticks: other channels may say anything, as a knob at 150 % does and a channel
 * that the receiver does not have, and whoever uses one takes what is beyond its end as the end.
 *
 * Frames are found by their headers and by gaps: a byte that comes late begins a frame, and when
 * bytes are no right frame, the search goes on at the next of them that may be a header. So a right
 * frame is taken by its last byte, whatever was before, unless some of its bytes and bytes before
 * it were taken as a frame already; after a gap it always is. The sum sees one changed byte, not
 * all changes of two: two that make up for each other are believed.
 *
 * All is integer arithmetic. All counts and times stay at UINT32_MAX.
 */
#ifndef KEEL_MIDDLEWARE_IBUS_H
#define KEEL_MIDDLEWARE_IBUS_H

#include "keel/c_declarations.h"
#include "keel/middleware/framing.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Bytes of a frame. */
#define KEEL_IBUS_BYTES 32

/** Its first two bytes. */
#define KEEL_IBUS_HEADER  0x20
#define KEEL_IBUS_COMMAND 0x40

/** Channels of a frame, and those in the upper bits of them. */
#define KEEL_IBUS_WORDS    14
#define KEEL_IBUS_EXTRAS   4
#define KEEL_IBUS_CHANNELS 18

/** The largest value of a channel that may be configured. */
#define KEEL_IBUS_CHANNEL_MAX 4095

/** A configuration of a decoder. */
typedef struct keel_ibus_config {
    uint32_t gap_us;  /**< Silence that ends a partial frame when it is longer, in us; more than 0.
                           Between a byte's time, 87, and the silence between frames, 4000. */
    uint32_t judged;  /**< The channels whose range is judged: bit i for channel i + 1; 0x0000F is
                           usual, the sticks. */
    uint16_t lowest;  /**< The smallest value of a channel that is judged, in us; 885 is usual. */
    uint16_t highest; /**< The largest, lowest to KEEL_IBUS_CHANNEL_MAX; 2115 is usual. */
    bool extended;    /**< Upper bits are channels 15 to 18. */
} keel_ibus_config_t;

/** Counts since the start. */
typedef struct keel_ibus_count {
    uint32_t frames;  /**< Right frames. */
    uint32_t headers; /**< First bytes of a frame without its second. */
    uint32_t sums;    /**< Frames refused for their sum. */
    uint32_t ranges;  /**< Frames refused for a channel that is judged and out of its range. */
} keel_ibus_count_t;

/** A decoder. Only the functions below write it; all of it may be read. */
typedef struct keel_ibus {
    keel_ibus_config_t config;            /**< The configuration. */
    keel_framing_t framing;               /**< The bytes held of a frame. */
    keel_ibus_count_t count;              /**< Counts of events. */
    uint32_t age_us;                      /**< Since the last right frame; UINT32_MAX before. */
    uint16_t channel[KEEL_IBUS_CHANNELS]; /**< Its channels, in us; 0 before, and where there is
                                               none. */
} keel_ibus_t;

/**
 * Makes a decoder (requirements IBU-001 and IBU-002).
 *
 * @param ibus   the decoder
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_LIMITS when the range is empty or ends above KEEL_IBUS_CHANNEL_MAX;
 *         KEEL_ERR_AGE when gap_us is 0; the first that applies: then nothing is changed
 */
keel_status_t keel_ibus_init(keel_ibus_t *ibus, const keel_ibus_config_t *config);

/**
 * Takes a byte from the receiver (requirements IBU-003 to IBU-010).
 *
 * @param ibus       the decoder, initialised
 * @param byte       what came
 * @param elapsed_us the time since the byte before, or since keel_ibus_pass_time when that was
 *                   called after it, in us; each microsecond is passed once
 * @return whether it ended a right frame: it is in ibus->channel then. Otherwise that is as it was
 */
bool keel_ibus_take(keel_ibus_t *ibus, uint8_t byte, uint32_t elapsed_us);

/**
 * Lets time pass in which no byte came (requirement IBU-008), so that age_us is up to date.
 *
 * @param ibus       the decoder, initialised
 * @param elapsed_us the time since the last call for this decoder, in us
 */
void keel_ibus_pass_time(keel_ibus_t *ibus, uint32_t elapsed_us);

KEEL_C_END

#endif
