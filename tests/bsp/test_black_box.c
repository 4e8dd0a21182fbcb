/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/fatfs on a simulated card, whose FAT16 is made and read here, by hand, as
 * Microsoft's specification has it. tests/flight/test_black_box.py cuts the power. */
#include "fatfs/black_box.h"
#include "unity.h"

#include <stdlib.h>
#include <string.h>

#include "../unit/any.h"
#include "simulated/card.c"

#define SECTORS    5000u
#define SECTOR     512u
#define FAT_AT     1u
#define FAT_LENGTH 20u
#define ROOT_AT    (FAT_AT + (2u * FAT_LENGTH))
#define ROOT_SIZE  32u /* Entries: two sectors. */
#define DATA_AT    (ROOT_AT + 2u)
#define CLUSTERS   (SECTORS - DATA_AT) /* Of one sector each. */
#define ALLOCATION (64u * SECTOR)
#define BURST      4u
#define STEP_US    10000u
#define SYNC_US    500000u
#define SEED       20261124u

static uint8_t bytes[SECTORS * SECTOR];
static uint8_t before[SECTORS * SECTOR];
static uint8_t log_bytes[ALLOCATION];
static simulated_card_t card;
static keel_disk_t disk;
static keel_black_box_t box;
static uint32_t now_us;

/* --- The card, as its specification has it. --- */

static void put_16(uint8_t *at, uint32_t value)
{
    at[0] = (uint8_t)(value & 0xFFu);
    at[1] = (uint8_t)((value >> 8) & 0xFFu);
}

static uint32_t get_16(const uint8_t *at)
{
    return at[0] + (256u * at[1]);
}

static uint32_t get_32(const uint8_t *at)
{
    return get_16(at) + (65536u * get_16(&at[2]));
}

static void set_fat(uint32_t cluster, uint32_t value)
{
    put_16(&bytes[(FAT_AT * SECTOR) + (2u * cluster)], value);
    put_16(&bytes[((FAT_AT + FAT_LENGTH) * SECTOR) + (2u * cluster)], value);
}

static uint32_t fat_of(uint32_t cluster)
{
    const uint32_t value = get_16(&bytes[(FAT_AT * SECTOR) + (2u * cluster)]);

    TEST_ASSERT_EQUAL_UINT32(value,
                             get_16(&bytes[((FAT_AT + FAT_LENGTH) * SECTOR) + (2u * cluster)]));
    return value;
}

static uint8_t *entry(uint32_t index)
{
    return &bytes[(ROOT_AT * SECTOR) + (32u * index)];
}

static void put_entry(uint32_t index, const char *name, uint8_t attributes, uint32_t cluster,
                      uint32_t size)
{
    memset(entry(index), 0, 32u);
    memcpy(entry(index), name, 11u);
    entry(index)[11] = attributes;
    put_16(&entry(index)[26], cluster);
    put_16(&entry(index)[28], size);
}

/* The place of a name in the directory, or ROOT_SIZE. */
static uint32_t find(const char *name)
{
    uint32_t index = 0u;

    while ((index < ROOT_SIZE) && (memcmp(entry(index), name, 11u) != 0)) {
        index++;
    }
    return index;
}

static uint32_t size_of(const char *name)
{
    TEST_ASSERT_TRUE_MESSAGE(find(name) < ROOT_SIZE, name);
    return get_32(&entry(find(name))[28]);
}

static uint32_t used_clusters(void)
{
    uint32_t used = 0u;

    for (uint32_t i = 2u; i < (CLUSTERS + 2u); i++) {
        used += (fat_of(i) != 0u) ? 1u : 0u;
    }
    return used;
}

