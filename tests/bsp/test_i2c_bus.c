/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/i2c_bus.h with a simulated I2C, which moves on between two looks of
 * the driver, and a device behind it that keeps what it is told and answers with complements. */
#include "stm32f767/i2c_bus.h"
#include "unity.h"

#include <string.h>

#define BYTES   300u
#define LOOKS   40u
#define SCL     7u
#define SDA     8u
#define ADDRESS 0x0Eu
#define NOWHERE UINT32_MAX
#define EVERY   (I2C_ICR_NACKCF | I2C_ICR_STOPCF | I2C_ICR_BERRCF | I2C_ICR_ARLOCF | I2C_ICR_OVRCF)

static keel_i2c_t i2c;
static keel_gpio_t port;
static uint8_t taken[BYTES]; /* What the device acknowledged. */
static uint32_t count;       /* So many. */
static uint32_t given;       /* So many it gave. */
static uint32_t wanted;      /* Bytes of the transfer that is under way. */
static uint32_t moved;       /* So many of them went. */
static bool deaf;            /* Nobody acknowledges the address. */
static uint32_t refused;     /* This byte is not acknowledged. */
static uint32_t silent_from; /* From this byte of the exchange on nothing happens. */
static uint32_t error;       /* This flag rises … */
static uint32_t error_at;    /* … at this byte. */
static bool endless;         /* No stop condition comes. */
static uint32_t began[4];    /* What was written to begin something. */
static uint32_t begins;      /* How often. */
static uint32_t looks;       /* Between how many looks time passed. */
static uint32_t held_for;    /* The device lets SDA go after so many clocks. */
static bool clock_held;      /* Somebody holds SCL. */
static uint32_t clocks;      /* Clocks that it made then, … */
static uint32_t stops;       /* … stop conditions … */
static uint32_t pauses;      /* … and pauses. */
static bool clock_driven;    /* What it drives. */
static bool data_driven;
static bool driven; /* Both pins were outputs with an open drain in all of them. */

static void lines_are(bool clock, bool data)
{
    port.IDR = (clock ? (1u << SCL) : 0u) | (data ? (1u << SDA) : 0u);
}

static void stop_comes(void)
{
    i2c.ISR = endless ? 0u : I2C_ISR_STOPF;
}

/* A transfer begins: the address goes out. */
static void begin(void)
{
    began[begins % 4u] = i2c.CR2;
    begins++;
    i2c.CR2 &= ~I2C_CR2_START;
    wanted = keel_bits_get(i2c.CR2, I2C_CR2_NBYTES);
    moved = 0u;
    if (deaf) {
        i2c.ISR = I2C_ISR_NACKF | I2C_ISR_BUSY;
    } else if ((count + given) >= silent_from) {
        i2c.ISR = I2C_ISR_BUSY;
    } else {
        i2c.ISR = I2C_ISR_BUSY | (((i2c.CR2 & I2C_CR2_RD_WRN) == 0u) ? I2C_ISR_TXIS : 0u);
    }
}

/* All bytes of it went. */
static void end(void)
{
    if ((i2c.CR2 & I2C_CR2_AUTOEND) == 0u) {
        i2c.ISR = I2C_ISR_TC | I2C_ISR_BUSY;
    } else {
        stop_comes();
    }
}

static void write_goes_on(void)
{
    if (count == refused) {
        i2c.ISR = I2C_ISR_NACKF | I2C_ISR_BUSY;
        return;
    }
    taken[count] = (uint8_t)i2c.TXDR;
    count++;
    moved++;
    i2c.ISR = I2C_ISR_TXIS | I2C_ISR_BUSY;
    if (moved == wanted) {
        end();
    }
}

static void read_goes_on(void)
{
    if (moved == wanted) {
        stop_comes();
        return;
    }
    i2c.RXDR = (uint8_t)~given;
    given++;
    moved++;
    i2c.ISR = I2C_ISR_RXNE | I2C_ISR_BUSY;
}

/* A byte's time passes between two looks of the driver: whatever it saw, it has answered. */
static void advance(void *context)
{
    (void)context;
    looks++;
    if ((i2c.CR2 & I2C_CR2_START) != 0u) {
        begin();
    } else if ((i2c.ICR & I2C_ICR_NACKCF) != 0u) {
        i2c.ICR = 0u;
        stop_comes();
    } else if ((count + given) >= silent_from) {
        i2c.ISR &= ~(I2C_ISR_TXIS | I2C_ISR_RXNE);
    } else if (((count + given) == error_at) && (error != 0u)) {
        i2c.ISR |= error;
    } else if ((i2c.CR2 & I2C_CR2_RD_WRN) != 0u) {
        read_goes_on();
    } else {
        write_goes_on();
    }
}

