/* SPDX-License-Identifier: Apache-2.0 */
/* The SBUS decoder beside its executable specification (specs/model): random frames, disturbed and
 * not, with gaps and without, to both; after each byte every field must be the same. */
#include "any.h"
#include "keel/middleware/sbus.h"
#include "unity.h"

#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/sbus.c"

#define FRAMES 20000u
#define SEED   20261124u

static keel_sbus_t sbus;
static keel_sbus_t model;
static uint32_t taken;

void setUp(void)
{
    any_from(SEED);
    memset(&sbus, 0, sizeof sbus);
    memset(&model, 0, sizeof model);
    taken = 0u;
}

void tearDown(void)
{
}

static void set_up(void)
{
    keel_sbus_config_t config;
    keel_status_t expected;

    memset(&config, 0, sizeof config);
    config.gap_us = one_in(16u) ? any() % 3u : 1000u;
    config.lowest = (uint16_t)(one_in(2u) ? 172u : (any() % 600u));
    config.highest = (uint16_t)(one_in(2u) ? 1811u : (1500u + (any() % 600u)));
    config.judged = (uint16_t)(one_in(4u) ? 0xFFFFu : (1u << (any() % 16u)));
    expected = model_sbus_init(&model, &config);
    TEST_ASSERT_EQUAL(expected, keel_sbus_init(&sbus, &config));
    if (one_in(8u) && (expected == KEEL_OK)) {
        memset(&sbus.count, 0xFF, sizeof sbus.count);
        memset(&model.count, 0xFF, sizeof model.count);
    }
}

static void both_take(uint8_t byte, uint32_t elapsed_us)
{
    const bool expected = model_sbus_take(&model, byte, elapsed_us);

    TEST_ASSERT_EQUAL(expected, keel_sbus_take(&sbus, byte, elapsed_us));
    TEST_ASSERT_EQUAL_MEMORY(&model, &sbus, sizeof sbus);
    taken += expected ? 1u : 0u;
}

static void any_frame(uint8_t *frame)
{
    const uint8_t footers[6] = {0x00, 0x00, 0x04, 0x14, 0x24, 0x34};

    frame[0] = 0x0Fu;
    for (uint32_t i = 1u; i < 23u; i++) {
        const uint8_t middle[11] = {0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07,
                                    0x3E, 0xF0, 0x81, 0x0F, 0x7C};

        frame[i] = one_in(64u) ? (uint8_t)any() : middle[(i - 1u) % 11u];
    }
    frame[23] = one_in(8u) ? (uint8_t)any() : (uint8_t)(any() % 16u);
    frame[24] = one_in(8u) ? (uint8_t)any() : footers[any() % 6u];
}

static void RAD_003_each_byte_is_as_specified(void)
{
    for (uint32_t n = 0u; n < FRAMES; n++) {
        uint8_t frame[25];

        if ((n % 256u) == 0u) {
            set_up();
        }
        any_frame(frame);
        for (uint32_t i = 0u; i < 25u; i++) {
            const bool pause = (i == 0u) ? one_in(2u) : one_in(512u);

            if (one_in(256u)) {
                both_take((uint8_t)(one_in(2u) ? 0x0Fu : any()), 120u);
            }
            if (!one_in(256u)) {
                both_take(frame[i], pause ? any() % 4000u : 120u);
            }
        }
        if (one_in(4u)) {
            const uint32_t elapsed_us = one_in(64u) ? any() : 4000u;

            model_sbus_pass_time(&model, elapsed_us);
            keel_sbus_pass_time(&sbus, elapsed_us);
            TEST_ASSERT_EQUAL_MEMORY(&model, &sbus, sizeof sbus);
        }
    }
    TEST_ASSERT_TRUE(taken > (FRAMES / 10u));
}

static void RAD_003_noise_is_as_specified(void)
{
    const uint8_t often[4] = {0x0F, 0x00, 0x04, 0x0F};

    set_up();
    for (uint32_t n = 0u; n < (FRAMES * 5u); n++) {
        both_take(one_in(2u) ? often[any() % 4u] : (uint8_t)any(), any() % 1100u);
    }
}

static void RAD_012_each_pulse_is_as_specified(void)
{
    for (uint32_t raw = 0u; raw <= UINT16_MAX; raw++) {
        TEST_ASSERT_EQUAL_UINT16(model_sbus_us((uint16_t)raw), keel_sbus_us((uint16_t)raw));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(RAD_003_each_byte_is_as_specified);
    RUN_TEST(RAD_003_noise_is_as_specified);
    RUN_TEST(RAD_012_each_pulse_is_as_specified);
    return UNITY_END();
}
