/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/ist8310.h with a simulated sensor. Registers, identity, times and
 * scales are those of the maker's register map. */
#include "devices/ist8310.h"
#include "simulated/ist8310.c"
#include "unity.h"

#define PERIOD   10000u
#define ALL_ONES 0xFF
#define ALL_LOW  (-0xFF)

static simulated_ist8310_t sensor;
static keel_ist8310_t device;

void setUp(void)
{
    simulated_ist8310_init(&sensor);
    sensor.field[0] = 264; /* 20 uT forward, 0.5 right and 40 up. */
    sensor.field[1] = 7;
    sensor.field[2] = 528;
    sensor.temperature = 321;
    keel_ist8310_begin(&device, (keel_bus_t){simulated_ist8310_exchange, &sensor});
}

void tearDown(void)
{
}

static keel_bsp_status_t step_after(uint32_t time_us)
{
    simulated_ist8310_pass(&sensor, time_us);
    return keel_ist8310_step(&device, time_us);
}

static void waits(uint32_t time_us)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(time_us));
}

static void measures(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
}

/* Reset and configuration; then it measures. */
static void start(void)
{
    waits(0u);
    waits(50000u);
    TEST_ASSERT_EQUAL(KEEL_IST8310_MEASURING, device.state);
    sensor.faults.exchanges = 0u;
}

static void refuses_after(uint32_t time_us, keel_bsp_status_t reason)
{
    const keel_ist8310_sample_t before = device.sample;
    const uint32_t failures = device.progress.failures;

    TEST_ASSERT_EQUAL(reason, step_after(time_us));
    TEST_ASSERT_EQUAL_MEMORY(&before, &device.sample, sizeof before);
    TEST_ASSERT_EQUAL_UINT32(failures + 1u, device.progress.failures);
}

static void IST_001_it_begins_with_no_sample(void)
{
    TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, device.progress.age_us);
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.failures);
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.faults.exchanges);
}

static void IST_002_it_is_reset_and_given_its_time(void)
{
    waits(0u);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.resets);
    waits(49999u);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
    waits(1u);
    TEST_ASSERT_EQUAL_UINT32(1u + 9u, sensor.faults.exchanges);
}

static void IST_002_a_reset_that_does_not_end(void)
{
    waits(0u);
    sensor.reset_us = 90000u;
    refuses_after(50000u, KEEL_BSP_TIMEOUT);
    TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
}

static void IST_003_another_device(void)
{
    waits(0u);
    sensor.identity = 0x48u;
    refuses_after(50000u, KEEL_BSP_ID);
    TEST_ASSERT_EQUAL_HEX8(0x00u, sensor.value[0x0D]); /* It was not configured. */
}

static void IST_003_a_line_that_does_not_move(void)
{
    waits(0u);
    sensor.faults.line = ALL_LOW;
    refuses_after(50000u, KEEL_BSP_STUCK);
    waits(0u);
    sensor.faults.line = ALL_ONES;
    refuses_after(50000u, KEEL_BSP_STUCK);
}

static void IST_004_it_is_configured(void)
{
    start();
    TEST_ASSERT_EQUAL_HEX8(0x24u, sensor.value[0x41]); /* 16 times: 100b for Y, and for X and Z. */
    TEST_ASSERT_EQUAL_HEX8(0xC0u, sensor.value[0x42]); /* The pulse that the maker asks for. */
    TEST_ASSERT_EQUAL_HEX8(0x70u, sensor.value[0x0D]); /* 16 bits: Z, Y, X. */
    TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x0A]); /* A single measurement. */
}

static void IST_004_what_does_not_read_back(void)
{
    static const int registers[3] = {0x41, 0x42, 0x0D};

    for (uint32_t i = 0u; i < 3u; i++) {
        setUp();
        sensor.stays = registers[i];
        waits(0u);
        refuses_after(50000u, KEEL_BSP_VERIFY);
        TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
        sensor.stays = -1;
        start();
    }
}

/* Whichever setting is looked at next, a brown-out has taken it. */
static void IST_005_a_brown_out(void)
{
    for (uint32_t samples = 0u; samples < 5u; samples++) {
        setUp();
        start();
        for (uint32_t i = 0u; i < samples; i++) {
            measures();
        }
        simulated_ist8310_pass(&sensor, PERIOD);
        simulated_ist8310_brown_out(&sensor);
        sensor.value[0x02] = 1u; /* And a sample is there, a quarter of what it should be. */
        sensor.value[0x03] = 66u;
        refuses_after(PERIOD, KEEL_BSP_VERIFY);
        start();
        measures();
    }
}

