/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/receiver.h. The test is the UART and the DMA: it writes into the ring
 * and counts down. */
#include "keel/middleware/sbus.h"
#include "stm32f767/receiver.h"
#include "unity.h"

#include <string.h>

#define CLOCK_HZ   54000000u
#define STREAM     1u
#define CHANNEL    5u
#define BYTE_US    120u /* Of SBUS: 12 bits of 10 us. */
#define TRUSTED_US (KEEL_RECEIVER_TRUSTED * BYTE_US)
#define BEGIN_US   (UINT32_MAX - 1000u) /* The clock wraps in most tests. */
#define EN         0x1u

static const keel_wait_t wait = {3u, NULL, NULL};

static keel_uart_t uart;
static keel_dma_t dma;
static keel_receiver_t receiver;
static keel_receiver_config_t config;
static uint32_t written; /* By DMA, since it was started. */
static uint32_t now_us;

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_receiver_start(&receiver, &config, now_us));
    written = 0u;
}

void setUp(void)
{
    memset(&uart, 0, sizeof uart);
    memset(&dma, 0, sizeof dma);
    memset(&receiver, 0x55, sizeof receiver);
    uart.ISR = UART_ISR_RESET;
    now_us = BEGIN_US;
    config = (keel_receiver_config_t){&uart,    &dma,  STREAM,         CHANNEL,
                                      CLOCK_HZ, &wait, keel_line_sbus, false};
    start();
}

void tearDown(void)
{
}

/* DMA moves a byte. */
static void arrive(uint8_t value)
{
    keel_dma_stream_t *const stream = &dma.stream[config.stream];

    receiver.ring[written % KEEL_RECEIVER_CAPACITY] = value;
    written++;
    stream->NDTR = KEEL_RECEIVER_CAPACITY - (written % KEEL_RECEIVER_CAPACITY);
}

static void arrive_many(uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        arrive((uint8_t)written);
    }
}

static void turn_after(uint32_t passed_us)
{
    now_us += passed_us;
    keel_receiver_turn(&receiver, now_us);
}

static void reads(uint8_t value, uint32_t elapsed_us)
{
    keel_receiver_byte_t byte = {0u, 0u};

    TEST_ASSERT_TRUE(keel_receiver_read(&receiver, &byte));
    TEST_ASSERT_EQUAL_HEX8(value, byte.value);
    TEST_ASSERT_EQUAL_UINT32(elapsed_us, byte.elapsed_us);
}

static void reads_nothing(void)
{
    keel_receiver_byte_t byte = {77u, 78u};

    TEST_ASSERT_FALSE(keel_receiver_read(&receiver, &byte));
    TEST_ASSERT_EQUAL_UINT32(77u, byte.elapsed_us);
    TEST_ASSERT_EQUAL_UINT8(78u, byte.value);
}

static void REC_001_the_line_of_sbus(void)
{
    TEST_ASSERT_EQUAL_UINT32(540u, uart.BRR);
    TEST_ASSERT_EQUAL_HEX32(0x00001405u, uart.CR1); /* On, receiver, 9 bits, even parity. */
    TEST_ASSERT_EQUAL_HEX32(0x00032000u, uart.CR2); /* Two stops, both ways inverted. */
    TEST_ASSERT_EQUAL_HEX32(0x00000040u, uart.CR3); /* DMA. */
    TEST_ASSERT_EQUAL_UINT32(BYTE_US, receiver.byte_us);
    TEST_ASSERT_EQUAL_UINT32(TRUSTED_US, receiver.trusted_us);
}

static void REC_001_plain_lines(void)
{
    config.line = keel_line_crsf;
    start();
    TEST_ASSERT_EQUAL_UINT32(129u, uart.BRR); /* 128.57. */
    TEST_ASSERT_EQUAL_HEX32(0x00000005u, uart.CR1);
    TEST_ASSERT_EQUAL_HEX32(0u, uart.CR2);
    TEST_ASSERT_EQUAL_UINT32(24u, receiver.byte_us);       /* 23.8. */
    TEST_ASSERT_EQUAL_UINT32(10667u, receiver.trusted_us); /* 448 of 23.81: 10 666.7. */
    config.line = keel_line_115200;
    start();
    TEST_ASSERT_EQUAL_UINT32(469u, uart.BRR);
    TEST_ASSERT_EQUAL_UINT32(87u, receiver.byte_us); /* 86.8. */
}

