/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/sd_card.h with a simulated card, which is strict about states. */
#include "devices/sd_card.h"
#include "simulated/sd_card.c"
#include "unity.h"

#include <string.h>

#define SECTORS 2048u
#define BUSY    5u

static uint8_t content[SECTORS * KEEL_DISK_SECTOR_BYTES];
static uint8_t other[8u * KEEL_DISK_SECTOR_BYTES];
static simulated_sd_t slot;
static keel_sd_card_t card;
static keel_disk_t disk;
static uint32_t sectors;
static uint32_t betweens;

static void between(void *context)
{
    TEST_ASSERT_EQUAL_PTR(&slot, context);
    betweens++;
}

void setUp(void)
{
    for (uint32_t i = 0u; i < sizeof content; i++) {
        content[i] = (uint8_t)((i / KEEL_DISK_SECTOR_BYTES) + (3u * i));
    }
    for (uint32_t i = 0u; i < sizeof other; i++) {
        other[i] = (uint8_t)(0x55u ^ (i + (i / KEEL_DISK_SECTOR_BYTES)));
    }
    simulated_sd_init(&slot, content, SECTORS);
    memset(&card, 0x5A, sizeof card);
    card.host = simulated_sd_host(&slot);
    card.delay = simulated_sd_delay;
    card.patience = (keel_wait_t){BUSY + 1u, between, &slot};
    disk = keel_sd_card_disk(&card);
    sectors = 77u;
    betweens = 0u;
}

void tearDown(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, slot.breaches);
}

static void starts(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_sd_card_start(&card, &sectors));
    TEST_ASSERT_EQUAL(SIMULATED_SD_TRANSFER, slot.state);
    TEST_ASSERT_EQUAL(KEEL_SD_BUS_TRANSFER, slot.bus);
}

/* It does not start, says so, and nothing can be done with it. */
static void refuses(keel_bsp_status_t status)
{
    uint8_t bytes[KEEL_DISK_SECTOR_BYTES];

    TEST_ASSERT_EQUAL(status, keel_sd_card_start(&card, &sectors));
    TEST_ASSERT_EQUAL_UINT32(77u, sectors);
    TEST_ASSERT_FALSE(disk.read(disk.context, 0u, bytes, 1u));
    TEST_ASSERT_FALSE(disk.write(disk.context, 0u, bytes, 1u));
    TEST_ASSERT_FALSE(disk.sync(disk.context));
    TEST_ASSERT_FALSE(disk.is_busy(disk.context));
    TEST_ASSERT_EQUAL_UINT32(0u, slot.blocks);
}

static void SDC_001_a_card_of_high_capacity_starts_from_any_state(void)
{
    for (uint32_t state = 0u; state <= (uint32_t)SIMULATED_SD_PROGRAMMING; state++) {
        slot.state = (simulated_sd_state_t)state;
        starts();
        TEST_ASSERT_EQUAL_UINT32(SECTORS, sectors);
    }
    TEST_ASSERT_EQUAL_HEX32(0x000001AAu, slot.last[8]);
    TEST_ASSERT_EQUAL_HEX32(0x40300000u, slot.last[41]); /* 3.2 to 3.4 V, high capacity. */
    TEST_ASSERT_EQUAL_HEX32(0xB3680000u, slot.last[7]);
    TEST_ASSERT_EQUAL_UINT32(2u, slot.last[6]); /* Four lines. */
    TEST_ASSERT_EQUAL_UINT32(0u, slot.count[16]);
    TEST_ASSERT_TRUE(slot.is_selected_wide);
}

static void SDC_001_the_disk_starts_it(void)
{
    TEST_ASSERT_TRUE(disk.start(disk.context, &sectors));
    TEST_ASSERT_EQUAL_UINT32(SECTORS, sectors);
    slot.is_absent = true;
    TEST_ASSERT_FALSE(disk.start(disk.context, &sectors));
}

