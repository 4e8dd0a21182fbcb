/* SPDX-License-Identifier: Apache-2.0 */
/* The MS5611's formulas beside their executable specification (specs/model): random PROMs and
 * readings, at their ends and between, to both; status and result must be the same. */
#include "any.h"
#include "keel/middleware/ms5611.h"
#include "unity.h"

#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/ms5611.c"

#define PROMS   20000u
#define SAMPLES 300000u
#define SEED    20261123u

void setUp(void)
{
    any_from(SEED);
}

void tearDown(void)
{
}

static uint16_t any_coefficient(void)
{
    static const uint16_t ends[4] = {0u, 1u, 0xFFFEu, 0xFFFFu};

    return one_in(4u) ? ends[any() % 4u] : (uint16_t)any();
}

static uint32_t any_reading(void)
{
    static const uint32_t ends[6] = {0u, 1u, 0xFFFFFEu, 0xFFFFFFu, 0x1000000u, UINT32_MAX};

    return one_in(64u) ? ends[any() % 6u] : (any() & 0xFFFFFFu);
}

/* Near those of a real sensor, or anywhere. */
static keel_ms5611_t any_coefficients(void)
{
    static const uint16_t real[6] = {40127u, 36924u, 23317u, 23282u, 33464u, 28312u};
    uint16_t value[6];

    for (uint32_t i = 0u; i < 6u; i++) {
        value[i] = (uint16_t)((real[i] - 2000u) + (any() % 4000u));
    }
    if (one_in(2u)) {
        for (uint32_t i = 0u; i < 6u; i++) {
            value[i] = any_coefficient();
        }
    }
    return (keel_ms5611_t){value[0], value[1], value[2], value[3], value[4], value[5]};
}

static void MSC_002_each_prom_is_as_specified(void)
{
    uint32_t taken = 0u;

    for (uint32_t n = 0u; n < PROMS; n++) {
        uint16_t word[8];
        keel_ms5611_t ms5611;
        keel_ms5611_t model;
        keel_status_t expected;

        memset(&ms5611, 0xA5, sizeof ms5611);
        model = ms5611;
        for (uint32_t i = 0u; i < 8u; i++) {
            word[i] = one_in(64u) ? 0u : any_coefficient();
        }
        TEST_ASSERT_EQUAL_UINT8(model_ms5611_crc(word), keel_ms5611_crc(word));
        if (one_in(2u)) {
            word[7] = (uint16_t)((word[7] & 0xFFF0u) | model_ms5611_crc(word));
        }
        if (one_in(64u)) {
            memset(word, 0, sizeof word);
        }
        expected = model_ms5611_init(&model, word);
        TEST_ASSERT_EQUAL(expected, keel_ms5611_init(&ms5611, word));
        TEST_ASSERT_EQUAL_MEMORY(&model, &ms5611, sizeof model);
        taken += (expected == KEEL_OK) ? 1u : 0u;
    }
    TEST_ASSERT_TRUE((taken > (PROMS / 4u)) && (taken < (3u * (PROMS / 4u))));
}

static void MSC_007_each_sample_is_as_specified(void)
{
    uint32_t met[KEEL_ERR_GEOMETRY + 1] = {0u};

    for (uint32_t n = 0u; n < SAMPLES; n++) {
        const keel_ms5611_t ms5611 = any_coefficients();
        const uint32_t d1 = any_reading();
        const uint32_t d2 = one_in(2u) ? (6000000u + (any() % 5000000u)) : any_reading();
        keel_ms5611_sample_t sample = {-1, -1};
        keel_ms5611_sample_t model = sample;
        const keel_status_t expected = model_ms5611_compensate(&ms5611, d1, d2, &model);

        TEST_ASSERT_EQUAL(expected, keel_ms5611_compensate(&ms5611, d1, d2, &sample));
        TEST_ASSERT_EQUAL_MEMORY(&model, &sample, sizeof sample);
        met[expected]++;
    }
    TEST_ASSERT_TRUE(met[KEEL_OK] > (SAMPLES / 20u));
    TEST_ASSERT_TRUE(met[KEEL_ERR_INPUT] > 100u);
    TEST_ASSERT_TRUE(met[KEEL_ERR_STATE] > 100u);
    TEST_ASSERT_TRUE(met[KEEL_ERR_VALUE] > 100u);
    TEST_ASSERT_TRUE(met[KEEL_ERR_LIMITS] > 100u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MSC_002_each_prom_is_as_specified);
    RUN_TEST(MSC_007_each_sample_is_as_specified);
    return UNITY_END();
}
