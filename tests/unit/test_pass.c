/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/internal/rtos/pass.h on a virtual board. Schedules are worked out by hand. */
#include "actors.h"

void setUp(void)
{
    board_reset(0u);
}

void tearDown(void)
{
}

/* --- Order of service --- */

static void SCH_015_due_realtime_tasks_run_in_queue_order(void)
{
    board_init(0u);
    add(&c);
    add(&a);
    add(&b);
    start();
    step();
    ran("CAB");
    step();
    ran("");
    step_at(1000u);
    ran("CAB");
}

static void SCH_015_only_due_realtime_tasks_run(void)
{
    board_init(0u);
    b.config.phase_us = 500u;
    add(&a);
    add(&b);
    add(&c);
    start();
    step();
    ran("AC");
    step_at(499u);
    ran("");
    step_at(500u);
    ran("B");
}

static void SCH_015_clock_is_read_again_before_each_decision(void)
{
    board_init(0u);
    b.config.phase_us = 10u; /* Falls due just when A ends. */
    c.config.phase_us = 31u; /* Falls due 1 us after B ends. */
    add(&a);
    add(&b);
    add(&c);
    start();
    step();
    ran("AB");
    TEST_ASSERT_EQUAL_UINT32(4u, board.reads); /* start, begin, after A, after B */
    step_at(31u);
    ran("C");
}

static void SCH_015_a_pass_does_not_turn_back(void)
{
    board_init(0u);
    a.config.phase_us = 5u;
    add(&a);
    add(&b); /* While B runs, A falls due, which stands before it. */
    start();
    step();
    ran("B");
    step();
    ran("A");
}

static void SCH_016_at_most_one_other_task_a_step(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    add(&p);
    start();
    step();
    ran("AP"); /* dp of P is 5, of O is 2. */
    step();
    ran("O");
    step();
    ran("");
}

static void SCH_016_ties_go_to_the_first_queued(void)
{
    board_init(0u);
    o.config.priority = KEEL_PRIORITY_HIGH;
    add(&o);
    add(&p);
    start();
    step();
    ran("O");
    step();
    ran("P");
}

static void SCH_016_released_tasks_only(void)
{
    board_init(0u);
    o.config.phase_us = 100u;
    add(&o);
    start();
    step_at(99u);
    ran("");
    step_at(100u);
    ran("O");
    step_at(2099u);
    ran("");
    step_at(2100u);
    ran("O");
}

static void SCH_016_runs_when_guard_and_worst_case_just_fit(void)
{
    board_init(20u);
    a.config.phase_us = 170u;
    o.config.phase_us = 100u;
    add(&a);
    add(&o);
    start();
    step_at(100u); /* 20 + 50 = 70 */
    ran("O");
    step_at(170u);
    ran("A");
}

static void SCH_016_waits_when_it_is_one_microsecond_too_long(void)
{
    board_init(20u);
    a.config.phase_us = 169u;
    o.config.phase_us = 100u;
    add(&a);
    add(&o);
    start();
    step_at(100u);
    ran("");
    step_at(169u);
    ran("AO"); /* Now there are 990 us. */
}

static void SCH_016_nothing_runs_within_the_guard(void)
{
    board_init(20u);
    a.config.phase_us = 110u;
    o.config.phase_us = 100u;
    add(&a);
    add(&o);
    start();
    step(); /* Nothing is due; both releases are known now. */
    step_at(100u);
    ran("");
    step_at(110u);
    ran("AO");
}

static void SCH_016_no_other_task_while_a_realtime_task_is_due(void)
{
    board_init(0u);
    a.cost_us = 1000u; /* A overruns until its next release. */
    add(&a);
    add(&o);
    start();
    step();
    ran("A");
    step();
    ran("A");
}

