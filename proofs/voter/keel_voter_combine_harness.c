// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// checks: assertions
// covers: keel_voter_combine keel_voter_mean model_voter_combine model_voter_mean
//
// Every bit pattern of the samples and the weights of three and four sensors. All other checks:
// keel_voter_combine__bounds_harness.c, for what callers may ask. Two:
// keel_voter_combine__a_pair_harness.c, as z3 takes long over all at once.
#include "../common/voter_proof.h"

void keel_voter_combine_harness(void)
{
    for (uint32_t sensors = 3u; sensors <= SENSORS; sensors++) {
        keel_voter_sample_t sample[SENSORS];
        keel_voter_sample_t before[SENSORS];
        float weight[SENSORS];
        float expected;

        any_samples(sample, before);
        for (uint32_t i = 0u; i < SENSORS; i++) {
            weight[i] = nondet_float();
        }
        expected = model_voter_combine(sample, weight, sensors);

        __CPROVER_assert(float_same(keel_voter_combine(sample, weight, sensors), expected),
                         "VOT_005_model: as the model says");
    }
}
