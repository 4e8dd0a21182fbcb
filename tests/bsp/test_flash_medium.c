/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/flash_medium.h with a simulated flash. Keys, bits and sectors are
 * those of RM0410, 3.3 and 3.7. */
#include "stm32f767/flash_medium.h"
#include "unity.h"

#include <string.h>

#define SECTOR 0x40000u
#define FIRST  10u
#define LOCKED 0x80000000u
#define BUSY   0x00010000u
#define NEVER  UINT32_MAX

/* The flash, with what can go wrong. Time passes at each look. */
static keel_flash_t flash;
static uint8_t memory[2u * SECTOR];
static uint32_t busy_looks; /* So long an operation takes. */
static uint32_t left;
static uint32_t fails_at; /* This operation ends with that error. */
static uint32_t error;
static uint32_t operations;
static uint32_t power; /* Operations until it fails. */
static uint32_t last_sector;
static bool ignores_keys;
static uint32_t settled_control; /* CR when it was last certain. */

static keel_flash_sectors_t sectors;
static keel_medium_t medium;

static void begin(void)
{
    operations++;
    left = busy_looks;
    flash.SR |= BUSY | ((operations == fails_at) ? error : 0u);
}

static void erase_now(void)
{
    const uint32_t sector = (flash.CR >> 3) & 0xFu;

    TEST_ASSERT_EQUAL_HEX32(0x10202u | (sector << 3), flash.CR); /* By words. */
    TEST_ASSERT_TRUE((sector == FIRST) || (sector == (FIRST + 1u)));
    flash.CR &= ~0x10000u;
    begin();
    last_sector = sector;
    if ((operations != fails_at) && (power > 0u)) {
        memset(&memory[(sector - FIRST) * SECTOR], 0xFF, SECTOR);
    }
    power -= ((power == NEVER) || (power == 0u)) ? 0u : 1u;
}

/* What was written to registers takes effect. */
static void settle(void *context)
{
    TEST_ASSERT_EQUAL_PTR(&memory, context);
    if (flash.SR == 0xF2u) { /* Ones clear, and the driver clears all. */
        flash.SR = 0u;
    }
    settled_control = flash.CR;
    if ((flash.KEYR == 0xCDEF89ABu) && !ignores_keys) {
        flash.CR &= ~LOCKED;
    }
    flash.KEYR = 0u;
    if ((flash.CR & 0x10002u) == 0x10002u) { /* STRT and SER. */
        erase_now();
    }
}

/* Time passes. */
static void advance(void *context)
{
    (void)context;
    if (left > 0u) {
        left--;
    } else {
        flash.SR &= ~BUSY;
    }
}

static uint8_t get(void *context, uint32_t address)
{
    TEST_ASSERT_EQUAL_PTR(&memory, context);
    TEST_ASSERT_EQUAL_HEX32(0u, flash.SR & BUSY);
    return memory[address];
}

static void put(void *context, uint32_t address, uint8_t byte)
{
    TEST_ASSERT_EQUAL_PTR(&memory, context);
    TEST_ASSERT_EQUAL_HEX32(0x1u, settled_control); /* Or the byte could come before it. */
    settled_control = 0u;
    TEST_ASSERT_EQUAL_HEX32(0x1u, flash.CR); /* Programming, by bytes, and not locked. */
    TEST_ASSERT_EQUAL_HEX32(0u, flash.SR & BUSY);
    begin();
    if ((operations != fails_at) && (power > 0u)) {
        memory[address] &= byte;
    }
    power -= ((power == NEVER) || (power == 0u)) ? 0u : 1u;
}

static const keel_wait_t short_wait = {5u, advance, NULL};
static const keel_wait_t long_wait = {50u, advance, NULL};

void setUp(void)
{
    memset(&flash, 0, sizeof flash);
    for (uint32_t i = 0u; i < sizeof memory; i++) {
        memory[i] = (uint8_t)(i ^ (i >> 8));
    }
    flash.OPTCR = 0xFFFFAAFDu; /* As delivered. */
    flash.CR = LOCKED;
    busy_looks = 2u;
    left = 0u;
    fails_at = NEVER;
    error = 0u;
    operations = 0u;
    power = NEVER;
    ignores_keys = false;
    settled_control = 0u;
    sectors = (keel_flash_sectors_t){&flash, FIRST, &short_wait, &long_wait,
                                     settle, get,   put,         memory};
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_flash_medium(&sectors, &medium));
}

void tearDown(void)
{
}

static bool erase(uint32_t address, uint32_t count)
{
    const bool done = medium.erase(medium.context, address, count);

    TEST_ASSERT_EQUAL_HEX32(LOCKED, flash.CR);
    return done;
}

