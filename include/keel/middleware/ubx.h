/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ubx.h
 * @brief The satellite receiver: a decoder of UBX, byte by byte, and what sets a receiver up.
 *
 * A message is 0xB5 0x62, its class, its id, the length of its payload in two bytes, the payload,
 * and two bytes of checksum (Fletcher-8) over all but the first two; numbers have their lowest byte
 * first. NAV-PVT (0x01 0x07) is a fix, and is decoded; ACK-ACK and ACK-NAK, the answers to what
 * sets a receiver up, are counted, and so are all others, of any length. No payload is held: a
 * field of a fix is put together from its bytes as they come.
 *
 * NAV-PVT has 84 bytes from an u-blox 7 (protocol 14), and 92 from later receivers. Both are taken,
 * and longer ones too, by the part that is known here; shorter ones are other messages.
 *
 * The six bytes that a NAV-PVT of 84 or 92 bytes begins with begin one wherever they come, in the
 * midst of another message too. So a right one is taken by its last byte, whatever was before,
 * unless a right message ends in its first five bytes, or such six come in it again: one in 2^40
 * does by chance, and the next one is taken. After a gap the former cannot be. One of another
 * length begins where no message is under way, so it is taken after a gap. Bytes that look like the
 * header of another message hide others for its length, 65535 bytes at most, or until a gap or a
 * NAV-PVT of 84 or 92 bytes.
 *
 * A message with a wrong checksum changes no fix; it is counted. The checksum finds all changes of
 * one byte, and lets one in 65536 of others through.
 *
 * All is integer arithmetic. All counts and times stay at UINT32_MAX.
 */
#ifndef KEEL_MIDDLEWARE_UBX_H
#define KEEL_MIDDLEWARE_UBX_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Bytes of a NAV-PVT's payload from protocol 15 on, and of all of it. */
#define KEEL_UBX_PAYLOAD 92
#define KEEL_UBX_BYTES   100

/** Bytes of its payload in protocol 14: the least that it has. */
#define KEEL_UBX_PAYLOAD_LEAST 84

/** The beginning of a NAV-PVT, the first byte the lowest. */
#define KEEL_UBX_HEADER 0x005C070162B5

/** The beginning of one of protocol 14. */
#define KEEL_UBX_HEADER_14 0x0054070162B5

/** A fix in three dimensions, in keel_ubx_fix_t. */
#define KEEL_UBX_3D 3

/** Milliseconds of a week: its time of week is less. */
#define KEEL_UBX_WEEK_MS 604800000

/** @name The part that a decoder waits for. */
/** @{ */
#define KEEL_UBX_SEARCH 0 /**< A message. */
#define KEEL_UBX_DATA   1 /**< A byte of its payload. */
#define KEEL_UBX_SUM_A  2 /**< The first byte of its checksum. */
#define KEEL_UBX_SUM_B  3 /**< The second. */
/** @} */

/** @name The messages. */
/** @{ */
#define KEEL_UBX_OTHER 0 /**< None of those below. */
#define KEEL_UBX_PVT   1 /**< NAV-PVT. */
#define KEEL_UBX_ACK   2 /**< ACK-ACK. */
#define KEEL_UBX_NAK   3 /**< ACK-NAK. */
/** @} */

/** A configuration of a decoder. */
typedef struct keel_ubx_config {
    uint32_t gap_us; /**< Silence that ends a message when it is longer, in us; more than 0. Above a
                          byte's time and what a driver adds, below the silence between bursts:
                          20000 is usual at 10 Hz. */
    uint32_t max_age_us;     /**< The oldest fix that is usable, in us; more than 0. */
    uint32_t accuracy_mm;    /**< The worst usable accuracy of the place, in mm; more than 0. */
    uint32_t speed_accuracy; /**< The worst usable accuracy of the speed, in mm/s; more than 0. */
} keel_ubx_config_t;

