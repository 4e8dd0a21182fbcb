// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// defines: -DVOTER_FLOATS_OPEN
// replaces: keel_voter_step keel_voter_reconsider keel_voter_step_unanimous
// checks: assertions
// covers: keel_virtual_imu_step
//
// The thresholds of every channel, without the model, and with the voter's own function for them:
// every valid virtual unit of 2 to 4 units, every sample, and whatever a vote comes to. The floats
// that no threshold comes of may be anything. All other checks: keel_virtual_imu_step_harness.c and
// keel_voter_scale__valid_harness.c.
#include "any_vote.h"

/* What voter_valid says of the floats that thresholds come of. */
static bool scale_valid_here(const keel_voter_t *v)
{
    return config_valid_here(&v->config) && (v->config.lowest <= v->vote.output) &&
           (v->vote.output <= v->config.highest);
}

void keel_virtual_imu_step__thresholds_harness(void)
{
    keel_virtual_imu_t imu;
    keel_virtual_imu_sample_t sample[SENSORS];
    keel_virtual_imu_sample_t copy[SENSORS];

    any_virtual_imu(&imu, nondet_u8());
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        __CPROVER_assume(keel_voter_step_may(&imu.channel[k]) && scale_valid_here(&imu.channel[k]));
    }
    any_unit_samples(sample, copy);

    keel_virtual_imu_step(&imu, sample, nondet_u32());

    for (uint32_t k = 0u; k < CHANNELS; k++) {
        const keel_voter_t *const voter = &imu.channel[k];

        __CPROVER_assert(voter->config.agree <= voter->agree,
                         "IMU_005_thresholds: a is not less than that of the configuration");
        __CPROVER_assert((voter->config.slope != 0.0f) || (voter->agree == voter->config.agree),
                         "IMU_005_thresholds: without a slope it is that of the configuration");
    }
}
