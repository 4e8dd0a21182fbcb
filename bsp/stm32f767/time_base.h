/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file time_base.h
 * @brief A free-running counter of microseconds from a 32-bit timer; it wraps at 2^32.
 */
#ifndef KEEL_BSP_STM32F767_TIME_BASE_H
#define KEEL_BSP_STM32F767_TIME_BASE_H

#include "common/bsp_status.h"
#include "stm32f767/registers/tim.h"

#include <stdint.h>

/**
 * The content of PSC that makes a timer count at a rate (requirement TIB-001).
 *
 * @param timer_hz the timer's clock, a multiple of the rate
 * @param rate_hz  the rate, at least 1
 * @param word     the content: the divisor, 1 to 65536, less one
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with word as it was
 */
keel_bsp_status_t keel_timer_prescaler(uint32_t timer_hz, uint32_t rate_hz, uint32_t *word);

/**
 * Starts the counter at 0 (requirement TIB-002).
 *
 * @param tim      a 32-bit timer
 * @param timer_hz its clock, a multiple of 1 MHz
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with the timer as it was
 */
keel_bsp_status_t keel_time_base_start(keel_tim_t *tim, uint32_t timer_hz);

/**
 * The counter, as keel_scheduler_config_t wants it (requirement TIB-003).
 *
 * @param context the timer
 * @return microseconds since the start, modulo 2^32
 */
uint32_t keel_time_base_us(void *context);

#endif
