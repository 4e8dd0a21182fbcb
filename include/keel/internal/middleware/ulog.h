/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/ulog.h
 * @brief The contracts of ulog.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_ULOG_H
#define KEEL_INTERNAL_MIDDLEWARE_ULOG_H

#include "keel/c_declarations.h"
#include "keel/middleware/ulog.h"

KEEL_C_BEGIN

/*@ predicate ulog_valid(keel_ulog_message_t *m) = m->size <= KEEL_ULOG_MESSAGE_BYTES;
  @
  @ // A whole message of a kind, or none.
  @ predicate ulog_made(keel_ulog_message_t *m, integer kind, integer made) =
  @     ulog_valid(m) && (made == 0 ==> m->size == 0) && (made != 0 ==>
  @         m->size >= KEEL_ULOG_HEAD_BYTES && m->bytes[2] == kind && m->overflowed == 0 &&
  @         m->bytes[0] + 256 * m->bytes[1] == m->size - KEEL_ULOG_HEAD_BYTES);
  @*/

/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_001_size: message->size == KEEL_ULOG_BEGIN_BYTES;
  @ ensures ULG_001_magic: message->bytes[0] == 0x55 && message->bytes[1] == 0x4C &&
  @     message->bytes[2] == 0x6F && message->bytes[3] == 0x67 && message->bytes[4] == 0x01 &&
  @     message->bytes[5] == 0x12 && message->bytes[6] == 0x35 && message->bytes[7] == 0x01;
  @*/
void keel_ulog_begin(keel_ulog_message_t *message, uint64_t start_us);

/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_flags: ulog_made(message, 'B', 1);
  @ ensures ULG_003_size: message->size == 43;
  @*/
void keel_ulog_flags(keel_ulog_message_t *message);

/*@ requires \valid(message) && \valid_read(format) && \separated(message, format);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_format: ulog_made(message, 'F', \result);
  @ ensures ULG_004_fields: \result ==> format->fields <= KEEL_ULOG_FIELDS;
  @ ensures ULG_004_types: \result ==> \forall integer i; 0 <= i < format->fields ==>
  @     format->field[i].type < KEEL_ULOG_TYPES;
  @*/
bool keel_ulog_format(keel_ulog_message_t *message, const keel_ulog_format_t *format);

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

/*@ requires \valid(message) && \valid_read(name) && \valid_read(value + (0 .. 3));
  @ requires \separated(message, name) && \separated(message, value + (0 .. 3));
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_parameter: ulog_made(message, 'P', \result);
  @ ensures ULG_006_type: \result <==> type == KEEL_ULOG_INT32 || type == KEEL_ULOG_FLOAT;
  @*/
bool keel_ulog_parameter(keel_ulog_message_t *message, const keel_ulog_name_t *name, uint8_t type,
                         const uint8_t *value);

/*@ requires \valid(message) && \valid_read(name) && \separated(message, name);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_subscription: ulog_made(message, 'A', 1);
  @*/
void keel_ulog_subscription(keel_ulog_message_t *message, uint8_t instance, uint16_t number,
                            const keel_ulog_name_t *name);

/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_data: ulog_made(message, 'D', 1);
  @ ensures ULG_008_size: message->size == 5;
  @*/
void keel_ulog_data(keel_ulog_message_t *message, uint16_t number);

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

/*@ requires \valid(message);
  @ assigns message->size, message->overflowed,
  @     message->bytes[0 .. KEEL_ULOG_MESSAGE_BYTES - 1];
  @ ensures ULG_002_dropout: ulog_made(message, 'O', 1);
  @ ensures ULG_011_size: message->size == KEEL_ULOG_DROPOUT_BYTES;
  @*/
void keel_ulog_dropout(keel_ulog_message_t *message, uint64_t lost_us);

/*@ requires \valid_read(field);
  @ assigns \nothing;
  @ ensures ULG_012_most: \result <= 8 * field->count;
  @ ensures ULG_012_unknown: field->type >= KEEL_ULOG_TYPES ==> \result == 0;
  @*/
uint16_t keel_ulog_field_bytes(const keel_ulog_field_t *field);

KEEL_C_END

#endif
