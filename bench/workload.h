/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file workload.h
 * @brief What the steps of the layers above the RTOS are measured with, on the host and on the
 *        Cortex-M7: configurations, and inputs that keep a step on its longest usual path.
 */
#ifndef KEEL_BENCH_WORKLOAD_H
#define KEEL_BENCH_WORKLOAD_H

#include "keel/flight/altitude.h"
#include "keel/flight/attitude.h"
#include "keel/flight/battery.h"
#include "keel/flight/calibration.h"
#include "keel/flight/cascade.h"
#include "keel/flight/mixer.h"
#include "keel/flight/mode.h"
#include "keel/flight/pid.h"
#include "keel/flight/position.h"
#include "keel/flight/reference.h"
#include "keel/middleware/crsf.h"
#include "keel/middleware/ibus.h"
#include "keel/middleware/log_ring.h"
#include "keel/middleware/mavlink.h"
#include "keel/middleware/ms5611.h"
#include "keel/middleware/ppm.h"
#include "keel/middleware/sbus.h"
#include "keel/middleware/signing.h"
#include "keel/middleware/ubx.h"
#include "keel/middleware/ulog.h"
#include "keel/middleware/virtual_imu.h"

#define STEPS 1000u
#define UNITS 3u

/* A signal that keeps moving, within 0 to 1. */
static float signal_at(uint32_t n)
{
    return (float)((n * 37u) % 101u) / 101.0f;
}

/* --- PID -------------------------------------------------------------------------------------- */

static const keel_pid_config_t pid_workload = {.gains = {2.0f, 5.0f, 0.02f, 0.5f},
                                               .rate_hz = 1000.0f,
                                               .cutoff_hz = 80.0f,
                                               .output_min = -100.0f,
                                               .output_max = 100.0f,
                                               .integral_min = -10.0f,
                                               .integral_max = 10.0f};

/* --- Reference generator ---------------------------------------------------------------------- */

static const keel_reference_config_t reference_workload = {.roll = {0.05f, 0.3f},
                                                           .pitch = {0.05f, 0.3f},
                                                           .yaw = {0.05f, 0.3f},
                                                           .climb = {0.05f, 0.3f},
                                                           .limits = {.roll_rate = 6.0f,
                                                                      .pitch_rate = 6.0f,
                                                                      .yaw_rate = 3.0f,
                                                                      .heading_rate = 1.5f,
                                                                      .tilt = 0.6f,
                                                                      .speed = 8.0f,
                                                                      .climb_rate = 4.0f,
                                                                      .descent_rate = 2.0f}};

/* A stick that keeps moving, from -1 to 1. */
static float stick_at(uint32_t n)
{
    return (2.0f * signal_at(n)) - 1.0f;
}

/* Sticks on both sides of their centres, in their dead bands now and then. */
static keel_reference_sticks_t sticks_at(uint32_t n)
{
    const keel_reference_sticks_t sticks = {.roll = stick_at(n),
                                            .pitch = stick_at(n + 7u),
                                            .yaw = stick_at(n + 14u),
                                            .climb = stick_at(n + 21u)};

    return sticks;
}

/* --- Mixer ------------------------------------------------------------------------------------ */

/* Torques of so much to twice as much about a middling thrust: with little, all that is asked for
 * fits; with much, everything gives way. */
static keel_mixer_command_t command_at(uint32_t n, float torque)
{
    const keel_mixer_command_t command = {.roll = torque * (1.0f + signal_at(n)),
                                          .pitch = -torque * (1.0f + signal_at(n + 1u)),
                                          .yaw = torque * (1.0f + signal_at(n + 2u)),
                                          .thrust = 0.4f + (0.2f * signal_at(n + 3u))};

    return command;
}

/* --- Mode ------------------------------------------------------------------------------------- */

/* With what the mode machine is told at each step from then on: in flight a frame each; on the
 * ground every fact that can be seen, waiting to settle. */
