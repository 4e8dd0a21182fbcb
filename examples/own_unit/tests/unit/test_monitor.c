/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of battery/monitor.h. */
#include "battery/monitor.h"
#include "keel/rtos/scheduler.h"
#include "unity.h"

static battery_monitor_t monitor;
static uint16_t voltage_mv;
static bool land;

/* The body of the task: takes what the converter read. */
static void watch_battery(void *context)
{
    land = battery_monitor_step(context, voltage_mv);
}

/* Ten times a second, for at most 100 us. */
static const keel_task_config_t task = {
    .name = "battery",
    .run = watch_battery,
    .context = &monitor,
    .period_us = 100000u,
    .budget_us = 100u,
    .priority = 2u,
};

void setUp(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, battery_monitor_init(&monitor, 14000u));
    land = false;
}

void tearDown(void)
{
}

static bool after(uint16_t sample_mv, uint32_t samples)
{
    bool alarm = false;

    for (uint32_t i = 0u; i < samples; i++) {
        alarm = battery_monitor_step(&monitor, sample_mv);
    }
    return alarm;
}

static void BAT_002_four_low_samples_raise_no_alarm(void)
{
    TEST_ASSERT_FALSE(after(13999u, 4u));
    TEST_ASSERT_FALSE(after(14000u, 1u));
    TEST_ASSERT_FALSE(after(13999u, 4u));
}

static void BAT_002_five_do_and_it_stays(void)
{
    TEST_ASSERT_TRUE(after(13999u, 5u));
    TEST_ASSERT_TRUE(after(16800u, 100u));
}

static void BAT_001_a_limit_of_0_is_refused(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, battery_monitor_init(&monitor, 0u));
    TEST_ASSERT_EQUAL(14000u, monitor.limit_mv);
}

static void BAT_002_as_a_task_of_keel(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&task));
    voltage_mv = 0u;
    for (uint32_t i = 0u; i < 5u; i++) {
        TEST_ASSERT_FALSE(land);
        task.run(task.context);
    }
    TEST_ASSERT_TRUE(land);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(BAT_001_a_limit_of_0_is_refused);
    RUN_TEST(BAT_002_four_low_samples_raise_no_alarm);
    RUN_TEST(BAT_002_five_do_and_it_stays);
    RUN_TEST(BAT_002_as_a_task_of_keel);
    return UNITY_END();
}
