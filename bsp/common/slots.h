/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file slots.h
 * @brief A set of bytes that a power cut cannot take: two slots of a memory, written in turn.
 *
 * A slot holds a mark, then the set's sequence number, its length, its bytes, and a CRC-32 of all
 * these but the mark; numbers have their lowest byte first. The slot whose set is read is never
 * written: a new set goes into the other one, whose mark is cleared first and set last, when all
 * else was written and read back. So when the power fails, whichever byte is being written and
 * whatever becomes of it, the old set is read afterwards or the new one.
 *
 * The mark alone decides that; the check finds what it cannot: bits that change with time, and an
 * erasure that was cut.
 *
 * A save is made of steps, each of a few bytes, so that it can go on beside whatever flies.
 */
#ifndef KEEL_BSP_COMMON_SLOTS_H
#define KEEL_BSP_COMMON_SLOTS_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** How many slots there are. */
#define KEEL_SLOTS 2

/** The most bytes that are read or written at once. */
#define KEEL_SLOTS_PIECE 8

/** The sequence number and the length of a set, which precede its bytes. */
#define KEEL_SLOTS_HEAD 8

/** The check, which follows them. */
#define KEEL_SLOTS_CHECK 4

/** Bytes of a slot that are not the set's: the mark, KEEL_SLOTS_HEAD and KEEL_SLOTS_CHECK. */
#define KEEL_SLOTS_OVERHEAD 13

/** The mark of a slot that holds a set, and the one that it is cleared to. */
#define KEEL_SLOTS_MARK    0x4B
#define KEEL_SLOTS_CLEARED 0x00

/** A memory that keeps its bytes without power. Each function returns whether it did it. */
typedef struct keel_medium {
    /** Reads 1 to KEEL_SLOTS_PIECE bytes. */
    bool (*read)(void *context, uint32_t address, uint8_t *bytes, uint32_t count);
    /** Writes 1 to KEEL_SLOTS_PIECE bytes, in their order; erased ones, where there is erase. */
    bool (*write)(void *context, uint32_t address, const uint8_t *bytes, uint32_t count);
    /** Erases a slot: its bytes read 0xFF. Null where bytes can be written without. */
    bool (*erase)(void *context, uint32_t address, uint32_t count);
    void *context; /**< Handed to all; may be null. */
} keel_medium_t;

/** What slots are made from. */
typedef struct keel_slots_config {
    keel_medium_t medium;
    uint32_t address[KEEL_SLOTS]; /**< Where each begins. Of room and KEEL_SLOTS_OVERHEAD bytes. */
    uint32_t room;                /**< Bytes of the longest set, at least 1. */
} keel_slots_config_t;

/** What was found in a slot. */
typedef enum keel_slot_state {
    KEEL_SLOT_EMPTY = 0,  /**< No mark: nothing was saved there, or not to its end. */
    KEEL_SLOT_MARKED,     /**< A set which was not looked at, as the other is newer. */
    KEEL_SLOT_WHOLE,      /**< The set that was loaded. */
    KEEL_SLOT_DAMAGED,    /**< A set whose length or check is wrong. */
    KEEL_SLOT_UNREADABLE, /**< The medium could not read it. */
} keel_slot_state_t;

/** A slot, as loading found it. */
typedef struct keel_slot {
    keel_slot_state_t state;
    uint32_t sequence; /**< Of its set; 0 unless the state is marked, whole or damaged. */
    uint32_t length;   /**< Of its set; 0 unless the state is marked or whole. */
} keel_slot_t;

/** How far a save is. */
typedef enum keel_slots_stage {
    KEEL_SLOTS_CLOSED = 0, /**< What is in the slots is not known: there is no saving. */
    KEEL_SLOTS_READY,      /**< No save is under way. */
    KEEL_SLOTS_CLEARING,   /**< Next, the mark is cleared. */
    KEEL_SLOTS_WRITING,    /**< Next, bytes are written. */
    KEEL_SLOTS_COMPARING,  /**< Next, bytes are read back. */
    KEEL_SLOTS_MARKING     /**< Next, the mark is set. */
} keel_slots_stage_t;

