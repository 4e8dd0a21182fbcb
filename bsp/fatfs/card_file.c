/* SPDX-License-Identifier: Apache-2.0 */
#include "fatfs/card_file.h"

#include "ff.h"

#include "diskio.h"

#include <stddef.h>

#define DIGITS   5u
#define DIGIT_AT 3u
#define TEN      10u

/* LOG, digits, .ULG, and the end. */
#define NAME_BYTES 13u

/* The only state: FatFs calls the disk without a context. */
static const keel_disk_t *the_disk;
static uint32_t sectors;
static FATFS volume;
static FIL the_file;
static char the_name[NAME_BYTES];

/* A file in the root directory. */
typedef struct found {
    uint32_t number; /* 0: none. */
    uint32_t size;
} found_t;

/* Of what FatFs asks the disk: a card whose FAT is wrong may lead it anywhere. */
static bool is_on_disk(LBA_t sector, UINT count)
{
    return (sector < sectors) && (count <= (sectors - sector));
}

DSTATUS disk_status(BYTE drive)
{
    (void)drive;
    return 0u;
}

DSTATUS disk_initialize(BYTE drive)
{
    (void)drive;
    return the_disk->start(the_disk->context, &sectors) ? (DSTATUS)0u : (DSTATUS)STA_NOINIT;
}

DRESULT disk_read(BYTE drive, BYTE *bytes, LBA_t sector, UINT count)
{
    (void)drive;
    return (is_on_disk(sector, count) && the_disk->read(the_disk->context, sector, bytes, count))
               ? RES_OK
               : RES_ERROR;
}

DRESULT disk_write(BYTE drive, const BYTE *bytes, LBA_t sector, UINT count)
{
    (void)drive;
    return (is_on_disk(sector, count) && the_disk->write(the_disk->context, sector, bytes, count))
               ? RES_OK
               : RES_ERROR;
}

/* A disk keeps the order of what is written, so that nobody needs to wait here, least of all when a
 * size is told in flight. */
DRESULT disk_ioctl(BYTE drive, BYTE what, void *data)
{
    (void)drive;
    (void)data;
    return (what == (BYTE)CTRL_SYNC) ? RES_OK : RES_PARERR;
}

static keel_card_result_t result_of(FRESULT said)
{
    keel_card_result_t result;

    switch (said) {
    case FR_OK:
        result = KEEL_CARD_OK;
        break;
    case FR_DISK_ERR:
        result = KEEL_CARD_IO;
        break;
    case FR_NOT_READY:
        result = KEEL_CARD_ABSENT;
        break;
    case FR_NO_FILESYSTEM:
        result = KEEL_CARD_NO_FILE_SYSTEM;
        break;
    case FR_DENIED:
        result = KEEL_CARD_FULL;
        break;
    default:
        result = KEEL_CARD_DAMAGED;
        break;
    }
    return result;
}

static void name_file(uint32_t number)
{
    static const char pattern[NAME_BYTES] = "LOG00000.ULG";
    static const char digits[] = "0123456789";
    uint32_t left = number;

    for (uint32_t i = 0u; i < NAME_BYTES; i++) {
        the_name[i] = pattern[i];
    }
    for (uint32_t i = DIGITS; i > 0u; i--) {
        the_name[DIGIT_AT + i - 1u] = digits[left % TEN];
        left /= TEN;
    }
}

/* The number in a name; 0 when it is not one of ours. */
static uint32_t number_in(const char *name)
{
    uint32_t number = 0u;

    for (uint32_t i = 0u; i < DIGITS; i++) {
        const char *const digit = &name[DIGIT_AT + i];

        if ((*digit < '0') || (*digit > '9')) {
            return 0u;
        }
        number = (TEN * number) + ((uint32_t)(uint8_t)*digit - (uint32_t)(uint8_t)'0');
    }
    name_file(number);
    for (uint32_t i = 0u; i < NAME_BYTES; i++) {
        if (name[i] != the_name[i]) {
            return 0u;
        }
    }
    return number;
}

/* The file of the highest number. */
static FRESULT find_newest(found_t *newest)
{
    DIR directory;
    FILINFO entry;
    FRESULT said = f_opendir(&directory, "");

    newest->number = 0u;
    newest->size = 0u;
    while (said == FR_OK) {
        said = f_readdir(&directory, &entry);
        if ((said != FR_OK) || (entry.fname[0] == '\0')) {
            break;
        }
        if (number_in(entry.fname) > newest->number) {
            newest->number = number_in(entry.fname);
            newest->size = entry.fsize;
        }
    }
    return said;
}

