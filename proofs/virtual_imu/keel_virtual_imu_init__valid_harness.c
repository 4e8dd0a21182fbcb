// cbmc: --unwind 7 --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// sources: specs/model/virtual_imu.c specs/model/voter.c specs/model/range.c
// covers: keel_virtual_imu_init
#include "../common/virtual_imu_proof.h"

void keel_virtual_imu_init__valid_harness(void)
{
    keel_virtual_imu_t imu;
    const keel_imu_config_t config = {any_voter_config(), any_voter_config()};

    if (keel_virtual_imu_init(&imu, &config) == KEEL_OK) {
        __CPROVER_assert(imu_valid_here(&imu), "IMU_001_ready: each channel is valid");
    }
}