/* Half a clock of the driver, which has just set one line. */
static void pass_half(void *context)
{
    const bool was_high = (port.IDR & (1u << SDA)) != 0u;
    const bool clock_was_high = (port.IDR & (1u << SCL)) != 0u;

    (void)context;
    pauses++;
    driven = driven && (port.MODER == ((1u << (2u * SCL)) | (1u << (2u * SDA)))) &&
             (port.OTYPER == ((1u << SCL) | (1u << SDA)));
    clock_driven = (port.BSRR == (1u << SCL)) ||
                   (clock_driven && (port.BSRR != (1u << (SCL + 16u))));
    data_driven = (port.BSRR == (1u << SDA)) || (data_driven && (port.BSRR != (1u << (SDA + 16u))));
    if (!clock_was_high && clock_driven) {
        clocks++;
    }
    lines_are(clock_driven && !clock_held, data_driven && (clocks >= held_for));
    if (clock_was_high && !was_high && ((port.IDR & (1u << SDA)) != 0u)) {
        stops++;
    }
}

static const keel_wait_t wait = {LOOKS, advance, NULL};
static const keel_i2c_device_t device = {&i2c, ADDRESS, {&port, SCL}, {&port, SDA},
                                         4u,   &wait,   pass_half,    NULL};

void setUp(void)
{
    memset(&i2c, 0, sizeof i2c);
    memset(&port, 0, sizeof port);
    memset(taken, 0, sizeof taken);
    i2c.ISR = I2C_ISR_RESET;
    lines_are(true, true);
    count = given = wanted = moved = begins = looks = 0u;
    clocks = stops = pauses = held_for = 0u;
    refused = silent_from = error_at = NOWHERE;
    error = 0u;
    deaf = endless = clock_held = false;
    clock_driven = data_driven = driven = true;
}

void tearDown(void)
{
}

/* Times of a timing, in clocks. */
static uint32_t ticks_of(uint32_t timing, uint32_t field, uint32_t more)
{
    const uint32_t divisor = keel_bits_get(timing, I2C_TIMINGR_PRESC) + 1u;

    return divisor * (keel_bits_get(timing, field) + more);
}

static void IIC_001_a_timing(void)
{
    uint32_t timing = 77u;

    /* At 54 MHz a clock is 18.52 ns. The setup time of 400 ns has 22 of them, more than the field
     * holds, so a tick is two: setup 11; hold (250 - 55.6) / 37.04 = 5.2, 6 of at most 7; high
     * 600 / 37.04 = 16.2, 17; a period (2400 - 74.1) / 37.04 = 62.8, 63 with a low time of 46. */
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_i2c_timing(54000000u, &timing));
    TEST_ASSERT_EQUAL_HEX32(0x10A6102Du, timing);
    /* At 16 MHz one tick is 62.5 ns: setup 7; hold (250 - 187.5) / 62.5 = 1 of at most 1; high 10;
     * a period (2400 - 250) / 62.5 = 34.4, 35 with a low time of 25. */
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_i2c_timing(16000000u, &timing));
    TEST_ASSERT_EQUAL_HEX32(0x00610918u, timing);
}

/* Whether a timing has the specification's times, in thousandths of a clock. */
static void timing_is_good(uint64_t clock_hz, uint32_t timing)
{
    const uint64_t clocks_of_us = clock_hz / 1000u; /* Thousandths in a microsecond. */
    const uint64_t low = 1000u * (uint64_t)ticks_of(timing, I2C_TIMINGR_SCLL, 1u);
    const uint64_t high = 1000u * (uint64_t)ticks_of(timing, I2C_TIMINGR_SCLH, 1u);
    const uint64_t hold = 1000u * (uint64_t)ticks_of(timing, I2C_TIMINGR_SDADEL, 0u);
    const uint64_t setup = 1000u * (uint64_t)ticks_of(timing, I2C_TIMINGR_SCLDEL, 1u);

    TEST_ASSERT_TRUE((10u * low) >= (13u * clocks_of_us));
    TEST_ASSERT_TRUE((10u * high) >= (6u * clocks_of_us));
    TEST_ASSERT_TRUE((10u * (low + high + 4000u)) >= (24u * clocks_of_us)); /* 2.5 us less 0.1. */
    TEST_ASSERT_TRUE((100u * (hold + 3000u)) >= (25u * clocks_of_us));
    TEST_ASSERT_TRUE((100u * (hold + 4000u)) <= (34u * clocks_of_us));
    TEST_ASSERT_TRUE((10u * setup) >= (4u * clocks_of_us));
    TEST_ASSERT_TRUE((hold + setup) <= low); /* Or the bus would be held up. */
    TEST_ASSERT_TRUE((10u * (low + high)) <=
                     (25u * clocks_of_us)); /* And is no slower than that. */
}

