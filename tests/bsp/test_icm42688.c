/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/icm42688.h with a simulated sensor. Registers, identity and scales are
 * those of the data sheet DS-000347. */
#include "devices/icm42688.h"
#include "simulated/icm42688.c"
#include "unity.h"

/* Exchanges of a start: bank, reset, identity and reset done; of banks 1, 2 and 0 two to select it
 * and three a setting, of which there are four, three and eight; two to switch on. */
#define START    57u
#define ALL_ONES 0xFF
#define ALL_LOW  (-0xFF)

/* In the order of the registers: temperature, acceleration, rate. */
static const int16_t moving[7] = {1325, 2048, -2048, 32767, -32766, -1, 164};

static simulated_icm42688_t sensor;
static keel_icm42688_t device;

void setUp(void)
{
    simulated_icm42688_init(&sensor);
    memset(&device, 0, sizeof device);
    device.registers.bus = (keel_bus_t){simulated_icm42688_exchange, &sensor};
    device.registers.delay = simulated_icm42688_delay;
    device.registers.delay_context = &sensor;
}

void tearDown(void)
{
}

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_start(&device));
    sensor.faults.exchanges = 0u;
}

static void fail_at(uint32_t at, keel_bsp_status_t error)
{
    sensor.faults.fails_from = at;
    sensor.faults.fails_for = 1u;
    sensor.faults.error = error;
}

static void ICP_001_it_is_reset_and_given_its_time(void)
{
    start();
    TEST_ASSERT_TRUE(sensor.was_reset);
    /* 10 ms, 1 ms for each of fifteen settings, and 60 ms, of which 45 are needed. */
    TEST_ASSERT_EQUAL_UINT32(85000u, sensor.waited_us);
    TEST_ASSERT_EQUAL_UINT32(60000u, sensor.on_us);
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.misplaced);
}

static void ICP_001_a_delay_that_fails_ends_the_start(void)
{
    sensor.delay_fails = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_icm42688_start(&device));
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
}

/* A processor that was reset in the midst of a start finds another bank selected, and one that was
 * reset in flight a sensor that runs. */
static void ICP_001_whatever_it_was_left_in(void)
{
    for (uint8_t bank = 0u; bank < 8u; bank++) {
        setUp();
        sensor.value[0][0x76] = bank;
        start();
        TEST_ASSERT_TRUE(sensor.was_reset);
    }
    start();
    TEST_ASSERT_EQUAL_UINT32(0u, sensor.misplaced);
}

static void ICP_001_a_reset_that_was_not_made(void)
{
    sensor.ignores_reset = true;
    sensor.value[0][0x2D] = 0x00u;
    TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_icm42688_start(&device));
}

/* An ICM-42605 (0x42), an ICM-42686-P (0x44) and an ICM-20689 (0x98). */
static void ICP_002_another_device_is_refused(void)
{
    static const uint8_t other[3] = {0x42u, 0x44u, 0x98u};

    for (uint32_t i = 0u; i < 3u; i++) {
        setUp();
        sensor.identity = other[i];
        TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_icm42688_start(&device));
        TEST_ASSERT_EQUAL_HEX8(0x00u, sensor.value[0][0x4E]); /* It was not configured. */
    }
}

static void ICP_002_a_line_that_does_not_move(void)
{
    sensor.faults.line = ALL_LOW;
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_icm42688_start(&device));
    sensor.faults.line = ALL_ONES;
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_icm42688_start(&device));
}

/* The simulation's registers are 0x5A before: what is not set stays as it was. */
static void ICP_003_it_is_configured(void)
{
    start();
    TEST_ASSERT_EQUAL_HEX8(0x0Fu, sensor.value[0][0x4E]); /* Both low noise, thermometer on. */
    TEST_ASSERT_EQUAL_HEX8(0x3Bu, sensor.value[0][0x4C]); /* Invalid is told, big endian, no I2C. */
    TEST_ASSERT_EQUAL_HEX8(0x59u, sensor.value[0][0x4D]); /* 7:6: 01; 2: 0; 1:0: 01. */
    TEST_ASSERT_EQUAL_HEX8(0x16u, sensor.value[0][0x4F]); /* 2000 deg/s (000), 1 kHz (0110). */
    TEST_ASSERT_EQUAL_HEX8(0x16u, sensor.value[0][0x50]); /* 16 g (000), 1 kHz (0110). */
    TEST_ASSERT_EQUAL_HEX8(0x11u, sensor.value[0][0x52]); /* A quarter of 1 kHz. */
    TEST_ASSERT_EQUAL_HEX8(0x00u, sensor.value[0][0x76]); /* Bank 0. */
}

