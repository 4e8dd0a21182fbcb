/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/voter.h. Expected values are worked out by hand: a = 1, n = 3, so
 * an agreement is (3 - d) / 2 between the distances 1 and 3. */
#include "keel/internal/middleware/voter.h"
#include "unity.h"

#include <math.h>
#include <string.h>

static keel_voter_config_t config;
static keel_voter_t voter;

void setUp(void)
{
    const keel_voter_config_t usual = {.agree = 1.0f,
                                       .cutoff = 3.0f,
                                       .lowest = -100.0f,
                                       .highest = 100.0f,
                                       .initial = 7.0f,
                                       .max_age_us = 1000u,
                                       .latch_count = 3u,
                                       .stale_count = 0u,
                                       .density_limit = 0u,
                                       .sensors = 3u};

    config = usual;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_init(&voter, &config));
}

void tearDown(void)
{
}

static void restart(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_init(&voter, &config));
}

static void vote4(float a, float b, float c, float d)
{
    const keel_voter_sample_t sample[4] = {
        {a, 0u, true}, {b, 0u, true}, {c, 0u, true}, {d, 0u, true}};

    keel_voter_step(&voter, sample, 10u);
}

static void vote(float a, float b, float c)
{
    vote4(a, b, c, 0.0f);
}

static void expect(uint8_t state, float output)
{
    TEST_ASSERT_EQUAL_UINT8(state, voter.vote.state);
    TEST_ASSERT_EQUAL_FLOAT(output, voter.vote.output);
}

static void expect_reasons(uint8_t a, uint8_t b, uint8_t c)
{
    TEST_ASSERT_EQUAL_UINT8(a, voter.vote.reason[0]);
    TEST_ASSERT_EQUAL_UINT8(b, voter.vote.reason[1]);
    TEST_ASSERT_EQUAL_UINT8(c, voter.vote.reason[2]);
}

static void expect_weights(float a, float b, float c)
{
    TEST_ASSERT_EQUAL_FLOAT(a, voter.vote.weight[0]);
    TEST_ASSERT_EQUAL_FLOAT(b, voter.vote.weight[1]);
    TEST_ASSERT_EQUAL_FLOAT(c, voter.vote.weight[2]);
}

static void refuses(keel_status_t why)
{
    keel_voter_t before;

    memcpy(&before, &voter, sizeof before);
    TEST_ASSERT_EQUAL(why, keel_voter_check(&config));
    TEST_ASSERT_EQUAL(why, keel_voter_init(&voter, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &voter, sizeof voter);
}

static void VOT_001_number_of_sensors(void)
{
    config.sensors = 1u;
    refuses(KEEL_ERR_SENSORS);
    config.sensors = 5u;
    refuses(KEEL_ERR_SENSORS);
    config.sensors = 2u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_check(&config));
    config.sensors = 4u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_check(&config));
}

static void VOT_001_distance_of_agreement(void)
{
    config.agree = 0.0f;
    refuses(KEEL_ERR_AGREEMENT);
    config.agree = NAN;
    refuses(KEEL_ERR_AGREEMENT);
    config.agree = 1000.5f;
    refuses(KEEL_ERR_AGREEMENT);
    config.agree = 0x1.fffffep-11f; /* the last number before 2^-10 */
    refuses(KEEL_ERR_AGREEMENT);
    config.agree = 0x1p-10f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_check(&config));
    config.agree = 1000.0f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_check(&config));
}

static void VOT_001_cutoff(void)
{
    config.cutoff = 1.0f;
    refuses(KEEL_ERR_CUTOFF);
    config.cutoff = INFINITY;
    refuses(KEEL_ERR_CUTOFF);
    config.cutoff = NAN;
    refuses(KEEL_ERR_CUTOFF);
    config.cutoff = 0.5f;
    refuses(KEEL_ERR_CUTOFF);
    config.cutoff = 1000001.0f; /* n a beyond the range */
    refuses(KEEL_ERR_CUTOFF);
    config.cutoff = 1000000.0f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_check(&config));
}

static void VOT_001_limits(void)
{
    config.lowest = 101.0f;
    refuses(KEEL_ERR_LIMITS);
    config.lowest = -INFINITY;
    refuses(KEEL_ERR_LIMITS);
    config.lowest = 1000001.0f;
    refuses(KEEL_ERR_LIMITS);
    config.lowest = -100.0f;
    config.highest = 1000001.0f;
    refuses(KEEL_ERR_LIMITS);
}

static void VOT_001_initial_age_and_latch(void)
{
    config.initial = 100.5f;
    refuses(KEEL_ERR_INITIAL);
    config.initial = -100.5f;
    refuses(KEEL_ERR_INITIAL);
    config.initial = 0.0f;
    config.max_age_us = 0u;
    refuses(KEEL_ERR_AGE);
    config.max_age_us = 1u;
    config.latch_count = 0u;
    refuses(KEEL_ERR_LATCH);
}

static void VOT_002_starts_with_the_initial_output(void)
{
    TEST_ASSERT_EQUAL_FLOAT(7.0f, voter.vote.output);
    TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_NONE, voter.vote.state);
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        TEST_ASSERT_FALSE(voter.sensor[i].latched);
        TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[i].condemned_votes);
    }
}