static void IST_006_a_measurement_is_given_its_time(void)
{
    start();
    waits(5999u);
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.faults.exchanges);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(1u));
    TEST_ASSERT_EQUAL(KEEL_IST8310_MEASURING, device.state);
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.age_us);
    waits(100u);
    TEST_ASSERT_EQUAL_UINT32(100u, device.progress.age_us);
}

static void IST_006_not_ready_yet(void)
{
    start();
    sensor.measure_us = 20000u;
    waits(19999u);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(1u));
}

static void IST_006_never_ready(void)
{
    start();
    sensor.measure_us = UINT32_MAX;
    waits(29999u);
    refuses_after(1u, KEEL_BSP_TIMEOUT);
    waits(0u); /* It is begun again. */
    measures();
}

static void IST_007_a_sample(void)
{
    start();
    measures();
    TEST_ASSERT_EQUAL_INT16(264, device.sample.field[0]);
    TEST_ASSERT_EQUAL_INT16(7, device.sample.field[1]);
    TEST_ASSERT_EQUAL_INT16(-528, device.sample.field[2]); /* Down. */
    TEST_ASSERT_EQUAL_INT16(321, device.sample.temperature);
}

static void IST_007_the_ends(void)
{
    sensor.field[0] = INT16_MIN;
    sensor.field[1] = INT16_MAX;
    sensor.field[2] = INT16_MIN;
    sensor.temperature = INT16_MIN;
    start();
    measures();
    TEST_ASSERT_EQUAL_INT16(INT16_MIN, device.sample.field[0]);
    TEST_ASSERT_EQUAL_INT16(INT16_MAX, device.sample.field[1]);
    TEST_ASSERT_EQUAL_INT16(INT16_MAX, device.sample.field[2]); /* There is no 32768. */
    TEST_ASSERT_EQUAL_INT16(INT16_MIN, device.sample.temperature);
    sensor.field[2] = INT16_MAX;
    measures();
    TEST_ASSERT_EQUAL_INT16(-32767, device.sample.field[2]);
    sensor.field[2] = -1;
    measures();
    TEST_ASSERT_EQUAL_INT16(1, device.sample.field[2]);
}

static void IST_008_an_overrun_is_counted(void)
{
    start();
    measures();
    TEST_ASSERT_EQUAL_UINT32(0u, device.overruns);
    simulated_ist8310_pass(&sensor, PERIOD);
    sensor.value[0x02] |= 0x02u;
    sensor.field[0] = 300;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ist8310_step(&device, PERIOD));
    TEST_ASSERT_EQUAL_UINT32(1u, device.overruns);
    device.overruns = UINT32_MAX;
    simulated_ist8310_pass(&sensor, PERIOD);
    sensor.value[0x02] |= 0x02u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ist8310_step(&device, PERIOD));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, device.overruns);
}

static void IST_009_a_field_of_one_bit(void)
{
    memset(sensor.field, 0, sizeof sensor.field);
    start();
    refuses_after(PERIOD, KEEL_BSP_STUCK);
    sensor.field[0] = -1;
    sensor.field[1] = -1;
    sensor.field[2] = -1;
    waits(PERIOD);
    refuses_after(PERIOD, KEEL_BSP_STUCK);
    sensor.field[2] = -2;
    waits(PERIOD);
    measures();
}

static void IST_009_a_field_that_does_not_move(void)
{
    start();
    measures();
    for (uint32_t again = 1u; again <= KEEL_IST8310_REPEATS; again++) {
        measures();
    }
    refuses_after(PERIOD, KEEL_BSP_STUCK);
    waits(PERIOD);
    sensor.field[1]++;
    measures();
}

/* The reset, nine exchanges of the start, five of the first sample, and the one that begins the
 * next: each fails once in its turn and is told, but for the last, which is counted. */