static bool write_bytes(uint32_t address, const char *text, uint32_t count)
{
    const bool done = medium.write(medium.context, address, (const uint8_t *)text, count);

    TEST_ASSERT_EQUAL_HEX32(LOCKED, flash.CR);
    return done;
}

static void FLM_001_sectors_of_another_size_are_refused(void)
{
    static const uint32_t wrong[] = {0u, 4u, 11u, 12u, UINT32_MAX};
    const keel_medium_t before = medium;

    for (uint32_t i = 0u; i < (sizeof wrong / sizeof wrong[0]); i++) {
        sectors.first = wrong[i];
        TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_flash_medium(&sectors, &medium));
        TEST_ASSERT_EQUAL_MEMORY(&before, &medium, sizeof medium);
    }
    sectors.first = 5u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_flash_medium(&sectors, &medium));
}

static void FLM_001_two_banks_are_refused(void)
{
    const keel_medium_t before = medium;

    flash.OPTCR &= ~0x20000000u; /* nDBANK. */
    TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_flash_medium(&sectors, &medium));
    TEST_ASSERT_EQUAL_MEMORY(&before, &medium, sizeof medium);
}

static void FLM_002_bytes_are_read(void)
{
    uint8_t bytes[8];

    TEST_ASSERT_TRUE(medium.read(medium.context, SECTOR - 4u, bytes, 8u));
    TEST_ASSERT_EQUAL_MEMORY(&memory[SECTOR - 4u], bytes, 8u);
    TEST_ASSERT_TRUE(medium.read(medium.context, (2u * SECTOR) - 1u, bytes, 1u));
    TEST_ASSERT_EQUAL_HEX8(memory[(2u * SECTOR) - 1u], bytes[0]);
    TEST_ASSERT_EQUAL_UINT32(0u, operations);
}

static void FLM_003_bytes_are_programmed_in_their_order(void)
{
    memset(memory, 0xFF, sizeof memory);
    TEST_ASSERT_TRUE(write_bytes(SECTOR + 3u, "Keel", 4u));
    TEST_ASSERT_EQUAL_MEMORY("\xFF\xFF\xFFKeel\xFF", &memory[SECTOR], 8u);
    TEST_ASSERT_EQUAL_UINT32(4u, operations);
}

static void FLM_003_a_lock_that_stays(void)
{
    ignores_keys = true;
    TEST_ASSERT_FALSE(write_bytes(0u, "K", 1u));
    TEST_ASSERT_FALSE(erase(0u, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, operations);
}

static void FLM_004_a_sector_is_erased_and_no_other(void)
{
    uint8_t expected[sizeof memory];

    memcpy(expected, memory, sizeof memory);
    memset(&expected[SECTOR], 0xFF, SECTOR);
    TEST_ASSERT_TRUE(erase(SECTOR, 100u));
    TEST_ASSERT_EQUAL_UINT32(FIRST + 1u, last_sector);
    TEST_ASSERT_EQUAL_MEMORY(expected, memory, sizeof memory);
    TEST_ASSERT_TRUE(erase(0u, SECTOR));
    TEST_ASSERT_EQUAL_UINT32(FIRST, last_sector);
    TEST_ASSERT_EQUAL_UINT32(2u, operations);
}

static void FLM_005_what_is_not_within_is_refused(void)
{
    uint8_t bytes[8] = {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u};

    TEST_ASSERT_FALSE(medium.read(medium.context, (2u * SECTOR) - 7u, bytes, 8u));
    TEST_ASSERT_FALSE(medium.read(medium.context, 2u * SECTOR, bytes, 1u));
    TEST_ASSERT_FALSE(medium.read(medium.context, UINT32_MAX, bytes, 8u));
    TEST_ASSERT_EQUAL_HEX8(1u, bytes[0]);
    TEST_ASSERT_FALSE(medium.write(medium.context, (2u * SECTOR) - 7u, bytes, 8u));
    TEST_ASSERT_FALSE(medium.write(medium.context, UINT32_MAX, bytes, 8u));
    TEST_ASSERT_FALSE(medium.erase(medium.context, 2u * SECTOR, 1u));
    TEST_ASSERT_FALSE(medium.erase(medium.context, 1u, SECTOR)); /* Of two sectors. */
    TEST_ASSERT_FALSE(medium.erase(medium.context, 0u, SECTOR + 1u));
    TEST_ASSERT_FALSE(medium.erase(medium.context, SECTOR - 1u, UINT32_MAX));
    TEST_ASSERT_EQUAL_UINT32(0u, operations);
}

static void FLM_006_errors_are_told(void)
{
    static const uint32_t errors[] = {0x2u, 0x10u, 0x20u, 0x40u, 0x80u};

    memset(memory, 0xFF, sizeof memory);
    for (uint32_t i = 0u; i < (sizeof errors / sizeof errors[0]); i++) {
        error = errors[i];
        fails_at = operations + 2u;
        TEST_ASSERT_FALSE(write_bytes(16u * i, "Keel", 4u));
        TEST_ASSERT_EQUAL_UINT32(fails_at, operations); /* And nothing behind it is done. */
        fails_at = operations + 1u;
        TEST_ASSERT_FALSE(erase(0u, 1u));
        fails_at = NEVER;
    }
}

/* The flags stay until they are cleared. */
static void FLM_006_errors_of_before_do_not_count(void)
{
    flash.SR = 0x70u;
    TEST_ASSERT_TRUE(erase(0u, 1u));
    flash.SR = 0x82u;
    TEST_ASSERT_TRUE(write_bytes(0u, "K", 1u));
}

static void FLM_006_waits_are_bounded(void)
{
    busy_looks = NEVER;
    TEST_ASSERT_FALSE(write_bytes(0u, "Keel", 4u));
    TEST_ASSERT_EQUAL_UINT32(1u, operations);
    TEST_ASSERT_EQUAL_HEX32(BUSY, flash.SR & BUSY);
    TEST_ASSERT_FALSE(medium.write(medium.context, 0u, (const uint8_t *)"K", 1u));
    TEST_ASSERT_FALSE(medium.erase(medium.context, 0u, 1u)); /* It is under way still. */
    TEST_ASSERT_EQUAL_UINT32(1u, operations);
    left = 0u;
    busy_looks = 30u; /* As long as an erasure may take, but no byte. */
    TEST_ASSERT_TRUE(erase(0u, 1u));
    TEST_ASSERT_FALSE(write_bytes(0u, "K", 1u));
    TEST_ASSERT_EQUAL_UINT32(3u, operations);
    flash.SR = BUSY; /* Another's erasure is waited for. */
    left = 30u;
    TEST_ASSERT_TRUE(erase(0u, 1u));
}

/* --- With slots on it. --- */

#define ROOM 24u

static keel_slots_result_t load(keel_slots_t *slots, uint8_t *set, uint32_t *length)
{
    const keel_slots_config_t config = {.medium = medium, .address = {0u, SECTOR}, .room = ROOM};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(slots, &config));
    return keel_slots_load(slots, set, length);
}

