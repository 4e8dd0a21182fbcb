/* Unit tests of keel/rtos/scheduler.h on a virtual board. Schedules are worked out by hand. */
#include "board.h"

void setUp(void)
{
    board_reset(0u);
}

void tearDown(void)
{
}

/* --- Setting up --- */

static void SCH_001_init_makes_an_empty_scheduler(void)
{
    const keel_scheduler_config_t config = board_config(25u);
    keel_scheduler_t *const s = &kernel.scheduler;

    memset(s, 0xA5, sizeof *s);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(s, &config));
    TEST_ASSERT_EQUAL_UINT32(0u, s->queue.count);
    TEST_ASSERT_EQUAL_UINT32(0u, s->queue.realtime_count);
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        TEST_ASSERT_NULL(s->queue.task[i]);
    }
    TEST_ASSERT_TRUE(s->config.read_clock == board_read);
    TEST_ASSERT_EQUAL_PTR(&board, s->config.clock_context);
    TEST_ASSERT_EQUAL_UINT32(25u, s->config.guard_us);
    TEST_ASSERT_EQUAL_UINT32(1000000u, s->config.utilisation_limit);
    TEST_ASSERT_EQUAL_UINT64(0u, s->clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0u, s->clock.raw_us);
    TEST_ASSERT_EQUAL_UINT64(0u, s->wake_us);
    TEST_ASSERT_EQUAL_UINT64(0u, s->busy_us);
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_SETUP, s->stage);
    TEST_ASSERT_EQUAL_UINT32(0u, s->cursor);
    TEST_ASSERT_EQUAL_UINT32(0u, s->pass_end);
    TEST_ASSERT_EQUAL_UINT32(KEEL_INDEX_NONE, s->running);
    TEST_ASSERT_FALSE(s->ran);
    TEST_ASSERT_EQUAL_UINT32(0u, board.reads);
}

static void init_is_refused(keel_status_t reason, const keel_scheduler_config_t *config)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_init(&kernel.scheduler, config));
    unchanged();
}

static void SCH_002_init_refuses_null(void)
{
    keel_scheduler_config_t config = board_config(25u);

    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_init(NULL, &config));
    init_is_refused(KEEL_ERR_NULL, NULL);
    config.read_clock = NULL;
    init_is_refused(KEEL_ERR_NULL, &config);
}

static void SCH_002_init_refuses_limits_out_of_range(void)
{
    keel_scheduler_config_t config = board_config(0x80000000u);

    init_is_refused(KEEL_ERR_CONFIG, &config);
    config.guard_us = 0x7FFFFFFFu;
    config.utilisation_limit = 1000001u;
    init_is_refused(KEEL_ERR_CONFIG, &config);
    config.utilisation_limit = 1000000u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&kernel.scheduler, &config));
}

static void check_finds(keel_status_t status, uint32_t admitted)
{
    uint32_t found = UINT32_MAX;

    remember();
    TEST_ASSERT_EQUAL(status, keel_scheduler_check(&kernel.scheduler, &found));
    TEST_ASSERT_EQUAL_UINT32(admitted, found);
    unchanged();
}

static void SCH_003_check_names_the_offender(void)
{
    board_init(10u);
    check_finds(KEEL_OK, 0u);
    add(&kernel.a);
    check_finds(KEEL_OK, 1u);
    kernel.b.config.budget_us = 971u; /* 10 + 971 + 20 > 1000 */
    add(&kernel.b);
    check_finds(KEEL_ERR_REALTIME_DEMAND, 1u);
    discard(&kernel.b);
    kernel.o.config.budget_us = 981u; /* 981 + 10 > 990 */
    add(&kernel.o);
    check_finds(KEEL_ERR_BUDGET_GAP, 1u);
    discard(&kernel.o);
    kernel.p.config.budget_us = 980u;
    kernel.p.config.period_us = 985u; /* 1 % + 99.5 % */
    add(&kernel.p);
    check_finds(KEEL_ERR_UTILISATION, 1u);
}

static void SCH_004_add_before_the_start_checks_the_task_alone(void)
{
    board_init(10u);
    kernel.a.config.budget_us = 5000u; /* Never admissible, but that is for the start to say. */
    add(&kernel.a);
    TEST_ASSERT_EQUAL_UINT32(1u, kernel.scheduler.queue.count);
}

static void SCH_004_add_after_the_start_arms_the_task_from_now(void)
{
    board_init(0u);
    start();
    step_at(5000u);
    kernel.o.config.phase_us = 300u;
    kernel.o.task.stats.runs = 7u;
    kernel.o.task.skipped = 7u;
    add(&kernel.o);
    TEST_ASSERT_EQUAL_UINT64(5300u, kernel.o.task.release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.o.task.stats.runs);
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.o.task.skipped);
    step_at(5299u);
    ran("");
    step_at(5300u);
    ran("O");
}

static void SCH_004_add_after_the_start_wakes_the_scheduler(void)
{
    board_init(0u);
    kernel.a.config.phase_us = 900u;
    add(&kernel.a);
    start();
    step_at(100u); /* Idle until 900. */
    TEST_ASSERT_EQUAL_UINT64(900u, kernel.scheduler.wake_us);
    kernel.o.config.phase_us = 50u;
    add(&kernel.o);
    step_at(149u);
    ran("");
    step_at(150u);
    ran("O");
}

static void add_is_refused(keel_status_t reason, actor_t *actor)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_add(&kernel.scheduler, &actor->task));
    unchanged();
}

