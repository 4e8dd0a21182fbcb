/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/queue.h"

#include <stdbool.h>
#include <stddef.h>

void keel_queue_init(keel_queue_t *queue)
{
    queue->count = 0u;
    queue->realtime_count = 0u;
    /*@ loop invariant range: 0 <= i <= KEEL_QUEUE_CAPACITY;
      @ loop invariant order: \forall integer j; 0 <= j < i ==> queue->order[j] == j;
      @ loop invariant free: \forall integer j; 0 <= j < i ==> queue->task[j] == \null;
      @ loop assigns i, queue->order[0 .. KEEL_QUEUE_CAPACITY - 1],
      @     queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant KEEL_QUEUE_CAPACITY - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        queue->order[i] = (uint8_t)i;
        queue->task[i] = NULL;
    }
}

uint32_t keel_queue_find(const keel_queue_t *queue, const keel_task_config_t *task)
{
    uint32_t i = 0u;

    /*@ loop invariant range: 0 <= i <= queue->count;
      @ loop invariant absent: \forall integer j; 0 <= j < i ==>
      @     queue->task[queue->order[j]] != task;
      @ loop assigns i;
      @ loop variant queue->count - i;
      @*/
    while ((i < queue->count) && (queue->task[queue->order[i]] != task)) {
        i++;
    }
    return i;
}

/* Fills the first free slot: what is declared of a task, its first release, no statistics. */
/*@ requires \valid(queue) && queue_valid(queue) && queue->count < KEEL_QUEUE_CAPACITY;
  @ requires \valid_read(task) && \separated(queue, task) && config_valid(task);
  @ assigns queue->release_us[queue->order[queue->count]],
  @     queue->period_us[queue->order[queue->count]],
  @     queue->budget_us[queue->order[queue->count]],
  @     queue->priority[queue->order[queue->count]],
  @     queue->skipped[queue->order[queue->count]],
  @     STATS_FIELDS(queue->stats[queue->order[queue->count]]);
  @ QUEUE_STAYS_VALID(queue)
  @ ensures slot: \result == queue->order[queue->count];
  @ ensures release: queue->release_us[\result] == release_us;
  @ ensures period: queue->period_us[\result] == task->period_us;
  @ ensures budget: queue->budget_us[\result] == task->budget_us;
  @ ensures priority: queue->priority[\result] == task->priority;
  @ ensures skipped: queue->skipped[\result] == 0;
  @ ensures stats: STATS_FRESH(queue->stats[\result]);
  @ ensures order: order_same{Pre, Post}(queue, 0, KEEL_QUEUE_CAPACITY);
  @*/
static uint8_t fill_slot(keel_queue_t *queue, const keel_task_config_t *task, uint64_t release_us)
{
    const uint8_t slot = queue->order[queue->count];

    //@ assert free: \forall integer i; 0 <= i < queue->count ==> queue->order[i] != slot;
    queue->release_us[slot] = release_us;
    queue->period_us[slot] = task->period_us;
    queue->budget_us[slot] = task->budget_us;
    queue->priority[slot] = (uint8_t)task->priority;
    queue->skipped[slot] = 0u;
    queue->stats[slot].total_us = 0u;
    queue->stats[slot].runs = 0u;
    queue->stats[slot].last_us = 0u;
    queue->stats[slot].longest_us = 0u;
    queue->stats[slot].remembered_us = 0u;
    queue->stats[slot].forgotten_in = 0u;
    queue->stats[slot].overruns = 0u;
    queue->stats[slot].promotions = 0u;
    //@ assert order: order_same{Pre, Here}(queue, 0, KEEL_QUEUE_CAPACITY);
    return slot;
}

