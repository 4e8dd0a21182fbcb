// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c specs/model/virtual_imu.c
// sources: specs/model/voter.c specs/model/range.c
// covers: keel_virtual_imu_init model_virtual_imu_init
//
// Every bit pattern of both configurations, and of what the unit was before. That a channel is
// valid once it is initialised: VOT_002_ready, keel_voter_init__valid_harness.c.
#include "virtual_imu_proof.h"

void keel_virtual_imu_init_harness(void)
{
    const keel_virtual_imu_config_t config = {any_voter_config(), any_voter_config()};
    const keel_virtual_imu_config_t before = config;
    keel_virtual_imu_t imu;
    keel_virtual_imu_t model;
    keel_status_t expected;
    keel_status_t status;

    any_virtual_imu(&imu, nondet_u8());
    model = imu;
    expected = model_virtual_imu_init(&model, &config);

    status = keel_virtual_imu_init(&imu, &config);

    __CPROVER_assert(status == expected, "IMU_001_model: as the model says");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(virtual_imu_same(&imu, &model, i), "IMU_001_model: in every field");
    }
    __CPROVER_assert((status != KEEL_OK) || noted_here(&imu),
                     "IMU_001_ready: no bit is set, and no channel is latched");
    __CPROVER_assert(voter_config_same(&config.accelerometer, &before.accelerometer) &&
                         voter_config_same(&config.gyroscope, &before.gyroscope),
                     "IMU_001_read: the configuration is only read");
}
