/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/common/slots.h on a simulated medium whose power can be cut at any byte.
 * What is expected is what was saved. Checks are those of zlib.crc32. */
#include "common/slots.h"
#include "unity.h"

#include <string.h>

#include "../unit/any.h"

#define ROOM    40u
#define SIZE    (ROOM + 13u)
#define GAP     11u /* Between the slots, and around them: nothing may be written there. */
#define FIRST   GAP
#define SECOND  (FIRST + SIZE + GAP)
#define MEMORY  (SECOND + SIZE + GAP)
#define OUTSIDE 0xA7u
#define NEVER   UINT32_MAX
#define CUTS    100000u
#define SEED    20261123u

/* A memory; with erase it is a flash, whose bits are cleared alone. */
typedef struct simulation {
    uint8_t byte[MEMORY];
    uint32_t power;    /* Bytes that are written until it fails. */
    uint32_t reads;    /* Calls until one fails, and is told. */
    uint32_t writes;   /* Calls until one fails, and is told. */
    uint32_t lies;     /* Calls until one does nothing, and tells that it did. */
    uint32_t erasures; /* Calls until one fails, and is told. */
    uint32_t calls;
    bool is_flash;
    bool is_off;
} simulation_t;

static simulation_t memory;
static keel_slots_t slots;
static uint8_t image[ROOM];
static uint32_t length;

static bool ends_with(uint32_t *calls)
{
    const bool now = *calls == 0u;

    *calls -= (*calls == NEVER) ? 0u : 1u;
    return now;
}

static bool read_bytes(void *context, uint32_t address, uint8_t *bytes, uint32_t count)
{
    TEST_ASSERT_EQUAL_PTR(&memory, context);
    TEST_ASSERT_TRUE((0u < count) && (count <= 8u));
    memory.calls++;
    if (memory.is_off || ends_with(&memory.reads)) {
        memset(bytes, any() & 0xFF, count);
        return false;
    }
    memcpy(bytes, &memory.byte[address], count);
    return true;
}

/* The byte that is being written when the power fails is any. */
static void change(uint32_t at, uint8_t byte)
{
    if (memory.power > 0u) {
        memory.power -= (memory.power == NEVER) ? 0u : 1u;
        memory.byte[at] = byte;
    } else if (!memory.is_off) {
        memory.is_off = true;
        memory.byte[at] = (uint8_t)any();
    } else {
        /* It is off. */
    }
}

static bool write_bytes(void *context, uint32_t address, const uint8_t *bytes, uint32_t count)
{
    TEST_ASSERT_EQUAL_PTR(&memory, context);
    TEST_ASSERT_TRUE((0u < count) && (count <= 8u));
    memory.calls++;
    if (ends_with(&memory.writes)) {
        return false;
    }
    if (ends_with(&memory.lies)) {
        return true;
    }
    for (uint32_t i = 0u; i < count; i++) {
        const uint8_t before = memory.byte[address + i];

        change(address + i, memory.is_flash ? (uint8_t)(before & bytes[i]) : bytes[i]);
    }
    return !memory.is_off;
}

/* Bits rise at any rate each: when the power fails, some have. */
static bool erase(void *context, uint32_t address, uint32_t count)
{
    TEST_ASSERT_EQUAL_PTR(&memory, context);
    TEST_ASSERT_EQUAL_UINT32(SIZE, count);
    memory.calls++;
    if (ends_with(&memory.erasures)) {
        return false;
    }
    if (ends_with(&memory.lies)) {
        return true;
    }
    memory.is_off = memory.is_off || (memory.power == 0u);
    for (uint32_t i = 0u; i < count; i++) {
        memory.byte[address + i] |= memory.is_off ? (uint8_t)any() : 0xFFu;
    }
    memory.power -= ((memory.power == NEVER) || memory.is_off) ? 0u : 1u;
    return !memory.is_off;
}

static keel_slots_config_t usual(void)
{
    return (keel_slots_config_t){.medium = {.read = read_bytes,
                                            .write = write_bytes,
                                            .erase = memory.is_flash ? erase : NULL,
                                            .context = &memory},
                                 .address = {FIRST, SECOND},
                                 .room = ROOM};
}

