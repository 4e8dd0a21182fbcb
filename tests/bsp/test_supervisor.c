/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/common/supervisor.h with a real scheduler on a simulated clock. */
#include "common/supervisor.h"
#include "keel/internal/rtos/queue.h"
#include "unity.h"

#include <string.h>

static uint32_t ticks;
static keel_scheduler_t scheduler;
static keel_supervisor_t supervisor;

static uint32_t read_clock(void *context)
{
    (void)context;
    return ticks;
}

static void work(void *context)
{
    (void)context;
    ticks += 10u;
}

static const keel_task_config_t fast = {.name = "fast",
                                        .run = work,
                                        .period_us = 1000u,
                                        .budget_us = 10u,
                                        .priority = KEEL_PRIORITY_REALTIME};
static const keel_task_config_t slow = {.name = "slow",
                                        .run = work,
                                        .period_us = 4000u,
                                        .budget_us = 10u,
                                        .priority = KEEL_PRIORITY_REALTIME};
static const keel_task_config_t other = {.name = "other",
                                         .run = work,
                                         .period_us = 1000u,
                                         .budget_us = 10u,
                                         .priority = KEEL_PRIORITY_LOW};

static void add(const keel_task_config_t *task)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_add(&scheduler, task));
}

void setUp(void)
{
    const keel_scheduler_config_t config = {.read_clock = read_clock,
                                            .guard_us = 10u,
                                            .utilisation_limit_ppm = KEEL_UTILISATION_FULL_PPM};

    ticks = 0u;
    memset(&scheduler, 0, sizeof scheduler);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&scheduler, &config));
    add(&fast);
    add(&slow);
    add(&other);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_start(&scheduler));
    keel_supervisor_start(&supervisor, &scheduler);
}

void tearDown(void)
{
}

static void step_at(uint32_t now_us)
{
    ticks = now_us;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_step(&scheduler));
}

static bool met(void)
{
    return keel_supervisor_met(&supervisor, &scheduler, scheduler.clock.now_us);
}

/* What the scheduler counts of a task, to set it to what it takes long to reach. */
static uint16_t *skipped(const keel_task_config_t *task)
{
    const uint32_t position = keel_queue_find(&scheduler.queue, task);

    return &scheduler.queue.skipped[scheduler.queue.order[position]];
}

static void SUP_001_the_past_before_the_start_does_not_count(void)
{
    step_at(0u);
    step_at(5500u); /* Four periods missed. */
    keel_supervisor_start(&supervisor, &scheduler);
    step_at(6000u);
    TEST_ASSERT_TRUE(met());
}

static void SUP_002_a_scheduler_in_time_is_seen_so(void)
{
    for (uint32_t now_us = 0u; now_us < 20000u; now_us += 500u) {
        step_at(now_us);
        TEST_ASSERT_TRUE(met());
    }
}

static void SUP_003_a_missed_period_is_seen_once(void)
{
    step_at(0u);
    TEST_ASSERT_TRUE(met());
    step_at(2500u); /* The release at 1 ms was missed. */
    TEST_ASSERT_FALSE(met());
    step_at(3000u);
    TEST_ASSERT_TRUE(met());
}

static void SUP_003_a_counter_at_its_end_is_never_in_time(void)
{
    step_at(0u);
    *skipped(&fast) = UINT16_MAX;
    TEST_ASSERT_FALSE(met());
    TEST_ASSERT_FALSE(met());
}

/* One look every 4 ms; the releases between were met or missed. */
static bool look(uint32_t number, bool good)
{
    const uint32_t begin_us = number * 4000u;

    for (uint32_t at_us = good ? 0u : 3000u; at_us < 4000u; at_us += 1000u) {
        step_at(begin_us + at_us);
        step_at(begin_us + at_us + 100u); /* The slow task, when both were due. */
    }
    return met();
}

static void SUP_003_good_looks_between_misses_do_not_hide_them(void)
{
    uint32_t fed = 0u;

    for (uint32_t i = 0u; i < 100u; i++) {
        fed += look(i, (i % 5u) == 0u) ? 1u : 0u;
    }
    TEST_ASSERT_EQUAL_UINT32(1u, fed); /* The very first, before anything was missed. */
}

static void SUP_003_every_other_look_adds_up(void)
{
    /* Weights after each pair: 2 then 1, 3 then 2, 4 then 3, 5 then 4, 6 then 5, 7 then 6. */
    for (uint32_t i = 0u; i < 12u; i++) {
        TEST_ASSERT_EQUAL(((i % 2u) == 1u) && (i < 11u), look(i, (i % 2u) == 1u));
    }
}

static void SUP_003_one_miss_in_three_is_borne(void)
{
    for (uint32_t i = 0u; i < 300u; i++) {
        TEST_ASSERT_EQUAL((i % 3u) != 0u, look(i, (i % 3u) != 0u));
    }
}

static void SUP_003_a_bad_time_is_forgotten(void)
{
    for (uint32_t i = 0u; i < 20u; i++) {
        TEST_ASSERT_FALSE(look(i, false));
    }
    /* From 12 down to 6 in six looks, below it with the seventh. */
    for (uint32_t i = 20u; i < 30u; i++) {
        TEST_ASSERT_EQUAL(i >= 26u, look(i, true));
    }
}

static void SUP_003_others_may_miss_theirs(void)
{
    step_at(0u);
    *skipped(&other) = 5u;
    TEST_ASSERT_TRUE(met());
}

static void SUP_004_a_task_that_waits_beyond_its_deadline(void)
{
    step_at(0u);
    /* The fast task's next release is at 1 ms, its deadline at 2 ms. */
    TEST_ASSERT_TRUE(keel_supervisor_met(&supervisor, &scheduler, 1999u));
    TEST_ASSERT_FALSE(keel_supervisor_met(&supervisor, &scheduler, 2000u));
}

static void SUP_005_a_task_that_went_away(void)
{
    step_at(0u);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &slow));
    TEST_ASSERT_FALSE(met());
}

static void SUP_005_no_task_at_all_is_not_in_time(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &slow));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &fast));
    keel_supervisor_start(&supervisor, &scheduler);
    TEST_ASSERT_FALSE(met());
}

static void SUP_002_a_single_task_is_enough(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &slow));
    keel_supervisor_start(&supervisor, &scheduler);
    step_at(0u);
    TEST_ASSERT_TRUE(met());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SUP_001_the_past_before_the_start_does_not_count);
    RUN_TEST(SUP_002_a_scheduler_in_time_is_seen_so);
    RUN_TEST(SUP_003_a_missed_period_is_seen_once);
    RUN_TEST(SUP_003_a_counter_at_its_end_is_never_in_time);
    RUN_TEST(SUP_003_good_looks_between_misses_do_not_hide_them);
    RUN_TEST(SUP_003_every_other_look_adds_up);
    RUN_TEST(SUP_003_one_miss_in_three_is_borne);
    RUN_TEST(SUP_003_a_bad_time_is_forgotten);
    RUN_TEST(SUP_003_others_may_miss_theirs);
    RUN_TEST(SUP_004_a_task_that_waits_beyond_its_deadline);
    RUN_TEST(SUP_005_a_task_that_went_away);
    RUN_TEST(SUP_005_no_task_at_all_is_not_in_time);
    RUN_TEST(SUP_002_a_single_task_is_enough);
    return UNITY_END();
}
