/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file dma_ring.h
 * @brief A stream of DMA that moves what one register of a peripheral has round a ring in memory.
 *
 * receiver.h and capture.h share it; their requirements cover it. The ring must lie where no cache
 * is between, in DTCM.
 */
#ifndef KEEL_BSP_STM32F767_DMA_RING_H
#define KEEL_BSP_STM32F767_DMA_RING_H

#include "common/wait.h"
#include "stm32f767/registers/dma.h"

#include <stdbool.h>
#include <stdint.h>

/** A stream. */
typedef struct keel_dma_ring {
    keel_dma_t *dma;  /**< With its clock on. */
    uint32_t stream;  /**< 0 to 7. */
    uint32_t channel; /**< Of the stream: the peripheral that it hears, 0 to 15. */
} keel_dma_ring_t;

/** The size of what is moved, as PSIZE and MSIZE have it. */
typedef enum keel_dma_size {
    KEEL_DMA_BYTE = 0,
    KEEL_DMA_HALF_WORD = 1
} keel_dma_size_t;

/** Whether stream and channel are in their ranges. */
bool keel_dma_ring_is_valid(const keel_dma_ring_t *ring);

/**
 * Switches the stream off.
 *
 * @param ring the stream
 * @param wait the bound, some cycles
 * @return whether it is off within the bound
 */
bool keel_dma_ring_stop(const keel_dma_ring_t *ring, const keel_wait_t *wait);

/**
 * Starts the stream, which is off, from the ring's beginning.
 *
 * @param ring  the stream
 * @param from  the register
 * @param to    the ring
 * @param count how many pieces the ring has
 * @param size  of a piece
 */
void keel_dma_ring_begin(const keel_dma_ring_t *ring, const volatile uint32_t *from,
                         const volatile uint8_t *to, uint32_t count, keel_dma_size_t size);

/** Pieces to the ring's end: as many as it has at its beginning. */
uint32_t keel_dma_ring_left(const keel_dma_ring_t *ring);

/** Whether an error of the bus has stopped the stream. */
bool keel_dma_ring_failed(const keel_dma_ring_t *ring);

/**
 * Whether the stream is off; if not, it is told to switch off, without waiting.
 *
 * @param ring the stream, of which a transfer failed
 */
bool keel_dma_ring_is_off(const keel_dma_ring_t *ring);

#endif
