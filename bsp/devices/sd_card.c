/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/sd_card.h"

#include <stddef.h>

/* Commands (SD Physical Layer Simplified Specification, 4.7.4); those of an application, ACMD, come
 * behind APP_CMD. */
#define GO_IDLE_STATE        0u
#define ALL_SEND_CID         2u
#define SEND_RELATIVE_ADDR   3u
#define ACMD_SET_BUS_WIDTH   6u
#define SELECT_CARD          7u
#define SEND_IF_COND         8u
#define SEND_CSD             9u
#define STOP_TRANSMISSION    12u
#define SEND_STATUS          13u
#define SET_BLOCKLEN         16u
#define READ_SINGLE_BLOCK    17u
#define READ_MULTIPLE_BLOCK  18u
#define WRITE_BLOCK          24u
#define WRITE_MULTIPLE_BLOCK 25u
#define ACMD_SEND_OP_COND    41u
#define APP_CMD              55u

/* Card status, R1 (4.10.1). Bit 25 says that a card is locked, bit 14 that it goes without ECC:
 * these are no errors. */
#define STATUS_ERRORS       0xFDF98008u
#define STATUS_NOT_TAKEN    0x00C00000u /* The command before was damaged, or is none. */
#define STATUS_OUT_OF_RANGE 0x80000000u
#define STATUS_STATE        0x00001E00u
#define STATUS_TRANSFER     0x00000800u /* State 4. */
#define STATUS_SENDING      0x00000A00u /* State 5: blocks to the host. */
#define STATUS_RECEIVING    0x00000C00u /* State 6: blocks of the host. */
#define STATUS_READY        0x00000100u
#define STATUS_APP_CMD      0x00000020u

#define IF_COND_3V3 0x000001AAu /* 2.7 to 3.6 V, and a pattern that is sent back. */
#define IF_COND     0x00000FFFu

/* Operation conditions, OCR (5.1). */
#define OCR_3V3      0x00300000u /* 3.2 to 3.4 V. */
#define OCR_CAPACITY 0x40000000u /* The host knows high capacity; the card has it. */
#define OCR_READY    0x80000000u
#define POWER_UP_US  1000u /* A card is up 1 ms behind its supply, and takes 74 clocks then. */
#define READY_EVERY  1000u /* us. */
#define READY_LOOKS  1000u /* A second (4.2.3). */
#define ADDRESS_MASK 0xFFFF0000u
#define FOUR_LINES   2u
#define ANSWER_WORDS 4u

/* Card-specific data, CSD (5.3): its words, highest first. */
#define CSD_STRUCTURE_SHIFT 30u
#define CSD_LENGTH_SHIFT    16u /* READ_BL_LEN, in word 1. */
#define CSD_LENGTH_MASK     0xFu
#define CSD_LENGTH_MIN      9u /* A sector's bytes, as a power of two. */
#define CSD_LENGTH_MAX      11u
#define CSD_SIZE_HIGH_MASK  0x3FFu /* C_SIZE of version 1: 10 bits in word 1, 2 in word 2. */
#define CSD_SIZE_HIGH_SHIFT 2u
#define CSD_SIZE_LOW_SHIFT  30u
#define CSD_FACTOR_SHIFT    15u /* C_SIZE_MULT, in word 2. */
#define CSD_FACTOR_MASK     7u
#define CSD_FACTOR_ADD      2u
#define CSD2_HIGH_MASK      0x3Fu /* C_SIZE of version 2: 6 bits in word 1, 16 in word 2. */
#define CSD2_HIGH_SHIFT     16u
#define CSD2_LOW_SHIFT      16u
#define CSD2_UNIT           1024u     /* Sectors. */
#define CSD2_LARGEST        0x3FFEFFu /* 2 TB: what SDXC goes to. */

static keel_bsp_status_t send_command(const keel_sd_card_t *card, uint32_t index, uint32_t argument,
                                      keel_sd_answer_t kind, uint32_t *answer)
{
    const keel_sd_command_t command = {index, argument, kind};

    return card->host.command(card->host.context, &command, answer);
}

/* A command whose answer is one word; 0 when there is none. */
static keel_bsp_status_t ask_card(const keel_sd_card_t *card, uint32_t index, uint32_t argument,
                                  keel_sd_answer_t kind, uint32_t *answer)
{
    uint32_t words[ANSWER_WORDS] = {0u, 0u, 0u, 0u};
    const keel_bsp_status_t status = send_command(card, index, argument, kind, words);

    *answer = words[0];
    return status;
}

