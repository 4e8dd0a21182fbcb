/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file gpio.h
 * @brief General-purpose inputs and outputs (RM0410, chapter 6).
 *
 * MODER, OSPEEDR and PUPDR hold two bits for each pin, AFRL and AFRH four, the others one.
 */
#ifndef KEEL_BSP_STM32F767_GPIO_H
#define KEEL_BSP_STM32F767_GPIO_H

#include "cortex_m7/bits.h"

typedef struct keel_gpio {
    volatile uint32_t MODER;
    volatile uint32_t OTYPER;
    volatile uint32_t OSPEEDR;
    volatile uint32_t PUPDR;
    volatile uint32_t IDR;
    volatile uint32_t ODR;
    volatile uint32_t BSRR;
    volatile uint32_t LCKR;
    volatile uint32_t AFRL;
    volatile uint32_t AFRH;
} keel_gpio_t;

#define GPIOA_BASE        0x40020000u
#define GPIOB_BASE        0x40020400u
#define GPIOC_BASE        0x40020800u
#define GPIOD_BASE        0x40020C00u
#define GPIOE_BASE        0x40021000u
#define GPIOF_BASE        0x40021400u
#define GPIOG_BASE        0x40021800u
#define GPIOH_BASE        0x40021C00u
#define GPIOI_BASE        0x40022000u
#define GPIO_MODER_RESET  0x00000000u /* Of every port but A and B. */
#define GPIOA_MODER_RESET 0xA8000000u
#define GPIOB_MODER_RESET 0x00000280u

#endif
