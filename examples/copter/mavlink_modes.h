/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mavlink_modes.h
 * @brief The modes of mode.h as ground stations know them: numbers, names, standard modes.
 *
 * MAVLink leaves `custom_mode` to the autopilot, and stations read it by a table that they bring
 * along. Of a quadrotor with a generic autopilot, pymavlink and MAVProxy read it by ArduCopter's
 * table (numbers below 30), MAVSDK by PX4's layout: a main mode in bits 16 to 23, a sub-mode in
 * bits 24 to 31. No number means the same in both. So Keel's are PX4's numbers of the modes that do
 * the same: MAVSDK shows the right name, and ArduCopter's table has a name for none of them. A
 * station that asks for AVAILABLE_MODES needs no table.
 */
#ifndef COPTER_MAVLINK_MODES_H
#define COPTER_MAVLINK_MODES_H

#include "telemetry.h"

#include <stdbool.h>
#include <stdint.h>

/** The number while no mode is in force and the pilot has not said one: of no table. */
#define COPTER_MODE_NUMBER_NONE 0x00FF0000u

/** PX4's main mode for all that flies by itself, and its sub-mode that holds the place. */
#define COPTER_MODE_AUTO 4u
#define COPTER_MODE_HOLD 3u

/** The mode that is told: the one in force; without one, the one that the pilot asks for. */
uint8_t copter_mavlink_mode_told(const copter_t *copter);

/** A mode's number in custom_mode. */
uint32_t copter_mavlink_mode_number(uint8_t mode);

/** The mode of a number; KEEL_MODE_NONE when it is none. */
uint8_t copter_mavlink_mode_of_number(uint32_t number);

/** The mode that does what one of MAVLink's standard modes does; KEEL_MODE_NONE without one. */
uint8_t copter_mavlink_mode_of_standard(uint32_t standard);

/** Wants AVAILABLE_MODES on a link: of a mode by its index, from 1; of all for 0. Returns whether
 * there is such an index. */
bool copter_mavlink_modes_want(copter_link_t *link, float index);

/** Fills CURRENT_MODE. */
void copter_mavlink_modes_current(const copter_t *copter, uint8_t *payload);

/** Fills AVAILABLE_MODES of the next mode that is wanted; returns whether one is. */
bool copter_mavlink_modes_available(copter_link_t *link, uint8_t *payload);

#endif
