// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/queue.c
// covers: keel_queue_add open_slot keel_queue_find
#include "../common/keel_proof.h"

static bool holds(const keel_queue_t *queue, const keel_task_t *task)
{
    bool held = false;

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        held = held || ((i < queue->count) && (queue->task[i] == task));
    }
    return held;
}

void keel_queue_add_harness(void)
{
    keel_queue_t queue;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t t = any_below(TASKS);
    keel_queue_t before;
    keel_task_t task_before;
    keel_task_config_t config_before;
    keel_task_t *task;
    bool held;
    bool realtime;
    uint32_t place;
    keel_status_t status;

    any_queue(&queue);
    task = nondet_bool() ? proof_task[any_below(TASKS)] : NULL;
    realtime = (task != NULL) && is_realtime(task);
    held = holds(&queue, task);
    before = queue;
    task_before = *proof_task[t];
    config_before = *proof_config[t];
    place = realtime ? queue.realtime_count : queue.count;

    status = keel_queue_add(&queue, task);

    assert_queue_valid(&queue);
    __CPROVER_assert((task != NULL) || (status == KEEL_ERR_NULL), "QUE_004_null: no task");
    __CPROVER_assert((task == NULL) || !held || (status == KEEL_ERR_DUPLICATE),
                     "QUE_004_duplicate: queued already");
    __CPROVER_assert((task == NULL) || held || (before.count < CAPACITY) ||
                         (status == KEEL_ERR_FULL),
                     "QUE_004_full: no slot is left");
    __CPROVER_assert((task == NULL) || held || (before.count == CAPACITY) || (status == KEEL_OK),
                     "QUE_003_ok: a new task is taken while a slot is left");
    if (status == KEEL_OK) {
        __CPROVER_assert(queue.count == (before.count + 1u), "QUE_003_count: one task more");
        __CPROVER_assert(queue.realtime_count == (before.realtime_count + (realtime ? 1u : 0u)),
                         "QUE_003_realtime: one real-time task more if it is one");
        __CPROVER_assert(queue.task[place] == task,
                         "QUE_003_place: it stands behind the last of its class");
        __CPROVER_assert((i >= place) || (queue.task[i] == before.task[i]),
                         "QUE_006_before: the tasks before it stay");
        __CPROVER_assert((i <= place) || (i >= queue.count) ||
                             (queue.task[i] == before.task[i - 1u]),
                         "QUE_006_behind: the tasks behind it move down one slot");
    } else {
        __CPROVER_assert((queue.count == before.count) &&
                             (queue.realtime_count == before.realtime_count),
                         "QUE_004_unchanged: a refusal keeps the counts");
        __CPROVER_assert(queue.task[i] == before.task[i],
                         "QUE_004_unchanged: a refusal keeps the slots");
    }
    __CPROVER_assert(task_same(proof_task[t], &task_before) &&
                         config_same(proof_config[t], &config_before),
                     "QUE_003_frame: no task and no declaration is written");
}
