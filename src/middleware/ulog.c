/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/ulog.h"

/* The kinds of messages, each by its character. */
#define FLAG_BITS    0x42u /* B */
#define FORMAT       0x46u /* F */
#define ABOUT        0x49u /* I */
#define PARAMETER    0x50u /* P */
#define SUBSCRIPTION 0x41u /* A */
#define DATA         0x44u /* D */
#define LOGGING      0x4Cu /* L */
#define DROPOUT      0x4Fu /* O */

#define COLON     0x3Au
#define SEMICOLON 0x3Bu
#define BRACKET   0x5Bu
#define END       0x5Du
#define SPACE     0x20u
#define ZERO      0x30u

/* Bytes of the flag bits: 8 of each sort, and three places of 8 bytes. */
#define FLAG_BYTES 40u

/* Where the length of a key stands. */
#define KEY_AT KEEL_ULOG_HEAD_BYTES

/* Of a value, whichever of the two types it has. */
#define PARAMETER_BYTES 4u

#define US_PER_MS   1000u
#define DROPOUT_MAX 65535u

/* Characters of the longest type, `uint64_t`. */
#define TYPE_LENGTH 8u

/* ULog and its version. */
#define MAGIC_BYTES 8u

/*@ // A name is so many characters long: those before the first 0, or all.
  @ predicate ulog_length(keel_ulog_name_t *name, integer n) =
  @     0 <= n <= KEEL_ULOG_NAME_LENGTH &&
  @     (\forall integer k; 0 <= k < n ==> name->text[k] != 0) &&
  @     (n < KEEL_ULOG_NAME_LENGTH ==> name->text[n] == 0);
  @
  @ // Each of its characters stands in the message, from there on.
  @ predicate ulog_named(keel_ulog_message_t *m, integer at, keel_ulog_name_t *name) =
  @     \forall integer n; ulog_length(name, n) ==>
  @         \forall integer k; 0 <= k < n ==> m->bytes[at + k] == name->text[k];
  @
  @ // The bytes that were there are, with so many behind them at most; those fit, if that many do.
  @ predicate ulog_kept{L, M}(keel_ulog_message_t *m, integer most) =
  @     ulog_valid{M}(m) && (\at(m->overflowed, L) != 0 ==> \at(m->overflowed, M) != 0) &&
  @     \at(m->size, L) <= \at(m->size, M) <= \at(m->size, L) + most &&
  @     (\at(m->size, L) + most <= KEEL_ULOG_MESSAGE_BYTES ==>
  @         \at(m->overflowed, M) == \at(m->overflowed, L)) &&
  @     (\forall integer k; 0 <= k < \at(m->size, L) ==>
  @         \at(m->bytes[k], M) == \at(m->bytes[k], L));
  @
  @ // With just so many, if they fit.
  @ predicate ulog_longer{L, M}(keel_ulog_message_t *m, integer count) =
  @     ulog_kept{L, M}(m, count) &&
  @     (\at(m->size, L) + count <= KEEL_ULOG_MESSAGE_BYTES ==>
  @         \at(m->size, M) == \at(m->size, L) + count) &&
  @     (\at(m->size, L) + count > KEEL_ULOG_MESSAGE_BYTES ==> \at(m->overflowed, M) != 0);
  @*/

/*@ requires \valid(message) && ulog_valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_longer{Pre, Post}(message, 1);
  @ ensures \old(message->size) < KEEL_ULOG_MESSAGE_BYTES ==>
  @     message->bytes[\old(message->size)] == byte;
  @*/
static void log_byte(keel_ulog_message_t *message, uint8_t byte)
{
    if (message->size < KEEL_ULOG_MESSAGE_BYTES) {
        message->bytes[message->size] = byte;
        message->size++;
    } else {
        message->overflowed = true;
    }
}

/* Bytes of a number, the lowest first. */
/*@ requires \valid(message) && ulog_valid(message) && count <= 8;
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_longer{Pre, Post}(message, count);
  @*/
