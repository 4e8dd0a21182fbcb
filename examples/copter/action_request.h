/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file action_request.h
 * @brief What a ground station asks of the state machine, as if the pilot had moved a switch.
 *
 * A request moves the arm switch or the mode switch in the pilot's frames, and nothing else:
 * checks, throttle, kill switch, the times to settle and the link are what they are, and without
 * the pilot's frames a request moves nothing. He takes over by his own switch, when it has been so
 * for COPTER_ACTION_REQUEST_FRAMES frames in a row: the mode switch, by being moved; the arm
 * switch, by being moved to where it was asked to be, from where on it counts again. A request ends
 * with the link, and with the flight.
 */
#ifndef COPTER_ACTION_REQUEST_H
#define COPTER_ACTION_REQUEST_H

#include "keel/flight/mode.h"

#include <stdbool.h>
#include <stdint.h>

/** So many of the pilot's frames in a row take over from a request. */
#define COPTER_ACTION_REQUEST_FRAMES 25u

/** How long the state machine has to do what is asked, in us. */
#define COPTER_ACTION_REQUEST_TIME_US 1000000u

/** The outcome of a request. */
typedef enum copter_answer {
    COPTER_ANSWER_NONE,   /**< There is none. */
    COPTER_ANSWER_WAITS,  /**< The state machine has not decided. */
    COPTER_ANSWER_DONE,   /**< It has been done. */
    COPTER_ANSWER_REFUSED /**< The state machine refuses; nothing is asked any more. */
} copter_answer_t;

/** A switch that is moved. */
typedef struct copter_moved {
    copter_answer_t answer; /**< Read and set to none by who asked. */
    uint32_t age_us;        /**< Since it was asked for, while the answer waits. */
    uint32_t frames;        /**< Of the pilot, in a row, that take over. */
    bool is_moved;
} copter_moved_t;

/** A request. */
typedef struct copter_action_request {
    copter_moved_t arm;
    copter_moved_t mode;
    bool arms;          /**< Where the arm switch is moved to. */
    bool ran;           /**< Whether motors were on in the last step. */
    uint8_t asked;      /**< Where the mode switch is moved to: KEEL_MODE_LAND, ... */
    uint8_t pilot_mode; /**< Where the pilot's own was then. */
} copter_action_request_t;

/** Moves the arm switch, on or off. */
void copter_action_request_arm(copter_action_request_t *request, bool arms);

/** Moves the mode switch. */
void copter_action_request_mode(copter_action_request_t *request, uint8_t mode, uint8_t pilot_mode);

/** Adds the request to the state machine's input; frame: whether one came since the last step. */
void copter_action_request_apply(copter_action_request_t *request, bool frame,
                                 keel_mode_input_t *input);

/** Follows the state machine, and answers. */
void copter_action_request_follow(copter_action_request_t *request, const keel_mode_t *machine,
                                  uint32_t elapsed_us);

#endif