static void VOT_003_agreement(void)
{
    TEST_ASSERT_EQUAL_FLOAT(1.0f, keel_voter_agreement(2.0f, 2.0f, 1.0f, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, keel_voter_agreement(2.0f, 3.0f, 1.0f, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.75f, keel_voter_agreement(-0.5f, 1.0f, 1.0f, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.25f, keel_voter_agreement(2.0f, -0.5f, 1.0f, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, keel_voter_agreement(0.0f, 3.0f, 1.0f, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, keel_voter_agreement(-1.0e6f, 1.0e6f, 1.0f, 3.0f));
}

static void VOT_004_agreement_never_exceeds_one(void)
{
    /* One step above a: eq. 16 as it stands gives more than 1 for many a and n. */
    for (float a = 0.1f; a < 10.0f; a *= 1.01f) {
        const float s = keel_voter_agreement(0.0f, a + (a * 0x1p-23f), a, 1.7f * a);

        TEST_ASSERT_TRUE((s <= 1.0f) && (s > 0.99f));
    }
}

static void VOT_005_mean_of_three(void)
{
    vote(1.0f, 1.5f, 2.0f); /* All within a: the plain mean. */
    expect(KEEL_VOTER_MEAN, 1.5f);
    expect_weights(1.0f, 1.0f, 1.0f);
    /* d = 0, 2, 2: weights 3/4, 3/4, 1/2; mean (0 + 0 + 2 * 1/2) / 2. */
    vote(0.0f, 0.0f, 2.0f);
    expect(KEEL_VOTER_MEAN, 0.5f);
    expect_weights(0.75f, 0.75f, 0.5f);
}

static void VOT_005_mean_of_equal_samples_is_their_value(void)
{
    vote(0.1f, 0.1f, 0.1f);
    TEST_ASSERT_TRUE(voter.vote.output == 0.1f);
}

static void VOT_005_mean_is_clamped_to_its_samples(void)
{
    TEST_ASSERT_EQUAL_FLOAT(2.0f, keel_voter_mean(6.0f, 3.0f, 1.0f, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(2.5f, keel_voter_mean(6.0f, 3.0f, 2.5f, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(1.5f, keel_voter_mean(6.0f, 3.0f, 1.0f, 1.5f));
}

/* Just within a of each other, and just not: the weights tell. */
static void VOT_006_all_agree_up_to_a(void)
{
    vote(0.0f, 0.5f, 1.0f);
    expect(KEEL_VOTER_MEAN, 0.5f);
    expect_weights(1.0f, 1.0f, 1.0f);
    vote(0.0f, 0.5f, 1.25f); /* d = 1.25: agreement 7/8, weight (1 + 7/8)/2. */
    expect_weights(0.9375f, 1.0f, 0.9375f);
}

static void VOT_006_counts_what_contributes(void)
{
    TEST_ASSERT_EQUAL_UINT8(0u, voter.vote.contributing);
    vote(1.0f, 1.5f, 2.0f);
    TEST_ASSERT_EQUAL_UINT8(3u, voter.vote.contributing);
    vote(1.0f, 1.5f, 50.0f);
    TEST_ASSERT_EQUAL_UINT8(2u, voter.vote.contributing);
    vote(1.0f, 20.0f, 50.0f); /* The median alone. */
    TEST_ASSERT_EQUAL_UINT8(1u, voter.vote.contributing);
    vote(1.0f, 20.0f, NAN);
    TEST_ASSERT_EQUAL_UINT8(0u, voter.vote.contributing);
}

static void VOT_006_weights_of_two_and_four(void)
{
    config.sensors = 2u;
    restart();
    vote(0.0f, 2.0f, 0.0f); /* One agreement of 1/2. */
    expect(KEEL_VOTER_MEAN, 1.0f);
    expect_weights(0.5f, 0.5f, 0.0f);
    config.sensors = 4u;
    restart();
    vote4(0.0f, 0.0f, 0.0f, 9.0f);
    expect(KEEL_VOTER_MEAN, 0.0f);
    expect_weights(2.0f / 3.0f, 2.0f / 3.0f, 2.0f / 3.0f);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, voter.vote.weight[3]);
    TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_OUTVOTED, voter.vote.reason[3]);
}

static void VOT_006_a_weight_is_the_mean_of_agreements(void)
{
    const float agreement[3] = {1.0f, 0.5f, 0.0f};
    const float none[2] = {0.0f, 0.0f};

    TEST_ASSERT_EQUAL_FLOAT(1.0f, keel_voter_weight(agreement, 1u));
    TEST_ASSERT_EQUAL_FLOAT(0.75f, keel_voter_weight(agreement, 2u));
    TEST_ASSERT_EQUAL_FLOAT(0.5f, keel_voter_weight(agreement, 3u));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, keel_voter_weight(none, 2u));
}

static void VOT_007_not_finite(void)
{
    vote(NAN, 1.0f, 2.0f);
    expect_reasons(KEEL_VOTER_NOT_FINITE, KEEL_VOTER_USED, KEEL_VOTER_USED);
    expect(KEEL_VOTER_MEAN, 1.5f);
    vote(1.0f, INFINITY, 2.0f);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_NOT_FINITE, KEEL_VOTER_USED);
    vote(1.0f, 2.0f, -INFINITY);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_NOT_FINITE);
    expect(KEEL_VOTER_MEAN, 1.5f);
}

static void VOT_007_implausible(void)
{
    vote(100.5f, 99.0f, 100.0f);
    expect_reasons(KEEL_VOTER_OUT_OF_RANGE, KEEL_VOTER_USED, KEEL_VOTER_USED);
    expect(KEEL_VOTER_MEAN, 99.5f);
    vote(-99.0f, -100.0f, -100.5f);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_OUT_OF_RANGE);
}

static void VOT_007_missing_and_late(void)
{
    keel_voter_sample_t sample[3] = {{1.0f, 1001u, true}, {NAN, 9u, false}, {2.0f, 1000u, true}};

    keel_voter_step(&voter, sample, 10u);
    expect_reasons(KEEL_VOTER_LATE, KEEL_VOTER_MISSING, KEEL_VOTER_USED);
    expect(KEEL_VOTER_SINGLE, 2.0f);
}

static void VOT_008_two_disagree(void)
{
    vote(0.0f, 4.0f, NAN);
    expect(KEEL_VOTER_DISAGREE, 7.0f);
    expect_reasons(KEEL_VOTER_OUTVOTED, KEEL_VOTER_OUTVOTED, KEEL_VOTER_NOT_FINITE);
    TEST_ASSERT_EQUAL_UINT32(1u, voter.vote.held);
    TEST_ASSERT_EQUAL_UINT32(10u, voter.vote.held_us);
    vote(NAN, NAN, NAN);
    expect(KEEL_VOTER_NONE, 7.0f);
    TEST_ASSERT_EQUAL_UINT32(2u, voter.vote.held);
    TEST_ASSERT_EQUAL_UINT32(20u, voter.vote.held_us);
    vote(1.0f, 1.0f, 1.0f);
    expect(KEEL_VOTER_MEAN, 1.0f);
    TEST_ASSERT_EQUAL_UINT32(0u, voter.vote.held);
    TEST_ASSERT_EQUAL_UINT32(0u, voter.vote.held_us);
}

static void VOT_008_counts_saturate(void)
{
    voter.vote.held = UINT32_MAX;
    voter.vote.held_us = UINT32_MAX - 9u;
    vote(0.0f, 4.0f, NAN);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, voter.vote.held);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, voter.vote.held_us);
}

static void VOT_009_one_left(void)
{
    vote(NAN, 200.0f, 3.0f);
    expect(KEEL_VOTER_SINGLE, 3.0f);
    expect_weights(0.0f, 0.0f, 1.0f);
}

static void VOT_010_two_that_disagree_are_not_condemned(void)
{
    for (uint32_t i = 0u; i < 9u; i++) {
        vote(0.0f, 4.0f, NAN);
        expect(KEEL_VOTER_DISAGREE, 7.0f);
    }
    TEST_ASSERT_EQUAL_UINT32(9u, voter.vote.held);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[0].condemned_votes);
    TEST_ASSERT_FALSE(voter.sensor[0].latched);
    TEST_ASSERT_FALSE(voter.sensor[1].latched);
    TEST_ASSERT_TRUE(voter.sensor[2].latched);
}

