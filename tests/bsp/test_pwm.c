/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/pwm.h. Expected register contents are from RM0410, 25.4. */
#include "stm32f767/pwm.h"
#include "unity.h"

#include <string.h>

static keel_tim_t tim;

void setUp(void)
{
    memset(&tim, 0, sizeof tim);
    tim.BDTR = 0x00008000u; /* As if the outputs were on. */
    tim.CCR1 = 1500u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_start(&tim, 216000000u, 400u));
}

void tearDown(void)
{
}

static void PWM_001_starts_without_pulses_and_driven_low(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x00000400u, tim.BDTR); /* OSSI, no main output. */
    TEST_ASSERT_EQUAL_HEX32(0u, tim.CR2);           /* Idle levels low. */
    TEST_ASSERT_EQUAL_UINT32(0u, tim.CCR1 | tim.CCR2 | tim.CCR3 | tim.CCR4);
    TEST_ASSERT_EQUAL_UINT32(215u, tim.PSC);
    TEST_ASSERT_EQUAL_UINT32(2499u, tim.ARR);        /* 2500 us. */
    TEST_ASSERT_EQUAL_HEX32(0x00006868u, tim.CCMR1); /* Mode 1 and preload, twice. */
    TEST_ASSERT_EQUAL_HEX32(0x00006868u, tim.CCMR2);
    TEST_ASSERT_EQUAL_HEX32(0x00001111u, tim.CCER);
    TEST_ASSERT_EQUAL_HEX32(1u, tim.EGR);
    TEST_ASSERT_EQUAL_HEX32(0x00000081u, tim.CR1);
}

static void start_refuses(uint32_t timer_hz, uint32_t rate_hz)
{
    keel_tim_t before;

    memcpy(&before, &tim, sizeof tim);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_pwm_start(&tim, timer_hz, rate_hz));
    TEST_ASSERT_EQUAL_MEMORY(&before, &tim, sizeof tim);
}

static void PWM_001_rates_out_of_range_are_refused(void)
{
    start_refuses(216000000u, 49u);
    start_refuses(216000000u, 401u);
    start_refuses(216500000u, 400u);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_start(&tim, 216000000u, 50u));
    TEST_ASSERT_EQUAL_UINT32(19999u, tim.ARR);
}

static void PWM_002_each_channel_its_own(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&tim, 0u, 900u));
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&tim, 1u, 1500u));
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&tim, 2u, 2100u));
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&tim, 3u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(900u, tim.CCR1);
    TEST_ASSERT_EQUAL_UINT32(1500u, tim.CCR2);
    TEST_ASSERT_EQUAL_UINT32(2100u, tim.CCR3);
    TEST_ASSERT_EQUAL_UINT32(1000u, tim.CCR4);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&tim, 1u, 0u));
    TEST_ASSERT_EQUAL_UINT32(0u, tim.CCR2);
}

static void set_refuses(uint32_t channel, uint32_t pulse_us)
{
    keel_tim_t before;

    memcpy(&before, &tim, sizeof tim);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_pwm_set(&tim, channel, pulse_us));
    TEST_ASSERT_EQUAL_MEMORY(&before, &tim, sizeof tim);
}

static void PWM_002_pulses_out_of_range_are_refused(void)
{
    set_refuses(0u, 899u);
    set_refuses(0u, 2101u);
    set_refuses(0u, 1u);
    set_refuses(4u, 1500u);
}

static void PWM_003_and_004_arm_and_off(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&tim, 0u, 1500u));
    keel_pwm_arm(&tim);
    TEST_ASSERT_EQUAL_HEX32(0x00008400u, tim.BDTR);
    keel_pwm_off(&tim);
    TEST_ASSERT_EQUAL_HEX32(0x00000400u, tim.BDTR);
}

static void PWM_004_off_is_off_from_any_state(void)
{
    tim.BDTR = 0xFFFFFFFFu;
    keel_pwm_off(&tim);
    TEST_ASSERT_EQUAL_HEX32(0x00000400u, tim.BDTR);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PWM_001_starts_without_pulses_and_driven_low);
    RUN_TEST(PWM_001_rates_out_of_range_are_refused);
    RUN_TEST(PWM_002_each_channel_its_own);
    RUN_TEST(PWM_002_pulses_out_of_range_are_refused);
    RUN_TEST(PWM_003_and_004_arm_and_off);
    RUN_TEST(PWM_004_off_is_off_from_any_state);
    return UNITY_END();
}
