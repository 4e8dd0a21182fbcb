/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/dma_ring.h"

#define STREAM_MAX     7u
#define CHANNEL_MAX    15u
#define PRIORITY       2u /* High, of four: what comes by a line cannot wait. */
#define STREAMS_A_WORD 4u /* Whose flags share a register. */

#define ALL_FLAGS                                                                                  \
    (DMA_LIFCR_CFEIF0 | DMA_LIFCR_CDMEIF0 | DMA_LIFCR_CTEIF0 | DMA_LIFCR_CHTIF0 | DMA_LIFCR_CTCIF0)

static keel_dma_stream_t *stream_of(const keel_dma_ring_t *ring)
{
    return &ring->dma->stream[ring->stream];
}

/* Flags of stream 0, where the stream has them in its register (RM0410, 8.5.1). */
static uint32_t flags_of(const keel_dma_ring_t *ring, uint32_t flags)
{
    static const uint32_t flag_places[STREAMS_A_WORD] = {0u, 6u, 16u, 22u};

    return flags << flag_places[ring->stream % STREAMS_A_WORD];
}

/* Clears the stream's flags, or it would not start again (RM0410, 8.3.18). */
static void clear_flags(const keel_dma_ring_t *ring)
{
    const uint32_t flags = flags_of(ring, ALL_FLAGS);

    if (ring->stream < STREAMS_A_WORD) {
        ring->dma->LIFCR = flags;
    } else {
        ring->dma->HIFCR = flags;
    }
}

bool keel_dma_ring_is_valid(const keel_dma_ring_t *ring)
{
    return (ring->stream <= STREAM_MAX) && (ring->channel <= CHANNEL_MAX);
}

bool keel_dma_ring_stop(const keel_dma_ring_t *ring, const keel_wait_t *wait)
{
    keel_dma_stream_t *const stream = stream_of(ring);

    stream->CR &= ~DMA_CR0_EN;
    return keel_wait_for(&stream->CR, DMA_CR0_EN, 0u, wait);
}

void keel_dma_ring_begin(const keel_dma_ring_t *ring, const volatile uint32_t *from,
                         const volatile uint8_t *to, uint32_t count, keel_dma_size_t size)
{
    keel_dma_stream_t *const stream = stream_of(ring);

    clear_flags(ring);
    stream->PAR = (uint32_t)(uintptr_t)from;
    stream->M0AR = (uint32_t)(uintptr_t)to;
    stream->NDTR = count;
    stream->FCR = 0u; /* Direct mode. */
    stream->CR = FIELD(DMA_CR0_CHSEL, ring->channel) | FIELD(DMA_CR0_PL, PRIORITY) |
                 FIELD(DMA_CR0_PSIZE, (uint32_t)size) | FIELD(DMA_CR0_MSIZE, (uint32_t)size) |
                 DMA_CR0_MINC | DMA_CR0_CIRC;
    stream->CR |= DMA_CR0_EN;
}

uint32_t keel_dma_ring_left(const keel_dma_ring_t *ring)
{
    return stream_of(ring)->NDTR;
}

bool keel_dma_ring_failed(const keel_dma_ring_t *ring)
{
    const uint32_t flags = (ring->stream < STREAMS_A_WORD) ? ring->dma->LISR : ring->dma->HISR;

    return (flags & flags_of(ring, DMA_LISR_TEIF0)) != 0u;
}

bool keel_dma_ring_is_off(const keel_dma_ring_t *ring)
{
    keel_dma_stream_t *const stream = stream_of(ring);
    const bool is_off = (stream->CR & DMA_CR0_EN) == 0u;

    if (!is_off) {
        stream->CR &= ~DMA_CR0_EN;
    }
    return is_off;
}
