/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/invensense.h with a simulated sensor of each kind. Registers,
 * identities and scales are those of the data sheets DS-000143 and DS-000176 and of the register
 * map RM-MPU-6000A. */
#include "devices/invensense.h"
#include "simulated/invensense.c"
#include "unity.h"

#define KINDS    3u
#define ALL_ONES 0xFF
#define ALL_LOW  (-0xFF)

/* What each must be told, from its register map. */
typedef struct expected {
    const keel_invensense_kind_t *kind;
    uint8_t identity;
    uint8_t interface_at;
    uint8_t interface;
    uint32_t start; /* Exchanges of a start. */
    uint8_t paths;
} expected_t;

static const expected_t expected[KINDS] = {
    {&keel_icm20689, 0x98u, 0x6Au, 0x10u, 18u, 0x00u},
    {&keel_icm20602, 0x12u, 0x70u, 0x40u, 18u, 0x00u},
    {&keel_mpu6000, 0x68u, 0x6Au, 0x10u, 17u, 0x07u}, /* Another reset, and a setting less. */
};

static const int16_t moving[7] = {2048, -2048, 32767, 327, -32768, -1, 164};

static simulated_invensense_t sensor;
static keel_invensense_t device;

static void power_up(uint32_t kind)
{
    simulated_invensense_init(&sensor, expected[kind].identity);
    memset(&device, 0, sizeof device);
    device.kind = expected[kind].kind;
    device.registers.bus = (keel_bus_t){simulated_invensense_exchange, &sensor};
    device.sample_bus = (keel_bus_t){simulated_invensense_fast_exchange, &sensor};
    device.registers.delay = simulated_invensense_delay;
    device.registers.delay_context = &sensor;
}

void setUp(void)
{
    power_up(0u);
}

void tearDown(void)
{
}

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_start(&device));
    sensor.faults.exchanges = 0u;
}

static void ICM_001_it_is_reset_and_given_its_time(void)
{
    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        power_up(kind);
        start();
        TEST_ASSERT_TRUE(sensor.was_reset);
        TEST_ASSERT_GREATER_OR_EQUAL_UINT32(100000u, sensor.waited_us);
        TEST_ASSERT_EQUAL_HEX8(expected[kind].paths, sensor.paths_reset);
    }
}

static void ICM_001_a_delay_that_fails_ends_the_start(void)
{
    sensor.delay_fails = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_invensense_start(&device));
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
}

/* Each of them, in the place of each other one. */
static void ICM_002_another_device_is_refused(void)
{
    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        for (uint32_t other = 0u; other < KINDS; other++) {
            power_up(kind);
            sensor.identity = expected[other].identity;
            TEST_ASSERT_EQUAL((kind == other) ? KEEL_BSP_OK : KEEL_BSP_ID,
                              keel_invensense_start(&device));
            /* It was not configured. */
            TEST_ASSERT_EQUAL_HEX8((kind == other) ? 0x01u : 0x40u, sensor.value[0x6B]);
        }
    }
}

static void ICM_002_a_line_that_does_not_move(void)
{
    sensor.faults.line = ALL_LOW;
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_invensense_start(&device));
    sensor.faults.line = ALL_ONES;
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_invensense_start(&device));
}

static void ICM_003_it_is_configured(void)
{
    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        power_up(kind);
        start();
        TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x6B]); /* Awake, best clock. */
        TEST_ASSERT_EQUAL_HEX8(expected[kind].interface, sensor.value[expected[kind].interface_at]);
        TEST_ASSERT_EQUAL_HEX8(0x00u, sensor.value[0x19]); /* 1 kHz / (1 + 0). */
        TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x1A]); /* At 1 kHz; with 0 it is 8 kHz. */
        TEST_ASSERT_EQUAL_HEX8(0x18u, sensor.value[0x1B]); /* 2000 degrees per second. */
        TEST_ASSERT_EQUAL_HEX8(0x18u, sensor.value[0x1C]); /* 16 g. */
        TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x38]); /* Data ready. */
    }
}

/* The accelerometer's low-pass, 218 Hz: the MPU-6000 has no such register, and none is written. */
static void ICM_003_the_second_filter(void)
{
    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        power_up(kind);
        start();
        TEST_ASSERT_EQUAL_HEX8((kind == 2u) ? 0x5Au : 0x01u, sensor.value[0x1D]);
    }
}

static void ICM_003_what_does_not_read_back_is_noticed(void)
{
    static const int address[8] = {0x6B, 0x6A, 0x19, 0x1A, 0x1B, 0x1C, 0x1D, 0x38};

    for (uint32_t i = 0u; i < 8u; i++) {
        power_up(0u);
        sensor.stays = address[i];
        TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_invensense_start(&device));
    }
    power_up(1u);
    sensor.stays = 0x70;
    TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_invensense_start(&device));
    power_up(2u);
    sensor.stays = 0x1D; /* It is not asked for. */
    start();
}

