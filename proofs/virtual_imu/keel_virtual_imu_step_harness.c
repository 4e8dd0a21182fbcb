// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c specs/model/virtual_imu.c
// defines: -DVOTER_FLOATS_OPEN
// replaces: keel_voter_scale keel_voter_step keel_voter_reconsider keel_voter_step_unanimous
// covers: keel_virtual_imu_step note_verdicts channel_bit model_virtual_imu_step
//
// Every virtual unit of 2 to 4 units, every bit pattern of the samples. What a vote comes to is
// unknown: the model's vote on a channel comes to anything that its contract allows. The code must
// ask for that vote, on the same channel in the same state with the same samples, and is told the
// same.
//
// The floats of a channel may be anything: the virtual unit does not look at them. That each
// channel is valid in full when it votes: keel_virtual_imu_step__order_harness.c. Composed by hand:
// a unanimous vote comes to what the whole vote comes to (VOT-018, shown in proofs/voter). When it
// is taken is unknown, but only of a channel whose last vote was unanimous, and it stays so.
#include "virtual_imu_proof.h"

/* A vote on a channel: what was asked, and what came of it; its thresholds, and of which state. */
typedef struct ballot {
    keel_voter_t unscaled;
    float agree;
    float disagree;
    keel_voter_t before;
    keel_voter_t after;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sensor_t reconsidered[SENSORS];
    uint32_t elapsed_us;
} ballot_t;

static ballot_t ballot[CHANNELS];
static keel_virtual_imu_t imu;
static keel_virtual_imu_t model;

static uint32_t channel_of(const keel_virtual_imu_t *unit, const keel_voter_t *voter)
{
    uint32_t channel = CHANNELS;

    for (uint32_t k = 0u; k < CHANNELS; k++) {
        channel = (voter == &unit->channel[k]) ? k : channel;
    }
    return channel;
}

void model_voter_scale(keel_voter_t *voter)
{
    ballot_t *const vote = &ballot[channel_of(&model, voter)];

    vote->unscaled = *voter;
    vote->agree = nondet_float();
    vote->disagree = nondet_float();
    voter->agree = vote->agree;
    voter->disagree = vote->disagree;
}

/* Asks for the thresholds that the model asked for, in the same state. */
void keel_voter_scale_stand_in(keel_voter_t *voter)
{
    const ballot_t *const vote = &ballot[channel_of(&imu, voter)];

    __CPROVER_assert(keel_voter_scale_may(voter), "precondition: keel_voter_scale");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(voter, &vote->unscaled, i),
                         "IMU_005_state: thresholds after the channel's last output");
    }
    voter->agree = vote->agree;
    voter->disagree = vote->disagree;
    __CPROVER_assume(keel_voter_scale_does(voter));
}

void model_voter_step(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t elapsed_us)
{
    ballot_t *const vote = &ballot[channel_of(&model, voter)];

    vote->before = *voter;
    vote->elapsed_us = elapsed_us;
    for (uint32_t i = 0u; i < SENSORS; i++) {
        vote->sample[i] = sample[i];
    }
    any_voter(&vote->after, nondet_float(), nondet_float());
    vote->after.config = voter->config;
    vote->after.agree = voter->agree;
    vote->after.disagree = voter->disagree;
    __CPROVER_assume(keel_voter_step_does(&vote->after));
    *voter = vote->after;
}

/* Probation may come to anything, but sensors that are not latched stay as they are. */
void model_voter_reconsider(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    ballot_t *const vote = &ballot[channel_of(&model, voter)];

    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert((i >= voter->config.sensors) ||
                             voter_sample_same(&sample[i], &vote->sample[i]),
                         "IMU_006_model: with the samples of the vote");
        if ((i < voter->config.sensors) && voter->sensor[i].latched) {
            voter->sensor[i] = any_sensor();
        }
        vote->reconsidered[i] = voter->sensor[i];
    }
    __CPROVER_assume(keel_voter_reconsider_does(voter));
}

static void same_samples(const keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    const ballot_t *const vote = &ballot[channel_of(&imu, voter)];

    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert((i >= voter->config.sensors) ||
                             voter_sample_same(&sample[i], &vote->sample[i]),
                         "IMU_002_sample: with the same sample of each unit");
    }
}

/* Asks for the vote that the model asked for, but for the time elapsed. */
static void vote_as_the_model(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    const ballot_t *const vote = &ballot[channel_of(&imu, voter)];

    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(voter, &vote->before, i), "IMU_002_state: in the same state");
    }
    same_samples(voter, sample);
    *voter = vote->after;
}

/* Asks for the probation that the model asked for: in the same state, with the same samples. */
void keel_voter_reconsider_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    const ballot_t *const vote = &ballot[channel_of(&imu, voter)];

    __CPROVER_assert(keel_voter_reconsider_may(voter), "precondition: keel_voter_reconsider");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(voter, &vote->after, i), "IMU_006_state: after the vote");
    }
    same_samples(voter, sample);
    for (uint32_t i = 0u; i < SENSORS; i++) {
        voter->sensor[i] = vote->reconsidered[i];
    }
    __CPROVER_assume(keel_voter_reconsider_does(voter));
}

void keel_voter_step_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                              uint32_t elapsed_us)
{
    __CPROVER_assert(keel_voter_step_may(voter), "precondition: keel_voter_step");
    __CPROVER_assert(elapsed_us == ballot[channel_of(&imu, voter)].elapsed_us,
                     "IMU_002_elapsed: after the same time");
    vote_as_the_model(voter, sample);
    __CPROVER_assume(keel_voter_step_does(voter));
}

bool keel_voter_step_unanimous_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                                        uint32_t oldest_us)
{
    const bool taken = voter->unanimous && nondet_bool();

    __CPROVER_assert(keel_voter_step_unanimous_may(voter, sample, oldest_us),
                     "precondition: keel_voter_step_unanimous");
    if (taken) {
        vote_as_the_model(voter, sample);
        __CPROVER_assume(voter->unanimous);
    }
    __CPROVER_assume(keel_voter_step_unanimous_does(voter));
    return taken;
}

void keel_virtual_imu_step_harness(void)
{
    const uint8_t units = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    keel_virtual_imu_sample_t sample[SENSORS];
    keel_virtual_imu_sample_t before[SENSORS];

    any_virtual_imu(&imu, units);
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        __CPROVER_assume(keel_voter_step_may(&imu.channel[k]));
    }
    any_unit_samples(sample, before);
    model = imu;
    model_virtual_imu_step(&model, sample, elapsed_us);

    keel_virtual_imu_step(&imu, sample, elapsed_us);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(virtual_imu_same(&imu, &model, i), "IMU_002_model: as the model says");
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(unit_sample_same(&sample[i], &before[i]),
                         "IMU_002_read: the samples are only read");
    }
    __CPROVER_assert(noted_here(&imu), "IMU_003_noted: bits as the channels say");
}
