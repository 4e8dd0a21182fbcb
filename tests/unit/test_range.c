/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/range.h. */
#include "keel/middleware/range.h"
#include "unity.h"

#include <math.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void RNG_001_holds_its_ends_and_what_is_between(void)
{
    TEST_ASSERT_TRUE(keel_range_contains(-1.0f, -1.0f, 2.0f));
    TEST_ASSERT_TRUE(keel_range_contains(0.5f, -1.0f, 2.0f));
    TEST_ASSERT_TRUE(keel_range_contains(2.0f, -1.0f, 2.0f));
    TEST_ASSERT_TRUE(keel_range_contains(-0.0f, 0.0f, 0.0f));
}

static void RNG_001_does_not_hold_the_floats_next_to_it(void)
{
    TEST_ASSERT_FALSE(keel_range_contains(nextafterf(-1.0f, -2.0f), -1.0f, 2.0f));
    TEST_ASSERT_FALSE(keel_range_contains(nextafterf(2.0f, 3.0f), -1.0f, 2.0f));
}

static void RNG_001_holds_neither_nan_nor_infinity(void)
{
    TEST_ASSERT_FALSE(keel_range_contains(NAN, -1.0f, 1.0f));
    TEST_ASSERT_FALSE(keel_range_contains(NAN, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST));
    TEST_ASSERT_FALSE(keel_range_contains(INFINITY, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST));
    TEST_ASSERT_FALSE(keel_range_contains(-INFINITY, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST));
    TEST_ASSERT_TRUE(keel_range_contains(KEEL_RANGE_LARGEST, 0.0f, KEEL_RANGE_LARGEST));
}

static void RNG_001_without_a_number_between_its_ends_is_empty(void)
{
    TEST_ASSERT_FALSE(keel_range_contains(1.0f, 2.0f, 0.0f));
}

static void RNG_002_leaves_what_lies_in_it(void)
{
    TEST_ASSERT_EQUAL_FLOAT(0.5f, keel_range_clamp(0.5f, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, keel_range_clamp(-1.0f, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, keel_range_clamp(2.0f, -1.0f, 2.0f));
}

static void RNG_002_takes_the_end_that_is_next(void)
{
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, keel_range_clamp(-1.5f, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, keel_range_clamp(2.5f, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, keel_range_clamp(-INFINITY, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, keel_range_clamp(INFINITY, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(3.0f, keel_range_clamp(7.0f, 3.0f, 3.0f));
}

static void RNG_002_makes_nan_the_lower_end(void)
{
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, keel_range_clamp(NAN, -1.0f, 2.0f));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(RNG_001_holds_its_ends_and_what_is_between);
    RUN_TEST(RNG_001_does_not_hold_the_floats_next_to_it);
    RUN_TEST(RNG_001_holds_neither_nan_nor_infinity);
    RUN_TEST(RNG_001_without_a_number_between_its_ends_is_empty);
    RUN_TEST(RNG_002_leaves_what_lies_in_it);
    RUN_TEST(RNG_002_takes_the_end_that_is_next);
    RUN_TEST(RNG_002_makes_nan_the_lower_end);
    return UNITY_END();
}
