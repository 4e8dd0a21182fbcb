/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file iwdg.h
 * @brief Independent watchdog (RM0410, chapter 30).
 */
#ifndef KEEL_BSP_STM32F767_IWDG_H
#define KEEL_BSP_STM32F767_IWDG_H

#include "cortex_m7/bits.h"

typedef struct keel_iwdg {
    volatile uint32_t KR;
    volatile uint32_t PR;
    volatile uint32_t RLR;
    volatile uint32_t SR;
    volatile uint32_t WINR;
} keel_iwdg_t;

#define IWDG_BASE      0x40003000u
#define IWDG_RLR_RESET 0x00000FFFu
#define IWDG_SR_PVU    BITS(0u, 1u)
#define IWDG_SR_RVU    BITS(1u, 1u)

#endif
