/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sim.h
 * @brief The copter on simulated devices and a virtual clock, as a shared library for a plant.
 *
 * Whoever owns time, a plant say, writes what the devices hold now into sim_sensors(), lets the
 * copter run up to a time with sim_run_until(), and reads motors and all else from sim_view().
 * There is one copter in a process. Nothing here waits, starts a thread or reads a clock, so that
 * equal inputs lead to equal flights, bit for bit.
 *
 * Frames: body is forward, right, down; Earth is north, east, down. A device has a new sample when
 * its count differs from that of the last one that the copter took.
 */
#ifndef COPTER_SIM_H
#define COPTER_SIM_H

#include <stdint.h>

#define SIM_IMUS      3
#define SIM_MODULES   2
#define SIM_RECEIVERS 2
#define SIM_MOTORS    4
#define SIM_RING      512
#define SIM_TASKS     21
#define SIM_LINKS     3
#define SIM_KEY       32
#define SIM_ANSWER    8191

/** An inertial measurement unit. */
typedef struct sim_imu {
    float accelerometer[3]; /**< Specific force, body, in m/s^2: (0, 0, -9.81) at rest. */
    float gyroscope[3];     /**< Body, in rad/s. */
    int16_t temperature;    /**< In 0.01 degrees Celsius. */
    uint32_t count;
} sim_imu_t;

/** A magnetometer. */
typedef struct sim_magnetometer {
    float field[3]; /**< Body, in microtesla. */
    uint32_t count;
} sim_magnetometer_t;

/** A barometer. */
typedef struct sim_barometer {
    float pressure;      /**< In Pa. */
    int16_t temperature; /**< In 0.01 degrees Celsius. */
    uint32_t count;
} sim_barometer_t;

/** A receiver: the last bytes that it sent, or that are on their way. Byte n is at n modulo
 * SIM_RING.
 *
 * The first is that of the pilot's radio: SBUS, whose channels are, from 988 to 2012 us with 1500
 * in the middle, roll (right), pitch (stick pulled, nose up), throttle (up), yaw (right), arm
 * switch (off 1000, on 2000), mode switch (see sim_mode_channel), kill switch (off 1000, on 2000),
 * and the switch that asks for a calibration. The second is the satellite receiver: UBX. */
typedef struct sim_receiver {
    uint32_t byte[SIM_RING];
    uint32_t at_us[SIM_RING]; /**< When it has come, in us since power-up, modulo 2^32: never before
                                   the byte before. */
    uint32_t count;           /**< Of all bytes. */
} sim_receiver_t;

/** A power module. */
typedef struct sim_power {
    float voltage; /**< In V. */
    float current; /**< In A. */
    uint32_t count;
} sim_power_t;

/** The chip's measurements of itself; each is told once. */
typedef struct sim_chip {
    uint16_t supply;     /**< In mV. */
    int16_t temperature; /**< In 0.01 degrees Celsius. */
    uint32_t count;
} sim_chip_t;

/** The samples of all devices now. Values may be any bit pattern. */
typedef struct sim_sensors {
    sim_imu_t imu[SIM_IMUS];
    sim_magnetometer_t magnetometer;
    sim_barometer_t barometer;
    sim_receiver_t receiver[SIM_RECEIVERS];
    sim_power_t power[SIM_MODULES];
    sim_chip_t chip;
} sim_sensors_t;

/** SHA-256 of some bytes. */
typedef void (*sim_hash_t)(const uint8_t *data, uint32_t size, uint8_t *digest);

/** How a flight is made. */
typedef struct sim_options {
    uint32_t costs_percent; /**< Of its budget that a task's run takes: 100. */
    uint32_t imus;          /**< Inertial units that it has, 2 or 3. */
    uint32_t boot_us;    /**< From power-up to the copter's first turn; a board needs some time. */
    uint32_t plain_mean; /**< 1: the three units' mean in place of their vote, for comparison. */
    uint32_t bytes_per_s[SIM_LINKS]; /**< That each link of telemetry carries; 0: it is not there.
                                          Without any there is no telemetry, nor its task. */
    uint32_t listens[SIM_LINKS];     /**< 1: what comes by it may not command. */
    uint8_t key[SIM_KEY];            /**< What frames are signed with, if there is a hash. */
    sim_hash_t hash;                 /**< Null: frames are neither signed nor checked. */
    uint64_t timestamp;              /**< Now, in 10 us since 2015 began (UTC). */
    uint32_t trace;                  /**< 1: each run of a task is in the log. */
    const char *memory;              /**< The file that keeps parameters; null: none. It is read and
                                          written as long as the copter runs. */
} sim_options_t;

