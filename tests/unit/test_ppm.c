/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/ppm.h. Frames of 20 ms; channels are taken from the third in a row
 * on. */
#include "keel/middleware/ppm.h"
#include "unity.h"

#include <string.h>

#define FRAME_US 20000u
#define LOST_US  100000u

static const keel_ppm_config_t usual = {.lost_us = LOST_US,
                                        .lowest_us = 800u,
                                        .highest_us = 2200u,
                                        .sync_us = 2300u,
                                        .judged = 0xFFFFu,
                                        .least = 4u,
                                        .frames_to_take = 3u};

static const uint16_t eight[8] = {1000, 1100, 1200, 1300, 1400, 1500, 2000, 2200};

static keel_ppm_t ppm;

void setUp(void)
{
    memset(&ppm, 0xA5, sizeof ppm);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ppm_init(&ppm, &usual));
}

void tearDown(void)
{
}

/* The edges behind so many channels, and the one behind the sync gap. */
static bool frame_of(const uint16_t *channel, uint32_t count)
{
    uint32_t left = FRAME_US;

    for (uint32_t i = 0u; i < count; i++) {
        TEST_ASSERT_FALSE(keel_ppm_take(&ppm, channel[i]));
        left -= channel[i];
    }
    return keel_ppm_take(&ppm, left);
}

/* A first edge, and the one behind a sync gap: a frame begins. */
static void synchronise(void)
{
    TEST_ASSERT_FALSE(keel_ppm_take(&ppm, 5000u));
    TEST_ASSERT_FALSE(keel_ppm_take(&ppm, 5000u));
}

/* Eight channels are taken. */
static void lock(void)
{
    synchronise();
    TEST_ASSERT_FALSE(frame_of(eight, 8u));
    TEST_ASSERT_FALSE(frame_of(eight, 8u));
    TEST_ASSERT_TRUE(frame_of(eight, 8u));
}

static void says_eight(void)
{
    TEST_ASSERT_EQUAL_UINT8(8u, ppm.channels);
    for (uint32_t i = 0u; i < 16u; i++) {
        TEST_ASSERT_EQUAL_UINT16((i < 8u) ? eight[i] : 0u, ppm.channel[i]);
    }
}

static void refused(keel_ppm_config_t config, keel_status_t reason)
{
    const keel_ppm_t before = ppm;

    TEST_ASSERT_EQUAL(reason, keel_ppm_init(&ppm, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &ppm, sizeof ppm);
}

static void PPM_001_refuses_limits_in_the_wrong_order(void)
{
    keel_ppm_config_t config = usual;

    config.lowest_us = 2201u;
    refused(config, KEEL_ERR_LIMITS);
    config = usual;
    config.highest_us = 2300u;
    refused(config, KEEL_ERR_LIMITS);
    config = usual;
    config.lost_us = 2300u;
    refused(config, KEEL_ERR_LIMITS);
    config = usual;
    config.least = 0u;
    refused(config, KEEL_ERR_LIMITS);
    config.least = 17u;
    config.frames_to_take = 0u;
    refused(config, KEEL_ERR_LIMITS);
    config.least = 16u;
    refused(config, KEEL_ERR_LATCH);
}

static void PPM_002_begins_with_nothing(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ppm.age_us);
    TEST_ASSERT_EQUAL_UINT8(0u, ppm.channels);
    TEST_ASSERT_EQUAL_UINT32(0u, ppm.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, ppm.count.gaps);
    TEST_ASSERT_TRUE(keel_ppm_is_lost(&ppm));
}

static void PPM_005_takes_the_third(void)
{
    lock();
    says_eight();
    TEST_ASSERT_EQUAL_UINT32(1u, ppm.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, ppm.age_us);
    TEST_ASSERT_TRUE(frame_of(eight, 8u));
    TEST_ASSERT_EQUAL_UINT32(2u, ppm.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, ppm.count.pulses + ppm.count.numbers + ppm.count.gaps);
}

/* The receiver was on before: what comes first is the end of a frame, and no frame. */
static void PPM_010_the_end_of_a_frame_is_none(void)
{
    keel_ppm_config_t config = usual;

    config.frames_to_take = 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ppm_init(&ppm, &config));
    TEST_ASSERT_FALSE(keel_ppm_take(&ppm, 0u));
    TEST_ASSERT_FALSE(frame_of(&eight[3], 5u));
    TEST_ASSERT_TRUE(frame_of(eight, 8u));
    says_eight();
}

