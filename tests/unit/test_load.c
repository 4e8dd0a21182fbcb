/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/load.h. Expected values are worked out by hand. */
#include "keel/rtos/load.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void LOD_006_begin_notes_time_and_busy_time(void)
{
    keel_load_t load = {1u, 2u};

    keel_load_begin(&load, 5000000000u, 6000000u);
    TEST_ASSERT_EQUAL_UINT64(5000000000u, load.start_us);
    TEST_ASSERT_EQUAL_UINT64(6000000u, load.busy_us);
}

static void LOD_007_load_of_a_window(void)
{
    const keel_load_t load = {10000u, 2000u};

    TEST_ASSERT_EQUAL_UINT32(0u, keel_load_ppm(&load, 11000u, 2000u));
    TEST_ASSERT_EQUAL_UINT32(250000u, keel_load_ppm(&load, 11000u, 2250u));
    TEST_ASSERT_EQUAL_UINT32(333333u, keel_load_ppm(&load, 10003u, 2001u));
    TEST_ASSERT_EQUAL_UINT32(666666u, keel_load_ppm(&load, 10003u, 2002u));
    TEST_ASSERT_EQUAL_UINT32(1000000u, keel_load_ppm(&load, 11000u, 3000u));
}

static void LOD_007_empty_window_is_idle(void)
{
    const keel_load_t load = {10000u, 2000u};

    TEST_ASSERT_EQUAL_UINT32(0u, keel_load_ppm(&load, 10000u, 2000u));
}

static void LOD_007_longest_window(void)
{
    const keel_load_t load = {7u, 0u};

    TEST_ASSERT_EQUAL_UINT32(1000000u, keel_load_ppm(&load, 7u + (uint64_t)UINT32_MAX, UINT32_MAX));
    /* 2^31 of 2^32 - 1: 500000.0001 ppm. */
    TEST_ASSERT_EQUAL_UINT32(500000u, keel_load_ppm(&load, 7u + (uint64_t)UINT32_MAX, 0x80000000u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(LOD_006_begin_notes_time_and_busy_time);
    RUN_TEST(LOD_007_load_of_a_window);
    RUN_TEST(LOD_007_empty_window_is_idle);
    RUN_TEST(LOD_007_longest_window);
    return UNITY_END();
}
