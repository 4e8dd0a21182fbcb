/* SPDX-License-Identifier: Apache-2.0 */
#include "ulog.h"

/* The longest type's characters. */
#define TYPE_MOST 8u

/* A message of any length, and its first bytes. */
typedef struct draft {
    uint32_t size;
    uint8_t bytes[KEEL_ULOG_MESSAGE_BYTES];
} draft_t;

static void append(draft_t *draft, uint8_t byte)
{
    if (draft->size < KEEL_ULOG_MESSAGE_BYTES) {
        draft->bytes[draft->size] = byte;
    }
    draft->size++;
}

/* A name that fills all of its characters has no 0 at its end. */
static void append_name(draft_t *draft, const keel_ulog_name_t *name)
{
    bool ended = false;

    for (uint32_t i = 0u; i < KEEL_ULOG_NAME_LENGTH; i++) {
        ended = ended || (name->text[i] == '\0');
        if (!ended) {
            append(draft, (uint8_t)name->text[i]);
        }
    }
}

static void append_text(draft_t *draft, const char *text, uint8_t length)
{
    for (uint32_t i = 0u; i < length; i++) {
        append(draft, (uint8_t)text[i]);
    }
}

/* Little-endian. */
static void append_u16(draft_t *draft, uint16_t value)
{
    append(draft, (uint8_t)(value & 0xFFu));
    append(draft, (uint8_t)(value >> 8u));
}

static void append_u64(draft_t *draft, uint64_t value)
{
    for (uint32_t shift = 0u; shift < 64u; shift += 8u) {
        append(draft, (uint8_t)((value >> shift) & 0xFFu));
    }
}

/* ULG-004: as C has it. */
static void append_type(draft_t *draft, uint8_t type)
{
    static const char names[KEEL_ULOG_TYPES][TYPE_MOST + 1u] = {
        "int8_t",  "uint8_t",  "int16_t", "uint16_t", "int32_t", "uint32_t",
        "int64_t", "uint64_t", "float",   "double",   "bool",    "char"};

    for (uint32_t i = 0u; i < TYPE_MOST; i++) {
        if (names[type][i] != '\0') {
            append(draft, (uint8_t)names[type][i]);
        }
    }
}

/* ULG-012 */
static uint32_t type_size(uint8_t type)
{
    static const uint8_t sizes[KEEL_ULOG_TYPES] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 1, 1};

    return (type < KEEL_ULOG_TYPES) ? sizes[type] : 0u;
}

static void append_array(draft_t *draft, uint8_t count)
{
    const uint8_t digits[3] = {(uint8_t)(count / 100u), (uint8_t)((count / 10u) % 10u),
                               (uint8_t)(count % 10u)};

    append(draft, '[');
    for (uint32_t i = 0u; i < 3u; i++) {
        if ((i == 2u) || (count >= ((i == 0u) ? 100u : 10u))) {
            append(draft, (uint8_t)('0' + digits[i]));
        }
    }
    append(draft, ']');
}

/* ULG-002: two bytes for the size, and the kind. */
static void start(draft_t *draft, char kind)
{
    draft->size = 0u;
    append_u16(draft, 0u);
    append(draft, (uint8_t)kind);
}

/* ULG-002: it begins with its size. What does not fit is none, but its first bytes are. */
static bool finish(const draft_t *draft, keel_ulog_message_t *message)
{
    message->overflowed = draft->size > KEEL_ULOG_MESSAGE_BYTES;
    for (uint32_t i = 0u; (i < draft->size) && (i < KEEL_ULOG_MESSAGE_BYTES); i++) {
        message->bytes[i] = draft->bytes[i];
    }
    if (message->overflowed) {
        message->size = 0u;
        return false;
    }
    message->size = (uint16_t)draft->size;
    message->bytes[0] = (uint8_t)((draft->size - 3u) & 0xFFu);
    message->bytes[1] = (uint8_t)((draft->size - 3u) >> 8u);
    return true;
}

/* ULG-002 */
static bool none(keel_ulog_message_t *message)
{
    message->size = 0u;
    message->overflowed = true;
    return false;
}

/* ULG-001 */
void model_ulog_begin(keel_ulog_message_t *message, uint64_t start_us)
{
    static const uint8_t magic[8] = {'U', 'L', 'o', 'g', 1, 0x12, 0x35, 1};
    draft_t draft = {.size = 0u};

    for (uint32_t i = 0u; i < 8u; i++) {
        append(&draft, magic[i]);
    }
    append_u64(&draft, start_us);
    for (uint32_t i = 0u; i < 16u; i++) {
        message->bytes[i] = draft.bytes[i];
    }
    message->size = 16u;
    message->overflowed = false;
}

/* ULG-003 */
void model_ulog_flags(keel_ulog_message_t *message)
{
    draft_t draft;

    start(&draft, 'B');
    for (uint32_t i = 0u; i < 40u; i++) {
        append(&draft, 0u);
    }
    (void)finish(&draft, message);
}