static void VOT_010_one_agreement_clears(void)
{
    vote(0.0f, 0.0f, 9.0f);
    vote(0.0f, 0.0f, 9.0f);
    TEST_ASSERT_EQUAL_UINT16(2u, voter.sensor[2].condemned_votes);
    vote(0.0f, 0.0f, 2.5f);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[2].condemned_votes);
    TEST_ASSERT_FALSE(voter.sensor[2].latched);
}

static void VOT_011_latched_exactly_at_the_count(void)
{
    vote(0.0f, 0.0f, 9.0f);
    vote(0.0f, 0.0f, 9.0f);
    TEST_ASSERT_FALSE(voter.sensor[2].latched);
    vote(0.0f, 0.0f, 9.0f);
    TEST_ASSERT_TRUE(voter.sensor[2].latched);
    TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_OUTVOTED, voter.vote.reason[2]);
    vote(0.0f, 1.0f, 0.5f); /* It agrees again, but is out. */
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_LATCHED);
    expect(KEEL_VOTER_MEAN, 0.5f);
    TEST_ASSERT_EQUAL_UINT16(3u, voter.sensor[2].condemned_votes);
}

/* Silence of all, or nonsense of all, says of none that it is broken. */
static void VOT_010_silence_of_all_condemns_nobody(void)
{
    const keel_voter_sample_t silent[3] = {{0.0f, 0u, false}};

    for (uint32_t i = 0u; i < 9u; i++) {
        keel_voter_step(&voter, silent, 10u);
        vote(NAN, INFINITY, 101.0f);
    }
    expect(KEEL_VOTER_NONE, 7.0f);
    for (uint32_t i = 0u; i < 3u; i++) {
        TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[i].condemned_votes);
        TEST_ASSERT_FALSE(voter.sensor[i].latched);
    }
    vote(1.0f, 1.5f, 2.0f);
    expect(KEEL_VOTER_MEAN, 1.5f);
}

