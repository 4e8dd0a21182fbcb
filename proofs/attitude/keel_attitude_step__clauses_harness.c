// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_step
// replaces: keel_attitude_is_unit
//
// As keel_attitude_step__valid_harness: the contract of a step, clause by clause.
#include "attitude_proof.h"

static bool is_told(const keel_attitude_t *attitude, uint32_t flag)
{
    return (attitude->flags & flag) != 0u;
}

static bool runs(const keel_attitude_t *attitude)
{
    return attitude->phase == KEEL_ATTITUDE_RUNNING;
}

void keel_attitude_step__clauses_harness(void)
{
    const keel_attitude_sample_t sample = any_sample();
    keel_attitude_t attitude = any_attitude_at_all();
    const keel_attitude_t before = attitude;

    __CPROVER_assume(attitude_rest_valid(&attitude));

    keel_attitude_step(&attitude, &sample);

    __CPROVER_assert(sample.has_gyroscope || is_told(&attitude, KEEL_ATTITUDE_LOST),
                     "ATT_005_lost: a rate that does not come is told");
    __CPROVER_assert(!is_told(&attitude, KEEL_ATTITUDE_DOWN) ||
                         (sample.has_accelerometer &&
                          vector_within(sample.accelerometer, KEEL_ATTITUDE_FORCE_LIMIT)),
                     "ATT_006_down: gravity is measured");
    __CPROVER_assert(!is_told(&attitude, KEEL_ATTITUDE_COMPENSATED) ||
                         (sample.has_acceleration &&
                          vector_within(sample.acceleration, KEEL_ATTITUDE_FORCE_LIMIT)),
                     "ATT_007_compensated: what is taken off was given, and is in range");
    __CPROVER_assert(!is_told(&attitude, KEEL_ATTITUDE_FIELD) ||
                         (sample.has_magnetometer &&
                          vector_within(sample.magnetometer, KEEL_ATTITUDE_FIELD_REACH) &&
                          (attitude.field_age == 0u)),
                     "ATT_008_field: the field that counts is a new one");
    __CPROVER_assert(float_same(attitude.rate.x, attitude.gyroscope.x - before.bias.x) &&
                         float_same(attitude.rate.y, attitude.gyroscope.y - before.bias.y) &&
                         float_same(attitude.rate.z, attitude.gyroscope.z - before.bias.z),
                     "ATT_009_rate: the rate is the gyroscope's less the bias");
    __CPROVER_assert(vector_within(attitude.bias, attitude.config.bias_limit),
                     "ATT_012_limit: the bias is within its limit");
    __CPROVER_assert(is_told(&attitude, KEEL_ATTITUDE_DOWN) ||
                         (before.phase == KEEL_ATTITUDE_STILL) ||
                         vector_same(&attitude.bias, &before.bias),
                     "ATT_012_rests: without gravity the bias rests");
    __CPROVER_assert((before.phase != KEEL_ATTITUDE_STILL) ||
                         (attitude.phase == KEEL_ATTITUDE_STILL) ||
                         ((attitude.phase == KEEL_ATTITUDE_ALIGNING) && (attitude.still == 0u)),
                     "ATT_013_mean: behind the rest it aligns");
    __CPROVER_assert(!runs(&attitude) || runs(&before) ||
                         ((before.phase == KEEL_ATTITUDE_ALIGNING) && (attitude.lost == 0u) &&
                          (attitude.settled == attitude.config.settle_steps)),
                     "ATT_014_begins: tilt is valid once it has settled");
    __CPROVER_assert(!runs(&before) || runs(&attitude) ||
                         ((attitude.phase == KEEL_ATTITUDE_ALIGNING) && (attitude.settled == 0u) &&
                          !attitude.heading_valid),
                     "ATT_014_ends: without valid tilt nothing is valid");
    __CPROVER_assert(!attitude.heading_valid || before.heading_valid ||
                         (runs(&attitude) && is_told(&attitude, KEEL_ATTITUDE_FIELD) &&
                          (attitude.heading_settled == attitude.config.settle_steps)),
                     "ATT_015_begins: a heading is valid once it has settled");
    __CPROVER_assert(!is_told(&attitude, KEEL_ATTITUDE_CORRUPTED) ||
                         (is_level(attitude.quaternion) && !runs(&attitude) &&
                          vector_within(attitude.down, 0.0f) &&
                          vector_within(attitude.field, 0.0f)),
                     "ATT_016_told: what was corrupted is level, and nothing is known");
}