static void IIC_001_timings_of_many_clocks(void)
{
    uint32_t fitting = 0u;

    for (uint32_t clock_hz = 1000u; clock_hz < 800000000u; clock_hz += 91000u) {
        uint32_t timing = 77u;

        if (keel_i2c_timing(clock_hz, &timing) == KEEL_BSP_OK) {
            fitting++;
            timing_is_good(clock_hz, timing);
        } else {
            TEST_ASSERT_EQUAL_UINT32(77u, timing);
            TEST_ASSERT_TRUE((clock_hz < 22300000u) || (clock_hz > 600000000u));
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(6000u, fitting);
}

static void IIC_001_clocks_that_do_not_fit(void)
{
    static const uint32_t clock_hz[5] = {0u, 11764705u, 12500000u, 640000001u, UINT32_MAX};
    uint32_t timing = 77u;

    for (uint32_t i = 0u; i < 5u; i++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_i2c_timing(clock_hz[i], &timing));
        TEST_ASSERT_EQUAL_UINT32(77u, timing);
    }
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_i2c_timing(11764706u, &timing));  /* Four clocks: 340 ns. */
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_i2c_timing(640000000u, &timing)); /* 256: 400 ns. */
}

static void IIC_002_a_master(void)
{
    i2c.CR1 = 0xFFFFFFFFu;
    i2c.CR2 = i2c.OAR1 = i2c.OAR2 = i2c.TIMEOUTR = 0x8000u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_i2c_start(&i2c, 54000000u));
    TEST_ASSERT_EQUAL_HEX32(0x10A6102Du, i2c.TIMINGR);
    TEST_ASSERT_EQUAL_HEX32(0x00000001u, i2c.CR1); /* On, without interrupts; with the filter. */
    TEST_ASSERT_EQUAL_HEX32(0u, i2c.CR2 | i2c.OAR1 | i2c.OAR2 | i2c.TIMEOUTR);
}

static void IIC_002_a_clock_that_does_not_fit_changes_nothing(void)
{
    keel_i2c_t before;

    i2c.CR1 = 0x00000041u;
    memcpy(&before, &i2c, sizeof i2c);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_i2c_start(&i2c, 1000000u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &i2c, sizeof i2c);
}

static const uint8_t out[BYTES] = {0x0Au, 0x01u, 0xFFu, 0x34u};
static uint8_t in[BYTES];
static uint32_t done;

static keel_bsp_status_t exchange(uint8_t *into, uint32_t length)
{
    memset(in, 0x77, sizeof in);
    done = 77u;
    count = given = begins = looks = 0u;
    return keel_i2c_bus_exchange((void *)&device, out, into, length, &done);
}

/* It was off and on again, with no flag left, and the next exchange goes well. */
static void is_ready_again(void)
{
    TEST_ASSERT_EQUAL_HEX32(EVERY, i2c.ICR);
    TEST_ASSERT_EQUAL_HEX32(I2C_CR1_PE, i2c.CR1);
    i2c.ISR = I2C_ISR_RESET; /* As off has left them. */
    i2c.ICR = 0u;
    refused = silent_from = error_at = NOWHERE;
    deaf = endless = false;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, exchange(in, 3u));
    TEST_ASSERT_EQUAL_UINT32(3u, done);
}

static void IIC_003_all_bytes_are_written(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, exchange(NULL, 4u));
    TEST_ASSERT_EQUAL_UINT32(4u, done);
    TEST_ASSERT_EQUAL_UINT32(4u, count);
    TEST_ASSERT_EQUAL_MEMORY(out, taken, 4u);
    TEST_ASSERT_EQUAL_UINT32(1u, begins);
    /* START, AUTOEND, four bytes, address 0x0E in bits 7:1. */
    TEST_ASSERT_EQUAL_HEX32(0x0204201Cu, began[0]);
    TEST_ASSERT_EQUAL_HEX32(I2C_ICR_STOPCF, i2c.ICR);
}

static void IIC_003_the_longest(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, exchange(NULL, 256u));
    TEST_ASSERT_EQUAL_UINT32(0u, done);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, exchange(in, 0u));
    TEST_ASSERT_EQUAL_UINT32(0u, done);
    TEST_ASSERT_EQUAL_UINT32(0u, looks);
    TEST_ASSERT_EQUAL_HEX32(0u, i2c.CR2);
    TEST_ASSERT_EQUAL_HEX32(0u, i2c.ICR);
}

