/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file copter.h
 * @brief A flight controller for a quadcopter: the 21 tasks of table 2 on Keel's units.
 *
 * Which task hands what to whom. Each structure below is written by the tasks named beside it
 * alone: a task's body takes a pointer to what it writes, and the copter as const. Data flows from
 * left to right through them.
 *
 *     background IMU -> foreground IMU --(imu)------> navigation --(estimate)--+
 *     background, foreground magnetometer (magnetometer)^  ^                   |
 *     background, foreground barometer ---(barometer)------+                   v
 *     GPS --------------------------------(gps)------------+      +--- position control
 *     background, foreground radio --------(pilot)--> state machine    angle control
 *     background, foreground power module -(power)-------^   |    |    angle rate control
 *                                                            +--(state)-----> | (control)
 *                                                                             v
 *                                                                           motors
 *
 * Besides, telemetry (telemetry.h) tells all of it, and asks the state machine (action_request.h).
 *
 * The tasks do not interrupt one another (they run to their end, one at a time), so a structure is
 * never seen half written. No task computes what is a unit's to compute.
 */
#ifndef COPTER_H
#define COPTER_H

#include "action_request.h"
#include "common/task_table.h"
#include "keel/flight/altitude.h"
#include "keel/flight/attitude.h"
#include "keel/flight/battery.h"
#include "keel/flight/calibration.h"
#include "keel/flight/cascade.h"
#include "keel/flight/filter.h"
#include "keel/flight/mixer.h"
#include "keel/flight/mode.h"
#include "keel/flight/position.h"
#include "keel/flight/reference.h"
#include "keel/middleware/oversample.h"
#include "keel/middleware/ubx.h"
#include "keel/middleware/virtual_imu.h"
#include "keel/rtos/load.h"
#include "keel/rtos/scheduler.h"
#include "log.h"
#include "parameter_store.h"
#include "port.h"
#include "rc.h"
#include "settings.h"
#include "urpilot_tasks.h"
#include "wmm.h"

/** Tasks beside table 2's, and all together. */
#define COPTER_OWN_TASKS 4u
#define COPTER_TASKS     (URPILOT_TASK_COUNT + COPTER_OWN_TASKS)

/** Blocks of steps whose mean forces are kept for navigation, should it come late. */
#define COPTER_BLOCKS 8u

/** So many bytes of a receiver a run takes at most: more than come in its period. */
#define COPTER_BYTES 256u

/** @name Where the copter departs from table 2: four protocols of a radio cost more than one, and
 * runs also write the log. */
/** @{ */
#define COPTER_ANALYSIS_WCET_US  20u   /**< Of the analysis of the scheduler, not 10. */
#define COPTER_ANALYSIS_PHASE_US 2800u /**< Where there is room for that, in the way of none. */
#define COPTER_RADIO_READS_US    170u  /**< A run of background radio begins no byte later. */
#define COPTER_RADIO_WCET_US     200u  /**< And takes so long at most, not 21. */
#define COPTER_RADIO_PHASE_US    2344u /**< Where there is room for that, in none's way. */
#define COPTER_PILOT_PHASE_US    2568u /**< Foreground radio follows. */
#define COPTER_STATE_PHASE_US    2645u /**< And the state machine. */
/* A run that is far too long leaves a task to promotion (priority.h), which comes after 15 periods
 * over its priority, for eight runs. By the paper's priorities that were 150 and 300 ms, in which
 * the pilot would be taken for lost. */
#define COPTER_PILOT_PRIORITY KEEL_PRIORITY_HIGH /**< Of foreground radio: after 75 ms. */
#define COPTER_STATE_PRIORITY KEEL_PRIORITY_HIGH /**< Of the state machine: after 75 ms. */
/** @} */

/** The mean specific force of a block of steps. */
typedef struct copter_force {
    keel_attitude_vector_t mean; /**< Body, in m/s^2. */
    bool is_known;               /**< Whether any of the steps had one. */
} copter_force_t;