/** What became of a load or a step. */
typedef enum keel_slots_result {
    KEEL_SLOTS_DONE = 0, /**< A set was loaded, or saved, or there is nothing to do. */
    KEEL_SLOTS_BUSY,     /**< The save goes on: another step. */
    KEEL_SLOTS_NONE,     /**< No set was ever saved, or none is whole. */
    KEEL_SLOTS_READ,     /**< The medium could not read. */
    KEEL_SLOTS_WRITE,    /**< The medium could not write or erase. */
    KEEL_SLOTS_VERIFY    /**< What was written does not read back. */
} keel_slots_result_t;

/** Two slots. Written by the functions below alone; all of it may be read. */
typedef struct keel_slots {
    keel_slots_config_t config;
    keel_slot_t slot[KEEL_SLOTS]; /**< As the last load found them. */
    keel_slots_stage_t stage;
    uint32_t newest;      /**< The slot of the newest set: never written. */
    uint32_t sequence;    /**< Of the newest set; 0 when there is none. */
    const uint8_t *image; /**< What is being saved; null before the first save. */
    uint32_t length;      /**< Of that. */
    uint32_t at;          /**< How many bytes behind the mark are written, or compared. */
    uint32_t crc;         /**< Of those that were written, but the check's own. */
} keel_slots_t;

/**
 * Makes slots (requirements SLT-001 and SLT-002). Nothing is read or written.
 *
 * @param slots  the slots
 * @param config what they are made from; copied
 * @return KEEL_OK; KEEL_ERR_NULL when the medium cannot read or not write; KEEL_ERR_LIMITS when
 *         there is no room, or slots end behind the last address or overlap; the first that
 *         applies: then nothing is changed
 */
keel_status_t keel_slots_init(keel_slots_t *slots, const keel_slots_config_t *config);

/**
 * Loads the newest set that is whole (requirements SLT-003 to SLT-005). A save that was under way
 * ends; what was saved of it does not count.
 *
 * @param slots  the slots, initialised; slots->slot says what was found
 * @param image  the set, of config.room bytes; unless KEEL_SLOTS_DONE they are any
 * @param length its bytes; as it was unless KEEL_SLOTS_DONE
 * @return KEEL_SLOTS_DONE; KEEL_SLOTS_NONE when no set is whole; KEEL_SLOTS_READ when none is and a
 *         slot could not be read: then nothing can be saved, as that slot may hold one
 */
keel_slots_result_t keel_slots_load(keel_slots_t *slots, uint8_t *image, uint32_t *length);

/**
 * Begins to save a set (requirement SLT-006); keel_slots_step does it. Nothing is written yet.
 *
 * @param slots  the slots, loaded
 * @param image  the set: read until the save has ended, and not to be changed before
 * @param length its bytes; 0 is right
 * @return KEEL_OK; KEEL_ERR_STATE before they were loaded, or when that gave KEEL_SLOTS_READ, or
 *         when a save is under way; KEEL_ERR_LIMITS for more than config.room bytes; KEEL_ERR_FULL
 *         after 2^32 - 1 saves; the first that applies: then nothing is changed
 */
keel_status_t keel_slots_begin(keel_slots_t *slots, const uint8_t *image, uint32_t length);

/**
 * Goes on with a save, by at most KEEL_SLOTS_PIECE bytes (requirements SLT-007 to SLT-011). The
 * first step clears the other slot, and that can take long where the medium has to erase it.
 *
 * @param slots the slots, loaded
 * @return KEEL_SLOTS_BUSY while the save goes on; KEEL_SLOTS_DONE with its last step, and when
 *         none is under way; KEEL_SLOTS_READ, KEEL_SLOTS_WRITE or KEEL_SLOTS_VERIFY when it ended
 *         for an error: then the set of before is as it was, and is loaded, unless all but the
 *         mark's reading back went well: then it may be the new one
 */
keel_slots_result_t keel_slots_step(keel_slots_t *slots);

KEEL_C_END

#endif
