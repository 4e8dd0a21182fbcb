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

/* Steps on until there is a sample, with nothing wrong. */
static void measures(void)
{
    keel_bsp_status_t status = KEEL_BSP_WAIT;

    for (uint32_t i = 0u; (i < 4u) && (status == KEEL_BSP_WAIT); i++) {
        status = step_after(PERIOD);
    }
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, status);
}

/* Reset and configuration; then it measures. */
static void start(void)
{
    waits(0u);
    waits(50000u);
    for (uint32_t i = 0u; i < 7u; i++) {
        TEST_ASSERT_EQUAL(KEEL_IST8310_STARTING, device.state);
        waits(0u);
    }
    TEST_ASSERT_EQUAL(KEEL_IST8310_IDLE, device.state);
    waits(0u);
    TEST_ASSERT_EQUAL(KEEL_IST8310_MEASURING, device.state);
    sensor.faults.exchanges = 0u;
}

/* And with the first samples behind it, within the next measurement. */
static void fly(uint32_t samples)
{
    start();
    for (uint32_t i = 0u; i < samples; i++) {
        measures();
    }
    while (device.state != KEEL_IST8310_MEASURING) {
        waits(0u);
    }
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
    TEST_ASSERT_EQUAL_UINT32(2u, sensor.faults.exchanges);
}

static void IST_002_a_reset_that_does_not_end(void)
{
    waits(0u);
    sensor.reset_us = 90000u;
    waits(50000u); /* It tells its identity, and is asked then. */
    refuses_after(0u, KEEL_BSP_TIMEOUT);
    TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
}

static void IST_003_another_device(void)
{
    waits(0u);
    sensor.identity = 0x48u;
    refuses_after(50000u, KEEL_BSP_ID);
    TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
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
        waits(50000u);
        for (uint32_t step = 0u; step < ((2u * i) + 2u); step++) {
            waits(0u);
        }
        refuses_after(0u, KEEL_BSP_VERIFY);
        TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
        sensor.stays = -1;
        start();
    }
}

/* A brown-out between two measurements: what comes is a quarter of what it should be, and is not
 * taken for a sample, whichever sample it is. */
static void IST_005_a_brown_out(void)
{
    for (uint32_t samples = 0u; samples < 25u; samples++) {
        uint32_t steps = 0u;

        setUp();
        fly(samples);
        while ((device.state == KEEL_IST8310_MEASURING) || (device.state == KEEL_IST8310_PROVING)) {
            (void)step_after(PERIOD);
        }
        simulated_ist8310_brown_out(&sensor);
        while (device.state != KEEL_IST8310_OFF) {
            const keel_ist8310_sample_t before = device.sample;
            const keel_bsp_status_t status = step_after(PERIOD);

            TEST_ASSERT_EQUAL((device.state == KEEL_IST8310_OFF) ? KEEL_BSP_VERIFY : KEEL_BSP_WAIT,
                              status);
            TEST_ASSERT_EQUAL_MEMORY(&before, &device.sample, sizeof before);
            steps++;
        }
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(4u, steps);
        TEST_ASSERT_EQUAL_UINT32(1u, device.progress.failures);
        start();
        measures();
    }
}

/* Within a measurement: that is lost, and the one behind it is in other units. */
static void IST_005_a_brown_out_of_a_measurement(void)
{
    fly(5u);
    simulated_ist8310_brown_out(&sensor);
    waits(PERIOD);
    waits(PERIOD);
    refuses_after(PERIOD, KEEL_BSP_TIMEOUT);
    waits(PERIOD);
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_IST8310_PROVING, device.state);
    refuses_after(PERIOD, KEEL_BSP_VERIFY);
    TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
}

/* While a sample waits for its proof: it is not told. */
static void IST_005_a_brown_out_before_the_proof(void)
{
    start();
    waits(PERIOD);
    simulated_ist8310_brown_out(&sensor);
    refuses_after(PERIOD, KEEL_BSP_VERIFY);
    TEST_ASSERT_EQUAL(KEEL_IST8310_OFF, device.state);
}

