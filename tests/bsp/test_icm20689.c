/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/icm20689.h with a simulated sensor. Registers, identity and scales are
 * those of the data sheet DS-000143. */
#include "devices/icm20689.h"
#include "unity.h"

#include <string.h>

#define REGISTERS 128u
#define FINE      UINT32_MAX

/* A sensor on a bus, with what can go wrong. */
typedef struct simulation {
    uint8_t value[REGISTERS];
    uint8_t read_only_from; /* Registers from this one on do not take what is written. */
    uint8_t identity;
    uint32_t exchanges;
    uint32_t fails_at; /* This exchange reports an error … */
    keel_bsp_status_t error;
    uint32_t short_at;  /* … this one ends a byte early. */
    int stuck;          /* What the data line always says, or -1. */
    uint32_t waited_us; /* In delays since the last reset. */
    bool delay_fails;
    bool was_reset;
} simulation_t;

static simulation_t sensor;

static void reset(void)
{
    /* Not what the sensor's registers are after a reset: whatever they are, they must be set. */
    memset(sensor.value, 0x5A, sizeof sensor.value);
    sensor.value[0x6B] = 0x40u; /* Asleep. */
    sensor.waited_us = 0u;
    sensor.was_reset = true;
}

static uint8_t answer(uint8_t address)
{
    if (sensor.waited_us < 100000u) {
        return 0u; /* Still starting. */
    }
    return (address == 0x75u) ? sensor.identity : sensor.value[address];
}

static void take(uint8_t address, uint8_t value)
{
    if ((address == 0x6Bu) && ((value & 0x80u) != 0u)) {
        reset();
    } else if (address < sensor.read_only_from) {
        sensor.value[address] = value;
    } else {
        /* Not taken. */
    }
}

static keel_bsp_status_t exchange(void *context, const uint8_t *out, uint8_t *in, uint32_t length,
                                  uint32_t *done)
{
    const uint8_t address = out[0] & 0x7Fu;

    TEST_ASSERT_EQUAL_PTR(&sensor, context);
    TEST_ASSERT_GREATER_OR_EQUAL_UINT32(2u, length);
    sensor.exchanges++;
    if (sensor.exchanges == sensor.fails_at) {
        *done = 0u;
        return sensor.error;
    }
    *done = (sensor.exchanges == sensor.short_at) ? (length - 1u) : length;
    in[0] = 0u;
    for (uint32_t i = 1u; i < *done; i++) {
        if ((out[0] & 0x80u) == 0u) {
            take((uint8_t)(address + i - 1u), out[i]);
        }
        in[i] = (sensor.stuck >= 0) ? (uint8_t)sensor.stuck : answer((uint8_t)(address + i - 1u));
    }
    return KEEL_BSP_OK;
}

static keel_bsp_status_t delay(void *context, uint32_t time_us)
{
    TEST_ASSERT_EQUAL_PTR(&sensor, context);
    sensor.waited_us += time_us;
    return sensor.delay_fails ? KEEL_BSP_TIMEOUT : KEEL_BSP_OK;
}

static const keel_icm20689_t icm = {{exchange, &sensor}, delay, &sensor};

void setUp(void)
{
    memset(&sensor, 0, sizeof sensor);
    sensor.read_only_from = REGISTERS - 1u;
    sensor.identity = 0x98u;
    sensor.fails_at = FINE;
    sensor.short_at = FINE;
    sensor.error = KEEL_BSP_BUS;
    sensor.stuck = -1;
}

void tearDown(void)
{
}

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_start(&icm));
    sensor.exchanges = 0u;
}

static void ICM_001_it_is_reset_and_given_its_time(void)
{
    start();
    TEST_ASSERT_TRUE(sensor.was_reset);
    TEST_ASSERT_GREATER_OR_EQUAL_UINT32(100000u, sensor.waited_us);
}

static void ICM_001_a_delay_that_fails_ends_the_start(void)
{
    sensor.delay_fails = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_icm20689_start(&icm));
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.exchanges);
}

static void ICM_002_another_device_is_refused(void)
{
    sensor.identity = 0x12u; /* An ICM-20602. */
    TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_icm20689_start(&icm));
    TEST_ASSERT_EQUAL_HEX8(0x40u, sensor.value[0x6B]); /* It was not configured. */
}

static void ICM_002_a_line_that_does_not_move(void)
{
    sensor.stuck = 0x00;
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_icm20689_start(&icm));
    sensor.stuck = 0xFF;
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_icm20689_start(&icm));
}

static void ICM_003_it_is_configured(void)
{
    start();
    TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x6B]); /* Awake, best clock. */
    TEST_ASSERT_EQUAL_HEX8(0x10u, sensor.value[0x6A]); /* No I2C. */
    TEST_ASSERT_EQUAL_HEX8(0x00u, sensor.value[0x19]); /* 1 kHz / (1 + 0). */
    TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x1A]); /* 176 Hz, at 1 kHz; with 0 it is 8 kHz. */
    TEST_ASSERT_EQUAL_HEX8(0x18u, sensor.value[0x1B]); /* 2000 degrees per second. */
    TEST_ASSERT_EQUAL_HEX8(0x18u, sensor.value[0x1C]); /* 16 g. */
    TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x1D]); /* 218 Hz. */
    TEST_ASSERT_EQUAL_HEX8(0x01u, sensor.value[0x38]); /* Data ready. */
}

static void ICM_003_what_does_not_read_back_is_noticed(void)
{
    sensor.read_only_from = 0x1Bu; /* The gyroscope's range is not taken. */
    TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_icm20689_start(&icm));
}

