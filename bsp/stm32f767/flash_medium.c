/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/flash_medium.h"

#define KEY_1        0x45670123u
#define KEY_2        0xCDEF89ABu
#define BY_BYTES     0u
#define BY_WORDS     2u /* From 2.7 V on, as the flash must have for the core's clock. */
#define MEDIUM_BYTES (2u * KEEL_FLASH_SECTOR_BYTES)
#define ERRORS                                                                                     \
    (FLASH_SR_OPERR | FLASH_SR_WRPERR | FLASH_SR_PGAERR | FLASH_SR_PGPERR | FLASH_SR_ERSERR)

static bool is_in_sectors(uint32_t address, uint32_t count)
{
    return (address < MEDIUM_BYTES) && (count <= (MEDIUM_BYTES - address));
}

/* Lets go of the lock, with errors of before forgotten; not while something else is under way. */
static bool unlock_flash(const keel_flash_sectors_t *sectors, const keel_wait_t *wait)
{
    keel_flash_t *const flash = sectors->flash;

    if (!keel_wait_for(&flash->SR, FLASH_SR_BSY, 0u, wait)) {
        return false;
    }
    flash->SR = ERRORS; /* Ones clear. */
    if ((flash->CR & FLASH_CR_LOCK) != 0u) {
        flash->KEYR = KEY_1;
        flash->KEYR = KEY_2;
    }
    sectors->settle(sectors->context);
    return (flash->CR & FLASH_CR_LOCK) == 0u;
}

/* Waits for the end; whether all went well. The flash is locked whatever came. */
static bool end_operation(keel_flash_t *flash, const keel_wait_t *wait)
{
    const bool has_ended = keel_wait_for(&flash->SR, FLASH_SR_BSY, 0u, wait);
    const bool is_good = has_ended && ((flash->SR & ERRORS) == 0u);

    flash->CR = FLASH_CR_LOCK;
    return is_good;
}

static bool program_byte(const keel_flash_sectors_t *sectors, uint32_t address, uint8_t byte)
{
    if (!unlock_flash(sectors, sectors->program)) {
        return false;
    }
    sectors->flash->CR = FLASH_CR_PG | FIELD(FLASH_CR_PSIZE, BY_BYTES);
    sectors->settle(sectors->context);
    sectors->put(sectors->context, address, byte);
    return end_operation(sectors->flash, sectors->program);
}

static bool read_bytes_back(void *context, uint32_t address, uint8_t *bytes, uint32_t count)
{
    const keel_flash_sectors_t *const sectors = context;

    if (!is_in_sectors(address, count)) {
        return false;
    }
    for (uint32_t i = 0u; i < count; i++) {
        bytes[i] = sectors->get(sectors->context, address + i);
    }
    return true;
}

static bool program_bytes(void *context, uint32_t address, const uint8_t *bytes, uint32_t count)
{
    const keel_flash_sectors_t *const sectors = context;
    bool is_done = is_in_sectors(address, count);

    for (uint32_t i = 0u; (i < count) && is_done; i++) {
        is_done = program_byte(sectors, address + i, bytes[i]);
    }
    return is_done;
}

/* All of the sector that has these bytes, which must be of one. */
static bool erase_sector(void *context, uint32_t address, uint32_t count)
{
    const keel_flash_sectors_t *const sectors = context;
    const uint32_t sector = sectors->first + (address / KEEL_FLASH_SECTOR_BYTES);
    const bool is_one = (count <= KEEL_FLASH_SECTOR_BYTES) &&
                        ((address % KEEL_FLASH_SECTOR_BYTES) <= (KEEL_FLASH_SECTOR_BYTES - count));

    if (!is_one || !is_in_sectors(address, count) || !unlock_flash(sectors, sectors->erasure)) {
        return false;
    }
    sectors->flash->CR = FLASH_CR_SER | FIELD(FLASH_CR_SNB, sector) |
                         FIELD(FLASH_CR_PSIZE, BY_WORDS);
    sectors->flash->CR |= FLASH_CR_STRT;
    sectors->settle(sectors->context);
    return end_operation(sectors->flash, sectors->erasure);
}

keel_bsp_status_t keel_flash_medium(keel_flash_sectors_t *sectors, keel_medium_t *medium)
{
    if ((sectors->first < KEEL_FLASH_FIRST_LARGE) || (sectors->first >= KEEL_FLASH_LAST_LARGE)) {
        return KEEL_BSP_ARGUMENT;
    }
    if ((sectors->flash->OPTCR & FLASH_OPTCR_NDBANK) == 0u) {
        return KEEL_BSP_ID;
    }
    *medium = (keel_medium_t){read_bytes_back, program_bytes, erase_sector, sectors};
    return KEEL_BSP_OK;
}