/* A command that is answered with the card's status, which must be without an error. */
static keel_bsp_status_t order_card(const keel_sd_card_t *card, uint32_t index, uint32_t argument)
{
    uint32_t answer;
    const keel_bsp_status_t status = ask_card(card, index, argument, KEEL_SD_SHORT, &answer);

    return ((status == KEEL_BSP_OK) && ((answer & STATUS_ERRORS) != 0u)) ? KEEL_BSP_BUS : status;
}

/* What precedes a command of an application. Errors of the command before it, which a card of
 * version 1 does not know, are in this answer: it must say nothing but that it is understood. */
static keel_bsp_status_t announce_application(const keel_sd_card_t *card)
{
    uint32_t answer;
    const keel_bsp_status_t status = ask_card(card, APP_CMD, card->address, KEEL_SD_SHORT, &answer);

    return ((status == KEEL_BSP_OK) && ((answer & STATUS_APP_CMD) == 0u)) ? KEEL_BSP_BUS : status;
}

/* Whether the card is of version 2 or later and works at this supply; one that does not answer at
 * all is of version 1, or not there. */
static keel_bsp_status_t ask_version(const keel_sd_card_t *card, bool *is_later)
{
    uint32_t answer;
    const keel_bsp_status_t status = ask_card(card, SEND_IF_COND, IF_COND_3V3, KEEL_SD_SHORT,
                                              &answer);

    if (status == KEEL_BSP_TIMEOUT) {
        *is_later = false;
        return KEEL_BSP_OK;
    }
    *is_later = true;
    if (status != KEEL_BSP_OK) {
        return status;
    }
    return ((answer & IF_COND) == IF_COND_3V3) ? KEEL_BSP_OK : KEEL_BSP_ID;
}

/* One question whether the card is ready, and what it then says of itself. */
static keel_bsp_status_t ask_ready(const keel_sd_card_t *card, uint32_t wanted,
                                   uint32_t *conditions)
{
    uint32_t answer;
    keel_bsp_status_t status = announce_application(card);

    if (status == KEEL_BSP_OK) {
        status = ask_card(card, ACMD_SEND_OP_COND, wanted, KEEL_SD_PLAIN, &answer);
    }
    if (status != KEEL_BSP_OK) {
        return status;
    }
    *conditions = answer;
    return ((answer & OCR_READY) != 0u) ? KEEL_BSP_OK : KEEL_BSP_WAIT;
}

static keel_bsp_status_t wait_ready(const keel_sd_card_t *card, uint32_t wanted,
                                    uint32_t *conditions)
{
    keel_bsp_status_t status = ask_ready(card, wanted, conditions);

    for (uint32_t look = 1u; (look < READY_LOOKS) && (status == KEEL_BSP_WAIT); look++) {
        const keel_bsp_status_t waited = card->delay(card->host.context, READY_EVERY);

        status = (waited == KEEL_BSP_OK) ? ask_ready(card, wanted, conditions) : waited;
    }
    return (status == KEEL_BSP_WAIT) ? KEEL_BSP_TIMEOUT : status;
}

/* From any state to one in which the card is ready and says how it counts sectors (4.2.3). */
static keel_bsp_status_t wake(keel_sd_card_t *card)
{
    uint32_t answer;
    uint32_t conditions = 0u;
    bool is_later = false;
    keel_bsp_status_t status = ask_card(card, GO_IDLE_STATE, 0u, KEEL_SD_SILENT, &answer);

    if (status == KEEL_BSP_OK) {
        status = ask_version(card, &is_later);
    }
    if (status == KEEL_BSP_OK) {
        status = wait_ready(card, OCR_3V3 | (is_later ? OCR_CAPACITY : 0u), &conditions);
    }
    if (status != KEEL_BSP_OK) {
        return status;
    }
    card->per_sector = ((conditions & OCR_CAPACITY) != 0u) ? 1u : KEEL_DISK_SECTOR_BYTES;
    return ((conditions & OCR_3V3) == OCR_3V3) ? KEEL_BSP_OK : KEEL_BSP_ID;
}

/* The card gives itself an address. */
static keel_bsp_status_t identify_card(keel_sd_card_t *card)
{
    uint32_t identity[ANSWER_WORDS];
    uint32_t answer;
    keel_bsp_status_t status = send_command(card, ALL_SEND_CID, 0u, KEEL_SD_LONG, identity);

    if (status == KEEL_BSP_OK) {
        status = ask_card(card, SEND_RELATIVE_ADDR, 0u, KEEL_SD_SHORT, &answer);
    }
    if (status == KEEL_BSP_OK) {
        card->address = answer & ADDRESS_MASK;
    }
    return status;
}

