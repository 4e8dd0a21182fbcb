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

#define COPTER_IMUS          3u /* At most. */
#define COPTER_IMUS_LEAST    2u
#define COPTER_POWER_MODULES 2u
#define COPTER_MOTORS        4u

/** Bytes of a chip's own number: 96 bits, as an STM32's. */
#define COPTER_UID_BYTES 12u

/** @name Receivers: devices that send bytes. */
/** @{ */
#define COPTER_RC        0u /**< The pilot's receiver: rc.h; of PPM, a byte is an edge. */
#define COPTER_GPS       1u /**< The satellite receiver: UBX, NAV-PVT. */
#define COPTER_RECEIVERS 2u
/** @} */

/** A sample of an inertial measurement unit, body axes. */
typedef struct copter_imu_sample {
    float accelerometer[3]; /**< Specific force, in m/s^2. */
    float gyroscope[3];     /**< In rad/s. */
    int16_t temperature;    /**< Of the unit, in hundredths of a degree Celsius. */
} copter_imu_sample_t;

/** A sample of a magnetometer, body axes. */
typedef struct copter_magnetometer_sample {
    float value[3]; /**< In microtesla. */
} copter_magnetometer_sample_t;

/** A sample of a barometer. */
typedef struct copter_barometer_sample {
    float pressure_pa;   /**< In Pa. */
    int16_t temperature; /**< Of the sensor, in hundredths of a degree Celsius. */
} copter_barometer_sample_t;

/** A byte from a receiver. */
typedef struct copter_byte {
    uint32_t elapsed_us; /**< Since the byte before, or since the start, in us. */
    uint8_t value;       /**< Without those whose parity is wrong. */
} copter_byte_t;

/** A sample of a power module. */
typedef struct copter_power_reading {
    float voltage; /**< In V. */
    float current; /**< In A. */
} copter_power_reading_t;

/** The controller's measurements of itself. */
typedef struct copter_chip {
    uint16_t supply_mv;   /**< In mV. */
    int16_t temperature;  /**< Of the chip, in hundredths of a degree Celsius. */
    bool has_supply;      /**< Whether the supply is known. */
    bool has_temperature; /**< Whether the temperature is known. */
} copter_chip_t;

/** Notices of a port at most. */
#define COPTER_NOTICES 10u

/** A text for whoever is to fly: that it restarted, or that a device fails. */
typedef struct copter_notice {
    const char *first;
    const char *then; /**< Follows it. */
    bool is_urgent;   /**< It ended a flight, say. */
} copter_notice_t;

/** The functions of a port. */
typedef struct copter_port {
    keel_clock_fn_t read_clock;
    void *clock;   /**< Handed to read_clock. */
    void *context; /**< Handed to all others. */
    uint32_t imus; /**< Inertial units of the aircraft: 2 agree or do not, 3 outvote one of them. */
    bool (*read_imu)(void *context, uint32_t unit, copter_imu_sample_t *sample);
    bool (*read_magnetometer)(void *context, copter_magnetometer_sample_t *sample);
    bool (*read_barometer)(void *context, copter_barometer_sample_t *sample);
    /** Hands over the next byte; a run may leave some for the one 10 ms later. */
    bool (*read_byte)(void *context, uint32_t receiver, copter_byte_t *byte);
    bool (*read_power)(void *context, uint32_t module, copter_power_reading_t *reading);
    /** Writes what the chip measures of itself, and that it has it; null: it measures nothing. The
        task that asks has 18 us: of two conversions, one a call may be new. */
    void (*read_chip)(void *context, copter_chip_t *chip);
    /** Whether the safety switch says that motors may start; null: there is none. Asked while the
        parameter SAFETY_SWITCH says that it is used. */
    bool (*is_ready)(void *context);
    uint32_t (*stack_free)(void *context); /**< Bytes of the stack that were never used. */
    void (*write_motors)(void *context, const float output[COPTER_MOTORS]); /**< Each 0 to 1. */
    /** How many bytes of the log write_log takes now; what it has no room for stays in the ring. */
    uint32_t (*log_room)(void *context);
    /** Takes bytes of the log, in order: as many as there is room for, at most. Called in each run
        of copter_log_start's task, and by no other; with none when there are none. */
    void (*write_log)(void *context, const uint8_t *bytes, uint32_t length);
    /** A task's run ends: which, and what it is said to have cost at most. */
    void (*end_run)(void *context, uint32_t row, uint32_t wcet_us);
    const keel_medium_t *memory; /**< Keeps parameters; null: there is none. */
    const uint8_t *uid;          /**< COPTER_UID_BYTES that no other chip has; null: none. */
    /** Why it started when nobody wanted it to, as "watchdog"; null: it was switched on, or
        somebody asked for it. It is in the log. */
    const char *restart;
    const copter_notice_t *notices; /**< Told again and again until motors start; null: none. */
    uint32_t notice_count;          /**< COPTER_NOTICES at most. */
    /** Starts all anew, as power that is switched on does; returns on a host alone. Null: there is
        no way. Called with the motors off. */
    void (*reboot)(void *context);
} copter_port_t;

#endif