/* Silence is no longer than the longest that can be told. */
static void PPM_010_the_longest_silence(void)
{
    keel_ppm_config_t config = usual;

    config.lost_us = UINT32_MAX;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ppm_init(&ppm, &config));
    TEST_ASSERT_FALSE(keel_ppm_take(&ppm, 0u));
    keel_ppm_pass_time(&ppm, UINT32_MAX);
    TEST_ASSERT_FALSE(keel_ppm_take(&ppm, 5u));
    TEST_ASSERT_EQUAL_UINT32(0u, ppm.count.gaps);
    TEST_ASSERT_TRUE(ppm.begun);
}

/* The ends of a channel's range; between its longest and the sync gap there is neither. */
static void PPM_004_each_width(void)
{
    for (uint32_t width = 700u; width < 2400u; width++) {
        uint16_t channel[8];
        const bool right = (width >= 800u) && (width <= 2200u);

        memcpy(channel, eight, sizeof channel);
        channel[7] = (uint16_t)width;
        setUp();
        lock();
        TEST_ASSERT_EQUAL(right, frame_of(channel, 8u));
        TEST_ASSERT_EQUAL_UINT16(right ? width : 2200u, ppm.channel[7]);
        TEST_ASSERT_EQUAL_UINT32((right || (width >= 2300u)) ? 0u : 1u, ppm.count.pulses);
    }
}

/* Each channel alone is judged: then it alone voids a frame, too short or too long. */
static void PPM_004_each_channel_may_be_judged(void)
{
    const uint16_t odd[4] = {732u, 2268u, 1u, 2299u};

    for (uint32_t judged = 0u; judged < 16u; judged++) {
        keel_ppm_config_t config = usual;

        config.judged = (uint16_t)(1u << judged);
        for (uint32_t k = 0u; k < 64u; k++) {
            uint16_t channel[16];

            for (uint32_t i = 0u; i < 16u; i++) {
                channel[i] = (i == (k / 4u)) ? odd[k % 4u] : 1000u;
            }
            TEST_ASSERT_EQUAL(KEEL_OK, keel_ppm_init(&ppm, &config));
            synchronise();
            for (uint32_t n = 0u; n < 3u; n++) {
                TEST_ASSERT_EQUAL((n == 2u) && ((k / 4u) != judged), frame_of(channel, 16u));
            }
            TEST_ASSERT_EQUAL_UINT32(((k / 4u) == judged) ? 3u : 0u, ppm.count.pulses);
        }
    }
}

/* A frame of another number begins another row; so it does when it is one that there is none of. */
static void PPM_009_another_number(void)
{
    uint16_t many[17];

    for (uint32_t i = 0u; i < 17u; i++) {
        many[i] = 900u;
    }
    for (uint32_t count = 0u; count <= 17u; count++) {
        setUp();
        lock();
        TEST_ASSERT_EQUAL(count == 8u, frame_of(many, count));
        if (count != 8u) {
            says_eight();
            TEST_ASSERT_EQUAL_UINT32(((count < 4u) || (count > 16u)) ? 1u : 0u, ppm.count.numbers);
            TEST_ASSERT_FALSE(frame_of(eight, 8u));
            TEST_ASSERT_FALSE(frame_of(eight, 8u));
            TEST_ASSERT_TRUE(frame_of(eight, 8u));
        }
    }
}

/* Three frames of five channels: then they are five, and the others none. */
static void PPM_009_a_row_of_another(void)
{
    lock();
    TEST_ASSERT_FALSE(frame_of(&eight[1], 5u));
    TEST_ASSERT_FALSE(frame_of(&eight[1], 5u));
    says_eight();
    TEST_ASSERT_TRUE(frame_of(&eight[1], 5u));
    TEST_ASSERT_EQUAL_UINT8(5u, ppm.channels);
    for (uint32_t i = 0u; i < 16u; i++) {
        TEST_ASSERT_EQUAL_UINT16((i < 5u) ? eight[i + 1u] : 0u, ppm.channel[i]);
    }
}

/* An edge too few makes one channel of two, an edge too many two of one. */
static void PPM_009_an_edge_too_few_or_too_many(void)
{
    const uint16_t fewer[7] = {2100, 1200, 1300, 1400, 1500, 2000, 2200};
    const uint16_t more[9] = {1000, 1100, 1200, 1300, 1400, 1500, 1000, 1000, 2200};

    lock();
    TEST_ASSERT_FALSE(frame_of(fewer, 7u));
    TEST_ASSERT_FALSE(frame_of(more, 9u));
    says_eight();
    TEST_ASSERT_EQUAL_UINT32(2u * FRAME_US, ppm.age_us);
}

