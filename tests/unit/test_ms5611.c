/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/ms5611.h. The first sample is the example of the data sheet; the
 * others are its formulas, worked out by hand:
 *
 * D2 =           8273150    7974190    7233450
 * dT            - 293634   - 592594  - 1333334   D2 - 2^8 33464
 * TEMP              1009          0     - 2500   2000 + 28312 dT / 2^23
 * T2                  40        163        827   dT^2 / 2^31
 * OFF         2366441993 2312063971 2177330310   2^16 36924 + 23282 dT / 2^7
 * SENS        1288136755 1260906871 1193438767   2^15 40127 + 23317 dT / 2^8
 * OFF2           2455202   10000000   57625000   5 (TEMP - 2000)^2 / 2, + 7 (TEMP + 1500)^2
 * SENS2          1227601    5000000   30812500   5 (TEMP - 2000)^2 / 4, + 11 (TEMP + 1500)^2 / 2
 * TEMP - T2          969      - 163     - 3327
 * P                98000      95791      89023   of D1 = 9085466 */
#include "keel/middleware/ms5611.h"
#include "unity.h"

#include <string.h>

#define D1 9085466u
#define D2 8569150u

/* The data sheet's coefficients. */
static const keel_ms5611_t typical = {
    .sensitivity = 40127u,
    .offset = 36924u,
    .sensitivity_slope = 23317u,
    .offset_slope = 23282u,
    .reference = 33464u,
    .temperature_slope = 28312u,
};

/* The example of the maker's note on the check (AN520): it is 11. */
static const uint16_t noted[8] = {0x3132, 0x3334, 0x3536, 0x3738, 0x3940, 0x4142, 0x4344, 0x450B};

static keel_ms5611_sample_t sample;

void setUp(void)
{
    memset(&sample, 0xA5, sizeof sample);
}

void tearDown(void)
{
}

static void measures(uint32_t d1, uint32_t d2, int32_t pressure_pa, int32_t temperature_cdeg)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ms5611_compensate(&typical, d1, d2, &sample));
    TEST_ASSERT_EQUAL_INT32(pressure_pa, sample.pressure_pa);
    TEST_ASSERT_EQUAL_INT32(temperature_cdeg, sample.temperature_cdeg);
}

static void refuses(keel_status_t reason, const keel_ms5611_t *ms5611, uint32_t d1, uint32_t d2)
{
    const keel_ms5611_sample_t before = sample;

    TEST_ASSERT_EQUAL(reason, keel_ms5611_compensate(ms5611, d1, d2, &sample));
    TEST_ASSERT_EQUAL_MEMORY(&before, &sample, sizeof sample);
}

static void MSC_001_the_makers_example(void)
{
    TEST_ASSERT_EQUAL_UINT8(11u, keel_ms5611_crc(noted));
}

/* The last byte is not in: its upper half may be anything. */
static void MSC_001_the_last_byte_is_not_in(void)
{
    uint16_t word[8];

    memcpy(word, noted, sizeof word);
    for (uint32_t byte = 0u; byte < 256u; byte++) {
        word[7] = (uint16_t)(0x4500u | byte);
        TEST_ASSERT_EQUAL_UINT8(11u, keel_ms5611_crc(word));
    }
}

/* x^n divided by x^4 + x + 1 leaves x + 1 for n = 4, and so on; its powers repeat after 15. */
static void MSC_001_each_bit_alone(void)
{
    static const uint8_t power[15] = {1u, 2u,  4u, 8u,  3u,  6u,  12u, 11u,
                                      5u, 10u, 7u, 14u, 15u, 13u, 9u};

    for (uint32_t bit = 0u; bit < 120u; bit++) {
        uint16_t word[8] = {0};

        word[bit / 16u] = (uint16_t)(1u << (15u - (bit % 16u)));
        TEST_ASSERT_EQUAL_UINT8(power[(123u - bit) % 15u], keel_ms5611_crc(word));
    }
}

