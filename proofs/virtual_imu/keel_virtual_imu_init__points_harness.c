// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --object-bits 10
// checks: assertions
// sources: src/middleware/virtual_imu.c src/middleware/voter.c specs/model/virtual_imu.c
// sources: specs/model/voter.c specs/model/range.c
// covers: keel_virtual_imu_init model_virtual_imu_init
//
// Chosen configurations, of which the last four are refused, each for a reason of its own; every
// bit was set before. Every configuration: keel_virtual_imu_init_harness.c, which takes longer.
#include "chosen_vote.h"

#define POINTS 5u

static keel_virtual_imu_config_t configuration(uint32_t point)
{
    keel_virtual_imu_config_t config = {accelerometer, gyroscope};

    if ((point == 1u) || (point == 2u)) {
        config.accelerometer.latch_count = 0u;
    }
    if ((point == 2u) || (point == 3u)) {
        config.gyroscope.max_age_us = 0u;
    }
    if (point == 4u) {
        config.gyroscope.sensors = UNITS - 1u;
    }
    return config;
}

/* A unit of which every bit is set. */
static keel_virtual_imu_t voted(void)
{
    keel_virtual_imu_t imu = after_a_vote();

    for (uint32_t i = 0u; i < SENSORS; i++) {
        imu.used[i] = UINT8_MAX;
        imu.latched[i] = UINT8_MAX;
    }
    return imu;
}

void keel_virtual_imu_init__points_harness(void)
{
    for (uint32_t point = 0u; point < POINTS; point++) {
        const keel_virtual_imu_config_t config = configuration(point);
        keel_virtual_imu_t imu = voted();
        keel_virtual_imu_t model = imu;
        const keel_status_t expected = model_virtual_imu_init(&model, &config);

        __CPROVER_assert(keel_virtual_imu_init(&imu, &config) == expected,
                         "IMU_001_points: taken or refused as the model says");
        for (uint32_t i = 0u; i < SENSORS; i++) {
            __CPROVER_assert(virtual_imu_same(&imu, &model, i),
                             "IMU_001_points: every field is what the model says");
        }
    }
}