/** The worst of the last votes of one kind, so that what comes and goes is told once. */
typedef struct copter_doubt {
    uint16_t votes; /**< For so many more it stands, unless a worse one comes. */
    uint8_t state;  /**< KEEL_VOTER_MEAN, ... */
} copter_doubt_t;

/** Written by background and foreground IMU. */
typedef struct copter_imu {
    uint32_t units; /**< So many there are. */
    keel_oversample_t channel[COPTER_IMUS][KEEL_VIRTUAL_IMU_CHANNELS];
    uint64_t sampled_us[COPTER_IMUS];            /**< When each unit last gave a sample. */
    int16_t temperature[COPTER_IMUS];            /**< Of it, in 0.01 degrees Celsius. */
    keel_virtual_imu_sample_t unit[COPTER_IMUS]; /**< As measured, without calibration. */
    bool rests[COPTER_IMUS];                     /**< Whether a unit said the same as before. */
    keel_filter_t filter[COPTER_IMUS][KEEL_VIRTUAL_IMU_CHANNELS]; /**< Of what is voted on. */
    keel_virtual_imu_t virtual_imu;
    keel_virtual_imu_sample_t slow_unit[COPTER_IMUS]; /**< What drifts in them. */
    keel_virtual_imu_t slow;
    uint32_t votes;               /**< How many there were. */
    copter_doubt_t accelerometer; /**< What is to be said of the votes. */
    copter_doubt_t gyroscope;
    keel_attitude_t attitude;
    uint32_t calibrations;               /**< What was taken of calibration.done. */
    uint32_t fields;                     /**< What was taken of estimate.fields. */
    uint32_t field_taken;                /**< What was taken of magnetometer.samples. */
    keel_attitude_vector_t down;         /**< As the body sees it. */
    keel_attitude_vector_t force_sum;    /**< Of the steps of this block. */
    uint32_t forces;                     /**< How many are in it. */
    uint32_t steps;                      /**< Of this block. */
    copter_force_t force[COPTER_BLOCKS]; /**< Block n is at n modulo COPTER_BLOCKS. */
    uint32_t blocks;                     /**< How many there were. */
} copter_imu_t;

/** A calibration of accelerometers that a ground station asked for. */
typedef enum copter_levelling {
    COPTER_LEVELLING_NONE = 0, /**< None, or it has ended. */
    COPTER_LEVELLING_SIDES,    /**< On six sides. */
    COPTER_LEVELLING_LEVEL     /**< Standing level: how the sensors are mounted. */
} copter_levelling_t;

/** How a calibration of accelerometers ended. */
typedef enum copter_levelled {
    COPTER_LEVELLED_NOT = 0, /**< It goes on. */
    COPTER_LEVELLED_DONE,
    COPTER_LEVELLED_BEYOND, /**< What was found cannot be believed. */
    COPTER_LEVELLED_LATE,   /**< It did not rest on another side for long. */
    COPTER_LEVELLED_CANCELLED
} copter_levelled_t;

/** Written by calibration IMU; asked for by telemetry. */
typedef struct copter_accel_calibration {
    uint32_t units; /**< So many there are. */
    keel_calibration_rest_t rest[COPTER_IMUS];
    keel_calibration_sides_t sides[COPTER_IMUS];
    keel_calibration_correction_t correction[COPTER_IMUS]; /**< In force. */
    keel_calibration_rotation_t board;                     /**< As settings.board says. */
    keel_calibration_rotation_t turn;                      /**< The same, and trimmed: in force. */
    keel_calibration_correction_t found[COPTER_IMUS];      /**< By the last one on six sides. */
    float trim[2];     /**< The roll and pitch that the last one found. */
    bool is_turned;    /**< Anything but not at all. */
    uint32_t seen;     /**< The sides that are done, a bit each. */
    uint32_t waited;   /**< Runs since the last one was. */
    uint8_t side;      /**< On which they rest now; KEEL_CALIBRATION_SIDES: on none. */
    uint8_t shown;     /**< The vehicle's side then, if it is one of them. */
    uint8_t levelling; /**< What goes on: copter_levelling_t. */
    uint8_t end;       /**< How the last one ended: copter_levelled_t. */
} copter_accel_calibration_t;

