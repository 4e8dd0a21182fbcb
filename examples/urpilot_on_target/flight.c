/* SPDX-License-Identifier: Apache-2.0 */
#include "flight.h"

#include "board.h"
#include "console.h"
#include "keel/flight/pid.h"
#include "keel/middleware/virtual_imu.h"

#define UNITS          3u
#define FROZEN_UNIT    2u
#define FROZEN_FROM    4000u /* Votes: at 8 s. */
#define VOTE_PERIOD_US 2000u
#define RATE_HZ        500.0f
#define AXES           3u

/* The truth is a triangle of +-1 in 2 s; the units are a hundredth apart from it each. */
#define TRIANGLE  1000u
#define HALF      500u
#define CHANNEL_N 40u /* Each channel is this many votes ahead of the one before. */
#define OFFSET    0.01f

static keel_virtual_imu_t imu KEEL_REALTIME_ZERO;
static keel_virtual_imu_sample_t sample[UNITS] KEEL_REALTIME_ZERO;
static keel_pid_t controller[AXES] KEEL_REALTIME_ZERO;
static uint32_t votes KEEL_REALTIME_ZERO;
static uint32_t steps KEEL_REALTIME_ZERO;
static uint32_t refused KEEL_REALTIME_ZERO;
static float worst KEEL_REALTIME_ZERO; /* The largest distance of a voted value from the truth. */

keel_status_t flight_init(void)
{
    const keel_voter_config_t voter = {.agree = 0.1f,
                                       .cutoff = 3.0f,
                                       .lowest = -20.0f,
                                       .highest = 20.0f,
                                       .initial = 0.0f,
                                       .max_age_us = VOTE_PERIOD_US,
                                       .latch_count = 100u,
                                       .stale_count = 50u,
                                       .density_limit = 0u,
                                       .sensors = UNITS};
    const keel_virtual_imu_config_t config = {voter, voter};
    const keel_pid_config_t rate = {.gains = {0.5f, 0.2f, 0.01f, 0.0f},
                                    .rate_hz = RATE_HZ,
                                    .cutoff_hz = 80.0f,
                                    .output_min = -1.0f,
                                    .output_max = 1.0f,
                                    .integral_min = -0.3f,
                                    .integral_max = 0.3f};
    keel_status_t status = keel_virtual_imu_init(&imu, &config);

    for (uint32_t axis = 0u; (axis < AXES) && (status == KEEL_OK); axis++) {
        status = keel_pid_init(&controller[axis], &rate);
    }
    return status;
}

KEEL_REALTIME_CODE static float truth_of(uint32_t channel)
{
    const uint32_t n = (votes + (CHANNEL_N * channel)) % TRIANGLE;
    const uint32_t height = (n < HALF) ? n : (TRIANGLE - n);

    return ((float)height / (0.5f * (float)HALF)) - 1.0f;
}

KEEL_REALTIME_CODE static void measure(void)
{
    for (uint32_t unit = 0u; unit < UNITS; unit++) {
        const bool frozen = (unit == FROZEN_UNIT) && (votes >= FROZEN_FROM);

        for (uint32_t k = 0u; (k < KEEL_VIRTUAL_IMU_CHANNELS) && !frozen; k++) {
            sample[unit].value[k] = truth_of(k) + (OFFSET * (float)unit);
        }
        sample[unit].present = true;
    }
}

KEEL_REALTIME_CODE void flight_vote(void)
{
    measure();
    keel_virtual_imu_step(&imu, sample, VOTE_PERIOD_US);
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        const float distance = imu.channel[k].vote.output - truth_of(k);
        const float size = (distance < 0.0f) ? -distance : distance;

        worst = (size > worst) ? size : worst;
    }
    votes++;
}

KEEL_REALTIME_CODE void flight_control(void)
{
    for (uint32_t axis = 0u; axis < AXES; axis++) {
        const float rate = imu.channel[KEEL_VIRTUAL_IMU_ACCELEROMETER + axis].vote.output;

        if (keel_pid_step(&controller[axis], 0.0f, rate) != KEEL_OK) {
            refused++;
        }
    }
    steps++;
}

static void print_number(const char *label, uint32_t value)
{
    keel_console_text(label);
    keel_console_number(value);
}

void flight_print(void)
{
    print_number("flight votes ", votes);
    print_number(" steps ", steps);
    print_number(" refused ", refused);
    print_number(" worst ", (uint32_t)(worst * 1.0e6f));
    for (uint32_t unit = 0u; unit < UNITS; unit++) {
        print_number(" used ", imu.used[unit]);
        print_number(" latched ", imu.latched[unit]);
    }
    keel_console_text("\n");
}
