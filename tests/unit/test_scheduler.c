/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/scheduler.h on a virtual board. Schedules are worked out by hand. */
#include "actors.h"

static actor_t crowd[KEEL_QUEUE_CAPACITY];

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
    keel_scheduler_config_t config = board_config(25u);
    keel_scheduler_t *const s = &scheduler;

    config.without_promotion = true;
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
    TEST_ASSERT_EQUAL_UINT32(1000000u, s->config.utilisation_limit_ppm);
    TEST_ASSERT_TRUE(s->config.without_promotion);
    TEST_ASSERT_EQUAL_UINT64(0u, s->clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0u, s->clock.raw_us);
    TEST_ASSERT_EQUAL_UINT64(0u, s->wake_us);
    TEST_ASSERT_EQUAL_UINT64(0u, s->busy_us);
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_SETUP, s->stage);
    TEST_ASSERT_EQUAL_UINT32(0u, s->cursor);
    TEST_ASSERT_EQUAL_UINT32(0u, s->pass_end);
    TEST_ASSERT_EQUAL_UINT32(KEEL_POSITION_NONE, s->running);
    TEST_ASSERT_EQUAL_UINT64(0u, s->earliest_realtime_us);
    TEST_ASSERT_EQUAL_UINT64(0u, s->earliest_other_us);
    TEST_ASSERT_EQUAL_UINT32(0u, board.reads);
}

static void init_is_refused(keel_status_t reason, const keel_scheduler_config_t *config)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_init(&scheduler, config));
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
    config.utilisation_limit_ppm = 1000001u;
    init_is_refused(KEEL_ERR_CONFIG, &config);
    config.utilisation_limit_ppm = 1000000u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&scheduler, &config));
}

static void check_finds(keel_status_t status, uint32_t admitted)
{
    uint32_t found = UINT32_MAX;

    remember();
    TEST_ASSERT_EQUAL(status, keel_scheduler_check(&scheduler, &found));
    TEST_ASSERT_EQUAL_UINT32(admitted, found);
    unchanged();
}

static void start_is_refused(keel_status_t reason)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_start(&scheduler));
    unchanged();
}

static void SCH_003_check_names_the_offender(void)
{
    board_init(10u);
    check_finds(KEEL_OK, 0u);
    add(&a);
    check_finds(KEEL_OK, 1u);
    b.config.budget_us = 971u; /* 10 + 971 + 20 > 1000 */
    add(&b);
    check_finds(KEEL_ERR_REALTIME_DEMAND, 1u);
    discard(&b);
    o.config.budget_us = 981u; /* 981 + 10 > 990 */
    add(&o);
    check_finds(KEEL_ERR_BUDGET_GAP, 1u);
    discard(&o);
    p.config.budget_us = 980u;
    p.config.period_us = 985u; /* 1 % + 99.5 % */
    add(&p);
    check_finds(KEEL_ERR_UTILISATION, 1u);
}

static void SCH_004_add_before_the_start_checks_the_task_alone(void)
{
    board_init(10u);
    a.config.budget_us = 5000u; /* Never admissible, but that is for the start to say. */
    add(&a);
    TEST_ASSERT_EQUAL_UINT32(1u, scheduler.queue.count);
}

static void SCH_004_add_after_the_start_arms_the_task_from_now(void)
{
    board_init(0u);
    start();
    step_at(5000u);
    o.config.phase_us = 300u;
    add(&o);
    TEST_ASSERT_EQUAL_UINT64(5300u, report(&o).release_us);
    step_at(5299u);
    ran("");
    step_at(5300u);
    ran("O");
}

static void SCH_004_a_task_added_again_begins_anew(void)
{
    const keel_stats_t none = {0};
    keel_task_report_t again;

    board_init(0u);
    add(&p);
    start();
    p.cost_us = 61u;  /* An overrun. */
    step_at(100000u); /* Promoted, 50 periods late. */
    ran("P");
    TEST_ASSERT_EQUAL_UINT16(50u, report(&p).skipped);
    discard(&p);
    add(&p);
    again = report(&p);
    TEST_ASSERT_EQUAL_UINT64(100061u, again.release_us);
    TEST_ASSERT_EQUAL_UINT16(0u, again.skipped);
    TEST_ASSERT_EQUAL_MEMORY(&none, &again.stats, sizeof none);
}

static void SCH_004_add_after_the_start_wakes_the_scheduler(void)
{
    board_init(0u);
    a.config.phase_us = 900u;
    add(&a);
    start();
    step_at(100u); /* Idle until 900. */
    TEST_ASSERT_EQUAL_UINT64(900u, scheduler.wake_us);
    o.config.phase_us = 50u;
    add(&o);
    step_at(149u);
    ran("");
    step_at(150u);
    ran("O");
}