/* Moves the first free slot to a place in the order, those from there on down by one. */
/*@ requires \valid(queue) && queue_counts(queue) && queue_order(queue);
  @ requires place <= queue->count < KEEL_QUEUE_CAPACITY;
  @ assigns queue->order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures slot: queue->order[place] == \old(queue->order[queue->count]);
  @ ensures before: order_same{Pre, Post}(queue, 0, place);
  @ ensures moved: order_down{Pre, Post}(queue, place + 1, queue->count + 1);
  @ ensures behind: order_same{Pre, Post}(queue, queue->count + 1, KEEL_QUEUE_CAPACITY);
  @ ensures order: queue_order(queue);
  @*/
static void open_place(keel_queue_t *queue, uint32_t place)
{
    const uint8_t slot = queue->order[queue->count];

    /*@ loop invariant range: place <= i <= queue->count;
      @ loop invariant unmoved: order_same{Pre, Here}(queue, 0, i);
      @ loop invariant moved: order_down{Pre, Here}(queue, i + 1, queue->count + 1);
      @ loop invariant behind: order_same{Pre, Here}(queue, queue->count + 1,
      @                                              KEEL_QUEUE_CAPACITY);
      @ loop assigns i, queue->order[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant i;
      @*/
    for (uint32_t i = queue->count; i > place; i--) {
        queue->order[i] = queue->order[i - 1u];
    }
    queue->order[place] = slot;
}

/* Moves the slot at a place behind the others in use, those behind it up by one. */
/*@ requires \valid(queue) && queue_counts(queue) && queue_order(queue);
  @ requires place < queue->count;
  @ assigns queue->order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures slot: \result == \old(queue->order[place]) &&
  @     queue->order[queue->count - 1] == \result;
  @ ensures before: order_same{Pre, Post}(queue, 0, place);
  @ ensures moved: order_up{Pre, Post}(queue, place, queue->count - 1);
  @ ensures behind: order_same{Pre, Post}(queue, queue->count, KEEL_QUEUE_CAPACITY);
  @ ensures order: queue_order(queue);
  @*/
static uint8_t close_place(keel_queue_t *queue, uint32_t place)
{
    const uint8_t slot = queue->order[place];
    const uint32_t last = queue->count - 1u;

    /*@ loop invariant range: place <= i <= last;
      @ loop invariant before: order_same{Pre, Here}(queue, 0, place);
      @ loop invariant moved: order_up{Pre, Here}(queue, place, i);
      @ loop invariant unmoved: order_same{Pre, Here}(queue, i, KEEL_QUEUE_CAPACITY);
      @ loop assigns i, queue->order[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant last - i;
      @*/
    for (uint32_t i = place; i < last; i++) {
        queue->order[i] = queue->order[i + 1u];
    }
    queue->order[last] = slot;
    return slot;
}

/* Puts a slot that was filled into the order. */
/*@ requires \valid(queue) && queue_valid(queue) && queue->count < KEEL_QUEUE_CAPACITY;
  @ requires slot == queue->order[queue->count];
  @ requires task != \null && period_valid(queue->period_us[slot]) && 0 < queue->budget_us[slot];
  @ requires priority_valid(queue->priority[slot]);
  @ requires \forall integer j; 0 <= j < queue->count ==> queue->task[queue->order[j]] != task;
  @ assigns queue->count, queue->realtime_count, queue->order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns queue->task[slot];
  @ QUEUE_STAYS_VALID(queue)
  @ ensures count: queue->count == \old(queue->count) + 1;
  @ ensures realtime: queue->realtime_count == \old(queue->realtime_count)
  @     + ((\old(queue->priority[slot]) == KEEL_PRIORITY_REALTIME) ? 1 : 0);
  @ ensures slot: queue->order[\old(queue_place(queue, queue->priority[slot]))] == slot;
  @ ensures task: queue->task[slot] == task;
  @ ensures priority: queue->priority[slot] == \old(queue->priority[slot]);
  @ ensures before: order_same{Pre, Post}(queue, 0,
  @     \old(queue_place(queue, queue->priority[slot])));
  @ ensures behind: order_down{Pre, Post}(queue,
  @     \old(queue_place(queue, queue->priority[slot])) + 1, queue->count);
  @ ensures free: order_same{Pre, Post}(queue, queue->count, KEEL_QUEUE_CAPACITY);
  @*/