/** Written by calibration IMU and calibration magnetometer. */
typedef struct copter_calibration {
    copter_accel_calibration_t accelerometers;
    uint32_t units; /**< So many there are. */
    keel_calibration_rest_t gyroscope[COPTER_IMUS];
    keel_calibration_rest_t rest; /**< Of the field: while it turns, nothing rests. */
    uint32_t rest_taken;          /**< What was taken of magnetometer.samples. */
    keel_calibration_field_t field;
    keel_calibration_correction_t magnetometer; /**< In force, in microtesla. */
    uint32_t field_ends;                        /**< How often the pilot ended it. */
    uint8_t field_end;                          /**< With what: keel_calibration_verdict_t. */
    bool field_asked;                           /**< He asked for it in the last run. */
    uint32_t done;                              /**< How often all gyroscopes were calibrated. */
    uint32_t turns;  /**< How often the field turned while gyroscopes saw nothing move. */
    uint32_t fields; /**< What was taken of estimate.fields. */
    uint32_t checks; /**< KEEL_MODE_CHECK_CALIBRATION and _MAGNETOMETER, as far as they hold. */
} copter_calibration_t;

/** Written by background and foreground magnetometer. */
typedef struct copter_magnetometer {
    keel_oversample_t axis[3];
    keel_filter_t calm[3];        /**< Of raw, what is slower than a second or so. */
    keel_attitude_vector_t raw;   /**< Body, in microtesla, as measured. */
    keel_attitude_vector_t field; /**< The same less what the aircraft adds. */
    uint32_t samples;             /**< How many there were. */
} copter_magnetometer_t;

/** Written by background and foreground barometer. */
typedef struct copter_barometer {
    keel_oversample_t pressure;
    float pressure_pa;
    int16_t temperature; /**< Of the last sample that counted, in 0.01 degrees Celsius. */
    uint32_t samples;    /**< How many there were. */
    uint32_t repeats;    /**< How often the last pressure came again, until it counts as stuck. */
    uint64_t sampled_us; /**< When that sample came. */
} copter_barometer_t;

/** A fix, as navigation takes it. */
typedef struct copter_fix {
    uint32_t tow_ms;       /**< When it was so: the receiver's time of week. */
    int32_t latitude;      /**< In 1e-7 degrees. */
    int32_t longitude;     /**< In 1e-7 degrees. */
    float height;          /**< Above mean sea level, in m. */
    float north;           /**< Velocity, in m/s. */
    float east;            /**< Velocity, in m/s. */
    float climb;           /**< Velocity upwards, in m/s. */
    float accuracy;        /**< Of the position, in m. */
    float height_accuracy; /**< Of the height, in m. */
    float speed_accuracy;  /**< Of the velocity, in m/s. */
    bool is_valid;         /**< Usable, by the receiver's limits. */
} copter_fix_t;

/** The date, as the satellite receiver told it last. */
typedef struct copter_date {
    uint8_t bytes[KEEL_UBX_BYTES]; /**< The receiver's last ones. */
    uint32_t next;                 /**< Of the next one, which is the place of the oldest. */
    uint64_t utc_us;               /**< Since 1970 began (UTC); 0: it is not known. */
    uint64_t read_us;              /**< When that was, by our clock. */
} copter_date_t;

/** The satellite receiver is silent when no byte of it has come for longer than this: twice the
 * time between two fixes, where that is the longest (ublox.h). */
#define COPTER_GPS_SILENT_US 2000000u

/** Written by GPS. */
typedef struct copter_gps {
    keel_ubx_t receiver;
    uint32_t bytes;   /**< How many had come at the last run. */
    uint64_t byte_us; /**< When the last of them came, or the first run was. */
    bool is_silent;   /**< None has come for COPTER_GPS_SILENT_US. */
    copter_date_t date;
    copter_fix_t fix;
    uint32_t fixes; /**< How many there were. */
    uint64_t fixed_us;
    keel_attitude_vector_t acceleration; /**< Of the aircraft, Earth, by the last two fixes. */
    bool is_accelerated;                 /**< Whether that is known. */
} copter_gps_t;

