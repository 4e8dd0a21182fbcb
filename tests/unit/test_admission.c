/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/admission.h: each rule where it just holds and one microsecond beyond. */
#include "keel/internal/rtos/admission.h"
#include "unity.h"

#include <string.h>

static keel_admission_t admission;

void setUp(void)
{
    memset(&admission, 0, sizeof admission);
}

void tearDown(void)
{
}

static keel_status_t admit(uint32_t priority, uint32_t period_us, uint32_t budget_us)
{
    return keel_admission_admit(&admission, priority, period_us, budget_us);
}

static void begin(uint32_t guard_us)
{
    keel_admission_init(&admission, guard_us, KEEL_UTILISATION_FULL_PPM);
}

static void admitted(uint32_t priority, uint32_t period_us, uint32_t budget_us)
{
    TEST_ASSERT_EQUAL(KEEL_OK, admit(priority, period_us, budget_us));
}

static void refused(keel_status_t reason, uint32_t priority, uint32_t period_us, uint32_t budget_us)
{
    keel_admission_t before;

    memcpy(&before, &admission, sizeof before);
    TEST_ASSERT_EQUAL(reason, admit(priority, period_us, budget_us));
    TEST_ASSERT_EQUAL_MEMORY(&before, &admission, sizeof admission);
}

static void ADM_001_begins_with_an_empty_set(void)
{
    memset(&admission, 0xA5, sizeof admission);
    keel_admission_init(&admission, 25u, 690000u);
    TEST_ASSERT_EQUAL_UINT64(25u, admission.guard_us);
    TEST_ASSERT_EQUAL_UINT64(690000u, admission.utilisation_limit_ppm);
    TEST_ASSERT_EQUAL_UINT64(0u, admission.utilisation_ppm);
    TEST_ASSERT_EQUAL_UINT64(0u, admission.realtime_demand_us);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, admission.shortest_realtime_us);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, admission.shortest_gap_us);
    TEST_ASSERT_EQUAL_UINT64(0u, admission.longest_other_us);
    TEST_ASSERT_EQUAL_UINT64(0u, admission.tasks);
}

static void ADM_002_totals_of_a_set(void)
{
    begin(5u);
    admitted(KEEL_PRIORITY_REALTIME, 1000u, 100u); /* 10 %, leaves 900 */
    admitted(KEEL_PRIORITY_LOW, 3000u, 50u);       /* 1.66667 %, rounded up */
    admitted(KEEL_PRIORITY_REALTIME, 500u, 20u);   /* 4 %, leaves 480 */
    admitted(KEEL_PRIORITY_HIGH, 2000u, 40u);      /* 2 % */
    TEST_ASSERT_EQUAL_UINT64(176667u, admission.utilisation_ppm);
    TEST_ASSERT_EQUAL_UINT64(120u, admission.realtime_demand_us);
    TEST_ASSERT_EQUAL_UINT64(500u, admission.shortest_realtime_us);
    TEST_ASSERT_EQUAL_UINT64(480u, admission.shortest_gap_us);
    TEST_ASSERT_EQUAL_UINT64(50u, admission.longest_other_us);
    TEST_ASSERT_EQUAL_UINT64(4u, admission.tasks);
    TEST_ASSERT_EQUAL_UINT64(5u, admission.guard_us);
    TEST_ASSERT_EQUAL_UINT64(KEEL_UTILISATION_FULL_PPM, admission.utilisation_limit_ppm);
}

static void ADM_002_shortest_period_and_gap_may_be_of_different_tasks(void)
{
    begin(0u);
    admitted(KEEL_PRIORITY_REALTIME, 1000u, 100u); /* leaves 900 */
    admitted(KEEL_PRIORITY_REALTIME, 1100u, 300u); /* leaves 800 */
    TEST_ASSERT_EQUAL_UINT64(1000u, admission.shortest_realtime_us);
    TEST_ASSERT_EQUAL_UINT64(800u, admission.shortest_gap_us);
}

static void ADM_003_demand_of_one_task(void)
{
    begin(100u);
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 300u, 101u);
    admitted(KEEL_PRIORITY_REALTIME, 300u, 100u); /* 100 + 2 * 100 = 300 */
}

static void ADM_003_demand_of_the_smallest_budget(void)
{
    begin(1u);
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 2u, 1u);
    admitted(KEEL_PRIORITY_REALTIME, 3u, 1u); /* 1 + 2 * 1 = 3 */
}

static void ADM_003_demand_adds_up_against_the_shortest_period(void)
{
    begin(25u);
    admitted(KEEL_PRIORITY_REALTIME, 200u, 100u);
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 100000u, 51u);
    admitted(KEEL_PRIORITY_REALTIME, 100000u, 50u); /* 150 + 50 = 200 */
}

static void ADM_003_demand_against_the_new_task_s_period(void)
{
    begin(25u);
    admitted(KEEL_PRIORITY_REALTIME, 100000u, 100u);
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 199u, 50u);
    admitted(KEEL_PRIORITY_REALTIME, 200u, 50u);
}

