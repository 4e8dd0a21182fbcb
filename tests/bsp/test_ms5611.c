/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/ms5611.h with a simulated sensor. Commands, times, coefficients and
 * readings are those of the data sheet's examples. */
#include "devices/ms5611.h"
#include "simulated/ms5611.c"
#include "unity.h"

#define D1       9085466u
#define D2       8569150u
#define PERIOD   10000u
#define ALL_ONES 0xFF
#define ALL_LOW  (-0xFF)

/* The check of the coefficients, behind a maker's word of 0, is 0. */
static const uint16_t prom[8] = {0x0000, 40127, 36924, 23317, 23282, 33464, 28312, 0x0000};

static simulated_ms5611_t sensor;
static keel_ms5611_device_t device;

void setUp(void)
{
    simulated_ms5611_init(&sensor, prom);
    sensor.pressure = D1;
    sensor.temperature = D2;
    keel_ms5611_begin(&device, (keel_bus_t){simulated_ms5611_exchange, &sensor});
}

void tearDown(void)
{
}

static keel_bsp_status_t step_after(uint32_t time_us)
{
    simulated_ms5611_pass(&sensor, time_us);
    return keel_ms5611_step(&device, time_us);
}

static void waits(uint32_t time_us)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(time_us));
}

/* Reset, PROM, temperature; then the pressure is being converted. */
static void start(void)
{
    for (uint32_t i = 0u; i < 3u; i++) {
        waits(PERIOD);
    }
    TEST_ASSERT_EQUAL(KEEL_MS5611_PRESSURE, device.state);
}

static void measure(void)
{
    start();
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
    TEST_ASSERT_EQUAL_INT32(100009, device.sample.pressure_pa);
    TEST_ASSERT_EQUAL_INT32(2007, device.sample.temperature_cdeg);
}

/* A step refuses, tells why, and leaves the sample. */
static void refuses(keel_bsp_status_t reason)
{
    const keel_ms5611_sample_t before = device.sample;
    const uint32_t failures = device.progress.failures;

    TEST_ASSERT_EQUAL(reason, step_after(PERIOD));
    TEST_ASSERT_EQUAL_MEMORY(&before, &device.sample, sizeof before);
    TEST_ASSERT_EQUAL_UINT32(failures + 1u, device.progress.failures);
}

static void MSD_001_it_begins_with_no_sample(void)
{
    TEST_ASSERT_EQUAL(KEEL_MS5611_OFF, device.state);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, device.progress.age_us);
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.failures);
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.faults.exchanges);
}

static void MSD_002_it_is_reset_and_given_its_time(void)
{
    waits(0u);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.resets);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
    waits(2800u);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
    waits(1u);
    TEST_ASSERT_EQUAL_UINT32(1u + 8u + 1u, sensor.faults.exchanges);
    TEST_ASSERT_EQUAL(KEEL_MS5611_TEMPERATURE, device.state);
    TEST_ASSERT_EQUAL_UINT16(40127u, device.coefficients.sensitivity);
    TEST_ASSERT_EQUAL_UINT16(28312u, device.coefficients.temperature_slope);
}

static void MSD_003_a_wrong_bit_of_the_prom(void)
{
    sensor.prom[3] ^= 0x0100u;
    waits(PERIOD);
    refuses(KEEL_BSP_VERIFY);
    sensor.prom[3] ^= 0x0100u;
    waits(PERIOD); /* It is reset again. */
    TEST_ASSERT_EQUAL_UINT32(2u, sensor.resets);
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_MS5611_TEMPERATURE, device.state);
}

static void MSD_003_a_line_that_does_not_move(void)
{
    waits(PERIOD);
    sensor.faults.line = ALL_LOW;
    refuses(KEEL_BSP_STUCK);
    waits(PERIOD);
    sensor.faults.line = ALL_ONES;
    refuses(KEEL_BSP_STUCK);
}

/* Zeros and ones in turn are no line that does not move. */
static void MSD_003_words_of_zeros_and_ones(void)
{
    memset(sensor.prom, 0, sizeof sensor.prom);
    sensor.prom[1] = 0xFFFFu;
    waits(PERIOD);
    refuses(KEEL_BSP_VERIFY);
}

