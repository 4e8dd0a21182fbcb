/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file flash_medium.h
 * @brief Two sectors of the chip's flash as a memory for slots: for boards without another one.
 *
 * Bytes are programmed one by one into erased ones, which any supply allows. Whatever is read from
 * the flash meanwhile waits, code included: 100 us for a byte, and up to some seconds while a
 * sector is erased. So a save is for the ground, and an erasure for where no watchdog runs.
 *
 * It is for a flash of one bank, as chips are delivered; the sectors of two banks are others.
 */
#ifndef KEEL_BSP_STM32F767_FLASH_MEDIUM_H
#define KEEL_BSP_STM32F767_FLASH_MEDIUM_H

#include "common/bsp_status.h"
#include "common/slots.h"
#include "common/wait.h"
#include "stm32f767/registers/flash.h"

#include <stdint.h>

/** Bytes of a sector, of those from KEEL_FLASH_FIRST_LARGE on. */
#define KEEL_FLASH_SECTOR_BYTES 0x40000u

/** The first and the last sector of that size. */
#define KEEL_FLASH_FIRST_LARGE 5u
#define KEEL_FLASH_LAST_LARGE  11u

/** Two sectors, one behind the other. Address 0 of the medium is the first byte of the first. */
typedef struct keel_flash_sectors {
    keel_flash_t *flash;
    uint32_t first;             /**< The first one's number. */
    const keel_wait_t *program; /**< The bound of a byte's programming: 100 us at least. */
    const keel_wait_t *erasure; /**< The bound of a sector's erasing: some seconds. */
    /** Returns when what was written to registers has taken effect. */
    void (*settle)(void *context);
    /** Reads a byte from the flash itself, past any cache. */
    uint8_t (*get)(void *context, uint32_t address);
    /** Stores a byte to the flash, and returns when it is stored. */
    void (*put)(void *context, uint32_t address, uint8_t byte);
    void *context; /**< Handed to these three; may be null. */
} keel_flash_sectors_t;

/**
 * The sectors as a medium, whose slots begin at 0 and at KEEL_FLASH_SECTOR_BYTES (requirements
 * FLM-001 to FLM-007). Nothing is read or written.
 *
 * @param sectors the sectors; stay in use
 * @param medium  the medium; as it was unless KEEL_BSP_OK
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT when a sector has another size; KEEL_BSP_ID when the
 *         chip's option bytes make two banks of its flash
 */
keel_bsp_status_t keel_flash_medium(keel_flash_sectors_t *sectors, keel_medium_t *medium);

#endif
