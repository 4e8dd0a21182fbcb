/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/watchdog.h. Expected values by RM0410, 30.3: the time-out is
 * (reload + 1) * divisor / 32 kHz. */
#include "stm32f767/watchdog.h"
#include "unity.h"

#include <string.h>

static keel_iwdg_t iwdg;
static uint32_t looks_until_taken;

void setUp(void)
{
    memset(&iwdg, 0, sizeof iwdg);
    iwdg.RLR = IWDG_RLR_RESET;
    looks_until_taken = 0u;
}

void tearDown(void)
{
}

static void advance(void *context)
{
    (void)context;
    if (looks_until_taken > 0u) {
        looks_until_taken--;
        iwdg.SR = (looks_until_taken > 0u) ? 3u : 0u;
    }
}

static const keel_wait_t wait = {10u, advance, NULL};

static void plan_is(uint32_t timeout_us, uint32_t prescaler, uint32_t reload)
{
    keel_watchdog_plan_t plan = {99u, 99u};

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_watchdog_plan(timeout_us, &plan));
    TEST_ASSERT_EQUAL_UINT32(prescaler, plan.prescaler);
    TEST_ASSERT_EQUAL_UINT32(reload, plan.reload);
}

static void WDG_001_plans(void)
{
    plan_is(125u, 0u, 0u);         /* 4 ticks of 31.25 us: one step. */
    plan_is(126u, 0u, 1u);         /* Rounded up. */
    plan_is(50000u, 0u, 399u);     /* 1600 ticks / 4 = 400. */
    plan_is(512000u, 0u, 4095u);   /* The most of the finest. */
    plan_is(512001u, 1u, 2048u);   /* 16385 ticks / 8 = 2048.1, rounded up to 2049. */
    plan_is(32768000u, 6u, 4095u); /* The most there is. */
}

static void WDG_001_what_cannot_be_had_is_refused(void)
{
    keel_watchdog_plan_t plan = {99u, 98u};

    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_watchdog_plan(0u, &plan));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_watchdog_plan(93u, &plan)); /* 2.98: 3 ticks. */
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_watchdog_plan(32768001u, &plan));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_watchdog_plan(UINT32_MAX, &plan));
    TEST_ASSERT_EQUAL_UINT32(99u, plan.prescaler);
    TEST_ASSERT_EQUAL_UINT32(98u, plan.reload);
}

static void WDG_002_starts(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_watchdog_start(&iwdg, 50000u, &wait));
    TEST_ASSERT_EQUAL_UINT32(0u, iwdg.PR);
    TEST_ASSERT_EQUAL_UINT32(399u, iwdg.RLR);
    TEST_ASSERT_EQUAL_HEX32(0xAAAAu, iwdg.KR); /* The last key: its time begins. */
}

static void WDG_002_waits_until_its_registers_are_taken(void)
{
    iwdg.SR = 3u;
    looks_until_taken = 9u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_watchdog_start(&iwdg, 50000u, &wait));
    iwdg.SR = 3u;
    looks_until_taken = 10u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_watchdog_start(&iwdg, 50000u, &wait));
    TEST_ASSERT_EQUAL_HEX32(0x5555u, iwdg.KR);
}

static void WDG_002_a_bad_time_does_not_start_it(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_watchdog_start(&iwdg, 10u, &wait));
    TEST_ASSERT_EQUAL_HEX32(0u, iwdg.KR);
    TEST_ASSERT_EQUAL_UINT32(IWDG_RLR_RESET, iwdg.RLR);
}

static void WDG_003_is_fed(void)
{
    keel_watchdog_feed(&iwdg);
    TEST_ASSERT_EQUAL_HEX32(0xAAAAu, iwdg.KR);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(WDG_001_plans);
    RUN_TEST(WDG_001_what_cannot_be_had_is_refused);
    RUN_TEST(WDG_002_starts);
    RUN_TEST(WDG_002_waits_until_its_registers_are_taken);
    RUN_TEST(WDG_002_a_bad_time_does_not_start_it);
    RUN_TEST(WDG_003_is_fed);
    return UNITY_END();
}