/** The counts a second ago, to which those of now are compared. */
typedef struct copter_pilot_ear {
    uint32_t runs;                     /**< Of foreground radio, since. */
    uint32_t received;                 /**< Frames that had come. */
    uint32_t frames;                   /**< And the pilot's. */
    uint32_t refused[COPTER_REFUSALS]; /**< And those refused. */
    uint8_t heard;                     /**< What was heard in it: copter_heard_t. */
} copter_pilot_ear_t;

/** Sticks: roll, pitch, yaw and climb. */
#define COPTER_STICKS 4u

/** Written by background and foreground radio; angle control writes what the sticks ask for. */
typedef struct copter_pilot {
    copter_rc_t rc;
    uint32_t frames;                /**< How many frames the pilot sent, and are in what follows. */
    uint32_t read;                  /**< Of rc.frames, the last one looked at. */
    copter_pilot_ear_t ear;         /**< What was there a second ago. */
    keel_reference_sticks_t sticks; /**< As the last frame has them. */
    keel_filter_t smoother[COPTER_STICKS]; /**< They follow it smoothly. */
    keel_reference_sticks_t smooth;
    keel_reference_t reference; /**< The smooth sticks ask for this. */
    uint32_t facts;             /**< KEEL_MODE_RC_LINKED, ... of the pilot's last frame. */
    bool calibrates;            /**< It asks for a calibration of the magnetometer. */
    uint8_t asked;              /**< The mode that it asks for. */
} copter_pilot_t;

/** Written by background and foreground power module. */
typedef struct copter_power {
    keel_battery_sample_t sample; /**< What came since the last step. */
    keel_battery_t battery;
    bool is_known; /**< Its voltage at rest has said what it has. */
} copter_power_t;

/** What tells the height. */
typedef enum copter_height {
    COPTER_HEIGHT_NONE = 0, /**< Nothing: the climb rate is the acceleration's, for a while. */
    COPTER_HEIGHT_BAROMETER,
    COPTER_HEIGHT_GPS /**< The barometer is silent. */
} copter_height_t;

/** What the inertial units say of the way up, in a step. */
typedef struct copter_vertical_force {
    float acceleration; /**< Upwards, gravity taken off, in m/s^2. */
    bool is_known;
} copter_vertical_force_t;

/** Height without the barometer, and what the aircraft's weight asks for. */
typedef struct copter_vertical {
    keel_axis_t gps;   /**< The receiver's height, above where it first could be used. */
    float zero;        /**< That place, above mean sea level, in m. */
    float offset;      /**< How much higher the receiver's height is than the barometer's. */
    float speed;       /**< Upwards by acceleration alone, of the last seconds, in m/s. */
    float hover;       /**< The thrust that hovers, as learnt in flight, 0 to 1. */
    uint32_t lying;    /**< Steps in a row in which it lay on its side. */
    uint32_t touching; /**< Steps in a row in which it did not sink, but was to. */
    uint32_t resting;  /**< Steps in a row in which it touched, and the motors pushed little. */
    keel_axis_quality_t quality; /**< Of the height that is told. */
    uint8_t source;              /**< Of the height that is told: copter_height_t. */
    bool has_zero;
    bool has_offset;
    bool is_up;      /**< It has moved up or down since it stood on the ground. */
    bool is_crashed; /**< It lies on its side or its back: motors stand, until it is disarmed. */
} copter_vertical_t;

