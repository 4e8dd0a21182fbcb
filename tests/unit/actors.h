/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file actors.h
 * @brief Tasks for tests of the scheduler, and a clock that only they and the tests move.
 *
 * An actor is a task with a one-letter name, the time it takes, and something it may do while it
 * runs. Which actors ran, in which order, is the text in board.ran.
 */
#ifndef KEEL_TESTS_UNIT_ACTORS_H
#define KEEL_TESTS_UNIT_ACTORS_H

#include "keel/internal/rtos/pass.h"
#include "keel/rtos/scheduler.h"
#include "unity.h"

#include <stdbool.h>
#include <string.h>

#define BOARD_LOG_SIZE 200u

typedef struct actor {
    keel_task_config_t config; /* Its address is the task. */
    uint32_t cost_us;          /* How long it runs. */
    void (*act)(void);         /* What it does halfway, or null. */
    char name;
} actor_t;

typedef struct board {
    uint32_t raw_us; /* The counter. */
    uint32_t reads;  /* How often it was read. */
    uint32_t log_length;
    char ran[BOARD_LOG_SIZE];
} board_t;

/* All that the kernel may write: compared byte for byte where it must not. */
static keel_scheduler_t scheduler;
static keel_scheduler_t scheduler_before;

static actor_t a, b, c, d, o, p;
static board_t board;

/* A reading of the counter some time later: it wraps. */
static inline uint32_t later(uint32_t raw_us, uint32_t us)
{
    return (uint32_t)((uint64_t)raw_us + us);
}

static inline uint32_t board_read(void *context)
{
    board_t *const read = context;

    read->reads++;
    return read->raw_us;
}

static inline void actor_run(void *context)
{
    const actor_t *const actor = context;

    TEST_ASSERT_LESS_THAN_UINT32(BOARD_LOG_SIZE - 1u, board.log_length);
    board.ran[board.log_length] = actor->name;
    board.log_length++;
    if (actor->act != NULL) {
        actor->act();
    }
    board.raw_us = later(board.raw_us, actor->cost_us);
}

/* Declares an actor whose runs take its budget. */
static inline void declare(actor_t *actor, char name, uint32_t priority, uint32_t period_us,
                           uint32_t budget_us)
{
    memset(actor, 0, sizeof *actor);
    actor->name = name;
    actor->cost_us = budget_us;
    actor->config.run = actor_run;
    actor->config.context = actor;
    actor->config.period_us = period_us;
    actor->config.budget_us = budget_us;
    actor->config.priority = priority;
}

/* Clears the board; A to D are real-time, O and P are not. */
static inline void board_reset(uint32_t raw_us)
{
    memset(&board, 0, sizeof board);
    memset(&scheduler, 0, sizeof scheduler);
    board.raw_us = raw_us;
    declare(&a, 'A', KEEL_PRIORITY_REALTIME, 1000u, 10u);
    declare(&b, 'B', KEEL_PRIORITY_REALTIME, 1000u, 20u);
    declare(&c, 'C', KEEL_PRIORITY_REALTIME, 1000u, 30u);
    declare(&d, 'D', KEEL_PRIORITY_REALTIME, 1000u, 40u);
    declare(&o, 'O', KEEL_PRIORITY_LOW, 2000u, 50u);
    declare(&p, 'P', KEEL_PRIORITY_HIGH, 2000u, 60u);
}

static inline keel_scheduler_config_t board_config(uint32_t guard_us)
{
    const keel_scheduler_config_t config = {.read_clock = board_read,
                                            .clock_context = &board,
                                            .guard_us = guard_us,
                                            .utilisation_limit_ppm = KEEL_UTILISATION_FULL_PPM};

    return config;
}

static inline void board_init(uint32_t guard_us)
{
    const keel_scheduler_config_t config = board_config(guard_us);

    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&scheduler, &config));
}

/* The same, and no task is ever promoted. */
static inline void board_init_without_promotion(uint32_t guard_us)
{
    keel_scheduler_config_t config = board_config(guard_us);

    config.without_promotion = true;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&scheduler, &config));
}

