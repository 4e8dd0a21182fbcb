// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// checks: assertions
// covers: keel_voter_plain_mean model_voter_plain_mean
//
// Every bit pattern of two to four samples. All other checks:
// keel_voter_plain_mean__bounds_harness.c, for what callers may ask.
#include "../common/voter_proof.h"

void keel_voter_plain_mean_harness(void)
{
    for (uint32_t sensors = 2u; sensors <= SENSORS; sensors++) {
        const float least = nondet_float();
        const float most = nondet_float();
        keel_voter_sample_t sample[SENSORS];
        keel_voter_sample_t before[SENSORS];
        float expected;

        any_samples(sample, before);
        expected = model_voter_plain_mean(sample, sensors, least, most);

        __CPROVER_assert(float_same(keel_voter_plain_mean(sample, sensors, least, most), expected),
                         "VOT_018_model: as the model says");
    }
}
