/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/task.h. Expected values are worked out by hand. */
#include "keel/rtos/task.h"
#include "unity.h"

#include <string.h>

static void body(void *context)
{
    (void)context;
}

static keel_task_config_t config;

void setUp(void)
{
    memset(&config, 0, sizeof config);
    config.run = body;
    config.period_us = 100u;
    config.budget_us = 10u;
    config.phase_us = 7u;
    config.priority = KEEL_PRIORITY_LOW;
}

void tearDown(void)
{
}

static void TSK_002_valid_declarations_pass(void)
{
    static const uint32_t priorities[] = {1u, 2u, 3u, 4u, 16u};

    for (size_t i = 0u; i < (sizeof priorities / sizeof priorities[0]); i++) {
        config.priority = priorities[i];
        TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    }
}

static void TSK_002_null_is_refused(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_task_check(NULL));
    config.run = NULL;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_task_check(&config));
}

static void TSK_002_period_at_its_limits(void)
{
    config.phase_us = 0u;
    config.period_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
    config.period_us = 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.period_us = 0x7FFFFFFFu;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.period_us = 0x80000000u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
    config.period_us = UINT32_MAX;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
}

static void TSK_002_phase_at_its_limit(void)
{
    config.phase_us = 99u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.phase_us = 100u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PHASE, keel_task_check(&config));
    config.phase_us = UINT32_MAX;
    TEST_ASSERT_EQUAL(KEEL_ERR_PHASE, keel_task_check(&config));
}

static void TSK_002_budget_at_its_limit(void)
{
    config.budget_us = 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.budget_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_BUDGET_ZERO, keel_task_check(&config));
}

static void TSK_002_unknown_priorities_are_refused(void)
{
    static const uint32_t wrong[] = {0u, 5u, 15u, 17u, UINT32_MAX};

    for (size_t i = 0u; i < (sizeof wrong / sizeof wrong[0]); i++) {
        config.priority = wrong[i];
        TEST_ASSERT_EQUAL(KEEL_ERR_PRIORITY, keel_task_check(&config));
    }
}

/* Everything is wrong at first; mending one thing at a time brings out the next reason. */
static void TSK_002_first_reason_is_reported(void)
{
    config = (keel_task_config_t){NULL, NULL, NULL, 0u, 0u, 100u, 0u};
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_task_check(&config));
    config.run = body;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
    config.period_us = 100u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PHASE, keel_task_check(&config));
    config.phase_us = 99u;
    TEST_ASSERT_EQUAL(KEEL_ERR_BUDGET_ZERO, keel_task_check(&config));
    config.budget_us = 1u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PRIORITY, keel_task_check(&config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(TSK_002_valid_declarations_pass);
    RUN_TEST(TSK_002_null_is_refused);
    RUN_TEST(TSK_002_period_at_its_limits);
    RUN_TEST(TSK_002_phase_at_its_limit);
    RUN_TEST(TSK_002_budget_at_its_limit);
    RUN_TEST(TSK_002_unknown_priorities_are_refused);
    RUN_TEST(TSK_002_first_reason_is_reported);
    return UNITY_END();
}
