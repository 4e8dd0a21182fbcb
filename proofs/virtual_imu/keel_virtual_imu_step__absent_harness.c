// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --object-bits 10
// sources: src/middleware/virtual_imu.c src/middleware/voter.c specs/model/virtual_imu.c
// sources: specs/model/voter.c specs/model/voter_parts.c specs/model/range.c
// covers: note model_virtual_imu_step
//
// A chosen vote: one unit gives nothing, and another one is late for the accelerometer alone.
#include "chosen_vote.h"

void keel_virtual_imu_step__absent_harness(void)
{
    keel_virtual_imu_sample_t sample[SENSORS] = {{{0.0f}, 0u, false}};
    keel_virtual_imu_t imu = after_a_vote();
    keel_virtual_imu_t model = imu;

    all_present(sample);
    sample[0].present = false;
    sample[2].age_us = 1500u;
    model_virtual_imu_step(&model, sample, 1100u);

    keel_virtual_imu_step(&imu, sample, 1100u);

    __CPROVER_assert(virtual_imu_same(&imu, &model), "IMU_002_absent: as the model says");
}
