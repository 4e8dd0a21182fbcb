/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/spread.h"

#include <stdbool.h>
#include <stddef.h>

/* No phase; longer than any period. */
#define NO_PHASE_US UINT32_MAX

/* How far the placing is, by slot. */
typedef struct progress {
    bool tried[KEEL_QUEUE_CAPACITY];  /* It was the task's turn. */
    bool placed[KEEL_QUEUE_CAPACITY]; /* It has its phase. */
} progress_t;

/*@ // A task that can be placed.
  @ predicate queued(keel_queue_t *q, integer x) =
  @     0 <= x < KEEL_QUEUE_CAPACITY && q->task[x] != \null && period_valid(q->period_us[x]);
  @
  @ predicate placed_queued(keel_queue_t *q, progress_t *p) =
  @     \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==> p->placed[x] != 0 ==>
  @         queued(q, x) && q->release_us[x] < q->period_us[x];
  @
  @ predicate placed_apart(keel_queue_t *q, progress_t *p, integer guard_us) =
  @     \forall integer x, y; 0 <= x < KEEL_QUEUE_CAPACITY && 0 <= y < KEEL_QUEUE_CAPACITY ==>
  @         x != y ==> p->placed[x] != 0 ==> p->placed[y] != 0 ==>
  @         keep_apart(q, x, y, guard_us);
  @
  @ predicate order_queued(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->count ==> queued(q, q->order[i]);
  @*/

uint32_t keel_spread_divisor(uint32_t a, uint32_t b)
{
    uint32_t divisor = a;
    uint32_t rest = b;
    //@ ghost uint32_t steps = b;

    /*@ loop invariant steps: rest <= steps;
      @ loop invariant divisor: divisor_within(divisor, rest, steps) == common_divisor(a, b);
      @ loop invariant range: 0 < divisor < KEEL_PERIOD_LIMIT_US && rest < KEEL_PERIOD_LIMIT_US;
      @ loop assigns divisor, rest, steps;
      @ loop variant rest;
      @*/
    while (rest > 0u) {
        const uint32_t next = divisor % rest;

        divisor = rest;
        rest = next;
        //@ ghost steps--;
    }
    return divisor;
}

/*@ requires \valid_read(queue) && slot < KEEL_QUEUE_CAPACITY;
  @ assigns \nothing;
  @ ensures \result == spread_need(queue, slot, guard_us);
  @*/
static uint64_t need_us(const keel_queue_t *queue, uint32_t slot, uint32_t guard_us)
{
    return (uint64_t)queue->budget_us[slot] + guard_us + 1u;
}

/* The first phase from that one on which lies, in each cycle, at least so far behind the other
 * release and so far before the next one. */
/*@ requires phase_us < KEEL_PERIOD_LIMIT_US && 0 < cycle_us < KEEL_PERIOD_LIMIT_US;
  @ requires behind_us < KEEL_TIME_NEVER_US / 2 && before_us < KEEL_TIME_NEVER_US / 2;
  @ assigns \nothing;
  @ ensures onward: phase_us <= \result;
  @ ensures apart: \result == phase_us ==>
  @     behind_us <= cycle_distance(phase_us, other_us, cycle_us) <= cycle_us - before_us;
  @*/
static uint32_t next_free(uint32_t phase_us, uint32_t other_us, uint32_t cycle_us,
                          uint64_t behind_us, uint64_t before_us)
{
    uint32_t distance_us;

    if ((behind_us + before_us) > cycle_us) {
        return NO_PHASE_US;
    }
    distance_us = (phase_us + cycle_us - (other_us % cycle_us)) % cycle_us;
    if (distance_us < behind_us) {
        return phase_us + ((uint32_t)behind_us - distance_us);
    }
    if (distance_us > (cycle_us - before_us)) {
        return phase_us + (cycle_us - distance_us) + (uint32_t)behind_us;
    }
    return phase_us;
}

/* Goes once through the tasks that are placed, each time to the first phase that keeps apart from
 * that one. Where it ends at the phase that it began with, all of them agree. */
/*@ requires \valid_read(queue) && \valid_read(progress) && \separated(queue, progress);
  @ requires queued(queue, slot) && placed_queued(queue, progress);
  @ requires phase_us < queue->period_us[slot] && guard_us < KEEL_PERIOD_LIMIT_US;
  @ assigns \nothing;
  @ ensures onward: phase_us <= \result;
  @ ensures apart: \result == phase_us ==>
  @     \forall integer y; 0 <= y < KEEL_QUEUE_CAPACITY ==> progress->placed[y] != 0 ==>
  @         apart_at(queue, slot, phase_us, y, guard_us);
  @*/