static void MSC_002_one_wrong_bit(void)
{
    keel_ms5611_t ms5611 = typical;

    for (uint32_t bit = 0u; bit < 128u; bit++) {
        uint16_t word[8];

        memcpy(word, noted, sizeof word);
        word[bit / 16u] = (uint16_t)(word[bit / 16u] ^ (1u << (15u - (bit % 16u))));
        if ((bit < 120u) || (bit >= 124u)) {
            TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_ms5611_init(&ms5611, word));
            TEST_ASSERT_EQUAL_MEMORY(&typical, &ms5611, sizeof typical);
        } else {
            TEST_ASSERT_EQUAL(KEEL_OK, keel_ms5611_init(&ms5611, word));
            ms5611 = typical;
        }
    }
}

/* A line that stays low: the check of nothing but zeros would be right. That of nothing but ones is
 * wrong: 8 times 15 ones leave 0, and 15 is said. */
static void MSC_002_a_line_that_does_not_move(void)
{
    keel_ms5611_t ms5611 = typical;
    uint16_t word[8] = {0};

    TEST_ASSERT_EQUAL_UINT8(0u, keel_ms5611_crc(word));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_ms5611_init(&ms5611, word));
    memset(word, 0xFF, sizeof word);
    TEST_ASSERT_EQUAL_UINT8(0u, keel_ms5611_crc(word));
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_ms5611_init(&ms5611, word));
    TEST_ASSERT_EQUAL_MEMORY(&typical, &ms5611, sizeof typical);
}

/* One word that is not 0 is enough: x^123 leaves x^3, 8. */
static void MSC_002_nearly_blank(void)
{
    keel_ms5611_t ms5611 = typical;
    uint16_t word[8] = {[0] = 0x8000u, [7] = 0x0008u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_ms5611_init(&ms5611, word));
    TEST_ASSERT_EQUAL_UINT16(0u, ms5611.sensitivity);
    TEST_ASSERT_EQUAL_UINT16(0u, ms5611.temperature_slope);
}

static void MSC_003_each_coefficient_is_its_word(void)
{
    keel_ms5611_t ms5611;

    memset(&ms5611, 0xA5, sizeof ms5611);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ms5611_init(&ms5611, noted));
    TEST_ASSERT_EQUAL_HEX16(0x3334, ms5611.sensitivity);
    TEST_ASSERT_EQUAL_HEX16(0x3536, ms5611.offset);
    TEST_ASSERT_EQUAL_HEX16(0x3738, ms5611.sensitivity_slope);
    TEST_ASSERT_EQUAL_HEX16(0x3940, ms5611.offset_slope);
    TEST_ASSERT_EQUAL_HEX16(0x4142, ms5611.reference);
    TEST_ASSERT_EQUAL_HEX16(0x4344, ms5611.temperature_slope);
}

static void MSC_004_more_than_24_bits(void)
{
    refuses(KEEL_ERR_INPUT, &typical, 0x1000000u, D2);
    refuses(KEEL_ERR_INPUT, &typical, D1, 0x1000000u);
    refuses(KEEL_ERR_INPUT, &typical, UINT32_MAX, 0u);
    refuses(KEEL_ERR_INPUT, &typical, 0u, UINT32_MAX);
}

static void MSC_005_a_conversion_that_has_not_ended(void)
{
    refuses(KEEL_ERR_STATE, &typical, 0u, D2);
    refuses(KEEL_ERR_STATE, &typical, D1, 0u);
    refuses(KEEL_ERR_STATE, &typical, 0u, 0u);
}

/* A reading is within 24 bits, but what it amounts to is no weather. */
static void MSC_006_the_ends_of_the_readings(void)
{
    refuses(KEEL_ERR_LIMITS, &typical, 1u, D2);
    refuses(KEEL_ERR_LIMITS, &typical, 0xFFFFFFu, D2);
    refuses(KEEL_ERR_VALUE, &typical, D1, 1u);
    refuses(KEEL_ERR_VALUE, &typical, D1, 0xFFFFFFu);
    refuses(KEEL_ERR_VALUE, &typical, 0xFFFFFFu, 0xFFFFFFu);
}

/* At dT = 2366, OFF = 2420281617 and SENS = 1315097036: 1000 Pa begin where D1 SENS / 2^21 is at
 * least 2453049617, 120000 Pa end where it is at least 6352474385. */
