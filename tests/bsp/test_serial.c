/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/serial.h on a simulated line. */
#include "stm32f767/serial.h"
#include "unity.h"

#include <string.h>

#define SENT_SIZE 64u

static keel_uart_t uart;
static keel_serial_t serial;
static char sent[SENT_SIZE];
static uint32_t sent_length;
static bool dead; /* The line takes nothing any more. */

void setUp(void)
{
    memset(&uart, 0, sizeof uart);
    memset(&serial, 0x55, sizeof serial);
    memset(sent, 0, sizeof sent);
    sent_length = 0u;
    dead = false;
    uart.ISR = UART_ISR_RESET;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_serial_start(&serial, &uart, 54000000u, 115200u));
}

void tearDown(void)
{
}

static void print(const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        keel_serial_put(&serial, *c);
    }
}

static void divisor_is(uint32_t expected, uint32_t clock_hz, uint32_t baud)
{
    uint32_t divisor = 0u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_serial_divisor(clock_hz, baud, &divisor));
    TEST_ASSERT_EQUAL_UINT32(expected, divisor);
}

static void divisor_refuses(uint32_t clock_hz, uint32_t baud)
{
    uint32_t divisor = 77u;

    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_serial_divisor(clock_hz, baud, &divisor));
    TEST_ASSERT_EQUAL_UINT32(77u, divisor);
}

static void SER_001_divisors(void)
{
    divisor_is(469u, 54000000u, 115200u); /* 468.75: 0.05 % slow. */
    divisor_is(5625u, 54000000u, 9600u);  /* Exact. */
    divisor_is(59u, 54000000u, 921600u);  /* 58.59. */
    divisor_is(16u, 16000000u, 1000000u); /* The least. */
    divisor_is(65535u, 65535000u, 1000u); /* The greatest. */
    divisor_is(17u, 850000u, 51000u);     /* 16.67: 867 000 for 850 000 is off by just 2 %. */
}

static void SER_001_what_cannot_be_had_is_refused(void)
{
    divisor_refuses(54000000u, 3600000u); /* 15. */
    divisor_refuses(65536000u, 1000u);    /* 65 536. */
    divisor_refuses(54000000u, 800u);     /* 67 500. */
    divisor_refuses(16500000u, 1000000u); /* 16.5 rounds to 17: 3 % off. */
}

static void SER_002_the_line_is_set_up_while_it_is_off(void)
{
    TEST_ASSERT_EQUAL_UINT32(469u, uart.BRR);
    TEST_ASSERT_EQUAL_HEX32(0x0000000Du, uart.CR1); /* On, transmitter, receiver. */
    TEST_ASSERT_EQUAL_UINT32(0u, serial.dropped);
}

static void SER_002_what_was_set_before_is_gone(void)
{
    uart.CR1 = 0xFFFFFFFFu;
    uart.CR2 = 0xFFFFFFFFu;
    uart.CR3 = 0xFFFFFFFFu;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_serial_start(&serial, &uart, 54000000u, 115200u));
    TEST_ASSERT_EQUAL_HEX32(0x0000000Du, uart.CR1);
    TEST_ASSERT_EQUAL_HEX32(0u, uart.CR2);
    TEST_ASSERT_EQUAL_HEX32(0u, uart.CR3);
}

static void SER_002_a_bad_rate_changes_nothing(void)
{
    keel_uart_t before;

    memcpy(&before, &uart, sizeof uart);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_serial_start(&serial, &uart, 54000000u, 4000000u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &uart, sizeof uart);
}

static void SER_003_what_does_not_fit_is_counted(void)
{
    for (uint32_t i = 0u; i < (KEEL_SERIAL_CAPACITY + 5u); i++) {
        keel_serial_put(&serial, 'x');
    }
    TEST_ASSERT_EQUAL_UINT32(KEEL_SERIAL_CAPACITY, serial.head - serial.tail);
    TEST_ASSERT_EQUAL_UINT32(5u, serial.dropped);
    serial.dropped = UINT32_MAX;
    keel_serial_put(&serial, 'x');
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, serial.dropped);
}

