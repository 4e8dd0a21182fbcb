/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file capture.h
 * @brief The times of rising edges at a timer's input, for PPM: the timer captures each, DMA writes
 *        it into a ring, the main loop looks at how far that came, and tasks read them.
 *
 * Nothing waits and nothing interrupts. The timer counts microseconds, and the time from an edge to
 * the next is right to the microsecond however late a look comes: what the timer's 16 bits leave
 * open, whole 65 536 us, the clock of the looks tells. That holds while looks are
 * KEEL_CAPTURE_TRUSTED_US apart at most; after a longer time edges are forgotten, and the next one
 * tells the gap.
 *
 * The timer's filter takes no level that lasts for less than 4.7 us, at its clock of 216 MHz.
 *
 * More than KEEL_CAPTURE_TRUSTED edges from look to look are noise: PPM has one each 800 us. Of
 * more than the ring holds, some are lost without a word.
 *
 * A capture must lie in DTCM (KEEL_REALTIME_ZERO), as receiver.h says of receivers.
 *
 * All counts and times stay at UINT32_MAX.
 */
#ifndef KEEL_BSP_STM32F767_CAPTURE_H
#define KEEL_BSP_STM32F767_CAPTURE_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/registers/dma.h"
#include "stm32f767/registers/tim.h"

#include <stdbool.h>
#include <stdint.h>

/** Edges of the ring; a power of two. */
#define KEEL_CAPTURE_CAPACITY 64u

/** Edges that may come from look to look, and that may be unread. */
#define KEEL_CAPTURE_TRUSTED 48u

/** The longest time between two looks, in us: less than half of the timer's 65 536. */
#define KEEL_CAPTURE_TRUSTED_US 20000u

/** What a capture is made from. */
typedef struct keel_capture_config {
    keel_tim_t *tim;         /**< With its clock on; channel 1 captures. */
    uint32_t timer_hz;       /**< The timer's clock, a multiple of 1 MHz. */
    keel_dma_t *dma;         /**< With its clock on. */
    uint32_t stream;         /**< Of the DMA that hears channel 1, 0 to 7 (RM0410, 8.3.3). */
    uint32_t channel;        /**< Of the stream: the one of the timer's channel 1, 0 to 15. */
    const keel_wait_t *wait; /**< The bound for the stream to stop, some cycles. */
} keel_capture_config_t;

/** What came, and what did not. */
typedef struct keel_capture_count {
    uint32_t edges;     /**< Edges that looks found. */
    uint32_t overruns;  /**< Looks behind an edge that DMA did not take in time. */
    uint32_t laps;      /**< Times that edges may have been overwritten or their times unknown, and
                             unread ones were forgotten. */
    uint32_t transfers; /**< Times that DMA stopped for a bus error, and was started again. */
} keel_capture_count_t;

/** A capture. The caller owns it, in DTCM; only the functions below and DMA write it. */
typedef struct keel_capture {
    keel_capture_config_t config; /**< What it was started with. */
    keel_capture_count_t count;   /**< Since its start. */
    uint32_t look_us;             /**< The time of the last look, in us, modulo 2^32. */
    uint32_t quiet_us;            /**< From the look that found the last edge to the last look. */
    uint32_t head;                /**< Edges found, modulo 2^32; modulo the capacity, where DMA
                                       writes the next. */
    uint32_t tail;                /**< Edges read or forgotten, modulo 2^32. */
    uint16_t last;                /**< What the timer counted at the last edge. */
    bool has_last;                /**< Whether there was one since edges were forgotten. */
    uint32_t elapsed_us[KEEL_CAPTURE_CAPACITY];    /**< Of each edge, since the one before. */
    volatile uint16_t ring[KEEL_CAPTURE_CAPACITY]; /**< Written by DMA. */
} keel_capture_t;

/**
 * Starts a capture, or starts it anew: what was unread is forgotten, and counts begin at 0
 * (requirements CAP-001 and CAP-002). A capture that was started already must have the same timer
 * and stream.
 *
 * @param capture the capture
 * @param config  what it is made from; copied
 * @param now_us  the time, in us, modulo 2^32
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT for a clock that is no multiple of 1 MHz, a stream above 7
 *         or a channel above 15: capture and hardware are as they were; KEEL_BSP_TIMEOUT when the
 *         stream does not stop: then the timer is off, and the capture as it was
 */
keel_bsp_status_t keel_capture_start(keel_capture_t *capture, const keel_capture_config_t *config,
                                     uint32_t now_us);

/**
 * Looks at the edges that came: to be called in every turn of the main loop (requirements CAP-003
 * to CAP-005). Never waits.
 *
 * @param capture the capture, started
 * @param now_us  the time, in us, modulo 2^32; less than 2^32 us after the last look
 */
void keel_capture_turn(keel_capture_t *capture, uint32_t now_us);

/**
 * Reads the next edge that a look found; never waits (requirement CAP-006).
 *
 * @param capture    the capture, started
 * @param elapsed_us the time since the edge that was read before, or since the start, in us
 * @return whether there is one; else elapsed_us is as it was
 */
bool keel_capture_read(keel_capture_t *capture, uint32_t *elapsed_us);

#endif
