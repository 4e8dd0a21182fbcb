/* Unit tests of keel/rtos/queue.h. A queue is compared as text: the names of its tasks in order. */
#include "keel/rtos/queue.h"
#include "unity.h"

#include <string.h>

#define TASKS (KEEL_QUEUE_CAPACITY + 1u)

static const keel_task_config_t realtime = {.priority = KEEL_PRIORITY_REALTIME};
static const keel_task_config_t other = {.priority = KEEL_PRIORITY_LOW};

static keel_queue_t queue;
static keel_task_t task[TASKS]; /* task[0] is called A, task[1] B, and so on. */

void setUp(void)
{
    memset(task, 0, sizeof task);
    memset(&queue, 0, sizeof queue);
    keel_queue_init(&queue);
}

void tearDown(void)
{
}

/* Adds the tasks of a text: capitals as real-time tasks, small letters as others. */
static void fill(const char *names)
{
    for (const char *name = names; *name != '\0'; name++) {
        const bool capital = (*name >= 'A') && (*name <= 'Z');
        keel_task_t *const added = &task[*name - (capital ? 'A' : 'a')];

        added->config = capital ? &realtime : &other;
        TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_add(&queue, added));
    }
}

/* The queue holds these tasks in this order, counts them right and has nothing behind them. */
static void holds(const char *names)
{
    uint32_t capitals = 0u;
    const uint32_t length = (uint32_t)strlen(names);

    TEST_ASSERT_EQUAL_UINT32(length, queue.count);
    for (uint32_t i = 0u; i < length; i++) {
        const bool capital = (names[i] >= 'A') && (names[i] <= 'Z');

        TEST_ASSERT_EQUAL_PTR(&task[names[i] - (capital ? 'A' : 'a')], queue.task[i]);
        capitals += capital ? 1u : 0u;
    }
    for (uint32_t i = length; i < KEEL_QUEUE_CAPACITY; i++) {
        TEST_ASSERT_NULL(queue.task[i]);
    }
    TEST_ASSERT_EQUAL_UINT32(capitals, queue.realtime_count);
}

static void fill_to_capacity(void)
{
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        task[i].config = &other;
        TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_add(&queue, &task[i]));
    }
}

static void QUE_001_init_empties_whatever_was_there(void)
{
    memset(&queue, 0xA5, sizeof queue);
    keel_queue_init(&queue);
    holds("");
}

static void QUE_002_find_gives_the_index(void)
{
    fill("AbC"); /* Queued as A, C, b. */
    TEST_ASSERT_EQUAL_UINT32(0u, keel_queue_find(&queue, &task[0]));
    TEST_ASSERT_EQUAL_UINT32(2u, keel_queue_find(&queue, &task[1]));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_queue_find(&queue, &task[2]));
}

static void QUE_002_find_gives_the_count_for_a_stranger(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, keel_queue_find(&queue, &task[0]));
    fill("AbC");
    TEST_ASSERT_EQUAL_UINT32(3u, keel_queue_find(&queue, &task[3]));
    TEST_ASSERT_EQUAL_UINT32(3u, keel_queue_find(&queue, NULL));
}

static void QUE_002_find_stops_at_the_end_of_a_full_queue(void)
{
    fill_to_capacity();
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY - 1u,
                             keel_queue_find(&queue, &task[KEEL_QUEUE_CAPACITY - 1u]));
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY,
                             keel_queue_find(&queue, &task[KEEL_QUEUE_CAPACITY]));
}

static void QUE_003_add_puts_other_behind_all(void)
{
    fill("a");
    holds("a");
    fill("bc");
    holds("abc");
}

static void QUE_003_add_puts_realtime_behind_realtime(void)
{
    fill("AB");
    holds("AB");
    fill("C");
    holds("ABC");
}

static void QUE_003_add_puts_realtime_before_others(void)
{
    fill("ab");
    fill("C");
    holds("Cab");
    fill("D");
    holds("CDab");
    fill("e");
    holds("CDabe");
    fill("F");
    holds("CDFabe");
}

static void QUE_003_add_fills_every_slot(void)
{
    fill_to_capacity();
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY, queue.count);
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        TEST_ASSERT_EQUAL_PTR(&task[i], queue.task[i]);
    }
}

static void QUE_003_add_moves_a_nearly_full_queue(void)
{
    for (uint32_t i = 0u; i < (KEEL_QUEUE_CAPACITY - 1u); i++) {
        task[i].config = &other;
        TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_add(&queue, &task[i]));
    }
    task[KEEL_QUEUE_CAPACITY].config = &realtime;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_add(&queue, &task[KEEL_QUEUE_CAPACITY]));
    TEST_ASSERT_EQUAL_PTR(&task[KEEL_QUEUE_CAPACITY], queue.task[0]);
    for (uint32_t i = 0u; i < (KEEL_QUEUE_CAPACITY - 1u); i++) {
        TEST_ASSERT_EQUAL_PTR(&task[i], queue.task[i + 1u]);
    }
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY, queue.count);
    TEST_ASSERT_EQUAL_UINT32(1u, queue.realtime_count);
}