static void VOT_012_density_finds_what_agrees_now_and_then(void)
{
    config.density_limit = 4u;
    restart();
    for (uint32_t i = 0u; i < 3u; i++) { /* Two bad, one good: the leaky count rises by one. */
        vote(0.0f, 0.0f, 9.0f);
        vote(0.0f, 0.0f, 9.0f);
        TEST_ASSERT_EQUAL(i == 2u, voter.sensor[2].latched);
        vote(0.0f, 0.0f, 0.0f);
    }
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[0].density);
}

static void VOT_012_density_is_off_by_default(void)
{
    voter.sensor[2].density = UINT16_MAX;
    vote(0.0f, 0.0f, 9.0f);
    TEST_ASSERT_FALSE(voter.sensor[2].latched);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, voter.sensor[2].density);
    config.latch_count = 1u;
    restart();
    voter.sensor[2].density = UINT16_MAX;
    vote(0.0f, 0.0f, 9.0f); /* The consecutive votes still count. */
    TEST_ASSERT_TRUE(voter.sensor[2].latched);
}

static void VOT_013_frozen_while_others_move(void)
{
    config.stale_count = 2u;
    restart();
    vote(0.0f, 0.0f, 0.5f);
    vote(0.1f, 0.2f, 0.5f);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_USED);
    TEST_ASSERT_EQUAL_UINT16(1u, voter.sensor[2].unchanged_votes);
    vote(0.1f, 0.3f, 0.5f); /* The first does not move either, for the first time. */
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_STALE);
    vote(0.3f, 0.5f, 0.6f); /* It moves again. */
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_USED);
}

static void VOT_013_the_first_may_be_frozen(void)
{
    config.stale_count = 1u;
    restart();
    vote(0.5f, 0.0f, 0.0f);
    vote(0.5f, 0.1f, 0.2f);
    expect_reasons(KEEL_VOTER_STALE, KEEL_VOTER_USED, KEEL_VOTER_USED);
}

static void VOT_013_count_saturates(void)
{
    vote(0.5f, 0.0f, 0.0f);
    voter.sensor[0].unchanged_votes = UINT16_MAX;
    vote(0.5f, 0.1f, 0.2f);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, voter.sensor[0].unchanged_votes);
    voter.config.stale_count = UINT16_MAX;
    vote(0.5f, 0.2f, 0.3f);
    expect_reasons(KEEL_VOTER_STALE, KEEL_VOTER_USED, KEEL_VOTER_USED);
}

/* Two of three repeat themselves: each by its own count, at its third repetition. */
static void VOT_013_two_are_frozen(void)
{
    config.stale_count = 3u;
    restart();
    vote(0.5f, 0.5f, 0.0f);
    vote(0.5f, 0.5f, 0.1f);
    vote(0.5f, 0.5f, 0.2f);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_USED);
    vote(0.5f, 0.5f, 0.3f);
    expect_reasons(KEEL_VOTER_STALE, KEEL_VOTER_STALE, KEEL_VOTER_USED);
    expect(KEEL_VOTER_SINGLE, 0.3f);
    vote(0.5f, 0.6f, 0.4f);
    expect_reasons(KEEL_VOTER_STALE, KEEL_VOTER_USED, KEEL_VOTER_USED);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[1].unchanged_votes);
}

/* The output is held, and nobody is condemned for it. */
static void VOT_013_all_are_frozen(void)
{
    config.stale_count = 2u;
    restart();
    vote(0.5f, 0.25f, 0.75f);
    vote(0.5f, 0.25f, 0.75f);
    expect(KEEL_VOTER_MEAN, 0.5f);
    vote(0.5f, 0.25f, 0.75f);
    expect(KEEL_VOTER_NONE, 0.5f);
    expect_reasons(KEEL_VOTER_STALE, KEEL_VOTER_STALE, KEEL_VOTER_STALE);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[0].condemned_votes);
}

static void VOT_013_by_itself(void)
{
    keel_voter_sample_t sample[3] = {{0.5f, 0u, true}, {0.0f, 0u, false}, {0.0f, 0u, false}};

    config.stale_count = 1u;
    restart();
    keel_voter_step(&voter, sample, 10u);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_MISSING, KEEL_VOTER_MISSING);
    keel_voter_step(&voter, sample, 10u);
    expect_reasons(KEEL_VOTER_STALE, KEEL_VOTER_MISSING, KEEL_VOTER_MISSING);
    sample[0].value = -0.0f;
    keel_voter_step(&voter, sample, 10u);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_MISSING, KEEL_VOTER_MISSING);
    sample[0].value = 0.0f; /* The sign of a zero is no change. */
    keel_voter_step(&voter, sample, 10u);
    expect_reasons(KEEL_VOTER_STALE, KEEL_VOTER_MISSING, KEEL_VOTER_MISSING);
}

