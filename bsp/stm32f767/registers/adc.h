/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file adc.h
 * @brief Analogue-to-digital converter (RM0410, chapter 15).
 *
 * SMPR1 holds the sampling times of channels 10 to 18, SMPR2 those of 0 to 9, three bits each.
 */
#ifndef KEEL_BSP_STM32F767_REGISTERS_ADC_H
#define KEEL_BSP_STM32F767_REGISTERS_ADC_H

#include "cortex_m7/bits.h"

typedef struct keel_adc {
    volatile uint32_t SR;
    volatile uint32_t CR1;
    volatile uint32_t CR2;
    volatile uint32_t SMPR1;
    volatile uint32_t SMPR2;
    volatile uint32_t JOFR1;
    volatile uint32_t JOFR2;
    volatile uint32_t JOFR3;
    volatile uint32_t JOFR4;
    volatile uint32_t HTR;
    volatile uint32_t LTR;
    volatile uint32_t SQR1;
    volatile uint32_t SQR2;
    volatile uint32_t SQR3;
    volatile uint32_t JSQR;
    volatile uint32_t JDR1;
    volatile uint32_t JDR2;
    volatile uint32_t JDR3;
    volatile uint32_t JDR4;
    volatile uint32_t DR;
} keel_adc_t;

#define ADC1_BASE       0x40012000u
#define ADC_SR_EOC      BITS(1u, 1u)
#define ADC_SR_OVR      BITS(5u, 1u)
#define ADC_CR2_ADON    BITS(0u, 1u)
#define ADC_CR2_EOCS    BITS(10u, 1u)
#define ADC_CR2_SWSTART BITS(30u, 1u)
#define ADC_SMPR1_SMP10 BITS(0u, 3u)
#define ADC_SMPR1_SMP18 BITS(24u, 3u)
#define ADC_SMPR2_SMP0  BITS(0u, 3u)
#define ADC_SMPR2_SMP9  BITS(27u, 3u)
#define ADC_SQR3_SQ1    BITS(0u, 5u)
#define ADC_DR_DATA     BITS(0u, 16u)

#endif