/* Every reason of keel_task_check, then mended; the queue is as before. */
static void refuses_bad_declarations(void)
{
    kernel.o.task.config = NULL;
    add_is_refused(KEEL_ERR_NULL, &kernel.o);
    kernel.o.task.config = &kernel.o.config;
    kernel.o.config.run = NULL;
    add_is_refused(KEEL_ERR_NULL, &kernel.o);
    kernel.o.config.run = actor_run;
    kernel.o.config.period_us = 0u;
    add_is_refused(KEEL_ERR_PERIOD, &kernel.o);
    kernel.o.config.period_us = 0x80000000u;
    add_is_refused(KEEL_ERR_PERIOD, &kernel.o);
    kernel.o.config.period_us = 2000u;
    kernel.o.config.phase_us = 2000u;
    add_is_refused(KEEL_ERR_PHASE, &kernel.o);
    kernel.o.config.phase_us = 0u;
    kernel.o.config.budget_us = 0u;
    add_is_refused(KEEL_ERR_BUDGET_ZERO, &kernel.o);
    kernel.o.config.budget_us = 50u;
    kernel.o.config.priority = 5u;
    add_is_refused(KEEL_ERR_PRIORITY, &kernel.o);
    kernel.o.config.priority = KEEL_PRIORITY_LOW;
}

static void SCH_005_add_refuses_null(void)
{
    board_init(0u);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_add(NULL, &kernel.a.task));
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_add(&kernel.scheduler, NULL));
    unchanged();
}

static void SCH_005_add_refuses_bad_declarations(void)
{
    board_init(0u);
    refuses_bad_declarations();
    add(&kernel.a);
    start();
    step();
    refuses_bad_declarations();
    add(&kernel.o);
}

static void SCH_005_add_refuses_a_duplicate(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    add_is_refused(KEEL_ERR_DUPLICATE, &kernel.a);
    start();
    add_is_refused(KEEL_ERR_DUPLICATE, &kernel.o);
}

static void fill_with_a_crowd(void)
{
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        declare(&kernel.crowd[i], 'x', KEEL_PRIORITY_LOW, 1000000u, 1u);
        add(&kernel.crowd[i]);
    }
}

static void SCH_005_add_refuses_when_full(void)
{
    board_init(0u);
    fill_with_a_crowd();
    add_is_refused(KEEL_ERR_FULL, &kernel.a);
    add_is_refused(KEEL_ERR_DUPLICATE, &kernel.crowd[0]);
    start();
    add_is_refused(KEEL_ERR_FULL, &kernel.o);
}

static void SCH_005_add_after_the_start_refuses_what_is_not_admitted(void)
{
    board_init(10u);
    add(&kernel.a);
    start();
    kernel.b.config.budget_us = 971u;
    add_is_refused(KEEL_ERR_REALTIME_DEMAND, &kernel.b);
    kernel.o.config.budget_us = 981u;
    add_is_refused(KEEL_ERR_BUDGET_GAP, &kernel.o);
    kernel.p.config.budget_us = 980u;
    kernel.p.config.period_us = 985u;
    add_is_refused(KEEL_ERR_UTILISATION, &kernel.p);
    kernel.b.config.budget_us = 970u;
    add(&kernel.b);
}

/* Nobody may write the limit of a started scheduler. If it is written nonetheless, so that the
 * set that runs breaks it, the kernel still refuses rather than add to the load. */
static void SCH_005_add_refuses_when_the_set_itself_is_not_admitted(void)
{
    board_init(10u);
    add(&kernel.a);
    start();
    kernel.scheduler.config.utilisation_limit = 9999u; /* A takes 1 %. */
    add_is_refused(KEEL_ERR_UTILISATION, &kernel.o);
}

static void SCH_007_remove_takes_the_task_out(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    discard(&kernel.a);
    start();
    step();
    ran("B");
    discard(&kernel.b);
    step_at(5000u);
    ran("");
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.scheduler.queue.count);
    TEST_ASSERT_EQUAL_UINT32(1u, kernel.b.task.stats.runs);
}

static void SCH_007_remove_makes_the_scheduler_decide_anew(void)
{
    board_init(0u);
    add(&kernel.a);
    kernel.o.config.phase_us = 150u;
    kernel.o.config.budget_us = 900u;
    add(&kernel.o);
    start();
    step();        /* A runs. */
    step_at(150u); /* O is released but does not fit the 850 us before A. */
    ran("A");
    TEST_ASSERT_EQUAL_UINT64(1000u, kernel.scheduler.wake_us);
    discard(&kernel.a);
    step_at(151u);
    ran("O");
}

static void SCH_008_remove_refuses_null_and_strangers(void)
{
    board_init(0u);
    add(&kernel.a);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_remove(NULL, &kernel.a.task));
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_remove(&kernel.scheduler, NULL));
    TEST_ASSERT_EQUAL(KEEL_ERR_UNKNOWN_TASK,
                      keel_scheduler_remove(&kernel.scheduler, &kernel.b.task));
    unchanged();
}

/* --- Starting --- */

static void SCH_009_start_sets_time_and_releases(void)
{
    board_reset(0xFFFFFF00u);
    board_init(0u);
    kernel.a.config.phase_us = 7u;
    kernel.o.config.phase_us = 1999u;
    kernel.a.task.skipped = 5u;
    kernel.a.task.release_us = 99u;
    add(&kernel.a);
    add(&kernel.o);
    start();
    TEST_ASSERT_EQUAL_UINT64(0u, kernel.scheduler.clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0xFFFFFF00u, kernel.scheduler.clock.raw_us);
    TEST_ASSERT_EQUAL_UINT64(7u, kernel.a.task.release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.a.task.skipped);
    TEST_ASSERT_EQUAL_UINT64(1999u, kernel.o.task.release_us);
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, kernel.scheduler.stage);
    TEST_ASSERT_EQUAL_UINT32(1u, board.reads);
    ran("");
}

