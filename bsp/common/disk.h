/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file disk.h
 * @brief A disk of sectors, as an interface: what a file system needs of a card's driver.
 *
 * A disk keeps sectors in the order in which they are written: it takes one when all before it are
 * kept. When the power fails, the sector that is being written holds its old bytes or the new ones
 * afterwards, and all others hold theirs (docs/copter.md has this assumption on cards).
 *
 * A write returns when the disk has the bytes. Keeping them may take it a quarter of a second more,
 * in which it is busy; whoever must not wait asks for that first.
 */
#ifndef KEEL_BSP_COMMON_DISK_H
#define KEEL_BSP_COMMON_DISK_H

#include <stdbool.h>
#include <stdint.h>

/** Bytes of a sector. */
#define KEEL_DISK_SECTOR_BYTES 512u

/**
 * A disk. Each function but is_busy returns whether it did what it is for; none waits for ever.
 * Those that read or write are asked for sectors of the disk alone.
 */
typedef struct keel_disk {
    /** Makes the disk ready, whatever it was doing; tells how many sectors it has. */
    bool (*start)(void *context, uint32_t *sectors);
    /** Whether a read or a write would wait, as the disk is still keeping what was written. */
    bool (*is_busy)(void *context);
    /** Reads sectors, at least one; waits while the disk is busy. */
    bool (*read)(void *context, uint32_t sector, uint8_t *bytes, uint32_t count);
    /** Writes sectors in their order, at least one; waits while the disk is busy. */
    bool (*write)(void *context, uint32_t sector, const uint8_t *bytes, uint32_t count);
    /** Waits until all that was written is kept. */
    bool (*sync)(void *context);
    void *context; /**< Handed to all; may be null. */
} keel_disk_t;

#endif
