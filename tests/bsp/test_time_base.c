/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/time_base.h. */
#include "stm32f767/time_base.h"
#include "unity.h"

#include <string.h>

static keel_tim_t tim;

void setUp(void)
{
    memset(&tim, 0, sizeof tim);
}

void tearDown(void)
{
}

static void TIB_001_prescalers(void)
{
    uint32_t word = 0u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_timer_prescaler(108000000u, 1000000u, &word));
    TEST_ASSERT_EQUAL_UINT32(107u, word);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_timer_prescaler(216000000u, 1000000u, &word));
    TEST_ASSERT_EQUAL_UINT32(215u, word);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_timer_prescaler(65536u, 1u, &word));
    TEST_ASSERT_EQUAL_UINT32(65535u, word);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_timer_prescaler(1000000u, 1000000u, &word));
    TEST_ASSERT_EQUAL_UINT32(0u, word);
}

static void TIB_001_what_cannot_be_had_is_refused(void)
{
    uint32_t word = 77u;

    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_timer_prescaler(108500000u, 1000000u, &word));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_timer_prescaler(65537u, 1u, &word));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_timer_prescaler(999999u, 1000000u, &word));
    TEST_ASSERT_EQUAL_UINT32(77u, word);
}

static void TIB_002_counts_microseconds_over_all_32_bits(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_time_base_start(&tim, 108000000u));
    TEST_ASSERT_EQUAL_HEX32(107u, tim.PSC);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFFu, tim.ARR);
    TEST_ASSERT_EQUAL_HEX32(1u, tim.EGR);
    TEST_ASSERT_EQUAL_HEX32(1u, tim.CR1);
}

static void TIB_002_a_clock_without_whole_microseconds_is_refused(void)
{
    keel_tim_t before;

    memcpy(&before, &tim, sizeof tim);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_time_base_start(&tim, 13500000u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &tim, sizeof tim);
}

static void TIB_003_is_the_counter(void)
{
    tim.CNT = 0xFFFFFFFEu;
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFEu, keel_time_base_us(&tim));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(TIB_001_prescalers);
    RUN_TEST(TIB_001_what_cannot_be_had_is_refused);
    RUN_TEST(TIB_002_counts_microseconds_over_all_32_bits);
    RUN_TEST(TIB_002_a_clock_without_whole_microseconds_is_refused);
    RUN_TEST(TIB_003_is_the_counter);
    return UNITY_END();
}
