/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/ulog.h: each message's bytes, by the format's specification. */
#include "keel/middleware/ulog.h"
#include "unity.h"

#include <string.h>

static keel_ulog_message_t message;

void setUp(void)
{
    memset(&message, 0xA5, sizeof message);
}

void tearDown(void)
{
}

/* Its bytes, and that it is one. */
static void is_made(const void *bytes, uint16_t size)
{
    TEST_ASSERT_EQUAL_UINT16(size, message.size);
    TEST_ASSERT_FALSE(message.overflowed);
    TEST_ASSERT_EQUAL_MEMORY(bytes, message.bytes, size);
}

static void is_none(void)
{
    TEST_ASSERT_EQUAL_UINT16(0u, message.size);
    TEST_ASSERT_TRUE(message.overflowed);
}

static void ULG_001_a_file_begins_with_the_magic_and_the_time(void)
{
    const uint8_t expected[16] = {0x55, 0x4C, 0x6F, 0x67, 0x01, 0x12, 0x35, 0x01,
                                  0x08, 0x07, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01};

    keel_ulog_begin(&message, 0x0102030405060708u);
    is_made(expected, 16u);
}

static void ULG_003_no_flag_is_set(void)
{
    uint8_t expected[43] = {40u, 0u, 'B'};

    keel_ulog_flags(&message);
    is_made(expected, 43u);
}

static void ULG_004_a_format_names_its_fields(void)
{
    const keel_ulog_format_t format = {.name = {"attitude"},
                                       .fields = 4u,
                                       .field = {{{"timestamp"}, KEEL_ULOG_UINT64, 1u},
                                                 {{"q"}, KEEL_ULOG_FLOAT, 4u},
                                                 {{"many"}, KEEL_ULOG_INT8, 10u},
                                                 {{"most"}, KEEL_ULOG_BOOL, 255u}}};
    const char expected[] =
        "\x46\0F"
        "attitude:uint64_t timestamp;float[4] q;int8_t[10] many;bool[255] most;";

    TEST_ASSERT_TRUE(keel_ulog_format(&message, &format));
    is_made(expected, 0x46u + 3u);
}

static void ULG_004_all_types_have_names(void)
{
    static const char *const names[KEEL_ULOG_TYPES] = {"int8_t",  "uint8_t",  "int16_t", "uint16_t",
                                                       "int32_t", "uint32_t", "int64_t", "uint64_t",
                                                       "float",   "double",   "bool",    "char"};
    keel_ulog_format_t format = {.name = {"t"}, .fields = 1u, .field = {{{"x"}, 0u, 1u}}};

    for (uint8_t type = 0u; type < KEEL_ULOG_TYPES; type++) {
        format.field[0].type = type;
        TEST_ASSERT_TRUE(keel_ulog_format(&message, &format));
        TEST_ASSERT_EQUAL_UINT16(3u + 2u + strlen(names[type]) + 3u, message.size);
        TEST_ASSERT_EQUAL_MEMORY(names[type], &message.bytes[5], strlen(names[type]));
    }
}

static void ULG_004_a_name_may_fill_its_characters(void)
{
    keel_ulog_format_t format = {.fields = 0u};

    memset(format.name.text, 'n', sizeof format.name.text);
    TEST_ASSERT_TRUE(keel_ulog_format(&message, &format));
    TEST_ASSERT_EQUAL_UINT16(3u + KEEL_ULOG_NAME_LENGTH + 1u, message.size);
    TEST_ASSERT_EQUAL_HEX8('n', message.bytes[3u + KEEL_ULOG_NAME_LENGTH - 1u]);
    TEST_ASSERT_EQUAL_HEX8(':', message.bytes[3u + KEEL_ULOG_NAME_LENGTH]);
}

static void ULG_004_strange_fields_are_refused(void)
{
    keel_ulog_format_t format = {.name = {"t"}, .fields = KEEL_ULOG_FIELDS + 1u};

    TEST_ASSERT_FALSE(keel_ulog_format(&message, &format));
    is_none();
    format.fields = 2u;
    format.field[0].type = KEEL_ULOG_TYPES;
    TEST_ASSERT_FALSE(keel_ulog_format(&message, &format));
    is_none();
    format.fields = 0u;
    TEST_ASSERT_TRUE(keel_ulog_format(&message, &format));
    is_made("\2\0Ft:", 5u);
}

