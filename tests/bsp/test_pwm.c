/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/pwm.h. Expected register contents are from RM0410, 6.4 (ports), 25.4
 * (timer 1), 26.4 (timers 2 to 5) and 27.4 (timers with two channels). */
#include "stm32f767/pwm.h"
#include "unity.h"

#include <string.h>

/* What lies where a timer lacks a register: no driver may touch it. */
#define HOLE 0xC0DEC0DEu

static keel_tim_t advanced;
static keel_tim_t general;
static keel_tim_t small;
static keel_gpio_t port;

static const keel_pwm_timer_t gated = {&advanced, 4u, true};
static const keel_pwm_timer_t plain = {&general, 4u, false};
static const keel_pwm_timer_t two = {&small, 2u, false};

/* As on a board: not in the order of the channels, and not all of them. */
static const keel_pwm_output_t outputs[] = {
    {{&port, 14u}, 1u, &gated, 4u}, {{&port, 9u}, 1u, &gated, 1u}, {{&port, 3u}, 2u, &plain, 2u},
    {{&port, 4u}, 2u, &plain, 3u},  {{&port, 6u}, 9u, &two, 1u},   {{&port, 8u}, 9u, &two, 2u},
};

#define COUNT 6u

static void dig_holes(void)
{
    general.RCR = HOLE;
    general.BDTR = HOLE;
    small.CR2 = HOLE;
    small.CCMR2 = HOLE;
    small.RCR = HOLE;
    small.CCR3 = HOLE;
    small.CCR4 = HOLE;
    small.BDTR = HOLE;
}

static void check_holes(void)
{
    TEST_ASSERT_EQUAL_HEX32(HOLE, general.RCR);
    TEST_ASSERT_EQUAL_HEX32(HOLE, general.BDTR);
    TEST_ASSERT_EQUAL_HEX32(HOLE, small.CR2);
    TEST_ASSERT_EQUAL_HEX32(HOLE, small.CCMR2);
    TEST_ASSERT_EQUAL_HEX32(HOLE, small.RCR);
    TEST_ASSERT_EQUAL_HEX32(HOLE, small.CCR3);
    TEST_ASSERT_EQUAL_HEX32(HOLE, small.CCR4);
    TEST_ASSERT_EQUAL_HEX32(HOLE, small.BDTR);
}

void setUp(void)
{
    memset(&advanced, 0, sizeof advanced);
    memset(&general, 0, sizeof general);
    memset(&small, 0, sizeof small);
    memset(&port, 0, sizeof port);
    dig_holes();
    advanced.BDTR = 0x00008000u; /* As if the outputs were on. */
    advanced.CCR1 = 1500u;
    general.CCR2 = 1500u;
    small.CCR1 = 1500u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_start(&gated, 216000000u, 400u));
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_start(&plain, 108000000u, 400u));
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_start(&two, 108000000u, 400u));
    advanced.EGR = 0u;
    general.EGR = 0u;
    small.EGR = 0u;
}

void tearDown(void)
{
    check_holes();
}

static void PWM_001_starts_without_pulses_and_with_the_gate_shut(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x00000400u, advanced.BDTR); /* OSSI, no main output. */
    TEST_ASSERT_EQUAL_HEX32(0u, advanced.CR2);           /* Idle levels low. */
    TEST_ASSERT_EQUAL_UINT32(0u, advanced.CCR1 | advanced.CCR2 | advanced.CCR3 | advanced.CCR4);
    TEST_ASSERT_EQUAL_UINT32(215u, advanced.PSC);
    TEST_ASSERT_EQUAL_UINT32(2499u, advanced.ARR);        /* 2500 us. */
    TEST_ASSERT_EQUAL_HEX32(0x00006868u, advanced.CCMR1); /* Mode 1 and preload, twice. */
    TEST_ASSERT_EQUAL_HEX32(0x00006868u, advanced.CCMR2);
    TEST_ASSERT_EQUAL_HEX32(0x00001111u, advanced.CCER);
    TEST_ASSERT_EQUAL_HEX32(0x00000081u, advanced.CR1);
    TEST_ASSERT_EQUAL_HEX32(0u, port.MODER); /* Pins are not its business. */
}