static void IIC_003_the_most_bytes(void)
{
    static const keel_wait_t patient = {300u, advance, NULL};
    keel_i2c_device_t other = device;

    other.wait = &patient;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_i2c_bus_exchange(&other, out, NULL, 255u, &done));
    TEST_ASSERT_EQUAL_UINT32(255u, done);
    TEST_ASSERT_EQUAL_MEMORY(out, taken, 255u);
}

static void IIC_004_one_byte_is_written_and_the_others_are_read(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(4u, done);
    TEST_ASSERT_EQUAL_UINT32(1u, count);
    TEST_ASSERT_EQUAL_HEX8(0x0Au, taken[0]);
    TEST_ASSERT_EQUAL_HEX8(0x77u, in[0]); /* As it was. */
    TEST_ASSERT_EQUAL_HEX8(0xFFu, in[1]);
    TEST_ASSERT_EQUAL_HEX8(0xFEu, in[2]);
    TEST_ASSERT_EQUAL_HEX8(0xFDu, in[3]);
    TEST_ASSERT_EQUAL_UINT32(2u, begins);
    TEST_ASSERT_EQUAL_HEX32(0x0001201Cu, began[0]); /* One byte, and no end. */
    TEST_ASSERT_EQUAL_HEX32(0x0203241Cu, began[1]); /* Three are read, and then it ends. */
    TEST_ASSERT_EQUAL_HEX32(I2C_ICR_STOPCF, i2c.ICR);
}

static void IIC_004_with_one_byte_nothing_is_read(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, exchange(in, 1u));
    TEST_ASSERT_EQUAL_UINT32(1u, done);
    TEST_ASSERT_EQUAL_UINT32(0u, given);
    TEST_ASSERT_EQUAL_UINT32(1u, begins);
    TEST_ASSERT_EQUAL_HEX32(0x0201201Cu, began[0]);
}

static void IIC_005_nobody_answers(void)
{
    deaf = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(0u, done);
    TEST_ASSERT_EQUAL_UINT32(1u, begins);
    is_ready_again();
}

static void IIC_005_the_address_is_not_acknowledged_again(void)
{
    error_at = 1u;
    error = I2C_ISR_NACKF;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(1u, done);
    TEST_ASSERT_EQUAL_UINT32(0u, given);
    is_ready_again();
}

static void IIC_005_a_byte_is_not_acknowledged(void)
{
    for (uint32_t i = 0u; i < 4u; i++) {
        setUp();
        refused = i;
        TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(NULL, 4u));
        TEST_ASSERT_EQUAL_UINT32(i, done);
        is_ready_again();
    }
}

/* The stop condition behind it is waited for, but not for ever. */
static void IIC_005_no_end_behind_it(void)
{
    deaf = true;
    endless = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(LOOKS - 1u, looks);
    is_ready_again();
}

static void IIC_006_errors_of_the_bus(void)
{
    static const uint32_t flag[3] = {I2C_ISR_BERR, I2C_ISR_ARLO, I2C_ISR_OVR};

    for (uint32_t i = 0u; i < 3u; i++) {
        for (uint32_t at = 0u; at < 5u; at++) {
            setUp();
            error = flag[i];
            error_at = at;
            TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 5u));
            TEST_ASSERT_EQUAL_UINT32(at, done);
            TEST_ASSERT_LESS_THAN_UINT32(2u * 5u, looks); /* Nothing more is waited for. */
            is_ready_again();
        }
    }
}

static void IIC_007_nothing_happens(void)
{
    for (uint32_t from = 0u; from < 5u; from++) {
        setUp();
        silent_from = from;
        TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange(in, 5u));
        TEST_ASSERT_EQUAL_UINT32(from, done);
        TEST_ASSERT_EQUAL_UINT32(LOOKS - 1u, looks); /* Of all waits together. */
        is_ready_again();
        setUp();
        silent_from = from;
        TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange(NULL, 5u));
        TEST_ASSERT_EQUAL_UINT32(from, done);
        is_ready_again();
    }
}

static void IIC_007_no_end(void)
{
    endless = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(4u, done); /* All came. */
    is_ready_again();
    endless = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange(NULL, 4u));
    TEST_ASSERT_EQUAL_UINT32(3u, done); /* The last may be acknowledged or not. */
    is_ready_again();
}

static void IIC_007_nothing_between_two_looks(void)
{
    static const keel_wait_t blind = {3u, NULL, NULL};
    keel_i2c_device_t other = device;

    other.wait = &blind;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_i2c_bus_exchange(&other, out, in, 4u, &done));
    TEST_ASSERT_EQUAL_UINT32(0u, done);
}

