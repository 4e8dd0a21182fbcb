/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/bmi055.h with a simulated sensor. Registers, identities and scales are
 * those of the data sheet BST-BMI055-DS000. */
#include "devices/bmi055.h"
#include "simulated/bmi055.c"
#include "unity.h"

#define PARTS    2u
#define START    14u /* Exchanges of a part at a start: reset, identity, and three a setting. */
#define ALL_ONES 0xFF
#define ALL_LOW  (-0xFF)

static const int16_t rates[3] = {164, -32768, -1};
static const int16_t accelerations[3] = {128, -128, 2047};

static simulated_bmi055_t sensor;
static simulated_bmi055_part_t *const part[PARTS] = {&sensor.gyroscope, &sensor.accelerometer};
static keel_bmi055_t device;

void setUp(void)
{
    simulated_bmi055_init(&sensor);
    memset(&device, 0, sizeof device);
    device.gyroscope.bus = (keel_bus_t){simulated_bmi055_exchange, &sensor.gyroscope};
    device.gyroscope.delay = simulated_bmi055_delay;
    device.gyroscope.delay_context = &sensor;
    device.accelerometer.bus = (keel_bus_t){simulated_bmi055_exchange, &sensor.accelerometer};
    device.accelerometer.delay = simulated_bmi055_delay;
    device.accelerometer.delay_context = &sensor;
}

void tearDown(void)
{
}

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_start(&device));
    sensor.gyroscope.faults.exchanges = 0u;
    sensor.accelerometer.faults.exchanges = 0u;
    simulated_bmi055_sample(&sensor, rates, accelerations);
}

static void fail_at(uint32_t which, uint32_t at, keel_bsp_status_t error)
{
    part[which]->faults.fails_from = at;
    part[which]->faults.fails_for = 1u;
    part[which]->faults.error = error;
}

static void BMI_001_both_are_reset_and_given_their_time(void)
{
    start();
    TEST_ASSERT_TRUE(sensor.gyroscope.was_reset);
    TEST_ASSERT_TRUE(sensor.accelerometer.was_reset);
    /* 30 ms, and 1 ms for each of the eight settings. */
    TEST_ASSERT_EQUAL_UINT32(38000u, sensor.gyroscope.waited_us);
    TEST_ASSERT_EQUAL_UINT32(38000u, sensor.accelerometer.waited_us);
}

static void BMI_001_a_delay_that_fails_ends_the_start(void)
{
    sensor.delay_fails = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_bmi055_start(&device));
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.gyroscope.faults.exchanges);
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.accelerometer.faults.exchanges);
}

/* Each in the place of the other, as with select pins that were mistaken; and a BMI088, whose
 * accelerometer is 0x1E. */
static void BMI_002_another_device_is_refused(void)
{
    static const uint8_t other[PARTS][3] = {{0xFAu, 0x1Eu, 0x0Eu}, {0x0Fu, 0x1Eu, 0xFBu}};

    for (uint32_t which = 0u; which < PARTS; which++) {
        for (uint32_t i = 0u; i < 3u; i++) {
            setUp();
            part[which]->identity = other[which][i];
            TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_bmi055_start(&device));
            TEST_ASSERT_EQUAL_HEX8(0xDAu, part[which]->value[0x11]); /* It was not configured. */
        }
    }
}

static void BMI_002_a_line_that_does_not_move(void)
{
    static const int line[2] = {ALL_LOW, ALL_ONES};

    for (uint32_t which = 0u; which < PARTS; which++) {
        for (uint32_t i = 0u; i < 2u; i++) {
            setUp();
            part[which]->faults.line = line[i];
            TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_bmi055_start(&device));
        }
    }
}

/* The simulation's registers are 0x5A before, and 0xDA (suspended) that of the power: what is not
 * set stays as it was. */
static void BMI_003_the_gyroscope_is_configured(void)
{
    start();
    TEST_ASSERT_EQUAL_HEX8(0x5Au, sensor.gyroscope.value[0x11]); /* Bits 7 and 5: 0, awake. */
    TEST_ASSERT_EQUAL_HEX8(0x58u, sensor.gyroscope.value[0x0F]); /* 2:0: 000, 2000 deg/s. */
    TEST_ASSERT_EQUAL_HEX8(0xD2u, sensor.gyroscope.value[0x10]); /* 3:0: 0010, 1 kHz, 116 Hz. */
    TEST_ASSERT_EQUAL_HEX8(0x1Au, sensor.gyroscope.value[0x13]); /* 7, 6: 0, filtered, held. */
}

static void BMI_003_the_accelerometer_is_configured(void)
{
    start();
    TEST_ASSERT_EQUAL_HEX8(0x1Au, sensor.accelerometer.value[0x11]); /* 7:5: 000, awake. */
    TEST_ASSERT_EQUAL_HEX8(0x5Cu, sensor.accelerometer.value[0x0F]); /* 3:0: 1100, 16 g. */
    TEST_ASSERT_EQUAL_HEX8(0x4Eu, sensor.accelerometer.value[0x10]); /* 4:0: 01110, 500 Hz. */
    TEST_ASSERT_EQUAL_HEX8(0x1Au, sensor.accelerometer.value[0x13]); /* 7, 6: 0. */
}