/* A start is the reset, the identity, and eight settings written and read. */
static void ICM_004_an_error_of_the_bus_at_any_exchange(void)
{
    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        for (uint32_t at = 1u; at <= expected[kind].start; at++) {
            static const keel_bsp_status_t error[2] = {KEEL_BSP_BUS, KEEL_BSP_TIMEOUT};

            for (uint32_t i = 0u; i < 2u; i++) {
                power_up(kind);
                sensor.faults.fails_from = at;
                sensor.faults.fails_for = 1u;
                sensor.faults.error = error[i];
                TEST_ASSERT_EQUAL(error[i], keel_invensense_start(&device));
                TEST_ASSERT_EQUAL_UINT32(at, sensor.faults.exchanges);
            }
            power_up(kind);
            sensor.faults.short_at = at;
            TEST_ASSERT_EQUAL(KEEL_BSP_SHORT, keel_invensense_start(&device));
            TEST_ASSERT_EQUAL_UINT32(at, sensor.faults.exchanges);
        }
        power_up(kind);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_start(&device));
        TEST_ASSERT_EQUAL_UINT32(expected[kind].start, sensor.faults.exchanges);
    }
}

static void ICM_005_data_ready(void)
{
    bool ready = true;

    start();
    sensor.value[0x3A] = 0x40u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_ready(&device, &ready));
    TEST_ASSERT_FALSE(ready);
    simulated_invensense_sample(&sensor, moving);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_ready(&device, &ready));
    TEST_ASSERT_TRUE(ready);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_ready(&device, &ready));
    TEST_ASSERT_FALSE(ready);
}

static void ICM_005_an_error_is_no_answer(void)
{
    bool ready = true;

    start();
    sensor.faults.fails_from = 1u;
    sensor.faults.fails_for = 1u;
    sensor.faults.error = KEEL_BSP_BUS;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_invensense_ready(&device, &ready));
    TEST_ASSERT_TRUE(ready);
}

static void ICM_006_a_sample_is_one_burst(void)
{
    keel_inertial_sample_t sample;

    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        power_up(kind);
        start();
        simulated_invensense_sample(&sensor, moving);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_read(&device, &sample));
        TEST_ASSERT_EQUAL_UINT32(1u, sensor.faults.exchanges);
        TEST_ASSERT_EQUAL_INT16(2048, sample.acceleration[0]);  /* 1 g. */
        TEST_ASSERT_EQUAL_INT16(-2048, sample.acceleration[1]); /* -1 g. */
        TEST_ASSERT_EQUAL_INT16(32767, sample.acceleration[2]); /* Full scale. */
        TEST_ASSERT_EQUAL_INT16(-32768, sample.rate[0]);        /* Full scale. */
        TEST_ASSERT_EQUAL_INT16(-1, sample.rate[1]);
        TEST_ASSERT_EQUAL_INT16(164, sample.rate[2]); /* 10 degrees per second. */
    }
}

/* 25 degrees and 326.8 steps a degree; 36.53 degrees and 340. */
static void ICM_006_temperatures(void)
{
    static const int16_t raw[6] = {0, 3268, -3268, 3400, 32767, -32768};
    static const int16_t icm[6] = {2500, 3500, 1500, 3540, 12526, -7526};
    static const int16_t mpu[6] = {3653, 4614, 2692, 4653, 13290, -5984};

    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        power_up(kind);
        start();
        for (uint32_t i = 0u; i < 6u; i++) {
            const int16_t number[7] = {1, 2, 3, raw[i], 4, 5, 6};
            keel_inertial_sample_t sample;

            simulated_invensense_sample(&sensor, number);
            TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_read(&device, &sample));
            TEST_ASSERT_EQUAL_INT16((kind == 2u) ? mpu[i] : icm[i], sample.temperature_cdeg);
        }
    }
}

static void read_refuses(keel_bsp_status_t status)
{
    keel_inertial_sample_t sample;
    keel_inertial_sample_t before;

    memset(&sample, 0x5A, sizeof sample);
    memcpy(&before, &sample, sizeof sample);
    TEST_ASSERT_EQUAL(status, keel_invensense_read(&device, &sample));
    TEST_ASSERT_EQUAL_MEMORY(&before, &sample, sizeof sample);
}

static void ICM_007_a_bad_read_changes_nothing(void)
{
    start();
    simulated_invensense_sample(&sensor, moving);
    sensor.faults.fails_from = 1u;
    sensor.faults.fails_for = 1u;
    sensor.faults.error = KEEL_BSP_BUS;
    read_refuses(KEEL_BSP_BUS);
    sensor.faults.short_at = 2u;
    read_refuses(KEEL_BSP_SHORT);
    sensor.faults.line = ALL_LOW;
    read_refuses(KEEL_BSP_STUCK);
    sensor.faults.line = ALL_ONES;
    read_refuses(KEEL_BSP_STUCK);
}

