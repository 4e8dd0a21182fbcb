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
#define FLASH_SR_OPERR      BITS(1u, 1u)
#define FLASH_SR_WRPERR     BITS(4u, 1u)
#define FLASH_SR_PGAERR     BITS(5u, 1u)
#define FLASH_SR_PGPERR     BITS(6u, 1u)
#define FLASH_SR_ERSERR     BITS(7u, 1u)
#define FLASH_SR_BSY        BITS(16u, 1u)
#define FLASH_CR_RESET      0x80000000u
#define FLASH_CR_PG         BITS(0u, 1u)
#define FLASH_CR_SER        BITS(1u, 1u)
#define FLASH_CR_SNB        BITS(3u, 5u)
#define FLASH_CR_PSIZE      BITS(8u, 2u)
#define FLASH_CR_STRT       BITS(16u, 1u)
#define FLASH_CR_LOCK       BITS(31u, 1u)
#define FLASH_OPTCR_OPTLOCK BITS(0u, 1u)
#define FLASH_OPTCR_OPTSTRT BITS(1u, 1u)
#define FLASH_OPTCR_BOR_LEV BITS(2u, 2u)
#define FLASH_OPTCR_NDBANK  BITS(29u, 1u)

#endif
