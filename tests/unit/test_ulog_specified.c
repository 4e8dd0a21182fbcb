/* SPDX-License-Identifier: Apache-2.0 */
/* The writer of ULog beside its executable specification (specs/model): random messages by both,
 * which must be the same in every field. */
#include "any.h"
#include "keel/middleware/ulog.h"
#include "unity.h"

#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/ulog.c"

#define CALLS 20000u
#define SEED  20261126u
#define TEXT  600u

static keel_ulog_message_t message;
static keel_ulog_message_t model;
static char text[TEXT];
static uint8_t bytes[TEXT];

void setUp(void)
{
    any_from(SEED);
    memset(&message, 0, sizeof message);
    memset(&model, 0, sizeof model);
}

void tearDown(void)
{
}

static void any_name(keel_ulog_name_t *name)
{
    for (uint32_t i = 0u; i < KEEL_ULOG_NAME_LENGTH; i++) {
        name->text[i] = one_in(24u) ? '\0' : (char)any();
    }
}

static void any_format(keel_ulog_format_t *format)
{
    format->fields = (uint8_t)(any() % (one_in(8u) ? 256u : (KEEL_ULOG_FIELDS + 1u)));
    any_name(&format->name);
    for (uint32_t i = 0u; i < KEEL_ULOG_FIELDS; i++) {
        any_name(&format->field[i].name);
        format->field[i].type = (uint8_t)(any() % (KEEL_ULOG_TYPES + (one_in(8u) ? 1u : 0u)));
        format->field[i].count = one_in(2u) ? 1u : (uint8_t)any();
    }
}

static bool both_make(uint32_t kind)
{
    const uint8_t length = (uint8_t)any();
    const uint64_t time_us = any_64() >> (any() % 64u);
    const uint16_t number = (uint16_t)any();
    const uint16_t count = (uint16_t)(any() % (one_in(4u) ? TEXT : 100u));
    const uint8_t type = (uint8_t)(any() % 12u);
    keel_ulog_name_t name;
    keel_ulog_format_t format;

    any_name(&name);
    any_format(&format);
    TEST_ASSERT_EQUAL_UINT16(model_ulog_field_bytes(&format.field[0]),
                             keel_ulog_field_bytes(&format.field[0]));
    switch (kind) {
    case 0u:
        model_ulog_begin(&model, time_us);
        keel_ulog_begin(&message, time_us);
        return true;
    case 1u:
        model_ulog_flags(&model);
        keel_ulog_flags(&message);
        return true;
    case 2u:
        return model_ulog_format(&model, &format) == keel_ulog_format(&message, &format);
    case 3u:
        return model_ulog_information(&model, &name, text, length) ==
               keel_ulog_information(&message, &name, text, length);
    case 4u:
        return model_ulog_parameter(&model, &name, type, bytes) ==
               keel_ulog_parameter(&message, &name, type, bytes);
    case 5u:
        model_ulog_subscription(&model, type, number, &name);
        keel_ulog_subscription(&message, type, number, &name);
        return true;
    case 6u:
        model_ulog_data(&model, number);
        keel_ulog_data(&message, number);
        return true;
    case 7u:
        return model_ulog_logging(&model, type, time_us, text, length) ==
               keel_ulog_logging(&message, type, time_us, text, length);
    case 8u:
        model_ulog_dropout(&model, time_us);
        keel_ulog_dropout(&message, time_us);
        return true;
    default:
        return model_ulog_add(&model, bytes, count) == keel_ulog_add(&message, bytes, count);
    }
}

static void ULG_002_each_message_is_as_specified(void)
{
    for (uint32_t n = 0u; n < CALLS; n++) {
        text[any() % TEXT] = (char)any();
        bytes[any() % TEXT] = (uint8_t)any();
        TEST_ASSERT_TRUE(both_make(any() % 13u));
        TEST_ASSERT_EQUAL_MEMORY(&model, &message, sizeof message);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ULG_002_each_message_is_as_specified);
    return UNITY_END();
}
