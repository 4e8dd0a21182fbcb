// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// checks: assertions
// covers: keel_virtual_imu_init
//
// Each clause of the contract, without the model: every bit pattern of both configurations, and of
// what the unit was before. All other checks: keel_virtual_imu_init_harness.c.
#include "virtual_imu_proof.h"

/* Every channel of a kind has its configuration, and as its output the initial one. */
static bool has_config(const keel_virtual_imu_t *imu, uint32_t k, const keel_voter_config_t *config)
{
    const keel_voter_t *const voter = &imu->channel[k];

    return voter_config_same(&voter->config, config) &&
           float_same(voter->vote.output, config->initial);
}

void keel_virtual_imu_init__clauses_harness(void)
{
    const keel_virtual_imu_config_t config = {any_voter_config(), any_voter_config()};
    const bool valid = config_valid_here(&config.accelerometer) &&
                       config_valid_here(&config.gyroscope);
    const bool as_many = config.accelerometer.sensors == config.gyroscope.sensors;
    keel_virtual_imu_t imu;
    keel_virtual_imu_t before;
    keel_status_t status;

    any_virtual_imu(&imu, nondet_u8());
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        imu.channel[k].config = any_voter_config();
    }
    before = imu;

    status = keel_virtual_imu_init(&imu, &config);

    __CPROVER_assert(
        (status == KEEL_OK) == (valid && as_many),
        "IMU_001_accepted: two valid configurations of as many sensors, and no others");
    __CPROVER_assert(!(valid && !as_many) || (status == KEEL_ERR_SENSORS),
                     "IMU_001_differ: refused for their numbers of sensors, when these differ");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert((status == KEEL_OK) || virtual_imu_same(&imu, &before, i),
                         "IMU_001_kept: a refusal changes nothing");
        __CPROVER_assert((status != KEEL_OK) || ((imu.used[i] == 0u) && (imu.latched[i] == 0u)),
                         "IMU_001_fresh: no verdict is noted");
    }
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        const bool accelerometer = k < KEEL_VIRTUAL_IMU_ACCELEROMETER;

        __CPROVER_assert((status != KEEL_OK) || !accelerometer ||
                             has_config(&imu, k, &config.accelerometer),
                         "IMU_001_accelerometer: its channels begin with its configuration");
        __CPROVER_assert((status != KEEL_OK) || accelerometer ||
                             has_config(&imu, k, &config.gyroscope),
                         "IMU_001_gyroscope: its channels begin with its configuration");
    }
}
