/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/virtual_imu.h. Expected values are worked out by hand. */
#include "keel/middleware/virtual_imu.h"
#include "unity.h"

#include <math.h>
#include <string.h>

static const keel_voter_config_t accelerometer = {.agree = 1.0f,
                                                  .cutoff = 3.0f,
                                                  .lowest = -160.0f,
                                                  .highest = 160.0f,
                                                  .initial = 0.0f,
                                                  .max_age_us = 5000u,
                                                  .latch_count = 2u,
                                                  .sensors = 3u};
static const keel_voter_config_t gyroscope = {.agree = 0.5f,
                                              .cutoff = 3.0f,
                                              .lowest = -35.0f,
                                              .highest = 35.0f,
                                              .initial = 0.0f,
                                              .max_age_us = 5000u,
                                              .latch_count = 2u,
                                              .sensors = 3u};
static keel_virtual_imu_config_t config;
static keel_virtual_imu_t imu;
static keel_virtual_imu_sample_t sample[3];

void setUp(void)
{
    config.accelerometer = accelerometer;
    config.gyroscope = gyroscope;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_virtual_imu_init(&imu, &config));
    for (uint32_t i = 0u; i < 3u; i++) {
        sample[i].age_us = 0u;
        sample[i].present = true;
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            sample[i].value[k] = (float)k;
        }
    }
}

void tearDown(void)
{
}

static void refuses(keel_status_t why)
{
    keel_virtual_imu_t before;

    memcpy(&before, &imu, sizeof before);
    TEST_ASSERT_EQUAL(why, keel_virtual_imu_init(&imu, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &imu, sizeof imu);
}

static void IMU_001_both_configurations_are_checked(void)
{
    config.accelerometer.latch_count = 0u;
    refuses(KEEL_ERR_LATCH);
    config.accelerometer = accelerometer;
    config.gyroscope.agree = 0.0f;
    refuses(KEEL_ERR_AGREEMENT);
    config.gyroscope = gyroscope;
    config.gyroscope.sensors = 2u;
    refuses(KEEL_ERR_SENSORS);
}

static void IMU_001_the_accelerometers_fault_is_told_first(void)
{
    config.gyroscope.agree = 0.0f;
    config.gyroscope.sensors = 2u;
    config.accelerometer.latch_count = 0u;
    refuses(KEEL_ERR_LATCH);
}

static void IMU_001_each_channel_has_the_configuration_of_its_kind(void)
{
    for (uint32_t k = 0u; k < 3u; k++) {
        TEST_ASSERT_EQUAL_FLOAT(160.0f, imu.channel[k].config.highest);
        TEST_ASSERT_EQUAL_FLOAT(35.0f, imu.channel[k + 3u].config.highest);
    }
}

static void IMU_001_starts_anew(void)
{
    sample[1].value[4] = NAN;
    keel_virtual_imu_step(&imu, sample, 1000u);
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(0x10u, imu.latched[1]);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_virtual_imu_init(&imu, &config));
    TEST_ASSERT_EQUAL_HEX8(0u, imu.latched[1]);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.used[0]);
    TEST_ASSERT_FALSE(imu.channel[4].sensor[1].latched);
}

/* All values lie within a, so each is remembered, where it belongs. */
static void IMU_002_each_value_reaches_its_sensor(void)
{
    for (uint32_t i = 0u; i < 3u; i++) {
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            sample[i].value[k] = (float)(k + 1u) + (0.125f * (float)i);
        }
    }
    keel_virtual_imu_step(&imu, sample, 1000u);
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        TEST_ASSERT_EQUAL_FLOAT((float)(k + 1u), imu.channel[k].sensor[0].last);
        TEST_ASSERT_EQUAL_FLOAT((float)(k + 1u) + 0.125f, imu.channel[k].sensor[1].last);
        TEST_ASSERT_EQUAL_FLOAT((float)(k + 1u) + 0.25f, imu.channel[k].sensor[2].last);
    }
}

static void IMU_002_each_unit_has_its_own_age_and_presence(void)
{
    sample[0].age_us = 5000u;
    sample[1].age_us = 5001u;
    sample[2].present = false;
    keel_virtual_imu_step(&imu, sample, 1000u);
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_USED, imu.channel[k].vote.reason[0]);
        TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_LATE, imu.channel[k].vote.reason[1]);
        TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_MISSING, imu.channel[k].vote.reason[2]);
    }
}