/* O is released at 900 and 2900, both times 99 us before A; its first run takes cost_us. */
static void second_run_at_2900(uint32_t cost_us, const char *expected)
{
    board_reset(0u);
    board_init(20u);
    a.config.phase_us = 999u;
    o.config.phase_us = 900u;
    o.cost_us = cost_us;
    add(&a);
    add(&o);
    start();
    step_at(900u); /* 20 + 50 fit whatever the run will take. */
    ran("O");
    step_at(999u);
    step_at(1999u);
    ran("AA");
    step_at(2900u);
    ran(expected);
}

static void SCH_016_worst_case_is_the_longest_run(void)
{
    second_run_at_2900(79u, "O"); /* 20 + 79 = 99 */
    second_run_at_2900(80u, "");
    TEST_ASSERT_EQUAL_UINT16(1u, report(&o).stats.overruns);
    step_at(2999u);
    ran("AO");                    /* Now there are 990 us. */
    second_run_at_2900(30u, "O"); /* The budget, not the shorter run, counts. */
}

/* --- Releases and statistics --- */

static void SCH_014_releases_stay_on_the_grid(void)
{
    board_init(0u);
    a.config.phase_us = 100u;
    add(&a);
    start();
    step_at(150u);
    TEST_ASSERT_EQUAL_UINT64(1100u, report(&a).release_us);
    step_at(2099u); /* 999 late. */
    TEST_ASSERT_EQUAL_UINT64(2100u, report(&a).release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, report(&a).skipped);
    step_at(5234u); /* The releases at 3100 and 4100 and 5100: two are missed. */
    TEST_ASSERT_EQUAL_UINT64(6100u, report(&a).release_us);
    TEST_ASSERT_EQUAL_UINT32(3u, report(&a).skipped);
    ran("AAA");
}

static void SCH_014_next_gives_null_unless_a_pass_is_open(void)
{
    board_init(0u);
    add(&a);
    remember();
    TEST_ASSERT_NULL(keel_pass_next(&scheduler));
    unchanged();
    start();
    remember();
    TEST_ASSERT_NULL(keel_pass_next(&scheduler));
    unchanged();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(&scheduler, 0u));
    TEST_ASSERT_EQUAL_PTR(&a.config, keel_pass_next(&scheduler));
    remember();
    TEST_ASSERT_NULL(keel_pass_next(&scheduler)); /* A runs. */
    unchanged();
}

static void SCH_017_finish_records_the_run(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    start();
    a.cost_us = 8u;
    step();
    a.cost_us = 25u; /* 15 more than the budget. */
    step_at(1000u);
    a.cost_us = 9u;
    step_at(2000u);
    ran("AOAAO");
    TEST_ASSERT_EQUAL_UINT32(3u, report(&a).stats.runs);
    TEST_ASSERT_EQUAL_UINT64(42u, report(&a).stats.total_us);
    TEST_ASSERT_EQUAL_UINT32(9u, report(&a).stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(25u, report(&a).stats.longest_us);
    TEST_ASSERT_EQUAL_UINT16(1u, report(&a).stats.overruns);
    TEST_ASSERT_EQUAL_UINT16(0u, report(&a).stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(2u, report(&o).stats.runs);
    TEST_ASSERT_EQUAL_UINT64(142u, scheduler.busy_us);
    TEST_ASSERT_EQUAL_UINT64(2059u, scheduler.clock.now_us);
}

static void SCH_017_begin_next_finish_make_a_step(void)
{
    keel_scheduler_t *const s = &scheduler;

    board_init(0u);
    add(&a);
    add(&o);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(s, 100u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_PASS, s->stage);
    TEST_ASSERT_EQUAL_PTR(&a.config, keel_pass_next(s));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_REALTIME, s->stage);
    TEST_ASSERT_EQUAL_UINT32(0u, s->running);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_finish(s, 111u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_PASS, s->stage);
    TEST_ASSERT_EQUAL_UINT32(KEEL_POSITION_NONE, s->running);
    TEST_ASSERT_EQUAL_PTR(&o.config, keel_pass_next(s));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_OTHER, s->stage);
    TEST_ASSERT_EQUAL_UINT32(1u, s->running);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_finish(s, 160u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, s->stage);
    TEST_ASSERT_EQUAL_UINT32(11u, report(&a).stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(49u, report(&o).stats.last_us);
    TEST_ASSERT_EQUAL_UINT64(60u, s->busy_us);
}

static void SCH_023_without_a_pass_nothing_runs(void)
{
    board_init(0u);
    add(&a);
    start();
    remember();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_run(&scheduler));
    unchanged();
    ran("");
}