static void PWM_001_a_timer_without_a_gate(void)
{
    TEST_ASSERT_EQUAL_UINT32(107u, general.PSC);
    TEST_ASSERT_EQUAL_UINT32(2499u, general.ARR);
    TEST_ASSERT_EQUAL_HEX32(0x00006868u, general.CCMR1);
    TEST_ASSERT_EQUAL_HEX32(0x00006868u, general.CCMR2);
    TEST_ASSERT_EQUAL_HEX32(0x00001111u, general.CCER);
    TEST_ASSERT_EQUAL_UINT32(0u, general.CCR1 | general.CCR2 | general.CCR3 | general.CCR4);
    TEST_ASSERT_EQUAL_HEX32(0x00000081u, general.CR1);
}

static void PWM_001_a_timer_with_two_channels(void)
{
    TEST_ASSERT_EQUAL_UINT32(107u, small.PSC);
    TEST_ASSERT_EQUAL_UINT32(2499u, small.ARR);
    TEST_ASSERT_EQUAL_HEX32(0x00006868u, small.CCMR1);
    TEST_ASSERT_EQUAL_HEX32(0x00000011u, small.CCER);
    TEST_ASSERT_EQUAL_UINT32(0u, small.CCR1 | small.CCR2);
    TEST_ASSERT_EQUAL_HEX32(0x00000081u, small.CR1);
}

static void PWM_001_takes_its_values_over_at_the_start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_start(&two, 108000000u, 400u));
    TEST_ASSERT_EQUAL_HEX32(1u, small.EGR);
}

static void start_refuses(uint32_t timer_hz, uint32_t rate_hz)
{
    keel_tim_t before;

    memcpy(&before, &advanced, sizeof advanced);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_pwm_start(&gated, timer_hz, rate_hz));
    TEST_ASSERT_EQUAL_MEMORY(&before, &advanced, sizeof advanced);
}

static void PWM_001_rates_out_of_range_are_refused(void)
{
    start_refuses(216000000u, 49u);
    start_refuses(216000000u, 401u);
    start_refuses(216500000u, 400u);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_start(&gated, 216000000u, 50u));
    TEST_ASSERT_EQUAL_UINT32(19999u, advanced.ARR);
}

static void PWM_002_each_output_its_own(void)
{
    static const uint32_t pulse_us[COUNT] = {900u, 1500u, 2100u, 1000u, 1100u, 1200u};

    for (uint32_t i = 0u; i < COUNT; i++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&outputs[i], pulse_us[i]));
    }
    TEST_ASSERT_EQUAL_UINT32(900u, advanced.CCR4);
    TEST_ASSERT_EQUAL_UINT32(1500u, advanced.CCR1);
    TEST_ASSERT_EQUAL_UINT32(0u, advanced.CCR2 | advanced.CCR3);
    TEST_ASSERT_EQUAL_UINT32(2100u, general.CCR2);
    TEST_ASSERT_EQUAL_UINT32(1000u, general.CCR3);
    TEST_ASSERT_EQUAL_UINT32(0u, general.CCR1 | general.CCR4);
    TEST_ASSERT_EQUAL_UINT32(1100u, small.CCR1);
    TEST_ASSERT_EQUAL_UINT32(1200u, small.CCR2);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&outputs[0], 0u));
    TEST_ASSERT_EQUAL_UINT32(0u, advanced.CCR4);
}

static void set_refuses(uint32_t pulse_us)
{
    keel_tim_t before;

    memcpy(&before, &advanced, sizeof advanced);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_pwm_set(&outputs[0], pulse_us));
    TEST_ASSERT_EQUAL_MEMORY(&before, &advanced, sizeof advanced);
}

static void PWM_002_pulses_out_of_range_are_refused(void)
{
    set_refuses(899u);
    set_refuses(2101u);
    set_refuses(1u);
}

/* The ports' registers do not follow BSRR here, as a chip's ODR does. */
static void arm_all(void)
{
    for (uint32_t i = 0u; i < COUNT; i++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_set(&outputs[i], 1500u));
    }
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_arm(outputs, COUNT));
}

