/* SPDX-License-Identifier: Apache-2.0 */
/* What one faulty sensor of three can do to the output (keel/middleware/voter.h, VOT-015), and the
 * condition under which that is bounded. a = 1, n = 3, so c(n) = 1/2. */
#include "keel/middleware/voter.h"
#include "unity.h"

static keel_voter_t voter;

void setUp(void)
{
}

void tearDown(void)
{
}

/* The output of a first vote. */
static float voted(float one, float other, float faulty)
{
    const keel_voter_config_t config = {.agree = 1.0f,
                                        .cutoff = 3.0f,
                                        .lowest = -100.0f,
                                        .highest = 100.0f,
                                        .initial = 7.0f,
                                        .max_age_us = 1000u,
                                        .latch_count = 3u,
                                        .sensors = 3u};
    const keel_voter_sample_t sample[3] = {{one, 0u, true}, {other, 0u, true}, {faulty, 0u, true}};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_init(&voter, &config));
    keel_voter_step(&voter, sample, 10u);
    return voter.vote.output;
}

/* How far the worst third takes the output beyond the upper one of two healthy samples. */
static float worst_excess(float distance)
{
    float worst = 0.0f;

    for (int32_t i = 0; i <= 800; i++) {
        const float excess = voted(0.0f, distance, (float)i / 128.0f) - distance;

        worst = (excess > worst) ? excess : worst;
    }
    return worst;
}

static void VOT_015_bounded_while_the_healthy_two_are_within_a(void)
{
    for (int32_t i = 0; i <= 16; i++) {
        TEST_ASSERT_TRUE(worst_excess((float)i / 16.0f) <= 0.50001f);
    }
    TEST_ASSERT_EQUAL_FLOAT(0.5f, worst_excess(0.0f));
}

static void VOT_015_not_bounded_when_they_are_farther_apart(void)
{
    /* Agreements 1/16 of the healthy two, 7/16 of the upper one with the third: weights 1/32, 1/4
     * and 7/32, so the mean is 2 (2.875 / 4 + 35 / 32) = 3.625, 3/4 beyond the upper one. */
    TEST_ASSERT_EQUAL_FLOAT(3.625f, voted(0.0f, 2.875f, 5.0f));
    TEST_ASSERT_TRUE(worst_excess(2.875f) >= 0.75f);
    /* From n a on the healthy two do not agree at all; the third takes one of them with it. */
    TEST_ASSERT_EQUAL_FLOAT(4.0f, voted(0.0f, 3.0f, 5.0f));
}

static void VOT_015_a_third_between_them_leaves_no_hull(void)
{
    for (int32_t i = 0; i <= 16; i++) {
        const float output = voted(0.0f, 1.0f, (float)i / 16.0f);

        TEST_ASSERT_TRUE((output >= 0.0f) && (output <= 1.0f));
    }
}

/* A channel whose a grows by a quarter of the output's magnitude. Nobody is ever latched. */
static void begin_growing(float initial)
{
    const keel_voter_config_t config = {.agree = 1.0f,
                                        .cutoff = 3.0f,
                                        .slope = 0.25f,
                                        .lowest = -1000.0f,
                                        .highest = 1000.0f,
                                        .initial = initial,
                                        .max_age_us = 1000u,
                                        .latch_count = 65535u,
                                        .sensors = 3u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_voter_init(&voter, &config));
}

/* The next vote on two samples of 10 and a third where it takes the output farthest. Its output
 * before is what a grows with. */
static void vote_worst(void)
{
    const keel_voter_t before = voter;
    keel_voter_t worst = voter;

    for (int32_t i = -128; i <= 4096; i++) {
        const keel_voter_sample_t sample[3] = {
            {10.0f, 0u, true}, {10.0f, 0u, true}, {10.0f + ((float)i / 64.0f), 0u, true}};

        voter = before;
        keel_voter_scale(&voter);
        keel_voter_step(&voter, sample, 10u);
        if ((i == -128) || (voter.vote.output > worst.vote.output)) {
            worst = voter;
        }
    }
    voter = worst;
}

/* By hand: c = 1/2, slope = 1/4, H = 10, agree = 1, so B = (10 + 1/2)/(1 - 1/8) = 12. There a is 4,
 * and a third at 18 takes the output 2 beyond 10: B is reached. */
static void VOT_023_a_third_opens_the_thresholds_to_a_bound_and_no_farther(void)
{
    begin_growing(0.0f);
    for (int32_t i = 0; i < 100; i++) {
        vote_worst();
        TEST_ASSERT_TRUE(voter.vote.output <= 12.0001f);
    }
    TEST_ASSERT_TRUE(voter.vote.output >= 11.99f);
}

static void VOT_023_an_output_beyond_the_bound_comes_nearer_by_the_factor(void)
{
    float beyond = 512.0f - 12.0f;

    begin_growing(512.0f);
    for (int32_t i = 0; i < 5; i++) {
        vote_worst();
        TEST_ASSERT_TRUE((voter.vote.output - 12.0f) <= ((beyond / 8.0f) + 0.0002f));
        beyond = voter.vote.output - 12.0f;
    }
    TEST_ASSERT_TRUE(beyond < 0.02f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(VOT_023_a_third_opens_the_thresholds_to_a_bound_and_no_farther);
    RUN_TEST(VOT_023_an_output_beyond_the_bound_comes_nearer_by_the_factor);
    RUN_TEST(VOT_015_bounded_while_the_healthy_two_are_within_a);
    RUN_TEST(VOT_015_not_bounded_when_they_are_farther_apart);
    RUN_TEST(VOT_015_a_third_between_them_leaves_no_hull);
    return UNITY_END();
}