static void VOT_013_never_without_a_count(void)
{
    for (uint32_t i = 0u; i < 9u; i++) {
        vote(0.0f, 0.0f, 0.0f);
    }
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_USED);
    TEST_ASSERT_EQUAL_UINT16(8u, voter.sensor[2].unchanged_votes); /* The first changed, from 7. */
}

static void VOT_001_slope(void)
{
    config.slope = -0.001f;
    refuses(KEEL_ERR_AGREEMENT);
    config.slope = 1.001f;
    refuses(KEEL_ERR_AGREEMENT);
    config.slope = NAN;
    refuses(KEEL_ERR_AGREEMENT);
    config.slope = 1.0f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_check(&config));
}

/* a = 1 + |output| / 4, n a three times that. */
static void VOT_019_thresholds_grow_with_the_output(void)
{
    config.slope = 0.25f;
    restart();
    TEST_ASSERT_EQUAL_FLOAT(1.0f, voter.agree);
    TEST_ASSERT_EQUAL_FLOAT(3.0f, voter.disagree);
    keel_voter_scale(&voter);
    TEST_ASSERT_EQUAL_FLOAT(2.75f, voter.agree);
    TEST_ASSERT_EQUAL_FLOAT(8.25f, voter.disagree);
    vote(-18.0f, -20.0f, -22.0f);
    keel_voter_scale(&voter);
    TEST_ASSERT_EQUAL_FLOAT(6.0f, voter.agree);
    vote(-17.0f, -20.0f, -23.0f); /* All within 6: full weights. */
    expect(KEEL_VOTER_MEAN, -20.0f);
    expect_weights(1.0f, 1.0f, 1.0f);
}

static void VOT_019_limits(void)
{
    config.slope = 1.0f;
    config.agree = 900.0f;
    config.lowest = -1.0e6f;
    config.highest = 1.0e6f;
    config.initial = -500.0f;
    restart();
    keel_voter_scale(&voter); /* 1400 is too much. */
    TEST_ASSERT_EQUAL_FLOAT(1000.0f, voter.agree);
    TEST_ASSERT_EQUAL_FLOAT(3000.0f, voter.disagree);
    config.cutoff = 1050.0f; /* n a is 945000, and would be 1050000. */
    restart();
    keel_voter_scale(&voter);
    TEST_ASSERT_EQUAL_FLOAT(900.0f, voter.agree);
    TEST_ASSERT_EQUAL_FLOAT(945000.0f, voter.disagree);
    config.slope = 0.0f;
    restart();
    keel_voter_scale(&voter);
    TEST_ASSERT_EQUAL_FLOAT(900.0f, voter.agree);
}

static void VOT_020_median_of_three(void)
{
    for (uint32_t i = 0u; i < 9u; i++) {
        vote(8.0f, 0.0f, 4.0f + (0.125f * (float)i));
        expect(KEEL_VOTER_MEDIAN, 4.0f + (0.125f * (float)i));
        expect_reasons(KEEL_VOTER_OUTVOTED, KEEL_VOTER_OUTVOTED, KEEL_VOTER_USED);
        expect_weights(0.0f, 0.0f, 1.0f);
        TEST_ASSERT_EQUAL_UINT32(0u, voter.vote.held);
    }
    for (uint32_t i = 0u; i < 3u; i++) {
        TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[i].condemned_votes);
        TEST_ASSERT_FALSE(voter.sensor[i].latched);
    }
    TEST_ASSERT_FALSE(voter.unanimous);
}

/* Of four: the mean of the middle two; of four of which one is unusable: the others' median. */
static void VOT_020_median_of_four(void)
{
    config.sensors = 4u;
    restart();
    vote4(9.0f, -50.0f, 5.0f, 80.0f);
    expect(KEEL_VOTER_MEDIAN, 7.0f);
    TEST_ASSERT_EQUAL_UINT8(2u, voter.vote.contributing);
    vote4(9.0f, -50.0f, 101.0f, 80.0f);
    expect(KEEL_VOTER_MEDIAN, 9.0f);
    TEST_ASSERT_EQUAL_UINT16(1u, voter.sensor[2].condemned_votes);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[1].condemned_votes);
}

static void latch_the_third(void)
{
    for (uint32_t i = 0u; i < 3u; i++) {
        vote(0.01f * (float)i, 0.125f * (float)i, 9.0f - (0.125f * (float)i));
    }
    TEST_ASSERT_TRUE(voter.sensor[2].latched);
}

/* A vote, and the probation of what is latched. */
static void vote_again(float a, float b, float c)
{
    const keel_voter_sample_t sample[3] = {{a, 0u, true}, {b, 0u, true}, {c, 0u, true}};

    keel_voter_step(&voter, sample, 10u);
    keel_voter_reconsider(&voter, sample);
}