static void PWM_003_armed_pins_are_their_timers(void)
{
    arm_all();
    TEST_ASSERT_EQUAL_HEX32(0x200A2280u, port.MODER); /* Pins 3, 4, 6, 8, 9 and 14. */
    TEST_ASSERT_EQUAL_HEX32(0x09022000u, port.AFRL);
    TEST_ASSERT_EQUAL_HEX32(0x01000019u, port.AFRH);
    TEST_ASSERT_EQUAL_HEX32(0x00008400u, advanced.BDTR);
    TEST_ASSERT_EQUAL_UINT32(1500u, advanced.CCR4);
    TEST_ASSERT_EQUAL_UINT32(1500u, advanced.CCR1);
    TEST_ASSERT_EQUAL_UINT32(1500u, general.CCR2);
    TEST_ASSERT_EQUAL_UINT32(1500u, general.CCR3);
    TEST_ASSERT_EQUAL_UINT32(1500u, small.CCR1);
    TEST_ASSERT_EQUAL_UINT32(1500u, small.CCR2);
}

static void PWM_003_too_many_or_none_are_refused(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_pwm_arm(outputs, 0u));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_pwm_arm(outputs, KEEL_PWM_OUTPUTS_MAX + 1u));
    TEST_ASSERT_EQUAL_HEX32(0u, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x00000400u, advanced.BDTR);
}

/* A second call would cut the pulses that are out. */
static void PWM_003_arming_twice_changes_nothing(void)
{
    arm_all();
    general.EGR = 0u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pwm_arm(outputs, COUNT));
    TEST_ASSERT_EQUAL_HEX32(0u, general.EGR);
    TEST_ASSERT_EQUAL_UINT32(1500u, general.CCR2);
}

static void PWM_004_off_is_low_as_a_plain_pin_and_forgets(void)
{
    arm_all();
    port.BSRR = 0u;
    keel_pwm_off(outputs, COUNT);
    TEST_ASSERT_EQUAL_HEX32(0x10051140u, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x01000000u, port.BSRR); /* The last of them, pin 8, cleared. */
    TEST_ASSERT_EQUAL_HEX32(0x00000400u, advanced.BDTR);
    TEST_ASSERT_EQUAL_UINT32(0u, advanced.CCR4 | advanced.CCR1);
    TEST_ASSERT_EQUAL_UINT32(0u, general.CCR2 | general.CCR3);
    TEST_ASSERT_EQUAL_UINT32(0u, small.CCR1 | small.CCR2);
    TEST_ASSERT_EQUAL_HEX32(1u, general.EGR);
}

/* Channels of the same timers that are no outputs stay as they are. */
static void PWM_004_off_is_off_from_any_state(void)
{
    memset(&advanced, 0xFF, sizeof advanced);
    memset(&port, 0xFF, sizeof port);
    keel_pwm_off(outputs, 2u);
    TEST_ASSERT_EQUAL_HEX32(0x00000400u, advanced.BDTR);
    TEST_ASSERT_EQUAL_HEX32(0xDFF7FFFFu, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFBDFFu, port.OTYPER);
    TEST_ASSERT_EQUAL_UINT32(0u, advanced.CCR4 | advanced.CCR1);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFFu, advanced.CCR2);
}

/* Whatever runs in the timers is taken out of them (UG) before the pins become theirs. That the
 * pulses come back only when the pins are given is seen on the model of the chip. */
static void PWM_005_no_part_of_a_pulse_comes_out(void)
{
    arm_all();
    TEST_ASSERT_EQUAL_HEX32(1u, advanced.EGR);
    TEST_ASSERT_EQUAL_HEX32(1u, general.EGR);
    TEST_ASSERT_EQUAL_HEX32(1u, small.EGR);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PWM_001_starts_without_pulses_and_with_the_gate_shut);
    RUN_TEST(PWM_001_a_timer_without_a_gate);
    RUN_TEST(PWM_001_a_timer_with_two_channels);
    RUN_TEST(PWM_001_takes_its_values_over_at_the_start);
    RUN_TEST(PWM_001_rates_out_of_range_are_refused);
    RUN_TEST(PWM_002_each_output_its_own);
    RUN_TEST(PWM_002_pulses_out_of_range_are_refused);
    RUN_TEST(PWM_003_armed_pins_are_their_timers);
    RUN_TEST(PWM_003_too_many_or_none_are_refused);
    RUN_TEST(PWM_003_arming_twice_changes_nothing);
    RUN_TEST(PWM_004_off_is_low_as_a_plain_pin_and_forgets);
    RUN_TEST(PWM_004_off_is_off_from_any_state);
    RUN_TEST(PWM_005_no_part_of_a_pulse_comes_out);
    return UNITY_END();
}
