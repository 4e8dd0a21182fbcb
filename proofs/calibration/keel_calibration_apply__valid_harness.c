// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// sources: src/flight/calibration.c
// covers: keel_calibration_apply
//
// Offsets and samples within the limit: the result is within twice of it, and nothing overflows.
#include "calibration_proof.h"

void keel_calibration_apply__valid_harness(void)
{
    const keel_calibration_vector_t offset = nondet_vector();
    const keel_calibration_vector_t raw = nondet_vector();
    keel_calibration_vector_t out = nondet_vector();

    __CPROVER_assume(three_within(offset.axis, -LIMIT, LIMIT));
    __CPROVER_assume(three_within(raw.axis, -LIMIT, LIMIT));

    keel_calibration_apply(offset.axis, raw.axis, &out);

    __CPROVER_assert(three_within(out.axis, -2.0f * LIMIT, 2.0f * LIMIT),
                     "CAL_014_finite: within twice the limit");
}