/* The first sample, however strong, is told by the step after. */
static void IST_005_the_first_sample_is_proved(void)
{
    for (uint32_t i = 0u; i < 2u; i++) {
        start();
        sensor.field[0] = INT16_MAX;
        sensor.field[1] = INT16_MIN;
        waits(PERIOD);
        TEST_ASSERT_EQUAL(KEEL_IST8310_PROVING, device.state);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
        TEST_ASSERT_EQUAL_INT16(INT16_MAX, device.sample.field[0]);
        device.state = KEEL_IST8310_OFF; /* And again after another reset. */
    }
}

/* Half of (264, 0, 528): of 590.3 counts 295.2, whose square is 87120. */
static void IST_005_a_field_that_becomes_weak_is_proved(void)
{
    sensor.field[1] = 0;
    fly(1u);
    sensor.field[0] = 132;
    sensor.field[2] = 264; /* Just half: 132 * 132 + 264 * 264 = 87120. */
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
    setUp();
    sensor.field[1] = 0;
    fly(1u);
    sensor.field[0] = -131;
    sensor.field[2] = -264;
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
    TEST_ASSERT_EQUAL_INT16(-131, device.sample.field[0]);
    TEST_ASSERT_EQUAL_INT16(264, device.sample.field[2]);
    sensor.field[0] = -130; /* It stays weak: that is no news. */
    waits(PERIOD);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
}

/* In a row of steps, in which of them a sample comes; the exchanges that are not told are those. */
static void IST_013_samples_come_with_every_second_step(void)
{
    uint32_t samples = 0u;

    fly(1u); /* Behind the first sample the temperature was read. */
    for (uint32_t aside = 0u; aside < 4u; aside++) {
        for (uint32_t i = 0u; i < KEEL_IST8310_ASIDE; i++) {
            sensor.field[1]++;
            TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(PERIOD));
            samples++;
            if (i < (KEEL_IST8310_ASIDE - 1u)) {
                waits(PERIOD);
            }
        }
        TEST_ASSERT_EQUAL(KEEL_IST8310_ASIDE_DUE, device.state);
        TEST_ASSERT_EQUAL_UINT32(aside, device.aside);
        waits(PERIOD);
        waits(PERIOD);
    }
    TEST_ASSERT_EQUAL_UINT32(40u, samples);
    TEST_ASSERT_EQUAL_UINT32(0u, device.aside); /* The temperature was the last. */
}

/* A setting that is lost without the others, while the field tells nothing. */
static void IST_013_each_setting_is_read_back(void)
{
    static const uint32_t registers[3] = {0x41u, 0x42u, 0x0Du};

    for (uint32_t i = 0u; i < 3u; i++) {
        uint32_t samples = 0u;

        setUp();
        fly(1u);
        sensor.value[registers[i]] = 0u;
        sensor.field[0] = 2640; /* It grows tenfold. */
        sensor.field[2] = 5280;
        while (device.state != KEEL_IST8310_OFF) {
            const keel_bsp_status_t status = step_after(PERIOD);

            sensor.field[1]++;
            samples += (status == KEEL_BSP_OK) ? 1u : 0u;
        }
        TEST_ASSERT_EQUAL_UINT32(KEEL_IST8310_ASIDE * (i + 1u), samples);
        TEST_ASSERT_EQUAL_UINT32(1u, device.progress.failures);
    }
}

/* A brown-out that the field does not tell: the worst is one behind the last setting. */
static void IST_013_a_brown_out_is_found_within_20_samples(void)
{
    for (uint32_t before = 1u; before < 45u; before++) {
        uint32_t samples = 0u;

        setUp();
        fly(before);
        simulated_ist8310_brown_out(&sensor);
        sensor.value[0x0A] = 1u; /* It measures on. */
        sensor.measuring = true;
        sensor.field[0] = 2640;
        sensor.field[2] = 5280;
        while (device.state != KEEL_IST8310_OFF) {
            const keel_bsp_status_t status = step_after(PERIOD);

            sensor.field[1] = (int16_t)(sensor.field[1] + 4);
            samples += (status == KEEL_BSP_OK) ? 1u : 0u;
        }
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(2u * KEEL_IST8310_ASIDE, samples);
    }
}

