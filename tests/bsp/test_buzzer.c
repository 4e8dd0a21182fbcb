/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/buzzer.h. Expected register contents are from RM0410, 27.4 (timers
 * with two channels); periods are a second by the tone's frequency, to the nearest microsecond. */
#include "stm32f767/buzzer.h"
#include "unity.h"

#include <string.h>

/* What lies where the timer lacks a register. */
#define HOLE 0xC0DEC0DEu

static keel_tim_t tim;
static keel_buzzer_t buzzer;

static const keel_tone_t tune[] = {{440u, 200u}, {0u, 100u}, {880u, 50u}};

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_buzzer_start(&buzzer, &tim, 216000000u));
    tim.EGR = 0u;
}

void setUp(void)
{
    memset(&tim, 0, sizeof tim);
    memset(&buzzer, 0x55, sizeof buzzer);
    tim.CR2 = HOLE;
    tim.CCMR2 = HOLE;
    tim.RCR = HOLE;
    tim.CCR3 = HOLE;
    tim.CCR4 = HOLE;
    tim.BDTR = HOLE;
    tim.CCR1 = 500u; /* As if it sounded. */
    start();
}

void tearDown(void)
{
    TEST_ASSERT_EQUAL_HEX32(HOLE, tim.CR2);
    TEST_ASSERT_EQUAL_HEX32(HOLE, tim.CCMR2);
    TEST_ASSERT_EQUAL_HEX32(HOLE, tim.RCR);
    TEST_ASSERT_EQUAL_HEX32(HOLE, tim.CCR3);
    TEST_ASSERT_EQUAL_HEX32(HOLE, tim.CCR4);
    TEST_ASSERT_EQUAL_HEX32(HOLE, tim.BDTR);
}

static void sounds(uint32_t period_us)
{
    TEST_ASSERT_EQUAL_UINT32(period_us - 1u, tim.ARR);
    TEST_ASSERT_EQUAL_UINT32(period_us / 2u, tim.CCR1);
    TEST_ASSERT_EQUAL_HEX32(1u, tim.EGR);
    tim.EGR = 0u;
}

static void is_silent(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, tim.CCR1);
    TEST_ASSERT_EQUAL_HEX32(1u, tim.EGR);
    tim.EGR = 0u;
}

static void BUZ_001_it_starts_silent(void)
{
    TEST_ASSERT_EQUAL_UINT32(215u, tim.PSC); /* 1 MHz. */
    TEST_ASSERT_EQUAL_UINT32(0u, tim.CCR1);
    TEST_ASSERT_EQUAL_HEX32(0x00000068u, tim.CCMR1); /* PWM mode 1, preloaded. */
    TEST_ASSERT_EQUAL_HEX32(0x00000001u, tim.CCER);  /* Channel 1, active high. */
    TEST_ASSERT_EQUAL_HEX32(0x00000081u, tim.CR1);   /* Runs, with the period preloaded. */
    TEST_ASSERT_EQUAL_HEX32(0u, tim.SMCR);
    TEST_ASSERT_EQUAL_HEX32(0u, tim.DIER); /* No interrupts. */
    TEST_ASSERT_FALSE(keel_buzzer_plays(&buzzer));
}

static void BUZ_001_it_takes_the_silence_over(void)
{
    tim.CCR1 = 500u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_buzzer_start(&buzzer, &tim, 108000000u));
    TEST_ASSERT_EQUAL_UINT32(107u, tim.PSC);
    is_silent();
}

static void BUZ_001_other_clocks_are_refused(void)
{
    static const uint32_t bad[] = {0u, 500000u, 216500000u};
    const keel_buzzer_t before = buzzer;
    const keel_tim_t registers = tim;
    keel_tim_t other;

    memset(&other, 0, sizeof other);
    for (uint32_t i = 0u; i < 3u; i++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_buzzer_start(&buzzer, &tim, bad[i]));
        TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_buzzer_start(&buzzer, &other, bad[i]));
    }
    TEST_ASSERT_EQUAL_MEMORY(&before, &buzzer, sizeof buzzer);
    TEST_ASSERT_EQUAL_MEMORY(&registers, &tim, sizeof tim);
}

static void BUZ_002_frequencies(void)
{
    static const struct {
        uint16_t hz;
        uint32_t period_us;
    } tone[] = {{20u, 50000u}, {440u, 2273u}, {880u, 1136u}, {3000u, 333u}, {10000u, 100u}};

    for (uint32_t i = 0u; i < 5u; i++) {
        const keel_tone_t one = {tone[i].hz, 10u};

        keel_buzzer_play(&buzzer, &one, 1u);
        sounds(tone[i].period_us);
    }
}

