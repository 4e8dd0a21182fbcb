/* SPDX-License-Identifier: Apache-2.0 */
/* JSBSim's F450: 1.4 kg, arms of 0.23 m, 9.4 inch propellers; it hovers at 0.37 of its throttle on
 * a full battery. The gains follow from this: a unit of roll or pitch torque turns it with about
 * 490 rad/s^2, of yaw with about 44 rad/s^2, and a unit of thrust lifts it with about 40 m/s^2. */
#include "settings.h"

#define CONTROL_HZ    COPTER_CONTROL_HZ /* And angle rate control. */
#define POSITION_HZ   100.0f            /* Position control. */
#define NAVIGATION_HZ 50.0f

#define HOVER 0.37f

/* A controller whose output and integral have limits that are even to both sides. */
#define PID(p, i, d, hz, cutoff, most, integral)                                                   \
    {.gains = {(p), (i), (d), 0.0f},                                                               \
     .rate_hz = (hz),                                                                              \
     .cutoff_hz = (cutoff),                                                                        \
     .output_min = -(most),                                                                        \
     .output_max = (most),                                                                         \
     .integral_min = -(integral),                                                                  \
     .integral_max = (integral)}

/* How a channel of three units votes; plausible up to a limit that is even to both sides. */
#define VOTER(a, n, grows, most, latch, stale, readmit)                                            \
    {.agree = (a),                                                                                 \
     .cutoff = (n),                                                                                \
     .slope = (grows),                                                                             \
     .lowest = -(most),                                                                            \
     .highest = (most),                                                                            \
     .initial = 0.0f,                                                                              \
     .max_age_us = 4000u,                                                                          \
     .latch_count = (latch),                                                                       \
     .stale_count = (stale),                                                                       \
     .readmit_count = (readmit),                                                                   \
     .density_limit = 0u,                                                                          \
     .sensors = COPTER_IMUS}

