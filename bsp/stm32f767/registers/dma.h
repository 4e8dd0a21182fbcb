/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file dma.h
 * @brief Direct memory access (RM0410, chapter 8).
 *
 * A controller has eight streams. The fields of stream 0 stand for those of all: each stream has
 * the same, and its flags are those of stream 0 shifted by 6, 16 and 22 bits for streams 1 to 3;
 * streams 4 to 7 have theirs in HISR and HIFCR.
 */
#ifndef KEEL_BSP_STM32F767_DMA_H
#define KEEL_BSP_STM32F767_DMA_H

#include "cortex_m7/bits.h"

typedef struct keel_dma_stream {
    volatile uint32_t CR;
    volatile uint32_t NDTR;
    volatile uint32_t PAR;
    volatile uint32_t M0AR;
    volatile uint32_t M1AR;
    volatile uint32_t FCR;
} keel_dma_stream_t;

typedef struct keel_dma {
    volatile uint32_t LISR;
    volatile uint32_t HISR;
    volatile uint32_t LIFCR;
    volatile uint32_t HIFCR;
    keel_dma_stream_t stream[8];
} keel_dma_t;

#define DMA1_BASE         0x40026000u
#define DMA2_BASE         0x40026400u
#define DMA_LISR_RESET    0x00000000u
#define DMA_LISR_TEIF0    BITS(3u, 1u)
#define DMA_LIFCR_RESET   0x00000000u
#define DMA_LIFCR_CFEIF0  BITS(0u, 1u)
#define DMA_LIFCR_CDMEIF0 BITS(2u, 1u)
#define DMA_LIFCR_CTEIF0  BITS(3u, 1u)
#define DMA_LIFCR_CHTIF0  BITS(4u, 1u)
#define DMA_LIFCR_CTCIF0  BITS(5u, 1u)
#define DMA_CR0_RESET     0x00000000u
#define DMA_CR0_EN        BITS(0u, 1u)
#define DMA_CR0_CIRC      BITS(8u, 1u)
#define DMA_CR0_MINC      BITS(10u, 1u)
#define DMA_CR0_PSIZE     BITS(11u, 2u)
#define DMA_CR0_MSIZE     BITS(13u, 2u)
#define DMA_CR0_PL        BITS(16u, 2u)
#define DMA_CR0_CHSEL     BITS(25u, 4u)
#define DMA_FCR0_RESET    0x00000021u

#endif
