// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 58 --external-sat-solver cadical
// sources: src/middleware/mavlink.c specs/model/mavlink.c
// replaces: keel_crc16
// covers: keel_mavlink_write cut_of checksum_of
// covers: model_mavlink_write sent_bytes model_mavlink_checksum
//
// Any sender and message, and any payload of up to 32 bytes: the solver's time grows with them.
// What a byte makes of a checksum is unknown, the same for code and model.
//
// What a decoder takes from a frame is what was written, zeros for what was left out.
#include "mavlink_contracts.h"

#define PAYLOAD 32u
#define ASKED   (10u + PAYLOAD)
#include "told_crc.h"

keel_mavlink_packet_t nondet_packet(void);

void keel_mavlink_write_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    const keel_mavlink_message_t message = nondet_message();
    keel_mavlink_sender_t sender = {nondet_u8(), nondet_u8(), nondet_u8(), nondet_bool()};
    keel_mavlink_sender_t model_sender = sender;
    uint8_t payload[PAYLOAD];
    keel_mavlink_packet_t packet = nondet_packet();
    keel_mavlink_packet_t model = packet;
    const uint8_t length = nondet_u8();
    const uint32_t i = any_below(PAYLOAD);
    uint16_t expected;
    uint16_t written;

    __CPROVER_assume(length <= PAYLOAD);
    tell_model();
    expected = model_mavlink_write(&model_sender, &message, payload, length, &model);

    tell_code();
    written = keel_mavlink_write(&sender, &message, payload, length, &packet);

    __CPROVER_assert(written == expected, "MAV_011_model: written or not as the model says");
    __CPROVER_assert(mavlink_packet_same(&packet, &model, at),
                     "MAV_012_model: every byte is what the model says");
    __CPROVER_assert(mavlink_sender_same(&sender, &model_sender),
                     "MAV_013_model: so is the sender");
    if (written > 0u) {
        __CPROVER_assert((packet.bytes[0] == 0xFDu) && (packet.bytes[2] <= 1u) &&
                             (packet.bytes[1] >= 1u) &&
                             (model_mavlink_whole(packet.bytes) == written),
                         "MAV_012_frame: it is a frame");
        __CPROVER_assert((i >= length) ||
                             (payload[i] == ((i < packet.bytes[1]) ? packet.bytes[10u + i] : 0u)),
                         "MAV_012_inverse: the payload is there, but for zeros at its end");
    }
}
