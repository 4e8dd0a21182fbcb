/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file chip_parts.h
 * @brief What the files of this folder share: how a board's device gets its pins and its time.
 *
 * For these files alone; an application calls chip.h.
 */
#ifndef KEEL_BSP_STM32F767_TARGET_CHIP_PARTS_H
#define KEEL_BSP_STM32F767_TARGET_CHIP_PARTS_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/pin.h"
#include "stm32f767/target/chip.h"

#include <stdint.h>

/** The longest wait for a byte of an SPI. */
extern const keel_wait_t keel_chip_byte_patience;

/** Ends in the safe state, unless a driver took what the board says of its part. */
void keel_chip_require(keel_bsp_status_t status);

/** Gives a pin to its peripheral. */
void keel_chip_give(keel_alternate_t to, keel_pull_t pull);

/** Makes the pin of a light an output, with the light dark: an open drain where low lights it. */
void keel_chip_give_light(const keel_led_t *light);

/** Lets a light shine, or not. */
void keel_chip_shine(const keel_led_t *light, bool on);

/** Makes a chip select's pin an output that selects nothing. */
void keel_chip_deselect(keel_pin_t select);

/** Gives an SPI its pins: its clock rests high, and without a device all ones are read. */
void keel_chip_give_spi(keel_alternate_t sck, keel_alternate_t miso, keel_alternate_t mosi);

/**
 * Waits for a time, as a device's start asks for.
 *
 * @param context unused
 * @param time_us how long, in us
 * @return KEEL_BSP_OK, or KEEL_BSP_TIMEOUT when the time base stands still
 */
keel_bsp_status_t keel_chip_delay(void *context, uint32_t time_us);

/** Looks at the bytes that came by the lines; a part of keel_chip_turn. */
void keel_chip_lines_turn(uint32_t now_us);

#endif
