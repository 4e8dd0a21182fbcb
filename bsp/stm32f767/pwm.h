/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pwm.h
 * @brief Four pulse outputs for motors or servos from an advanced timer.
 *
 * The outputs are off, that is driven low, until they are armed, and again as soon as they are
 * switched off; switching off is one store, for fault handlers.
 */
#ifndef KEEL_BSP_STM32F767_PWM_H
#define KEEL_BSP_STM32F767_PWM_H

#include "common/bsp_status.h"
#include "stm32f767/registers/tim.h"

#include <stdint.h>

#define KEEL_PWM_PULSE_MIN_US 900u  /**< Shortest pulse, in us. */
#define KEEL_PWM_PULSE_MAX_US 2100u /**< Longest pulse, in us. */
#define KEEL_PWM_RATE_MIN_HZ  50u   /**< Lowest rate of pulses. */
#define KEEL_PWM_RATE_MAX_HZ  400u  /**< Highest rate of pulses. */

/**
 * Starts a timer with all outputs off and without pulses (requirement PWM-001).
 *
 * @param tim      an advanced timer
 * @param timer_hz its clock, a multiple of 1 MHz
 * @param rate_hz  pulses per second, KEEL_PWM_RATE_MIN_HZ to KEEL_PWM_RATE_MAX_HZ
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with the timer as it was
 */
keel_bsp_status_t keel_pwm_start(keel_tim_t *tim, uint32_t timer_hz, uint32_t rate_hz);

/**
 * Sets the pulse of an output from the next period on (requirement PWM-002).
 *
 * @param tim      the timer
 * @param channel  0 to 3
 * @param pulse_us 0 for none, or KEEL_PWM_PULSE_MIN_US to KEEL_PWM_PULSE_MAX_US
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with the output as it was
 */
keel_bsp_status_t keel_pwm_set(keel_tim_t *tim, uint32_t channel, uint32_t pulse_us);

/**
 * Lets the pulses out (requirement PWM-003).
 *
 * @param tim the timer
 */
void keel_pwm_arm(keel_tim_t *tim);

/**
 * Drives all outputs low at once, with one store (requirement PWM-004).
 *
 * @param tim the timer
 */
void keel_pwm_off(keel_tim_t *tim);

#endif