/* A card has a millisecond with its clock before the first command. */
static void SDC_001_it_is_given_time(void)
{
    slot.ready_after = 0u;
    starts();
    TEST_ASSERT_EQUAL_UINT32(1000u, slot.waited_us);
    slot.ready_after = 4u; /* The fifth answer says so: four times a millisecond between. */
    starts();
    TEST_ASSERT_EQUAL_UINT32(6000u, slot.waited_us);
    slot.delays = KEEL_BSP_TIMEOUT;
    sectors = 77u;
    refuses(KEEL_BSP_TIMEOUT);
}

static void SDC_002_cards_of_standard_capacity(void)
{
    uint8_t bytes[KEEL_DISK_SECTOR_BYTES];

    simulated_sd_make_standard(&slot);
    starts();
    TEST_ASSERT_EQUAL_UINT32(SECTORS, sectors);
    TEST_ASSERT_EQUAL_HEX32(512u, slot.last[16]);
    TEST_ASSERT_TRUE(disk.read(disk.context, 3u, bytes, 1u));
    TEST_ASSERT_EQUAL_HEX32(1536u, slot.last[17]); /* It counts bytes. */
    TEST_ASSERT_EQUAL_MEMORY(&content[1536], bytes, sizeof bytes);
    TEST_ASSERT_TRUE(disk.write(disk.context, 5u, other, 1u));
    TEST_ASSERT_EQUAL_HEX32(2560u, slot.last[24]);
    TEST_ASSERT_EQUAL_MEMORY(other, &content[2560], sizeof bytes);
    slot.is_version_1 = true; /* And does not know SEND_IF_COND. */
    starts();
    TEST_ASSERT_EQUAL_HEX32(0x00300000u, slot.last[41]);
}

/* Such a card is never ready for a host that does not say that it knows high capacity. */
static void SDC_002_a_question_that_is_lost_does_not_make_it_ready(void)
{
    slot.loses_command = 2u; /* SEND_IF_COND. */
    refuses(KEEL_BSP_TIMEOUT);
}

/* The first version: C_SIZE at 62..73, C_SIZE_MULT at 47..49, READ_BL_LEN at 80..83. */
static void csd_1(uint32_t length, uint32_t size, uint32_t factor)
{
    simulated_sd_make_standard(&slot);
    slot.csd[1] = (length << 16) | (size >> 2);
    slot.csd[2] = (size << 30) | (factor << 15);
}

static void SDC_003_sizes_of_the_first_version(void)
{
    csd_1(9u, 0u, 0u);
    starts();
    TEST_ASSERT_EQUAL_UINT32(4u, sectors);
    csd_1(10u, 3874u, 7u); /* A card of 2 GB: 3875 * 512 blocks of 1024. */
    starts();
    TEST_ASSERT_EQUAL_UINT32(3968000u, sectors);
    csd_1(11u, 4095u, 7u);
    starts();
    TEST_ASSERT_EQUAL_UINT32(8388608u, sectors); /* 4 GB. */
    sectors = 77u;
    csd_1(8u, 4095u, 7u);
    refuses(KEEL_BSP_RANGE);
    csd_1(12u, 4095u, 7u);
    refuses(KEEL_BSP_RANGE);
}

static void csd_2(uint32_t size)
{
    slot.csd[1] = 0x5B590000u | (size >> 16);
    slot.csd[2] = (size << 16) | 0x7F80u;
}

static void SDC_003_sizes_of_the_second_version(void)
{
    csd_2(0x3B37u); /* A card of 8 GB: 15160 * 512 kB. */
    starts();
    TEST_ASSERT_EQUAL_UINT32(15523840u, sectors);
    csd_2(0x3FFEFFu); /* 2 TB. */
    starts();
    TEST_ASSERT_EQUAL_UINT32(4294705152u, sectors);
    sectors = 77u;
    csd_2(0x3FFF00u);
    refuses(KEEL_BSP_RANGE);
    slot.csd[0] = 0x800E0032u; /* The third version: more than 2 TB. */
    csd_2(0x3B37u);
    refuses(KEEL_BSP_RANGE);
}

