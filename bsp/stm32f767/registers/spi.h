/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file spi.h
 * @brief Serial peripheral interface (RM0410, chapter 35).
 */
#ifndef KEEL_BSP_STM32F767_SPI_H
#define KEEL_BSP_STM32F767_SPI_H

#include "cortex_m7/bits.h"

typedef struct keel_spi {
    volatile uint32_t CR1;
    volatile uint32_t CR2;
    volatile uint32_t SR;
    volatile uint32_t DR;
} keel_spi_t;

#define SPI1_BASE     0x40013000u
#define SPI2_BASE     0x40003800u
#define SPI4_BASE     0x40013400u
#define SPI_CR1_RESET 0x00000000u
#define SPI_CR1_CPHA  BITS(0u, 1u)
#define SPI_CR1_CPOL  BITS(1u, 1u)
#define SPI_CR1_MSTR  BITS(2u, 1u)
#define SPI_CR1_BR    BITS(3u, 3u)
#define SPI_CR1_SPE   BITS(6u, 1u)
#define SPI_CR1_SSI   BITS(8u, 1u)
#define SPI_CR1_SSM   BITS(9u, 1u)
#define SPI_CR2_RESET 0x00000700u
#define SPI_CR2_DS    BITS(8u, 4u)
#define SPI_CR2_FRXTH BITS(12u, 1u)
#define SPI_SR_RESET  0x00000002u
#define SPI_SR_RXNE   BITS(0u, 1u)
#define SPI_SR_TXE    BITS(1u, 1u)
#define SPI_SR_MODF   BITS(5u, 1u)
#define SPI_SR_OVR    BITS(6u, 1u)
#define SPI_SR_BSY    BITS(7u, 1u)

#endif