static void ICM_007_equal_bytes_alone_are_no_fault(void)
{
    keel_inertial_sample_t sample;

    start();
    memset(&sensor.value[0x3B], 0x11, 14u);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_read(&device, &sample));
    memset(&sensor.value[0x3B], 0x00, 14u);
    sensor.value[0x48] = 0x01u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_read(&device, &sample));
    TEST_ASSERT_EQUAL_INT16(1, sample.rate[2]);
    sensor.value[0x48] = 0x00u;
    sensor.value[0x3C] = 0x01u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_read(&device, &sample));
    TEST_ASSERT_EQUAL_INT16(1, sample.acceleration[0]);
}

/* Identity and eight settings, seven of the MPU-6000. */
static void ICM_008_it_is_still_the_one(void)
{
    for (uint32_t kind = 0u; kind < KINDS; kind++) {
        power_up(kind);
        start();
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_check(&device));
        TEST_ASSERT_EQUAL_UINT32((kind == 2u) ? 8u : 9u, sensor.faults.exchanges);
        simulated_invensense_brown_out(&sensor);
        TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_invensense_check(&device));
        TEST_ASSERT_EQUAL_HEX8(0x40u, sensor.value[0x6B]); /* Nothing was written. */
        start();
        sensor.value[0x1C] = 0x10u; /* 8 g. */
        TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_invensense_check(&device));
        sensor.identity = 0x55u;
        TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_invensense_check(&device));
        sensor.faults.exchanges = 0u;
        sensor.faults.fails_from = 1u;
        sensor.faults.fails_for = 1u;
        sensor.faults.error = KEEL_BSP_TIMEOUT;
        TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_invensense_check(&device));
    }
}

static void ICM_009_samples_that_do_not_move(void)
{
    keel_inertial_sample_t sample;
    int16_t number[7];

    start();
    memcpy(number, moving, sizeof number);
    simulated_invensense_sample(&sensor, number);
    for (uint32_t again = 0u; again <= KEEL_INVENSENSE_REPEATS; again++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_read(&device, &sample));
    }
    read_refuses(KEEL_BSP_STUCK);
    device.repeats.count = UINT32_MAX; /* It stays there. */
    read_refuses(KEEL_BSP_STUCK);
    number[6]++;
    simulated_invensense_sample(&sensor, number);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_invensense_read(&device, &sample));
    TEST_ASSERT_EQUAL_INT16(165, sample.rate[2]);
}

static void ICM_010_how_fast_the_bus_may_be(void)
{
    TEST_ASSERT_EQUAL_UINT32(8000000u, keel_icm20689.bus_limit_hz);
    TEST_ASSERT_EQUAL_UINT32(8000000u, keel_icm20689.sample_limit_hz);
    TEST_ASSERT_EQUAL_UINT32(10000000u, keel_icm20602.bus_limit_hz);
    TEST_ASSERT_EQUAL_UINT32(10000000u, keel_icm20602.sample_limit_hz);
    TEST_ASSERT_EQUAL_UINT32(1000000u, keel_mpu6000.bus_limit_hz);
    TEST_ASSERT_EQUAL_UINT32(20000000u, keel_mpu6000.sample_limit_hz);
}

/* And on the fast bus alone nothing can be started: the simulation would notice. */
static void ICM_010_settings_go_over_the_slow_bus(void)
{
    device.registers.bus = device.sample_bus;
    TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_invensense_start(&device));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ICM_001_it_is_reset_and_given_its_time);
    RUN_TEST(ICM_001_a_delay_that_fails_ends_the_start);
    RUN_TEST(ICM_002_another_device_is_refused);
    RUN_TEST(ICM_002_a_line_that_does_not_move);
    RUN_TEST(ICM_003_it_is_configured);
    RUN_TEST(ICM_003_the_second_filter);
    RUN_TEST(ICM_003_what_does_not_read_back_is_noticed);
    RUN_TEST(ICM_004_an_error_of_the_bus_at_any_exchange);
    RUN_TEST(ICM_005_data_ready);
    RUN_TEST(ICM_005_an_error_is_no_answer);
    RUN_TEST(ICM_006_a_sample_is_one_burst);
    RUN_TEST(ICM_006_temperatures);
    RUN_TEST(ICM_007_a_bad_read_changes_nothing);
    RUN_TEST(ICM_007_equal_bytes_alone_are_no_fault);
    RUN_TEST(ICM_008_it_is_still_the_one);
    RUN_TEST(ICM_009_samples_that_do_not_move);
    RUN_TEST(ICM_010_how_fast_the_bus_may_be);
    RUN_TEST(ICM_010_settings_go_over_the_slow_bus);
    return UNITY_END();
}
