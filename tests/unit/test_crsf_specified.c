/* SPDX-License-Identifier: Apache-2.0 */
/* The CRSF decoder beside its executable specification (specs/model): random frames, disturbed and
 * not, with gaps and without, to both; after each byte every field must be the same. */
#include "any.h"
#include "keel/middleware/crsf.h"
#include "unity.h"

#include <string.h>

/* The models are part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/crc.c"
#include "../../specs/model/crsf.c"
#include "../../specs/model/crsf_parts.c"
#include "../../specs/model/framing.c"
#include "../../specs/model/framing_parts.c"

#define FRAMES 20000u
#define SEED   20261125u

static keel_crsf_t crsf;
static keel_crsf_t model;
static uint32_t taken[5];

void setUp(void)
{
    any_from(SEED);
    memset(&crsf, 0, sizeof crsf);
    memset(&model, 0, sizeof model);
    memset(taken, 0, sizeof taken);
}

void tearDown(void)
{
}

static void set_up(void)
{
    keel_crsf_config_t config;
    keel_status_t expected;

    memset(&config, 0, sizeof config);
    config.gap_us = one_in(16u) ? any() % 3u : 300u;
    config.channels_us = one_in(16u) ? any() % 3u : 20000u;
    config.link_us = one_in(4u) ? 0u : 40000u;
    expected = model_crsf_init(&model, &config);
    TEST_ASSERT_EQUAL(expected, keel_crsf_init(&crsf, &config));
    if (one_in(8u) && (expected == KEEL_OK)) {
        memset(&crsf.count, 0xFF, sizeof crsf.count);
        memset(&model.count, 0xFF, sizeof model.count);
    }
}

static void both_are_the_same(void)
{
    TEST_ASSERT_EQUAL_MEMORY(&model, &crsf, sizeof crsf);
    TEST_ASSERT_EQUAL(model_crsf_is_lost(&model), keel_crsf_is_lost(&crsf));
}

static void both_take(uint8_t byte, uint32_t elapsed_us)
{
    const keel_crsf_taken_t expected = model_crsf_take(&model, byte, elapsed_us);

    TEST_ASSERT_EQUAL(expected, keel_crsf_take(&crsf, byte, elapsed_us));
    both_are_the_same();
    taken[expected]++;
}

/* Of the types that are understood, of others, shorter and longer; its CRC is mostly right. */
static uint32_t any_frame(uint8_t *frame)
{
    const uint8_t headers[4] = {0xC8, 0x00, 0xEC, 0xEE};
    const uint8_t types[4] = {0x16, 0x14, 0x2B, 0xC8};
    const uint8_t lengths[4] = {24, 12, 4, 62};
    const uint32_t k = any() % 4u;
    const uint32_t length = one_in(8u) ? 2u + (any() % 61u) : lengths[k];

    for (uint32_t i = 0u; i < 64u; i++) {
        frame[i] = one_in(16u) ? 0xC8u : (uint8_t)any();
    }
    frame[0] = headers[any() % 4u];
    frame[1] = (uint8_t)length;
    frame[2] = types[k];
    frame[length + 1u] = model_crsf_crc(&frame[2], length - 1u);
    if (one_in(8u)) {
        frame[any() % (length + 2u)] = (uint8_t)any();
    }
    return length + 2u;
}

static void CRF_003_each_byte_is_as_specified(void)
{
    for (uint32_t n = 0u; n < FRAMES; n++) {
        uint8_t frame[64];
        uint32_t size;

        if ((n % 256u) == 0u) {
            set_up();
        }
        size = any_frame(frame);
        for (uint32_t i = 0u; i < size; i++) {
            const bool pause = (i == 0u) ? one_in(2u) : one_in(512u);

            if (one_in(256u)) {
                both_take((uint8_t)(one_in(2u) ? 0xC8u : any()), 24u);
            }
            if (!one_in(256u)) {
                both_take(frame[i], pause ? any() % 1000u : 24u);
            }
        }
        if (one_in(4u)) {
            const uint32_t elapsed_us = one_in(64u) ? any() : 4000u;

            model_crsf_pass_time(&model, elapsed_us);
            keel_crsf_pass_time(&crsf, elapsed_us);
            both_are_the_same();
        }
    }
    for (uint32_t k = 1u; k < 5u; k++) {
        TEST_ASSERT_TRUE(taken[k] >
                         ((k == (uint32_t)KEEL_CRSF_TOOK_SHORT) ? 200u : (FRAMES / 10u)));
    }
}

/* Short frames and headers, so that what is held has several frames in it. */
static void CRF_003_noise_is_as_specified(void)
{
    const uint8_t often[4] = {0xC8, 0x02, 0x03, 0x3E};

    set_up();
    for (uint32_t n = 0u; n < (FRAMES * 5u); n++) {
        const uint8_t last = (crsf.framing.held > 2u)
                                 ? model_crsf_crc(&crsf.framing.byte[2], crsf.framing.held - 2u)
                                 : 0u;
        const uint8_t byte = one_in(2u) ? often[any() % 4u] : (uint8_t)any();

        both_take(one_in(3u) ? last : byte, one_in(64u) ? any() % 400u : 24u);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(300u, taken[KEEL_CRSF_TOOK_OTHER]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CRF_003_each_byte_is_as_specified);
    RUN_TEST(CRF_003_noise_is_as_specified);
    return UNITY_END();
}
