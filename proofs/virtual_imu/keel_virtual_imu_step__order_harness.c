// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=2u
// replaces: keel_voter_scale keel_voter_step keel_voter_reconsider keel_voter_step_unanimous
// covers: keel_virtual_imu_step note_verdicts channel_bit
//
// Every valid virtual unit of two units and every sample; a channel's vote leaves any valid
// channel behind. Each channel is valid when its vote is taken. How many units there are does not
// matter to that: the loops over them write nothing that a channel has.
#include "keel/middleware/virtual_imu.h"

#include "../common/voter_contracts.h"

static uint8_t units;

/* What a vote may write: all but the configuration. */
static void any_vote(keel_voter_t *voter)
{
    __CPROVER_assert(voter->config.sensors == units,
                     "sensors_stay: no vote changes another channel's configuration");
    voter->unanimous = nondet_bool();
    voter->vote.output = nondet_float();
    voter->vote.held = nondet_u32();
    voter->vote.held_us = nondet_u32();
    voter->vote.state = nondet_u8();
    voter->vote.contributing = nondet_u8();
    for (uint32_t i = 0u; i < SENSORS; i++) {
        voter->sensor[i] = any_sensor();
        voter->vote.weight[i] = nondet_float();
        voter->vote.reason[i] = nondet_u8();
    }
}

void keel_voter_scale_stand_in(keel_voter_t *voter)
{
    __CPROVER_assert(keel_voter_scale_may(voter), "precondition: keel_voter_scale");
    voter->agree = nondet_float();
    voter->disagree = nondet_float();
    __CPROVER_assume(keel_voter_scale_does(voter));
}

void keel_voter_step_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                              uint32_t elapsed_us)
{
    (void)sample;
    (void)elapsed_us;
    __CPROVER_assert(keel_voter_step_may(voter), "precondition: keel_voter_step");
    any_vote(voter);
    __CPROVER_assume(keel_voter_step_does(voter));
}

void keel_voter_reconsider_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    (void)sample;
    __CPROVER_assert(keel_voter_reconsider_may(voter), "precondition: keel_voter_reconsider");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        voter->sensor[i] = any_sensor();
    }
    __CPROVER_assume(keel_voter_reconsider_does(voter));
}

bool keel_voter_step_unanimous_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                                        uint32_t oldest_us)
{
    const bool taken = nondet_bool();

    __CPROVER_assert(keel_voter_step_unanimous_may(voter, sample, oldest_us),
                     "precondition: keel_voter_step_unanimous");
    any_vote(voter);
    __CPROVER_assume(keel_voter_step_unanimous_does(voter));
    return taken;
}

void keel_virtual_imu_step__order_harness(void)
{
    keel_virtual_imu_t imu;
    keel_virtual_imu_sample_t sample[SENSORS];

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        any_voter(&imu.channel[k], nondet_float(), nondet_float());
        __CPROVER_assume(voter_valid_here(&imu.channel[k]) &&
                         (imu.channel[k].config.sensors == imu.channel[0].config.sensors));
    }
    units = imu.channel[0].config.sensors;
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].age_us = nondet_u32();
        sample[i].present = nondet_bool();
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            sample[i].value[k] = nondet_float();
        }
    }

    keel_virtual_imu_step(&imu, sample, nondet_u32());

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        __CPROVER_assert(voter_valid_here(&imu.channel[k]) &&
                             (imu.channel[k].config.sensors == units),
                         "IMU_002_valid: each channel stays valid");
    }
}
