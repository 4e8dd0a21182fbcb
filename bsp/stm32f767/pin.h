/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pin.h
 * @brief Pins: outputs, inputs, alternate functions and analogue pins.
 */
#ifndef KEEL_BSP_STM32F767_PIN_H
#define KEEL_BSP_STM32F767_PIN_H

#include "stm32f767/registers/gpio.h"

#include <stdbool.h>
#include <stdint.h>

/** A pin of a port. */
typedef struct keel_pin {
    keel_gpio_t *port; /**< The port, with its clock on. */
    uint32_t number;   /**< 0 to 15. */
} keel_pin_t;

/** How an output drives its line. */
typedef enum keel_drive {
    KEEL_DRIVE_PUSH_PULL = 0,
    KEEL_DRIVE_OPEN_DRAIN = 1
} keel_drive_t;

/** What holds an input that nobody drives. */
typedef enum keel_pull {
    KEEL_PULL_NONE = 0,
    KEEL_PULL_UP = 1,
    KEEL_PULL_DOWN = 2
} keel_pull_t;

/**
 * Sets a pin's level (requirement PIN-001): one store, so that nothing comes between.
 *
 * @param pin  the pin
 * @param high the level; with an open drain, high lets the line go
 */
void keel_pin_write(keel_pin_t pin, bool high);

/**
 * The level at a pin (requirement PIN-002).
 *
 * @param pin the pin
 */
bool keel_pin_read(keel_pin_t pin);

/**
 * Makes a pin an output; its level is right before it drives (requirement PIN-003).
 *
 * @param pin   the pin
 * @param drive how it drives
 * @param high  its first level
 */
void keel_pin_output(keel_pin_t pin, keel_drive_t drive, bool high);

/**
 * Makes a pin an input (requirement PIN-004).
 *
 * @param pin  the pin
 * @param pull what holds it
 */
void keel_pin_input(keel_pin_t pin, keel_pull_t pull);

/**
 * Gives a pin to a peripheral (requirement PIN-005).
 *
 * @param pin      the pin
 * @param function the number of the alternate function, 0 to 15
 * @param pull     what holds it
 */
void keel_pin_alternate(keel_pin_t pin, uint32_t function, keel_pull_t pull);

/**
 * Gives a pin to a peripheral that shares its line with others, as of I2C: it drives low, or lets
 * the line go (requirement PIN-008).
 *
 * @param pin      the pin
 * @param function the number of the alternate function, 0 to 15
 * @param pull     what holds it
 */
void keel_pin_alternate_open_drain(keel_pin_t pin, uint32_t function, keel_pull_t pull);

/**
 * Whether a pin is given to a peripheral (requirement PIN-007).
 *
 * @param pin the pin
 */
bool keel_pin_is_alternate(keel_pin_t pin);

/**
 * Leaves a pin to the analogue-to-digital converter, with nothing that holds it (requirement
 * PIN-006).
 *
 * @param pin the pin
 */
void keel_pin_analogue(keel_pin_t pin);

#endif