static void put_number(keel_ulog_message_t *message, uint64_t value, uint32_t count)
{
    uint64_t rest = value;

    /*@ loop invariant 0 <= i <= count && ulog_longer{Pre, Here}(message, i);
      @ loop assigns i, rest, message->size, message->overflowed,
      @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
      @ loop variant count - i;
      @*/
    for (uint32_t i = 0u; i < count; i++) {
        log_byte(message, (uint8_t)(rest % 256u));
        rest /= 256u;
    }
}

/*@ requires \valid(message) && ulog_valid(message);
  @ requires \valid_read(bytes + (0 .. count - 1));
  @ requires \separated(message, bytes + (0 .. count - 1));
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_longer{Pre, Post}(message, count);
  @ ensures \old(message->size) + count <= KEEL_ULOG_MESSAGE_BYTES ==>
  @     \forall integer k; 0 <= k < count ==>
  @         message->bytes[\at(message->size, Pre) + k] == bytes[k];
  @*/
static void put_bytes(keel_ulog_message_t *message, const uint8_t *bytes, uint32_t count)
{
    /*@ loop invariant 0 <= i <= count && ulog_longer{Pre, Here}(message, i);
      @ loop invariant \at(message->size, Pre) + i <= KEEL_ULOG_MESSAGE_BYTES ==>
      @     \forall integer k; 0 <= k < i ==>
      @         message->bytes[\at(message->size, Pre) + k] == bytes[k];
      @ loop assigns i, message->size, message->overflowed,
      @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
      @ loop variant count - i;
      @*/
    for (uint32_t i = 0u; i < count; i++) {
        log_byte(message, bytes[i]);
    }
}

/*@ requires \valid(message) && ulog_valid(message);
  @ requires \valid_read(text + (0 .. count - 1));
  @ requires \separated(message, text + (0 .. count - 1));
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_longer{Pre, Post}(message, count);
  @ ensures \old(message->size) + count <= KEEL_ULOG_MESSAGE_BYTES ==>
  @     \forall integer k; 0 <= k < count ==>
  @         message->bytes[\at(message->size, Pre) + k] == text[k];
  @*/
static void put_text(keel_ulog_message_t *message, const char *text, uint32_t count)
{
    /*@ loop invariant 0 <= i <= count && ulog_longer{Pre, Here}(message, i);
      @ loop invariant \at(message->size, Pre) + i <= KEEL_ULOG_MESSAGE_BYTES ==>
      @     \forall integer k; 0 <= k < i ==>
      @         message->bytes[\at(message->size, Pre) + k] == text[k];
      @ loop assigns i, message->size, message->overflowed,
      @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
      @ loop variant count - i;
      @*/
    for (uint32_t i = 0u; i < count; i++) {
        log_byte(message, (uint8_t)text[i]);
    }
}

/* Up to the first 0, or all of it. */
/*@ requires \valid(message) && ulog_valid(message) && \valid_read(name);
  @ requires \separated(message, name);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_kept{Pre, Post}(message, KEEL_ULOG_NAME_LENGTH);
  @ ensures \old(message->size) + KEEL_ULOG_NAME_LENGTH <= KEEL_ULOG_MESSAGE_BYTES ==>
  @     ulog_named(message, \old(message->size), name) &&
  @     \forall integer n; ulog_length(name, n) ==> message->size == \old(message->size) + n;
  @*/
static void put_name(keel_ulog_message_t *message, const keel_ulog_name_t *name)
{
    /*@ loop invariant 0 <= i <= KEEL_ULOG_NAME_LENGTH && ulog_longer{Pre, Here}(message, i);
      @ loop invariant \forall integer k; 0 <= k < i ==> name->text[k] != 0;
      @ loop invariant \at(message->size, Pre) + i <= KEEL_ULOG_MESSAGE_BYTES ==>
      @     \forall integer k; 0 <= k < i ==>
      @         message->bytes[\at(message->size, Pre) + k] == name->text[k];
      @ loop assigns i, message->size, message->overflowed,
      @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
      @ loop variant KEEL_ULOG_NAME_LENGTH - i;
      @*/
    for (uint32_t i = 0u; (i < KEEL_ULOG_NAME_LENGTH) && (name->text[i] != '\0'); i++) {
        log_byte(message, (uint8_t)name->text[i]);
    }
}