static void SER_004_one_character_at_a_time_in_order(void)
{
    print("ab");
    keel_serial_pump(&serial);
    TEST_ASSERT_EQUAL('a', uart.TDR);
    keel_serial_pump(&serial);
    TEST_ASSERT_EQUAL('b', uart.TDR);
    uart.TDR = 0u;
    keel_serial_pump(&serial);
    TEST_ASSERT_EQUAL_UINT32(0u, uart.TDR);
}

static void SER_004_a_busy_line_is_left_alone(void)
{
    print("a");
    uart.ISR = 0u;
    keel_serial_pump(&serial);
    TEST_ASSERT_EQUAL_UINT32(0u, uart.TDR);
    TEST_ASSERT_EQUAL_UINT32(1u, serial.head - serial.tail);
}

static void SER_004_the_counters_wrap(void)
{
    serial.head = UINT32_MAX;
    serial.tail = UINT32_MAX;
    print("abc");
    for (const char *c = "abc"; *c != '\0'; c++) {
        keel_serial_pump(&serial);
        TEST_ASSERT_EQUAL(*c, uart.TDR);
    }
    TEST_ASSERT_EQUAL_UINT32(2u, serial.head);
}

/* The line takes the character that is in its register, and is free again. */
static void transmit(void *context)
{
    (void)context;
    if (!dead) {
        sent[sent_length] = (char)uart.TDR;
        sent_length++;
        uart.ISR = UART_ISR_RESET;
    }
}

static void SER_005_all_is_sent(void)
{
    const keel_wait_t wait = {3u, transmit, NULL};

    print("Keel\n");
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_serial_flush(&serial, &wait));
    TEST_ASSERT_EQUAL_UINT32(serial.head, serial.tail);
    TEST_ASSERT_EQUAL('\n', uart.TDR);
}

static void SER_005_a_dead_line_ends_it(void)
{
    const keel_wait_t wait = {3u, transmit, NULL};

    print("Keel\n");
    uart.ISR = 0u;
    dead = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_serial_flush(&serial, &wait));
    TEST_ASSERT_EQUAL_UINT32(5u, serial.head - serial.tail);
}

static void SER_005_it_waits_for_the_last_bit(void)
{
    const keel_wait_t wait = {3u, transmit, NULL};

    uart.ISR = UART_ISR_TXE;
    dead = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_serial_flush(&serial, &wait));
    dead = false;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_serial_flush(&serial, &wait));
}

static void SER_006_a_character_that_came(void)
{
    char character = '?';

    TEST_ASSERT_FALSE(keel_serial_get(&serial, &character));
    TEST_ASSERT_EQUAL('?', character);
    uart.ISR = UART_ISR_RESET | UART_ISR_RXNE;
    uart.RDR = 'k';
    TEST_ASSERT_TRUE(keel_serial_get(&serial, &character));
    TEST_ASSERT_EQUAL('k', character);
    TEST_ASSERT_EQUAL_HEX32(0u, uart.ICR);
}

static void SER_006_an_overrun_does_not_end_it(void)
{
    char character = '?';

    uart.ISR = UART_ISR_RESET | UART_ISR_RXNE | UART_ISR_ORE;
    uart.RDR = 'k';
    TEST_ASSERT_TRUE(keel_serial_get(&serial, &character));
    TEST_ASSERT_EQUAL_HEX32(0x8u, uart.ICR);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SER_001_divisors);
    RUN_TEST(SER_001_what_cannot_be_had_is_refused);
    RUN_TEST(SER_002_the_line_is_set_up_while_it_is_off);
    RUN_TEST(SER_002_what_was_set_before_is_gone);
    RUN_TEST(SER_002_a_bad_rate_changes_nothing);
    RUN_TEST(SER_003_what_does_not_fit_is_counted);
    RUN_TEST(SER_004_one_character_at_a_time_in_order);
    RUN_TEST(SER_004_a_busy_line_is_left_alone);
    RUN_TEST(SER_004_the_counters_wrap);
    RUN_TEST(SER_005_all_is_sent);
    RUN_TEST(SER_005_a_dead_line_ends_it);
    RUN_TEST(SER_005_it_waits_for_the_last_bit);
    RUN_TEST(SER_006_a_character_that_came);
    RUN_TEST(SER_006_an_overrun_does_not_end_it);
    return UNITY_END();
}