static void SCH_009_start_at_takes_the_reading(void)
{
    board_init(0u);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_start_at(&kernel.scheduler, 4711u));
    TEST_ASSERT_EQUAL_UINT32(4711u, kernel.scheduler.clock.raw_us);
    TEST_ASSERT_EQUAL_UINT32(0u, board.reads);
}

static void start_is_refused(keel_status_t reason)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_start(&kernel.scheduler));
    TEST_ASSERT_EQUAL(reason, keel_scheduler_start_at(&kernel.scheduler, 4711u));
    unchanged();
}

static void SCH_010_start_refuses_null(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_start(NULL));
}

static void SCH_010_start_refuses_a_second_time(void)
{
    board_init(0u);
    add(&kernel.a);
    start();
    start_is_refused(KEEL_ERR_STATE);
    step();
    start_is_refused(KEEL_ERR_STATE);
}

static void SCH_010_start_refuses_what_is_not_admitted(void)
{
    board_init(10u);
    add(&kernel.a);
    kernel.b.config.budget_us = 971u;
    add(&kernel.b);
    start_is_refused(KEEL_ERR_REALTIME_DEMAND);
    discard(&kernel.b);
    kernel.o.config.budget_us = 981u;
    add(&kernel.o);
    start_is_refused(KEEL_ERR_BUDGET_GAP);
    discard(&kernel.o);
    kernel.p.config.budget_us = 980u;
    kernel.p.config.period_us = 985u;
    add(&kernel.p);
    start_is_refused(KEEL_ERR_UTILISATION);
    discard(&kernel.p);
    start();
}

/* --- Order of service --- */

static void SCH_015_due_realtime_tasks_run_in_queue_order(void)
{
    board_init(0u);
    add(&kernel.c);
    add(&kernel.a);
    add(&kernel.b);
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
    kernel.b.config.phase_us = 500u;
    add(&kernel.a);
    add(&kernel.b);
    add(&kernel.c);
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
    kernel.b.config.phase_us = 10u; /* Falls due just when A ends. */
    kernel.c.config.phase_us = 31u; /* Falls due 1 us after B ends. */
    add(&kernel.a);
    add(&kernel.b);
    add(&kernel.c);
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
    kernel.a.config.phase_us = 5u;
    add(&kernel.a);
    add(&kernel.b); /* While B runs, A falls due, which stands before it. */
    start();
    step();
    ran("B");
    step();
    ran("A");
}

static void SCH_016_at_most_one_other_task_a_step(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    add(&kernel.p);
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
    kernel.o.config.priority = KEEL_PRIORITY_HIGH;
    add(&kernel.o);
    add(&kernel.p);
    start();
    step();
    ran("O");
    step();
    ran("P");
}

static void SCH_016_released_tasks_only(void)
{
    board_init(0u);
    kernel.o.config.phase_us = 100u;
    add(&kernel.o);
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
    kernel.a.config.phase_us = 170u;
    kernel.o.config.phase_us = 100u;
    add(&kernel.a);
    add(&kernel.o);
    start();
    step_at(100u); /* 20 + 50 = 70 */
    ran("O");
    step_at(170u);
    ran("A");
}

static void SCH_016_waits_when_it_is_one_microsecond_too_long(void)
{
    board_init(20u);
    kernel.a.config.phase_us = 169u;
    kernel.o.config.phase_us = 100u;
    add(&kernel.a);
    add(&kernel.o);
    start();
    step_at(100u);
    ran("");
    step_at(169u);
    ran("AO"); /* Now there are 990 us. */
}

static void SCH_016_no_other_task_while_a_realtime_task_is_due(void)
{
    board_init(0u);
    kernel.a.cost_us = 1000u; /* A overruns until its next release. */
    add(&kernel.a);
    add(&kernel.o);
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
    kernel.a.config.phase_us = 999u;
    kernel.o.config.phase_us = 900u;
    kernel.o.cost_us = cost_us;
    add(&kernel.a);
    add(&kernel.o);
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
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.o.task.stats.overruns);
    step_at(2999u);
    ran("AO");                    /* Now there are 990 us. */
    second_run_at_2900(30u, "O"); /* The budget, not the shorter run, counts. */
}

/* --- Releases and statistics --- */

static void SCH_014_releases_stay_on_the_grid(void)
{
    board_init(0u);
    kernel.a.config.phase_us = 100u;
    add(&kernel.a);
    start();
    step_at(150u);
    TEST_ASSERT_EQUAL_UINT64(1100u, kernel.a.task.release_us);
    step_at(2099u); /* 999 late. */
    TEST_ASSERT_EQUAL_UINT64(2100u, kernel.a.task.release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.a.task.skipped);
    step_at(5234u); /* The releases at 3100 and 4100 and 5100: two are missed. */
    TEST_ASSERT_EQUAL_UINT64(6100u, kernel.a.task.release_us);
    TEST_ASSERT_EQUAL_UINT32(3u, kernel.a.task.skipped);
    ran("AAA");
}

