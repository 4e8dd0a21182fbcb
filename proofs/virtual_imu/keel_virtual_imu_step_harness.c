// cbmc: --unwind 7 --external-sat-solver cadical
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// sources: specs/model/virtual_imu.c specs/model/voter.c specs/model/range.c
// replaces: keel_voter_step keel_voter_step_unanimous keel_voter_plain
// replaces: model_voter_step model_voter_plain
// covers: keel_virtual_imu_step note model_virtual_imu_step
//
// Every valid virtual unit of 2 to 4 units, every bit pattern of the samples. What a channel's vote
// leaves is any function of the channel, of the samples and of the time, with the contract of the
// vote. So each channel has one outcome here, and what is asked for it must be the same in the code
// as in the model. A unanimous vote that is taken leaves the same, whatever the time
// (model_voter_step_unanimous__same_harness.c).
#include "../common/virtual_imu_proof.h"
#include "../common/voter_stand_ins.h"

static keel_virtual_imu_t imu;
static keel_virtual_imu_t model;
static keel_virtual_imu_t before;
static keel_voter_t outcome[KEEL_IMU_CHANNELS];

/* What the model asked for. */
static keel_voter_sample_t asked[KEEL_IMU_CHANNELS][SENSORS];
static uint32_t asked_elapsed_us;

static uint32_t index_of(const keel_voter_t *voter, const keel_virtual_imu_t *of)
{
    uint32_t k = 0u;

    while ((k < (KEEL_IMU_CHANNELS - 1u)) && (voter != &of->channel[k])) {
        k++;
    }
    return k;
}

void model_voter_step_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                               uint32_t elapsed_us)
{
    const uint32_t k = index_of(voter, &model);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        asked[k][i] = sample[i];
    }
    asked_elapsed_us = elapsed_us;
    *voter = outcome[k];
    __CPROVER_assume(keel_voter_step_does(voter));
}

/* Whether the samples of a vote are those that the model asked for. */
static bool as_asked(uint32_t k, const keel_voter_sample_t sample[])
{
    bool same = true;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        same = same && ((i >= before.channel[k].config.sensors) ||
                        (float_same(sample[i].value, asked[k][i].value) &&
                         (sample[i].age_us == asked[k][i].age_us) &&
                         (sample[i].present == asked[k][i].present)));
    }
    return same;
}

void keel_voter_step_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                              uint32_t elapsed_us)
{
    const uint32_t k = index_of(voter, &imu);

    __CPROVER_assert(keel_voter_step_may(voter), "precondition: keel_voter_step");
    __CPROVER_assert(voter_same(voter, &before.channel[k]) && as_asked(k, sample) &&
                         (elapsed_us == asked_elapsed_us),
                     "IMU_002_asked: each channel votes once, on what the model says");
    *voter = outcome[k];
    __CPROVER_assume(keel_voter_step_does(voter));
}

bool keel_voter_step_unanimous_stand_in(keel_voter_t *voter, const keel_voter_sample_t sample[],
                                        uint32_t oldest_us)
{
    const uint32_t k = index_of(voter, &imu);
    const bool taken = nondet_bool();

    __CPROVER_assert(keel_voter_step_unanimous_may(voter, sample, oldest_us),
                     "precondition: keel_voter_step_unanimous");
    __CPROVER_assert(voter_same(voter, &before.channel[k]) && as_asked(k, sample),
                     "IMU_002_asked: the shorter way is tried with the same");
    if (taken) {
        *voter = outcome[k];
    }
    __CPROVER_assume(keel_voter_step_unanimous_does(voter, taken));
    return taken;
}

static void any_imu_samples(keel_imu_sample_t sample[SENSORS])
{
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].age_us = nondet_u32();
        sample[i].present = nondet_bool();
        for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
            sample[i].value[k] = nondet_float();
        }
    }
}

void keel_virtual_imu_step_harness(void)
{
    const uint32_t elapsed_us = nondet_u32();
    keel_imu_sample_t sample[SENSORS];

    any_imu(&imu, nondet_u8());
    __CPROVER_assume(imu_valid_here(&imu));
    any_imu_samples(sample);
    before = imu;
    model = imu;
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        any_channel(&outcome[k], imu.channel[0].config.sensors);
        outcome[k].config = imu.channel[k].config;
        outcome[k].none = imu.channel[k].none;
    }
    model_virtual_imu_step(&model, sample, elapsed_us);

    keel_virtual_imu_step(&imu, sample, elapsed_us);

    __CPROVER_assert(virtual_imu_same(&imu, &model), "IMU_003_model: as the model says");
    __CPROVER_assert(imu_valid_here(&imu), "IMU_002_valid: each channel stays valid");
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        __CPROVER_assert(imu.channel[k].config.sensors == before.channel[0].config.sensors,
                         "sensors_stay: no vote changes another channel's configuration");
    }
}
