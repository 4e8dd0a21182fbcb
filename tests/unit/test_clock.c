/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/clock.h. Expected values are worked out by hand. */
#include "keel/rtos/clock.h"
#include "unity.h"

#include <string.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void CLK_001_elapsed_without_wrap(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, keel_clock_elapsed_us(0u, 0u));
    TEST_ASSERT_EQUAL_UINT32(15u, keel_clock_elapsed_us(10u, 25u));
    TEST_ASSERT_EQUAL_UINT32(0xFFFFFFFFu, keel_clock_elapsed_us(0u, 0xFFFFFFFFu));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_clock_elapsed_us(0xFFFFFFFFu, 0xFFFFFFFFu));
}

static void CLK_001_elapsed_across_the_wrap(void)
{
    TEST_ASSERT_EQUAL_UINT32(1u, keel_clock_elapsed_us(0xFFFFFFFFu, 0u));
    TEST_ASSERT_EQUAL_UINT32(0x110u, keel_clock_elapsed_us(0xFFFFFF00u, 0x10u));
    TEST_ASSERT_EQUAL_UINT32(0xFFFFFFFFu, keel_clock_elapsed_us(1u, 0u));
    TEST_ASSERT_EQUAL_UINT32(0x80000000u, keel_clock_elapsed_us(0xC0000000u, 0x40000000u));
}

static void CLK_002_init_starts_time_at_zero(void)
{
    keel_clock_t clock = {77u, 99u};

    keel_clock_init(&clock, 0xFFFFFF00u);
    TEST_ASSERT_EQUAL_UINT64(0u, clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0xFFFFFF00u, clock.raw_us);
}

static void CLK_003_advance_without_wrap(void)
{
    keel_clock_t clock = {1000u, 50u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_clock_advance(&clock, 80u));
    TEST_ASSERT_EQUAL_UINT64(1030u, clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(80u, clock.raw_us);
}

static void CLK_003_advance_across_the_wrap(void)
{
    keel_clock_t clock = {1000u, 0xFFFFFF00u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_clock_advance(&clock, 0x10u));
    TEST_ASSERT_EQUAL_UINT64(1272u, clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0x10u, clock.raw_us);
}

static void CLK_003_advance_by_nothing(void)
{
    keel_clock_t clock = {1000u, 50u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_clock_advance(&clock, 50u));
    TEST_ASSERT_EQUAL_UINT64(1000u, clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(50u, clock.raw_us);
}

static void CLK_003_longest_step_is_taken(void)
{
    keel_clock_t clock = {0u, 0xFFFFFFF0u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_clock_advance(&clock, 0x7FFFFFEFu));
    TEST_ASSERT_EQUAL_UINT64(0x7FFFFFFFu, clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0x7FFFFFEFu, clock.raw_us);
}

static void CLK_003_time_outgrows_the_counter(void)
{
    keel_clock_t clock;
    uint32_t raw_us = 12345u;

    /* Ten steps of 2^30 us: two and a half turns of the counter. */
    keel_clock_init(&clock, raw_us);
    for (int i = 0; i < 10; i++) {
        raw_us = (raw_us < 0xC0000000u) ? (raw_us + 0x40000000u) : (raw_us - 0xC0000000u);
        TEST_ASSERT_EQUAL(KEEL_OK, keel_clock_advance(&clock, raw_us));
    }
    TEST_ASSERT_EQUAL_UINT64(10737418240u, clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0x80003039u, clock.raw_us);
}

static void refuses(uint32_t from_us, uint32_t to_us)
{
    keel_clock_t clock;
    keel_clock_t before;

    memset(&clock, 0, sizeof clock);
    clock.now_us = 5000000000u;
    clock.raw_us = from_us;
    memcpy(&before, &clock, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_CLOCK, keel_clock_advance(&clock, to_us));
    TEST_ASSERT_EQUAL_MEMORY(&before, &clock, sizeof clock);
}

static void CLK_004_step_back_is_refused(void)
{
    refuses(100u, 99u);
    refuses(100u, 0u);
    refuses(0u, 0xFFFFFFFFu);
    refuses(0x10u, 0xFFFFFF00u);
}

static void CLK_004_step_of_half_the_range_is_refused(void)
{
    refuses(0u, 0x80000000u);
    refuses(0xFFFFFFF0u, 0x7FFFFFF0u);
    refuses(0u, 0x80000001u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CLK_001_elapsed_without_wrap);
    RUN_TEST(CLK_001_elapsed_across_the_wrap);
    RUN_TEST(CLK_002_init_starts_time_at_zero);
    RUN_TEST(CLK_003_advance_without_wrap);
    RUN_TEST(CLK_003_advance_across_the_wrap);
    RUN_TEST(CLK_003_advance_by_nothing);
    RUN_TEST(CLK_003_longest_step_is_taken);
    RUN_TEST(CLK_003_time_outgrows_the_counter);
    RUN_TEST(CLK_004_step_back_is_refused);
    RUN_TEST(CLK_004_step_of_half_the_range_is_refused);
    return UNITY_END();
}
