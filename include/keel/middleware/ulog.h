/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ulog.h
 * @brief A writer of ULog, the format of flight logs that PX4's tools read: message by message.
 *
 * A log is its beginning (keel_ulog_begin), the flag bits, the formats of all topics, information
 * and parameters; then subscriptions, which give topics numbers, and data, text and dropouts, as
 * they come. Each function makes one message of it, for the caller to store. One that is too long,
 * or has what is not allowed in it, is none: its size is 0.
 *
 * Formats are constant tables of the caller. Values come as their bytes, the lowest first, as they
 * lie in the memory of a little-endian processor; they stand in a message without gaps, in the
 * order of the format's fields, the first of which is `uint64_t timestamp` in us.
 */
#ifndef KEEL_MIDDLEWARE_ULOG_H
#define KEEL_MIDDLEWARE_ULOG_H

#include "keel/c_declarations.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Bytes of the longest message. */
#ifndef KEEL_ULOG_MESSAGE_BYTES
#define KEEL_ULOG_MESSAGE_BYTES 512u
#endif

/** Characters of a name. */
#ifndef KEEL_ULOG_NAME_LENGTH
#define KEEL_ULOG_NAME_LENGTH 24u
#endif

/** Fields of a format. */
#ifndef KEEL_ULOG_FIELDS
#define KEEL_ULOG_FIELDS 16u
#endif

#if (KEEL_ULOG_NAME_LENGTH < 1u) || (KEEL_ULOG_NAME_LENGTH > 200u)
#error "KEEL_ULOG_NAME_LENGTH: 1 to 200"
#endif

#if (KEEL_ULOG_FIELDS < 1u) || (KEEL_ULOG_FIELDS > 255u)
#error "KEEL_ULOG_FIELDS: 1 to 255"
#endif

/* These always fit: flag bits, keys, parameters and subscriptions. */
#if (KEEL_ULOG_MESSAGE_BYTES < 43u) || (KEEL_ULOG_MESSAGE_BYTES > 65535u) ||                       \
    (KEEL_ULOG_MESSAGE_BYTES < (KEEL_ULOG_NAME_LENGTH + 24u))
#error "KEEL_ULOG_MESSAGE_BYTES: at least 43, and 24 more than a name, at most 65535"
#endif

/** Bytes of what a file begins with. */
#define KEEL_ULOG_BEGIN_BYTES 16u

/** Bytes of what each message begins with: its size without them, and its kind. */
#define KEEL_ULOG_HEAD_BYTES 3u

/** Bytes of a dropout. */
#define KEEL_ULOG_DROPOUT_BYTES 5u

/** @name Types of values. */
/** @{ */
#define KEEL_ULOG_INT8   0u
#define KEEL_ULOG_UINT8  1u
#define KEEL_ULOG_INT16  2u
#define KEEL_ULOG_UINT16 3u
#define KEEL_ULOG_INT32  4u
#define KEEL_ULOG_UINT32 5u
#define KEEL_ULOG_INT64  6u
#define KEEL_ULOG_UINT64 7u
#define KEEL_ULOG_FLOAT  8u
#define KEEL_ULOG_DOUBLE 9u
#define KEEL_ULOG_BOOL   10u
#define KEEL_ULOG_CHAR   11u
#define KEEL_ULOG_TYPES  12u /**< How many there are. */
/** @} */

/** @name How bad it is what a text says. */
/** @{ */
#define KEEL_ULOG_ERROR       0x33u
#define KEEL_ULOG_WARNING     0x34u
#define KEEL_ULOG_INFORMATION 0x36u
/** @} */

/** A name: up to the first 0, or all of it. */
typedef struct keel_ulog_name {
    char text[KEEL_ULOG_NAME_LENGTH];
} keel_ulog_name_t;

/** A field of a topic. */
typedef struct keel_ulog_field {
    keel_ulog_name_t name;
    uint8_t type;  /**< KEEL_ULOG_INT8, ... */
    uint8_t count; /**< 1: a value; more: an array of so many. */
} keel_ulog_field_t;

/** The format of a topic's data. */
typedef struct keel_ulog_topic_format {
    keel_ulog_name_t name;
    uint8_t fields; /**< How many, up to KEEL_ULOG_FIELDS. */
    keel_ulog_field_t field[KEEL_ULOG_FIELDS];
} keel_ulog_format_t;