static void SCH_014_next_gives_null_unless_a_pass_is_open(void)
{
    board_init(0u);
    add(&kernel.a);
    remember();
    TEST_ASSERT_NULL(keel_scheduler_next(&kernel.scheduler));
    unchanged();
    start();
    remember();
    TEST_ASSERT_NULL(keel_scheduler_next(&kernel.scheduler));
    unchanged();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(&kernel.scheduler, 0u));
    TEST_ASSERT_EQUAL_PTR(&kernel.a.task, keel_scheduler_next(&kernel.scheduler));
    remember();
    TEST_ASSERT_NULL(keel_scheduler_next(&kernel.scheduler)); /* A runs. */
    unchanged();
}

static void SCH_017_finish_records_the_run(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    start();
    kernel.a.cost_us = 8u;
    step();
    kernel.a.cost_us = 25u; /* 15 more than the budget. */
    step_at(1000u);
    kernel.a.cost_us = 9u;
    step_at(2000u);
    ran("AOAAO");
    TEST_ASSERT_EQUAL_UINT32(3u, kernel.a.task.stats.runs);
    TEST_ASSERT_EQUAL_UINT64(42u, kernel.a.task.stats.total_us);
    TEST_ASSERT_EQUAL_UINT32(9u, kernel.a.task.stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(25u, kernel.a.task.stats.longest_us);
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.a.task.stats.overruns);
    TEST_ASSERT_EQUAL_UINT16(0u, kernel.a.task.stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(2u, kernel.o.task.stats.runs);
    TEST_ASSERT_EQUAL_UINT64(142u, kernel.scheduler.busy_us);
    TEST_ASSERT_EQUAL_UINT64(2059u, kernel.scheduler.clock.now_us);
}

static void SCH_017_begin_next_finish_make_a_step(void)
{
    keel_scheduler_t *const s = &kernel.scheduler;

    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(s, 100u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_PASS, s->stage);
    TEST_ASSERT_EQUAL_PTR(&kernel.a.task, keel_scheduler_next(s));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_REALTIME, s->stage);
    TEST_ASSERT_EQUAL_UINT32(0u, s->running);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_finish(s, 111u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_PASS, s->stage);
    TEST_ASSERT_EQUAL_UINT32(KEEL_INDEX_NONE, s->running);
    TEST_ASSERT_EQUAL_PTR(&kernel.o.task, keel_scheduler_next(s));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_OTHER, s->stage);
    TEST_ASSERT_EQUAL_UINT32(1u, s->running);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_finish(s, 160u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, s->stage);
    TEST_ASSERT_EQUAL_UINT32(11u, kernel.a.task.stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(49u, kernel.o.task.stats.last_us);
    TEST_ASSERT_EQUAL_UINT64(60u, s->busy_us);
}

static void SCH_023_without_a_pass_nothing_runs(void)
{
    board_init(0u);
    add(&kernel.a);
    start();
    remember();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_run_pass(&kernel.scheduler));
    unchanged();
    ran("");
}

static void SCH_023_begin_and_run_pass_make_a_step(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    add(&kernel.o);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(&kernel.scheduler, 0u));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_run_pass(&kernel.scheduler));
    ran("ABO");
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, kernel.scheduler.stage);
}

static void SCH_018_finish_refuses_when_nothing_runs(void)
{
    keel_scheduler_t *const s = &kernel.scheduler;

    board_init(0u);
    add(&kernel.a);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_scheduler_finish(s, 5u));
    unchanged();
    start();
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_scheduler_finish(s, 5u));
    unchanged();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(s, 0u));
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_scheduler_finish(s, 5u));
    unchanged();
}

static void SCH_018_broken_clock_ends_the_pass(void)
{
    keel_scheduler_t *const s = &kernel.scheduler;

    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(s, 100u));
    TEST_ASSERT_EQUAL_PTR(&kernel.a.task, keel_scheduler_next(s));
    TEST_ASSERT_EQUAL(KEEL_ERR_CLOCK, keel_scheduler_finish(s, 99u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, s->stage);
    TEST_ASSERT_EQUAL_UINT32(KEEL_INDEX_NONE, s->running);
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.a.task.stats.runs);
    TEST_ASSERT_EQUAL_UINT64(0u, s->busy_us);
    TEST_ASSERT_EQUAL_UINT64(100u, s->clock.now_us);
    /* A was served; B is not skipped, it waits for the clock. */
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(s, 100u));
    TEST_ASSERT_EQUAL_PTR(&kernel.b.task, keel_scheduler_next(s));
}

/* --- Sleeping --- */

static void SCH_012_an_idle_step_reads_the_clock_alone(void)
{
    board_init(0u);
    kernel.a.config.phase_us = 700u;
    add(&kernel.a);
    add(&kernel.o);
    start();
    step();
    ran("O");
    step();
    TEST_ASSERT_EQUAL_UINT64(700u, kernel.scheduler.wake_us);
    board.reads = 0u;
    remember();
    board.raw_us = 699u;
    step();
    TEST_ASSERT_EQUAL_UINT32(1u, board.reads);
    ran("");
    kernel_before.scheduler.clock.now_us = 699u;
    kernel_before.scheduler.clock.raw_us = 699u;
    unchanged(); /* Nothing but the time. */
}

static void SCH_012_wakes_for_a_release_and_not_before(void)
{
    board_init(0u);
    kernel.a.config.phase_us = 700u;
    add(&kernel.a);
    start();
    for (uint64_t now_us = 0u; now_us < 700u; now_us += 1u) {
        step_at(now_us);
    }
    ran("");
    step_at(700u);
    ran("A");
}

