/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ublox.h
 * @brief A simulated satellite receiver by u-blox, byte by byte, and the line to it.
 *
 * It knows no place, only its settings, and counts the NAV-PVT that arrive at the other end of the
 * line. It comes up with NMEA alone, at the rate of its maker, and forgets all settings with its
 * supply. Characters at another rate than its own are noise to it; more than 100 wrong ones in a
 * second make it deaf until its end. Its time is moved on by simulated_ublox_pass.
 */
#ifndef KEEL_BSP_SIMULATED_UBLOX_H
#define KEEL_BSP_SIMULATED_UBLOX_H

#include <stdbool.h>
#include <stdint.h>

/** The longest message that it takes. */
#define SIMULATED_UBLOX_BYTES 64u

/** The settings. */
typedef struct simulated_ublox_settings {
    uint32_t baud;
    uint32_t period_ms; /**< Between measurements. */
    uint32_t every;     /**< NAV-PVT with each so many of them, or never. */
    uint32_t model;     /**< The dynamic model. */
    bool ubx_in;
    bool ubx_out;
    bool nmea_out;
} simulated_ublox_settings_t;

/** A receiver with its line. */
typedef struct simulated_ublox {
    bool knows_messages; /**< CFG-PRT, CFG-MSG, CFG-RATE and CFG-NAV5: u-blox 7 to F9. */
    bool knows_items;    /**< CFG-VALSET: from the ninth generation on. */
    bool is_off;         /**< It has no supply. */
    bool is_mute;        /**< The line to it takes no bytes. */
    uint32_t lag_us;     /**< Until it changes its rate when it is told to; 0 for at once. */
    simulated_ublox_settings_t factory;
    simulated_ublox_settings_t now;
    uint32_t line_baud; /**< Of the other end. */
    uint32_t sends_us;  /**< Until all bytes that the line took are out. */
    uint32_t rates;     /**< Times that the other end's rate was set. */
    uint32_t cut;       /**< Of them, while bytes went out. */
    uint32_t garbage;   /**< Bytes at a wrong rate, or to a deaf receiver. */
    uint32_t acks;      /**< Messages that it did. */
    uint32_t naks;      /**< Messages that it refused. */
    uint32_t checksums; /**< Messages that were wrong. */
    uint32_t fixes;     /**< NAV-PVT that arrived. */
    uint32_t new_baud;  /**< Told, and not set yet; or 0. */
    uint32_t new_us;    /**< Until it is. */
    uint32_t epoch_us;  /**< Since the last measurement. */
    uint32_t second_us; /**< Of the second in which wrong characters are counted. */
    uint32_t wrong;     /**< In it. */
    uint32_t length;    /**< Of the message so far. */
    uint8_t message[SIMULATED_UBLOX_BYTES];
} simulated_ublox_t;

/** Powers up a receiver whose maker has set it to this rate. */
void simulated_ublox_init(simulated_ublox_t *receiver, uint32_t baud);

/** Takes its supply away, until simulated_ublox_power gives it back. */
void simulated_ublox_unplug(simulated_ublox_t *receiver);

/** Powers it up again: all settings are its maker's. */
void simulated_ublox_power(simulated_ublox_t *receiver);

/** Lets time pass: 100 ms at most, so that no two NAV-PVT come in it at 10 Hz. */
void simulated_ublox_pass(simulated_ublox_t *receiver, uint32_t time_us);

/** As keel_ublox_port_t's send: takes a byte while at most one other is on its way. */
bool simulated_ublox_send(void *context, uint8_t byte);

/** As keel_ublox_port_t's set_baud. */
void simulated_ublox_set_baud(void *context, uint32_t baud);

#endif
