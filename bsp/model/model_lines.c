/* SPDX-License-Identifier: Apache-2.0 */
/* UARTs with the streams of DMA that take their bytes round a ring, and who sends.
 *
 * Bytes that come in other bits than the registers say are flagged, and not moved. */
#include "model.h"

#include "stm32f767/registers/dma.h"
#include "stm32f767/registers/gpio.h"
#include "stm32f767/registers/uart.h"

#include <stddef.h>
#include <string.h>

#define TICKS_PER_S 432000000u
#define TOLERANCE   50u /* 1 in 50. */
#define ROOM        4096u
#define UARTS_END   0x400u
#define FLAG_BITS   0x3Fu
#define COMPLETE    0x20u
#define HALF        0x10u
#define TELEMETRY   57600u
#define PORT_SIZE   0x400u
#define MILLE       1000u
#define GAP_US      150u /* Between two things that an undriven line brings: at least, … */
#define GAP_MORE_US 700u /* … and at most so much more. */
#define GOOD_ONE_IN 8u   /* Of these that look like a byte. */
#define MISHAPS     6u
#define ERRORS      (UART_ISR_PE | UART_ISR_FE | UART_ISR_NF | UART_ISR_ORE)

/* A line as the board wires it. */
typedef struct model_wiring {
    uint32_t uart;
    uint32_t dma; /* 1 or 2. */
    uint32_t stream;
    uint32_t channel;
    uint32_t clock_hz;
    uint8_t port;
    uint8_t pin;
    uint8_t function;
} model_wiring_t;

/* A UART with its stream. */
typedef struct model_uart {
    uint32_t status;
    uint8_t received;
    uint32_t size;  /* Of the ring. */
    uint32_t flags; /* Of the stream, as stream 0 has them in LISR. */
    uint64_t sent_until;
} model_uart_t;

/* Bytes of the telemetry in one direction. */
typedef struct model_queue {
    uint8_t bytes[ROOM];
    uint64_t at[ROOM]; /* When each has come. */
    uint32_t head;
    uint32_t tail;
} model_queue_t;

static const model_wiring_t wirings[MODEL_LINES] = {
    [MODEL_PILOT] = {USART6_BASE, 2u, 1u, 5u, 108000000u, 6u, 9u, 8u},
    [MODEL_SPARE] = {USART3_BASE, 1u, 1u, 4u, 54000000u, 3u, 9u, 7u},
    [MODEL_SATELLITES] = {USART1_BASE, 2u, 5u, 4u, 108000000u, 1u, 7u, 7u},
    [MODEL_TELEMETRY] = {USART2_BASE, 1u, 5u, 4u, 54000000u, 3u, 6u, 7u},
};
static const uint8_t flag_places[4] = {0u, 6u, 16u, 22u};

static model_uart_t uarts[MODEL_LINES];
static model_bits_t senders[MODEL_LINES];
static uint32_t taken[SIM_RECEIVERS];
static model_disturbance_t disturbances[MODEL_LINES];
static uint64_t brings_at_us[MODEL_LINES]; /* When an undriven line brings something. */
static uint32_t chance;
static model_queue_t up;
static model_queue_t down;

static uint32_t *uart_word(model_line_t line, uint32_t offset)
{
    return model_word(wirings[line].uart + offset);
}

static uint32_t *stream_word(model_line_t line, uint32_t offset)
{
    const uint32_t base = (wirings[line].dma == 1u) ? DMA1_BASE : DMA2_BASE;

    return model_word(base + (uint32_t)offsetof(keel_dma_t, stream) +
                      (wirings[line].stream * (uint32_t)sizeof(keel_dma_stream_t)) + offset);
}

void model_lines_start(void)
{
    memset(taken, 0, sizeof taken);
    memset(&up, 0, sizeof up);
    memset(&down, 0, sizeof down);
    memset(disturbances, 0, sizeof disturbances);
    chance = 1u;
    senders[MODEL_PILOT] = (model_bits_t){100000u, true, true, true};
    senders[MODEL_SATELLITES] = (model_bits_t){115200u, false, false, false};
    senders[MODEL_TELEMETRY] = (model_bits_t){TELEMETRY, false, false, false};
}

void model_lines_reset(void)
{
    memset(uarts, 0, sizeof uarts);
    for (uint32_t i = 0u; i < (uint32_t)MODEL_LINES; i++) {
        *stream_word((model_line_t)i, offsetof(keel_dma_stream_t, FCR)) = 0x21u;
    }
}

void model_line_disturb(model_line_t line, const model_disturbance_t *disturbance)
{
    disturbances[line] = *disturbance;
    brings_at_us[line] = model_now_us();
}

