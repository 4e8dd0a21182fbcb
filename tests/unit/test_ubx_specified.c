/* SPDX-License-Identifier: Apache-2.0 */
/* The UBX decoder beside its executable specification (specs/model): random messages, disturbed and
 * not, with gaps and without, to both; after each byte every field must be the same. */
#include "any.h"
#include "keel/middleware/ubx.h"
#include "unity.h"

#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/ubx.c"

#define MESSAGES 10000u
#define SEED     20261124u

static keel_ubx_t ubx;
static keel_ubx_t model;
static uint32_t taken;

void setUp(void)
{
    any_from(SEED);
    memset(&ubx, 0, sizeof ubx);
    memset(&model, 0, sizeof model);
    taken = 0u;
}

void tearDown(void)
{
}

static void set_up(void)
{
    keel_ubx_config_t config;
    keel_status_t expected;

    memset(&config, 0, sizeof config);
    config.gap_us = one_in(16u) ? any() % 3u : 5000u;
    config.max_age_us = one_in(16u) ? 0u : 300000u;
    config.accuracy_mm = one_in(16u) ? 0u : any();
    config.speed_accuracy = one_in(16u) ? 0u : any();
    expected = model_ubx_init(&model, &config);
    TEST_ASSERT_EQUAL(expected, keel_ubx_init(&ubx, &config));
    if (one_in(8u) && (expected == KEEL_OK)) {
        memset(&ubx.count, 0xFF, sizeof ubx.count);
        memset(&model.count, 0xFF, sizeof model.count);
    }
}

static void both_take(uint8_t byte, uint32_t elapsed_us)
{
    const bool expected = model_ubx_take(&model, byte, elapsed_us);

    TEST_ASSERT_EQUAL(expected, keel_ubx_take(&ubx, byte, elapsed_us));
    TEST_ASSERT_EQUAL_MEMORY(&model, &ubx, sizeof ubx);
    TEST_ASSERT_EQUAL(model_ubx_judge(&model), keel_ubx_judge(&ubx));
    taken += expected ? 1u : 0u;
}

/* A message, right but for its checksum at times; its size. */
static uint32_t any_message(uint8_t *to)
{
    static const uint8_t heads[5][3] = {
        {0x01, 0x07, 92}, {0x01, 0x07, 92}, {0x05, 0x01, 2}, {0x05, 0x00, 2}, {0x01, 0x07, 84}};
    const uint8_t *const head = heads[any() % 5u];
    const uint32_t length = one_in(8u) ? any() % 120u : head[2];
    uint32_t a = 0u;
    uint32_t b = 0u;

    to[0] = 0xB5u;
    to[1] = 0x62u;
    to[2] = head[0];
    to[3] = head[1];
    to[4] = (uint8_t)length;
    to[5] = one_in(256u) ? (uint8_t)any() : 0u;
    for (uint32_t i = 6u; i < (6u + length); i++) {
        to[i] = one_in(4u) ? (uint8_t)any() : 0u;
    }
    to[26] = one_in(2u) ? 3u : to[26];
    for (uint32_t i = 2u; i < (6u + length); i++) {
        a = (a + to[i]) % 256u;
        b = (b + a) % 256u;
    }
    to[6u + length] = (uint8_t)(a + (one_in(16u) ? 1u : 0u));
    to[7u + length] = (uint8_t)(b + (one_in(16u) ? 1u : 0u));
    return 8u + length;
}

static void UBX_003_each_byte_is_as_specified(void)
{
    for (uint32_t n = 0u; n < MESSAGES; n++) {
        uint8_t bytes[140];
        const uint32_t size = any_message(bytes);

        if ((n % 64u) == 0u) {
            set_up();
        }
        for (uint32_t i = 0u; i < size; i++) {
            const bool pause = (i == 0u) ? one_in(2u) : one_in(2048u);

            if (one_in(512u)) {
                both_take((uint8_t)(one_in(2u) ? 0xB5u : any()), 90u);
            }
            if (!one_in(512u)) {
                both_take(bytes[i], pause ? any() % 80000u : 90u);
            }
        }
        if (one_in(4u)) {
            const uint32_t elapsed_us = one_in(64u) ? any() : 4000u;

            model_ubx_pass_time(&model, elapsed_us);
            keel_ubx_pass_time(&ubx, elapsed_us);
            TEST_ASSERT_EQUAL_MEMORY(&model, &ubx, sizeof ubx);
        }
    }
    TEST_ASSERT_TRUE(taken > (MESSAGES / 10u));
}

static void UBX_003_noise_is_as_specified(void)
{
    const uint8_t often[9] = {0xB5, 0x62, 0x01, 0x07, 0x5C, 0x00, 0x05, 0x02, 0x54};

    set_up();
    for (uint32_t n = 0u; n < (MESSAGES * 50u); n++) {
        const uint32_t at = any() % 9u;

        both_take(one_in(4u) ? (uint8_t)any() : often[one_in(2u) ? (n % 6u) : at], any() % 5100u);
    }
}

static void UBX_015_each_message_is_as_specified(void)
{
    for (uint32_t n = 0u; n < MESSAGES; n++) {
        const uint32_t key = any();
        const uint32_t value = any();
        keel_ubx_message_t is;
        keel_ubx_message_t said;

        memset(&is, 0, sizeof is);
        memset(&said, 0, sizeof said);
        TEST_ASSERT_EQUAL(model_ubx_write_value(&said, key, value),
                          keel_ubx_write_value(&is, key, value));
        TEST_ASSERT_EQUAL_MEMORY(&said, &is, sizeof is);
        model_ubx_write_output(&said, (uint8_t)key, (uint8_t)(key >> 8), (uint8_t)value);
        keel_ubx_write_output(&is, (uint8_t)key, (uint8_t)(key >> 8), (uint8_t)value);
        TEST_ASSERT_EQUAL_MEMORY(&said, &is, sizeof is);
        model_ubx_write_rate(&said, (uint16_t)value);
        keel_ubx_write_rate(&is, (uint16_t)value);
        TEST_ASSERT_EQUAL_MEMORY(&said, &is, sizeof is);
        model_ubx_write_port(&said, value);
        keel_ubx_write_port(&is, value);
        TEST_ASSERT_EQUAL_MEMORY(&said, &is, sizeof is);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(UBX_003_each_byte_is_as_specified);
    RUN_TEST(UBX_003_noise_is_as_specified);
    RUN_TEST(UBX_015_each_message_is_as_specified);
    return UNITY_END();
}
