/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file card.h
 * @brief A simulated card, sector by sector, as a disk.
 *
 * When its power fails, the sector that is being written keeps its old bytes, as those do that
 * follow it. Reads and writes are counted in sectors, from 1.
 */
#ifndef KEEL_BSP_SIMULATED_CARD_H
#define KEEL_BSP_SIMULATED_CARD_H

#include "common/disk.h"

#include <stdbool.h>
#include <stdint.h>

/** A count that is never reached. */
#define SIMULATED_CARD_NEVER UINT32_MAX

/** A card in its slot. */
typedef struct simulated_card {
    uint8_t *bytes;   /**< What it holds. */
    uint32_t sectors; /**< How much that is. */
    bool is_absent;
    uint32_t reads;            /**< So many there were; may be set to 0. */
    uint32_t writes;           /**< The same. */
    uint32_t fails_read;       /**< This one fails. */
    uint32_t fails_write_from; /**< From this one … */
    uint32_t fails_write_for;  /**< … so many fail. */
    uint32_t power;            /**< So many sectors are written until it fails. */
    uint32_t busy_looks;       /**< Behind a write it is busy for so many looks. */
    uint32_t busy_left;        /**< Of these. */
    uint32_t waits;            /**< Reads and writes for which somebody waited. */
    uint32_t strays;           /**< Reads and writes of sectors that it has not. */
    uint32_t syncs;            /**< So many there were. */
    void (*watch)(uint32_t sector, const uint8_t *bytes); /**< Each sector written, or null. */
} simulated_card_t;

/** A card that nothing is wrong with. */
void simulated_card_init(simulated_card_t *card, uint8_t *bytes, uint32_t sectors);

/** The card as a disk. */
keel_disk_t simulated_card_disk(simulated_card_t *card);

#endif
