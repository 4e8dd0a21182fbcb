// cbmc: --unwind 7 --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=2u
// covers: keel_virtual_imu_readmit
#include "keel/middleware/virtual_imu.h"

#include "../common/unchanged.h"
#include "../common/voter_proof.h"

void keel_virtual_imu_readmit_harness(void)
{
    keel_virtual_imu_t imu;
    const uint32_t unit = nondet_u32();
    bool was = false;
    bool is = false;
    keel_virtual_imu_t before;
    keel_status_t status;

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        imu.channel[k].config.sensors = 2u;
        imu.channel[k].sensor[0] = any_sensor();
        imu.channel[k].sensor[1] = any_sensor();
        was = was || ((unit == 0u) && imu.channel[k].sensor[0].latched) ||
              ((unit == 1u) && imu.channel[k].sensor[1].latched);
    }
    imu.latched[0] = nondet_u8();
    imu.latched[1] = nondet_u8();
    before = imu;

    status = keel_virtual_imu_readmit(&imu, unit);

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        is = is || ((unit == 0u) && imu.channel[k].sensor[0].latched) ||
             ((unit == 1u) && imu.channel[k].sensor[1].latched);
    }
    __CPROVER_assert((status == KEEL_ERR_SENSORS) == (unit > 1u), "IMU_004_unknown: no such unit");
    __CPROVER_assert((status == KEEL_OK) == was, "IMU_004_refused: none of its is latched");
    __CPROVER_assert((status != KEEL_OK) || !is, "IMU_004_readmitted: all of its channels are");
    __CPROVER_assert((status != KEEL_OK) || (imu.latched[unit] == 0u),
                     "IMU_004_noted: no channel of it is latched");
    __CPROVER_assert((unit == 1u) || (imu.latched[1] == before.latched[1]),
                     "IMU_004_note: the other unit's note stays");
    __CPROVER_assert((unit == 1u) ||
                         unchanged(&imu.channel[3].sensor[1], &before.channel[3].sensor[1],
                                   sizeof(keel_voter_sensor_t)),
                     "IMU_004_frame: the other unit stays");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&imu, &before, sizeof(imu)),
                     "STA_001_kept: a refusal changes nothing");
}
