/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file board_lines.h
 * @brief The copter's lines on a board: the pilot's receiver, which is looked for, the satellite
 *        receiver, and telemetry.
 *
 * A receiver's protocol tells its bits. As long as the copter has heard none, each protocol's bits
 * are tried at each of the pilot's sockets in turn, and PPM at a pin of its own, BOARD_LISTEN_US
 * each: a receiver that sends is heard within BOARD_LISTEN_US times the number of turns, 3.5 s on a
 * board with two sockets and that pin. The satellite receiver is set up by ublox.h, unless it sends
 * fixes by itself.
 */
#ifndef COPTER_BOARD_LINES_H
#define COPTER_BOARD_LINES_H

#include "devices/ublox.h"
#include "port.h"
#include "rc.h"
#include "stm32f767/target/chip.h"
#include "telemetry.h"

#include <stdbool.h>
#include <stdint.h>

/** How long a socket is listened to, with the bits of one protocol, in us. The slowest that is
 *  heard needs ten frames of SBUS, 14 ms each. */
#define BOARD_LISTEN_US 500000u

/** Bits per second of the telemetry's socket: those of the radios that are sold with boards. */
#define BOARD_TELEMETRY_BAUD 57600u

/** Bits per second that the satellite receiver is to send with, and the time between two fixes. */
#define BOARD_SATELLITES_BAUD 115200u
#define BOARD_FIX_MS          100u

/** Bytes of telemetry that wait for the line; a power of two. */
#define BOARD_TELEMETRY_BYTES 1024u

/** The lines. The caller owns them; all of it may be read. */
typedef struct board_lines {
    keel_bsp_status_t pilot;      /**< How the pilot's line started last. */
    keel_bsp_status_t satellites; /**< The same of the satellite receiver's. */
    keel_bsp_status_t telemetry;  /**< The same of telemetry's. */
    keel_ublox_t receiver;        /**< The satellite receiver, as it is set up. */
    uint32_t stepped_us;          /**< When that had its last step. */
    keel_chip_line_t socket;      /**< That is listened to. */
    bool by_edges;                /**< It is not: PPM is, at its own pin. */
    uint32_t turn;                /**< Of the search. */
    uint32_t since_us;            /**< When that turn began. */
    uint32_t head;                /**< Bytes of telemetry that were put in, modulo 2^32. */
    uint32_t tail;                /**< And sent. */
    uint8_t out[BOARD_TELEMETRY_BYTES];
} board_lines_t;

/** Starts the lines that the board has. */
void board_lines_start(board_lines_t *lines);

/** What the copter makes of the bytes of its receivers. */
typedef struct board_heard {
    uint8_t chosen; /**< The parameter RC_PROTOCOL: COPTER_PROTOCOL_ANY, or the only one. */
    uint8_t heard;  /**< The protocol that it hears; COPTER_PROTOCOL_ANY: none yet. */
    uint32_t fixes; /**< NAV-PVT that it took, as keel_ublox_step counts them. */
} board_heard_t;

/**
 * Goes on: sends telemetry, looks for the pilot's receiver, and sets up the satellite receiver. To
 * be called in every turn of the main loop.
 *
 * @param lines  the lines
 * @param heard  what the copter hears by them
 * @param now_us the time, in us, modulo 2^32
 */
void board_lines_turn(board_lines_t *lines, const board_heard_t *heard, uint32_t now_us);

/** The next byte of a receiver, as copter_port_t's read_byte. */
bool board_lines_read(board_lines_t *lines, uint32_t receiver, copter_byte_t *byte);

/** How telemetry is made of the lines; without a key, and commands are taken. */
copter_telemetry_config_t board_lines_telemetry(board_lines_t *lines);

#endif