static void MSD_004_each_conversion_is_given_its_time(void)
{
    waits(0u);
    waits(2801u);
    TEST_ASSERT_EQUAL_HEX8(0x58u, sensor.converting); /* D2, 4096 times. */
    sensor.faults.exchanges = 0u;
    waits(9040u);
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.faults.exchanges);
    waits(1u);
    TEST_ASSERT_EQUAL_UINT32(2u, sensor.faults.exchanges);
    TEST_ASSERT_EQUAL_HEX8(0x48u, sensor.converting); /* D1, 4096 times. */
    waits(9040u);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(1u));
    TEST_ASSERT_EQUAL_HEX8(0x58u, sensor.converting);
}

static void MSD_004_fifty_samples_a_second(void)
{
    uint32_t samples = 0u;

    start();
    for (uint32_t i = 0u; i < 100u; i++) {
        sensor.pressure += 7u;
        samples += (step_after(PERIOD) == KEEL_BSP_OK) ? 1u : 0u;
    }
    TEST_ASSERT_EQUAL_UINT32(50u, samples);
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.failures);
}

static void MSD_005_a_sample(void)
{
    measure();
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.age_us);
    waits(PERIOD);
    TEST_ASSERT_EQUAL_UINT32(PERIOD, device.progress.age_us);
    sensor.pressure = 3911817u; /* 1000 Pa at this temperature. */
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
    TEST_ASSERT_EQUAL_INT32(1000, device.sample.pressure_pa);
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.age_us);
}

static void MSD_005_the_age_stays_at_its_end(void)
{
    measure();
    sensor.faults = (simulated_faults_t){
        .fails_from = 1u, .fails_for = UINT32_MAX, .error = KEEL_BSP_BUS};
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, step_after(UINT32_MAX - 1u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX - 1u, device.progress.age_us);
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, step_after(5u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, device.progress.age_us);
}

/* A reading of 0: and what the sensor converts then is lost, so it is begun again. */
static void MSD_006_a_conversion_that_does_not_end(void)
{
    waits(PERIOD);
    waits(PERIOD);
    sensor.slow_us = PERIOD;
    waits(PERIOD);
    refuses(KEEL_BSP_TIMEOUT);
    sensor.slow_us = 0u;
    waits(PERIOD);
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
}

static void MSD_006_all_ones(void)
{
    start();
    sensor.faults.line = ALL_ONES;
    refuses(KEEL_BSP_STUCK);
    sensor.faults.line = SIMULATED_LINE_FREE;
    waits(PERIOD);
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
}

static void MSD_007_no_weather(void)
{
    sensor.pressure = 1u;
    start();
    refuses(KEEL_BSP_RANGE);
    sensor.pressure = D1;
    sensor.temperature = 1u;
    waits(PERIOD);
    waits(PERIOD);
    refuses(KEEL_BSP_RANGE);
    sensor.temperature = D2;
    waits(PERIOD);
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
}

/* A reset, eight words, and four exchanges until the first sample, and one behind it: each fails
 * once in its turn, and is told, but for the last, which is counted; a sample comes in the end. */
static void fails_once(uint32_t at, keel_bsp_status_t error, uint32_t short_at)
{
    uint32_t told = 0u;
    bool measured = false;

    setUp();
    sensor.faults.fails_from = at;
    sensor.faults.fails_for = (short_at == 0u) ? 1u : 0u;
    sensor.faults.error = error;
    sensor.faults.short_at = short_at;
    for (uint32_t i = 0u; (i < 12u) && !measured; i++) {
        const keel_bsp_status_t status = step_after(PERIOD);

        measured = status == KEEL_BSP_OK;
        if ((status != KEEL_BSP_OK) && (status != KEEL_BSP_WAIT)) {
            TEST_ASSERT_EQUAL((short_at == 0u) ? error : KEEL_BSP_SHORT, status);
            told++;
        }
    }
    TEST_ASSERT_TRUE(measured);
    TEST_ASSERT_EQUAL_UINT32(1u, device.progress.failures);
    TEST_ASSERT_EQUAL_UINT32((at == 14u) ? 0u : 1u, told);
    TEST_ASSERT_EQUAL_INT32(100009, device.sample.pressure_pa);
}