/** Written by navigation. */
typedef struct copter_estimate {
    keel_altitude_t altitude;
    keel_position_t position;
    copter_vertical_t vertical;
    keel_cascade_estimate_t here;   /**< For the cascade: from home. */
    float home_north;               /**< Of the position's origin, in m. */
    float home_east;                /**< Of the position's origin, in m. */
    uint32_t blocks;                /**< What was taken of imu.blocks. */
    uint32_t pressures;             /**< What was taken of barometer.samples. */
    uint32_t fixes;                 /**< What was taken of gps.fixes. */
    uint32_t homes;                 /**< What was taken of state.homes. */
    uint32_t resets;                /**< How often the place jumped, as fixes contradicted it. */
    keel_cascade_vector_t reset_by; /**< How far it jumped the last time, in m. */
    copter_wmm_field_t field;       /**< The Earth's magnetic field at the origin. */
    uint32_t fields;                /**< How often an origin was set. */
    bool is_landed;                 /**< Nothing moves, and the motors hardly push. */
    bool touches;                   /**< It is to sink and does not: it may have landed. */
    bool rests;                     /**< It touches, and the motors do not carry it. */
} copter_estimate_t;

/** Written by position control, angle control and angle rate control. */
typedef struct copter_control {
    keel_cascade_t cascade;
    keel_mixer_t mixer;
    keel_cascade_vector_t place; /**< To be held or reached, in m from home. */
    keel_cascade_vector_t asked; /**< The velocity that is asked for, in m/s. */
    uint32_t resets;             /**< What was taken of estimate.resets. */
    float sink;                  /**< Thrust in a landing without a height, 0 to 1. */
    float sink_integral;         /**< The part of it that grew with time, of what hovers. */
    uint8_t state;               /**< Of the state machine, in the last run. */
    uint8_t mode;                /**< The mode in the last run. */
} copter_control_t;

/** A side of the fence. */
typedef enum copter_side {
    COPTER_SIDE_NONE = 0, /**< It never went out. */
    COPTER_SIDE_LOW,
    COPTER_SIDE_HIGH,
    COPTER_SIDE_AROUND
} copter_side_t;

/** The aircraft went out of the fence. */
typedef struct copter_breach {
    uint32_t count;   /**< How often. */
    uint64_t last_us; /**< When it last did. */
    uint8_t side;     /**< Where: copter_side_t. */
} copter_breach_t;

/** Written by the state machine. */
typedef struct copter_state {
    keel_mode_t mode;
    uint32_t frames; /**< What was taken of pilot.frames. */
    uint32_t homes;  /**< Counts take-offs: home is where the last was. */
    uint64_t stepped_us;
    copter_breach_t breach;
    uint32_t refusals;    /**< Attempts to arm, by the switch or for a station, that failed. */
    uint32_t unconfirmed; /**< Runs in a row in which no second inertial unit confirms the first. */
    bool lands_unconfirmed; /**< It was asked to land for that. */
} copter_state_t;

/** Written by scheduler analysis, stack and ADC. */
typedef struct copter_health {
    keel_load_t window;
    uint32_t load_ppm;   /**< In the last window. */
    uint32_t overruns;   /**< Runs of all tasks that were longer than their budgets. */
    uint32_t skipped;    /**< Periods of all tasks that passed without a run. */
    uint32_t stack_free; /**< In bytes. */
    uint32_t checks;     /**< KEEL_MODE_CHECK_CPU_LOAD, if it holds. */
    copter_chip_t chip;  /**< As the last run of ADC found it. */
} copter_health_t;

/** A task: its body is handed the copter. */
typedef struct copter copter_t;
typedef struct copter_task {
    copter_t *copter;
    void (*body)(copter_t *copter);
    uint32_t row;     /**< Of urpilot_task; from URPILOT_TASK_COUNT on a task beside those. */
    uint32_t wcet_us; /**< What a run is said to take at most, as port.end_run is told. */
} copter_task_t;

/** A task beside those of table 2, of low priority: it waits for all others. */
typedef struct copter_own_task {
    const char *name;
    void (*body)(copter_t *copter);
    uint32_t period_us;
    uint32_t wcet_us;   /**< Worst-case execution time of the body. */
    uint32_t budget_us; /**< To be declared: wcet_us, and the scheduler's own time for a run. */
    uint32_t phase_us;  /**< Time until the first release. */
} copter_own_task_t;

