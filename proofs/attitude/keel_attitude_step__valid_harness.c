// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_step
// replaces: keel_attitude_is_unit
//
// Any bit pattern for all that was measured and for the quaternion, the rest of the estimator
// valid: one step of the induction that keeps every state finite and within its bounds. The bias is
// in keel_attitude_step__clauses_harness, the heading's error in
// keel_attitude_step__heading_harness.
// The quaternion that a step leaves is the level one, or the one that keel_attitude_is_unit was
// asked of last and took for one; either way its components are within 1 + 2^-10. What is measured
// and no number is computed with and refused by the gates: overflow on the way to a gate is not
// checked.
#include "attitude_proof.h"

void keel_attitude_step__valid_harness(void)
{
    const keel_attitude_sample_t sample = any_sample();
    keel_attitude_t attitude = any_attitude_at_all();

    __CPROVER_assume(attitude_rest_valid(&attitude));

    keel_attitude_step(&attitude, &sample);

    __CPROVER_assert(quaternion_same(&attitude.quaternion, &accepted),
                     "ATT_011_taken: the quaternion was taken for a unit");
    __CPROVER_assert(keel_attitude_is_unit_does(true, attitude.quaternion),
                     "ATT_011_components: the quaternion is finite and bounded");
    __CPROVER_assert(attitude_counts_valid(&attitude), "ATT_011_counts: the counts are in range");
    __CPROVER_assert(attitude.phase <= KEEL_ATTITUDE_RUNNING, "ATT_014_one: one of three phases");
    __CPROVER_assert(vector_within(attitude.first_rate, KEEL_ATTITUDE_RATE_LIMIT) &&
                         vector_within(attitude.first_force, KEEL_ATTITUDE_FORCE_LIMIT),
                     "ATT_011_still: so is the first of the still samples");
    __CPROVER_assert(attitude_passed_valid(&attitude),
                     "ATT_020_bounded: so is what was low-passed");
    __CPROVER_assert(vector_within(attitude.gyroscope, KEEL_ATTITUDE_RATE_LIMIT) &&
                         vector_within(attitude.rate, KEEL_ATTITUDE_RATE_LIMIT + 0.5f),
                     "ATT_011_rate: so are the rates");
}
