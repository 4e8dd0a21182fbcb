/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file command.h
 * @brief Commands of ground stations: what came, and who carries it out.
 *
 * Each of the functions below returns one of MAV_RESULT, and says by a text why, if it refuses:
 * ACCEPTED when it is done; IN_PROGRESS when the state machine has been asked, whose answer
 * copter_mavlink_pass_answers passes on; DENIED for what can never be as it was asked for;
 * UNSUPPORTED for what this aircraft does not do; TEMPORARILY_REJECTED for what it does not do now.
 */
#ifndef COPTER_COMMAND_H
#define COPTER_COMMAND_H

#include "telemetry.h"

#include <stdbool.h>
#include <stdint.h>

#define COPTER_COMMAND_PARAMS 7u

/** A command, of whichever message. */
typedef struct copter_command {
    uint32_t link;
    uint8_t system;
    uint8_t component;
    uint16_t id;
    float param[COPTER_COMMAND_PARAMS]; /**< Param 1 first; a place left open is no number. */
} copter_command_t;

/** The sender, who waits for its answer. */
copter_waiter_t copter_command_waiter(const copter_command_t *command);

/** Whether it is who waits already: it asks again until it is answered. */
bool copter_command_is_again(const copter_waiter_t *waiter, const copter_command_t *command);

/** Whether a parameter says nothing: some stations send 0, others no number. */
bool copter_command_is_empty(float param);

/** @name Modes: mode_commands.c. */
/** @{ */
/** DO_SET_MODE: a number of mavlink_modes.h; or PX4's main mode and sub-mode, as by MAVSDK. */
uint32_t copter_command_set_mode(copter_t *copter, const copter_command_t *command);
/** SET_MODE. */
uint32_t copter_command_set_mode_by_number(copter_t *copter, const copter_command_t *command,
                                           bool is_custom, uint32_t number);
/** DO_SET_STANDARD_MODE. */
uint32_t copter_command_set_standard_mode(copter_t *copter, const copter_command_t *command);
/** NAV_LAND, where it is; NAV_RETURN_TO_LAUNCH; NAV_LOITER_UNLIM, where it is. */
uint32_t copter_command_land(copter_t *copter, const copter_command_t *command);
uint32_t copter_command_return(copter_t *copter, const copter_command_t *command);
uint32_t copter_command_hold(copter_t *copter, const copter_command_t *command);
/** NAV_TAKEOFF. */
uint32_t copter_command_take_off(copter_t *copter, const copter_command_t *command);
/** @} */

/** @name Calibration: calibration_commands.c. */
/** @{ */
/** PREFLIGHT_CALIBRATION: accelerometers on six sides, how they are mounted; nothing: ends it. */
uint32_t copter_command_calibrate(copter_t *copter, const copter_command_t *command);
/** @} */

/** @name Starting anew: reboot.c. */
/** @{ */
/** PREFLIGHT_REBOOT_SHUTDOWN: on the ground, with its motors off. */
uint32_t copter_command_reboot(copter_t *copter, const copter_command_t *command);
/** Starts anew once that was asked for, answered, and nothing is left to be saved. */
void copter_reboot_step(copter_t *copter);
/** @} */

#endif