static void SCH_012_a_pass_that_ran_a_task_does_not_sleep(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    add(&kernel.p);
    start();
    step();
    TEST_ASSERT_EQUAL_UINT64(0u, kernel.scheduler.wake_us);
    step();
    TEST_ASSERT_EQUAL_UINT64(0u, kernel.scheduler.wake_us);
    step();
    TEST_ASSERT_EQUAL_UINT64(1000u, kernel.scheduler.wake_us);
    ran("APO");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(&kernel.scheduler, 1000u));
    TEST_ASSERT_EQUAL_UINT64(0u, kernel.scheduler.wake_us); /* As finish demands. */
}

static void SCH_012_sleeps_for_ever_without_tasks(void)
{
    board_init(0u);
    start();
    step();
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, kernel.scheduler.wake_us);
    add(&kernel.a);
    step();
    ran("A");
}

static void SCH_012_wakes_for_a_promotion(void)
{
    board_init(20u);
    kernel.o.task.config = &kernel.o.config;
    kernel.o.config.period_us = 100u;
    kernel.o.config.priority = KEEL_PRIORITY_HIGH;
    kernel.a.config.phase_us = 999u;
    add(&kernel.a);
    add(&kernel.o);
    start();
    kernel.o.task.stats.longest_us = 5000u; /* Fits no gap. */
    step();
    /* Promoted at age 375, which is 275 behind the release. */
    TEST_ASSERT_EQUAL_UINT64(275u, kernel.scheduler.wake_us);
    step_at(274u);
    ran("");
    step_at(275u);
    ran("O");
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.o.task.stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(2u, kernel.o.task.skipped);
    TEST_ASSERT_EQUAL_UINT64(300u, kernel.o.task.release_us);
}

/* --- Promotion --- */

/* A real-time task that leaves 950 us of each 1000, and another whose first run takes 950. */
static void SCH_016_a_long_run_is_outlived_through_promotion(void)
{
    board_init(10u);
    declare(&kernel.a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 50u);
    declare(&kernel.o, 'O', KEEL_PRIORITY_HIGH, 10000u, 100u);
    kernel.o.cost_us = 950u;
    add(&kernel.a);
    add(&kernel.o);
    start();
    step();
    ran("AO");
    TEST_ASSERT_EQUAL_UINT32(950u, kernel.o.task.stats.longest_us);
    kernel.o.cost_us = 90u;
    /* Released at 10000, it never fits again: 10 + 950 > 950. Promoted at 3.75 periods. */
    for (uint64_t now_us = 1000u; now_us < 37500u; now_us += 50u) {
        step_at(now_us);
    }
    ran("AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"); /* 1000, 2000, ... 37000 */
    step_at(37500u);
    ran("O");
    TEST_ASSERT_EQUAL_UINT32(2u, kernel.o.task.stats.runs);
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.o.task.stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(2u, kernel.o.task.skipped); /* of the releases 10000 to 30000 */
    TEST_ASSERT_EQUAL_UINT64(40000u, kernel.o.task.release_us);
}

static void SCH_016_promoted_runs_behind_due_realtime_tasks(void)
{
    board_init(10u);
    declare(&kernel.p, 'P', KEEL_PRIORITY_HIGH, 1000u, 60u);
    add(&kernel.a);
    add(&kernel.o);
    add(&kernel.p);
    start();
    step_at(3000u); /* P: age 4000 of 1000, promoted; O: 1 + 5000 / 2000. */
    ran("AP");
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.p.task.stats.promotions);
    TEST_ASSERT_EQUAL_UINT16(0u, kernel.o.task.stats.promotions);
    step();
    ran("O");
    TEST_ASSERT_EQUAL_UINT16(0u, kernel.o.task.stats.promotions);
}

static void SCH_016_promoted_tasks_run_first_come_first_served(void)
{
    board_init(0u);
    add(&kernel.o);
    add(&kernel.p);
    start();
    step_at(100000u); /* Both are promoted: queue order, not class. */
    ran("O");
    step();
    ran("P");
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.o.task.stats.promotions);
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.p.task.stats.promotions);
    step_at(102000u);
    step();
    ran("PO"); /* Served, they compete by class again. */
    TEST_ASSERT_EQUAL_UINT16(1u, kernel.p.task.stats.promotions);
}

/* --- Adding and removing from inside a running task --- */

static void remove_a(void)
{
    discard(&kernel.a);
}

static void remove_b(void)
{
    discard(&kernel.b);
}

static void remove_o(void)
{
    discard(&kernel.o);
}

static void add_d(void)
{
    kernel.p.act = NULL;
    kernel.o.act = NULL;
    kernel.a.act = NULL;
    add(&kernel.d);
}

static void add_p(void)
{
    kernel.o.act = NULL;
    add(&kernel.p);
}

static void readd_a(void)
{
    discard(&kernel.a);
    add(&kernel.a);
    kernel.a.act = NULL;
}

static void with_a_b_c(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    add(&kernel.c);
    start();
}

/* Each task that ran has its own time and no other's. */
static void took(const actor_t *actor, uint32_t runs)
{
    TEST_ASSERT_EQUAL_UINT32(runs, actor->task.stats.runs);
    TEST_ASSERT_EQUAL_UINT32((runs > 0u) ? actor->cost_us : 0u, actor->task.stats.last_us);
    TEST_ASSERT_EQUAL_UINT64((uint64_t)runs * actor->cost_us, actor->task.stats.total_us);
}

