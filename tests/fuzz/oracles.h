/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file oracles.h
 * @brief What decoders that others wrote say of one frame: tests/oracles has all but the last, of
 *        Rust, and oracle_mavlink.c the last, of MAVLink's own generator.
 */
#ifndef FUZZ_ORACLES_H
#define FUZZ_ORACLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Given for executions by the hundred million: no models, only frames behind a gap. */
#ifdef KEEL_ORACLE_ALONE
#define ALONE true
#else
#define ALONE false
#endif

/** uf-sbus: whether these 25 bytes are a frame, its channels, and its flags, the lowest bit first:
 *  channels 17 and 18, lost, failsafe. */
bool oracle_sbus(const uint8_t *frame, uint16_t channel[16], uint8_t *flags);

/** crsf: 1 for a frame with channels, 2 for one with statistics (strength at two antennas, quality,
 *  signal to noise, antenna, mode), 0 for none of these; size is 64 at most. */
int32_t oracle_crsf(const uint8_t *frame, size_t size, uint16_t channel[16], uint8_t link[6]);

/** parse_rc_ibus: whether these 32 bytes are a frame, and the 16 bits of each of its channels. */
bool oracle_ibus(const uint8_t *frame, uint16_t channel[14]);

/** ppm_decode: how many channels the frame has that the last of these times ends, and the first 16
 *  of them, of 800 to 2200 us; 0 when none ends then. A time from one edge to the next is more than
 *  0, and a sync gap from 4000 us on; there are 20 at most. */
uint32_t oracle_ppm(const uint32_t *width, size_t count, uint8_t least, uint16_t channel[16]);

/** ublox: whether these bytes are a NAV-PVT of protocol 23, of 92 bytes, and its fields: time of
 *  week, longitude, latitude, height, accuracy of place and height, velocity (3), its accuracy,
 *  type, satellites, is_ok. */
bool oracle_ubx(const uint8_t *message, size_t size, int64_t fix[13]);

/** The same of protocol 14, a u-blox 7's, of 84 bytes. */
bool oracle_ubx_14(const uint8_t *message, size_t size, int64_t fix[13]);

/** What MAVLink's own parser says of a frame. */
typedef struct oracle_mavlink {
    uint32_t id;
    uint8_t sequence;
    uint8_t system;
    uint8_t component;
    uint8_t length;
    uint8_t payload[255]; /**< Zeros behind what was sent. */
} oracle_mavlink_t;

/** mavlink_frame_char: whether these bytes end a right frame. */
bool oracle_mavlink(const uint8_t *frame, size_t size, oracle_mavlink_t *said);

#endif