static keel_mode_input_t mode_workload(keel_mode_t *mode, uint32_t settle_us, bool flies)
{
    const keel_mode_config_t config = {.loss_us = 250000u,
                                       .regain_us = settle_us,
                                       .request_us = settle_us,
                                       .kill_us = settle_us,
                                       .landed_us = settle_us,
                                       .estimate_us = settle_us,
                                       .alarm_us = settle_us,
                                       .idle_us = settle_us,
                                       .required = 1u};
    keel_mode_input_t input = {.elapsed_us = 1000u, .facts = 0x074Du, .checks = 1u, .asked = 4u};

    (void)keel_mode_init(mode, &config);
    if (!flies) {
        input.facts = 0x3FFBu;
        return input;
    }
    for (uint32_t n = 0u; n < STEPS; n++) {
        keel_mode_step(mode, &input);
    }
    input.facts ^= KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF;
    for (uint32_t n = 0u; n < STEPS; n++) {
        input.facts ^= (n == (STEPS / 2u)) ? (KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW) : 0u;
        keel_mode_step(mode, &input);
    }
    return input;
}

/* --- Attitude --------------------------------------------------------------------------------- */

static const keel_attitude_config_t attitude_workload = {.rate_hz = 1000.0f,
                                                         .tilt_gain = 0.5f,
                                                         .heading_gain = 0.5f,
                                                         .align_gain = 8.0f,
                                                         .bias_gain = 0.02f,
                                                         .force_gain = 0.5f,
                                                         .field_share = 0.0625f,
                                                         .bias_limit = 0.1f,
                                                         .quiet_rate = 0.3f,
                                                         .clip_rate = 34.0f,
                                                         .still_rate = 0.05f,
                                                         .still_acceleration = 0.5f,
                                                         .tolerance = 0.02f,
                                                         .north = 21.6f,
                                                         .still_steps = 10u,
                                                         .settle_steps = 10u,
                                                         .lost_steps = 10u,
                                                         .field_steps = 100u};

/* At rest but for a little; the magnetometer gives a tenth as many samples as the others. */
static keel_attitude_sample_t attitude_sample_at(uint32_t n)
{
    const keel_attitude_sample_t sample = {.gyroscope = {.x = 0.04f * signal_at(n)},
                                           .accelerometer = {0.0f, 0.0f, -9.8f},
                                           .magnetometer = {21.6f, 0.0f, 43.0f},
                                           .acceleration = {.y = 0.1f * signal_at(n)},
                                           .has_gyroscope = true,
                                           .has_accelerometer = true,
                                           .has_magnetometer = (n % 10u) == 0u,
                                           .has_acceleration = true};

    return sample;
}

/* --- Cascade ---------------------------------------------------------------------------------- */

static keel_cascade_config_t cascade_workload(void)
{
    static const float reach[KEEL_CASCADE_AXES] = {6.0f, 6.0f, 3.0f,  0.5f,  0.5f, 8.0f,
                                                   8.0f, 3.0f, 90.0f, 90.0f, 60.0f};
    static const float most[KEEL_CASCADE_AXES] = {1.0f, 1.0f, 1.0f, 5.0f, 5.0f, 3.4f,
                                                  3.4f, 0.3f, 6.0f, 6.0f, 2.5f};
    keel_cascade_config_t config = {
        .hover = 0.375f, .acceleration = 4.0f, .braking = 1.5f, .reaction_s = 0.5f};

    for (uint32_t i = 0u; i < KEEL_CASCADE_AXES; i++) {
        config.reach[i] = reach[i];
        config.pid[i] = pid_workload;
        config.pid[i].output_min = -most[i];
        config.pid[i].output_max = most[i];
        config.pid[i].integral_min = -most[i];
        config.pid[i].integral_max = most[i];
    }
    return config;
}

/* On the way somewhere, with numbers that keep moving. */
static keel_cascade_estimate_t place_at(uint32_t n)
{
    const keel_cascade_estimate_t estimate = {.position = {10.0f * signal_at(n), 5.0f, 3.0f},
                                              .velocity = {signal_at(n), 0.5f, 0.1f * signal_at(n)},
                                              .forward_north = 0.8f,
                                              .forward_east = 0.6f,
                                              .has_place = true,
                                              .has_height = true};

    return estimate;
}