/* In decimal, without leading zeros. */
/*@ requires \valid(message) && ulog_valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_kept{Pre, Post}(message, 3);
  @*/
static void put_decimal(keel_ulog_message_t *message, uint8_t value)
{
    if (value >= 100u) {
        log_byte(message, (uint8_t)(ZERO + (value / 100u)));
    }
    if (value >= 10u) {
        log_byte(message, (uint8_t)(ZERO + ((value / 10u) % 10u)));
    }
    log_byte(message, (uint8_t)(ZERO + (value % 10u)));
}

/* A character of a type as C has it; 0 behind the last of a shorter one. */
/*@ requires type < KEEL_ULOG_TYPES && place < TYPE_LENGTH;
  @ assigns \nothing;
  @*/
static uint8_t type_letter(uint8_t type, uint32_t place)
{
    static const char names[KEEL_ULOG_TYPES][TYPE_LENGTH] = {
        [KEEL_ULOG_INT8] = "int8_t",   [KEEL_ULOG_UINT8] = "uint8_t",
        [KEEL_ULOG_INT16] = "int16_t", [KEEL_ULOG_UINT16] = "uint16_t",
        [KEEL_ULOG_INT32] = "int32_t", [KEEL_ULOG_UINT32] = "uint32_t",
        [KEEL_ULOG_INT64] = "int64_t", [KEEL_ULOG_UINT64] = "uint64_t",
        [KEEL_ULOG_FLOAT] = "float",   [KEEL_ULOG_DOUBLE] = "double",
        [KEEL_ULOG_BOOL] = "bool",     [KEEL_ULOG_CHAR] = "char"};

    return (uint8_t)names[type][place];
}

/*@ requires type < KEEL_ULOG_TYPES;
  @ assigns \nothing;
  @ ensures \result <= 8;
  @*/
static uint8_t value_bytes(uint8_t type)
{
    static const uint8_t sizes[KEEL_ULOG_TYPES] = {
        [KEEL_ULOG_INT8] = 1u,   [KEEL_ULOG_UINT8] = 1u,  [KEEL_ULOG_INT16] = 2u,
        [KEEL_ULOG_UINT16] = 2u, [KEEL_ULOG_INT32] = 4u,  [KEEL_ULOG_UINT32] = 4u,
        [KEEL_ULOG_INT64] = 8u,  [KEEL_ULOG_UINT64] = 8u, [KEEL_ULOG_FLOAT] = 4u,
        [KEEL_ULOG_DOUBLE] = 8u, [KEEL_ULOG_BOOL] = 1u,   [KEEL_ULOG_CHAR] = 1u};

    return sizes[type];
}

/* A type and a space, or with brackets: `float `, `float[4] `. */
/*@ requires \valid(message) && ulog_valid(message) && type < KEEL_ULOG_TYPES;
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_kept{Pre, Post}(message, TYPE_LENGTH + 6);
  @*/
static void put_type(keel_ulog_message_t *message, uint8_t type, bool is_array, uint8_t count)
{
    /*@ loop invariant 0 <= i <= TYPE_LENGTH && ulog_longer{Pre, Here}(message, i);
      @ loop assigns i, message->size, message->overflowed,
      @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
      @ loop variant TYPE_LENGTH - i;
      @*/
    for (uint32_t i = 0u; (i < TYPE_LENGTH) && (type_letter(type, i) != 0u); i++) {
        log_byte(message, type_letter(type, i));
    }
    if (is_array) {
        log_byte(message, BRACKET);
        put_decimal(message, count);
        log_byte(message, END);
    }
    log_byte(message, SPACE);
}

/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures message->size == KEEL_ULOG_HEAD_BYTES && message->overflowed == 0;
  @ ensures message->bytes[2] == kind;
  @*/
static void open_message(keel_ulog_message_t *message, uint8_t kind)
{
    message->overflowed = false;
    message->bytes[0] = 0u;
    message->bytes[1] = 0u;
    message->bytes[2] = kind;
    message->size = KEEL_ULOG_HEAD_BYTES;
}