static void SCH_007_a_task_removes_itself(void)
{
    with_a_b_c();
    kernel.a.act = remove_a;
    step();
    ran("ABC");
    took(&kernel.a, 0u); /* It left before its run was over; the time counts as busy. */
    took(&kernel.b, 1u);
    took(&kernel.c, 1u);
    TEST_ASSERT_EQUAL_UINT64(60u, kernel.scheduler.busy_us);
    step_at(1000u);
    ran("BC");
}

static void SCH_007_the_last_task_removes_itself(void)
{
    board_init(0u);
    add(&kernel.a);
    start();
    kernel.a.act = remove_a;
    step();
    ran("A");
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.scheduler.queue.count);
    step_at(1000u);
    ran("");
}

static void SCH_007_a_task_removes_an_earlier_one(void)
{
    with_a_b_c();
    kernel.b.act = remove_a;
    step();
    ran("ABC");
    took(&kernel.a, 1u);
    took(&kernel.b, 1u);
    took(&kernel.c, 1u);
    kernel.b.act = NULL;
    step_at(1000u);
    ran("BC");
}

static void SCH_007_a_task_removes_a_later_one(void)
{
    with_a_b_c();
    kernel.a.act = remove_b;
    step();
    ran("AC");
    took(&kernel.a, 1u);
    took(&kernel.b, 0u);
    took(&kernel.c, 1u);
    kernel.a.act = NULL;
    step_at(1000u);
    ran("AC");
}

static void SCH_007_removing_the_next_task_runs_none_twice(void)
{
    with_a_b_c();
    kernel.a.cost_us = 1000u; /* Due again when it ends. */
    kernel.a.act = remove_b;
    step();
    ran("AC");
    took(&kernel.a, 1u);
}

static void SCH_007_removing_the_first_other_task_skips_no_realtime_one(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    add(&kernel.o);
    start();
    kernel.a.act = remove_o;
    step();
    ran("AB");
}

static void SCH_007_other_task_removes_itself(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    add(&kernel.p);
    start();
    kernel.o.act = remove_o;
    step();
    step();
    ran("APO");
    took(&kernel.o, 0u);
    step_at(2000u);
    step();
    ran("AP");
}

static void SCH_007_other_task_removes_a_realtime_one(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    add(&kernel.o);
    add(&kernel.p);
    start();
    kernel.p.act = remove_a;
    step();
    ran("ABP");
    took(&kernel.p, 1u); /* Its index moved while it ran. */
    took(&kernel.o, 0u);
    took(&kernel.b, 1u);
}

static void SCH_004_a_realtime_task_added_in_a_pass_waits_for_the_next(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    start();
    kernel.a.act = add_d;
    step();
    ran("AB");
    TEST_ASSERT_EQUAL_UINT64(0u, kernel.d.task.release_us); /* From the time A started. */
    step();
    ran("D");
    took(&kernel.a, 1u);
    took(&kernel.b, 1u);
    took(&kernel.d, 1u);
    step_at(1000u);
    ran("ABD");
}

static void SCH_004_other_task_adds_a_realtime_one(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    add(&kernel.p);
    start();
    kernel.p.act = add_d;
    step();
    ran("AP");
    took(&kernel.p, 1u); /* Its index moved while it ran. */
    took(&kernel.o, 0u);
    took(&kernel.d, 0u);
    step();
    ran("DO");
}

static void SCH_004_the_first_other_task_adds_a_realtime_one(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    start();
    kernel.o.act = add_d; /* D takes the very slot of O. */
    step();
    ran("AO");
    took(&kernel.o, 1u);
    took(&kernel.d, 0u);
}

static void SCH_004_other_task_adds_another(void)
{
    board_init(0u);
    add(&kernel.o);
    start();
    kernel.o.act = add_p;
    step();
    ran("O");
    took(&kernel.o, 1u);
    took(&kernel.p, 0u);
    step();
    ran("P");
}

static void SCH_004_a_task_added_anew_by_itself_waits_for_the_next_pass(void)
{
    with_a_b_c();
    kernel.a.act = readd_a;
    step();
    ran("ABC");
    took(&kernel.a, 0u); /* Armed anew: no statistics. */
    TEST_ASSERT_EQUAL_UINT64(0u, kernel.a.task.release_us);
    step();
    ran("A");
    took(&kernel.a, 1u);
    step_at(1000u);
    ran("BCA");
}

static void swap_o_for_d(void)
{
    discard(&kernel.o);
    add(&kernel.d);
}

static void SCH_004_a_task_adds_after_it_has_removed_itself(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.o);
    start();
    kernel.o.act = swap_o_for_d;
    step();
    ran("AO");
    took(&kernel.o, 0u);
    took(&kernel.d, 0u);
    step();
    ran("D");
}

/* --- Refusals of a step --- */

static void step_is_refused(keel_status_t reason)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_step(&kernel.scheduler));
    unchanged();
    ran("");
}

static void SCH_013_step_refuses_null(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_step(NULL));
}

static void SCH_013_step_refuses_before_the_start(void)
{
    board_init(0u);
    add(&kernel.a);
    step_is_refused(KEEL_ERR_STATE);
}

static keel_status_t inner_status[4];

static void call_everything(void)
{
    inner_status[0] = keel_scheduler_step(&kernel.scheduler);
    inner_status[1] = keel_scheduler_begin(&kernel.scheduler, 5u);
    inner_status[2] = keel_scheduler_start(&kernel.scheduler);
    inner_status[3] = keel_scheduler_resync(&kernel.scheduler);
}

static void refused_inside(actor_t *actor)
{
    memset(inner_status, 0, sizeof inner_status);
    actor->act = call_everything;
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_EQUAL(KEEL_OK, inner_status[i]);
    }
    step();
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_EQUAL(KEEL_ERR_STATE, inner_status[i]);
    }
}