static void enqueue_task(keel_queue_t *queue, uint8_t slot, const keel_task_config_t *task)
{
    const bool realtime = queue->priority[slot] == KEEL_PRIORITY_REALTIME;
    const uint32_t place = realtime ? queue->realtime_count : queue->count;

    open_place(queue, place);
    queue->task[slot] = task;
    queue->count++;
    if (realtime) {
        queue->realtime_count++;
    }
    //@ assert before: order_same{Pre, Here}(queue, 0, place);
    //@ assert placed: queue->order[place] == slot;
    //@ assert behind: order_down{Pre, Here}(queue, place + 1, queue->count);
    //@ assert rest: order_same{Pre, Here}(queue, queue->count, KEEL_QUEUE_CAPACITY);
    /*@ assert free: \forall integer i; 0 <= i < \at(queue->count, Pre) ==>
      @     \at(queue->order[i], Pre) != slot;
      @*/
    /*@ assert priorities: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
      @     queue->priority[x] == \at(queue->priority[x], Pre);
      @*/
    /*@ assert tasks: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==> x != slot ==>
      @     queue->task[x] == \at(queue->task[x], Pre);
      @*/
    /*@ assert tasks_before: \forall integer i; 0 <= i < place ==>
      @     queue->task[queue->order[i]] == \at(queue->task[queue->order[i]], Pre);
      @*/
    /*@ assert tasks_behind: \forall integer i; place < i < queue->count ==>
      @     queue->task[queue->order[i]] == \at(queue->task[queue->order[i - 1]], Pre);
      @*/
    /*@ assert unused: \forall integer i; queue->count <= i < KEEL_QUEUE_CAPACITY ==>
      @     queue->task[queue->order[i]] == \at(queue->task[queue->order[i]], Pre);
      @*/
    /*@ assert used: \forall integer i; 0 <= i < queue->count ==>
      @     queue->task[queue->order[i]] != \null;
      @*/
    /*@ assert new: \forall integer i; 0 <= i < queue->count ==> i != place ==>
      @     queue->task[queue->order[i]] != task;
      @*/
    /*@ assert different: \forall integer i, j; 0 <= i < j < \at(queue->count, Pre) ==>
      @     \at(queue->task[queue->order[i]], Pre) != \at(queue->task[queue->order[j]], Pre);
      @*/
    /*@ assert old_before: \forall integer i, j; 0 <= i < j < place ==>
      @     queue->task[queue->order[i]] != queue->task[queue->order[j]];
      @*/
    /*@ assert old_around: \forall integer i, j; 0 <= i < place < j < queue->count ==>
      @     queue->task[queue->order[i]] != queue->task[queue->order[j]];
      @*/
    /*@ assert old_behind: \forall integer i, j; place < i < j < queue->count ==>
      @     queue->task[queue->order[i]] != queue->task[queue->order[j]];
      @*/
}

void keel_queue_add(keel_queue_t *queue, const keel_task_config_t *task, uint64_t release_us)
{
    const uint8_t slot = fill_slot(queue, task, release_us);

    //@ assert slot: 0 <= slot < KEEL_QUEUE_CAPACITY;
    //@ assert fresh: SLOT_FRESH(queue, slot);
    //@ assert filled: queue->priority[slot] == task->priority;
    /*@ assert place: queue_place(queue, queue->priority[slot])
      @     == \at(queue_place(queue, task->priority), Pre);
      @*/
    enqueue_task(queue, slot, task);
    //@ assert priority: queue->priority[slot] == task->priority;
    //@ assert task: queue->task[slot] == task;
    /*@ assert before: order_same{Pre, Here}(queue, 0,
      @     \at(queue_place(queue, task->priority), Pre));
      @*/
    //@ assert joined: queue->order[\at(queue_place(queue, task->priority), Pre)] == slot;
    /*@ assert behind: order_down{Pre, Here}(queue,
      @     \at(queue_place(queue, task->priority), Pre) + 1, queue->count);
      @*/
    //@ assert rest: order_same{Pre, Here}(queue, queue->count, KEEL_QUEUE_CAPACITY);
}

