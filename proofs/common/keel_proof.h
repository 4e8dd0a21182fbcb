/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file keel_proof.h
 * @brief What the CBMC harnesses share: arbitrary values, and any valid queue.
 *
 * A harness assumes its function's precondition by building a state that satisfies it, with
 * nothing else decided; it calls the function once and asserts the contract's clauses, each under
 * the clause's label. What holds for all indices is asserted at one arbitrary index, and what a
 * function may write is compared with a copy of the state before as a whole.
 *
 * Two things are decided without loss. Handles are compared and no more, so any names for them
 * will do: of one task the harness decides whether it is in the queue, and where. Slots are alike,
 * so one order of them stands for all; it is one in which no slot's number is its position, as a
 * function that took one for the other would not be noticed else. WP proves it for every order.
 */
#ifndef KEEL_PROOF_H
#define KEEL_PROOF_H

#include "any_below.h"
#include "keel/internal/rtos/queue.h"
#include "keel/rtos/clock.h"
#include "keel/rtos/stats.h"
#include "keel/rtos/task.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CAPACITY KEEL_QUEUE_CAPACITY

/* Arbitrary values. */
bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
int16_t nondet_s16(void);
uint32_t nondet_u32(void);
uint64_t nondet_u64(void);
keel_stats_t nondet_stats(void);
keel_queue_t nondet_queue(void);
keel_task_config_t nondet_config(void);

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

/* The declarations of the tasks in a queue, by slot, and that of the task which a harness is about:
 * it may stand in the queue in place of another. */
static keel_task_config_t proof_config[CAPACITY];
static keel_task_config_t proof_task;

static void idle_body(void *context)
{
    (void)context;
}

/* Any declaration; the body and the context are never looked into. */
static void any_config(keel_task_config_t *config)
{
    *config = nondet_config();
    config->name = NULL;
    config->run = nondet_bool() ? idle_body : NULL;
    config->context = NULL;
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

/* Has no divisor in common with any capacity of up to 255. */
#define STRIDE (((CAPACITY % 5u) != 0u) ? 5u : (((CAPACITY % 7u) != 0u) ? 7u : 11u))

/* The slot at a position: each has one of its own. */
static uint32_t slot_at(uint32_t position)
{
    return ((STRIDE * position) + 7u) % CAPACITY;
}

/* Any valid queue. Position of_interest holds the task that the harness is about, if it is within
 * the queue. */
static void any_queue(keel_queue_t *queue, uint32_t of_interest)
{
    *queue = nondet_queue();
    __CPROVER_assume(queue->count <= CAPACITY);
    __CPROVER_assume(queue->realtime_count <= queue->count);
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const uint32_t x = slot_at(i);

        queue->order[i] = (uint8_t)x;
        queue->task[x] = NULL;
        if (i < queue->count) {
            queue->task[x] = (i == of_interest) ? &proof_task : &proof_config[x];
            __CPROVER_assume((queue->priority[x] == KEEL_PRIORITY_REALTIME) ||
                             ((1u <= queue->priority[x]) &&
                              (queue->priority[x] <= KEEL_PRIORITY_HIGH)));
            __CPROVER_assume((queue->priority[x] == KEEL_PRIORITY_REALTIME) ==
                             (i < queue->realtime_count));
            __CPROVER_assume((0u < queue->period_us[x]) &&
                             (queue->period_us[x] < KEEL_PERIOD_LIMIT_US));
            __CPROVER_assume(0u < queue->budget_us[x]);
        }
    }
}

/* Replaces the periods and budgets of a queue by numbers of so many bits, for functions that
 * multiply or divide: the solver sees at once that the bits above are 0. */
static void narrow_tasks(keel_queue_t *queue, uint32_t bits)
{
    for (uint32_t x = 0u; x < CAPACITY; x++) {
        queue->period_us[x] = any_bits(bits) + 1u;
        queue->budget_us[x] = any_bits(bits) + 1u;
    }
}

/* The same of the releases. */
static void narrow_releases(keel_queue_t *queue, uint32_t bits)
{
    for (uint32_t x = 0u; x < CAPACITY; x++) {
        queue->release_us[x] = any_bits64(bits);
    }
}

/* Asserts that a queue is valid (queue_valid) under the ids of a unit, at two arbitrary positions;
 * for duplicates these are slots, which is the same where the other parts hold. */
