// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// replaces: keel_voter_mean
// covers: keel_voter_plain
//
// The quotient is whatever its contract allows.
#include "../common/voter_stand_ins.h"

void keel_voter_plain__bounds_harness(void)
{
    const float least = nondet_float();
    const float most = nondet_float();
    const uint32_t sensors = nondet_u32();
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t before[SENSORS];
    float mean;

    any_samples(sample, before);
    __CPROVER_assume(keel_voter_plain_may(sample, sensors, least, most));

    mean = keel_voter_plain(sample, sensors, least, most);

    __CPROVER_assert(keel_voter_plain_does(mean, least, most),
                     "VOT_018_mean: the mean lies among the samples");
}
