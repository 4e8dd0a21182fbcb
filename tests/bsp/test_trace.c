/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/common/trace.h and trace_log.h with a real scheduler on a simulated clock. */
#include "common/trace.h"
#include "common/trace_log.h"
#include "unity.h"

#include <string.h>

#define FIRST_TICK (UINT32_MAX - 2500u) /* The counter wraps 2501 us after the start. */
#define RUNS       8u

static uint32_t ticks;
static uint32_t cost_us; /* Of each run. */
static keel_scheduler_t scheduler;
static keel_trace_t trace;
static keel_log_ring_t ring;
static keel_trace_log_t made;
static keel_trace_run_t seen[RUNS]; /* Every run, in order. */
static uint32_t runs;

static uint32_t read_clock(void *context)
{
    (void)context;
    return ticks;
}

static void body(void *context)
{
    (void)context;
    keel_trace_begin(&trace, &scheduler);
    ticks += cost_us;
    keel_trace_end(&trace, &scheduler);
    keel_trace_store(&trace, &ring);
    seen[runs % RUNS] = trace.run;
    runs++;
}

static const keel_task_config_t fast = {.name = "fast",
                                        .run = body,
                                        .period_us = 1000u,
                                        .budget_us = 100u,
                                        .phase_us = 100u,
                                        .priority = KEEL_PRIORITY_REALTIME};
static const keel_task_config_t slow = {.name = "a name of more than thirty-two characters",
                                        .run = body,
                                        .period_us = 1500u,
                                        .budget_us = 300u,
                                        .phase_us = 300u,
                                        .priority = KEEL_PRIORITY_LOW};
static const keel_task_config_t nameless = {
    .run = body, .period_us = 2000u, .budget_us = 100u, .priority = KEEL_PRIORITY_LOW};

static void add(const keel_task_config_t *task)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_add(&scheduler, task));
}

void setUp(void)
{
    const keel_scheduler_config_t config = {.read_clock = read_clock,
                                            .guard_us = 20u,
                                            .utilisation_limit_ppm = KEEL_UTILISATION_FULL_PPM};

    ticks = FIRST_TICK;
    cost_us = 100u;
    runs = 0u;
    memset(&scheduler, 0, sizeof scheduler);
    memset(&trace, 0xA5, sizeof trace);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_init(&scheduler, &config));
    add(&fast);
    add(&slow);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_start(&scheduler));
    keel_trace_start(&trace, &scheduler);
    keel_log_ring_init(&ring);
    keel_trace_log_start(&made, &scheduler, &ring);
}

void tearDown(void)
{
}

static void step_at(uint32_t time_us)
{
    ticks = FIRST_TICK + time_us;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_step(&scheduler));
}

/* The run that was the so-manyeth. */
static void run_is(uint32_t number, keel_trace_run_t expected)
{
    const keel_trace_run_t *const run = &seen[number];

    TEST_ASSERT_LESS_THAN_UINT32(runs, number);
    TEST_ASSERT_EQUAL_UINT64(expected.start_us, run->start_us);
    TEST_ASSERT_EQUAL_UINT32(expected.late_us, run->late_us);
    TEST_ASSERT_EQUAL_UINT32(expected.length_us, run->length_us);
    TEST_ASSERT_EQUAL_UINT16(expected.skipped, run->skipped);
    TEST_ASSERT_EQUAL_UINT8(expected.slot, run->slot);
    TEST_ASSERT_EQUAL_UINT8(expected.flags, run->flags);
}

static void TRC_001_what_was_before_the_trace_does_not_count(void)
{
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        scheduler.queue.skipped[i] = 7u;
        scheduler.queue.stats[i].promotions = 3u;
        scheduler.queue.stats[i].runs = 1u;
    }
    keel_trace_start(&trace, &scheduler);
    step_at(110u);
    run_is(0u, (keel_trace_run_t){.start_us = 110u, .late_us = 10u, .length_us = 100u});
}

static void TRC_002_a_run_starts_when_it_is_chosen_and_is_late_since_its_release(void)
{
    step_at(130u);
    step_at(300u);
    TEST_ASSERT_EQUAL_UINT32(2u, runs);
    run_is(0u, (keel_trace_run_t){
                   .start_us = 130u, .late_us = 30u, .length_us = 100u, .flags = KEEL_TRACE_FIRST});
    run_is(1u, (keel_trace_run_t){
                   .start_us = 300u, .length_us = 100u, .slot = 1u, .flags = KEEL_TRACE_FIRST});
}

