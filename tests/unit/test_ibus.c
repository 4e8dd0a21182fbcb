/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/ibus.h. Frames are known ones, or made here, their sums by hand. */
#include "keel/middleware/ibus.h"
#include "unity.h"

#include <string.h>

#define BYTES     32u
#define BYTE_US   87u
#define GAP_US    500u
#define SILENT_US 4000u

/* 1500 us, 1500, 1000, and 1500 eleven times more. 1500 is 05DC, DC + 05 = 225; 1000 is 03E8, 235.
 * 32 + 64 + 13 x 225 + 235 = 3256, and 65535 - 3256 = 62279 is F347. */
static const uint8_t known[BYTES] = {
    0x20, 0x40, 0xDC, 0x05, 0xDC, 0x05, 0xE8, 0x03, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05,
    0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0x47, 0xF3};

static const keel_ibus_config_t usual = {
    .gap_us = GAP_US, .judged = 0x3FFFFu, .lowest = 900u, .highest = 2100u, .extended = false};
static const keel_ibus_config_t widest = {
    .gap_us = GAP_US, .judged = 0x3FFFFu, .lowest = 0u, .highest = 4095u, .extended = true};

static keel_ibus_t ibus;

void setUp(void)
{
    memset(&ibus, 0xA5, sizeof ibus);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &usual));
}

void tearDown(void)
{
}

/* How many frames end in these bytes, the first of which comes after so long. */
static uint32_t feed(const uint8_t *bytes, uint32_t count, uint32_t first_us)
{
    uint32_t taken = 0u;

    for (uint32_t i = 0u; i < count; i++) {
        taken += keel_ibus_take(&ibus, bytes[i], (i == 0u) ? first_us : BYTE_US) ? 1u : 0u;
    }
    return taken;
}

/* All but its last byte take nothing, and the last one takes it. */
static void is_taken(const uint8_t *frame, uint32_t first_us)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES - 1u, first_us));
    TEST_ASSERT_TRUE(keel_ibus_take(&ibus, frame[BYTES - 1u], BYTE_US));
}

static void says_known(void)
{
    for (uint32_t i = 0u; i < 18u; i++) {
        const uint16_t us = (i == 2u) ? 1000u : 1500u;

        TEST_ASSERT_EQUAL_UINT16((i < 14u) ? us : 0u, ibus.channel[i]);
    }
}

/* A frame of these words. */
static void write_frame(uint8_t *frame, const uint16_t *word)
{
    uint32_t sum = 0x20u + 0x40u;

    frame[0] = 0x20u;
    frame[1] = 0x40u;
    for (uint32_t i = 0u; i < 14u; i++) {
        frame[2u + (2u * i)] = (uint8_t)(word[i] % 256u);
        frame[3u + (2u * i)] = (uint8_t)(word[i] / 256u);
        sum += (word[i] % 256u) + (word[i] / 256u);
    }
    frame[30] = (uint8_t)((65535u - sum) % 256u);
    frame[31] = (uint8_t)((65535u - sum) / 256u);
}

/* All words the same but one. */
static void write_one(uint8_t *frame, uint16_t all, uint32_t index, uint16_t one)
{
    uint16_t word[14];

    for (uint32_t i = 0u; i < 14u; i++) {
        word[i] = (i == index) ? one : all;
    }
    write_frame(frame, word);
}

static void IBU_001_refuses_a_range_that_is_none(void)
{
    keel_ibus_config_t config = usual;
    const keel_ibus_t before = ibus;

    config.lowest = 2101u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_ibus_init(&ibus, &config));
    config = usual;
    config.highest = 4096u;
    config.gap_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_ibus_init(&ibus, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &ibus, sizeof ibus);
}

static void IBU_001_refuses_a_gap_of_none(void)
{
    keel_ibus_config_t config = usual;
    const keel_ibus_t before = ibus;

    config.gap_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_AGE, keel_ibus_init(&ibus, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &ibus, sizeof ibus);
}

static void IBU_002_begins_with_nothing(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ibus.age_us);
    TEST_ASSERT_EQUAL_UINT8(0u, ibus.framing.held);
    TEST_ASSERT_EQUAL_UINT32(0u, ibus.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, ibus.count.sums);
    for (uint32_t i = 0u; i < 18u; i++) {
        TEST_ASSERT_EQUAL_UINT16(0u, ibus.channel[i]);
    }
}

static void IBU_005_takes_a_known_frame(void)
{
    is_taken(known, SILENT_US);
    says_known();
    TEST_ASSERT_EQUAL_UINT32(1u, ibus.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, ibus.age_us);
    TEST_ASSERT_EQUAL_UINT8(0u, ibus.framing.held);
}

