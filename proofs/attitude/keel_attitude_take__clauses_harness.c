// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_take take_three
//
// Any virtual unit, any sample before: whether a rate came.
#include "attitude_proof.h"

keel_virtual_imu_t nondet_imu(void);

void keel_attitude_take__clauses_harness(void)
{
    const keel_virtual_imu_t imu = nondet_imu();
    const keel_voter_t *const gyroscope = &imu.channel[KEEL_VIRTUAL_IMU_ACCELEROMETER];
    keel_attitude_sample_t sample = any_sample();

    keel_attitude_take(&sample, &imu);

    __CPROVER_assert(sample.has_gyroscope == ((gyroscope[0].vote.contributing > 0u) &&
                                              (gyroscope[1].vote.contributing > 0u) &&
                                              (gyroscope[2].vote.contributing > 0u)),
                     "ATT_004_there: a rate came when a sensor contributed to each of the three");
}