static void TRC_002_what_waited_for_another_is_late_by_it(void)
{
    step_at(310u); /* Both are due: fast until 410, then slow. */
    TEST_ASSERT_EQUAL_UINT32(2u, runs);
    TEST_ASSERT_EQUAL_UINT32(210u, seen[0].late_us);
    TEST_ASSERT_EQUAL_UINT64(410u, seen[1].start_us);
    TEST_ASSERT_EQUAL_UINT32(110u, seen[1].late_us);
}

static void TRC_002_time_goes_on_over_the_wrap_of_the_counter(void)
{
    step_at(100u);
    step_at(1100u);
    step_at(2490u); /* The run of fast that was released at 2100 ends behind the wrap. */
    TEST_ASSERT_EQUAL_UINT64(2490u, seen[3].start_us);
    TEST_ASSERT_EQUAL_UINT32(390u, seen[3].late_us);
    TEST_ASSERT_EQUAL_UINT32(100u, seen[3].length_us);
}

static void TRC_003_periods_that_passed_are_told_with_the_first_release(void)
{
    step_at(3650u); /* 3.55 periods behind the release. */
    TEST_ASSERT_EQUAL_UINT16(3u, seen[0].skipped);
    TEST_ASSERT_EQUAL_UINT32(3550u, seen[0].late_us);
    step_at(4100u);
    TEST_ASSERT_EQUAL_UINT8(0u, seen[runs - 1u].slot);
    TEST_ASSERT_EQUAL_UINT16(0u, seen[runs - 1u].skipped);
    TEST_ASSERT_EQUAL_UINT32(0u, seen[runs - 1u].late_us);
}

static void TRC_003_a_lateness_beyond_32_bits_stays_at_its_end(void)
{
    step_at(100u);
    scheduler.queue.period_us[1] = 2000000000u;
    scheduler.clock.now_us = (UINT64_C(1) << 32) + 300u;
    step_at(200u);
    TEST_ASSERT_EQUAL_UINT8(1u, seen[2].slot);
    TEST_ASSERT_EQUAL_UINT16(2u, seen[2].skipped);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, seen[2].late_us);
}

/* slow is remembered with more than any gap between two releases of fast. */
static void TRC_004_a_promotion_is_told_once(void)
{
    uint32_t promoted = 0u;

    step_at(110u);
    cost_us = 950u;
    step_at(300u);
    cost_us = 100u;
    while (promoted == 0u) {
        TEST_ASSERT_LESS_THAN_UINT32(60000u, ticks - FIRST_TICK);
        step_at((ticks - FIRST_TICK) + 50u);
        promoted = scheduler.queue.stats[1].promotions;
    }
    TEST_ASSERT_EQUAL_UINT8(1u, seen[(runs - 1u) % RUNS].slot);
    TEST_ASSERT_EQUAL_UINT8(KEEL_TRACE_PROMOTED, seen[(runs - 1u) % RUNS].flags);
    scheduler.queue.stats[1].remembered_us = 0u;
    runs = 0u;
    while (runs < RUNS) {
        step_at((ticks - FIRST_TICK) + 50u);
    }
    for (uint32_t i = 0u; i < RUNS; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, seen[i].flags);
    }
    TEST_ASSERT_EQUAL_UINT16(1u, scheduler.queue.stats[1].promotions);
}

static void TRC_004_the_first_run_is_that_of_a_task_not_of_a_slot(void)
{
    step_at(100u);
    scheduler.queue.stats[0].promotions = 5u;
    step_at(4200u); /* 3 periods were skipped. */
    TEST_ASSERT_EQUAL_UINT8(KEEL_TRACE_PROMOTED, seen[1].flags);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &fast));
    add(&fast); /* Released 100 us from here. */
    runs = 0u;
    step_at((ticks - FIRST_TICK) + 100u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_TRACE_FIRST, seen[0].flags);
    TEST_ASSERT_EQUAL_UINT16(0u, seen[0].skipped);
    scheduler.queue.stats[0].promotions = 5u; /* As many as the other one had. */
    step_at((ticks - FIRST_TICK) + 1000u);
    TEST_ASSERT_EQUAL_UINT8(0u, seen[1].slot);
    TEST_ASSERT_EQUAL_UINT8(KEEL_TRACE_PROMOTED, seen[1].flags);
}