/* Each bit of each word, with channels 15 to 18 and without; the highest four bits of a word are of
 * one of those, the words of the last two of none. */
static void IBU_005_each_bit_is_of_its_channel(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &widest));
    for (uint32_t word = 0u; word < 14u; word++) {
        for (uint32_t bit = 0u; bit < 16u; bit++) {
            uint8_t frame[BYTES];
            uint32_t channel = word;
            uint16_t value = (uint16_t)(1u << bit);

            write_one(frame, 0u, word, value);
            if (bit >= 12u) {
                channel = (word < 12u) ? (14u + (word / 3u)) : 18u;
                value = (uint16_t)(1u << ((bit - 12u) + (4u * (word % 3u))));
            }
            is_taken(frame, SILENT_US);
            for (uint32_t i = 0u; i < 18u; i++) {
                TEST_ASSERT_EQUAL_UINT16((i == channel) ? value : 0u, ibus.channel[i]);
            }
        }
    }
}

/* The ends of the range, of each channel. */
static void IBU_004_each_channel_has_its_range(void)
{
    const uint16_t values[4] = {899u, 900u, 2100u, 2101u};

    for (uint32_t i = 0u; i < 14u; i++) {
        for (uint32_t v = 0u; v < 4u; v++) {
            uint8_t frame[BYTES];
            const uint32_t refused = ibus.count.ranges;
            const bool right = (v == 1u) || (v == 2u);

            write_one(frame, 1500u, i, values[v]);
            TEST_ASSERT_EQUAL_UINT32(right ? 1u : 0u, feed(frame, BYTES, SILENT_US));
            TEST_ASSERT_EQUAL_UINT32(refused + (right ? 0u : 1u), ibus.count.ranges);
        }
    }
}

/* Each channel alone is judged: then it alone voids a frame. One that there is none of does not. */
static void IBU_004_each_channel_may_be_judged(void)
{
    for (uint32_t judged = 0u; judged < 18u; judged++) {
        keel_ibus_config_t config = usual;

        config.judged = (uint32_t)1u << judged;
        TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &config));
        for (uint32_t i = 0u; i < 14u; i++) {
            uint8_t frame[BYTES];

            write_one(frame, 1500u, i, 0u);
            TEST_ASSERT_EQUAL_UINT32((i == judged) ? 0u : 1u, feed(frame, BYTES, SILENT_US));
        }
        TEST_ASSERT_EQUAL_UINT32((judged < 14u) ? 1u : 0u, ibus.count.ranges);
        config.extended = true; /* Channels 15 to 18 are 0 in such a frame. */
        TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &config));
        TEST_ASSERT_EQUAL_UINT32((judged < 14u) ? 1u : 0u, feed(known, BYTES, SILENT_US));
    }
}

/* Without channels 15 to 18, a word with upper bits is no channel; with them, they have a range. */
static void IBU_004_upper_bits(void)
{
    keel_ibus_config_t config = usual;
    uint8_t frame[BYTES];
    uint16_t word[14];

    write_one(frame, 1500u, 0u, (uint16_t)(0x8000u + 1500u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ibus.count.ranges);

    config.extended = true;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &config));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(known, BYTES, SILENT_US)); /* Channels 15 to 18 are 0. */
    TEST_ASSERT_EQUAL_UINT32(1u, ibus.count.ranges);
    for (uint32_t i = 0u; i < 14u; i++) { /* 0x5DC: C, D and 5, the lowest first. */
        const uint16_t upper[3] = {0xC000u, 0xD000u, 0x5000u};

        word[i] = (uint16_t)(1500u + ((i < 12u) ? upper[i % 3u] : 0u));
    }
    write_frame(frame, word);
    is_taken(frame, SILENT_US);
    for (uint32_t i = 0u; i < 18u; i++) {
        TEST_ASSERT_EQUAL_UINT16(1500u, ibus.channel[i]);
    }
}

/* Each bit of a frame changed: the sum sees them all. Nothing but counts changes. */
static void IBU_006_one_bit_changed(void)
{
    uint8_t other[BYTES];

    write_one(other, 1200u, 14u, 0u);
    for (uint32_t bit = 0u; bit < (8u * BYTES); bit++) {
        uint8_t frame[BYTES];

        memcpy(frame, other, sizeof frame);
        frame[bit / 8u] ^= (uint8_t)(1u << (bit % 8u));
        TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &usual));
        is_taken(known, SILENT_US);
        TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
        says_known();
        TEST_ASSERT_EQUAL_UINT32(1u, ibus.count.frames);
        TEST_ASSERT_EQUAL_UINT32(SILENT_US + (31u * BYTE_US), ibus.age_us);
        is_taken(known, SILENT_US);
    }
}