static void MSD_008_a_failure_at_any_exchange(void)
{
    for (uint32_t at = 1u; at <= 14u; at++) {
        fails_once(at, KEEL_BSP_BUS, 0u);
        fails_once(at, KEEL_BSP_TIMEOUT, 0u);
        fails_once(at, KEEL_BSP_OK, at);
    }
}

static void MSD_009_readings_that_do_not_move(void)
{
    measure();
    for (uint32_t again = 1u; again <= KEEL_MS5611_REPEATS; again++) {
        waits(PERIOD);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
    }
    waits(PERIOD);
    refuses(KEEL_BSP_STUCK);
    sensor.temperature++;
    waits(PERIOD); /* It begins again. */
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
    sensor.pressure++;
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
}

static void MSD_010_many_failures_reset_it(void)
{
    measure();
    sensor.faults.exchanges = 0u;
    sensor.faults.fails_from = 1u;
    sensor.faults.fails_for = KEEL_MS5611_FAILURES;
    sensor.faults.error = KEEL_BSP_TIMEOUT;
    for (uint32_t i = 0u; i < KEEL_MS5611_FAILURES; i++) {
        TEST_ASSERT_EQUAL_UINT32(1u, sensor.resets);
        refuses(KEEL_BSP_TIMEOUT);
    }
    TEST_ASSERT_EQUAL(KEEL_MS5611_OFF, device.state);
    waits(PERIOD);
    TEST_ASSERT_EQUAL_UINT32(2u, sensor.resets);
    waits(PERIOD);
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
}

/* One fewer, and a sample, and it goes on. */
static void MSD_010_a_sample_ends_a_row_of_failures(void)
{
    for (uint32_t round = 0u; round < 3u; round++) {
        measure();
        sensor.pressure = D1;
        sensor.faults.exchanges = 0u;
        sensor.faults.fails_from = 1u;
        sensor.faults.fails_for = KEEL_MS5611_FAILURES - 1u;
        sensor.faults.error = KEEL_BSP_BUS;
        for (uint32_t i = 0u; i < (KEEL_MS5611_FAILURES - 1u); i++) {
            refuses(KEEL_BSP_BUS);
        }
        waits(PERIOD);
        waits(PERIOD);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
        TEST_ASSERT_EQUAL_UINT32(1u, sensor.resets);
        TEST_ASSERT_EQUAL_UINT32(0u, device.progress.in_row);
        setUp();
    }
}

static void MSD_010_failures_stay_at_their_end(void)
{
    start();
    device.progress.failures = UINT32_MAX;
    sensor.faults.line = ALL_ONES;
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, step_after(PERIOD));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, device.progress.failures);
}

/* A step makes nine exchanges at most, whatever happens. */
static void MSD_011_no_step_is_long(void)
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
    RUN_TEST(MSD_001_it_begins_with_no_sample);
    RUN_TEST(MSD_002_it_is_reset_and_given_its_time);
    RUN_TEST(MSD_003_a_wrong_bit_of_the_prom);
    RUN_TEST(MSD_003_a_line_that_does_not_move);
    RUN_TEST(MSD_003_words_of_zeros_and_ones);
    RUN_TEST(MSD_004_each_conversion_is_given_its_time);
    RUN_TEST(MSD_004_fifty_samples_a_second);
    RUN_TEST(MSD_005_a_sample);
    RUN_TEST(MSD_005_the_age_stays_at_its_end);
    RUN_TEST(MSD_006_a_conversion_that_does_not_end);
    RUN_TEST(MSD_006_all_ones);
    RUN_TEST(MSD_007_no_weather);
    RUN_TEST(MSD_008_a_failure_at_any_exchange);
    RUN_TEST(MSD_009_readings_that_do_not_move);
    RUN_TEST(MSD_010_many_failures_reset_it);
    RUN_TEST(MSD_010_a_sample_ends_a_row_of_failures);
    RUN_TEST(MSD_010_failures_stay_at_their_end);
    RUN_TEST(MSD_011_no_step_is_long);
    return UNITY_END();
}
