/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/queue.h. A queue is compared as text: the names of its tasks in order. */
#include "keel/internal/rtos/queue.h"
#include "unity.h"

#include <string.h>

#define TASKS (KEEL_QUEUE_CAPACITY + 1u)

static keel_queue_t queue;
static keel_task_config_t task[TASKS]; /* task[0] is called A, task[1] B, and so on. */

static void body(void *context)
{
    (void)context;
}

/* A declaration in which each number tells whose it is. */
static void declare(uint32_t i, uint32_t priority)
{
    task[i] = (keel_task_config_t){NULL, body, NULL, 1000u + i, 100u + i, 0u, priority};
}

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
        const uint32_t i = (uint32_t)(*name - (capital ? 'A' : 'a'));

        declare(i, capital ? KEEL_PRIORITY_REALTIME : KEEL_PRIORITY_LOW);
        keel_queue_add(&queue, &task[i], i);
    }
}

/* Every slot stands in the order once; those that are free hold no task. */
static void whole(void)
{
    bool seen[KEEL_QUEUE_CAPACITY] = {false};

    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        TEST_ASSERT_LESS_THAN_UINT8(KEEL_QUEUE_CAPACITY, queue.order[i]);
        TEST_ASSERT_FALSE(seen[queue.order[i]]);
        seen[queue.order[i]] = true;
        TEST_ASSERT_EQUAL(i >= queue.count, queue.task[queue.order[i]] == NULL);
    }
}

/* The slot of a position holds a task, and what is scheduled is what was declared of it. */
static void stands(uint32_t i, uint32_t position)
{
    const uint32_t slot = queue.order[position];

    TEST_ASSERT_EQUAL_PTR(&task[i], queue.task[slot]);
    TEST_ASSERT_EQUAL_UINT32(task[i].period_us, queue.period_us[slot]);
    TEST_ASSERT_EQUAL_UINT32(task[i].budget_us, queue.budget_us[slot]);
    TEST_ASSERT_EQUAL_UINT32(task[i].priority, queue.priority[slot]);
    TEST_ASSERT_EQUAL_UINT64(i, queue.release_us[slot]);
}

/* The queue holds these tasks in this order, counts them right and has nothing behind them. */
static void holds(const char *names)
{
    uint32_t capitals = 0u;
    const uint32_t length = (uint32_t)strlen(names);

    whole();
    TEST_ASSERT_EQUAL_UINT32(length, queue.count);
    for (uint32_t i = 0u; i < length; i++) {
        const bool capital = (names[i] >= 'A') && (names[i] <= 'Z');

        stands((uint32_t)(names[i] - (capital ? 'A' : 'a')), i);
        capitals += capital ? 1u : 0u;
    }
    TEST_ASSERT_EQUAL_UINT32(capitals, queue.realtime_count);
}

static void fill_with_others(uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        declare(i, KEEL_PRIORITY_LOW);
        keel_queue_add(&queue, &task[i], i);
    }
}

static void QUE_001_init_empties_whatever_was_there(void)
{
    memset(&queue, 0xA5, sizeof queue);
    keel_queue_init(&queue);
    holds("");
}

static void QUE_002_find_gives_the_position(void)
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
    fill_with_others(KEEL_QUEUE_CAPACITY);
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
    fill_with_others(KEEL_QUEUE_CAPACITY);
    whole();
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY, queue.count);
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        stands(i, i);
    }
}

static void QUE_003_add_moves_a_nearly_full_queue(void)
{
    fill_with_others(KEEL_QUEUE_CAPACITY - 1u);
    declare(KEEL_QUEUE_CAPACITY, KEEL_PRIORITY_REALTIME);
    keel_queue_add(&queue, &task[KEEL_QUEUE_CAPACITY], KEEL_QUEUE_CAPACITY);
    whole();
    stands(KEEL_QUEUE_CAPACITY, 0u);
    for (uint32_t i = 0u; i < (KEEL_QUEUE_CAPACITY - 1u); i++) {
        stands(i, i + 1u);
    }
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY, queue.count);
    TEST_ASSERT_EQUAL_UINT32(1u, queue.realtime_count);
}

