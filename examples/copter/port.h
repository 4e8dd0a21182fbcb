/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file port.h
 * @brief What the copter needs of whatever it runs on: devices, motors, a clock.
 *
 * Frames: body is forward, right, down; Earth is north, east, down. A function that reads a device
 * returns whether there is a new sample since it was last asked; if not, it writes nothing.
 */
#ifndef COPTER_PORT_H
#define COPTER_PORT_H

#include "common/slots.h"
#include "keel/rtos/scheduler.h"

#include <stdbool.h>
#include <stdint.h>

#define COPTER_IMUS     3u
#define COPTER_MODULES  2u
#define COPTER_MOTORS   4u
#define COPTER_CHANNELS 8u

/** What an inertial measurement unit measured, body axes. */
typedef struct copter_inertial {
    float accelerometer[3]; /**< Specific force, in m/s^2. */
    float gyroscope[3];     /**< In rad/s. */
} copter_inertial_t;

/** What a magnetometer measured, body axes. */
typedef struct copter_field {
    float value[3]; /**< In microtesla. */
} copter_field_t;

/** What a satellite receiver says. */
typedef struct copter_fix {
    int32_t latitude;     /**< In 1e-7 degrees. */
    int32_t longitude;    /**< In 1e-7 degrees. */
    float north;          /**< Velocity, in m/s. */
    float east;           /**< Velocity, in m/s. */
    float accuracy;       /**< Of the position, in m. */
    float speed_accuracy; /**< Of the velocity, in m/s. */
    bool is_valid;        /**< A fix in three dimensions. */
} copter_fix_t;

/** A frame of the pilot's radio. */
typedef struct copter_frame {
    uint16_t channel[COPTER_CHANNELS]; /**< 988 to 2012, see radio.c. */
    bool failsafe;                     /**< The receiver hears no transmitter. */
} copter_frame_t;

/** What a power module measured. */
typedef struct copter_power_reading {
    float voltage; /**< In V. */
    float current; /**< In A. */
} copter_power_reading_t;

/** The functions of a port. */
typedef struct copter_port {
    keel_clock_fn_t read_clock;
    void *clock;   /**< What read_clock is handed. */
    void *context; /**< What all others are handed. */
    bool (*read_imu)(void *context, uint32_t unit, copter_inertial_t *sample);
    bool (*read_magnetometer)(void *context, copter_field_t *sample);
    bool (*read_barometer)(void *context, float *pressure_pa);
    bool (*read_gps)(void *context, copter_fix_t *fix);
    bool (*read_radio)(void *context, copter_frame_t *frame);
    bool (*read_power)(void *context, uint32_t module, copter_power_reading_t *reading);
    uint32_t (*stack_free)(void *context); /**< Bytes of the stack that were never used. */
    void (*write_motors)(void *context, const float output[COPTER_MOTORS]); /**< Each 0 to 1. */
    /** Takes bytes of the log, in order; called by copter_log_start's task alone. */
    void (*write_log)(void *context, const uint8_t *bytes, uint32_t length);
    /** A task's run ends: which, and what it is said to have cost at most. */
    void (*end_run)(void *context, uint32_t row, uint32_t wcet_us);
    const keel_medium_t *memory; /**< Keeps parameters; null: there is none. */
} copter_port_t;

#endif
