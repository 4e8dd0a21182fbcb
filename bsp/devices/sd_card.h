/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sd_card.h
 * @brief An SD memory card as a disk, over the commands that a host interface sends.
 *
 * Commands, answers and their bits are those of the SD Physical Layer Simplified Specification.
 * Cards of standard capacity (SDSC), SDHC and SDXC are taken; MMC and SDUC are none of these.
 *
 * A card takes a write's bytes first and programs them afterwards, for up to half a second; what
 * goes wrong then it tells with the next answer. So the driver asks for the card's status before
 * each transfer. A write whose programming failed cannot be tried again, as its bytes are gone:
 * from then on everything fails, until the card is started anew. That is what disk.h promises: no
 * write is taken behind one that is lost.
 */
#ifndef KEEL_BSP_DEVICES_SD_CARD_H
#define KEEL_BSP_DEVICES_SD_CARD_H

#include "common/bsp_status.h"
#include "common/disk.h"
#include "common/wait.h"

#include <stdbool.h>
#include <stdint.h>

/** How a card answers a command (section 4.9). */
typedef enum keel_sd_answer {
    KEEL_SD_SILENT = 0, /**< Not at all. */
    KEEL_SD_SHORT,      /**< 32 bits, with the command's index and a checksum: R1, R6, R7. */
    KEEL_SD_PLAIN,      /**< 32 bits with neither of them: R3. */
    KEEL_SD_LONG        /**< 128 bits: R2. */
} keel_sd_answer_t;

/** A command. */
typedef struct keel_sd_command {
    uint32_t index; /**< 0 to 63. */
    uint32_t argument;
    keel_sd_answer_t answer; /**< How the card answers. */
} keel_sd_command_t;

/** How the host drives the bus. */
typedef enum keel_sd_bus {
    KEEL_SD_BUS_IDENTIFY = 0, /**< One data line, at most 400 kHz: until the card is known. */
    KEEL_SD_BUS_TRANSFER      /**< Four data lines, at most 25 MHz. */
} keel_sd_bus_t;

/**
 * A host interface. A transfer is in blocks of KEEL_DISK_SECTOR_BYTES. None of these functions
 * waits for ever; those with a status give KEEL_BSP_OK, KEEL_BSP_TIMEOUT when the card does not
 * answer, or KEEL_BSP_BUS when a checksum or an index is wrong, or the host missed bytes.
 */
typedef struct keel_sd_host {
    /** Sets the bus up; its clock runs from then on. */
    void (*set_bus)(void *context, keel_sd_bus_t bus);
    /** Sends a command and takes its answer: 4 words of which a short answer fills the first; a
     *  long one begins with the highest. */
    keel_bsp_status_t (*command)(void *context, const keel_sd_command_t *command, uint32_t *answer);
    /** Makes ready for so many blocks, at least one; the command that asks for them follows. */
    void (*expect)(void *context, uint32_t blocks);
    /** Takes them: behind that command. */
    keel_bsp_status_t (*take)(void *context, uint8_t *bytes, uint32_t blocks);
    /** Sends so many blocks, at least one: behind the command that announces them. Returns when
     *  the card has them, which need not have kept them yet. */
    keel_bsp_status_t (*give)(void *context, const uint8_t *bytes, uint32_t blocks);
    void *context; /**< Handed to all; may be null. */
} keel_sd_host_t;

/** A card. Its owner fills in the first three; the others are the driver's. */
typedef struct keel_sd_card {
    keel_sd_host_t host;
    /** Waits so many us, up to 1000, or says why it cannot; is handed the host's context. */
    keel_bsp_status_t (*delay)(void *context, uint32_t time_us);
    /** For how many looks at its status the card may be busy: half a second at least. A look takes
     *  the time of a command and its answer, 96 bits of the bus or more. */
    keel_wait_t patience;
    uint32_t address;    /**< The card's own, at the place that it has in arguments. */
    uint32_t per_sector; /**< By how much a sector's number counts in arguments: 1, or its bytes. */
    bool is_usable;      /**< It was started, and no programming has failed since. */
} keel_sd_card_t;

/**
 * Starts a card, whatever it was doing (requirements SDC-001 to SDC-005). Takes as long as the
 * card needs to be ready, up to some two seconds: for the ground.
 *
 * @param card    the card, its first three fields filled in
 * @param sectors how many it has, at least one; as it was unless KEEL_BSP_OK
 * @return KEEL_BSP_OK; KEEL_BSP_TIMEOUT when there is no card, or it does not become ready;
 *         KEEL_BSP_ID when it does not work at 3.3 V; KEEL_BSP_RANGE when its size is not one that
 *         is known here; KEEL_BSP_BUS when an answer is damaged, or an error; what delay returned
 */
keel_bsp_status_t keel_sd_card_start(keel_sd_card_t *card, uint32_t *sectors);

/**
 * The card as a disk, by disk.h (requirements SDC-006 to SDC-010). It may be used once the card is
 * started, by the disk's start or by keel_sd_card_start.
 *
 * @param card the card; stays in use
 */
keel_disk_t keel_sd_card_disk(keel_sd_card_t *card);

#endif
