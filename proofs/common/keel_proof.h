/**
 * @file keel_proof.h
 * @brief What the CBMC harnesses share: arbitrary values, and arbitrary states that are valid.
 *
 * A harness assumes its function's precondition by building a state that satisfies it, with
 * nothing else decided; it calls the function once and asserts the contract's clauses, each under
 * the clause's label. What holds for all indices is asserted at one arbitrary index.
 *
 * Task i stands in slot i of the queue here. Nothing is lost by that: the kernel
 * compares tasks for equality only, so every valid queue is this one up to the names of its tasks.
 * Two tasks with equal declarations stand for two tasks that share one, as the kernel never writes
 * declarations.
 */
#ifndef KEEL_PROOF_H
#define KEEL_PROOF_H

#include "keel/rtos/queue.h"
#include "keel/rtos/task.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CAPACITY KEEL_QUEUE_CAPACITY

/* Arbitrary values. */
bool nondet_bool(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
uint64_t nondet_u64(void);
keel_stats_t nondet_stats(void);
keel_task_t nondet_task(void);
keel_task_config_t nondet_config(void);

static uint32_t any_below(uint32_t limit)
{
    const uint32_t value = nondet_u32();

    __CPROVER_assume(value < limit);
    return value;
}

/* An arbitrary value of so many bits. The bits above are 0 by construction, which the solver sees
 * at once, where it would have to reason from an assumption: products and quotients need it. */
static uint32_t any_bits(uint32_t bits)
{
    return nondet_u32() & ((1u << bits) - 1u);
}

static uint64_t any_bits64(uint32_t bits)
{
    return nondet_u64() & (((uint64_t)1u << bits) - 1u);
}

/* A period that keel_task_check accepts: 1 to 2^31 - 1 us. */
static uint32_t any_period(void)
{
    const uint32_t period_us = any_bits(31u);

    __CPROVER_assume(period_us > 0u);
    return period_us;
}

/* As many tasks as a queue holds, and a newcomer. */
#define TASKS    (CAPACITY + 1u)
#define NEWCOMER CAPACITY

/* Each an object of its own, not an array's element: a pointer to any of them is then a choice of
 * objects to the solver, without a division by an element's size. */
static keel_task_config_t *proof_config[TASKS];
static keel_task_t *proof_task[TASKS];

static void idle_body(void *context)
{
    (void)context;
}

/* Any declaration of the given class; the body and the context are never looked into. */
static void any_config(keel_task_config_t *config, bool realtime)
{
    *config = nondet_config();
    config->name = NULL;
    config->run = idle_body;
    config->context = NULL;
    if (realtime) {
        config->priority = KEEL_PRIORITY_REALTIME;
    }
    __CPROVER_assume(realtime == (config->priority == KEEL_PRIORITY_REALTIME));
}

/* What keel_task_check accepts (config_valid). */
static bool config_is_valid_here(const keel_task_config_t *config)
{
    return (config->run != NULL) && (0u < config->period_us) &&
           (config->period_us < KEEL_PERIOD_LIMIT_US) && (config->phase_us < config->period_us) &&
           (0u < config->budget_us) &&
           (((KEEL_PRIORITY_LOW <= config->priority) && (config->priority <= KEEL_PRIORITY_HIGH)) ||
            (config->priority == KEEL_PRIORITY_REALTIME));
}

/* Any task, with a declaration of the given class. */
static void any_task(uint32_t index, bool realtime)
{
    proof_config[index] = __CPROVER_allocate(sizeof(keel_task_config_t), 0);
    any_config(proof_config[index], realtime);
    proof_task[index] = __CPROVER_allocate(sizeof(keel_task_t), 0);
    *proof_task[index] = nondet_task();
    proof_task[index]->config = proof_config[index];
}

/* Any valid queue of at most so many tasks, 0 to count - 1 in this order. The newcomer is in none.
 * The queue's capacity is the shipped one whatever the number of tasks. */
static void any_queue_of(keel_queue_t *queue, uint32_t most)
{
    queue->count = any_below(most + 1u);
    queue->realtime_count = any_below(queue->count + 1u);
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        queue->task[i] = NULL;
    }
    for (uint32_t i = 0u; i < most; i++) {
        any_task(i, i < queue->realtime_count);
        if (i < queue->count) {
            queue->task[i] = proof_task[i];
        }
    }
    any_task(NEWCOMER, nondet_bool());
}

/* A valid queue of just so many tasks. With no slot in doubt the solver sees which tasks a loop
 * reads, and how small their numbers are. */
static void queue_of(keel_queue_t *queue, uint32_t realtime_count, uint32_t count)
{
    queue->count = count;
    queue->realtime_count = realtime_count;
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        queue->task[i] = NULL;
    }
    for (uint32_t i = 0u; i < count; i++) {
        any_task(i, i < realtime_count);
        queue->task[i] = proof_task[i];
    }
    any_task(NEWCOMER, nondet_bool());
}

