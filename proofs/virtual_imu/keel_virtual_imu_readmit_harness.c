// cbmc: --unwind 7 --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// sources: specs/model/virtual_imu.c specs/model/voter.c specs/model/range.c
// covers: keel_virtual_imu_readmit model_virtual_imu_readmit
//
// Whatever the channels are, valid or not; that each stays valid is keel_voter_readmit_harness.c's.
#include "../common/virtual_imu_proof.h"

void keel_virtual_imu_readmit_harness(void)
{
    keel_virtual_imu_t imu;
    keel_virtual_imu_t model;
    const uint32_t unit = nondet_u32();
    keel_status_t expected;
    keel_status_t status;

    any_imu(&imu, nondet_u8());
    __CPROVER_assume(imu.channel[0].config.sensors <= SENSORS);
    model = imu;
    expected = model_virtual_imu_readmit(&model, unit);

    status = keel_virtual_imu_readmit(&imu, unit);

    __CPROVER_assert(status == expected, "IMU_004_model: as the model says");
    __CPROVER_assert(virtual_imu_same(&imu, &model), "IMU_004_model: in every field");
}
