// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// sources: src/flight/altitude.c
// covers: keel_altitude_step height_between
// replaces: keel_axis_step
//
// Any valid estimator, any bit pattern for all that was measured: the contract of a step, clause by
// clause; no operation overflows or gives a NaN.
#include "../axis/axis_stepped.h"
#include "altitude_proof.h"

void keel_altitude_step__valid_harness(void)
{
    const keel_altitude_sample_t sample = any_altitude_sample();
    keel_altitude_t altitude = any_altitude_at_all();
    const keel_altitude_t before = altitude;
    const bool counting = sample.has_pressure && is_pressure(sample.pressure);
    const keel_axis_t *const axis = &altitude.axis;

    __CPROVER_assume(axis_config_valid(&altitude.axis.config));
    __CPROVER_assume(!altitude.has_reference || is_pressure(altitude.reference));
    __CPROVER_assume(within(altitude.zero, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT));

    keel_altitude_step(&altitude, &sample);

    __CPROVER_assert(before.has_reference || !counting ||
                         (altitude.has_reference && (altitude.reference == sample.pressure)),
                     "ALT_004_first: the first pressure is the reference");
    __CPROVER_assert((!before.has_reference && counting) ||
                         ((altitude.has_reference == before.has_reference) &&
                          float_same(altitude.reference, before.reference)),
                     "ALT_004_kept: and stays it");
    __CPROVER_assert(!altitude.has_reference || is_pressure(altitude.reference),
                     "ALT_004_pressure: a reference is a pressure");
    __CPROVER_assert(is_told(axis, KEEL_AXIS_UNUSABLE) == (sample.has_pressure && !counting),
                     "ALT_005_unusable: a pressure that does not count is told");
    __CPROVER_assert(counting ==
                         (is_told(axis, KEEL_AXIS_FIXED) || is_told(axis, KEEL_AXIS_JUMPED)),
                     "ALT_005_counts: any other is judged");
    __CPROVER_assert(within(axis->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT),
                     "ALT_006_position: within its limit");
    __CPROVER_assert(within(axis->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT),
                     "ALT_006_velocity: within its limit");
    __CPROVER_assert(within(altitude.height, -2.0f * KEEL_AXIS_POSITION_LIMIT,
                            2.0f * KEEL_AXIS_POSITION_LIMIT) &&
                         float_same(altitude.height, axis->position - altitude.zero),
                     "ALT_006_height: above what is called 0");
}
