// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c
// covers: keel_mavlink_write cut_of checksum_of
// covers: model_mavlink_write sent_bytes model_mavlink_checksum
//
// Any sender and message, any room, and any payload of up to 8 bytes: each byte more makes the
// checksum harder. WP shows the clauses for any length; what they leave open is the checksum.
//
// What a decoder takes from a frame is what was written, zeros for what was left out.
#include "mavlink_proof.h"

#define PAYLOAD 8u
#define ROOM    34u

void keel_mavlink_write_harness(void)
{
    const keel_mavlink_message_t message = nondet_message();
    keel_mavlink_sender_t sender = {nondet_u8(), nondet_u8(), nondet_u8(), nondet_bool()};
    keel_mavlink_sender_t model_sender = sender;
    uint8_t payload[PAYLOAD];
    uint8_t out[ROOM];
    uint8_t model[ROOM];
    const uint8_t length = nondet_u8();
    const uint32_t size = nondet_u32();
    const uint32_t i = nondet_u32();
    uint16_t expected;
    uint16_t written;

    __CPROVER_assume((length <= PAYLOAD) && (size <= ROOM) && (i < ROOM));
    __CPROVER_assume(out[i] == model[i]);
    expected = model_mavlink_write(&model_sender, &message, payload, length, model, size);

    written = keel_mavlink_write(&sender, &message, payload, length, out, size);

    __CPROVER_assert(written == expected, "MAV_011_model: written or not as the model says");
    __CPROVER_assert(out[i] == model[i], "MAV_012_model: every byte is what the model says");
    __CPROVER_assert(mavlink_sender_same(&sender, &model_sender),
                     "MAV_013_model: so is the sender");
    if (written > 0u) {
        __CPROVER_assert((out[0] == 0xFDu) && (out[2] <= 1u) && (out[1] >= 1u) &&
                             (model_mavlink_whole(out) == written),
                         "MAV_012_frame: it is a frame");
        __CPROVER_assert((i >= length) || (payload[i] == ((i < out[1]) ? out[10u + i] : 0u)),
                         "MAV_012_inverse: the payload is there, but for zeros at its end");
    }
}