static uint32_t one_round(const keel_queue_t *queue, const progress_t *progress, uint32_t slot,
                          uint32_t phase_us, uint32_t guard_us)
{
    const uint32_t period_us = queue->period_us[slot];
    uint32_t later_us = phase_us;

    /*@ loop invariant range: 0 <= y <= KEEL_QUEUE_CAPACITY;
      @ loop invariant onward: phase_us <= later_us;
      @ loop invariant apart: later_us == phase_us ==>
      @     \forall integer z; 0 <= z < y ==> progress->placed[z] != 0 ==>
      @         apart_at(queue, slot, phase_us, z, guard_us);
      @ loop assigns y, later_us;
      @ loop variant KEEL_QUEUE_CAPACITY - y;
      @*/
    for (uint32_t y = 0u; y < KEEL_QUEUE_CAPACITY; y++) {
        if (progress->placed[y] && (later_us < period_us)) {
            const uint32_t cycle_us = keel_spread_divisor(period_us, queue->period_us[y]);

            later_us = next_free(later_us, (uint32_t)queue->release_us[y], cycle_us,
                                 need_us(queue, y, guard_us), need_us(queue, slot, guard_us));
        }
    }
    return later_us;
}

/* The first phase at which the task in a slot keeps apart from all that are placed. */
/*@ requires \valid_read(queue) && \valid_read(progress) && \separated(queue, progress);
  @ requires queued(queue, slot) && placed_queued(queue, progress);
  @ requires guard_us < KEEL_PERIOD_LIMIT_US;
  @ assigns \nothing;
  @ ensures apart: \result < queue->period_us[slot] ==>
  @     \forall integer y; 0 <= y < KEEL_QUEUE_CAPACITY ==> progress->placed[y] != 0 ==>
  @         apart_at(queue, slot, \result, y, guard_us);
  @*/
static uint32_t first_phase_us(const keel_queue_t *queue, const progress_t *progress, uint32_t slot,
                               uint32_t guard_us)
{
    uint32_t phase_us = 0u;
    uint32_t later_us = one_round(queue, progress, slot, phase_us, guard_us);

    /*@ loop invariant range: phase_us < queue->period_us[slot];
      @ loop invariant rounds: 1 <= rounds <= \max(1, KEEL_SPREAD_ROUNDS_MAX);
      @ loop invariant apart: later_us == phase_us ==>
      @     \forall integer y; 0 <= y < KEEL_QUEUE_CAPACITY ==> progress->placed[y] != 0 ==>
      @         apart_at(queue, slot, phase_us, y, guard_us);
      @ loop assigns rounds, phase_us, later_us;
      @ loop variant KEEL_SPREAD_ROUNDS_MAX - rounds;
      @*/
    for (uint32_t rounds = 1u; (rounds < KEEL_SPREAD_ROUNDS_MAX) && (later_us != phase_us) &&
                               (later_us < queue->period_us[slot]);
         rounds++) {
        phase_us = later_us;
        later_us = one_round(queue, progress, slot, phase_us, guard_us);
    }
    return (later_us == phase_us) ? phase_us : NO_PHASE_US;
}

/* Takes a task's turn. */
/*@ requires \valid(queue) && \valid(progress) && \separated(queue, progress);
  @ requires queued(queue, slot) && placed_queued(queue, progress);
  @ requires placed_apart(queue, progress, guard_us) && guard_us < KEEL_PERIOD_LIMIT_US;
  @ assigns queue->release_us[slot], progress->tried[slot], progress->placed[slot];
  @ ensures phase: queue->release_us[slot] == \old(queue->release_us[slot]) ||
  @     queue->release_us[slot] < queue->period_us[slot];
  @ ensures queued: placed_queued(queue, progress);
  @ ensures apart: placed_apart(queue, progress, guard_us);
  @*/
static void place_task(keel_queue_t *queue, progress_t *progress, uint32_t slot, uint32_t guard_us)
{
    const uint32_t phase_us = first_phase_us(queue, progress, slot, guard_us);

    progress->tried[slot] = true;
    if (phase_us < queue->period_us[slot]) {
        queue->release_us[slot] = phase_us;
        progress->placed[slot] = true;
    }
}

/* The slot of the next task that is not real-time: of the shortest period among those whose turn
 * is still to come, the first. There is one. */
/*@ requires \valid_read(queue) && \valid_read(progress) && \separated(queue, progress);
  @ requires queue_counts(queue) && order_queued(queue);
  @ requires queue->realtime_count < queue->count;
  @ assigns \nothing;
  @ ensures queued: queued(queue, \result);
  @*/
