// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// replaces: keel_voter_mean
// covers: keel_voter_plain_mean
//
// Every number of samples between every two ends. The quotient is whatever its contract allows.
#include "voter_stand_ins.h"

void keel_voter_plain_mean__bounds_harness(void)
{
    const uint32_t sensors = nondet_u32();
    const float least = nondet_float();
    const float most = nondet_float();
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t before[SENSORS];
    float mean;

    any_samples(sample, before);
    __CPROVER_assume(keel_voter_plain_mean_may(sample, sensors, least, most));

    mean = keel_voter_plain_mean(sample, sensors, least, most);

    __CPROVER_assert(keel_voter_plain_mean_does(mean, least, most),
                     "VOT_018_mean: it lies among the samples");
}