/** The contents of a NAV-PVT; all 0 before the first. */
typedef struct keel_ubx_fix {
    uint32_t tow_ms;          /**< Time of week (GPS), in ms. */
    int32_t longitude;        /**< In 1e-7 degrees, east is positive. */
    int32_t latitude;         /**< In 1e-7 degrees, north is positive. */
    int32_t height_mm;        /**< Above mean sea level, in mm. */
    uint32_t accuracy_mm;     /**< Estimated, of the place, horizontally, in mm. */
    uint32_t height_accuracy; /**< Estimated, of the height, in mm. */
    int32_t north;            /**< Velocity, in mm/s. */
    int32_t east;             /**< Velocity, in mm/s. */
    int32_t down;             /**< Velocity, in mm/s. */
    uint32_t speed_accuracy;  /**< Estimated, in mm/s. */
    uint8_t type;             /**< KEEL_UBX_3D, or what the receiver's manual says. */
    uint8_t satellites;       /**< Used. */
    bool is_ok;               /**< Within the receiver's own limits (gnssFixOK). */
    bool is_invalid; /**< Longitude, latitude and height are not to be used (invalidLlh); false of
                          fewer than 92 bytes, which have no such bit. */
} keel_ubx_fix_t;

/** Counts since the start. */
typedef struct keel_ubx_count {
    uint32_t bytes;     /**< All that came. */
    uint32_t fixes;     /**< Right NAV-PVT of at least 84 bytes. */
    uint32_t acks;      /**< Right ACK-ACK: the receiver has done what was asked. */
    uint32_t naks;      /**< Right ACK-NAK: it has refused to. */
    uint32_t others;    /**< Other right messages. */
    uint32_t checksums; /**< Messages with a wrong checksum. */
    uint32_t cut;       /**< Messages that ended too soon: a gap, or a NAV-PVT began. */
} keel_ubx_count_t;

/** A decoder. Only the functions below write it; all of it may be read. */
typedef struct keel_ubx {
    keel_ubx_config_t config; /**< The configuration. */
    keel_ubx_fix_t fix;       /**< The last right NAV-PVT. */
    keel_ubx_count_t count;   /**< Counts of events. */
    bool is_advancing;        /**< Whether the time of week advanced with the last. */
    uint32_t age_us;          /**< Since the last right NAV-PVT, in us; UINT32_MAX before. */
    uint32_t quiet_us;        /**< Since the last byte, in us. */
    keel_ubx_fix_t pending;   /**< The next one, as far as it came. */
    uint64_t window;          /**< The last six bytes, the latest the highest; 0 for none. */
    uint16_t length;          /**< Bytes of the payload. */
    uint16_t left;            /**< How many of them are to come. */
    uint8_t sum_a;            /**< The checksum so far. */
    uint8_t sum_b;            /**< The checksum so far. */
    uint8_t kind;             /**< KEEL_UBX_OTHER, ...: the message under way. */
    uint8_t step;             /**< KEEL_UBX_SEARCH, ... */
} keel_ubx_t;

/** Whether the last fix is usable, or why not: the first that applies. */
typedef enum keel_ubx_verdict {
    KEEL_UBX_USABLE = 0, /**< It is. */
    KEEL_UBX_NONE,       /**< There was none. */
    KEEL_UBX_OLD,        /**< It is older than config.max_age_us. */
    KEEL_UBX_NOT_OK,     /**< The receiver does not vouch for it. */
    KEEL_UBX_NOT_3D,     /**< It is not in three dimensions, only by satellites. */
    KEEL_UBX_INVALID,    /**< The receiver says that the place is not to be used. */
    KEEL_UBX_WIDE,       /**< The place is less accurate than config.accuracy_mm. */
    KEEL_UBX_WIDE_SPEED, /**< The speed is less accurate than config.speed_accuracy. */
    KEEL_UBX_STUCK       /**< Its time has not advanced from the one before, or there was none. */
} keel_ubx_verdict_t;

/** The longest message that the functions below write. */
#define KEEL_UBX_MESSAGE_BYTES 28