/* As after a start: all that is known of the slots is what the medium holds. */
static keel_slots_result_t start_and_load(void)
{
    const keel_slots_config_t config = usual();

    memory.power = NEVER;
    memory.is_off = false;
    memset(&slots, 0x5A, sizeof slots);
    memset(image, 0xEE, sizeof image);
    length = 77u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(&slots, &config));
    return keel_slots_load(&slots, image, &length);
}

static void begin_empty(bool is_flash)
{
    memset(&memory, 0, sizeof memory);
    memset(memory.byte, OUTSIDE, sizeof memory.byte);
    memset(&memory.byte[FIRST], is_flash ? 0xFF : 0x00, SIZE);
    memset(&memory.byte[SECOND], is_flash ? 0xFF : 0x00, SIZE);
    memory.reads = NEVER;
    memory.writes = NEVER;
    memory.lies = NEVER;
    memory.erasures = NEVER;
    memory.is_flash = is_flash;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_NONE, start_and_load());
}

void setUp(void)
{
    any_from(SEED);
    begin_empty(false);
}

void tearDown(void)
{
    for (uint32_t i = 0u; i < GAP; i++) {
        TEST_ASSERT_EQUAL_HEX8(OUTSIDE, memory.byte[i]);
        TEST_ASSERT_EQUAL_HEX8(OUTSIDE, memory.byte[FIRST + SIZE + i]);
        TEST_ASSERT_EQUAL_HEX8(OUTSIDE, memory.byte[SECOND + SIZE + i]);
    }
}

static keel_slots_result_t save(const char *text)
{
    keel_slots_result_t result = KEEL_SLOTS_BUSY;

    TEST_ASSERT_EQUAL(KEEL_OK,
                      keel_slots_begin(&slots, (const uint8_t *)text, (uint32_t)strlen(text)));
    for (uint32_t i = 0u; (i < 100u) && (result == KEEL_SLOTS_BUSY) && !memory.is_off; i++) {
        result = keel_slots_step(&slots);
    }
    return result;
}

static bool holds(const char *text)
{
    return (length == strlen(text)) && (memcmp(image, text, length) == 0);
}

static void saved(const char *text)
{
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, save(text));
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
    TEST_ASSERT_TRUE_MESSAGE(holds(text), text);
}

static void SLT_001_refused_configurations(void)
{
    keel_slots_config_t config = usual();
    keel_slots_t before;

    memcpy(&before, &slots, sizeof before);
    config.medium.read = NULL;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_slots_init(&slots, &config));
    config = usual();
    config.medium.write = NULL;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_slots_init(&slots, &config));
    config = usual();
    config.room = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_slots_init(&slots, &config));
    config.room = UINT32_MAX - 12u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_slots_init(&slots, &config));
    config = usual();
    config.address[0] = UINT32_MAX - SIZE + 1u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_slots_init(&slots, &config));
    config = usual();
    config.address[1] = UINT32_MAX - SIZE + 1u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_slots_init(&slots, &config));
    config = usual();
    config.address[1] = FIRST + SIZE - 1u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_slots_init(&slots, &config));
    config.address[0] = FIRST + SIZE - 1u;
    config.address[1] = FIRST;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_slots_init(&slots, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &slots, sizeof before);
}

static void SLT_002_slots_may_touch_and_be_in_any_order(void)
{
    keel_slots_config_t config = usual();

    config.address[1] = FIRST + SIZE;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(&slots, &config));
    config.address[0] = FIRST + SIZE;
    config.address[1] = FIRST;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(&slots, &config));
    config.address[0] = UINT32_MAX - SIZE;
    memory.calls = 0u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(&slots, &config));
    TEST_ASSERT_EQUAL(KEEL_SLOTS_CLOSED, slots.stage);
    TEST_ASSERT_EQUAL_UINT32(0u, memory.calls);
}

static void SLT_003_what_was_saved_is_loaded(void)
{
    saved("first");
    saved("");
    saved("the third one has just as many bytes as ");
    saved("four");
    TEST_ASSERT_EQUAL_UINT32(4u, slots.sequence);
    TEST_ASSERT_EQUAL(KEEL_SLOT_WHOLE, slots.slot[slots.newest].state);
    TEST_ASSERT_EQUAL(KEEL_SLOT_MARKED, slots.slot[1u - slots.newest].state);
    TEST_ASSERT_EQUAL_UINT32(3u, slots.slot[1u - slots.newest].sequence);
}

