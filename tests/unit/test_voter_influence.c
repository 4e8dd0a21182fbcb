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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(VOT_015_bounded_while_the_healthy_two_are_within_a);
    RUN_TEST(VOT_015_not_bounded_when_they_are_farther_apart);
    RUN_TEST(VOT_015_a_third_between_them_leaves_no_hull);
    return UNITY_END();
}
