// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5
// checks: assertions
// sources: src/middleware/voter.c
// replaces: keel_voter_agreement keel_voter_weight keel_voter_combine
// covers: keel_voter_step
//
// As keel_voter_step_harness.c, every valid channel of 2 to 4 sensors and every bit pattern of the
// samples: the contract of a vote, clause by clause; and that it leaves probation alone, which the
// virtual unit's stand-in for a vote (proofs/virtual_imu/any_vote.h) does.
#include "voter_stand_ins.h"

static keel_voter_t old;
static keel_voter_t now;
static keel_voter_sample_t sample[SENSORS];

static uint32_t least_of(uint32_t a, uint32_t b)
{
    return (a < b) ? a : b;
}

/* Whether the vote took the sample of a sensor of the channel so. */
static bool was(uint32_t i, uint32_t reason)
{
    return (i < now.config.sensors) && (now.vote.reason[i] == reason);
}

static bool has_output(void)
{
    return now.vote.state < KEEL_VOTER_DISAGREE;
}

static void check_output(void)
{
    bool above = false;
    bool below = false;
    bool equal = false;
    uint32_t used = 0u;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if (was(i, KEEL_VOTER_USED)) {
            used++;
            above = above || (sample[i].value <= now.vote.output);
            below = below || (now.vote.output <= sample[i].value);
            equal = equal || (now.vote.output == sample[i].value);
        }
    }
    __CPROVER_assert(!has_output() || (above && below),
                     "VOT_005_hull: the output lies among the samples that contributed");
    __CPROVER_assert(now.vote.contributing == used,
                     "VOT_006_contributing: those that contributed are counted");
    __CPROVER_assert((now.vote.state != KEEL_VOTER_SINGLE) || equal,
                     "VOT_009_single: what one sensor alone says is the output");
}

static void check_hold(uint32_t elapsed_us)
{
    const uint64_t sum = (uint64_t)old.vote.held_us + elapsed_us;
    const uint32_t held_us = (sum < UINT32_MAX) ? (uint32_t)sum : UINT32_MAX;
    const uint32_t held = (old.vote.held < UINT32_MAX) ? (old.vote.held + 1u) : UINT32_MAX;

    __CPROVER_assert(has_output() || (now.vote.output == old.vote.output),
                     "VOT_008_hold: a vote without an output holds the last");
    __CPROVER_assert(now.vote.held == (has_output() ? 0u : held),
                     "VOT_008_held: such votes are counted");
    __CPROVER_assert(now.vote.held_us == (has_output() ? 0u : held_us),
                     "VOT_008_held_us: their time is summed");
}

static void check_sample(uint32_t i)
{
    const bool latched = old.sensor[i].latched;
    const bool finite = finite_here(sample[i].value);
    const uint32_t reason = now.vote.reason[i];

    __CPROVER_assert((now.vote.weight[i] >= 0.0f) && (now.vote.weight[i] <= 1.0f),
                     "VOT_006_weights: a weight lies in [0, 1]");
    __CPROVER_assert((now.vote.weight[i] > 0.0f) == (reason == KEEL_VOTER_USED),
                     "VOT_006_reason: what has a weight contributed");
    __CPROVER_assert(latched == (reason == KEEL_VOTER_LATCHED),
                     "VOT_007_latched: a latched sensor takes no part");
    __CPROVER_assert((reason == KEEL_VOTER_MISSING) == (!latched && !sample[i].present),
                     "VOT_007_missing: nor does one that gave nothing");
    __CPROVER_assert((reason == KEEL_VOTER_NOT_FINITE) ==
                         (!latched && sample[i].present && !finite),
                     "VOT_007_finite: nor one that gave no number");
    __CPROVER_assert(((reason > KEEL_VOTER_OUTVOTED) && (reason != KEEL_VOTER_STALE)) ||
                         (sample[i].present && finite && (now.config.lowest <= sample[i].value) &&
                          (sample[i].value <= now.config.highest) &&
                          (sample[i].age_us <= now.config.max_age_us)),
                     "VOT_007_usable: what takes part is plausible, and not late");
}

