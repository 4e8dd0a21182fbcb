/* SPDX-License-Identifier: Apache-2.0 */
/* The lines of a board: UARTs whose bytes DMA takes, for receivers and ground stations, and the pin
 * of a receiver of PPM, whose edges a timer captures. */
#include "board.h"
#include "stm32f767/capture.h"
#include "stm32f767/clock_tree.h"
#include "stm32f767/receiver.h"
#include "stm32f767/registers/rcc.h"
#include "stm32f767/target/chip.h"
#include "stm32f767/target/chip_parts.h"

#include <stddef.h>

#define RCC  ((keel_rcc_t *)RCC_BASE)
#define TIM8 ((keel_tim_t *)TIM8_BASE)
#define DMA2 ((keel_dma_t *)DMA2_BASE)
#define PINS (&keel_board_pins)

/* What hears channel 1 of timer 8 (RM0410, table 28). */
#define PPM_STREAM  2u
#define PPM_CHANNEL 7u

/* A stream stops at the end of a byte's transfer. */
static const keel_wait_t stream_patience = {1000u, NULL, NULL};

/* In DTCM, which DMA reaches and no cache covers. */
static keel_receiver_t receiver[KEEL_CHIP_LINES] KEEL_REALTIME_ZERO;
static bool is_started[KEEL_CHIP_LINES];
static keel_capture_t capture KEEL_REALTIME_ZERO;
static bool captures;

bool keel_chip_has_line(keel_chip_line_t name)
{
    return PINS->lines[name].uart != NULL;
}

keel_bsp_status_t keel_chip_line_start(keel_chip_line_t name, const keel_line_t *line)
{
    const keel_board_line_t *const place = &PINS->lines[name];
    const keel_receiver_config_t config = {
        .uart = place->uart,
        .dma = place->dma,
        .stream = place->stream,
        .channel = place->channel,
        .clock_hz = place->on_apb2 ? KEEL_APB2_LIMIT_HZ : KEEL_APB1_LIMIT_HZ,
        .wait = &stream_patience,
        .line = *line,
        .sends = place->sends,
    };
    keel_bsp_status_t status = KEEL_BSP_ARGUMENT;

    if (place->uart == NULL) {
        return status;
    }
    keel_bits_enable(place->on_apb2 ? &RCC->APB2ENR : &RCC->APB1ENR, place->enable);
    keel_bits_enable(&RCC->AHB1ENR, RCC_AHB1ENR_DMA1EN | RCC_AHB1ENR_DMA2EN);
    status = keel_receiver_start(&receiver[name], &config, keel_board_clock_us(NULL));
    if (status == KEEL_BSP_OK) {
        /* No pull at an input: a sender that is there drives it, and its level is the sender's. */
        keel_chip_give(place->rx, KEEL_PULL_NONE);
        if (place->sends) {
            keel_chip_give(place->tx, KEEL_PULL_UP);
        }
        is_started[name] = true;
    }
    return status;
}

bool keel_chip_line_read(keel_chip_line_t name, keel_receiver_byte_t *byte)
{
    return is_started[name] && keel_receiver_read(&receiver[name], byte);
}

bool keel_chip_line_send(keel_chip_line_t name, uint8_t value)
{
    return is_started[name] && keel_receiver_send(&receiver[name], value);
}

bool keel_chip_has_ppm(void)
{
    return PINS->ppm != NULL;
}

/* Receivers drive the pin, or, as the sockets of some transmitters do, only pull it low. */
keel_bsp_status_t keel_chip_ppm_start(void)
{
    const uint32_t apb2 = keel_bus_divisor(KEEL_CORE_HZ, KEEL_APB2_LIMIT_HZ);
    const keel_capture_config_t config = {.tim = TIM8,
                                          .timer_hz = keel_timer_hz(KEEL_CORE_HZ, apb2),
                                          .dma = DMA2,
                                          .stream = PPM_STREAM,
                                          .channel = PPM_CHANNEL,
                                          .wait = &stream_patience};
    keel_bsp_status_t status = KEEL_BSP_ARGUMENT;

    if (PINS->ppm == NULL) {
        return status;
    }
    keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_TIM8EN);
    keel_bits_enable(&RCC->AHB1ENR, RCC_AHB1ENR_DMA2EN);
    status = keel_capture_start(&capture, &config, keel_board_clock_us(NULL));
    if (status == KEEL_BSP_OK) {
        keel_chip_give(*PINS->ppm, KEEL_PULL_UP);
        captures = true;
    }
    return status;
}

bool keel_chip_ppm_read(uint32_t *elapsed_us)
{
    return captures && keel_capture_read(&capture, elapsed_us);
}

const keel_receiver_count_t *keel_chip_line_count(keel_chip_line_t name)
{
    return &receiver[name].count;
}

void keel_chip_lines_turn(uint32_t now_us)
{
    for (uint32_t i = 0u; i < KEEL_CHIP_LINES; i++) {
        if (is_started[i]) {
            keel_receiver_turn(&receiver[i], now_us);
        }
    }
    if (captures) {
        keel_capture_turn(&capture, now_us);
    }
}