static void SLT_003_a_damaged_set_gives_way_to_the_one_before(void)
{
    saved("old");
    saved("new");
    for (uint32_t i = 0u; i < (13u + 3u); i++) {
        const uint32_t at = ((slots.newest == 0u) ? FIRST : SECOND) + i;

        for (uint32_t bit = 0u; bit < 8u; bit++) {
            memory.byte[at] ^= (uint8_t)(1u << bit);
            TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
            TEST_ASSERT_TRUE(holds("old"));
            memory.byte[at] ^= (uint8_t)(1u << bit);
            TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
            TEST_ASSERT_TRUE(holds("new"));
        }
    }
}

static void SLT_004_none_is_whole(void)
{
    TEST_ASSERT_EQUAL_UINT32(77u, length);
    TEST_ASSERT_EQUAL(KEEL_SLOT_EMPTY, slots.slot[0].state);
    TEST_ASSERT_EQUAL(KEEL_SLOT_EMPTY, slots.slot[1].state);
    saved("only");
    memory.byte[((slots.newest == 0u) ? FIRST : SECOND) + 9u] ^= 1u;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_NONE, start_and_load());
    TEST_ASSERT_EQUAL(KEEL_SLOT_DAMAGED,
                      slots.slot[(slots.slot[0].state == KEEL_SLOT_EMPTY) ? 1 : 0].state);
    TEST_ASSERT_EQUAL_UINT32(77u, length);
    TEST_ASSERT_EQUAL_UINT32(0u, slots.sequence);
    saved("again");
}

static void SLT_005_a_slot_that_cannot_be_read_is_told(void)
{
    saved("old");
    saved("new");
    for (uint32_t i = 0u; i < 6u; i++) {
        /* Two of each slot's head, one of the newer one's bytes, one of its check. */
        memory.reads = i;
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
        if (slots.slot[slots.newest].sequence == 1u) {
            TEST_ASSERT_TRUE(holds("old"));
            TEST_ASSERT_EQUAL(KEEL_SLOT_UNREADABLE, slots.slot[1u - slots.newest].state);
        } else {
            TEST_ASSERT_TRUE(holds("new"));
        }
        memory.reads = NEVER;
    }
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
    TEST_ASSERT_TRUE(holds("new"));
}

static void SLT_005_nothing_is_saved_while_a_set_may_be_unread(void)
{
    saved("only");
    memory.byte[(slots.newest == 0u) ? SECOND : FIRST] = 0x4Bu;
    memory.reads = 3u;
    (void)start_and_load();
    memory.reads = 0u;
    memory.byte[(slots.newest == 0u) ? SECOND : FIRST] = 0x00u;
    begin_empty(false);
    memory.reads = 1u;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_READ, start_and_load());
    TEST_ASSERT_EQUAL(KEEL_SLOTS_CLOSED, slots.stage);
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_slots_begin(&slots, image, 1u));
    TEST_ASSERT_EQUAL(KEEL_SLOTS_NONE, keel_slots_load(&slots, image, &length));
    saved("now");
}

static void SLT_006_refused_saves(void)
{
    const keel_slots_config_t config = usual();
    keel_slots_t before;

    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(&slots, &config));
    memcpy(&before, &slots, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_slots_begin(&slots, image, 1u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &slots, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_SLOTS_NONE, keel_slots_load(&slots, image, &length));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_slots_begin(&slots, image, ROOM + 1u));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_begin(&slots, image, ROOM));
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_slots_begin(&slots, image, ROOM));
    TEST_ASSERT_EQUAL(KEEL_SLOTS_NONE, keel_slots_load(&slots, image, &length));
    slots.sequence = UINT32_MAX;
    TEST_ASSERT_EQUAL(KEEL_ERR_FULL, keel_slots_begin(&slots, image, 1u));
    slots.sequence = UINT32_MAX - 1u;
    saved("last");
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, slots.sequence);
    TEST_ASSERT_EQUAL(KEEL_ERR_FULL, keel_slots_begin(&slots, image, 1u));
}

