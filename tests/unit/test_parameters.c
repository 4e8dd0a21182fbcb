/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of examples/copter/parameters.h. */
#include "unity.h"

#include <math.h>
#include <string.h>

/* No part of the kernel that this test is linked with. */
#include "../../examples/copter/parameters.c"

#define COUNT 4u
#define ROOM  (COUNT * 21u)

#define REAL(x)  {.type = KEEL_PARAMETER_FLOAT, .real = (x)}
#define WHOLE(x) {.type = KEEL_PARAMETER_INT32, .whole = (x)}
#define FLAG(x)  {.type = KEEL_PARAMETER_BOOL, .whole = (x)}

/* HIGH must be above LOW: what no range can say. */
enum {
    LOW,
    HIGH,
    CELLS,
    SIXTEEN
};

static const keel_parameter_t table[COUNT] = {
    {.name = "LOW", .initial = REAL(1.5f), .lowest = REAL(-8.0f), .highest = REAL(8.0f)},
    {.name = "HIGH", .initial = REAL(2.5f), .lowest = REAL(-8.0f), .highest = REAL(8.0f)},
    {.name = "CELLS", .initial = WHOLE(4), .lowest = WHOLE(-3), .highest = WHOLE(2000000000)},
    {.name = "SIXTEEN_LETTERS_", .initial = FLAG(1), .lowest = FLAG(0), .highest = FLAG(1)}};

static keel_parameter_entry_t entry[COUNT];
static keel_parameters_t all;
static keel_parameters_config_t config;
static uint32_t checks;

static keel_status_t check(void *context, const keel_parameter_entry_t *given)
{
    TEST_ASSERT_EQUAL_PTR(&checks, context);
    TEST_ASSERT_EQUAL_PTR(entry, given);
    checks++;
    return (given[LOW].value.real < given[HIGH].value.real) ? KEEL_OK : KEEL_ERR_LIMITS;
}

void setUp(void)
{
    memset(&all, 0, sizeof all);
    memset(entry, 0x5A, sizeof entry);
    config = (keel_parameters_config_t){
        .table = table, .entry = entry, .count = COUNT, .check = check, .context = &checks};
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_init(&all, &config));
    checks = 0u;
}

void tearDown(void)
{
}

static keel_parameter_value_t real(float number)
{
    const keel_parameter_value_t value = REAL(number);

    return value;
}

static keel_parameter_value_t whole(int32_t number)
{
    const keel_parameter_value_t value = WHOLE(number);

    return value;
}

static keel_parameter_value_t flag(int32_t number)
{
    const keel_parameter_value_t value = FLAG(number);

    return value;
}

static float real_of(uint16_t index)
{
    return keel_parameters_get(&all, index).real;
}

static void PAR_001_refused_tables(void)
{
    keel_parameters_t before;
    keel_parameter_t wrong[1] = {table[CELLS]};
    keel_parameters_config_t given = config;

    memcpy(&before, &all, sizeof before);
    given.table = NULL;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_parameters_init(&all, &given));
    given = config;
    given.entry = NULL;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_parameters_init(&all, &given));
    given = config;
    given.check = NULL;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_parameters_init(&all, &given));
    given = config;
    given.count = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_parameters_init(&all, &given));
    given = config;
    given.table = wrong;
    given.count = 1u;
    wrong[0].initial.whole = -4;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_init(&all, &given));
    wrong[0].initial = real(1.0f);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_init(&all, &given));
    wrong[0] = table[CELLS];
    wrong[0].lowest = flag(0);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_init(&all, &given));
    wrong[0] = table[CELLS];
    wrong[0].highest = real(5.0f);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_init(&all, &given));
    wrong[0] = table[CELLS];
    memset(wrong[0].name, 'X', sizeof wrong[0].name);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_init(&all, &given));
    TEST_ASSERT_EQUAL_MEMORY(&before, &all, sizeof before);
}