/* Sectors by the first version of the card-specific data: up to 2 GB; 0 when it contradicts itself.
 * At most 4096 * 2^9 * 2^2. */
static uint32_t sectors_1(const uint32_t *csd)
{
    const uint32_t length = (csd[1] >> CSD_LENGTH_SHIFT) & CSD_LENGTH_MASK;
    const uint32_t size = ((csd[1] & CSD_SIZE_HIGH_MASK) << CSD_SIZE_HIGH_SHIFT) |
                          (csd[2] >> CSD_SIZE_LOW_SHIFT);
    const uint32_t factor = ((csd[2] >> CSD_FACTOR_SHIFT) & CSD_FACTOR_MASK) + CSD_FACTOR_ADD;

    if ((length < CSD_LENGTH_MIN) || (length > CSD_LENGTH_MAX)) {
        return 0u;
    }
    return (size + 1u) << (factor + (length - CSD_LENGTH_MIN));
}

/* The same by the second version: up to 2 TB, which are not quite 2^32 sectors. */
static uint32_t sectors_2(const uint32_t *csd)
{
    const uint32_t size = ((csd[1] & CSD2_HIGH_MASK) << CSD2_HIGH_SHIFT) |
                          (csd[2] >> CSD2_LOW_SHIFT);

    return (size <= CSD2_LARGEST) ? ((size + 1u) * CSD2_UNIT) : 0u;
}

/* Sectors by the version that it is, 0 for one that is not known here. */
static uint32_t sectors_of(const uint32_t *csd)
{
    const uint32_t structure = csd[0] >> CSD_STRUCTURE_SHIFT;

    if (structure == 0u) {
        return sectors_1(csd);
    }
    return (structure == 1u) ? sectors_2(csd) : 0u;
}

static keel_bsp_status_t ask_size(const keel_sd_card_t *card, uint32_t *sectors)
{
    uint32_t csd[ANSWER_WORDS];
    const keel_bsp_status_t status = send_command(card, SEND_CSD, card->address, KEEL_SD_LONG, csd);
    uint32_t found;

    if (status != KEEL_BSP_OK) {
        return status;
    }
    found = sectors_of(csd);
    if (found == 0u) {
        return KEEL_BSP_RANGE;
    }
    *sectors = found;
    return KEEL_BSP_OK;
}

/* Selected, on four lines, in blocks of a sector: those of high capacity know no others. */
static keel_bsp_status_t prepare_transfer(const keel_sd_card_t *card)
{
    keel_bsp_status_t status = order_card(card, SELECT_CARD, card->address);

    if (status == KEEL_BSP_OK) {
        status = announce_application(card);
    }
    if (status == KEEL_BSP_OK) {
        status = order_card(card, ACMD_SET_BUS_WIDTH, FOUR_LINES);
    }
    if ((status == KEEL_BSP_OK) && (card->per_sector != 1u)) {
        status = order_card(card, SET_BLOCKLEN, KEEL_DISK_SECTOR_BYTES);
    }
    if (status == KEEL_BSP_OK) {
        card->host.set_bus(card->host.context, KEEL_SD_BUS_TRANSFER);
    }
    return status;
}

keel_bsp_status_t keel_sd_card_start(keel_sd_card_t *card, uint32_t *sectors)
{
    uint32_t found = 0u;
    keel_bsp_status_t status;

    card->is_usable = false;
    card->address = 0u; /* What a card has that was not given one. */
    card->host.set_bus(card->host.context, KEEL_SD_BUS_IDENTIFY);
    status = card->delay(card->host.context, POWER_UP_US);
    if (status == KEEL_BSP_OK) {
        status = wake(card);
    }
    if (status == KEEL_BSP_OK) {
        status = identify_card(card);
    }
    if (status == KEEL_BSP_OK) {
        status = ask_size(card, &found);
    }
    if (status == KEEL_BSP_OK) {
        status = prepare_transfer(card);
    }
    if (status == KEEL_BSP_OK) {
        card->is_usable = true;
        *sectors = found;
    }
    return status;
}

static keel_bsp_status_t ask_status(const keel_sd_card_t *card, uint32_t *answer)
{
    return ask_card(card, SEND_STATUS, card->address, KEEL_SD_SHORT, answer);
}

/* Whether the card can take a command to transfer. An error that it tells belongs to a write that
 * it had taken. It tells each but once, so an answer that came damaged may have told one. */