/* The checks below name the line of the test that made them, not their own. */
#define add(actor)     succeeds(keel_scheduler_add(&scheduler, &(actor)->config), __LINE__)
#define discard(actor) succeeds(keel_scheduler_remove(&scheduler, &(actor)->config), __LINE__)
#define start()        succeeds(keel_scheduler_start(&scheduler), __LINE__)
#define step()         succeeds(keel_scheduler_step(&scheduler), __LINE__)
#define step_at(now)   succeeds(step_when(now), __LINE__)
#define report(actor)  report_at(actor, __LINE__)
#define unknown(actor) unknown_at(actor, __LINE__)
#define took(actor, n) took_at(actor, n, __LINE__)
#define ran(names)     ran_at(names, __LINE__)
#define unchanged()    unchanged_at(__LINE__)

static inline void succeeds(keel_status_t status, int line)
{
    UNITY_TEST_ASSERT_EQUAL_INT(KEEL_OK, status, line, "refused");
}

/* What the scheduler tells of a task. */
static inline keel_task_report_t report_at(const actor_t *actor, int line)
{
    keel_task_report_t found;

    memset(&found, 0xA5, sizeof found);
    succeeds(keel_scheduler_report(&scheduler, &actor->config, &found), line);
    return found;
}

/* The scheduler does not know this task. */
static inline void unknown_at(const actor_t *actor, int line)
{
    keel_task_report_t found;

    UNITY_TEST_ASSERT_EQUAL_INT(KEEL_ERR_UNKNOWN_TASK,
                                keel_scheduler_report(&scheduler, &actor->config, &found), line,
                                "known");
}

/* A task ran so often, and each time took its own time and no other's. */
static inline void took_at(const actor_t *actor, uint32_t runs, int line)
{
    const keel_stats_t stats = report_at(actor, line).stats;

    UNITY_TEST_ASSERT_EQUAL_UINT32(runs, stats.runs, line, "runs");
    UNITY_TEST_ASSERT_EQUAL_UINT32((runs > 0u) ? actor->cost_us : 0u, stats.last_us, line, "last");
    UNITY_TEST_ASSERT_EQUAL_UINT64((uint64_t)runs * actor->cost_us, stats.total_us, line, "total");
}

/* Where the scheduler keeps a task: for a test that sets what cannot be told to it. */
static inline uint32_t slot_of(const actor_t *actor)
{
    const uint32_t position = keel_queue_find(&scheduler.queue, &actor->config);

    TEST_ASSERT_LESS_THAN_UINT32(scheduler.queue.count, position);
    return scheduler.queue.order[position];
}

/* Lets time pass outside of tasks. */
static inline void wait_us(uint32_t us)
{
    board.raw_us = later(board.raw_us, us);
}

/* Steps once when the scheduler's time is now_us. */
static inline keel_status_t step_when(uint64_t now_us)
{
    const keel_clock_t *const clock = &scheduler.clock;

    board.raw_us = later(clock->raw_us, (uint32_t)(now_us - clock->now_us));
    return keel_scheduler_step(&scheduler);
}

/* Nobody looks at who ran so far: for runs longer than the log. */
static inline void board_quiet(void)
{
    memset(board.ran, 0, sizeof board.ran);
    board.log_length = 0u;
}

/* These ran since the last look, in this order. */
static inline void ran_at(const char *names, int line)
{
    UNITY_TEST_ASSERT_EQUAL_STRING(names, board.ran, line, "ran");
    board_quiet();
}

static inline void remember(void)
{
    memcpy(&scheduler_before, &scheduler, sizeof scheduler);
}

/* The kernel has written nothing since remember(). */
static inline void unchanged_at(int line)
{
    UNITY_TEST_ASSERT_EQUAL_MEMORY(&scheduler_before, &scheduler, sizeof scheduler, line,
                                   "written");
}

#endif
