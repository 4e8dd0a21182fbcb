/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/common/task_table.h with a real scheduler on a simulated clock. */
#include "common/task_table.h"
#include "unity.h"

#include <string.h>

static uint32_t ticks;
static uint32_t cost_us; /* Of each run. */
static keel_scheduler_t scheduler;
static keel_trace_t trace;
static keel_task_table_t table;
static char line[KEEL_TASK_TABLE_LINE];

static uint32_t read_clock(void *context)
{
    (void)context;
    return ticks;
}

static void body(void *context)
{
    (void)context;
    keel_trace_begin(&trace, &scheduler);
    ticks += cost_us;
    keel_task_table_add(&table, &trace.run);
}

static const keel_task_config_t fast = {.name = "fast",
                                        .run = body,
                                        .period_us = 1000u,
                                        .budget_us = 100u,
                                        .priority = KEEL_PRIORITY_REALTIME};
static const keel_task_config_t slow = {.name = "a name of more than 24 characters",
                                        .run = body,
                                        .period_us = 4000u,
                                        .budget_us = 300u,
                                        .phase_us = 400u,
                                        .priority = KEEL_PRIORITY_LOW};
static const keel_task_config_t nameless = {.run = body,
                                            .period_us = 2000000u,
                                            .budget_us = 100u,
                                            .phase_us = 700u,
                                            .priority = KEEL_PRIORITY_LOW};

static void add(const keel_task_config_t *task)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_add(&scheduler, task));
}

void setUp(void)
{
    const keel_scheduler_config_t config = {.read_clock = read_clock,
                                            .guard_us = 20u,
                                            .utilisation_limit_ppm = KEEL_UTILISATION_FULL_PPM};

    ticks = 0u;
    cost_us = 40u;
    memset(&scheduler, 0, sizeof scheduler);
    memset(&trace, 0, sizeof trace);
    memset(&table, 0, sizeof table);
    memset(line, 'x', sizeof line);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&scheduler, &config));
    add(&fast);
    add(&slow);
    add(&nameless);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_start(&scheduler));
}

void tearDown(void)
{
}

static void step_at(uint32_t time_us)
{
    ticks = time_us;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_step(&scheduler));
}

static void line_is(uint32_t number, const char *expected)
{
    const uint32_t length = keel_task_table_line(&table, &scheduler, number, line);

    TEST_ASSERT_EQUAL_STRING(expected, line);
    TEST_ASSERT_EQUAL_UINT32(strlen(expected), length);
}

static void late_is(uint32_t slot, const uint32_t expected[KEEL_TASK_TABLE_BUCKETS])
{
    TEST_ASSERT_EQUAL_UINT32_ARRAY(expected, table.late[slot], KEEL_TASK_TABLE_BUCKETS);
}

static void TBL_001_a_run_counts_in_the_range_of_its_lateness(void)
{
    static const struct {
        uint32_t late_us;
        uint32_t bucket;
    } edge[] = {{0u, 0u},    {9u, 0u},    {10u, 1u},   {29u, 1u},       {30u, 2u},
                {99u, 2u},   {100u, 3u},  {299u, 3u},  {300u, 4u},      {999u, 4u},
                {1000u, 5u}, {2999u, 5u}, {3000u, 6u}, {UINT32_MAX, 6u}};

    for (uint32_t i = 0u; i < (sizeof edge / sizeof edge[0]); i++) {
        const keel_trace_run_t run = {.late_us = edge[i].late_us, .slot = 2u};
        uint32_t expected[KEEL_TASK_TABLE_BUCKETS] = {0u};

        memset(&table, 0, sizeof table);
        keel_task_table_add(&table, &run);
        expected[edge[i].bucket] = 1u;
        late_is(2u, expected);
        late_is(1u, (const uint32_t[KEEL_TASK_TABLE_BUCKETS]){0u});
        late_is(3u, (const uint32_t[KEEL_TASK_TABLE_BUCKETS]){0u});
    }
}

static void TBL_001_counts_stay_at_their_end(void)
{
    const keel_trace_run_t run = {.late_us = 10u};

    table.late[0][1] = UINT32_MAX - 1u;
    keel_task_table_add(&table, &run);
    keel_task_table_add(&table, &run);
    late_is(0u, (const uint32_t[KEEL_TASK_TABLE_BUCKETS]){0u, UINT32_MAX});
}

static void TBL_001_a_task_that_takes_a_slot_begins_anew(void)
{
    const keel_trace_run_t run = {.late_us = 40u, .flags = KEEL_TRACE_FIRST};

    for (uint32_t i = 0u; i < KEEL_TASK_TABLE_BUCKETS; i++) {
        table.late[0][i] = 5u + i;
        table.late[1][i] = 5u;
    }
    keel_task_table_add(&table, &run);
    late_is(0u, (const uint32_t[KEEL_TASK_TABLE_BUCKETS]){0u, 0u, 1u});
    late_is(1u, (const uint32_t[KEEL_TASK_TABLE_BUCKETS]){5u, 5u, 5u, 5u, 5u, 5u, 5u});
}