static void ICP_003_data_ready_is_told_at_a_pin(void)
{
    start();
    TEST_ASSERT_EQUAL_HEX8(0x5Bu, sensor.value[0][0x14]); /* Pulsed, push-pull, high: 011. */
    TEST_ASSERT_EQUAL_HEX8(0x4Au, sensor.value[0][0x64]); /* Bit 4 is 0. */
    TEST_ASSERT_EQUAL_HEX8(0x08u, sensor.value[0][0x65]); /* Data ready only. */
}

/* 258 Hz: delt 6, its square 36, shift 10. 213 Hz: 5, 25, 10 (table of section 5.3). */
static void ICP_003_the_anti_alias_filters(void)
{
    start();
    TEST_ASSERT_EQUAL_HEX8(0x58u, sensor.value[1][0x0B]); /* Bits 1 and 0: 0, both filters on. */
    TEST_ASSERT_EQUAL_HEX8(0x46u, sensor.value[1][0x0C]);
    TEST_ASSERT_EQUAL_HEX8(0x24u, sensor.value[1][0x0D]);
    TEST_ASSERT_EQUAL_HEX8(0xA0u, sensor.value[1][0x0E]);
    TEST_ASSERT_EQUAL_HEX8(0x0Au, sensor.value[2][0x03]); /* 6:1: 5; bit 0: 0, on. */
    TEST_ASSERT_EQUAL_HEX8(0x19u, sensor.value[2][0x04]);
    TEST_ASSERT_EQUAL_HEX8(0xA0u, sensor.value[2][0x05]);
}

/* The same where the registers are 0xA5 before: so each bit was 0 once, and 1 once. */
static void ICP_003_whatever_the_registers_were(void)
{
    static const struct {
        uint32_t bank;
        uint8_t address;
        uint8_t value;
    } is[15] = {
        {0u, 0x14u, 0xA3u}, {0u, 0x4Cu, 0x37u}, {0u, 0x4Du, 0x61u}, {0u, 0x4Fu, 0x06u},
        {0u, 0x50u, 0x06u}, {0u, 0x52u, 0x11u}, {0u, 0x64u, 0xA5u}, {0u, 0x65u, 0x88u},
        {1u, 0x0Bu, 0xA4u}, {1u, 0x0Cu, 0x86u}, {1u, 0x0Du, 0x24u}, {1u, 0x0Eu, 0xA0u},
        {2u, 0x03u, 0x8Au}, {2u, 0x04u, 0x19u}, {2u, 0x05u, 0xA0u},
    };

    sensor.fill = 0xA5u;
    start();
    for (uint32_t i = 0u; i < 15u; i++) {
        TEST_ASSERT_EQUAL_HEX8(is[i].value, sensor.value[is[i].bank][is[i].address]);
    }
}

static void ICP_003_what_does_not_read_back_is_noticed(void)
{
    static const struct {
        uint32_t bank;
        int address;
    } at[17] = {
        {0u, 0x14}, {0u, 0x4C}, {0u, 0x4D}, {0u, 0x4E}, {0u, 0x4F}, {0u, 0x50},
        {0u, 0x52}, {0u, 0x64}, {0u, 0x65}, {0u, 0x76}, {1u, 0x0B}, {1u, 0x0C},
        {1u, 0x0D}, {1u, 0x0E}, {2u, 0x03}, {2u, 0x04}, {2u, 0x05},
    };

    for (uint32_t i = 0u; i < 17u; i++) {
        setUp();
        sensor.stays_bank = at[i].bank;
        sensor.stays = at[i].address;
        TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_icm42688_start(&device));
    }
}