static keel_bsp_status_t look_at_card(keel_sd_card_t *card)
{
    uint32_t answer;
    const keel_bsp_status_t status = ask_status(card, &answer);
    const bool has_erred = (answer & STATUS_ERRORS & ~STATUS_NOT_TAKEN) != 0u;

    if ((status == KEEL_BSP_BUS) || ((status == KEEL_BSP_OK) && has_erred)) {
        card->is_usable = false;
        return KEEL_BSP_BUS;
    }
    if (status != KEEL_BSP_OK) {
        return status;
    }
    return ((answer & (STATUS_STATE | STATUS_READY)) == (STATUS_TRANSFER | STATUS_READY))
               ? KEEL_BSP_OK
               : KEEL_BSP_WAIT;
}

/* Waits while the card is busy; whether it can be used then. */
static bool wait_idle(keel_sd_card_t *card)
{
    keel_bsp_status_t status = card->is_usable ? look_at_card(card) : KEEL_BSP_BUS;

    for (uint32_t i = 1u; (i < card->patience.looks) && (status == KEEL_BSP_WAIT); i++) {
        if (card->patience.between != NULL) {
            card->patience.between(card->patience.context);
        }
        status = look_at_card(card);
    }
    return status == KEEL_BSP_OK;
}

/* Ends a transfer of several blocks. Behind the card's last sector it may say that the next one
 * would be out of range, which means nothing (4.10.1). */
static bool stop_transfer(const keel_sd_card_t *card)
{
    uint32_t answer;
    const keel_bsp_status_t status = ask_card(card, STOP_TRANSMISSION, 0u, KEEL_SD_SHORT, &answer);
    const bool has_erred = (answer & STATUS_ERRORS & ~STATUS_OUT_OF_RANGE) != 0u;

    return (status == KEEL_BSP_OK) && !has_erred;
}

/* After a transfer that broke off: a card that is still in it leaves it; one that is not would not
 * know the command. What it tells of errors belongs to this transfer, which is told as failed. */
static void leave_transfer(const keel_sd_card_t *card)
{
    uint32_t answer;
    const keel_bsp_status_t status = ask_status(card, &answer);
    const uint32_t state = answer & STATUS_STATE;

    if ((status == KEEL_BSP_OK) && ((state == STATUS_SENDING) || (state == STATUS_RECEIVING))) {
        (void)stop_transfer(card);
    }
}

/* Ends a transfer; whether all of it went well. */
static bool conclude_transfer(const keel_sd_card_t *card, uint32_t count, keel_bsp_status_t status)
{
    bool is_done = (status == KEEL_BSP_OK);

    if (is_done && (count > 1u)) {
        is_done = stop_transfer(card);
    }
    if (!is_done) {
        leave_transfer(card);
    }
    return is_done;
}

static bool start_disk(void *context, uint32_t *sectors)
{
    return keel_sd_card_start(context, sectors) == KEEL_BSP_OK;
}

static bool is_disk_busy(void *context)
{
    keel_sd_card_t *const card = context;

    return card->is_usable && (look_at_card(card) == KEEL_BSP_WAIT);
}

static bool read_disk(void *context, uint32_t sector, uint8_t *bytes, uint32_t count)
{
    keel_sd_card_t *const card = context;
    const uint32_t command = (count == 1u) ? READ_SINGLE_BLOCK : READ_MULTIPLE_BLOCK;
    keel_bsp_status_t status;

    if (!wait_idle(card)) {
        return false;
    }
    card->host.expect(card->host.context, count);
    status = order_card(card, command, sector * card->per_sector);
    if (status == KEEL_BSP_OK) {
        status = card->host.take(card->host.context, bytes, count);
    }
    return conclude_transfer(card, count, status);
}

static bool write_disk(void *context, uint32_t sector, const uint8_t *bytes, uint32_t count)
{
    keel_sd_card_t *const card = context;
    const uint32_t command = (count == 1u) ? WRITE_BLOCK : WRITE_MULTIPLE_BLOCK;
    keel_bsp_status_t status;

    if (!wait_idle(card)) {
        return false;
    }
    status = order_card(card, command, sector * card->per_sector);
    if (status == KEEL_BSP_OK) {
        status = card->host.give(card->host.context, bytes, count);
    }
    return conclude_transfer(card, count, status);
}

static bool sync_disk(void *context)
{
    return wait_idle(context);
}

keel_disk_t keel_sd_card_disk(keel_sd_card_t *card)
{
    return (keel_disk_t){start_disk, is_disk_busy, read_disk, write_disk, sync_disk, card};
}
