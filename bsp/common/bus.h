/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bus.h
 * @brief A bus to a device, as an interface: what a driver of a device needs of the board.
 */
#ifndef KEEL_BSP_COMMON_BUS_H
#define KEEL_BSP_COMMON_BUS_H

#include "common/bsp_status.h"

#include <stdbool.h>
#include <stdint.h>

/** A bus with one device selected: SPI, where each byte out brings one in, or I2C. */
typedef struct keel_bus {
    /**
     * Exchanges bytes with the device, which is selected for just this exchange.
     *
     * On I2C, which goes one way at a time, the first byte is written and the others are read, each
     * into its place; with in null all are written.
     *
     * @param context the bus's own
     * @param out     the bytes to send
     * @param in      the bytes that came, as many as were exchanged
     * @param length  how many, at least 1
     * @param done    how many were exchanged
     * @return KEEL_BSP_OK, KEEL_BSP_TIMEOUT or KEEL_BSP_BUS
     */
    keel_bsp_status_t (*exchange)(void *context, const uint8_t *out, uint8_t *in, uint32_t length,
                                  uint32_t *done);
    void *context; /**< Handed to exchange; may be null. */
} keel_bus_t;

/** What a device said last, and how often it has said just that since. */
typedef struct keel_repeats {
    uint8_t last[14]; /**< What it said; as many bytes as are told. */
    uint32_t count;   /**< How often it was said again; stays at UINT32_MAX. */
} keel_repeats_t;

/**
 * An exchange in which all bytes must come.
 *
 * @param bus    the bus
 * @param out    the bytes to send
 * @param in     the bytes that came, or null where nothing is read of I2C
 * @param length how many, at least 1
 * @return KEEL_BSP_OK; KEEL_BSP_SHORT when fewer came; KEEL_BSP_TIMEOUT or KEEL_BSP_BUS
 */
keel_bsp_status_t keel_bus_transfer(const keel_bus_t *bus, const uint8_t *out, uint8_t *in,
                                    uint32_t length);

/**
 * Whether all bits are zeros, or all are ones, as of a line that does not move.
 *
 * @param byte   the bytes
 * @param length how many, at least 1
 * @return whether they are
 */
bool keel_bus_is_still(const uint8_t *byte, uint32_t length);

/**
 * Counts how often a device has said the same again.
 *
 * @param repeats what it said last; all 0 at the start
 * @param byte    what it says
 * @param length  how many bytes, 1 to 14; always as many
 * @return how often it has been said again
 */
uint32_t keel_bus_repeats(keel_repeats_t *repeats, const uint8_t *byte, uint32_t length);

#endif
