/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file settings.h
 * @brief The numbers of one aircraft.
 */
#ifndef COPTER_SETTINGS_H
#define COPTER_SETTINGS_H

#include "keel/flight/attitude.h"
#include "keel/flight/axis.h"
#include "keel/flight/battery.h"
#include "keel/flight/calibration.h"
#include "keel/flight/cascade.h"
#include "keel/flight/mixer.h"
#include "keel/flight/mode.h"
#include "keel/flight/position.h"
#include "keel/flight/reference.h"
#include "keel/middleware/ubx.h"
#include "keel/middleware/virtual_imu.h"
#include "rc.h"

#include <stdbool.h>
#include <stdint.h>

/** A check before arming beside KEEL_MODE_CHECK_: the pressure may be that of the ground. */
#define COPTER_CHECK_GROUND_PRESSURE 0x1000u

/** Another one: the safety switch is not at safe, or not used. */
#define COPTER_CHECK_SAFETY_SWITCH 0x2000u

/** How often units vote, in Hz: table 2, foreground IMU. */
#define COPTER_VOTE_HZ 500.0f

/** How often the sticks are smoothed, in Hz: table 2, angle control. */
#define COPTER_CONTROL_HZ 500.0f

/** All that a unit is made from, and what the tasks decide by. */
typedef struct copter_settings {
    keel_virtual_imu_config_t imu;
    keel_virtual_imu_config_t slow; /**< Of the vote on what is left of units without motion. */
    float slow_gain;                /**< Of what they say, so much a vote: 2 pi f / 500 Hz. */
    float accelerometer_hz;         /**< The cut-off of what is voted on, in Hz. */
    float gyroscope_hz;             /**< The same. */
    keel_calibration_rest_config_t gyroscope;    /**< Of each unit. */
    keel_calibration_rest_config_t rest;         /**< Of the field, while those are calibrated. */
    keel_calibration_field_config_t field;       /**< Of the magnetometer. */
    keel_calibration_rest_config_t side;         /**< Of an accelerometer that lies on a side. */
    keel_calibration_correction_t correction[3]; /**< Of each accelerometer. */
    float trim[2];                               /**< Roll and pitch that are mounted, in rad. */
    float board[3];                              /**< The board's roll, pitch, yaw, in rad. */
    keel_calibration_correction_t magnetometer;  /**< Of the magnetometer, in microtesla. */
    float field_per_ampere[3]; /**< What the battery's current adds to it, in microtesla per A. */
    keel_attitude_config_t attitude;
    keel_axis_config_t altitude;
    keel_position_config_t position;
    copter_rc_config_t rc;
    keel_ubx_config_t gps;
    keel_reference_config_t reference;
    float stick_hz; /**< The cut-off of the sticks' low-pass, in Hz. */
    keel_battery_config_t battery;
    keel_mode_config_t mode;
    keel_cascade_config_t cascade;
    keel_mixer_config_t mixer;
    uint32_t load_limit_ppm;   /**< The greatest load with which it may be armed. */
    float level;               /**< The least cosine of the tilt with which it may be armed. */
    float ground_least;        /**< The least pressure with which it may be armed, in Pa: not below
                                  half of the greatest, or an MS5607 may be taken for an MS5611. */
    float ground_most;         /**< The greatest pressure with which it may be armed, in Pa. */
    float landed_rate;         /**< Less than this on the ground, in rad/s. */
    float landed_acceleration; /**< Less than this on the ground, along it, in m/s^2. */
    float landed_speed;        /**< Less than this on the ground, up or down, in m/s. */
    float home_radius;         /**< Within this of home, to either side, it is there, in m. */
    float return_height;       /**< At least so high on the way home, in m. */
    float land_fast;           /**< Landing, from high above, in m/s. */
    float land_slow;           /**< Landing, near the ground, in m/s. */
    float land_near;           /**< Below this height the ground is near, in m. */
    float height_accuracy;     /**< Of a receiver's height, at worst, in m. */
    float stop_s;              /**< How far it goes on when the sticks are let go: in s. */
    float fence_margin;        /**< The pilot comes so near to the fence, in m. */
    float fence_rate;          /**< Of the way that is left, so much a second, in 1/s. */
    bool safety_switch;        /**< The board's safety switch is used: at safe it does not arm. */
    bool buzzer;               /**< The board's buzzer sounds. */
    uint8_t system;            /**< Its number among the vehicles that MAVLink connects. */
} copter_settings_t;

/** A quadcopter of 1.4 kg: the F450 that JSBSim comes with. */
extern const copter_settings_t copter_defaults;

/** The settings in force: the defaults with the parameters. copter_parameter_store_start and
 * copter_parameter_store_apply alone write them. */
extern copter_settings_t copter_settings;

#endif
