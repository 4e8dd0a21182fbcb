/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/spi_bus.h with a simulated SPI, which answers each byte with its
 * complement. */
#include "stm32f767/spi_bus.h"
#include "unity.h"

#include <string.h>

#define BYTES 8u

static keel_spi_t spi;
static keel_gpio_t port;
static uint8_t taken[BYTES]; /* What the device got. */
static uint32_t count;
static uint32_t silent_from; /* From this byte on nothing comes back. */
static uint32_t overrun_at;  /* This byte overruns. */
static bool full;            /* The transmit buffer never empties. */
static bool busy;            /* The bus never becomes idle. */
static bool lost;            /* A failure switches the master off, as a mode fault does. */
static uint32_t looks;       /* Between how many looks time passed. */
static uint32_t selected;    /* Bytes during which the device was selected. */

/* The hardware between two looks: the driver waits for room first, then for the answer. */
static void advance(void *context)
{
    (void)context;
    looks++;
    if (full) {
        spi.SR &= ~SPI_SR_TXE;
    } else if ((spi.SR & (SPI_SR_TXE | SPI_SR_RXNE)) != SPI_SR_TXE) {
        spi.SR = (spi.SR & ~SPI_SR_RXNE) | SPI_SR_TXE;
    } else if (count < silent_from) {
        taken[count] = (uint8_t)spi.DR;
        selected += (port.BSRR == (1u << 20)) ? 1u : 0u;
        spi.DR = (uint8_t)~spi.DR;
        spi.SR = SPI_SR_RXNE | ((count == overrun_at) ? SPI_SR_OVR : 0u);
        count++;
    } else {
        /* Nothing comes. */
        spi.CR1 &= lost ? ~(SPI_CR1_SPE | SPI_CR1_MSTR) : UINT32_MAX;
    }
    if (busy) {
        spi.SR |= SPI_SR_BSY;
    }
}

static const keel_wait_t wait = {4u, advance, NULL};
static const keel_spi_device_t device = {&spi, {&port, 4u}, &wait};

void setUp(void)
{
    memset(&spi, 0, sizeof spi);
    memset(&port, 0, sizeof port);
    memset(taken, 0, sizeof taken);
    spi.CR2 = SPI_CR2_RESET;
    spi.SR = SPI_SR_RESET;
    count = 0u;
    selected = 0u;
    silent_from = UINT32_MAX;
    overrun_at = UINT32_MAX;
    full = false;
    busy = false;
    lost = false;
    looks = 0u;
}

void tearDown(void)
{
}

static void divisor_is(uint32_t expected, uint32_t clock_hz, uint32_t limit_hz)
{
    uint32_t code = 77u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_spi_divisor(clock_hz, limit_hz, &code));
    TEST_ASSERT_EQUAL_UINT32(expected, code);
}

static void SPI_001_divisors(void)
{
    uint32_t code = 77u;

    divisor_is(3u, 108000000u, 8000000u);  /* A 16th: 6.75 MHz; an 8th would be 13.5. */
    divisor_is(0u, 108000000u, 54000000u); /* A half, exactly. */
    divisor_is(1u, 108000000u, 53999999u);
    divisor_is(6u, 108000000u, 1000000u); /* A 128th: 0.84 MHz. */
    divisor_is(7u, 108000000u, 421875u);  /* A 256th, exactly. */
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_spi_divisor(108000000u, 421874u, &code));
    TEST_ASSERT_EQUAL_UINT32(77u, code);
}

static void SPI_002_a_master_in_mode_3(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_spi_start(&spi, 108000000u, 8000000u));
    TEST_ASSERT_EQUAL_HEX32(0x00001700u, spi.CR2); /* Eight bits, an event for each byte. */
    /* CPHA, CPOL, master, divisor 3, on, chip select by software and high. */
    TEST_ASSERT_EQUAL_HEX32(0x0000035Fu, spi.CR1);
}