/* A start is 18 exchanges: the reset, the identity, and eight settings written and read. */
static void ICM_004_an_error_of_the_bus_at_any_exchange(void)
{
    for (uint32_t at = 1u; at <= 18u; at++) {
        setUp();
        sensor.fails_at = at;
        TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_icm20689_start(&icm));
        TEST_ASSERT_EQUAL_UINT32(at, sensor.exchanges);
        setUp();
        sensor.fails_at = at;
        sensor.error = KEEL_BSP_TIMEOUT;
        TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_icm20689_start(&icm));
    }
    setUp();
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_start(&icm));
    TEST_ASSERT_EQUAL_UINT32(18u, sensor.exchanges);
}

static void ICM_004_a_short_read_at_any_exchange(void)
{
    for (uint32_t at = 1u; at <= 18u; at++) {
        setUp();
        sensor.short_at = at;
        TEST_ASSERT_EQUAL(KEEL_BSP_SHORT, keel_icm20689_start(&icm));
        TEST_ASSERT_EQUAL_UINT32(at, sensor.exchanges);
    }
}

static void ICM_005_data_ready(void)
{
    bool ready = true;

    start();
    sensor.value[0x3A] = 0x40u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_ready(&icm, &ready));
    TEST_ASSERT_FALSE(ready);
    sensor.value[0x3A] = 0x41u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_ready(&icm, &ready));
    TEST_ASSERT_TRUE(ready);
}

static void ICM_005_an_error_is_no_answer(void)
{
    bool ready = true;

    start();
    sensor.fails_at = 1u;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_icm20689_ready(&icm, &ready));
    TEST_ASSERT_TRUE(ready);
}

static const uint8_t burst[14] = {0x08u, 0x00u, 0xF8u, 0x00u, 0x7Fu, 0xFFu, 0x01u,
                                  0x47u, 0x80u, 0x00u, 0xFFu, 0xFFu, 0x00u, 0xA4u};

static void ICM_006_a_sample_is_one_burst(void)
{
    keel_icm20689_sample_t sample;

    start();
    memcpy(&sensor.value[0x3B], burst, sizeof burst);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_read(&icm, &sample));
    TEST_ASSERT_EQUAL_UINT32(1u, sensor.exchanges);
    TEST_ASSERT_EQUAL_INT16(2048, sample.acceleration[0]);  /* 1 g. */
    TEST_ASSERT_EQUAL_INT16(-2048, sample.acceleration[1]); /* -1 g. */
    TEST_ASSERT_EQUAL_INT16(32767, sample.acceleration[2]); /* Full scale. */
    TEST_ASSERT_EQUAL_INT16(327, sample.temperature);       /* 26 degrees. */
    TEST_ASSERT_EQUAL_INT16(-32768, sample.rate[0]);        /* Full scale. */
    TEST_ASSERT_EQUAL_INT16(-1, sample.rate[1]);
    TEST_ASSERT_EQUAL_INT16(164, sample.rate[2]); /* 10 degrees per second. */
}

static void read_refuses(keel_bsp_status_t status)
{
    keel_icm20689_sample_t sample;
    keel_icm20689_sample_t before;

    memset(&sample, 0x5A, sizeof sample);
    memcpy(&before, &sample, sizeof sample);
    TEST_ASSERT_EQUAL(status, keel_icm20689_read(&icm, &sample));
    TEST_ASSERT_EQUAL_MEMORY(&before, &sample, sizeof sample);
}

static void ICM_007_a_bad_read_changes_nothing(void)
{
    start();
    memcpy(&sensor.value[0x3B], burst, sizeof burst);
    sensor.fails_at = 1u;
    read_refuses(KEEL_BSP_BUS);
    sensor.fails_at = FINE;
    sensor.short_at = 2u;
    read_refuses(KEEL_BSP_SHORT);
    sensor.stuck = 0x00;
    read_refuses(KEEL_BSP_STUCK);
    sensor.stuck = 0xFF;
    read_refuses(KEEL_BSP_STUCK);
}

static void ICM_007_equal_bytes_alone_are_no_fault(void)
{
    keel_icm20689_sample_t sample;

    start();
    memset(&sensor.value[0x3B], 0x11, sizeof burst);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_read(&icm, &sample));
    memset(&sensor.value[0x3B], 0x00, sizeof burst);
    sensor.value[0x48] = 0x01u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_read(&icm, &sample));
    TEST_ASSERT_EQUAL_INT16(1, sample.rate[2]);
    sensor.value[0x48] = 0x00u;
    sensor.value[0x3C] = 0x01u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_icm20689_read(&icm, &sample));
    TEST_ASSERT_EQUAL_INT16(1, sample.acceleration[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ICM_001_it_is_reset_and_given_its_time);
    RUN_TEST(ICM_001_a_delay_that_fails_ends_the_start);
    RUN_TEST(ICM_002_another_device_is_refused);
    RUN_TEST(ICM_002_a_line_that_does_not_move);
    RUN_TEST(ICM_003_it_is_configured);
    RUN_TEST(ICM_003_what_does_not_read_back_is_noticed);
    RUN_TEST(ICM_004_an_error_of_the_bus_at_any_exchange);
    RUN_TEST(ICM_004_a_short_read_at_any_exchange);
    RUN_TEST(ICM_005_data_ready);
    RUN_TEST(ICM_005_an_error_is_no_answer);
    RUN_TEST(ICM_006_a_sample_is_one_burst);
    RUN_TEST(ICM_007_a_bad_read_changes_nothing);
    RUN_TEST(ICM_007_equal_bytes_alone_are_no_fault);
    return UNITY_END();
}
