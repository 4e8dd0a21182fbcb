/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file adc_common.h
 * @brief What the three analogue-to-digital converters share (RM0410, 15.13.15 and following).
 */
#ifndef KEEL_BSP_STM32F767_REGISTERS_ADC_COMMON_H
#define KEEL_BSP_STM32F767_REGISTERS_ADC_COMMON_H

#include "cortex_m7/bits.h"

typedef struct keel_adc_common {
    volatile uint32_t CSR;
    volatile uint32_t CCR;
    volatile uint32_t CDR;
} keel_adc_common_t;

#define ADC123_COMMON_BASE     0x40012300u
#define ADC_COMMON_CCR_ADCPRE  BITS(16u, 2u)
#define ADC_COMMON_CCR_VBATE   BITS(22u, 1u)
#define ADC_COMMON_CCR_TSVREFE BITS(23u, 1u)

#endif