/* It is tried again behind the next sample. */
static void IST_013_one_that_fails(void)
{
    start();
    measures();
    for (uint32_t i = 0u; i < 3u; i++) {
        TEST_ASSERT_EQUAL(KEEL_IST8310_ASIDE_DUE, device.state);
        TEST_ASSERT_EQUAL_UINT32(3u, device.aside);
        sensor.faults.exchanges = 0u;
        sensor.faults.fails_from = 1u;
        sensor.faults.fails_for = 1u;
        sensor.faults.error = KEEL_BSP_BUS;
        refuses_after(PERIOD, KEEL_BSP_BUS);
        TEST_ASSERT_EQUAL(KEEL_IST8310_IDLE, device.state);
        measures();
    }
    waits(PERIOD);
    TEST_ASSERT_EQUAL_UINT32(0u, device.aside);
    TEST_ASSERT_EQUAL_INT16(321, device.temperature);
}

static void IST_006_a_measurement_is_given_its_time(void)
{
    fly(1u);
    waits(5999u);
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.faults.exchanges);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(1u));
    TEST_ASSERT_EQUAL(KEEL_IST8310_IDLE, device.state);
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.age_us);
    waits(100u);
    TEST_ASSERT_EQUAL(KEEL_IST8310_MEASURING, device.state);
    TEST_ASSERT_EQUAL_UINT32(100u, device.progress.age_us);
}

static void IST_006_not_ready_yet(void)
{
    fly(1u);
    sensor.measure_us = 20000u;
    waits(19999u);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(1u));
}

static void IST_006_never_ready(void)
{
    fly(1u);
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
    TEST_ASSERT_EQUAL_INT16(0, device.sample.temperature); /* It was not read yet. */
    measures();
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
    fly(1u);
    TEST_ASSERT_EQUAL_UINT32(0u, device.overruns);
    simulated_ist8310_pass(&sensor, PERIOD);
    sensor.value[0x02] |= 0x02u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ist8310_step(&device, PERIOD));
    TEST_ASSERT_EQUAL_UINT32(1u, device.overruns);
    waits(PERIOD);
    device.overruns = UINT32_MAX;
    simulated_ist8310_pass(&sensor, PERIOD);
    sensor.value[0x02] |= 0x02u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ist8310_step(&device, PERIOD));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, device.overruns);
}

static void IST_009_a_field_of_one_bit(void)
{
    fly(1u);
    memset(sensor.field, 0, sizeof sensor.field);
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
    fly(1u);
    for (uint32_t again = 1u; again <= KEEL_IST8310_REPEATS; again++) {
        measures();
    }
    while (device.state != KEEL_IST8310_MEASURING) {
        waits(PERIOD);
    }
    refuses_after(PERIOD, KEEL_BSP_STUCK);
    waits(PERIOD);
    sensor.field[1]++;
    measures();
}

/* The reset, eight exchanges of the start, begin and end of the first sample, its proof, and the
 * temperature behind it: each fails once in its turn and is told. */