static void format(void)
{
    static const uint8_t boot[] = {
        0xEB,         0x3C, 0x90,       'B', 'Y', ' ', 'H', 'A',       'N', 'D',
        ' ',          0,    2,          1,   1,   0,   2,   ROOT_SIZE, 0,   SECTORS & 0xFFu,
        SECTORS >> 8, 0xF8, FAT_LENGTH, 0};

    memset(bytes, 0, DATA_AT * SECTOR);
    memcpy(bytes, boot, sizeof boot);
    put_16(&bytes[510], 0xAA55u);
    set_fat(0u, 0xFFF8u);
    set_fat(1u, 0xFFFFu);
}

/* What was there before. */
static void fill(void)
{
    for (uint32_t i = DATA_AT * SECTOR; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)any();
    }
}

/* --- The box. --- */

static keel_black_box_config_t usual(void)
{
    return (keel_black_box_config_t){.disk = &disk, .allocation = ALLOCATION, .burst = BURST};
}

static void make_box(void)
{
    const keel_black_box_config_t config = usual();

    TEST_ASSERT_EQUAL(KEEL_OK, keel_black_box_init(&box, &config));
}

static void open_box(void)
{
    TEST_ASSERT_EQUAL(KEEL_CARD_OK, keel_black_box_open(&box, now_us));
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_OPEN, box.state);
}

void setUp(void)
{
    any_from(SEED);
    format();
    fill();
    for (uint32_t i = 0u; i < sizeof log_bytes; i++) {
        log_bytes[i] = (uint8_t)any();
    }
    simulated_card_init(&card, bytes, SECTORS);
    disk = simulated_card_disk(&card);
    now_us = 4294000000u; /* Wraps within the first second. */
    memset(&box, 0x5A, sizeof box);
    make_box();
}

void tearDown(void)
{
    (void)keel_black_box_close(&box);
}

static void hand_in(uint32_t count)
{
    TEST_ASSERT_TRUE(keel_black_box_write(&box, &log_bytes[box.taken], count));
}

/* Time passes, a step each 10 ms; what each may cost is looked at. */
static void pass(uint32_t time_us)
{
    for (uint32_t i = 0u; i < (time_us / STEP_US); i++) {
        const uint32_t reads = card.reads;
        const uint32_t writes = card.writes;
        const uint32_t waits = card.waits;

        now_us += STEP_US;
        (void)keel_black_box_step(&box, now_us);
        TEST_ASSERT_EQUAL_UINT32(reads, card.reads);
        TEST_ASSERT_TRUE((card.writes - writes) <= box.config.burst);
        TEST_ASSERT_EQUAL_UINT32(waits, card.waits);
    }
}

/* What the card's file holds. */
static void holds(const char *name, uint32_t size)
{
    const uint32_t first = get_16(&entry(find(name))[26]);

    TEST_ASSERT_EQUAL_UINT32(size, size_of(name));
    TEST_ASSERT_EQUAL_MEMORY(log_bytes, &bytes[(DATA_AT + first - 2u) * SECTOR], size);
    for (uint32_t i = 0u; (i + 1u) < ((size + SECTOR - 1u) / SECTOR); i++) {
        TEST_ASSERT_EQUAL_UINT32(first + i + 1u, fat_of(first + i));
    }
}

static void refuses_disk(bool is_null)
{
    keel_black_box_config_t config = usual();
    keel_black_box_t as_it_was;

    memcpy(&as_it_was, &box, sizeof box);
    config.disk = is_null ? NULL : config.disk;
    config.burst = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_black_box_init(&box, &config));
    TEST_ASSERT_EQUAL_MEMORY(&as_it_was, &box, sizeof box);
}

static void BBX_001_refused_disks(void)
{
    refuses_disk(true);
    disk.start = NULL;
    refuses_disk(false);
    disk = simulated_card_disk(&card);
    disk.is_busy = NULL;
    refuses_disk(false);
    disk = simulated_card_disk(&card);
    disk.read = NULL;
    refuses_disk(false);
    disk = simulated_card_disk(&card);
    disk.write = NULL;
    refuses_disk(false);
    disk = simulated_card_disk(&card);
    disk.sync = NULL;
    refuses_disk(false);
}