static void ADM_003_budget_beyond_the_period_is_a_demand(void)
{
    begin(0u);
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 100u, 101u);
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 1u, UINT32_MAX);
    admitted(KEEL_PRIORITY_REALTIME, 100u, 100u);
}

static void ADM_003_others_make_no_demand(void)
{
    begin(0x7FFFFFFFu);
    admitted(KEEL_PRIORITY_LOW, 1000u, 100u);
    TEST_ASSERT_EQUAL_UINT64(0u, admission.realtime_demand_us);
}

static void ADM_003_gap_with_the_other_task_last(void)
{
    begin(40u);
    admitted(KEEL_PRIORITY_REALTIME, 200u, 100u); /* leaves 100 */
    refused(KEEL_ERR_BUDGET_GAP, KEEL_PRIORITY_LOW, 10000u, 61u);
    admitted(KEEL_PRIORITY_LOW, 10000u, 60u);
}

static void ADM_003_gap_with_the_realtime_task_last(void)
{
    begin(40u);
    admitted(KEEL_PRIORITY_LOW, 10000u, 60u);
    refused(KEEL_ERR_BUDGET_GAP, KEEL_PRIORITY_REALTIME, 200u, 101u);
    admitted(KEEL_PRIORITY_REALTIME, 200u, 100u);
}

static void ADM_003_a_longer_period_than_the_shortest_may_leave_no_gap(void)
{
    begin(0u);
    admitted(KEEL_PRIORITY_REALTIME, 1000u, 100u);
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 2000u, 2000u);
}

static void ADM_003_gap_of_the_longest_budget_counts(void)
{
    begin(40u);
    admitted(KEEL_PRIORITY_LOW, 10000u, 60u);
    admitted(KEEL_PRIORITY_LOW, 10000u, 20u);
    refused(KEEL_ERR_BUDGET_GAP, KEEL_PRIORITY_REALTIME, 199u, 100u);
    admitted(KEEL_PRIORITY_REALTIME, 200u, 100u);
}

static void ADM_003_no_gap_at_all(void)
{
    begin(0u);
    admitted(KEEL_PRIORITY_REALTIME, 100u, 100u);
    refused(KEEL_ERR_BUDGET_GAP, KEEL_PRIORITY_LOW, 1000000u, 1u);
}

static void ADM_003_without_realtime_every_budget_has_a_gap(void)
{
    begin(0x7FFFFFFFu);
    admitted(KEEL_PRIORITY_LOW, 0x7FFFFFFFu, 0x7FFFFFFFu);
}

static void ADM_003_utilisation_just_at_its_limit(void)
{
    begin(0u);
    for (int i = 0; i < 4; i++) {
        admitted(KEEL_PRIORITY_LOW, 1000u, 250u);
    }
    TEST_ASSERT_EQUAL_UINT64(KEEL_UTILISATION_FULL_PPM, admission.utilisation_ppm);
    refused(KEEL_ERR_UTILISATION, KEEL_PRIORITY_LOW, 0x7FFFFFFFu, 1u);
}

static void ADM_003_utilisation_rounds_each_task_up(void)
{
    keel_admission_init(&admission, 0u, 333333u);
    refused(KEEL_ERR_UTILISATION, KEEL_PRIORITY_LOW, 3u, 1u);
    keel_admission_init(&admission, 0u, 333334u);
    admitted(KEEL_PRIORITY_LOW, 3u, 1u);
    begin(0u);
    admitted(KEEL_PRIORITY_LOW, 3u, 1u);
    admitted(KEEL_PRIORITY_LOW, 3u, 1u);
    refused(KEEL_ERR_UTILISATION, KEEL_PRIORITY_LOW, 3u, 1u); /* 1000002 ppm */
}

static void ADM_003_smallest_and_largest_utilisation(void)
{
    begin(0u);
    refused(KEEL_ERR_UTILISATION, KEEL_PRIORITY_LOW, 1u, UINT32_MAX);
    refused(KEEL_ERR_UTILISATION, KEEL_PRIORITY_LOW, 1000u, 1001u);
    admitted(KEEL_PRIORITY_LOW, 0x7FFFFFFFu, 1u);
    TEST_ASSERT_EQUAL_UINT64(1u, admission.utilisation_ppm);
}

static void ADM_003_first_reason_is_reported(void)
{
    keel_admission_init(&admission, 10u, 500000u);
    admitted(KEEL_PRIORITY_LOW, 1000u, 70u);
    /* 81 + 20 > 100; 70 + 10 > 19; 88 %. */
    refused(KEEL_ERR_REALTIME_DEMAND, KEEL_PRIORITY_REALTIME, 100u, 81u);
    /* 80 + 20 = 100; 70 + 10 > 20; 87 %. */
    refused(KEEL_ERR_BUDGET_GAP, KEEL_PRIORITY_REALTIME, 100u, 80u);
    /* 100 + 20 < 180; 70 + 10 = 80; 62.6 %. */
    refused(KEEL_ERR_UTILISATION, KEEL_PRIORITY_REALTIME, 180u, 100u);
}

static keel_queue_t queue;
static keel_task_config_t config[3];