static void PAR_001_defaults_that_no_unit_takes(void)
{
    keel_parameter_t crossed[COUNT];
    keel_parameters_t before;
    keel_parameters_config_t given = config;

    memcpy(crossed, table, sizeof crossed);
    crossed[HIGH].initial.real = 1.5f;
    given.table = crossed;
    memcpy(&before, &all, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_init(&all, &given));
    TEST_ASSERT_EQUAL_MEMORY(&before, &all, sizeof before);
}

static void PAR_002_the_table_can_be_read(void)
{
    TEST_ASSERT_EQUAL_UINT16(COUNT, keel_parameters_count(&all));
    TEST_ASSERT_EQUAL_STRING("CELLS", keel_parameters_name(&all, CELLS));
    TEST_ASSERT_NULL(keel_parameters_name(&all, COUNT));
    TEST_ASSERT_EQUAL(KEEL_PARAMETER_INT32, keel_parameters_get(&all, CELLS).type);
    TEST_ASSERT_EQUAL_INT32(4, keel_parameters_get(&all, CELLS).whole);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, real_of(LOW));
    TEST_ASSERT_EQUAL(KEEL_PARAMETER_BOOL, keel_parameters_get(&all, SIXTEEN).type);
}

static void PAR_003_names_end_with_a_zero_or_their_sixteenth_letter(void)
{
    static const char sixteen[17] = "SIXTEEN_LETTERS_";
    char mavlink[17] = "LOW\0rest, unsaid";

    TEST_ASSERT_EQUAL_UINT16(LOW, keel_parameters_find(&all, "LOW"));
    TEST_ASSERT_EQUAL_UINT16(LOW, keel_parameters_find(&all, mavlink));
    TEST_ASSERT_EQUAL_UINT16(HIGH, keel_parameters_find(&all, "HIGH"));
    TEST_ASSERT_EQUAL_UINT16(SIXTEEN, keel_parameters_find(&all, sixteen));
    TEST_ASSERT_EQUAL_UINT16(SIXTEEN, keel_parameters_find(&all, "SIXTEEN_LETTERS_AND_MORE"));
    TEST_ASSERT_EQUAL_UINT16(COUNT, keel_parameters_find(&all, "LO"));
    TEST_ASSERT_EQUAL_UINT16(COUNT, keel_parameters_find(&all, "LOWER"));
    TEST_ASSERT_EQUAL_UINT16(COUNT, keel_parameters_find(&all, "SIXTEEN_LETTERS"));
    TEST_ASSERT_EQUAL_UINT16(COUNT, keel_parameters_find(&all, ""));
}

static void PAR_004_what_is_set_is_kept(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_set(&all, LOW, real(-8.0f)));
    TEST_ASSERT_EQUAL_FLOAT(-8.0f, real_of(LOW));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_set_by_name(&all, "CELLS", whole(2000000000)));
    TEST_ASSERT_EQUAL_INT32(2000000000, keel_parameters_get(&all, CELLS).whole);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_set_by_name(&all, "SIXTEEN_LETTERS_", flag(0)));
    TEST_ASSERT_EQUAL_INT32(0, keel_parameters_get(&all, SIXTEEN).whole);
    TEST_ASSERT_EQUAL_UINT32(3u, checks);
}

static void PAR_004_the_number_that_does_not_count_is_0(void)
{
    keel_parameter_value_t value = real(1.0f);

    value.whole = 77;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_set(&all, LOW, value));
    TEST_ASSERT_EQUAL_INT32(0, keel_parameters_get(&all, LOW).whole);
    value = whole(5);
    value.real = NAN;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_set(&all, CELLS, value));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, real_of(CELLS));
}