/** A copter. Read it freely. */
struct copter {
    const copter_port_t *port;
    copter_imu_t imu;
    copter_calibration_t calibration;
    copter_magnetometer_t magnetometer;
    copter_barometer_t barometer;
    copter_gps_t gps;
    copter_pilot_t pilot;
    copter_power_t power;
    copter_estimate_t estimate;
    copter_state_t state;
    copter_control_t control;
    copter_health_t health;
    copter_log_t log;
    copter_parameter_store_t parameters;
    copter_action_request_t request;    /**< Written by telemetry and the state machine. */
    struct copter_telemetry *telemetry; /**< Null without. */
    keel_scheduler_t scheduler;
    copter_task_t task[COPTER_TASKS];
    uint32_t tasks;          /**< How many of them there are. */
    keel_task_table_t table; /**< How late their runs started. */
    bool plain_mean;         /**< The units' plain mean flies in place of their vote. */
};

/**
 * Makes a copter and starts its scheduler; then call keel_scheduler_step for ever.
 *
 * @param copter     the copter
 * @param port       what it runs on; kept
 * @param plain_mean the units' plain mean in place of their vote: to compare, not to fly
 * @return KEEL_OK; KEEL_ERR_SENSORS if the port has fewer inertial units than COPTER_IMUS_LEAST or
 *         more than COPTER_IMUS; or what the first unit that refuses its settings says
 */
keel_status_t copter_start(copter_t *copter, const copter_port_t *port, bool plain_mean);

/**
 * Adds a task beside those of table 2 to a copter that was started.
 *
 * @param copter the copter
 * @param own    the task; its name is kept
 * @return KEEL_OK; KEEL_ERR_FULL when there are COPTER_OWN_TASKS of them; what keel_scheduler_add
 *         says, above all when its budget fits in no gap
 */
keel_status_t copter_add(copter_t *copter, const copter_own_task_t *own);

/**
 * Adds the task that moves the log to the port, which must have log_room and write_log; without
 * this task nothing is logged. The copter was started.
 *
 * @param copter the copter
 * @return as copter_add
 */
keel_status_t copter_log_start(copter_t *copter);

/**
 * Has each run of each task logged, too (bsp/common/trace_log.h). The inertial units' samples
 * are left out then: there is no room for both.
 *
 * @param copter the copter, behind copter_log_start and before the first step
 */
void copter_log_runs(copter_t *copter);

/**
 * Logs the run of copter->log.trace.
 *
 * @param copter the copter
 */
void copter_log_run(copter_t *copter);

/**
 * Samples the topics of a task whose run ends.
 *
 * @param copter the copter
 * @param row    the task's, or COPTER_LOG_ROW
 */
void copter_log_sample(copter_t *copter, uint32_t row);

/**
 * Puts in force what was set of parameters and does not wait for a restart. Units that hold such
 * settings are made anew, which is for the ground alone: the copter is disarmed.
 *
 * @param copter the copter
 */
void copter_retune(copter_t *copter);

/**
 * The declaration by which the scheduler knows a task: one set, for one copter.
 *
 * @param row which of urpilot_task; those that were added follow
 */
const keel_task_config_t *copter_declaration(uint32_t row);

/** The body of each task of table 2, which hands it what it writes (tasks.c). */
extern void (*const copter_bodies[URPILOT_TASK_COUNT])(copter_t *copter);

/** @name The bodies of the tasks, by the files that have them.
 * A body may write where its first parameters point to; the copter is for reading. */
/** @{ */
keel_status_t copter_imu_init(copter_imu_t *imu, uint32_t units);
void copter_background_imu(copter_imu_t *self, const copter_t *copter);
void copter_foreground_imu(copter_imu_t *self, const copter_t *copter);

keel_status_t copter_magnetometer_init(copter_magnetometer_t *magnetometer);
void copter_background_magnetometer(copter_magnetometer_t *self, const copter_t *copter);
void copter_foreground_magnetometer(copter_magnetometer_t *self, const copter_t *copter);

keel_status_t copter_barometer_init(copter_barometer_t *barometer);
void copter_background_barometer(copter_barometer_t *self, const copter_t *copter);
void copter_foreground_barometer(copter_barometer_t *self);

keel_status_t copter_gps_init(copter_gps_t *gps);
void copter_gps(copter_gps_t *self, const copter_t *copter);