static void REC_001_a_line_that_sends_too(void)
{
    config.line = keel_line_115200;
    config.sends = true;
    start();
    TEST_ASSERT_EQUAL_HEX32(0x0000000Du, uart.CR1);
}

static void REC_001_the_stream(void)
{
    const keel_dma_stream_t *const stream = &dma.stream[STREAM];

    TEST_ASSERT_EQUAL_HEX32(0x0A020501u, stream->CR); /* Channel 5, high, circular, on. */
    TEST_ASSERT_EQUAL_UINT32(KEEL_RECEIVER_CAPACITY, stream->NDTR);
    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)&uart.RDR, stream->PAR);
    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)receiver.ring, stream->M0AR);
    TEST_ASSERT_EQUAL_HEX32(0u, stream->FCR);
}

static void clears(uint32_t stream, uint32_t low, uint32_t high)
{
    memset(&dma, 0, sizeof dma);
    config.stream = stream;
    start();
    TEST_ASSERT_EQUAL_HEX32(low, dma.LIFCR);
    TEST_ASSERT_EQUAL_HEX32(high, dma.HIFCR);
    TEST_ASSERT_EQUAL_HEX32(0x0A020501u, dma.stream[stream].CR);
}

static void REC_001_the_flags_of_the_stream_alone_are_cleared(void)
{
    clears(0u, 0x0000003Du, 0u);
    clears(1u, 0x00000F40u, 0u);
    clears(2u, 0x003D0000u, 0u);
    clears(3u, 0x0F400000u, 0u);
    clears(4u, 0u, 0x0000003Du);
    clears(5u, 0u, 0x00000F40u);
    clears(6u, 0u, 0x003D0000u);
    clears(7u, 0u, 0x0F400000u);
}

static void REC_001_what_was_set_before_is_gone(void)
{
    memset(&uart, 0xFF, sizeof uart);
    memset(&dma.stream[STREAM], 0xFE, sizeof dma.stream[STREAM]);
    start();
    REC_001_the_line_of_sbus();
    REC_001_the_stream();
}

static void refuses(void)
{
    keel_uart_t uart_before;
    keel_dma_t dma_before;
    keel_receiver_t before;

    memcpy(&uart_before, &uart, sizeof uart);
    memcpy(&dma_before, &dma, sizeof dma);
    memcpy(&before, &receiver, sizeof receiver);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_receiver_start(&receiver, &config, now_us));
    TEST_ASSERT_EQUAL_MEMORY(&uart_before, &uart, sizeof uart);
    TEST_ASSERT_EQUAL_MEMORY(&dma_before, &dma, sizeof dma);
    TEST_ASSERT_EQUAL_MEMORY(&before, &receiver, sizeof receiver);
}

static void REC_002_a_refusal_changes_nothing(void)
{
    const keel_receiver_config_t good = config;

    arrive(0x0Fu);
    turn_after(80u);
    config.stream = 8u;
    refuses();
    config = good;
    config.channel = 16u;
    refuses();
    config = good;
    config.line.baud = 0u;
    refuses();
    config.line.baud = KEEL_RECEIVER_BAUD_MIN - 1u;
    config.clock_hz = 299u * 1000u; /* Which the divisor could make. */
    refuses();
    config = good;
    config.line.baud = 4000000u; /* A divisor of 13.5. */
    refuses();
    reads(0x0Fu, 80u);
}

static void REC_002_the_last_that_are_taken(void)
{
    config.channel = 15u;
    config.stream = 7u;
    config.line.baud = KEEL_RECEIVER_BAUD_MIN;
    config.clock_hz = 300000u;
    start();
    TEST_ASSERT_EQUAL_UINT32(40000u, receiver.byte_us); /* 12 of 3333.3. */
}

