/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file uart.h
 * @brief USART and UART (RM0410, chapter 34).
 */
#ifndef KEEL_BSP_STM32F767_UART_H
#define KEEL_BSP_STM32F767_UART_H

#include "cortex_m7/bits.h"

typedef struct keel_uart {
    volatile uint32_t CR1;
    volatile uint32_t CR2;
    volatile uint32_t CR3;
    volatile uint32_t BRR;
    volatile uint32_t GTPR;
    volatile uint32_t RTOR;
    volatile uint32_t RQR;
    volatile uint32_t ISR;
    volatile uint32_t ICR;
    volatile uint32_t RDR;
    volatile uint32_t TDR;
} keel_uart_t;

#define USART1_BASE    0x40011000u
#define USART2_BASE    0x40004400u
#define USART3_BASE    0x40004800u
#define UART4_BASE     0x40004C00u
#define USART6_BASE    0x40011400u
#define UART7_BASE     0x40007800u
#define UART_CR1_RESET 0x00000000u
#define UART_CR1_UE    BITS(0u, 1u)
#define UART_CR1_RE    BITS(2u, 1u)
#define UART_CR1_TE    BITS(3u, 1u)
#define UART_CR1_PCE   BITS(10u, 1u)
#define UART_CR1_M0    BITS(12u, 1u)
#define UART_CR2_RESET 0x00000000u
#define UART_CR2_STOP  BITS(12u, 2u)
#define UART_CR2_RXINV BITS(16u, 1u)
#define UART_CR2_TXINV BITS(17u, 1u)
#define UART_CR3_RESET 0x00000000u
#define UART_CR3_DMAR  BITS(6u, 1u)
#define UART_ISR_RESET 0x000000C0u
#define UART_ISR_PE    BITS(0u, 1u)
#define UART_ISR_FE    BITS(1u, 1u)
#define UART_ISR_NF    BITS(2u, 1u)
#define UART_ISR_ORE   BITS(3u, 1u)
#define UART_ISR_RXNE  BITS(5u, 1u)
#define UART_ISR_TC    BITS(6u, 1u)
#define UART_ISR_TXE   BITS(7u, 1u)
#define UART_ICR_RESET 0x00000000u
#define UART_ICR_PECF  BITS(0u, 1u)
#define UART_ICR_FECF  BITS(1u, 1u)
#define UART_ICR_NCF   BITS(2u, 1u)
#define UART_ICR_ORECF BITS(3u, 1u)

#endif
