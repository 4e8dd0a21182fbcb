/* SPDX-License-Identifier: Apache-2.0 */
/* The IBUS decoder beside its executable specification (specs/model): random frames, disturbed and
 * not, with gaps and without, to both; after each byte every field must be the same. */
#include "any.h"
#include "keel/middleware/ibus.h"
#include "unity.h"

#include <string.h>

/* The models are part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/framing.c"
#include "../../specs/model/framing_parts.c"
#include "../../specs/model/ibus.c"

#define FRAMES 20000u
#define SEED   20261126u

static keel_ibus_t ibus;
static keel_ibus_t model;
static uint32_t taken;

void setUp(void)
{
    any_from(SEED);
    memset(&ibus, 0, sizeof ibus);
    memset(&model, 0, sizeof model);
    taken = 0u;
}

void tearDown(void)
{
}

static void set_up(void)
{
    keel_ibus_config_t config;
    keel_status_t expected;

    memset(&config, 0, sizeof config);
    config.gap_us = one_in(16u) ? any() % 3u : 500u;
    config.lowest = (uint16_t)(one_in(2u) ? 900u : (any() % 1100u));
    config.highest = (uint16_t)(one_in(2u) ? 2100u : (1000u + (any() % 3500u)));
    config.extended = one_in(2u);
    config.judged = one_in(4u) ? 0x3FFFFu : ((uint32_t)1u << (any() % 18u));
    expected = model_ibus_init(&model, &config);
    TEST_ASSERT_EQUAL(expected, keel_ibus_init(&ibus, &config));
    if (one_in(8u) && (expected == KEEL_OK)) {
        memset(&ibus.count, 0xFF, sizeof ibus.count);
        memset(&model.count, 0xFF, sizeof model.count);
    }
}

static void both_take(uint8_t byte, uint32_t elapsed_us)
{
    const bool expected = model_ibus_take(&model, byte, elapsed_us);

    TEST_ASSERT_EQUAL(expected, keel_ibus_take(&ibus, byte, elapsed_us));
    TEST_ASSERT_EQUAL_MEMORY(&model, &ibus, sizeof ibus);
    taken += expected ? 1u : 0u;
}

/* Mostly plausible channels, upper bits as of channels of 1500 us, and a right sum. */
static void any_frame(uint8_t *frame)
{
    const uint16_t upper[3] = {0xC000u, 0xD000u, 0x5000u};
    uint32_t left = 0xFFFFu - 0x60u;

    frame[0] = 0x20u;
    frame[1] = 0x40u;
    for (uint32_t i = 0u; i < 14u; i++) {
        const uint32_t plain = one_in(512u) ? any() : 1000u + (any() % 1000u);
        const uint32_t word = plain + (ibus.config.extended ? upper[i % 3u] : 0u);

        frame[2u + (2u * i)] = (uint8_t)word;
        frame[3u + (2u * i)] = (uint8_t)(word >> 8);
        left -= (uint32_t)frame[2u + (2u * i)] + frame[3u + (2u * i)];
    }
    frame[30] = (uint8_t)left;
    frame[31] = (uint8_t)(left >> 8);
    if (one_in(8u)) {
        frame[any() % 32u] = (uint8_t)any();
    }
}

static void IBU_003_each_byte_is_as_specified(void)
{
    for (uint32_t n = 0u; n < FRAMES; n++) {
        uint8_t frame[32];

        if ((n % 256u) == 0u) {
            set_up();
        }
        any_frame(frame);
        for (uint32_t i = 0u; i < 32u; i++) {
            const bool pause = (i == 0u) ? one_in(2u) : one_in(512u);

            if (one_in(256u)) {
                both_take((uint8_t)(one_in(2u) ? 0x20u : any()), 87u);
            }
            if (!one_in(256u)) {
                both_take(frame[i], pause ? any() % 4000u : 87u);
            }
        }
        if (one_in(4u)) {
            const uint32_t elapsed_us = one_in(64u) ? any() : 4000u;

            model_ibus_pass_time(&model, elapsed_us);
            keel_ibus_pass_time(&ibus, elapsed_us);
            TEST_ASSERT_EQUAL_MEMORY(&model, &ibus, sizeof ibus);
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(FRAMES / 10u, taken);
}

static void IBU_003_noise_is_as_specified(void)
{
    const uint8_t often[4] = {0x20, 0x40, 0x40, 0x20};

    set_up();
    for (uint32_t n = 0u; n < (FRAMES * 5u); n++) {
        both_take(one_in(4u) ? (uint8_t)any() : often[any() % 4u], any() % 505u);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(IBU_003_each_byte_is_as_specified);
    RUN_TEST(IBU_003_noise_is_as_specified);
    return UNITY_END();
}