void model_pilot_sends(const model_bits_t *bits)
{
    senders[MODEL_PILOT] = *bits;
}

bool model_is_uart(uint32_t address, model_line_t *line)
{
    for (uint32_t i = 0u; i < (uint32_t)MODEL_LINES; i++) {
        if ((address - wirings[i].uart) < sizeof(keel_uart_t)) {
            *line = (model_line_t)i;
            return true;
        }
    }
    return false;
}

/* --- A byte comes. --- */

/* Whether the UART makes bits as its sender does. */
static bool fits(model_line_t line)
{
    const model_bits_t *const sender = &senders[line];
    const uint32_t divisor = *uart_word(line, offsetof(keel_uart_t, BRR));
    const uint32_t made = wirings[line].clock_hz / ((divisor > 0u) ? divisor : 1u);
    const uint32_t off = (made > sender->baud) ? (made - sender->baud) : (sender->baud - made);
    const uint32_t control = *uart_word(line, offsetof(keel_uart_t, CR1));
    const bool parity = (control & UART_CR1_PCE) != 0u;
    const bool inverted = (*uart_word(line, offsetof(keel_uart_t, CR2)) & UART_CR2_RXINV) != 0u;

    return ((off * TOLERANCE) <= sender->baud) && (inverted == sender->inverted) &&
           (parity == sender->even_parity);
}

/* DMA moves what the UART has, if it may. */
static void move_byte(model_line_t line)
{
    model_uart_t *const uart = &uarts[line];
    uint32_t *const left = stream_word(line, offsetof(keel_dma_stream_t, NDTR));
    const uint32_t control = *stream_word(line, offsetof(keel_dma_stream_t, CR));
    uint8_t *place;

    if (((control & DMA_CR0_EN) == 0u) || ((uart->status & UART_ISR_RXNE) == 0u) ||
        ((*uart_word(line, offsetof(keel_uart_t, CR3)) & UART_CR3_DMAR) == 0u)) {
        return;
    }
    place = model_memory(*stream_word(line, offsetof(keel_dma_stream_t, M0AR)) + uart->size - *left,
                         1u);
    if (place == NULL) {
        model_fail("DMA moves a byte to where no memory is");
        return;
    }
    *place = uart->received;
    uart->status &= ~UART_ISR_RXNE;
    uart->flags |= (*left == 1u) ? COMPLETE : 0u;
    uart->flags |= ((*left - 1u) == (uart->size / 2u)) ? HALF : 0u;
    *left = (*left == 1u) ? uart->size : (*left - 1u);
}

/* Whether it hears at all: after an overrun not until its flag is cleared. */
static bool hears(model_line_t line)
{
    const model_wiring_t *const wiring = &wirings[line];
    const uint32_t on = UART_CR1_UE | UART_CR1_RE;

    return ((*uart_word(line, offsetof(keel_uart_t, CR1)) & on) == on) &&
           ((uarts[line].status & UART_ISR_ORE) == 0u) &&
           model_pin_has(wiring->port, wiring->pin, wiring->function);
}

/* A byte with an error is flagged, and not moved (RM0410, 34.8.3, DDRE). */
static void receive_error(model_line_t line, uint32_t flag)
{
    if (hears(line)) {
        uarts[line].status |= flag;
    }
}

static void receive_byte(model_line_t line, uint8_t byte)
{
    model_uart_t *const uart = &uarts[line];

    if (!hears(line)) {
        return;
    }
    if (!fits(line)) {
        uart->status |= UART_ISR_FE;
        return;
    }
    if ((uart->status & UART_ISR_RXNE) != 0u) {
        uart->status |= UART_ISR_ORE;
        return;
    }
    uart->received = byte;
    uart->status |= UART_ISR_RXNE;
    move_byte(line);
}

/* --- What disturbs a line. --- */

/* Below a limit, by a generator of its own (Numerical Recipes' constants). */
static uint32_t drawn(uint32_t limit)
{
    chance = (chance * 1664525u) + 1013904223u;
    return (chance >> 8u) % limit;
}

static bool has_parity(model_line_t line)
{
    return (*uart_word(line, offsetof(keel_uart_t, CR1)) & UART_CR1_PCE) != 0u;
}

