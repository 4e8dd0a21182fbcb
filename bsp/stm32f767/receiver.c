/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/receiver.h"

#include "common/progress.h"
#include "stm32f767/dma_ring.h"
#include "stm32f767/serial.h"

#define TWO_STOPS     2u  /* The code for two stop bits. */
#define PLAIN_BITS    10u /* Start, data and one stop. */
#define US_PER_SECOND 1000000u

/* Clearing bits have the places of the flags. */
#define ALL_ERRORS (UART_ISR_PE | UART_ISR_FE | UART_ISR_NF | UART_ISR_ORE)

const keel_line_t keel_line_sbus = {100000u, true, true, true};
const keel_line_t keel_line_crsf = {420000u, false, false, false};
const keel_line_t keel_line_115200 = {115200u, false, false, false};

static keel_dma_ring_t ring_of(const keel_receiver_config_t *config)
{
    return (keel_dma_ring_t){config->dma, config->stream, config->channel};
}

/* The time of so many bytes, to the nearest microsecond. */
static uint32_t bytes_time_of(const keel_line_t *line, uint32_t bytes)
{
    const uint32_t bits = PLAIN_BITS + (line->even_parity ? 1u : 0u) + (line->two_stops ? 1u : 0u);
    const uint64_t scaled = (uint64_t)bits * bytes * US_PER_SECOND;

    return (uint32_t)((scaled + (line->baud / 2u)) / line->baud);
}

/* Bytes from the UART go round the ring, from its beginning, each at once. The stream is off. */
static void begin_stream(keel_receiver_t *receiver)
{
    const keel_dma_ring_t ring = ring_of(&receiver->config);

    receiver->head = 0u;
    receiver->tail = 0u;
    keel_dma_ring_begin(&ring, &receiver->config.uart->RDR, &receiver->ring[0],
                        KEEL_RECEIVER_CAPACITY, KEEL_DMA_BYTE);
}

/* The UART is off, and comes on with DMA behind it, so that no byte waits. */
static void begin_line(const keel_receiver_config_t *config, uint32_t divisor)
{
    keel_uart_t *const uart = config->uart;
    const keel_line_t *const line = &config->line;

    uart->CR2 = (line->two_stops ? FIELD(UART_CR2_STOP, TWO_STOPS) : 0u) |
                (line->inverted ? (UART_CR2_RXINV | UART_CR2_TXINV) : 0u);
    uart->CR3 = UART_CR3_DMAR;
    uart->BRR = divisor;
    /* Characters of nine bits, of which the last is the parity. */
    uart->CR1 = UART_CR1_UE | UART_CR1_RE | (config->sends ? UART_CR1_TE : 0u) |
                (line->even_parity ? (UART_CR1_M0 | UART_CR1_PCE) : 0u);
}

keel_bsp_status_t keel_receiver_start(keel_receiver_t *receiver,
                                      const keel_receiver_config_t *config, uint32_t now_us)
{
    const keel_line_t *const line = &config->line;
    const keel_dma_ring_t ring = ring_of(config);
    uint32_t divisor;

    if (!keel_dma_ring_is_valid(&ring) || (line->baud < KEEL_RECEIVER_BAUD_MIN) ||
        (keel_serial_divisor(config->clock_hz, line->baud, &divisor) != KEEL_BSP_OK)) {
        return KEEL_BSP_ARGUMENT;
    }
    config->uart->CR1 = 0u; /* Asks DMA for nothing more, and forgets what came, and its errors. */
    if (!keel_dma_ring_stop(&ring, config->wait)) {
        return KEEL_BSP_TIMEOUT;
    }
    receiver->config = *config;
    receiver->count = (keel_receiver_count_t){0};
    receiver->byte_us = bytes_time_of(line, 1u);
    receiver->trusted_us = bytes_time_of(line, KEEL_RECEIVER_TRUSTED);
    receiver->look_us = now_us;
    receiver->quiet_us = 0u;
    begin_stream(receiver);
    begin_line(&receiver->config, divisor);
    return KEEL_BSP_OK;
}

/* The bytes of a look: the newest came now, each before it a byte's time earlier, but none before
 * the look before, when it was not there. Times are since that look. */
