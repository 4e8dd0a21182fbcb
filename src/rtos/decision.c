/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/decision.h"

#include <stdbool.h>

/*@ // A task that is less than a period late: dp = 1 + sp + sp * late / T, never saturated.
  @ lemma DEC_fresh: \forall integer sp, late_us, period_us;
  @     1 <= sp <= KEEL_PRIORITY_HIGH ==> 0 <= late_us < period_us ==>
  @     dynamic_priority(sp, late_us + period_us, period_us) ==
  @         1 + sp + (sp * late_us) / period_us;
  @
  @ // The contracts say what a result is, not how it is found; there is only one such.
  @ lemma DEC_001_only: \forall keel_queue_t *q, integer from, to, now_us, a, b;
  @     from <= a <= to && (a < to ==> released(q, q->order[a], now_us)) &&
  @     (\forall integer i; from <= i < a ==> !released(q, q->order[i], now_us)) ==>
  @     from <= b <= to && (b < to ==> released(q, q->order[b], now_us)) &&
  @     (\forall integer i; from <= i < b ==> !released(q, q->order[i], now_us)) ==> a == b;
  @ lemma DEC_002_only: \forall keel_queue_t *q, integer first, last, a, b;
  @     a <= KEEL_TIME_NEVER_US ==> b <= KEEL_TIME_NEVER_US ==>
  @     is_earliest(q, first, last, a) ==> is_earliest(q, first, last, b) ==> a == b;
  @ lemma DEC_003_only: \forall keel_queue_t *q, keel_choice_t a, keel_choice_t b,
  @     integer now_us, room_us, without;
  @     chosen(q, a, now_us, room_us, without) ==> chosen(q, b, now_us, room_us, without) ==>
  @     (\forall integer i; q->realtime_count <= i < q->count ==>
  @         eligible(q, q->order[i], now_us, room_us, without) ==>
  @         task_priority(q, q->order[i], now_us) <= a.priority &&
  @         task_priority(q, q->order[i], now_us) <= b.priority) ==>
  @     (\forall integer i; q->realtime_count <= i < a.position ==>
  @         eligible(q, q->order[i], now_us, room_us, without) ==>
  @         task_priority(q, q->order[i], now_us) < a.priority) ==>
  @     (\forall integer i; q->realtime_count <= i < b.position ==>
  @         eligible(q, q->order[i], now_us, room_us, without) ==>
  @         task_priority(q, q->order[i], now_us) < b.priority) ==>
  @     a.position == b.position && a.priority == b.priority;
  @*/

uint32_t keel_decision_realtime(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                uint64_t now_us)
{
    uint32_t i = from;

    /*@ loop invariant range: from <= i <= to;
      @ loop invariant none: \forall integer j; from <= j < i ==>
      @     !released(queue, queue->order[j], now_us);
      @ loop assigns i;
      @ loop variant to - i;
      @*/
    while ((i < to) && (queue->release_us[queue->order[i]] > now_us)) {
        i++;
    }
    return i;
}

uint64_t keel_decision_earliest_us(const keel_queue_t *queue)
{
    uint64_t earliest_us = KEEL_TIME_NEVER_US;

    /*@ loop invariant range: 0 <= i <= queue->realtime_count;
      @ loop invariant earliest: is_earliest(queue, 0, i, earliest_us);
      @ loop assigns i, earliest_us;
      @ loop variant queue->realtime_count - i;
      @*/
    for (uint32_t i = 0u; i < queue->realtime_count; i++) {
        const uint64_t release_us = queue->release_us[queue->order[i]];

        if (release_us < earliest_us) {
            earliest_us = release_us;
        }
    }
    return earliest_us;
}

/* The dynamic priority of a released task. Mostly it is less than a period late, and then sp * late
 * is mostly below T: no division. */
/*@ requires \valid_read(queue) && slot < KEEL_QUEUE_CAPACITY;
  @ requires period_valid(queue->period_us[slot]);
  @ requires 1 <= queue->priority[slot] <= KEEL_PRIORITY_HIGH;
  @ requires released(queue, slot, now_us) && now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns \nothing;
  @ ensures \result == task_priority(queue, slot, now_us);
  @ ensures 1 <= \result <= KEEL_PRIORITY_REALTIME;
  @*/
static uint32_t priority_of(const keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    const uint64_t late_us = now_us - queue->release_us[slot];
    const uint32_t period_us = queue->period_us[slot];
    const uint32_t sp = queue->priority[slot];

    if ((late_us < period_us) && ((sp * late_us) < period_us)) {
        return 1u + sp;
    }
    return keel_priority_dynamic(sp, late_us + period_us, period_us);
}

