/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file safety_switch.h
 * @brief The button of a safety switch: held for a second, it changes between safe and ready.
 *
 * It begins safe. A contact bounces and a line picks up noise, so a level counts when all readings
 * agree for KEEL_SAFETY_SWITCH_SETTLE_US. A button that was pressed ever since the start, or since
 * the last change, changes nothing: a line that is torn or short does not leave safe.
 */
#ifndef KEEL_BSP_DEVICES_SAFETY_SWITCH_H
#define KEEL_BSP_DEVICES_SAFETY_SWITCH_H

#include <stdbool.h>
#include <stdint.h>

/** A level that lasts so long counts, in us. A step counts for no longer, however late it comes. */
#define KEEL_SAFETY_SWITCH_SETTLE_US 20000u

/** How long the button is to be held, in us: PX4's and ArduPilot's second. */
#define KEEL_SAFETY_SWITCH_HOLD_US 1000000u

/** The half of a period in which the light of a safe switch blinks, in us. */
#define KEEL_SAFETY_SWITCH_BLINK_US 500000u

/** A safety switch. Only the functions below write it; all of it may be read. */
typedef struct keel_safety_switch {
    bool is_safe;        /**< Motors are not to start; else it is ready. */
    bool is_pressed;     /**< The level that counts. */
    bool was_released;   /**< Since the start, or since it changed last. */
    bool differs;        /**< The last reading was of the other level. */
    uint32_t differs_us; /**< And has been since, in us. */
    uint32_t held_us;    /**< How long the button has been held, in us; stays at UINT32_MAX. */
    uint32_t blink_us;   /**< In the period in which the light blinks. */
} keel_safety_switch_t;

/**
 * Makes a switch: safe, and its button pressed until the line says otherwise (requirement SAF-001).
 *
 * @param self the switch
 */
void keel_safety_switch_init(keel_safety_switch_t *self);

/**
 * Takes a reading of the button (requirements SAF-002 to SAF-004).
 *
 * @param self       the switch, initialised
 * @param pressed    whether its line says that it is pressed
 * @param elapsed_us the time since the last step, in us
 * @return whether it has changed between safe and ready
 */
bool keel_safety_switch_step(keel_safety_switch_t *self, bool pressed, uint32_t elapsed_us);

/**
 * Whether its light is to shine (requirement SAF-005): all the time when it is ready, half of the
 * time when it is safe.
 *
 * @param self the switch, initialised
 */
bool keel_safety_switch_is_lit(const keel_safety_switch_t *self);

#endif
