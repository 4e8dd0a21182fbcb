/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bench_steps.c
 * @brief Runs the steps of the layers above the RTOS so that callgrind can count their
 *        instructions. Started by tools/keel bench; counts nothing outside valgrind.
 *
 * Each step is taken many times; what is dumped is labelled with its name and the number of steps.
 */
#include "workload.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <valgrind/callgrind.h>

#define LABEL_SIZE 64u

static keel_altitude_t bench_altitude;
static keel_attitude_t bench_attitude;
static keel_position_t bench_position;
static keel_battery_t bench_battery;
static keel_cascade_t bench_cascade;
static keel_calibration_rest_t bench_calibration;
static keel_filter_t bench_filter;
static keel_pid_t bench_pid;
static keel_mixer_t bench_mixer;
static keel_mode_t bench_mode;
static keel_reference_t bench_reference;
static keel_log_ring_t bench_ring;
static keel_sbus_t bench_sbus;
static keel_ubx_t bench_ubx;
static keel_mavlink_t bench_mavlink;
static keel_signing_t bench_signing;
static keel_ulog_message_t bench_message;
static keel_crsf_t bench_crsf;
static keel_ibus_t bench_ibus;
static keel_ppm_t bench_ppm;
static keel_virtual_imu_t bench_imu;

static void bench_require(int condition, const char *what)
{
    if (!condition) {
        (void)fprintf(stderr, "bench_steps: %s\n", what);
        exit(EXIT_FAILURE);
    }
}

static void bench_dump(const char *name)
{
    char label[LABEL_SIZE];

    (void)snprintf(label, sizeof(label), "keel %s %u", name, STEPS);
    CALLGRIND_DUMP_STATS_AT(label);
}

static void bench_run_filter(void)
{
    bench_require(keel_filter_init(&bench_filter, 1000.0f, 80.0f) == KEEL_OK, "filter");
    for (uint32_t n = 0u; n < STEPS; n++) {
        const float input = signal_at(n);
        keel_status_t status;

        CALLGRIND_TOGGLE_COLLECT;
        status = keel_filter_step(&bench_filter, input);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(status == KEEL_OK, "filter step");
    }
    bench_dump("filter");
}

static void bench_run_pid(void)
{
    bench_require(keel_pid_init(&bench_pid, &pid_workload) == KEEL_OK, "PID");
    bench_require(keel_pid_step(&bench_pid, 0.5f, 0.5f) == KEEL_OK, "first PID step");
    for (uint32_t n = 0u; n < STEPS; n++) {
        const float measurement = signal_at(n);
        keel_status_t status;

        CALLGRIND_TOGGLE_COLLECT;
        status = keel_pid_step(&bench_pid, 0.5f, measurement);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(status == KEEL_OK, "PID step");
    }
    bench_dump("pid");
}

static void bench_run_reference(void)
{
    bench_require(keel_reference_init(&bench_reference, &reference_workload) == KEEL_OK,
                  "reference");
    for (uint32_t n = 0u; n < STEPS; n++) {
        const keel_reference_sticks_t sticks = sticks_at(n);
        keel_status_t status;

        CALLGRIND_TOGGLE_COLLECT;
        status = keel_reference_step(&bench_reference, &sticks);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(status == KEEL_OK, "reference step");
    }
    bench_dump("reference");
}

static void bench_run_mixer(const char *name, float torque, uint8_t limited)
{
    const keel_mixer_config_t config = {keel_mixer_quad_x, 0.05f, 1.0f, 0.1f};

    bench_require(keel_mixer_init(&bench_mixer, &config) == KEEL_OK, "mixer");
    for (uint32_t n = 0u; n < STEPS; n++) {
        const keel_mixer_command_t command = command_at(n, torque);

        CALLGRIND_TOGGLE_COLLECT;
        keel_mixer_step(&bench_mixer, &command, true);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require((bench_mixer.limited & (KEEL_MIXER_YAW | KEEL_MIXER_TILT)) == limited,
                      "mixer step");
    }
    bench_dump(name);
}