/** A message to the receiver. */
typedef struct keel_ubx_message {
    uint8_t bytes[KEEL_UBX_MESSAGE_BYTES]; /**< The message to send, and then zeros. */
    uint8_t size;                          /**< How many of them are the message. */
} keel_ubx_message_t;

/**
 * Makes a decoder (requirements UBX-001 and UBX-002).
 *
 * @param ubx    the decoder
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_LIMITS when an accuracy is 0; KEEL_ERR_AGE when gap_us or max_age_us
 *         is; the first that applies: then nothing is changed
 */
keel_status_t keel_ubx_init(keel_ubx_t *ubx, const keel_ubx_config_t *config);

/**
 * Takes a byte from the receiver (requirements UBX-003 to UBX-012 and UBX-016).
 *
 * @param ubx        the decoder, initialised
 * @param byte       what came
 * @param elapsed_us the time since the byte before, or since keel_ubx_pass_time when that was
 *                   called after it, in us; each microsecond is passed once
 * @return whether it ended a right NAV-PVT: it is in ubx->fix then. Otherwise that is as it was
 */
bool keel_ubx_take(keel_ubx_t *ubx, uint8_t byte, uint32_t elapsed_us);

/**
 * Lets time pass in which no byte came (requirement UBX-008), so that age_us is up to date.
 *
 * @param ubx        the decoder, initialised
 * @param elapsed_us the time since the last call for this decoder, in us
 */
void keel_ubx_pass_time(keel_ubx_t *ubx, uint32_t elapsed_us);

/**
 * Judges the last fix by the configured limits (requirement UBX-013).
 *
 * @param ubx the decoder, initialised
 * @return KEEL_UBX_USABLE, or the first reason against it
 */
keel_ubx_verdict_t keel_ubx_judge(const keel_ubx_t *ubx);

/**
 * Writes CFG-VALSET for one item, into the receiver's RAM (requirement UBX-014): for receivers from
 * the ninth generation on. Items that a flight controller sets: CFG-UART1-BAUDRATE 0x40520001, four
 * bytes; CFG-UART1OUTPROT-NMEA 0x10740002, one; CFG-RATE-MEAS 0x30210001, in ms, two;
 * CFG-MSGOUT-UBX_NAV_PVT_UART1 0x20910007, one.
 *
 * @param message where it is written
 * @param key     the item; its bits 28 to 30 tell the length of its value: 1 and 2 a byte, 3 two,
 *                4 four
 * @param value   its value; of what does not fit the lowest bytes are sent
 * @return KEEL_OK; KEEL_ERR_VALUE when the key tells another length: then nothing is changed
 */
keel_status_t keel_ubx_write_value(keel_ubx_message_t *message, uint32_t key, uint32_t value);

/**
 * Writes CFG-MSG (requirement UBX-015): how often a message comes on the port that this is sent to.
 * For receivers up to the ninth generation, as the two below.
 *
 * @param message where it is written
 * @param group   the message's class; 0x01 for NAV-PVT, 0xF0 for NMEA's
 * @param id      its id; 0x07 for NAV-PVT
 * @param every   with each so many solutions; 0 for never
 */
void keel_ubx_write_output(keel_ubx_message_t *message, uint8_t group, uint8_t id, uint8_t every);

/**
 * Writes CFG-RATE (requirement UBX-015): a solution with each measurement, by GPS time.
 *
 * @param message   where it is written
 * @param period_ms the time between measurements, in ms
 */
void keel_ubx_write_rate(keel_ubx_message_t *message, uint16_t period_ms);

/**
 * Writes CFG-PRT for the receiver's first UART (requirement UBX-015): 8 data bits, no parity, one
 * stop bit, UBX in and out and nothing else. The receiver answers at the new rate, or not at all.
 *
 * @param message where it is written
 * @param baud    bits per second
 */
void keel_ubx_write_port(keel_ubx_message_t *message, uint32_t baud);

KEEL_C_END

#endif
