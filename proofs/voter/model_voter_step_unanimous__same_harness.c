// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// replaces: keel_voter_agreement keel_voter_weight keel_voter_combine keel_voter_within
// replaces: model_voter_agreement model_voter_weight model_voter_combine model_voter_within
// replaces: keel_voter_plain model_voter_plain
// covers: model_voter_step_unanimous
//
// A theorem about the model: where it takes the shorter way, it leaves what the whole vote leaves,
// after however long: every valid channel of 2 to 4 sensors, every bit pattern of the samples. Only
// a sample that has not changed is the last one bit for bit here: where 0 takes the place of -0, or
// the other way round, all that is 0 in the outcome may have the other sign.
#include "../common/voter_stand_ins.h"

void model_voter_step_unanimous__same_harness(void)
{
    for (uint8_t sensors = 2u; sensors <= SENSORS; sensors++) {
        const uint32_t oldest_us = nondet_u32();
        keel_voter_t voter;
        keel_voter_t whole;
        keel_voter_sample_t sample[SENSORS];
        keel_voter_sample_t same[SENSORS];

        any_channel(&voter, sensors);
        any_samples(sample, same);
        __CPROVER_assume(keel_voter_step_unanimous_may(&voter, sample, oldest_us));
        for (uint32_t i = 0u; i < SENSORS; i++) {
            __CPROVER_assume((sample[i].value != voter.sensor[i].last) ||
                             float_same(sample[i].value, voter.sensor[i].last));
        }
        whole = voter;

        if (model_voter_step_unanimous(&voter, sample, oldest_us)) {
            model_voter_step(&whole, same, nondet_u32());
            __CPROVER_assert(voter_same(&voter, &whole), "VOT_018_same: as the whole vote says");
        }
    }
}