static void TRC_004_a_first_run_can_be_promoted(void)
{
    scheduler.queue.stats[0].promotions = 1u;
    step_at(100u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_TRACE_FIRST | KEEL_TRACE_PROMOTED, seen[0].flags);
}

static void TRC_005_a_run_is_as_long_as_the_scheduler_records(void)
{
    cost_us = 123u;
    step_at(100u);
    TEST_ASSERT_EQUAL_UINT32(123u, seen[0].length_us);
    TEST_ASSERT_EQUAL_UINT32(scheduler.queue.stats[0].last_us, seen[0].length_us);
}

static void TRC_006_a_record_is_twenty_bytes_the_lowest_first(void)
{
    const uint8_t expected[KEEL_TRACE_RUN_BYTES] = {8u,    7u,    6u,    5u,    4u,    3u,    2u,
                                                    1u,    0x14u, 0x13u, 0x12u, 0x11u, 0x24u, 0x23u,
                                                    0x22u, 0x21u, 0x32u, 0x31u, 5u,    3u};
    uint8_t bytes[KEEL_TRACE_RUN_BYTES + 1u];

    trace.run = (keel_trace_run_t){.start_us = 0x0102030405060708u,
                                   .late_us = 0x11121314u,
                                   .length_us = 0x21222324u,
                                   .skipped = 0x3132u,
                                   .slot = 5u,
                                   .flags = 3u};
    keel_trace_store(&trace, &ring);
    TEST_ASSERT_EQUAL_UINT32(KEEL_TRACE_RUN_BYTES, keel_log_ring_read(&ring, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_MEMORY(expected, bytes, KEEL_TRACE_RUN_BYTES);
}

static void store_at(uint64_t time_us)
{
    trace.run = (keel_trace_run_t){.start_us = time_us};
    keel_trace_store(&trace, &ring);
}

/* The next message is a dropout of so many milliseconds. */
static void dropout_is(uint8_t ms)
{
    const uint8_t expected[KEEL_ULOG_DROPOUT_BYTES] = {2u, 0u, 'O', ms, 0u};

    TEST_ASSERT_TRUE(keel_trace_log_next(&made));
    TEST_ASSERT_EQUAL_UINT16(KEEL_ULOG_DROPOUT_BYTES, made.message.size);
    TEST_ASSERT_EQUAL_MEMORY(expected, made.message.bytes, KEEL_ULOG_DROPOUT_BYTES);
}

/* What a log begins with is taken. */
static void take_definitions(void)
{
    for (uint32_t i = 0u; i < 6u; i++) {
        TEST_ASSERT_TRUE(keel_trace_log_next(&made));
    }
}

/* The next message is a run's. */
static void run_is_next(uint64_t start_us)
{
    uint64_t time_us;

    TEST_ASSERT_TRUE(keel_trace_log_next(&made));
    TEST_ASSERT_EQUAL_UINT16(5u + KEEL_TRACE_RUN_BYTES, made.message.size);
    memcpy(&time_us, &made.message.bytes[5], sizeof time_us);
    TEST_ASSERT_EQUAL_UINT64(start_us, time_us);
}

static void TRC_006_what_is_lost_is_told_between_what_is_not(void)
{
    const uint32_t most = (KEEL_LOG_RING_BYTES - 1u) / KEEL_TRACE_RUN_BYTES;

    take_definitions();
    for (uint32_t i = 0u; i < most; i++) {
        store_at(i);
    }
    store_at(50000u); /* No room: it is lost, as the next one is. */
    store_at(52000u);
    TEST_ASSERT_TRUE(keel_trace_log_next(&made)); /* The task of slot 0. */
    run_is_next(0u);
    store_at(53000u); /* Room for one, but not for what was lost, too. */
    run_is_next(1u);
    run_is_next(2u);
    store_at(57000u);
    for (uint32_t i = 3u; i < most; i++) {
        run_is_next(i);
    }
    run_is_next(53000u);
    dropout_is(7u); /* From 50000 to 57000. */
    run_is_next(57000u);
    TEST_ASSERT_FALSE(keel_trace_log_next(&made));
}

static void TRC_006_a_loss_is_a_record_of_its_first_run_and_its_length(void)
{
    const uint32_t most = (KEEL_LOG_RING_BYTES - 1u) / KEEL_TRACE_RUN_BYTES;
    keel_trace_run_t lost = {0};

    for (uint32_t i = 0u; i < most; i++) {
        store_at(i);
    }
    store_at(50000u);
    for (uint32_t i = 0u; i < most; i++) {
        (void)keel_log_ring_read(&ring, (uint8_t *)&lost, KEEL_TRACE_RUN_BYTES);
    }
    store_at(50300u);
    (void)keel_log_ring_read(&ring, (uint8_t *)&lost, KEEL_TRACE_RUN_BYTES);
    TEST_ASSERT_EQUAL_UINT64(50000u, lost.start_us);
    TEST_ASSERT_EQUAL_UINT32(300u, lost.length_us);
    TEST_ASSERT_EQUAL_UINT8(KEEL_TRACE_LOST, lost.flags);
}

static void TRC_007_a_run_is_a_message(void)
{
    const uint8_t expected[] = {22u, 0u, 'D', 9u, 0u,  8u, 7u, 6u, 5u, 4u, 3u, 2u, 1u,
                                30u, 0u, 0u,  0u, 40u, 0u, 0u, 0u, 2u, 0u, 4u, 1u};
    const keel_trace_run_t run = {.start_us = 0x0102030405060708u,
                                  .late_us = 30u,
                                  .length_us = 40u,
                                  .skipped = 2u,
                                  .slot = 4u,
                                  .flags = 1u};

    keel_trace_run_message(&made.message, 9u, &run);
    TEST_ASSERT_EQUAL_UINT16(sizeof expected, made.message.size);
    TEST_ASSERT_EQUAL_MEMORY(expected, made.message.bytes, sizeof expected);
}

static void task_is(const uint8_t head[27], const char name[32])
{
    TEST_ASSERT_EQUAL_UINT16(27u + 32u, made.message.size);
    TEST_ASSERT_EQUAL_MEMORY(head, made.message.bytes, 27u);
    TEST_ASSERT_EQUAL_MEMORY(name, &made.message.bytes[27], 32u);
}

static void TRC_008_a_task_is_a_message(void)
{
    const uint8_t of_fast[27] = {56u, 0u, 'D', 7u,   0u, 100u, 0u, 0u,  0u, 0u, 0u, 0u, 0u,   0xE8u,
                                 3u,  0u, 0u,  100u, 0u, 0u,   0u, 20u, 0u, 0u, 0u, 0u, 0xFFu};
    const uint8_t of_slow[27] = {56u, 0u, 'D', 7u,    0u, 100u, 0u, 0u,  0u, 0u, 0u, 0u, 0u, 0xDCu,
                                 5u,  0u, 0u,  0x2Cu, 1u, 0u,   0u, 20u, 0u, 0u, 0u, 1u, 1u};
    uint8_t head[27];

    step_at(100u); /* Fast runs until 200; the time was read then. */
    memcpy(head, of_fast, sizeof head);
    head[5] = 200u;
    head[26] = (uint8_t)KEEL_PRIORITY_REALTIME;
    keel_trace_task_message(&made.message, 7u, &scheduler, 0u);
    task_is(head, (const char[32]){"fast"});
    memcpy(head, of_slow, sizeof head);
    head[5] = 200u;
    keel_trace_task_message(&made.message, 7u, &scheduler, 1u);
    task_is(head, slow.name);
}

static void TRC_008_a_task_without_a_name_and_none_at_all(void)
{
    const char none[32] = {0};

    add(&nameless);
    keel_trace_task_message(&made.message, 7u, &scheduler, 2u);
    TEST_ASSERT_EQUAL_MEMORY(none, &made.message.bytes[27], 32u);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &nameless));
    keel_trace_task_message(&made.message, 7u, &scheduler, 2u);
    TEST_ASSERT_EQUAL_MEMORY(none, &made.message.bytes[27], 32u);
}