/** A message. Only the functions below write it. */
typedef struct keel_ulog_message {
    uint16_t size;   /**< Of bytes; 0 when there is none. */
    bool overflowed; /**< It is none, as something did not fit. */
    uint8_t bytes[KEEL_ULOG_MESSAGE_BYTES];
} keel_ulog_message_t;

/*@ predicate ulog_valid(keel_ulog_message_t *m) = m->size <= KEEL_ULOG_MESSAGE_BYTES;
  @
  @ // A whole message of a kind, or none.
  @ predicate ulog_made(keel_ulog_message_t *m, integer kind, integer made) =
  @     ulog_valid(m) && (made == 0 ==> m->size == 0) && (made != 0 ==>
  @         m->size >= KEEL_ULOG_HEAD_BYTES && m->bytes[2] == kind && m->overflowed == 0 &&
  @         m->bytes[0] + 256 * m->bytes[1] == m->size - KEEL_ULOG_HEAD_BYTES);
  @*/

/**
 * The head of a file (requirement ULG-001): the magic bytes, the version, the time.
 *
 * @param message  receives it
 * @param start_us when logging begins, in us
 */
/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_001_size: message->size == KEEL_ULOG_BEGIN_BYTES;
  @ ensures ULG_001_magic: message->bytes[0] == 0x55 && message->bytes[1] == 0x4C &&
  @     message->bytes[2] == 0x6F && message->bytes[3] == 0x67 && message->bytes[4] == 0x01 &&
  @     message->bytes[5] == 0x12 && message->bytes[6] == 0x35 && message->bytes[7] == 0x01;
  @*/
void keel_ulog_begin(keel_ulog_message_t *message, uint64_t start_us);

/**
 * The flag bits (B), all 0 (requirement ULG-003): nothing that a reader has to know, no appended
 * data. They stand behind what a file begins with.
 *
 * @param message receives it
 */
/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_flags: ulog_made(message, 'B', 1);
  @ ensures ULG_003_size: message->size == 43;
  @*/
void keel_ulog_flags(keel_ulog_message_t *message);

/**
 * The format of a topic (F; requirement ULG-004).
 *
 * @param message receives it
 * @param format  the topic
 * @return whether it fits, its fields are not too many, and their types are known
 */
/*@ requires \valid(message) && \valid_read(format) && \separated(message, format);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_format: ulog_made(message, 'F', \result);
  @ ensures ULG_004_fields: \result ==> format->fields <= KEEL_ULOG_FIELDS;
  @ ensures ULG_004_types: \result ==> \forall integer i; 0 <= i < format->fields ==>
  @     format->field[i].type < KEEL_ULOG_TYPES;
  @*/
bool keel_ulog_format(keel_ulog_message_t *message, const keel_ulog_format_t *format);

/**
 * A text about the log (I; requirement ULG-005), as `sys_name`.
 *
 * @param message receives it
 * @param name    of what
 * @param text    what
 * @param length  its characters
 * @return whether it fits
 */
/*@ requires \valid(message) && \valid_read(name) && \valid_read(text + (0 .. length - 1));
  @ requires \separated(message, name) && \separated(message, text + (0 .. length - 1));
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_information: ulog_made(message, 'I', \result);
  @ ensures ULG_005_text: \result ==> length <= message->size &&
  @     \forall integer k; 0 <= k < length ==>
  @         message->bytes[message->size - length + k] == text[k];
  @*/
bool keel_ulog_information(keel_ulog_message_t *message, const keel_ulog_name_t *name,
                           const char *text, uint8_t length);

/**
 * A parameter (P; requirement ULG-006).
 *
 * @param message receives it
 * @param name    its name
 * @param type    KEEL_ULOG_INT32 or KEEL_ULOG_FLOAT
 * @param value   its four bytes
 * @return whether it may have this type
 */
/*@ requires \valid(message) && \valid_read(name) && \valid_read(value + (0 .. 3));
  @ requires \separated(message, name) && \separated(message, value + (0 .. 3));
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_parameter: ulog_made(message, 'P', \result);
  @ ensures ULG_006_type: \result <==> type == KEEL_ULOG_INT32 || type == KEEL_ULOG_FLOAT;
  @*/
bool keel_ulog_parameter(keel_ulog_message_t *message, const keel_ulog_name_t *name, uint8_t type,
                         const uint8_t *value);

