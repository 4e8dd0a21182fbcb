/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/spread.h. Phases are worked out by hand. A to D are real-time with a
 * period of 1000 us and budgets of 10, 20, 30 and 40 us; O and P are not, with 2000 us, 50 and
 * 60 us. */
#include "actors.h"
#include "keel/rtos/spread.h"

static uint32_t crowded;

void setUp(void)
{
    board_reset(0u);
    board_init(5u);
    crowded = 99u;
}

void tearDown(void)
{
}

#define spreads(count) spreads_at(count, __LINE__)
#define phase(actor)   report_at(actor, __LINE__).release_us

static void spreads_at(uint32_t count, int line)
{
    succeeds(keel_scheduler_spread(&scheduler, &crowded), line);
    UNITY_TEST_ASSERT_EQUAL_UINT32(count, crowded, line, "crowded");
}

static void SPR_002_no_tasks(void)
{
    spreads(0u);
}

/* Budget, guard of 5 and a tick: A keeps 16 behind it, B 26, C 36, P 66. O, added before P, and of
 * the same period, comes before it. */
static void SPR_002_one_behind_the_other(void)
{
    add(&o);
    add(&a);
    add(&p);
    add(&b);
    add(&c);
    spreads(0u);
    TEST_ASSERT_EQUAL_UINT64(0u, phase(&a));
    TEST_ASSERT_EQUAL_UINT64(16u, phase(&b));
    TEST_ASSERT_EQUAL_UINT64(42u, phase(&c));
    TEST_ASSERT_EQUAL_UINT64(78u, phase(&o));
    TEST_ASSERT_EQUAL_UINT64(134u, phase(&p));
}

/* P has the shorter period now, and is placed first. */
static void SPR_002_shorter_periods_come_first(void)
{
    p.config.period_us = 1000u;
    add(&o);
    add(&p);
    add(&a);
    spreads(0u);
    TEST_ASSERT_EQUAL_UINT64(16u, phase(&p));
    TEST_ASSERT_EQUAL_UINT64(82u, phase(&o));
}

/* Periods of 60 and 90: releases meet modulo 30, of which A takes 16 and B, with 8 + 6, just the
 * rest. With 9 + 6 there is no room, and B keeps its phase. */
static void SPR_002_room_is_what_the_common_divisor_leaves(void)
{
    a.config.period_us = 60u;
    b.config.period_us = 90u;
    b.config.budget_us = 8u;
    b.config.phase_us = 7u;
    add(&a);
    add(&b);
    spreads(0u);
    TEST_ASSERT_EQUAL_UINT64(16u, phase(&b));
    b.config.budget_us = 9u;
    discard(&b);
    add(&b);
    spreads(1u);
    TEST_ASSERT_EQUAL_UINT64(0u, phase(&a));
    TEST_ASSERT_EQUAL_UINT64(7u, phase(&b));
}

/* P, at 16, 216 and so on, keeps 66: 134 are left from 82 on, too few for O's 136, enough for
 * 134. */
static void SPR_002_a_gap_that_is_too_short_is_passed_over(void)
{
    p.config.period_us = 200u;
    o.config.period_us = 1000u;
    o.config.budget_us = 130u;
    add(&a);
    add(&p);
    add(&o);
    spreads(1u);
    TEST_ASSERT_EQUAL_UINT64(16u, phase(&p));
    TEST_ASSERT_EQUAL_UINT64(0u, phase(&o));
    discard(&o);
    o.config.budget_us = 128u;
    add(&o);
    spreads(0u);
    TEST_ASSERT_EQUAL_UINT64(82u, phase(&o));
}

/* Behind A and B, P would keep 42 to 108, into A's next release, as its period is 100. It keeps its
 * phase of 5, and O, which does not heed it, comes at 42. */