static keel_status_t init_with(uint32_t allocation, uint32_t burst)
{
    const keel_black_box_config_t config = {&disk, allocation, burst};

    return keel_black_box_init(&box, &config);
}

static void BBX_001_limits(void)
{
    keel_black_box_t as_it_was;

    memcpy(&as_it_was, &box, sizeof box);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, init_with(0u, 1u));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, init_with(SECTOR + 1u, 1u));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, init_with(SECTOR - 1u, 1u));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, init_with(SECTOR, 0u));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, init_with(SECTOR, 17u));
    TEST_ASSERT_EQUAL_MEMORY(&as_it_was, &box, sizeof box);
    TEST_ASSERT_EQUAL(KEEL_OK, init_with(SECTOR, 1u));
    TEST_ASSERT_EQUAL(KEEL_OK, init_with(0xFFFFFE00u, 16u));
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_CLOSED, box.state);
    TEST_ASSERT_EQUAL_UINT32(0u, card.reads + card.writes);
}

static void BBX_002_names_begin_with_1(void)
{
    open_box();
    TEST_ASSERT_EQUAL_UINT32(1u, box.file.number);
    TEST_ASSERT_EQUAL_UINT32(0u, size_of("LOG00001ULG"));
    TEST_ASSERT_EQUAL_UINT32(64u, used_clusters());
}

static void BBX_002_names_go_on_after_the_highest(void)
{
    set_fat(2u, 0xFFFFu);
    put_entry(0u, "LOG00012ULG", 0x20u, 2u, 100u);
    put_entry(1u, "LOG00003ULG", 0x20u, 0u, 0u);
    put_entry(2u, "LOG00099TXT", 0x20u, 0u, 0u);
    put_entry(3u, "LOG000A0ULG", 0x20u, 0u, 0u);
    put_entry(4u, "LOX00098ULG", 0x20u, 0u, 0u);
    put_entry(5u, "LOG0097 ULG", 0x20u, 0u, 0u);
    put_entry(6u, "LOG00096UL ", 0x20u, 0u, 0u);
    put_entry(7u, "LOG00095ULG", 0x08u, 0u, 0u); /* The card's own name. */
    put_entry(8u, "LOG00094ULG", 0x20u, 0u, 0u);
    entry(8u)[0] = 0xE5u; /* Removed. */
    memcpy(before, bytes, sizeof bytes);
    open_box();
    TEST_ASSERT_EQUAL_UINT32(13u, box.file.number);
    TEST_ASSERT_EQUAL_UINT32(0u, size_of("LOG00013ULG"));
    for (uint32_t i = 0u; i < 8u; i++) {
        TEST_ASSERT_EQUAL_MEMORY(&before[(ROOT_AT * SECTOR) + (32u * i)], entry(i), 11u);
        TEST_ASSERT_EQUAL_UINT32(get_32(&before[(ROOT_AT * SECTOR) + (32u * i) + 28u]),
                                 get_32(&entry(i)[28]));
    }
    TEST_ASSERT_EQUAL_MEMORY(&before[DATA_AT * SECTOR], &bytes[DATA_AT * SECTOR],
                             sizeof bytes - (DATA_AT * SECTOR));
}

static void BBX_002_a_folder_has_its_number(void)
{
    set_fat(2u, 0xFFFFu);
    memset(&bytes[DATA_AT * SECTOR], 0, SECTOR);
    put_entry(0u, "LOG00007ULG", 0x10u, 2u, 0u);
    open_box();
    TEST_ASSERT_EQUAL_UINT32(8u, box.file.number);
    TEST_ASSERT_EQUAL_UINT32(0x10u, entry(0u)[11]);
}