static void REC_003_starting_anew_forgets(void)
{
    arrive_many(3u);
    uart.ISR = UART_ISR_RESET | UART_ISR_FE;
    turn_after(500u);
    uart.ISR = UART_ISR_RESET;
    config.line = keel_line_crsf;
    start();
    TEST_ASSERT_EQUAL_UINT32(0u, receiver.count.bytes);
    TEST_ASSERT_EQUAL_UINT32(0u, receiver.count.framing);
    reads_nothing();
    arrive(0xC8u);
    turn_after(50u);
    reads(0xC8u, 50u);
}

static void REC_004_one_byte_a_turn(void)
{
    turn_after(80u);
    reads_nothing();
    arrive(0x0Fu);
    turn_after(80u);
    arrive(0xE0u);
    turn_after(100u);
    turn_after(70u);
    arrive(0x03u);
    turn_after(60u);
    reads(0x0Fu, 160u);
    reads(0xE0u, 100u);
    reads(0x03u, 130u);
    reads_nothing();
    TEST_ASSERT_EQUAL_UINT32(3u, receiver.count.bytes);
}

/* 3 bytes in 700 us: now, 120 us and 240 us ago, so the first came 460 us after the last look, and
 * 540 us after the byte before. */
static void REC_004_a_batch_is_spread_by_the_time_of_a_byte(void)
{
    arrive(1u);
    turn_after(80u);
    turn_after(80u);
    arrive(2u);
    arrive(3u);
    arrive(4u);
    turn_after(700u);
    reads(1u, 80u);
    reads(2u, 540u);
    reads(3u, 120u);
    reads(4u, 120u);
}

/* 4 bytes in 300 us: 0, 120 and 240 us ago, and the first at the look before. */
static void REC_004_no_byte_was_there_before_it_was_not(void)
{
    turn_after(1000u);
    arrive_many(4u);
    turn_after(300u);
    reads(0u, 1000u);
    reads(1u, 60u);
    reads(2u, 120u);
    reads(3u, 120u);
    arrive(5u); /* At the very time of the look before. */
    turn_after(0u);
    reads(5u, 0u);
}

static void REC_004_the_ring_and_its_counts_wrap(void)
{
    for (uint32_t i = 0u; i < (3u * KEEL_RECEIVER_CAPACITY); i += 2u) {
        arrive((uint8_t)i);
        arrive((uint8_t)(i + 1u));
        turn_after(250u);
        reads((uint8_t)i, 130u);
        reads((uint8_t)(i + 1u), 120u);
    }
    receiver.head = UINT32_MAX; /* In the ring the last place, as written has it. */
    receiver.tail = UINT32_MAX;
    arrive_many(KEEL_RECEIVER_CAPACITY - 1u);
    arrive(1u);
    arrive(2u);
    turn_after(TRUSTED_US);
    TEST_ASSERT_EQUAL_UINT32(1u, receiver.head);
    reads(1u, TRUSTED_US - 120u);
    reads(2u, 120u);
}

static void REC_004_times_stay_at_their_maximum(void)
{
    config.line = keel_line_115200;
    start();
    receiver.trusted_us = UINT32_MAX; /* So that no look takes too long. */
    turn_after(UINT32_MAX);
    turn_after(1u);
    arrive(1u);
    turn_after(500u);
    reads(1u, UINT32_MAX);
}

static void REC_005_as_many_as_are_trusted(void)
{
    arrive_many(KEEL_RECEIVER_TRUSTED);
    turn_after(TRUSTED_US);
    TEST_ASSERT_EQUAL_UINT32(0u, receiver.count.laps);
    for (uint32_t i = 0u; i < KEEL_RECEIVER_TRUSTED; i++) {
        reads((uint8_t)i, 120u);
    }
    reads_nothing();
}

/* 10 bytes are read; then 449 come in two looks, one more than may be unread. The next one comes 50
 * us later, and 50 us after that another. */