static void SCH_023_begin_and_run_pass_make_a_step(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    add(&o);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(&scheduler, 0u));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_run(&scheduler));
    ran("ABO");
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, scheduler.stage);
}

static actor_t many[KEEL_QUEUE_CAPACITY];

/* So many real-time tasks, of 1 us each: all of them run in one pass, each once, in queue order. */
static void all_run_in_one_pass(uint32_t count)
{
    char names[KEEL_QUEUE_CAPACITY + 1u] = {0};

    board_init(0u);
    for (uint32_t i = 0u; i < count; i++) {
        names[i] = (char)('A' + i);
        declare(&many[i], names[i], KEEL_PRIORITY_REALTIME, 1000u, 1u);
        add(&many[i]);
    }
    start();
    step();
    ran(names);
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, scheduler.stage);
    TEST_ASSERT_EQUAL_UINT64(count, scheduler.clock.now_us);
    step();
    ran("");
    step_at(1000u);
    ran(names);
    for (uint32_t i = 0u; i < count; i++) {
        TEST_ASSERT_EQUAL_UINT32(2u, report(&many[i]).stats.runs);
        TEST_ASSERT_EQUAL_UINT64(2000u, report(&many[i]).release_us);
    }
}

static void SCH_023_a_pass_runs_nine_realtime_tasks(void)
{
    all_run_in_one_pass(9u);
}

static void SCH_023_a_pass_runs_as_many_realtime_tasks_as_there_is_room_for(void)
{
    all_run_in_one_pass(KEEL_QUEUE_CAPACITY);
}

static void SCH_026_a_turn_runs_one_task(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(&scheduler, 0u));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_turn(&scheduler));
    ran("A");
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_PASS, scheduler.stage);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_turn(&scheduler));
    ran("O");
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, scheduler.stage);
    TEST_ASSERT_EQUAL_UINT64(60u, scheduler.clock.now_us); /* 10 + 50 */
    remember();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_turn(&scheduler));
    unchanged();
    ran("");
}

static void SCH_018_finish_refuses_when_nothing_runs(void)
{
    keel_scheduler_t *const s = &scheduler;

    board_init(0u);
    add(&a);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_pass_finish(s, 5u));
    unchanged();
    start();
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_pass_finish(s, 5u));
    unchanged();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(s, 0u));
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_pass_finish(s, 5u));
    unchanged();
}

static void SCH_018_broken_clock_ends_the_pass(void)
{
    keel_scheduler_t *const s = &scheduler;

    board_init(0u);
    add(&a);
    add(&b);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(s, 100u));
    TEST_ASSERT_EQUAL_PTR(&a.config, keel_pass_next(s));
    TEST_ASSERT_EQUAL(KEEL_ERR_CLOCK, keel_pass_finish(s, 99u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, s->stage);
    TEST_ASSERT_EQUAL_UINT32(KEEL_POSITION_NONE, s->running);
    TEST_ASSERT_EQUAL_UINT32(0u, report(&a).stats.runs);
    TEST_ASSERT_EQUAL_UINT64(0u, s->busy_us);
    TEST_ASSERT_EQUAL_UINT64(100u, s->clock.now_us);
    /* A was served; B is not skipped, it waits for the clock. */
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(s, 100u));
    TEST_ASSERT_EQUAL_PTR(&b.config, keel_pass_next(s));
}

/* --- Sleeping --- */

