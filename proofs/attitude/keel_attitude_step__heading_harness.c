// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_step
// replaces: keel_attitude_is_unit
//
// As keel_attitude_step__valid_harness: the error of the heading is finite and within 1.25. It is a
// sine whose square, with that of a cosine, is at most KEEL_ATTITUDE_FIELD_RATIO_MAX as rounded.
#include "attitude_proof.h"

void keel_attitude_step__heading_harness(void)
{
    const keel_attitude_sample_t sample = any_sample();
    keel_attitude_t attitude = any_attitude_at_all();

    __CPROVER_assume(attitude_rest_valid(&attitude));

    keel_attitude_step(&attitude, &sample);

    __CPROVER_assert(within(attitude.heading_error, -1.25f, 1.25f),
                     "ATT_011_heading: the error of the heading is in bounds");
}