/* What the tasks of a cascade do, once each: all four stages. */
static void bench_cascade_steps(keel_cascade_t *cascade, const keel_cascade_estimate_t *estimate)
{
    const keel_cascade_vector_t there = {12.0f, 4.0f, 3.5f};
    const keel_attitude_vector_t down = {0.1f * estimate->velocity.north, -0.05f, 0.99f};
    const keel_attitude_vector_t rate = {0.2f * estimate->velocity.north, 0.1f, -0.1f};
    keel_cascade_rates_t rates = {.yaw = 0.3f};

    keel_cascade_position_step(cascade, there, estimate);
    keel_cascade_velocity_step(cascade, cascade->velocity, estimate);
    keel_cascade_angle_step(cascade, cascade->tilt, down, true);
    rates.roll = cascade->rates.roll;
    rates.pitch = cascade->rates.pitch;
    rates.thrust = cascade->thrust;
    keel_cascade_rate_step(cascade, rates, rate, 0u);
}

/* --- Altitude and position -------------------------------------------------------------------- */

#define AXIS_WORKLOAD                                                                              \
    {.rate_hz = 100.0f,                                                                            \
     .position_gain = 0.25f,                                                                       \
     .velocity_gain = 0.25f,                                                                       \
     .rate_gain = 0.25f,                                                                           \
     .bias_gain = 0.03125f,                                                                        \
     .bias_limit = 1.0f,                                                                           \
     .position_gate = 50.0f,                                                                       \
     .velocity_gate = 20.0f,                                                                       \
     .late_steps = 20u,                                                                            \
     .lost_steps = 200u,                                                                           \
     .settle_fixes = 5u,                                                                           \
     .jump_fixes = 5u}

static const keel_axis_config_t altitude_workload = AXIS_WORKLOAD;

static const keel_position_config_t position_workload = {
    .axis = AXIS_WORKLOAD, .accuracy = 5.0f, .speed_accuracy = 1.0f};

/* A pressure in each step: the most that there can be to do. */
static keel_altitude_sample_t altitude_sample_at(uint32_t n)
{
    const keel_altitude_sample_t sample = {.pressure = 100000.0f + (10.0f * signal_at(n)),
                                           .acceleration = 0.1f * signal_at(n),
                                           .has_pressure = true,
                                           .has_acceleration = true};

    return sample;
}

/* A fix in each step. */
static keel_position_sample_t position_sample_at(uint32_t n)
{
    const keel_position_sample_t sample = {.fix = {.latitude = 481000000 + (int32_t)(n % 100u),
                                                   .longitude = 115000000 - (int32_t)(n % 50u),
                                                   .north = 0.1f * signal_at(n),
                                                   .east = -0.1f * signal_at(n),
                                                   .accuracy = 2.0f,
                                                   .speed_accuracy = 0.5f,
                                                   .is_valid = true},
                                           .north = 0.1f * signal_at(n),
                                           .east = 0.1f * signal_at(n),
                                           .has_fix = true,
                                           .has_acceleration = true};

    return sample;
}

/* --- Battery ---------------------------------------------------------------------------------- */

static const keel_battery_config_t battery_workload = {.capacity_ah = 5.0f,
                                                       .initial = 1.0f,
                                                       .resistance_ohm = 0.01f,
                                                       .voltage_min = 6.0f,
                                                       .voltage_max = 26.0f,
                                                       .voltage_spread = 0.5f,
                                                       .current_min = -1.0f,
                                                       .current_max = 120.0f,
                                                       .current_expected = 15.0f,
                                                       .cap_s = 3600.0f,
                                                       .low_voltage = 3.5f,
                                                       .critical_voltage = 3.3f,
                                                       .voltage_margin = 0.2f,
                                                       .low_charge = 0.25f,
                                                       .critical_charge = 0.15f,
                                                       .rate_hz = 20u,
                                                       .smoothing_steps = 100u,
                                                       .settle_steps = 40u,
                                                       .hold_steps = 10u,
                                                       .cells = 4u,
                                                       .modules = 2u};