static void PPM_009_a_bad_channel_breaks_a_row(void)
{
    const uint16_t bad[8] = {1000, 1100, 1200, 799, 1400, 1500, 2000, 2200};

    lock();
    TEST_ASSERT_FALSE(frame_of(bad, 8u));
    TEST_ASSERT_EQUAL_UINT32(1u, ppm.count.pulses);
    TEST_ASSERT_FALSE(frame_of(eight, 8u));
    TEST_ASSERT_FALSE(frame_of(eight, 8u));
    TEST_ASSERT_TRUE(frame_of(eight, 8u));
}

/* A silence as long as lost_us is a sync gap, a longer one is none, and breaks the row. */
static void PPM_010_a_silence_too_long(void)
{
    lock();
    for (uint32_t i = 0u; i < 8u; i++) {
        TEST_ASSERT_FALSE(keel_ppm_take(&ppm, eight[i]));
    }
    keel_ppm_pass_time(&ppm, LOST_US - 7u);
    TEST_ASSERT_TRUE(keel_ppm_is_lost(&ppm));
    TEST_ASSERT_TRUE(keel_ppm_take(&ppm, 7u));
    TEST_ASSERT_FALSE(keel_ppm_is_lost(&ppm));
    for (uint32_t i = 0u; i < 8u; i++) {
        TEST_ASSERT_FALSE(keel_ppm_take(&ppm, eight[i]));
    }
    TEST_ASSERT_FALSE(keel_ppm_take(&ppm, LOST_US + 1u));
    TEST_ASSERT_EQUAL_UINT32(1u, ppm.count.gaps);
    TEST_ASSERT_FALSE(frame_of(eight, 8u)); /* Nobody saw where it began. */
    TEST_ASSERT_FALSE(frame_of(eight, 8u));
    TEST_ASSERT_FALSE(frame_of(eight, 8u));
    TEST_ASSERT_TRUE(frame_of(eight, 8u));
}

static void PPM_011_lost_by_age(void)
{
    lock();
    keel_ppm_pass_time(&ppm, LOST_US);
    TEST_ASSERT_FALSE(keel_ppm_is_lost(&ppm));
    keel_ppm_pass_time(&ppm, 1u);
    TEST_ASSERT_TRUE(keel_ppm_is_lost(&ppm));
    says_eight();
}

static void PPM_008_time_stays_at_its_end(void)
{
    lock();
    keel_ppm_pass_time(&ppm, UINT32_MAX - 1u);
    keel_ppm_pass_time(&ppm, 2u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ppm.age_us);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ppm.quiet_us);
}

static void PPM_007_counts_stay_at_their_end(void)
{
    const uint16_t bad[2] = {1000, 799};
    uint16_t many[KEEL_PPM_CHANNELS + 1];

    for (uint32_t i = 0u; i <= KEEL_PPM_CHANNELS; i++) {
        many[i] = 1500u;
    }
    memset(&ppm.count, 0xFF, sizeof ppm.count);
    lock();
    (void)frame_of(eight, 2u);
    (void)frame_of(bad, 2u);
    lock();
    (void)frame_of(many, KEEL_PPM_CHANNELS + 1u);
    lock();
    (void)keel_ppm_take(&ppm, LOST_US + 1u);
    TEST_ASSERT_EACH_EQUAL_UINT32(UINT32_MAX, &ppm.count, 4u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PPM_001_refuses_limits_in_the_wrong_order);
    RUN_TEST(PPM_002_begins_with_nothing);
    RUN_TEST(PPM_005_takes_the_third);
    RUN_TEST(PPM_010_the_end_of_a_frame_is_none);
    RUN_TEST(PPM_010_the_longest_silence);
    RUN_TEST(PPM_004_each_width);
    RUN_TEST(PPM_004_each_channel_may_be_judged);
    RUN_TEST(PPM_009_another_number);
    RUN_TEST(PPM_009_a_row_of_another);
    RUN_TEST(PPM_009_an_edge_too_few_or_too_many);
    RUN_TEST(PPM_009_a_bad_channel_breaks_a_row);
    RUN_TEST(PPM_010_a_silence_too_long);
    RUN_TEST(PPM_011_lost_by_age);
    RUN_TEST(PPM_008_time_stays_at_its_end);
    RUN_TEST(PPM_007_counts_stay_at_their_end);
    return UNITY_END();
}