static void TBL_002_before_anything_ran_all_is_zero(void)
{
    line_is(0u, "up 0.000 s, load 0.00 %; times in us, and runs by how late they started\n");
    line_is(2u, "fast                        1000       0    0.0       0    100   0.00"
                "      0      0      0      0      0      0      0     0     0     0\n");
}

static void TBL_002_the_first_line_is_about_all_tasks(void)
{
    step_at(0u); /* Fast: 40 of then 12345678 us. */
    scheduler.clock.now_us = 12345678u;
    scheduler.busy_us = 3456789u; /* 28.0000 % rounded down would be 27.99. */
    line_is(0u, "up 12.345 s, load 27.99 %; times in us, and runs by how late they started\n");
    scheduler.clock.now_us = UINT64_MAX / 2u;
    scheduler.busy_us = 0u;
    line_is(0u, "up 4294967.295 s, load 0.00 %; times in us, and runs by how late they started\n");
}

static void TBL_003_the_second_line_has_headings(void)
{
    line_is(1u, "task                      period    runs   mean longest budget load %"
                "    <10    <30   <100   <300  <1000  <3000   more  over  prom  skip\n");
}

static void TBL_004_each_other_line_is_a_tasks(void)
{
    step_at(5u); /* Fast, 5 us late. */
    cost_us = 241u;
    step_at(1150u); /* Fast, 150 us late and over its budget; slow, 991 us late, as that ends. */
    cost_us = 40u;
    step_at(4000u); /* Fast, 2000 us late, as two periods have passed; nameless, 3340 us late. */
    TEST_ASSERT_EQUAL_UINT64(4080u, scheduler.clock.now_us);
    /* 321 us in 3 runs, 7.867 % of 4080 us. */
    line_is(2u, "fast                        1000       3  107.0     241    100   7.86"
                "      1      0      0      1      0      1      0     1     0     2\n");
    /* 241 us are 5.906 % of them. */
    line_is(3u, "a name of more than 24 c    4000       1  241.0     241    300   5.90"
                "      0      0      0      0      1      0      0     0     0     0\n");
    line_is(4u, "                         2000000       1   40.0      40    100   0.98"
                "      0      0      0      0      0      0      1     0     0     0\n");
}

static void TBL_004_a_mean_has_a_digit_behind_the_point(void)
{
    step_at(0u);
    cost_us = 41u;
    step_at(1000u);
    step_at(2000u); /* 122 us in 3 runs: 40.66... */
    (void)keel_task_table_line(&table, &scheduler, 2u, line);
    TEST_ASSERT_NOT_NULL(strstr(line, "   3   40.6      41"));
}

static void TBL_004_promotions_are_counted(void)
{
    scheduler.queue.stats[scheduler.queue.order[2]].promotions = 7u;
    line_is(4u, "                         2000000       0    0.0       0    100   0.00"
                "      0      0      0      0      0      0      0     0     7     0\n");
}

static void TBL_004_the_longest_line_fits(void)
{
    keel_queue_t *const queue = &scheduler.queue;
    const uint32_t slot = queue->order[1];

    queue->stats[slot] = (keel_stats_t){.total_us = UINT64_C(0xFFFFFFFE00000001),
                                        .runs = UINT32_MAX,
                                        .longest_us = UINT32_MAX,
                                        .overruns = UINT16_MAX,
                                        .promotions = UINT16_MAX};
    queue->period_us[slot] = UINT32_MAX;
    queue->budget_us[slot] = UINT32_MAX;
    queue->skipped[slot] = UINT16_MAX;
    scheduler.clock.now_us = 1u;
    memset(table.late[slot], 0xFF, sizeof table.late[slot]);
    line[KEEL_TASK_TABLE_LINE - 1u] = 'x';
    TEST_ASSERT_LESS_THAN_UINT32(KEEL_TASK_TABLE_LINE,
                                 keel_task_table_line(&table, &scheduler, 3u, line));
    TEST_ASSERT_NOT_NULL(strstr(line,
                                " 4294967295 4294967295 4294967295 4294967295 4294967295 4294967295"
                                " 4294967295 65535 65535 65535\n"));
}

static void TBL_005_behind_the_last_task_there_is_no_line(void)
{
    line_is(5u, "");
    line_is(UINT32_MAX, "");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &slow));
    line_is(4u, "");
    line_is(3u, "                         2000000       0    0.0       0    100   0.00"
                "      0      0      0      0      0      0      0     0     0     0\n");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(TBL_001_a_run_counts_in_the_range_of_its_lateness);
    RUN_TEST(TBL_001_counts_stay_at_their_end);
    RUN_TEST(TBL_001_a_task_that_takes_a_slot_begins_anew);
    RUN_TEST(TBL_002_before_anything_ran_all_is_zero);
    RUN_TEST(TBL_002_the_first_line_is_about_all_tasks);
    RUN_TEST(TBL_003_the_second_line_has_headings);
    RUN_TEST(TBL_004_each_other_line_is_a_tasks);
    RUN_TEST(TBL_004_a_mean_has_a_digit_behind_the_point);
    RUN_TEST(TBL_004_promotions_are_counted);
    RUN_TEST(TBL_004_the_longest_line_fits);
    RUN_TEST(TBL_005_behind_the_last_task_there_is_no_line);
    return UNITY_END();
}
