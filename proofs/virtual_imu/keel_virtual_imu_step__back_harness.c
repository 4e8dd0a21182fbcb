// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// defines: -DVOTER_FLOATS_OPEN
// replaces: keel_voter_scale keel_voter_step keel_voter_step_unanimous
// checks: assertions
// covers: keel_virtual_imu_step
//
// The votes that a channel of a unit that is back went through, without the model, and with the
// voter's own probation: every virtual unit of 2 to 4 units, every sample, whatever a vote is.
// The floats of a channel may be anything. All other checks: keel_virtual_imu_step_harness.c and
// keel_voter_reconsider_harness.c.
#include "any_vote.h"

void keel_virtual_imu_step__back_harness(void)
{
    keel_virtual_imu_t imu;
    keel_virtual_imu_t before;
    keel_virtual_imu_sample_t sample[SENSORS];
    keel_virtual_imu_sample_t copy[SENSORS];

    any_virtual_imu(&imu, nondet_u8());
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        __CPROVER_assume(keel_voter_step_may(&imu.channel[k]));
    }
    any_unit_samples(sample, copy);
    before = imu;

    keel_virtual_imu_step(&imu, sample, nondet_u32());

    for (uint32_t k = 0u; k < CHANNELS; k++) {
        const keel_voter_config_t *const config = &imu.channel[k].config;

        for (uint32_t i = 0u; i < SENSORS; i++) {
            const keel_voter_sensor_t *const was = &before.channel[k].sensor[i];
            const bool back = (i < config->sensors) && was->latched &&
                              !imu.channel[k].sensor[i].latched;
            const float value = sample[i].value[k];

            __CPROVER_assert(!back || ((0u < config->readmit_count) &&
                                       (config->readmit_count <= (was->probation + 1u))),
                             "IMU_006_back: only after as many votes for it as are asked for");
            __CPROVER_assert(!back || (sample[i].present && (config->lowest <= value) &&
                                       (value <= config->highest)),
                             "IMU_006_back: this one had a plausible sample of it");
        }
    }
}
