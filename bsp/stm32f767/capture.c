/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/capture.h"

#include "common/progress.h"
#include "stm32f767/dma_ring.h"
#include "stm32f767/time_base.h"

#define TICK_HZ        1000000u
#define WRAP           0x10000u /* The timer's 16 bits, in us. */
#define HALF_WRAP      0x8000u
#define DIRECT_INPUT   1u  /* CC1S: channel 1 captures at its own pin. */
#define SLOWEST_FILTER 15u /* IC1F: 8 samples that agree, each 32 clocks of the filter apart. */
#define QUARTER_CLOCK  2u  /* CKD: a clock of the filter is four of the timer's. */

static keel_dma_ring_t stream_of_edges(const keel_capture_config_t *config)
{
    return (keel_dma_ring_t){config->dma, config->stream, config->channel};
}

/* Captures go round the ring, from its beginning. The stream is off. */
static void begin_edges(keel_capture_t *capture)
{
    const keel_dma_ring_t ring = stream_of_edges(&capture->config);

    capture->head = 0u;
    capture->tail = 0u;
    keel_dma_ring_begin(&ring, &capture->config.tim->CCR1,
                        (const volatile uint8_t *)&capture->ring[0], KEEL_CAPTURE_CAPACITY,
                        KEEL_DMA_HALF_WORD);
}

/* The channel is set up while it is off, and comes on with DMA behind it. */
static void begin_timer(keel_tim_t *tim, uint32_t prescaler)
{
    tim->CCER = 0u;
    tim->PSC = prescaler;
    tim->ARR = WRAP - 1u;
    tim->CCMR1 = FIELD(TIM_CCMR1_CC1S, DIRECT_INPUT) | FIELD(TIM_CCMR1_IC1F, SLOWEST_FILTER);
    tim->EGR = TIM_EGR_UG; /* Takes the prescaler over. */
    tim->SR = 0u;
    tim->DIER = TIM_DIER_CC1DE;
    tim->CCER = TIM_CCER_CC1E; /* Rising edges. */
    tim->CR1 = FIELD(TIM_CR1_CKD, QUARTER_CLOCK) | TIM_CR1_CEN;
}

keel_bsp_status_t keel_capture_start(keel_capture_t *capture, const keel_capture_config_t *config,
                                     uint32_t now_us)
{
    const keel_dma_ring_t ring = stream_of_edges(config);
    uint32_t prescaler;

    if (!keel_dma_ring_is_valid(&ring) ||
        (keel_timer_prescaler(config->timer_hz, TICK_HZ, &prescaler) != KEEL_BSP_OK)) {
        return KEEL_BSP_ARGUMENT;
    }
    config->tim->CR1 = 0u;
    config->tim->DIER = 0u; /* Asks DMA for nothing more. */
    if (!keel_dma_ring_stop(&ring, config->wait)) {
        return KEEL_BSP_TIMEOUT;
    }
    capture->config = *config;
    capture->count = (keel_capture_count_t){0};
    capture->look_us = now_us;
    capture->quiet_us = 0u;
    capture->has_last = false;
    begin_edges(capture);
    begin_timer(config->tim, prescaler);
    return KEEL_BSP_OK;
}

/* The time of which the timer tells all but whole wraps, next to what the looks say: those are off
 * by less than half a wrap. */
static uint32_t unwrapped(uint32_t about_us, uint32_t rest_us)
{
    uint32_t whole_us = 0u;

    if (about_us > (UINT32_MAX - WRAP)) {
        return UINT32_MAX;
    }
    if ((about_us + HALF_WRAP) > rest_us) {
        whole_us = (((about_us + HALF_WRAP) - rest_us) / WRAP) * WRAP;
    }
    return whole_us + rest_us;
}

/* Without an edge before it an edge has the time of the looks. */
static void take_edge(keel_capture_t *capture)
{
    const uint32_t place = capture->head % KEEL_CAPTURE_CAPACITY;
    const uint16_t now = capture->ring[place];
    const uint32_t rest_us = ((uint32_t)now - capture->last) % WRAP;

    capture->elapsed_us[place] = capture->has_last ? unwrapped(capture->quiet_us, rest_us)
                                                   : capture->quiet_us;
    capture->last = now;
    capture->has_last = true;
    capture->quiet_us = 0u;
    capture->head++;
}

static void take_edges(keel_capture_t *capture, uint32_t came, uint32_t passed_us)
{
    capture->quiet_us = keel_progress_sum(capture->quiet_us, passed_us);
    for (uint32_t i = 0u; i < came; i++) {
        take_edge(capture);
    }
}

/* What is unread is forgotten, but for its time: the next edge tells it, as it tells of a gap. */
static void forget_edges(keel_capture_t *capture, uint32_t came, uint32_t passed_us)
{
    capture->quiet_us = keel_progress_sum(capture->quiet_us, passed_us);
    while (capture->tail != capture->head) {
        capture->quiet_us = keel_progress_sum(
            capture->quiet_us, capture->elapsed_us[capture->tail % KEEL_CAPTURE_CAPACITY]);
        capture->tail++;
    }
    capture->head += came;
    capture->tail = capture->head;
    capture->has_last = false;
}

/* DMA counts an edge some cycles before it lies in the ring, as a byte of a receiver. Its time is
 * read here, so a look begins with the count and goes on to another register of a peripheral. */
static void look_at_edges(keel_capture_t *capture, uint32_t passed_us)
{
    const keel_dma_ring_t ring = stream_of_edges(&capture->config);
    const uint32_t place = KEEL_CAPTURE_CAPACITY - keel_dma_ring_left(&ring);
    const uint32_t status = capture->config.tim->SR;
    const uint32_t came = (place - capture->head) % KEEL_CAPTURE_CAPACITY;
    const uint32_t unread = (capture->head - capture->tail) + came;

    if ((status & TIM_SR_CC1OF) != 0u) {
        capture->config.tim->SR = ~TIM_SR_CC1OF; /* Zeros clear. */
        capture->count.overruns = keel_progress_next(capture->count.overruns);
    }
    capture->count.edges = keel_progress_sum(capture->count.edges, came);
    if ((passed_us > KEEL_CAPTURE_TRUSTED_US) || (unread > KEEL_CAPTURE_TRUSTED)) {
        capture->count.laps = keel_progress_next(capture->count.laps);
        forget_edges(capture, came, passed_us);
    } else {
        take_edges(capture, came, passed_us);
    }
}

/* An error of the bus has stopped the stream. Should it not be off yet, the next look finds it. */
static void recover_edges(keel_capture_t *capture, uint32_t passed_us)
{
    const keel_dma_ring_t ring = stream_of_edges(&capture->config);

    forget_edges(capture, 0u, passed_us);
    if (keel_dma_ring_is_off(&ring)) {
        capture->count.transfers = keel_progress_next(capture->count.transfers);
        begin_edges(capture);
    }
}

void keel_capture_turn(keel_capture_t *capture, uint32_t now_us)
{
    const uint32_t passed_us = now_us - capture->look_us;
    const keel_dma_ring_t ring = stream_of_edges(&capture->config);

    capture->look_us = now_us;
    if (keel_dma_ring_failed(&ring)) {
        recover_edges(capture, passed_us);
    } else {
        look_at_edges(capture, passed_us);
    }
}

bool keel_capture_read(keel_capture_t *capture, uint32_t *elapsed_us)
{
    if (capture->tail == capture->head) {
        return false;
    }
    *elapsed_us = capture->elapsed_us[capture->tail % KEEL_CAPTURE_CAPACITY];
    capture->tail++;
    return true;
}