static void SCH_012_an_idle_step_reads_the_clock_alone(void)
{
    board_init(0u);
    a.config.phase_us = 700u;
    add(&a);
    add(&o);
    start();
    step();
    ran("O");
    step();
    TEST_ASSERT_EQUAL_UINT64(700u, scheduler.wake_us);
    board.reads = 0u;
    remember();
    board.raw_us = 699u;
    step();
    TEST_ASSERT_EQUAL_UINT32(1u, board.reads);
    ran("");
    scheduler_before.clock.now_us = 699u;
    scheduler_before.clock.raw_us = 699u;
    unchanged(); /* Nothing but the time. */
}

static void SCH_012_wakes_for_a_release_and_not_before(void)
{
    board_init(0u);
    a.config.phase_us = 700u;
    add(&a);
    start();
    for (uint64_t now_us = 0u; now_us < 700u; now_us += 1u) {
        step_at(now_us);
    }
    ran("");
    step_at(700u);
    ran("A");
}

static void SCH_012_a_pass_of_realtime_tasks_sleeps_when_it_ends(void)
{
    board_init(0u);
    o.config.phase_us = 700u;
    add(&a);
    add(&b);
    add(&o);
    start();
    step();
    ran("AB");
    TEST_ASSERT_EQUAL_UINT64(700u, scheduler.wake_us); /* Without another pass. */
    step_at(700u);
    ran("O");
    step();
    TEST_ASSERT_EQUAL_UINT64(1000u, scheduler.wake_us);
    step_at(1000u);
    ran("AB");
    TEST_ASSERT_EQUAL_UINT64(2000u, scheduler.wake_us);
}

/* B falls due while A runs behind it in the queue: the pass must not sleep over it. */
static void SCH_012_sleeps_over_no_task_that_fell_due_in_the_pass(void)
{
    board_init(0u);
    b.config.phase_us = 5u;
    add(&b);
    add(&a);
    start();
    step();
    ran("A");
    step();
    ran("B");
    TEST_ASSERT_EQUAL_UINT64(1000u, scheduler.wake_us);
}

static void SCH_012_a_pass_that_ran_another_task_does_not_sleep(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    add(&p);
    start();
    step();
    TEST_ASSERT_EQUAL_UINT64(0u, scheduler.wake_us);
    step();
    TEST_ASSERT_EQUAL_UINT64(0u, scheduler.wake_us);
    step();
    TEST_ASSERT_EQUAL_UINT64(1000u, scheduler.wake_us);
    ran("APO");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(&scheduler, 1000u));
    TEST_ASSERT_EQUAL_UINT64(0u, scheduler.wake_us); /* As finish demands. */
}

static void SCH_012_sleeps_for_ever_without_tasks(void)
{
    board_init(0u);
    start();
    step();
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, scheduler.wake_us);
    add(&a);
    step();
    ran("A");
}

