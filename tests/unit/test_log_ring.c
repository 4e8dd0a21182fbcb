/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/log_ring.h. */
#include "keel/middleware/log_ring.h"
#include "unity.h"

#include <string.h>

#define MOST (KEEL_LOG_RING_BYTES - 1u)

static const uint8_t abc[3] = {'a', 'b', 'c'};
static const uint8_t defg[4] = {'d', 'e', 'f', 'g'};

static keel_log_ring_t ring;
static uint8_t many[KEEL_LOG_RING_BYTES];
static uint8_t got[KEEL_LOG_RING_BYTES];

void setUp(void)
{
    memset(&ring, 0xA5, sizeof ring);
    memset(got, 0, sizeof got);
    for (uint32_t i = 0u; i < KEEL_LOG_RING_BYTES; i++) {
        many[i] = (uint8_t)(i % 251u);
    }
    keel_log_ring_init(&ring);
}

void tearDown(void)
{
}

static void RIN_001_a_ring_begins_empty(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, keel_log_ring_held(&ring));
    TEST_ASSERT_EQUAL_UINT32(0u, ring.loss.records);
    TEST_ASSERT_EQUAL_UINT64(0u, ring.loss.since_us);
    TEST_ASSERT_EQUAL_UINT32(0u, keel_log_ring_read(&ring, got, 10u));
    TEST_ASSERT_EQUAL_HEX8(0xA5, ring.buffer[0]);
}

static void RIN_003_records_come_out_in_order(void)
{
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, abc, 3u, 1u));
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, defg, 4u, 2u));
    TEST_ASSERT_EQUAL_UINT32(7u, keel_log_ring_held(&ring));
    TEST_ASSERT_EQUAL_UINT32(7u, keel_log_ring_read(&ring, got, sizeof got));
    TEST_ASSERT_EQUAL_MEMORY("abcdefg", got, 7u);
    TEST_ASSERT_EQUAL_UINT32(0u, keel_log_ring_held(&ring));
}

static void RIN_003_a_record_of_nothing_is_written(void)
{
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, abc, 0u, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_log_ring_held(&ring));
}

static void RIN_008_no_more_than_asked_for(void)
{
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, defg, 4u, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_log_ring_read(&ring, got, 0u));
    TEST_ASSERT_EQUAL_UINT32(3u, keel_log_ring_read(&ring, got, 3u));
    TEST_ASSERT_EQUAL_MEMORY("def\0", got, 4u);
    TEST_ASSERT_EQUAL_UINT32(1u, keel_log_ring_held(&ring));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_log_ring_read(&ring, got, 3u));
    TEST_ASSERT_EQUAL_MEMORY("gef\0", got, 4u);
}

/* Three bytes below the end: a record of four goes around it. */
static void RIN_003_around_the_end(void)
{
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, many, MOST - 2u, 1u));
    TEST_ASSERT_EQUAL_UINT32(MOST - 2u, keel_log_ring_read(&ring, got, MOST - 2u));
    TEST_ASSERT_EQUAL_MEMORY(many, got, MOST - 2u);
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, defg, 4u, 1u));
    TEST_ASSERT_EQUAL_UINT32(4u, keel_log_ring_held(&ring));
    TEST_ASSERT_EQUAL_HEX8('d', ring.buffer[MOST - 2u]);
    TEST_ASSERT_EQUAL_HEX8('f', ring.buffer[MOST]);
    TEST_ASSERT_EQUAL_HEX8('g', ring.buffer[0]);
    TEST_ASSERT_EQUAL_UINT32(4u, keel_log_ring_read(&ring, got, 4u));
    TEST_ASSERT_EQUAL_MEMORY(defg, got, 4u);
}

static void RIN_005_up_to_the_last_byte_but_one(void)
{
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, many, KEEL_LOG_RING_BYTES, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_log_ring_held(&ring));
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, many, MOST, 1u));
    TEST_ASSERT_EQUAL_UINT32(MOST, keel_log_ring_held(&ring));
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, abc, 1u, 1u));
    TEST_ASSERT_EQUAL_UINT32(2u, ring.loss.records);
}

