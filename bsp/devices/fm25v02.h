/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fm25v02.h
 * @brief The ferroelectric memory FM25V02 or FM25V02A (Cypress, 32 KiB) on an SPI bus.
 *
 * It takes bytes as fast as the bus brings them, without erasing, and does not wear out: what
 * bsp/common/slots.h asks of a medium.
 */
#ifndef KEEL_BSP_DEVICES_FM25V02_H
#define KEEL_BSP_DEVICES_FM25V02_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "common/slots.h"

#include <stdbool.h>
#include <stdint.h>

/** The fastest that the bus may be, in Hz. */
#define KEEL_FM25V02_BUS_LIMIT_HZ 40000000u

/** Its bytes. */
#define KEEL_FM25V02_BYTES 32768u

/**
 * Makes sure that the memory is there (requirement FRM-001).
 *
 * @param bus the bus, with the memory selected
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when the identity reads all zeros or all ones; KEEL_BSP_ID;
 *         KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT of the bus
 */
keel_bsp_status_t keel_fm25v02_start(const keel_bus_t *bus);

/**
 * Reads bytes in one exchange (requirement FRM-002).
 *
 * @param bus     the bus, with the memory selected
 * @param address of the first
 * @param bytes   what was read; as it was unless KEEL_BSP_OK
 * @param count   1 to KEEL_SLOTS_PIECE
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT when they are too many, or not within the memory;
 *         KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT of the bus
 */
keel_bsp_status_t keel_fm25v02_read(const keel_bus_t *bus, uint32_t address, uint8_t *bytes,
                                    uint32_t count);

/**
 * Writes bytes in two exchanges: writing is enabled anew each time (requirement FRM-003). The
 * memory does not tell whether it took them: who wants to know reads them back.
 *
 * @param bus     the bus, with the memory selected
 * @param address of the first
 * @param bytes   what is written
 * @param count   1 to KEEL_SLOTS_PIECE
 * @return as keel_fm25v02_read; after a failure of the bus any of them may be written
 */
keel_bsp_status_t keel_fm25v02_write(const keel_bus_t *bus, uint32_t address, const uint8_t *bytes,
                                     uint32_t count);

/**
 * The memory as a medium of slots (requirement FRM-004).
 *
 * @param bus the bus, with the memory selected; used as long as the medium is
 * @return the medium, which needs no erasing
 */
keel_medium_t keel_fm25v02_medium(keel_bus_t *bus);

#endif
