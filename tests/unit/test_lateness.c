/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/lateness.h. Bounds are worked out by hand from the sentences of ISO-001
 * and ISO-002. A to D are real-time with a period of 1000 us and budgets of 10, 20, 30 and 40 us;
 * O and P are not, with 2000 us, 50 and 60 us. The guard is 5 us. */
#include "actors.h"
#include "keel/rtos/lateness.h"

static keel_lateness_t lateness;

void setUp(void)
{
    board_reset(0u);
    board_init(5u);
}

void tearDown(void)
{
}

#define tells(actor, unpromoted_us, late_us)                                                       \
    tells_at((actor), (unpromoted_us), (late_us), true, false, __LINE__)
#define tells_skipping(actor, unpromoted_us, late_us)                                              \
    tells_at((actor), (unpromoted_us), (late_us), true, true, __LINE__)
#define tells_for_ever(actor, late_us)                                                             \
    tells_at((actor), (late_us), (late_us), false, false, __LINE__)

static void tells_at(const actor_t *actor, uint64_t unpromoted_us, uint64_t late_us, bool promotes,
                     bool skips, int line)
{
    memset(&lateness, 0x55, sizeof lateness);
    succeeds(keel_scheduler_lateness(&scheduler, &actor->config, &lateness), line);
    UNITY_TEST_ASSERT_EQUAL_UINT64(unpromoted_us, lateness.unpromoted_us, line, "unpromoted");
    UNITY_TEST_ASSERT_EQUAL_UINT64(late_us, lateness.late_us, line, "late");
    UNITY_TEST_ASSERT_EQUAL_UINT(promotes, lateness.promotes, line, "promotes");
    UNITY_TEST_ASSERT_EQUAL_UINT(skips, lateness.skips, line, "skips");
}

static void refuses(keel_status_t expected, const keel_scheduler_t *asked,
                    const keel_task_config_t *task)
{
    keel_lateness_t before;

    memset(&lateness, 0x55, sizeof lateness);
    memcpy(&before, &lateness, sizeof before);
    memcpy(&scheduler_before, &scheduler, sizeof scheduler);
    TEST_ASSERT_EQUAL(expected, keel_scheduler_lateness(asked, task, &lateness));
    TEST_ASSERT_EQUAL_MEMORY(&before, &lateness, sizeof before);
    TEST_ASSERT_EQUAL_MEMORY(&scheduler_before, &scheduler, sizeof scheduler);
}

/* Two real-time tasks of 50 us, every 1000 and 1001 us, and one other of 700 us every 10 ms. */
static void add_two_beside_a_long_one(void)
{
    a.config.budget_us = 50u;
    b.config.budget_us = 50u;
    b.config.period_us = 1001u;
    o.config.budget_us = 700u;
    o.config.period_us = 10000u;
    add(&a);
    add(&o);
    add(&b);
}

/* As long as nothing is promoted, the other's 50 and 5. Else 2 x 50 + 2 x 5 + 700 = 810 pass
 * between two looks, which a period of 1000 holds: less the own 50. */
static void LAT_001_two_beside_a_long_one(void)
{
    add_two_beside_a_long_one();
    tells(&a, 55u, 760u);
    tells(&b, 55u, 760u);
}

static void LAT_001_without_promotion_the_stronger_bound_holds(void)
{
    board_init_without_promotion(5u);
    add_two_beside_a_long_one();
    tells_for_ever(&a, 55u);
    tells_for_ever(&b, 55u);
}

/* 20 + 30 for A, 10 + 30 for B, 10 + 20 for C. Nothing can be promoted. */
static void LAT_001_real_time_tasks_alone(void)
{
    add(&a);
    add(&b);
    add(&c);
    tells_for_ever(&a, 55u);
    tells_for_ever(&b, 45u);
    tells_for_ever(&c, 35u);
}

static void LAT_001_a_task_by_itself_waits_for_the_guard(void)
{
    add(&d);
    tells_for_ever(&d, 5u);
}

/* P's 60 is the longest other budget, wherever it stands; 10 + 20 + 10 + 60 = 100. */
static void LAT_001_the_longest_other_budget_counts(void)
{
    add(&p);
    add(&o);
    add(&a);
    add(&b);
    tells(&a, 25u, 90u);
    tells(&b, 15u, 80u);
    discard(&p);
    tells(&a, 25u, 80u);
    tells(&b, 15u, 70u);
}