static void ICP_004_an_error_of_the_bus_at_any_exchange(void)
{
    static const keel_bsp_status_t error[2] = {KEEL_BSP_BUS, KEEL_BSP_TIMEOUT};

    for (uint32_t at = 1u; at <= START; at++) {
        for (uint32_t i = 0u; i < 2u; i++) {
            setUp();
            fail_at(at, error[i]);
            TEST_ASSERT_EQUAL(error[i], keel_icm42688_start(&device));
            TEST_ASSERT_EQUAL_UINT32(at, sensor.faults.exchanges);
            start(); /* It can be started again. */
        }
        setUp();
        sensor.faults.short_at = at;
        TEST_ASSERT_EQUAL(KEEL_BSP_SHORT, keel_icm42688_start(&device));
        TEST_ASSERT_EQUAL_UINT32(at, sensor.faults.exchanges);
    }
    setUp();
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_start(&device));
    TEST_ASSERT_EQUAL_UINT32(START, sensor.faults.exchanges);
}

static void ICP_005_data_ready(void)
{
    bool ready = true;

    start();
    sensor.value[0][0x2D] = 0x20u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_ready(&device, &ready));
    TEST_ASSERT_FALSE(ready);
    simulated_icm42688_sample(&sensor, moving);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_ready(&device, &ready));
    TEST_ASSERT_TRUE(ready);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_ready(&device, &ready));
    TEST_ASSERT_FALSE(ready);
}

static void ICP_005_an_error_is_no_answer(void)
{
    bool ready = true;

    start();
    fail_at(1u, KEEL_BSP_BUS);
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_icm42688_ready(&device, &ready));
    TEST_ASSERT_TRUE(ready);
}

/* 2048 steps a g and 16.4 a degree per second; the least valid number is -32766. */
static void ICP_006_a_sample_is_one_burst(void)
{
    keel_inertial_sample_t sample;

    start();
    simulated_icm42688_sample(&sensor, moving);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_read(&device, &sample));
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
    TEST_ASSERT_EQUAL_INT16(3500, sample.temperature_cdeg);
    TEST_ASSERT_EQUAL_INT16(2048, sample.acceleration[0]);  /* 1 g. */
    TEST_ASSERT_EQUAL_INT16(-2048, sample.acceleration[1]); /* -1 g. */
    TEST_ASSERT_EQUAL_INT16(32767, sample.acceleration[2]); /* Saturated. */
    TEST_ASSERT_EQUAL_INT16(-32766, sample.rate[0]);        /* Saturated. */
    TEST_ASSERT_EQUAL_INT16(-1, sample.rate[1]);
    TEST_ASSERT_EQUAL_INT16(164, sample.rate[2]); /* 10 degrees per second. */
}

/* 25 degrees and 132.48 steps a degree: 1325 / 1.3248 is 1000.15, 32767 / 1.3248 is 24733.5. */
static void ICP_006_temperatures(void)
{
    static const int16_t raw[6] = {0, 2, 1325, -1325, 32767, -32767};
    static const int16_t cdeg[6] = {2500, 2501, 3500, 1500, 27233, -22233};

    start();
    for (uint32_t i = 0u; i < 6u; i++) {
        const int16_t number[7] = {raw[i], 1, 2, 3, 4, 5, 6};
        keel_inertial_sample_t sample;

        simulated_icm42688_sample(&sensor, number);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_read(&device, &sample));
        TEST_ASSERT_EQUAL_INT16(cdeg[i], sample.temperature_cdeg);
    }
}

static void read_refuses(keel_bsp_status_t status)
{
    keel_inertial_sample_t sample;
    keel_inertial_sample_t before;

    memset(&sample, 0x5A, sizeof sample);
    memcpy(&before, &sample, sizeof sample);
    TEST_ASSERT_EQUAL(status, keel_icm42688_read(&device, &sample));
    TEST_ASSERT_EQUAL_MEMORY(&before, &sample, sizeof sample);
}

static void ICP_007_a_bad_read_changes_nothing(void)
{
    start();
    simulated_icm42688_sample(&sensor, moving);
    fail_at(1u, KEEL_BSP_BUS);
    read_refuses(KEEL_BSP_BUS);
    sensor.faults.short_at = 2u;
    read_refuses(KEEL_BSP_SHORT);
    sensor.faults.line = ALL_LOW;
    read_refuses(KEEL_BSP_STUCK);
    sensor.faults.line = ALL_ONES;
    read_refuses(KEEL_BSP_STUCK);
}

