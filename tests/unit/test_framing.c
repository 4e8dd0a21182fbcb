/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/framing.h. The header is 0xC8, and a gap is longer than 300 us. */
#include "keel/internal/middleware/framing.h"
#include "unity.h"

#include <string.h>

#define HEADER  0xC8u
#define GAP_US  300u
#define BYTE_US 24u

static const uint8_t one[KEEL_FRAMING_HEADERS] = {HEADER, HEADER, HEADER, HEADER};

static keel_framing_t framing;

void setUp(void)
{
    memset(&framing, 0xA5, sizeof framing);
    keel_framing_begin(&framing, GAP_US, one);
}

void tearDown(void)
{
}

static void take_all(const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        keel_framing_take(&framing, bytes[i], BYTE_US);
    }
}

static void holds(const uint8_t *bytes, uint8_t count)
{
    TEST_ASSERT_EQUAL_UINT8(count, framing.held);
    for (uint32_t i = 0u; i < count; i++) {
        TEST_ASSERT_EQUAL_UINT8(bytes[i], framing.byte[i]);
    }
}

static void FRG_001_sums_stay_at_their_end(void)
{
    TEST_ASSERT_EQUAL_UINT32(5u, keel_framing_sum(2u, 3u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, keel_framing_sum(UINT32_MAX, 0u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, keel_framing_sum(UINT32_MAX - 1u, 1u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, keel_framing_sum(UINT32_MAX - 1u, 2u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, keel_framing_sum(UINT32_MAX, UINT32_MAX));
}

static void FRG_002_begins_with_nothing(void)
{
    TEST_ASSERT_EQUAL_UINT8(0u, framing.held);
    TEST_ASSERT_EQUAL_UINT32(GAP_US, framing.gap_us);
    TEST_ASSERT_EACH_EQUAL_UINT8(HEADER, framing.header, KEEL_FRAMING_HEADERS);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, framing.quiet_us);
    TEST_ASSERT_EQUAL_UINT32(0u, framing.gaps);
    TEST_ASSERT_EQUAL_UINT32(0u, framing.strays);
    for (uint32_t i = 0u; i < KEEL_FRAMING_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, framing.byte[i]);
    }
}

static void FRG_005_waits_for_a_header(void)
{
    const uint8_t bytes[4] = {0x00, 0xFF, 0xC8, 0x12};

    take_all(bytes, 4u);
    holds(&bytes[2], 2u);
    TEST_ASSERT_EQUAL_UINT32(2u, framing.strays);
    TEST_ASSERT_EQUAL_UINT32(0u, framing.gaps);
}

/* 300 us are no gap, 301 us are one, passed in one or in two. */
static void FRG_004_a_gap_is_longer(void)
{
    const uint8_t bytes[3] = {0xC8, 0x01, 0x02};

    take_all(bytes, 2u);
    keel_framing_take(&framing, 0x02u, GAP_US);
    holds(bytes, 3u);
    keel_framing_take(&framing, HEADER, GAP_US + 1u);
    holds(bytes, 1u);
    TEST_ASSERT_EQUAL_UINT32(1u, framing.gaps);
    keel_framing_pass_time(&framing, 200u);
    TEST_ASSERT_EQUAL_UINT32(200u, framing.quiet_us);
    keel_framing_take(&framing, 0x55u, 101u);
    TEST_ASSERT_EQUAL_UINT8(0u, framing.held);
    TEST_ASSERT_EQUAL_UINT32(2u, framing.gaps);
    TEST_ASSERT_EQUAL_UINT32(1u, framing.strays);
    TEST_ASSERT_EQUAL_UINT32(0u, framing.quiet_us);
    keel_framing_take(&framing, HEADER, 10000u); /* Nothing was held. */
    TEST_ASSERT_EQUAL_UINT32(2u, framing.gaps);
}

static void FRG_006_drops_up_to_the_next_header(void)
{
    const uint8_t bytes[8] = {0xC8, 0x01, 0xC8, 0x02, 0x03, 0xC8, 0xC8, 0x04};

    take_all(bytes, 8u);
    keel_framing_drop(&framing, 1u);
    holds(&bytes[2], 6u);
    keel_framing_drop(&framing, 1u);
    holds(&bytes[5], 3u);
    keel_framing_drop(&framing, 1u);
    holds(&bytes[6], 2u);
    keel_framing_drop(&framing, 1u);
    TEST_ASSERT_EQUAL_UINT8(0u, framing.held);
}

/* Each of four begins a frame, ends the search for the next one, and begins anew behind a gap. */
static void FRG_006_any_of_four_headers(void)
{
    static const uint8_t four[KEEL_FRAMING_HEADERS] = {0x11u, 0x22u, 0x33u, 0x44u};

    for (uint32_t i = 0u; i < (uint32_t)KEEL_FRAMING_HEADERS; i++) {
        const uint8_t bytes[3] = {four[i], 0x55u, four[i]};

        keel_framing_begin(&framing, GAP_US, four);
        take_all(bytes, 3u);
        holds(bytes, 3u);
        keel_framing_drop(&framing, 1u);
        holds(&four[i], 1u);
        keel_framing_take(&framing, four[i], GAP_US + 1u);
        holds(&four[i], 1u);
        TEST_ASSERT_EQUAL_UINT32(1u, framing.gaps);
    }
}

/* As many as there is room for, all headers, and any number of them dropped. */
static void FRG_006_drops_of_a_full_one(void)
{
    for (uint32_t count = 1u; count <= KEEL_FRAMING_BYTES; count++) {
        uint8_t bytes[KEEL_FRAMING_BYTES];

        for (uint32_t i = 0u; i < KEEL_FRAMING_BYTES; i++) {
            bytes[i] = (uint8_t)i;
        }
        bytes[0] = HEADER;
        bytes[count % KEEL_FRAMING_BYTES] = HEADER;
        keel_framing_begin(&framing, GAP_US, one);
        take_all(bytes, KEEL_FRAMING_BYTES);
        TEST_ASSERT_EQUAL_UINT8(KEEL_FRAMING_BYTES, framing.held);
        keel_framing_drop(&framing, count);
        holds(&bytes[count % KEEL_FRAMING_BYTES], (uint8_t)(KEEL_FRAMING_BYTES - count));
    }
}

static void FRG_001_counts_stay_at_their_end(void)
{
    framing.gaps = UINT32_MAX;
    framing.strays = UINT32_MAX;
    keel_framing_take(&framing, 0x00u, BYTE_US);
    keel_framing_take(&framing, HEADER, BYTE_US);
    keel_framing_take(&framing, HEADER, GAP_US + 1u);
    keel_framing_take(&framing, 0x00u, GAP_US + 1u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, framing.gaps);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, framing.strays);
}

static void FRG_003_silence_stays_at_its_end(void)
{
    keel_framing_take(&framing, HEADER, BYTE_US);
    keel_framing_pass_time(&framing, UINT32_MAX - 1u);
    keel_framing_pass_time(&framing, 2u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, framing.quiet_us);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(FRG_001_sums_stay_at_their_end);
    RUN_TEST(FRG_002_begins_with_nothing);
    RUN_TEST(FRG_005_waits_for_a_header);
    RUN_TEST(FRG_004_a_gap_is_longer);
    RUN_TEST(FRG_006_drops_up_to_the_next_header);
    RUN_TEST(FRG_006_any_of_four_headers);
    RUN_TEST(FRG_006_drops_of_a_full_one);
    RUN_TEST(FRG_001_counts_stay_at_their_end);
    RUN_TEST(FRG_003_silence_stays_at_its_end);
    return UNITY_END();
}