void keel_queue_remove(keel_queue_t *queue, uint32_t position)
{
    const uint8_t slot = close_place(queue, position);

    queue->count--;
    queue->task[slot] = NULL;
    if (position < queue->realtime_count) {
        queue->realtime_count--;
    }
    //@ assert before: order_same{Pre, Here}(queue, 0, position);
    //@ assert behind: order_up{Pre, Here}(queue, position, queue->count);
    //@ assert freed: queue->order[queue->count] == slot;
    //@ assert rest: order_same{Pre, Here}(queue, queue->count + 1, KEEL_QUEUE_CAPACITY);
    /*@ assert tasks: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==> x != slot ==>
      @     queue->task[x] == \at(queue->task[x], Pre);
      @*/
    //@ assert used: \forall integer i; 0 <= i < queue->count ==> queue->order[i] != slot;
    /*@ assert tasks_before: \forall integer i; 0 <= i < position ==>
      @     queue->task[queue->order[i]] == \at(queue->task[queue->order[i]], Pre);
      @*/
    /*@ assert tasks_behind: \forall integer i; position <= i < queue->count ==>
      @     queue->task[queue->order[i]] == \at(queue->task[queue->order[i + 1]], Pre);
      @*/
    /*@ assert priorities: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
      @     queue->priority[x] == \at(queue->priority[x], Pre);
      @*/
    /*@ assert priorities_before: \forall integer i; 0 <= i < position ==>
      @     queue->priority[queue->order[i]] == \at(queue->priority[queue->order[i]], Pre);
      @*/
    /*@ assert priorities_behind: \forall integer i; position <= i < queue->count ==>
      @     queue->priority[queue->order[i]] == \at(queue->priority[queue->order[i + 1]], Pre);
      @*/
    /*@ assert unused: \forall integer i; queue->count < i < KEEL_QUEUE_CAPACITY ==>
      @     queue->task[queue->order[i]] == \at(queue->task[queue->order[i]], Pre);
      @*/
    /*@ assert old_before: \forall integer i, j; 0 <= i < j < position ==>
      @     queue->task[queue->order[i]] != queue->task[queue->order[j]];
      @*/
    /*@ assert old_around: \forall integer i, j; 0 <= i < position <= j < queue->count ==>
      @     queue->task[queue->order[i]] != queue->task[queue->order[j]];
      @*/
    /*@ assert old_behind: \forall integer i, j; position <= i < j < queue->count ==>
      @     queue->task[queue->order[i]] != queue->task[queue->order[j]];
      @*/
}

/*@ assigns \nothing;
  @ ensures \result == \min(UINT16_MAX, value + more);
  @*/
static uint16_t add_saturating(uint16_t value, uint64_t more)
{
    const uint16_t room = (uint16_t)(UINT16_MAX - value);

    return (more > room) ? UINT16_MAX : (uint16_t)(value + more);
}

void keel_queue_advance(keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    const uint32_t period_us = queue->period_us[slot];
    const uint64_t late_us = now_us - queue->release_us[slot];
    /* On the target a division of 64 bits is a call, which a task that is on time does without. */
    const uint64_t missed = (late_us < period_us) ? 0u : (late_us / period_us);

    //@ assert floor: missed * period_us <= late_us < (missed + 1) * period_us;
    queue->release_us[slot] += (missed + 1u) * period_us;
    queue->skipped[slot] = add_saturating(queue->skipped[slot], missed);
}
