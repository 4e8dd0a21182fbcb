/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bus.h
 * @brief A bus to a device, as an interface: what a driver of a device needs of the board.
 */
#ifndef KEEL_BSP_COMMON_BUS_H
#define KEEL_BSP_COMMON_BUS_H

#include "common/bsp_status.h"

#include <stdint.h>

/** A full-duplex bus with one device selected. */
typedef struct keel_bus {
    /**
     * Exchanges bytes with the device, which is selected for just this exchange.
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

#endif