static void add_is_refused(keel_status_t reason, actor_t *actor)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_add(&scheduler, &actor->config));
    unchanged();
}

/* Every reason of keel_task_check, then mended; the queue is as before. */
static void refuses_bad_declarations(void)
{
    o.config.run = NULL;
    add_is_refused(KEEL_ERR_NULL, &o);
    o.config.run = actor_run;
    o.config.period_us = 0u;
    add_is_refused(KEEL_ERR_PERIOD, &o);
    o.config.period_us = 0x80000000u;
    add_is_refused(KEEL_ERR_PERIOD, &o);
    o.config.period_us = 2000u;
    o.config.phase_us = 2000u;
    add_is_refused(KEEL_ERR_PHASE, &o);
    o.config.phase_us = 0u;
    o.config.budget_us = 0u;
    add_is_refused(KEEL_ERR_BUDGET_ZERO, &o);
    o.config.budget_us = 50u;
    o.config.priority = 5u;
    add_is_refused(KEEL_ERR_PRIORITY, &o);
    o.config.priority = KEEL_PRIORITY_LOW;
}

static void SCH_005_add_refuses_null(void)
{
    board_init(0u);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_add(NULL, &a.config));
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_add(&scheduler, NULL));
    unchanged();
}

static void SCH_005_add_refuses_bad_declarations(void)
{
    board_init(0u);
    refuses_bad_declarations();
    add(&a);
    start();
    step();
    refuses_bad_declarations();
    add(&o);
}

static void SCH_005_add_refuses_a_duplicate(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    add_is_refused(KEEL_ERR_DUPLICATE, &a);
    start();
    add_is_refused(KEEL_ERR_DUPLICATE, &o);
}

static void fill_with_a_crowd(void)
{
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        declare(&crowd[i], 'x', KEEL_PRIORITY_LOW, 1000000u, 1u);
        add(&crowd[i]);
    }
}

static void SCH_005_add_refuses_when_full(void)
{
    board_init(0u);
    fill_with_a_crowd();
    add_is_refused(KEEL_ERR_FULL, &a);
    add_is_refused(KEEL_ERR_DUPLICATE, &crowd[0]);
    start();
    add_is_refused(KEEL_ERR_FULL, &o);
}

static void SCH_005_add_after_the_start_refuses_what_is_not_admitted(void)
{
    board_init(10u);
    add(&a);
    start();
    b.config.budget_us = 971u;
    add_is_refused(KEEL_ERR_REALTIME_DEMAND, &b);
    o.config.budget_us = 981u;
    add_is_refused(KEEL_ERR_BUDGET_GAP, &o);
    p.config.budget_us = 980u;
    p.config.period_us = 985u;
    add_is_refused(KEEL_ERR_UTILISATION, &p);
    b.config.budget_us = 970u;
    add(&b);
}

/* Guard 10; A leaves 990 us of each 1000. */
static void with_a(void)
{
    board_reset(0u);
    board_init(10u);
    add(&a);
}

/* And O, whose runs take up to 60 us. */
static void with_a_and_o(void)
{
    with_a();
    o.config.budget_us = 60u;
    add(&o);
}

/* The same A, when no more than a tenth of the time is to be used. */
static void with_a_and_a_tenth(void)
{
    keel_scheduler_config_t config = board_config(10u);

    config.utilisation_limit_ppm = 100000u;
    board_reset(0u);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&scheduler, &config));
    add(&a);
}

/* What a task declares, as far as admission looks at it. */
typedef struct claim {
    uint32_t period_us, budget_us;
} claim_t;

static void claims(actor_t *actor, claim_t claim)
{
    actor->config.period_us = claim.period_us;
    actor->config.budget_us = claim.budget_us;
}

/* A task is accepted after the start exactly as far as the rule goes. */
static void joins_up_to(void (*set_up)(void), actor_t *actor, claim_t good, claim_t bad,
                        keel_status_t reason)
{
    set_up();
    start();
    claims(actor, bad);
    add_is_refused(reason, actor);
    claims(actor, good);
    add(actor);
}

/* A set starts exactly as far as the rule goes; the offender is the task at a position. */
static void starts_up_to(void (*set_up)(void), actor_t *actor, claim_t good, claim_t bad,
                         keel_status_t reason, uint32_t offender)
{
    set_up();
    claims(actor, bad);
    add(actor);
    check_finds(reason, offender);
    start_is_refused(reason);
    discard(actor);
    claims(actor, good);
    add(actor);
    check_finds(KEEL_OK, scheduler.queue.count);
    start();
}

