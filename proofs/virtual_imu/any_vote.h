/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file any_vote.h
 * @brief What stands in for the parts of a channel's vote, where clauses of the virtual unit are
 *        shown without the model: any that leaves a valid channel behind.
 *
 * Each writes only what its part writes; that every field is the model's, the voter's own harnesses
 * show. A vote changes no configuration, no thresholds and no probation, and a sensor stays latched
 * in it (VOT-011). A unanimous vote changes the output and the last samples alone, of a channel
 * that was unanimous (VOT-018). Probation changes latched sensors alone (VOT-021). A harness
 * replaces the parts that it does not look into.
 */
#ifndef ANY_VOTE_H
#define ANY_VOTE_H

#include "virtual_imu_proof.h"

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
    voter->unanimous = nondet_bool();
    voter->vote.output = nondet_float();
    voter->vote.held = nondet_u32();
    voter->vote.held_us = nondet_u32();
    voter->vote.state = nondet_u8();
    voter->vote.contributing = nondet_u8();
    for (uint32_t i = 0u; i < SENSORS; i++) {
        keel_voter_sensor_t *const sensor = &voter->sensor[i];

        sensor->last = nondet_float();
        sensor->unchanged_votes = nondet_u16();
        sensor->condemned_votes = nondet_u16();
        sensor->density = nondet_u16();
        sensor->latched = sensor->latched || nondet_bool();
        voter->vote.weight[i] = nondet_float();
        voter->vote.reason[i] = nondet_u8();
    }
    __CPROVER_assume(keel_voter_step_does(voter));
}

void keel_voter_reconsider_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    (void)sample;
    __CPROVER_assert(keel_voter_reconsider_may(voter), "precondition: keel_voter_reconsider");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        if (voter->sensor[i].latched) {
            voter->sensor[i] = any_sensor();
        }
    }
    __CPROVER_assume(keel_voter_reconsider_does(voter));
}

bool keel_voter_step_unanimous_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                                        uint32_t oldest_us)
{
    const bool taken = voter->unanimous && nondet_bool();

    __CPROVER_assert(keel_voter_step_unanimous_may(voter, sample, oldest_us),
                     "precondition: keel_voter_step_unanimous");
    if (taken) {
        voter->vote.output = nondet_float();
        for (uint32_t i = 0u; i < SENSORS; i++) {
            voter->sensor[i].last = nondet_float();
        }
    }
    __CPROVER_assume(keel_voter_step_unanimous_does(voter));
    return taken;
}

#endif
