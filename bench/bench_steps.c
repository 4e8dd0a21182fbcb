/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bench_steps.c
 * @brief Runs the steps of the layers above the RTOS so that callgrind can count their
 *        instructions. Started by tools/bench.py; counts nothing outside valgrind.
 *
 * Each step is taken many times with inputs that keep it on its longest usual path; what is dumped
 * is labelled with its name and the number of steps.
 */
#include "keel/flight/mixer.h"
#include "keel/flight/mode.h"
#include "keel/flight/pid.h"
#include "keel/flight/reference.h"
#include "keel/middleware/virtual_imu.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <valgrind/callgrind.h>

#define STEPS      1000u
#define UNITS      3u
#define LABEL_SIZE 64u

static keel_filter_t bench_filter;
static keel_pid_t bench_pid;
static keel_mixer_t bench_mixer;
static keel_mode_t bench_mode;
static keel_reference_t bench_reference;
static keel_virtual_imu_t bench_imu;

static void bench_require(int condition, const char *what)
{
    if (!condition) {
        (void)fprintf(stderr, "bench_steps: %s\n", what);
        exit(EXIT_FAILURE);
    }
}

/* A signal that keeps moving, within 0 to 1. */
static float bench_signal(uint32_t n)
{
    return (float)((n * 37u) % 101u) / 101.0f;
}

/* A stick that keeps moving, from -1 to 1. */
static float bench_stick(uint32_t n)
{
    return (2.0f * bench_signal(n)) - 1.0f;
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
        const float input = bench_signal(n);
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
    const keel_pid_config_t config = {.gains = {2.0f, 5.0f, 0.02f, 0.5f},
                                      .rate_hz = 1000.0f,
                                      .cutoff_hz = 80.0f,
                                      .output_min = -100.0f,
                                      .output_max = 100.0f,
                                      .integral_min = -10.0f,
                                      .integral_max = 10.0f};

    bench_require(keel_pid_init(&bench_pid, &config) == KEEL_OK, "PID");
    bench_require(keel_pid_step(&bench_pid, 0.5f, 0.5f) == KEEL_OK, "first PID step");
    for (uint32_t n = 0u; n < STEPS; n++) {
        const float measurement = bench_signal(n);
        keel_status_t status;

        CALLGRIND_TOGGLE_COLLECT;
        status = keel_pid_step(&bench_pid, 0.5f, measurement);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(status == KEEL_OK, "PID step");
    }
    bench_dump("pid");
}

/* Sticks on both sides of their centres, in their dead bands now and then. */
static void bench_run_reference(void)
{
    const keel_reference_config_t config = {.roll = {0.05f, 0.3f},
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

    bench_require(keel_reference_init(&bench_reference, &config) == KEEL_OK, "reference");
    for (uint32_t n = 0u; n < STEPS; n++) {
        const keel_reference_sticks_t sticks = {.roll = bench_stick(n),
                                                .pitch = bench_stick(n + 7u),
                                                .yaw = bench_stick(n + 14u),
                                                .climb = bench_stick(n + 21u)};
        keel_status_t status;

        CALLGRIND_TOGGLE_COLLECT;
        status = keel_reference_step(&bench_reference, &sticks);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(status == KEEL_OK, "reference step");
    }
    bench_dump("reference");
}

/* A quadcopter's X, with torques of so much to twice as much about a middling thrust: with little,
 * all that is asked for fits; with much, everything gives way. */
static void bench_run_mixer(const char *name, float torque, uint8_t limited)
{
    const keel_mixer_config_t config = {keel_mixer_quad_x, 0.05f, 1.0f};

    bench_require(keel_mixer_init(&bench_mixer, &config) == KEEL_OK, "mixer");
    for (uint32_t n = 0u; n < STEPS; n++) {
        const keel_mixer_command_t command = {
            .roll = torque * (1.0f + bench_signal(n)),
            .pitch = -torque * (1.0f + bench_signal(n + 1u)),
            .yaw = torque * (1.0f + bench_signal(n + 2u)),
            .thrust = 0.4f + (0.2f * bench_signal(n + 3u)),
        };

        CALLGRIND_TOGGLE_COLLECT;
        keel_mixer_step(&bench_mixer, &command, true);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require((bench_mixer.limited & (KEEL_MIXER_YAW | KEEL_MIXER_TILT)) == limited,
                      "mixer step");
    }
    bench_dump(name);
}

/* In flight, with a frame at each step; or on the ground, with every
 * fact that can be seen waiting to settle. */
static void bench_run_mode(const char *name, uint32_t settle_us, uint8_t state)
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
    const int flies = state == KEEL_MODE_FLYING;
    keel_mode_input_t input = {.elapsed_us = 1000u, .facts = 0x074Du, .checks = 1u, .asked = 4u};

    bench_require(keel_mode_init(&bench_mode, &config) == KEEL_OK, "mode");
    for (uint32_t n = 0u; flies && (n < STEPS); n++) {
        keel_mode_step(&bench_mode, &input);
    }
    input.facts ^= KEEL_MODE_IS_ON | KEEL_MODE_IS_OFF;
    for (uint32_t n = 0u; flies && (n < STEPS); n++) {
        input.facts ^= (n == (STEPS / 2u)) ? (KEEL_MODE_IS_LANDED | KEEL_MODE_IS_LOW) : 0u;
        keel_mode_step(&bench_mode, &input);
    }
    for (uint32_t n = 0u; n < STEPS; n++) {
        input.facts = flies ? input.facts : 0x3FFBu;
        CALLGRIND_TOGGLE_COLLECT;
        keel_mode_step(&bench_mode, &input);
        CALLGRIND_TOGGLE_COLLECT;
        bench_require(bench_mode.state == state, "mode step");
    }
    bench_dump(name);
}

/* Samples that keep moving: of all units within the distance of full agreement, or with the last
 * unit's beyond that of none. */
static void bench_fill(keel_virtual_imu_sample_t sample[UNITS], uint32_t n, float offset)
{
    for (uint32_t i = 0u; i < UNITS; i++) {
        sample[i].age_us = 100u;
        sample[i].present = true;
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            sample[i].value[k] = (0.2f * bench_signal((3u * n) + (7u * i) + k)) +
                                 ((i == (UNITS - 1u)) ? offset : 0.0f);
        }
    }
}

static void bench_run_imu(const char *name, float offset, uint8_t contributing)
{
    const keel_voter_config_t voter = {.agree = 0.25f,
                                       .cutoff = 3.0f,
                                       .lowest = -160.0f,
                                       .highest = 160.0f,
                                       .max_age_us = 10000u,
                                       .latch_count = UINT16_MAX,
                                       .stale_count = 50u,
                                       .sensors = UNITS};
    const keel_virtual_imu_config_t config = {voter, voter};
    keel_virtual_imu_sample_t sample[UNITS];

    bench_require(keel_virtual_imu_init(&bench_imu, &config) == KEEL_OK, "virtual IMU");
    for (uint32_t n = 0u; n < STEPS; n++) {
        bench_fill(sample, n, offset);
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
    bench_run_imu("imu", 0.0f, UNITS);
    bench_run_imu("imu_worst", 10.0f, UNITS - 1u);
    return EXIT_SUCCESS;
}
