/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file signing.h
 * @brief What the functions of keel/middleware/signing.h do.
 */
#ifndef MODEL_SIGNING_H
#define MODEL_SIGNING_H

#include "keel/middleware/signing.h"

void model_signing_init(keel_signing_t *signing, uint8_t link, keel_signing_hash_fn_t hash);
void model_signing_set_key(keel_signing_t *signing, const uint8_t *key);
void model_signing_clear_key(keel_signing_t *signing);
void model_signing_advance(keel_signing_t *signing, uint64_t timestamp);
bool model_signing_accepts(keel_signing_t *signing, const keel_mavlink_frame_t *frame);
uint16_t model_signing_write(keel_signing_t *signing, keel_mavlink_sender_t *sender,
                             const keel_mavlink_message_t *message, const uint8_t *payload,
                             uint8_t length, keel_mavlink_packet_t *packet);

#endif