static void text_is(const char *text, uint16_t from)
{
    TEST_ASSERT_TRUE(keel_trace_log_next(&made));
    TEST_ASSERT_EQUAL_UINT16(from + strlen(text), made.message.size);
    TEST_ASSERT_EQUAL_MEMORY(text, &made.message.bytes[from], strlen(text));
}

static void TRC_009_a_log_begins_with_what_readers_need(void)
{
    TEST_ASSERT_TRUE(keel_trace_log_next(&made));
    TEST_ASSERT_EQUAL_UINT16(KEEL_ULOG_BEGIN_BYTES, made.message.size);
    TEST_ASSERT_EQUAL_MEMORY("ULog", made.message.bytes, 4u);
    TEST_ASSERT_TRUE(keel_trace_log_next(&made));
    TEST_ASSERT_EQUAL_UINT8('B', made.message.bytes[2]);
    text_is("run:uint64_t timestamp;uint32_t late_us;uint32_t length_us;uint16_t skipped;"
            "uint8_t slot;uint8_t flags;",
            3u);
    text_is("task:uint64_t timestamp;uint32_t period_us;uint32_t budget_us;uint32_t guard_us;"
            "uint8_t slot;uint8_t priority;char[32] name;",
            3u);
    text_is("run", 6u);
    TEST_ASSERT_EQUAL_UINT8(0u, made.message.bytes[4]);
    text_is("task", 6u);
    TEST_ASSERT_EQUAL_UINT8(1u, made.message.bytes[4]);
    TEST_ASSERT_FALSE(keel_trace_log_next(&made));
}

