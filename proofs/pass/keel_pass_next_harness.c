// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/pass.c src/rtos/queue.c src/rtos/decision.c src/rtos/priority.c src/rtos/stats.c
// sources: specs/model/pass.c specs/model/clock.c specs/model/stats.c
// replaces: keel_decision_realtime keel_decision_earliest_us keel_decision_other
// replaces: keel_decision_event_us keel_queue_advance
// covers: keel_pass_next dispatch_task find_realtime find_earliest_realtime choose_other
// covers: remember_earliest serve_other find_wake close_pass model_pass_next serve
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// Bounded to a capacity of 4 tasks, with which the solver comes to an end in half a minute; the
// contract under WP has no bound and determines every field.
// What a decision looks up in the queue is the same unknown for the code and for the model: the
// answer that the model is told the code is told as well, if it asks the same. The code asks less
// often, where a bound that it remembers already has the answer.
#include "../../specs/model/decision.h"
#include "../../specs/model/pass.h"
#include "../common/decision_contracts.h"
#include "../common/keel_scheduler_proof.h"
#include "../common/queue_contracts.h"
#include "../common/step_contracts.h"

keel_choice_t nondet_choice(void);

static uint32_t x; /* The position and the slot at which all is seen. */
static keel_scheduler_t before;

/* The answers. */
static uint32_t first;
static uint64_t earliest_us;
static keel_choice_t choice;
static uint64_t event_us;
static uint32_t room_us; /* of which the choice is */
static bool without;     /* and whether it is one without promotion */
static uint32_t served;  /* the slot whose release has moved on */
static uint64_t next_us;
static uint16_t skipped;

static bool is_asked_of(const keel_queue_t *queue, uint64_t now_us)
{
    return (now_us == before.clock.now_us) && queue_same(queue, &before.queue, x);
}

uint32_t model_decision_realtime(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                 uint64_t now_us)
{
    __CPROVER_assume(keel_decision_realtime_does(first, queue, from, to, now_us));
    return first;
}

uint32_t keel_decision_realtime_stand_in(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                         uint64_t now_us)
{
    __CPROVER_assert(keel_decision_realtime_may(queue, from, to),
                     "precondition: keel_decision_realtime");
    __CPROVER_assert(is_asked_of(queue, now_us) && (from == (uint32_t)before.cursor) &&
                         (to == (uint32_t)before.pass_end),
                     "SCH_015_asked: the tasks of the pass that it has yet to look at");
    __CPROVER_assume(keel_decision_realtime_does(first, queue, from, to, now_us));
    return first;
}

uint64_t model_decision_earliest_us(const keel_queue_t *queue)
{
    __CPROVER_assume(keel_decision_earliest_us_does(earliest_us, queue));
    return earliest_us;
}

uint64_t keel_decision_earliest_us_stand_in(const keel_queue_t *queue)
{
    __CPROVER_assert(keel_decision_earliest_us_may(queue),
                     "precondition: keel_decision_earliest_us");
    __CPROVER_assert(is_asked_of(queue, before.clock.now_us), "SCH_016_asked: of the same queue");
    __CPROVER_assume(keel_decision_earliest_us_does(earliest_us, queue));
    return earliest_us;
}

uint32_t model_decision_room_us(uint64_t realtime_us, uint64_t now_us, uint32_t guard_us)
{
    return keel_decision_room_us(realtime_us, now_us, guard_us);
}

keel_choice_t model_decision_other(const keel_queue_t *queue, uint64_t now_us, uint32_t room,
                                   bool without_promotion)
{
    room_us = room;
    without = without_promotion;
    __CPROVER_assume(keel_decision_other_does(&choice, queue, now_us));
    return choice;
}

keel_choice_t keel_decision_other_stand_in(const keel_queue_t *queue, uint64_t now_us,
                                           uint32_t room, bool without_promotion)
{
    __CPROVER_assert(keel_decision_other_may(queue, now_us), "precondition: keel_decision_other");
    __CPROVER_assert(is_asked_of(queue, now_us) && (room == room_us) &&
                         (without_promotion == without),
                     "SCH_016_asked: with the room that the slack leaves");
    __CPROVER_assume(keel_decision_other_does(&choice, queue, now_us));
    return choice;
}

uint64_t model_decision_event_us(const keel_queue_t *queue, uint64_t now_us, bool without_promotion)
{
    (void)queue;
    (void)now_us;
    without = without_promotion;
    return event_us;
}

uint64_t keel_decision_event_us_stand_in(const keel_queue_t *queue, uint64_t now_us,
                                         bool without_promotion)
{
    const uint64_t told_us = event_us;

    __CPROVER_assert(keel_decision_event_us_may(queue, now_us),
                     "precondition: keel_decision_event_us");
    __CPROVER_assert(is_asked_of(queue, now_us) && (without_promotion == without),
                     "SCH_012_asked: of the same queue");
    __CPROVER_assume(keel_decision_event_us_does(told_us, event_us));
    return told_us;
}

void model_queue_advance(keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    (void)now_us;
    served = slot;
    queue->release_us[slot] = next_us;
    queue->skipped[slot] = skipped;
}

void keel_queue_advance_stand_in(keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    keel_queue_t modelled = *queue;

    __CPROVER_assert(keel_queue_advance_may(queue, slot, now_us),
                     "precondition: keel_queue_advance");
    __CPROVER_assert((slot == served) && (now_us == before.clock.now_us) &&
                         (queue->release_us[slot] == before.queue.release_us[slot]) &&
                         (queue->skipped[slot] == before.queue.skipped[slot]),
                     "SCH_014_moved: the release of the task that is served, once");
    queue->release_us[slot] = next_us;
    queue->skipped[slot] = skipped;
    modelled.release_us[slot] = next_us;
    modelled.skipped[slot] = skipped;
    __CPROVER_assume(keel_queue_advance_does(queue, &modelled, x));
}

void keel_pass_next_harness(void)
{
    keel_scheduler_t scheduler;
    keel_scheduler_t expected;
    bool due;
    const keel_task_config_t *modelled;
    const keel_task_config_t *task;

    x = any_below(CAPACITY);
    first = nondet_u32();
    earliest_us = nondet_u64();
    choice = nondet_choice();
    event_us = nondet_u64();
    next_us = nondet_u64();
    skipped = nondet_u16();
    any_scheduler(&scheduler, CAPACITY);
    due = release_at(&scheduler.queue, x) <= scheduler.clock.now_us;
    before = scheduler;
    expected = scheduler;
    modelled = model_pass_next(&expected);

    __CPROVER_assume(keel_pass_next_may(&scheduler));
    task = keel_pass_next(&scheduler);

    __CPROVER_assert((task == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SCH_014_model: as the model says");
    __CPROVER_assert(keel_pass_next_does(task, &before, &scheduler, x, due),
                     "SCH_023_part: as the pass takes it to do");
}
