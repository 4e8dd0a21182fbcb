// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c
// covers: keel_calibration_rest_step
//
// Any state, any bit pattern for what was measured: what belongs to a run, by the rounded
// differences to its first.
#include "calibration_proof.h"

void keel_calibration_rest_step__near_harness(void)
{
    const keel_calibration_vector_t sample = nondet_vector();
    keel_calibration_rest_t rest = any_rest_at_all();
    const bool runs = (rest.state == KEEL_CALIBRATION_COLLECTING) && (rest.count != 0u) &&
                      three_within(sample.axis, -LIMIT, LIMIT);
    const float spread = rest.config.spread;
    const float x = sample.axis[0] - rest.first[0];
    const float y = sample.axis[1] - rest.first[1];
    const float z = sample.axis[2] - rest.first[2];
    const bool near = within(x, -spread, spread) && within(y, -spread, spread) &&
                      within(z, -spread, spread);

    __CPROVER_assume(rest_counts(&rest));

    keel_calibration_rest_step(&rest, sample.axis);

    __CPROVER_assert(!runs || ((rest.count == 0u) == !near),
                     "CAL_005_far: what lies too far off ends a run");
}