static const claim_t demand[2] = {{1000u, 970u}, {1000u, 971u}};  /* 10 + 970 + 2 * 10 = 1000 */
static const claim_t short_period[2] = {{60u, 30u}, {59u, 30u}};  /* 10 + 30 + 2 * 10 = 60 */
static const claim_t gap[2] = {{100000u, 980u}, {100000u, 981u}}; /* 980 + 10 = 990 */
static const claim_t gap_left[2] = {{100u, 30u}, {100u, 31u}};    /* 60 + 10 = 100 - 30 */
static const claim_t tenth[2] = {{2000u, 180u}, {2000u, 181u}};   /* 1 % + 9 % */
static const claim_t tenth_of[2] = {{2000u, 180u}, {1999u, 180u}};

static void SCH_004_add_after_the_start_accepts_all_that_can_be_scheduled(void)
{
    joins_up_to(with_a, &b, demand[0], demand[1], KEEL_ERR_REALTIME_DEMAND);
    joins_up_to(with_a, &b, short_period[0], short_period[1], KEEL_ERR_REALTIME_DEMAND);
    joins_up_to(with_a, &o, gap[0], gap[1], KEEL_ERR_BUDGET_GAP);
    joins_up_to(with_a_and_o, &b, gap_left[0], gap_left[1], KEEL_ERR_BUDGET_GAP);
    joins_up_to(with_a_and_a_tenth, &p, tenth[0], tenth[1], KEEL_ERR_UTILISATION);
    joins_up_to(with_a_and_a_tenth, &p, tenth_of[0], tenth_of[1], KEEL_ERR_UTILISATION);
}

static void SCH_009_start_accepts_all_that_can_be_scheduled(void)
{
    starts_up_to(with_a, &b, demand[0], demand[1], KEEL_ERR_REALTIME_DEMAND, 1u);
    starts_up_to(with_a, &b, short_period[0], short_period[1], KEEL_ERR_REALTIME_DEMAND, 1u);
    starts_up_to(with_a, &o, gap[0], gap[1], KEEL_ERR_BUDGET_GAP, 1u);
    /* B is before O in the queue, so it is O that no longer fits. */
    starts_up_to(with_a_and_o, &b, gap_left[0], gap_left[1], KEEL_ERR_BUDGET_GAP, 2u);
    starts_up_to(with_a_and_a_tenth, &p, tenth[0], tenth[1], KEEL_ERR_UTILISATION, 1u);
    starts_up_to(with_a_and_a_tenth, &p, tenth_of[0], tenth_of[1], KEEL_ERR_UTILISATION, 1u);
}

/* Nobody may write the limit of a started scheduler. If it is written nonetheless, so that the
 * set that runs breaks it, the kernel still refuses rather than add to the load. */
static void SCH_005_add_refuses_when_the_set_itself_is_not_admitted(void)
{
    board_init(10u);
    add(&a);
    start();
    scheduler.config.utilisation_limit_ppm = 9999u; /* A takes 1 %. */
    add_is_refused(KEEL_ERR_UTILISATION, &o);
}

static void SCH_007_remove_takes_the_task_out(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    discard(&a);
    start();
    step();
    ran("B");
    discard(&b);
    step_at(5000u);
    ran("");
    TEST_ASSERT_EQUAL_UINT32(0u, scheduler.queue.count);
    unknown(&b);
}

static void SCH_007_remove_makes_the_scheduler_decide_anew(void)
{
    board_init(0u);
    add(&a);
    o.config.phase_us = 150u;
    o.config.budget_us = 900u;
    add(&o);
    start();
    step();        /* A runs. */
    step_at(150u); /* O is released but does not fit the 850 us before A. */
    ran("A");
    TEST_ASSERT_EQUAL_UINT64(1000u, scheduler.wake_us);
    discard(&a);
    step_at(151u);
    ran("O");
}

static void SCH_008_remove_refuses_null_and_strangers(void)
{
    board_init(0u);
    add(&a);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_remove(NULL, &a.config));
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_remove(&scheduler, NULL));
    TEST_ASSERT_EQUAL(KEEL_ERR_UNKNOWN_TASK, keel_scheduler_remove(&scheduler, &b.config));
    unchanged();
}

/* --- Starting --- */