static void refuses(keel_card_result_t why)
{
    const keel_card_file_t file = box.file;

    TEST_ASSERT_EQUAL(why, keel_black_box_open(&box, now_us));
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_CLOSED, box.state);
    TEST_ASSERT_EQUAL_UINT32(file.number, box.file.number);
    TEST_ASSERT_EQUAL_UINT32(file.sector, box.file.sector);
    TEST_ASSERT_EQUAL_UINT32(0u, keel_black_box_room(&box));
    TEST_ASSERT_FALSE(keel_black_box_write(&box, log_bytes, 7u));
    TEST_ASSERT_EQUAL_UINT32(7u, box.count.refused);
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_CLOSED, keel_black_box_step(&box, now_us));
    TEST_ASSERT_EQUAL(KEEL_CARD_OK, keel_black_box_close(&box));
}

static void BBX_003_no_card(void)
{
    card.is_absent = true;
    refuses(KEEL_CARD_ABSENT);
    TEST_ASSERT_EQUAL_UINT32(0u, card.reads + card.writes);
    card.is_absent = false;
    open_box();
}

static void BBX_003_no_file_system(void)
{
    memset(bytes, 0, SECTOR);
    refuses(KEEL_CARD_NO_FILE_SYSTEM);
    format();
    memset(&bytes[510], 0, 2u);
    memset(&bytes[0], 'x', 3u);
    refuses(KEEL_CARD_NO_FILE_SYSTEM);
    TEST_ASSERT_EQUAL_UINT32(0u, card.writes);
}

static void BBX_003_the_last_number(void)
{
    put_entry(0u, "LOG99999ULG", 0x21u, 0u, 0u); /* Not to be written. */
    refuses(KEEL_CARD_NAMES);
    TEST_ASSERT_EQUAL_UINT32(0u, card.writes);
    put_entry(0u, "LOG99998ULG", 0x21u, 0u, 0u);
    open_box();
    TEST_ASSERT_EQUAL_UINT32(99999u, box.file.number);
}

/* Nothing is left of the attempt but the name of a file that was removed. */
static void BBX_003_no_room_in_one_piece(void)
{
    for (uint32_t i = 2u; i < (CLUSTERS + 2u); i++) {
        set_fat(i, ((i % 64u) == 0u) ? 0xFFFFu : 0u); /* 63 in a row are free. */
    }
    memcpy(before, bytes, sizeof bytes);
    refuses(KEEL_CARD_FULL);
    TEST_ASSERT_EQUAL_MEMORY(before, bytes, ROOT_AT * SECTOR);
    TEST_ASSERT_EQUAL_HEX8(0xE5u, entry(0u)[0]);
    entry(0u)[0] = 0u;
    TEST_ASSERT_EQUAL_MEMORY(&before[DATA_AT * SECTOR], &bytes[DATA_AT * SECTOR],
                             sizeof bytes - (DATA_AT * SECTOR));
    TEST_ASSERT_EQUAL(KEEL_OK, init_with(63u * SECTOR, BURST));
    open_box();
}

static void BBX_003_no_room_in_the_directory(void)
{
    for (uint32_t i = 0u; i < ROOT_SIZE; i++) {
        put_entry(i, "OTHER   TXT", 0x20u, 0u, 0u);
    }
    memcpy(before, bytes, sizeof bytes);
    refuses(KEEL_CARD_FULL);
    TEST_ASSERT_EQUAL_MEMORY(before, bytes, sizeof bytes);
}

/* The table has clusters that the card has not. */
static void BBX_003_a_file_system_larger_than_its_card(void)
{
    for (uint32_t i = 2u; i < 4100u; i++) {
        set_fat(i, 0xFFFFu);
    }
    card.sectors = 4100u;
    refuses(KEEL_CARD_DAMAGED);
}

static uint32_t writes_of[100];
static uint32_t noted;

static void note_write(uint32_t sector, const uint8_t *from)
{
    (void)from;
    TEST_ASSERT_TRUE(noted < 100u);
    writes_of[noted++] = sector;
}

static bool is_second_table(uint32_t sector)
{
    return (sector >= (FAT_AT + FAT_LENGTH)) && (sector < ROOT_AT);
}

