// cbmc: --unwind 7 --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=2u
// covers: keel_virtual_imu_step note
//
// Any unit may be absent, late or latched, any channel's last vote unanimous; the values are fixed,
// another for each channel, as here it counts which sample goes where. How a channel votes:
// keel_voter_step's harnesses.
#include "keel/middleware/virtual_imu.h"

#include "../common/voter_proof.h"

void keel_virtual_imu_step_harness(void)
{
    keel_virtual_imu_t imu;
    keel_imu_sample_t sample[2];
    bool was[KEEL_IMU_CHANNELS][2];
    float before[KEEL_IMU_CHANNELS];

    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        const keel_voter_config_t config = {1.0f, 3.0f, -9.0f, 9.0f, 0.0f, 5u, 2u, 0u, 0u, 2u};

        imu.channel[k].config = config;
        imu.channel[k].disagree = 3.0f;
        imu.channel[k].unanimous = nondet_bool();
        imu.channel[k].vote.output = imu.channel[k].unanimous ? 0.0f : 9.0f;
        imu.channel[k].vote.state = KEEL_VOTER_MEAN;
        imu.channel[k].vote.contributing = 2u;
        before[k] = imu.channel[k].vote.output;
        imu.channel[k].vote.held = 0u;
        imu.channel[k].vote.held_us = 0u;
        for (uint32_t i = 0u; i < 2u; i++) {
            const keel_voter_sensor_t fresh = {0.0f, 0u, 0u, 0u, false};

            imu.channel[k].sensor[i] = fresh;
            was[k][i] = nondet_bool();
            imu.channel[k].sensor[i].latched = was[k][i];
            imu.channel[k].vote.weight[i] = 1.0f;
            imu.channel[k].vote.reason[i] = KEEL_VOTER_USED;
            sample[i].value[k] = (float)k;
        }
        __CPROVER_assume(!imu.channel[k].unanimous || unanimous_here(&imu.channel[k]));
    }
    sample[0].age_us = nondet_u32();
    sample[1].age_us = nondet_u32();
    sample[0].present = nondet_bool();
    sample[1].present = nondet_bool();

    keel_virtual_imu_step(&imu, sample, nondet_u32());

    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        __CPROVER_assert((imu.channel[k].vote.output == (float)k) ||
                             ((imu.channel[k].vote.output == before[k]) &&
                              (imu.channel[k].vote.contributing == 0u)),
                         "IMU_002_valid: each channel votes on its own samples");
        for (uint32_t i = 0u; i < 2u; i++) {
            __CPROVER_assert((((imu.used[i] >> k) & 1u) != 0u) ==
                                 (imu.channel[k].vote.reason[i] == KEEL_VOTER_USED),
                             "IMU_003_used: a bit per channel that contributed");
            __CPROVER_assert((((imu.latched[i] >> k) & 1u) != 0u) ==
                                 imu.channel[k].sensor[i].latched,
                             "IMU_003_latched: a bit per channel that is latched");
            __CPROVER_assert(sample[i].present ||
                                 (imu.channel[k].vote.reason[i] == KEEL_VOTER_LATCHED) ||
                                 (imu.channel[k].vote.reason[i] == KEEL_VOTER_MISSING),
                             "IMU_002_absent: an absent unit has no channel");
            __CPROVER_assert((imu.channel[k].vote.reason[i] == KEEL_VOTER_LATE) ==
                                 (!was[k][i] && sample[i].present && (sample[i].age_us > 5u)),
                             "IMU_002_late: a unit's age is that of all its channels");
        }
    }
}