static void SCH_009_start_sets_time_and_releases(void)
{
    board_reset(0xFFFFFF00u);
    board_init(0u);
    a.config.phase_us = 7u;
    o.config.phase_us = 1999u;
    add(&a);
    add(&o);
    start();
    TEST_ASSERT_EQUAL_UINT64(0u, scheduler.clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(0xFFFFFF00u, scheduler.clock.raw_us);
    TEST_ASSERT_EQUAL_UINT64(7u, report(&a).release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, report(&a).skipped);
    TEST_ASSERT_EQUAL_UINT64(1999u, report(&o).release_us);
    TEST_ASSERT_EQUAL_UINT32(KEEL_STAGE_READY, scheduler.stage);
    TEST_ASSERT_EQUAL_UINT32(1u, board.reads);
    ran("");
}

static void SCH_010_start_refuses_null(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_start(NULL));
}

static void SCH_010_start_refuses_a_second_time(void)
{
    board_init(0u);
    add(&a);
    start();
    start_is_refused(KEEL_ERR_STATE);
    step();
    start_is_refused(KEEL_ERR_STATE);
}

static void SCH_010_start_refuses_what_is_not_admitted(void)
{
    board_init(10u);
    add(&a);
    b.config.budget_us = 971u;
    add(&b);
    start_is_refused(KEEL_ERR_REALTIME_DEMAND);
    discard(&b);
    o.config.budget_us = 981u;
    add(&o);
    start_is_refused(KEEL_ERR_BUDGET_GAP);
    discard(&o);
    p.config.budget_us = 980u;
    p.config.period_us = 985u;
    add(&p);
    start_is_refused(KEEL_ERR_UTILISATION);
    discard(&p);
    start();
}

/* --- Adding and removing from inside a running task --- */

static void remove_a(void)
{
    discard(&a);
}

static void remove_b(void)
{
    discard(&b);
}

static void remove_o(void)
{
    discard(&o);
}

static void add_d(void)
{
    p.act = NULL;
    o.act = NULL;
    a.act = NULL;
    add(&d);
}

static void add_p(void)
{
    o.act = NULL;
    add(&p);
}

static void readd_a(void)
{
    discard(&a);
    add(&a);
    a.act = NULL;
}

static void with_a_b_c(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    add(&c);
    start();
}

static void SCH_007_a_task_removes_itself(void)
{
    with_a_b_c();
    a.act = remove_a;
    step();
    ran("ABC");
    unknown(&a); /* It left before its run was over; the time counts as busy. */
    took(&b, 1u);
    took(&c, 1u);
    TEST_ASSERT_EQUAL_UINT64(60u, scheduler.busy_us);
    step_at(1000u);
    ran("BC");
}

static void SCH_007_the_last_task_removes_itself(void)
{
    board_init(0u);
    add(&a);
    start();
    a.act = remove_a;
    step();
    ran("A");
    TEST_ASSERT_EQUAL_UINT32(0u, scheduler.queue.count);
    step_at(1000u);
    ran("");
}

static void SCH_007_a_task_removes_an_earlier_one(void)
{
    with_a_b_c();
    b.act = remove_a;
    step();
    ran("ABC");
    unknown(&a);
    took(&b, 1u);
    took(&c, 1u);
    b.act = NULL;
    step_at(1000u);
    ran("BC");
}

static void SCH_007_a_task_removes_a_later_one(void)
{
    with_a_b_c();
    a.act = remove_b;
    step();
    ran("AC");
    took(&a, 1u);
    unknown(&b);
    took(&c, 1u);
    a.act = NULL;
    step_at(1000u);
    ran("AC");
}

static void SCH_007_removing_the_next_task_runs_none_twice(void)
{
    with_a_b_c();
    a.cost_us = 1000u; /* Due again when it ends. */
    a.act = remove_b;
    step();
    ran("AC");
    took(&a, 1u);
}

static void SCH_007_removing_the_first_other_task_skips_no_realtime_one(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    add(&o);
    start();
    a.act = remove_o;
    step();
    ran("AB");
}

static void SCH_007_other_task_removes_itself(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    add(&p);
    start();
    o.act = remove_o;
    step();
    step();
    ran("APO");
    unknown(&o);
    step_at(2000u);
    step();
    ran("AP");
}

static void SCH_007_other_task_removes_a_realtime_one(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    add(&o);
    add(&p);
    start();
    p.act = remove_a;
    step();
    ran("ABP");
    took(&p, 1u); /* Its position moved while it ran. */
    took(&o, 0u);
    took(&b, 1u);
}

static void SCH_004_a_realtime_task_added_in_a_pass_waits_for_the_next(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    start();
    a.act = add_d;
    step();
    ran("AB");
    TEST_ASSERT_EQUAL_UINT64(0u, report(&d).release_us); /* From the time A started. */
    step();
    ran("D");
    took(&a, 1u);
    took(&b, 1u);
    took(&d, 1u);
    step_at(1000u);
    ran("ABD");
}

