// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --object-bits 10
// sources: src/middleware/virtual_imu.c src/middleware/voter.c specs/model/virtual_imu.c
// sources: specs/model/voter.c specs/model/voter_parts.c specs/model/range.c
// covers: keel_virtual_imu_step note keel_virtual_imu_init keel_virtual_imu_readmit
//
// Chosen votes of three units, one after the other, with the votes themselves in them: the same as
// the model's, in every field. All of them are dealt with in the other harnesses; a mistake in
// which sample, age, channel or bit is meant shows here, in seconds.
#include "virtual_imu_proof.h"

#define UNITS 3u
#define VOTES 3u

/* One unit is off in one channel; how old each unit's sample is, and which unit gives none. */
typedef struct point {
    uint32_t off;
    uint32_t channel;
    uint32_t age_us[UNITS];
    uint32_t absent;
    uint32_t elapsed_us;
} point_t;

#define NONE 9u

/* All agree; one is off where a first bad vote latches; one gives nothing, and another one is late
 * for the accelerometer alone. */
static const point_t points[VOTES] = {
    {NONE, 0u, {10u, 30u, 20u}, NONE, 1000u},
    {2u, 5u, {30u, 10u, 20u}, NONE, 900u},
    {1u, 1u, {10u, 1500u, 20u}, 0u, 1100u},
};

static const keel_virtual_imu_config_t good = {
    {1.0f, 3.0f, -100.0f, 100.0f, 1.5f, 1000u, 2u, 0u, 0u, UNITS},
    {2.0f, 2.0f, -50.0f, 60.0f, -0.5f, 2000u, 1u, 3u, 9u, UNITS},
};

static keel_virtual_imu_t imu;
static keel_virtual_imu_t model;

static void initialise(const keel_virtual_imu_config_t *config)
{
    const keel_status_t status = keel_virtual_imu_init(&imu, config);

    __CPROVER_assert(status == model_virtual_imu_init(&model, config),
                     "IMU_001_points: taken or refused as the model says");
    __CPROVER_assert(virtual_imu_same(&imu, &model), "IMU_001_points: in every field");
}

static void vote(const point_t *point, uint32_t number)
{
    keel_virtual_imu_sample_t sample[SENSORS] = {{{0.0f}, 0u, false}};

    for (uint32_t i = 0u; i < UNITS; i++) {
        sample[i].age_us = point->age_us[i];
        sample[i].present = i != point->absent;
        for (uint32_t k = 0u; k < CHANNELS; k++) {
            sample[i].value[k] = (5.0f * (float)k) + (0.125f * (float)i) + (0.25f * (float)number);
        }
    }
    if (point->off < UNITS) {
        sample[point->off].value[point->channel] += 20.0f;
    }
    model_virtual_imu_step(&model, sample, point->elapsed_us);

    keel_virtual_imu_step(&imu, sample, point->elapsed_us);

    __CPROVER_assert(virtual_imu_same(&imu, &model), "IMU_002_points: as the model says");
}

static void readmit(uint32_t unit)
{
    const keel_status_t status = keel_virtual_imu_readmit(&imu, unit);

    __CPROVER_assert(status == model_virtual_imu_readmit(&model, unit),
                     "IMU_004_points: taken or refused as the model says");
    __CPROVER_assert(virtual_imu_same(&imu, &model), "IMU_004_points: in every field");
}

void keel_virtual_imu_step__points_harness(void)
{
    keel_virtual_imu_config_t bad = good;

    bad.gyroscope.sensors = 2u;
    initialise(&bad);
    initialise(&good);
    for (uint32_t number = 0u; number < VOTES; number++) {
        vote(&points[number], number);
    }
    readmit(UNITS);
    readmit(2u);
    readmit(2u);
}