/* Parity finds one bit that has changed, but not two. */
static void receive_disturbed(model_line_t line, uint8_t byte)
{
    const uint8_t bit = (uint8_t)(1u << drawn(8u));

    switch (drawn(MISHAPS)) {
    case 0u: /* Its start bit is not seen. */
        break;
    case 1u:
        receive_error(line, UART_ISR_FE);
        break;
    case 2u:
        receive_error(line, UART_ISR_NF);
        break;
    case 3u:
        if (has_parity(line)) {
            receive_error(line, UART_ISR_PE);
        } else {
            receive_byte(line, byte ^ bit);
        }
        break;
    case 4u:
        receive_byte(line, (uint8_t)(byte ^ bit ^ ((bit == 0x80u) ? 1u : (uint8_t)(bit << 1u))));
        break;
    default: /* Something comes before it. */
        receive_byte(line, (uint8_t)drawn(256u));
        receive_byte(line, byte);
        break;
    }
}

static void receive_sent(model_line_t line, uint8_t byte)
{
    if (drawn(MILLE) < disturbances[line].noise) {
        receive_disturbed(line, byte);
    } else {
        receive_byte(line, byte);
    }
}

/* A pin with a pull rests; without one it takes what the wires beside it do for bits, few of which
 * make a byte. */
static void hear_nobody(model_line_t line)
{
    const model_wiring_t *const wiring = &wirings[line];
    const uint32_t pulls = *model_word(GPIOA_BASE + (PORT_SIZE * wiring->port) +
                                       offsetof(keel_gpio_t, PUPDR));

    while (brings_at_us[line] <= model_now_us()) {
        brings_at_us[line] += GAP_US + drawn(GAP_MORE_US);
        if (((pulls >> (2u * wiring->pin)) & 3u) != 0u) {
            /* It rests. */
        } else if (drawn(GOOD_ONE_IN) == 0u) {
            if (hears(line) && ((uarts[line].status & UART_ISR_RXNE) == 0u)) {
                uarts[line].received = (uint8_t)drawn(256u);
                uarts[line].status |= UART_ISR_RXNE;
                move_byte(line);
            }
        } else {
            receive_error(line, UART_ISR_FE | UART_ISR_NF);
        }
    }
}

/* The bytes of one of the plant's receivers that have come by now. */
static void hear_receiver(model_line_t line, uint32_t number)
{
    const sim_receiver_t *const from = &model_sensors()->receiver[number];
    const uint32_t now_us = (uint32_t)model_now_us();

    if ((from->count - taken[number]) > (uint32_t)SIM_RING) {
        taken[number] = from->count - (uint32_t)SIM_RING; /* Too late for those before. */
    }
    while ((taken[number] != from->count) &&
           ((now_us - from->at_us[taken[number] % SIM_RING]) < 0x80000000u)) {
        if (!disturbances[line].silent && !disturbances[line].unplugged) {
            receive_sent(line, (uint8_t)from->byte[taken[number] % SIM_RING]);
        }
        taken[number]++;
    }
    if (disturbances[line].unplugged) {
        hear_nobody(line);
    }
}

static void hear_telemetry(void)
{
    while ((up.tail != up.head) && (up.at[up.tail % ROOM] <= model_now())) {
        receive_byte(MODEL_TELEMETRY, up.bytes[up.tail % ROOM]);
        up.tail++;
    }
}

/* What has come by now. */
static void hear(model_line_t line)
{
    if (line == MODEL_PILOT) {
        hear_receiver(line, 0u);
    } else if (line == MODEL_SATELLITES) {
        hear_receiver(line, 1u);
    } else if (line == MODEL_TELEMETRY) {
        hear_telemetry();
    } else {
        /* Nobody sends. */
    }
}

/* --- The UART's registers. --- */

static uint64_t sent_byte_ticks(model_line_t line)
{
    const uint32_t divisor = *uart_word(line, offsetof(keel_uart_t, BRR));

    return ((uint64_t)10u * divisor * TICKS_PER_S) / wirings[line].clock_hz;
}

static uint32_t free_flags(model_line_t line)
{
    const uint64_t until = uarts[line].sent_until;
    const uint64_t now = model_now();

    return ((until <= (now + sent_byte_ticks(line))) ? UART_ISR_TXE : 0u) |
           ((until <= now) ? UART_ISR_TC : 0u);
}

uint32_t model_uart_read(model_line_t line, uint32_t offset)
{
    hear(line);
    if (offset == offsetof(keel_uart_t, ISR)) {
        return uarts[line].status | free_flags(line);
    }
    if (offset == offsetof(keel_uart_t, RDR)) {
        uarts[line].status &= ~UART_ISR_RXNE;
        return uarts[line].received;
    }
    return *uart_word(line, offset);
}

/* A byte goes out; that of the telemetry is heard at its end. */
static void send_byte(model_line_t line, uint8_t byte)
{
    model_uart_t *const uart = &uarts[line];
    const uint64_t now = model_now();

    uart->sent_until = ((uart->sent_until > now) ? uart->sent_until : now) + sent_byte_ticks(line);
    if ((line == MODEL_TELEMETRY) && ((down.head - down.tail) < ROOM)) {
        down.bytes[down.head % ROOM] = byte;
        down.at[down.head % ROOM] = uart->sent_until;
        down.head++;
    }
}