/* In flight, with all samples of both modules. */
static keel_battery_sample_t battery_sample_at(uint32_t n)
{
    const keel_battery_sample_t sample = {
        .module = {{15.8f, 7.0f + signal_at(n), true, true}, {15.9f, 7.5f, true, true}},
        .running = true};

    return sample;
}

/* --- Calibration ------------------------------------------------------------------------------ */

static const keel_calibration_rest_config_t calibration_workload = {
    .expected = {0.0f, 0.0f, -9.80665f},
    .spread = 4.0f,
    .limit = 4.0f,
    .samples = KEEL_CALIBRATION_SAMPLES_MAX};

/* At rest, but for what vibrates. */
static keel_calibration_vector_t calibration_sample_at(uint32_t n)
{
    const float noise = 0.1f * signal_at(n);
    const keel_calibration_vector_t sample = {{0.1f + noise, 0.2f - noise, noise - 9.9f}};

    return sample;
}

/* --- MS5611 ----------------------------------------------------------------------------------- */

static const keel_ms5611_t ms5611_workload = {.sensitivity = 40127u,
                                              .offset = 36924u,
                                              .sensitivity_slope = 23317u,
                                              .offset_slope = 23282u,
                                              .reference = 33464u,
                                              .temperature_slope = 28312u};

/* Below -15 degrees, with all corrections. */
static uint32_t ms5611_pressure_at(uint32_t n)
{
    return 9085466u + (n % 4096u);
}

static uint32_t ms5611_temperature_at(uint32_t n)
{
    return 7233450u + (n % 256u);
}

/* --- SBUS ------------------------------------------------------------------------------------- */

static const keel_sbus_config_t sbus_workload = {
    .gap_us = 1000u, .lowest = 8u, .highest = 1976u, .judged = 0x000Fu};

/* One frame behind the other, all channels in the middle, 8 in 11 bytes. */
static uint8_t sbus_byte_at(uint32_t n)
{
    static const uint8_t middle[11] = {0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07,
                                       0x3E, 0xF0, 0x81, 0x0F, 0x7C};
    const uint32_t at = n % 25u;

    if (at == 0u) {
        return 0x0Fu;
    }
    return (at < 23u) ? middle[(at - 1u) % 11u] : 0x00u;
}

/* --- UBX -------------------------------------------------------------------------------------- */

static const keel_ubx_config_t ubx_workload = {
    .gap_us = 20000u, .max_age_us = 500000u, .accuracy_mm = 5000u, .speed_accuracy = 1000u};

/* One NAV-PVT behind the other. All zeros and a fix in three dimensions that is vouched for, so its
 * checksum is that of the header, 0x64 0xD1, with 3 behind 24 bytes and 1 behind 25: a sum of 0x68,
 * and 0xD1 + 92 * 0x64 + 72 * 3 + 71 * 1, modulo 256. */
static uint8_t ubx_byte_at(uint32_t n)
{
    static const uint8_t header[6] = {0xB5, 0x62, 0x01, 0x07, 0x5C, 0x00};
    const uint32_t at = n % 100u;
    uint8_t byte = 0u;

    if (at < 6u) {
        byte = header[at];
    } else if (at == 26u) {
        byte = 3u;
    } else if (at == 27u) {
        byte = 1u;
    } else if (at == 98u) {
        byte = 0x68u;
    } else if (at == 99u) {
        byte = (uint8_t)((0xD1u + (92u * 0x64u) + (72u * 3u) + 71u) % 256u);
    } else {
        byte = 0u;
    }
    return byte;
}

/* --- Log -------------------------------------------------------------------------------------- */

/* What an inertial unit measured: its time, six values, an age. */
#define LOG_RECORD 36u

static const uint8_t log_workload[LOG_RECORD] = {1u, 2u, 3u};

/* --- MAVLink ---------------------------------------------------------------------------------- */