/* Each read or write of an opening fails once: it is told, and the next opening goes well. FatFs
 * does without the table's second copy, which it never reads. */
static void BBX_003_errors_of_opening(void)
{
    uint32_t reads;
    uint32_t writes;

    card.watch = note_write;
    open_box();
    reads = card.reads;
    writes = card.writes;
    for (uint32_t n = 1u; n <= (reads + writes); n++) {
        format();
        simulated_card_init(&card, bytes, SECTORS);
        card.fails_read = (n <= reads) ? n : SIMULATED_CARD_NEVER;
        card.fails_write_from = (n > reads) ? (n - reads) : SIMULATED_CARD_NEVER;
        card.fails_write_for = 1u;
        make_box();
        if ((n > reads) && is_second_table(writes_of[n - reads - 1u])) {
            open_box();
        } else {
            refuses(KEEL_CARD_IO);
            open_box();
        }
    }
}

static void BBX_004_what_a_cut_left_is_given_back(void)
{
    open_box();
    hand_in(1000u);
    pass(2u * SYNC_US);
    keel_card_file_leave(); /* The power. */
    TEST_ASSERT_EQUAL_UINT32(64u, used_clusters());
    make_box();
    open_box();
    TEST_ASSERT_EQUAL_UINT32(2u, box.file.number);
    holds("LOG00001ULG", 1000u);
    TEST_ASSERT_EQUAL_UINT32(64u + 2u, used_clusters());
    keel_card_file_leave(); /* Again, before a byte was kept: the name is used again. */
    make_box();
    open_box();
    TEST_ASSERT_EQUAL_UINT32(2u, box.file.number);
    holds("LOG00001ULG", 1000u);
    TEST_ASSERT_EQUAL_UINT32(64u + 2u, used_clusters());
}

/* A file that is longer than what we allocate is not ours to cut. */
static void BBX_004_longer_files_stay(void)
{
    for (uint32_t i = 0u; i < 100u; i++) {
        set_fat(2u + i, (i == 99u) ? 0xFFFFu : (3u + i));
    }
    put_entry(0u, "LOG00001ULG", 0x20u, 2u, ALLOCATION + 1u);
    open_box();
    TEST_ASSERT_EQUAL_UINT32(64u + 100u, used_clusters());
    TEST_ASSERT_EQUAL(KEEL_CARD_OK, keel_black_box_close(&box));
    put_entry(0u, "LOG00001ULG", 0x20u, 2u, ALLOCATION);
    open_box();
    TEST_ASSERT_EQUAL_UINT32(64u + 64u, used_clusters());
}

static void BBX_004_a_damaged_log_stops_no_other(void)
{
    set_fat(2u, 4u); /* Which is free. */
    put_entry(0u, "LOG00001ULG", 0x20u, 2u, 5000u);
    open_box();
    TEST_ASSERT_EQUAL_UINT32(2u, box.file.number);
}

static void BBX_005_room(void)
{
    open_box();
    TEST_ASSERT_EQUAL_UINT32(8192u, keel_black_box_room(&box));
    hand_in(0u);
    hand_in(8000u);
    TEST_ASSERT_EQUAL_UINT32(192u, keel_black_box_room(&box));
    TEST_ASSERT_FALSE(keel_black_box_write(&box, log_bytes, 193u));
    TEST_ASSERT_EQUAL_UINT32(193u, box.count.refused);
    TEST_ASSERT_EQUAL_UINT32(192u, keel_black_box_room(&box));
    hand_in(192u);
    TEST_ASSERT_EQUAL_UINT32(0u, keel_black_box_room(&box));
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(BURST * SECTOR, keel_black_box_room(&box));
}

