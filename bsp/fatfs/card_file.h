/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file card_file.h
 * @brief A file on a card, allocated in one piece: all that the black box needs of FatFs.
 *
 * What stands between a power cut and the file is the order of writes. Making one writes the
 * allocation first, then the directory entry, whose size is 0. From then on the allocation stays as
 * it is: data go into sectors that are the file's already, and a new size is one write of the
 * directory's sector. The size never tells of bytes that are not on the card yet. The end cuts off
 * what was allocated in vain; where it was missed, the next file's making does so for the file
 * before it.
 *
 * There is one such file at a time, in static memory, as FatFs has one table of its volumes.
 */
#ifndef KEEL_BSP_FATFS_CARD_FILE_H
#define KEEL_BSP_FATFS_CARD_FILE_H

#include "common/disk.h"

#include <stdint.h>

/** What became of it. */
typedef enum keel_card_result {
    KEEL_CARD_OK = 0,         /**< Done. */
    KEEL_CARD_ABSENT,         /**< There is no card, or it does not start. */
    KEEL_CARD_NO_FILE_SYSTEM, /**< It has no FAT12, FAT16 or FAT32: exFAT is none. */
    KEEL_CARD_DAMAGED,        /**< Its file system contradicts itself. */
    KEEL_CARD_FULL,           /**< No room in one piece, or none in the root directory. */
    KEEL_CARD_NAMES,          /**< There is a file with the last number. */
    KEEL_CARD_IO              /**< A sector could not be read or written, or is not the card's. */
} keel_card_result_t;

/** The highest number of a file. */
#define KEEL_CARD_FILE_LAST 99999u

/** A file that was made. */
typedef struct keel_card_file {
    uint32_t number; /**< Of its name: 1 is LOG00001.ULG, in the root directory. */
    uint32_t sector; /**< The disk's sector in which it begins; the others follow. */
} keel_card_file_t;

/**
 * Makes an empty file, in one piece, and leaves it open. Its number follows the highest one that
 * there is. Before that the file of the highest number loses what is allocated behind its size,
 * or itself when it is empty. Waits for the card, for as many reads as the FAT has sectors: not to
 * be called in flight. The disk stays in use until the file is closed.
 *
 * @param disk  the card
 * @param bytes to allocate: a multiple of KEEL_DISK_SECTOR_BYTES, not 0
 * @param file  what was made; as it was unless KEEL_CARD_OK
 * @return KEEL_CARD_OK, or why there is no new file; then nothing is left open
 */
keel_card_result_t keel_card_file_make(const keel_disk_t *disk, uint32_t bytes,
                                       keel_card_file_t *file);

/**
 * Tells the directory the file's size: one sector is written, and none read. Waits only when the
 * disk is busy.
 *
 * @param bytes how many of the file's bytes are on the card, at most those allocated
 * @return KEEL_CARD_OK; KEEL_CARD_IO when the write failed: then it may be tried again
 */
keel_card_result_t keel_card_file_set_size(uint32_t bytes);

/**
 * Ends the file: its size is told, what is allocated behind it becomes free, and an empty file is
 * removed. Waits for the card; not to be called in flight. Whatever the result, the file is closed.
 *
 * @param bytes as for keel_card_file_set_size
 * @return KEEL_CARD_OK, or what went wrong: then the file has a size that it was told before
 */
keel_card_result_t keel_card_file_close(uint32_t bytes);

/** Forgets the file, and neither reads nor writes: what is on the card stays. */
void keel_card_file_leave(void);

#endif