static void PAR_005_what_is_refused_changes_nothing(void)
{
    keel_parameter_entry_t before[COUNT];

    memcpy(before, entry, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_parameters_set(&all, COUNT, real(1.0f)));
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_parameters_set_by_name(&all, "LOWER", real(1.0f)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, LOW, real(-8.01f)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, HIGH, real(8.01f)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, HIGH, real(NAN)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, HIGH, real(INFINITY)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, LOW, whole(0)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, CELLS, whole(-4)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, CELLS, whole(2000000001)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, CELLS, flag(1)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, SIXTEEN, flag(2)));
    TEST_ASSERT_EQUAL_UINT32(0u, checks);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_set(&all, LOW, real(2.5f)));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_parameters_set(&all, HIGH, real(1.5f)));
    TEST_ASSERT_EQUAL_UINT32(2u, checks);
    TEST_ASSERT_EQUAL_MEMORY(before, entry, sizeof before);
}

/* -2.5f is 0xC0200000; 300 is 0x12C. */
static const uint8_t stored[3u * 21u] = {
    'L', 'O',  'W',  0,    0,    0,   0,    0,    0,    0,    0,   0,   0,   0,   0,   0,
    0,   0x00, 0x00, 0x20, 0xC0, 'C', 'E',  'L',  'L',  'S',  0,   0,   0,   0,   0,   0,
    0,   0,    0,    0,    0,    1,   0x2C, 0x01, 0x00, 0x00, 'S', 'I', 'X', 'T', 'E', 'E',
    'N', '_',  'L',  'E',  'T',  'T', 'E',  'R',  'S',  '_',  2,   0,   0,   0,   0};

static void PAR_006_stored_is_what_is_no_default(void)
{
    uint8_t image[ROOM];
    uint32_t length = 99u;

    memset(image, 0xEE, sizeof image);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_pack(&all, image, ROOM, &length));
    TEST_ASSERT_EQUAL_UINT32(0u, length);
    (void)keel_parameters_set(&all, LOW, real(-2.5f));
    (void)keel_parameters_set(&all, HIGH, real(2.5f));
    (void)keel_parameters_set(&all, CELLS, whole(300));
    (void)keel_parameters_set(&all, SIXTEEN, flag(0));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_pack(&all, image, ROOM, &length));
    TEST_ASSERT_EQUAL_UINT32(63u, length);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(stored, image, 63u);
    TEST_ASSERT_EQUAL_HEX8(0xEE, image[63]);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_pack(&all, image, 63u, &length));
    length = 99u;
    TEST_ASSERT_EQUAL(KEEL_ERR_FULL, keel_parameters_pack(&all, image, 62u, &length));
    TEST_ASSERT_EQUAL_UINT32(99u, length);
}

static keel_parameters_loaded_t loaded(const uint8_t *image, uint32_t length)
{
    return keel_parameters_load(&all, image, length);
}

static void PAR_007_what_was_stored_is_loaded(void)
{
    keel_parameters_loaded_t found;

    (void)keel_parameters_set(&all, HIGH, real(7.0f));
    found = loaded(stored, sizeof stored);
    TEST_ASSERT_EQUAL_UINT32(3u, found.taken);
    TEST_ASSERT_EQUAL_UINT32(0u, found.refused);
    TEST_ASSERT_EQUAL_UINT32(0u, found.unknown);
    TEST_ASSERT_EQUAL_FLOAT(-2.5f, real_of(LOW));
    TEST_ASSERT_EQUAL_FLOAT(2.5f, real_of(HIGH)); /* Its default: it was not stored. */
    TEST_ASSERT_EQUAL_INT32(300, keel_parameters_get(&all, CELLS).whole);
    TEST_ASSERT_EQUAL_INT32(0, keel_parameters_get(&all, SIXTEEN).whole);
}

