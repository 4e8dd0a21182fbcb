/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file i2c.h
 * @brief Inter-integrated circuit interface (RM0410, chapter 33).
 */
#ifndef KEEL_BSP_STM32F767_I2C_H
#define KEEL_BSP_STM32F767_I2C_H

#include "cortex_m7/bits.h"

typedef struct keel_i2c {
    volatile uint32_t CR1;
    volatile uint32_t CR2;
    volatile uint32_t OAR1;
    volatile uint32_t OAR2;
    volatile uint32_t TIMINGR;
    volatile uint32_t TIMEOUTR;
    volatile uint32_t ISR;
    volatile uint32_t ICR;
    volatile uint32_t PECR;
    volatile uint32_t RXDR;
    volatile uint32_t TXDR;
} keel_i2c_t;

#define I2C3_BASE          0x40005C00u
#define I2C_CR1_RESET      0x00000000u
#define I2C_CR1_PE         BITS(0u, 1u)
#define I2C_CR2_RESET      0x00000000u
#define I2C_CR2_SADD       BITS(0u, 10u)
#define I2C_CR2_RD_WRN     BITS(10u, 1u)
#define I2C_CR2_START      BITS(13u, 1u)
#define I2C_CR2_NBYTES     BITS(16u, 8u)
#define I2C_CR2_AUTOEND    BITS(25u, 1u)
#define I2C_TIMINGR_RESET  0x00000000u
#define I2C_TIMINGR_SCLL   BITS(0u, 8u)
#define I2C_TIMINGR_SCLH   BITS(8u, 8u)
#define I2C_TIMINGR_SDADEL BITS(16u, 4u)
#define I2C_TIMINGR_SCLDEL BITS(20u, 4u)
#define I2C_TIMINGR_PRESC  BITS(28u, 4u)
#define I2C_ISR_RESET      0x00000001u
#define I2C_ISR_TXIS       BITS(1u, 1u)
#define I2C_ISR_RXNE       BITS(2u, 1u)
#define I2C_ISR_NACKF      BITS(4u, 1u)
#define I2C_ISR_STOPF      BITS(5u, 1u)
#define I2C_ISR_TC         BITS(6u, 1u)
#define I2C_ISR_BERR       BITS(8u, 1u)
#define I2C_ISR_ARLO       BITS(9u, 1u)
#define I2C_ISR_OVR        BITS(10u, 1u)
#define I2C_ISR_BUSY       BITS(15u, 1u)
#define I2C_ICR_NACKCF     BITS(4u, 1u)
#define I2C_ICR_STOPCF     BITS(5u, 1u)
#define I2C_ICR_BERRCF     BITS(8u, 1u)
#define I2C_ICR_ARLOCF     BITS(9u, 1u)
#define I2C_ICR_OVRCF      BITS(10u, 1u)

#endif