/* The same where the registers are 0xA5 before: so each bit was 0 once, and 1 once. */
static void BMI_003_whatever_the_registers_were(void)
{
    static const uint8_t address[4] = {0x11u, 0x0Fu, 0x10u, 0x13u};
    static const uint8_t value[PARTS][4] = {{0x05u, 0xA0u, 0xA2u, 0x25u},
                                            {0x05u, 0xACu, 0xAEu, 0x25u}};

    sensor.gyroscope.fill = 0xA5u;
    sensor.accelerometer.fill = 0xA5u;
    start();
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_EQUAL_HEX8(value[0][i], sensor.gyroscope.value[address[i]]);
        TEST_ASSERT_EQUAL_HEX8(value[1][i], sensor.accelerometer.value[address[i]]);
    }
}

static void BMI_003_what_does_not_read_back_is_noticed(void)
{
    static const int address[4] = {0x11, 0x0F, 0x10, 0x13};

    for (uint32_t which = 0u; which < PARTS; which++) {
        for (uint32_t i = 0u; i < 4u; i++) {
            setUp();
            part[which]->stays = address[i];
            TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_bmi055_start(&device));
        }
    }
}

static void BMI_004_an_error_of_the_bus_at_any_exchange(void)
{
    static const keel_bsp_status_t error[2] = {KEEL_BSP_BUS, KEEL_BSP_TIMEOUT};

    for (uint32_t which = 0u; which < PARTS; which++) {
        for (uint32_t at = 1u; at <= START; at++) {
            for (uint32_t i = 0u; i < 2u; i++) {
                setUp();
                fail_at(which, at, error[i]);
                TEST_ASSERT_EQUAL(error[i], keel_bmi055_start(&device));
                TEST_ASSERT_EQUAL_UINT32(at, part[which]->faults.exchanges);
            }
            setUp();
            part[which]->faults.short_at = at;
            TEST_ASSERT_EQUAL(KEEL_BSP_SHORT, keel_bmi055_start(&device));
            TEST_ASSERT_EQUAL_UINT32(at, part[which]->faults.exchanges);
        }
    }
    setUp();
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_start(&device));
    TEST_ASSERT_EQUAL_UINT32(START, sensor.gyroscope.faults.exchanges);
    TEST_ASSERT_EQUAL_UINT32(START, sensor.accelerometer.faults.exchanges);
}

/* 16.4 steps a degree per second; 128 steps a g, in the upper twelve of sixteen bits. */
static void BMI_005_a_sample_is_a_burst_of_each(void)
{
    keel_inertial_sample_t sample;

    start();
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_read(&device, &sample));
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.gyroscope.faults.exchanges);
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.accelerometer.faults.exchanges);
    TEST_ASSERT_EQUAL_INT16(164, sample.rate[0]);    /* 10 degrees per second. */
    TEST_ASSERT_EQUAL_INT16(-32768, sample.rate[1]); /* Full scale. */
    TEST_ASSERT_EQUAL_INT16(-1, sample.rate[2]);
    TEST_ASSERT_EQUAL_INT16(2048, sample.acceleration[0]);  /* 1 g. */
    TEST_ASSERT_EQUAL_INT16(-2048, sample.acceleration[1]); /* -1 g. */
    TEST_ASSERT_EQUAL_INT16(32752, sample.acceleration[2]); /* 2047 * 16: full scale. */
}

static void BMI_005_saturated_values(void)
{
    static const int16_t most[3] = {32767, -32768, 32767};
    static const int16_t least[3] = {-2048, 2047, -2048};
    keel_inertial_sample_t sample;

    start();
    simulated_bmi055_sample(&sensor, most, least);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_read(&device, &sample));
    TEST_ASSERT_EQUAL_INT16(32767, sample.rate[0]);
    TEST_ASSERT_EQUAL_INT16(-32768, sample.rate[1]);
    TEST_ASSERT_EQUAL_INT16(-32768, sample.acceleration[0]); /* -2048 * 16. */
    TEST_ASSERT_EQUAL_INT16(32752, sample.acceleration[1]);
}

/* 23 degrees and half a degree a step. */
static void BMI_005_temperatures(void)
{
    static const uint8_t raw[6] = {0x00u, 0x01u, 0xFFu, 0x04u, 0x7Fu, 0x80u};
    static const int16_t cdeg[6] = {2300, 2350, 2250, 2500, 8650, -4100};

    start();
    for (uint32_t i = 0u; i < 6u; i++) {
        keel_inertial_sample_t sample;

        sensor.accelerometer.value[0x08] = raw[i];
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_read(&device, &sample));
        TEST_ASSERT_EQUAL_INT16(cdeg[i], sample.temperature_cdeg);
    }
}

static void read_refuses(keel_bsp_status_t status)
{
    keel_inertial_sample_t sample;
    keel_inertial_sample_t before;

    memset(&sample, 0x5A, sizeof sample);
    memcpy(&before, &sample, sizeof sample);
    TEST_ASSERT_EQUAL(status, keel_bmi055_read(&device, &sample));
    TEST_ASSERT_EQUAL_MEMORY(&before, &sample, sizeof sample);
}