static void BUZ_002_silence_by_a_tone(void)
{
    static const uint16_t silent[] = {0u, 19u, 10001u, UINT16_MAX};

    for (uint32_t i = 0u; i < 4u; i++) {
        const keel_tone_t one = {silent[i], 10u};

        tim.CCR1 = 500u;
        keel_buzzer_play(&buzzer, &one, 1u);
        is_silent();
        TEST_ASSERT_TRUE(keel_buzzer_plays(&buzzer));
    }
}

static void BUZ_003_a_tune_takes_the_place_of_another(void)
{
    static const keel_tone_t other[] = {{3000u, 1000u}};

    keel_buzzer_play(&buzzer, tune, 3u);
    keel_buzzer_turn(&buzzer, 199999u);
    keel_buzzer_play(&buzzer, other, 1u);
    sounds(333u);
    keel_buzzer_turn(&buzzer, 999999u); /* With its whole time. */
    TEST_ASSERT_TRUE(keel_buzzer_plays(&buzzer));
    keel_buzzer_turn(&buzzer, 1u);
    is_silent();
    TEST_ASSERT_FALSE(keel_buzzer_plays(&buzzer));
}

static void BUZ_003_none_is_silence(void)
{
    keel_buzzer_play(&buzzer, tune, 3u);
    sounds(2273u);
    keel_buzzer_play(&buzzer, NULL, 0u);
    is_silent();
    TEST_ASSERT_FALSE(keel_buzzer_plays(&buzzer));
    keel_buzzer_turn(&buzzer, UINT32_MAX);
    TEST_ASSERT_EQUAL_HEX32(0u, tim.EGR); /* And stays so. */
}

static void BUZ_004_one_tone_behind_the_other(void)
{
    keel_buzzer_play(&buzzer, tune, 3u);
    sounds(2273u);
    for (uint32_t i = 0u; i < 199u; i++) {
        keel_buzzer_turn(&buzzer, 1000u);
        TEST_ASSERT_EQUAL_HEX32(0u, tim.EGR); /* The timer is left alone meanwhile. */
    }
    keel_buzzer_turn(&buzzer, 1000u);
    is_silent();
    keel_buzzer_turn(&buzzer, 99999u);
    TEST_ASSERT_EQUAL_HEX32(0u, tim.EGR);
    keel_buzzer_turn(&buzzer, 1u);
    sounds(1136u);
    keel_buzzer_turn(&buzzer, 49999u);
    TEST_ASSERT_TRUE(keel_buzzer_plays(&buzzer));
    keel_buzzer_turn(&buzzer, 1u);
    is_silent();
    TEST_ASSERT_FALSE(keel_buzzer_plays(&buzzer));
}

static void BUZ_004_a_late_turn_shortens_no_tone(void)
{
    keel_buzzer_play(&buzzer, tune, 3u);
    keel_buzzer_turn(&buzzer, UINT32_MAX);
    is_silent();
    keel_buzzer_turn(&buzzer, 99999u);
    TEST_ASSERT_EQUAL_UINT32(2u, buzzer.left);
    keel_buzzer_turn(&buzzer, 1u);
    sounds(1136u);
}

static void BUZ_004_the_longest_tone(void)
{
    static const keel_tone_t one[] = {{440u, UINT16_MAX}};

    keel_buzzer_play(&buzzer, one, 1u);
    keel_buzzer_turn(&buzzer, 65534999u);
    keel_buzzer_turn(&buzzer, 0u);
    TEST_ASSERT_TRUE(keel_buzzer_plays(&buzzer));
    keel_buzzer_turn(&buzzer, UINT32_MAX); /* The sum does not wrap. */
    TEST_ASSERT_FALSE(keel_buzzer_plays(&buzzer));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(BUZ_001_it_starts_silent);
    RUN_TEST(BUZ_001_it_takes_the_silence_over);
    RUN_TEST(BUZ_001_other_clocks_are_refused);
    RUN_TEST(BUZ_002_frequencies);
    RUN_TEST(BUZ_002_silence_by_a_tone);
    RUN_TEST(BUZ_003_a_tune_takes_the_place_of_another);
    RUN_TEST(BUZ_003_none_is_silence);
    RUN_TEST(BUZ_004_one_tone_behind_the_other);
    RUN_TEST(BUZ_004_a_late_turn_shortens_no_tone);
    RUN_TEST(BUZ_004_the_longest_tone);
    return UNITY_END();
}