/* Frees what is allocated behind a size of the open file. FatFs does so for a file that is longer;
 * by how much does not matter. */
static FRESULT cut_behind(uint32_t bytes)
{
    FRESULT said;

    the_file.obj.objsize = bytes;
    said = f_lseek(&the_file, bytes);
    if (said == FR_OK) {
        the_file.obj.objsize = bytes + 1u;
        said = f_truncate(&the_file);
    }
    return (said == FR_OK) ? f_close(&the_file) : said;
}

/* What a power cut left of the file before: it has all that was allocated. Whose size is more than
 * we allocate was made otherwise, and what cannot be opened is a folder or not to be written. A
 * failure costs room alone, and what is wrong with the card stands in the way of the next file,
 * too; what is wrong with that file does not. */
static void trim(const found_t *before, uint32_t bytes)
{
    name_file(before->number);
    if ((before->size <= bytes) && (f_open(&the_file, the_name, FA_READ | FA_WRITE) == FR_OK)) {
        (void)((before->size == 0u) ? f_unlink(the_name) : cut_behind(before->size));
    }
}

/* Writes the directory's entry; its sector stays in FatFs' buffer. Writing nothing is how FatFs is
 * told that there is something to write. */
static FRESULT write_entry(uint32_t bytes)
{
    UINT none;
    FRESULT said;

    the_file.obj.objsize = bytes;
    said = f_write(&the_file, the_name, 0u, &none);
    return (said == FR_OK) ? f_sync(&the_file) : said;
}

/* Where the file begins. */
static uint32_t first_sector(void)
{
    return volume.database + ((the_file.obj.sclust - 2u) * volume.csize);
}

/* f_expand makes a file as long as its allocation: the size becomes 0 before it gets to the card.
 * The second writing brings the directory's sector back, where that of FAT32's hints came after. */
static FRESULT allocate(uint32_t bytes)
{
    FRESULT said = f_expand(&the_file, bytes, 1u);

    if ((said == FR_OK) && !is_on_disk(first_sector(), bytes / KEEL_DISK_SECTOR_BYTES)) {
        said = FR_INT_ERR;
    }
    if (said == FR_OK) {
        said = write_entry(0u);
    }
    return (said == FR_OK) ? write_entry(0u) : said;
}

/* Makes the file of a number; takes its name back when there is no room. */
static FRESULT make_file(uint32_t number, uint32_t bytes)
{
    FRESULT said;

    name_file(number);
    said = f_open(&the_file, the_name, FA_WRITE | FA_CREATE_NEW);
    if (said == FR_OK) {
        said = allocate(bytes);
        if (said != FR_OK) {
            (void)f_unlink(the_name);
        }
    }
    return said;
}

static keel_card_result_t make_next(uint32_t bytes, keel_card_file_t *file)
{
    found_t newest;
    FRESULT said = find_newest(&newest);

    if ((said == FR_OK) && (newest.number > 0u)) {
        trim(&newest, bytes);
        said = find_newest(&newest);
    }
    if ((said == FR_OK) && (newest.number == KEEL_CARD_FILE_LAST)) {
        return KEEL_CARD_NAMES;
    }
    if (said == FR_OK) {
        said = make_file(newest.number + 1u, bytes);
    }
    if (said == FR_OK) {
        file->number = newest.number + 1u;
        file->sector = first_sector();
    }
    return result_of(said);
}

keel_card_result_t keel_card_file_make(const keel_disk_t *disk, uint32_t bytes,
                                       keel_card_file_t *file)
{
    keel_card_result_t result;

    the_disk = disk;
    sectors = 0u;
    result = result_of(f_mount(&volume, "", 1u));
    if (result == KEEL_CARD_OK) {
        result = make_next(bytes, file);
    }
    if (result != KEEL_CARD_OK) {
        keel_card_file_leave();
    }
    return result;
}

keel_card_result_t keel_card_file_set_size(uint32_t bytes)
{
    return result_of(write_entry(bytes));
}

keel_card_result_t keel_card_file_close(uint32_t bytes)
{
    FRESULT said;

    if (bytes == 0u) {
        said = f_unlink(the_name);
    } else {
        said = write_entry(bytes);
        if (said == FR_OK) {
            said = cut_behind(bytes);
        }
    }
    if ((said == FR_OK) && !the_disk->sync(the_disk->context)) {
        said = FR_DISK_ERR;
    }
    keel_card_file_leave();
    return result_of(said);
}

void keel_card_file_leave(void)
{
    (void)f_mount(NULL, "", 0u);
}
