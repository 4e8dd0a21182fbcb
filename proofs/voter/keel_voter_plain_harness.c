// cbmc: --unwind 5 --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// checks: assertions
// covers: keel_voter_plain keel_voter_mean model_voter_plain
//
// Every bit pattern of the samples of two to four sensors. All other checks:
// keel_voter_plain__bounds_harness.c, for what callers may ask.
#include "../common/voter_proof.h"

void keel_voter_plain_harness(void)
{
    for (uint32_t sensors = 2u; sensors <= SENSORS; sensors++) {
        const float least = nondet_float();
        const float most = nondet_float();
        keel_voter_sample_t sample[SENSORS];
        keel_voter_sample_t before[SENSORS];
        float expected;

        any_samples(sample, before);
        expected = model_voter_plain(sample, sensors, least, most);

        __CPROVER_assert(float_same(keel_voter_plain(sample, sensors, least, most), expected),
                         "VOT_018_model: as the model says");
    }
}
