// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_combine
//
// Every weight that keel_voter_weight may give, every bit pattern of the samples without weight.
#include "../common/voter_proof.h"

void keel_voter_combine_harness(void)
{
    keel_voter_sample_t sample[SENSORS];
    float weight[SENSORS];
    const uint32_t sensors = nondet_u32();
    bool some = false;
    bool above = false;
    bool below = false;
    float mean;

    __CPROVER_assume((1u <= sensors) && (sensors <= SENSORS));
    any_samples(sample);
    for (uint32_t i = 0u; i < SENSORS; i++) {
        weight[i] = nondet_float();
        if (i < sensors) {
            __CPROVER_assume((weight[i] == 0.0f) ||
                             ((0x1p-26f <= weight[i]) && (weight[i] <= 1.0f)));
            __CPROVER_assume((weight[i] == 0.0f) || ((-KEEL_VOTER_RANGE <= sample[i].value) &&
                                                     (sample[i].value <= KEEL_VOTER_RANGE)));
            some = some || (weight[i] > 0.0f);
        }
    }
    __CPROVER_assume(some);

    mean = keel_voter_combine(sample, weight, sensors);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if ((i < sensors) && (weight[i] > 0.0f)) {
            above = above || (sample[i].value <= mean);
            below = below || (mean <= sample[i].value);
        }
    }
    __CPROVER_assert(finite_here(mean), "VOT_005_finite: the mean is finite");
    __CPROVER_assert(above, "VOT_005_above: not below what contributes");
    __CPROVER_assert(below, "VOT_005_below: nor above");
}
