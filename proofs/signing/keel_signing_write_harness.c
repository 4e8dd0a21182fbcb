// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --refine
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_write sign_frame byte_in model_signing_write byte_of
//
// Any state, sender and message, any hash, and any frame of any length. What keel_mavlink_write
// makes of a payload is unknown: the code must ask for the same as the model, and is told the same.
#include "signing_write.h"

void keel_signing_write_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    const uint32_t place = any_below(KEEL_SIGNING_TEXT_MAX);
    keel_signing_t signing = any_valid_signing();
    keel_signing_t model = signing;
    keel_mavlink_sender_t sender = any_sender();
    keel_mavlink_sender_t model_sender = sender;
    const keel_mavlink_message_t message = nondet_message();
    const uint8_t payload[1] = {nondet_u8()};
    const uint8_t length = nondet_u8();
    keel_mavlink_packet_t packet = nondet_packet();
    keel_mavlink_packet_t model_packet = packet;
    uint32_t model_asked;
    uint32_t model_size;
    uint8_t model_byte;
    uint16_t expected;
    uint16_t written;

    begin_frame();
    ask_for(&model);
    expected = model_signing_write(&model, &model_sender, &message, payload, length, &model_packet);
    model_asked = asked;
    model_size = asked_size;
    model_byte = asked_byte;

    ask_for(&signing);
    written = keel_signing_write(&signing, &sender, &message, payload, length, &packet);

    __CPROVER_assert((asked == model_asked) && (asked_size == model_size) && asked_own &&
                         (asked_byte == model_byte),
                     "SGN_011_asked: the hash is asked for as the model says");
    __CPROVER_assert(written == expected, "SGN_011_length: written or not as the model says");
    __CPROVER_assert(packet_same(&packet, &model_packet, at),
                     "SGN_011_model: every byte is what the model says");
    __CPROVER_assert(sender_same(&sender, &model_sender), "SGN_011_sender: so is the sender");
    __CPROVER_assert(signing_same(&signing, &model, place), "SGN_012_model: and every field");
}
