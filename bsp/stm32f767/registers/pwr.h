/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pwr.h
 * @brief Power control (RM0410, chapter 4).
 */
#ifndef KEEL_BSP_STM32F767_PWR_H
#define KEEL_BSP_STM32F767_PWR_H

#include "cortex_m7/bits.h"

typedef struct keel_pwr {
    volatile uint32_t CR1;
    volatile uint32_t CSR1;
    volatile uint32_t CR2;
    volatile uint32_t CSR2;
} keel_pwr_t;

#define PWR_BASE         0x40007000u
#define PWR_CR1_RESET    0x0000C000u
#define PWR_CR1_DBP      BITS(8u, 1u)
#define PWR_CR1_VOS      BITS(14u, 2u)
#define PWR_CR1_ODEN     BITS(16u, 1u)
#define PWR_CR1_ODSWEN   BITS(17u, 1u)
#define PWR_CSR1_RESET   0x00000000u
#define PWR_CSR1_ODRDY   BITS(16u, 1u)
#define PWR_CSR1_ODSWRDY BITS(17u, 1u)

#endif