static void ICP_007_what_was_not_measured(void)
{
    start();
    read_refuses(KEEL_BSP_RANGE); /* As after a reset. */
    for (uint32_t i = 0u; i < 7u; i++) {
        int16_t number[7];

        memcpy(number, moving, sizeof number);
        number[i] = INT16_MIN;
        simulated_icm42688_sample(&sensor, number);
        read_refuses(KEEL_BSP_RANGE);
    }
}

static void ICP_007_equal_bytes_alone_are_no_fault(void)
{
    keel_inertial_sample_t sample;

    start();
    memset(&sensor.value[0][0x1D], 0x11, 14u);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_read(&device, &sample));
    memset(&sensor.value[0][0x1D], 0x00, 14u);
    sensor.value[0][0x2A] = 0x01u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_read(&device, &sample));
    TEST_ASSERT_EQUAL_INT16(1, sample.rate[2]);
}

/* Identity, eight settings, and whether the sensors are on. */
static void ICP_008_it_is_still_the_one(void)
{
    start();
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_check(&device));
    TEST_ASSERT_EQUAL_UINT32(10u, sensor.faults.exchanges);
    simulated_icm42688_brown_out(&sensor);
    TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_icm42688_check(&device));
    TEST_ASSERT_EQUAL_HEX8(0x5Au, sensor.value[0][0x4C]); /* Nothing was written. */
    start();
    sensor.value[0][0x4E] = 0x00u; /* Off. */
    TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_icm42688_check(&device));
    start();
    sensor.value[0][0x50] = 0x26u; /* 8 g. */
    TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_icm42688_check(&device));
    sensor.value[0][0x76] = 0x01u; /* Another bank, in which nobody answers there. */
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_icm42688_check(&device));
    sensor.value[0][0x76] = 0x00u;
    sensor.identity = 0x55u;
    TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_icm42688_check(&device));
    sensor.faults.exchanges = 0u;
    fail_at(1u, KEEL_BSP_TIMEOUT);
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_icm42688_check(&device));
}

static void ICP_009_samples_that_do_not_move(void)
{
    keel_inertial_sample_t sample;
    int16_t number[7];

    start();
    memcpy(number, moving, sizeof number);
    simulated_icm42688_sample(&sensor, number);
    for (uint32_t again = 0u; again <= KEEL_ICM42688_REPEATS; again++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_read(&device, &sample));
    }
    read_refuses(KEEL_BSP_STUCK);
    device.repeats.count = UINT32_MAX; /* It stays there. */
    read_refuses(KEEL_BSP_STUCK);
    number[6]++;
    simulated_icm42688_sample(&sensor, number);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm42688_read(&device, &sample));
    TEST_ASSERT_EQUAL_INT16(165, sample.rate[2]);
}

static void ICP_010_how_fast_the_bus_may_be(void)
{
    TEST_ASSERT_EQUAL_UINT32(24000000u, KEEL_ICM42688_BUS_LIMIT_HZ);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ICP_001_it_is_reset_and_given_its_time);
    RUN_TEST(ICP_001_a_delay_that_fails_ends_the_start);
    RUN_TEST(ICP_001_whatever_it_was_left_in);
    RUN_TEST(ICP_001_a_reset_that_was_not_made);
    RUN_TEST(ICP_002_another_device_is_refused);
    RUN_TEST(ICP_002_a_line_that_does_not_move);
    RUN_TEST(ICP_003_it_is_configured);
    RUN_TEST(ICP_003_data_ready_is_told_at_a_pin);
    RUN_TEST(ICP_003_the_anti_alias_filters);
    RUN_TEST(ICP_003_whatever_the_registers_were);
    RUN_TEST(ICP_003_what_does_not_read_back_is_noticed);
    RUN_TEST(ICP_004_an_error_of_the_bus_at_any_exchange);
    RUN_TEST(ICP_005_data_ready);
    RUN_TEST(ICP_005_an_error_is_no_answer);
    RUN_TEST(ICP_006_a_sample_is_one_burst);
    RUN_TEST(ICP_006_temperatures);
    RUN_TEST(ICP_007_a_bad_read_changes_nothing);
    RUN_TEST(ICP_007_what_was_not_measured);
    RUN_TEST(ICP_007_equal_bytes_alone_are_no_fault);
    RUN_TEST(ICP_008_it_is_still_the_one);
    RUN_TEST(ICP_009_samples_that_do_not_move);
    RUN_TEST(ICP_010_how_fast_the_bus_may_be);
    return UNITY_END();
}