static void SDC_004_no_card(void)
{
    slot.is_absent = true;
    refuses(KEEL_BSP_TIMEOUT);
}

static void SDC_004_a_card_that_is_never_ready(void)
{
    slot.ready_after = 999u; /* The thousandth answer. */
    starts();
    sectors = 77u;
    slot.ready_after = 1000u;
    refuses(KEEL_BSP_TIMEOUT);
}

static void SDC_004_a_card_for_another_supply(void)
{
    slot.pattern = 0x2AAu;
    refuses(KEEL_BSP_ID);
    slot.pattern = 0x1A8u;
    refuses(KEEL_BSP_ID);
    slot.pattern = 0x1AAu;
    slot.conditions = 0x400F8000u; /* Not up to 3.4 V. */
    refuses(KEEL_BSP_ID);
}

/* Whatever answer is damaged, or command lost, the start does not go on as if it had come. */
static void SDC_005_every_command_of_the_start_counts(void)
{
    uint32_t count;

    slot.ready_after = 0u;
    starts();
    count = slot.commands;
    for (uint32_t i = 1u; i <= count; i++) {
        slot.commands = 0u;
        slot.damages_command = i;
        if (i > 1u) { /* The first is not answered. */
            TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_sd_card_start(&card, &sectors));
            TEST_ASSERT_FALSE(card.is_usable);
        }
        slot.damages_command = SIMULATED_SD_NEVER;
        slot.commands = 0u;
        slot.loses_command = i;
        TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_sd_card_start(&card, &sectors));
        TEST_ASSERT_FALSE(card.is_usable);
        slot.loses_command = SIMULATED_SD_NEVER;
    }
}

static void SDC_006_blocks_come_from_their_sectors(void)
{
    uint8_t bytes[3u * KEEL_DISK_SECTOR_BYTES];

    starts();
    TEST_ASSERT_TRUE(disk.read(disk.context, 5u, bytes, 1u));
    TEST_ASSERT_EQUAL_MEMORY(&content[5u * 512u], bytes, 512u);
    TEST_ASSERT_TRUE(disk.read(disk.context, 1000u, bytes, 3u));
    TEST_ASSERT_EQUAL_MEMORY(&content[1000u * 512u], bytes, 1536u);
    TEST_ASSERT_EQUAL_UINT32(1u, slot.count[17]);
    TEST_ASSERT_EQUAL_UINT32(1u, slot.count[18]);
    TEST_ASSERT_EQUAL_UINT32(1u, slot.count[12]);
    /* The last ones, behind which the card has looked ahead. */
    TEST_ASSERT_TRUE(disk.read(disk.context, SECTORS - 2u, bytes, 2u));
    TEST_ASSERT_TRUE(disk.read(disk.context, SECTORS - 1u, bytes, 1u));
    TEST_ASSERT_EQUAL_MEMORY(&content[(SECTORS - 1u) * 512u], bytes, 512u);
}

static void SDC_007_blocks_go_to_their_sectors(void)
{
    uint8_t expected[sizeof content];

    memcpy(expected, content, sizeof content);
    memcpy(&expected[7u * 512u], other, 512u);
    memcpy(&expected[(SECTORS - 4u) * 512u], &other[512], 4u * 512u);
    starts();
    TEST_ASSERT_TRUE(disk.write(disk.context, 7u, other, 1u));
    TEST_ASSERT_TRUE(disk.write(disk.context, SECTORS - 4u, &other[512], 4u));
    TEST_ASSERT_TRUE(disk.sync(disk.context));
    TEST_ASSERT_EQUAL_MEMORY(expected, content, sizeof content);
    TEST_ASSERT_EQUAL_UINT32(1u, slot.count[24]);
    TEST_ASSERT_EQUAL_UINT32(1u, slot.count[25]);
    TEST_ASSERT_EQUAL_UINT32(1u, slot.count[12]);
}