/*@ requires \valid_read(queue) && slot < KEEL_QUEUE_CAPACITY;
  @ assigns \nothing;
  @ ensures \result <==> task_worst(queue, slot) <= room_us;
  @*/
static bool task_fits(const keel_queue_t *queue, uint32_t slot, uint32_t room_us)
{
    return (queue->budget_us[slot] <= room_us) && (queue->stats[slot].remembered_us <= room_us);
}

keel_choice_t keel_decision_other(const keel_queue_t *queue, uint64_t now_us, uint32_t room_us,
                                  bool without_promotion)
{
    const uint32_t last = queue->count;
    keel_choice_t choice = {KEEL_TIME_NEVER_US, 0u, 0u};

    /*@ loop invariant range: queue->realtime_count <= i <= queue->count;
      @ loop invariant scale: choice.priority <= KEEL_PRIORITY_REALTIME;
      @ loop invariant earliest: is_earliest(queue, queue->realtime_count, i, choice.earliest_us);
      @ loop invariant before: choice.priority > 0 ==> choice.position < i;
      @ loop invariant nowhere: choice.priority == 0 ==> choice.position == 0;
      @ loop invariant chosen: choice.priority > 0 ==>
      @     chosen(queue, choice, now_us, room_us, without_promotion);
      @ loop invariant highest: \forall integer j; queue->realtime_count <= j < i ==>
      @     eligible(queue, queue->order[j], now_us, room_us, without_promotion) ==>
      @     task_priority(queue, queue->order[j], now_us) <= choice.priority;
      @ loop invariant first: choice.priority > 0 ==>
      @     \forall integer j; queue->realtime_count <= j < choice.position ==>
      @     eligible(queue, queue->order[j], now_us, room_us, without_promotion) ==>
      @     task_priority(queue, queue->order[j], now_us) < choice.priority;
      @ loop invariant none: choice.priority == 0 ==>
      @     \forall integer j; queue->realtime_count <= j < i ==>
      @     !eligible(queue, queue->order[j], now_us, room_us, without_promotion);
      @ loop assigns i, choice;
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = queue->realtime_count; i < last; i++) {
        const uint32_t slot = queue->order[i];
        const uint64_t release_us = queue->release_us[slot];

        if (release_us < choice.earliest_us) {
            choice.earliest_us = release_us;
        }
        if (release_us <= now_us) {
            const uint32_t priority = priority_of(queue, slot, now_us);

            if ((priority > choice.priority) &&
                (((priority == KEEL_PRIORITY_REALTIME) && !without_promotion) ||
                 task_fits(queue, slot, room_us))) {
                choice.position = i;
                choice.priority = priority;
            }
        }
    }
    return choice;
}

/* When only waiting makes the task in a slot run, which is not real-time. */
/*@ requires \valid_read(queue) && slot < KEEL_QUEUE_CAPACITY;
  @ requires period_valid(queue->period_us[slot]);
  @ requires 1 <= queue->priority[slot] <= KEEL_PRIORITY_HIGH;
  @ requires now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns \nothing;
  @ ensures \result == next_event(queue, slot, now_us, without_promotion);
  @*/
static uint64_t event_of(const keel_queue_t *queue, uint32_t slot, uint64_t now_us,
                         bool without_promotion)
{
    const uint64_t release_us = queue->release_us[slot];

    if (release_us > now_us) {
        return release_us;
    }
    if (without_promotion) {
        return KEEL_TIME_NEVER_US;
    }
    return release_us +
           keel_priority_promotion_age_us(queue->priority[slot], queue->period_us[slot]) -
           queue->period_us[slot];
}

uint64_t keel_decision_event_us(const keel_queue_t *queue, uint64_t now_us, bool without_promotion)
{
    uint64_t event_us = KEEL_TIME_NEVER_US;

    /*@ loop invariant range: queue->realtime_count <= i <= queue->count;
      @ loop invariant bound: \forall integer j; queue->realtime_count <= j < i ==>
      @     event_us <= next_event(queue, queue->order[j], now_us, without_promotion);
      @ loop invariant exact: event_us == KEEL_TIME_NEVER_US ||
      @     \exists integer j; queue->realtime_count <= j < i &&
      @         event_us == next_event(queue, queue->order[j], now_us, without_promotion);
      @ loop assigns i, event_us;
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = queue->realtime_count; i < queue->count; i++) {
        const uint64_t at_us = event_of(queue, queue->order[i], now_us, without_promotion);

        if (at_us < event_us) {
            event_us = at_us;
        }
    }
    return event_us;
}