static void PAR_008_a_set_of_another_firmware(void)
{
    uint8_t foreign[4u * 21u + 20u];
    keel_parameters_loaded_t found;

    memset(foreign, 0, sizeof foreign);
    memcpy(foreign, stored, sizeof stored);
    memcpy(&foreign[63], "GONE", 4u);
    foreign[20] = 0x41u;     /* LOW is 10: out of its range here. */
    foreign[21u + 16u] = 0u; /* CELLS was a float. */
    found = loaded(foreign, sizeof foreign);
    TEST_ASSERT_EQUAL_UINT32(1u, found.taken);
    TEST_ASSERT_EQUAL_UINT32(2u, found.refused);
    TEST_ASSERT_EQUAL_UINT32(1u, found.unknown); /* 20 bytes are no record. */
    TEST_ASSERT_EQUAL_FLOAT(1.5f, real_of(LOW));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, entry[LOW].refused);
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, entry[CELLS].refused);
    TEST_ASSERT_EQUAL(KEEL_OK, entry[HIGH].refused);
    TEST_ASSERT_EQUAL_INT32(4, keel_parameters_get(&all, CELLS).whole);
    TEST_ASSERT_EQUAL_INT32(0, keel_parameters_get(&all, SIXTEEN).whole);
    foreign[21u + 16u] = 7u; /* CELLS is of a type that there is none of. */
    found = loaded(foreign, sizeof foreign);
    TEST_ASSERT_EQUAL_UINT32(2u, found.refused);
}

static void PAR_008_values_that_do_not_go_together(void)
{
    uint8_t foreign[42];
    keel_parameters_loaded_t found;

    /* LOW is 5, 0x40A00000, and HIGH is 6, 0x40C00000: together, not one by one. */
    memset(foreign, 0, sizeof foreign);
    memcpy(foreign, "LOW", 3u);
    foreign[19] = 0xA0u;
    foreign[20] = 0x40u;
    memcpy(&foreign[21], "HIGH", 4u);
    foreign[40] = 0xC0u;
    foreign[41] = 0x40u;
    found = loaded(foreign, sizeof foreign);
    TEST_ASSERT_EQUAL_UINT32(2u, found.taken);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, real_of(LOW));
    TEST_ASSERT_EQUAL_FLOAT(6.0f, real_of(HIGH));

    /* HIGH is 2, 0x40000000: without LOW it can be taken. */
    foreign[40] = 0x00u;
    found = loaded(foreign, sizeof foreign);
    TEST_ASSERT_EQUAL_UINT32(1u, found.taken);
    TEST_ASSERT_EQUAL_UINT32(1u, found.refused);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, entry[LOW].refused);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, real_of(LOW));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, real_of(HIGH));
}

static void PAR_008_what_is_set_afterwards_is_no_stored_value(void)
{
    uint8_t foreign[21] = "LOW";

    foreign[19] = 0x80u; /* Infinity. */
    foreign[20] = 0x7Fu;
    TEST_ASSERT_EQUAL_UINT32(1u, loaded(foreign, sizeof foreign).refused);
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_parameters_set(&all, LOW, real(9.0f)));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, entry[LOW].refused);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_parameters_set(&all, LOW, real(2.0f)));
    TEST_ASSERT_EQUAL(KEEL_OK, entry[LOW].refused);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PAR_001_refused_tables);
    RUN_TEST(PAR_001_defaults_that_no_unit_takes);
    RUN_TEST(PAR_002_the_table_can_be_read);
    RUN_TEST(PAR_003_names_end_with_a_zero_or_their_sixteenth_letter);
    RUN_TEST(PAR_004_what_is_set_is_kept);
    RUN_TEST(PAR_004_the_number_that_does_not_count_is_0);
    RUN_TEST(PAR_005_what_is_refused_changes_nothing);
    RUN_TEST(PAR_006_stored_is_what_is_no_default);
    RUN_TEST(PAR_007_what_was_stored_is_loaded);
    RUN_TEST(PAR_008_a_set_of_another_firmware);
    RUN_TEST(PAR_008_values_that_do_not_go_together);
    RUN_TEST(PAR_008_what_is_set_afterwards_is_no_stored_value);
    return UNITY_END();
}