static void add_o(void)
{
    a.act = NULL;
    add(&o);
}

/* A, which takes 10 us, adds O, whose first release is its phase later; what the step runs. */
static void a_adds_o(uint32_t phase_us, const char *expected)
{
    board_reset(0u);
    board_init(0u);
    o.config.phase_us = phase_us;
    add(&a);
    start();
    a.act = add_o;
    step();
    ran(expected);
    took(&a, 1u);
}

static void SCH_004_another_task_added_in_a_pass_takes_part_in_its_choice(void)
{
    a_adds_o(0u, "AO");
    took(&o, 1u);
    a_adds_o(10u, "AO"); /* Its phase is over when A ends ... */
    a_adds_o(11u, "A");  /* ... and here 1 us later. */
    took(&o, 0u);
    step_at(11u);
    ran("O");
}

static void SCH_004_other_task_adds_a_realtime_one(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    add(&p);
    start();
    p.act = add_d;
    step();
    ran("AP");
    took(&p, 1u); /* Its position moved while it ran. */
    took(&o, 0u);
    took(&d, 0u);
    step();
    ran("DO");
}

static void SCH_004_the_first_other_task_adds_a_realtime_one(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    start();
    o.act = add_d; /* D takes the very position of O. */
    step();
    ran("AO");
    took(&o, 1u);
    took(&d, 0u);
}

static void SCH_004_other_task_adds_another(void)
{
    board_init(0u);
    add(&o);
    start();
    o.act = add_p;
    step();
    ran("O");
    took(&o, 1u);
    took(&p, 0u);
    step();
    ran("P");
}

static void SCH_004_a_task_added_anew_by_itself_waits_for_the_next_pass(void)
{
    with_a_b_c();
    a.act = readd_a;
    step();
    ran("ABC");
    took(&a, 0u); /* Armed anew: no statistics. */
    TEST_ASSERT_EQUAL_UINT64(0u, report(&a).release_us);
    step();
    ran("A");
    took(&a, 1u);
    step_at(1000u);
    ran("BCA");
}

static void swap_o_for_d(void)
{
    discard(&o);
    add(&d);
}

static void SCH_004_a_task_adds_after_it_has_removed_itself(void)
{
    board_init(0u);
    add(&a);
    add(&o);
    start();
    o.act = swap_o_for_d;
    step();
    ran("AO");
    unknown(&o);
    took(&d, 0u);
    step();
    ran("D");
}

/* --- What is known of tasks --- */

static void SCH_024_tasks_are_told_in_queue_order(void)
{
    board_init(0u);
    TEST_ASSERT_NULL(keel_scheduler_task(&scheduler, 0u));
    add(&o);
    add(&c);
    add(&a);
    TEST_ASSERT_EQUAL_PTR(&c.config, keel_scheduler_task(&scheduler, 0u));
    TEST_ASSERT_EQUAL_PTR(&a.config, keel_scheduler_task(&scheduler, 1u));
    TEST_ASSERT_EQUAL_PTR(&o.config, keel_scheduler_task(&scheduler, 2u));
    TEST_ASSERT_NULL(keel_scheduler_task(&scheduler, 3u));
    discard(&a);
    TEST_ASSERT_EQUAL_PTR(&c.config, keel_scheduler_task(&scheduler, 0u));
    TEST_ASSERT_EQUAL_PTR(&o.config, keel_scheduler_task(&scheduler, 1u));
    TEST_ASSERT_NULL(keel_scheduler_task(&scheduler, 2u));
}

static void SCH_024_no_task_beyond_the_queue_or_without_a_scheduler(void)
{
    board_init(0u);
    fill_with_a_crowd();
    TEST_ASSERT_EQUAL_PTR(&crowd[KEEL_QUEUE_CAPACITY - 1u].config,
                          keel_scheduler_task(&scheduler, KEEL_QUEUE_CAPACITY - 1u));
    TEST_ASSERT_NULL(keel_scheduler_task(&scheduler, KEEL_QUEUE_CAPACITY));
    TEST_ASSERT_NULL(keel_scheduler_task(&scheduler, UINT32_MAX));
    TEST_ASSERT_NULL(keel_scheduler_task(NULL, 0u));
}