static keel_slots_result_t save(keel_slots_t *slots, const char *text)
{
    keel_slots_result_t result = KEEL_SLOTS_BUSY;

    TEST_ASSERT_EQUAL(KEEL_OK,
                      keel_slots_begin(slots, (const uint8_t *)text, (uint32_t)strlen(text)));
    while (result == KEEL_SLOTS_BUSY) {
        result = keel_slots_step(slots);
    }
    return result;
}

/* Whichever operation the power fails at, the old set is there or the new one. */
static void FLM_007_slots_survive_a_cut_at_any_operation(void)
{
    keel_slots_t slots;
    uint8_t set[ROOM];
    uint32_t length = 0u;
    uint32_t all;

    busy_looks = 0u;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_NONE, load(&slots, set, &length));
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, save(&slots, "the old set"));
    operations = 0u;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, save(&slots, "another"));
    all = operations;
    TEST_ASSERT_EQUAL_UINT32(1u + 8u + 7u + 4u + 1u, all); /* Erase; head, set, check; mark. */
    for (uint32_t cut = 0u; cut <= all; cut++) {
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, load(&slots, set, &length));
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, save(&slots, "the old set"));
        power = cut;
        (void)save(&slots, "another");
        power = NEVER;
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, load(&slots, set, &length));
        if (cut < all) {
            TEST_ASSERT_EQUAL_UINT32(11u, length);
            TEST_ASSERT_EQUAL_MEMORY("the old set", set, 11u);
        } else {
            TEST_ASSERT_EQUAL_UINT32(7u, length);
            TEST_ASSERT_EQUAL_MEMORY("another", set, 7u);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(FLM_001_sectors_of_another_size_are_refused);
    RUN_TEST(FLM_001_two_banks_are_refused);
    RUN_TEST(FLM_002_bytes_are_read);
    RUN_TEST(FLM_003_bytes_are_programmed_in_their_order);
    RUN_TEST(FLM_003_a_lock_that_stays);
    RUN_TEST(FLM_004_a_sector_is_erased_and_no_other);
    RUN_TEST(FLM_005_what_is_not_within_is_refused);
    RUN_TEST(FLM_006_errors_are_told);
    RUN_TEST(FLM_006_errors_of_before_do_not_count);
    RUN_TEST(FLM_006_waits_are_bounded);
    RUN_TEST(FLM_007_slots_survive_a_cut_at_any_operation);
    return UNITY_END();
}
