/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file flight.h
 * @brief What the demo's real-time tasks do: a vote of three simulated inertial units, one of which
 *        freezes after eight seconds (the paper's fig. 14), and three rate controllers.
 */
#ifndef FLIGHT_H
#define FLIGHT_H

#include "keel/status.h"

/** Makes units and controllers ready. */
keel_status_t flight_init(void);

/** Foreground IMU: takes a vote over what the units measure now. Every 2 ms. */
void flight_vote(void);

/** Angle rate control: one step of the three controllers. Every 2 ms. */
void flight_control(void);

/** Writes what came of it to the console. */
void flight_print(void);

#endif