static void SCH_025_report_copies_what_is_known(void)
{
    keel_task_report_t o_now;

    board_init(0u);
    add(&a);
    add(&o);
    start();
    o.cost_us = 70u; /* 20 more than the budget. */
    step_at(5500u);  /* A missed 5 periods, O 2. */
    ran("AO");
    remember();
    TEST_ASSERT_EQUAL_UINT64(6000u, report(&a).release_us);
    TEST_ASSERT_EQUAL_UINT16(5u, report(&a).skipped);
    o_now = report(&o);
    TEST_ASSERT_EQUAL_UINT64(6000u, o_now.release_us);
    TEST_ASSERT_EQUAL_UINT16(2u, o_now.skipped);
    TEST_ASSERT_EQUAL_UINT64(70u, o_now.stats.total_us);
    TEST_ASSERT_EQUAL_UINT32(1u, o_now.stats.runs);
    TEST_ASSERT_EQUAL_UINT32(70u, o_now.stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(70u, o_now.stats.longest_us);
    TEST_ASSERT_EQUAL_UINT16(1u, o_now.stats.overruns);
    TEST_ASSERT_EQUAL_UINT16(0u, o_now.stats.promotions);
    unchanged();
}

/* Slots are given to other tasks again; a report must not mix them up. */
static void SCH_025_report_follows_a_task_that_others_move(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    add(&o);
    start();
    step();
    discard(&a);
    add(&c); /* Takes the slot of A, at a position before O. */
    took(&b, 1u);
    took(&o, 1u);
    took(&c, 0u);
    unknown(&a);
}

static keel_task_report_t inside;

static void report_a(void)
{
    inside = report(&a);
}

static void SCH_025_report_from_inside_the_task_itself(void)
{
    board_init(0u);
    add(&a);
    start();
    a.act = report_a;
    step_at(500u);
    TEST_ASSERT_EQUAL_UINT64(1000u, inside.release_us); /* It has moved on already. */
    TEST_ASSERT_EQUAL_UINT32(0u, inside.stats.runs);    /* The run is not over. */
}

static void SCH_025_report_refuses_null_and_strangers(void)
{
    keel_task_report_t found;
    keel_task_report_t before;

    board_init(0u);
    add(&a);
    memset(&found, 0xA5, sizeof found);
    memset(&before, 0xA5, sizeof before);
    remember();
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_report(NULL, &a.config, &found));
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_report(&scheduler, NULL, &found));
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_report(&scheduler, &a.config, NULL));
    TEST_ASSERT_EQUAL(KEEL_ERR_UNKNOWN_TASK, keel_scheduler_report(&scheduler, &b.config, &found));
    TEST_ASSERT_EQUAL_MEMORY(&before, &found, sizeof found);
    unchanged();
}

/* --- Refusals of a step --- */

static void step_is_refused(keel_status_t reason)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_step(&scheduler));
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
    add(&a);
    step_is_refused(KEEL_ERR_STATE);
}

static keel_status_t inner_status[4];

static void call_everything(void)
{
    inner_status[0] = keel_scheduler_step(&scheduler);
    inner_status[1] = keel_pass_begin(&scheduler, 5u);
    inner_status[2] = keel_scheduler_start(&scheduler);
    inner_status[3] = keel_scheduler_resync(&scheduler);
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
    o.config.phase_us = 500u;
    add(&a);
    add(&o);
    start();
    refused_inside(&a);
    ran("A");
    took(&a, 1u);
    wait_us(600u);
    refused_inside(&o);
    ran("O");
    took(&o, 1u);
}

static void SCH_013_step_refuses_a_backwards_clock(void)
{
    board_init(0u);
    add(&a);
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
    TEST_ASSERT_EQUAL_UINT64(510u + 0x7FFFFFFFu + 10u, scheduler.clock.now_us);
}

/* --- Sleeping --- */

#define idle_is(expected, latency_us, longest_us)                                                  \
    TEST_ASSERT_EQUAL_UINT32(expected, keel_scheduler_idle_us(&scheduler, latency_us, longest_us))

/* A every 1000, O every 2000; both ran, and the pass behind them found nothing else. */
static void sleep_after_a_and_o(uint32_t raw_us)
{
    board_reset(raw_us);
    board_init(0u);
    add(&a);
    add(&o);
    start();
    step();
    ran("AO");
    idle_is(0u, 0u, UINT32_MAX); /* Another task ran: more of them may be due. */
    step();
    ran("");
}

/* 60 us have gone; A is due at 1000. */
static void SCH_028_until_the_next_release(void)
{
    sleep_after_a_and_o(0u);
    idle_is(940u, 0u, UINT32_MAX);
    idle_is(930u, 10u, UINT32_MAX);
    idle_is(1u, 939u, UINT32_MAX);
    idle_is(0u, 940u, UINT32_MAX);
    idle_is(0u, UINT32_MAX, UINT32_MAX);
    idle_is(100u, 10u, 100u);
    idle_is(0u, 0u, 0u);
}