static void check_counts(uint32_t i)
{
    const keel_voter_sensor_t *const before = &old.sensor[i];
    const keel_voter_sensor_t *const after = &now.sensor[i];
    const uint32_t reason = now.vote.reason[i];
    const bool none = now.vote.state == KEEL_VOTER_NONE;
    const bool median = now.vote.state == KEEL_VOTER_MEDIAN;

    __CPROVER_assert(before->latched || (after->condemned_votes == 0u) ||
                         (after->condemned_votes == before->condemned_votes) ||
                         (after->condemned_votes == (before->condemned_votes + 1u)),
                     "VOT_010_count: a vote counts once, or not, or clears the count");
    __CPROVER_assert((reason < KEEL_VOTER_MISSING) || none ||
                         (after->condemned_votes ==
                          least_of(before->condemned_votes + 1u, UINT16_MAX)),
                     "VOT_010_condemned: a sample that is unusable counts");
    __CPROVER_assert(before->latched || !none ||
                         (after->condemned_votes == before->condemned_votes),
                     "VOT_010_nobody: where nothing is usable nobody is condemned");
    __CPROVER_assert((reason != KEEL_VOTER_USED) || (after->condemned_votes == 0u),
                     "VOT_010_clear: to contribute clears the count");
    __CPROVER_assert((reason != KEEL_VOTER_USED) ||
                         (after->density == ((before->density > 0u) ? (before->density - 1u) : 0u)),
                     "VOT_012_density: to contribute takes one off");
    __CPROVER_assert(!median || (reason != KEEL_VOTER_OUTVOTED) ||
                         (after->condemned_votes == before->condemned_votes),
                     "VOT_020_nobody: a median condemns none that is outvoted");
    __CPROVER_assert(before->latched ||
                         (after->latched == ((after->condemned_votes >= now.config.latch_count) ||
                                             ((now.config.density_limit > 0u) &&
                                              (after->density >= now.config.density_limit)))),
                     "VOT_011_latch: latched at the one count or the other");
}

static void check_repeats(uint32_t i)
{
    const uint32_t before = old.sensor[i].unchanged_votes;
    const uint32_t after = now.sensor[i].unchanged_votes;
    const uint32_t reason = now.vote.reason[i];
    const uint32_t stale = now.config.stale_count;
    const bool changed = sample[i].value != old.sensor[i].last;

    __CPROVER_assert((reason != KEEL_VOTER_STALE) || ((0u < stale) && (stale <= after)),
                     "VOT_013_stale: a stale sensor has repeated itself so often");
    __CPROVER_assert((reason != KEEL_VOTER_USED) || (stale == 0u) || (after < stale),
                     "VOT_013_by_itself: one that contributes has not");
    __CPROVER_assert((reason != KEEL_VOTER_USED) ||
                         ((now.sensor[i].last == sample[i].value) &&
                          (after == (changed ? 0u : least_of(before + 1u, UINT16_MAX)))),
                     "VOT_013_count: its sample is kept, its repetitions are counted");
}

static void check_middle(uint32_t i)
{
    const bool median = now.vote.state == KEEL_VOTER_MEDIAN;
    bool lower = false;
    bool higher = false;

    for (uint32_t j = 0u; j < SENSORS; j++) {
        const bool outvoted = was(j, KEEL_VOTER_OUTVOTED);

        lower = lower || (outvoted && (sample[j].value < sample[i].value));
        higher = higher || (outvoted && (sample[i].value < sample[j].value));
    }
    __CPROVER_assert(!median || ((1u <= now.vote.contributing) && (now.vote.contributing <= 2u)),
                     "VOT_020_middle: a median is of one sample or two");
    __CPROVER_assert(!median || (now.vote.reason[i] != KEEL_VOTER_USED) || (lower && higher),
                     "VOT_020_middle: one that is outvoted lies below, and one above");
}

void keel_voter_step__clauses_harness(void)
{
    const uint32_t elapsed_us = nondet_u32();

    any_voter(&now, nondet_float(), nondet_float());
    __CPROVER_assume(keel_voter_step_may(&now));
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].value = nondet_float();
        sample[i].age_us = nondet_u32();
        sample[i].present = nondet_bool();
    }
    old = now;

    keel_voter_step(&now, sample, elapsed_us);

    check_output();
    check_hold(elapsed_us);
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(!old.sensor[i].latched || now.sensor[i].latched,
                         "VOT_011_stays: what is latched stays so");
        __CPROVER_assert(now.sensor[i].probation == old.sensor[i].probation,
                         "VOT_021_elsewhere: a vote leaves probation as it is");
        if (i < now.config.sensors) {
            check_sample(i);
            check_counts(i);
            check_repeats(i);
            check_middle(i);
        }
    }
}
