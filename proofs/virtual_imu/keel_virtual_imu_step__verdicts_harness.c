// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// defines: -DVOTER_FLOATS_OPEN
// replaces: keel_voter_scale keel_voter_step keel_voter_reconsider keel_voter_step_unanimous
// checks: assertions
// covers: keel_virtual_imu_step note_verdicts channel_bit
//
// The notes on a vote, without the model: every virtual unit of 2 to 4 units, every sample, and
// whatever a vote comes to. The floats of a channel may be anything, as the virtual unit does not
// look at them. That each channel is valid in full when it votes:
// keel_virtual_imu_step__order_harness.c. All other checks: keel_virtual_imu_step_harness.c.
#include "any_vote.h"

void keel_virtual_imu_step__verdicts_harness(void)
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
        const keel_voter_t *const voter = &imu.channel[k];

        __CPROVER_assert(voter_config_same(&voter->config, &before.channel[k].config),
                         "IMU_002_config: no configuration changes");
        for (uint32_t i = 0u; i < SENSORS; i++) {
            const bool is_unit = i < voter->config.sensors;
            const bool contributed = voter->vote.reason[i] == KEEL_VOTER_USED;

            __CPROVER_assert(!is_unit || (is_set(imu.used[i], k) == contributed),
                             "IMU_003_used: noted as used are the channels that contributed");
            __CPROVER_assert(!is_unit || (is_set(imu.latched[i], k) == voter->sensor[i].latched),
                             "IMU_003_latched: noted as latched are those that are now");
        }
    }
}