static void IMU_002_each_channel_counts_the_time_it_holds(void)
{
    for (uint32_t i = 0u; i < 3u; i++) {
        sample[i].age_us = 20u;
        sample[i].present = false;
    }
    keel_virtual_imu_step(&imu, sample, 700u);
    keel_virtual_imu_step(&imu, sample, 300u);
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        TEST_ASSERT_EQUAL_UINT32(2u, imu.channel[k].vote.held);
        TEST_ASSERT_EQUAL_UINT32(1000u, imu.channel[k].vote.held_us);
    }
}

static void IMU_002_each_channel_votes_with_its_configuration(void)
{
    sample[2].value[1] = 3.0f; /* 2 away: weight 1/2 with a = 1. */
    sample[2].value[4] = 6.0f; /* 2 away: none with a = 0.5. */
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, imu.channel[0].vote.output);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, imu.channel[1].vote.output);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, imu.channel[2].vote.output);
    TEST_ASSERT_EQUAL_FLOAT(3.0f, imu.channel[3].vote.output);
    TEST_ASSERT_EQUAL_FLOAT(4.0f, imu.channel[4].vote.output);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, imu.channel[5].vote.output);
}

/* The second vote of each channel is a unanimous one; then a unit is late, then absent. */
static void IMU_002_unanimous_votes_and_others(void)
{
    keel_virtual_imu_step(&imu, sample, 1000u);
    sample[0].value[2] = 2.25f;
    sample[1].value[2] = 2.5f;
    sample[2].value[2] = 2.75f;
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_FLOAT(2.5f, imu.channel[2].vote.output);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, imu.channel[5].vote.output);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[2]);
    sample[0].age_us = 5001u; /* Not the oldest in order: the others are as old as may be. */
    sample[2].age_us = 5000u;
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.used[0]);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[2]);
    TEST_ASSERT_EQUAL_FLOAT(2.625f, imu.channel[2].vote.output);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_virtual_imu_init(&imu, &config));
    sample[0].age_us = 0u;
    keel_virtual_imu_step(&imu, sample, 1000u);
    sample[0].present = false;
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.used[0]);
    TEST_ASSERT_EQUAL_FLOAT(2.625f, imu.channel[2].vote.output);
}

/* Gyroscopes 3 % apart in scale at a full stick: 0.06 rad/s of 2, with a = 0.01 + 0.05 |rate|. The
 * first votes find no agreement: their median is what the thresholds grow by. */
static void IMU_005_thresholds_follow_each_channel(void)
{
    config.gyroscope.agree = 0.01f;
    config.gyroscope.slope = 0.05f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_virtual_imu_init(&imu, &config));
    for (uint32_t n = 0u; n < 9u; n++) {
        for (uint32_t i = 0u; i < 3u; i++) {
            sample[i].value[3] = 0.0f;
            sample[i].value[5] = -1.94f - (0.06f * (float)i);
        }
        keel_virtual_imu_step(&imu, sample, 2000u);
        TEST_ASSERT_EQUAL_FLOAT(-2.0f, imu.channel[5].vote.output);
    }
    TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_MEAN, imu.channel[5].vote.state);
    TEST_ASSERT_EQUAL_FLOAT(0.01f, imu.channel[3].agree);
    TEST_ASSERT_EQUAL_FLOAT(0.11f, imu.channel[5].agree);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[0]);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[2]);
}

/* The bus is silent for as long as latches: nobody is; one unit is silent, and comes back. */
static void IMU_006_a_latch_ends_by_itself(void)
{
    config.accelerometer.readmit_count = 3u;
    config.gyroscope.readmit_count = 2u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_virtual_imu_init(&imu, &config));
    for (uint32_t i = 0u; i < 3u; i++) {
        sample[i].present = false;
    }
    for (uint32_t n = 0u; n < 9u; n++) {
        keel_virtual_imu_step(&imu, sample, 2000u);
    }
    sample[0].present = true;
    sample[1].present = true;
    TEST_ASSERT_EQUAL_HEX8(0u, imu.latched[0] | imu.latched[1] | imu.latched[2]);
    keel_virtual_imu_step(&imu, sample, 2000u);
    keel_virtual_imu_step(&imu, sample, 2000u);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.latched[2]);
    sample[2].present = true;
    keel_virtual_imu_step(&imu, sample, 2000u);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.latched[2]);
    keel_virtual_imu_step(&imu, sample, 2000u);
    TEST_ASSERT_EQUAL_HEX8(0x07u, imu.latched[2]);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.used[2]);
    keel_virtual_imu_step(&imu, sample, 2000u);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.latched[2]);
    TEST_ASSERT_EQUAL_HEX8(0x38u, imu.used[2]);
}