/* The next message is of a topic, and of a slot. */
static void topic_is(uint8_t topic, uint8_t slot)
{
    TEST_ASSERT_TRUE(keel_trace_log_next(&made));
    TEST_ASSERT_EQUAL_UINT8(topic, made.message.bytes[3]);
    TEST_ASSERT_EQUAL_UINT8(slot, made.message.bytes[(topic == 0u) ? 23 : 25]);
}

static void TRC_010_a_task_is_told_before_its_first_run_in_the_log(void)
{
    take_definitions();
    step_at(100u);
    step_at(300u);
    step_at(1100u);
    topic_is(1u, 0u);
    topic_is(0u, 0u);
    topic_is(1u, 1u);
    topic_is(0u, 1u);
    topic_is(0u, 0u);
    TEST_ASSERT_FALSE(keel_trace_log_next(&made));
}

static void TRC_010_a_task_that_takes_the_slot_of_another_is_told(void)
{
    TRC_010_a_task_is_told_before_its_first_run_in_the_log();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_scheduler_remove(&scheduler, &slow));
    add(&nameless);
    step_at(1400u);
    topic_is(1u, 1u);
    TEST_ASSERT_EQUAL_UINT8(0xD0u, made.message.bytes[13]); /* Of 2000. */
    topic_is(0u, 1u);
    TEST_ASSERT_FALSE(keel_trace_log_next(&made));
}

static void TRC_011_a_log_of_a_trace_that_began_in_flight_tells_its_tasks(void)
{
    step_at(100u);
    keel_log_ring_init(&ring);
    take_definitions();
    step_at(1100u);
    topic_is(1u, 0u); /* Though it was not its first run. */
    topic_is(0u, 0u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(TRC_001_what_was_before_the_trace_does_not_count);
    RUN_TEST(TRC_002_a_run_starts_when_it_is_chosen_and_is_late_since_its_release);
    RUN_TEST(TRC_002_what_waited_for_another_is_late_by_it);
    RUN_TEST(TRC_002_time_goes_on_over_the_wrap_of_the_counter);
    RUN_TEST(TRC_003_periods_that_passed_are_told_with_the_first_release);
    RUN_TEST(TRC_003_a_lateness_beyond_32_bits_stays_at_its_end);
    RUN_TEST(TRC_004_a_promotion_is_told_once);
    RUN_TEST(TRC_004_a_first_run_can_be_promoted);
    RUN_TEST(TRC_004_the_first_run_is_that_of_a_task_not_of_a_slot);
    RUN_TEST(TRC_005_a_run_is_as_long_as_the_scheduler_records);
    RUN_TEST(TRC_006_a_record_is_twenty_bytes_the_lowest_first);
    RUN_TEST(TRC_006_what_is_lost_is_told_between_what_is_not);
    RUN_TEST(TRC_006_a_loss_is_a_record_of_its_first_run_and_its_length);
    RUN_TEST(TRC_007_a_run_is_a_message);
    RUN_TEST(TRC_008_a_task_is_a_message);
    RUN_TEST(TRC_008_a_task_without_a_name_and_none_at_all);
    RUN_TEST(TRC_009_a_log_begins_with_what_readers_need);
    RUN_TEST(TRC_010_a_task_is_told_before_its_first_run_in_the_log);
    RUN_TEST(TRC_010_a_task_that_takes_the_slot_of_another_is_told);
    RUN_TEST(TRC_011_a_log_of_a_trace_that_began_in_flight_tells_its_tasks);
    return UNITY_END();
}
