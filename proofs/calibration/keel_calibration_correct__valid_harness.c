// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// sources: src/flight/calibration.c
// covers: keel_calibration_correct
//
// Valid corrections and samples within the limit: the result is within four times of it, and
// nothing overflows.
#include "calibration_proof.h"

void keel_calibration_correct__valid_harness(void)
{
    const keel_calibration_correction_t correction = nondet_correction();
    const keel_calibration_vector_t raw = nondet_vector();
    keel_calibration_vector_t out = nondet_vector();

    __CPROVER_assume(correction_valid(&correction));
    __CPROVER_assume(three_within(raw.axis, -LIMIT, LIMIT));

    keel_calibration_correct(&correction, raw.axis, &out);

    __CPROVER_assert(three_within(out.axis, -4.0f * LIMIT, 4.0f * LIMIT),
                     "CAL_015_finite: within four times the limit");
}