static uint32_t next_other(const keel_queue_t *queue, const progress_t *progress)
{
    uint32_t next = queue->order[queue->realtime_count];
    uint32_t shortest_us = UINT32_MAX;

    /*@ loop invariant range: queue->realtime_count <= i <= queue->count;
      @ loop invariant queued: queued(queue, next);
      @ loop assigns i, next, shortest_us;
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = queue->realtime_count; i < queue->count; i++) {
        const uint32_t slot = queue->order[i];

        if (!progress->tried[slot] && (queue->period_us[slot] < shortest_us)) {
            shortest_us = queue->period_us[slot];
            next = slot;
        }
    }
    return next;
}

/* No task has had its turn. */
/*@ requires \valid(progress);
  @ assigns *progress;
  @ ensures none: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==> progress->placed[x] == 0;
  @*/
static void begin_placing(progress_t *progress)
{
    /*@ loop invariant range: 0 <= x <= KEEL_QUEUE_CAPACITY;
      @ loop invariant none: \forall integer y; 0 <= y < x ==> progress->placed[y] == 0;
      @ loop assigns x, *progress;
      @ loop variant KEEL_QUEUE_CAPACITY - x;
      @*/
    for (uint32_t x = 0u; x < KEEL_QUEUE_CAPACITY; x++) {
        progress->tried[x] = false;
        progress->placed[x] = false;
    }
}

/* Every task has its turn. */
/*@ requires \valid(queue) && \valid(progress) && \separated(queue, progress);
  @ requires queue_counts(queue) && order_queued(queue) && guard_us < KEEL_PERIOD_LIMIT_US;
  @ assigns queue->release_us[0 .. KEEL_QUEUE_CAPACITY - 1], *progress;
  @ ensures apart: placed_apart(queue, progress, guard_us);
  @ ensures phases: phases_only{Pre, Post}(queue);
  @ ensures free: free_untouched{Pre, Post}(queue);
  @*/
static void place_tasks(keel_queue_t *queue, progress_t *progress, uint32_t guard_us)
{
    begin_placing(progress);
    /*@ loop invariant range: 0 <= i <= queue->realtime_count;
      @ loop invariant queued: placed_queued(queue, progress);
      @ loop invariant apart: placed_apart(queue, progress, guard_us);
      @ loop invariant phases: phases_only{Pre, Here}(queue);
      @ loop invariant free: free_untouched{Pre, Here}(queue);
      @ loop assigns i, queue->release_us[0 .. KEEL_QUEUE_CAPACITY - 1], *progress;
      @ loop variant queue->realtime_count - i;
      @*/
    for (uint32_t i = 0u; i < queue->realtime_count; i++) {
        place_task(queue, progress, queue->order[i], guard_us);
    }
    /*@ loop invariant range: queue->realtime_count <= i <= queue->count;
      @ loop invariant queued: placed_queued(queue, progress);
      @ loop invariant apart: placed_apart(queue, progress, guard_us);
      @ loop invariant phases: phases_only{Pre, Here}(queue);
      @ loop invariant free: free_untouched{Pre, Here}(queue);
      @ loop assigns i, queue->release_us[0 .. KEEL_QUEUE_CAPACITY - 1], *progress;
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = queue->realtime_count; i < queue->count; i++) {
        place_task(queue, progress, next_other(queue, progress), guard_us);
    }
}

/* How many tasks of the queue are not placed. */
/*@ requires \valid_read(queue) && \valid_read(progress) && \separated(queue, progress);
  @ requires queue_counts(queue) && queue_order(queue);
  @ assigns \nothing;
  @ ensures range: \result <= queue->count;
  @ ensures none: \result == 0 ==> \forall integer i; 0 <= i < queue->count ==>
  @     progress->placed[queue->order[i]] != 0;
  @*/
static uint32_t not_placed(const keel_queue_t *queue, const progress_t *progress)
{
    uint32_t crowded = 0u;

    /*@ loop invariant range: 0 <= crowded <= i <= queue->count;
      @ loop invariant none: crowded == 0 ==> \forall integer j; 0 <= j < i ==>
      @     progress->placed[queue->order[j]] != 0;
      @ loop assigns i, crowded;
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = 0u; i < queue->count; i++) {
        if (!progress->placed[queue->order[i]]) {
            crowded++;
        }
    }
    return crowded;
}

keel_status_t keel_scheduler_spread(keel_scheduler_t *scheduler, uint32_t *crowded)
{
    progress_t progress;

    if ((scheduler == NULL) || (crowded == NULL)) {
        return KEEL_ERR_NULL;
    }
    if (scheduler->stage != KEEL_STAGE_SETUP) {
        return KEEL_ERR_STATE;
    }
    place_tasks(&scheduler->queue, &progress, scheduler->config.guard_us);
    *crowded = not_placed(&scheduler->queue, &progress);
    scheduler->earliest_realtime_us = 0u;
    scheduler->earliest_other_us = 0u;
    scheduler->wake_us = 0u;
    return KEEL_OK;
}
