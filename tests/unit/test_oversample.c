/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/oversample.h. Expected values are worked out by hand. */
#include "keel/middleware/oversample.h"
#include "unity.h"

#include <math.h>
#include <string.h>

static keel_oversample_t channel;
static float mean;

void setUp(void)
{
    mean = -1.0f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_oversample_init(&channel, 2u));
}

void tearDown(void)
{
}

static void add(float value)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_oversample_add(&channel, value));
}

static void take(float expected)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_oversample_take(&channel, &mean));
    TEST_ASSERT_EQUAL_FLOAT(expected, mean);
}

static void OVS_001_factor_zero_is_refused(void)
{
    keel_oversample_t before;

    add(1.0f);
    memcpy(&before, &channel, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_FACTOR, keel_oversample_init(&channel, 0u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &channel, sizeof before);
    TEST_ASSERT_EQUAL_UINT16(2u, channel.factor);
}

static void OVS_002_mean_of_two(void)
{
    add(1.0f);
    add(2.0f);
    TEST_ASSERT_EQUAL_UINT16(2u, channel.count);
    take(1.5f);
    add(-4.0f);
    add(-6.0f);
    take(-5.0f);
}

static void OVS_003_bad_samples_do_not_enter(void)
{
    add(3.0f);
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_oversample_add(&channel, NAN));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_oversample_add(&channel, INFINITY));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_oversample_add(&channel, -1.1e9f));
    TEST_ASSERT_EQUAL_UINT16(1u, channel.count);
    TEST_ASSERT_EQUAL_UINT16(4u, channel.runs);
    take(3.0f);
}

static void OVS_003_the_ends_of_the_range_enter(void)
{
    /* 1000000064 is the next number behind 1e9. */
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_oversample_add(&channel, 1000000064.0f));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_oversample_add(&channel, -1000000064.0f));
    add(-1.0e9f);
    take(-1.0e9f);
    add(1.0e9f);
    take(1.0e9f);
}

static void OVS_003_runs_are_full(void)
{
    channel.runs = UINT16_MAX - 1u;
    add(3.0f);
    TEST_ASSERT_EQUAL(KEEL_ERR_FULL, keel_oversample_add(&channel, 9.0f));
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, channel.runs);
    TEST_ASSERT_EQUAL_UINT16(1u, channel.count);
    take(3.0f);
}

static void OVS_004_mean_stays_among_the_samples(void)
{
    /* Seven times 0.1 in single precision sum to 0.70000005, whose seventh is above 0.1. */
    for (uint32_t i = 0u; i < 7u; i++) {
        add(0.1f);
    }
    TEST_ASSERT_TRUE((channel.sum / 7.0f) > 0.1f);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_oversample_take(&channel, &mean));
    TEST_ASSERT_TRUE(mean == 0.1f);
    for (uint32_t i = 0u; i < 7u; i++) {
        add(-0.1f);
    }
    TEST_ASSERT_EQUAL(KEEL_OK, keel_oversample_take(&channel, &mean));
    TEST_ASSERT_TRUE(mean == -0.1f);
}

static void OVS_004_no_sample_no_mean(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_oversample_take(&channel, &mean));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, mean);
    TEST_ASSERT_EQUAL_UINT32(2u, channel.missed);
}

static void OVS_005_begins_anew(void)
{
    add(100.0f);
    take(100.0f);
    TEST_ASSERT_EQUAL_UINT16(0u, channel.runs);
    add(1.0f);
    take(1.0f);
}

static void OVS_006_missed_and_extra_runs(void)
{
    add(1.0f);
    take(1.0f);
    TEST_ASSERT_EQUAL_UINT32(1u, channel.missed);
    add(1.0f);
    add(1.0f);
    take(1.0f);
    add(1.0f);
    add(1.0f);
    add(1.0f);
    add(1.0f);
    add(1.0f);
    take(1.0f);
    TEST_ASSERT_EQUAL_UINT32(1u, channel.missed);
    TEST_ASSERT_EQUAL_UINT32(3u, channel.extra);
}

static void OVS_006_counts_saturate(void)
{
    channel.missed = UINT32_MAX - 1u;
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_oversample_take(&channel, &mean));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, channel.missed);
    channel.extra = UINT32_MAX;
    for (uint32_t i = 0u; i < 3u; i++) {
        add(1.0f);
    }
    take(1.0f);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, channel.extra);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(OVS_001_factor_zero_is_refused);
    RUN_TEST(OVS_002_mean_of_two);
    RUN_TEST(OVS_003_bad_samples_do_not_enter);
    RUN_TEST(OVS_003_the_ends_of_the_range_enter);
    RUN_TEST(OVS_003_runs_are_full);
    RUN_TEST(OVS_004_mean_stays_among_the_samples);
    RUN_TEST(OVS_004_no_sample_no_mean);
    RUN_TEST(OVS_005_begins_anew);
    RUN_TEST(OVS_006_missed_and_extra_runs);
    RUN_TEST(OVS_006_counts_saturate);
    return UNITY_END();
}