static void SCH_013_step_refuses_inside_a_running_task(void)
{
    board_init(0u);
    kernel.o.config.phase_us = 500u;
    add(&kernel.a);
    add(&kernel.o);
    start();
    refused_inside(&kernel.a);
    ran("A");
    took(&kernel.a, 1u);
    wait_us(600u);
    refused_inside(&kernel.o);
    ran("O");
    took(&kernel.o, 1u);
}

static void SCH_013_begin_refuses_in_an_open_pass(void)
{
    board_init(0u);
    add(&kernel.a);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(&kernel.scheduler, 0u));
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_scheduler_begin(&kernel.scheduler, 10u));
    unchanged();
}

static void SCH_013_step_refuses_a_backwards_clock(void)
{
    board_init(0u);
    add(&kernel.a);
    start();
    step_at(500u);
    ran("A");
    wait_us(0xFFFFFFFFu); /* One back. */
    step_is_refused(KEEL_ERR_CLOCK);
    wait_us(0x80000001u); /* 2^31 on from the last good reading. */
    step_is_refused(KEEL_ERR_CLOCK);
    wait_us(0xFFFFFFFFu); /* 2^31 - 1 on: the longest good step. */
    step();
    ran("A");
    TEST_ASSERT_EQUAL_UINT64(510u + 0x7FFFFFFFu + 10u, kernel.scheduler.clock.now_us);
}

static void resync_adopts_the_clock(void)
{
    board_init(0u);
    kernel.a.config.phase_us = 600u;
    add(&kernel.a);
    start();
    step_at(500u);
    board.raw_us = 90u;
    step_is_refused(KEEL_ERR_CLOCK);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_resync(&kernel.scheduler));
    TEST_ASSERT_EQUAL_UINT32(90u, kernel.scheduler.clock.raw_us);
    TEST_ASSERT_EQUAL_UINT64(500u, kernel.scheduler.clock.now_us); /* Time stands still. */
    board.raw_us = 189u;
    step();
    ran("");
    board.raw_us = 190u; /* 100 us on: A's release at 600. */
    step();
    ran("A");
}

static void step_the_clock_back(void)
{
    kernel.a.act = NULL;
    board.raw_us = 40u;
}

static void resync_after_a_task_s_clock_jumped(void)
{
    board_init(0u);
    add(&kernel.a);
    add(&kernel.b);
    start();
    wait_us(100u);
    kernel.a.act = step_the_clock_back;
    TEST_ASSERT_EQUAL(KEEL_ERR_CLOCK, keel_scheduler_step(&kernel.scheduler));
    ran("A");
    step_is_refused(KEEL_ERR_CLOCK);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_resync(&kernel.scheduler));
    step();
    ran("B"); /* A is served already, B still due. */
    TEST_ASSERT_EQUAL_UINT64(120u, kernel.scheduler.clock.now_us);
}

static void resync_is_refused(keel_status_t reason)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_resync(&kernel.scheduler));
    unchanged();
}

static void resync_refuses_null_and_wrong_stages(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_resync(NULL));
    board_init(0u);
    add(&kernel.a);
    resync_is_refused(KEEL_ERR_STATE);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_begin(&kernel.scheduler, 0u));
    resync_is_refused(KEEL_ERR_STATE);
}

/* --- The wrap --- */

/* The same schedule wherever the counter stands. Guard 10; A every 1000 takes 50, B every 2500
 * takes 20, O every 3000 takes 100, all from 0. Steps every 100 us up to 6000:
 *     0     A 0-50, B 50-70, O 70-170    1000  A    2000  A    2500  B
 *     3000  A, then O 3050-3150          4000  A    5000  A, B 5050-5070
 *     6000  A, O */
static void schedule_is_the_same_from(uint32_t raw_us)
{
    board_reset(raw_us);
    board_init(10u);
    declare(&kernel.a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 50u);
    declare(&kernel.b, 'B', KEEL_PRIORITY_REALTIME, 2500u, 20u);
    declare(&kernel.o, 'O', KEEL_PRIORITY_MEDIUM, 3000u, 100u);
    add(&kernel.a);
    add(&kernel.b);
    add(&kernel.o);
    start();
    step();
    for (uint64_t now_us = 200u; now_us <= 6000u; now_us += 100u) {
        if (kernel.scheduler.clock.now_us <= now_us) {
            step_at(now_us);
        }
    }
    ran("ABOAABAOAABAO");
    TEST_ASSERT_EQUAL_UINT64(6150u, kernel.scheduler.clock.now_us);
    TEST_ASSERT_EQUAL_UINT64(710u, kernel.scheduler.busy_us); /* 7 * 50 + 3 * 20 + 3 * 100 */
    TEST_ASSERT_EQUAL_UINT64(7000u, kernel.a.task.release_us);
    TEST_ASSERT_EQUAL_UINT64(7500u, kernel.b.task.release_us);
    TEST_ASSERT_EQUAL_UINT64(9000u, kernel.o.task.release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, kernel.a.task.skipped);
}

