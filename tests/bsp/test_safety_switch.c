/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/safety_switch.h. Times are those of its header, counted by hand. */
#include "devices/safety_switch.h"
#include "unity.h"

#include <string.h>

#define STEP_US 1000u

static keel_safety_switch_t safety;

void setUp(void)
{
    memset(&safety, 0x55, sizeof safety);
    keel_safety_switch_init(&safety);
}

void tearDown(void)
{
}

/* Steps of a millisecond each; how often the switch changed. */
static uint32_t step_for(bool pressed, uint32_t ms)
{
    uint32_t changes = 0u;

    for (uint32_t i = 0u; i < ms; i++) {
        changes += keel_safety_switch_step(&safety, pressed, STEP_US) ? 1u : 0u;
    }
    return changes;
}

static void SAF_001_it_begins_safe(void)
{
    TEST_ASSERT_TRUE(safety.is_safe);
    TEST_ASSERT_TRUE(safety.is_pressed);
    TEST_ASSERT_FALSE(safety.was_released);
    TEST_ASSERT_EQUAL_UINT32(0u, safety.held_us);
}

static void SAF_001_a_button_pressed_since_the_start_changes_nothing(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 5000u));
    TEST_ASSERT_TRUE(safety.is_safe);
    /* Once it was released, it does. */
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(false, 30u));
    TEST_ASSERT_EQUAL_UINT32(1u, step_for(true, 1500u));
}

/* The reading of the press begins a time; 20 steps settle it, and 1000 more hold it. */
static void SAF_002_a_second_changes_it(void)
{
    (void)step_for(false, 100u);
    TEST_ASSERT_FALSE(safety.is_pressed);
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 20u));
    TEST_ASSERT_FALSE(safety.is_pressed);
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 1u));
    TEST_ASSERT_TRUE(safety.is_pressed);
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 999u));
    TEST_ASSERT_TRUE(safety.is_safe);
    TEST_ASSERT_TRUE(keel_safety_switch_step(&safety, true, STEP_US));
    TEST_ASSERT_FALSE(safety.is_safe);
}

static void SAF_002_and_back(void)
{
    (void)step_for(false, 100u);
    TEST_ASSERT_EQUAL_UINT32(1u, step_for(true, 1100u));
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(false, 100u));
    TEST_ASSERT_FALSE(safety.is_safe);
    TEST_ASSERT_EQUAL_UINT32(1u, step_for(true, 1100u));
    TEST_ASSERT_TRUE(safety.is_safe);
}

static void SAF_002_a_press_changes_it_once(void)
{
    (void)step_for(false, 100u);
    TEST_ASSERT_EQUAL_UINT32(1u, step_for(true, 60000u));
    TEST_ASSERT_FALSE(safety.is_safe);
}

static void SAF_002_short_presses_do_not_add_up(void)
{
    (void)step_for(false, 100u);
    for (uint32_t i = 0u; i < 10u; i++) {
        TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 900u));
        TEST_ASSERT_EQUAL_UINT32(0u, step_for(false, 30u));
    }
    TEST_ASSERT_TRUE(safety.is_safe);
}

/* Contacts bounce for some milliseconds, when they close and when they open. */
static void SAF_003_bounces_neither_begin_nor_end_a_press(void)
{
    (void)step_for(false, 100u);
    for (uint32_t i = 0u; i < 100u; i++) {
        TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 20u)); /* One step too short to count. */
        TEST_ASSERT_EQUAL_UINT32(0u, step_for(false, 1u));
        TEST_ASSERT_FALSE(safety.is_pressed);
    }
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 500u));
    for (uint32_t i = 0u; i < 10u; i++) {
        TEST_ASSERT_EQUAL_UINT32(0u, step_for(false, 20u));
        TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 1u));
        TEST_ASSERT_TRUE(safety.is_pressed);
    }
    /* 479 ms since it settled, and 210 ms of bounces: 311 are left. */
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 310u));
    TEST_ASSERT_EQUAL_UINT32(1u, step_for(true, 1u));
}

static void SAF_003_a_release_is_as_settled_as_a_press(void)
{
    (void)step_for(false, 100u);
    TEST_ASSERT_EQUAL_UINT32(1u, step_for(true, 1100u));
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(false, 20u)); /* Not yet released … */
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(true, 3000u));
    TEST_ASSERT_FALSE(safety.is_safe);
    TEST_ASSERT_EQUAL_UINT32(0u, step_for(false, 21u)); /* … and now it is. */
    TEST_ASSERT_EQUAL_UINT32(1u, step_for(true, 1100u));
}

/* Two readings far apart are not a press, nor does a late step make one of a touch. */
static void SAF_004_late_steps_make_the_hold_longer(void)
{
    (void)step_for(false, 100u);
    TEST_ASSERT_FALSE(keel_safety_switch_step(&safety, true, 5000000u));
    TEST_ASSERT_FALSE(safety.is_pressed);
    TEST_ASSERT_FALSE(keel_safety_switch_step(&safety, true, 5000000u));
    TEST_ASSERT_TRUE(safety.is_pressed);
    for (uint32_t i = 0u; i < 49u; i++) { /* 20 ms each. */
        TEST_ASSERT_FALSE(keel_safety_switch_step(&safety, true, UINT32_MAX));
    }
    TEST_ASSERT_TRUE(keel_safety_switch_step(&safety, true, UINT32_MAX));
}

static void SAF_004_the_time_held_stays_at_its_end(void)
{
    (void)step_for(false, 100u);
    safety.held_us = UINT32_MAX - 1u;
    (void)keel_safety_switch_step(&safety, false, STEP_US);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, safety.held_us);
}

static void SAF_005_the_light(void)
{
    uint32_t lit = 0u;

    for (uint32_t i = 0u; i < 1000u; i++) {
        const bool was = keel_safety_switch_is_lit(&safety);

        TEST_ASSERT_EQUAL(i < 500u, was); /* Half a second, then dark for another one. */
        lit += was ? 1u : 0u;
        (void)step_for(false, 1u);
    }
    TEST_ASSERT_EQUAL_UINT32(500u, lit);
    TEST_ASSERT_TRUE(keel_safety_switch_is_lit(&safety)); /* And again. */
    (void)step_for(true, 1100u);
    for (uint32_t i = 0u; i < 2000u; i++) {
        TEST_ASSERT_TRUE(keel_safety_switch_is_lit(&safety));
        (void)step_for(false, 1u);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SAF_001_it_begins_safe);
    RUN_TEST(SAF_001_a_button_pressed_since_the_start_changes_nothing);
    RUN_TEST(SAF_002_a_second_changes_it);
    RUN_TEST(SAF_002_and_back);
    RUN_TEST(SAF_002_a_press_changes_it_once);
    RUN_TEST(SAF_002_short_presses_do_not_add_up);
    RUN_TEST(SAF_003_bounces_neither_begin_nor_end_a_press);
    RUN_TEST(SAF_003_a_release_is_as_settled_as_a_press);
    RUN_TEST(SAF_004_late_steps_make_the_hold_longer);
    RUN_TEST(SAF_004_the_time_held_stays_at_its_end);
    RUN_TEST(SAF_005_the_light);
    return UNITY_END();
}
