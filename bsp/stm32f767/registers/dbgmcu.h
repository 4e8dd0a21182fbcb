/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file dbgmcu.h
 * @brief Debug support (RM0410, chapter 40): what stands still while a debugger halts the core.
 */
#ifndef KEEL_BSP_STM32F767_DBGMCU_H
#define KEEL_BSP_STM32F767_DBGMCU_H

#include "cortex_m7/bits.h"

typedef struct keel_dbgmcu {
    volatile uint32_t IDCODE;
    volatile uint32_t CR;
    volatile uint32_t APB1_FZ;
    volatile uint32_t APB2_FZ;
} keel_dbgmcu_t;

#define DBGMCU_BASE                   0xE0042000u
#define DBGMCU_APB1_FZ_DBG_TIM4_STOP  BITS(2u, 1u)
#define DBGMCU_APB1_FZ_DBG_TIM5_STOP  BITS(3u, 1u)
#define DBGMCU_APB1_FZ_DBG_TIM12_STOP BITS(6u, 1u)
#define DBGMCU_APB1_FZ_DBG_IWDG_STOP  BITS(12u, 1u)
#define DBGMCU_APB2_FZ_DBG_TIM1_STOP  BITS(0u, 1u)

#endif
