/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ulog.h
 * @brief What the functions of keel/middleware/ulog.h do: messages of any length are made, and
 *        kept when they fit.
 */
#ifndef MODEL_ULOG_H
#define MODEL_ULOG_H

#include "keel/middleware/ulog.h"

void model_ulog_begin(keel_ulog_message_t *message, uint64_t start_us);
void model_ulog_flags(keel_ulog_message_t *message);
bool model_ulog_format(keel_ulog_message_t *message, const keel_ulog_format_t *format);
bool model_ulog_information(keel_ulog_message_t *message, const keel_ulog_name_t *name,
                            const char *text, uint8_t length);
bool model_ulog_parameter(keel_ulog_message_t *message, const keel_ulog_name_t *name, uint8_t type,
                          const uint8_t *value);
void model_ulog_subscription(keel_ulog_message_t *message, uint8_t instance, uint16_t number,
                             const keel_ulog_name_t *name);
void model_ulog_data(keel_ulog_message_t *message, uint16_t number);
bool model_ulog_add(keel_ulog_message_t *message, const uint8_t *bytes, uint16_t count);
bool model_ulog_logging(keel_ulog_message_t *message, uint8_t level, uint64_t time_us,
                        const char *text, uint8_t length);
void model_ulog_dropout(keel_ulog_message_t *message, uint64_t lost_us);
uint16_t model_ulog_field_bytes(const keel_ulog_field_t *field);

#endif