static void BBX_005_a_full_file(void)
{
    open_box();
    while (box.taken < ALLOCATION) {
        hand_in((keel_black_box_room(&box) < 1500u) ? keel_black_box_room(&box) : 1500u);
        pass(STEP_US);
    }
    TEST_ASSERT_EQUAL_UINT32(0u, keel_black_box_room(&box));
    TEST_ASSERT_FALSE(keel_black_box_write(&box, log_bytes, 1u));
    pass(2u * SYNC_US);
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_OPEN, box.state);
    holds("LOG00001ULG", ALLOCATION);
    TEST_ASSERT_EQUAL(KEEL_CARD_OK, keel_black_box_close(&box));
    holds("LOG00001ULG", ALLOCATION);
    TEST_ASSERT_EQUAL_UINT32(64u, used_clusters());
}

static void BBX_006_a_step_writes_a_burst(void)
{
    open_box();
    hand_in((BURST * SECTOR) + SECTOR + 1u);
    card.writes = 0u;
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(BURST, card.writes);
    TEST_ASSERT_EQUAL_UINT32(BURST * SECTOR, box.stored);
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(BURST + 1u, card.writes);
    pass(10u * STEP_US);
    TEST_ASSERT_EQUAL_UINT32(BURST + 1u, card.writes); /* The last byte can wait. */
    TEST_ASSERT_EQUAL_UINT32(0u, size_of("LOG00001ULG"));
}

/* The buffer ends in the middle of what could be written at once. */
static void BBX_006_bursts_end_with_the_buffer(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, init_with(ALLOCATION, 5u));
    open_box();
    hand_in(8192u);
    pass(3u * STEP_US);
    TEST_ASSERT_EQUAL_UINT32(15u * SECTOR, box.stored);
    hand_in(4u * SECTOR);
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(16u * SECTOR, box.stored);
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(20u * SECTOR, box.stored);
    pass(2u * SYNC_US);
    holds("LOG00001ULG", 20u * SECTOR);
}

static void BBX_006_a_busy_card_is_left_alone(void)
{
    open_box();
    card.writes = 0u;
    card.busy_looks = 3u;
    hand_in(2u * BURST * SECTOR);
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(BURST, card.writes);
    pass(3u * STEP_US);
    TEST_ASSERT_EQUAL_UINT32(BURST, card.writes);
    TEST_ASSERT_EQUAL_UINT32(3u, box.count.busy);
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(2u * BURST, card.writes);
}

/* Twice a second all that was taken is kept, in a write of the last sector and one of the size. */
static void BBX_007_sizes_are_told(void)
{
    open_box();
    hand_in(700u);
    pass(SYNC_US - STEP_US);
    TEST_ASSERT_EQUAL_UINT32(0u, box.due);
    card.writes = 0u;
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(700u, box.due);
    TEST_ASSERT_EQUAL_UINT32(700u, box.stored);
    TEST_ASSERT_EQUAL_UINT32(0u, size_of("LOG00001ULG"));
    hand_in(5u); /* Comes too late for this time. */
    pass(STEP_US);
    TEST_ASSERT_EQUAL_UINT32(700u, box.kept);
    holds("LOG00001ULG", 700u);
    TEST_ASSERT_EQUAL_UINT32(2u, card.writes);
    TEST_ASSERT_EQUAL_UINT32(1u, box.count.sizes);
    pass(SYNC_US - STEP_US);
    TEST_ASSERT_EQUAL_UINT32(705u, box.due);
    pass(STEP_US);
    holds("LOG00001ULG", 705u);
    pass(4u * SYNC_US);
    TEST_ASSERT_EQUAL_UINT32(4u, card.writes); /* There is nothing new. */
    TEST_ASSERT_EQUAL_UINT32(5u, box.count.sectors);
}

/* What comes while a size is due neither delays it nor gets into it. */
static void BBX_007_sizes_end_with_a_write(void)
{
    open_box();
    hand_in(100u);
    pass(SYNC_US - STEP_US);
    for (uint32_t i = 0u; i < 60u; i++) {
        const uint32_t due = box.due;

        hand_in(300u);
        pass(STEP_US);
        TEST_ASSERT_TRUE((box.due == due) || (box.due == box.taken));
        TEST_ASSERT_EQUAL_UINT32(100u, (box.kept % 300u) + ((box.kept == 0u) ? 100u : 0u));
    }
    TEST_ASSERT_TRUE(box.kept >= 400u);
    holds("LOG00001ULG", box.kept);
}

