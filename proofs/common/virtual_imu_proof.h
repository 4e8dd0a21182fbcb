/**
 * @file virtual_imu_proof.h
 * @brief What the CBMC harnesses of the virtual unit share.
 */
#ifndef VIRTUAL_IMU_PROOF_H
#define VIRTUAL_IMU_PROOF_H

#include "../../specs/model/virtual_imu.h"
#include "voter_contracts.h"

static bool virtual_imu_same(const keel_virtual_imu_t *a, const keel_virtual_imu_t *b)
{
    bool same = true;

    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        same = same && voter_same(&a->channel[k], &b->channel[k]);
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        same = same && (a->used[i] == b->used[i]) && (a->latched[i] == b->latched[i]);
    }
    return same;
}

/* Any virtual unit of so many units; imu_valid_here tells whether it is valid. */
static void any_imu(keel_virtual_imu_t *imu, uint8_t units)
{
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        any_channel(&imu->channel[k], units);
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        imu->used[i] = nondet_u8();
        imu->latched[i] = nondet_u8();
    }
}

/* imu_valid */
static bool imu_valid_here(const keel_virtual_imu_t *imu)
{
    bool valid = true;

    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        valid = valid && voter_valid_here(&imu->channel[k]) &&
                (imu->channel[k].config.sensors == imu->channel[0].config.sensors);
    }
    return valid;
}

#endif
