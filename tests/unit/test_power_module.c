/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/power_module.h. What is expected is worked out by hand, or in
 * double precision. */
#include "any.h"
#include "keel/middleware/power_module.h"
#include "unity.h"

#include <math.h>
#include <string.h>

/* 3300 mV times 18.1 is 59730 mV for 4096 counts; times 36.367515 A/V it is 120012.7995 mA. */
static const keel_power_module_config_t board = {
    .reference_mv = 3300u, .divider = 18100000u, .ua_per_v = 36367515u, .open_mv = 5600u};

static keel_power_module_t module;
static keel_power_module_reading_t reading;

void setUp(void)
{
    memset(&module, 0xA5, sizeof module);
    memset(&reading, 0xA5, sizeof reading);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_power_module_init(&module, &board));
}

void tearDown(void)
{
}

static void read_is(uint16_t voltage, uint16_t current, uint32_t millivolts, uint32_t milliamperes,
                    uint32_t told)
{
    keel_power_module_read(&module, voltage, current, &reading);
    TEST_ASSERT_EQUAL_UINT32(millivolts, reading.voltage_mv);
    TEST_ASSERT_EQUAL_UINT32(milliamperes, reading.current_ma);
    TEST_ASSERT_EQUAL_UINT32(told, reading.told);
}

/* A value of 0 and one above the limit, in each of three places. */
static void PMD_001_refuses_what_is_out_of_range(void)
{
    const keel_power_module_t before = module;
    const uint32_t wrong[6][3] = {{0u, 1u, 1u},          {5001u, 1u, 1u}, {1u, 0u, 1u},
                                  {1u, 1000000001u, 1u}, {1u, 1u, 0u},    {1u, 1u, 1000000001u}};

    for (uint32_t i = 0u; i < 6u; i++) {
        const keel_power_module_config_t config = {
            .reference_mv = wrong[i][0], .divider = wrong[i][1], .ua_per_v = wrong[i][2]};

        TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_power_module_init(&module, &config));
        TEST_ASSERT_EQUAL_MEMORY(&before, &module, sizeof module);
    }
}

/* 4095 * 5000 * 10^9 / (4096 * 10^6) is 4998779.296875. */
static void PMD_002_takes_the_ends(void)
{
    keel_power_module_config_t config = {
        .reference_mv = 5000u, .divider = 1000000000u, .ua_per_v = 1000000000u, .open_mv = 0u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_power_module_init(&module, &config));
    read_is(4095u, 4095u, 4998779u, 4998779u, 6u);
    config.reference_mv = 1u;
    config.divider = 1u;
    config.ua_per_v = 1u;
    config.open_mv = UINT32_MAX;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_power_module_init(&module, &config));
    read_is(4094u, 4094u, 0u, 0u, 1u);
}

static void PMD_003_known_readings(void)
{
    read_is(0u, 0u, 0u, 0u, KEEL_POWER_MODULE_OPEN);
    read_is(1024u, 1024u, 14933u, 30003u, 0u); /* 14932.5, 30003.2 */
    read_is(1098u, 205u, 16012u, 6006u, 0u);   /* 16011.6, 6006.49997 */
    read_is(1100u, 385u, 16041u, 11280u, 0u);  /* 16040.8, 11280.49995 */
}

/* Every count, beside double precision: within half a unit, and a bit for the product. */
static void PMD_003_every_count(void)
{
    for (uint32_t count = 0u; count <= 4095u; count++) {
        const double volts = (double)count * 59730.0 / 4096.0;
        const double amperes = (double)count * 120012.7995 / 4096.0;

        keel_power_module_read(&module, (uint16_t)count, (uint16_t)count, &reading);
        TEST_ASSERT_TRUE(fabs((double)reading.voltage_mv - volts) <= 0.5);
        TEST_ASSERT_TRUE(fabs((double)reading.current_ma - amperes) <= 0.5);
    }
}

static void PMD_003_any_configuration(void)
{
    any_from(20261124u);
    for (uint32_t n = 0u; n < 20000u; n++) {
        const keel_power_module_config_t config = {.reference_mv = 1u + (any() % 5000u),
                                                   .divider = 1u + (any() % 1000000000u),
                                                   .ua_per_v = 1u + (any() % 1000000000u),
                                                   .open_mv = any() % 10000u};
        const uint16_t voltage = (uint16_t)(any() % 4096u);
        const uint16_t current = (uint16_t)(any() % 4096u);
        const double full = (double)config.reference_mv / 4096.0e6;

        TEST_ASSERT_EQUAL(KEEL_OK, keel_power_module_init(&module, &config));
        keel_power_module_read(&module, voltage, current, &reading);
        TEST_ASSERT_TRUE(fabs((double)reading.voltage_mv -
                              ((double)voltage * full * (double)config.divider)) <= 0.5001);
        TEST_ASSERT_TRUE(fabs((double)reading.current_ma -
                              ((double)current * full * (double)config.ua_per_v)) <= 0.5001);
    }
}

/* 384 counts are 5599.7 mV, 385 are 5614.3. */
static void PMD_004_an_open_input_is_told(void)
{
    read_is(384u, 0u, 5600u, 0u, KEEL_POWER_MODULE_OPEN);
    read_is(385u, 0u, 5614u, 0u, 0u);
}

static void PMD_005_a_full_count_is_told(void)
{
    read_is(4094u, 4094u, 59701u, 119954u, 0u); /* 59700.8, 119954.2 */
    read_is(4095u, 0u, 59715u, 0u, KEEL_POWER_MODULE_TOP_VOLTAGE);
    read_is(1024u, 4095u, 14933u, 119983u, KEEL_POWER_MODULE_TOP_CURRENT);
    read_is(4096u, UINT16_MAX, 59715u, 119983u,
            KEEL_POWER_MODULE_TOP_VOLTAGE | KEEL_POWER_MODULE_TOP_CURRENT);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PMD_001_refuses_what_is_out_of_range);
    RUN_TEST(PMD_002_takes_the_ends);
    RUN_TEST(PMD_003_known_readings);
    RUN_TEST(PMD_003_every_count);
    RUN_TEST(PMD_003_any_configuration);
    RUN_TEST(PMD_004_an_open_input_is_told);
    RUN_TEST(PMD_005_a_full_count_is_told);
    return UNITY_END();
}
