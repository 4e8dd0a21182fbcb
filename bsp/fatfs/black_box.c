/* SPDX-License-Identifier: Apache-2.0 */
#include "fatfs/black_box.h"

#include <stddef.h>

#define SECTOR KEEL_DISK_SECTOR_BYTES

static void count_up(uint32_t *count, uint32_t more)
{
    *count = (*count > (UINT32_MAX - more)) ? UINT32_MAX : (*count + more);
}

static uint32_t least(uint32_t one, uint32_t other)
{
    return (one < other) ? one : other;
}

/* Where the first sector begins that is not stored, or not to its end. */
static uint32_t open_sector(const keel_black_box_t *box)
{
    return box->stored - (box->stored % SECTOR);
}

/* Sectors that are whole in the buffer. */
static uint32_t whole_sectors(const keel_black_box_t *box)
{
    return (box->taken - open_sector(box)) / SECTOR;
}

/* Notes how a write ended; whether it did well. After too many failures the box gives up. */
static bool note_write(keel_black_box_t *box, bool done, uint32_t sectors)
{
    if (done) {
        box->failures = 0u;
        count_up(&box->count.sectors, sectors);
    } else {
        box->failures++;
        count_up(&box->count.errors, 1u);
        if (box->failures > KEEL_BLACK_BOX_TRIES) {
            box->state = KEEL_BLACK_BOX_FAILED;
            keel_card_file_leave();
        }
    }
    return done;
}

/* Writes sectors from the first one that is not stored on. */
static bool write_sectors(keel_black_box_t *box, uint32_t sectors)
{
    const keel_disk_t *const disk = box->config.disk;
    const uint32_t at = open_sector(box);

    return note_write(box,
                      disk->write(disk->context, box->file.sector + (at / SECTOR),
                                  &box->buffer[at % KEEL_BLACK_BOX_BYTES], sectors),
                      sectors);
}

/* As many whole sectors as may be written at once, and as lie in a row in the buffer. */
static void write_whole(keel_black_box_t *box)
{
    const uint32_t at = open_sector(box);
    const uint32_t row = (KEEL_BLACK_BOX_BYTES - (at % KEEL_BLACK_BOX_BYTES)) / SECTOR;
    const uint32_t sectors = least(least(whole_sectors(box), box->config.burst), row);

    if (write_sectors(box, sectors)) {
        box->stored = at + (sectors * SECTOR);
    }
}

/* The last sector as far as it goes, and zeros behind that. */
static void write_rest(keel_black_box_t *box)
{
    const uint32_t end = open_sector(box) + SECTOR;

    for (uint32_t at = box->taken; at < end; at++) {
        box->buffer[at % KEEL_BLACK_BOX_BYTES] = 0u;
    }
    if (write_sectors(box, 1u)) {
        box->stored = box->taken;
    }
}

static void write_data(keel_black_box_t *box)
{
    if (whole_sectors(box) > 0u) {
        write_whole(box);
    } else {
        write_rest(box);
    }
}

static void write_size(keel_black_box_t *box)
{
    if (note_write(box, keel_card_file_set_size(box->due) == KEEL_CARD_OK, 1u)) {
        box->kept = box->due;
        count_up(&box->count.sizes, 1u);
    }
}

/* Now and then what was taken until then becomes due. What comes later does not delay it. */
static void note_time(keel_black_box_t *box, uint32_t now_us)
{
    if ((box->due == box->kept) && ((now_us - box->synced_us) >= KEEL_BLACK_BOX_SYNC_US)) {
        box->due = box->taken;
        box->synced_us = now_us;
    }
}

static void write_next(keel_black_box_t *box)
{
    if (box->stored < box->due) {
        write_data(box);
    } else if (box->kept < box->due) {
        write_size(box);
    } else if (whole_sectors(box) > 0u) {
        write_whole(box);
    } else {
        /* Nothing is due. */
    }
}

static bool is_complete(const keel_disk_t *disk)
{
    return (disk->start != NULL) && (disk->is_busy != NULL) && (disk->read != NULL) &&
           (disk->write != NULL) && (disk->sync != NULL);
}

/* Nothing was taken, and nothing met. */
static void empty_box(keel_black_box_t *box)
{
    static const keel_black_box_count_t none = {0};

    box->taken = 0u;
    box->stored = 0u;
    box->kept = 0u;
    box->due = 0u;
    box->failures = 0u;
    box->count = none;
}

keel_status_t keel_black_box_init(keel_black_box_t *box, const keel_black_box_config_t *config)
{
    if ((config->disk == NULL) || !is_complete(config->disk)) {
        return KEEL_ERR_NULL;
    }
    if ((config->allocation == 0u) || (config->allocation > KEEL_BLACK_BOX_MOST) ||
        ((config->allocation % SECTOR) != 0u) || (config->burst == 0u) ||
        (config->burst > KEEL_BLACK_BOX_SECTORS)) {
        return KEEL_ERR_LIMITS;
    }
    box->config = *config;
    box->state = KEEL_BLACK_BOX_CLOSED;
    box->file.number = 0u;
    box->file.sector = 0u;
    box->synced_us = 0u;
    empty_box(box);
    return KEEL_OK;
}

keel_card_result_t keel_black_box_open(keel_black_box_t *box, uint32_t now_us)
{
    const keel_card_result_t result = keel_card_file_make(box->config.disk, box->config.allocation,
                                                          &box->file);

    empty_box(box);
    box->synced_us = now_us;
    box->state = (result == KEEL_CARD_OK) ? KEEL_BLACK_BOX_OPEN : KEEL_BLACK_BOX_CLOSED;
    return result;
}

uint32_t keel_black_box_room(const keel_black_box_t *box)
{
    if (box->state != KEEL_BLACK_BOX_OPEN) {
        return 0u;
    }
    return least(KEEL_BLACK_BOX_BYTES - (box->taken - open_sector(box)),
                 box->config.allocation - box->taken);
}

bool keel_black_box_write(keel_black_box_t *box, const uint8_t *bytes, uint32_t length)
{
    if (length > keel_black_box_room(box)) {
        count_up(&box->count.refused, length);
        return false;
    }
    for (uint32_t i = 0u; i < length; i++) {
        box->buffer[(box->taken + i) % KEEL_BLACK_BOX_BYTES] = bytes[i];
    }
    box->taken += length;
    return true;
}

keel_black_box_state_t keel_black_box_step(keel_black_box_t *box, uint32_t now_us)
{
    const keel_disk_t *const disk = box->config.disk;

    if (box->state != KEEL_BLACK_BOX_OPEN) {
        return box->state;
    }
    note_time(box, now_us);
    if (disk->is_busy(disk->context)) {
        count_up(&box->count.busy, 1u);
    } else {
        write_next(box);
    }
    return box->state;
}

keel_card_result_t keel_black_box_close(keel_black_box_t *box)
{
    keel_card_result_t result = KEEL_CARD_OK;

    while ((box->state == KEEL_BLACK_BOX_OPEN) && (box->stored < box->taken)) {
        write_data(box);
    }
    if (box->state == KEEL_BLACK_BOX_OPEN) {
        result = keel_card_file_close(box->stored);
        box->kept = (result == KEEL_CARD_OK) ? box->stored : box->kept;
    } else if (box->state == KEEL_BLACK_BOX_FAILED) {
        result = KEEL_CARD_IO;
    } else {
        /* It was closed. */
    }
    box->state = KEEL_BLACK_BOX_CLOSED;
    return result;
}
