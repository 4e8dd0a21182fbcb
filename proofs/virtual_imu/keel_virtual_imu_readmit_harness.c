// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c specs/model/virtual_imu.c
// sources: specs/model/voter.c specs/model/range.c
// covers: keel_virtual_imu_readmit model_virtual_imu_readmit
//
// Every virtual unit of 2 to 4 units, be its channels valid or not. That a valid channel stays so:
// keel_voter_readmit_harness.c.
#include "virtual_imu_proof.h"

void keel_virtual_imu_readmit_harness(void)
{
    const uint8_t units = nondet_u8();
    const uint32_t unit = nondet_u32();
    keel_virtual_imu_t imu;
    keel_virtual_imu_t model;
    bool noted;
    keel_status_t expected;
    keel_status_t status;

    __CPROVER_assume((2u <= units) && (units <= SENSORS));
    any_virtual_imu(&imu, units);
    noted = noted_here(&imu);
    model = imu;
    expected = model_virtual_imu_readmit(&model, unit);

    status = keel_virtual_imu_readmit(&imu, unit);

    __CPROVER_assert(status == expected, "IMU_004_model: as the model says");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(virtual_imu_same(&imu, &model, i), "IMU_004_model: in every field");
    }
    __CPROVER_assert(!noted || noted_here(&imu), "IMU_004_valid: bits as the channels say, still");
}
