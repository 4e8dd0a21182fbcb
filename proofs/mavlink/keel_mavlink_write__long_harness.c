// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 58 --external-sat-solver cadical
// sources: src/middleware/mavlink.c specs/model/mavlink.c
// covers: keel_mavlink_write cut_of checksum_of
// covers: model_mavlink_write sent_bytes model_mavlink_checksum
//
// Any sender and message, and any payload of up to 32 bytes: the solver's time grows with them.
// What a byte makes of the checksum is unknown: the code must ask the same as the model, byte by
// byte, and is told the same.
#include "../../specs/model/crc.h"
#include "mavlink_proof.h"

/* The bytes that a checksum can be of, and its message's. */
#define PAYLOAD 32u
#define ASKED   (10u + PAYLOAD)

keel_mavlink_packet_t nondet_packet(void);

static uint8_t asked[ASKED];
static uint16_t told[ASKED];
static uint32_t count;
static bool is_model;

static uint16_t told_crc(uint16_t crc, uint8_t byte)
{
    const uint32_t n = count;

    __CPROVER_assert(n < ASKED, "MAV_012_asks: no more than a frame has");
    __CPROVER_assert(crc == ((n == 0u) ? 0xFFFFu : told[n - 1u]), "MAV_012_order: in turn");
    count = n + 1u;
    if (is_model) {
        asked[n] = byte;
        told[n] = nondet_u16();
    } else {
        __CPROVER_assert(byte == asked[n], "MAV_012_same: of the same byte");
    }
    return told[n];
}

uint16_t model_crc16(uint16_t crc, uint8_t byte)
{
    return told_crc(crc, byte);
}

uint16_t keel_crc16(uint16_t crc, uint8_t byte)
{
    return told_crc(crc, byte);
}

void keel_mavlink_write__long_harness(void)
{
    const keel_mavlink_message_t message = nondet_message();
    keel_mavlink_sender_t sender = {nondet_u8(), nondet_u8(), nondet_u8(), nondet_bool()};
    keel_mavlink_sender_t model_sender = sender;
    uint8_t payload[PAYLOAD];
    keel_mavlink_packet_t packet = nondet_packet();
    keel_mavlink_packet_t model = packet;
    const uint8_t length = nondet_u8();
    const uint32_t i = nondet_u32();
    uint16_t expected;
    uint16_t written;

    __CPROVER_assume(length <= PAYLOAD);
    is_model = true;
    expected = model_mavlink_write(&model_sender, &message, payload, length, &model);

    is_model = false;
    count = 0u;
    written = keel_mavlink_write(&sender, &message, payload, length, &packet);

    __CPROVER_assert(written == expected, "MAV_011_model: written or not as the model says");
    __CPROVER_assert((i >= KEEL_MAVLINK_FRAME_MAX) || (packet.bytes[i] == model.bytes[i]),
                     "MAV_012_model: any byte is what the model says");
    __CPROVER_assert(mavlink_sender_same(&sender, &model_sender),
                     "MAV_013_model: so is the sender");
}