const copter_settings_t copter_defaults = {
    .imu = {.accelerometer = VOTER(6.0f, 2.5f, 0.1f, 160.0f, 100u, 40u, 1000u),
            .gyroscope = VOTER(0.3f, 3.0f, 0.3f, 35.0f, 100u, 40u, 1000u)},
    .slow = {.accelerometer = VOTER(1.0f, 3.0f, 0.1f, 160.0f, 25u, 8u, 100u),
             .gyroscope = VOTER(0.01f, 2.0f, 0.1f, 35.0f, 25u, 8u, 100u)},
    .slow_gain = 0.01257f, /* 1 Hz */
    .accelerometer_hz = 50.0f,
    .gyroscope_hz = 150.0f,
    .gyroscope = {.expected = {0.0f, 0.0f, 0.0f}, .spread = 0.03f, .limit = 0.1f, .samples = 50u},
    .rest = {.expected = {0.0f, 0.0f, 0.0f},
             .spread = 1.5f,
             .limit = KEEL_CALIBRATION_LIMIT, /* Any field, if only it rests. */
             .samples = 120u},
    .field = {.lowest = -400.0f,
              .highest = 400.0f,
              .span_min = 70.0f,
              .span_max = 140.0f,
              .limit = 150.0f}, /* MAG_OFF_X and so on take as much. */
    .side = {.expected = {0.0f, 0.0f, 0.0f}, .spread = 0.8f, .limit = 20.0f, .samples = 40u},
    .correction = {{.offset = {0.0f, 0.0f, 0.0f}, .scale = {1.0f, 1.0f, 1.0f}},
                   {.offset = {0.0f, 0.0f, 0.0f}, .scale = {1.0f, 1.0f, 1.0f}},
                   {.offset = {0.0f, 0.0f, 0.0f}, .scale = {1.0f, 1.0f, 1.0f}}},
    .trim = {0.0f, 0.0f},
    .board = {0.0f, 0.0f, 0.0f},
    .magnetometer = {.offset = {0.0f, 0.0f, 0.0f}, .scale = {1.0f, 1.0f, 1.0f}},
    .field_per_ampere = {0.0f, 0.0f, 0.0f},
    .attitude = {.rate_hz = CONTROL_HZ,
                 .tilt_gain = 0.3f,
                 .heading_gain = 0.25f,
                 .align_gain = 4.0f,
                 .bias_gain = 0.03f,
                 .force_gain = 0.4f,
                 .field_share = 0.015625f, /* At 100 Hz, a time constant of 0.64 s. */
                 .bias_limit = 0.2f,
                 .quiet_rate = 0.7f,
                 .clip_rate = 34.0f,
                 .still_rate = 0.05f,
                 .still_acceleration = 1.0f,
                 .tolerance = 0.05f,
                 .north = 21.6f,
                 .east = 1.25f,
                 .still_steps = 500u,
                 .settle_steps = 100u,
                 .lost_steps = 25u,
                 .field_steps = 250u},
    .altitude = {.rate_hz = NAVIGATION_HZ,
                 .position_gain = 0.06f,
                 .velocity_gain = 0.06f,
                 .rate_gain = 0.0f,
                 .bias_gain = 0.03f,
                 .bias_limit = 1.0f,
                 .position_gate = 5.0f,
                 .velocity_gate = 50.0f,
                 .late_steps = 15u,
                 .lost_steps = 100u,
                 .settle_fixes = 25u,
                 .jump_fixes = 50u},
    .position = {.axis = {.rate_hz = NAVIGATION_HZ,
                          .position_gain = 0.2f,
                          .velocity_gain = 0.15f,
                          .rate_gain = 0.15f,
                          .bias_gain = 0.03f,
                          .bias_limit = 1.0f,
                          .position_gate = 5.0f,
                          .velocity_gate = 5.0f,
                          .late_steps = 15u,
                          .lost_steps = 200u,
                          .settle_fixes = 10u,
                          .jump_fixes = 30u},
                 .accuracy = 5.0f,
                 .speed_accuracy = 1.0f},
    .rc = {.protocol = COPTER_PROTOCOL_ANY,
           .sbus = {.gap_us = 1000u, .lowest = 8u, .highest = 1976u, .judged = 0x000Fu},
           .crsf = {.gap_us = 1000u, .channels_us = 300000u, .link_us = 0u},
           .ibus = {.gap_us = 2000u,
                    .judged = 0x0000Fu,
                    .lowest = 885u,
                    .highest = 2115u,
                    .extended = false},
           .ppm = {.lost_us = 100000u,
                   .lowest_us = 800u,
                   .highest_us = 2200u,
                   .sync_us = 2300u,
                   .judged = 0x000Fu,
                   .least = 5u,
                   .frames_to_take = 3u}},
    .gps = {.gap_us = 20000u, .max_age_us = 500000u, .accuracy_mm = 5000u, .speed_accuracy = 1000u},
    .reference = {.roll = {.dead_band = 0.03f, .expo = 0.3f},
                  .pitch = {.dead_band = 0.03f, .expo = 0.3f},
                  .yaw = {.dead_band = 0.03f, .expo = 0.3f},
                  .climb = {.dead_band = 0.08f, .expo = 0.3f},
                  .limits = {.roll_rate = 5.0f,
                             .pitch_rate = 5.0f,
                             .yaw_rate = 2.0f,
                             .heading_rate = 1.5f,
                             .tilt = 0.45f,
                             .speed = 5.0f,
                             .climb_rate = 2.0f,
                             .descent_rate = 1.0f}},
    .stick_hz = 15.0f, /* 15 ms later, and not a tenth is left of stairs 50 times a second. */
    .battery = {.capacity_ah = 5.0f,
                .initial = 1.0f,
                .resistance_ohm = 0.02f,
                .voltage_min = 8.0f,
                .voltage_max = 18.0f,
                .voltage_spread = 0.5f,
                .current_min = -1.0f,
                .current_max = 60.0f,
                .current_expected = 12.0f,
                .cap_s = 3600.0f,
                .low_voltage = 3.5f,
                .critical_voltage = 3.3f,
                .voltage_margin = 0.1f,
                .low_charge = 0.25f,
                .critical_charge = 0.15f,
                .rate_hz = 10u,
                .smoothing_steps = 100u,
                .settle_steps = 10u,
                .hold_steps = 20u,
                .cells = 4u,
                .modules = 2u},
    .mode = {.loss_us = 290000u,
             .regain_us = 500000u,
             .request_us = 300000u,
             .kill_us = 300000u,
             .landed_us = 1000000u,
             .estimate_us = 500000u,
             .alarm_us = 1000000u,
             .idle_us = 30000000u,
             .hold_us = 5000000u,
             .return_us = 120000000u,
             .required = KEEL_MODE_CHECK_GYROSCOPE | KEEL_MODE_CHECK_ACCELEROMETER |
                         KEEL_MODE_CHECK_MAGNETOMETER | KEEL_MODE_CHECK_BAROMETER |
                         KEEL_MODE_CHECK_POSITION_ESTIMATE | KEEL_MODE_CHECK_CALIBRATION |
                         KEEL_MODE_CHECK_LEVEL_ATTITUDE | KEEL_MODE_CHECK_BATTERY_LEVEL |
                         KEEL_MODE_CHECK_CPU_LOAD | KEEL_MODE_CHECK_HOME_POSITION |
                         COPTER_CHECK_GROUND_PRESSURE | COPTER_CHECK_SAFETY_SWITCH,
             .returns = true},
    .cascade =
        {.pid = {[KEEL_CASCADE_ROLL_RATE] = PID(0.05f, 0.1f, 0.001f, CONTROL_HZ, 90.0f, 1.0f,
                                                0.25f),
                 [KEEL_CASCADE_PITCH_RATE] = PID(0.05f, 0.1f, 0.001f, CONTROL_HZ, 90.0f, 1.0f,
                                                 0.25f),
                 [KEEL_CASCADE_YAW_RATE] = PID(0.15f, 0.1f, 0.0f, CONTROL_HZ, 90.0f, 1.0f, 0.25f),
                 [KEEL_CASCADE_ROLL] = PID(7.0f, 0.0f, 0.0f, CONTROL_HZ, 90.0f, 5.0f, 0.0f),
                 [KEEL_CASCADE_PITCH] = PID(7.0f, 0.0f, 0.0f, CONTROL_HZ, 90.0f, 5.0f, 0.0f),
                 [KEEL_CASCADE_NORTH_SPEED] = PID(1.8f, 0.6f, 0.0f, POSITION_HZ, 20.0f, 4.5f, 4.0f),
                 [KEEL_CASCADE_EAST_SPEED] = PID(1.8f, 0.6f, 0.0f, POSITION_HZ, 20.0f, 4.5f, 4.0f),
                 [KEEL_CASCADE_CLIMB] = PID(0.1f, 0.12f, 0.0f, POSITION_HZ, 20.0f, 0.3f, 0.3f),
                 [KEEL_CASCADE_NORTH] = PID(0.8f, 0.0f, 0.0f, POSITION_HZ, 20.0f, 5.0f, 0.0f),
                 [KEEL_CASCADE_EAST] = PID(0.8f, 0.0f, 0.0f, POSITION_HZ, 20.0f, 5.0f, 0.0f),
                 [KEEL_CASCADE_HEIGHT] = PID(1.0f, 0.0f, 0.0f, POSITION_HZ, 20.0f, 2.0f, 0.0f)},
         .reach = {[KEEL_CASCADE_ROLL_RATE] = 6.0f,
                   [KEEL_CASCADE_PITCH_RATE] = 6.0f,
                   [KEEL_CASCADE_YAW_RATE] = 3.0f,
                   [KEEL_CASCADE_ROLL] = 0.66f,
                   [KEEL_CASCADE_PITCH] = 0.66f,
                   [KEEL_CASCADE_NORTH_SPEED] = 8.0f,
                   [KEEL_CASCADE_EAST_SPEED] = 8.0f,
                   [KEEL_CASCADE_CLIMB] = 3.0f,
                   [KEEL_CASCADE_NORTH] = 100.0f,
                   [KEEL_CASCADE_EAST] = 100.0f,
                   [KEEL_CASCADE_HEIGHT] = 60.0f},
         .hover = HOVER,
         .acceleration = 4.9f, /* 30 degrees: 12 m/s of wind take so much of a light aircraft. */
         .braking = 1.5f,
         .reaction_s = 0.5f},
    .mixer = {.idle = 0.05f, .highest = 1.0f, .yaw_share = 0.1f},
    .load_limit_ppm = 500000u,
    .level = 0.94f,
    .ground_least = 55000.0f, /* Half of the greatest, and 4860 m in the standard atmosphere. */
    .ground_most = 110000.0f,
    .landed_rate = 0.3f,
    .landed_acceleration = 1.5f,
    .landed_speed = 0.4f,
    .home_radius = 1.5f,
    .return_height = 10.0f,
    .land_fast = 1.5f,
    .land_slow = 0.5f,
    .land_near = 5.0f,
    .height_accuracy = 10.0f,
    .stop_s = 0.8f,
    .fence_margin = 2.0f,
    .fence_rate = 0.25f,
    .buzzer = true,
    .system = 1u};