/** Remembers a byte of the satellite receiver. */
void copter_date_take(copter_date_t *date, uint8_t byte);
/** Reads the date of the NAV-PVT that the last byte ended; without one it stays what it is. */
void copter_date_read(copter_date_t *date, uint64_t now_us);
/** The date now, in us since 1970 began (UTC), late by what the receiver takes, a tenth of a second
 * or two; 0: it is not known. */
uint64_t copter_utc_us(const copter_date_t *date, uint64_t now_us);

keel_status_t copter_pilot_init(copter_pilot_t *pilot);
/** The sticks' curves and low-passes take their settings; the sticks rest until the next step. */
keel_status_t copter_pilot_tune(copter_pilot_t *pilot);
/** A step of the sticks' low-passes and of what they ask for; at COPTER_CONTROL_HZ. */
void copter_pilot_smooth(copter_pilot_t *pilot);
void copter_background_radio(copter_pilot_t *self, const copter_t *copter);
void copter_foreground_radio(copter_pilot_t *self);

keel_status_t copter_power_init(copter_power_t *power);
void copter_background_power_module(copter_power_t *self, const copter_t *copter);
void copter_foreground_power_module(copter_power_t *self, const copter_t *copter);

keel_status_t copter_estimate_init(copter_estimate_t *estimate);
void copter_navigation(copter_estimate_t *self, const copter_t *copter);

/** Knows neither a height nor another thrust that hovers than what is configured. */
keel_status_t copter_vertical_init(copter_vertical_t *vertical);
/** A step of navigation's, behind that of the barometer's estimator. */
void copter_vertical_step(copter_estimate_t *estimate, const copter_t *copter,
                          const copter_vertical_force_t *force, bool has_fix);
/** Writes height and climb rate into estimate->here, and a reset where the source changes. */
void copter_vertical_tell(copter_estimate_t *estimate);
/** Whether it stands on the ground or lies there, and what hovers; behind copter_vertical_tell. */
void copter_vertical_conclude(copter_estimate_t *estimate, const copter_t *copter);

keel_status_t copter_state_machine_init(copter_state_t *state);
void copter_state_machine(copter_state_t *self, copter_action_request_t *request,
                          const copter_t *copter);

keel_status_t copter_control_init(copter_control_t *control);
void copter_position_control(copter_control_t *self, const copter_t *copter);
void copter_angle_control(copter_control_t *self, copter_pilot_t *pilot, const copter_t *copter);
void copter_angle_rate_control(copter_control_t *self, const copter_t *copter);

void copter_scheduler_analysis(copter_health_t *self, const copter_t *copter);
void copter_stack(copter_health_t *self, copter_parameter_store_t *parameters,
                  const copter_t *copter);
void copter_adc(copter_health_t *self, const copter_t *copter);

keel_status_t copter_calibration_init(copter_calibration_t *calibration, uint32_t units);
/** Whether something has moved since its calibration at rest began. */
bool copter_has_moved(const keel_calibration_rest_t *rest);
/** Takes corrections from the settings. */
void copter_calibration_set(copter_calibration_t *calibration);
/** Corrects what a unit says, its specific force first, and turns it into the vehicle's axes. */
void copter_calibration_correct(const copter_calibration_t *calibration, uint32_t unit,
                                float value[KEEL_VIRTUAL_IMU_CHANNELS]);
keel_status_t copter_accel_calibration_init(copter_accel_calibration_t *self, uint32_t units);
/** Takes corrections and turn from the settings. */
void copter_accel_calibration_set(copter_accel_calibration_t *self);
/** Begins to calibrate them, or ends that. */
void copter_accel_calibration_ask(copter_accel_calibration_t *self, uint8_t levelling);
/** A run of calibration IMU, behind what it does for gyroscopes. */
void copter_accel_calibration_step(copter_accel_calibration_t *self, const copter_t *copter);
void copter_calibration_imu(copter_calibration_t *self, const copter_t *copter);
void copter_calibration_magnetometer(copter_calibration_t *self, const copter_t *copter);
/** @} */

#endif
