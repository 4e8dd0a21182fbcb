/* SPDX-License-Identifier: Apache-2.0 */
/* The PPM decoder beside its executable specification (specs/model): random frames, disturbed and
 * not; after each edge every field must be the same. */
#include "any.h"
#include "keel/middleware/ppm.h"
#include "unity.h"

#include <string.h>

/* The models are part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/framing.c"
#include "../../specs/model/ppm.c"

#define FRAMES 40000u
#define SEED   20261127u

static keel_ppm_t ppm;
static keel_ppm_t model;
static uint32_t taken;

void setUp(void)
{
    any_from(SEED);
    memset(&ppm, 0, sizeof ppm);
    memset(&model, 0, sizeof model);
    taken = 0u;
}

void tearDown(void)
{
}

static void set_up(void)
{
    keel_ppm_config_t config;
    keel_status_t expected;

    memset(&config, 0, sizeof config);
    config.lost_us = one_in(16u) ? any() % 5000u : 100000u;
    config.lowest_us = (uint16_t)(one_in(16u) ? (any() % 3000u) : 800u);
    config.highest_us = (uint16_t)(one_in(16u) ? (any() % 3000u) : 2200u);
    config.sync_us = (uint16_t)(one_in(16u) ? (any() % 6000u) : 2300u);
    config.judged = (uint16_t)(one_in(4u) ? 0xFFFFu : any());
    config.least = (uint8_t)(any() % 18u);
    config.frames_to_take = (uint8_t)(any() % 5u);
    expected = model_ppm_init(&model, &config);
    TEST_ASSERT_EQUAL(expected, keel_ppm_init(&ppm, &config));
    if (one_in(8u) && (expected == KEEL_OK)) {
        memset(&ppm.count, 0xFF, sizeof ppm.count);
        memset(&model.count, 0xFF, sizeof model.count);
    }
}

static void both_take(uint32_t elapsed_us)
{
    const bool expected = model_ppm_take(&model, elapsed_us);

    TEST_ASSERT_EQUAL(expected, keel_ppm_take(&ppm, elapsed_us));
    TEST_ASSERT_EQUAL_MEMORY(&model, &ppm, sizeof ppm);
    TEST_ASSERT_EQUAL(model_ppm_is_lost(&model), keel_ppm_is_lost(&ppm));
    taken += expected ? 1u : 0u;
}

static void PPM_003_each_edge_is_as_specified(void)
{
    uint32_t channels = 8u;

    set_up();
    for (uint32_t n = 0u; n < FRAMES; n++) {
        if (one_in(256u)) {
            set_up();
        }
        channels = one_in(32u) ? any() % 19u : channels;
        for (uint32_t i = 0u; i < channels; i++) {
            if (!one_in(256u)) {
                both_take(one_in(256u) ? any() % 5000u : 1000u + (any() % 1000u));
            }
        }
        if (one_in(8u)) {
            const uint32_t elapsed_us = one_in(64u) ? any() : 2000u;

            model_ppm_pass_time(&model, elapsed_us);
            keel_ppm_pass_time(&ppm, elapsed_us);
            TEST_ASSERT_EQUAL_MEMORY(&model, &ppm, sizeof ppm);
        }
        both_take(one_in(64u) ? any() % 200000u : 4000u);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(FRAMES / 10u, taken);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PPM_003_each_edge_is_as_specified);
    return UNITY_END();
}
