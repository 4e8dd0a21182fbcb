// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/middleware/signing.c src/middleware/mavlink.c src/middleware/crc.c
// sources: specs/model/signing.c
// covers: keel_signing_write sign_frame put_timestamp model_signing_write byte_of
//
// Any state, sender and message, and any payload of up to 2 bytes: what is signed of a frame does
// not depend on what it says, and how long it may be is WP's part.
#include "signing_proof.h"

#define PAYLOAD 2u
#define ROOM    27u

keel_mavlink_message_t nondet_message(void);

void keel_signing_write_harness(void)
{
    keel_signing_t signing = any_signing();
    keel_signing_t model = signing;
    keel_mavlink_sender_t sender = {nondet_u8(), nondet_u8(), nondet_u8(), nondet_bool()};
    keel_mavlink_sender_t model_sender = sender;
    const keel_mavlink_message_t message = nondet_message();
    const uint8_t payload[PAYLOAD] = {nondet_u8(), nondet_u8()};
    const uint8_t length = nondet_u8();
    const uint32_t size = nondet_u32();
    uint8_t out[ROOM];
    uint8_t model_out[ROOM];
    uint32_t model_asked;
    uint32_t model_size;
    uint8_t model_byte;
    uint16_t expected;
    uint16_t written;

    __CPROVER_assume((length <= PAYLOAD) && (size <= ROOM));
    for (uint32_t i = 0u; i < ROOM; i++) {
        out[i] = nondet_u8();
        model_out[i] = out[i];
    }
    expected = model_signing_write(&model, &model_sender, &message, payload, length, model_out,
                                   size);
    model_asked = asked;
    model_size = asked_size;
    model_byte = asked_byte;
    asked = 0u;

    written = keel_signing_write(&signing, &sender, &message, payload, length, out, size);

    __CPROVER_assert((asked == model_asked) && (asked_size == model_size) &&
                         (asked_byte == model_byte),
                     "SGN_011_asked: the hash is asked for as the model says");
    __CPROVER_assert(written == expected, "SGN_011_length: written or not as the model says");
    for (uint32_t i = 0u; i < ROOM; i++) {
        __CPROVER_assert(out[i] == model_out[i],
                         "SGN_011_model: every byte is what the model says");
    }
    __CPROVER_assert((sender.sequence == model_sender.sequence) &&
                         (sender.is_signing == model_sender.is_signing),
                     "SGN_011_sender: so is the sender");
    __CPROVER_assert(signing_same(&signing, &model), "SGN_012_model: and every field");
}
