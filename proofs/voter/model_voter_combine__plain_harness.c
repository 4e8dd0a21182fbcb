// cbmc: --unwind 5 --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// replaces: model_voter_product
// checks: assertions
// covers: model_voter_combine model_voter_plain
//
// Where all weights are 1, eq. 18 is the plain mean: two to four sensors, samples in range.
#include "../common/voter_stand_ins.h"

void model_voter_combine__plain_harness(void)
{
    for (uint32_t sensors = 2u; sensors <= SENSORS; sensors++) {
        const float weight[SENSORS] = {1.0f, 1.0f, 1.0f, 1.0f};
        keel_voter_sample_t sample[SENSORS];
        keel_voter_sample_t before[SENSORS];
        float mean;

        any_samples(sample, before);
        __CPROVER_assume(model_voter_combine_may(sample, weight, sensors));

        mean = model_voter_combine(sample, weight, sensors);

        __CPROVER_assert(model_voter_combine_does(mean, sample, weight, sensors),
                         "VOT_018_plain: the mean of eq. 18 is the plain one");
    }
}
