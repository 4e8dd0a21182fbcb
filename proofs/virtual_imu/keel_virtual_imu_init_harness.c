// cbmc: --unwind 7 --z3 --fpa
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// sources: specs/model/virtual_imu.c specs/model/voter.c specs/model/range.c
// checks: assertions
// covers: keel_virtual_imu_init model_virtual_imu_init
//
// Every bit pattern of both configurations, and of what the virtual unit was before. All other
// checks: keel_virtual_imu_init__valid_harness.c.
#include "../common/virtual_imu_proof.h"

void keel_virtual_imu_init_harness(void)
{
    keel_virtual_imu_t imu;
    keel_virtual_imu_t model;
    const keel_imu_config_t config = {any_voter_config(), any_voter_config()};
    const keel_imu_config_t before = config;
    keel_status_t expected;
    keel_status_t status;

    any_imu(&imu, nondet_u8());
    model = imu;
    expected = model_virtual_imu_init(&model, &before);

    status = keel_virtual_imu_init(&imu, &config);

    __CPROVER_assert(status == expected, "IMU_001_model: as the model says");
    __CPROVER_assert(virtual_imu_same(&imu, &model), "IMU_001_model: in every field");
    __CPROVER_assert(voter_config_same(&config.accelerometer, &before.accelerometer) &&
                         voter_config_same(&config.gyroscope, &before.gyroscope),
                     "IMU_001_model: the configurations are only read");
}