static void REC_005_too_many_unread_are_forgotten(void)
{
    arrive_many(10u);
    turn_after(2000u);
    while (keel_receiver_read(&receiver, &(keel_receiver_byte_t){0u, 0u})) {
    }
    arrive_many(208u);
    turn_after(208u * BYTE_US);
    arrive_many(241u);
    turn_after(241u * BYTE_US);
    TEST_ASSERT_EQUAL_UINT32(1u, receiver.count.laps);
    TEST_ASSERT_EQUAL_UINT32(459u, receiver.count.bytes);
    reads_nothing();
    arrive(0x0Fu);
    turn_after(50u);
    arrive(0xE0u);
    turn_after(50u);
    reads(0x0Fu, (449u * BYTE_US) + 50u);
    reads(0xE0u, 50u);
}

static void REC_005_a_look_that_comes_too_late(void)
{
    arrive(1u);
    turn_after(100u);
    arrive_many(700u); /* Once round, and more. */
    turn_after(TRUSTED_US + 1u);
    TEST_ASSERT_EQUAL_UINT32(1u, receiver.count.laps);
    reads_nothing();
    arrive(9u);
    turn_after(30u);
    reads(9u, 100u + TRUSTED_US + 1u + 30u);
    receiver.count.laps = UINT32_MAX;
    turn_after(TRUSTED_US + 1u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, receiver.count.laps);
}

static void REC_005_forgotten_times_stay_at_their_maximum(void)
{
    arrive(1u);
    turn_after(100u);
    receiver.elapsed_us[0] = UINT32_MAX - 5u;
    turn_after(TRUSTED_US + 1u);
    arrive(2u);
    turn_after(1u);
    reads(2u, UINT32_MAX);
}

static void REC_006_errors_are_counted_and_cleared(void)
{
    uart.ISR = UART_ISR_RESET | UART_ISR_PE;
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0x1u, uart.ICR);
    uart.ISR = UART_ISR_RESET | UART_ISR_FE;
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0x2u, uart.ICR);
    uart.ISR = UART_ISR_RESET | UART_ISR_NF;
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0x4u, uart.ICR);
    uart.ISR = UART_ISR_RESET | UART_ISR_ORE;
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0x8u, uart.ICR);
    uart.ISR = 0xFFFFFFFFu;
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0xFu, uart.ICR);
    TEST_ASSERT_EQUAL_UINT32(2u, receiver.count.parity);
    TEST_ASSERT_EQUAL_UINT32(2u, receiver.count.framing);
    TEST_ASSERT_EQUAL_UINT32(2u, receiver.count.noise);
    TEST_ASSERT_EQUAL_UINT32(2u, receiver.count.overruns);
}

static void REC_006_without_errors_nothing_is_written(void)
{
    uart.ISR = 0xFFFFFFF0u;
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0u, uart.ICR);
    TEST_ASSERT_EQUAL_UINT32(0u, receiver.count.parity);
}

static void REC_006_counts_stay_at_their_maximum(void)
{
    memset(&receiver.count, 0xFF, sizeof receiver.count);
    uart.ISR = 0xFFFFFFFFu;
    arrive(1u);
    turn_after(80u);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFFu, &receiver.count, sizeof receiver.count);
}

static void fail_transfers(uint32_t stream, volatile uint32_t *flags, uint32_t flag)
{
    memset(&dma, 0, sizeof dma);
    config.stream = stream;
    start();
    arrive_many(3u);
    turn_after(400u);
    *flags = ~flag; /* All others. */
    turn_after(80u);
    TEST_ASSERT_EQUAL_UINT32(0u, receiver.count.transfers);
    *flags = flag;
    dma.LIFCR = 0u;
    dma.HIFCR = 0u;
    dma.stream[stream].CR &= ~EN; /* As the hardware does. */
    turn_after(80u);
    TEST_ASSERT_EQUAL_UINT32(1u, receiver.count.transfers);
    TEST_ASSERT_EQUAL_HEX32(flag, (dma.LIFCR | dma.HIFCR) & flag);
    TEST_ASSERT_EQUAL_HEX32(0x0A020501u, dma.stream[stream].CR);
    TEST_ASSERT_EQUAL_UINT32(KEEL_RECEIVER_CAPACITY, dma.stream[stream].NDTR);
    *flags = 0u;
    written = 0u;
    reads_nothing();
    arrive(7u);
    turn_after(20u);
    reads(7u, 580u);
}

