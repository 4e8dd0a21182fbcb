/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/common/wait.h. */
#include "common/wait.h"
#include "unity.h"

#include <stddef.h>

static volatile uint32_t word;
static uint32_t calls;
static uint32_t ready_after; /* The call that makes the word ready. */
static uint32_t now_us;
static uint32_t step_us;
static uint32_t readings;

void setUp(void)
{
    word = 0u;
    calls = 0u;
    ready_after = UINT32_MAX;
    readings = 0u;
}

void tearDown(void)
{
}

static void between(void *context)
{
    TEST_ASSERT_EQUAL_PTR(&word, context);
    calls++;
    if (calls == ready_after) {
        word = 0xF6u;
    }
}

static bool wait_for(uint32_t looks)
{
    const keel_wait_t wait = {looks, between, (void *)&word};

    return keel_wait_for(&word, 0x0Fu, 0x06u, &wait);
}

static void WAI_001_what_is_there_is_not_waited_for(void)
{
    word = 0xA6u; /* The bits outside of the mask do not matter. */
    TEST_ASSERT_TRUE(wait_for(1u));
    TEST_ASSERT_EQUAL_UINT32(0u, calls);
}

static void WAI_001_the_last_look_counts(void)
{
    ready_after = 4u;
    TEST_ASSERT_TRUE(wait_for(5u));
    TEST_ASSERT_EQUAL_UINT32(4u, calls);
}

static void WAI_001_it_ends_at_the_bound(void)
{
    ready_after = 5u;
    TEST_ASSERT_FALSE(wait_for(5u));
    TEST_ASSERT_EQUAL_UINT32(4u, calls);
}

static void WAI_001_nothing_need_happen_between(void)
{
    const keel_wait_t wait = {1000u, NULL, NULL};

    TEST_ASSERT_FALSE(keel_wait_for(&word, 1u, 1u, &wait));
}

static uint32_t read_clock(void *context)
{
    const uint32_t read_us = now_us;

    TEST_ASSERT_EQUAL_PTR(&now_us, context);
    now_us = (uint32_t)((uint64_t)now_us + step_us);
    readings++;
    return read_us;
}

static void WAI_002_time_passes_also_over_the_wrap(void)
{
    now_us = UINT32_MAX - 20u;
    step_us = 10u;
    TEST_ASSERT_TRUE(keel_wait_us(read_clock, &now_us, 100u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(11u, readings); /* At 0, 10 … 100 us. */
}

static void WAI_002_no_time_takes_no_look(void)
{
    step_us = 0u;
    TEST_ASSERT_TRUE(keel_wait_us(read_clock, &now_us, 0u, 0u));
}

static void WAI_002_a_clock_that_stands_still_ends_it(void)
{
    now_us = 5u;
    step_us = 0u;
    TEST_ASSERT_FALSE(keel_wait_us(read_clock, &now_us, 1u, 50u));
    TEST_ASSERT_EQUAL_UINT32(51u, readings);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(WAI_001_what_is_there_is_not_waited_for);
    RUN_TEST(WAI_001_the_last_look_counts);
    RUN_TEST(WAI_001_it_ends_at_the_bound);
    RUN_TEST(WAI_001_nothing_need_happen_between);
    RUN_TEST(WAI_002_time_passes_also_over_the_wrap);
    RUN_TEST(WAI_002_no_time_takes_no_look);
    RUN_TEST(WAI_002_a_clock_that_stands_still_ends_it);
    return UNITY_END();
}