/**
 * A topic's number (A; requirement ULG-007): data that bear it are of this topic.
 *
 * @param message  receives it
 * @param instance which of several topics of this name; 0 for the first
 * @param number   the number
 * @param name     the format's name
 */
/*@ requires \valid(message) && \valid_read(name) && \separated(message, name);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_subscription: ulog_made(message, 'A', 1);
  @*/
void keel_ulog_subscription(keel_ulog_message_t *message, uint8_t instance, uint16_t number,
                            const keel_ulog_name_t *name);

/**
 * Data of a topic (D; requirement ULG-008), none yet: keel_ulog_add appends them.
 *
 * @param message receives it
 * @param number  of the topic
 */
/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_data: ulog_made(message, 'D', 1);
  @ ensures ULG_008_size: message->size == 5;
  @*/
void keel_ulog_data(keel_ulog_message_t *message, uint16_t number);

/**
 * Appends bytes to a message (requirement ULG-009).
 *
 * @param message the message, made by keel_ulog_data
 * @param bytes   what is appended
 * @param count   how many
 * @return whether it fits; otherwise there is no message any more, whatever is added
 */
/*@ requires \valid(message) && ulog_valid(message);
  @ requires \valid_read(bytes + (0 .. count - 1));
  @ requires \separated(message, bytes + (0 .. count - 1));
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_009_valid: ulog_valid(message) && (\result == 0 ==> message->size == 0);
  @ ensures ULG_009_fits: \result <==> \old(message->size) >= KEEL_ULOG_HEAD_BYTES &&
  @     count <= KEEL_ULOG_MESSAGE_BYTES - \old(message->size);
  @ ensures ULG_009_size: \result ==> message->size == \old(message->size) + count &&
  @     message->bytes[0] + 256 * message->bytes[1] == message->size - KEEL_ULOG_HEAD_BYTES;
  @ ensures ULG_009_bytes: \result ==> \forall integer k; 0 <= k < count ==>
  @     message->bytes[\at(message->size, Pre) + k] == bytes[k];
  @ ensures ULG_009_kept: \result ==> \forall integer k; 2 <= k < \old(message->size) ==>
  @     message->bytes[k] == \at(message->bytes[k], Pre);
  @*/
bool keel_ulog_add(keel_ulog_message_t *message, const uint8_t *bytes, uint16_t count);

/**
 * A line of text with a time (L; requirement ULG-010).
 *
 * @param message receives it
 * @param level   how bad it is: KEEL_ULOG_ERROR, ...
 * @param time_us when, in us
 * @param text    what
 * @param length  its characters
 * @return whether it fits
 */
/*@ requires \valid(message) && \valid_read(text + (0 .. length - 1));
  @ requires \separated(message, text + (0 .. length - 1));
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_logging: ulog_made(message, 'L', \result);
  @ ensures ULG_010_fits: \result <==>
  @     length <= KEEL_ULOG_MESSAGE_BYTES - KEEL_ULOG_HEAD_BYTES - 9;
  @ ensures ULG_010_text: \result ==> message->size == KEEL_ULOG_HEAD_BYTES + 9 + length &&
  @     \forall integer k; 0 <= k < length ==>
  @         message->bytes[KEEL_ULOG_HEAD_BYTES + 9 + k] == text[k];
  @*/
bool keel_ulog_logging(keel_ulog_message_t *message, uint8_t level, uint64_t time_us,
                       const char *text, uint8_t length);

/**
 * A dropout (O; requirement ULG-011): for so long nothing could be logged.
 *
 * @param message receives it
 * @param lost_us how long, in us; at least a millisecond is noted, and at most 65535
 */
/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_dropout: ulog_made(message, 'O', 1);
  @ ensures ULG_011_size: message->size == KEEL_ULOG_DROPOUT_BYTES;
  @*/
void keel_ulog_dropout(keel_ulog_message_t *message, uint64_t lost_us);

/**
 * How many bytes a field's data are (requirement ULG-012).
 *
 * @param field the field
 * @return so many values of its type; 0 when that is not known
 */
/*@ requires \valid_read(field);
  @ assigns \nothing;
  @ ensures ULG_012_most: \result <= 8 * field->count;
  @ ensures ULG_012_unknown: field->type >= KEEL_ULOG_TYPES ==> \result == 0;
  @*/
uint16_t keel_ulog_field_bytes(const keel_ulog_field_t *field);

KEEL_C_END

#endif