/* 16 fields of 24 characters and a long type are more than 512 bytes. */
static void ULG_002_what_is_too_long_is_none(void)
{
    keel_ulog_format_t format = {.name = {"t"}, .fields = KEEL_ULOG_FIELDS};

    for (uint32_t i = 0u; i < KEEL_ULOG_FIELDS; i++) {
        memset(format.field[i].name.text, 'f', KEEL_ULOG_NAME_LENGTH);
        format.field[i].type = KEEL_ULOG_UINT64;
        format.field[i].count = 100u;
    }
    TEST_ASSERT_FALSE(keel_ulog_format(&message, &format));
    is_none();
}

/* Wherever the end comes: each name is a character longer than the one before. */
static void ULG_002_too_long_at_any_place(void)
{
    for (uint32_t more = 0u; more <= (2u * KEEL_ULOG_NAME_LENGTH); more++) {
        keel_ulog_format_t format = {.fields = KEEL_ULOG_FIELDS};
        const uint32_t first = (more < KEEL_ULOG_NAME_LENGTH) ? more : KEEL_ULOG_NAME_LENGTH;

        memset(format.name.text, 'n', first);
        for (uint32_t i = 0u; i < KEEL_ULOG_FIELDS; i++) {
            memset(format.field[i].name.text, 'f', (i > 0u) ? KEEL_ULOG_NAME_LENGTH : more - first);
            format.field[i].type = KEEL_ULOG_UINT64;
            format.field[i].count = 100u;
        }
        TEST_ASSERT_FALSE(keel_ulog_format(&message, &format));
        is_none();
    }
}

/* Names and texts without a character, and names of 24. */
static void ULG_005_the_shortest_and_the_longest(void)
{
    const keel_ulog_name_t none = {""};
    const uint8_t value[4] = {1u, 2u, 3u, 4u};
    static char text[UINT8_MAX];
    keel_ulog_name_t full;

    memset(full.text, 'n', sizeof full.text);
    TEST_ASSERT_TRUE(keel_ulog_information(&message, &none, text, 0u));
    is_made("\x09\0I\x08"
            "char[0] ",
            12u);
    TEST_ASSERT_TRUE(keel_ulog_information(&message, &full, text, UINT8_MAX));
    TEST_ASSERT_EQUAL_UINT16(4u + 10u + 24u + 255u, message.size); /* "char[255] " */
    TEST_ASSERT_TRUE(keel_ulog_parameter(&message, &none, KEEL_ULOG_FLOAT, value));
    is_made("\x0B\0P\x06"
            "float \1\2\3\4",
            14u);
    TEST_ASSERT_TRUE(keel_ulog_parameter(&message, &full, KEEL_ULOG_FLOAT, value));
    TEST_ASSERT_EQUAL_UINT16(4u + 6u + 24u + 4u, message.size);
    keel_ulog_subscription(&message, 1u, 2u, &none);
    is_made("\3\0A\1\2\0", 6u);
    keel_ulog_subscription(&message, 1u, 2u, &full);
    TEST_ASSERT_EQUAL_UINT16(3u + 3u + 24u, message.size);
}

static void ULG_005_information_has_a_key_with_its_length(void)
{
    const keel_ulog_name_t name = {"sys_name"};

    TEST_ASSERT_TRUE(keel_ulog_information(&message, &name, "Keel", 4u));
    is_made("\x15\0I\x10"
            "char[4] sys_nameKeel",
            0x18u);
}

static void ULG_006_parameters_are_numbers(void)
{
    const keel_ulog_name_t name = {"GAIN"};
    const uint8_t value[4] = {1u, 2u, 3u, 0x80u};

    TEST_ASSERT_TRUE(keel_ulog_parameter(&message, &name, KEEL_ULOG_FLOAT, value));
    is_made("\x0F\0P\x0A"
            "float GAIN\1\2\3\x80",
            0x12u);
    TEST_ASSERT_TRUE(keel_ulog_parameter(&message, &name, KEEL_ULOG_INT32, value));
    is_made("\x11\0P\x0C"
            "int32_t GAIN\1\2\3\x80",
            0x14u);
    TEST_ASSERT_FALSE(keel_ulog_parameter(&message, &name, KEEL_ULOG_UINT32, value));
    is_none();
}

static void ULG_007_a_subscription_numbers_a_topic(void)
{
    const keel_ulog_name_t name = {"imu"};

    keel_ulog_subscription(&message, 2u, 0x0103u, &name);
    is_made("\6\0A\2\3\1imu", 9u);
}

