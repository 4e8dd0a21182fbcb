/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/card.h"

#include <string.h>

static bool start_card(void *context, uint32_t *sectors)
{
    const simulated_card_t *const card = context;

    *sectors = card->is_absent ? 0u : card->sectors;
    return !card->is_absent;
}

static bool is_card_busy(void *context)
{
    simulated_card_t *const card = context;
    const bool busy = card->busy_left > 0u;

    card->busy_left -= busy ? 1u : 0u;
    return busy;
}

/* Somebody waits until it is not. */
static void wait_for(simulated_card_t *card)
{
    card->waits += (card->busy_left > 0u) ? 1u : 0u;
    card->busy_left = 0u;
}

/* Whether it is asked for sectors that it has not. */
static void note_stray(simulated_card_t *card, uint32_t sector, uint32_t count)
{
    card->strays += ((sector < card->sectors) && (count <= (card->sectors - sector))) ? 0u : 1u;
}

static bool read_card(void *context, uint32_t sector, uint8_t *bytes, uint32_t count)
{
    simulated_card_t *const card = context;

    wait_for(card);
    note_stray(card, sector, count);
    for (uint32_t i = 0u; i < count; i++) {
        card->reads++;
        if (card->is_absent || (card->reads == card->fails_read) || (sector >= card->sectors) ||
            (i >= (card->sectors - sector))) {
            return false;
        }
        memcpy(&bytes[i * KEEL_DISK_SECTOR_BYTES],
               &card->bytes[(size_t)(sector + i) * KEEL_DISK_SECTOR_BYTES], KEEL_DISK_SECTOR_BYTES);
    }
    return true;
}

static bool fails_now(const simulated_card_t *card)
{
    return card->is_absent || (card->power == 0u) ||
           ((card->writes >= card->fails_write_from) &&
            ((card->writes - card->fails_write_from) < card->fails_write_for));
}

static bool write_card(void *context, uint32_t sector, const uint8_t *bytes, uint32_t count)
{
    simulated_card_t *const card = context;

    wait_for(card);
    note_stray(card, sector, count);
    for (uint32_t i = 0u; i < count; i++) {
        const uint8_t *const from = &bytes[i * KEEL_DISK_SECTOR_BYTES];

        card->writes++;
        if (fails_now(card) || (sector >= card->sectors) || (i >= (card->sectors - sector))) {
            return false;
        }
        card->power -= (card->power == SIMULATED_CARD_NEVER) ? 0u : 1u;
        memcpy(&card->bytes[(size_t)(sector + i) * KEEL_DISK_SECTOR_BYTES], from,
               KEEL_DISK_SECTOR_BYTES);
        if (card->watch != NULL) {
            card->watch(sector + i, from);
        }
    }
    card->busy_left = card->busy_looks;
    return true;
}

static bool sync_card(void *context)
{
    simulated_card_t *const card = context;

    card->busy_left = 0u;
    card->syncs++;
    return !card->is_absent && (card->power > 0u);
}

void simulated_card_init(simulated_card_t *card, uint8_t *bytes, uint32_t sectors)
{
    memset(card, 0, sizeof *card);
    card->bytes = bytes;
    card->sectors = sectors;
    card->fails_read = SIMULATED_CARD_NEVER;
    card->fails_write_from = SIMULATED_CARD_NEVER;
    card->power = SIMULATED_CARD_NEVER;
}

keel_disk_t simulated_card_disk(simulated_card_t *card)
{
    const keel_disk_t disk = {.start = start_card,
                              .is_busy = is_card_busy,
                              .read = read_card,
                              .write = write_card,
                              .sync = sync_card,
                              .context = card};

    return disk;
}
