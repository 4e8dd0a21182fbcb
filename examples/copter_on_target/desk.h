/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file desk.h
 * @brief Devices of a copter that lies on a desk, level, its nose to the north: for boards whose
 *        own sensors have no drivers yet, and for counting what the tasks cost.
 *
 * Samples come as often as those of real devices, and are never twice the same, as no real ones
 * are. The pilot switches on after seven seconds, raises the throttle to its middle after eight,
 * and the motors turn.
 */
#ifndef COPTER_DESK_H
#define COPTER_DESK_H

#include "port.h"

#include <stdint.h>

/** When a device last gave a sample, for each kind. */
typedef struct desk_device {
    uint32_t last_us;
    bool started;
} desk_device_t;

/** The longest that a receiver sends at once. */
#define DESK_BYTES 100u

/** A receiver, and what it sends now. */
typedef struct desk_receiver {
    desk_device_t device;
    uint8_t byte[DESK_BYTES];
    uint32_t size;
    uint32_t sent; /**< Of size. */
} desk_receiver_t;

/** A desk. */
typedef struct desk {
    keel_clock_fn_t read_clock;
    void *clock;
    desk_device_t imu[COPTER_IMUS];
    desk_device_t magnetometer;
    desk_device_t barometer;
    desk_receiver_t receiver[COPTER_RECEIVERS];
    desk_device_t power[COPTER_POWER_MODULES];
    uint32_t dither;            /**< The state of a pseudo-random sequence. */
    float motor[COPTER_MOTORS]; /**< What the motors were last told. */
} desk_t;

/**
 * Makes a port of a desk.
 *
 * @param desk       the desk
 * @param read_clock the clock that the scheduler is to read
 * @param clock      its context
 * @return the port, with no stack_free and no end_run that does anything, and no log
 */
copter_port_t desk_port(desk_t *desk, keel_clock_fn_t read_clock, void *clock);

#endif
