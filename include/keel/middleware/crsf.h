/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file crsf.h
 * @brief The pilot's radio: a decoder of CRSF, byte by byte.
 *
 * A frame is a sync byte; a length, of what comes behind it; a type; up to 60 bytes of payload; and
 * a CRC-8 over type and payload: at most 64 bytes. The sync byte is 0xC8, 0x00, or the address of a
 * device: of these, those between a pilot and a flight controller are taken. A receiver sends a
 * frame with 16 channels of 11 bits, the lowest bit first, every 4 to 20 ms, and now and then one
 * with statistics of the radio link, at 416 666 baud (or 420 000) with one stop bit, not inverted.
 * Setting up the port is its driver's affair. Of a frame that is longer than its type needs, as
 * newer senders have, what is known is taken. Frames of other types, and those that are too short,
 * are counted and skipped.
 *
 * A receiver that loses the radio stops sending channels, or goes on with those that it was set to
 * send then; its statistics say a link quality of 0. keel_crsf_is_lost tells both.
 * Channels are scaled as SBUS's are: keel_sbus_us gives the length of a pulse. All counts and times
 * stay at UINT32_MAX.
 */
#ifndef KEEL_MIDDLEWARE_CRSF_H
#define KEEL_MIDDLEWARE_CRSF_H

#include "keel/c_declarations.h"
#include "keel/middleware/crc.h"
#include "keel/middleware/framing.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

#define KEEL_CRSF_CHANNELS 16 /**< Of 11 bits each. */

/** The first byte of a frame: on a serial port, to all, and the addresses of a receiver and of a
 *  transmitter's module. A pilot's radio sends the last to its module. Other devices' addresses are
 *  no beginning, as each more of them makes more of a frame's bytes look like one. */
#define KEEL_CRSF_HEADER          0xC8
#define KEEL_CRSF_HEADER_ALL      0x00
#define KEEL_CRSF_HEADER_RECEIVER 0xEC
#define KEEL_CRSF_HEADER_MODULE   0xEE

#define KEEL_CRSF_LENGTH_MIN 2  /**< The shortest length, of a type and a CRC. */
#define KEEL_CRSF_LENGTH_MAX 62 /**< The longest. */

/** A frame with channels: its type and its least length. */
#define KEEL_CRSF_TYPE_CHANNELS   0x16
#define KEEL_CRSF_LENGTH_CHANNELS 24

/** A frame with statistics of the link: its type and its least length. */
#define KEEL_CRSF_TYPE_LINK   0x14
#define KEEL_CRSF_LENGTH_LINK 12

/** A configuration of a decoder. */
typedef struct keel_crsf_config {
    uint32_t gap_us;      /**< Silence that ends a partial frame when it is longer, in us; more than
                               0. Between a byte's time, 24, and the silence between frames. */
    uint32_t channels_us; /**< Channels that are older mean a lost radio, in us; more than 0. */
    uint32_t link_us;     /**< So do statistics that are older; 0 when none are asked for. */
} keel_crsf_config_t;

/** The last statistics of the link from the pilot. */
typedef struct keel_crsf_link {
    uint8_t rssi[2]; /**< Strength of the signal at each antenna, in -dBm: 90 is -90 dBm. */
    uint8_t quality; /**< Of 100 packets, how many came; 0: none. */
    int8_t snr;      /**< Signal to noise; in dB, or in quarters of it, by the receiver. */
    uint8_t antenna; /**< The antenna in use, 0 or 1. */
    uint8_t mode;    /**< The mode of the radio, by its maker. */
} keel_crsf_link_t;

/** Counts since the start. */
typedef struct keel_crsf_count {
    uint32_t channels; /**< Right frames with channels. */
    uint32_t links;    /**< Right frames with statistics. */
    uint32_t shorts;   /**< Right frames of these types that are too short. */
    uint32_t others;   /**< Right frames of another type. */
    uint32_t lengths;  /**< Headers with no possible length behind them. */
    uint32_t crcs;     /**< Frames refused for their CRC. */
} keel_crsf_count_t;

/** The kind of frame that a byte ended. */
typedef enum keel_crsf_taken {
    KEEL_CRSF_NOTHING = 0,   /**< No right frame. */
    KEEL_CRSF_TOOK_CHANNELS, /**< One with channels. */
    KEEL_CRSF_TOOK_LINK,     /**< One with statistics. */
    KEEL_CRSF_TOOK_SHORT,    /**< One that is skipped: too short for its type. */
    KEEL_CRSF_TOOK_OTHER     /**< One that is skipped: of another type. */
} keel_crsf_taken_t;

/** A decoder. Only the functions below write it; all of it may be read. */
typedef struct keel_crsf {
    keel_crsf_config_t config;            /**< The configuration. */
    keel_framing_t framing;               /**< The bytes held of a frame. */
    keel_crsf_count_t count;              /**< Counts of events. */
    uint32_t channels_age_us;             /**< Since the last channels; UINT32_MAX before. */
    uint32_t link_age_us;                 /**< Since the last statistics; UINT32_MAX before. */
    uint16_t channel[KEEL_CRSF_CHANNELS]; /**< The last, raw, 0 to 2047; 0 before. */
    keel_crsf_link_t link;                /**< The last; all 0 before. */
} keel_crsf_t;

/**
 * Makes a decoder (requirements CRF-001 and CRF-002).
 *
 * @param crsf   the decoder
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_AGE when gap_us or channels_us is 0: then nothing is changed
 */
keel_status_t keel_crsf_init(keel_crsf_t *crsf, const keel_crsf_config_t *config);

/**
 * Takes a byte from the receiver (requirements CRF-003 to CRF-011).
 *
 * @param crsf       the decoder, initialised
 * @param byte       what came
 * @param elapsed_us the time since the byte before, or since keel_crsf_pass_time when that was
 *                   called after it, in us; each microsecond is passed once
 * @return what right frame was taken, if any: it is in crsf->channel or crsf->link then; what no
 *         frame was taken of is as it was
 */
keel_crsf_taken_t keel_crsf_take(keel_crsf_t *crsf, uint8_t byte, uint32_t elapsed_us);

/**
 * Lets time pass in which no byte came (requirement CRF-009), so that both ages are up to date.
 *
 * @param crsf       the decoder, initialised
 * @param elapsed_us the time since the last call for this decoder, in us
 */
void keel_crsf_pass_time(keel_crsf_t *crsf, uint32_t elapsed_us);

/**
 * Whether the radio is lost (requirement CRF-012): channels are older than channels_us; or
 * statistics are asked for, and are older than link_us or say a link quality of 0.
 *
 * @param crsf the decoder, initialised
 * @return true, too, before the first channels
 */
bool keel_crsf_is_lost(const keel_crsf_t *crsf);

/**
 * The CRC of a frame (requirement CRF-013), for who sends one, too.
 *
 * @param bytes its type and what is behind it
 * @param count how many, without the CRC; when it is with it, the result is 0 for a right frame
 * @return the CRC-8 of these bytes, with the polynomial 0xD5, begun with 0
 */
uint8_t keel_crsf_crc(const uint8_t *bytes, uint32_t count);

KEEL_C_END

#endif
