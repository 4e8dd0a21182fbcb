/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ublox.h
 * @brief Sets up a satellite receiver by u-blox as it comes out of its box: a state machine that
 *        never waits.
 *
 * An M8 speaks NMEA at 9600 baud, an M9 at 38400, an M10 at one of the two, and others as they were
 * set up before. The driver goes through the rates. At each it sends all settings: NAV-PVT with
 * each measurement, the time between measurements, the dynamic model of an aircraft of up to 4 g,
 * UBX in place of NMEA, and last the rate of the line that is wanted. Then it listens at that rate.
 *
 * Each setting is sent as CFG-VALSET, which receivers know from the ninth generation on (M9, M10,
 * F9), and as CFG-PRT, CFG-MSG, CFG-RATE and CFG-NAV5, which u-blox 7 and M8 know: a receiver
 * refuses what it does not know. As the rate changes last, nothing that counts is sent to a
 * receiver that may have changed it already. All is in the receiver's RAM alone, and is gone with
 * its supply.
 *
 * The driver hears nothing but the count of fixes that the caller's decoder took
 * (keel/middleware/ubx.h). So NAV-PVT proves the rate of the line and the messages; nothing proves
 * the time between measurements and the dynamic model, and a byte that is lost on the way may cost
 * the one or the other. A receiver that sends NAV-PVT at the wanted rate when it is switched on is
 * left as it is, also in flight, behind a reset of the flight controller.
 *
 * A receiver that hears more than 100 wrong characters within a second is deaf until its end, as an
 * M8 tells in a message. The driver listens for longer than that before it sends again.
 */
#ifndef KEEL_BSP_DEVICES_UBLOX_H
#define KEEL_BSP_DEVICES_UBLOX_H

#include "common/bsp_status.h"
#include "common/progress.h"

#include <stdbool.h>
#include <stdint.h>

/** How many rates a receiver is looked for at. */
#define KEEL_UBLOX_RATES 5u

/** These, in bits per second, in their order. */
extern const uint32_t keel_ublox_baud[KEEL_UBLOX_RATES];

/** The bytes of all settings. */
#define KEEL_UBLOX_BYTES 220u

/** Bytes that a step sends at most. */
#define KEEL_UBLOX_BURST 16u

/** The longest time between measurements, in ms: then a fix comes while the driver listens. */
#define KEEL_UBLOX_PERIOD_MAX_MS 1000u

/** How long a receiver may be silent at first, in us: it comes up. */
#define KEEL_UBLOX_START_US 2000000u

/** When bytes that the line does not take are given up, in us: at 9600 baud all take 0.23 s. */
#define KEEL_UBLOX_SEND_US 3000000u

/** How long the last bytes, and the receiver's change of its rate, are waited for, in us. */
#define KEEL_UBLOX_SETTLE_US 100000u

/** How long the driver listens behind that, in us. */
#define KEEL_UBLOX_LISTEN_US 1200000u

/** Without a fix for so long a receiver is set up anew, in us. */
#define KEEL_UBLOX_LOST_US 5000000u

/** What the driver is doing. */
typedef enum keel_ublox_state {
    KEEL_UBLOX_OFF,       /**< The line is to be set to the wanted rate. */
    KEEL_UBLOX_LISTENING, /**< It waits for a fix, at the wanted rate. */
    KEEL_UBLOX_SENDING,   /**< It sends the settings, at one of the rates. */
    KEEL_UBLOX_SETTLING,  /**< The last bytes go out, and the receiver changes its rate. */
    KEEL_UBLOX_RUNNING    /**< Fixes come. */
} keel_ublox_state_t;

/** The line to a receiver: 8 data bits, no parity, one stop bit. */
typedef struct keel_ublox_port {
    /** Sends a byte, without waiting; false when the line takes none now. At KEEL_UBLOX_SETTLE_US
     *  behind the last it must be out. */
    bool (*send)(void *context, uint8_t byte);
    /** Sets the rate of both directions, in bits per second. */
    void (*set_baud)(void *context, uint32_t baud);
    void *context; /**< For both of them. */
} keel_ublox_port_t;

/** A receiver. Written by the functions below alone; all of it may be read. */
typedef struct keel_ublox {
    keel_ublox_port_t port;          /**< Its line. */
    keel_ublox_state_t state;        /**< What the driver is doing. */
    keel_progress_t progress;        /**< Times; a sample is a fix, a failure a time-out. */
    uint32_t target_baud;            /**< The rate that is wanted, in bits per second. */
    uint32_t tried_baud;             /**< At which settings were sent last; 0 before the first. */
    uint32_t found_baud;             /**< Behind which fixes came last: tried_baud, or target_baud
                                          when nothing had been sent; 0 before. */
    uint32_t attempts;               /**< Times that settings were sent; stays at its end. */
    uint32_t rounds;                 /**< Times that the last of the rates was in vain; likewise. */
    uint32_t rate;                   /**< The rate that is tried, or is to be tried next. */
    uint32_t fixes;                  /**< The caller's count at the last step. */
    uint32_t size;                   /**< Bytes of the settings. */
    uint32_t sent;                   /**< How many of them are sent. */
    uint8_t bytes[KEEL_UBLOX_BYTES]; /**< The settings. */
} keel_ublox_t;

/**
 * Makes a receiver that is not looked for yet; sends nothing (requirement UBL-001).
 *
 * @param receiver    the receiver
 * @param port        its line
 * @param target_baud the rate that it is to have, in bits per second; one of keel_ublox_baud
 * @param period_ms   the time between fixes, in ms; at most KEEL_UBLOX_PERIOD_MAX_MS, at least
 *                    what a NAV-PVT of 100 bytes takes at that rate. A receiver refuses less than
 *                    it can do: 100 ms suit all of them
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT for another rate or period: then nothing is changed
 */
keel_bsp_status_t keel_ublox_begin(keel_ublox_t *receiver, keel_ublox_port_t port,
                                   uint32_t target_baud, uint32_t period_ms);

/**
 * Does what is next, if its time has come: sends KEEL_UBLOX_BURST bytes at most, or sets the rate
 * of the line once, and never waits (requirements UBL-002 to UBL-011).
 *
 * @param receiver   the receiver, begun
 * @param elapsed_us the time since the call before, in us
 * @param fixes      how many right NAV-PVT the caller's decoder has taken since keel_ublox_begin
 * @return KEEL_BSP_OK while the receiver runs; KEEL_BSP_WAIT while it is looked for;
 *         KEEL_BSP_TIMEOUT in the step that begins to send settings, as no fix came in time, and
 *         in the one that gives up to send them, as the line does not take them
 */
keel_bsp_status_t keel_ublox_step(keel_ublox_t *receiver, uint32_t elapsed_us, uint32_t fixes);

#endif