static void SDC_008_a_busy_card_is_told_and_waited_for(void)
{
    uint8_t bytes[KEEL_DISK_SECTOR_BYTES];

    starts();
    TEST_ASSERT_FALSE(disk.is_busy(disk.context));
    slot.busy_looks = BUSY;
    TEST_ASSERT_TRUE(disk.write(disk.context, 7u, other, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, betweens); /* It returns when the card has the bytes. */
    TEST_ASSERT_TRUE(disk.is_busy(disk.context));
    TEST_ASSERT_TRUE(disk.write(disk.context, 8u, other, 2u));
    TEST_ASSERT_EQUAL_UINT32(BUSY - 1u, betweens);
    TEST_ASSERT_TRUE(disk.read(disk.context, 8u, bytes, 1u));
    TEST_ASSERT_TRUE(disk.write(disk.context, 9u, other, 1u));
    TEST_ASSERT_TRUE(disk.sync(disk.context));
    TEST_ASSERT_FALSE(disk.is_busy(disk.context));
}

static void SDC_008_but_not_for_ever(void)
{
    uint8_t bytes[KEEL_DISK_SECTOR_BYTES];

    starts();
    slot.busy_looks = BUSY + 1u;
    TEST_ASSERT_TRUE(disk.write(disk.context, 7u, other, 1u));
    TEST_ASSERT_FALSE(disk.sync(disk.context));
    TEST_ASSERT_EQUAL_UINT32(BUSY, betweens);
    slot.busy_left = BUSY + 1u;
    TEST_ASSERT_FALSE(disk.write(disk.context, 8u, other, 1u));
    slot.busy_left = BUSY + 1u;
    TEST_ASSERT_FALSE(disk.read(disk.context, 8u, bytes, 1u));
    slot.busy_left = 0u; /* It was late, but nothing is lost. */
    TEST_ASSERT_TRUE(disk.write(disk.context, 8u, other, 1u));
}

/* What failed may be tried again: the card has left the transfer. */
static void fails_once_and_works_again(bool (*go)(uint32_t count), uint32_t count)
{
    const uint32_t first = slot.commands;
    uint32_t commands;

    TEST_ASSERT_TRUE(go(count));
    commands = slot.commands - first;
    slot.fails_block = slot.blocks + count;
    TEST_ASSERT_FALSE(go(count));
    TEST_ASSERT_TRUE(go(count));
    for (uint32_t i = 1u; i <= commands; i++) {
        slot.loses_command = slot.commands + i;
        TEST_ASSERT_FALSE(go(count));
        TEST_ASSERT_TRUE(go(count));
    }
    for (uint32_t i = 2u; i <= commands; i++) { /* The first is a look, of which later. */
        slot.damages_command = slot.commands + i;
        TEST_ASSERT_FALSE(go(count));
        TEST_ASSERT_TRUE(go(count));
    }
}

static bool read_some(uint32_t count)
{
    uint8_t bytes[4u * KEEL_DISK_SECTOR_BYTES] = {0u};
    const bool done = disk.read(disk.context, 20u, bytes, count);

    if (done) {
        TEST_ASSERT_EQUAL_MEMORY(&content[20u * 512u], bytes, count * 512u);
    }
    return done;
}

static bool write_some(uint32_t count)
{
    const bool done = disk.write(disk.context, 20u, other, count);

    if (done) {
        TEST_ASSERT_EQUAL_MEMORY(other, &content[20u * 512u], count * 512u);
    }
    return done;
}

static void SDC_009_what_failed_can_be_tried_again(void)
{
    starts();
    fails_once_and_works_again(read_some, 1u);
    fails_once_and_works_again(read_some, 4u);
    fails_once_and_works_again(write_some, 1u);
    fails_once_and_works_again(write_some, 4u);
}

static void SDC_009_a_sector_that_is_not_the_cards(void)
{
    uint8_t bytes[KEEL_DISK_SECTOR_BYTES];

    starts();
    TEST_ASSERT_FALSE(disk.read(disk.context, SECTORS, bytes, 1u));
    TEST_ASSERT_FALSE(disk.write(disk.context, SECTORS, bytes, 2u));
    TEST_ASSERT_TRUE(read_some(1u));
}

static void SDC_009_a_card_that_is_pulled_out(void)
{
    starts();
    slot.is_absent = true;
    TEST_ASSERT_FALSE(read_some(1u));
    TEST_ASSERT_FALSE(write_some(2u));
    TEST_ASSERT_FALSE(disk.sync(disk.context));
    TEST_ASSERT_FALSE(disk.is_busy(disk.context)); /* There is nothing to wait for. */
}

/* Its bytes are gone: whoever went on would leave a hole in what is kept. */
static void SDC_010_after_programming_failed_nothing_works_until_a_start(void)
{
    uint8_t bytes[KEEL_DISK_SECTOR_BYTES];
    uint32_t writes;

    starts();
    slot.busy_looks = 1u;
    slot.fails_programming = slot.writes + 1u;
    TEST_ASSERT_TRUE(disk.write(disk.context, 7u, other, 1u));
    TEST_ASSERT_TRUE(disk.is_busy(disk.context));
    TEST_ASSERT_FALSE(disk.is_busy(disk.context)); /* Told here, and only once. */
    writes = slot.count[24];
    TEST_ASSERT_FALSE(disk.write(disk.context, 8u, other, 1u));
    TEST_ASSERT_FALSE(disk.read(disk.context, 8u, bytes, 1u));
    TEST_ASSERT_FALSE(disk.sync(disk.context));
    TEST_ASSERT_EQUAL_UINT32(writes, slot.count[24]);
    starts();
    TEST_ASSERT_TRUE(disk.write(disk.context, 8u, other, 1u));
    TEST_ASSERT_TRUE(disk.sync(disk.context));
}

/* A command that was damaged on its way is no write that is lost. */
static void SDC_010_a_command_that_was_not_taken_is_no_such_failure(void)
{
    starts();
    slot.errors = 0x00C00000u;
    TEST_ASSERT_TRUE(write_some(1u));
}

static void SDC_010_a_status_that_came_damaged_may_have_told_it(void)
{
    starts();
    slot.damages_command = slot.commands + 1u;
    TEST_ASSERT_FALSE(write_some(1u));
    TEST_ASSERT_FALSE(write_some(1u));
    starts();
    TEST_ASSERT_TRUE(write_some(1u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SDC_001_a_card_of_high_capacity_starts_from_any_state);
    RUN_TEST(SDC_001_the_disk_starts_it);
    RUN_TEST(SDC_001_it_is_given_time);
    RUN_TEST(SDC_002_cards_of_standard_capacity);
    RUN_TEST(SDC_002_a_question_that_is_lost_does_not_make_it_ready);
    RUN_TEST(SDC_003_sizes_of_the_first_version);
    RUN_TEST(SDC_003_sizes_of_the_second_version);
    RUN_TEST(SDC_004_no_card);
    RUN_TEST(SDC_004_a_card_that_is_never_ready);
    RUN_TEST(SDC_004_a_card_for_another_supply);
    RUN_TEST(SDC_005_every_command_of_the_start_counts);
    RUN_TEST(SDC_006_blocks_come_from_their_sectors);
    RUN_TEST(SDC_007_blocks_go_to_their_sectors);
    RUN_TEST(SDC_008_a_busy_card_is_told_and_waited_for);
    RUN_TEST(SDC_008_but_not_for_ever);
    RUN_TEST(SDC_009_what_failed_can_be_tried_again);
    RUN_TEST(SDC_009_a_sector_that_is_not_the_cards);
    RUN_TEST(SDC_009_a_card_that_is_pulled_out);
    RUN_TEST(SDC_010_after_programming_failed_nothing_works_until_a_start);
    RUN_TEST(SDC_010_a_command_that_was_not_taken_is_no_such_failure);
    RUN_TEST(SDC_010_a_status_that_came_damaged_may_have_told_it);
    return UNITY_END();
}
