/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file obstacle.h
 * @brief The words for what stands in the way of arming: the checks and the facts of mode.h.
 *
 * A ground station that asks reads all of them, a pilot who tries by his switch the first one, and
 * the log has that too: in the same words.
 */
#ifndef COPTER_OBSTACLE_H
#define COPTER_OBSTACLE_H

#include "keel/flight/mode.h"

#include <stdint.h>

/** How many obstacles have words. */
#define COPTER_OBSTACLES 27u

/** The words before those of an obstacle; with them it has 50 letters at most. */
#define COPTER_NOT_ARMED "not armed: "

/**
 * An obstacle, if it is there.
 *
 * @param refusal what stands in the way
 * @param index   which, below COPTER_OBSTACLES: first the checks, then the facts
 * @return its words; null: it does not stand in the way
 */
const char *copter_obstacle(const keel_mode_refusal_t *refusal, uint32_t index);

/**
 * The first obstacle of the last attempt to arm.
 *
 * @param mode the machine, which has refused it
 * @return its words
 */
const char *copter_obstacle_first(const keel_mode_t *mode);

#endif