static void MSC_006_the_pressures_that_it_is_made_for(void)
{
    measures(3911817u, D2, 1000, 2007);
    refuses(KEEL_ERR_LIMITS, &typical, 3911816u, D2);
    measures(10130130u, D2, 120000, 2007);
    refuses(KEEL_ERR_LIMITS, &typical, 10130131u, D2);
}

/* dT = 1926191 is 6500.997 above 2000, and a step more 6501.0; dT = -1477106 is 4985.3 below, which
 * dT^2 / 2^31 = 1015.9994 makes -4000, and a step less is 1016.0008. */
static void MSC_006_the_temperatures_that_it_is_made_for(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ms5611_compensate(&typical, D1, 10492975u, &sample));
    TEST_ASSERT_EQUAL_INT32(8500, sample.temperature_cdeg);
    refuses(KEEL_ERR_VALUE, &typical, D1, 10492976u);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ms5611_compensate(&typical, D1, 7089678u, &sample));
    TEST_ASSERT_EQUAL_INT32(-4000, sample.temperature_cdeg);
    refuses(KEEL_ERR_VALUE, &typical, D1, 7089677u);
}

static void MSC_007_the_example_of_the_data_sheet(void)
{
    measures(D1, D2, 100009, 2007);
}

static void MSC_008_below_20_degrees(void)
{
    measures(D1, 8273150u, 98000, 969);
    measures(D1, 7974190u, 95791, -163);
}

static void MSC_008_below_minus_15_degrees(void)
{
    measures(D1, 7233450u, 89023, -3327);
}

/* At dT = 0 it is 20 degrees: OFF = 2^16 36924 = 2419851264, SENS = 2^15 40127 = 1314881536,
 * D1 SENS / 2^21 = 5696445221. */
static void MSC_007_at_the_reference(void)
{
    measures(D1, 8566784u, 99993, 2000);
}

/* Every coefficient and reading at its end: the sanitizer looks on. */
static void MSC_007_every_end(void)
{
    for (uint32_t ends = 0u; ends < 64u; ends++) {
        const keel_ms5611_t ms5611 = {
            .sensitivity = ((ends & 1u) != 0u) ? UINT16_MAX : 0u,
            .offset = ((ends & 2u) != 0u) ? UINT16_MAX : 0u,
            .sensitivity_slope = ((ends & 4u) != 0u) ? UINT16_MAX : 0u,
            .offset_slope = ((ends & 8u) != 0u) ? UINT16_MAX : 0u,
            .reference = ((ends & 16u) != 0u) ? UINT16_MAX : 0u,
            .temperature_slope = ((ends & 32u) != 0u) ? UINT16_MAX : 0u,
        };
        static const uint32_t reading[4] = {1u, 0x7FFFFFu, 0x800000u, 0xFFFFFFu};

        for (uint32_t i = 0u; i < 16u; i++) {
            const keel_status_t status = keel_ms5611_compensate(&ms5611, reading[i / 4u],
                                                                reading[i % 4u], &sample);

            TEST_ASSERT_TRUE((status == KEEL_OK) || (status == KEEL_ERR_VALUE) ||
                             (status == KEEL_ERR_LIMITS));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MSC_001_the_makers_example);
    RUN_TEST(MSC_001_the_last_byte_is_not_in);
    RUN_TEST(MSC_001_each_bit_alone);
    RUN_TEST(MSC_002_one_wrong_bit);
    RUN_TEST(MSC_002_a_line_that_does_not_move);
    RUN_TEST(MSC_002_nearly_blank);
    RUN_TEST(MSC_003_each_coefficient_is_its_word);
    RUN_TEST(MSC_004_more_than_24_bits);
    RUN_TEST(MSC_005_a_conversion_that_has_not_ended);
    RUN_TEST(MSC_006_the_ends_of_the_readings);
    RUN_TEST(MSC_006_the_pressures_that_it_is_made_for);
    RUN_TEST(MSC_006_the_temperatures_that_it_is_made_for);
    RUN_TEST(MSC_007_the_example_of_the_data_sheet);
    RUN_TEST(MSC_007_at_the_reference);
    RUN_TEST(MSC_008_below_20_degrees);
    RUN_TEST(MSC_008_below_minus_15_degrees);
    RUN_TEST(MSC_007_every_end);
    return UNITY_END();
}