/* The time since the step counts, also where the counter wraps in it. */
static void SCH_028_counts_what_has_gone_by(void)
{
    sleep_after_a_and_o(UINT32_MAX - 70u);
    wait_us(40u);
    idle_is(900u, 0u, UINT32_MAX);
    wait_us(899u);
    idle_is(1u, 0u, UINT32_MAX);
    wait_us(1u);
    idle_is(0u, 0u, UINT32_MAX);
    wait_us(5000u);
    idle_is(0u, 0u, UINT32_MAX);
}

/* Steps at 1000 (A), 2000 (A, O), 2060 (is anything else due?) and 3000 (A). */
static void SCH_028_sleeping_loses_no_release(void)
{
    uint32_t steps = 0u;

    sleep_after_a_and_o(0u);
    while (scheduler.clock.now_us < 3000u) {
        wait_us(keel_scheduler_idle_us(&scheduler, 0u, UINT32_MAX));
        step();
        steps++;
    }
    ran("AAOA");
    TEST_ASSERT_EQUAL_UINT32(0u, report(&a).skipped);
    TEST_ASSERT_EQUAL_UINT64(3010u, scheduler.clock.now_us);
    TEST_ASSERT_EQUAL_UINT32(4u, steps);
}

/* Of a longer time the counter could not tell whether it went on or back. */
static void SCH_028_never_longer_than_the_counter_tells(void)
{
    board_init(0u);
    start();
    step();
    idle_is(0x7FFFFFFFu, 0u, UINT32_MAX);
    wait_us(1000u);
    idle_is(0x7FFFFFFFu - 1000u, 0u, UINT32_MAX);
    idle_is(0x7FFFFFFFu - 1007u, 7u, UINT32_MAX);
    wait_us(0x7FFFFFFFu - 1000u);
    idle_is(0u, 0u, UINT32_MAX);
    wait_us(1u); /* As if it had gone back. */
    idle_is(0u, 0u, UINT32_MAX);
}

static uint32_t idle_inside;

static void ask_inside(void)
{
    idle_inside = keel_scheduler_idle_us(&scheduler, 0u, UINT32_MAX);
}

static void SCH_028_not_before_the_start_nor_within_a_task(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, keel_scheduler_idle_us(NULL, 0u, UINT32_MAX));
    board_init(0u);
    idle_is(0u, 0u, UINT32_MAX);
    add(&a);
    start();
    idle_is(0u, 0u, UINT32_MAX);
    idle_inside = 1u;
    a.act = ask_inside;
    step();
    ran("A");
    TEST_ASSERT_EQUAL_UINT32(0u, idle_inside);
}

static void SCH_028_writes_nothing(void)
{
    sleep_after_a_and_o(0u);
    remember();
    idle_is(940u, 0u, UINT32_MAX);
    unchanged();
}

static void resync_adopts_the_clock(void)
{
    board_init(0u);
    a.config.phase_us = 600u;
    add(&a);
    start();
    step_at(500u);
    board.raw_us = 90u;
    step_is_refused(KEEL_ERR_CLOCK);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_resync(&scheduler));
    TEST_ASSERT_EQUAL_UINT32(90u, scheduler.clock.raw_us);
    TEST_ASSERT_EQUAL_UINT64(500u, scheduler.clock.now_us); /* Time stands still. */
    board.raw_us = 189u;
    step();
    ran("");
    board.raw_us = 190u; /* 100 us on: A's release at 600. */
    step();
    ran("A");
}

static void step_the_clock_back(void)
{
    a.act = NULL;
    board.raw_us = 40u;
}

static void resync_after_a_task_s_clock_jumped(void)
{
    board_init(0u);
    add(&a);
    add(&b);
    start();
    wait_us(100u);
    a.act = step_the_clock_back;
    TEST_ASSERT_EQUAL(KEEL_ERR_CLOCK, keel_scheduler_step(&scheduler));
    ran("A");
    step_is_refused(KEEL_ERR_CLOCK);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_resync(&scheduler));
    step();
    ran("B"); /* A is served already, B still due. */
    TEST_ASSERT_EQUAL_UINT64(120u, scheduler.clock.now_us);
}

static void resync_is_refused(keel_status_t reason)
{
    remember();
    TEST_ASSERT_EQUAL(reason, keel_scheduler_resync(&scheduler));
    unchanged();
}

