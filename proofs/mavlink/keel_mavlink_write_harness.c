// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 280 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c
// covers: keel_mavlink_write cut_of checksum_of
// covers: model_mavlink_write sent_bytes model_mavlink_checksum
//
// Any payload, sender and message, and any room. What a decoder takes from a frame
// (model_mavlink_frame) is what was written.
#include "mavlink_proof.h"

void keel_mavlink_write_harness(void)
{
    const keel_mavlink_message_t message = nondet_message();
    keel_mavlink_sender_t sender = {nondet_u8(), nondet_u8(), nondet_u8(), nondet_bool()};
    keel_mavlink_sender_t model_sender = sender;
    uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX];
    uint8_t out[KEEL_MAVLINK_FRAME_MAX];
    uint8_t model[KEEL_MAVLINK_FRAME_MAX];
    const uint8_t length = nondet_u8();
    const uint32_t size = nondet_u32();
    const uint32_t i = nondet_u32();
    uint16_t expected;
    uint16_t written;

    __CPROVER_assume((size <= KEEL_MAVLINK_FRAME_MAX) && (i < KEEL_MAVLINK_FRAME_MAX));
    __CPROVER_assume(out[i] == model[i]);
    expected = model_mavlink_write(&model_sender, &message, payload, length, model, size);

    written = keel_mavlink_write(&sender, &message, payload, length, out, size);

    __CPROVER_assert(written == expected, "MAV_011_model: written or not as the model says");
    __CPROVER_assert(out[i] == model[i], "MAV_012_model: every byte is what the model says");
    __CPROVER_assert((sender.sequence == model_sender.sequence) &&
                         (sender.system == model_sender.system) &&
                         (sender.component == model_sender.component) &&
                         (sender.is_signing == model_sender.is_signing),
                     "MAV_013_model: so is the sender");
    if (written > 0u) {
        const keel_mavlink_frame_t says = model_mavlink_frame(out);

        __CPROVER_assert((out[0] == 0xFDu) && (out[2] <= 1u) && (out[1] >= 1u) &&
                             (model_mavlink_whole(out) == written),
                         "MAV_012_frame: it is a frame");
        __CPROVER_assert((says.id == message.id) && (says.system == sender.system) &&
                             (says.component == sender.component) &&
                             (says.sequence == (uint8_t)(sender.sequence - 1u)),
                         "MAV_012_header: a decoder is told who sends what");
        __CPROVER_assert((i >= 255u) || (says.payload[i] == ((i < length) ? payload[i] : 0u)),
                         "MAV_012_inverse: and the payload, zeros for those left out");
    }
}