static void body(void *context)
{
    (void)context;
}

static keel_task_config_t declare(uint32_t priority, uint32_t period_us, uint32_t budget_us)
{
    const keel_task_config_t config = {NULL, body, NULL, period_us, budget_us, 0u, priority};

    return config;
}

/* A queue of three tasks; the one at a position has the given declaration, the others suit. */
static void queue_with(uint32_t position, keel_task_config_t misfit)
{
    keel_queue_init(&queue);
    config[0] = declare(KEEL_PRIORITY_REALTIME, 1000u, 100u);
    config[1] = declare(KEEL_PRIORITY_REALTIME, 2000u, 100u);
    config[2] = declare(KEEL_PRIORITY_LOW, 1000u, 10u);
    config[position] = misfit;
    for (uint32_t i = 0u; i < 3u; i++) {
        keel_queue_add(&queue, &config[i], 0u);
    }
    begin(10u);
}

static void ADM_004_all_are_admitted(void)
{
    queue_with(0u, declare(KEEL_PRIORITY_REALTIME, 1000u, 100u));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_admission_queue(&admission, &queue));
    TEST_ASSERT_EQUAL_UINT64(3u, admission.tasks);
    TEST_ASSERT_EQUAL_UINT64(160000u, admission.utilisation_ppm);
    TEST_ASSERT_EQUAL_UINT64(200u, admission.realtime_demand_us);
}

static void ADM_004_empty_queue_is_admitted(void)
{
    keel_queue_init(&queue);
    begin(10u);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_admission_queue(&admission, &queue));
    TEST_ASSERT_EQUAL_UINT64(0u, admission.tasks);
}

static void ADM_004_offender_is_named(void)
{
    queue_with(0u, declare(KEEL_PRIORITY_REALTIME, 1000u, 981u));
    TEST_ASSERT_EQUAL(KEEL_ERR_REALTIME_DEMAND, keel_admission_queue(&admission, &queue));
    TEST_ASSERT_EQUAL_UINT64(0u, admission.tasks);
    queue_with(1u, declare(KEEL_PRIORITY_REALTIME, 2000u, 881u));
    TEST_ASSERT_EQUAL(KEEL_ERR_REALTIME_DEMAND, keel_admission_queue(&admission, &queue));
    TEST_ASSERT_EQUAL_UINT64(1u, admission.tasks);
    queue_with(2u, declare(KEEL_PRIORITY_LOW, 10000u, 891u));
    TEST_ASSERT_EQUAL(KEEL_ERR_BUDGET_GAP, keel_admission_queue(&admission, &queue));
    TEST_ASSERT_EQUAL_UINT64(2u, admission.tasks);
    queue_with(2u, declare(KEEL_PRIORITY_LOW, 1000u, 851u)); /* 15 % + 85.1 % */
    TEST_ASSERT_EQUAL(KEEL_ERR_UTILISATION, keel_admission_queue(&admission, &queue));
    TEST_ASSERT_EQUAL_UINT64(2u, admission.tasks);
}

static void ADM_004_queue_is_left_alone(void)
{
    keel_queue_t before;

    queue_with(1u, declare(KEEL_PRIORITY_REALTIME, 2000u, 881u));
    memcpy(&before, &queue, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_REALTIME_DEMAND, keel_admission_queue(&admission, &queue));
    TEST_ASSERT_EQUAL_MEMORY(&before, &queue, sizeof queue);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ADM_001_begins_with_an_empty_set);
    RUN_TEST(ADM_002_totals_of_a_set);
    RUN_TEST(ADM_002_shortest_period_and_gap_may_be_of_different_tasks);
    RUN_TEST(ADM_003_demand_of_one_task);
    RUN_TEST(ADM_003_demand_of_the_smallest_budget);
    RUN_TEST(ADM_003_demand_adds_up_against_the_shortest_period);
    RUN_TEST(ADM_003_demand_against_the_new_task_s_period);
    RUN_TEST(ADM_003_budget_beyond_the_period_is_a_demand);
    RUN_TEST(ADM_003_others_make_no_demand);
    RUN_TEST(ADM_003_gap_with_the_other_task_last);
    RUN_TEST(ADM_003_gap_with_the_realtime_task_last);
    RUN_TEST(ADM_003_a_longer_period_than_the_shortest_may_leave_no_gap);
    RUN_TEST(ADM_003_gap_of_the_longest_budget_counts);
    RUN_TEST(ADM_003_no_gap_at_all);
    RUN_TEST(ADM_003_without_realtime_every_budget_has_a_gap);
    RUN_TEST(ADM_003_utilisation_just_at_its_limit);
    RUN_TEST(ADM_003_utilisation_rounds_each_task_up);
    RUN_TEST(ADM_003_smallest_and_largest_utilisation);
    RUN_TEST(ADM_003_first_reason_is_reported);
    RUN_TEST(ADM_004_all_are_admitted);
    RUN_TEST(ADM_004_empty_queue_is_admitted);
    RUN_TEST(ADM_004_offender_is_named);
    RUN_TEST(ADM_004_queue_is_left_alone);
    return UNITY_END();
}