static void ULG_009_data_are_added(void)
{
    const uint8_t bytes[4] = {9u, 8u, 7u, 6u};

    keel_ulog_data(&message, 0x0102u);
    is_made("\2\0D\2\1", 5u);
    TEST_ASSERT_TRUE(keel_ulog_add(&message, bytes, 4u));
    is_made("\6\0D\2\1\x9\x8\x7\x6", 9u);
    TEST_ASSERT_TRUE(keel_ulog_add(&message, bytes, 0u));
    TEST_ASSERT_TRUE(keel_ulog_add(&message, bytes, 1u));
    is_made("\7\0D\2\1\x9\x8\x7\x6\x9", 10u);
}

static void ULG_009_up_to_the_last_byte(void)
{
    static const uint8_t bytes[KEEL_ULOG_MESSAGE_BYTES] = {0};

    keel_ulog_data(&message, 1u);
    TEST_ASSERT_TRUE(keel_ulog_add(&message, bytes, KEEL_ULOG_MESSAGE_BYTES - 5u));
    TEST_ASSERT_EQUAL_UINT16(KEEL_ULOG_MESSAGE_BYTES, message.size);
    TEST_ASSERT_EQUAL_HEX8(0xFDu, message.bytes[0]); /* 512 - 3 = 0x1FD */
    TEST_ASSERT_EQUAL_HEX8(0x01u, message.bytes[1]);
    TEST_ASSERT_FALSE(keel_ulog_add(&message, bytes, 1u));
    is_none();
    TEST_ASSERT_FALSE(keel_ulog_add(&message, bytes, 0u));
    is_none();
}

static void ULG_010_a_text_has_a_level_and_a_time(void)
{
    TEST_ASSERT_TRUE(keel_ulog_logging(&message, KEEL_ULOG_WARNING, 0x0807060504030201u, "hi", 2u));
    is_made("\x0B\0L4\1\2\3\4\5\6\7\x8hi", 14u);
    TEST_ASSERT_TRUE(keel_ulog_logging(&message, KEEL_ULOG_ERROR, 0u, "", 0u));
    is_made("\x09\0L3\0\0\0\0\0\0\0\0", 12u);
}

static void ULG_011_dropouts_are_in_ms(void)
{
    keel_ulog_dropout(&message, 1999u);
    is_made("\2\0O\1\0", 5u);
    keel_ulog_dropout(&message, 0u);
    is_made("\2\0O\1\0", 5u);
    keel_ulog_dropout(&message, 2000u);
    is_made("\2\0O\2\0", 5u);
    keel_ulog_dropout(&message, 65535999u);
    is_made("\2\0O\xFF\xFF", 5u);
    keel_ulog_dropout(&message, UINT64_MAX);
    is_made("\2\0O\xFF\xFF", 5u);
}

static void ULG_012_sizes_of_fields(void)
{
    const uint8_t sizes[KEEL_ULOG_TYPES] = {1u, 1u, 2u, 2u, 4u, 4u, 8u, 8u, 4u, 8u, 1u, 1u};
    keel_ulog_field_t field = {.count = 3u};

    for (uint8_t type = 0u; type < KEEL_ULOG_TYPES; type++) {
        field.type = type;
        TEST_ASSERT_EQUAL_UINT16(3u * sizes[type], keel_ulog_field_bytes(&field));
    }
    field.type = KEEL_ULOG_TYPES;
    TEST_ASSERT_EQUAL_UINT16(0u, keel_ulog_field_bytes(&field));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ULG_001_a_file_begins_with_the_magic_and_the_time);
    RUN_TEST(ULG_003_no_flag_is_set);
    RUN_TEST(ULG_004_a_format_names_its_fields);
    RUN_TEST(ULG_004_all_types_have_names);
    RUN_TEST(ULG_004_a_name_may_fill_its_characters);
    RUN_TEST(ULG_004_strange_fields_are_refused);
    RUN_TEST(ULG_002_what_is_too_long_is_none);
    RUN_TEST(ULG_002_too_long_at_any_place);
    RUN_TEST(ULG_005_the_shortest_and_the_longest);
    RUN_TEST(ULG_005_information_has_a_key_with_its_length);
    RUN_TEST(ULG_006_parameters_are_numbers);
    RUN_TEST(ULG_007_a_subscription_numbers_a_topic);
    RUN_TEST(ULG_009_data_are_added);
    RUN_TEST(ULG_009_up_to_the_last_byte);
    RUN_TEST(ULG_010_a_text_has_a_level_and_a_time);
    RUN_TEST(ULG_011_dropouts_are_in_ms);
    RUN_TEST(ULG_012_sizes_of_fields);
    return UNITY_END();
}
