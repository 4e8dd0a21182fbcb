/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file rcc.h
 * @brief Reset and clock control (reference manual RM0410, chapter 5).
 */
#ifndef KEEL_BSP_STM32F767_RCC_H
#define KEEL_BSP_STM32F767_RCC_H

#include "cortex_m7/bits.h"

typedef struct keel_rcc {
    volatile uint32_t CR;
    volatile uint32_t PLLCFGR;
    volatile uint32_t CFGR;
    volatile uint32_t CIR;
    volatile uint32_t AHB1RSTR;
    volatile uint32_t AHB2RSTR;
    volatile uint32_t AHB3RSTR;
    volatile uint32_t reserved0;
    volatile uint32_t APB1RSTR;
    volatile uint32_t APB2RSTR;
    volatile uint32_t reserved1[2];
    volatile uint32_t AHB1ENR;
    volatile uint32_t AHB2ENR;
    volatile uint32_t AHB3ENR;
    volatile uint32_t reserved2;
    volatile uint32_t APB1ENR;
    volatile uint32_t APB2ENR;
    volatile uint32_t reserved3[10];
    volatile uint32_t BDCR;
    volatile uint32_t CSR;
    volatile uint32_t reserved4[5];
    volatile uint32_t DCKCFGR1;
    volatile uint32_t DCKCFGR2;
} keel_rcc_t;

#define RCC_BASE               0x40023800u
#define RCC_CR_RESET           0x00000083u
#define RCC_CR_HSION           BITS(0u, 1u)
#define RCC_CR_HSIRDY          BITS(1u, 1u)
#define RCC_CR_HSEON           BITS(16u, 1u)
#define RCC_CR_HSERDY          BITS(17u, 1u)
#define RCC_CR_HSEBYP          BITS(18u, 1u)
#define RCC_CR_CSSON           BITS(19u, 1u)
#define RCC_CR_PLLON           BITS(24u, 1u)
#define RCC_CR_PLLRDY          BITS(25u, 1u)
#define RCC_PLLCFGR_RESET      0x24003010u
#define RCC_PLLCFGR_PLLM       BITS(0u, 6u)
#define RCC_PLLCFGR_PLLN       BITS(6u, 9u)
#define RCC_PLLCFGR_PLLP       BITS(16u, 2u)
#define RCC_PLLCFGR_PLLSRC     BITS(22u, 1u)
#define RCC_PLLCFGR_PLLQ       BITS(24u, 4u)
#define RCC_CFGR_RESET         0x00000000u
#define RCC_CFGR_SW            BITS(0u, 2u)
#define RCC_CFGR_SWS           BITS(2u, 2u)
#define RCC_CFGR_HPRE          BITS(4u, 4u)
#define RCC_CFGR_PPRE1         BITS(10u, 3u)
#define RCC_CFGR_PPRE2         BITS(13u, 3u)
#define RCC_APB1RSTR_RESET     0x00000000u
#define RCC_APB1RSTR_I2C3RST   BITS(23u, 1u)
#define RCC_AHB1ENR_RESET      0x00100000u
#define RCC_AHB1ENR_GPIOAEN    BITS(0u, 1u)
#define RCC_AHB1ENR_GPIOBEN    BITS(1u, 1u)
#define RCC_AHB1ENR_GPIOCEN    BITS(2u, 1u)
#define RCC_AHB1ENR_GPIODEN    BITS(3u, 1u)
#define RCC_AHB1ENR_GPIOEEN    BITS(4u, 1u)
#define RCC_AHB1ENR_GPIOFEN    BITS(5u, 1u)
#define RCC_AHB1ENR_GPIOGEN    BITS(6u, 1u)
#define RCC_AHB1ENR_GPIOHEN    BITS(7u, 1u)
#define RCC_AHB1ENR_GPIOIEN    BITS(8u, 1u)
#define RCC_AHB1ENR_BKPSRAMEN  BITS(18u, 1u)
#define RCC_AHB1ENR_DMA1EN     BITS(21u, 1u)
#define RCC_AHB1ENR_DMA2EN     BITS(22u, 1u)
#define RCC_APB1ENR_RESET      0x00000000u
#define RCC_APB1ENR_TIM4EN     BITS(2u, 1u)
#define RCC_APB1ENR_TIM5EN     BITS(3u, 1u)
#define RCC_APB1ENR_TIM12EN    BITS(6u, 1u)
#define RCC_APB1ENR_SPI2EN     BITS(14u, 1u)
#define RCC_APB1ENR_USART2EN   BITS(17u, 1u)
#define RCC_APB1ENR_USART3EN   BITS(18u, 1u)
#define RCC_APB1ENR_UART4EN    BITS(19u, 1u)
#define RCC_APB1ENR_I2C3EN     BITS(23u, 1u)
#define RCC_APB1ENR_PWREN      BITS(28u, 1u)
#define RCC_APB1ENR_UART7EN    BITS(30u, 1u)
#define RCC_APB2ENR_RESET      0x00000000u
#define RCC_APB2ENR_TIM1EN     BITS(0u, 1u)
#define RCC_APB2ENR_TIM8EN     BITS(1u, 1u)
#define RCC_APB2ENR_USART1EN   BITS(4u, 1u)
#define RCC_APB2ENR_USART6EN   BITS(5u, 1u)
#define RCC_APB2ENR_ADC1EN     BITS(8u, 1u)
#define RCC_APB2ENR_SDMMC1EN   BITS(11u, 1u)
#define RCC_APB2ENR_SPI1EN     BITS(12u, 1u)
#define RCC_APB2ENR_SPI4EN     BITS(13u, 1u)
#define RCC_APB2ENR_TIM9EN     BITS(16u, 1u)
#define RCC_CSR_RESET          0x0E000000u
#define RCC_CSR_RMVF           BITS(24u, 1u)
#define RCC_CSR_BORRSTF        BITS(25u, 1u)
#define RCC_CSR_PINRSTF        BITS(26u, 1u)
#define RCC_CSR_PORRSTF        BITS(27u, 1u)
#define RCC_CSR_SFTRSTF        BITS(28u, 1u)
#define RCC_CSR_IWDGRSTF       BITS(29u, 1u)
#define RCC_CSR_WWDGRSTF       BITS(30u, 1u)
#define RCC_DCKCFGR1_RESET     0x00000000u
#define RCC_DCKCFGR1_TIMPRE    BITS(24u, 1u)
#define RCC_DCKCFGR2_RESET     0x00000000u
#define RCC_DCKCFGR2_USART3SEL BITS(4u, 2u)
#define RCC_DCKCFGR2_UART7SEL  BITS(12u, 2u)
#define RCC_DCKCFGR2_I2C3SEL   BITS(20u, 2u)
#define RCC_DCKCFGR2_CK48MSEL  BITS(27u, 1u)
#define RCC_DCKCFGR2_SDMMC1SEL BITS(28u, 1u)

#endif