/* Readmitted at the third vote in a row that speaks for it, and used in the one after. */
static void VOT_021_probation(void)
{
    config.readmit_count = 3u;
    restart();
    latch_the_third();
    vote_again(0.0f, 0.5f, 1.0f);
    vote_again(0.25f, 0.5f, 1.25f);
    TEST_ASSERT_EQUAL_UINT16(2u, voter.sensor[2].probation);
    vote_again(0.0f, 0.5f, 1.5f); /* 1.25 from the output: a new row. */
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[2].probation);
    vote_again(0.25f, 0.5f, 1.0f);
    vote_again(0.0f, 0.5f, NAN);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[2].probation);
    vote_again(0.25f, 0.5f, 1.0f);
    vote_again(0.0f, 0.5f, 1.125f);
    TEST_ASSERT_TRUE(voter.sensor[2].latched);
    vote_again(0.25f, 0.5f, 1.0f);
    TEST_ASSERT_FALSE(voter.sensor[2].latched);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_LATCHED);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[2].condemned_votes);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[2].probation);
    vote_again(0.0f, 0.5f, 1.0f);
    expect(KEEL_VOTER_MEAN, 0.5f);
    expect_reasons(KEEL_VOTER_USED, KEEL_VOTER_USED, KEEL_VOTER_USED);
}

static void VOT_021_a_latched_sensor_that_is_frozen_stays_out(void)
{
    config.readmit_count = 3u;
    config.stale_count = 2u;
    restart();
    latch_the_third();
    for (uint32_t i = 0u; i < 9u; i++) {
        vote_again(0.0f + (0.01f * (float)i), 0.5f - (0.01f * (float)i), 0.25f);
    }
    TEST_ASSERT_TRUE(voter.sensor[2].latched);
    TEST_ASSERT_EQUAL_UINT16(8u, voter.sensor[2].unchanged_votes);
}

/* A latched sensor's sample, with an output of 0. */
static void reconsider(float value, uint32_t age_us, bool present)
{
    const keel_voter_sample_t sample[3] = {
        {0.0f, 0u, true}, {0.0f, 0u, true}, {value, age_us, present}};

    keel_voter_reconsider(&voter, sample);
}

/* Each reason against it ends its row. */
static void VOT_021_what_speaks_against_it(void)
{
    const struct {
        float value;
        uint32_t age_us;
        bool present;
        uint16_t probation;
    } row[] = {{1.0f, 1000u, true, 8u}, {-1.0f, 0u, true, 8u},   {1.001f, 0u, true, 0u},
               {-1.001f, 0u, true, 0u}, {0.5f, 1001u, true, 0u}, {0.5f, 0u, false, 0u},
               {NAN, 0u, true, 0u},     {100.5f, 0u, true, 0u},  {-100.5f, 0u, true, 0u},
               {INFINITY, 0u, true, 0u}};

    for (uint32_t count = 0u; count < 10u; count += 9u) {
        config.stale_count = 4u;
        config.readmit_count = (uint16_t)count;
        restart();
        voter.vote.output = 0.0f;
        voter.vote.contributing = 2u;
        voter.sensor[2].latched = true;
        for (uint32_t i = 0u; i < (sizeof row / sizeof row[0]); i++) {
            voter.sensor[2].probation = 7u;
            reconsider(row[i].value, row[i].age_us, row[i].present);
            TEST_ASSERT_EQUAL_UINT16(row[i].probation, voter.sensor[2].probation);
            TEST_ASSERT_TRUE(voter.sensor[2].latched);
        }
        voter.sensor[2].unchanged_votes = 4u;
        reconsider(0.5f, 0u, true);
        TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[2].probation);
        voter.sensor[2].unchanged_votes = 3u;
        voter.vote.contributing = 0u;
        reconsider(50.0f, 0u, true);
        TEST_ASSERT_EQUAL_UINT16(1u, voter.sensor[2].probation);
    }
    voter.config.readmit_count = 0u;
    voter.sensor[2].probation = UINT16_MAX;
    reconsider(50.0f, 0u, true);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, voter.sensor[2].probation);
    voter.vote.contributing = 2u;
    reconsider(0.5f, 0u, true);
    reconsider(-0.5f, 0u, true);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, voter.sensor[2].probation);
    voter.config.readmit_count = UINT16_MAX;
    reconsider(0.5f, 0u, true);
    TEST_ASSERT_FALSE(voter.sensor[2].latched);
}

/* The other two fall silent: there is no output that could speak against it. */
static void VOT_021_without_an_output_what_is_usable_comes_back(void)
{
    config.readmit_count = 2u;
    restart();
    latch_the_third();
    vote_again(NAN, NAN, 9.0f);
    expect(KEEL_VOTER_NONE, 0.135f); /* (0.02 + 0.25) / 2 */
    vote_again(NAN, NAN, 9.125f);
    TEST_ASSERT_FALSE(voter.sensor[2].latched);
    vote_again(NAN, NAN, 9.0f);
    expect(KEEL_VOTER_SINGLE, 9.0f);
}

static void VOT_021_without_a_count_a_latch_stays(void)
{
    latch_the_third();
    for (uint32_t i = 0u; i < 99u; i++) {
        vote_again(0.0f, 0.5f, 0.25f + (0.001f * (float)i));
    }
    TEST_ASSERT_TRUE(voter.sensor[2].latched);
}