static void CLK_003_schedule_is_the_same_across_the_wrap(void)
{
    schedule_is_the_same_from(0u);
    schedule_is_the_same_from(0xFFFFFF00u);
    schedule_is_the_same_from(0xFFFFFFFFu);
    schedule_is_the_same_from(0x7FFFFFF0u);
    for (uint32_t i = 1u; i <= 6000u; i += 61u) {
        schedule_is_the_same_from(UINT32_MAX - i);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SCH_001_init_makes_an_empty_scheduler);
    RUN_TEST(SCH_002_init_refuses_null);
    RUN_TEST(SCH_002_init_refuses_limits_out_of_range);
    RUN_TEST(SCH_003_check_names_the_offender);
    RUN_TEST(SCH_004_add_before_the_start_checks_the_task_alone);
    RUN_TEST(SCH_004_add_after_the_start_arms_the_task_from_now);
    RUN_TEST(SCH_004_add_after_the_start_wakes_the_scheduler);
    RUN_TEST(SCH_005_add_refuses_null);
    RUN_TEST(SCH_005_add_refuses_bad_declarations);
    RUN_TEST(SCH_005_add_refuses_a_duplicate);
    RUN_TEST(SCH_005_add_refuses_when_full);
    RUN_TEST(SCH_005_add_after_the_start_refuses_what_is_not_admitted);
    RUN_TEST(SCH_005_add_refuses_when_the_set_itself_is_not_admitted);
    RUN_TEST(SCH_007_remove_takes_the_task_out);
    RUN_TEST(SCH_007_remove_makes_the_scheduler_decide_anew);
    RUN_TEST(SCH_008_remove_refuses_null_and_strangers);
    RUN_TEST(SCH_009_start_sets_time_and_releases);
    RUN_TEST(SCH_009_start_at_takes_the_reading);
    RUN_TEST(SCH_010_start_refuses_null);
    RUN_TEST(SCH_010_start_refuses_a_second_time);
    RUN_TEST(SCH_010_start_refuses_what_is_not_admitted);
    RUN_TEST(SCH_015_due_realtime_tasks_run_in_queue_order);
    RUN_TEST(SCH_015_only_due_realtime_tasks_run);
    RUN_TEST(SCH_015_clock_is_read_again_before_each_decision);
    RUN_TEST(SCH_015_a_pass_does_not_turn_back);
    RUN_TEST(SCH_016_at_most_one_other_task_a_step);
    RUN_TEST(SCH_016_ties_go_to_the_first_queued);
    RUN_TEST(SCH_016_released_tasks_only);
    RUN_TEST(SCH_016_runs_when_guard_and_worst_case_just_fit);
    RUN_TEST(SCH_016_waits_when_it_is_one_microsecond_too_long);
    RUN_TEST(SCH_016_no_other_task_while_a_realtime_task_is_due);
    RUN_TEST(SCH_016_worst_case_is_the_longest_run);
    RUN_TEST(SCH_014_releases_stay_on_the_grid);
    RUN_TEST(SCH_014_next_gives_null_unless_a_pass_is_open);
    RUN_TEST(SCH_017_finish_records_the_run);
    RUN_TEST(SCH_017_begin_next_finish_make_a_step);
    RUN_TEST(SCH_023_without_a_pass_nothing_runs);
    RUN_TEST(SCH_023_begin_and_run_pass_make_a_step);
    RUN_TEST(SCH_018_finish_refuses_when_nothing_runs);
    RUN_TEST(SCH_018_broken_clock_ends_the_pass);
    RUN_TEST(SCH_012_an_idle_step_reads_the_clock_alone);
    RUN_TEST(SCH_012_wakes_for_a_release_and_not_before);
    RUN_TEST(SCH_012_a_pass_that_ran_a_task_does_not_sleep);
    RUN_TEST(SCH_012_sleeps_for_ever_without_tasks);
    RUN_TEST(SCH_012_wakes_for_a_promotion);
    RUN_TEST(SCH_016_a_long_run_is_outlived_through_promotion);
    RUN_TEST(SCH_016_promoted_runs_behind_due_realtime_tasks);
    RUN_TEST(SCH_016_promoted_tasks_run_first_come_first_served);
    RUN_TEST(SCH_007_a_task_removes_itself);
    RUN_TEST(SCH_007_the_last_task_removes_itself);
    RUN_TEST(SCH_007_a_task_removes_an_earlier_one);
    RUN_TEST(SCH_007_a_task_removes_a_later_one);
    RUN_TEST(SCH_007_removing_the_next_task_runs_none_twice);
    RUN_TEST(SCH_007_removing_the_first_other_task_skips_no_realtime_one);
    RUN_TEST(SCH_007_other_task_removes_itself);
    RUN_TEST(SCH_007_other_task_removes_a_realtime_one);
    RUN_TEST(SCH_004_a_realtime_task_added_in_a_pass_waits_for_the_next);
    RUN_TEST(SCH_004_other_task_adds_a_realtime_one);
    RUN_TEST(SCH_004_the_first_other_task_adds_a_realtime_one);
    RUN_TEST(SCH_004_other_task_adds_another);
    RUN_TEST(SCH_004_a_task_added_anew_by_itself_waits_for_the_next_pass);
    RUN_TEST(SCH_004_a_task_adds_after_it_has_removed_itself);
    RUN_TEST(SCH_013_step_refuses_null);
    RUN_TEST(SCH_013_step_refuses_before_the_start);
    RUN_TEST(SCH_013_step_refuses_inside_a_running_task);
    RUN_TEST(SCH_013_begin_refuses_in_an_open_pass);
    RUN_TEST(SCH_013_step_refuses_a_backwards_clock);
    RUN_TEST(resync_adopts_the_clock);
    RUN_TEST(resync_after_a_task_s_clock_jumped);
    RUN_TEST(resync_refuses_null_and_wrong_stages);
    RUN_TEST(CLK_003_schedule_is_the_same_across_the_wrap);
    return UNITY_END();
}