static void BMI_006_a_bad_read_changes_nothing(void)
{
    for (uint32_t which = 0u; which < PARTS; which++) {
        setUp();
        start();
        fail_at(which, 1u, KEEL_BSP_BUS);
        read_refuses(KEEL_BSP_BUS);
        part[which]->faults.short_at = 2u;
        read_refuses(KEEL_BSP_SHORT);
        part[which]->faults.line = ALL_LOW;
        read_refuses(KEEL_BSP_STUCK);
        part[which]->faults.line = ALL_ONES;
        read_refuses(KEEL_BSP_STUCK);
        part[which]->faults.line = SIMULATED_LINE_FREE;
        part[which]->identity = 0x1Eu;
        read_refuses(KEEL_BSP_ID);
    }
}

/* A gyroscope at rest may say zero on all axes: the identity before it shows that it answers. */
static void BMI_006_zeros_are_no_fault(void)
{
    static const int16_t zero[3] = {0, 0, 0};
    keel_inertial_sample_t sample;

    start();
    simulated_bmi055_sample(&sensor, zero, zero);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_read(&device, &sample));
    TEST_ASSERT_EQUAL_INT16(0, sample.rate[0]);
    TEST_ASSERT_EQUAL_INT16(0, sample.acceleration[0]);
}

/* Identity and four settings each. */
static void BMI_007_it_is_still_the_one(void)
{
    for (uint32_t which = 0u; which < PARTS; which++) {
        setUp();
        start();
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_check(&device));
        TEST_ASSERT_EQUAL_UINT32(5u, sensor.gyroscope.faults.exchanges);
        TEST_ASSERT_EQUAL_UINT32(5u, sensor.accelerometer.faults.exchanges);
        simulated_bmi055_brown_out(part[which]);
        TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_bmi055_check(&device));
        TEST_ASSERT_EQUAL_HEX8(0xDAu, part[which]->value[0x11]); /* Nothing was written. */
        start();
        part[which]->value[0x0F] = 0x03u; /* Another range. */
        TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_bmi055_check(&device));
        part[which]->identity = 0x55u;
        TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_bmi055_check(&device));
        part[which]->faults.exchanges = 0u;
        fail_at(which, 1u, KEEL_BSP_TIMEOUT);
        TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_bmi055_check(&device));
    }
}

/* The other part goes on moving, and the temperature; the accelerometer's bit that tells a new
 * value does not count. */
static void BMI_008_samples_that_do_not_move(void)
{
    for (uint32_t which = 0u; which < PARTS; which++) {
        int16_t number[PARTS][3];
        keel_inertial_sample_t sample;

        setUp();
        start();
        memcpy(number[0], rates, sizeof rates);
        memcpy(number[1], accelerations, sizeof accelerations);
        for (uint32_t again = 0u; again <= KEEL_BMI055_REPEATS; again++) {
            number[1u - which][0] = (int16_t)again;
            sensor.accelerometer.value[0x08] = (uint8_t)again;
            simulated_bmi055_sample(&sensor, number[0], number[1]);
            TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_read(&device, &sample));
        }
        number[1u - which][0]++;
        sensor.accelerometer.value[0x08]++;
        simulated_bmi055_sample(&sensor, number[0], number[1]);
        read_refuses(KEEL_BSP_STUCK);
        read_refuses(KEEL_BSP_STUCK);
        number[which][1]++;
        simulated_bmi055_sample(&sensor, number[0], number[1]);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_bmi055_read(&device, &sample));
    }
}

static void BMI_009_how_fast_the_bus_may_be(void)
{
    TEST_ASSERT_EQUAL_UINT32(10000000u, KEEL_BMI055_BUS_LIMIT_HZ);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(BMI_001_both_are_reset_and_given_their_time);
    RUN_TEST(BMI_001_a_delay_that_fails_ends_the_start);
    RUN_TEST(BMI_002_another_device_is_refused);
    RUN_TEST(BMI_002_a_line_that_does_not_move);
    RUN_TEST(BMI_003_the_gyroscope_is_configured);
    RUN_TEST(BMI_003_the_accelerometer_is_configured);
    RUN_TEST(BMI_003_whatever_the_registers_were);
    RUN_TEST(BMI_003_what_does_not_read_back_is_noticed);
    RUN_TEST(BMI_004_an_error_of_the_bus_at_any_exchange);
    RUN_TEST(BMI_005_a_sample_is_a_burst_of_each);
    RUN_TEST(BMI_005_saturated_values);
    RUN_TEST(BMI_005_temperatures);
    RUN_TEST(BMI_006_a_bad_read_changes_nothing);
    RUN_TEST(BMI_006_zeros_are_no_fault);
    RUN_TEST(BMI_007_it_is_still_the_one);
    RUN_TEST(BMI_008_samples_that_do_not_move);
    RUN_TEST(BMI_009_how_fast_the_bus_may_be);
    return UNITY_END();
}