/* 10 + 20 + 10 + 60 = 100: a period of 100 us holds that, one of 99 does not, and A's own 10 count.
 * B's bound does not depend on A's period. */
static void LAT_001_a_period_that_is_too_short(void)
{
    a.config.period_us = 100u;
    add(&a);
    add(&b);
    add(&p);
    tells(&a, 25u, 90u);
    discard(&a);
    a.config.period_us = 99u;
    add(&a);
    tells_skipping(&a, 25u, 100u);
    tells(&b, 15u, 80u);
}

/* Without promotion nothing is skipped: ISO-001 does not ask for that period. */
static void LAT_001_no_period_is_too_short_without_promotion(void)
{
    board_init_without_promotion(5u);
    a.config.period_us = 99u;
    add(&a);
    add(&b);
    add(&p);
    tells_for_ever(&a, 25u);
}

/* 10^9 + 2 x 5 x 10^8 + 6 x 10^8 = 2.6 x 10^9, more than any period. */
static void LAT_001_sums_exceed_31_bits(void)
{
    const uint32_t longest_us = (uint32_t)(KEEL_PERIOD_LIMIT_US - 1u);

    board_init(500000000u);
    a.config.period_us = longest_us;
    a.config.budget_us = 1000000000u;
    o.config.period_us = longest_us;
    o.config.budget_us = 600000000u;
    add(&a);
    add(&o);
    tells_skipping(&a, 500000000u, 2600000000u);
}

/* The answer is that of the present tasks, in flight as before it. */
static void LAT_001_asked_in_flight(void)
{
    add(&a);
    add(&o);
    start();
    tells(&a, 5u, 60u);
    add(&b);
    tells(&a, 25u, 80u);
    discard(&o);
    tells_for_ever(&a, 25u);
}

static void LAT_002_other_tasks_have_no_bound(void)
{
    add(&a);
    add(&o);
    tells_skipping(&o, KEEL_TIME_NEVER_US, KEEL_TIME_NEVER_US);
    board_init_without_promotion(5u);
    add(&o);
    tells_at(&o, KEEL_TIME_NEVER_US, KEEL_TIME_NEVER_US, false, true, __LINE__);
}

static void LAT_003_refuses_null(void)
{
    add(&a);
    refuses(KEEL_ERR_NULL, NULL, &a.config);
    refuses(KEEL_ERR_NULL, &scheduler, NULL);
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_lateness(&scheduler, &a.config, NULL));
}

static void LAT_003_refuses_a_task_that_is_not_queued(void)
{
    add(&a);
    refuses(KEEL_ERR_UNKNOWN_TASK, &scheduler, &b.config);
    b.config.budget_us = 2000u;
    add(&b);
    refuses(KEEL_ERR_UNKNOWN_TASK, &scheduler, &c.config); /* Before what is wrong with the set. */
}

/* 990 + 10 + 2 x 5 exceed 1000; without B, O's 990 and 5 exceed the gap of 990 that A leaves. */
static void LAT_003_refuses_a_set_that_is_not_admitted(void)
{
    b.config.budget_us = 990u;
    add(&a);
    add(&b);
    refuses(KEEL_ERR_REALTIME_DEMAND, &scheduler, &a.config);
    discard(&b);
    o.config.budget_us = 990u;
    add(&o);
    refuses(KEEL_ERR_BUDGET_GAP, &scheduler, &a.config);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(LAT_001_two_beside_a_long_one);
    RUN_TEST(LAT_001_without_promotion_the_stronger_bound_holds);
    RUN_TEST(LAT_001_real_time_tasks_alone);
    RUN_TEST(LAT_001_a_task_by_itself_waits_for_the_guard);
    RUN_TEST(LAT_001_the_longest_other_budget_counts);
    RUN_TEST(LAT_001_a_period_that_is_too_short);
    RUN_TEST(LAT_001_no_period_is_too_short_without_promotion);
    RUN_TEST(LAT_001_sums_exceed_31_bits);
    RUN_TEST(LAT_001_asked_in_flight);
    RUN_TEST(LAT_002_other_tasks_have_no_bound);
    RUN_TEST(LAT_003_refuses_null);
    RUN_TEST(LAT_003_refuses_a_task_that_is_not_queued);
    RUN_TEST(LAT_003_refuses_a_set_that_is_not_admitted);
    return UNITY_END();
}
