// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c
// covers: keel_calibration_rest_step
//
// Any run, any number that was measured: which ones belong to it, by their rounded differences.
#include "calibration_proof.h"

void keel_calibration_rest_step__near_harness(void)
{
    const keel_calibration_vector_t sample = nondet_vector();
    keel_calibration_rest_t rest = any_rest_at_all();
    const float spread = rest.config.spread;
    const float x = sample.axis[0] - rest.first[0];
    const float y = sample.axis[1] - rest.first[1];
    const float z = sample.axis[2] - rest.first[2];
    const bool near = within(x, -spread, spread) && within(y, -spread, spread) &&
                      within(z, -spread, spread);

    __CPROVER_assume(rest_counts(&rest) && (rest.count != 0u));
    __CPROVER_assume(rest.state == KEEL_CALIBRATION_COLLECTING);
    __CPROVER_assume(three_within(sample.axis, -LIMIT, LIMIT));

    keel_calibration_rest_step(&rest, sample.axis);

    __CPROVER_assert((rest.count == 0u) == !near, "CAL_005_far: what lies too far off ends a run");
}