static const keel_mavlink_message_t mavlink_workload[1] = {
    {.id = 0u, .crc_extra = 50u, .shortest = 1u, .longest = 9u}};

/* One heartbeat behind the other. */
static uint8_t mavlink_byte_at(uint32_t n)
{
    static const uint8_t heartbeat[21] = {0xFD, 9, 0, 0, 0, 1, 1, 0, 0,    0,   0,
                                          0,    0, 0, 2, 0, 0, 3, 3, 0x83, 0x46};

    return heartbeat[n % 21u];
}

/* --- Signatures ------------------------------------------------------------------------------- */

/* A heartbeat that is signed; its seal is what the hash below leaves. */
static const keel_mavlink_frame_t signing_workload = {
    .system = 255u, .component = 190u, .length = 9u, .is_signed = true, .timestamp = 1u};

static const uint8_t signing_key[KEEL_SIGNING_KEY_BYTES] = {1u, 2u, 3u};

/* None: the hash is no part of Keel, and its time is not counted. */
static void bench_hash(const uint8_t *data, uint32_t size, uint8_t *digest)
{
    (void)data;
    (void)size;
    (void)digest;
}

/* --- CRSF ------------------------------------------------------------------------------------- */

static const keel_crsf_config_t crsf_workload = {
    .gap_us = 300u, .channels_us = 200000u, .link_us = 0u};

/* One frame behind the other: channels 172, 1811, and 992 fourteen times. */
static uint8_t crsf_byte_at(uint32_t n)
{
    static const uint8_t frame[26] = {0xC8, 0x18, 0x16, 0xAC, 0x98, 0x38, 0xF8, 0xC0, 0x07,
                                      0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0xE0, 0x03, 0x1F, 0xF8,
                                      0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x20};

    return frame[n % 26u];
}

/* --- IBUS ------------------------------------------------------------------------------------- */

static const keel_ibus_config_t ibus_workload = {
    .gap_us = 500u, .judged = 0x0000Fu, .lowest = 885u, .highest = 2115u, .extended = false};

/* One frame behind the other: channels of 1500 us. */
static uint8_t ibus_byte_at(uint32_t n)
{
    static const uint8_t ends[4] = {0x20, 0x40, 0x51, 0xF3};
    const uint32_t at = n % 32u;

    if (at < 2u) {
        return ends[at];
    }
    if (at >= 30u) {
        return ends[at - 28u];
    }
    return ((at % 2u) == 0u) ? 0xDCu : 0x05u;
}

/* --- PPM -------------------------------------------------------------------------------------- */

static const keel_ppm_config_t ppm_workload = {.lost_us = 100000u,
                                               .lowest_us = 800u,
                                               .highest_us = 2200u,
                                               .sync_us = 2300u,
                                               .judged = 0x000Fu,
                                               .least = 4u,
                                               .frames_to_take = 3u};

/* Frames of eight channels, and a sync gap. */
static uint32_t ppm_edge_at(uint32_t n)
{
    return ((n % 9u) == 0u) ? 8000u : 1500u;
}

/* --- Virtual IMU ------------------------------------------------------------------------------ */

static const keel_voter_config_t voter_workload = {.agree = 0.25f,
                                                   .cutoff = 3.0f,
                                                   .slope = 0.01f,
                                                   .lowest = -160.0f,
                                                   .highest = 160.0f,
                                                   .max_age_us = 10000u,
                                                   .latch_count = UINT16_MAX,
                                                   .stale_count = 50u,
                                                   .readmit_count = 100u,
                                                   .sensors = UNITS};

/* Samples that keep moving: with no offset all units' within the distance of full agreement; the
 * last unit's differ by the offset more. */
static void samples_at(keel_virtual_imu_sample_t sample[UNITS], uint32_t n, float offset)
{
    for (uint32_t i = 0u; i < UNITS; i++) {
        sample[i].age_us = 100u;
        sample[i].present = true;
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            sample[i].value[k] = (0.2f * signal_at((3u * n) + (7u * i) + k)) +
                                 ((i == (UNITS - 1u)) ? offset : 0.0f);
        }
    }
}

#endif
