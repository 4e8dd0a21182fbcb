/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file flash.h
 * @brief Flash interface and option bytes (RM0410, chapter 3).
 */
#ifndef KEEL_BSP_STM32F767_FLASH_H
#define KEEL_BSP_STM32F767_FLASH_H

#include "cortex_m7/bits.h"

typedef struct keel_flash {
    volatile uint32_t ACR;
    volatile uint32_t KEYR;
    volatile uint32_t OPTKEYR;
    volatile uint32_t SR;
    volatile uint32_t CR;
    volatile uint32_t OPTCR;
    volatile uint32_t OPTCR1;
} keel_flash_t;

#define FLASH_BASE          0x40023C00u
#define FLASH_ACR_RESET     0x00000000u
#define FLASH_ACR_LATENCY   BITS(0u, 4u)
#define FLASH_ACR_PRFTEN    BITS(8u, 1u)
#define FLASH_ACR_ARTEN     BITS(9u, 1u)
#define FLASH_ACR_ARTRST    BITS(11u, 1u)
#define FLASH_SR_BSY        BITS(16u, 1u)
#define FLASH_OPTCR_OPTLOCK BITS(0u, 1u)
#define FLASH_OPTCR_OPTSTRT BITS(1u, 1u)
#define FLASH_OPTCR_BOR_LEV BITS(2u, 2u)

#endif