static void SPR_002_a_crowded_task_keeps_its_phase(void)
{
    p.config.period_us = 100u;
    p.config.phase_us = 5u;
    o.config.period_us = 1000u;
    add(&a);
    add(&b);
    add(&p);
    add(&o);
    spreads(1u);
    TEST_ASSERT_EQUAL_UINT64(5u, phase(&p));
    TEST_ASSERT_EQUAL_UINT64(42u, phase(&o));
}

/* B, at 16, is not due a microsecond before. */
static void SPR_001_phases_are_kept_from_the_start_on(void)
{
    add(&a);
    add(&b);
    spreads(0u);
    start();
    step();
    ran("A");
    step_at(15u);
    ran("");
    step_at(16u);
    ran("B");
}

static void SPR_001_twice_is_once(void)
{
    add(&a);
    add(&b);
    spreads(0u);
    remember();
    spreads(0u);
    unchanged();
}

static void SPR_004_divides_both(void)
{
    TEST_ASSERT_EQUAL_UINT32(6u, keel_spread_divisor(12u, 18u));
    TEST_ASSERT_EQUAL_UINT32(6u, keel_spread_divisor(18u, 12u));
    TEST_ASSERT_EQUAL_UINT32(7u, keel_spread_divisor(7u, 0u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_spread_divisor(1000u, 1001u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_spread_divisor(KEEL_PERIOD_LIMIT_US - 1u,
                                                     KEEL_PERIOD_LIMIT_US - 2u));
}

static void SPR_003_refuses_null(void)
{
    add(&a);
    add(&b);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_spread(NULL, &crowded));
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_spread(&scheduler, NULL));
    TEST_ASSERT_EQUAL_UINT32(99u, crowded);
    unchanged();
}

/* Periods share 220 us, of which each task takes 1 + 5 + 1. They are added the longest first, and
 * placed the shortest first, so a round moves a task on by one place: 31 find theirs, one behind
 * the other, and the last, for which 3 us are left, goes on until no round is left. */
static void SPR_002_rounds_have_an_end(void)
{
    static const uint32_t primes[] = {131u, 127u, 113u, 109u, 107u, 103u, 101u, 97u, 89u, 83u, 79u,
                                      73u,  71u,  67u,  61u,  59u,  53u,  47u,  43u, 41u, 37u, 31u,
                                      29u,  23u,  19u,  17u,  13u,  11u,  7u,   5u,  3u,  2u};
    static actor_t many[32];

    for (uint32_t i = 0u; i < 32u; i++) {
        declare(&many[i], 'M', 1u, 220u * primes[i], 1u);
        add(&many[i]);
    }
    spreads(1u);
    TEST_ASSERT_EQUAL_UINT64(0u, phase(&many[0]));
    for (uint32_t turn = 0u; turn < 31u; turn++) {
        TEST_ASSERT_EQUAL_UINT64(7u * turn, phase(&many[31u - turn]));
    }
}

static void SPR_003_refuses_after_the_start(void)
{
    add(&a);
    add(&b);
    start();
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_scheduler_spread(&scheduler, &crowded));
    TEST_ASSERT_EQUAL_UINT32(99u, crowded);
    unchanged();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SPR_002_no_tasks);
    RUN_TEST(SPR_002_one_behind_the_other);
    RUN_TEST(SPR_002_shorter_periods_come_first);
    RUN_TEST(SPR_002_room_is_what_the_common_divisor_leaves);
    RUN_TEST(SPR_002_a_gap_that_is_too_short_is_passed_over);
    RUN_TEST(SPR_002_a_crowded_task_keeps_its_phase);
    RUN_TEST(SPR_001_phases_are_kept_from_the_start_on);
    RUN_TEST(SPR_001_twice_is_once);
    RUN_TEST(SPR_002_rounds_have_an_end);
    RUN_TEST(SPR_004_divides_both);
    RUN_TEST(SPR_003_refuses_null);
    RUN_TEST(SPR_003_refuses_after_the_start);
    return UNITY_END();
}