static void IMU_003_verdicts_per_unit(void)
{
    sample[2].value[4] = 6.0f;
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[0]);
    TEST_ASSERT_EQUAL_HEX8(0x2Fu, imu.used[2]);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.latched[2]);
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(0x10u, imu.latched[2]);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.latched[1]);
}

static void IMU_003_a_unit_that_agrees_again_is_used_again(void)
{
    sample[2].value[4] = 6.0f;
    sample[1].value[0] = 9.0f;
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(0x2Fu, imu.used[2]);
    TEST_ASSERT_EQUAL_HEX8(0x3Eu, imu.used[1]);
    sample[2].value[4] = 4.0f;
    sample[1].value[0] = 0.0f;
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[2]);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[1]);
}

static void IMU_003_a_silent_unit_loses_all_channels(void)
{
    sample[1].present = false;
    keel_virtual_imu_step(&imu, sample, 1000u);
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.latched[1]);
    TEST_ASSERT_EQUAL_HEX8(0u, imu.used[1]);
    sample[1].present = true;
    sample[0].age_us = 5001u; /* Late, and alone is the third. */
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_VOTER_SINGLE, imu.channel[5].vote.state);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, imu.channel[5].vote.output);
}

static void IMU_004_readmits_a_unit(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_SENSORS, keel_virtual_imu_readmit(&imu, 3u));
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_virtual_imu_readmit(&imu, 1u));
    sample[1].value[0] = NAN;
    keel_virtual_imu_step(&imu, sample, 1000u);
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(0x01u, imu.latched[1]);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_virtual_imu_readmit(&imu, 1u));
    TEST_ASSERT_EQUAL_HEX8(0u, imu.latched[1]);
    TEST_ASSERT_FALSE(imu.channel[0].sensor[1].latched);
}

static void IMU_004_readmits_each_channel_of_one_unit_only(void)
{
    sample[1].value[0] = NAN;
    sample[1].value[4] = NAN;
    sample[0].value[5] = NAN;
    keel_virtual_imu_step(&imu, sample, 1000u);
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(0x11u, imu.latched[1]);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_virtual_imu_readmit(&imu, 1u));
    TEST_ASSERT_EQUAL_HEX8(0u, imu.latched[1]);
    TEST_ASSERT_FALSE(imu.channel[0].sensor[1].latched);
    TEST_ASSERT_FALSE(imu.channel[4].sensor[1].latched);
    TEST_ASSERT_EQUAL_HEX8(0x20u, imu.latched[0]);
    TEST_ASSERT_TRUE(imu.channel[5].sensor[0].latched);
    TEST_ASSERT_EQUAL_HEX8(0x2Eu, imu.used[1]); /* Of the last vote, and so it stays. */
    sample[1].value[0] = 0.0f;
    sample[1].value[4] = 4.0f;
    keel_virtual_imu_step(&imu, sample, 1000u);
    TEST_ASSERT_EQUAL_HEX8(KEEL_VIRTUAL_IMU_ALL, imu.used[1]);
    TEST_ASSERT_EQUAL_HEX8(0x1Fu, imu.used[0]);
    TEST_ASSERT_EQUAL_HEX8(0x20u, imu.latched[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(IMU_001_both_configurations_are_checked);
    RUN_TEST(IMU_001_the_accelerometers_fault_is_told_first);
    RUN_TEST(IMU_001_each_channel_has_the_configuration_of_its_kind);
    RUN_TEST(IMU_001_starts_anew);
    RUN_TEST(IMU_002_each_value_reaches_its_sensor);
    RUN_TEST(IMU_002_each_unit_has_its_own_age_and_presence);
    RUN_TEST(IMU_002_each_channel_counts_the_time_it_holds);
    RUN_TEST(IMU_002_each_channel_votes_with_its_configuration);
    RUN_TEST(IMU_002_unanimous_votes_and_others);
    RUN_TEST(IMU_005_thresholds_follow_each_channel);
    RUN_TEST(IMU_006_a_latch_ends_by_itself);
    RUN_TEST(IMU_003_verdicts_per_unit);
    RUN_TEST(IMU_003_a_unit_that_agrees_again_is_used_again);
    RUN_TEST(IMU_003_a_silent_unit_loses_all_channels);
    RUN_TEST(IMU_004_readmits_a_unit);
    RUN_TEST(IMU_004_readmits_each_channel_of_one_unit_only);
    return UNITY_END();
}