static void ist_fails_once(uint32_t at, keel_bsp_status_t error, uint32_t short_at)
{
    uint32_t told = 0u;
    uint32_t measured = 0u;

    setUp();
    sensor.faults.fails_from = at;
    sensor.faults.fails_for = (short_at == 0u) ? 1u : 0u;
    sensor.faults.error = error;
    sensor.faults.short_at = short_at;
    for (uint32_t i = 0u; (i < 60u) && (measured < 2u); i++) {
        const keel_ist8310_sample_t before = device.sample;
        const keel_bsp_status_t status = step_after(PERIOD);

        if (status == KEEL_BSP_OK) {
            measured++;
        } else {
            TEST_ASSERT_EQUAL_MEMORY(&before, &device.sample, sizeof before);
        }
        if ((status != KEEL_BSP_OK) && (status != KEEL_BSP_WAIT)) {
            TEST_ASSERT_EQUAL((short_at == 0u) ? error : KEEL_BSP_SHORT, status);
            told++;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(2u, measured);
    TEST_ASSERT_EQUAL_UINT32(1u, device.progress.failures);
    TEST_ASSERT_EQUAL_UINT32(1u, told);
    TEST_ASSERT_EQUAL_INT16(-528, device.sample.field[2]);
}

static void IST_010_a_failure_at_any_exchange(void)
{
    for (uint32_t at = 1u; at <= 13u; at++) {
        ist_fails_once(at, KEEL_BSP_BUS, 0u);
        ist_fails_once(at, KEEL_BSP_TIMEOUT, 0u);
        ist_fails_once(at, KEEL_BSP_OK, at);
    }
}

static void IST_011_many_failures_reset_it(void)
{
    fly(1u);
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
    for (uint32_t i = 0u; i < 8u; i++) {
        waits(PERIOD);
    }
    measures();
    TEST_ASSERT_EQUAL_UINT32(0u, device.progress.in_row);
}

static void IST_011_a_sample_ends_a_row_of_failures(void)
{
    fly(1u);
    for (uint32_t round = 0u; round < 3u; round++) {
        sensor.faults.exchanges = 0u;
        sensor.faults.fails_from = 1u;
        sensor.faults.fails_for = KEEL_IST8310_FAILURES - 1u;
        sensor.faults.error = KEEL_BSP_BUS;
        for (uint32_t i = 0u; i < (KEEL_IST8310_FAILURES - 1u); i++) {
            refuses_after(PERIOD, KEEL_BSP_BUS);
        }
        measures();
        TEST_ASSERT_EQUAL_UINT32(0u, device.progress.in_row);
    }
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.resets);
}

static uint32_t longest; /* Of all exchanges. */

static keel_bsp_status_t measured_exchange(void *context, const uint8_t *out, uint8_t *in,
                                           uint32_t length, uint32_t *done)
{
    longest = (length > longest) ? length : longest;
    return simulated_ist8310_exchange(context, out, in, length, done);
}

/* A step makes one exchange at most, of eight bytes at most, whatever happens. */
static void IST_012_no_step_is_long(void)
{
    uint32_t samples = 0u;

    device.bus.exchange = measured_exchange;
    longest = 0u;
    for (uint32_t i = 0u; i < 4000u; i++) {
        sensor.faults.exchanges = 0u;
        sensor.faults.fails_from = 1u;
        sensor.faults.fails_for = ((i % 11u) == 0u) ? 1u : 0u;
        sensor.faults.error = KEEL_BSP_BUS;
        sensor.field[1] = (int16_t)(i % 5u);
        samples += (step_after(i % 97u * 200u) == KEEL_BSP_OK) ? 1u : 0u;
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(1u, sensor.faults.exchanges);
    }
    TEST_ASSERT_EQUAL_UINT32(8u, longest);
    TEST_ASSERT_GREATER_THAN_UINT32(0u, device.progress.failures);
    TEST_ASSERT_GREATER_THAN_UINT32(100u, samples);
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
    RUN_TEST(IST_005_a_brown_out_of_a_measurement);
    RUN_TEST(IST_005_a_brown_out_before_the_proof);
    RUN_TEST(IST_005_the_first_sample_is_proved);
    RUN_TEST(IST_005_a_field_that_becomes_weak_is_proved);
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
    RUN_TEST(IST_013_samples_come_with_every_second_step);
    RUN_TEST(IST_013_each_setting_is_read_back);
    RUN_TEST(IST_013_a_brown_out_is_found_within_20_samples);
    RUN_TEST(IST_013_one_that_fails);
    return UNITY_END();
}