/* One after the other fails, but one is never latched. */
static void VOT_022_one_is_never_latched(void)
{
    for (uint32_t i = 0u; i < 9u; i++) {
        vote(NAN, NAN, 1.0f + (float)i);
    }
    TEST_ASSERT_TRUE(voter.sensor[0].latched && voter.sensor[1].latched);
    for (uint32_t i = 0u; i < 9u; i++) {
        vote(NAN, NAN, NAN);
    }
    TEST_ASSERT_FALSE(voter.sensor[2].latched);
    expect(KEEL_VOTER_NONE, 9.0f);
}

static void VOT_014_readmission_on_request(void)
{
    keel_voter_t before;

    TEST_ASSERT_EQUAL(KEEL_ERR_SENSORS, keel_voter_readmit(&voter, 3u));
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_voter_readmit(&voter, 2u));
    for (uint32_t i = 0u; i < 3u; i++) {
        vote(0.0f, 0.0f, 9.0f);
    }
    memcpy(&before, &voter, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_readmit(&voter, 2u));
    TEST_ASSERT_EQUAL_MEMORY(&before.sensor[0], &voter.sensor[0], 2u * sizeof before.sensor[0]);
    vote(0.0f, 0.5f, 1.0f);
    expect(KEEL_VOTER_MEAN, 0.5f);
    TEST_ASSERT_EQUAL_UINT16(0u, voter.sensor[2].condemned_votes);
}

static bool unanimous(float a, float b, float c, uint32_t oldest_us)
{
    const keel_voter_sample_t sample[3] = {{a, 0u, true}, {b, 0u, true}, {c, 0u, true}};

    return keel_voter_step_unanimous(&voter, sample, oldest_us);
}

static void is_refused(float a, float b, float c, uint32_t oldest_us)
{
    keel_voter_t before;

    memcpy(&before, &voter, sizeof before);
    TEST_ASSERT_FALSE(unanimous(a, b, c, oldest_us));
    TEST_ASSERT_EQUAL_MEMORY(&before, &voter, sizeof voter);
}

static void VOT_018_within_a_of_each_other(void)
{
    TEST_ASSERT_TRUE(keel_voter_within(-0.5f, 0.5f, 1.0f));
    TEST_ASSERT_FALSE(keel_voter_within(0.0f, nextafterf(1.0f, 2.0f), 1.0f));
}

static void VOT_018_mean_of_samples_of_full_weight(void)
{
    const keel_voter_sample_t sample[3] = {{1.0f, 0u, true}, {1.5f, 0u, true}, {3.5f, 0u, true}};
    const keel_voter_sample_t equal[2] = {{1.5f, 0u, true}, {1.5f, 0u, true}};

    TEST_ASSERT_EQUAL_FLOAT(1.25f, keel_voter_plain_mean(sample, 2u, 1.0f, 1.5f));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, keel_voter_plain_mean(sample, 3u, 1.0f, 3.5f));
    TEST_ASSERT_EQUAL_FLOAT(1.5f, keel_voter_plain_mean(&equal[0], 2u, 1.5f, 1.5f));
}

static void VOT_018_unanimous(void)
{
    is_refused(1.0f, 1.5f, 2.0f, 0u); /* There was no vote before. */
    vote(1.0f, 1.5f, 2.0f);
    TEST_ASSERT_TRUE(unanimous(2.0f, 1.75f, 2.25f, 1000u));
    expect(KEEL_VOTER_MEAN, 2.0f);
    expect_weights(1.0f, 1.0f, 1.0f);
    is_refused(2.0f, 1.75f, 2.25f, 0u);                /* All at rest: that is counted. */
    TEST_ASSERT_TRUE(unanimous(3.0f, 2.0f, 2.5f, 0u)); /* Just within a. */
    expect(KEEL_VOTER_MEAN, 2.5f);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, voter.sensor[1].last);
    TEST_ASSERT_TRUE(unanimous(4.0f, 4.0f, 4.0f, 0u)); /* All the same. */
    expect(KEEL_VOTER_MEAN, 4.0f);
}

static void VOT_018_leaves_the_others(void)
{
    vote(1.0f, 1.5f, 2.0f);
    is_refused(2.0f, 1.75f, 2.25f, 1001u); /* late */
    is_refused(1.0f, 1.75f, 2.25f, 0u);    /* The first rests alone, */
    is_refused(1.25f, 1.5f, 2.25f, 0u);    /* the second, */
    is_refused(1.0f, 1.5f, 2.25f, 0u);     /* all but the last. */
    is_refused(2.0f, 1.75f, 3.0f, 0u);     /* Just beyond a. */
    is_refused(NAN, 1.75f, 2.25f, 0u);     /* not finite */
    is_refused(2.0f, NAN, 2.25f, 0u);
    is_refused(2.0f, 1.75f, INFINITY, 0u);
    is_refused(-100.25f, -100.5f, -100.25f, 0u); /* implausible */
    is_refused(-99.75f, -100.5f, -99.75f, 0u);
    is_refused(100.25f, 100.5f, 100.25f, 0u);
}