static void take_bytes(keel_receiver_t *receiver, uint32_t came, uint32_t passed_us)
{
    uint32_t before_us = 0u;

    for (uint32_t behind = came; behind > 0u; behind--) {
        const uint32_t earlier_us = (behind - 1u) * receiver->byte_us;
        const uint32_t at_us = (earlier_us < passed_us) ? (passed_us - earlier_us) : 0u;

        receiver->elapsed_us[receiver->head % KEEL_RECEIVER_CAPACITY] =
            keel_progress_sum(receiver->quiet_us, at_us - before_us);
        receiver->head++;
        receiver->quiet_us = 0u;
        before_us = at_us;
    }
    receiver->quiet_us = keel_progress_sum(receiver->quiet_us, passed_us - before_us);
}

/* What is unread is forgotten, but for its time: the next byte tells it, as it tells of a gap. */
static void forget_bytes(keel_receiver_t *receiver, uint32_t came, uint32_t passed_us)
{
    receiver->quiet_us = keel_progress_sum(receiver->quiet_us, passed_us);
    while (receiver->tail != receiver->head) {
        receiver->quiet_us = keel_progress_sum(
            receiver->quiet_us, receiver->elapsed_us[receiver->tail % KEEL_RECEIVER_CAPACITY]);
        receiver->tail++;
    }
    receiver->head += came;
    receiver->tail = receiver->head;
}

/* DMA counts a byte some cycles before it lies in the ring. None is read so early: a look goes on
 * to other registers of peripherals before anybody reads. */
static void look_at_ring(keel_receiver_t *receiver, uint32_t passed_us)
{
    const keel_dma_ring_t ring = ring_of(&receiver->config);
    const uint32_t place = KEEL_RECEIVER_CAPACITY - keel_dma_ring_left(&ring);
    const uint32_t came = (place - receiver->head) % KEEL_RECEIVER_CAPACITY;
    const uint32_t unread = (receiver->head - receiver->tail) + came;

    receiver->count.bytes = keel_progress_sum(receiver->count.bytes, came);
    if ((passed_us > receiver->trusted_us) || (unread > KEEL_RECEIVER_TRUSTED)) {
        receiver->count.laps = keel_progress_next(receiver->count.laps);
        forget_bytes(receiver, came, passed_us);
    } else {
        take_bytes(receiver, came, passed_us);
    }
}

/* An error of the bus has stopped the stream. Should it not be off yet, the next look finds it. */
static void recover_stream(keel_receiver_t *receiver, uint32_t passed_us)
{
    const keel_dma_ring_t ring = ring_of(&receiver->config);

    forget_bytes(receiver, 0u, passed_us);
    if (keel_dma_ring_is_off(&ring)) {
        receiver->count.transfers = keel_progress_next(receiver->count.transfers);
        begin_stream(receiver);
    }
}

static void count_error(uint32_t *count, uint32_t flag)
{
    if (flag != 0u) {
        *count = keel_progress_next(*count);
    }
}

/* While the flag of an overrun stands, the UART takes nothing more. */
static void look_at_errors(keel_receiver_t *receiver)
{
    keel_uart_t *const uart = receiver->config.uart;
    const uint32_t errors = uart->ISR & ALL_ERRORS;

    if (errors != 0u) {
        uart->ICR = errors;
        count_error(&receiver->count.parity, errors & UART_ISR_PE);
        count_error(&receiver->count.framing, errors & UART_ISR_FE);
        count_error(&receiver->count.noise, errors & UART_ISR_NF);
        count_error(&receiver->count.overruns, errors & UART_ISR_ORE);
    }
}

void keel_receiver_turn(keel_receiver_t *receiver, uint32_t now_us)
{
    const uint32_t passed_us = now_us - receiver->look_us;
    const keel_dma_ring_t ring = ring_of(&receiver->config);

    receiver->look_us = now_us;
    if (keel_dma_ring_failed(&ring)) {
        recover_stream(receiver, passed_us);
    } else {
        look_at_ring(receiver, passed_us);
    }
    look_at_errors(receiver);
}

bool keel_receiver_read(keel_receiver_t *receiver, keel_receiver_byte_t *byte)
{
    const uint32_t place = receiver->tail % KEEL_RECEIVER_CAPACITY;

    if (receiver->tail == receiver->head) {
        return false;
    }
    byte->elapsed_us = receiver->elapsed_us[place];
    byte->value = receiver->ring[place];
    receiver->tail++;
    return true;
}

bool keel_receiver_send(keel_receiver_t *receiver, uint8_t value)
{
    keel_uart_t *const uart = receiver->config.uart;

    if (!receiver->config.sends || ((uart->ISR & UART_ISR_TXE) == 0u)) {
        return false;
    }
    uart->TDR = value;
    return true;
}
