/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pwm.h
 * @brief Pulse outputs for motors or servos: pins with channels of timers, as many as a board has.
 *
 * An output that is off is driven low as a plain output pin; its timer has no say. So it does not
 * matter whether the timer has a gate for its outputs: timer 1 has one, timers 4 and 12 have none.
 * Where there is a gate it is shut as well, by one store for four outputs.
 */
#ifndef KEEL_BSP_STM32F767_PWM_H
#define KEEL_BSP_STM32F767_PWM_H

#include "common/bsp_status.h"
#include "stm32f767/pin.h"
#include "stm32f767/registers/tim.h"

#include <stdint.h>

#define KEEL_PWM_OUTPUTS_MAX  12u   /**< Most outputs of a board. */
#define KEEL_PWM_PULSE_MIN_US 900u  /**< Shortest pulse, in us. */
#define KEEL_PWM_PULSE_MAX_US 2100u /**< Longest pulse, in us. */
#define KEEL_PWM_RATE_MIN_HZ  50u   /**< Lowest rate of pulses. */
#define KEEL_PWM_RATE_MAX_HZ  400u  /**< Highest rate of pulses. */

/** A timer that makes pulses. */
typedef struct keel_pwm_timer {
    keel_tim_t *tim;
    uint32_t channels; /**< 4, or 2: such a timer lacks the registers of the others. */
    bool has_gate;     /**< It has a main output, without which no channel drives its pin. */
} keel_pwm_timer_t;

/** An output. */
typedef struct keel_pwm_output {
    keel_pin_t pin;
    uint32_t function; /**< The pin's alternate function that gives it to the timer. */
    const keel_pwm_timer_t *timer;
    uint32_t channel; /**< 1 to the timer's channels. */
} keel_pwm_output_t;

/**
 * Starts a timer without pulses, and its gate shut if it has one (requirement PWM-001).
 *
 * @param timer    the timer, with its clock on
 * @param timer_hz its clock, a multiple of 1 MHz
 * @param rate_hz  pulses per second, KEEL_PWM_RATE_MIN_HZ to KEEL_PWM_RATE_MAX_HZ
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with the timer as it was
 */
keel_bsp_status_t keel_pwm_start(const keel_pwm_timer_t *timer, uint32_t timer_hz,
                                 uint32_t rate_hz);

/**
 * Sets the pulse of an output from the next period on (requirement PWM-002). It comes out while the
 * outputs are armed.
 *
 * @param output   the output
 * @param pulse_us 0 for none, or KEEL_PWM_PULSE_MIN_US to KEEL_PWM_PULSE_MAX_US
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with the output as it was
 */
keel_bsp_status_t keel_pwm_set(const keel_pwm_output_t *output, uint32_t pulse_us);

/**
 * Lets the pulses out that were set since the outputs were off: whole ones, from the timers' next
 * periods on (requirements PWM-003 and PWM-005). Does nothing while they are out.
 *
 * @param outputs the outputs of a board, whose timers were started
 * @param count   how many, 1 to KEEL_PWM_OUTPUTS_MAX
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with the outputs as they were
 */
keel_bsp_status_t keel_pwm_arm(const keel_pwm_output_t *outputs, uint32_t count);

/**
 * Drives outputs low at once, as plain pins, and forgets their pulses (requirement PWM-004). By
 * loads and stores alone, so for handlers of faults too.
 *
 * @param outputs the outputs of a board
 * @param count   how many
 */
void keel_pwm_off(const keel_pwm_output_t *outputs, uint32_t count);

#endif
