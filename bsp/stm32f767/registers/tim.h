/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file tim.h
 * @brief Timers 1 and 8 (advanced, RM0410 chapter 25), 4 and 5 (chapter 26, 5 of 32 bits), and 9
 *        and 12 (two channels, chapter 27).
 *
 * Timers 4 and 5 have neither RCR nor BDTR; timers 9 and 12 have neither these nor CR2, CCMR2, CCR3
 * and CCR4.
 */
#ifndef KEEL_BSP_STM32F767_TIM_H
#define KEEL_BSP_STM32F767_TIM_H

#include "cortex_m7/bits.h"

typedef struct keel_tim {
    volatile uint32_t CR1;
    volatile uint32_t CR2;
    volatile uint32_t SMCR;
    volatile uint32_t DIER;
    volatile uint32_t SR;
    volatile uint32_t EGR;
    volatile uint32_t CCMR1;
    volatile uint32_t CCMR2;
    volatile uint32_t CCER;
    volatile uint32_t CNT;
    volatile uint32_t PSC;
    volatile uint32_t ARR;
    volatile uint32_t RCR;
    volatile uint32_t CCR1;
    volatile uint32_t CCR2;
    volatile uint32_t CCR3;
    volatile uint32_t CCR4;
    volatile uint32_t BDTR;
} keel_tim_t;

#define TIM1_BASE       0x40010000u
#define TIM4_BASE       0x40000800u
#define TIM5_BASE       0x40000C00u
#define TIM8_BASE       0x40010400u
#define TIM9_BASE       0x40014000u
#define TIM12_BASE      0x40001800u
#define TIM_CR1_RESET   0x00000000u
#define TIM_CR1_CEN     BITS(0u, 1u)
#define TIM_CR1_ARPE    BITS(7u, 1u)
#define TIM_CR1_CKD     BITS(8u, 2u)
#define TIM_DIER_CC1DE  BITS(9u, 1u)
#define TIM_SR_CC1OF    BITS(9u, 1u)
#define TIM_EGR_UG      BITS(0u, 1u)
#define TIM_CCMR1_CC1S  BITS(0u, 2u)
#define TIM_CCMR1_IC1F  BITS(4u, 4u)
#define TIM_CCMR1_OC1PE BITS(3u, 1u)
#define TIM_CCMR1_OC1M  BITS(4u, 3u)
#define TIM_CCMR1_OC2PE BITS(11u, 1u)
#define TIM_CCMR1_OC2M  BITS(12u, 3u)
#define TIM_CCMR2_OC3PE BITS(3u, 1u)
#define TIM_CCMR2_OC3M  BITS(4u, 3u)
#define TIM_CCMR2_OC4PE BITS(11u, 1u)
#define TIM_CCMR2_OC4M  BITS(12u, 3u)
#define TIM_CCER_CC1E   BITS(0u, 1u)
#define TIM_CCER_CC2E   BITS(4u, 1u)
#define TIM_CCER_CC3E   BITS(8u, 1u)
#define TIM_CCER_CC4E   BITS(12u, 1u)
#define TIM_BDTR_OSSI   BITS(10u, 1u)
#define TIM_BDTR_MOE    BITS(15u, 1u)

#endif