static void SCH_012_wakes_for_a_promotion(void)
{
    board_init(20u);
    o.config.period_us = 100u;
    o.config.priority = KEEL_PRIORITY_HIGH;
    a.config.phase_us = 999u;
    add(&a);
    add(&o);
    start();
    scheduler.queue.stats[slot_of(&o)].remembered_us = 5000u; /* Fits no gap. */
    step();
    /* Promoted at age 375, which is 275 behind the release. */
    TEST_ASSERT_EQUAL_UINT64(275u, scheduler.wake_us);
    step_at(274u);
    ran("");
    step_at(275u);
    ran("O");
    TEST_ASSERT_EQUAL_UINT16(1u, report(&o).stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(2u, report(&o).skipped);
    TEST_ASSERT_EQUAL_UINT64(300u, report(&o).release_us);
}

/* --- Promotion --- */

/* A real-time task that leaves 950 us of each 1000, and another whose first run takes 950. */
static void SCH_016_a_long_run_is_outlived_through_promotion(void)
{
    board_init(10u);
    declare(&a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 50u);
    declare(&o, 'O', KEEL_PRIORITY_HIGH, 10000u, 100u);
    o.cost_us = 950u;
    add(&a);
    add(&o);
    start();
    step();
    ran("AO");
    TEST_ASSERT_EQUAL_UINT32(950u, report(&o).stats.longest_us);
    o.cost_us = 90u;
    /* Released at 10000, it never fits again: 10 + 950 > 950. Promoted at 3.75 periods. */
    for (uint64_t now_us = 1000u; now_us < 37500u; now_us += 50u) {
        step_at(now_us);
    }
    ran("AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"); /* 1000, 2000, ... 37000 */
    step_at(37500u);
    ran("O");
    TEST_ASSERT_EQUAL_UINT32(2u, report(&o).stats.runs);
    TEST_ASSERT_EQUAL_UINT16(1u, report(&o).stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(2u, report(&o).skipped); /* of the releases 10000 to 30000 */
    TEST_ASSERT_EQUAL_UINT64(40000u, report(&o).release_us);
}

/* The same real-time task, and another with a stall of 500 ms. It is promoted as soon as the stall
 * is over, at an age of 50 periods, and then at one of 15: at 650, 800, ... 1550 ms. The eighth run
 * within the budget is the last of these, 1.05 s behind the stall; from then on it fits again. */
static void SCH_016_a_stall_is_forgotten_after_eight_runs(void)
{
    uint64_t now_us;

    board_init(10u);
    declare(&a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 50u);
    declare(&o, 'O', KEEL_PRIORITY_LOW, 10000u, 100u);
    o.cost_us = 500000u;
    add(&a);
    add(&o);
    start();
    step();
    ran("AO");
    o.cost_us = 90u;
    step();
    ran("AO"); /* at 500050 */
    TEST_ASSERT_EQUAL_UINT64(510000u, report(&o).release_us);
    for (now_us = 501000u; now_us <= 1549000u; now_us += 1000u) {
        board_quiet();
        step_at(now_us);
    }
    TEST_ASSERT_EQUAL_UINT32(8u, report(&o).stats.runs); /* of them six at 650, ... 1400 ms */
    TEST_ASSERT_EQUAL_UINT16(7u, report(&o).stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(500000u, report(&o).stats.remembered_us);
    for (; now_us <= 1650000u; now_us += 1000u) {
        board_quiet();
        step_at(now_us);
    }
    /* One more by promotion, at 1550 ms, then ten in 100 ms, as many as it has periods. */
    TEST_ASSERT_EQUAL_UINT32(19u, report(&o).stats.runs);
    TEST_ASSERT_EQUAL_UINT16(8u, report(&o).stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(0u, report(&o).stats.remembered_us);
    TEST_ASSERT_EQUAL_UINT32(500000u, report(&o).stats.longest_us);
    TEST_ASSERT_EQUAL_UINT16(1u, report(&o).stats.overruns);
}

static void SCH_016_promoted_runs_behind_due_realtime_tasks(void)
{
    board_init(10u);
    declare(&p, 'P', KEEL_PRIORITY_HIGH, 1000u, 60u);
    add(&a);
    add(&o);
    add(&p);
    start();
    step_at(3000u); /* P: age 4000 of 1000, promoted; O: 1 + 5000 / 2000. */
    ran("AP");
    TEST_ASSERT_EQUAL_UINT16(1u, report(&p).stats.promotions);
    TEST_ASSERT_EQUAL_UINT16(0u, report(&o).stats.promotions);
    step();
    ran("O");
    TEST_ASSERT_EQUAL_UINT16(0u, report(&o).stats.promotions);
}

static void SCH_016_promoted_tasks_run_first_come_first_served(void)
{
    board_init(0u);
    add(&o);
    add(&p);
    start();
    step_at(100000u); /* Both are promoted: queue order, not class. */
    ran("O");
    step();
    ran("P");
    TEST_ASSERT_EQUAL_UINT16(1u, report(&o).stats.promotions);
    TEST_ASSERT_EQUAL_UINT16(1u, report(&p).stats.promotions);
    step_at(102000u);
    step();
    ran("PO"); /* Served, they compete by class again. */
    TEST_ASSERT_EQUAL_UINT16(1u, report(&p).stats.promotions);
}

/* --- Without promotion --- */

static void SCH_012_without_promotion_wakes_for_the_next_gap(void)
{
    board_init_without_promotion(20u);
    o.config.period_us = 100u;
    o.config.priority = KEEL_PRIORITY_HIGH;
    a.config.phase_us = 999u;
    add(&a);
    add(&o);
    start();
    scheduler.queue.stats[slot_of(&o)].remembered_us = 970u; /* Fits behind A alone. */
    step_at(10u);
    TEST_ASSERT_EQUAL_UINT64(999u, scheduler.wake_us);
    step_at(998u);
    ran("");
    step_at(999u);
    ran("AO"); /* A ends at 1009: 20 + 970 are just left. */
    TEST_ASSERT_EQUAL_UINT16(0u, report(&o).stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(10u, report(&o).skipped);
}

/* Promoted or not, what fits the slack runs in the same order; no promotion is counted. */
static void SCH_016_without_promotion_what_fits_runs(void)
{
    board_init_without_promotion(10u);
    declare(&p, 'P', KEEL_PRIORITY_HIGH, 1000u, 60u);
    add(&a);
    add(&o);
    add(&p);
    start();
    step_at(3000u); /* P: age 4000 of 1000, the highest priority; O: 1 + 5000 / 2000. */
    ran("AP");
    step();
    ran("O");
    TEST_ASSERT_EQUAL_UINT16(0u, report(&p).stats.promotions);
    TEST_ASSERT_EQUAL_UINT16(0u, report(&o).stats.promotions);
}

/* A real-time task that leaves 950 us of each 1000, and another whose first run takes 950: it never
 * fits again, until it is added anew. */
static void SCH_016_without_promotion_what_never_fits_never_runs(void)
{
    board_init_without_promotion(10u);
    declare(&a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 50u);
    declare(&o, 'O', KEEL_PRIORITY_HIGH, 10000u, 100u);
    o.cost_us = 950u;
    add(&a);
    add(&o);
    start();
    step();
    ran("AO");
    o.cost_us = 90u;
    for (uint64_t now_us = 1000u; now_us <= 1000000u; now_us += 1000u) {
        board_quiet();
        step_at(now_us);
        TEST_ASSERT_EQUAL_UINT64(now_us + 1000u, scheduler.wake_us);
    }
    ran("A");
    TEST_ASSERT_EQUAL_UINT32(1u, report(&o).stats.runs);
    discard(&o);
    add(&o);
    step();
    ran("O");
}

static uint32_t latest_us; /* How late a real-time task has started at most. */

static void note(uint32_t late_us)
{
    latest_us = (late_us > latest_us) ? late_us : latest_us;
}

static void note_a(void)
{
    note(board.raw_us % 1000u);
}

static void note_b(void)
{
    note(board.raw_us % 1001u);
}

/* Two real-time tasks whose gap is shorter than 720 us for half a second, longer than another task
 * waits for its promotion, which is 27.5 ms. */
static void run_drifting(void)
{
    declare(&a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 50u);
    declare(&b, 'B', KEEL_PRIORITY_REALTIME, 1001u, 50u);
    declare(&o, 'O', KEEL_PRIORITY_HIGH, 10000u, 700u);
    a.act = note_a;
    b.act = note_b;
    latest_us = 0u;
    add(&a);
    add(&b);
    add(&o);
    start();
    step();
    while (scheduler.clock.now_us < 1001000u) {
        const uint64_t now_us = scheduler.clock.now_us;

        board_quiet();
        step_at((scheduler.wake_us > now_us) ? scheduler.wake_us : now_us);
    }
    TEST_ASSERT_EQUAL_UINT16(0u, report(&a).stats.overruns);
    TEST_ASSERT_EQUAL_UINT16(0u, report(&b).stats.overruns);
    TEST_ASSERT_EQUAL_UINT16(0u, report(&o).stats.overruns);
}

/* ISO-001: the other real-time budget, which is 50 us, and the guard. */
static void SCH_016_without_promotion_no_realtime_task_is_later_than_its_bound(void)
{
    board_init(20u);
    run_drifting();
    TEST_ASSERT_GREATER_THAN_UINT32(70u, latest_us);
    TEST_ASSERT_GREATER_THAN_UINT16(0u, report(&o).stats.promotions);
    board_reset(0u);
    board_init_without_promotion(20u);
    run_drifting();
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(70u, latest_us);
    TEST_ASSERT_EQUAL_UINT16(0u, report(&o).stats.promotions);
    TEST_ASSERT_GREATER_THAN_UINT32(40u, report(&o).stats.runs); /* of 100 periods */
}

static void SCH_013_begin_refuses_in_an_open_pass(void)
{
    board_init(0u);
    add(&a);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(&scheduler, 0u));
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_pass_begin(&scheduler, 10u));
    unchanged();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SCH_015_due_realtime_tasks_run_in_queue_order);
    RUN_TEST(SCH_015_only_due_realtime_tasks_run);
    RUN_TEST(SCH_015_clock_is_read_again_before_each_decision);
    RUN_TEST(SCH_015_a_pass_does_not_turn_back);
    RUN_TEST(SCH_016_at_most_one_other_task_a_step);
    RUN_TEST(SCH_016_ties_go_to_the_first_queued);
    RUN_TEST(SCH_016_released_tasks_only);
    RUN_TEST(SCH_016_runs_when_guard_and_worst_case_just_fit);
    RUN_TEST(SCH_016_waits_when_it_is_one_microsecond_too_long);
    RUN_TEST(SCH_016_nothing_runs_within_the_guard);
    RUN_TEST(SCH_016_no_other_task_while_a_realtime_task_is_due);
    RUN_TEST(SCH_016_worst_case_is_the_longest_run);
    RUN_TEST(SCH_014_releases_stay_on_the_grid);
    RUN_TEST(SCH_014_next_gives_null_unless_a_pass_is_open);
    RUN_TEST(SCH_017_finish_records_the_run);
    RUN_TEST(SCH_017_begin_next_finish_make_a_step);
    RUN_TEST(SCH_023_without_a_pass_nothing_runs);
    RUN_TEST(SCH_023_begin_and_run_pass_make_a_step);
    RUN_TEST(SCH_023_a_pass_runs_nine_realtime_tasks);
    RUN_TEST(SCH_023_a_pass_runs_as_many_realtime_tasks_as_there_is_room_for);
    RUN_TEST(SCH_026_a_turn_runs_one_task);
    RUN_TEST(SCH_018_finish_refuses_when_nothing_runs);
    RUN_TEST(SCH_018_broken_clock_ends_the_pass);
    RUN_TEST(SCH_012_an_idle_step_reads_the_clock_alone);
    RUN_TEST(SCH_012_wakes_for_a_release_and_not_before);
    RUN_TEST(SCH_012_a_pass_of_realtime_tasks_sleeps_when_it_ends);
    RUN_TEST(SCH_012_sleeps_over_no_task_that_fell_due_in_the_pass);
    RUN_TEST(SCH_012_a_pass_that_ran_another_task_does_not_sleep);
    RUN_TEST(SCH_012_sleeps_for_ever_without_tasks);
    RUN_TEST(SCH_012_wakes_for_a_promotion);
    RUN_TEST(SCH_016_a_long_run_is_outlived_through_promotion);
    RUN_TEST(SCH_016_a_stall_is_forgotten_after_eight_runs);
    RUN_TEST(SCH_016_promoted_runs_behind_due_realtime_tasks);
    RUN_TEST(SCH_016_promoted_tasks_run_first_come_first_served);
    RUN_TEST(SCH_012_without_promotion_wakes_for_the_next_gap);
    RUN_TEST(SCH_016_without_promotion_what_fits_runs);
    RUN_TEST(SCH_016_without_promotion_what_never_fits_never_runs);
    RUN_TEST(SCH_016_without_promotion_no_realtime_task_is_later_than_its_bound);
    RUN_TEST(SCH_013_begin_refuses_in_an_open_pass);
    return UNITY_END();
}