/** The counts of a task. */
typedef struct sim_task {
    uint32_t runs;
    uint32_t skipped;  /**< Periods without a run. */
    uint32_t overruns; /**< Runs longer than the budget. */
    uint32_t longest_us;
} sim_task_t;

/** The copter's actions and estimates. Angles are sines where said, distances in m from home. */
typedef struct sim_view {
    float motor[SIM_MOTORS];  /**< 0 to 1: front right, aft right, aft left, front left. */
    uint32_t state;           /**< KEEL_MODE_DISARMED, ... */
    uint32_t mode;            /**< The mode in force: KEEL_MODE_ACRO, ... */
    uint32_t motors_on;       /**< Whether motors may turn. */
    uint32_t cause;           /**< What led to this state. */
    uint32_t blocking_checks; /**< What stands in the way of arming. */
    uint32_t blocking_facts;
    uint32_t phase; /**< Of the attitude: 2 is running. */
    uint32_t heading_valid;
    uint32_t attitude_flags;
    float quaternion[4];     /**< w, x, y, z, from body to Earth. */
    float bias[3];           /**< Of the gyroscopes, in rad/s. */
    float rate[3];           /**< In rad/s. */
    float vote[6];           /**< Accelerometer, gyroscope. */
    uint32_t vote_state[6];  /**< How each came about: KEEL_VOTER_MEAN, ... */
    uint32_t used[SIM_IMUS]; /**< Per unit: its channels that contributed, a bit each. */
    uint32_t latched[SIM_IMUS];
    float position[3];      /**< North, east, up, in m from home. */
    float velocity[3];      /**< North, east, up, in m/s. */
    uint32_t place_quality; /**< 0 none, 1 poor, 2 good. */
    uint32_t height_quality;
    float asked_place[3]; /**< Set-points. */
    float asked_velocity[3];
    float asked_tilt[2]; /**< Roll, pitch: sines. */
    float asked_rate[3];
    float command[4];       /**< Roll, pitch, yaw, thrust. */
    uint32_t limited;       /**< What the mixer gave up. */
    uint32_t battery_level; /**< 0 unknown, 1 ok, 2 low, 3 critical. */
    float battery_left;     /**< 0 to 1. */
    uint32_t load_ppm;      /**< In the last 100 ms. */
} sim_view_t;

/** Powers up a copter at time 0 with all devices silent; what was before is forgotten.
 * @return 0, or the status with which the kernel refused */
int sim_start(const sim_options_t *options);

/** Sets a parameter, and saves all that were set in the memory: the next start has it in force.
 * @return 0; 1: there is no such parameter; 2: the value is not of its type, or out of its range;
 *         3: it contradicts another; 4: nothing keeps it */
int sim_set(const char *name, double value);

/** Where the flight's log goes from now on, a file that is made anew; an empty path: nowhere. What
 * was open is closed.
 * @return 0, or how often something could not be opened, written or closed since the last call */
int sim_log(const char *path);

/** The samples of the devices: to be written. */
sim_sensors_t *sim_sensors(void);

/** Runs the copter until the virtual clock reaches a time, in us since power-up.
 * @return 0, or the status with which the scheduler refused */
int sim_run_until(uint64_t time_us);

/** The view of the copter; made anew by each call. */
const sim_view_t *sim_view(void);

/** The counts of each task, SIM_TASKS of them; made anew by each call. */
const sim_task_t *sim_tasks(void);

/** What the copter answers to a command that is typed (examples/copter/console.h), in SIM_ANSWER
 * characters at most and a zero; there until the next call. */
const char *sim_console(const char *typed);

/** Makes the next runs of a task, from 0 in the order of table 2, longer by some time each. */
void sim_overrun(uint32_t task, uint32_t runs, uint32_t extra_us);

/** Bytes for the copter, which come by a link.
 * @return how many of them it has room for: the others are lost */
uint32_t sim_link_send(uint32_t link, const uint8_t *bytes, uint32_t size);

/** Bytes of the copter, which it sent by a link: whole frames, as many as fit.
 * @return how many */
uint32_t sim_link_receive(uint32_t link, uint8_t *bytes, uint32_t size);

/** The channel of the mode switch that asks for a mode: KEEL_MODE_ACRO, ... */
uint16_t sim_mode_channel(uint32_t mode);

/** The name of a task. */
const char *sim_task_name(uint32_t task);

#endif