/* A weight of 15/16, an old count, a leaky one: the vote that follows is a whole one. */
static void VOT_018_not_after_a_doubt(void)
{
    vote(0.0f, 0.5f, 1.25f);
    is_refused(1.0f, 1.5f, 2.0f, 0u);
    vote(1.0f, 1.5f, 9.0f);
    is_refused(1.0f, 1.5f, 2.0f, 0u);
    vote(0.0f, 0.5f, 1.0f); /* It agrees again: the leaky count is 0. */
    TEST_ASSERT_TRUE(unanimous(1.0f, 1.5f, 2.0f, 0u));
    vote(1.0f, 1.5f, 9.0f);
    vote(0.5f, 1.0f, 9.0f);
    vote(0.0f, 0.5f, 1.0f); /* The leaky count is 1. */
    is_refused(1.0f, 1.5f, 2.0f, 0u);
    restart();
    voter.sensor[0].density = 3u; /* Of the first sensor. */
    vote(1.0f, 1.5f, 2.0f);
    is_refused(1.25f, 1.75f, 2.25f, 0u);
    restart();
    vote(1.0f, 1.5f, 2.0f);
    vote(1.25f, 1.5f, 2.25f); /* The second rests alone. */
    is_refused(1.0f, 1.25f, 2.0f, 0u);
}

static void VOT_015_influence_of_one_faulty_sensor(void)
{
    /* The worst case for n = 3: the healthy two at 0, the third at 2 a moves them by a / 2. */
    float worst = 0.0f;

    for (int32_t i = -400; i <= 400; i++) {
        restart();
        vote(0.0f, 0.0f, (float)i * 0.0125f);
        worst = (fabsf(voter.vote.output) > worst) ? fabsf(voter.vote.output) : worst;
    }
    TEST_ASSERT_EQUAL_FLOAT(0.5f, worst);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(VOT_001_number_of_sensors);
    RUN_TEST(VOT_001_distance_of_agreement);
    RUN_TEST(VOT_001_cutoff);
    RUN_TEST(VOT_001_limits);
    RUN_TEST(VOT_001_initial_age_and_latch);
    RUN_TEST(VOT_002_starts_with_the_initial_output);
    RUN_TEST(VOT_003_agreement);
    RUN_TEST(VOT_004_agreement_never_exceeds_one);
    RUN_TEST(VOT_005_mean_of_three);
    RUN_TEST(VOT_005_mean_of_equal_samples_is_their_value);
    RUN_TEST(VOT_005_mean_is_clamped_to_its_samples);
    RUN_TEST(VOT_006_all_agree_up_to_a);
    RUN_TEST(VOT_006_counts_what_contributes);
    RUN_TEST(VOT_006_weights_of_two_and_four);
    RUN_TEST(VOT_006_a_weight_is_the_mean_of_agreements);
    RUN_TEST(VOT_007_not_finite);
    RUN_TEST(VOT_007_implausible);
    RUN_TEST(VOT_007_missing_and_late);
    RUN_TEST(VOT_008_two_disagree);
    RUN_TEST(VOT_008_counts_saturate);
    RUN_TEST(VOT_009_one_left);
    RUN_TEST(VOT_010_two_that_disagree_are_not_condemned);
    RUN_TEST(VOT_010_one_agreement_clears);
    RUN_TEST(VOT_011_latched_exactly_at_the_count);
    RUN_TEST(VOT_010_silence_of_all_condemns_nobody);
    RUN_TEST(VOT_012_density_finds_what_agrees_now_and_then);
    RUN_TEST(VOT_012_density_is_off_by_default);
    RUN_TEST(VOT_013_frozen_while_others_move);
    RUN_TEST(VOT_013_the_first_may_be_frozen);
    RUN_TEST(VOT_013_count_saturates);
    RUN_TEST(VOT_013_by_itself);
    RUN_TEST(VOT_013_never_without_a_count);
    RUN_TEST(VOT_013_two_are_frozen);
    RUN_TEST(VOT_013_all_are_frozen);
    RUN_TEST(VOT_001_slope);
    RUN_TEST(VOT_019_thresholds_grow_with_the_output);
    RUN_TEST(VOT_019_limits);
    RUN_TEST(VOT_020_median_of_three);
    RUN_TEST(VOT_020_median_of_four);
    RUN_TEST(VOT_021_probation);
    RUN_TEST(VOT_021_what_speaks_against_it);
    RUN_TEST(VOT_021_a_latched_sensor_that_is_frozen_stays_out);
    RUN_TEST(VOT_021_without_an_output_what_is_usable_comes_back);
    RUN_TEST(VOT_021_without_a_count_a_latch_stays);
    RUN_TEST(VOT_022_one_is_never_latched);
    RUN_TEST(VOT_014_readmission_on_request);
    RUN_TEST(VOT_015_influence_of_one_faulty_sensor);
    RUN_TEST(VOT_018_within_a_of_each_other);
    RUN_TEST(VOT_018_mean_of_samples_of_full_weight);
    RUN_TEST(VOT_018_unanimous);
    RUN_TEST(VOT_018_leaves_the_others);
    RUN_TEST(VOT_018_not_after_a_doubt);
    return UNITY_END();
}
