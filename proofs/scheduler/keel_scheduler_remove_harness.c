// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_remove take_out shift_up
#include "../common/keel_scheduler_proof.h"

void keel_scheduler_remove_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t place = any_below(CAPACITY + 1u);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    bool null;
    bool known;
    keel_scheduler_t before;
    keel_scheduler_t expected;
    keel_status_t status;

    any_scheduler(&scheduler, place);
    null = !given || (task == NULL);
    known = place < scheduler.queue.count;
    before = scheduler;
    expected = scheduler;

    status = keel_scheduler_remove(given ? &scheduler : NULL, task);

    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_NULL) == null, "SCH_008_null: an argument is missing");
    __CPROVER_assert((status == KEEL_ERR_UNKNOWN_TASK) == (!null && !known),
                     "SCH_008_unknown: it is not in the queue");
    __CPROVER_assert((status == KEEL_OK) == (!null && known), "SCH_007_ok: a queued task goes");
    if (status == KEEL_OK) {
        const uint32_t slot = before.queue.order[place];
        const int16_t gone = (int16_t)place;

        __CPROVER_assert(scheduler.queue.task[i] != task, "SCH_007_gone: it is queued no more");
        expected.queue.count--;
        expected.queue.realtime_count -= (place < before.queue.realtime_count) ? 1u : 0u;
        expected.queue.task[slot] = NULL;
        expected.queue.order[i] = scheduler.queue.order[i];
        __CPROVER_assert(
            scheduler.queue.order[i] ==
                (((place <= i) && (i < expected.queue.count))
                     ? before.queue.order[(i + 1u) % CAPACITY]
                     : ((i == expected.queue.count) ? slot : before.queue.order[i])),
            "SCH_007_order: those behind it move up by one, its slot is the first free one");
        expected.cursor -= (gone < before.cursor) ? 1 : 0;
        expected.pass_end -= (gone < before.pass_end) ? 1 : 0;
        if (gone == before.running) {
            expected.running = KEEL_POSITION_NONE;
        } else if (gone < before.running) {
            expected.running--;
        }
        __CPROVER_assert((scheduler.cursor == expected.cursor) &&
                             (scheduler.pass_end == expected.pass_end),
                         "SCH_007_pass: the pass goes on with the same tasks");
        __CPROVER_assert(scheduler.running == expected.running,
                         "SCH_007_running: the running task is still known, unless it went");
        expected.wake_us = 0u;
        expected.earliest_realtime_us = 0u;
        expected.earliest_other_us = 0u;
        __CPROVER_assert((scheduler.wake_us == 0u) && (scheduler.earliest_realtime_us == 0u) &&
                             (scheduler.earliest_other_us == 0u),
                         "SCH_007_wake: nothing is known of the releases");
        __CPROVER_assert((scheduler.pass_end - scheduler.cursor) <=
                             (before.pass_end - before.cursor),
                         "SCH_007_shrinks: the pass gets no longer");
    }
    __CPROVER_assert(scheduler_same(&scheduler, &expected, i),
                     "SCH_007_frame: nothing else is written, and nothing at all by a refusal");
}
