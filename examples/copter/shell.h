/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file shell.h
 * @brief The console (console.h) by MAVLink: SERIAL_CONTROL of the device "shell", as PX4 has it.
 *
 * mavlink_shell.py, QGroundControl's MAVLink console and MAVProxy's module nsh send what their
 * users type, a line at a time, and show what comes back: the line again, the answer and a prompt.
 * Nothing but the console can be reached.
 *
 * Each station has a place of its own, and the next message is for the next station of those that
 * wait. At most so many bytes go out at once as a message carries, and they are made then.
 */
#ifndef COPTER_SHELL_H
#define COPTER_SHELL_H

#include "console.h"
#include "mavlink_messages.h"

#include <stdbool.h>
#include <stdint.h>

/** Stations at a time. One more takes the place of the one that came first. */
#define COPTER_SHELL_STATIONS 4u

/** Typed characters that wait, as long as an answer is given. */
#define COPTER_SHELL_TYPED 72u

/** A station. */
typedef struct copter_shell_station {
    char typed[COPTER_SHELL_TYPED]; /**< It waits: count characters. */
    char line[COPTER_CONSOLE_LINE]; /**< To be sent: from sent up to length. */
    copter_said_t answer;           /**< What follows, if it answers. */
    uint8_t count;
    uint8_t sent;
    uint8_t length;
    uint8_t system;
    uint8_t component;
    bool answers;
    bool is_open; /**< Otherwise there is none. */
} copter_shell_station_t;

/** The stations of a link. */
typedef struct copter_shell {
    copter_shell_station_t station[COPTER_SHELL_STATIONS];
    uint32_t next_station; /**< The place of one more. */
    uint32_t turn;         /**< Who had the last message. */
} copter_shell_t;

/**
 * Takes what a station types. Without SERIAL_CONTROL_FLAG_RESPOND it goes away, and what waited for
 * it, too. Other devices, and replies, are not for the copter.
 *
 * @param shell     the stations
 * @param message   what came
 * @param system    of whom
 * @param component of whom
 * @return whether there was room for all that was typed
 */
bool copter_shell_take(copter_shell_t *shell, const message_serial_control_t *message,
                       uint8_t system, uint8_t component);

/** Whether something is to be sent. */
bool copter_shell_waits(const copter_shell_t *shell);

/**
 * Makes the next message.
 *
 * @param copter  the copter
 * @param shell   the stations
 * @param message filled
 * @return whether there is one
 */
bool copter_shell_report(const struct copter *copter, copter_shell_t *shell,
                         message_serial_control_t *message);

#endif