static void SLT_007_without_a_save_a_step_does_nothing(void)
{
    const keel_slots_config_t config = usual();

    memory.calls = 0u;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, keel_slots_step(&slots));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(&slots, &config));
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, keel_slots_step(&slots));
    TEST_ASSERT_EQUAL_UINT32(0u, memory.calls);
}

static void SLT_008_saves_go_to_the_slots_in_turn(void)
{
    uint32_t last = slots.newest;

    for (uint32_t i = 0u; i < 5u; i++) {
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, save("turn"));
        TEST_ASSERT_EQUAL_UINT32(1u - last, slots.newest);
        TEST_ASSERT_EQUAL_UINT32(i + 1u, slots.sequence);
        last = slots.newest;
    }
}

/* Each call of a save fails once: it is told, and the old set is the newest still. */
static void errors_are_told(bool is_flash)
{
    uint32_t told[6] = {0u};

    begin_empty(is_flash);
    saved("before");
    for (uint32_t n = 0u; n < 24u; n++) {
        uint32_t *const fails[4] = {&memory.reads, &memory.writes, &memory.lies, &memory.erasures};
        keel_slots_result_t result;

        *fails[n % 4u] = n / 4u;
        result = save("after");
        *fails[n % 4u] = NEVER;
        TEST_ASSERT_TRUE(result <= KEEL_SLOTS_VERIFY);
        told[result]++;
        TEST_ASSERT_EQUAL(KEEL_SLOTS_READY, slots.stage);
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
        /* The mark was set, but could not be read back: the fifth reading. */
        TEST_ASSERT_TRUE(((result == KEEL_SLOTS_DONE) || (n == 16u)) ? holds("after")
                                                                     : holds("before"));
        saved("before");
    }
    TEST_ASSERT_EQUAL_UINT32(0u, told[KEEL_SLOTS_BUSY]);
    TEST_ASSERT_EQUAL_UINT32(0u, told[KEEL_SLOTS_NONE]);
    TEST_ASSERT_EQUAL_UINT32(5u, told[KEEL_SLOTS_READ]);
    TEST_ASSERT_EQUAL_UINT32(5u, told[KEEL_SLOTS_WRITE]);
    TEST_ASSERT_TRUE(told[KEEL_SLOTS_VERIFY] >= 3u);
}

static void SLT_009_errors_are_told_of_memory_without_erase(void)
{
    errors_are_told(false);
}

static void SLT_009_errors_are_told_of_flash(void)
{
    errors_are_told(true);
}

static void SLT_010_the_bytes_of_a_slot(void)
{
    /* zlib.crc32(bytes([1, 0, 0, 0, 3, 0, 0, 0]) + b"abc") is 0x5184EC61. */
    static const uint8_t expected[16] = {0x4B, 1,   0,   0,   0,    3,    0,    0,
                                         0,    'a', 'b', 'c', 0x61, 0xEC, 0x84, 0x51};
    const uint32_t at = (slots.newest == 0u) ? SECOND : FIRST;

    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, save("abc"));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, &memory.byte[at], 16u);
}

/* Cuts the power behind so many bytes; whether the save was done before. */
static bool cut(const char *old, const char *new, uint32_t power)
{
    bool done;

    memory.power = power;
    done = save(new) == KEEL_SLOTS_DONE;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
    TEST_ASSERT_TRUE(holds(new) || (!done && holds(old)));
    return done;
}

static void at_each_byte(bool is_flash)
{
    static const char *const text[4] = {"", "12345678", "a longer one, of some pieces",
                                        "the longest of all that there is room fo"};

    for (uint32_t n = 0u; n < 12u; n++) {
        const char *const old = text[n % 4u];
        const char *const new = text[(n + (n / 4u) + 1u) % 4u];
        uint32_t power = 0u;

        begin_empty(is_flash);
        do {
            saved("older, and also rather long");
            saved(old);
            power++;
        } while (!cut(old, new, power - 1u));
        /* The mark is cleared, or the slot erased; then all bytes are written, and the mark. */
        TEST_ASSERT_EQUAL_UINT32(1u + 8u + strlen(new) + 4u + 1u, power - 1u);
    }
}