void model_uart_write(model_line_t line, uint32_t offset, uint32_t value)
{
    hear(line);
    if (offset == offsetof(keel_uart_t, ICR)) {
        uarts[line].status &= ~(value & ERRORS);
    } else if (offset == offsetof(keel_uart_t, TDR)) {
        send_byte(line, (uint8_t)value);
    } else {
        *uart_word(line, offset) = value;
        if ((*uart_word(line, offsetof(keel_uart_t, CR1)) & UART_CR1_UE) == 0u) {
            uarts[line].status = 0u;
        }
        move_byte(line);
    }
}

/* --- The registers of DMA. --- */

static void hear_stream_lines(uint32_t dma)
{
    for (uint32_t i = 0u; i < (uint32_t)MODEL_LINES; i++) {
        if (wirings[i].dma == dma) {
            hear((model_line_t)i);
        }
    }
}

uint32_t model_dma_read(uint32_t dma, uint32_t offset)
{
    const uint32_t first = offset; /* The lower word is of streams 0 to 3, the upper of 4 to 7. */
    uint32_t flags = 0u;

    hear_stream_lines(dma);
    if (offset > offsetof(keel_dma_t, HISR)) {
        return *model_word(((dma == 1u) ? DMA1_BASE : DMA2_BASE) + offset);
    }
    for (uint32_t i = 0u; i < (uint32_t)MODEL_LINES; i++) {
        if ((wirings[i].dma == dma) && ((wirings[i].stream - first) < 4u)) {
            flags |= uarts[i].flags << flag_places[wirings[i].stream - first];
        }
    }
    return flags;
}

static void clear_stream_flags(uint32_t dma, uint32_t first, uint32_t value)
{
    for (uint32_t i = 0u; i < (uint32_t)MODEL_LINES; i++) {
        if ((wirings[i].dma == dma) && ((wirings[i].stream - first) < 4u)) {
            uarts[i].flags &= ~((value >> flag_places[wirings[i].stream - first]) & FLAG_BITS);
        }
    }
}

/* A stream that is switched on takes its ring's size over. */
static void start_streams(void)
{
    for (uint32_t i = 0u; i < (uint32_t)MODEL_LINES; i++) {
        const model_line_t line = (model_line_t)i;
        const uint32_t control = *stream_word(line, offsetof(keel_dma_stream_t, CR));

        if ((control & DMA_CR0_EN) == 0u) {
            uarts[i].size = 0u;
        } else if (uarts[i].size == 0u) {
            uarts[i].size = *stream_word(line, offsetof(keel_dma_stream_t, NDTR));
            if (keel_bits_get(control, DMA_CR0_CHSEL) != wirings[i].channel) {
                model_fail("a stream of DMA %u does not hear its UART", wirings[i].dma);
            }
            move_byte(line);
        } else {
            /* It goes on. */
        }
    }
}

void model_dma_write(uint32_t dma, uint32_t offset, uint32_t value)
{
    hear_stream_lines(dma);
    if ((offset == offsetof(keel_dma_t, LIFCR)) || (offset == offsetof(keel_dma_t, HIFCR))) {
        clear_stream_flags(dma, offset - (uint32_t)offsetof(keel_dma_t, LIFCR), value);
        return;
    }
    *model_word(((dma == 1u) ? DMA1_BASE : DMA2_BASE) + offset) = value;
    start_streams();
}

/* --- Telemetry. --- */

uint32_t model_telemetry_send(const uint8_t *bytes, uint32_t size)
{
    const uint64_t byte_ticks = ((uint64_t)10u * TICKS_PER_S) / TELEMETRY;
    uint32_t count = 0u;

    while ((count < size) && ((up.head - up.tail) < ROOM)) {
        const uint64_t before = (up.head != up.tail) ? up.at[(up.head - 1u) % ROOM] : 0u;

        up.bytes[up.head % ROOM] = bytes[count];
        up.at[up.head % ROOM] = ((before > model_now()) ? before : model_now()) + byte_ticks;
        up.head++;
        count++;
    }
    return count;
}

uint32_t model_telemetry_receive(uint8_t *bytes, uint32_t size)
{
    uint32_t count = 0u;

    while ((count < size) && (down.tail != down.head) &&
           (down.at[down.tail % ROOM] <= model_now())) {
        bytes[count] = down.bytes[down.tail % ROOM];
        down.tail++;
        count++;
    }
    return count;
}