static void BBX_008_a_write_is_tried_again(void)
{
    open_box();
    hand_in(2000u);
    card.writes = 0u;
    card.fails_write_from = 2u; /* In the middle of a burst. */
    card.fails_write_for = 3u;
    pass(2u * SYNC_US);
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_OPEN, box.state);
    TEST_ASSERT_TRUE(box.count.errors >= 1u);
    holds("LOG00001ULG", 2000u);
}

static void BBX_008_a_size_is_tried_again(void)
{
    open_box();
    hand_in(SECTOR);
    pass(SYNC_US - STEP_US);
    card.writes = 0u;
    card.fails_write_from = 1u;
    card.fails_write_for = 3u;
    pass(4u * STEP_US);
    TEST_ASSERT_EQUAL_UINT32(3u, box.count.errors);
    holds("LOG00001ULG", SECTOR);
}

static void BBX_009_a_card_that_fails_is_given_up(void)
{
    open_box();
    hand_in(600u);
    pass(2u * SYNC_US);
    hand_in(4000u);
    card.is_absent = true;
    card.writes = 0u;
    pass(3u * STEP_US);
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_OPEN, box.state);
    pass(STEP_US);
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_FAILED, box.state);
    TEST_ASSERT_EQUAL_UINT32(4u, box.count.errors);
    TEST_ASSERT_EQUAL_UINT32(0u, keel_black_box_room(&box));
    pass(2u * SYNC_US);
    TEST_ASSERT_EQUAL_UINT32(4u, card.writes);
    holds("LOG00001ULG", 600u);
    TEST_ASSERT_EQUAL(KEEL_CARD_IO, keel_black_box_close(&box));
    TEST_ASSERT_EQUAL_UINT32(4u, card.writes);
    card.is_absent = false;
    open_box();
    TEST_ASSERT_EQUAL_UINT32(2u, box.file.number);
    holds("LOG00001ULG", 600u);
}

static void BBX_010_closing_keeps_all_and_no_more(void)
{
    open_box();
    hand_in(1300u);
    card.busy_looks = 100u;
    TEST_ASSERT_EQUAL(KEEL_CARD_OK, keel_black_box_close(&box));
    TEST_ASSERT_EQUAL_UINT32(1300u, box.kept);
    holds("LOG00001ULG", 1300u);
    TEST_ASSERT_EQUAL_UINT32(3u, used_clusters());
    TEST_ASSERT_EQUAL_UINT32(0u, card.busy_left);
    TEST_ASSERT_EQUAL_UINT32(1u, card.syncs);
    TEST_ASSERT_EQUAL(KEEL_CARD_OK, keel_black_box_close(&box));
}

static void BBX_010_an_empty_file_is_removed(void)
{
    open_box();
    TEST_ASSERT_EQUAL(KEEL_CARD_OK, keel_black_box_close(&box));
    TEST_ASSERT_EQUAL_UINT32(ROOT_SIZE, find("LOG00001ULG"));
    TEST_ASSERT_EQUAL_UINT32(0u, used_clusters());
}

static void BBX_010_errors_of_closing(void)
{
    open_box();
    hand_in(1000u);
    pass(2u * SYNC_US);
    hand_in(300u);
    card.is_absent = true;
    TEST_ASSERT_EQUAL(KEEL_CARD_IO, keel_black_box_close(&box));
    TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_CLOSED, box.state);
    holds("LOG00001ULG", 1000u);
    card.is_absent = false;
    for (uint32_t n = 1u; n < 8u; n++) {
        make_box();
        open_box();
        hand_in(1300u);
        card.writes = 0u;
        card.fails_write_from = n;
        card.fails_write_for = 4u;
        TEST_ASSERT_EQUAL((n < 8u) ? KEEL_CARD_IO : KEEL_CARD_OK, keel_black_box_close(&box));
        card.fails_write_from = SIMULATED_CARD_NEVER;
    }
}