/* Seven bytes are held, around the end. */
static void RIN_005_room_around_the_end(void)
{
    keel_log_ring_loss_t loss;

    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, many, MOST - 2u, 1u));
    TEST_ASSERT_EQUAL_UINT32(MOST - 2u, keel_log_ring_read(&ring, got, MOST - 2u));
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, defg, 4u, 1u));
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, abc, 3u, 1u));
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, many, MOST - 6u, 1u));
    TEST_ASSERT_FALSE(keel_log_ring_take_loss(&ring, MOST - 6u, &loss));
    TEST_ASSERT_TRUE(keel_log_ring_take_loss(&ring, MOST - 7u, &loss));
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, many, MOST - 7u, 1u));
    TEST_ASSERT_EQUAL_UINT32(MOST, keel_log_ring_held(&ring));
}

static void RIN_004_of_a_lost_record_nothing_is_there(void)
{
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, many, MOST - 3u, 1u));
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, defg, 4u, 2u));
    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, abc, 3u, 3u));
    TEST_ASSERT_EQUAL_UINT32(MOST, keel_log_ring_read(&ring, got, MOST));
    TEST_ASSERT_EQUAL_MEMORY(many, got, MOST - 3u);
    TEST_ASSERT_EQUAL_MEMORY(abc, &got[MOST - 3u], 3u);
}

static void RIN_007_what_is_lost_is_told_once(void)
{
    keel_log_ring_loss_t loss = {77u, 77u};

    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, many, MOST - 2u, 1u));
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, abc, 3u, 0x123456789u));
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, defg, 4u, 0x12345678Au));
    TEST_ASSERT_FALSE(keel_log_ring_take_loss(&ring, 3u, &loss));
    TEST_ASSERT_EQUAL_UINT32(77u, loss.records);
    TEST_ASSERT_EQUAL_UINT64(77u, loss.since_us);
    TEST_ASSERT_EQUAL_UINT32(2u, ring.loss.records);
    TEST_ASSERT_TRUE(keel_log_ring_take_loss(&ring, 2u, &loss));
    TEST_ASSERT_EQUAL_UINT32(2u, loss.records);
    TEST_ASSERT_EQUAL_UINT64(0x123456789u, loss.since_us);
    TEST_ASSERT_FALSE(keel_log_ring_take_loss(&ring, 0u, &loss));
    TEST_ASSERT_EQUAL_UINT32(2u, loss.records);
}

static void RIN_007_none_is_lost_none_is_told(void)
{
    keel_log_ring_loss_t loss = {77u, 77u};

    TEST_ASSERT_TRUE(keel_log_ring_write(&ring, abc, 3u, 1u));
    TEST_ASSERT_FALSE(keel_log_ring_take_loss(&ring, 0u, &loss));
    TEST_ASSERT_EQUAL_UINT32(77u, loss.records);
}

static void RIN_006_a_second_loss_has_its_own_time(void)
{
    keel_log_ring_loss_t loss;

    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, many, KEEL_LOG_RING_BYTES, 5u));
    TEST_ASSERT_TRUE(keel_log_ring_take_loss(&ring, 1u, &loss));
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, many, KEEL_LOG_RING_BYTES, 9u));
    TEST_ASSERT_TRUE(keel_log_ring_take_loss(&ring, 1u, &loss));
    TEST_ASSERT_EQUAL_UINT32(1u, loss.records);
    TEST_ASSERT_EQUAL_UINT64(9u, loss.since_us);
}

static void RIN_006_the_count_stays_at_its_end(void)
{
    ring.loss.records = UINT32_MAX - 1u;
    ring.loss.since_us = 3u;
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, many, KEEL_LOG_RING_BYTES, 5u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ring.loss.records);
    TEST_ASSERT_FALSE(keel_log_ring_write(&ring, many, KEEL_LOG_RING_BYTES, 6u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ring.loss.records);
    TEST_ASSERT_EQUAL_UINT64(3u, ring.loss.since_us);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(RIN_001_a_ring_begins_empty);
    RUN_TEST(RIN_003_records_come_out_in_order);
    RUN_TEST(RIN_003_a_record_of_nothing_is_written);
    RUN_TEST(RIN_008_no_more_than_asked_for);
    RUN_TEST(RIN_003_around_the_end);
    RUN_TEST(RIN_005_up_to_the_last_byte_but_one);
    RUN_TEST(RIN_005_room_around_the_end);
    RUN_TEST(RIN_004_of_a_lost_record_nothing_is_there);
    RUN_TEST(RIN_007_what_is_lost_is_told_once);
    RUN_TEST(RIN_007_none_is_lost_none_is_told);
    RUN_TEST(RIN_006_a_second_loss_has_its_own_time);
    RUN_TEST(RIN_006_the_count_stays_at_its_end);
    return UNITY_END();
}
