// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --object-bits 10 --max-field-sensitivity-array-size 4
// sources: src/middleware/virtual_imu.c src/middleware/voter.c specs/model/virtual_imu.c
// sources: specs/model/voter.c specs/model/voter_parts.c specs/model/range.c
// covers: keel_virtual_imu_step note_verdicts channel_bit model_virtual_imu_step
//
// Two chosen votes from one state: a unit is late for the accelerometer alone, another one is off
// in a channel of the gyroscope, where the first bad vote latches, and the third gives its sample
// or not.
#include "chosen_vote.h"

void keel_virtual_imu_step__points_harness(void)
{
    keel_virtual_imu_sample_t sample[SENSORS] = {{{0.0f}, 0u, false}};

    all_present(sample);
    sample[1].age_us = 1500u;
    sample[2].value[5] += 20.0f;
    for (uint32_t absent = 0u; absent < 2u; absent++) {
        keel_virtual_imu_t imu = after_a_vote();
        keel_virtual_imu_t model = imu;

        sample[0].present = absent == 0u;
        model_virtual_imu_step(&model, sample, 900u);

        keel_virtual_imu_step(&imu, sample, 900u);

        for (uint32_t i = 0u; i < SENSORS; i++) {
            __CPROVER_assert(virtual_imu_same(&imu, &model, i),
                             "IMU_002_points: as the model says");
        }
    }
}