static void add_is_refused(keel_status_t reason, keel_task_t *added)
{
    keel_queue_t before;
    keel_task_t tasks_before[TASKS];

    memcpy(&before, &queue, sizeof before);
    memcpy(tasks_before, task, sizeof tasks_before);
    TEST_ASSERT_EQUAL(reason, keel_queue_add(&queue, added));
    TEST_ASSERT_EQUAL_MEMORY(&before, &queue, sizeof queue);
    TEST_ASSERT_EQUAL_MEMORY(tasks_before, task, sizeof task);
}

static void QUE_004_null_is_refused(void)
{
    fill("Ab");
    add_is_refused(KEEL_ERR_NULL, NULL);
}

static void QUE_004_duplicate_is_refused(void)
{
    fill("AbC");
    add_is_refused(KEEL_ERR_DUPLICATE, &task[0]);
    add_is_refused(KEEL_ERR_DUPLICATE, &task[1]);
    add_is_refused(KEEL_ERR_DUPLICATE, &task[2]);
}

static void QUE_004_full_is_refused(void)
{
    fill_to_capacity();
    task[KEEL_QUEUE_CAPACITY].config = &other;
    add_is_refused(KEEL_ERR_FULL, &task[KEEL_QUEUE_CAPACITY]);
    task[KEEL_QUEUE_CAPACITY].config = &realtime;
    add_is_refused(KEEL_ERR_FULL, &task[KEEL_QUEUE_CAPACITY]);
}

static void QUE_004_first_reason_is_reported(void)
{
    fill_to_capacity();
    add_is_refused(KEEL_ERR_NULL, NULL);
    add_is_refused(KEEL_ERR_DUPLICATE, &task[0]);
    add_is_refused(KEEL_ERR_DUPLICATE, &task[KEEL_QUEUE_CAPACITY - 1u]);
}

static void remove_is_refused(uint32_t index)
{
    keel_queue_t before;

    memcpy(&before, &queue, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_UNKNOWN_TASK, keel_queue_remove(&queue, index));
    TEST_ASSERT_EQUAL_MEMORY(&before, &queue, sizeof queue);
}

static void QUE_004_unknown_index_is_refused(void)
{
    remove_is_refused(0u);
    fill("AbC");
    remove_is_refused(3u);
    remove_is_refused(KEEL_QUEUE_CAPACITY);
    remove_is_refused(UINT32_MAX);
}

static void QUE_005_stays_valid_in_any_order(void)
{
    fill("aB");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 0u));
    holds("a");
    fill("CdE");
    holds("CEad");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 2u));
    holds("CEd");
    fill("aB");
    holds("CEBda");
}

static void QUE_006_add_writes_no_task(void)
{
    keel_task_t before[TASKS];

    fill("AbC");
    task[3].config = &realtime;
    task[3].skipped = 9u;
    memcpy(before, task, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_add(&queue, &task[3]));
    TEST_ASSERT_EQUAL_MEMORY(before, task, sizeof task);
}

static void QUE_007_remove_counts_each_class(void)
{
    fill("ABcd");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 1u)); /* the last real-time task */
    holds("Acd");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 1u)); /* the first other task */
    holds("Ad");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 1u));
    holds("A");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 0u));
    holds("");
}

static void QUE_008_remove_closes_the_gap(void)
{
    fill("ABCde");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 0u));
    holds("BCde");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 3u));
    holds("BCd");
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 1u));
    holds("Bd");
}

static void QUE_008_remove_from_a_full_queue(void)
{
    fill_to_capacity();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, KEEL_QUEUE_CAPACITY - 1u));
    TEST_ASSERT_NULL(queue.task[KEEL_QUEUE_CAPACITY - 1u]);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_remove(&queue, 0u));
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY - 2u, queue.count);
    for (uint32_t i = 0u; i < (KEEL_QUEUE_CAPACITY - 2u); i++) {
        TEST_ASSERT_EQUAL_PTR(&task[i + 1u], queue.task[i]);
    }
    TEST_ASSERT_NULL(queue.task[KEEL_QUEUE_CAPACITY - 2u]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(QUE_001_init_empties_whatever_was_there);
    RUN_TEST(QUE_002_find_gives_the_index);
    RUN_TEST(QUE_002_find_gives_the_count_for_a_stranger);
    RUN_TEST(QUE_002_find_stops_at_the_end_of_a_full_queue);
    RUN_TEST(QUE_003_add_puts_other_behind_all);
    RUN_TEST(QUE_003_add_puts_realtime_behind_realtime);
    RUN_TEST(QUE_003_add_puts_realtime_before_others);
    RUN_TEST(QUE_003_add_fills_every_slot);
    RUN_TEST(QUE_003_add_moves_a_nearly_full_queue);
    RUN_TEST(QUE_004_null_is_refused);
    RUN_TEST(QUE_004_duplicate_is_refused);
    RUN_TEST(QUE_004_full_is_refused);
    RUN_TEST(QUE_004_first_reason_is_reported);
    RUN_TEST(QUE_004_unknown_index_is_refused);
    RUN_TEST(QUE_005_stays_valid_in_any_order);
    RUN_TEST(QUE_006_add_writes_no_task);
    RUN_TEST(QUE_007_remove_counts_each_class);
    RUN_TEST(QUE_008_remove_closes_the_gap);
    RUN_TEST(QUE_008_remove_from_a_full_queue);
    return UNITY_END();
}
