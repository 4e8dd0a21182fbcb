// cbmc: --unwind 7
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=2u
// covers: keel_virtual_imu_step
//
// Every channel and none beyond, with numbers that CBMC need not search, only whether the second
// unit is there: a step that leaves the channels shows at once.
#include "keel/middleware/virtual_imu.h"

#include "../common/voter_proof.h"

void keel_virtual_imu_step__channels_harness(void)
{
    const keel_voter_config_t one = {1.0f, 3.0f, -9.0f, 9.0f, 9.0f, 5u, 2u, 0u, 0u, 2u};
    const keel_imu_config_t config = {one, one};
    const bool both = nondet_bool();
    const keel_imu_sample_t sample[2] = {{{0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f}, 0u, true},
                                         {{0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f}, 0u, both}};
    keel_virtual_imu_t imu;

    (void)keel_virtual_imu_init(&imu, &config);
    imu.channel[0].unanimous = true; /* As if both had given 9 before. */
    imu.channel[0].vote.state = KEEL_VOTER_MEAN;
    imu.channel[0].vote.contributing = 2u;
    imu.channel[0].vote.weight[0] = 1.0f;
    imu.channel[0].vote.weight[1] = 1.0f;

    keel_virtual_imu_step(&imu, sample, 0u);

    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        __CPROVER_assert(imu.channel[k].vote.output == ((float)k + (both ? 0.25f : 0.0f)),
                         "IMU_002_valid: each channel is the mean of its own samples");
    }
    __CPROVER_assert((imu.used[0] == KEEL_IMU_ALL) && (imu.used[1] == (both ? KEEL_IMU_ALL : 0u)),
                     "IMU_003_used: all of them");
}
