// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282 --max-field-sensitivity-array-size 300
// checks: assertions
// sources: src/middleware/mavlink.c specs/model/mavlink.c
// replaces: keel_crc16
// covers: keel_mavlink_write cut_of checksum_of
//
// Chosen payloads of up to 255 bytes, with zeros at their end or none, that fit or are just too
// long: the same as the model's. Faults that only a long payload shows are refuted here;
// keel_mavlink_write_harness has every payload of up to 32 bytes.
#include "mavlink_contracts.h"

#define ASKED (10u + KEEL_MAVLINK_PAYLOAD_MAX)
#include "told_crc_steps.h"

typedef struct {
    uint8_t length;
    uint8_t zeros_from;
    bool is_signing;
    uint8_t longest;
} point_t;

#define POINTS 10u

static const point_t point[POINTS] = {
    {255u, 255u, true, 255u},  {255u, 200u, false, 255u}, {255u, 65u, true, 255u},
    {200u, 255u, true, 255u},  {64u, 255u, false, 64u},   {65u, 64u, true, 255u},
    {0u, 255u, false, 255u},   {63u, 255u, true, 63u},    {65u, 255u, true, 64u},
    {255u, 255u, false, 254u},
};

void keel_mavlink_write__points_harness(void)
{
    uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX];
    keel_mavlink_packet_t old;

    for (uint32_t at = 0u; at < KEEL_MAVLINK_FRAME_MAX; at++) {
        old.bytes[at] = (uint8_t)(at | 1u);
    }
    for (uint32_t i = 0u; i < POINTS; i++) {
        const keel_mavlink_message_t message = {
            .id = 0x123456u, .longest = point[i].longest, .crc_extra = 77u};
        bool same = true;
        keel_mavlink_sender_t sender = {(uint8_t)(i * 36u), 3u, 200u, point[i].is_signing};
        keel_mavlink_sender_t model_sender = sender;
        keel_mavlink_packet_t packet = old;
        keel_mavlink_packet_t model = packet;
        uint16_t expected;
        uint16_t written;

        for (uint32_t j = 0u; j < KEEL_MAVLINK_PAYLOAD_MAX; j++) {
            payload[j] = (j < point[i].zeros_from) ? (uint8_t)((j % 251u) + 1u) : 0u;
        }
        tell_steps();
        expected = model_mavlink_write(&model_sender, &message, payload, point[i].length, &model);

        tell_code();
        written = keel_mavlink_write(&sender, &message, payload, point[i].length, &packet);

        __CPROVER_assert(written == expected, "MAV_011_model: written or not as the model says");
        for (uint32_t at = 0u; at < KEEL_MAVLINK_FRAME_MAX; at++) {
            same = same && mavlink_packet_same(&packet, &model, at);
        }
        __CPROVER_assert(same, "MAV_012_model: every byte is what the model says");
        __CPROVER_assert(mavlink_sender_same(&sender, &model_sender),
                         "MAV_013_model: so is the sender");
    }
}
