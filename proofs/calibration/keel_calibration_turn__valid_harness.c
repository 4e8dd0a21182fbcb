// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// sources: src/flight/calibration.c
// covers: keel_calibration_turn row_product
//
// Rows of numbers up to 1, and what a correction gives: the result is within four times of it, and
// nothing overflows.
#include "calibration_proof.h"

void keel_calibration_turn__valid_harness(void)
{
    const keel_calibration_rotation_t turn = nondet_turn();
    const keel_calibration_vector_t raw = nondet_vector();
    keel_calibration_vector_t out = nondet_vector();

    __CPROVER_assume(three_within(turn.x, -1.0f, 1.0f));
    __CPROVER_assume(three_within(turn.y, -1.0f, 1.0f));
    __CPROVER_assume(three_within(turn.z, -1.0f, 1.0f));
    __CPROVER_assume(three_within(raw.axis, -4.0f * LIMIT, 4.0f * LIMIT));

    keel_calibration_turn(&turn, raw.axis, &out);

    __CPROVER_assert(three_within(out.axis, -16.0f * LIMIT, 16.0f * LIMIT),
                     "CAL_018_finite: within four times of it");
}