#define ASSERT_QUEUE_VALID(queue, id)                                                              \
    do {                                                                                           \
        const uint32_t at_i = any_below(CAPACITY);                                                 \
        const uint32_t at_j = any_below(CAPACITY);                                                 \
        const uint32_t x_i = (queue)->order[at_i];                                                 \
        const uint32_t x_j = (queue)->order[at_j];                                                 \
                                                                                                   \
        __CPROVER_assert(((queue)->realtime_count <= (queue)->count) &&                            \
                             ((queue)->count <= CAPACITY),                                         \
                         id "_counts: the counts are in order and in range");                      \
        __CPROVER_assert((x_i < CAPACITY) && ((at_i == at_j) || (x_i != x_j)),                     \
                         id "_order: every slot stands in the order, once");                       \
        __CPROVER_assert((at_i < (queue)->count) == ((queue)->task[x_i] != NULL),                  \
                         id "_no_gaps: the slots before count hold tasks, the others none");       \
        __CPROVER_assert((at_i == at_j) || ((queue)->task[at_i] == NULL) ||                        \
                             ((queue)->task[at_i] != (queue)->task[at_j]),                         \
                         id "_no_duplicates: no two slots hold the same task");                    \
        if (at_i < (queue)->count) {                                                               \
            __CPROVER_assert((at_i >= (queue)->realtime_count) ||                                  \
                                 ((queue)->priority[x_i] == KEEL_PRIORITY_REALTIME),               \
                             id "_realtime: the first realtime_count tasks are real-time");        \
            __CPROVER_assert((at_i < (queue)->realtime_count) ||                                   \
                                 ((1u <= (queue)->priority[x_i]) &&                                \
                                  ((queue)->priority[x_i] <= KEEL_PRIORITY_HIGH)),                 \
                             id "_others: the tasks behind them are not");                         \
            __CPROVER_assert((0u < (queue)->period_us[x_i]) &&                                     \
                                 ((queue)->period_us[x_i] < KEEL_PERIOD_LIMIT_US),                 \
                             id "_periods: every period is in its range");                         \
            __CPROVER_assert(0u < (queue)->budget_us[x_i], id "_budgets: no budget is 0");         \
        }                                                                                          \
    } while (false)

static bool stats_same(const keel_stats_t *a, const keel_stats_t *b)
{
    return (a->total_us == b->total_us) && (a->runs == b->runs) && (a->last_us == b->last_us) &&
           (a->longest_us == b->longest_us) && (a->remembered_us == b->remembered_us) &&
           (a->forgotten_in == b->forgotten_in) && (a->overruns == b->overruns) &&
           (a->promotions == b->promotions);
}

static bool clock_same(const keel_clock_t *a, const keel_clock_t *b)
{
    return (a->now_us == b->now_us) && (a->raw_us == b->raw_us);
}

static bool config_same(const keel_task_config_t *a, const keel_task_config_t *b)
{
    return (a->name == b->name) && (a->run == b->run) && (a->context == b->context) &&
           (a->period_us == b->period_us) && (a->budget_us == b->budget_us) &&
           (a->phase_us == b->phase_us) && (a->priority == b->priority);
}

/* Whether a slot holds what it held but for who the task is. Statistics are compared field by
 * field: of an object at a variable place in an array CBMC knows an address, behind which it looks
 * at every byte of the array (ten times the work). */
static bool slot_same(const keel_queue_t *a, const keel_queue_t *b, uint32_t x)
{
    return (a->release_us[x] == b->release_us[x]) && (a->period_us[x] == b->period_us[x]) &&
           (a->budget_us[x] == b->budget_us[x]) && (a->priority[x] == b->priority[x]) &&
           (a->skipped[x] == b->skipped[x]) && (a->stats[x].total_us == b->stats[x].total_us) &&
           (a->stats[x].runs == b->stats[x].runs) && (a->stats[x].last_us == b->stats[x].last_us) &&
           (a->stats[x].longest_us == b->stats[x].longest_us) &&
           (a->stats[x].remembered_us == b->stats[x].remembered_us) &&
           (a->stats[x].forgotten_in == b->stats[x].forgotten_in) &&
           (a->stats[x].overruns == b->stats[x].overruns) &&
           (a->stats[x].promotions == b->stats[x].promotions);
}

/* Whether two queues are the same, as seen at a position and slot: if at any, they are. */
static bool queue_same(const keel_queue_t *a, const keel_queue_t *b, uint32_t x)
{
    return (a->count == b->count) && (a->realtime_count == b->realtime_count) &&
           (a->order[x] == b->order[x]) && (a->task[x] == b->task[x]) && slot_same(a, b, x);
}

#endif