static void REC_007_a_stream_that_stopped_is_started_again(void)
{
    fail_transfers(1u, &dma.LISR, 0x00000200u);
    fail_transfers(2u, &dma.LISR, 0x00080000u);
    fail_transfers(5u, &dma.HISR, 0x00000200u);
}

static void REC_007_a_stream_that_is_not_off_yet(void)
{
    dma.LISR = 0x00000200u;
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0x0A020500u, dma.stream[STREAM].CR);
    TEST_ASSERT_EQUAL_UINT32(0u, receiver.count.transfers);
    turn_after(80u);
    TEST_ASSERT_EQUAL_HEX32(0x0A020501u, dma.stream[STREAM].CR);
    TEST_ASSERT_EQUAL_UINT32(1u, receiver.count.transfers);
    dma.LISR = 0u;
    written = 0u;
    arrive(1u);
    turn_after(80u);
    reads(1u, 240u);
}

static void REC_008_bytes_in_order_and_then_none(void)
{
    reads_nothing();
    arrive(0xA5u);
    reads_nothing(); /* No look has found it. */
    arrive(0x5Au);
    turn_after(1000u);
    reads(0xA5u, 880u);
    reads(0x5Au, 120u);
    reads_nothing();
}

static void REC_009_a_byte_if_the_line_is_free(void)
{
    TEST_ASSERT_FALSE(keel_receiver_send(&receiver, 'k')); /* Not started to send. */
    TEST_ASSERT_EQUAL_UINT32(0u, uart.TDR);
    config.sends = true;
    start();
    uart.ISR = 0u;
    TEST_ASSERT_FALSE(keel_receiver_send(&receiver, 'k'));
    TEST_ASSERT_EQUAL_UINT32(0u, uart.TDR);
    uart.ISR = UART_ISR_TXE;
    TEST_ASSERT_TRUE(keel_receiver_send(&receiver, 'k'));
    TEST_ASSERT_EQUAL('k', uart.TDR);
}

/* Sixteen channels in the middle, 992, as tests/unit/test_sbus.c works them out. */
static const uint8_t frame[KEEL_SBUS_BYTES] = {0x0F, 0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0,
                                               0x81, 0x0F, 0x7C, 0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07,
                                               0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x00, 0x00};

#define FRAMES    12u
#define SILENT_US 4000u /* From the end of a frame to the beginning of the next one. */
#define PERIOD_US (SILENT_US + (KEEL_SBUS_BYTES * BYTE_US))

/* What came until then, since the test began: bytes end 120 us apart, 25 a frame. */
static uint32_t ended_until(uint32_t passed_us)
{
    const uint32_t rest_us = passed_us % PERIOD_US;
    const uint32_t rest = (rest_us <= SILENT_US) ? 0u : ((rest_us - SILENT_US) / BYTE_US);
    const uint32_t all = ((passed_us / PERIOD_US) * KEEL_SBUS_BYTES) + rest;
    const uint32_t end = FRAMES * KEEL_SBUS_BYTES;

    return (all < end) ? all : end;
}