/* Refuses a message: it becomes none. */
/*@ requires \valid(message);
  @ assigns message->size, message->overflowed;
  @ ensures message->size == 0 && message->overflowed != 0 && \result == 0;
  @*/
static bool refuse_message(keel_ulog_message_t *message)
{
    message->size = 0u;
    message->overflowed = true;
    return false;
}

/* Its size, now that it is known; or none, when it is too long. */
/*@ requires \valid(message) && ulog_valid(message);
  @ requires message->overflowed || message->size >= KEEL_ULOG_HEAD_BYTES;
  @ assigns message->size, message->bytes[0], message->bytes[1];
  @ ensures \result <==> message->overflowed == 0;
  @ ensures \result ==> message->size == \old(message->size) &&
  @     message->bytes[0] + 256 * message->bytes[1] == message->size - KEEL_ULOG_HEAD_BYTES;
  @ ensures !\result ==> message->size == 0;
  @*/
static bool close_message(keel_ulog_message_t *message)
{
    if (message->overflowed) {
        message->size = 0u;
    } else {
        const uint32_t size = (uint32_t)message->size - KEEL_ULOG_HEAD_BYTES;

        message->bytes[0] = (uint8_t)(size % 256u);
        message->bytes[1] = (uint8_t)(size / 256u);
    }
    return !message->overflowed;
}

/* The length of a key, which stands in front of it. */
/*@ requires \valid(message) && ulog_valid(message);
  @ requires KEY_AT < message->size <= KEY_AT + 1 + UINT8_MAX;
  @ assigns message->bytes[KEY_AT];
  @ ensures message->bytes[KEY_AT] == message->size - (KEY_AT + 1);
  @*/
static void set_key_length(keel_ulog_message_t *message)
{
    message->bytes[KEY_AT] = (uint8_t)((uint32_t)message->size - (KEY_AT + 1u));
}

void keel_ulog_begin(keel_ulog_message_t *message, uint64_t start_us)
{
    const uint8_t magic[MAGIC_BYTES] = {0x55u, 0x4Cu, 0x6Fu, 0x67u, 0x01u, 0x12u, 0x35u, 0x01u};

    message->overflowed = false;
    message->size = 0u;
    put_bytes(message, magic, MAGIC_BYTES);
    put_number(message, start_us, 8u);
}

