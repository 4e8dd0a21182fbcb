/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sbus.h
 * @brief The pilot's radio: a decoder of SBUS, byte by byte.
 *
 * A frame is 25 bytes: the header 0x0F; 22 bytes with 16 channels of 11 bits, the lowest bit first;
 * a byte of flags, whose upper half is 0; a footer, 0x00. SBUS2's footers, 0x04, 0x14, 0x24 and
 * 0x34, say which quarter of its telemetry comes behind the frame. A receiver sends a frame every 6
 * to 14 ms, in 3 ms, at 100 000 baud with even parity and two stop bits, inverted. Setting up the
 * port and dropping bytes whose parity is wrong is its driver's affair.
 *
 * Frames are found by their headers: a byte that comes late begins a frame, and when 25 bytes are
 * no right frame, the search goes on at the next of them that may be a header. So a right frame is
 * taken by its last byte, whatever was before, unless some of its bytes and bytes before it were
 * taken as a frame already; after a gap it always is.
 *
 * SBUS has no checksum. A frame with a wrong bit in a channel is taken, and without gaps bytes of
 * channels can look like a frame, over and over while no channel moves. So a driver that hands
 * bytes over in batches must tell the gaps, and whoever acts on a channel (arms, kills) asks for
 * several frames that say the same.
 *
 * A range is all that tells a stick without pulses: some receivers send zeros when they lose the
 * radio. So a frame is refused when a channel that is judged is out of its range. Judge the sticks
 * alone: other channels may say anything, as a knob at 110 % does and a channel that the receiver
 * does not have, and whoever uses one takes what is beyond its end as the end.
 *
 * A receiver that loses the radio goes on sending frames, with the channels that it was set to
 * send then: frame.lost and frame.failsafe tell so, not age_us.
 *
 * All is integer arithmetic. All counts and times stay at UINT32_MAX.
 */
#ifndef KEEL_MIDDLEWARE_SBUS_H
#define KEEL_MIDDLEWARE_SBUS_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Bytes of a frame. */
#define KEEL_SBUS_BYTES 25

/** Channels of 11 bits. */
#define KEEL_SBUS_CHANNELS 16

/** The largest value of a channel. */
#define KEEL_SBUS_CHANNEL_MAX 2047

/** The first byte of a frame. */
#define KEEL_SBUS_HEADER 0x0F

/** The bounds of what keel_sbus_us gives, in us. */
#define KEEL_SBUS_US_MIN 880
#define KEEL_SBUS_US_MAX 2159

/** A configuration of a decoder. */
typedef struct keel_sbus_config {
    uint32_t gap_us;  /**< Silence that ends a partial frame when it is longer, in us; more than 0.
                           Between a byte's time, 120, and the silence between frames, 3000. */
    uint16_t lowest;  /**< The smallest value of a channel that is judged; 8 is usual, 885 us. */
    uint16_t highest; /**< The largest, lowest to KEEL_SBUS_CHANNEL_MAX; 1976 is usual, 2115 us. */
    uint16_t judged;  /**< The channels that are: bit i for channel i + 1; 0x000F is usual, the
                           sticks. */
} keel_sbus_config_t;

/** The contents of a frame. */
typedef struct keel_sbus_frame {
    uint16_t channel[KEEL_SBUS_CHANNELS]; /**< Raw; keel_sbus_us scales it. */
    bool digital_17;                      /**< Channel 17. */
    bool digital_18;                      /**< Channel 18. */
    bool lost;                            /**< The receiver missed a frame from the pilot. */
    bool failsafe;                        /**< It has lost the pilot: channels are made up. */
} keel_sbus_frame_t;

/** Counts since the start. */
typedef struct keel_sbus_count {
    uint32_t frames;  /**< Right frames. */
    uint32_t headers; /**< Bytes that were no header where a frame should begin. */
    uint32_t footers; /**< Frames refused for their last byte. */
    uint32_t flags;   /**< Frames refused for a flag that there is none of. */
    uint32_t ranges;  /**< Frames refused for a channel that is judged and out of its range. */
    uint32_t gaps;    /**< Partial frames that a gap ended. */
} keel_sbus_count_t;

/** A decoder. Only the functions below write it; all of it may be read. */
typedef struct keel_sbus {
    keel_sbus_config_t config;       /**< The configuration. */
    keel_sbus_frame_t frame;         /**< The last right frame; all 0 and failsafe before. */
    keel_sbus_count_t count;         /**< Counts of events. */
    uint32_t age_us;                 /**< Since the last right frame, in us; UINT32_MAX before. */
    uint32_t quiet_us;               /**< Since the last byte, in us. */
    uint8_t buffer[KEEL_SBUS_BYTES]; /**< A partial frame, and behind it what was before. */
    uint8_t held;                    /**< Its bytes, fewer than KEEL_SBUS_BYTES. */
} keel_sbus_t;

/**
 * Makes a decoder (requirements RAD-001 and RAD-002).
 *
 * @param sbus   the decoder
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_LIMITS when the range is empty or ends above KEEL_SBUS_CHANNEL_MAX;
 *         KEEL_ERR_AGE when gap_us is 0; the first that applies: then nothing is changed
 */
keel_status_t keel_sbus_init(keel_sbus_t *sbus, const keel_sbus_config_t *config);

/**
 * Takes a byte from the receiver (requirements RAD-003 to RAD-011).
 *
 * @param sbus       the decoder, initialised
 * @param byte       what came
 * @param elapsed_us the time since the byte before, or since keel_sbus_pass_time when that was
 *                   called after it, in us; each microsecond is passed once
 * @return whether it ended a right frame: it is in sbus->frame then. Otherwise that is as it was
 */
bool keel_sbus_take(keel_sbus_t *sbus, uint8_t byte, uint32_t elapsed_us);

/**
 * Lets time pass in which no byte came (requirement RAD-008), so that age_us is up to date.
 *
 * @param sbus       the decoder, initialised
 * @param elapsed_us the time since the last call for this decoder, in us
 */
void keel_sbus_pass_time(keel_sbus_t *sbus, uint32_t elapsed_us);

/**
 * A channel as the length of a servo's pulse (requirement RAD-012): 0.625 us a step, so that 172 is
 * 988 us, 992 is 1500 us and 1811 is 2012 us; rounded to the nearest, halves up.
 *
 * @param raw a channel; what is above KEEL_SBUS_CHANNEL_MAX counts as that
 * @return KEEL_SBUS_US_MIN to KEEL_SBUS_US_MAX, in us
 */
uint16_t keel_sbus_us(uint16_t raw);

KEEL_C_END

#endif