static void ist_fails_once(uint32_t at, keel_bsp_status_t error, uint32_t short_at)
{
    uint32_t told = 0u;
    bool measured = false;

    setUp();
    sensor.faults.fails_from = at;
    sensor.faults.fails_for = (short_at == 0u) ? 1u : 0u;
    sensor.faults.error = error;
    sensor.faults.short_at = short_at;
    for (uint32_t i = 0u; (i < 30u) && !measured; i++) {
        const keel_bsp_status_t status = step_after(PERIOD);

        measured = status == KEEL_BSP_OK;
        if ((status != KEEL_BSP_OK) && (status != KEEL_BSP_WAIT)) {
            TEST_ASSERT_EQUAL((short_at == 0u) ? error : KEEL_BSP_SHORT, status);
            told++;
        }
    }
    TEST_ASSERT_TRUE(measured);
    TEST_ASSERT_EQUAL_UINT32(1u, device.progress.failures);
    TEST_ASSERT_EQUAL_UINT32((at == 15u) ? 0u : 1u, told);
    TEST_ASSERT_EQUAL_INT16(-528, device.sample.field[2]);
}

static void IST_010_a_failure_at_any_exchange(void)
{
    for (uint32_t at = 1u; at <= 15u; at++) {
        ist_fails_once(at, KEEL_BSP_BUS, 0u);
        ist_fails_once(at, KEEL_BSP_TIMEOUT, 0u);
        ist_fails_once(at, KEEL_BSP_OK, at);
    }
}

static void IST_011_many_failures_reset_it(void)
{
    start();
    sensor.faults.fails_from = 1u;
    sensor.faults.fails_for = KEEL_IST8310_FAILURES;
    sensor.faults.error = KEEL_BSP_BUS;
    for (uint32_t i = 0u; i < KEEL_IST8310_FAILURES; i++) {
        TEST_ASSERT_EQUAL_UINT32(1u, sensor.resets);
        refuses_after(PERIOD, KEEL_BSP_BUS);
    }
    TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
    waits(PERIOD);
    TEST_ASSERT_EQUAL_UINT32(2u, sensor.resets);
    waits(50000u);
    measures();
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.in_row);
}

/* The failure to begin the next measurement is the tenth in a row, behind nine without a sample:
 * but the sample ends the row. */
static void IST_011_a_sample_ends_a_row_of_failures(void)
{
    start();
    sensor.faults.fails_from = 1u;
    sensor.faults.fails_for = KEEL_IST8310_FAILURES - 1u;
    sensor.faults.error = KEEL_BSP_BUS;
    for (uint32_t i = 0u; i < (KEEL_IST8310_FAILURES - 1u); i++) {
        refuses_after(PERIOD, KEEL_BSP_BUS);
    }
    waits(PERIOD);
    sensor.faults.exchanges = 0u;
    sensor.faults.fails_from = 5u;
    sensor.faults.fails_for = 1u;
    measures();
    TEST_ASSERT_EQUAL_UINT32(KEEL_IST8310_FAILURES, device.progress.failures);
    TEST_ASSERT_EQUAL_UINT32(1u, device.progress.in_row);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.resets);
}

/* A step makes nine exchanges at most, whatever happens. */
static void IST_012_no_step_is_long(void)
{
    for (uint32_t i = 0u; i < 2000u; i++) {
        sensor.faults.exchanges = 0u;
        sensor.faults.fails_from = i % 7u;
        sensor.faults.fails_for = ((i / 64u) % 2u == 0u) ? 0u : 1u;
        sensor.faults.error = KEEL_BSP_BUS;
        (void)step_after(i % 97u * 200u);
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(9u, sensor.faults.exchanges);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(0u, device.progress.failures);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(IST_001_it_begins_with_no_sample);
    RUN_TEST(IST_002_it_is_reset_and_given_its_time);
    RUN_TEST(IST_002_a_reset_that_does_not_end);
    RUN_TEST(IST_003_another_device);
    RUN_TEST(IST_003_a_line_that_does_not_move);
    RUN_TEST(IST_004_it_is_configured);
    RUN_TEST(IST_004_what_does_not_read_back);
    RUN_TEST(IST_005_a_brown_out);
    RUN_TEST(IST_006_a_measurement_is_given_its_time);
    RUN_TEST(IST_006_not_ready_yet);
    RUN_TEST(IST_006_never_ready);
    RUN_TEST(IST_007_a_sample);
    RUN_TEST(IST_007_the_ends);
    RUN_TEST(IST_008_an_overrun_is_counted);
    RUN_TEST(IST_009_a_field_of_one_bit);
    RUN_TEST(IST_009_a_field_that_does_not_move);
    RUN_TEST(IST_010_a_failure_at_any_exchange);
    RUN_TEST(IST_011_many_failures_reset_it);
    RUN_TEST(IST_011_a_sample_ends_a_row_of_failures);
    RUN_TEST(IST_012_no_step_is_long);
    return UNITY_END();
}