/* From look to look it is 80 us, and once 700 us; a task reads every 10 ms. */
static void takes_every_frame(uint32_t long_at_us)
{
    static const keel_sbus_config_t usual = {1000u, 8u, 1976u, 0x000Fu};
    keel_receiver_byte_t byte;
    keel_sbus_t sbus;
    uint32_t taken = 0u;
    uint32_t read_us = 0u;

    start();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
    for (uint32_t at_us = 0u; at_us < ((FRAMES + 2u) * PERIOD_US);) {
        const uint32_t turn_us = ((at_us <= long_at_us) && ((at_us + 80u) > long_at_us)) ? 700u
                                                                                         : 80u;
        at_us += turn_us;
        while (written < ended_until(at_us)) {
            arrive(frame[written % KEEL_SBUS_BYTES]);
        }
        turn_after(turn_us);
        if ((at_us - read_us) >= 10000u) {
            read_us = at_us;
            while (keel_receiver_read(&receiver, &byte)) {
                taken += keel_sbus_take(&sbus, byte.value, byte.elapsed_us) ? 1u : 0u;
            }
        }
    }
    TEST_ASSERT_EQUAL_UINT32(FRAMES, taken);
    TEST_ASSERT_EQUAL_UINT32(FRAMES, sbus.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.headers + sbus.count.footers + sbus.count.gaps);
    TEST_ASSERT_EQUAL_UINT32(0u, receiver.count.laps);
}

static void REC_004_every_frame_of_sbus_is_taken(void)
{
    for (uint32_t long_at_us = 0u; long_at_us < (2u * PERIOD_US); long_at_us += 60u) {
        takes_every_frame(long_at_us);
    }
}

/* A lap in the middle of a frame: the rest of it is refused, and the next one is taken. */
static void REC_005_the_frame_behind_a_lap_is_taken(void)
{
    static const keel_sbus_config_t usual = {1000u, 8u, 1976u, 0x000Fu};
    keel_receiver_byte_t byte;
    keel_sbus_t sbus;

    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
    arrive_many(10u);
    turn_after(TRUSTED_US + 1u);
    for (uint32_t i = 10u; i < KEEL_SBUS_BYTES; i++) {
        arrive(frame[i]);
        turn_after(BYTE_US);
    }
    turn_after(SILENT_US);
    for (uint32_t i = 0u; i < KEEL_SBUS_BYTES; i++) {
        arrive(frame[i]);
        turn_after(BYTE_US);
    }
    while (keel_receiver_read(&receiver, &byte)) {
        (void)keel_sbus_take(&sbus, byte.value, byte.elapsed_us);
    }
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.frames);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(REC_001_the_line_of_sbus);
    RUN_TEST(REC_001_plain_lines);
    RUN_TEST(REC_001_a_line_that_sends_too);
    RUN_TEST(REC_001_the_stream);
    RUN_TEST(REC_001_the_flags_of_the_stream_alone_are_cleared);
    RUN_TEST(REC_001_what_was_set_before_is_gone);
    RUN_TEST(REC_002_a_refusal_changes_nothing);
    RUN_TEST(REC_002_the_last_that_are_taken);
    RUN_TEST(REC_003_starting_anew_forgets);
    RUN_TEST(REC_004_one_byte_a_turn);
    RUN_TEST(REC_004_a_batch_is_spread_by_the_time_of_a_byte);
    RUN_TEST(REC_004_no_byte_was_there_before_it_was_not);
    RUN_TEST(REC_004_the_ring_and_its_counts_wrap);
    RUN_TEST(REC_004_times_stay_at_their_maximum);
    RUN_TEST(REC_004_every_frame_of_sbus_is_taken);
    RUN_TEST(REC_005_as_many_as_are_trusted);
    RUN_TEST(REC_005_too_many_unread_are_forgotten);
    RUN_TEST(REC_005_a_look_that_comes_too_late);
    RUN_TEST(REC_005_forgotten_times_stay_at_their_maximum);
    RUN_TEST(REC_005_the_frame_behind_a_lap_is_taken);
    RUN_TEST(REC_006_errors_are_counted_and_cleared);
    RUN_TEST(REC_006_without_errors_nothing_is_written);
    RUN_TEST(REC_006_counts_stay_at_their_maximum);
    RUN_TEST(REC_007_a_stream_that_stopped_is_started_again);
    RUN_TEST(REC_007_a_stream_that_is_not_off_yet);
    RUN_TEST(REC_008_bytes_in_order_and_then_none);
    RUN_TEST(REC_009_a_byte_if_the_line_is_free);
    return UNITY_END();
}