/* ULG-004: `float[4] q;` */
static void append_field(draft_t *draft, const keel_ulog_field_t *field)
{
    append_type(draft, field->type);
    if (field->count != 1u) {
        append_array(draft, field->count);
    }
    append(draft, ' ');
    append_name(draft, &field->name);
    append(draft, ';');
}

/* ULG-004: `name:uint64_t timestamp;float[4] q;` */
bool model_ulog_format(keel_ulog_message_t *message, const keel_ulog_format_t *format)
{
    draft_t draft;

    if (format->fields > KEEL_ULOG_FIELDS) {
        return none(message);
    }
    for (uint32_t i = 0u; i < KEEL_ULOG_FIELDS; i++) {
        if ((i < format->fields) && (format->field[i].type >= KEEL_ULOG_TYPES)) {
            return none(message);
        }
    }
    start(&draft, 'F');
    append_name(&draft, &format->name);
    append(&draft, ':');
    for (uint32_t i = 0u; (i < KEEL_ULOG_FIELDS) && (i < format->fields); i++) {
        append_field(&draft, &format->field[i]);
    }
    return finish(&draft, message);
}

/* ULG-005: the key's length, the key, `char[4] name`, and the text. */
bool model_ulog_information(keel_ulog_message_t *message, const keel_ulog_name_t *name,
                            const char *text, uint8_t length)
{
    draft_t draft;

    start(&draft, 'I');
    append(&draft, 0u);
    append_type(&draft, KEEL_ULOG_CHAR);
    append_array(&draft, length);
    append(&draft, ' ');
    append_name(&draft, name);
    draft.bytes[3] = (uint8_t)(draft.size - 4u);
    append_text(&draft, text, length);
    return finish(&draft, message);
}

/* ULG-006 */
bool model_ulog_parameter(keel_ulog_message_t *message, const keel_ulog_name_t *name, uint8_t type,
                          const uint8_t *value)
{
    draft_t draft;

    if ((type != KEEL_ULOG_INT32) && (type != KEEL_ULOG_FLOAT)) {
        return none(message);
    }
    start(&draft, 'P');
    append(&draft, 0u);
    append_type(&draft, type);
    append(&draft, ' ');
    append_name(&draft, name);
    draft.bytes[3] = (uint8_t)(draft.size - 4u);
    for (uint32_t i = 0u; i < 4u; i++) {
        append(&draft, value[i]);
    }
    return finish(&draft, message);
}

/* ULG-007 */
void model_ulog_subscription(keel_ulog_message_t *message, uint8_t instance, uint16_t number,
                             const keel_ulog_name_t *name)
{
    draft_t draft;

    start(&draft, 'A');
    append(&draft, instance);
    append_u16(&draft, number);
    append_name(&draft, name);
    (void)finish(&draft, message);
}

/* ULG-008 */
void model_ulog_data(keel_ulog_message_t *message, uint16_t number)
{
    draft_t draft;

    start(&draft, 'D');
    append_u16(&draft, number);
    (void)finish(&draft, message);
}

/* ULG-009: to no message nothing is added. */
bool model_ulog_add(keel_ulog_message_t *message, const uint8_t *bytes, uint16_t count)
{
    const uint32_t size = (uint32_t)message->size + count;

    if ((message->size < 3u) || (size > KEEL_ULOG_MESSAGE_BYTES)) {
        return none(message);
    }
    for (uint32_t i = 0u; i < count; i++) {
        message->bytes[message->size + i] = bytes[i];
    }
    message->bytes[0] = (uint8_t)((size - 3u) & 0xFFu);
    message->bytes[1] = (uint8_t)((size - 3u) >> 8u);
    message->size = (uint16_t)size;
    message->overflowed = false;
    return true;
}

/* ULG-010 */
bool model_ulog_logging(keel_ulog_message_t *message, uint8_t level, uint64_t time_us,
                        const char *text, uint8_t length)
{
    draft_t draft;

    start(&draft, 'L');
    append(&draft, level);
    append_u64(&draft, time_us);
    append_text(&draft, text, length);
    return finish(&draft, message);
}

/* ULG-011: milliseconds, at least 1 and at most 65535. */
void model_ulog_dropout(keel_ulog_message_t *message, uint64_t lost_us)
{
    uint64_t lost_ms = lost_us / 1000u;
    draft_t draft;

    if (lost_ms == 0u) {
        lost_ms = 1u;
    }
    if (lost_ms > 65535u) {
        lost_ms = 65535u;
    }
    start(&draft, 'O');
    append_u16(&draft, (uint16_t)lost_ms);
    (void)finish(&draft, message);
}

/* ULG-012 */
uint16_t model_ulog_field_bytes(const keel_ulog_field_t *field)
{
    return (uint16_t)(type_size(field->type) * field->count);
}