/* A slot that a task has left is as new for the next. */
static void QUE_003_add_clears_what_was_known(void)
{
    const keel_stats_t none = {0};
    uint32_t slot;

    memset(queue.stats, 0xA5, sizeof queue.stats);
    memset(queue.skipped, 0xA5, sizeof queue.skipped);
    fill("a");
    slot = queue.order[0];
    TEST_ASSERT_EQUAL_UINT16(0u, queue.skipped[slot]);
    TEST_ASSERT_EQUAL_UINT64(none.total_us, queue.stats[slot].total_us);
    TEST_ASSERT_EQUAL_UINT32(none.runs, queue.stats[slot].runs);
    TEST_ASSERT_EQUAL_UINT32(none.last_us, queue.stats[slot].last_us);
    TEST_ASSERT_EQUAL_UINT32(none.longest_us, queue.stats[slot].longest_us);
    TEST_ASSERT_EQUAL_UINT32(none.remembered_us, queue.stats[slot].remembered_us);
    TEST_ASSERT_EQUAL_UINT32(none.forgotten_in, queue.stats[slot].forgotten_in);
    TEST_ASSERT_EQUAL_UINT16(none.overruns, queue.stats[slot].overruns);
    TEST_ASSERT_EQUAL_UINT16(none.promotions, queue.stats[slot].promotions);
}

static void QUE_003_add_takes_a_release_beyond_32_bits(void)
{
    declare(0u, KEEL_PRIORITY_LOW);
    keel_queue_add(&queue, &task[0], 5000000007u);
    TEST_ASSERT_EQUAL_UINT64(5000000007u, queue.release_us[queue.order[0]]);
}

static void QUE_005_stays_valid_in_any_order(void)
{
    fill("aB");
    keel_queue_remove(&queue, 0u);
    holds("a");
    fill("CdE");
    holds("CEad");
    keel_queue_remove(&queue, 2u);
    holds("CEd");
    fill("aB");
    holds("CEBda");
}

/* A task keeps its slot, and all that is known of it, while others come and go. */
static void QUE_003_others_stay_in_their_slots(void)
{
    keel_queue_t before;

    fill("AbC");
    memcpy(&before, &queue, sizeof before);
    fill("D");
    keel_queue_remove(&queue, 0u);
    for (uint32_t i = 1u; i < 3u; i++) {
        const uint32_t slot = keel_queue_find(&before, &task[i]);

        TEST_ASSERT_EQUAL_PTR(&task[i], queue.task[before.order[slot]]);
    }
    TEST_ASSERT_EQUAL_UINT8(before.order[1], queue.order[0]); /* C */
    TEST_ASSERT_EQUAL_UINT8(before.order[3], queue.order[1]); /* D: the first that was free */
    TEST_ASSERT_EQUAL_UINT8(before.order[2], queue.order[2]); /* b */
}

static void QUE_007_remove_counts_each_class(void)
{
    fill("ABcd");
    keel_queue_remove(&queue, 1u); /* the last real-time task */
    holds("Acd");
    keel_queue_remove(&queue, 1u); /* the first other task */
    holds("Ad");
    keel_queue_remove(&queue, 1u);
    holds("A");
    keel_queue_remove(&queue, 0u);
    holds("");
}

static void QUE_007_remove_closes_the_gap(void)
{
    fill("ABCde");
    keel_queue_remove(&queue, 0u);
    holds("BCde");
    keel_queue_remove(&queue, 3u);
    holds("BCd");
    keel_queue_remove(&queue, 1u);
    holds("Bd");
}

static void QUE_007_remove_from_a_full_queue(void)
{
    fill_with_others(KEEL_QUEUE_CAPACITY);
    keel_queue_remove(&queue, KEEL_QUEUE_CAPACITY - 1u);
    whole();
    keel_queue_remove(&queue, 0u);
    whole();
    TEST_ASSERT_EQUAL_UINT32(KEEL_QUEUE_CAPACITY - 2u, queue.count);
    for (uint32_t i = 0u; i < (KEEL_QUEUE_CAPACITY - 2u); i++) {
        stands(i + 1u, i);
    }
}

/* The slot of a task with period 100, to be released at 1000. */
static uint32_t released_at_1000(void)
{
    declare(0u, KEEL_PRIORITY_LOW);
    task[0].period_us = 100u;
    keel_queue_add(&queue, &task[0], 1000u);
    return queue.order[0];
}

/* It is served at now_us. */
static void advances(uint64_t now_us, uint64_t release_us, uint32_t skipped)
{
    uint32_t slot;

    keel_queue_init(&queue);
    slot = released_at_1000();
    keel_queue_advance(&queue, slot, now_us);
    TEST_ASSERT_EQUAL_UINT64(release_us, queue.release_us[slot]);
    TEST_ASSERT_EQUAL_UINT32(skipped, queue.skipped[slot]);
}