/* Both pins are given to the bus, with an open drain, and the bus is on. */
static void pins_are_given(void)
{
    TEST_ASSERT_TRUE(driven);
    TEST_ASSERT_EQUAL_HEX32((2u << (2u * SCL)) | (2u << (2u * SDA)), port.MODER);
    TEST_ASSERT_EQUAL_HEX32((1u << SCL) | (1u << SDA), port.OTYPER);
    TEST_ASSERT_EQUAL_HEX32(0x40000000u, port.AFRL);
    TEST_ASSERT_EQUAL_HEX32(0x00000004u, port.AFRH);
    TEST_ASSERT_EQUAL_HEX32(I2C_CR1_PE, i2c.CR1);
}

static void IIC_008_a_held_bus_is_freed_and_the_next_exchange_goes_well(void)
{
    held_for = 3u;
    lines_are(true, false);
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(0u, done);
    TEST_ASSERT_EQUAL_UINT32(0u, begins);
    TEST_ASSERT_EQUAL_UINT32(0u, looks);
    TEST_ASSERT_EQUAL_UINT32(1u, stops);
    pins_are_given();
    is_ready_again();
}

static void IIC_008_a_bus_that_is_not_idle(void)
{
    i2c.ISR |= I2C_ISR_BUSY;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(0u, begins);
    TEST_ASSERT_EQUAL_UINT32(1u, stops);
    TEST_ASSERT_EQUAL_UINT32(4u, pauses);
    pins_are_given();
    is_ready_again();
}

static void IIC_008_a_clock_that_is_held(void)
{
    clock_held = true;
    lines_are(false, true);
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 4u));
    TEST_ASSERT_EQUAL_UINT32(0u, begins);
    pins_are_given();
    clock_held = false;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange(in, 4u)); /* It is freed again, and now it is free. */
    is_ready_again();
}

static void IIC_009_as_many_clocks_as_it_takes(void)
{
    for (uint32_t i = 1u; i <= 9u; i++) {
        setUp();
        held_for = i;
        lines_are(true, false);
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_i2c_bus_free(&device));
        TEST_ASSERT_EQUAL_UINT32(i + 1u, clocks); /* The last is the stop condition's. */
        TEST_ASSERT_EQUAL_UINT32(1u, stops);
        TEST_ASSERT_EQUAL_UINT32((2u * i) + 4u, pauses);
        pins_are_given();
    }
}

static void IIC_009_a_line_that_stays_low(void)
{
    held_for = NOWHERE;
    lines_are(true, false);
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_i2c_bus_free(&device));
    TEST_ASSERT_EQUAL_UINT32(10u, clocks);
    TEST_ASSERT_EQUAL_UINT32(KEEL_I2C_PAUSES, pauses);
    pins_are_given();
    setUp();
    clock_held = true;
    lines_are(false, true);
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_i2c_bus_free(&device));
    TEST_ASSERT_EQUAL_UINT32(4u, pauses);
    pins_are_given();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(IIC_001_a_timing);
    RUN_TEST(IIC_001_timings_of_many_clocks);
    RUN_TEST(IIC_001_clocks_that_do_not_fit);
    RUN_TEST(IIC_002_a_master);
    RUN_TEST(IIC_002_a_clock_that_does_not_fit_changes_nothing);
    RUN_TEST(IIC_003_all_bytes_are_written);
    RUN_TEST(IIC_003_the_longest);
    RUN_TEST(IIC_003_the_most_bytes);
    RUN_TEST(IIC_004_one_byte_is_written_and_the_others_are_read);
    RUN_TEST(IIC_004_with_one_byte_nothing_is_read);
    RUN_TEST(IIC_005_nobody_answers);
    RUN_TEST(IIC_005_the_address_is_not_acknowledged_again);
    RUN_TEST(IIC_005_a_byte_is_not_acknowledged);
    RUN_TEST(IIC_005_no_end_behind_it);
    RUN_TEST(IIC_006_errors_of_the_bus);
    RUN_TEST(IIC_007_nothing_happens);
    RUN_TEST(IIC_007_no_end);
    RUN_TEST(IIC_007_nothing_between_two_looks);
    RUN_TEST(IIC_008_a_held_bus_is_freed_and_the_next_exchange_goes_well);
    RUN_TEST(IIC_008_a_bus_that_is_not_idle);
    RUN_TEST(IIC_008_a_clock_that_is_held);
    RUN_TEST(IIC_009_as_many_clocks_as_it_takes);
    RUN_TEST(IIC_009_a_line_that_stays_low);
    return UNITY_END();
}