static void SPI_002_a_rate_that_cannot_be_had_changes_nothing(void)
{
    keel_spi_t before;

    memcpy(&before, &spi, sizeof spi);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_spi_start(&spi, 108000000u, 100000u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &spi, sizeof spi);
}

static const uint8_t out[4] = {0x12u, 0x00u, 0xFFu, 0x34u};
static uint8_t in[4];
static uint32_t done;

static keel_bsp_status_t exchange(void)
{
    memset(in, 0x77, sizeof in);
    done = 77u;
    return keel_spi_bus_exchange((void *)&device, out, in, sizeof out, &done);
}

/* The device is deselected (pin 4 high) at the end. */
static void deselected(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x00000010u, port.BSRR);
}

static void SPI_003_every_byte_goes_and_comes(void)
{
    const uint8_t answer[4] = {0xEDu, 0xFFu, 0x00u, 0xCBu};

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, exchange());
    TEST_ASSERT_EQUAL_UINT32(4u, done);
    TEST_ASSERT_EQUAL_MEMORY(out, taken, sizeof out);
    TEST_ASSERT_EQUAL_MEMORY(answer, in, sizeof in);
    TEST_ASSERT_EQUAL_UINT32(4u, selected);
    deselected();
}

static void SPI_004_an_answer_that_never_comes(void)
{
    silent_from = 2u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange());
    TEST_ASSERT_EQUAL_UINT32(2u, done);
    TEST_ASSERT_EQUAL_HEX8(0x77u, in[2]);
    deselected();
}

static void SPI_004_a_buffer_that_never_empties(void)
{
    full = true;
    spi.SR = 0u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange());
    TEST_ASSERT_EQUAL_UINT32(0u, done);
    TEST_ASSERT_EQUAL_UINT32(0u, count);
    deselected();
}

static void SPI_004_a_bus_that_never_becomes_idle(void)
{
    busy = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange());
    TEST_ASSERT_EQUAL_UINT32(4u, done);
    deselected();
}

static void SPI_005_an_overrun_is_an_error_of_the_bus(void)
{
    overrun_at = 1u;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange());
    TEST_ASSERT_EQUAL_UINT32(1u, done);
    deselected();
}

static void SPI_005_a_mode_fault_is_an_error_of_the_bus(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, exchange());
    spi.SR = SPI_SR_TXE | SPI_SR_RXNE | SPI_SR_MODF;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, exchange());
    TEST_ASSERT_EQUAL_UINT32(0u, done);
    deselected();
}

static void SPI_006_nothing_more_is_waited_for(void)
{
    silent_from = 0u;
    busy = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange());
    /* The buffer is empty at once; then four looks for the answer, with time between them. */
    TEST_ASSERT_EQUAL_UINT32(3u, looks);
}

static void SPI_006_the_bus_is_a_master_and_on_again(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_spi_start(&spi, 108000000u, 8000000u));
    silent_from = 1u;
    lost = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, exchange());
    TEST_ASSERT_EQUAL_HEX32(0x0000035Fu, spi.CR1);
    silent_from = UINT32_MAX;
    spi.SR = SPI_SR_RESET;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, exchange());
    TEST_ASSERT_EQUAL_UINT32(4u, done);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SPI_001_divisors);
    RUN_TEST(SPI_002_a_master_in_mode_3);
    RUN_TEST(SPI_002_a_rate_that_cannot_be_had_changes_nothing);
    RUN_TEST(SPI_003_every_byte_goes_and_comes);
    RUN_TEST(SPI_004_an_answer_that_never_comes);
    RUN_TEST(SPI_004_a_buffer_that_never_empties);
    RUN_TEST(SPI_004_a_bus_that_never_becomes_idle);
    RUN_TEST(SPI_005_an_overrun_is_an_error_of_the_bus);
    RUN_TEST(SPI_005_a_mode_fault_is_an_error_of_the_bus);
    RUN_TEST(SPI_006_nothing_more_is_waited_for);
    RUN_TEST(SPI_006_the_bus_is_a_master_and_on_again);
    return UNITY_END();
}