static void resync_refuses_null_and_wrong_stages(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_scheduler_resync(NULL));
    board_init(0u);
    add(&a);
    resync_is_refused(KEEL_ERR_STATE);
    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pass_begin(&scheduler, 0u));
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
    declare(&a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 50u);
    declare(&b, 'B', KEEL_PRIORITY_REALTIME, 2500u, 20u);
    declare(&o, 'O', KEEL_PRIORITY_MEDIUM, 3000u, 100u);
    add(&a);
    add(&b);
    add(&o);
    start();
    step();
    for (uint64_t now_us = 200u; now_us <= 6000u; now_us += 100u) {
        if (scheduler.clock.now_us <= now_us) {
            step_at(now_us);
        }
    }
    ran("ABOAABAOAABAO");
    TEST_ASSERT_EQUAL_UINT64(6150u, scheduler.clock.now_us);
    TEST_ASSERT_EQUAL_UINT64(710u, scheduler.busy_us); /* 7 * 50 + 3 * 20 + 3 * 100 */
    TEST_ASSERT_EQUAL_UINT64(7000u, report(&a).release_us);
    TEST_ASSERT_EQUAL_UINT64(7500u, report(&b).release_us);
    TEST_ASSERT_EQUAL_UINT64(9000u, report(&o).release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, report(&a).skipped);
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
    RUN_TEST(SCH_004_a_task_added_again_begins_anew);
    RUN_TEST(SCH_004_add_after_the_start_wakes_the_scheduler);
    RUN_TEST(SCH_004_add_after_the_start_accepts_all_that_can_be_scheduled);
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
    RUN_TEST(SCH_009_start_accepts_all_that_can_be_scheduled);
    RUN_TEST(SCH_010_start_refuses_null);
    RUN_TEST(SCH_010_start_refuses_a_second_time);
    RUN_TEST(SCH_010_start_refuses_what_is_not_admitted);
    RUN_TEST(SCH_007_a_task_removes_itself);
    RUN_TEST(SCH_007_the_last_task_removes_itself);
    RUN_TEST(SCH_007_a_task_removes_an_earlier_one);
    RUN_TEST(SCH_007_a_task_removes_a_later_one);
    RUN_TEST(SCH_007_removing_the_next_task_runs_none_twice);
    RUN_TEST(SCH_007_removing_the_first_other_task_skips_no_realtime_one);
    RUN_TEST(SCH_007_other_task_removes_itself);
    RUN_TEST(SCH_007_other_task_removes_a_realtime_one);
    RUN_TEST(SCH_004_a_realtime_task_added_in_a_pass_waits_for_the_next);
    RUN_TEST(SCH_004_another_task_added_in_a_pass_takes_part_in_its_choice);
    RUN_TEST(SCH_004_other_task_adds_a_realtime_one);
    RUN_TEST(SCH_004_the_first_other_task_adds_a_realtime_one);
    RUN_TEST(SCH_004_other_task_adds_another);
    RUN_TEST(SCH_004_a_task_added_anew_by_itself_waits_for_the_next_pass);
    RUN_TEST(SCH_004_a_task_adds_after_it_has_removed_itself);
    RUN_TEST(SCH_024_tasks_are_told_in_queue_order);
    RUN_TEST(SCH_024_no_task_beyond_the_queue_or_without_a_scheduler);
    RUN_TEST(SCH_025_report_copies_what_is_known);
    RUN_TEST(SCH_025_report_follows_a_task_that_others_move);
    RUN_TEST(SCH_025_report_from_inside_the_task_itself);
    RUN_TEST(SCH_025_report_refuses_null_and_strangers);
    RUN_TEST(SCH_013_step_refuses_null);
    RUN_TEST(SCH_013_step_refuses_before_the_start);
    RUN_TEST(SCH_013_step_refuses_inside_a_running_task);
    RUN_TEST(SCH_013_step_refuses_a_backwards_clock);
    RUN_TEST(SCH_028_until_the_next_release);
    RUN_TEST(SCH_028_counts_what_has_gone_by);
    RUN_TEST(SCH_028_sleeping_loses_no_release);
    RUN_TEST(SCH_028_never_longer_than_the_counter_tells);
    RUN_TEST(SCH_028_not_before_the_start_nor_within_a_task);
    RUN_TEST(SCH_028_writes_nothing);
    RUN_TEST(resync_adopts_the_clock);
    RUN_TEST(resync_after_a_task_s_clock_jumped);
    RUN_TEST(resync_refuses_null_and_wrong_stages);
    RUN_TEST(CLK_003_schedule_is_the_same_across_the_wrap);
    return UNITY_END();
}