/* Any valid queue. */
static void any_queue(keel_queue_t *queue)
{
    any_queue_of(queue, CAPACITY);
}

/* Assumes that the declarations of the first tasks and the newcomer's have passed
 * keel_task_check (queue_checked). */
static void assume_checked(uint32_t most)
{
    for (uint32_t i = 0u; i < most; i++) {
        __CPROVER_assume(config_is_valid_here(proof_config[i]));
    }
    __CPROVER_assume(config_is_valid_here(proof_config[NEWCOMER]));
}

/* Replaces the first tasks' numbers, the newcomer's too, by small ones that pass keel_task_check:
 * periods, phases, budgets and runs of so many bits, releases of release_bits. For harnesses whose
 * function divides: the solver comes to the end of a division of small numbers only. */
static void narrow_task(uint32_t index, uint32_t bits, uint32_t release_bits)
{
    keel_task_config_t *const config = proof_config[index];

    config->period_us = any_bits(bits) + 1u;
    config->phase_us = any_below(config->period_us);
    config->budget_us = any_bits(bits) + 1u;
    config->priority = (config->priority == KEEL_PRIORITY_REALTIME) ? KEEL_PRIORITY_REALTIME
                                                                    : (any_bits(2u) + 1u);
    proof_task[index]->release_us = any_bits64(release_bits);
    proof_task[index]->stats.longest_us = any_bits(bits);
}

static void narrow_tasks(uint32_t most, uint32_t bits, uint32_t release_bits)
{
    for (uint32_t i = 0u; i < most; i++) {
        narrow_task(i, bits, release_bits);
    }
    narrow_task(NEWCOMER, bits, release_bits);
}

/* Eq. 3 without a division: one more for each of the 15 multiples of T that sp * age reaches. */
static uint32_t dynamic_priority(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    uint32_t priority = 1u;

    for (uint32_t k = 1u; k < KEEL_PRIORITY_REALTIME; k++) {
        if ((sp * age_us) >= (k * (uint64_t)period_us)) {
            priority++;
        }
    }
    return priority;
}

static bool is_realtime(const keel_task_t *task)
{
    return task->config->priority == KEEL_PRIORITY_REALTIME;
}

/* The same, found by comparing pointers: reading through one that may be any of many is dear. */
static bool is_known_realtime(const keel_task_t *task)
{
    bool realtime = false;

    for (uint32_t i = 0u; i < TASKS; i++) {
        realtime = realtime || ((proof_task[i] != NULL) && (task == proof_task[i]) &&
                                (proof_config[i]->priority == KEEL_PRIORITY_REALTIME));
    }
    return realtime;
}

static bool is_known(const keel_task_t *task)
{
    bool known = false;

    for (uint32_t i = 0u; i < TASKS; i++) {
        known = known || (task == proof_task[i]);
    }
    return (task != NULL) && known;
}

/* Asserts that a queue is valid (queue_valid), at two arbitrary indices. */
static void assert_queue_valid(const keel_queue_t *queue)
{
    const uint32_t i = any_below(CAPACITY);
    const uint32_t j = any_below(CAPACITY);
    const keel_task_t *const task = queue->task[i];

    __CPROVER_assert((queue->realtime_count <= queue->count) && (queue->count <= CAPACITY),
                     "QUE_005_counts: the counts are in order and in range");
    __CPROVER_assert((i < queue->count) == (task != NULL),
                     "QUE_005_no_gaps: slots below count hold tasks, the others none");
    if (i < queue->count) {
        __CPROVER_assert((j >= queue->count) || (i == j) || (task != queue->task[j]),
                         "QUE_005_no_duplicates: no task is queued twice");
        __CPROVER_assert(is_known(task),
                         "QUE_005_tasks: what is queued is a task, apart from the queue");
        __CPROVER_assert((i >= queue->realtime_count) || is_known_realtime(task),
                         "QUE_005_realtime: the first realtime_count tasks are real-time");
        __CPROVER_assert((i < queue->realtime_count) || !is_known_realtime(task),
                         "QUE_005_others: the tasks behind them are not");
    }
}

static bool stats_same(const keel_stats_t *a, const keel_stats_t *b)
{
    return (a->total_us == b->total_us) && (a->runs == b->runs) && (a->last_us == b->last_us) &&
           (a->longest_us == b->longest_us) && (a->overruns == b->overruns) &&
           (a->promotions == b->promotions);
}

static bool task_same(const keel_task_t *a, const keel_task_t *b)
{
    return (a->config == b->config) && (a->skipped == b->skipped) &&
           (a->release_us == b->release_us) && stats_same(&a->stats, &b->stats);
}

static bool config_same(const keel_task_config_t *a, const keel_task_config_t *b)
{
    return (a->name == b->name) && (a->run == b->run) && (a->context == b->context) &&
           (a->period_us == b->period_us) && (a->budget_us == b->budget_us) &&
           (a->phase_us == b->phase_us) && (a->priority == b->priority);
}

#endif