void keel_ulog_flags(keel_ulog_message_t *message)
{
    open_message(message, FLAG_BITS);
    /*@ loop invariant 0 <= i <= FLAG_BYTES && ulog_longer{LoopEntry, Here}(message, i);
      @ loop assigns i, message->size, message->overflowed,
      @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
      @ loop variant FLAG_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < FLAG_BYTES; i++) {
        log_byte(message, 0u);
    }
    (void)close_message(message);
}

/* Not too many fields, each of a known type. */
/*@ requires \valid_read(format);
  @ assigns \nothing;
  @ ensures \result <==> format->fields <= KEEL_ULOG_FIELDS &&
  @     \forall integer i; 0 <= i < format->fields ==> format->field[i].type < KEEL_ULOG_TYPES;
  @*/
static bool is_format_known(const keel_ulog_format_t *format)
{
    bool known = format->fields <= KEEL_ULOG_FIELDS;

    /*@ loop invariant 0 <= i <= KEEL_ULOG_FIELDS && (known != 0 ==> i <= format->fields);
      @ loop invariant known <==> format->fields <= KEEL_ULOG_FIELDS &&
      @     \forall integer j; 0 <= j < i && j < format->fields ==>
      @         format->field[j].type < KEEL_ULOG_TYPES;
      @ loop assigns i, known;
      @ loop variant KEEL_ULOG_FIELDS - i;
      @*/
    for (uint32_t i = 0u; (i < KEEL_ULOG_FIELDS) && (i < format->fields); i++) {
        known = known && (format->field[i].type < KEEL_ULOG_TYPES);
    }
    return known;
}

/*@ requires \valid(message) && ulog_valid(message) && \valid_read(field);
  @ requires field->type < KEEL_ULOG_TYPES && \separated(message, field);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ulog_kept{Pre, Post}(message, TYPE_LENGTH + 6 + KEEL_ULOG_NAME_LENGTH + 1);
  @*/
static void put_field(keel_ulog_message_t *message, const keel_ulog_field_t *field)
{
    put_type(message, field->type, field->count != 1u, field->count);
    put_name(message, &field->name);
    log_byte(message, SEMICOLON);
}

bool keel_ulog_format(keel_ulog_message_t *message, const keel_ulog_format_t *format)
{
    if (!is_format_known(format)) {
        return refuse_message(message);
    }
    open_message(message, FORMAT);
    put_name(message, &format->name);
    log_byte(message, COLON);
    /*@ loop invariant 0 <= i <= format->fields <= KEEL_ULOG_FIELDS;
      @ loop invariant \forall integer k; 0 <= k < format->fields ==>
      @     format->field[k].type < KEEL_ULOG_TYPES;
      @ loop invariant ulog_valid(message) && KEEL_ULOG_HEAD_BYTES <= message->size &&
      @     message->bytes[2] == FORMAT;
      @ loop assigns i, message->size, message->overflowed,
      @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
      @ loop variant format->fields - i;
      @*/
    for (uint32_t i = 0u; (i < KEEL_ULOG_FIELDS) && (i < format->fields); i++) {
        put_field(message, &format->field[i]);
    }
    return close_message(message);
}

bool keel_ulog_information(keel_ulog_message_t *message, const keel_ulog_name_t *name,
                           const char *text, uint8_t length)
{
    open_message(message, ABOUT);
    log_byte(message, 0u);
    put_type(message, KEEL_ULOG_CHAR, true, length);
    put_name(message, name);
    set_key_length(message);
    put_text(message, text, length);
    return close_message(message);
}

bool keel_ulog_parameter(keel_ulog_message_t *message, const keel_ulog_name_t *name, uint8_t type,
                         const uint8_t *value)
{
    if ((type != KEEL_ULOG_INT32) && (type != KEEL_ULOG_FLOAT)) {
        return refuse_message(message);
    }
    open_message(message, PARAMETER);
    log_byte(message, 0u);
    put_type(message, type, false, 1u);
    put_name(message, name);
    set_key_length(message);
    put_bytes(message, value, PARAMETER_BYTES);
    return close_message(message);
}

void keel_ulog_subscription(keel_ulog_message_t *message, uint8_t instance, uint16_t number,
                            const keel_ulog_name_t *name)
{
    open_message(message, SUBSCRIPTION);
    log_byte(message, instance);
    put_number(message, number, 2u);
    put_name(message, name);
    (void)close_message(message);
}

void keel_ulog_data(keel_ulog_message_t *message, uint16_t number)
{
    open_message(message, DATA);
    put_number(message, number, 2u);
    (void)close_message(message);
}

bool keel_ulog_add(keel_ulog_message_t *message, const uint8_t *bytes, uint16_t count)
{
    if ((message->size < KEEL_ULOG_HEAD_BYTES) ||
        (count > (KEEL_ULOG_MESSAGE_BYTES - message->size))) {
        return refuse_message(message);
    }
    message->overflowed = false;
    put_bytes(message, bytes, count);
    return close_message(message);
}

bool keel_ulog_logging(keel_ulog_message_t *message, uint8_t level, uint64_t time_us,
                       const char *text, uint8_t length)
{
    open_message(message, LOGGING);
    log_byte(message, level);
    put_number(message, time_us, 8u);
    put_text(message, text, length);
    return close_message(message);
}

void keel_ulog_dropout(keel_ulog_message_t *message, uint64_t lost_us)
{
    const uint64_t most_us = (uint64_t)DROPOUT_MAX * US_PER_MS;
    const uint64_t told_us = (lost_us < most_us) ? lost_us : most_us;

    open_message(message, DROPOUT);
    put_number(message, (told_us < US_PER_MS) ? 1u : (told_us / US_PER_MS), 2u);
    (void)close_message(message);
}

uint16_t keel_ulog_field_bytes(const keel_ulog_field_t *field)
{
    uint32_t bytes = 0u;

    if (field->type < KEEL_ULOG_TYPES) {
        bytes = (uint32_t)value_bytes(field->type) * field->count;
    }
    return (uint16_t)bytes;
}
