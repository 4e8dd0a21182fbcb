// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_take take_three model_attitude_take
//
// Any virtual unit, any sample before: the same as the model's, bit for bit.
#include "../../specs/model/attitude.h"
#include "attitude_proof.h"

keel_virtual_imu_t nondet_imu(void);

void keel_attitude_take_harness(void)
{
    const keel_virtual_imu_t imu = nondet_imu();
    keel_attitude_sample_t sample = any_sample();
    keel_attitude_sample_t model = sample;

    keel_attitude_take(&sample, &imu);
    model_attitude_take(&model, &imu);

    __CPROVER_assert(sample_same(&sample, &model),
                     "ATT_004_model: the sample is what the model says");
}