static void QUE_009_release_stays_on_the_grid(void)
{
    advances(1000u, 1100u, 0u);
    advances(1001u, 1100u, 0u);
    advances(1099u, 1100u, 0u);
}

static void QUE_009_missed_periods_are_skipped_and_counted(void)
{
    advances(1100u, 1200u, 1u);
    advances(1199u, 1200u, 1u);
    advances(1349u, 1400u, 3u);
    advances(1400u, 1500u, 4u);
}

static void QUE_009_skipped_adds_up(void)
{
    const uint32_t slot = released_at_1000();

    keel_queue_advance(&queue, slot, 1250u); /* 2 missed, next 1300 */
    keel_queue_advance(&queue, slot, 1600u); /* 3 missed, next 1700 */
    TEST_ASSERT_EQUAL_UINT32(5u, queue.skipped[slot]);
    TEST_ASSERT_EQUAL_UINT64(1700u, queue.release_us[slot]);
}

static void QUE_009_skipped_stops_at_its_limit(void)
{
    const uint32_t slot = released_at_1000();

    queue.skipped[slot] = UINT16_MAX - 2u;
    keel_queue_advance(&queue, slot, 1250u); /* 2 missed: exactly the limit */
    TEST_ASSERT_EQUAL_UINT32(UINT16_MAX, queue.skipped[slot]);
    keel_queue_advance(&queue, slot, 1400u); /* 1 missed: stays there */
    TEST_ASSERT_EQUAL_UINT32(UINT16_MAX, queue.skipped[slot]);
    TEST_ASSERT_EQUAL_UINT64(1500u, queue.release_us[slot]);
}

static void QUE_009_more_than_2_32_missed_periods(void)
{
    declare(0u, KEEL_PRIORITY_LOW);
    task[0].period_us = 1u;
    keel_queue_add(&queue, &task[0], 0u);
    keel_queue_advance(&queue, queue.order[0], 0x100000005u);
    TEST_ASSERT_EQUAL_UINT32(UINT16_MAX, queue.skipped[queue.order[0]]);
    TEST_ASSERT_EQUAL_UINT64(0x100000006u, queue.release_us[queue.order[0]]);
}

static void QUE_009_all_else_is_left_alone(void)
{
    const uint32_t slot = released_at_1000();
    keel_queue_t before;

    fill("Bc");
    queue.stats[slot] = (keel_stats_t){1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u};
    memcpy(&before, &queue, sizeof before);
    keel_queue_advance(&queue, slot, 1250u);
    before.release_us[slot] = 1300u;
    before.skipped[slot] = 2u;
    TEST_ASSERT_EQUAL_MEMORY(&before, &queue, sizeof queue);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(QUE_001_init_empties_whatever_was_there);
    RUN_TEST(QUE_002_find_gives_the_position);
    RUN_TEST(QUE_002_find_gives_the_count_for_a_stranger);
    RUN_TEST(QUE_002_find_stops_at_the_end_of_a_full_queue);
    RUN_TEST(QUE_003_add_puts_other_behind_all);
    RUN_TEST(QUE_003_add_puts_realtime_behind_realtime);
    RUN_TEST(QUE_003_add_puts_realtime_before_others);
    RUN_TEST(QUE_003_add_fills_every_slot);
    RUN_TEST(QUE_003_add_moves_a_nearly_full_queue);
    RUN_TEST(QUE_003_add_clears_what_was_known);
    RUN_TEST(QUE_003_add_takes_a_release_beyond_32_bits);
    RUN_TEST(QUE_005_stays_valid_in_any_order);
    RUN_TEST(QUE_003_others_stay_in_their_slots);
    RUN_TEST(QUE_007_remove_counts_each_class);
    RUN_TEST(QUE_007_remove_closes_the_gap);
    RUN_TEST(QUE_007_remove_from_a_full_queue);
    RUN_TEST(QUE_009_release_stays_on_the_grid);
    RUN_TEST(QUE_009_missed_periods_are_skipped_and_counted);
    RUN_TEST(QUE_009_skipped_adds_up);
    RUN_TEST(QUE_009_skipped_stops_at_its_limit);
    RUN_TEST(QUE_009_more_than_2_32_missed_periods);
    RUN_TEST(QUE_009_all_else_is_left_alone);
    return UNITY_END();
}
