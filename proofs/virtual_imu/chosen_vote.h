/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file chosen_vote.h
 * @brief A vote of three units from a chosen state, with the channels' own votes in it.
 *
 * Every state and every sample is dealt with where what a vote comes to is unknown; a mistake in
 * which sample, age, channel or bit is meant shows here, in seconds.
 */
#ifndef CHOSEN_VOTE_H
#define CHOSEN_VOTE_H

#include "virtual_imu_proof.h"

#define UNITS 3u

/* A channel of unit 1 that is latched; all others were unanimous. */
#define LATCHED 2u

static const keel_voter_config_t accelerometer = {1.0f,  3.0f, 0.0f, -100.0f, 100.0f, 1.5f,
                                                  1000u, 2u,   0u,   0u,      0u,     UNITS};
static const keel_voter_config_t gyroscope = {2.0f,  2.0f, 0.125f, -50.0f, 60.0f, -0.5f,
                                              2000u, 1u,   3u,     2u,     9u,    UNITS};

/* What a unit measured on a channel in the vote of that number. */
static float value_of(uint32_t unit, uint32_t channel, uint32_t number)
{
    return (5.0f * (float)channel) + (0.125f * (float)unit) + (0.25f * (float)number);
}

static keel_voter_t channel_after_a_vote(uint32_t channel)
{
    const bool latched = channel == LATCHED;
    keel_voter_t voter = {.config = accelerometer};

    if (channel >= KEEL_VIRTUAL_IMU_ACCELEROMETER) {
        voter.config = gyroscope;
    }
    voter.agree = voter.config.agree;
    voter.disagree = voter.config.cutoff * voter.config.agree;
    voter.unanimous = !latched;
    for (uint32_t i = 0u; i < UNITS; i++) {
        voter.sensor[i].last = value_of(i, channel, 0u);
        voter.vote.weight[i] = 1.0f;
        voter.vote.reason[i] = KEEL_VOTER_USED;
    }
    voter.vote.output = value_of(1u, channel, 0u);
    voter.vote.state = KEEL_VOTER_MEAN;
    voter.vote.contributing = UNITS;
    if (latched) {
        voter.sensor[1].latched = true;
        voter.vote.weight[1] = 0.0f;
        voter.vote.reason[1] = KEEL_VOTER_LATCHED;
        voter.vote.contributing = UNITS - 1u;
    }
    return voter;
}

static keel_virtual_imu_t after_a_vote(void)
{
    keel_virtual_imu_t imu = {.used = {0u}};

    for (uint32_t k = 0u; k < CHANNELS; k++) {
        imu.channel[k] = channel_after_a_vote(k);
    }
    for (uint32_t i = 0u; i < UNITS; i++) {
        imu.used[i] = KEEL_VIRTUAL_IMU_ALL;
    }
    imu.used[1] = KEEL_VIRTUAL_IMU_ALL & ~(1u << LATCHED);
    imu.latched[1] = 1u << LATCHED;
    return imu;
}

/* The samples of the next vote: every unit's present, and each as old as no other. */
static void all_present(keel_virtual_imu_sample_t sample[SENSORS])
{
    for (uint32_t i = 0u; i < UNITS; i++) {
        sample[i].age_us = 30u - (10u * i);
        sample[i].present = true;
        for (uint32_t k = 0u; k < CHANNELS; k++) {
            sample[i].value[k] = value_of(i, k, 1u);
        }
    }
}

#endif