static void bench_run_attitude(void)
{
    bench_require(keel_attitude_init(&bench_attitude, &attitude_workload) == KEEL_OK, "attitude");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const keel_attitude_sample_t sample = attitude_sample_at(n);

        if (n < STEPS) {
            keel_attitude_step(&bench_attitude, &sample);
        } else {
            bench_require(bench_attitude.heading_valid, "attitude is not valid");
            CALLGRIND_TOGGLE_COLLECT;
            keel_attitude_step(&bench_attitude, &sample);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_dump("attitude");
}

static void bench_run_cascade(void)
{
    const keel_cascade_config_t config = cascade_workload();

    bench_require(keel_cascade_init(&bench_cascade, &config) == KEEL_OK, "cascade");
    keel_cascade_enter(&bench_cascade, KEEL_MODE_RETURN);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const keel_cascade_estimate_t estimate = place_at(n);

        if (n < STEPS) {
            bench_cascade_steps(&bench_cascade, &estimate);
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            bench_cascade_steps(&bench_cascade, &estimate);
            CALLGRIND_TOGGLE_COLLECT;
            bench_require(bench_cascade.axis[KEEL_CASCADE_NORTH].running, "cascade step");
        }
    }
    bench_dump("cascade");
}

static void bench_run_altitude(void)
{
    bench_require(keel_altitude_init(&bench_altitude, &altitude_workload) == KEEL_OK, "altitude");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const keel_altitude_sample_t sample = altitude_sample_at(n);

        if (n < STEPS) {
            keel_altitude_step(&bench_altitude, &sample);
        } else {
            bench_require(bench_altitude.axis.quality == KEEL_AXIS_GOOD, "altitude is not good");
            CALLGRIND_TOGGLE_COLLECT;
            keel_altitude_step(&bench_altitude, &sample);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_dump("altitude");
}

static void bench_run_position(void)
{
    bench_require(keel_position_init(&bench_position, &position_workload) == KEEL_OK, "position");
    bench_require(keel_position_set_origin(&bench_position, 481000000, 115000000) == KEEL_OK,
                  "origin");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const keel_position_sample_t sample = position_sample_at(n);

        if (n < STEPS) {
            keel_position_step(&bench_position, &sample);
        } else {
            bench_require(bench_position.quality == KEEL_AXIS_GOOD, "position is not good");
            CALLGRIND_TOGGLE_COLLECT;
            keel_position_step(&bench_position, &sample);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_dump("position");
}

static void bench_run_battery(void)
{
    bench_require(keel_battery_init(&bench_battery, &battery_workload) == KEEL_OK, "battery");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const keel_battery_sample_t sample = battery_sample_at(n);

        if (n < STEPS) {
            keel_battery_step(&bench_battery, &sample);
        } else {
            bench_require(bench_battery.level == KEEL_BATTERY_OK, "battery is not well");
            CALLGRIND_TOGGLE_COLLECT;
            keel_battery_step(&bench_battery, &sample);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_dump("battery");
}

static void bench_run_calibration(void)
{
    bench_require(keel_calibration_rest_init(&bench_calibration, &calibration_workload) == KEEL_OK,
                  "calibration");
    keel_calibration_rest_begin(&bench_calibration);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const keel_calibration_vector_t sample = calibration_sample_at(n);

        if (n < STEPS) {
            keel_calibration_rest_step(&bench_calibration, sample.axis);
        } else {
            bench_require(bench_calibration.count == n, "calibration is not at rest");
            CALLGRIND_TOGGLE_COLLECT;
            keel_calibration_rest_step(&bench_calibration, sample.axis);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_dump("calibration");
}

static void bench_run_ms5611(void)
{
    keel_ms5611_sample_t sample = {0};

    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint32_t d1 = ms5611_pressure_at(n);
        const uint32_t d2 = ms5611_temperature_at(n);

        if (n < STEPS) {
            (void)keel_ms5611_compensate(&ms5611_workload, d1, d2, &sample);
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            (void)keel_ms5611_compensate(&ms5611_workload, d1, d2, &sample);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_require(sample.temperature_cdeg < -1500, "MS5611");
    bench_dump("ms5611");
}

static void bench_run_sbus(const char *name, bool noise)
{
    bench_require(keel_sbus_init(&bench_sbus, &sbus_workload) == KEEL_OK, "SBUS");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint8_t byte = noise ? (uint8_t)KEEL_SBUS_HEADER : sbus_byte_at(n);

        if (n < STEPS) {
            (void)keel_sbus_take(&bench_sbus, byte, 120u);
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            (void)keel_sbus_take(&bench_sbus, byte, 120u);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_require(noise == (bench_sbus.count.frames == 0u), "SBUS frames");
    bench_dump(name);
}

static void bench_run_ubx(void)
{
    bench_require(keel_ubx_init(&bench_ubx, &ubx_workload) == KEEL_OK, "UBX");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint8_t byte = ubx_byte_at(n);

        if (n < STEPS) {
            (void)keel_ubx_take(&bench_ubx, byte, 87u);
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            (void)keel_ubx_take(&bench_ubx, byte, 87u);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_require(bench_ubx.count.fixes == ((2u * STEPS) / 100u), "UBX fixes");
    bench_dump("ubx");
}

static void bench_run_log_ring(void)
{
    uint8_t read[LOG_RECORD];

    keel_log_ring_init(&bench_ring);
    for (uint32_t n = 0u; n < STEPS; n++) {
        CALLGRIND_TOGGLE_COLLECT;
        (void)keel_log_ring_write(&bench_ring, log_workload, LOG_RECORD, n);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(keel_log_ring_read(&bench_ring, read, LOG_RECORD) == LOG_RECORD, "ring");
    }
    bench_dump("log_ring");
}

static void bench_run_ulog(void)
{
    for (uint32_t n = 0u; n < STEPS; n++) {
        keel_ulog_data(&bench_message, 1u);
        CALLGRIND_TOGGLE_COLLECT;
        (void)keel_ulog_add(&bench_message, log_workload, LOG_RECORD);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(bench_message.size > LOG_RECORD, "ULog");
    }
    bench_dump("ulog");
}

static void read_mavlink(uint8_t byte)
{
    (void)keel_mavlink_take(&bench_mavlink, byte);
    while (keel_mavlink_look(&bench_mavlink) != KEEL_MAVLINK_NOTHING) {
    }
}

static void bench_run_mavlink(void)
{
    bench_require(keel_mavlink_init(&bench_mavlink, mavlink_workload, 1u) == KEEL_OK, "MAVLink");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint8_t byte = mavlink_byte_at(n);

        if (n < STEPS) {
            read_mavlink(byte);
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            read_mavlink(byte);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_require(bench_mavlink.count.frames > 0u, "MAVLink frames");
    bench_dump("mavlink");
}

static void bench_run_signing(void)
{
    keel_mavlink_frame_t frame = signing_workload;

    keel_signing_init(&bench_signing, 1u, bench_hash);
    keel_signing_set_key(&bench_signing, signing_key);
    for (uint32_t n = 0u; n < STEPS; n++) {
        bool accepted;

        frame.timestamp = (uint64_t)n + 1u;
        CALLGRIND_TOGGLE_COLLECT;
        accepted = keel_signing_accepts(&bench_signing, &frame);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(accepted, "signatures");
    }
    bench_dump("signing");
}

static void bench_run_crsf(void)
{
    bench_require(keel_crsf_init(&bench_crsf, &crsf_workload) == KEEL_OK, "CRSF");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        if (n < STEPS) {
            (void)keel_crsf_take(&bench_crsf, crsf_byte_at(n), 24u);
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            (void)keel_crsf_take(&bench_crsf, crsf_byte_at(n), 24u);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_require(bench_crsf.count.channels == ((2u * STEPS) / 26u), "CRSF frames");
    bench_dump("crsf");
}

static void bench_run_ibus(void)
{
    bench_require(keel_ibus_init(&bench_ibus, &ibus_workload) == KEEL_OK, "IBUS");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        if (n < STEPS) {
            (void)keel_ibus_take(&bench_ibus, ibus_byte_at(n), 87u);
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            (void)keel_ibus_take(&bench_ibus, ibus_byte_at(n), 87u);
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_require(bench_ibus.count.frames == ((2u * STEPS) / 32u), "IBUS frames");
    bench_dump("ibus");
}

static void bench_run_ppm(void)
{
    bench_require(keel_ppm_init(&bench_ppm, &ppm_workload) == KEEL_OK, "PPM");
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        if (n < STEPS) {
            (void)keel_ppm_take(&bench_ppm, ppm_edge_at(n));
        } else {
            CALLGRIND_TOGGLE_COLLECT;
            (void)keel_ppm_take(&bench_ppm, ppm_edge_at(n));
            CALLGRIND_TOGGLE_COLLECT;
        }
    }
    bench_require(bench_ppm.channels == 8u, "PPM channels");
    bench_dump("ppm");
}

static void bench_run_mode(const char *name, uint32_t settle_us, uint8_t state)
{
    const keel_mode_input_t input = mode_workload(&bench_mode, settle_us,
                                                  state == KEEL_MODE_FLYING);

    for (uint32_t n = 0u; n < STEPS; n++) {
        CALLGRIND_TOGGLE_COLLECT;
        keel_mode_step(&bench_mode, &input);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(bench_mode.state == state, "mode step");
    }
    bench_dump(name);
}

static void bench_run_imu(const char *name, float offset, uint8_t contributing)
{
    const keel_virtual_imu_config_t config = {voter_workload, voter_workload};
    keel_virtual_imu_sample_t sample[UNITS];

    bench_require(keel_virtual_imu_init(&bench_imu, &config) == KEEL_OK, "virtual IMU");
    for (uint32_t n = 0u; n < STEPS; n++) {
        samples_at(sample, n, offset);
        CALLGRIND_TOGGLE_COLLECT;
        keel_virtual_imu_step(&bench_imu, sample, 1000u);
        CALLGRIND_TOGGLE_COLLECT;
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            bench_require(bench_imu.channel[k].vote.contributing == contributing, "vote");
        }
    }
    bench_dump(name);
}

int main(void)
{
    bench_run_filter();
    bench_run_pid();
    bench_run_reference();
    bench_run_mixer("mixer", 0.05f, 0u);
    bench_run_mixer("mixer_worst", 0.4f, KEEL_MIXER_YAW | KEEL_MIXER_TILT);
    bench_run_mode("mode", 250000u, KEEL_MODE_FLYING);
    bench_run_mode("mode_worst", KEEL_MODE_TIME_MOST_US, KEEL_MODE_DISARMED);
    bench_run_attitude();
    bench_run_cascade();
    bench_run_altitude();
    bench_run_position();
    bench_run_battery();
    bench_run_calibration();
    bench_run_ms5611();
    bench_run_sbus("sbus", false);
    bench_run_sbus("sbus_worst", true);
    bench_run_ubx();
    bench_run_log_ring();
    bench_run_ulog();
    bench_run_mavlink();
    bench_run_signing();
    bench_run_crsf();
    bench_run_ibus();
    bench_run_ppm();
    bench_run_imu("imu", 0.0f, UNITS);
    bench_run_imu("imu_worst", 10.0f, UNITS - 1u);
    return EXIT_SUCCESS;
}