static void SLT_010_cut_at_each_byte_of_memory_without_erase(void)
{
    at_each_byte(false);
}

static void SLT_010_cut_at_each_byte_of_flash(void)
{
    at_each_byte(true);
}

static void SLT_010_the_first_save_is_cut(void)
{
    for (uint32_t power = 0u; power < 19u; power++) {
        keel_slots_result_t found;

        begin_empty(false);
        memory.power = power;
        (void)save("first");
        found = start_and_load();
        TEST_ASSERT_TRUE((found == KEEL_SLOTS_NONE) || holds("first"));
        saved("next");
    }
}

static void any_text(char *text)
{
    const uint32_t count = any() % (ROOM + 1u);

    for (uint32_t i = 0u; i < count; i++) {
        text[i] = (char)(1 + (any() % 255u));
    }
    text[count] = '\0';
}

/* Any sets, one after the other, most of them cut at any byte; half of the cuts with errors. */
static void SLT_010_a_hundred_thousand_cuts(void)
{
    char text[2][ROOM + 1u] = {"", ""};
    uint32_t now = 0u;
    uint32_t done = 0u;
    uint32_t kept = 0u;

    for (uint32_t n = 0u; n < CUTS; n++) {
        char *const old = text[now];
        char *const new = text[1u - now];
        keel_slots_result_t result;

        if ((n % (CUTS / 4u)) == 0u) {
            begin_empty(n >= (CUTS / 2u));
            saved(old);
        }
        any_text(new);
        memory.power = any() % (16u + (uint32_t)strlen(new));
        memory.writes = one_in(4u) ? any() % 8u : NEVER;
        memory.lies = one_in(4u) ? any() % 8u : NEVER;
        memory.reads = one_in(4u) ? any() % 8u : NEVER;
        result = save(new);
        memory.writes = NEVER;
        memory.lies = NEVER;
        memory.reads = NEVER;
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, start_and_load());
        if (holds(new)) {
            now = 1u - now;
            done++;
        } else {
            TEST_ASSERT_TRUE(holds(old) && (result != KEEL_SLOTS_DONE));
            kept++;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(CUTS, done + kept);
    TEST_ASSERT_TRUE((done > (CUTS / 50u)) && (kept > (CUTS / 2u)));
}

static void SLT_011_a_step_is_short(void)
{
    memory.calls = 0u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_begin(&slots, image, ROOM));
    TEST_ASSERT_EQUAL_UINT32(0u, memory.calls);
    for (uint32_t i = 0u; i < 15u; i++) {
        memory.calls = 0u;
        TEST_ASSERT_EQUAL(KEEL_SLOTS_BUSY, keel_slots_step(&slots));
        TEST_ASSERT_TRUE(memory.calls <= 2u);
    }
    /* 52 bytes are 7 pieces, which are written and compared; one step clears, one marks. */
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, keel_slots_step(&slots));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SLT_001_refused_configurations);
    RUN_TEST(SLT_002_slots_may_touch_and_be_in_any_order);
    RUN_TEST(SLT_003_what_was_saved_is_loaded);
    RUN_TEST(SLT_003_a_damaged_set_gives_way_to_the_one_before);
    RUN_TEST(SLT_004_none_is_whole);
    RUN_TEST(SLT_005_a_slot_that_cannot_be_read_is_told);
    RUN_TEST(SLT_005_nothing_is_saved_while_a_set_may_be_unread);
    RUN_TEST(SLT_006_refused_saves);
    RUN_TEST(SLT_007_without_a_save_a_step_does_nothing);
    RUN_TEST(SLT_008_saves_go_to_the_slots_in_turn);
    RUN_TEST(SLT_009_errors_are_told_of_memory_without_erase);
    RUN_TEST(SLT_009_errors_are_told_of_flash);
    RUN_TEST(SLT_010_the_bytes_of_a_slot);
    RUN_TEST(SLT_010_cut_at_each_byte_of_memory_without_erase);
    RUN_TEST(SLT_010_cut_at_each_byte_of_flash);
    RUN_TEST(SLT_010_the_first_save_is_cut);
    RUN_TEST(SLT_010_a_hundred_thousand_cuts);
    RUN_TEST(SLT_011_a_step_is_short);
    return UNITY_END();
}
