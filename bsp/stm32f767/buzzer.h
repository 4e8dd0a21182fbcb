/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file buzzer.h
 * @brief A buzzer at a channel of a timer: tones by a table, one behind the other.
 *
 * Nothing waits: keel_buzzer_turn looks whether a tone has lasted for its time. The timer makes a
 * tone by itself, so a turn that comes late makes it longer. While it is silent the pin is low, so
 * that no current flows through the buzzer.
 */
#ifndef KEEL_BSP_STM32F767_BUZZER_H
#define KEEL_BSP_STM32F767_BUZZER_H

#include "common/bsp_status.h"
#include "stm32f767/registers/tim.h"

#include <stdbool.h>
#include <stdint.h>

#define KEEL_BUZZER_MIN_HZ 20u    /**< The lowest tone. */
#define KEEL_BUZZER_MAX_HZ 10000u /**< The highest one. */

/** A tone of a tune. */
typedef struct keel_tone {
    uint16_t hz; /**< KEEL_BUZZER_MIN_HZ to KEEL_BUZZER_MAX_HZ; any other is silence. */
    uint16_t ms; /**< How long it lasts, in ms. */
} keel_tone_t;

/** A buzzer. Only the functions below write it; all of it may be read. */
typedef struct keel_buzzer {
    keel_tim_t *tim;
    const keel_tone_t *tone; /**< The one that sounds, while left is not 0. */
    uint32_t left;           /**< Tones of the tune, that one included; 0: none plays. */
    uint32_t passed_us;      /**< Of that one's time, in us. */
} keel_buzzer_t;

/**
 * Starts the timer, silent, with channel 1 low (requirement BUZ-001).
 *
 * @param buzzer   the buzzer
 * @param tim      its timer, of two channels or more, with its clock on
 * @param timer_hz the timer's clock, a multiple of 1 MHz
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with buzzer and timer as they were
 */
keel_bsp_status_t keel_buzzer_start(keel_buzzer_t *buzzer, keel_tim_t *tim, uint32_t timer_hz);

/**
 * Plays a tune from its first tone on, in the place of what plays (requirements BUZ-002, BUZ-003).
 *
 * @param buzzer the buzzer, started
 * @param tones  the tune; kept until it has ended
 * @param count  how many tones; 0: silence
 */
void keel_buzzer_play(keel_buzzer_t *buzzer, const keel_tone_t *tones, uint32_t count);

/**
 * Lets time pass: a tone that has lasted for its time gives way to the next one, the last one to
 * silence (requirement BUZ-004). To be called in every turn of a main loop.
 *
 * @param buzzer     the buzzer, started
 * @param elapsed_us the time since the last turn, in us
 */
void keel_buzzer_turn(keel_buzzer_t *buzzer, uint32_t elapsed_us);

/** Whether a tune plays (requirement BUZ-004); its pauses are a part of it. */
bool keel_buzzer_plays(const keel_buzzer_t *buzzer);

#endif