/* Whatever a card says: no stray access (the sanitizers look), no endless loop, and the box is open
 * or closed. */
static void BBX_011_cards_that_lie(void)
{
    static const uint32_t places[] = {0u, FAT_AT, ROOT_AT, ROOT_AT + 1u, DATA_AT};
    uint32_t opened = 0u;

    for (uint32_t round = 0u; round < 6000u; round++) {
        const uint32_t changes = 1u + (any() % 6u);

        format();
        memset(&bytes[DATA_AT * SECTOR], 0, 4u * SECTOR);
        set_fat(2u, 3u);
        set_fat(3u, 0xFFFFu);
        put_entry(0u, "LOG00001ULG", 0x20u, 2u, 900u);
        put_entry(1u, "FOLDER     ", 0x10u, 4u, 0u);
        for (uint32_t i = 0u; i < changes; i++) {
            const uint32_t at = places[any() % 5u] * SECTOR;

            /* Mostly where something is. */
            bytes[at + (any() % (one_in(2u) ? 64u : SECTOR))] = one_in(3u) ? 0xFFu : (uint8_t)any();
        }
        simulated_card_init(&card, bytes, SECTORS);
        make_box();
        if (keel_black_box_open(&box, now_us) == KEEL_CARD_OK) {
            opened++;
            hand_in(3000u);
            pass(SYNC_US + (5u * STEP_US));
        }
        (void)keel_black_box_close(&box);
        TEST_ASSERT_EQUAL(KEEL_BLACK_BOX_CLOSED, box.state);
        TEST_ASSERT_EQUAL_UINT32(0u, card.strays);
        TEST_ASSERT_TRUE((card.reads + card.writes) < 20000u);
    }
    TEST_ASSERT_TRUE((opened > 1000u) && (opened < 6000u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(BBX_001_refused_disks);
    RUN_TEST(BBX_001_limits);
    RUN_TEST(BBX_002_names_begin_with_1);
    RUN_TEST(BBX_002_names_go_on_after_the_highest);
    RUN_TEST(BBX_002_a_folder_has_its_number);
    RUN_TEST(BBX_003_no_card);
    RUN_TEST(BBX_003_no_file_system);
    RUN_TEST(BBX_003_the_last_number);
    RUN_TEST(BBX_003_no_room_in_one_piece);
    RUN_TEST(BBX_003_no_room_in_the_directory);
    RUN_TEST(BBX_003_a_file_system_larger_than_its_card);
    RUN_TEST(BBX_003_errors_of_opening);
    RUN_TEST(BBX_004_what_a_cut_left_is_given_back);
    RUN_TEST(BBX_004_longer_files_stay);
    RUN_TEST(BBX_004_a_damaged_log_stops_no_other);
    RUN_TEST(BBX_005_room);
    RUN_TEST(BBX_005_a_full_file);
    RUN_TEST(BBX_006_a_step_writes_a_burst);
    RUN_TEST(BBX_006_bursts_end_with_the_buffer);
    RUN_TEST(BBX_006_a_busy_card_is_left_alone);
    RUN_TEST(BBX_007_sizes_are_told);
    RUN_TEST(BBX_007_sizes_end_with_a_write);
    RUN_TEST(BBX_008_a_write_is_tried_again);
    RUN_TEST(BBX_008_a_size_is_tried_again);
    RUN_TEST(BBX_009_a_card_that_fails_is_given_up);
    RUN_TEST(BBX_010_closing_keeps_all_and_no_more);
    RUN_TEST(BBX_010_an_empty_file_is_removed);
    RUN_TEST(BBX_010_errors_of_closing);
    RUN_TEST(BBX_011_cards_that_lie);
    return UNITY_END();
}
