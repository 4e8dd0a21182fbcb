// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_side way_of model_calibration_side lies_in
//
// Any bit pattern: the side is the model's, and the contract, clause by clause.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_side_harness(void)
{
    keel_calibration_vector_t mean = nondet_vector();
    const keel_calibration_vector_t before = mean;
    const float least = nondet_float();
    const float most = nondet_float();
    const uint32_t axis = any_axis();
    uint32_t side;

    __CPROVER_assume(side_limits(least, most));

    side = keel_calibration_side(mean.axis, least, most);

    __CPROVER_assert(side == model_calibration_side(before.axis, least, most),
                     "CAL_016_model: what the model says");
    __CPROVER_assert(vector_same(&mean, &before), "CAL_016_frame: nothing is written");
    __CPROVER_assert(side <= KEEL_CALIBRATION_SIDES, "CAL_016_side: one of six, or none");
    __CPROVER_assert(three_within(mean.axis, -LIMIT, LIMIT) || (side == KEEL_CALIBRATION_SIDES),
                     "CAL_016_none: what is no number has no side");
    __CPROVER_assert((side != (2u * axis)) || (mean.axis[axis] >= least),
                     "CAL_016_up: what points up says so");
    __CPROVER_assert((side != ((2u * axis) + 1u)) || (mean.axis[axis] <= -least),
                     "CAL_016_down: what points down says so");
}
