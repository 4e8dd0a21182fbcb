/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file black_box.h
 * @brief A log in a file on a card: a power cut takes the last second at most if the card is quick.
 *
 * Bytes are handed in at any time and only copied. A step does what is next, if the disk is not
 * busy: one write, of whole sectors as a rule. Every KEEL_BLACK_BOX_SYNC_US what was taken until
 * then becomes due: its last sector is written as far as it goes, and by a step of its own the
 * directory's sector, with a size that covers what was due. So a step writes at most config.burst
 * sectors, reads none, and waits for none. That is what makes it fit a task that nothing preempts.
 *
 * At every moment the file on the card is as long as its directory entry says, those bytes are
 * what was handed in (card_file.h says why), and the last one ends a write of the user's: a message
 * is whole if it was handed in as a whole. A byte is kept at the latest KEEL_BLACK_BOX_SYNC_US
 * after it was handed in, and the time in which the buffer's sectors and that of the directory are
 * written: KEEL_BLACK_BOX_SECTORS / config.burst + 3 steps, and as often the time for which the
 * disk is busy. On a disk on which that takes longer than KEEL_BLACK_BOX_SYNC_US it is twice that.
 *
 * For what there is no room is not taken: whoever logs keeps it, and says in the log what was lost.
 * After a failure, and when the file is full, there is no room.
 *
 * Opening and closing wait for the card: they are for the ground.
 *
 * What is here is tested, at every cut of the power, and not proved.
 */
#ifndef KEEL_BSP_FATFS_BLACK_BOX_H
#define KEEL_BSP_FATFS_BLACK_BOX_H

#include "common/disk.h"
#include "fatfs/card_file.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

/** Sectors of the buffer. */
#define KEEL_BLACK_BOX_SECTORS 16u

/** Bytes of the buffer. */
#define KEEL_BLACK_BOX_BYTES (KEEL_BLACK_BOX_SECTORS * KEEL_DISK_SECTOR_BYTES)

/** How often bytes become due, in us. */
#define KEEL_BLACK_BOX_SYNC_US 500000u

/** How often a write is tried again at once, in one step each, before the box gives up. */
#define KEEL_BLACK_BOX_TRIES 3u

/** The longest file of FAT in whole sectors. */
#define KEEL_BLACK_BOX_MOST 0xFFFFFE00u

/** What a black box is made from. */
typedef struct keel_black_box_config {
    const keel_disk_t *disk; /**< The card. */
    uint32_t allocation;     /**< Bytes of the file at most: a multiple of KEEL_DISK_SECTOR_BYTES,
                                  up to KEEL_BLACK_BOX_MOST. The copter's log takes 92 kB/s. */
    uint32_t burst;          /**< Sectors in a step at most: 1 to KEEL_BLACK_BOX_SECTORS. */
} keel_black_box_config_t;

/** What a black box does. */
typedef enum keel_black_box_state {
    KEEL_BLACK_BOX_CLOSED = 0, /**< There is no file. */
    KEEL_BLACK_BOX_OPEN,       /**< Bytes are taken, while there is room. */
    KEEL_BLACK_BOX_FAILED      /**< The card failed: what its directory knows of stays. */
} keel_black_box_state_t;

/** What was met since the box was opened. Each stays at UINT32_MAX. */
typedef struct keel_black_box_count {
    uint32_t sectors; /**< Written, those of the directory included. */
    uint32_t sizes;   /**< Told to the directory. */
    uint32_t busy;    /**< Steps that left as the disk was busy. */
    uint32_t errors;  /**< Writes that failed. */
    uint32_t refused; /**< Bytes that were not taken for want of room. */
} keel_black_box_count_t;

/** A black box. Written by the functions below alone; all of it may be read. */
typedef struct keel_black_box {
    keel_black_box_config_t config;
    keel_black_box_state_t state;
    keel_card_file_t file;                /**< The file; as the last one was when there is none. */
    uint32_t taken;                       /**< Bytes that were handed in, */
    uint32_t stored;                      /**< how many of them are on the card, */
    uint32_t kept;                        /**< and in the file, as the directory knows. */
    uint32_t due;                         /**< So many are to be in the file next. */
    uint32_t synced_us;                   /**< When they became due. */
    uint32_t failures;                    /**< Writes that failed in a row. */
    keel_black_box_count_t count;         /**< What was met. */
    uint8_t buffer[KEEL_BLACK_BOX_BYTES]; /**< Byte n of the file is at n modulo its size. */
} keel_black_box_t;

/**
 * Makes a black box (requirement BBX-001). The card is not touched.
 *
 * @param box    the box
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_NULL when there is no disk, or one without all its functions;
 *         KEEL_ERR_LIMITS when the allocation or the burst is out of its range; the first that
 *         applies: then nothing is changed
 */
keel_status_t keel_black_box_init(keel_black_box_t *box, const keel_black_box_config_t *config);

/**
 * Makes a new file and opens it (requirements BBX-002 to BBX-004). Waits for the card, for seconds
 * where it is large: for the ground. One box is open at a time in a program.
 *
 * @param box    the box, initialised and not open
 * @param now_us the time, in us, which wraps
 * @return KEEL_CARD_OK; else why there is no new file: then the box is closed, and no room
 */
keel_card_result_t keel_black_box_open(keel_black_box_t *box, uint32_t now_us);

/**
 * How many bytes are taken now (requirement BBX-005).
 *
 * @param box the box, initialised
 * @return that; 0 when it is not open
 */
uint32_t keel_black_box_room(const keel_black_box_t *box);

/**
 * Hands in bytes (requirement BBX-005). They are copied; the card is not touched.
 *
 * @param box    the box, initialised
 * @param bytes  the bytes
 * @param length how many; 0 is right
 * @return whether there was room for all; if not, none is taken, and all are counted
 */
bool keel_black_box_write(keel_black_box_t *box, const uint8_t *bytes, uint32_t length);

/**
 * Does what is due next, or nothing (requirements BBX-006 to BBX-009): one write of at most
 * config.burst sectors.
 *
 * @param box    the box, initialised
 * @param now_us the time, in us, which wraps
 * @return the state that it leads to
 */
keel_black_box_state_t keel_black_box_step(keel_black_box_t *box, uint32_t now_us);

/**
 * Writes all that was taken, cuts the file to that, and closes it (requirement BBX-010). A file
 * without a byte is removed. Waits for the card: for the ground.
 *
 * @param box the box, initialised; closed afterwards whatever the result
 * @return KEEL_CARD_OK, also when it was closed; KEEL_CARD_IO when it had failed or fails: then the
 *         file has a size that the directory was told before
 */
keel_card_result_t keel_black_box_close(keel_black_box_t *box);

#endif
