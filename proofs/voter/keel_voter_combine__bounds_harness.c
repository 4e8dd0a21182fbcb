// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// replaces: keel_voter_mean
// covers: keel_voter_combine
//
// Every weight that keel_voter_weight may give, every bit pattern of the samples without weight.
// The quotient is whatever its contract allows.
#include "voter_stand_ins.h"

void keel_voter_combine__bounds_harness(void)
{
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t before[SENSORS];
    float weight[SENSORS];
    const uint32_t sensors = nondet_u32();
    float mean;

    any_samples(sample, before);
    for (uint32_t i = 0u; i < SENSORS; i++) {
        weight[i] = nondet_float();
    }
    __CPROVER_assume(keel_voter_combine_may(sample, weight, sensors));

    mean = keel_voter_combine(sample, weight, sensors);

    __CPROVER_assert(finite_here(mean), "VOT_005_finite: the mean is finite");
    __CPROVER_assert(combine_above(mean, sample, weight, sensors),
                     "VOT_005_above: not below what contributes");
    __CPROVER_assert(keel_voter_combine_does(mean, sample, weight, sensors),
                     "VOT_005_below: nor above");
}
