/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file virtual_imu_proof.h
 * @brief What the CBMC harnesses of the virtual IMU share: arbitrary units and samples.
 */
#ifndef VIRTUAL_IMU_PROOF_H
#define VIRTUAL_IMU_PROOF_H

#include "../../specs/model/virtual_imu.h"
#include "../common/voter_contracts.h"

#define CHANNELS KEEL_VIRTUAL_IMU_CHANNELS

/* Any virtual unit of so many units. */
static void any_virtual_imu(keel_virtual_imu_t *imu, uint8_t units)
{
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        any_voter(&imu->channel[k], nondet_float(), nondet_float());
        imu->channel[k].config.sensors = units;
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        imu->used[i] = nondet_u8();
        imu->latched[i] = nondet_u8();
    }
}

/* Any samples, and a copy of them. */
static void any_unit_samples(keel_virtual_imu_sample_t sample[SENSORS],
                             keel_virtual_imu_sample_t copy[SENSORS])
{
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].age_us = nondet_u32();
        sample[i].present = nondet_bool();
        for (uint32_t k = 0u; k < CHANNELS; k++) {
            sample[i].value[k] = nondet_float();
        }
        copy[i] = sample[i];
    }
}

static bool is_set(uint8_t bits, uint32_t channel)
{
    return ((bits >> channel) & 1u) != 0u;
}

/* virtual_imu_noted of a channel and a unit */
static bool noted_of(const keel_virtual_imu_t *imu, uint32_t k, uint32_t i)
{
    const keel_voter_t *const voter = &imu->channel[k];
    const bool contributed = (voter->vote.contributing > 0u) &&
                             (voter->vote.reason[i] == KEEL_VOTER_USED);

    return (is_set(imu->used[i], k) == contributed) &&
           (is_set(imu->latched[i], k) == voter->sensor[i].latched);
}

/* What virtual_imu_valid says beyond voter_valid of each channel. */
static bool noted_here(const keel_virtual_imu_t *imu)
{
    bool noted = true;

    for (uint32_t k = 0u; k < CHANNELS; k++) {
        noted = noted && (imu->channel[k].config.sensors == imu->channel[0].config.sensors);
        for (uint32_t i = 0u; i < SENSORS; i++) {
            noted = noted && ((i >= imu->channel[k].config.sensors) || noted_of(imu, k, i));
        }
    }
    return noted;
}

static bool unit_sample_same(const keel_virtual_imu_sample_t *a, const keel_virtual_imu_sample_t *b)
{
    return (a->age_us == b->age_us) && (a->present == b->present) &&
           float_same(a->value[0u], b->value[0u]) && float_same(a->value[1u], b->value[1u]) &&
           float_same(a->value[2u], b->value[2u]) && float_same(a->value[3u], b->value[3u]) &&
           float_same(a->value[4u], b->value[4u]) && float_same(a->value[5u], b->value[5u]);
}

static bool virtual_imu_same(const keel_virtual_imu_t *a, const keel_virtual_imu_t *b, uint32_t i)
{
    return voter_same(&a->channel[0u], &b->channel[0u], i) &&
           voter_same(&a->channel[1u], &b->channel[1u], i) &&
           voter_same(&a->channel[2u], &b->channel[2u], i) &&
           voter_same(&a->channel[3u], &b->channel[3u], i) &&
           voter_same(&a->channel[4u], &b->channel[4u], i) &&
           voter_same(&a->channel[5u], &b->channel[5u], i) && (a->used[i] == b->used[i]) &&
           (a->latched[i] == b->latched[i]);
}

#endif
