// cbmc: --unwind 7 --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// covers: keel_virtual_imu_init
#include "keel/middleware/virtual_imu.h"

#include "../common/unchanged.h"
#include "../common/voter_proof.h"

void keel_virtual_imu_init_harness(void)
{
    keel_virtual_imu_t imu;
    keel_virtual_imu_t before;
    keel_virtual_imu_config_t config;
    const uint32_t i = nondet_u32();
    keel_status_t expected;
    keel_status_t status;

    __CPROVER_assume(i < SENSORS);
    config.accelerometer = any_voter_config();
    config.gyroscope = any_voter_config();
    before = imu;

    expected = keel_voter_check(&config.accelerometer);
    if (expected == KEEL_OK) {
        expected = keel_voter_check(&config.gyroscope);
    }
    if ((expected == KEEL_OK) && (config.accelerometer.sensors != config.gyroscope.sensors)) {
        expected = KEEL_ERR_SENSORS;
    }

    status = keel_virtual_imu_init(&imu, &config);

    __CPROVER_assert(status == expected, "IMU_001_status: the first reason to refuse, or none");

    if (status == KEEL_OK) {
        __CPROVER_assert(agreement_valid_here(&config.accelerometer) &&
                             limits_valid_here(&config.accelerometer) &&
                             agreement_valid_here(&config.gyroscope) &&
                             limits_valid_here(&config.gyroscope) &&
                             (config.accelerometer.sensors == config.gyroscope.sensors),
                         "IMU_001_refused: nothing invalid is accepted");
        __CPROVER_assert((imu.channel[0].config.agree == config.accelerometer.agree) &&
                             (imu.channel[2].config.lowest == config.accelerometer.lowest) &&
                             (imu.channel[3].config.agree == config.gyroscope.agree) &&
                             (imu.channel[5].config.lowest == config.gyroscope.lowest) &&
                             (imu.channel[5].vote.held == 0u) && (imu.used[i] == 0u) &&
                             (imu.latched[i] == 0u),
                         "IMU_001_ready: each channel has its configuration");
    } else {
        __CPROVER_assert(unchanged(&imu, &before, sizeof(imu)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