/* The sum first, then the range; and a first byte without its second. */
static void IBU_007_one_reason_is_counted(void)
{
    uint8_t frame[BYTES];

    write_one(frame, 1500u, 3u, 0u);
    frame[30] ^= 1u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ibus.count.sums);
    TEST_ASSERT_EQUAL_UINT32(0u, ibus.count.ranges);
    frame[1] = 0x41u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, 2u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ibus.count.headers);
    TEST_ASSERT_EQUAL_UINT8(0u, ibus.framing.held);
    TEST_ASSERT_EQUAL_UINT32(1u, ibus.count.sums);
}

/* Any part of a frame before a gap. */
static void IBU_009_any_part_before_a_gap(void)
{
    for (uint32_t from = 0u; from < BYTES; from++) {
        for (uint32_t to = from; to < BYTES; to++) {
            TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &usual));
            TEST_ASSERT_EQUAL_UINT32(0u, feed(&known[from], to - from, SILENT_US));
            is_taken(known, GAP_US + 1u);
        }
    }
}

static void IBU_009_a_gap_within(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(known, 12u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(&known[12], 20u, GAP_US));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(known, 12u, SILENT_US));
    keel_ibus_pass_time(&ibus, 300u);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&known[12], 20u, 201u));
    TEST_ASSERT_EQUAL_UINT32(1u, ibus.framing.gaps);
}

/* The end of a frame, or any number of headers, and then a whole one without a gap. */
static void IBU_010_any_part_without_a_gap(void)
{
    for (uint32_t lost = 1u; lost < BYTES; lost++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &usual));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(&known[lost], BYTES - lost, BYTE_US));
        is_taken(known, BYTE_US);
        is_taken(known, BYTE_US);
    }
}

/* A false beginning at any distance, with any number of headers behind it: the frame is taken by
 * its last byte still. */
static void IBU_010_false_beginnings(void)
{
    for (uint32_t before = 2u; before < 70u; before += 5u) {
        for (uint32_t headers = 0u; headers < before; headers++) {
            TEST_ASSERT_EQUAL(KEEL_OK, keel_ibus_init(&ibus, &usual));
            for (uint32_t i = 0u; i < before; i++) {
                const bool second = (i % (headers + 2u)) == 1u;

                TEST_ASSERT_FALSE(keel_ibus_take(&ibus, second ? 0x40u : 0x20u, BYTE_US));
            }
            is_taken(known, BYTE_US);
        }
    }
}

static void IBU_008_time_stays_at_its_end(void)
{
    is_taken(known, SILENT_US);
    keel_ibus_pass_time(&ibus, UINT32_MAX - 1u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX - 1u, ibus.age_us);
    keel_ibus_pass_time(&ibus, 2u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ibus.age_us);
    is_taken(known, 0u);
    TEST_ASSERT_EQUAL_UINT32(0u, ibus.age_us);
}

static void IBU_007_counts_stay_at_their_end(void)
{
    uint8_t frame[BYTES];

    memset(&ibus.count, 0xFF, sizeof ibus.count);
    write_one(frame, 1500u, 3u, 0u);
    (void)feed(frame, BYTES, SILENT_US);
    frame[30] ^= 1u;
    (void)feed(frame, BYTES, SILENT_US);
    (void)feed(&known[0], 1u, SILENT_US);
    (void)feed(&known[0], 1u, BYTE_US);
    is_taken(known, SILENT_US);
    TEST_ASSERT_EACH_EQUAL_UINT32(UINT32_MAX, &ibus.count, 4u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(IBU_001_refuses_a_range_that_is_none);
    RUN_TEST(IBU_001_refuses_a_gap_of_none);
    RUN_TEST(IBU_002_begins_with_nothing);
    RUN_TEST(IBU_005_takes_a_known_frame);
    RUN_TEST(IBU_005_each_bit_is_of_its_channel);
    RUN_TEST(IBU_004_each_channel_has_its_range);
    RUN_TEST(IBU_004_each_channel_may_be_judged);
    RUN_TEST(IBU_004_upper_bits);
    RUN_TEST(IBU_006_one_bit_changed);
    RUN_TEST(IBU_007_one_reason_is_counted);
    RUN_TEST(IBU_009_any_part_before_a_gap);
    RUN_TEST(IBU_009_a_gap_within);
    RUN_TEST(IBU_010_any_part_without_a_gap);
    RUN_TEST(IBU_010_false_beginnings);
    RUN_TEST(IBU_008_time_stays_at_its_end);
    RUN_TEST(IBU_007_counts_stay_at_their_end);
    return UNITY_END();
}
