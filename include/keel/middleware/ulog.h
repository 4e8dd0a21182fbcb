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

/**
 * The head of a file (requirement ULG-001): the magic bytes, the version, the time.
 *
 * @param message  receives it
 * @param start_us when logging begins, in us
 */
void keel_ulog_begin(keel_ulog_message_t *message, uint64_t start_us);

/**
 * The flag bits (B), all 0 (requirement ULG-003): nothing that a reader has to know, no appended
 * data. They stand behind what a file begins with.
 *
 * @param message receives it
 */
void keel_ulog_flags(keel_ulog_message_t *message);

/**
 * The format of a topic (F; requirement ULG-004).
 *
 * @param message receives it
 * @param format  the topic
 * @return whether it fits, its fields are not too many, and their types are known
 */
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
void keel_ulog_subscription(keel_ulog_message_t *message, uint8_t instance, uint16_t number,
                            const keel_ulog_name_t *name);

/**
 * Data of a topic (D; requirement ULG-008), none yet: keel_ulog_add appends them.
 *
 * @param message receives it
 * @param number  of the topic
 */
void keel_ulog_data(keel_ulog_message_t *message, uint16_t number);

/**
 * Appends bytes to a message (requirement ULG-009).
 *
 * @param message the message, made by keel_ulog_data
 * @param bytes   what is appended
 * @param count   how many
 * @return whether it fits; otherwise there is no message any more, whatever is added
 */
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
bool keel_ulog_logging(keel_ulog_message_t *message, uint8_t level, uint64_t time_us,
                       const char *text, uint8_t length);

/**
 * A dropout (O; requirement ULG-011): for so long nothing could be logged.
 *
 * @param message receives it
 * @param lost_us how long, in us; at least a millisecond is noted, and at most 65535
 */
void keel_ulog_dropout(keel_ulog_message_t *message, uint64_t lost_us);

/**
 * How many bytes a field's data are (requirement ULG-012).
 *
 * @param field the field
 * @return so many values of its type; 0 when that is not known
 */
uint16_t keel_ulog_field_bytes(const keel_ulog_field_t *field);

KEEL_C_END

#endif
